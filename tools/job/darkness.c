// darkness.c: a warning where a file's own lights leave its model black.
#include "job_steps.h"

#include <stdio.h>

// Warns where the file's own lights leave most of what is seen black, though its surfaces are not: as its author saw it under lights of the
// program that wrote it, perhaps, and as it looks without. Two small pictures tell: the lit one, and the colours of the surfaces.
bool job_note_darkness(struct job *job, const lam_draw_params *draw, int width, int height, const lam_control *control,
                       lam_error *error)
{
    const struct options *o = job->options;
    if (!job->file_lights || o->picture.exposure_kind != EXPOSURE_BY_FILE || draw->output != LAM_OUTPUT_PICTURE)
        return true;
    enum { SIDE_MAX = 96 };
    const double black = 0.002, dark = 0.02; // luminances
    lam_draw_params params = *draw;
    params.background = (lam_rgba){0, 0, 0, 0};
    params.samples = 1;
    params.ground = LAM_GROUND_NONE;
    params.wireframe = params.no_surfaces = false;
    params.edges = 0;
    int longer = width > height ? width : height;
    width = longer > SIDE_MAX ? (int)((int64_t)width * SIDE_MAX / longer) : width;
    height = longer > SIDE_MAX ? (int)((int64_t)height * SIDE_MAX / longer) : height;
    lam_image lit = {0}, surfaces = {0};
    bool ok = lam_image_make(&lit, width > 0 ? width : 1, height > 0 ? height : 1, LAM_RGBA32F, error) &&
              lam_image_make(&surfaces, lit.width, lit.height, LAM_RGBA32F, error) &&
              lam_draw(job->device, job->scene, &job->camera, &params, &lit, control, error);
    params.output = LAM_OUTPUT_BASE_COLOR;
    ok = ok && lam_draw(job->device, job->scene, &job->camera, &params, &surfaces, control, error);
    size_t covered = 0, unlit = 0;
    for (size_t i = 0; ok && i < (size_t)lit.width * (size_t)lit.height; i++) {
        const float *p = (const float *)lit.pixels + 4 * i, *q = (const float *)surfaces.pixels + 4 * i;
        if (!(p[3] > 0))
            continue;
        covered++;
        unlit += 0.2126 * (double)p[0] + 0.7152 * (double)p[1] + 0.0722 * (double)p[2] < black &&
                 0.2126 * (double)q[0] + 0.7152 * (double)q[1] + 0.0722 * (double)q[2] > dark;
    }
    lam_image_free(&lit);
    lam_image_free(&surfaces);
    if (2 * unlit > covered) {
        char text[160];
        snprintf(text, sizeof text,
                 "the lights of the file leave %d %% of what is seen black; --rig studio lights it in their place",
                 (int)(100 * unlit / covered));
        lam_scene_add_warning(job->scene, text);
    }
    return ok;
}
