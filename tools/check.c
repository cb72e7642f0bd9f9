// check.c: the command `check`: a shader against the reference scenes.
#include "check.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "command.h"
#include "console.h"
#include "interrupt.h"
#include "output.h"
#include "report.h"

enum { EXIT_DIFFERS = 6, TEXT_MOST = 1 << 20, SCENES_MOST = 32 };

// A text file as a string, from malloc.
static char *read_text(const char *path, lam_error *error)
{
    bool standard = strcmp(path, "-") == 0;
    FILE *file = standard ? stdin : fopen(path, "rb");
    if (!file) {
        complain(error, LAM_CANNOT_READ, "%s: %s", path, strerror(errno));
        return NULL;
    }
    char *text = malloc(TEXT_MOST + 1);
    size_t size = text ? fread(text, 1, TEXT_MOST + 1, file) : 0;
    bool bad = ferror(file);
    int reason = errno;
    if (!standard)
        fclose(file);
    if (!text)
        complain(error, LAM_LIMIT, "out of memory");
    else if (bad)
        complain(error, LAM_CANNOT_READ, "%s: %s", path, strerror(reason));
    else if (size > TEXT_MOST)
        complain(error, LAM_LIMIT, "%s: a shader of more than %d bytes", path, TEXT_MOST);
    else if (memchr(text, 0, size))
        complain(error, LAM_CANNOT_READ, "%s: holds a zero byte, expected the text of a shader", path);
    else {
        text[size] = 0;
        return text;
    }
    free(text);
    return NULL;
}

// "all,gate" into its names; cuts `list`.
static int split(char *list, const char *names[SCENES_MOST])
{
    int count = 0;
    for (char *word = strtok(list, ","); word && count < SCENES_MOST; word = strtok(NULL, ","))
        names[count++] = word;
    return count;
}

static bool check_output(const struct options *o, const char *shader, lam_error *error)
{
    lam_pixel_format format = LAM_RGBA8;
    if (!o->output)
        return true;
    if (!output_is_named(o->output))
        return complain(error, LAM_BAD_ARGUMENT, "option '--output' names the folder '%s', expected a file",
                        o->output);
    if (output_is_stream(o->output))
        return true;
    return lam_image_format_for(o->output, &format, error) &&
           (format == LAM_RGBA8 ||
            complain(error, LAM_UNSUPPORTED, "%s: a sheet is written as .png or .ppm", o->output)) &&
           output_check(o->output, shader, true, error);
}

static int tell(const struct options *o, const lam_check_report *report, const char *shader, double tolerance)
{
    FILE *file = o->output && strcmp(o->output, "-") == 0 ? stderr : stdout;
    if (o->json)
        check_tell_json(file, report, shader, o->vertex, tolerance, report->scene_count ? o->output : NULL);
    else if (!o->quiet)
        check_tell_text(file, report, shader, tolerance);
    return report->verdict == LAM_CHECK_PASSES ? 0 : EXIT_DIFFERS;
}

int run_check(int operand_count, char **operands, const struct options *o)
{
    if (o->list) {
        check_tell_lists(stdout);
        return 0;
    }
    interrupt_start();
    lam_error error = {0};
    const char *shader = operand_count ? operands[0] : NULL, *names[SCENES_MOST];
    double tolerance = option_given(o, "tolerance") ? o->tolerance : 2;
    struct check_process process = {.time_limit_s = o->stop_after_s};
    char *fragment = NULL, *vertex = NULL, *scenes = o->scenes ? strdup(o->scenes) : NULL;
    bool ok =
        shader || complain(&error, LAM_BAD_ARGUMENT,
                           "check: no shader is given, expected a file with a fragment shader, or --list");
    ok = ok && check_output(o, shader, &error) && (fragment = read_text(shader, &error)) &&
         (!o->vertex || (vertex = read_text(o->vertex, &error)));
    lam_check_report report = {0};
    if (ok) {
        lam_check_params params = {
            .fragment = fragment,
            .fragment_name = shader,
            .vertex = vertex,
            .vertex_name = o->vertex,
            .contract = (lam_check_contract)o->contract,
            .size = o->has_size ? o->width : 0,
            .tolerance = tolerance / 255,
            .light_frame = (lam_light_frame)o->light_frame,
            .reflection = (lam_reflection)o->highlight,
            .scenes = scenes ? names : NULL,
            .scene_count = scenes ? split(scenes, names) : 0,
            .draw = check_process,
            .user = &process,
        };
        ok = (!o->has_size || o->width == o->height ||
              complain(&error, LAM_BAD_ARGUMENT, "check: pictures are square, found %dx%d", o->width,
                       o->height)) &&
             lam_check_run(&params, &report, &error);
    }
    int code = 0;
    if (ok && o->output && report.scene_count)
        ok = check_sheet(&report, shader, o, &error);
    if (ok)
        code = tell(o, &report, shader, tolerance);
    lam_check_report_free(&report);
    free(fragment);
    free(vertex);
    free(scenes);
    if (interrupted())
        interrupt_finish();
    return ok ? code : tell_failure(&error, o);
}
