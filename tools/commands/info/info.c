// info.c: the command `info`: prints the contents of a model without drawing it.
#include "info.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "command.h"
#include "console.h"
#include "interrupt.h"
#include "job_steps.h"
#include "limit_options.h"
#include "report.h"
#include "sandbox_start.h"

// Reads a model. If the file requires an unknown extension, reads the file again as with --lenient.
static bool load(struct info *info, struct job *job, struct options *options, lam_error *error)
{
    struct progress progress;
    progress_start(&progress, job->model, console_is_terminal() && !options->report.quiet);
    bool ok = job_load(job, &progress, error);
    if (!ok && error->code == LAM_UNSUPPORTED && !options->model.lenient && strcmp(job->model, "-") != 0) {
        lam_error second = {0};
        lam_scene_free(job->scene);
        *job = (struct job){.options = options,
                            .model = job->model,
                            .measure = true,
                            .keeps_axes = true,
                            .times.start = job->times.start};
        options->model.lenient = true;
        ok = info->needs_lenient = job_load(job, &progress, &second);
    }
    progress_end(&progress);
    return ok;
}

// Draws the depths once to measure the memory that drawing needs. Lighting needs no additional memory, except for
// environment light.
static void measure_drawing(struct info *info, const struct job *job)
{
    lam_device *device = lam_device_cpu(&(lam_cpu_params){.threads = job->options->work.threads}, NULL);
    lam_image image = {0};
    lam_camera camera = lam_camera_fit(job->scene, INFO_SIDE, INFO_SIDE, NULL);
    lam_draw_params params = {.output = LAM_OUTPUT_DEPTH};
    lam_control control = limits_control(job->options);
    const uint64_t picture = (uint64_t)INFO_SIDE * INFO_SIDE * 4;
    if (control.memory_limit_bytes && control.memory_limit_bytes <= picture)
        info->drawing_bytes = 0; // the picture alone exceeds the limit
    else if (device && lam_image_make(&image, INFO_SIDE, INFO_SIDE, LAM_RGBA8, NULL) &&
             lam_draw(device, job->scene, &camera, &params, &image, &control, NULL)) {
        lam_frame_report report;
        lam_device_report(device, &report);
        info->drawing_bytes = report.memory_bytes + picture;
        info->drawing_threads = lam_device_threads(device);
    }
    lam_image_free(&image);
    lam_device_free(device);
}

// Cuts the model to measure its sections. All other numbers describe the whole model.
static bool measure_sections(struct info *info, struct job *job, lam_error *error)
{
    lam_control control;
    if (!job_control(job, NULL, &control, error) || !job_section(job, &control, error))
        return false;
    for (int i = 0; lam_scene_section(job->scene, i); i++) {
        info->sections[i] = *lam_scene_section(job->scene, i);
        info->section_areas[i] = lam_scene_section_area(job->scene, i);
        info->section_count = i + 1;
    }
    return lam_scene_set_sections(job->scene, NULL, 0, NULL, error);
}

static int print_one(const char *model, const struct options *given, bool first)
{
    struct options options = *given;
    struct job job = {.options = &options, .model = model, .measure = true, .keeps_axes = true};
    lam_error error = {0};
    struct info info = {.job = &job, .error = &error};
    job.times.start = clock_ms();
    struct info_textures textures = {0};
    struct info_names names = {0};
    struct info_print print = {0};
    info.print = given->print.wanted ? &print : NULL;
    info.textures = &textures;
    info.names = &names;
    bool ok = load(&info, &job, &options, &error) && info_textures_list(job.scene, &textures, &error) &&
              info_names_list(job.scene, &names, &error) && measure_sections(&info, &job, &error) &&
              (!info.print || info_print_check(job.scene, given->print.overhang_deg, &print, &error));
    if (ok) {
        error = (lam_error){0}; // if only the second attempt succeeded, the error is from the first
        measure_drawing(&info, &job);
    } else
        say_error(error.text);
    if (given->report.json) {
        info_json(&info);
    } else if (ok) {
        if (!first)
            printf("\n");
        info_text(&info);
    }
    free(textures.items);
    free(names.items);
    lam_scene_free(job.scene);
    const int code = exit_code_of(error.code)->code;
    return !code && info.print && !print.printable ? EXIT_DIFFERS : code;
}

int run_info(int operand_count, char **operands, const struct options *options)
{
    lam_error error = {0};
    for (int i = 0; i < operand_count && !error.code; i++) {
        if (!*operands[i])
            complain(&error, LAM_BAD_ARGUMENT, "a model's name is empty");
        else if (strcmp(operands[i], "-") == 0 && operand_count > 1)
            complain(&error, LAM_BAD_ARGUMENT, "'-' (standard input) works only with a single model");
        else if (strcmp(operands[i], "-") == 0 && isatty(STDIN_FILENO))
            complain(&error, LAM_BAD_ARGUMENT, "standard input is a terminal, expected a model: lambent info - < FILE");
    }
    if (error.code)
        return report_failure(&error, options);
    interrupt_start();
    struct sandbox_paths paths = {0};
    for (int i = 0; i < operand_count; i++)
        sandbox_add_input(&paths, operands[i]);
    if (!sandbox_start(options, &paths, &error))
        return report_failure(&error, options);
    int worst = 0;
    for (int i = 0; i < operand_count && !interrupted(); i++) {
        int code = print_one(operands[i], options, i == 0);
        worst = code > worst ? code : worst;
    }
    if (interrupted())
        interrupt_finish();
    return worst;
}
