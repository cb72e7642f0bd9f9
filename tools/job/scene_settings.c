// scene_settings.c: applies the picture settings of a scene file unless the command line overrides them, and writes the
// scene file of --save-scene.
#include "scene_settings.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <lambent/path.h>

#include "console.h"
#include "job.h"
#include "options.h"
#include "environment_option.h"
#include "output.h"

// Returns whether the scene file contains the setting and the command line does not override it.
static bool takes_setting(const struct job *job, unsigned bit, const char *option)
{
    return (job->settings.present & bit) && !option_given(&job->own, option);
}

// Returns whether the command line contains the option for a setting.
static bool setting_given(const struct options *o, const lam_setting *setting)
{
    char name[64];
    snprintf(name, sizeof name, "%s", setting->key);
    if (setting->offset == offsetof(lam_draw_params, ground_color))
        return option_given(o, "ground");
    for (char *c = name; *c; c++)
        *c = *c == '_' ? '-' : *c;
    return option_given(o, name);
}

void scene_settings_apply(struct job *job)
{
    job->own = *job->options;
    job->options = &job->own;
    if (!lam_scene_picture_settings(job->scene, &job->settings))
        return;
    struct options *own = &job->own;
    const lam_picture_settings *s = &job->settings;
    options_drop_settings(own);
    if (takes_setting(job, LAM_SETTING_SIZE, "size") && !own->picture.has_size) { // a sheet sets the size itself
        own->picture.width = s->width;
        own->picture.height = s->height;
    }
    if (takes_setting(job, LAM_SETTING_SAMPLES, "samples"))
        own->draw.samples = s->draw.samples;
    if (takes_setting(job, LAM_SETTING_COLOR, "color-mode"))
        own->picture.color_mode = (int)s->draw.color;
    if (takes_setting(job, LAM_SETTING_EXPOSURE, "exposure") && own->picture.exposure_kind == EXPOSURE_BY_FILE) {
        own->picture.exposure = s->draw.exposure;
        own->picture.exposure_kind = EXPOSURE_LITERAL;
    }
    if (takes_setting(job, LAM_SETTING_TONE, "tone"))
        own->draw.tone = s->draw.tone;
    bool shading_given = option_given(own, "shading");
    for (int i = 0; lam_draw_setting(i); i++) {
        const lam_setting *setting = lam_draw_setting(i);
        bool stage = setting->offset == offsetof(lam_draw_params, stage);
        // A shading method on the command line discards the file's stage, which may be incompatible.
        if ((s->draw_present >> i & 1) && !setting_given(own, setting) && !(stage && shading_given))
            lam_setting_copy(setting, &s->draw, &own->draw);
        if (setting->offset == offsetof(lam_draw_params, shading) && (s->draw_present >> i & 1) && !shading_given)
            own->shading.has_shading = !option_given(own, "stage");
    }
    // A list of lights, even an empty list, replaces the studio.
    if (takes_setting(job, LAM_SETTING_LIGHTS, "rig")) {
        own->lighting.rig = (int)LAM_RIG_NONE;
        own->lighting.has_rig = true;
    }
}

bool scene_settings_has_camera(const struct job *job)
{
    static const char *const others[] = {"camera", "view", "azimuth", "elevation", "zoom", "fov", "projection", NULL};
    for (int i = 0; others[i]; i++)
        if (option_given(&job->own, others[i]))
            return false;
    return job->settings.present & LAM_SETTING_CAMERA;
}

// Replaces the scene file's environment by the environment of the command line. If the command line sets only the
// rotation, replaces only the rotation. `names` receives the memory that contains the six file names.
static bool take_environment(const struct options *o, lam_picture_settings *s, char **names, lam_error *error)
{
    const char *text = o->shading.environment;
    if (text || option_given(o, "environment-rotation"))
        s->environment_rotation_rad = radians(o->shading.environment_rotation_deg);
    if (!text)
        return true;
    s->present &= ~(unsigned)LAM_SETTING_ENVIRONMENT;
    if (environment_option_is_none(text))
        return true;
    memset(s->environment_faces, 0, sizeof s->environment_faces);
    s->reflection_map = o->shading.reflection_map;
    s->environment_built_in = environment_option_built_in(text);
    s->environment_picture = s->environment_built_in || strchr(text, ',') ? NULL : text;
    s->present |= LAM_SETTING_ENVIRONMENT;
    return s->environment_built_in || s->environment_picture ||
           (*names = environment_option_faces(text, s->environment_faces, error)) != NULL;
}

bool scene_settings_are_beside(const struct job *job)
{
    const struct options *o = job->options;
    const char *slash = strrchr(o->picture.save_scene, '/');
    char *given = strndup(o->picture.save_scene, slash ? (size_t)(slash - o->picture.save_scene) + 1 : 0),
         *names = NULL;
    const char *folder = given && *given ? given : ".";
    lam_picture_settings s = {0};
    lam_error error;
    bool beside = lam_shape_find(job->model) >= 0 || strcmp(lam_scene_format(job->scene), "scene") == 0 ||
                  lam_path_is_below(job->model, folder);
    if (take_environment(o, &s, &names, &error)) {
        for (int i = 0; i < LAM_FACE_COUNT && s.environment_faces[i]; i++)
            beside &= lam_path_is_below(s.environment_faces[i], folder);
        beside &= !s.environment_picture || lam_path_is_below(s.environment_picture, folder);
    }
    free(names);
    free(given);
    return beside;
}

bool scene_settings_save(const struct job *job, lam_error *error)
{
    const lam_draw_params *draw = &job->draw;
    lam_picture_settings s = job->settings;
    s.present &= LAM_SETTING_ENVIRONMENT;
    // Pictures of scene files are not brightened automatically, so the saved exposure includes the brightening.
    const double brightened = job->times.frame.brightened;
    s.present |= draw->exposure != 0 || brightened != 0 || job->file_lights ? LAM_SETTING_EXPOSURE : 0;
    s.present |= draw->tone != LAM_TONE_AUTO ? LAM_SETTING_TONE : 0;
    s.present |=
        LAM_SETTING_SIZE | LAM_SETTING_SAMPLES | LAM_SETTING_BACKGROUND | LAM_SETTING_COLOR | LAM_SETTING_CAMERA;
    s.draw_present = 0;
    for (int i = 0; lam_draw_setting(i); i++) {
        size_t offset = lam_draw_setting(i)->offset;
        bool always = offset == offsetof(lam_draw_params, shading) || offset == offsetof(lam_draw_params, reflection);
        if (always || !lam_setting_is_default(lam_draw_setting(i), draw))
            s.draw_present |= UINT64_C(1) << i;
    }
    s.width = job->image.width;
    s.height = job->image.height;
    s.camera = job->camera;
    s.draw = *draw;
    s.draw.exposure += brightened;
    char *names = NULL;
    if (job->studio && !(s.present & LAM_SETTING_ENVIRONMENT)) {
        s.environment_built_in = "studio";
        s.present |= LAM_SETTING_ENVIRONMENT;
    }
    lam_bytes bytes = {0};
    uint64_t size;
    bool ok = job_check_inputs(job->scene, job->options->picture.save_scene, true, error) &&
              take_environment(job->options, &s, &names, error) &&
              lam_scene_encode(job->scene, &s, job->options->picture.save_scene, &bytes, error) &&
              output_save_bytes(&bytes, job->options->picture.save_scene, false, &size, error);
    lam_bytes_free(&bytes);
    free(names);
    return ok;
}

// --- prevents outputs from replacing the files of the model.

bool job_is_same_file(const char *a, const char *b)
{
    struct stat one, other;
    return stat(a, &one) == 0 && stat(b, &other) == 0 && one.st_dev == other.st_dev && one.st_ino == other.st_ino;
}

bool job_check_inputs(const lam_scene *scene, const char *path, bool own, lam_error *error)
{
    bool may = own && strcmp(lam_scene_format(scene), "scene") == 0;
    for (int i = may ? 1 : 0; lam_scene_file(scene, i); i++)
        if (job_is_same_file(path, lam_scene_file(scene, i)))
            return complain(error, LAM_BAD_ARGUMENT,
                            "%.300s: the output would replace a file that the model uses; name another output", path);
    return true;
}
