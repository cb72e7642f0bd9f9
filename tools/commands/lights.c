// lights.c: the command `lights`: prints the lights of a model or a rig in the format of a scene file.
#include "command.h"

#include <stdio.h>

#include "console.h"
#include "interrupt.h"
#include "job.h"
#include "report.h"
#include "sandbox_start.h"

int run_lights(int operand_count, char **operands, const struct options *options)
{
    (void)operand_count;
    struct job job = {.options = options, .model = operands[0]};
    struct progress progress;
    lam_error error = {0};
    lam_bytes text = {0};
    interrupt_start();
    job.times.start = clock_ms();
    progress_start(&progress, job.model, false);
    struct sandbox_paths paths = {0};
    sandbox_add_input(&paths, job.model);
    bool ok = sandbox_start(options, &paths, &error) && job_load(&job, &progress, &error) &&
              job_arrange(&job, &progress, &error) &&
              lam_lights_encode(job.scene, job.rig, options->draw.ground, &text, &error);
    progress_end(&progress);
    job_say_warnings(&job, &(int){0}, !options->report.quiet);
    if (ok)
        fwrite(text.data, 1, text.size, stdout); // main reports a failed write
    if (ok && lam_scene_light_count(job.scene) == 0 && job.studio && !options->report.quiet)
        say_plain(
            "no lights: the picture is lit by the environment 'studio'; use --rig studio to light it with lights\n");
    lam_bytes_free(&text);
    lam_scene_free(job.scene);
    if (interrupted())
        interrupt_finish();
    return ok ? 0 : report_failure(&error, options);
}
