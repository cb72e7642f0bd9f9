// command_table.c: defines the commands and the examples.
#include "command_table.h"

#include <string.h>

#define ABOUT (1ull << GROUP_ABOUT)
// The options for a picture of one model. Only `render` can draw several pictures of one model.
#define ALL                                                                                                            \
    (((1ull << GROUP_COUNT) - 1) &                                                                                     \
     ~(1ull << GROUP_DIFF | 1ull << GROUP_PLOT | 1ull << GROUP_CAPTIONS | 1ull << GROUP_SHEET | 1ull << GROUP_CHECK |  \
       1ull << GROUP_CONTACT | 1ull << GROUP_SHADER | 1ull << GROUP_SHAPE | 1ull << GROUP_FIGURE |                     \
       1ull << GROUP_EXERCISES | 1ull << GROUP_VIEWER | 1ull << GROUP_HASH | 1ull << GROUP_CONVERT |                   \
       1ull << GROUP_PRINT | 1ull << GROUP_SETTINGS | 1ull << GROUP_BATCH | 1ull << GROUP_ANIMATION))

static const struct own_default compare_defaults[] = {{"output", "MODEL-SHEET.png", NULL},
                                                      {"size", "480x400 each", NULL},
                                                      {"background", SHEET_BACKGROUND, NULL},
                                                      {NULL, NULL, NULL}};
static const struct own_default sheet_defaults[] = {{"output", "sheet.png", "FILE.png, .svg, .jpg ..."},
                                                    {"size", "256x256 each", "size of each picture, for example 320"},
                                                    {"background", SHEET_BACKGROUND, NULL},
                                                    {NULL, NULL, NULL}};
static const struct own_default batch_defaults[] = {{"output", "{stem}.png", NULL}, {NULL, NULL, NULL}};
static const struct own_default journal_defaults[] = {{"output", "no merged journal", NULL}, {NULL, NULL, NULL}};
static const struct own_default explain_defaults[] = {{"output", "no figure", NULL}, {NULL, NULL, NULL}};
static const struct own_default check_defaults[] = {{"output", "no sheet", NULL},
                                                    {"size", "128", NULL},
                                                    {"tolerance", "2", NULL},
                                                    {"memory-limit", "1Gi", NULL},
                                                    {NULL, NULL, NULL}};
static const struct own_default exercises_defaults[] = {{"output", "required", NULL}, {NULL, NULL, NULL}};
static const struct own_default shader_defaults[] = {{"output", "standard output", NULL}, {NULL, NULL, NULL}};
static const struct own_default shape_defaults[] = {{"output", "NAME.png, parametric.png or implicit.png", NULL},
                                                    {NULL, NULL, NULL}};
static const struct own_default diff_defaults[] = {
    {"output", "no picture, no page", "a picture of the difference between two pictures, or a page: FILE.html"},
    {"size", "384x384", "size of the models' pictures, for example 800 or 1920x1080"},
    {NULL, NULL, NULL}};
static const struct own_default hash_defaults[] = {{"output", "required without --check", "the text file of hashes"},
                                                   {"size", NULL, "size of the pictures, for example 800 or 1920x1080"},
                                                   {NULL, NULL, NULL}};
static const struct own_default plot_defaults[] = {
    {"output", "KIND.png", NULL}, {"size", "1600x1000", NULL}, {NULL, NULL, NULL}};
static const struct own_default materials_defaults[] = {{"output", "no sheet", NULL},
                                                        {"size", "1024x593", NULL},
                                                        {"background", SHEET_BACKGROUND, NULL},
                                                        {NULL, NULL, NULL}};

const struct command command_table[] = {
    [COMMAND_render] = {"render", "MODEL...", "Draw a picture of each model. You can omit the word `render`.",
                        ALL | 1ull << GROUP_BATCH | 1ull << GROUP_ANIMATION | 1ull << GROUP_SETTINGS,
                        .also = "draw image snapshot screenshot thumbnail thumb", .min_operands = 1,
                        .max_operands = -1},
    [COMMAND_batch] = {"batch", "[MODEL|FOLDER|@LIST|-]...",
                       "Draw many models, from folders, lists or standard input, and keep a journal.",
                       ALL | 1ull << GROUP_BATCH | 1ull << GROUP_ANIMATION, .also = "thumbnails thumbs",
                       .min_operands = 0, .max_operands = -1, .defaults = batch_defaults},
    [COMMAND_journal] =
        {"journal", "JOURNAL|FOLDER...",
         "Read the journals of a batch and list the written, failed and missing pictures; -o FILE merges "
         "the journals of the shards.",
         ABOUT | TAKES_OUTPUT | TAKES_JSON | TAKES_QUIET | TAKES_REPORT, .min_operands = 1, .max_operands = -1,
         .defaults = journal_defaults},
    [COMMAND_sheet] = {"sheet", "MODEL|FOLDER|@LIST...",
                       "Draw a contact sheet: small pictures of many models, with their names and sizes, on pages.",
                       (ALL & ~(1ull << GROUP_REPORT)) | 1ull << GROUP_CONTACT | 1ull << GROUP_CAPTIONS | TAKES_QUIET |
                           TAKES_MANY | TAKES_TITLE,
                       .also = "contact-sheet contactsheet montage overview", .min_operands = 0, .max_operands = -1,
                       .defaults = sheet_defaults},
    [COMMAND_compare] =
        {"compare", "MODEL", "Draw a sheet of labelled pictures that compare methods, lights or terms side by side.",
         (ALL & ~(1ull << GROUP_REPORT)) | 1ull << GROUP_SHEET | 1ull << GROUP_CAPTIONS | TAKES_QUIET | TAKES_JSON,
         .min_operands = 1, .max_operands = 1,
         .one_more =
             "the command shows one model in several ways; lambent diff compares two models, lambent sheet draws many",
         .defaults = compare_defaults},
    [COMMAND_explain] =
        {"explain", "MODEL X,Y",
         "Print the calculation of one pixel: the vectors, angles and terms of each light, and the resulting bytes. -o "
         "FILE (SVG, PNG) draws a figure with arrows, coordinates and terms. Lambent ignores --save-scene.",
         ALL | 1ull << GROUP_SHAPE | 1ull << GROUP_FIGURE | 1ull << GROUP_CAPTIONS | 1ull << GROUP_SETTINGS |
             TAKES_TITLE,
         .min_operands = 1, .max_operands = 2, .one_more = "write the pixel as one word, such as 512,400",
         .defaults = explain_defaults},
    [COMMAND_info] =
        {"info", "MODEL...",
         "Print the contents of models: size, triangles, materials, pictures, lights, cameras, animations, extensions.",
         ABOUT | 1ull << GROUP_MODEL | 1ull << GROUP_WORK | 1ull << GROUP_LIMITS | 1ull << GROUP_PRINT | TAKES_JSON |
             TAKES_QUIET,
         .also = "stats stat size measure inspect describe list volume bbox bounds dimensions area validate verify "
                 "count list-animations animations",
         .min_operands = 1, .max_operands = -1},
    [COMMAND_check] =
        {"check", "SHADER.frag...",
         "Compare the pictures of GLSL shaders with reference pictures, and find the mistakes that explain the "
         "differences.",
         ABOUT | 1ull << GROUP_CHECK | 1ull << GROUP_DIFF | 1ull << GROUP_CAPTIONS | TAKES_OUTPUT | TAKES_SIZE |
             TAKES_JSON | TAKES_QUIET | TAKES_THREADS | TAKES_MEMORY | TAKES_TITLE,
         .min_operands = 0, .max_operands = -1, .defaults = check_defaults},
    [COMMAND_shader] = {"shader", "[MODEL]",
                        "Print the shaders that light a model, with the values of their inputs, for use in another "
                        "program.",
                        ALL | 1ull << GROUP_SHADER, .min_operands = 0, .max_operands = 1, .defaults = shader_defaults},
    [COMMAND_diff] = {"diff", "OLD NEW",
                      "Compare two pictures, two models or the models of two folders; -o writes a picture of the "
                      "difference, or a page that shows the models before and after.",
                      (ALL & ~(1ull << GROUP_REPORT)) | 1ull << GROUP_DIFF | TAKES_JSON | TAKES_QUIET | TAKES_MANY |
                          TAKES_TITLE,
                      .also = "difference", .min_operands = 2, .max_operands = 2,
                      .one_more = "the command compares two pictures, two models or two folders of models",
                      .defaults = diff_defaults},
    [COMMAND_hash] =
        {"hash", "[MODEL|FOLDER|@LIST|-]...",
         "Write hashes of the models' pictures to a text file (-o), or compare them with such a file (--check).",
         (ALL & ~(1ull << GROUP_REPORT)) | 1ull << GROUP_HASH | TAKES_JSON | TAKES_QUIET | TAKES_MANY,
         .min_operands = 0, .max_operands = -1, .defaults = hash_defaults},
    [COMMAND_convert] = {"convert", "MODEL OUT.glb|obj|stl|ply|3mf",
                         "Write a model or a scene as GLB, OBJ, STL, PLY or 3MF, and report everything that the format "
                         "does not support.",
                         ABOUT | 1ull << GROUP_CONVERT | 1ull << GROUP_MODEL | 1ull << GROUP_LIMITS | TAKES_UP |
                             TAKES_THREADS | TAKES_JSON | TAKES_QUIET,
                         .also = "export transform", .min_operands = 2, .max_operands = 2,
                         .one_more = "the command writes one model: lambent convert MODEL OUT.glb"},
    [COMMAND_plot] = {"plot", "attenuation|spot|highlight|lambert|fresnel|tone|depth|lobe [CURVE...]",
                      "Plot curves (PNG or SVG) and print their values.",
                      ABOUT | 1ull << GROUP_PLOT | 1ull << GROUP_CAPTIONS | TAKES_OUTPUT | TAKES_SIZE | TAKES_JSON |
                          TAKES_QUIET | TAKES_FILES | TAKES_TERM | TAKES_TITLE,
                      .min_operands = 1, .max_operands = -1, .defaults = plot_defaults},
    [COMMAND_exercises] =
        {"exercises", NULL,
         "Write exercises for a class: shaders with a mistake, pictures, a page for students and a key.",
         ABOUT | 1ull << GROUP_EXERCISES | 1ull << GROUP_CAPTIONS | TAKES_OUTPUT | TAKES_QUIET | TAKES_TITLE,
         .min_operands = 0, .max_operands = 0, .defaults = exercises_defaults},
    [COMMAND_lights] =
        {"lights", "MODEL",
         "Print the lights of a model (or of the rig if the model has no lights) in the format of scene files.",
         ABOUT | 1ull << GROUP_MODEL | 1ull << GROUP_VIEW | 1ull << GROUP_LIGHTS | 1ull << GROUP_SHADING |
             1ull << GROUP_WORK | 1ull << GROUP_LIMITS,
         .min_operands = 1, .max_operands = 1, .one_more = "the command prints the lights of one model"},
    [COMMAND_shape] = {"shape", "[NAME]",
                       "Draw a built-in shape or a surface that formulas define (--parametric, --implicit), or save it "
                       "as OBJ, STL or PLY.",
                       ALL | 1ull << GROUP_SHAPE | 1ull << GROUP_ANIMATION | 1ull << GROUP_SETTINGS, .min_operands = 0,
                       .max_operands = 1, .defaults = shape_defaults},
    [COMMAND_view] =
        {"view", "MODEL|FOLDER",
         "Show a model in the browser and update the picture when the model file changes, or show the gallery of a "
         "folder.",
         ABOUT | 1ull << GROUP_VIEWER | PICTURE_GROUPS | 1ull << GROUP_LIMITS | TAKES_THREADS | TAKES_QUIET |
             WRITES_NO_FILE,
         .also = "watch open show gui viewer preview display", .min_operands = 1, .max_operands = 1,
         .one_more = "the command shows one model, or the models of one folder"},
    [COMMAND_shapes] = {"shapes", NULL, "List the built-in shapes.", ABOUT, .also = "list-shapes primitives",
                        .min_operands = 0, .max_operands = 0,
                        .one_more = "the command lists all shapes; lambent teapot draws one shape"},
    [COMMAND_formats] = {"formats", NULL, "List the formats of models and pictures.", ABOUT, .also = "list-formats",
                         .min_operands = 0, .max_operands = 0, .one_more = "the command lists all formats"},
    [COMMAND_looks] = {"looks", "[NAME]",
                       "List the built-in looks (--look), or print the text of one look; --sheet draws each.",
                       (ALL & ~(1ull << GROUP_REPORT)) | 1ull << GROUP_SHEET | 1ull << GROUP_CAPTIONS | TAKES_QUIET,
                       .also = "list-looks", .min_operands = 0, .max_operands = 1},
    [COMMAND_materials] =
        {"materials", NULL,
         "List the named materials with the values of their fields; -o FILE also draws a sheet of these materials.",
         ABOUT | 1ull << GROUP_PICTURE | 1ull << GROUP_CAPTIONS | TAKES_JSON, .also = "list-materials presets",
         .min_operands = 0, .max_operands = 0,
         .one_more = "the command lists all materials; lambent teapot --material gold shows one material",
         .defaults = materials_defaults},
    [COMMAND_config] = {"config", NULL, "Print the current settings, and the name of the settings file.",
                        ABOUT | 1ull << GROUP_SETTINGS | TAKES_JSON, .min_operands = 0, .max_operands = 0,
                        .one_more = "the command only prints the settings; to change settings, edit the settings file"},
    [COMMAND_devices] = {"devices", NULL,
                         "List the devices that can draw on this machine, and explain why other devices cannot.",
                         ABOUT | TAKES_JSON, .also = "list-devices gpus", .min_operands = 0, .max_operands = 0},
    [COMMAND_help] = {"help", "[TOPIC]",
                      "Explain a subject, a command or an option. Without TOPIC, list the subjects and commands.",
                      ABOUT, .also = "man usage", .min_operands = 0, .max_operands = -1, .verbatim = true},
    [COMMAND_complete] = {"complete", "-- WORD...", "Print completions for the last word (used by shells).", ABOUT,
                          .min_operands = 0, .max_operands = -1, .verbatim = true},
    [COMMAND_generate] = {"generate", "man|markdown|bash|zsh|fish|scene-schema|contract-schema|contract-NAME",
                          "Print the man page, the reference in Markdown, shell completions, the JSON Schema of scene "
                          "files or of shader contracts, or a built-in contract.",
                          ABOUT, .min_operands = 1, .max_operands = 1},
    [COMMAND_COUNT] = {.name = NULL},
};

const struct command *find_command(const char *name)
{
    for (const struct command *c = command_table; c->name; c++)
        if (strcmp(c->name, name) == 0)
            return c;
    return NULL;
}

const char *default_of(const struct command *command, const struct option *option)
{
    for (const struct own_default *d = command->defaults; d && d->option; d++)
        if (strcmp(d->option, option->name) == 0)
            return d->standard ? d->standard : option->standard;
    return option->standard;
}

const char *brief_of(const struct command *command, const struct option *option)
{
    for (const struct own_default *d = command->defaults; d && d->option; d++)
        if (strcmp(d->option, option->name) == 0 && d->brief)
            return d->brief;
    return option->brief ? option->brief : option->summary;
}

uint64_t find_groups(const char *name)
{
    const struct command *command = find_command(name);
    return command ? command->groups : 0;
}

const struct example examples[] = {
    {"lambent koala.obj", "writes koala.png, 1024x1024", true},
    {"lambent part.stl -o shot.png -b white", "writes shot.png on a white background", true},
    {"lambent scan.ply -s 640 --view front", "draws the model from the front, in 640x640 pixels", false},
    {"lambent teapot --color '#ff8800'", "draws a built-in shape (`lambent shapes`)", true},
    {"lambent -q *.stl -o pictures/", "writes all pictures to one folder", true},
    {"lambent batch models/ -o 'thumbs/{dir}/{stem}.png'",
     "draws all models in a folder and its sub-folders, and keeps a journal", false},
    {"lambent - -o - < part.stl > part.png",
     "reads the model from standard input and writes the picture to standard output", false},
    {"lambent koala.obj -o koala.html", "writes a web page on which you can turn the model (after `make web`)", false},
    {"lambent view koala.obj",
     "shows the model in the browser, and reloads it when the file changes (after `make web`)", false},
    {"lambent view models/", "shows a gallery of the folder (after `make web`)", false},
    {"lambent koala.obj --turntable 36 --fps 12", "writes an animated PNG of the turning model", false},
    {"lambent koala.obj --sweep light.azimuth=0..360 -o 'light-{frame}.png'",
     "draws 36 pictures of the model, with a light that moves around the model", false},
    {"lambent koala.obj --json", "reports the input files, the camera and the duration of each step", false},
    {"lambent info ship.glb", "lists the model's size, triangles, materials and animations", false},
    {"lambent compare koala.obj --sheet terms", "shows the lighting terms side by side, with captions", false},
    {"lambent compare bunny.ply --across 'light=point;directional:direction=-1/-2/-1'",
     "draws one picture for each value of an option", false},
    {"lambent convert scene.json scene.glb", "converts a scene file or a model to another format", false},
    {"lambent plot attenuation 1/0.54/0.2 1/0/1", "plots how two lights fade with distance", false},
    {"lambent plot spot cutoff=30,exponent=8 inner=20,outer=35 -o spot.svg", "plots the cones of two spot lights",
     false},
    {"lambent plot highlight 10 50 1000", "plots highlights of three different widths", false},
    {"lambent koala.obj --rig headlight --save-scene koala.json",
     "draws the model, and writes a scene file that you can edit", false},
    {"lambent koala.json", "draws a scene file: objects, materials, lights and camera", false},
    {"lambent explain teapot 512,400", "prints the calculation of this pixel", false},
    {"lambent explain teapot 512,400 -o figure.svg", "draws the same calculation as a figure", false},
    {"lambent check phong.frag --vertex phong.vert -o check.png", "finds the mistakes in a shader's lighting", false},
    {"lambent shader teapot --glsl 120 --host c -o teapot",
     "writes the model's shaders, and C code that sets their inputs", false},
    {"lambent shape --parametric 'x=u*cos(v); y=u*sin(v); z=cos(3u)' --u 0..4 -o ripple.obj",
     "defines a surface by formulas and saves it as a model", false},
    {"lambent shape --implicit 'x^2+y^2+z^2-1'", "draws an implicit surface, here a sphere", false},
    {"lambent diff old.png new.png -o where.png", "prints and draws the difference between two pictures", false},
    {"lambent diff old/ new/ -o report.html", "shows models before and after a change on one page", false},
    {"lambent hash models/ -o pictures.hash",
     "writes the hashes of all pictures to a file, which you can keep in a repository", false},
    {"lambent hash --check pictures.hash", "lists the models whose pictures changed", false},
    {NULL, NULL, false},
};
