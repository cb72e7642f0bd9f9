// topics.c: the subjects of `lambent help TOPIC`. The man page and the docs use the same texts.
#include "topics.h"

#include "options.h"

#define BIT(group) (1ull << GROUP_##group)

const struct topic topics[] = {
    {"models", "Models", BIT(MODEL), TOPIC_NO_TABLE,
     "MODEL is a file, the name of a built-in shape, or `-` for standard input. Lambent detects the format from the "
     "content; the extension is only a hint. The name of a built-in shape always means the shape. Write `./teapot` for "
     "a file of that name, and `./shapes` for a file named like a command. After `--` every argument is a model, even "
     "if it begins with a dash.\nIf you name several models, Lambent writes one picture for each, to the current "
     "folder or to the folder in `-o pictures/`. If a model fails, Lambent reports it and draws the others; the exit "
     "code is then the highest of all. `-o FILE` and `-` allow only one model."},
    {"batch", "Many models", BIT(BATCH), TOPIC_NO_TABLE,
     "`lambent batch` draws all models in folders and their sub-folders, in lists (`@FILE`) or named on standard input "
     "(`-`). It draws one model per processor at a time, and writes a journal: `lambent batch models/ -o "
     "'thumbs/{dir}/{stem}.png'`. `--dry-run` prints the picture's name for each model. If the run is interrupted, "
     "repeat the command with `--resume`. To draw only changed models, use `--skip-same`. The exit code is 7 if some "
     "pictures failed, and 0 with `--failures-ok`. `docs/batch.md` has the details. With `--jobs -` it works as a "
     "server: it reads one JSON job per line and answers each (`docs/worker.md`)."},
    {"viewer", "The viewer", BIT(VIEWER), TOPIC_NO_TABLE,
     "`lambent view bunny.obj` shows a model in the browser, and updates the picture when the file changes. `lambent "
     "view models/` shows a gallery of a folder. The viewer needs a page that `make web` builds once, in Lambent's "
     "source folder. Lambent serves that page only on 127.0.0.1, at an address with a secret token. Ctrl-C stops it. "
     "`docs/view.md` has the details."},
    {"formats", "Model formats", 0, TOPIC_NO_TABLE,
     "`lambent formats` lists the formats that Lambent reads and writes; `docs/formats.md` describes how it draws each "
     "element of each format.\n3MF (`.3mf`): a ZIP archive for 3D printing, with units, components, colours, textures, "
     "layered textures and metals. Lambent loads libzip and expat only for these files (Debian's `libzip4` or "
     "`libzip5`, and `libexpat1`). It ignores beams, slices and displacements, with a warning. `--lenient` reads files "
     "that require unknown extensions or use an undeclared XML prefix.\nSTL (`.stl`): triangles, text or binary. Z is "
     "up. The format has no unit; binary files may contain colours.\nOBJ (`.obj`): polygons, with `.mtl` materials and "
     "textures. Y is up.\nPLY (`.ply`): triangles, points and lines, with colours, text or binary.\nglTF (`.gltf`, "
     "`.glb`): scenes with physical materials, lights, cameras, skins and animations, in metres. Y is up. `--scene`, "
     "`--variant`, `--animation` and `--time` select parts of a file. Lambent decodes Draco and meshoptimizer data if "
     "their libraries are installed."},
    {"picture", "The picture", BIT(PICTURE), TOPIC_NO_TABLE, NULL},
    {"output", "Output", 0, TOPIC_NO_TABLE,
     "Without `-o` the picture of `models/koala.obj` is `koala.png` in the current folder. Lambent replaces an older "
     "picture that it wrote (recognised by the `Software` text in the PNG). If any other file of that name exists, "
     "Lambent keeps it and exits with 5. With `-o`, Lambent replaces the named file. Lambent writes a picture "
     "completely or not at all. Even if it is killed, it leaves no temporary file in the folder.\nStandard output "
     "carries only the picture (`-o -`) or the report (`--json`). All other output goes to standard error: warnings, "
     "errors, the line that names the written file, and a progress bar (only on a terminal, for work of over half a "
     "second)."},
    {"view", "The view", BIT(VIEW), TOPIC_NO_TABLE, NULL},
    {"lights", "Lights", BIT(LIGHTS), TOPIC_LIGHT_FIELDS, NULL},
    {"materials", "Materials", BIT(MATERIALS), TOPIC_MATERIAL_FIELDS, NULL},
    {"shading", "Shading", BIT(SHADING), TOPIC_NO_TABLE, NULL},
    {"animations", "Animations", BIT(ANIMATION), TOPIC_NO_TABLE,
     "`lambent MODEL --turntable 36` and `lambent MODEL --sweep light.azimuth=0..360` draw several pictures of one "
     "model, and read the model only once. Lambent writes the frames to one animated PNG or WebP (by the extension in "
     "`-o`), which loops forever. With `{frame}` in the name, each frame gets its own file. A frame is identical to a "
     "picture drawn alone with the same options. All frames use the camera and the automatic exposure of the first "
     "frame."},
    {"sheets", "Sheets", BIT(SHEET) | BIT(CAPTIONS), TOPIC_NO_TABLE,
     "`lambent compare MODEL` writes one PNG with several pictures of a model and a caption under each. To draw one of "
     "them alone, use `lambent MODEL` with the options printed in grey under the title and under the caption. "
     "`--sheet` selects the pictures; `--across OPTION=VALUES` draws a row with one picture for each value. Every "
     "other option applies to all pictures. `--size` (480x400) is the size of each picture. The options under a "
     "caption override the options of the command line. The background is white by default. Lambent writes the sheet "
     "to `MODEL-NAME.png` in the current folder, to the folder in `-o`, or to the file in `-o`. The pictures are "
     "identical on every machine; only the letters, drawn by FreeType, may differ.\nThe options under the title are "
     "the sheet's defaults, which make the differences visible. Sheets about shading draw a built-in shape with few "
     "segments (unless `--segments` is given) under one light (unless `--light`, `--rig` or the model brings lights). "
     "Sheets with highlights use a material with a highlight (unless `--material` or the model brings "
     "materials).\n`--sheet stages` frames the brightest highlight (the largest difference to the picture without "
     "highlights) and shows it below, three times as large. `terms` removes the other terms with black coefficients; "
     "`ambient` sets the ambient coefficient of the default material."},
    {"explain", "Explaining a pixel", 0, TOPIC_NO_TABLE,
     "`lambent explain MODEL X,Y` accepts the options of a picture and prints the calculation of the pixel in column X "
     "and row Y (from 0, from the top left corner). For each visible triangle it prints the samples, the object, the "
     "position in the triangle, n, v and t, and the material. For each light it prints its matrix (rows ambient, "
     "diffuse, specular), l, r and h, the angles between n and l, r and v, n and h, the distance, attenuation and spot "
     "factor, the highlight's base and power, and its diffuse and specular terms. At the end it prints the terms and "
     "their sum, the weighted sum of the triangles over the background, the encoding and the bytes. Vectors are in eye "
     "space. The numbers are bit-identical to the numbers that produce the picture; `docs/lighting.md` has the "
     "formulas. `--json` prints the same numbers as one line. `-o figure.svg` draws them as a figure."},
    {"info", "The contents of a model", 0, TOPIC_NO_TABLE,
     "`lambent info MODEL...` prints the contents of each model and writes no picture. It lists the format, the "
     "program that wrote the file, size with the up axis, triangles, meshes, parts and objects, materials with their "
     "numbers and maps, textures with their sizes, lights, cameras, scenes, animations with their lengths, variants, "
     "extensions of glTF with their support (supported, ignored or unknown), memory, the loading time, and warnings. "
     "Each list is limited to 8 rows; `--json` prints all rows, one line for each model (`docs/info.schema.json`). For "
     "glTF (in metres) and 3MF (which states its unit), it prints size, area and volume in millimetres. Other formats "
     "define no unit. It prints the volume only for closed surfaces: each edge belongs to as many triangles in one "
     "direction as in the other. It reads a file that requires an unknown extension as with `--lenient`, and reports "
     "the extension. The memory is the size of the model plus the memory for drawing a picture of 1024x1024 pixels; "
     "Lambent draws the depths once to measure it. If a model cannot be read, Lambent reports it and exits with the "
     "highest exit code."},
    {"check", "Checking shaders", BIT(CHECK) | BIT(DIFF), TOPIC_NO_TABLE,
     "`lambent check SHADER.frag --vertex SHADER.vert` draws small reference scenes with the shaders and compares the "
     "pictures with pictures of the CPU device. Without `--vertex` Lambent generates a correct vertex shader. It "
     "recognises the contract by the names of uniforms and attributes; if no contract fits, it infers the role of each "
     "input from its use. `--list` prints the contracts, the scenes and the known mistakes. If pictures differ, it "
     "draws the same scenes with known mistakes. It reports the smallest set of mistakes that reproduces the shader's "
     "pictures, with a corrected line for each mistake. `-o` writes a sheet with the shader's picture, the reference "
     "and the difference (times `--gain`) of each scene. `--tolerance` (default 2) applies to each channel of a pixel: "
     "one pixel in 200 may exceed it, and the mean difference may be at most a quarter of it. The shaders run in a "
     "separate process, which `--stop-after` and `--memory-limit` limit. `lambent check --class FOLDER --csv "
     "grades.csv -o sheets/` checks a class. A submission is a folder with one fragment shader and at most one vertex "
     "shader; outside such folders it is a fragment shader and the vertex shader of the same name. `sheets/index.html` "
     "is a page with all results. You can also name several shaders: `lambent check */phong.frag */phong.vert` pairs "
     "the fragment and vertex shaders of the same folder and name, and `-o sheets/` writes a sheet for each. If a "
     "shader cannot be checked, Lambent reports it and checks the others. The exit code is 0 if every scene of every "
     "shader matches the reference, otherwise the highest of all. It is 6 also for shaders that do not compile, do not "
     "end, or write NaN. With `--json` the report is one line (`docs/check.schema.json`). More: `docs/check.md`."},
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
     "models of both sides with one camera. `-o report.html` writes a page of added, removed and changed models, with "
     "pictures before and after. `docs/pull-requests.md` has the details."},
    {"hash", "Hashes of pictures", BIT(HASH), TOPIC_NO_TABLE,
     "`lambent hash models/ -o pictures.hash` writes a line for each model: the XXH64 of its picture's pixels (rows "
     "from the top, red, green, blue, alpha) and its name, relative to the file. The first lines of the file record "
     "the version and the options. Pictures are identical on every machine, so a repository can store this file "
     "instead of the pictures. `lambent hash models/ --check pictures.hash` lists the models whose pictures changed. "
     "`docs/pull-requests.md` has the details."},
    {"glass", "Glass", 0, TOPIC_NO_TABLE,
     "`--material glass` is clear, smooth glass: `white,roughness=0,transmission=1`. Keys change it: `--material "
     "glass,roughness=0.3` blurs what is behind, `glass,diffuse=0.2/0.8/0.5` colours it, and `thickness` bends the "
     "light. Only Phong shading with a physical reflection model on the CPU device shows glass. "
     "`docs/lighting/layers.md` has the formulas. For opaque surfaces that let some light through, use `--opacity`."},
    {"settings", "The user's own defaults", BIT(SETTINGS), TOPIC_NO_TABLE,
     "The file `lambent.json` in the folder `~/.config/lambent` replaces defaults of the picture. Its keys are keys of "
     "scene files: `{\"image\": {\"background\": \"white\"}, \"shadows\": true}`. Options of the command line and "
     "looks "
     "override it; scene files, `batch`, `hash`, `diff`, `check` and pages ignore it, and so does every command if the "
     "environment variable `CI` is set. `lambent config` prints the settings in force. `docs/settings.md` has the "
     "details."},
    {"convert", "Models in another format", BIT(CONVERT), TOPIC_NO_TABLE,
     "`lambent convert MODEL OUT.glb` writes any model or scene file as GLB, OBJ (with MTL and PNG beside it), STL, "
     "PLY or 3MF: geometry, materials with their textures, lights and cameras, as far as the format supports them. For "
     "everything that it does not support, Lambent prints a sentence. `docs/convert.md` has the details."},
    {"formulas", "Surfaces given by formulas", BIT(SHAPE), TOPIC_NO_TABLE,
     "`lambent shape --parametric 'x=...; y=...; z=...'` draws a surface over u and v. `--implicit 'x^2+y^2+z^2-1'` "
     "draws the surface on which an expression of x, y and z is zero. `-o torus.obj`, `.stl` or `.ply` saves it as a "
     "model file. Built-in shapes can be saved too: `lambent shape teapot -o teapot.stl`. Normals come from symbolic "
     "derivatives. On a surface over u and v, Lambent joins ends that meet. Creases along a grid line stay sharp "
     "(`--segments 64x32`). `docs/shapes.md` describes the language."},
    {"plots", "Plots", BIT(PLOT) | BIT(CAPTIONS), TOPIC_NO_TABLE,
     "`lambent plot attenuation a/b/c...` draws 1/(a + b d + c d^2) over the distance d. Each argument is a curve: "
     "three such numbers, a light as in `--light` (`spot:attenuation=0/0/1,range=9`), or a model or scene file, for a "
     "curve of each of its lights. A dot marks the distance at which each curve falls below 1/255, the last step of a "
     "picture with 8 bits. A fourth number (`a/b/c/range`) is a range as in glTF. `lambent plot spot "
     "cutoff=30,exponent=8 inner=20,outer=35` draws the cone of spot lights over the angle from the axis, by the "
     "formula of OpenGL or glTF. `lambent plot highlight 10 50 1000` draws the highlight over the angle between the "
     "mirrored light and the eye. For each shininess it draws three curves: Phong, Blinn-Phong, and Blinn-Phong at "
     "four times the shininess, which looks like Phong. Without arguments each plot draws a default set of curves. The "
     "values come from the functions that light pixels.\nBy default Lambent writes `attenuation.png`, `spot.png` or "
     "`highlight.png` (with `-o plots/`, in that folder), with 1600x1000 pixels. If the name ends in `.svg`, it writes "
     "an SVG. The table on standard output lists the distance or angle at which each curve falls below 1/255. With "
     "`--json` the table is one line: `plot`, `x`, `y`, `curves` (each with `label`, `below_1_255_from`, null for "
     "never, and `points`, 101 pairs) and `picture`."},
    {"work", "Threads and devices", BIT(WORK), TOPIC_NO_TABLE, NULL},
    {"limits", "Limits", BIT(LIMITS), TOPIC_NO_TABLE,
     "A hostile file could crash a program, hang it or exhaust the machine. Limits prevent this; options change them. "
     "If a file exceeds a limit, Lambent reports the number it found, the number allowed and the option that raises "
     "it. The exit code is 4. The same limits apply to the decoders for pictures and compressed meshes. `SECURITY.md` "
     "describes the promises and their tests."},
    {"reports", "Reports", BIT(REPORT), TOPIC_NO_TABLE, NULL},
    {"bytes", "Same picture everywhere", 0, TOPIC_NO_TABLE,
     "The same model and options give identical bytes on every instruction set, number of threads, compiler and "
     "machine."},
    {"variables", "Environment", 0, TOPIC_NO_TABLE,
     "If `NO_COLOR` is set and not empty, Lambent prints messages without colours. `TERM=dumb` also disables the "
     "progress bar. The locale has no effect: numbers always use a decimal point."},
    {"exit-codes", "Exit codes", 0, TOPIC_EXIT_CODES, NULL},
    {.word = NULL},
};
