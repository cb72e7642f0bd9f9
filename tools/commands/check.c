// check.c: the command `check`: compares what shaders draw with the reference scenes.
#include "check.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "command.h"
#include "console.h"
#include "exit_codes.h"
#include "interrupt.h"
#include "output.h"
#include "report.h"
#include "suggest.h"

enum { MAX_TEXT_BYTES = 1 << 20, MAX_SCENES = 32 };
static const size_t max_cache_bytes = (size_t)384 << 20; // of pictures cached for several shaders

// Reads a text file into memory from malloc.
static char *read_text(const char *path, lam_error *error)
{
    bool standard = strcmp(path, "-") == 0;
    FILE *file = standard ? stdin : fopen(path, "rb");
    if (!file) {
        complain(error, LAM_CANNOT_READ, "%s: %s", path, strerror(errno));
        return NULL;
    }
    char *text = malloc(MAX_TEXT_BYTES + 1);
    size_t size = text ? fread(text, 1, MAX_TEXT_BYTES + 1, file) : 0;
    bool bad = ferror(file);
    int reason = errno;
    if (!standard)
        fclose(file);
    if (!text)
        complain(error, LAM_LIMIT, "out of memory");
    else if (bad)
        complain(error, LAM_CANNOT_READ, "%s: %s", path, strerror(reason));
    else if (size > MAX_TEXT_BYTES)
        complain(error, LAM_LIMIT, "%s: the file is larger than %d bytes", path, MAX_TEXT_BYTES);
    else if (memchr(text, 0, size))
        complain(error, LAM_CANNOT_READ, "%s: expected text, found a zero byte", path);
    else {
        text[size] = 0;
        return text;
    }
    free(text);
    return NULL;
}

// The contract of a command line, by its name or from its file. *contract stays NULL for one that is to be recognised.
static bool read_contract(const char *name, lam_check_contract **contract, lam_error *error)
{
    if (!name || strcmp(name, "auto") == 0)
        return true;
    const char *text = lam_check_contract_text(name);
    if (text)
        return (*contract = lam_check_contract_read(text, strlen(text), name, error)) != NULL;
    if (!strpbrk(name, "./")) {
        struct suggestion nearest = suggest_start(name);
        char known[200] = "auto";
        for (int i = 0; lam_check_contract_shipped(i); i++) {
            size_t used = strlen(known);
            snprintf(known + used, sizeof known - used, ", %s", lam_check_contract_shipped(i));
            suggest_try(&nearest, lam_check_contract_shipped(i));
        }
        return complain(error, LAM_BAD_ARGUMENT, "option '--contract': found '%.60s', expected %s or a file%s%s%s",
                        name, known, nearest.best ? "; did you mean '" : "", nearest.best ? nearest.best : "",
                        nearest.best ? "'?" : "");
    }
    char *file = read_text(name, error);
    *contract = file ? lam_check_contract_read(file, strlen(file), name, error) : NULL;
    free(file);
    return *contract != NULL;
}

// State shared by all shaders of a command line.
struct batch {
    const struct options *options;
    const char *scenes[MAX_SCENES];
    int scene_count;
    bool several;
    double tolerance;
    lam_check_contract *contract; // NULL: recognised
    lam_check_cache *cache;       // NULL for a single shader
    int passed;
};

static bool check_output(const struct batch *c, const char *path, const char *shader, lam_error *error)
{
    lam_pixel_format format;
    if (output_is_stream(path))
        return true;
    return output_format(path, &format, error) &&
           (format == LAM_RGBA8 || complain(error, LAM_UNSUPPORTED, "%s: a sheet is written as .png or .ppm", path)) &&
           output_check(path, shader, output_is_named(c->options->output), error);
}

static void print_report(const struct batch *c, const lam_check_report *report, const struct check_pair *pair,
                         const char *sheet)
{
    const struct options *o = c->options;
    FILE *file = sheet && strcmp(sheet, "-") == 0 ? stderr : stdout;
    if (o->json)
        check_report_json(file, report, pair->fragment, pair->vertex, c->tolerance, report->scene_count ? sheet : NULL);
    else if (!o->quiet)
        check_report_text(file, report, pair->fragment, c->tolerance);
    fflush(file); // each shader's report appears as soon as it is done
}

// Checks one shader and prints its report; returns the exit code. A failure is in `error`.
static int check_one(struct batch *c, const struct check_pair *pair, lam_error *error)
{
    const struct options *o = c->options;
    struct check_process process = {.time_limit_s = o->stop_after_s};
    char *fragment = NULL, *vertex = NULL, *sheet = NULL;
    bool ok = !o->output || (sheet = check_sheet_path(o->output, pair->fragment)) ||
              complain(error, LAM_LIMIT, "out of memory");
    ok = ok && (!sheet || check_output(c, sheet, pair->fragment, error)) &&
         (fragment = read_text(pair->fragment, error)) && (!pair->vertex || (vertex = read_text(pair->vertex, error)));
    lam_check_report report = {0};
    if (ok) {
        lam_check_params params = {
            .fragment = fragment,
            .fragment_name = pair->fragment,
            .vertex = vertex,
            .vertex_name = pair->vertex,
            .contract = c->contract,
            .size = o->has_size ? o->width : 0,
            .tolerance = c->tolerance / 255,
            .light_frame = (lam_light_frame)o->light_frame,
            .reflection = (lam_reflection)o->highlight,
            .terms = (unsigned)o->terms,
            .scenes = c->scene_count ? c->scenes : NULL,
            .scene_count = c->scene_count,
            .cache = c->cache,
            .draw = check_process,
            .user = &process,
        };
        ok = lam_check_run(&params, &report, error);
        if (!ok && error->code == LAM_BAD_ARGUMENT && !strstr(error->text, pair->fragment)) {
            char text[sizeof error->text];
            snprintf(text, sizeof text, "%s", error->text);
            complain(error, error->code, "%s: %s", pair->fragment, text);
        }
    }
    if (ok && sheet && report.scene_count)
        ok = check_sheet(&report, pair->fragment, o, sheet, error);
    if (ok)
        print_report(c, &report, pair, sheet);
    int code = !ok ? exit_code_of(error->code)->code : report.verdict == LAM_CHECK_PASSES ? 0 : EXIT_DIFFERS;
    c->passed += code == 0;
    lam_check_report_free(&report);
    free(fragment);
    free(vertex);
    free(sheet);
    return code;
}

static bool prepare(struct batch *c, int pair_count, const struct check_pair *pairs, lam_error *error)
{
    const struct options *o = c->options;
    if (!pair_count)
        return complain(error, LAM_BAD_ARGUMENT,
                        "check: no shader given, expected the file of a fragment shader, or --list");
    for (int i = 0; c->several && i < pair_count; i++)
        if (strcmp(pairs[i].fragment, "-") == 0)
            return complain(error, LAM_BAD_ARGUMENT, "'-' (standard input) is possible only for a single shader");
    if (o->has_size && o->width != o->height)
        return complain(error, LAM_BAD_ARGUMENT, "check: pictures are square, found %dx%d", o->width, o->height);
    if (o->output && c->several && output_is_named(o->output))
        return complain(error, LAM_BAD_ARGUMENT,
                        "option '--output' names one sheet for %d shaders; name a folder: -o sheets/", pair_count);
    if (!read_contract(o->contract, &c->contract, error))
        return false;
    return !c->several || (c->cache = lam_check_cache_make(max_cache_bytes, error));
}

// Splits "all,gate" into its names, inside `list`.
static void split(struct batch *c, char *list)
{
    for (char *word = list ? strtok(list, ",") : NULL; word && c->scene_count < MAX_SCENES; word = strtok(NULL, ","))
        c->scenes[c->scene_count++] = word;
}

// An error in one shader is printed and the others are still checked. Returns the highest exit code.
static int check_all(struct batch *c, int count, const struct check_pair *pairs)
{
    int code = 0;
    for (int i = 0; i < count && !interrupted(); i++) {
        lam_error error = {0};
        int mine = check_one(c, &pairs[i], &error);
        if (error.code && !interrupted()) {
            say_error(error.text);
            if (c->options->json)
                check_report_error_json(stdout, pairs[i].fragment, pairs[i].vertex, &error);
        }
        code = mine > code ? mine : code;
    }
    if (!c->options->json && !c->options->quiet && !interrupted())
        printf("%d of %d pass\n", c->passed, count);
    return code;
}

int run_check(int operand_count, char **operands, const struct options *o)
{
    lam_error error = {0};
    if (o->list)
        return check_print_lists(stdout, &error) ? 0 : report_failure(&error, o);
    interrupt_start();
    struct batch c = {.options = o, .tolerance = option_given(o, "tolerance") ? o->tolerance : 2};
    struct check_pair *pairs = calloc((size_t)operand_count + 1, sizeof *pairs);
    char *scenes = o->scenes ? strdup(o->scenes) : NULL;
    split(&c, scenes);
    int count = pairs ? check_pair(operand_count, operands, o->vertex, pairs, &error) : -1, code = 0;
    c.several = count > 1;
    if (!pairs)
        complain(&error, LAM_LIMIT, "out of memory");
    else if (count >= 0 && prepare(&c, count, pairs, &error))
        code = c.several ? check_all(&c, count, pairs) : check_one(&c, pairs, &error);
    lam_check_cache_free(c.cache);
    lam_check_contract_free(c.contract);
    free(pairs);
    free(scenes);
    if (interrupted())
        interrupt_finish();
    return error.code ? report_failure(&error, o) : code;
}
