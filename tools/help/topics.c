// topics.c: defines the subjects of `lambent help TOPIC`. The man page and docs/command-line.md also contain these
// texts.
#include "help_texts.h"

#include "options.h"

#define BIT(group) (1ull << GROUP_##group)

const struct topic topics[] = {
    {"models", "Models", BIT(MODEL), TOPIC_NO_TABLE,
     "MODEL is a file, the name of a built-in shape, or `-` for standard input. Lambent detects the format from the "
     "content; the extension is only a hint. The name of a built-in shape always selects the shape. For a file with "
     "the same name as a shape or a command, write `./teapot` or `./shapes`. After `--`, every argument is a model, "
     "even if it begins with a dash.\nIf you give several models, Lambent writes one picture for each model. The "
     "pictures are in the current folder, or in the folder given with `-o pictures/`. If a model fails, Lambent "
     "reports the error and draws the other models. The exit code is then the highest exit code of all models. With "
     "`-o FILE` or `-`, you can give only one model."},
    {"batch", "Many models", BIT(BATCH), TOPIC_NO_TABLE,
     "`lambent batch` draws all models in folders and their sub-folders: `lambent batch models/ -o "
     "'thumbs/{dir}/{stem}.png'`. The command also accepts lists of models, from files (`@FILE`) or from standard "
     "input (`-`). The command draws one model per processor at a time, and writes a journal. `--dry-run` prints the "
     "picture's name for each model. If the run is interrupted, repeat the command with `--resume`. To draw only "
     "changed models, use `--skip-same`. If some pictures fail, the exit code is 7, or 0 with `--failures-ok`. For "
     "details, see `docs/batch.md`. `lambent batch --jobs -` works as a server: the command reads one JSON job per "
     "line and answers each job (`docs/worker.md`)."},
    {"contact-sheets", "Contact sheets", BIT(CONTACT), TOPIC_NO_TABLE,
     "`lambent sheet models/ -o sheet.png` draws small pictures of all models in a folder, with names and sizes in "
     "model "
     "units. `lambent models/` does the same. The picture's options apply to each model; `-s` sets the size of each "
     "picture. `--to-scale` draws all models to one scale. More than 60 models (`--per-page`) fill several pages. A "
     "model "
     "that cannot be drawn keeps its place on the sheet, and the exit code is then 7."},
    {"viewer", "The viewer", BIT(VIEWER), TOPIC_NO_TABLE,
     "`lambent view bunny.obj` shows a model in the browser, and updates the picture when the model file changes. "
     "`lambent view models/` shows a gallery of a folder. The viewer requires a web page: the package lambent-page, or "
     "`make web`, run once in Lambent's source folder. Lambent serves the page only on 127.0.0.1, at an address with a "
     "secret token. Press Ctrl-C to stop the viewer. For details, see `docs/view.md`."},
    {"formats", "Model formats", 0, TOPIC_NO_TABLE,
     "`lambent formats` lists the formats that Lambent reads and writes. `docs/formats.md` describes how Lambent draws "
     "each element of each format.\n3MF (`.3mf`): a ZIP archive for 3D printing, with units, components, colours, "
     "textures, layered textures and metals. Lambent loads expat (Debian's `libexpat1`) "
     "only for these files. Lambent ignores beams, slices and displacements, with a warning. With "
     "`--lenient`, Lambent also reads files that require unknown extensions or use an undeclared XML prefix.\nSTL "
     "(`.stl`): triangles, as text or binary data. Z is up. The format defines no unit. Binary files may contain "
     "colours.\nOBJ (`.obj`): polygons, with `.mtl` materials and textures. Y is up.\nPLY (`.ply`): triangles, points "
     "and lines with colours, as text or binary data.\nglTF (`.gltf`, `.glb`): scenes with physical materials, lights, "
     "cameras, skins and animations, in metres. Y is up. `--scene`, `--variant`, `--animation` and `--time` select the "
     "scene, the materials and the pose. Lambent decodes Draco and meshoptimizer data if their libraries are "
     "installed."},
    {"picture", "The picture", BIT(PICTURE), TOPIC_NO_TABLE, NULL},
    {"output", "Output", 0, TOPIC_NO_TABLE,
     "Without `-o`, Lambent writes the picture of `models/koala.obj` to `koala.png` in the current folder. Lambent "
     "overwrites an older picture that it wrote itself (recognised by the `Software` text in the PNG). If any other "
     "file of that name exists, Lambent keeps that file and exits with code 5. With `-o`, Lambent overwrites the given "
     "file. Lambent writes a picture completely or not at all. Even if Lambent is killed, it leaves no temporary file "
     "in the folder.\nStandard output contains only the picture (`-o -`) or the report (`--json`). Lambent writes "
     "warnings, errors, the line that names the written file, and a progress bar to standard error. The progress bar "
     "appears only on a terminal, if the work takes more than half a second."},
    {"view", "The view", BIT(VIEW), TOPIC_NO_TABLE, NULL},
    {"lights", "Lights", BIT(LIGHTS), TOPIC_LIGHT_FIELDS, NULL},
    {"materials", "Materials", BIT(MATERIALS), TOPIC_MATERIAL_FIELDS, NULL},
    {"shading", "Shading", BIT(SHADING), TOPIC_NO_TABLE, NULL},
    {"animations", "Animations", BIT(ANIMATION), TOPIC_NO_TABLE,
     "`lambent MODEL --turntable 36` and `lambent MODEL --sweep light.azimuth=0..360` draw several pictures of one "
     "model, and read the model only once. Lambent writes the frames to one animated PNG or WebP file, which loops "
     "forever. The extension in `-o` selects the format. With `{frame}` in the name, Lambent writes each frame to a "
     "separate file. A frame is identical to a single picture drawn with the same options. All frames use the camera "
     "and the automatic exposure of the first frame."},
    {"sheets", "Sheets", BIT(SHEET) | BIT(CAPTIONS), TOPIC_NO_TABLE,
     "`lambent compare MODEL` writes one PNG file with several pictures of a model, and a caption under each picture. "
     "To draw one of these pictures alone, use `lambent MODEL` with the options that the sheet shows in grey under the "
     "title and under the caption. `--sheet` selects the pictures; `--across OPTION=VALUES` draws a row with one "
     "picture for each value. Every other option applies to all pictures. `--size` sets the size of each picture "
     "(default: 480x400). The options under a caption override the options on the command line. The background is "
     "white by default. Lambent writes the sheet to `MODEL-NAME.png` in the current folder, or to the folder or file "
     "given with `-o`. The pictures are identical on every machine. FreeType draws the letters, which may differ "
     "between machines.\nThe options under the title are the sheet's defaults, which make the differences visible. "
     "Sheets about shading draw built-in shapes with few segments, unless you give `--segments`. They use one light, "
     "unless you give `--light` or `--rig`, or the model contains lights. Sheets with highlights use a material with a "
     "highlight (unless you give `--material`, or the model contains materials).\n`--sheet stages` marks the highlight "
     "that changes the picture most, and shows this highlight below, three times as large. For a picture of one term, "
     "`--sheet terms` sets the coefficients of the other terms to 0. `--sheet ambient` sets the ambient coefficient of "
     "the default material."},
    {"explain", "Explaining a pixel", BIT(FIGURE), TOPIC_NO_TABLE,
     "`lambent explain MODEL X,Y` accepts the same options as `lambent render` and prints the calculation of one "
     "pixel. X is the pixel's column and Y is its row, counted from 0 at the top left corner. For each visible "
     "triangle, Lambent prints the samples, the object, the position in the triangle, the vectors n, v and t, and the "
     "material. For each light, Lambent prints the colours (rows ambient, diffuse, specular), the vectors l, r and h, "
     "and the distance. Lambent also prints three angles: between n and l, between r and v, and between n and h. Then "
     "Lambent prints the light's attenuation and spot factors, the base and exponent of the highlight, and the diffuse "
     "and specular terms. Lambent then prints the terms and their sum. At the end, it blends the weighted sum of the "
     "triangles over the background, and prints the tone curve, the encoding and the bytes. Vectors are in eye space. "
     "The numbers are "
     "bit-identical to the numbers from which Lambent computes the picture. For the formulas, see `docs/lighting.md`. "
     "`--json` prints the same numbers on one line. `-o figure.svg` draws the numbers as a figure."},
    {"teaching", "Lectures and exercises", BIT(EXERCISES), TOPIC_NO_TABLE,
     "`docs/lectures.md` lists the contents of three lectures on lighting, each with a command. `lambent explain MODEL "
     "X,Y` prints the calculation of a pixel, with the halfway vector h, the winding of the triangle's corners, the "
     "normals and the plane. `lambent compare` draws sheets for slides (`--captions plain`), and `lambent plot` draws "
     "curves. `lambent shader --style lecture` prints short shaders, and `--mistake NAME` introduces a mistake.\n"
     "`lambent exercises --count 20 --seed 7 -o class/` writes exercises: for each exercise, a vertex shader and a "
     "fragment shader with one mistake, and the program's picture beside the right one. Each mistake is visible in at "
     "least 2 % of the pixels. `students.html` lists the exercises, and `key.html` names the mistakes. `lambent check "
     "--class class/` names them too. The pictures need OpenGL."},
    {"info", "The contents of a model", BIT(PRINT), TOPIC_NO_TABLE,
     "`lambent info MODEL...` prints the contents of each model and writes no picture. The command lists the format, "
     "the program that wrote the file, the size, the up axis, the numbers of triangles, meshes, parts and objects, and "
     "the names that `--hide` accepts. The command also lists materials (numbers and maps), textures and their sizes, "
     "lights, cameras, scenes, animations and their lengths, variants, and glTF extensions (supported, ignored or "
     "unknown). At the end, the command prints the memory, the loading time and the warnings. Each list is limited to "
     "8 rows; `--json` prints all rows, one line for each model (`docs/info.schema.json`). If the file states a unit "
     "(glTF, 3MF, FBX, STEP and others), the command prints the size, area and volume in millimetres too. For "
     "STEP, IGES and BREP files, `info` measures the exact shape. It prints the volume only for closed "
     "surfaces. A surface is closed if, at each edge, "
     "as many triangles traverse the edge in one direction as in the other. `info` also reads files that require an "
     "unknown extension, as with `--lenient`, and reports the extension. The memory is the sum of the model's size and "
     "the memory needed to draw a picture of 1024x1024 pixels. To measure this memory, Lambent draws a picture of the "
     "depths. If Lambent cannot read a model, Lambent reports the error and continues. The exit code is then the "
     "highest exit code of all models."},
    {"check", "Checking shaders", BIT(CHECK) | BIT(DIFF), TOPIC_NO_TABLE,
     "`lambent check SHADER.frag --vertex SHADER.vert` draws small reference scenes with the shaders and compares "
     "these pictures with the pictures of the CPU device. Without `--vertex`, Lambent generates a correct vertex "
     "shader. Lambent recognises the contract by the names of uniforms and attributes. If no contract fits, Lambent "
     "infers the role of each input from its use in the shader. `--list` prints the contracts, the scenes and the "
     "known mistakes. If pictures differ, Lambent draws the same scenes with known mistakes. Lambent reports the "
     "smallest set of mistakes that reproduces the shader's pictures, and a corrected line for each mistake. `-o` "
     "writes a sheet that shows, for each scene, the shader's picture, the reference and the difference between them, "
     "amplified by `--gain`. `--tolerance` (default 2) applies to each channel of a pixel. At most one pixel in 200 "
     "may exceed the tolerance. The mean difference may be at most a quarter of the tolerance. The shaders run in a "
     "separate process. `--stop-after` limits the processor time of this process, and `--memory-limit` limits its "
     "memory. `lambent check --class FOLDER --csv grades.csv -o sheets/` checks the submissions of all students in a "
     "class. A submission is a folder with one fragment shader and at most one vertex shader. In a folder with more "
     "shaders, each fragment shader forms one submission with the vertex shader of the same name. `sheets/index.html` "
     "is a page with all results. You can also give several shaders: `lambent check */phong.frag */phong.vert` pairs "
     "the fragment and vertex shaders of the same folder and name. `-o sheets/` then writes a sheet for each shader. "
     "If Lambent cannot check a shader, it reports the error and checks the other shaders. The exit code is 0 if every "
     "scene of every shader matches the reference. Otherwise, the exit code is the highest exit code of all shaders. "
     "The exit code for a shader is 6 if the shader's pictures differ, or if the shader does not compile, does not end "
     "or writes NaN. With `--json`, Lambent prints the report on one line (`docs/check.schema.json`). For details, see "
     "`docs/check.md`."},
    {"shaders", "Shaders for other programs", BIT(SHADER), TOPIC_NO_TABLE, NULL},
    {"diff", "Comparing pictures", BIT(DIFF), TOPIC_NO_TABLE,
     "`lambent diff A B` reads two pictures of the same size and the same kind (PNG or PPM with 8 bits, or PFM with "
     "floats). The command prints the largest difference of a channel, and the mean and root mean square over all "
     "channels. The channels are red, green, blue and alpha as stored in the files; 1 is the full range. The command "
     "also prints the PSNR in decibels (`infinite` for equal pictures, null in JSON), and the fractions of pixels in "
     "which a channel differs by more than 1/255 and by more than 2/255. `-o` draws the difference. With `-o out/`, "
     "the file is `A-difference.png` in that folder. Each channel of this picture is the channel's difference times "
     "`--gain`, clamped to 1. Equal pixels are black. A pixel that differs only in alpha is grey. A `.pfm` file stores "
     "the differences as floats without clamping. `--json` prints one line with these keys: `a`, `b`, `width`, "
     "`height`, `maximum`, `mean`, `rmse`, `psnr_db`, `share_over_1`, `share_over_2`, `tolerance`, `differ` (1 if the "
     "difference exceeds the tolerance, otherwise 0) and `picture`. The exit code is 6 if the largest difference "
     "exceeds the tolerance, and 1 if the sizes or kinds differ. If OLD and NEW are two models or two folders, "
     "`lambent diff OLD NEW` draws the old and the new models with the same camera. `-o report.html` writes a page of "
     "added, removed and changed models, with pictures before and after. For details, see `docs/pull-requests.md`."},
    {"hash", "Hashes of pictures", BIT(HASH), TOPIC_NO_TABLE,
     "`lambent hash models/ -o pictures.hash` writes a line for each model. The line contains the XXH64 hash of the "
     "picture's pixels (rows from the top; red, green, blue, alpha) and the model's path relative to the file. The "
     "first lines of the file record the version and the options. Pictures are identical on every machine, so a "
     "repository can store this file instead of the pictures. `lambent hash models/ --check pictures.hash` lists the "
     "models whose pictures changed. For details, see `docs/pull-requests.md`."},
    {"glass", "Glass", 0, TOPIC_NO_TABLE,
     "`--material glass` is clear, smooth glass: `white,roughness=0,transmission=1`. You can change this material with "
     "keys: `--material glass,roughness=0.3` blurs the scene behind the glass, `glass,diffuse=0.2/0.8/0.5` tints the "
     "glass, and `thickness` adds refraction. Glass requires Phong shading and a physical reflection model. Rough or "
     "thick glass also requires the CPU device. For the formulas, see `docs/lighting/layers.md`. For surfaces that are "
     "partly transparent and refract no light, use `--material opacity=0.5`."},
    {"settings", "The user's own defaults", BIT(SETTINGS), TOPIC_NO_TABLE,
     "The file `lambent.json` in the folder `~/.config/lambent` overrides the default picture settings. The file "
     "contains keys of scene files: `{\"image\": {\"background\": \"white\"}, \"shadows\": true}`. Looks and options "
     "on the command line override the settings file. The settings file applies only to pictures of models drawn by "
     "`render`, `explain` and `shape`, not to scene files or pages. If the environment variable `CI` is set, every "
     "command ignores this file. `lambent config` prints the current settings. For details, see `docs/settings.md`."},
    {"convert", "Models in another format", BIT(CONVERT), TOPIC_NO_TABLE,
     "`lambent convert MODEL OUT.glb` writes any model or scene file as GLB, OBJ (with MTL and PNG files next to it), "
     "STL, PLY or 3MF. The command writes all geometry, materials with their textures, lights and cameras that the "
     "format supports. For each kind of data that it omits, Lambent prints a sentence. For details, see "
     "`docs/convert.md`."},
    {"formulas", "Surfaces defined by formulas", BIT(SHAPE), TOPIC_NO_TABLE,
     "`lambent shape --parametric 'x=...; y=...; z=...'` draws a surface over u and v. `--implicit 'x^2+y^2+z^2-1'` "
     "draws the surface on which an expression of x, y and z is zero. `-o torus.obj`, `.stl` or `.ply` saves the "
     "surface as a model file. You can also save built-in shapes: `lambent shape teapot -o teapot.stl`. Normals come "
     "from symbolic derivatives. If two opposite edges of a surface over u and v meet, Lambent joins these edges. "
     "Creases along a grid line stay sharp; `--segments 64x32` sets the grid. `docs/shapes.md` describes the "
     "language."},
    {"plots", "Plots", BIT(PLOT) | BIT(CAPTIONS), TOPIC_NO_TABLE,
     "`lambent plot attenuation a/b/c...` plots 1/(a + b d + c d^2) against the distance d. An argument is either "
     "three such numbers, a light as in `--light` (`spot:attenuation=0/0/1,range=9`), or a model or scene file. For a "
     "file, Lambent draws a curve for each light in the file. A dot marks the distance at which each curve falls below "
     "1/255, the smallest step of an 8-bit picture. A fourth number (`a/b/c/range`) is a range as in glTF. `lambent "
     "plot spot cutoff=30,exponent=8 inner=20,outer=35` plots the cones of spot lights against the angle from the "
     "axis. The first cone uses the formula of OpenGL, and the second uses the formula of glTF. `lambent plot "
     "highlight 10 50 1000` plots the highlight against the angle between the mirrored light and the eye. For each "
     "shininess, Lambent draws three curves: Phong, Blinn-Phong, and Blinn-Phong at four times the shininess, which "
     "looks like Phong. `lambent plot lobe phong:50 ggx:0.3` draws the reflected share over directions. Other kinds "
     "are "
     "`lambert`, `fresnel 0.04 ior=1.5`, `tone reinhard contrast` and `depth NEAR/FAR`. Without arguments, each plot "
     "draws a default set of curves.\nBy default, Lambent writes a picture of 1600x1000 pixels to "
     "`attenuation.png`, or another file named after the kind (with `-o plots/`, in that folder). If the name ends in "
     "`.svg`, "
     "Lambent writes an SVG file. The table on standard output lists the distance or angle at which each curve falls "
     "below 1/255, or five values of a curve that does not fade. With `--json`, Lambent prints the table on one line, "
     "with the keys `plot`, `x`, `y`, `curves` and "
     "`picture`. Each curve contains `label`, `points` (101 pairs) and `below_1_255_from`, which is null if the curve "
     "stays above 1/255."},
    {"work", "Threads and devices", BIT(WORK), TOPIC_NO_TABLE, NULL},
    {"limits", "Limits", BIT(LIMITS), TOPIC_NO_TABLE,
     "A malicious file could crash or block a program, or exhaust the machine's memory. Limits prevent such attacks; "
     "you can change each limit with an option. If a file exceeds a limit, Lambent reports the number found, the "
     "number allowed, and the option that raises the limit. The exit code is 4. The same limits apply to the decoders "
     "for pictures and compressed meshes. `SECURITY.md` describes Lambent's security guarantees and their tests."},
    {"reports", "Reports", BIT(REPORT), TOPIC_NO_TABLE, NULL},
    {"bytes", "Same picture everywhere", 0, TOPIC_NO_TABLE,
     "The same model and options give identical bytes with every instruction set, number of threads and compiler, on "
     "every machine."},
    {"variables", "Environment", 0, TOPIC_NO_TABLE,
     "If `NO_COLOR` is set and not empty, Lambent prints messages without colours. `TERM=dumb` also disables the "
     "progress bar. The locale has no effect: numbers always use a decimal point."},
    {"exit-codes", "Exit codes", 0, TOPIC_EXIT_CODES, NULL},
    {.name = NULL},
};
