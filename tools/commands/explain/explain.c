// explain.c: the command `explain`: prints every value in the computation of one pixel, from its triangles to its
// bytes. With -o, it also draws a figure.
#include "explain.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "classroom.h"
#include "command.h"
#include "console.h"
#include "limit_options.h"
#include "drawing.h"
#include "explain_json.h"
#include "interrupt.h"
#include "job_steps.h"
#include "output.h"
#include "report.h"
#include "sandbox_start.h"
#include "terminal.h"

// Reads digits up to the character `end`. Returns the text after `end`, or NULL if there are no digits or too many
// digits.
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
                        text, o->picture.width / 2, o->picture.height / 2);
    if (*x >= o->picture.width || *y >= o->picture.height)
        return complain(error, LAM_BAD_ARGUMENT,
                        "explain: pixel %d,%d is outside the picture of %dx%d pixels, expected 0,0 to %d,%d", *x, *y,
                        o->picture.width, o->picture.height, o->picture.width - 1, o->picture.height - 1);
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

// --- the figure

// Returns the path of the figure, or NULL if none is requested. Sets `*failed` if memory runs out.
static char *figure_path(const struct options *o, const char *model, bool *failed)
{
    *failed = false;
    if (!o->picture.output && !terminal_shows())
        return NULL;
    char *path = output_path(o->picture.output ? o->picture.output : "-", model, "-explained.svg");
    *failed = !path;
    return path;
}

static bool check_figure(const char *path, const struct options *o, const char *model, lam_error *error)
{
    bool to_stdout = strcmp(path, "-") == 0;
    if (to_stdout && isatty(STDOUT_FILENO) && !terminal_shows())
        return terminal_refuse("explain MODEL X,Y", error);
    if (to_stdout && o->report.json)
        return complain(error, LAM_BAD_ARGUMENT, "options '--json' and '-o -' both write to standard output");
    if (!drawing_is_svg(path) && o->captions.title && !o->captions.no_captions &&
        !drawing_check_text("title", o->captions.title, o->captions.font != NULL, error))
        return false;
    if (!to_stdout && !drawing_is_svg(path) && !output_check_bytes(path, "figure", ".svg, ", error))
        return false;
    return to_stdout || output_check(path, model, output_given(o->picture.output), error);
}

// Draws the picture that contains the explained pixel.
static bool draw_picture(struct job *job, struct progress *progress, lam_error *error)
{
    lam_frame_report report;
    return job_make_image(job, LAM_RGBA8, error) && job_draw_frames(job, 0.75, 0.25, 1, &report, progress, error);
}

// Makes the request for a figure: a line of JSON about the page, the line of --json, and the pixels of the picture.
static bool make_request(const struct job *job, const lam_explanation *e, bool svg, lam_bytes *request,
                         lam_error *error)
{
    char *text = NULL;
    size_t size = 0;
    FILE *file = open_memstream(&text, &size);
    struct json json = {.file = file};
    if (!file)
        return complain(error, LAM_MACHINE, "out of memory");
    json_put(&json, OBJECT(NULL, FLAG("svg", svg), NUMBER("figure", job->options->captions.figure),
                           NUMBER("fovy_rad", job->camera.fovy_rad),
                           NUMBER("ortho_half_height", job->camera.ortho_half_height), NUMBER("fx", job->camera.fx),
                           NUMBER("fy", job->camera.fy), NUMBER("cx", job->camera.cx), NUMBER("cy", job->camera.cy)));
    putc('\n', file);
    explain_json(file, e, job);
    fwrite(job->image.pixels, 4, (size_t)job->image.width * (size_t)job->image.height, file);
    bool failed = ferror(file);
    failed |= fclose(file) != 0;
    *request = (lam_bytes){text, size};
    return !failed || complain(error, LAM_MACHINE, "out of memory");
}

static bool write_figure(struct job *job, const lam_explanation *e, const char *path, struct child *classroom,
                         lam_error *error)
{
    const struct options *o = job->options;
    const lam_save_params params = {
        .compress = (lam_compress)o->picture.compress, .quality = o->picture.quality, .durable = o->picture.durable};
    lam_bytes request = {0}, page = {0};
    int size[2];
    bool ok = make_request(job, e, drawing_is_svg(path), &request, error) &&
              classroom_ask(classroom, o, &request, &page, error) &&
              drawing_write_packed(&page, size, path, &params, error);
    if (ok && strcmp(path, "-") != 0 && !o->report.quiet)
        say_plain("%s  %dx%d\n", path, size[0], size[1]);
    lam_bytes_free(&request);
    lam_bytes_free(&page);
    return ok;
}

// --- the command

static void print(const lam_explanation *explanation, const struct job *job)
{
    if (job->options->report.json)
        explain_json(stdout, explanation, job);
    else
        explain_text(explanation, job);
}

// Explains the pixel, prints the explanation unless the figure is written to standard output, and draws the figure if
// requested.
static int explain(struct job *job, int x, int y, const char *figure, struct child *classroom)
{
    lam_error error = {0};
    struct progress progress;
    job->times.start = clock_ms();
    progress_start(&progress, job->model, console_is_terminal() && !job->options->report.quiet);
    lam_explanation *explanation = job_explain(job, x, y, &progress, &error);
    bool ok = explanation && (!figure || draw_picture(job, &progress, &error));
    progress_end(&progress);
    job_say_warnings(job, &(int){0}, !job->options->report.quiet);
    bool taken = figure && strcmp(figure, "-") == 0 && !terminal_shows();
    if (ok && !taken)
        print(explanation, job);
    fflush(stdout); // the figure may follow on standard output
    ok = ok && (!figure || write_figure(job, explanation, figure, classroom, &error));
    lam_explanation_free(explanation);
    return ok ? 0 : report_job_failure(job, &error);
}

static bool check(const struct job *job, const char *pixel, int *x, int *y, lam_error *error)
{
    const struct options *o = job->options;
    if (!*job->model)
        return complain(error, LAM_BAD_ARGUMENT, "a model's name is empty");
    if (strcmp(job->model, "-") == 0 && isatty(STDIN_FILENO))
        return complain(error, LAM_BAD_ARGUMENT,
                        "standard input is a terminal, expected a model: lambent explain - X,Y < FILE");
    if (o->report.dry_run)
        return complain(error, LAM_BAD_ARGUMENT, "option '--dry-run' does not apply to explain");
    if (o->picture.show)
        return complain(error, LAM_BAD_ARGUMENT,
                        "option '--show' has no effect on explain, which prints all terms of a pixel");
    // A figure is requested by -o, or by --term with a value other than auto and off.
    return read_pixel(pixel, o, x, y, error) &&
           terminal_start(o, o->picture.output || (o->picture.term != TERM_AUTO && o->picture.term != TERM_OFF), error);
}

int run_explain(int operand_count, char **operands, const struct options *options)
{
    const char *formula = options->shape.implicit ? "implicit" : options->shape.parametric ? "parametric" : NULL;
    struct job job = {.options = options, .model = formula ? formula : operands[0]};
    int x = 0, y = 0;
    lam_error error = {0};
    bool failed = false;
    bool ok = operand_count == (formula ? 1 : 2) ||
              complain(&error, LAM_BAD_ARGUMENT,
                       formula ? "explain: found '%s' and --%s, expected one of them"
                               : "explain: the pixel after the model '%s' is missing, expected X,Y such as 512,400",
                       operands[0], formula);
    ok =
        ok && job_check_formula(job.model, options, &error) && check(&job, operands[operand_count - 1], &x, &y, &error);
    char *figure = ok ? figure_path(options, job.model, &failed) : NULL;
    ok = ok && (!failed || complain(&error, LAM_MACHINE, "out of memory"));
    struct child classroom = NO_CHILD;
    ok = ok && (!figure ||
                (check_figure(figure, options, job.model, &error) && classroom_start(&classroom, options, &error)));
    int code = ok ? 0 : report_failure(&error, options);
    interrupt_start();
    if (ok) {
        struct sandbox_paths paths = {0};
        sandbox_add_input(&paths, job.model);
        if (figure)
            sandbox_add_output(&paths, figure, !output_is_named(options->picture.output));
        job.device = sandbox_start(options, &paths, &error) ? device_option_make(options, &error) : NULL;
        code = job.device ? explain(&job, x, y, figure, &classroom) : report_failure(&error, options);
    }
    classroom_end(&classroom);
    free(figure);
    job_free(&job);
    lam_device_free(job.device);
    if (interrupted())
        interrupt_finish();
    return code;
}
