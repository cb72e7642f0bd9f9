// topics.c: the subjects of `lambent help TOPIC`, which are the prose of the man page and the docs.
#include "topics.h"

#include "options.h"

#define BIT(group) (1ull << GROUP_##group)

const struct topic topics[] = {
    {"models", "Models", BIT(MODEL), TOPIC_NO_TABLE,
     "MODEL is a file, the name of a built-in shape, or `-` for standard input. The content decides the format; "
     "the extension is only a hint. The name of a built-in shape means the shape even if a file has that name: "
     "write `./teapot` for the file, and `./shapes` for a file that has the name of a command.\n"
     "Several models may be given: each becomes its own picture, in the current folder or that of `-o pictures/`. "
     "A model that fails is reported and the others are still drawn; the exit code is then the highest one. `-o "
     "FILE` and `-` need a single model."},
    {"batch", "Many models", BIT(BATCH), TOPIC_NO_TABLE,
     "`lambent batch` draws folders with all models below them, lists (`@FILE`), and names on standard input (`-`), as "
     "many at once as there are processors, and writes a journal: `lambent batch models/ -o "
     "'thumbs/{dir}/{stem}.png'`. `--dry-run` prints which picture each model becomes. Killed at any moment, the same "
     "command with `--resume` goes on; with `--skip-same` it draws only what has changed. The exit code is 7 where "
     "some "
     "pictures failed, and 0 with `--failures-ok`. `docs/batch.md` has the details. With `--jobs -` it takes jobs from "
     "a server, a line of JSON each, and answers them (`docs/worker.md`)."},
    {"viewer", "The viewer", BIT(VIEWER), TOPIC_NO_TABLE,
     "`lambent view bunny.obj` shows a model in the browser, and again whenever its file changes; `lambent view "
     "models/` is a gallery of a "
     "folder. It needs the page that `make web` builds, once, in the folder of Lambent's sources. It serves that page "
     "on "
     "127.0.0.1 alone, at an address that holds a secret, and ends with Ctrl-C. "
     "`docs/view.md` has the details."},
    {"formats", "Model formats", 0, TOPIC_NO_TABLE,
     "`lambent formats` lists the formats that are read and written; `docs/formats.md` says how each element of each "
     "format is drawn.\n"
     "3MF (`.3mf`): a ZIP archive of 3D printing, with units, components, colours, textures, layers of them, and "
     "metals. "
     "libzip and expat are opened when a file needs them (Debian's `libzip4` or `libzip5`, and `libexpat1`). Beams, "
     "slices and "
     "displacements are not drawn, with a warning. `--lenient` reads files that require unknown extensions, or use an "
     "XML "
     "prefix that they do not declare.\n"
     "STL (`.stl`): triangles, text or binary. Z is up. The format has no unit; binary files may have colours.\n"
     "OBJ (`.obj`): with its `.mtl` materials and textures. Y is up.\n"
     "PLY (`.ply`): triangles, points and lines, with colours, text or binary.\n"
     "glTF (`.gltf`, `.glb`): scenes with physical materials, lights, cameras, skins and animations, in metres. Y is "
     "up. `--scene`, `--variant`, `--animation` and `--time` select from its contents. Draco and meshoptimizer are "
     "decoded "
     "if their libraries are installed."},
    {"picture", "The picture", BIT(PICTURE), TOPIC_NO_TABLE, NULL},
    {"output", "Output", 0, TOPIC_NO_TABLE,
     "Without `-o` the picture of `models/koala.obj` is `koala.png` in the current folder. An older picture "
     "written by lambent (recognised by the `Software` text in the PNG) is replaced; any other file of that name "
     "stays, and the exit code is 5. With `-o` the named file is replaced. A picture is written completely or not "
     "at all, and nothing else is left in its folder, even if lambent is killed meanwhile.\n"
     "Standard output carries the picture (`-o -`) or the report (`--json`), and nothing else. Warnings, errors, "
     "the line that names the written file, and a progress bar (only on a terminal, for work of over half a "
     "second) go to standard error."},
    {"view", "The view", BIT(VIEW), TOPIC_NO_TABLE, NULL},
    {"lights", "Lights", BIT(LIGHTS), TOPIC_LIGHT_FIELDS, NULL},
    {"materials", "Materials", BIT(MATERIALS), TOPIC_MATERIAL_FIELDS, NULL},
    {"shading", "Shading", BIT(SHADING), TOPIC_NO_TABLE, NULL},
    {"animations", "Animations", BIT(ANIMATION), TOPIC_NO_TABLE,
     "`lambent MODEL --turntable 36` and `lambent MODEL --sweep light.azimuth=0..360` draw several pictures of one "
     "model, "
     "which is read once. They go into one animated PNG or WebP that loops for ever, as the ending of `-o` says, or "
     "with "
     "`{frame}` in the name into a file each. A frame is the picture that its options give by themselves; the camera "
     "and "
     "an automatic exposure are those of the first."},
    {"sheets", "Sheets", BIT(SHEET) | BIT(CAPTIONS), TOPIC_NO_TABLE,
     "`lambent compare MODEL` writes one PNG with several pictures of a model and a caption under each: `lambent "
     "MODEL` draws the same picture with the options printed in grey under the title and under the caption. "
     "`--sheet` selects the pictures; `--across OPTION=VALUES` makes a row with one picture for each value. Every "
     "other option applies to all pictures, `--size` (480x400) to each; the options under a caption follow those of "
     "the command line and override them. The background is white by default. The sheet is `MODEL-NAME.png` in the "
     "current folder or in the folder of `-o`, or the file of `-o`. The pictures are the same bytes everywhere; only "
     "the letters are FreeType's.\n"
     "The options under the title are the sheet's defaults, without which there would be little to see. Sheets about "
     "shading draw a built-in shape with few segments (`--segments` decides otherwise) under one light (not with "
     "`--light` or `--rig`, nor with a model that has lights), and sheets with highlights a material that has one (not "
     "with `--material`, nor with a model that has materials).\n"
     "`--sheet stages` frames the brightest highlight (the largest difference to the picture without highlights) "
     "and shows it below, three times as large. `terms` removes the other terms with black coefficients; `ambient` "
     "sets the ambient coefficient of the default material."},
    {"explain", "Explaining a pixel", 0, TOPIC_NO_TABLE,
     "`lambent explain MODEL X,Y` takes the options of a picture and prints the calculation of the pixel in column "
     "X and row Y (from 0, from the top left corner): each visible triangle with its samples, the object, the "
     "position in the triangle, n, v and t, and the material; for each light its matrix (rows ambient, diffuse, "
     "specular), l, r and h, the angles between n and l, r and v, n and h, the distance, attenuation and spot "
     "factor, the highlight's base and power, and its diffuse and specular terms; then the terms and their sum, "
     "the weighted sum of the triangles over the background, the encoding and the bytes. Vectors are in eye space. "
     "The numbers are those of the picture, to the last bit; `docs/lighting.md` has the formulas. `--json` prints "
     "the same as one line. No picture is written; `--output` has no effect."},
    {"info", "What is in a model", 0, TOPIC_NO_TABLE,
     "`lambent info MODEL...` prints what is in models, one after the other, and writes no picture: format, the "
     "program "
     "that wrote the file, size with the up axis, triangles, meshes, parts and objects, materials with their numbers "
     "and maps, textures with their sizes, lights, cameras, scenes, animations with their lengths, variants, "
     "extensions of glTF and "
     "what becomes of each (supported, ignored, or unknown), memory, the time that loading took, and warnings. Lists "
     "end after 8 rows; `--json` prints everything, one line for each model (`docs/info.schema.json`). Lengths of "
     "glTF are metres, and 3MF names its unit: the size, the area and the volume are printed in millimetres; other "
     "formats do not say. "
     "The volume is that of a closed surface: one whose every edge belongs to as many triangles in one direction as in "
     "the other. A file that requires an unknown extension is read as with "
     "`--lenient`, and the output says so. The memory is that of the model, and what drawing 1024x1024 pixels takes "
     "besides, the picture included: the depths are drawn once to find it. A model that cannot be read is reported, "
     "and the exit code is the highest one."},
    {"check", "Checking shaders", BIT(CHECK) | BIT(DIFF), TOPIC_NO_TABLE,
     "`lambent check SHADER.frag --vertex SHADER.vert` draws small reference scenes with the shaders and compares "
     "the pictures with those of the CPU device. Without `--vertex` a correct vertex shader is generated. The "
     "contract is recognised by the names of uniforms and attributes; `--list` prints the contracts, the scenes "
     "and the known mistakes. Where pictures differ, the same scenes are drawn with known mistakes made on "
     "purpose; the smallest set that reproduces the shader's pictures is reported, with a line to write instead. "
     "`-o` writes a sheet with the shader's picture, the reference and the difference (times `--gain`) of each "
     "scene. `--tolerance` (default 2) applies to each channel of a pixel: one pixel in 200 may exceed it, and the "
     "mean difference may be a quarter of it. The shaders run in a process of their own, which `--stop-after` and "
     "`--memory-limit` limit. `lambent check --class FOLDER --csv grades.csv -o sheets/` checks a class: each "
     "folder with one fragment shader and at most one vertex shader is a submission, and elsewhere each fragment "
     "shader with the vertex shader of the same name beside it; `sheets/index.html` is a page with everything. "
     "Several shaders may also be given by name: `lambent check */phong.frag */phong.vert` takes each vertex "
     "shader with the fragment shader of the same folder and name, and `-o sheets/` writes a sheet for each. A "
     "shader that cannot be checked is reported, and the others are still checked. The exit code is 0 if every "
     "scene of every shader matches the reference, else the highest of all; 6 also for shaders that do not "
     "compile, do not end, or write NaN. With `--json` the report is one line (`docs/check.schema.json`). More: "
     "`docs/check.md`."},
    {"shaders", "Shaders for other programs", BIT(SHADER), TOPIC_NO_TABLE, NULL},
    {"diff", "Comparing pictures", BIT(DIFF), TOPIC_NO_TABLE,
     "`lambent diff A B` reads two pictures of the same size (PNG or PPM with 8 bits, PFM with floats, both of one "
     "kind) and prints the largest difference of a channel, the mean and the root mean square over all channels "
     "(red, green, blue and alpha as stored in the files, 1 = full range), the PSNR in decibels (`infinite` for "
     "equal pictures, null in JSON), and the share of pixels in which a channel differs by more than 1/255 and "
     "2/255. `-o` draws the difference (`-o out/`: as `A-difference.png` in that folder): each channel is its "
     "difference times `--gain`, clamped at white; black means equal; a pixel that differs only in alpha is grey. "
     "A `.pfm` stores the differences as floats without clamping. With `--json` the figures are one line: `a`, "
     "`b`, `width`, `height`, `maximum`, `mean`, `rmse`, `psnr_db`, `share_over_1`, `share_over_2`, `tolerance`, "
     "`differ` (0 or 1: beyond the tolerance) and `picture`. The exit code is 6 if the largest difference exceeds "
     "the tolerance, 1 if the sizes or kinds differ. `lambent diff OLD NEW` of two models or two folders draws the "
     "models of "
     "both sides with one camera: `-o report.html` is a page with what was added, removed or changed, and pictures "
     "before and after. More: `docs/pull-requests.md`."},
    {"hash", "Hashes of pictures", BIT(HASH), TOPIC_NO_TABLE,
     "`lambent hash models/ -o pictures.hash` writes a line for each model: the XXH64 of its picture's pixels (rows "
     "from "
     "the "
     "top, red, green, blue, alpha) and its name, relative to the file. The head of the file names the version and the "
     "options. "
     "Pictures are the same on every machine, so a repository can keep this file in place of the pictures: `lambent "
     "hash "
     "models/ --check pictures.hash` names the models whose pictures are others. More: `docs/pull-requests.md`."},
    {"convert", "Models in another format", BIT(CONVERT), TOPIC_NO_TABLE,
     "`lambent convert MODEL OUT.glb` writes any model or scene file as GLB, OBJ (with MTL and PNG beside it), STL, "
     "PLY or "
     "3MF: geometry, materials with their pictures, lights and cameras as far as the format holds them. What it does "
     "not "
     "hold is said in one sentence each. More: `docs/convert.md`."},
    {"formulas", "Surfaces given by formulas", BIT(SHAPE), TOPIC_NO_TABLE,
     "`lambent shape --parametric 'x=...; y=...; z=...'` draws a surface over u and v, `--implicit 'x^2+y^2+z^2-1'` "
     "one "
     "on which an expression of x, y and z is zero. `-o torus.obj`, `.stl` or `.ply` saves it as a model file; "
     "built-in "
     "shapes too, `lambent shape teapot -o teapot.stl`. Normals come from symbolic derivatives. Of a surface over u "
     "and v, "
     "ends that meet are joined, and creases along a line of the grid stay sharp (`--segments 64x32`). "
     "`docs/shapes.md` "
     "describes the language."},
    {"plots", "Plots", BIT(PLOT) | BIT(CAPTIONS), TOPIC_NO_TABLE,
     "`lambent plot attenuation a/b/c...` draws 1/(a + b d + c d^2) over the distance d. A curve is three such "
     "numbers, a light as `--light` takes it (`spot:attenuation=0/0/1,range=9`), or every light of a model or "
     "scene file. A dot marks where each curve falls below 1/255, the last step of a picture with 8 bits; a fourth "
     "number (`a/b/c/range`) is a range as in glTF. `lambent plot spot cutoff=30,exponent=8 inner=20,outer=35` "
     "draws the cone of spot lights over the angle from the axis, by OpenGL's law or glTF's. `lambent plot "
     "highlight 10 50 1000` draws the highlight over the angle between the mirrored light and the eye: for each "
     "shininess Phong's and Blinn-Phong's, and Blinn-Phong's at four times the shininess, which looks like "
     "Phong's. Without curves each plot draws a default set. The values come from the functions that light pixels.\n"
     "The picture is `attenuation.png`, `spot.png` or `highlight.png` (in the folder of `-o plots/`), 1600x1000 "
     "pixels, unless `-o` and `-s` say otherwise; a name that ends in `.svg` makes an SVG. The table on standard "
     "output lists where each curve falls below 1/255; with `--json` it is one line: `plot`, `x`, `y`, `curves` "
     "(each with `label`, `below_1_255_from`, null for never, and `points`, 101 pairs) and `picture`."},
    {"work", "Threads and devices", BIT(WORK), TOPIC_NO_TABLE, NULL},
    {"limits", "Limits", BIT(LIMITS), TOPIC_NO_TABLE,
     "Files from strangers may be made to crash, hang or fill a machine, so limits hold unless options change them. "
     "What is over one is reported with the number that was found, the one that is allowed and the option that "
     "raises it, and the exit code is 4. Decoders of pictures and of compressed meshes are held to the same limits. "
     "`SECURITY.md` says what is promised, and how it is tested."},
    {"reports", "Reports", BIT(REPORT), TOPIC_NO_TABLE, NULL},
    {"bytes", "Same picture everywhere", 0, TOPIC_NO_TABLE,
     "The same model and options give the same bytes, whatever the instruction set, the number of threads, the "
     "compiler and the machine."},
    {"variables", "Environment", 0, TOPIC_NO_TABLE,
     "`NO_COLOR`: if set and not empty, messages have no colours. `TERM=dumb` also disables the progress bar. The "
     "locale has no effect: numbers always have a point."},
    {"exit-codes", "Exit codes", 0, TOPIC_EXIT_CODES, NULL},
    {.word = NULL},
};
