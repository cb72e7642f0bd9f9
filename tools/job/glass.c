// glass.c: a note about coloured glass over a transparent background.
#include "job_steps.h"

static bool is_grey(float r, float g, float b) { return r == g && g == b; }

static bool colors_light(const lam_material *m)
{
    return m->physical && m->transmission > 0 && m->metallic < 1 &&
           (!is_grey(m->diffuse.r, m->diffuse.g, m->diffuse.b) || m->maps[LAM_MAP_DIFFUSE] ||
            (m->thickness > 0 && m->attenuation_distance > 0 &&
             !is_grey(m->attenuation_color.r, m->attenuation_color.g, m->attenuation_color.b)));
}

void job_note_glass(struct job *job, const lam_draw_params *draw)
{
    if (draw->background.a > 0 || draw->output != LAM_OUTPUT_PICTURE)
        return;
    for (int i = 0; i < lam_scene_material_count(job->scene); i++)
        if (colors_light(lam_scene_material(job->scene, i))) {
            lam_scene_add_warning(job->scene,
                                  "the transparent picture of coloured glass is right over white; for another "
                                  "colour behind it, add --background COLOUR");
            return;
        }
}
