// command_table.c: the commands, the examples and the topics of the manual.
#include "command.h"

#include <string.h>

#define ABOUT (1u << GROUP_ABOUT)
// The options of a picture of a model.
#define ALL                                                                                                            \
    (((1u << GROUP_COUNT) - 1) & ~(1u << GROUP_DIFF | 1u << GROUP_PLOT | 1u << GROUP_CAPTIONS | 1u << GROUP_SHEET |    \
                                   1u << GROUP_CHECK | 1u << GROUP_SHADER))

const struct command command_table[] = {
    [COMMAND_render] = {"render", "MODEL...",
                        "Light models and write a picture of each. The word itself may be left out.", ALL, 1, -1},
    [COMMAND_compare] = {"compare", "MODEL",
                         "Draw one labelled sheet of pictures: methods, lights or terms side by side.",
                         (ALL & ~(1u << GROUP_REPORT)) | 1u << GROUP_SHEET | 1u << GROUP_CAPTIONS | TAKES_QUIET, 1, 1},
    [COMMAND_explain] =
        {"explain", "MODEL X,Y",
         "Print the calculation of one pixel: vectors, angles and terms of each light, the sum, the byte. Writes no "
         "picture or scene file; --output and --save-scene have no effect.",
         ALL, 2, 2},
    [COMMAND_check] =
        {"check", "SHADER.frag...",
         "Compare GLSL shaders with reference scenes, and name the known mistakes that explain the differences.",
         ABOUT | 1u << GROUP_CHECK | 1u << GROUP_DIFF | 1u << GROUP_CAPTIONS | TAKES_OUTPUT | TAKES_SIZE | TAKES_JSON |
             TAKES_QUIET,
         0, -1},
    [COMMAND_shader] = {"shader", "[MODEL]",
                        "Print the shaders that light a model, for use in another program, and their inputs.",
                        ALL | 1u << GROUP_SHADER, 0, 1},
    [COMMAND_diff] = {"diff", "A B", "Measure the difference of two pictures, and draw it.",
                      ABOUT | 1u << GROUP_DIFF | TAKES_OUTPUT | TAKES_JSON | TAKES_QUIET, 2, 2},
    [COMMAND_plot] = {"plot", "attenuation|spot|highlight [CURVE...]",
                      "Plot a law of light as curves (PNG or SVG), and print its numbers.",
                      ABOUT | 1u << GROUP_PLOT | 1u << GROUP_CAPTIONS | TAKES_OUTPUT | TAKES_SIZE | TAKES_JSON |
                          TAKES_QUIET,
                      1, -1},
    [COMMAND_lights] = {"lights", "MODEL",
                        "Print the lights of a model, or of the rig if it has none, in scene file form.",
                        ABOUT | 1u << GROUP_VIEW | 1u << GROUP_LIGHTS | 1u << GROUP_SHADING | 1u << GROUP_WORK, 1, 1},
    [COMMAND_shapes] = {"shapes", NULL, "List the built-in shapes.", ABOUT, 0, 0},
    [COMMAND_formats] = {"formats", NULL,
                         "List the model formats that can be read and the picture formats that can be written.", ABOUT,
                         0, 0},
    [COMMAND_materials] = {"materials", NULL,
                           "List the named materials with their numbers; -o FILE also draws a sheet of them.",
                           ABOUT | 1u << GROUP_PICTURE | 1u << GROUP_CAPTIONS | TAKES_JSON, 0, 0},
    [COMMAND_devices] = {"devices", NULL, "List the devices that can draw on this machine, and why others cannot.",
                         ABOUT | TAKES_JSON, 0, 0},
    [COMMAND_help] = {"help", "[COMMAND]", "Print the help of the program, or of a command.", ABOUT, 0, 1},
    [COMMAND_generate] =
        {"generate", "man|markdown|bash|zsh|fish|scene-schema",
         "Print the man page, its Markdown form, a shell's completions, or the JSON Schema of scene files.", ABOUT, 1,
         1},
    [COMMAND_COUNT] = {.name = NULL},
};

const struct command *find_command(const char *name)
{
    for (const struct command *c = command_table; c->name; c++)
        if (strcmp(c->name, name) == 0)
            return c;
    return NULL;
}

unsigned find_groups(const char *name)
{
    const struct command *command = find_command(name);
    return command ? command->groups : 0;
}

const struct example examples[] = {
    {"lambent koala.obj", "writes koala.png, 1024x1024, on a transparent background"},
    {"lambent part.stl -o shot.png -b white", "another name, on white"},
    {"lambent scan.ply -s 640 --view front", "640x640, straight from the front"},
    {"lambent teapot", "a built-in shape (`lambent shapes` lists them)"},
    {"lambent -q *.stl -o pictures/", "a picture of each model, in a folder"},
    {"lambent - -o - < part.stl > part.png", "from standard input to standard output"},
    {"lambent koala.obj --json", "what was read, the camera, and the time of each step"},
    {"lambent compare koala.obj --sheet terms", "the terms of the sum side by side, with captions"},
    {"lambent compare bunny.ply --across 'light=point;directional:direction=-1/-2/-1'",
     "a custom row: one picture for each value of an option"},
    {"lambent plot attenuation 1/0.54/0.2 1/0/1", "how two lights fade with distance"},
    {"lambent plot spot cutoff=30,exponent=8 inner=20,outer=35 -o spot.svg", "the cones of two spot lights"},
    {"lambent plot highlight 10 50 1000", "the width of highlights"},
    {"lambent koala.obj --rig headlight --save-scene koala.json", "also writes a scene file, to edit and draw again"},
    {"lambent koala.json", "a scene file: objects, materials, lights and camera"},
    {"lambent explain teapot 512,400", "the calculation of that pixel, number by number"},
    {"lambent check phong.frag --vertex phong.vert -o check.png", "the mistakes of a shader's lighting"},
    {"lambent shader teapot --glsl 120 --host c -o teapot", "its shaders, and C code that sets them"},
    {"lambent diff old.png new.png -o where.png", "the difference of two pictures, as numbers and as a picture"},
    {NULL, NULL},
};

const struct topic topics[] = {
    {"Models",
     "MODEL is a file, the name of a built-in shape, or `-` for standard input. The content decides the format; "
     "the extension is only a hint. The name of a built-in shape means the shape even if a file has that name: "
     "write `./teapot` for the file, and `./shapes` for a file that has the name of a command.\n"
     "Several models may be given: each becomes its own picture, in the current folder or that of `-o "
     "pictures/`. A model that fails is reported and the others are still drawn; the exit code is then the "
     "highest one. `-o FILE` and `-` need a single model."},
    {"Output",
     "Without `-o` the picture of `models/koala.obj` is `koala.png` in the current folder. An older picture "
     "written by lambent (recognised by the `Software` text in the PNG) is replaced; any other file of that "
     "name stays, and the exit code is 5. With `-o` the named file is replaced. A picture is written completely "
     "or not at all.\n"
     "Standard output carries the picture (`-o -`) or the report (`--json`), and nothing else. Warnings, "
     "errors, the line that names the written file, and a progress bar (only on a terminal, for work of over "
     "half a second) go to standard error."},
    {"Sheets",
     "`lambent compare MODEL` writes one PNG with several pictures of a model and a caption under each: "
     "`lambent MODEL` draws the same picture with the options printed in grey under the caption. `--sheet` "
     "selects the pictures; `--across OPTION=VALUES` makes a row with one picture for each value. Every other "
     "option applies to all pictures, `--size` (480x400) to each; the options of the sheet follow those of the "
     "command line and override them. The background is white by default. The sheet is `MODEL-NAME.png` in the "
     "current folder or in the folder of `-o`, or the file of `-o`. The pictures are the same bytes everywhere; only "
     "the letters are "
     "FreeType's.\n"
     "`--sheet stages` frames the brightest highlight (the largest difference to the picture without "
     "highlights) and shows it below, three times as large. That sheet, `surfaces` and `terms` give the model's "
     "materials a specular colour of their own, so that there is a highlight to see; `terms` removes the other "
     "terms with black coefficients; `ambient` sets the ambient coefficient of the default material."},
    {"Explaining a pixel",
     "`lambent explain MODEL X,Y` takes the options of a picture and prints the calculation of the pixel in "
     "column X and row Y (from 0, from the top left corner): each visible triangle with its samples, the "
     "object, the position in the triangle, n, v and t, and the material; for each light its matrix (rows "
     "ambient, diffuse, specular), l, r and h, the angles between n and l, r and v, n and h, the distance, "
     "attenuation and spot factor, the highlight's base and power, and its diffuse and specular terms; then the "
     "terms and their sum, the weighted sum of the triangles over the background, the encoding and the bytes. "
     "Vectors are in eye space. The numbers are those of the picture, to the last bit; `docs/lighting.md` has "
     "the formulas. `--json` prints the same as one line. No picture is written; `--output` has no effect."},
    {"Checking shaders", "`lambent check SHADER.frag --vertex SHADER.vert` draws small reference scenes with the "
                         "shaders and compares the pictures with those of the CPU device. Without `--vertex` a "
                         "correct vertex shader is generated. The contract is recognised by the names of uniforms "
                         "and attributes; `--list` prints the contracts, the scenes and the known mistakes. Where "
                         "pictures differ, the same scenes are drawn with known mistakes made on purpose; the "
                         "smallest set that reproduces the shader's pictures is reported, with a line to write "
                         "instead. `-o` writes a sheet with the shader's picture, the reference and the "
                         "difference (times `--gain`) of each scene. `--tolerance` (default 2) applies to each "
                         "channel of a pixel: one pixel in 200 may exceed it, and the mean difference may be a "
                         "quarter of it. The shaders run in a process of their own, which `--stop-after` limits. "
                         "Several shaders may be given: `lambent check */phong.frag */phong.vert` checks a class, "
                         "each vertex shader with the fragment shader of the same folder and name, and `-o "
                         "sheets/` writes a sheet for each. A shader that cannot be checked is reported, and the "
                         "others are still checked. The exit code is 0 if every scene of every shader matches the "
                         "reference, else the highest of all; 6 also for shaders that do not compile, do not end, "
                         "or write NaN. With `--json` the report is one line (`docs/check.schema.json`). More: "
                         "`docs/check.md`."},
    {"Comparing pictures",
     "`lambent diff A B` reads two pictures of the same size (PNG or PPM with 8 bits, PFM with floats, both of "
     "one kind) and prints the largest difference of a channel, the mean and the root mean square over all "
     "channels (red, green, blue and alpha as stored in the files, 1 = full range), the PSNR in decibels "
     "(`infinite` for equal pictures, null in JSON), and the share of pixels in which a channel differs by more "
     "than 1/255 and 2/255. `-o` draws the difference (`-o out/`: as `A-difference.png` in that folder): each channel "
     "is its difference times `--gain`, clamped "
     "at white; black means equal; a pixel that differs only in alpha is grey. A `.pfm` stores the differences "
     "as floats without clamping. With `--json` the figures are one line: `a`, `b`, `width`, `height`, "
     "`maximum`, `mean`, `rmse`, `psnr_db`, `share_over_1`, `share_over_2`, `tolerance`, `differ` (0 or 1: "
     "beyond the tolerance) and `picture`. The exit code is 6 if the largest difference exceeds the tolerance, "
     "1 if the sizes or kinds differ."},
    {"Plots",
     "`lambent plot attenuation a/b/c...` draws 1/(a + b d + c d^2) over the distance d. A curve is three such "
     "numbers, a light as `--light` takes it (`spot:attenuation=0/0/1,range=9`), or every light of a model or "
     "scene file. A dot marks where each curve falls below 1/255, the last step of a picture with 8 bits; a "
     "fourth number (`a/b/c/range`) is a range as in glTF. `lambent plot spot cutoff=30,exponent=8 "
     "inner=20,outer=35` draws the cone of spot lights over the angle from the axis, by OpenGL's law or glTF's. "
     "`lambent plot highlight 10 50 1000` draws the highlight over the angle between the mirrored light and the "
     "eye: for each shininess Phong's and Blinn-Phong's, and Blinn-Phong's at four times the shininess, which "
     "looks like Phong's. Without curves each plot draws a default set. The values come from the functions that "
     "light pixels.\n"
     "The picture is `attenuation.png`, `spot.png` or `highlight.png` (in the folder of `-o plots/`), 1600x1000 "
     "pixels, unless `-o` and `-s` say otherwise; a name that ends in `.svg` makes an SVG. The table on standard "
     "output lists where each "
     "curve falls below 1/255; with `--json` it is one line: `plot`, `x`, `y`, `curves` (each with `label`, "
     "`below_1_255_from`, null for never, and `points`, 101 pairs) and `picture`."},
    {"Same picture everywhere",
     "The same model and options give the same bytes, whatever the instruction set, the number of threads, the "
     "compiler and the machine."},
    {"Environment",
     "`NO_COLOR`: if set and not empty, messages have no colours. `TERM=dumb` also disables the progress bar. "
     "The locale has no effect: numbers always have a point."},
    {NULL, NULL},
};
