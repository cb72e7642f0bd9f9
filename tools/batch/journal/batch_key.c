// batch_key.c: computes the hash of everything that determines a picture.
#include "journal.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "console.h"
#include "environment_option.h"
#include "json.h"
#include "xxh64.h"

static bool is_in(const char *const *names, const char *name)
{
    while (*names && strcmp(*names, name) != 0)
        names++;
    return *names;
}

static bool is_texts(const struct option *option)
{
    return option->store == store_light || option->store == store_material || option->store == store_rotation;
}

static bool is_integer(const struct option *option)
{
    return option->store == store_word || option->store == store_words || option->store == store_up ||
           option->store == store_integer;
}

static void print_number(FILE *out, double value)
{
    char text[32];
    shortest_number(value, text);
    fputs(text, out);
}

// Prints the name of an option's value or, if the value has no name, its number.
static void print_word(FILE *out, const struct option *option, int value)
{
    const struct choice *choice = option->words;
    while (choice && choice->name && choice->value != value)
        choice++;
    if (choice && choice->name)
        fputs(choice->name, out);
    else
        fprintf(out, "%d", value);
}

static void print_value(FILE *out, const struct option *option, const struct options *o)
{
    const void *field = (const char *)o + option->field;
    const lam_rgb *color = field;
    if (option->store == store_switch || option->store == store_word_flag)
        fputs(*(const bool *)field ? "on" : "off", out);
    else if (is_integer(option))
        print_word(out, option, *(const int *)field);
    else if (option->store == store_number)
        print_number(out, *(const double *)field);
    else if (option->store == store_float || option->store == store_cutoff)
        fprintf(out, "%.9g", (double)*(const float *)field);
    else if (option->store == store_exposure)
        fprintf(out, "%d/%.17g", o->picture.exposure_kind, o->picture.exposure);
    else if (option->store == store_segments)
        fprintf(out, "%dx%d", o->shading.slices, o->shading.stacks);
    else if (option->store == store_reflectivity)
        fprintf(out, "%.9g/%.9g/%.9g", (double)color->r, (double)color->g, (double)color->b);
    else if (is_texts(option))
        for (int i = 0; i < ((const struct texts *)field)->count; i++)
            fprintf(out, "%s%s", i ? " | " : "", ((const struct texts *)field)->items[i]);
    else if (o->values[option - option_table]) // for all other options, the text of the value is used
        fputs(o->values[option - option_table], out);
}

// Prints the names and the hashes of the environment's files, which are read once for all models. Omits the files'
// folder, because the picture does not depend on the spelling of the folder.
static bool print_environment(FILE *out, const struct options *o, lam_error *error)
{
    const char *paths[LAM_FACE_COUNT] = {o->shading.environment};
    if (!o->shading.environment || environment_option_built_in(o->shading.environment)) {
        fputs(o->shading.environment ? o->shading.environment : "", out);
        return true;
    }
    char *names =
        strchr(o->shading.environment, ',') ? environment_option_faces(o->shading.environment, paths, error) : NULL;
    if (!names && strchr(o->shading.environment, ','))
        return false;
    bool ok = true;
    for (int i = 0; ok && i < (names ? LAM_FACE_COUNT : 1); i++) {
        uint64_t hash;
        char text[XXH64_TEXT];
        ok = xxh64_file(paths[i], &hash) ||
             complain(error, LAM_CANNOT_READ, "%s: cannot open: %s", paths[i], strerror(errno));
        if (ok) {
            xxh64_print(hash, text);
            const char *slash = strrchr(paths[i], '/');
            fprintf(out, "%s%s %s", i ? "," : "", slash ? slash + 1 : paths[i], text);
        }
    }
    free(names);
    return ok;
}

char *batch_options_text(const struct options *o, lam_error *error)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    bool ok = out || complain(error, LAM_MACHINE, "out of memory");
    for (const struct option *option = option_table; ok && option->name; option++) {
        if (!option_is_in(option, IN_KEY) || (option->has_field && option->store != store_switch &&
                                              !*(const bool *)((const char *)o + option->has_field)))
            continue;
        fprintf(out, "%s=", option->name);
        if (option->kind == VALUE_ENVIRONMENT)
            ok = strcmp(option->name, environment_option_name(o)) != 0 || print_environment(out, o, error);
        else
            print_value(out, option, o);
        putc('\n', out);
    }
    if (out && fclose(out) != 0 && ok)
        ok = complain(error, LAM_MACHINE, "out of memory");
    if (ok)
        return text;
    free(text);
    return NULL;
}

// Quotes a word for a shell.
static void put_argument(FILE *out, const char *argument)
{
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_=+,./:@%";
    bool quotes = !*argument || argument[strspn(argument, plain)];
    if (!quotes) {
        fputs(argument, out);
        return;
    }
    putc('\'', out);
    for (; *argument; argument++)
        if (*argument == '\'')
            fputs("'\\''", out);
        else
            putc(*argument == '\n' || *argument == '\r' ? ' ' : *argument, out);
    putc('\'', out);
}

static void put_given(FILE *out, const struct option *option, const struct options *o)
{
    const struct texts *texts = is_texts(option) ? (const struct texts *)((const char *)o + option->field) : NULL;
    const char *value = o->values[option - option_table];
    int count = texts ? texts->count : 1;
    for (int i = 0; i < count; i++) {
        fprintf(out, "%s--%s", ftell(out) ? " " : "", option->name);
        if (texts || value) {
            putc(' ', out);
            put_argument(out, texts ? texts->items[i] : value);
        }
    }
}

char *batch_options_given(const struct options *o)
{
    static const char *const own[] = {"size", "view", "look", NULL};
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    for (const struct option *option = option_table; out && option->name; option++)
        if (o->given[option - option_table] && !o->by_look[option - option_table] &&
            (option_is_in(option, IN_KEY) || is_in(own, option->name)))
            put_given(out, option, o);
    if (out && fclose(out) == 0)
        return text;
    free(text);
    return NULL;
}

// Formats a line `name=value` as `--name value`.
static int typed(const char *line, char *text, size_t size)
{
    int length = (int)strcspn(line, "\n"), name = (int)strcspn(line, "=\n");
    int value = length > name ? length - name - 1 : 0;
    return snprintf(text, size, "--%.*s %.*s", name < 40 ? name : 40, line, value < 80 ? value : 80,
                    line + length - value);
}

void batch_options_difference(const char *then, const char *now, char text[300])
{
    while (*then && *now && strcspn(then, "\n") == strcspn(now, "\n") && memcmp(then, now, strcspn(then, "\n")) == 0) {
        then += strcspn(then, "\n") + (then[strcspn(then, "\n")] == '\n');
        now += strcspn(now, "\n") + (now[strcspn(now, "\n")] == '\n');
    }
    char old[140] = "", new[140] = "";
    typed(then, old, sizeof old);
    typed(now, new, sizeof new);
    snprintf(text, 300, "'%s' in the journal, '%s' now", *then ? old : "nothing", *now ? new : "nothing");
}

uint64_t batch_key(const struct batch_key_parts *p)
{
    struct xxh64 hash;
    char numbers[100];
    xxh64_start(&hash);
    xxh64_add_text(&hash, lam_version());
    xxh64_add_text(&hash, lam_build_info());
    xxh64_add_text(&hash, p->options);
    // An option on the command line overrides the setting in a scene file, so the key includes the names of the typed
    // options.
    for (int i = 0; strcmp(p->format, "scene") == 0 && option_table[i].name; i++)
        if ((p->parsed->given[i] || p->parsed->by_key[i]) && option_is_in(&option_table[i], IN_KEY))
            xxh64_add_text(&hash, option_table[i].name);
    xxh64_add_text(&hash, p->file_count ? NULL : p->model);
    xxh64_add_text(&hash, p->picture);
    const struct job_view *v = p->view;
    const int side = v->given ? (int)lam_side_find(v->name) : p->parsed->view.side;
    if (side < LAM_SIDE_COUNT)
        snprintf(numbers, sizeof numbers, "%d %dx%d", side, v->width, v->height);
    else
        snprintf(numbers, sizeof numbers, "%.17g %.17g %dx%d", v->view.azimuth_rad, v->view.elevation_rad, v->width,
                 v->height);
    xxh64_add_text(&hash, numbers);
    if (*v->show)
        xxh64_add_text(&hash, v->show);
    if (v->camera)
        xxh64_add_text(&hash, v->camera);
    for (int i = 0; i < p->file_count; i++)
        xxh64_add_text(&hash, p->files[i]);
    return xxh64_end(&hash);
}
