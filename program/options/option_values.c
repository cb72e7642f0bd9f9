// option_values.c: parses the values of options. It is longer than 600 lines because it contains one short parser for each
// syntax of values.
#include "options.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#include <lambent/section.h>
#include <lambent/words.h>

#include "console.h"
#include "environment_option.h"
#include "material_option.h"

static void *field_of(struct options *options, size_t field) { return (char *)options + field; }

static bool wrong(lam_error *error, const char *value, const char *expected)
{
    return complain(error, LAM_BAD_ARGUMENT, "found '%.100s', expected %s", value, expected);
}

bool store_switch(const struct option *option, const char *value, struct options *options, lam_error *error)
{
    (void)value, (void)error;
    *(bool *)field_of(options, option->field) = true;
    return true;
}

bool store_text(const struct option *option, const char *value, struct options *options, lam_error *error)
{
    if (!*value)
        return complain(error, LAM_BAD_ARGUMENT, "the value is empty, expected %s", option->value);
    *(const char **)field_of(options, option->field) = value;
    return true;
}

// Stores the value of --environment or --reflection-map, which replaces the value of the other.
bool store_environment(const struct option *option, const char *value, struct options *options, lam_error *error)
{
    const char *paths[LAM_FACE_COUNT];
    char *copy = strchr(value, ',') ? environment_option_faces(value, paths, error) : NULL;
    free(copy);
    if (!copy && strchr(value, ','))
        return false;
    bool map = strcmp(option->name, "reflection-map") == 0;
    options->shading.reflection_map = map;
    return store_text(option, value, options, error);
}

const char *option_words_list(const struct option *option, char text[OPTION_WORDS_SIZE])
{
    size_t used = 0;
    text[0] = 0;
    for (const struct choice *w = option->words; w->name && used < OPTION_WORDS_SIZE; w++)
        used += (size_t)snprintf(text + used, OPTION_WORDS_SIZE - used, "%s%s",
                                 w == option->words ? ""
                                 : w[1].name        ? ", "
                                                    : " or ",
                                 w->name);
    return text;
}

// Finds the value that corresponds to one of the option's keywords.
static bool read_word(const struct option *option, const char *value, int *found, lam_error *error)
{
    struct suggestion nearest = suggest_start(value);
    for (const struct choice *w = option->words; w->name; w++) {
        if (strcmp(w->name, value) == 0) {
            *found = w->value;
            return true;
        }
        suggest_try(&nearest, w->name);
    }
    char known[OPTION_WORDS_SIZE], guess[64] = "";
    if (nearest.best && nearest.best[0] > '9') // numbers are never treated as mistyped words
        snprintf(guess, sizeof guess, "; did you mean '%s'?", nearest.best);
    return complain(error, LAM_BAD_ARGUMENT, "found '%.100s', expected %s%s", value, option_words_list(option, known),
                    guess);
}

bool store_word(const struct option *option, const char *value, struct options *options, lam_error *error)
{
    if (!read_word(option, value, field_of(options, option->field), error))
        return false;
    if (option->has_field)
        *(bool *)field_of(options, option->has_field) = true;
    return true;
}

bool store_back_faces(const struct option *option, const char *value, struct options *options, lam_error *error)
{
    int one;
    if (!read_word(option, value, &one, error))
        return false;
    options->shading.one_sided = one;
    options->shading.two_sided = !one;
    return true;
}

bool store_word_flag(const struct option *option, const char *value, struct options *options, lam_error *error)
{
    int flag;
    if (!read_word(option, value, &flag, error))
        return false;
    *(bool *)field_of(options, option->field) = flag != 0;
    return true;
}

bool store_ground(const struct option *option, const char *value, struct options *options, lam_error *error)
{
    lam_rgba color;
    options->shading.ground_color = NULL;
    for (const struct choice *w = option->words; w->name; w++)
        if (strcmp(w->name, value) == 0)
            return store_word(option, value, options, error);
    if (!lam_color_parse(value, LAM_COLOR_SRGB, &color, error) || color.a != 1)
        return wrong(error, value, "off, shadow, checker or a colour without alpha");
    options->draw.ground = LAM_GROUND_COLOR;
    options->shading.ground_color = value;
    return true;
}

bool store_words(const struct option *option, const char *value, struct options *options, lam_error *error)
{
    int *field = field_of(options, option->field), all = 0;
    if (option->setting && strcmp(value, "none") == 0) {
        *field = 0;
        return true;
    }
    for (const char *from = value; from; from = strchr(from, ',') ? strchr(from, ',') + 1 : NULL) {
        char name[32];
        snprintf(name, sizeof name, "%.*s", (int)(strcspn(from, ",") < 31 ? strcspn(from, ",") : 31), from);
        if (!store_word(option, name, options, error))
            return false;
        all |= *field;
    }
    *field = all;
    return true;
}

bool store_glsl(const struct option *option, const char *value, struct options *options, lam_error *error)
{
    return store_word(option, strcmp(value, "300 es") == 0 ? "300es" : value, options, error);
}

bool store_up(const struct option *option, const char *value, struct options *options, lam_error *error)
{
    const char *name = lam_up_name(lam_up_find(value));
    return store_word(option, name ? name : value, options, error);
}

double radians(double degrees) { return degrees * (3.14159265358979323846 / 180); }

const char *read_number(const char *text, double *value)
{
    // strtod also accepts spaces, hexadecimal numbers, "inf" and "nan", so only plain decimals are passed to it. strtod
    // rounds correctly, and expects a decimal point, because the program never sets a locale.
    const char *s = text;
    if (*s == '-' || *s == '+')
        s++;
    size_t digits = strspn(s, "0123456789");
    s += digits;
    if (*s == '.') {
        size_t fraction = strspn(++s, "0123456789");
        digits += fraction;
        s += fraction;
    }
    if (!digits)
        return NULL;
    if (*s == 'e' || *s == 'E') {
        const char *exponent = s + 1 + (s[1] == '-' || s[1] == '+');
        size_t exponent_digits = strspn(exponent, "0123456789");
        if (exponent_digits)
            s = exponent + exponent_digits;
    }
    char copy[128];
    if ((size_t)(s - text) >= sizeof copy)
        return NULL;
    memcpy(copy, text, (size_t)(s - text));
    copy[s - text] = 0;
    *value = strtod(copy, NULL);
    return *value - *value == 0 ? s : NULL;
}

static bool number_between(const struct option *option, const char *value, bool whole, double *number, lam_error *error)
{
    const lam_setting *setting = option->setting;
    double min = !setting ? option->min : setting->zero ? 0 : setting->min, max = setting ? setting->max : option->max;
    const char *end = read_number(value, number);
    if (end && !*end && *number >= min && *number <= max && (!whole || *number == (double)(long)*number))
        return true;
    char expected[128];
    int used = snprintf(expected, sizeof expected, "a %snumber from %.10g to %.10g", whole ? "whole " : "", min, max);
    if (end && strcmp(end, "%") == 0 && !whole)
        snprintf(expected + used, sizeof expected - (size_t)used, "; %.40s is %.10g", value, *number / 100);
    return wrong(error, value, expected);
}

bool store_integer(const struct option *option, const char *value, struct options *options, lam_error *error)
{
    double number;
    if (!number_between(option, value, true, &number, error))
        return false;
    *(int *)field_of(options, option->field) = (int)number;
    if (option->has_field)
        *(bool *)field_of(options, option->has_field) = true;
    return true;
}

bool store_number(const struct option *option, const char *value, struct options *options, lam_error *error)
{
    if (!number_between(option, value, false, field_of(options, option->field), error))
        return false;
    if (option->has_field)
        *(bool *)field_of(options, option->has_field) = true;
    return true;
}

bool store_float(const struct option *option, const char *value, struct options *options, lam_error *error)
{
    double number;
    if (!number_between(option, value, false, &number, error))
        return false;
    *(float *)field_of(options, option->field) = (float)number;
    return true;
}

// Converts degrees to radians.
bool store_angle(const struct option *option, const char *value, struct options *options, lam_error *error)
{
    float *angle = field_of(options, option->field);
    if (!store_float(option, value, options, error))
        return false;
    *angle = (float)radians((double)*angle);
    return true;
}

// A cutoff of 0 is valid and skips no light.
bool store_cutoff(const struct option *option, const char *value, struct options *options, lam_error *error)
{
    float *share = field_of(options, option->field);
    if (!store_float(option, value, options, error))
        return false;
    *share = *share > 0 ? *share : -1;
    return true;
}

// Parses "auto" or a number of stops.
bool store_exposure(const struct option *option, const char *value, struct options *options, lam_error *error)
{
    bool fitted = strcmp(value, "auto") == 0;
    double stops;
    if (!fitted && !read_number(value, &stops))
        return wrong(error, value, "auto, or stops from -100 to 100");
    if (!fitted && !number_between(option, value, false, &options->picture.exposure, error))
        return false;
    options->picture.exposure_kind = fitted ? EXPOSURE_AUTO : EXPOSURE_LITERAL;
    return true;
}

// Parses "800" or "1920x1080" and sets `end` to the rest of the text.
static bool read_size(const char *value, long max, int size[2], char **end)
{
    *end = (char *)(uintptr_t)value;
    long width = *value >= '0' && *value <= '9' ? strtol(value, end, 10) : 0;
    long height = width;
    if (*end > value && (**end == 'x' || **end == 'X') && (*end)[1] >= '0' && (*end)[1] <= '9')
        height = strtol(*end + 1, end, 10);
    bool ok = width >= 1 && height >= 1 && width <= max && height <= max;
    size[0] = ok ? (int)width : 0;
    size[1] = ok ? (int)height : 0;
    return ok;
}

bool store_size(const struct option *option, const char *value, struct options *options, lam_error *error)
{
    int size[2];
    char *end;
    if (!read_size(value, (long)option->max, size, &end) || *end)
        return wrong(error, value, "W or WxH from 1 to 65535 pixels, such as 800 or 1920x1080");
    options->picture.has_size = true;
    options->picture.width = size[0];
    options->picture.height = size[1];
    return true;
}

// Parses "1024,256x128".
bool store_sizes(const struct option *option, const char *value, struct options *options, lam_error *error)
{
    options->batch.size_count = 0;
    for (const char *at = value;;) {
        char *end;
        int *size = options->batch.sizes[options->batch.size_count];
        if (options->batch.size_count == SIZES_MAX || !read_size(at, (long)option->max, size, &end) ||
            (*end && *end != ','))
            return wrong(error, value, "at most 16 sizes, W or WxH from 1 to 65535 pixels, such as 1024,256x128");
        for (int i = 0; i < options->batch.size_count; i++)
            if (options->batch.sizes[i][0] == size[0] && options->batch.sizes[i][1] == size[1])
                return complain(error, LAM_BAD_ARGUMENT, "'%.100s' has a size twice", value);
        options->batch.size_count++;
        if (!*end)
            return true;
        at = end + 1;
    }
}

// Returns whether an item of a list separated by commas is in the list twice.
static bool has_twice(const char *value)
{
    for (const char *a = value; a; a = strchr(a, ',') ? strchr(a, ',') + 1 : NULL)
        for (const char *b = value; b < a; b = strchr(b, ',') + 1)
            if (strcspn(a, ",") == strcspn(b, ",") && strncmp(a, b, strcspn(a, ",")) == 0)
                return true;
    return false;
}

// Parses "front,left,iso", "24" or "ring:8@30".
bool store_views(const struct option *option, const char *value, struct options *options, lam_error *error)
{
    (void)option;
    int count = lam_views_parse(value, -1, NULL, NULL, error);
    if (count < 0)
        return false;
    if (has_twice(value))
        return complain(error, LAM_BAD_ARGUMENT, "'%.100s' has a side twice", value);
    options->batch.views = value;
    options->batch.view_count = count;
    options->batch.by_azimuth = false;
    return true;
}

// Parses "0,90,180".
bool store_azimuths(const struct option *option, const char *value, struct options *options, lam_error *error)
{
    int count = 0;
    for (const char *at = value;; at++) {
        double degrees;
        const char *end = read_number(at, &degrees);
        if (!end || (*end && *end != ',') || degrees < option->min || degrees > option->max)
            return wrong(error, value, "degrees from -3600 to 3600, separated by commas, such as 0,90,180");
        count++;
        at = end;
        if (!*at)
            break;
    }
    if (has_twice(value))
        return complain(error, LAM_BAD_ARGUMENT, "'%.100s' has an angle twice", value);
    options->batch.views = value;
    options->batch.view_count = count;
    options->batch.by_azimuth = true;
    return true;
}

bool store_cameras(const struct option *option, const char *value, struct options *options, lam_error *error)
{
    options->batch.view_count = 2;
    return store_text(option, value, options, error);
}

// Parses "64" or "64x32".
bool store_segments(const struct option *option, const char *value, struct options *options, lam_error *error)
{
    char *end = (char *)(uintptr_t)value;
    long slices = *value >= '0' && *value <= '9' ? strtol(value, &end, 10) : 0, stacks = 0;
    bool both = end > value && *end == 'x' && end[1] >= '0' && end[1] <= '9';
    if (both)
        stacks = strtol(end + 1, &end, 10);
    if (*end || slices < 3 || slices > (long)option->max || (both && (stacks < 1 || stacks > (long)option->max)))
        return wrong(error, value, "N or NxM (slices from 3, stacks from 1, both up to 16384), such as 64x32");
    options->shading.slices = (int)slices;
    options->shading.stacks = (int)stacks;
    return true;
}

// Parses a number with an optional suffix: k, M, G, T (powers of 1000) or Ki, Mi, Gi, Ti (powers of 1024). Returns the
// rest of the text, or NULL if the text does not start with a number.
static const char *read_multiple(const char *value, double *out)
{
    double number;
    const char *rest = read_number(value, &number);
    const char *letters = "kMGT", *letter = rest && *rest ? strchr(letters, *rest == 'K' ? 'k' : *rest) : NULL;
    if (letter) {
        bool binary = rest[1] == 'i';
        for (int i = 0; i <= letter - letters; i++)
            number *= binary ? 1024 : 1000;
        rest += binary ? 2 : 1;
    }
    *out = rest ? number : 0;
    return rest;
}

// Parses "500M", or "none", which is valid only for the time and memory limits.
bool store_bytes(const struct option *option, const char *value, struct options *options, lam_error *error)
{
    double number;
    uint64_t *out = field_of(options, option->field);
    bool may_be_none = option->single == TAKES_MEMORY;
    const char *rest = read_multiple(value, &number);
    if (may_be_none && strcmp(value, "none") == 0) {
        *out = UINT64_MAX;
        return true;
    }
    if (rest && *rest == 'B')
        rest++;
    if (!rest || *rest || !(number >= 1 && number <= 1e18))
        return wrong(error, value, may_be_none ? "bytes, such as 500M or 2Gi, or none" : "bytes, such as 500M or 2Gi");
    *out = (uint64_t)number;
    return true;
}

bool store_count(const struct option *option, const char *value, struct options *options, lam_error *error)
{
    double number;
    const char *rest = read_multiple(value, &number);
    if (!rest || *rest || !(number >= 1 && number <= option->max)) {
        char expected[80];
        snprintf(expected, sizeof expected, "a number from 1 to %.0f, such as 5000 or 20M", option->max);
        return wrong(error, value, expected);
    }
    *(uint64_t *)field_of(options, option->field) = (uint64_t)number;
    return true;
}

bool store_seconds(const struct option *option, const char *value, struct options *options, lam_error *error)
{
    if (strcmp(value, "none") != 0)
        return store_number(option, value, options, error);
    *(double *)field_of(options, option->field) = (double)INFINITY;
    return true;
}

bool background_environment(const char *text, float *blur)
{
    static const char word[] = "environment";
    const size_t length = sizeof word - 1;
    double number = 0;
    const char *end = text + length;
    if (strncmp(text, word, length) != 0 || (*end == ':' && !(end = read_number(end + 1, &number))) || *end ||
        !(number >= 0 && number <= 1))
        return false;
    *blur = number > 0.045 ? (float)number : 0.045f; // a field of 0 means no environment
    return true;
}

bool store_color(const struct option *option, const char *value, struct options *options, lam_error *error)
{
    lam_rgba color;
    float blur;
    bool around = option->field == offsetof(struct options, picture.background);
    if (around && strncmp(value, "environment", 11) == 0 && !background_environment(value, &blur))
        return complain(error, LAM_BAD_ARGUMENT, "found '%.60s', expected environment or environment:BLUR from 0 to 1",
                        value);
    if (!(around && background_environment(value, &blur)) && !lam_color_parse(value, LAM_COLOR_SRGB, &color, error))
        return false;
    *(const char **)field_of(options, option->field) = value;
    return true;
}

// Parses "0.5" for all three channels, or "r/g/b".
bool store_reflectivity(const struct option *option, const char *value, struct options *options, lam_error *error)
{
    double numbers[3];
    const char *at = value;
    int count = 0;
    while (at && count < 3 && (at = read_number(at, &numbers[count])) && numbers[count] >= 0 &&
           numbers[count] <= option->max) {
        count++;
        if (*at != '/')
            break;
        at++;
    }
    if (!at || *at || (count != 1 && count != 3))
        return wrong(error, value, "a number or r/g/b, from 0 to 1000");
    for (int i = count; i < 3; i++)
        numbers[i] = numbers[0];
    *(lam_rgb *)field_of(options, option->field) = (lam_rgb){(float)numbers[0], (float)numbers[1], (float)numbers[2]};
    *(bool *)field_of(options, option->has_field) = true;
    return true;
}

bool store_camera(const struct option *option, const char *value, struct options *options, lam_error *error)
{
    lam_camera camera;
    if (strncmp(value, "fovy=", 5) == 0 && !strchr(value, ',')) { // changes only the fitted camera's field of view
        options->view.camera = NULL;
        return number_between(option, value + 5, false, &options->view.fov_deg, error);
    }
    // A text without '=' names a camera in a file that has not been read yet.
    if (strchr(value, '=') && !lam_camera_parse(value, NULL, &camera, error))
        return false;
    *(const char **)field_of(options, option->field) = value;
    return true;
}

static bool append(const struct option *option, const char *value, struct options *options, lam_error *error)
{
    struct texts *texts = field_of(options, option->field);
    const char **items = realloc(texts->items, ((size_t)texts->count + 1) * sizeof *items);
    if (!items)
        return complain(error, LAM_MACHINE, "out of memory");
    items[texts->count++] = value;
    texts->items = items;
    return true;
}

bool store_list(const struct option *option, const char *value, struct options *options, lam_error *error)
{
    return *value ? append(option, value, options, error)
                  : complain(error, LAM_BAD_ARGUMENT, "the value is empty, expected a file with a list of names");
}

// Accepts "-" or a file. Rejects numbers, because other programs interpret a number as the number of parallel jobs.
bool store_jobs(const struct option *option, const char *value, struct options *options, lam_error *error)
{
    if (*value && strspn(value, "0123456789") == strlen(value))
        return complain(
            error, LAM_BAD_ARGUMENT,
            "found '%.20s', expected - (standard input) or a file; -j %.20s sets the number of models drawn at once",
            value, value);
    return store_text(option, value, options, error);
}

bool store_pictures(const struct option *option, const char *value, struct options *options, lam_error *error)
{
    const size_t length = strlen(value);
    if ((length < 5 || strcasecmp(value + length - 4, ".csv") != 0) &&
        (length < 7 || strcasecmp(value + length - 6, ".jsonl") != 0))
        return complain(error, LAM_BAD_ARGUMENT,
                        "found '%.200s', expected a list of pictures, FILE.csv or FILE.jsonl; for a list of names give "
                        "@FILE as a model",
                        value);
    options->batch.is_list = true;
    return store_text(option, value, options, error);
}

bool store_light(const struct option *option, const char *value, struct options *options, lam_error *error)
{
    bool ok = strcmp(value, "none") == 0 || lam_scene_add_light_text(NULL, value + (*value == '+'), NULL, error) == 0;
    return ok && append(option, value, options, error);
}

bool store_material(const struct option *option, const char *value, struct options *options, lam_error *error)
{
    struct material_option material;
    return material_option_parse(value, LAM_COLOR_SRGB, &material, error) && append(option, value, options, error);
}

bool rotation_parse(const char *text, lam_vec3 *axis, double *angle_deg)
{
    if (!(text[0] >= 'x' && text[0] <= 'z') || text[1] != ':')
        return false;
    *axis = (lam_vec3){text[0] == 'x', text[0] == 'y', text[0] == 'z'};
    text = read_number(text + 2, angle_deg);
    return text && !*text && *angle_deg >= -1e6 && *angle_deg <= 1e6;
}

// Accepts an existing file or folder.
bool store_path(const struct option *option, const char *value, struct options *options, lam_error *error)
{
    if (access(value, F_OK) != 0)
        return wrong(error, value, "a folder or file that exists");
    return append(option, value, options, error);
}

bool store_rotation(const struct option *option, const char *value, struct options *options, lam_error *error)
{
    lam_vec3 axis;
    double angle_deg;
    if (!rotation_parse(value, &axis, &angle_deg))
        return wrong(error, value, "an axis and degrees, such as y:30 (up to a million degrees)");
    return append(option, value, options, error);
}

bool store_explode(const struct option *option, const char *value, struct options *options, lam_error *error)
{
    lam_vec3 *by = field_of(options, option->field);
    const char axis = *value >= 'x' && *value <= 'z' && value[1] == '=' ? *value : 0;
    double factor;
    const char *end = read_number(axis ? value + 2 : value, &factor);
    if (!end || *end || !(factor >= 0 && factor <= 1000))
        return wrong(error, value, "a factor from 0 to 1000, such as 0.5, or along one axis z=0.5");
    *by = (lam_vec3){!axis || axis == 'x' ? factor : 0, !axis || axis == 'y' ? factor : 0,
                     !axis || axis == 'z' ? factor : 0};
    return true;
}

bool store_section(const struct option *option, const char *value, struct options *options, lam_error *error)
{
    lam_section section;
    const struct texts *list = field_of(options, option->field);
    if (strcmp(value, "none") != 0 && !lam_section_parse(value, LAM_COLOR_SRGB, &section, error))
        return false;
    if (list->count == LAM_SECTIONS_MAX)
        return wrong(error, value, "at most 8 sections");
    return append(option, value, options, error);
}

bool store_texts(const struct option *option, const char *value, struct options *options, lam_error *error)
{
    return append(option, value, options, error);
}

bool store_across(const struct option *option, const char *value, struct options *options, lam_error *error)
{
    if (options->sheet.across.count == ACROSS_MAX)
        return complain(error, LAM_BAD_ARGUMENT, "given a third time: a grid has only rows and columns");
    return append(option, value, options, error);
}

bool store_opaque_color(const struct option *option, const char *value, struct options *options, lam_error *error)
{
    lam_rgba color;
    if (!lam_color_parse(value, LAM_COLOR_SRGB, &color, error))
        return false;
    if (color.a != 1)
        return complain(error, LAM_BAD_ARGUMENT, "found '%.60s', expected a colour without alpha", value);
    *(const char **)field_of(options, option->field) = value;
    return true;
}
