// exercises.c: makes the exercises. An exercise is a shader in the lecture style with one of the mistakes of `lambent
// shader --mistake`.
#include <string.h>

#include <lambent/check.h>
#include <lambent/light.h>
#include <lambent/shader.h>

#include "check_module.h"
#include "json.h"

// An exercise uses the first of these scenes that meets the requirements of its mistake.
static const struct setting {
    lam_light_type lights[2];
    int light_count;
    lam_reflection reflection;
} settings[] = {
    {{LAM_LIGHT_POINT}, 1, LAM_REFLECTION_BLINN_PHONG},
    {{LAM_LIGHT_POINT}, 1, LAM_REFLECTION_PHONG},
    {{LAM_LIGHT_DIRECTIONAL}, 1, LAM_REFLECTION_BLINN_PHONG},
    {{LAM_LIGHT_SPOT}, 1, LAM_REFLECTION_BLINN_PHONG},
    {{LAM_LIGHT_POINT, LAM_LIGHT_DIRECTIONAL}, 2, LAM_REFLECTION_BLINN_PHONG},
};
enum { SETTINGS = sizeof settings / sizeof *settings, SIDE = 64 };

// The text of a shader depends on the kinds of lights and on which of their numbers are in use, not on their values.
static lam_light light_of(lam_light_type type)
{
    lam_light light = lam_light_default(type);
    light.position = (lam_vec3){0, 3, 1};
    if (type == LAM_LIGHT_POINT)
        light.attenuation = (lam_attenuation){0.4F, 0.3F, 0.2F};
    if (type == LAM_LIGHT_SPOT)
        light.exponent = 4;
    return light;
}

// A triangle, because the text of a shader does not depend on the shapes.
static lam_scene *scene_of(const struct setting *setting, lam_error *error)
{
    static const float positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    static const uint32_t indices[] = {0, 1, 2};
    const lam_mesh mesh = {.positions = positions, .vertex_count = 3, .indices = indices, .triangle_count = 1};
    const lam_object object = lam_object_default();
    lam_scene *scene = lam_scene_make(error);
    bool ok = scene && lam_scene_add_mesh(scene, &mesh, error) >= 0 && lam_scene_add_object(scene, &object, error) >= 0;
    for (int i = 0; ok && i < setting->light_count; i++) {
        lam_light light = light_of(setting->lights[i]);
        ok = lam_scene_add_light(scene, &light, error) >= 0;
    }
    if (ok)
        return scene;
    lam_scene_free(scene);
    return NULL;
}

static lam_shader *shader_of(const lam_scene *scene, lam_reflection reflection, const char *mistake, lam_error *error)
{
    lam_camera camera = lam_camera_default();
    lam_draw_params draw = {.reflection = reflection};
    lam_shader_params params = {.glsl = LAM_GLSL_300_ES, .style = LAM_SHADER_STYLE_LECTURE, .mistake = mistake};
    return lam_shader_make(scene, &camera, &draw, SIDE, SIDE, -1, &params, error);
}

static const char *explanation_of(const char *mistake)
{
    for (int i = 0; lam_check_mistake(i); i++)
        if (strcmp(lam_check_mistake(i), mistake) == 0)
            return lam_check_mistake_explanation(i);
    return NULL;
}

void exercises_list(struct json *json)
{
    lam_shader_mistake mistake;
    json_open(json, "exercises", '[');
    for (int i = 0; lam_shader_mistake_row(i, &mistake); i++) {
        json_put(json, OBJECT(NULL, TEXT("mistake", mistake.id), TEXT("looks", mistake.looks),
                              TEXT("wrong", explanation_of(mistake.id))));
    }
    json_close(json, ']');
}

static void put_texts(struct json *json, const char *key, const lam_shader *shader)
{
    json_put(json, OBJECT(key, TEXT("vertex", shader->vertex), TEXT("fragment", shader->fragment)));
}

// Prints the texts of one setting. Returns false if the setting does not meet a requirement of the mistake, or if this
// fails.
static bool put_exercise(const struct setting *setting, const char *mistake, lam_error *error)
{
    lam_scene *scene = scene_of(setting, error);
    lam_shader *wrong = scene ? shader_of(scene, setting->reflection, mistake, error) : NULL;
    lam_shader *right = wrong ? shader_of(scene, setting->reflection, NULL, error) : NULL;
    if (right) {
        struct json json = {.file = stdout};
        json_open(&json, NULL, '{');
        json_text(&json, "highlight", setting->reflection == LAM_REFLECTION_PHONG ? "phong" : "");
        put_texts(&json, "texts", wrong);
        put_texts(&json, "correct", right);
        json_close(&json, '}');
    }
    lam_shader_free(wrong);
    lam_shader_free(right);
    lam_scene_free(scene);
    return right != NULL;
}

bool exercise_put(const char *mistake, lam_error *error)
{
    for (int i = 0; i < SETTINGS; i++) {
        *error = (lam_error){0};
        if (put_exercise(&settings[i], mistake, error))
            return true;
        if (error->code != LAM_UNSUPPORTED)
            return false;
    }
    return false;
}
