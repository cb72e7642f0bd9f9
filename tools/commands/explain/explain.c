// explain.c: the command `explain`: every number of one pixel, from its triangles to its bytes.
#include "explain.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "command.h"
#include "console.h"
#include "device_option.h"
#include "interrupt.h"
#include "job.h"
#include "report.h"
#include "sandbox_start.h"

// Reads digits up to the character `end`; returns the text after it, NULL if there are no digits or too many.
static const char *read_pixel_number(const char *text, char end, int *value)
{
    const char *start = text;
    for (*value = 0; *text >= '0' && *text <= '9' && text - start < 6; text++)
        *value = *value * 10 + (*text - '0');
    return text > start && *text == end ? text + 1 : NULL;
}

static bool read_pixel(const char *text, const struct options *o, int *x, int *y, lam_error *error)
{
    const char *rest = read_pixel_number(text, ',', x);
    if (!rest || !read_pixel_number(rest, 0, y))
        return complain(error, LAM_BAD_ARGUMENT,
                        "explain: found '%.60s', expected a pixel X,Y, counted from the picture's top left corner, "
                        "such as %d,%d",
                        text, o->width / 2, o->height / 2);
    if (*x >= o->width || *y >= o->height)
        return complain(error, LAM_BAD_ARGUMENT,
                        "explain: pixel %d,%d lies outside the picture of %dx%d pixels, expected 0,0 to %d,%d", *x, *y,
                        o->width, o->height, o->width - 1, o->height - 1);
    return true;
}

static int report_job_failure(const struct job *job, lam_error *error)
{
    if (!strstr(error->text, job->model) && error->code != LAM_BAD_ARGUMENT) {
        lam_error plain = *error;
        complain(error, plain.code, "%.200s: %.300s", job->model, plain.text);
    }
    return report_failure(error, job->options);
}

int run_explain(int operand_count, char **operands, const struct options *given)
{
    (void)operand_count;
    struct options options = *given;
    options.output = NULL; // --output has no effect
    struct job job = {.options = &options, .model = operands[0]};
    int x = 0, y = 0;
    lam_error error = {0};
    if (!*job.model)
        complain(&error, LAM_BAD_ARGUMENT, "a model's name is empty");
    else if (strcmp(job.model, "-") == 0 && isatty(STDIN_FILENO))
        complain(&error, LAM_BAD_ARGUMENT,
                 "standard input is a terminal, expected a model: lambent explain - X,Y < FILE");
    else if (options.dry_run)
        complain(&error, LAM_BAD_ARGUMENT, "option '--dry-run' has no effect on explain, which writes nothing");
    else if (options.show)
        complain(&error, LAM_BAD_ARGUMENT,
                 "option '--show' has no effect on explain, which prints all terms of a pixel");
    else
        read_pixel(operands[1], &options, &x, &y, &error);
    if (error.code)
        return report_failure(&error, &options);
    interrupt_start();
    struct sandbox_paths paths = {0};
    sandbox_add_input(&paths, job.model);
    job.device = sandbox_start(&options, &paths, &error) ? device_option_make(&options, &error) : NULL;
    if (!job.device)
        return report_failure(&error, &options);
    job.times.start = clock_ms();
    struct progress progress;
    progress_start(&progress, job.model, console_is_terminal() && !options.quiet);
    lam_explanation *explanation = job_explain(&job, x, y, &progress, &error);
    progress_end(&progress);
    int code = 0;
    if (!explanation)
        code = report_job_failure(&job, &error);
    else if (options.json)
        explain_json(explanation, job.model);
    else
        explain_text(explanation, job.model);
    lam_explanation_free(explanation);
    lam_scene_free(job.scene);
    lam_device_free(job.device);
    if (interrupted()) {
        fflush(stdout);
        interrupt_finish();
    }
    return code;
}
