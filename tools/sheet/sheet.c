// sheet.c: defines the sheets of the command `compare` as command line options, so that a user can draw each cell
// separately.
#include "sheet.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <lambent/fields.h>
#include <lambent/shader.h>

#include "console.h"

// Most cells do not set the field `look`, so the warning about missing initializers is off.
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"

// A light from the front left, slightly above. Its highlight is visible on any rounded model, left of the centre.
#define KEY        "directional:frame=camera,direction=3/-1/-3"
#define BRIGHT     "ambient=0.15,diffuse=0.7,specular=1"
#define WHITE      KEY ",color=0.8,ambient=0.1"
#define GREEN      KEY ",color=0/0.8/0,ambient=0/0.1/0"
#define ORANGE     "ambient=0.9/0.35/0.05,diffuse=0.9/0.35/0.05"
#define AT_A_PLACE "point:position=1.5r/1.5r/1.5r,ambient=0.15,frame="

// Defaults of sheets (sheet.h). On a coarse shape, Gouraud shading misses this highlight and flat shading
// shows the facets.
#define COARSE {"--segments", NULL}
#define LIT    {"--light", KEY "," BRIGHT}
#define GLOSSY {"--material", "specular=0.7,shininess=100"}

static const struct sheet sheets[] = {
    [SHEET_SUMMARY] = {.name = "summary",
                       .title = "Shading and reflection",
                       .columns = 5,
                       .defaults = {COARSE, LIT, GLOSSY},
                       .count = 5,
                       .cells = {{"Flat", {"--shading", "flat"}},
                                 {"Smooth (Gouraud)", {"--shading", "gouraud"}},
                                 {"Normal interpolation (Phong)", {"--shading", "phong"}},
                                 {"Reflection (environment)",
                                  {"--reflection-map", "sky", "--reflectivity", "0.7", "--light-scale", "0.4"}},
                                 {"Anisotropic (Kajiya–Kay)",
                                  {"--reflection", "kajiya-kay"},
                                  "ambient=0.62,diffuse=0.3,shininess=30"}}},
    [SHEET_TERMS] = {.name = "terms",
                     .title = "The terms of the sum",
                     .columns = 4,
                     .beam = true,
                     .defaults = {COARSE, LIT, {"--material", "specular=0.7"}},
                     .count = 6,
                     .cells = {{"Ambient only", {"--material", "ambient=0.62,diffuse=0,specular=0"}},
                               {"Diffuse only", {"--material", "ambient=0,specular=0"}},
                               {"Specular only, shininess 50",
                                {"--material", "ambient=0,diffuse=0", "--shininess", "50"}},
                               {"All, shininess 50", {"--shininess", "50"}},
                               {"All, shininess 1000", {"--shininess", "1000"}},
                               {"All, shininess 1000, flat", {"--shininess", "1000", "--shading", "flat"}}}},
    [SHEET_STAGES] = {.name = "stages",
                      .title = "Where lighting is computed",
                      .columns = 2,
                      .inset = true,
                      .defaults = {COARSE, LIT, GLOSSY},
                      .count = 2,
                      .cells = {{"Per vertex", {"--stage", "vertex"}}, {"Per fragment", {"--stage", "fragment"}}}},
    [SHEET_LIGHT] = {.name = "light",
                     .title = "The colour of light",
                     .columns = 2,
                     .defaults = {{"--material", "specular=0.5,shininess=50"}},
                     .count = 4,
                     .cells = {{"White light", {"--light", WHITE}},
                               {"Green light", {"--light", GREEN}},
                               {"Orange surface, white light", {"--light", WHITE, "--material", ORANGE}},
                               {"Orange surface, green light", {"--light", GREEN, "--material", ORANGE}}}},
    [SHEET_AMBIENT] = {.name = "ambient",
                       .title = "Ambient and diffuse light",
                       .columns = 3,
                       .count = 3,
                       .cells = {{"Ambient white, diffuse white",
                                  {"--light", KEY ",ambient=0.25,diffuse=1", "--material", "ambient=0.72"}},
                                 {"Ambient red, diffuse white",
                                  {"--light", KEY ",ambient=0.25/0/0,diffuse=1", "--material", "ambient=0.72"}},
                                 {"Ambient red, diffuse red",
                                  {"--light", KEY ",ambient=0.25/0/0,diffuse=1/0/0,specular=1/0/0", "--material",
                                   "ambient=0.72"}}}},
    [SHEET_FRAMES] = {.name = "frames",
                      .title = "One light in three frames",
                      .columns = 3,
                      .defaults = {{"--material", "specular=0.5,shininess=50"}},
                      .count = 6,
                      .cells = {{"World", {"--light", AT_A_PLACE "world"}},
                                {"Camera", {"--light", AT_A_PLACE "camera"}},
                                {"Object", {"--light", AT_A_PLACE "object"}},
                                {"World, the model rotated", {"--light", AT_A_PLACE "world", "--rotate", "y:-60"}},
                                {"Camera, the model rotated", {"--light", AT_A_PLACE "camera", "--rotate", "y:-60"}},
                                {"Object, the model rotated", {"--light", AT_A_PLACE "object", "--rotate", "y:-60"}}}},
    [SHEET_SURFACES] = {.name = "surfaces",
                        .title = "Three kinds of surfaces",
                        .columns = 3,
                        .defaults = {LIT},
                        .count = 3,
                        .cells = {{"Specular", {"--material", "ambient=0.2,diffuse=0.2,specular=0.8,shininess=80"}},
                                  {"Diffuse", {"--material", "specular=0"}},
                                  {"Translucent", {"--material", "specular=0.5,shininess=80,opacity=0.45"}}}},
    [SHEET_FILTERS] = {.name = "filters",
                       .title = "Filters of textures",
                       .columns = 2,
                       .count = 4,
                       .cells = {{"Nearest texel", {"--map-filter", "nearest", "--anisotropy", "1"}},
                                 {"Bilinear", {"--map-filter", "bilinear", "--anisotropy", "1"}},
                                 {"Trilinear (mipmaps)", {"--map-filter", "trilinear", "--anisotropy", "1"}},
                                 {"Anisotropic, up to 16 probes",
                                  {"--map-filter", "trilinear", "--anisotropy", "16"}}}},
    [SHEET_TRUTH] = {.name = "truth",
                     .title = "Approximations of light",
                     .columns = 4,
                     .apart = 3,
                     .count = 6,
                     .cells = {{"Local lighting", {"--ground", "off", "--ao", "off", "--bounces", "0"}},
                               {"With shadows", {"--shadows", "--ao", "off", "--bounces", "0"}},
                               {"With shadows and occlusion", {"--shadows", "--ao", "rays", "--bounces", "0"}},
                               {"One bounce: direct light", {"--bounces", "1"}},
                               {"Two bounces", {"--bounces", "2"}},
                               {"Eight bounces", {"--bounces", "8"}}}},
};

// --- a row of variants

bool sheet_varies(const struct option *o) { return option_is_in(o, IN_SHEET); }

// Finds an option or, if no option has this name, a field of the material. The result is the option, or --material with
// the field in `*field`.
static const struct option *find_option(const char *name, size_t length, const lam_field **field, lam_error *error)
{
    char typed[64];
    *field = NULL;
    snprintf(typed, sizeof typed, "%.*s", (int)(length < 60 ? length : 60), name);
    struct suggestion nearest = suggest_start(typed);
    for (const struct option *o = option_table; o->name; o++) {
        if (sheet_varies(o) && strcmp(o->name, typed) == 0)
            return o;
        if (sheet_varies(o))
            suggest_try(&nearest, o->name);
    }
    for (int i = 0; lam_material_field(i); i++) {
        *field = lam_material_field(i);
        if (strcmp((*field)->key, typed) == 0)
            return find_option("material", 8, &(const lam_field *){NULL}, error);
        suggest_try(&nearest, (*field)->key);
    }
    complain(error, LAM_BAD_ARGUMENT,
             "option '--across': found '%s', expected an option of the picture such as shading, or a field of "
             "materials such "
             "as emission%s%s%s",
             typed, nearest.best ? "; did you mean '" : "", nearest.best ? nearest.best : "", nearest.best ? "'?" : "");
    return NULL;
}

static bool add_variant(struct sheet *sheet, const char *dashed, const char *name, const char *value, lam_error *error)
{
    if (sheet->count == CELLS_MAX)
        return complain(error, LAM_LIMIT, "option '--across': more than %d pictures", CELLS_MAX);
    struct cell *cell = &sheet->cells[sheet->count++];
    *cell = (struct cell){.words = {dashed, value}};
    snprintf(cell->caption, sizeof cell->caption, "%s %s", name, value);
    return true;
}

// Adds each value of the option once, without "auto", which selects one of the other values.
static bool add_words(struct sheet *sheet, const char *dashed, const struct option *option, lam_error *error)
{
    for (const struct choice *w = option->words; w->name; w++) {
        bool known = strcmp(w->name, "auto") == 0;
        for (const struct choice *before = option->words; before != w; before++)
            known = known || before->value == w->value;
        if (!known && !add_variant(sheet, dashed, option->name, w->name, error))
            return false;
    }
    return true;
}

// Returns true if commas separate the lights, instead of semicolons: a comma precedes the type of a light, as in
// "point,spot:cutoff=9".
static bool lacks_semicolons(const struct option *option, const char *values)
{
    if (strcmp(option->name, "light") != 0 || strchr(values, ';'))
        return false;
    for (const char *comma = strchr(values, ','); comma; comma = strchr(comma + 1, ','))
        if (comma[1 + strcspn(comma + 1, ",:=")] == ':')
            return true;
    return false;
}

// Rows of variants that need additional options to show a difference.
static const struct row {
    const char *option;
    const char *values; // the default values; NULL means the values that the option accepts
    struct sheet_default defaults[SHEET_DEFAULTS_MAX + 1];
} row_table[] = {
    {"shading", NULL, {COARSE, LIT, GLOSSY}},
    {"stage", NULL, {COARSE, LIT, GLOSSY}},
    {"normals", NULL, {COARSE, LIT, GLOSSY}},
    {"flat-normal", NULL, {COARSE, LIT, GLOSSY, {"--shading", "flat"}}},
    {"reflection", NULL, {LIT, {"--material", "ambient=0.62,diffuse=0.4,specular=0.5,shininess=30"}}},
    {"viewer", NULL, {LIT, GLOSSY}},
    {"rig", NULL, {GLOSSY}},
    {"shininess", "10,50,1000", {LIT, {"--material", "specular=0.7"}}},
    {"light",
     "ambient:color=0.4;hemisphere:sky=0.55/0.65/0.85,ground=0.3/0.2/0.1;point:position=0.4r/0.9r/1.1r;"
     "directional:direction=2/-2/-3;spot:position=1r/2r/3r,cutoff=7",
     {GLOSSY}},
    {"show",
     "ambient,diffuse,specular,emission,reflection",
     {LIT,
      {"--material", "specular=0.7,shininess=50,emission=0.2/0.05/0"},
      {"--reflection-map", "sky"},
      {"--reflectivity", "0.3"}}},
};

static const struct row *find_row(const char *option)
{
    for (size_t i = 0; i < sizeof row_table / sizeof *row_table; i++)
        if (strcmp(row_table[i].option, option) == 0)
            return &row_table[i];
    return NULL;
}

// Two lights, one attenuated and one from behind, on a coloured surface. These lights and the surface make most
// mistakes visible.
#define LAMP  "point:position=-1.2r/1.3r/1.7r,attenuation=0.3/0.1r/0.15r,ambient=0.2"
#define RIM   "directional:direction=-1/-0.5/1.4,diffuse=0.4/0.45/0.55,specular=0.8"
#define PAINT "ambient=0.3/0.12/0.08,diffuse=0.75/0.3/0.2,specular=0.5,shininess=20"

static bool add_mistake(struct sheet *sheet, const char *name, lam_error *error)
{
    if (sheet->count == CELLS_MAX)
        return complain(error, LAM_LIMIT, "option '--across': more than %d pictures", CELLS_MAX);
    struct cell *cell = &sheet->cells[sheet->count++];
    *cell = (struct cell){.mistake = name};
    snprintf(cell->caption, sizeof cell->caption, "%s", name ? name : "Correct");
    return true;
}

// Parses `values`: "all", or names separated by commas. The caller checks the names.
static bool choose_mistakes(const char *values, struct sheet *sheet, char **store, lam_error *error)
{
    *sheet = (struct sheet){.name = "mistake", .title = "Known mistakes", .mistakes = true};
    const struct sheet_default defaults[] = {{"--light", LAMP}, {"--light", RIM}, {"--material", PAINT}};
    memcpy(sheet->defaults, defaults, sizeof defaults);
    sheet->all = strcmp(values, "all") == 0;
    bool ok = add_mistake(sheet, NULL, error);
    lam_shader_mistake mistake;
    for (int i = 0; ok && sheet->all && lam_shader_mistake_row(i, &mistake); i++)
        ok = add_mistake(sheet, mistake.id, error);
    *store = ok && !sheet->all ? strdup(values) : NULL;
    if (ok && !sheet->all && !*store)
        return complain(error, LAM_MACHINE, "out of memory");
    for (char *name = *store, *end; ok && name; name = end) {
        end = strchr(name, ',');
        if (end)
            *end++ = 0;
        ok = add_mistake(sheet, name, error);
    }
    return ok;
}

// Makes the title of a row of pictures with different values of an option.
static void title_of(const char *option, char *title, size_t size)
{
    static const struct {
        const char *option, *title;
    } rows[] = {{"ao", "ambient occlusion"},
                {"color-mode", "encodings of colours"},
                {"cull", "culled sides of the surface"},
                {"environment", "environments"},
                {"reflection-map", "reflection maps"},
                {"environment-rotation", "rotations of the environment"},
                {"ground", "kinds of ground"},
                {"hidden-lines", "lines behind surfaces"},
                {"light", "lights"},
                {"look", "looks"},
                {"material", "materials"},
                {"normals", "sources of the normals"},
                {"opacity", "opacity"},
                {"projection", "projections"},
                {"reflection", "reflection models"},
                {"reflectivity", "reflectivities of surfaces"},
                {"rig", "sets of lights"},
                {"samples", "samples per pixel"},
                {"segments", "numbers of segments"},
                {"shading", "shading methods"},
                {"shadow-terminator", "shadows at the terminator"},
                {"shadows", "with and without shadows"},
                {"shininess", "exponents of the highlight"},
                {"show", "terms of the light and surface quantities"},
                {"surfaces", "with and without surfaces"},
                {"tone", "tone curves"},
                {"viewer", "positions of the eye for highlights"}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (strcmp(rows[i].option, option) == 0) {
            snprintf(title, size, "%s", rows[i].title);
            return;
        }
    snprintf(title, size, "values of --%s", option);
}

// Makes a row of two pictures, without and with a switch.
static bool choose_switch(const struct option *option, const char *values, struct sheet *sheet, char **store,
                          lam_error *error)
{
    if (values)
        return complain(error, LAM_BAD_ARGUMENT, "option '--across': '%s' is a switch without values; found '%.60s'",
                        option->name, values);
    if (asprintf(store, "--%s", option->name) < 0) {
        *store = NULL;
        return complain(error, LAM_MACHINE, "out of memory");
    }
    *sheet = (struct sheet){.name = option->name, .across = true, .columns = 2, .count = 2};
    snprintf(sheet->title, sizeof sheet->title, "Without and with --%s", option->name);
    snprintf(sheet->cells[0].caption, sizeof sheet->cells[0].caption, "without %s", option->name);
    snprintf(sheet->cells[1].caption, sizeof sheet->cells[1].caption, "%s", option->name);
    sheet->cells[1].words[0] = *store;
    return true;
}

static bool choose_across(const char *across, struct sheet *sheet, char **store, lam_error *error)
{
    size_t length = strcspn(across, "=");
    if (length == 7 && memcmp(across, "mistake", 7) == 0)
        return choose_mistakes(across[length] ? across + length + 1 : "all", sheet, store, error);
    bool term = length == 4 && memcmp(across, "term", 4) == 0; // an alias of --show
    const lam_field *field = NULL;
    const struct option *option =
        term ? find_option("show", 4, &field, error) : find_option(across, length, &field, error);
    if (!option)
        return false;
    const char *values = across[length] ? across + length + 1 : NULL, *name = field ? field->key : option->name;
    if (!option->value)
        return choose_switch(option, values, sheet, store, error);
    const struct row *row = find_row(name);
    if (!values && field && field->type == LAM_FIELD_FLAG)
        values = "no,yes";
    bool all_terms = !values && strcmp(option->name, "show") == 0;
    if (!values && row)
        values = row->values;
    if (!values && !option->words)
        return complain(error, LAM_BAD_ARGUMENT, "option '--across': '%s' needs values: %s=A,B,C", name, name);
    if (values && lacks_semicolons(option, values))
        return complain(error, LAM_BAD_ARGUMENT,
                        "option '--across': found a comma between two lights in '%.200s', expected a semicolon",
                        across);
    // Allocates one block for "--name" and the values, each with a terminating zero and, for a field, with its key.
    size_t dashed = strlen(option->name) + 3, key = field ? strlen(name) + 1 : 0, count = 1;
    for (const char *s = values; s && *s; s++)
        count += *s == ',' || *s == ';';
    *store = malloc(dashed + (values ? strlen(values) : 0) + count * (key + 1));
    if (!*store)
        return complain(error, LAM_MACHINE, "out of memory");
    sprintf(*store, "--%s", option->name);
    *sheet = (struct sheet){.name = name, .across = true};
    // A row of single terms or values shows the unchanged model. In a row of all five terms, the row's defaults change
    // the scene, so that every term is visible.
    if (row && (all_terms || strcmp(option->name, "show") != 0))
        memcpy(sheet->defaults, row->defaults, sizeof sheet->defaults);
    title_of(name, sheet->title, sizeof sheet->title);
    *sheet->title = (char)toupper((unsigned char)*sheet->title);
    bool ok = true;
    if (!values) {
        ok = add_words(sheet, *store, option, error);
    } else {
        char *value = *store + dashed;
        const char *separator = !option->words && strpbrk(values, ";=") ? ";" : ",";
        for (const char *from = values; ok && from; value += strlen(value) + 1) {
            size_t size = strcspn(from, separator);
            sprintf(value, "%s%s%.*s", field ? name : "", field ? "=" : "", (int)size, from);
            ok = size ? add_variant(sheet, *store, name, value + key, error)
                      : complain(error, LAM_BAD_ARGUMENT, "option '--across': an empty value in '%.200s'", across);
            if (ok)
                sheet->cells[sheet->count - 1].words[1] = value;
            from = from[size] ? from + size + 1 : NULL;
        }
    }
    // Puts up to six pictures in one row, and distributes more pictures evenly over several rows.
    int rows = (sheet->count + 5) / 6;
    sheet->columns = rows ? (sheet->count + rows - 1) / rows : 1;
    return ok;
}

// Combines two sheets into a table with one row for each picture of `lines` and one column for each picture of
// `columns`.
static bool cross(const struct sheet *lines, const struct sheet *columns, struct sheet *sheet, lam_error *error)
{
    *sheet = (struct sheet){.name = "across", .columns = columns->count, .across = true};
    sheet_defaults_merge(sheet, lines);
    sheet_defaults_merge(sheet, columns);
    char down[60], across[60];
    title_of(lines->name, down, sizeof down);
    title_of(columns->name, across, sizeof across);
    snprintf(sheet->title, sizeof sheet->title, "Rows: %s; columns: %s", down, across);
    if (lines->count * columns->count > CELLS_MAX)
        return complain(error, LAM_LIMIT, "options '--across': %d times %d pictures, at most %d", lines->count,
                        columns->count, CELLS_MAX);
    for (int i = 0; i < lines->count * columns->count; i++) {
        const struct cell *a = &lines->cells[i / columns->count], *b = &columns->cells[i % columns->count];
        struct cell *cell = &sheet->cells[sheet->count++];
        *cell = (struct cell){.words = {NULL}};
        int words = 0;
        for (int k = 0; k < 4 && a->words[k]; k++)
            cell->words[words++] = a->words[k];
        for (int k = 0; k < 4 && b->words[k]; k++)
            cell->words[words++] = b->words[k];
        snprintf(cell->caption, sizeof cell->caption, "%.45s, %.45s", a->caption, b->caption);
    }
    return true;
}

bool sheet_choose(const struct options *options, struct sheet *sheet, char *store[ACROSS_MAX], lam_error *error)
{
    for (int i = 0; i < ACROSS_MAX; i++)
        store[i] = NULL;
    const struct texts *across = &options->sheet.across;
    if (across->count == 0) {
        *sheet = sheets[options->sheet.name];
        if (options->shading.environment) // the user's environment replaces the sky
            for (int i = 0; i < sheet->count; i++)
                for (int k = 1; k < CELL_WORDS && sheet->cells[i].words[k]; k++)
                    if (strcmp(sheet->cells[i].words[k - 1], "--reflection-map") == 0)
                        sheet->cells[i].words[k] = options->shading.environment;
        return true;
    }
    if (across->count == 1)
        return choose_across(across->items[0], sheet, &store[0], error);
    struct sheet lines, columns;
    for (int i = 0; i < 2; i++)
        if (strncmp(across->items[i], "mistake", 7) == 0)
            return complain(error, LAM_BAD_ARGUMENT,
                            "option '--across': mistakes cannot be combined with another '--across'");
    return choose_across(across->items[0], &lines, &store[0], error) &&
           choose_across(across->items[1], &columns, &store[1], error) && cross(&lines, &columns, sheet, error);
}
