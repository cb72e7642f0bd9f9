// topics.c: the subjects of `lambent help TOPIC`, which are the prose of the man page and the docs.
#include "topics.h"

#include "options.h"

#define BIT(group) (1ull << GROUP_##group)

const struct topic topics[] = {
    {"models", "Models", BIT(MODEL), TOPIC_NO_TABLE,
     "MODEL is a file, the name of a built-in shape, or `-` for standard input. Lambent recognises the format by the "
     "content; the extension is only a hint. The name of a built-in shape always means the shape. Write `./teapot` for "
     "a file of that name, and `./shapes` for a file named like a command. After `--` every word is a model, even if "
     "it begins with a dash.\nWith several models, each becomes its own picture, in the current folder or in the "
     "folder of `-o pictures/`. If a model fails, Lambent reports it and draws the others; the exit code is then the "
     "highest one. `-o FILE` and `-` need a single model."},
    {"batch", "Many models", BIT(BATCH), TOPIC_NO_TABLE,
     "`lambent batch` draws folders with their sub-folders, lists (`@FILE`), and names on standard input (`-`). It "
     "draws as many models at once as there are processors, and writes a journal: `lambent batch models/ -o "
     "'thumbs/{dir}/{stem}.png'`. `--dry-run` prints the picture's name for each model. If the run is interrupted, "
     "repeat the command with `--resume`. To draw only changed models, use `--skip-same`. The exit code is 7 if some "
     "pictures failed, and 0 with `--failures-ok`. `docs/batch.md` has the details. With `--jobs -` it serves other "
     "programs: it reads one JSON job per line and answers each (`docs/worker.md`)."},
    {"viewer", "The viewer", BIT(VIEWER), TOPIC_NO_TABLE,
     "`lambent view bunny.obj` shows a model in the browser, and updates the picture when the file changes. `lambent "
     "view models/` shows a gallery of a folder. It needs the page that `make web` builds, once, in the folder of "
     "Lambent's sources. It serves that page only on 127.0.0.1, at an address with a secret token, and ends with "
     "Ctrl-C. `docs/view.md` has the details."},
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
     "Without `-o` the picture of `models/koala.obj` is `koala.png` in the current folder. Lambent replaces an older "
     "picture that it wrote (recognised by the `Software` text in the PNG). Any other file of that name remains, and "
     "the exit code is 5. With `-o`, Lambent replaces the named file. A picture is written completely or not at all. "
     "Nothing else remains in its folder, even if lambent is killed.\nStandard output carries only the picture (`-o "
     "-`) or the report (`--json`). All other output goes to standard error: warnings, errors, the line that names the "
     "written file, and a progress bar (only on a terminal, for work of over half a second)."},
    {"view", "The view", BIT(VIEW), TOPIC_NO_TABLE, NULL},
    {"lights", "Lights", BIT(LIGHTS), TOPIC_LIGHT_FIELDS, NULL},
    {"materials", "Materials", BIT(MATERIALS), TOPIC_MATERIAL_FIELDS, NULL},
    {"shading", "Shading", BIT(SHADING), TOPIC_NO_TABLE, NULL},
    {"animations", "Animations", BIT(ANIMATION), TOPIC_NO_TABLE,
     "`lambent MODEL --turntable 36` and `lambent MODEL --sweep light.azimuth=0..360` draw several pictures of one "
     "model, and read it once. The frames go into one animated PNG or WebP that loops forever, chosen by the extension "
     "in `-o`. With `{frame}` in the name, each frame gets its own file. A frame is identical to a picture drawn alone "
     "with its options. The camera and an automatic exposure are the first frame's."},
    {"sheets", "Sheets", BIT(SHEET) | BIT(CAPTIONS), TOPIC_NO_TABLE,
     "`lambent compare MODEL` writes one PNG with several pictures of a model and a caption under each. To draw one of "
     "them alone, use `lambent MODEL` with the options printed in grey under the title and under the caption. "
     "`--sheet` selects the pictures; `--across OPTION=VALUES` makes a row with one picture for each value. Every "
     "other option applies to all pictures, `--size` (480x400) to each. The options under a caption follow the command "
     "line's and override them. The background is white by default. The sheet is `MODEL-NAME.png` in the current "
     "folder or in the folder of `-o`, or the file of `-o`. The pictures are identical on every machine; only "
     "FreeType's letters may differ.\nThe options under the title are the sheet's defaults, which make the differences "
     "visible. Sheets about shading draw a built-in shape with few segments (unless `--segments` is given) under one "
     "light (unless `--light`, `--rig` or the model brings lights). Sheets with highlights use a material with a "
     "highlight (unless `--material` or the model brings materials).\n`--sheet stages` frames the brightest highlight "
     "(the largest difference to the picture without highlights) and shows it below, three times as large. `terms` "
     "removes the other terms with black coefficients; `ambient` sets the ambient coefficient of the default "
     "material."},
    {"explain", "Explaining a pixel", 0, TOPIC_NO_TABLE,
     "`lambent explain MODEL X,Y` accepts the options of a picture and prints the calculation of the pixel in column X "
     "and row Y (from 0, from the top left corner). For each visible triangle it prints the samples, the object, the "
     "position in the triangle, n, v and t, and the material. For each light it prints its matrix (rows ambient, "
     "diffuse, specular), l, r and h, the angles between n and l, r and v, n and h, the distance, attenuation and spot "
     "factor, the highlight's base and power, and its diffuse and specular terms. At the end it prints the terms and "
     "their sum, the weighted sum of the triangles over the background, the encoding and the bytes. Vectors are in eye "
     "space. The numbers equal the picture's to the last bit; `docs/lighting.md` has the formulas. `--json` prints the "
     "same numbers as one line. Lambent writes no picture; `--output` has no effect."},
    {"info", "The contents of a model", 0, TOPIC_NO_TABLE,
     "`lambent info MODEL...` prints the contents of each model and writes no picture. It lists the format, the "
     "program that wrote the file, size with the up axis, triangles, meshes, parts and objects, materials with their "
     "numbers and maps, textures with their sizes, lights, cameras, scenes, animations with their lengths, variants, "
     "extensions of glTF with their support (supported, ignored or unknown), memory, the loading time, and warnings. "
     "Lists end after 8 rows; `--json` prints everything, one line for each model (`docs/info.schema.json`). glTF "
     "measures in metres and 3MF names its unit, so size, area and volume are printed in millimetres. Other formats "
     "have no unit. The volume is printed for closed surfaces: each edge belongs to as many triangles in one direction "
     "as in the other. A file that requires an unknown extension is read as with `--lenient`, and the output says so. "
     "The memory is the model's, plus the memory for drawing 1024x1024 pixels, the picture included; Lambent draws the "
     "depths once to measure it. A model that cannot be read is reported, and the exit code is the highest one."},
    {"check", "Checking shaders", BIT(CHECK) | BIT(DIFF), TOPIC_NO_TABLE,
     "`lambent check SHADER.frag --vertex SHADER.vert` draws small reference scenes with the shaders and compares the "
     "pictures with the CPU device's. Without `--vertex` Lambent generates a correct vertex shader. It recognises the "
     "contract by the names of uniforms and attributes; if no contract fits, it infers the inputs from their use. "
     "`--list` prints the contracts, the scenes and the known mistakes. If pictures differ, it draws the same scenes "
     "with known mistakes. It reports the smallest set that reproduces the shader's pictures, with a corrected line "
     "for each. `-o` writes a sheet with the shader's picture, the reference and the difference (times `--gain`) of "
     "each scene. `--tolerance` (default 2) applies to each channel of a pixel: one pixel in 200 may exceed it, and "
     "the mean difference may be a quarter of it. The shaders run in a separate process, which `--stop-after` and "
     "`--memory-limit` limit. `lambent check --class FOLDER --csv grades.csv -o sheets/` checks a class. A submission "
     "is a folder with one fragment shader and at most one vertex shader; outside such folders it is a fragment shader "
     "and the vertex shader of the same name. `sheets/index.html` is a page with all results. You can also name "
     "several shaders: `lambent check */phong.frag */phong.vert` pairs the fragment and vertex shaders of the same "
     "folder and name, and `-o sheets/` writes a sheet for each. If a shader cannot be checked, Lambent reports it and "
     "checks the others. The exit code is 0 if every scene of every shader matches the reference, otherwise the "
     "highest of all. It is 6 also for shaders that do not compile, do not end, or write NaN. With `--json` the report "
     "is one line (`docs/check.schema.json`). More: `docs/check.md`."},
    {"shaders", "Shaders for other programs", BIT(SHADER), TOPIC_NO_TABLE, NULL},
    {"diff", "Comparing pictures", BIT(DIFF), TOPIC_NO_TABLE,
     "`lambent diff A B` reads two pictures of the same size and the same kind (PNG or PPM with 8 bits, or PFM with "
     "floats). It prints the largest difference of a channel, and the mean and root mean square over all channels "
     "(red, green, blue and alpha as stored in the files, 1 = full range). It also prints the PSNR in decibels "
     "(`infinite` for equal pictures, null in JSON), and the share of pixels in which a channel differs by more than "
     "1/255 and 2/255. `-o` draws the difference (with `-o out/` as `A-difference.png` in that folder). Each channel "
     "is its difference times `--gain`, clamped at white; black means equal. A pixel that differs only in alpha is "
     "grey. A `.pfm` stores the differences as floats without clamping. With `--json` the figures are one line: `a`, "
     "`b`, `width`, `height`, `maximum`, `mean`, `rmse`, `psnr_db`, `share_over_1`, `share_over_2`, `tolerance`, "
     "`differ` (0 or 1: beyond the tolerance) and `picture`. The exit code is 6 if the largest difference exceeds the "
     "tolerance, and 1 if the sizes or kinds differ. `lambent diff OLD NEW` of two models or two folders draws the "
     "models "
     "of both sides with one camera. `-o report.html` writes a page of added, removed and changed models, with "
     "pictures "
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
     "3MF: geometry, materials with their pictures, lights and cameras as far as the format stores them. The program "
     "reports data that the "
     "format cannot store. More: `docs/convert.md`."},
    {"formulas", "Surfaces given by formulas", BIT(SHAPE), TOPIC_NO_TABLE,
     "`lambent shape --parametric 'x=...; y=...; z=...'` draws a surface over u and v. `--implicit 'x^2+y^2+z^2-1'` "
     "draws the surface on which an expression of x, y and z is zero. `-o torus.obj`, `.stl` or `.ply` saves it as a "
     "model file. Built-in shapes can be saved too: `lambent shape teapot -o teapot.stl`. Normals come from symbolic "
     "derivatives. On a surface over u and v, ends that meet are joined, and creases along a line of the grid stay "
     "sharp (`--segments 64x32`). `docs/shapes.md` describes the language."},
    {"plots", "Plots", BIT(PLOT) | BIT(CAPTIONS), TOPIC_NO_TABLE,
     "`lambent plot attenuation a/b/c...` draws 1/(a + b d + c d^2) over the distance d. A curve is given by three "
     "such numbers, by a light as in `--light` (`spot:attenuation=0/0/1,range=9`), or by a model or scene file, which "
     "draws all its lights. A dot marks the distance at which each curve falls below 1/255, the last step of a picture "
     "with 8 bits. A fourth number (`a/b/c/range`) is a range as in glTF. `lambent plot spot cutoff=30,exponent=8 "
     "inner=20,outer=35` draws the cone of spot lights over the angle from the axis, by the formula of OpenGL or glTF. "
     "`lambent plot highlight 10 50 1000` draws the highlight over the angle between the mirrored light and the eye. "
     "For each shininess it draws Phong's, Blinn-Phong's, and Blinn-Phong's at four times the shininess, which looks "
     "like Phong's. Without curves each plot draws a default set. The values come from the functions that light "
     "pixels.\nBy default the picture is `attenuation.png`, `spot.png` or `highlight.png` (in the folder of `-o "
     "plots/`), with 1600x1000 pixels. A name that ends in `.svg` makes an SVG. The table on standard output lists the "
     "distance or angle at which each curve falls below 1/255. With `--json` it is one line: `plot`, `x`, `y`, "
     "`curves` (each with `label`, `below_1_255_from`, null for never, and `points`, 101 pairs) and `picture`."},
    {"work", "Threads and devices", BIT(WORK), TOPIC_NO_TABLE, NULL},
    {"limits", "Limits", BIT(LIMITS), TOPIC_NO_TABLE,
     "A hostile file could crash a program, hang it or exhaust the machine. Limits prevent this; options change them. "
     "If a file exceeds a limit, Lambent reports the number it found, the number allowed and the option that raises "
     "it. The exit code is 4. The same limits apply to decoders of pictures and of compressed meshes. `SECURITY.md` "
     "describes the promises and their tests."},
    {"reports", "Reports", BIT(REPORT), TOPIC_NO_TABLE, NULL},
    {"bytes", "Same picture everywhere", 0, TOPIC_NO_TABLE,
     "The same model and options give identical bytes on every instruction set, number of threads, compiler and "
     "machine."},
    {"variables", "Environment", 0, TOPIC_NO_TABLE,
     "`NO_COLOR`: if set and not empty, messages have no colours. `TERM=dumb` also disables the progress bar. The "
     "locale has no effect: numbers always use a decimal point."},
    {"exit-codes", "Exit codes", 0, TOPIC_EXIT_CODES, NULL},
    {.word = NULL},
};
