// render.c: the main command: each model becomes a picture.
#include "command.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "console.h"
#include "exit_codes.h"
#include "device_option.h"
#include "interrupt.h"
#include "job.h"
#include "limit_options.h"
#include "output.h"
#include "plan.h"
#include "progress.h"
#include "report.h"
#include "sandbox_start.h"

// --- checks of the options together

// Phong shading runs in the fragment stage, Gouraud shading in the vertex stage or the application, flat in any.
static bool check_stage(const struct options *o, lam_error *error)
{
    if (!o->has_shading || !o->draw.stage)
        return true;
    if (o->draw.shading == LAM_SHADING_PHONG && o->draw.stage != LAM_STAGE_FRAGMENT)
        return complain(error, LAM_BAD_ARGUMENT,
                        "phong shading cannot be evaluated in stage %s; phong works with fragment, gouraud with "
                        "application or vertex, flat with all three",
                        o->draw.stage == LAM_STAGE_VERTEX ? "vertex" : "application");
    if (o->draw.shading == LAM_SHADING_GOURAUD && o->draw.stage == LAM_STAGE_FRAGMENT)
        return complain(error, LAM_BAD_ARGUMENT,
                        "gouraud shading cannot be evaluated in stage fragment; gouraud works with application or "
                        "vertex, phong with fragment, flat with all three");
    return true;
}

static bool check_together(int count, char **models, const struct options *o, lam_error *error)
{
    const char *view = o->view            ? "view"
                       : o->has_azimuth   ? "azimuth"
                       : o->has_elevation ? "elevation"
                       : o->zoom > 0      ? "zoom"
                       : o->projection    ? "projection"
                                          : NULL;
    if (o->camera && view)
        return complain(error, LAM_BAD_ARGUMENT, "options '--camera' and '--%s' cannot be used together", view);
    if (o->two_sided && o->one_sided)
        return complain(error, LAM_BAD_ARGUMENT, "options '--two-sided' and '--one-sided' cannot be used together");
    if (!check_stage(o, error))
        return false;
    if (o->quiet && o->verbose)
        return complain(error, LAM_BAD_ARGUMENT, "options '--quiet' and '--verbose' cannot be used together");
    if (output_name_is_pattern(o->output)) {
        if (!output_name_check(o->output, NAME_VIEW | NAME_SIZE, error))
            return false;
    } else if (output_is_named(o->output) && count > 1)
        return complain(error, LAM_BAD_ARGUMENT,
                        "option '--output' names one picture, but there are %d models; "
                        "name a folder, -o pictures/, or a pattern, -o '{stem}-{view}.png'",
                        count);
    if (o->save_scene && count > 1)
        return complain(error, LAM_BAD_ARGUMENT,
                        "option '--save-scene' goes only with a single model, but there are %d", count);
    if (o->save_scene && strcmp(models[0], "-") == 0)
        return complain(error, LAM_BAD_ARGUMENT,
                        "option '--save-scene' needs a model with a name; standard input has none");
    if (o->save_scene && strcmp(o->save_scene, "-") == 0)
        return complain(error, LAM_BAD_ARGUMENT, "option '--save-scene' writes a file, expected its name");
    for (int i = 0; i < count; i++) {
        if (!*models[i])
            return complain(error, LAM_BAD_ARGUMENT, "a model's name is empty");
        if (strcmp(models[i], "-") == 0 && count > 1)
            return complain(error, LAM_BAD_ARGUMENT, "'-' (standard input) goes only with a single model");
        if (strcmp(models[i], "-") == 0 && isatty(STDIN_FILENO))
            return complain(error, LAM_BAD_ARGUMENT,
                            "standard input is a terminal, expected a model: lambent - < FILE");
    }
    if (o->output && strcmp(o->output, "-") == 0 && isatty(STDOUT_FILENO))
        return complain(error, LAM_BAD_ARGUMENT,
                        "standard output is a terminal, and the picture is not text; "
                        "redirect it: lambent MODEL -o - > FILE");
    return true;
}

// The path of the picture, from malloc. NULL: out of memory.
static char *path_of(const struct options *o, const char *model)
{
    struct output_words words = {
        .model = model, .view = lam_side_name((lam_side)o->view), .width = o->width, .height = o->height};
    return output_path_of(o->output, &words);
}

// Sorts models by their output, to find two with the same name.
struct named_output {
    const char *model;
    char *output;
};

static int by_output(const void *a, const void *b)
{
    const struct named_output *x = a, *y = b;
    return strcmp(x->output, y->output);
}

static bool check_names(int count, char **models, const struct options *o, lam_error *error)
{
    struct named_output *named = count > 0 ? calloc((size_t)count, sizeof *named) : NULL;
    bool ok = named != NULL;
    for (int i = 0; ok && i < count; i++) {
        named[i] = (struct named_output){models[i], path_of(o, models[i])};
        ok = named[i].output != NULL;
    }
    if (!ok)
        complain(error, LAM_LIMIT, "out of memory");
    else
        qsort(named, (size_t)count, sizeof *named, by_output);
    for (int i = 1; ok && i < count; i++)
        if (strcmp(named[i].output, named[i - 1].output) == 0)
            ok = complain(error, LAM_BAD_ARGUMENT,
                          "'%s' and '%s' would both be written to '%s'; run them one by one with -o, "
                          "or name a pattern: -o '{dir}-{stem}.png'",
                          named[i - 1].model, named[i].model, named[i].output);
    for (int i = 0; named && i < count; i++)
        free(named[i].output);
    free(named);
    return ok;
}

// --- messages

// Prints each warning once.
static void print_warnings(const struct job *job)
{
    for (int i = 0; job->scene && lam_scene_warning(job->scene, i); i++) {
        const char *text = lam_scene_warning(job->scene, i);
        bool printed = false;
        for (int k = 0; k < i && !printed; k++)
            printed = strcmp(lam_scene_warning(job->scene, k), text) == 0;
        if (!printed)
            say_warning(text);
    }
    if (job->written && !job->times.frame.pixels_covered)
        say_warning("the picture shows no part of the model");
}

// True if a sentence begins with the name, in which it shows control characters as '?'.
static bool names(const char *sentence, const char *name)
{
    for (; *name; name++, sentence++) {
        bool control = (unsigned char)*name < 32 || *name == 127;
        if (*sentence != (control ? '?' : *name))
            return false;
    }
    return *sentence == ':';
}

// Puts the model's name before a sentence of the library that lacks it, and the user's limit in place of the remaining
// one.
static void name_model(const struct job *job, lam_error *error)
{
    const struct options *o = job->options;
    const char *name = strcmp(job->model, "-") == 0 ? "standard input" : job->model;
    if (error->code == LAM_LIMIT && limits_time(o) > 0 && clock_ms() - job->times.start >= limits_time(o) * 1e3) {
        complain(error, LAM_LIMIT, "%s: the time limit of %.10g s was reached (--time-limit)", name, limits_time(o));
    } else if (error->code == LAM_CANCELLED) {
        complain(error, LAM_CANCELLED, "%s: interrupted", name);
    } else if (error->code != LAM_CANNOT_WRITE && !names(error->text, name) &&
               !(job->output && strstr(error->text, job->output) == error->text)) {
        lam_error plain = *error;
        complain(error, plain.code, "%.200s: %.300s", name, plain.text);
    }
}

// Draws one model; returns its exit code.
static int render_one(const char *model, lam_device *device, const struct options *o)
{
    struct job job = {.options = o, .model = model, .device = device};
    job.times.start = clock_ms();
    FILE *stream = report_stream(o);
    bool may_talk = stream != stderr;
    struct progress progress;
    progress_start(&progress, model, console_is_terminal() && !o->quiet && may_talk);
    char *path = path_of(o, model);
    job.output = path;
    lam_error error = {0};
    bool ok = job.output ? job_run(&job, &progress, &error) : complain(&error, LAM_LIMIT, "out of memory");
    job.times.total = clock_ms() - job.times.start;
    progress_end(&progress);
    if (!ok)
        name_model(&job, &error);

    if (!o->quiet && may_talk)
        print_warnings(&job);
    if (!ok && may_talk)
        say_error(error.text);
    if (ok && o->dry_run && !stream && !o->quiet)
        report_plan(&job);
    else if (ok && o->verbose && may_talk && !o->dry_run)
        report_table(&job);
    else if (ok && !o->quiet && !stream && !o->dry_run)
        report_line(&job);
    if (stream)
        report_json(stream, &job, &error);

    lam_image_free(&job.image);
    lam_scene_free(job.scene);
    free(path);
    return exit_code_of(error.code)->code;
}

static bool enter_sandbox(int count, char **models, const struct options *o, lam_error *error)
{
    struct sandbox_paths paths = {0};
    for (int i = 0; i < count; i++)
        sandbox_add_input(&paths, models[i]);
    for (int i = 0; i < count; i++) {
        char *path = path_of(o, models[i]);
        paths.failed |= !path;
        if (path)
            sandbox_add_output(&paths, path);
        free(path);
    }
    return sandbox_start(o, &paths, error);
}

int run_render(int operand_count, char **operands, const struct options *options)
{
    lam_error error = {0};
    if (!check_together(operand_count, operands, options, &error) ||
        !check_names(operand_count, operands, options, &error))
        return report_failure(&error, options);
    interrupt_start();
    lam_device *device =
        enter_sandbox(operand_count, operands, options, &error) ? device_option_make(options, &error) : NULL;
    if (!device)
        return report_failure(&error, options);
    int worst = 0;
    for (int i = 0; i < operand_count && !interrupted(); i++) {
        int code = render_one(operands[i], device, options);
        worst = code > worst ? code : worst;
    }
    lam_device_free(device);
    if (interrupted()) {
        fflush(stdout);
        interrupt_finish();
    }
    return worst;
}
