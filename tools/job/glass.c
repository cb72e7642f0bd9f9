// glass.c: adds notes about glass: its tint is only correct over white, or the drawing method does not show it.
#include "job_steps.h"

static bool is_grey(float r, float g, float b) { return r == g && g == b; }

static bool colors_light(const lam_material *m)
{
    return m->physical && m->transmission > 0 && m->metallic < 1 &&
           (!is_grey(m->diffuse.r, m->diffuse.g, m->diffuse.b) || m->maps[LAM_MAP_DIFFUSE] ||
            (m->thickness > 0 && m->attenuation_distance > 0 &&
             !is_grey(m->attenuation_color.r, m->attenuation_color.g, m->attenuation_color.b)));
}

static bool is_shown(const lam_draw_params *draw)
{
    bool other = draw->reflection != LAM_REFLECTION_AUTO && !lam_reflection_describe(draw->reflection)->microfacet;
    return draw->shading == LAM_SHADING_PHONG && !other;
}

void job_note_glass(struct job *job, const lam_draw_params *draw)
{
    for (int i = 0; !is_shown(draw) && i < lam_scene_material_count(job->scene); i++)
        if (lam_scene_material(job->scene, i)->physical && lam_scene_material(job->scene, i)->transmission > 0) {
            lam_scene_add_warning(
                job->scene, "glass is drawn opaque: only Phong shading with a physical reflection model shows it");
            return;
        }
    if (draw->background.a > 0 || draw->output != LAM_OUTPUT_PICTURE)
        return;
    for (int i = 0; i < lam_scene_material_count(job->scene); i++)
        if (colors_light(lam_scene_material(job->scene, i))) {
            lam_scene_add_warning(job->scene, "the transparent picture of coloured glass is correct over white; for "
                                              "another colour behind it, add --background COLOUR");
            return;
        }
}
