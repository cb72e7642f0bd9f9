// scene_settings.c: what a scene file says about its picture, below what the command line says; and --save-scene.
#include "scene_settings.h"

#include <stdlib.h>
#include <string.h>

#include "camera_option.h"
#include "environment_option.h"

// Settings that an option can override, by the option's name.
static bool free_to_take(const struct job *job, unsigned bit, const char *option)
{
    return (job->settings.given & bit) && !option_given(&job->own, option);
}

void scene_settings_apply(struct job *job)
{
    job->own = *job->options;
    job->options = &job->own;
    if (!lam_scene_settings(job->scene, &job->settings))
        return;
    struct options *own = &job->own;
    const lam_settings *s = &job->settings;
    if (free_to_take(job, LAM_GIVEN_SIZE, "size") && !own->has_size) { // a sheet decides its pictures' size
        own->width = s->width;
        own->height = s->height;
    }
    if (free_to_take(job, LAM_GIVEN_SAMPLES, "samples"))
        own->samples = s->draw.samples;
    if (free_to_take(job, LAM_GIVEN_COLOR, "color"))
        own->color = (int)s->draw.color;
    if (free_to_take(job, LAM_GIVEN_EXPOSURE, "exposure"))
        own->exposure = s->draw.exposure;
    if (free_to_take(job, LAM_GIVEN_SHADING, "shading")) {
        own->shading = (int)s->draw.shading;
        own->has_shading = !option_given(own, "stage");
    }
    if (free_to_take(job, LAM_GIVEN_REFLECTION, "reflection"))
        own->reflection = (int)s->draw.reflection;
    // A shading asked for on the command line comes without the file's stage, which may not go with it.
    if (free_to_take(job, LAM_GIVEN_STAGE, "stage") && !option_given(own, "shading"))
        own->stage = (int)s->draw.stage;
    if (free_to_take(job, LAM_GIVEN_VIEWER, "viewer"))
        own->viewer = (int)s->draw.viewer;
    if (free_to_take(job, LAM_GIVEN_FLAT_NORMAL, "flat-normal"))
        own->flat_normal = (int)s->draw.flat_normal;
    own->match_highlights |= s->draw.match_highlights;
    own->gl1 |= s->draw.gl1;
    if (free_to_take(job, LAM_GIVEN_LIGHT_CUTOFF, "light-cutoff")) {
        own->light_cutoff = (double)s->draw.light_cutoff;
        own->has_light_cutoff = true;
    }
    // Lights that are listed, be they none, leave no room for the studio.
    if (free_to_take(job, LAM_GIVEN_LIGHTS, "rig")) {
        own->rig = (int)LAM_RIG_NONE;
        own->has_rig = true;
    }
}

bool scene_settings_has_camera(const struct job *job)
{
    static const char *const others[] = {"camera", "view", "azimuth", "elevation", "zoom", "projection", NULL};
    for (int i = 0; others[i]; i++)
        if (option_given(&job->own, others[i]))
            return false;
    return job->settings.given & LAM_GIVEN_CAMERA;
}

// The environment as it is drawn: the command line's, or the scene file's with the command line's turn.
// `names` keeps the six names.
static bool take_environment(const struct options *o, lam_settings *s, char **names, lam_error *error)
{
    const char *text = o->environment;
    if (text || option_given(o, "environment-rotation"))
        s->environment_rotation_rad = radians(o->environment_rotation_deg);
    if (!text)
        return true;
    memset(s->faces, 0, sizeof s->faces);
    s->built_in = environment_option_built_in(text);
    s->equirectangular = s->built_in || strchr(text, ',') ? NULL : text;
    s->given |= LAM_GIVEN_ENVIRONMENT;
    return s->built_in || s->equirectangular || (*names = environment_option_faces(text, s->faces, error)) != NULL;
}

bool scene_settings_save(const struct job *job, lam_error *error)
{
    const lam_draw_params *draw = &job->draw;
    lam_settings s = job->settings;
    s.given &= LAM_GIVEN_ENVIRONMENT;
    s.given |= draw->exposure != 0 ? LAM_GIVEN_EXPOSURE : 0;
    s.given |= LAM_GIVEN_SIZE | LAM_GIVEN_SAMPLES | LAM_GIVEN_BACKGROUND | LAM_GIVEN_COLOR | LAM_GIVEN_CAMERA |
               LAM_GIVEN_SHADING | LAM_GIVEN_REFLECTION | LAM_GIVEN_MATCH_HIGHLIGHTS | LAM_GIVEN_GL1;
    s.given |= draw->light_cutoff != 0 ? LAM_GIVEN_LIGHT_CUTOFF : 0;
    s.given |= draw->stage != LAM_STAGE_AUTO ? LAM_GIVEN_STAGE : 0;
    s.given |= draw->viewer != LAM_VIEWER_LOCAL ? LAM_GIVEN_VIEWER : 0;
    s.given |= draw->flat_normal != LAM_FLAT_NORMAL_FACE ? LAM_GIVEN_FLAT_NORMAL : 0;
    s.width = job->image.width;
    s.height = job->image.height;
    s.camera = job->camera;
    s.draw = *draw;
    char *names = NULL;
    bool ok = take_environment(job->options, &s, &names, error) &&
              lam_scene_save(job->scene, &s, job->options->save_scene, error);
    free(names);
    return ok;
}
