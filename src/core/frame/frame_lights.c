// frame_lights.c: collects the lights of a frame in eye space: the lights of the scene and of the rig, and the lamp of
// the environment.
#include "frame_lights.h"

#include "environment.h"
#include "fail.h"
#include "fields.h"
#include "linear.h"
#include "up_axis.h"

#include <lambent/light.h>

#include <string.h>

static float rounded(double x) { return (float)x; }

static void store3(float out[3], lam_vec3 v)
{
    out[0] = rounded(v.x);
    out[1] = rounded(v.y);
    out[2] = rounded(v.z);
}

static void store_rgb(float out[3], lam_rgb c)
{
    out[0] = c.r;
    out[1] = c.g;
    out[2] = c.b;
}

// Computes the matrix from a light's frame to eye space.
static bool light_space(const lam_scene *scene, const lam_light *light, const lam_mat4 *view, lam_mat4 *out,
                        lam_error *error)
{
    if (light->frame == LAM_FRAME_CAMERA) {
        *out = lam_mat4_identity();
        return true;
    }
    if (light->frame == LAM_FRAME_VIEW) {
        lam_vec3 low, high, centre = v3(0, 0, 0);
        if (lam_scene_bounds(scene, &low, &high))
            centre = v3_scale(v3_add(low, high), 0.5);
        centre = mat4_point(view, centre);
        *out = mat4_translate(centre.x, centre.y, centre.z);
        return true;
    }
    *out = *view;
    if (light->frame == LAM_FRAME_WORLD)
        return true;
    if (light->frame == LAM_FRAME_MODEL) {
        *out = mat4_mul(view, &scene->placement);
        return true;
    }
    for (int i = 0; i < scene->objects.count; i++) {
        const lam_object *object = scene_object(scene, i);
        if (!light->object || (object->name && strcmp(object->name, light->object) == 0)) {
            *out = mat4_mul(view, &object->transform);
            return true;
        }
    }
    return fail(error, LAM_BAD_ARGUMENT, "light '%s': its frame is the object '%s', which the scene does not have",
                light->name ? light->name : "", light->object ? light->object : "");
}

void frame_light_init(struct frame_light *out, const lam_light *light)
{
    *out = (struct frame_light){.kind = LIGHT_POINT, .attenuation = {1, 0, 0}};
    if (light->type == LAM_LIGHT_DIRECTIONAL) {
        out->kind = LIGHT_DIRECTIONAL;
        return;
    }
    const lam_attenuation *a = &light->attenuation;
    if (a->constant != 0 || a->linear != 0 || a->quadratic != 0) {
        out->attenuation[0] = a->constant;
        out->attenuation[1] = a->linear;
        out->attenuation[2] = a->quadratic;
    }
    out->inverse_range = light->range > 0 ? rounded(1.0 / (double)light->range) : 0;
    const float *own = out->attenuation;
    out->falloff = out->inverse_range > 0                      ? FALLOFF_RANGE
                   : own[0] == 1 && own[1] == 0 && own[2] == 0 ? FALLOFF_NONE
                                                               : FALLOFF_DISTANCE;
    if (light->type != LAM_LIGHT_SPOT)
        return;
    out->exponent = light->exponent;
    if (light->outer_rad > 0) {
        double inner = math_cos((double)light->inner_rad), outer = math_cos((double)light->outer_rad);
        double width = inner - outer > 0.001 ? inner - outer : 0.001;
        out->kind = LIGHT_SPOT_CONES;
        out->cos_outer = rounded(outer);
        out->inverse_width = rounded(1 / width);
    } else if (light->cutoff_rad > 0 && (double)light->cutoff_rad <= PI / 2 + 1e-6) {
        double cosine = math_cos((double)light->cutoff_rad);
        out->kind = LIGHT_SPOT_CUTOFF;
        out->cos_cutoff = rounded(cosine > 0 ? cosine : 0);
    } else if (light->exponent > 0) {
        out->kind = LIGHT_SPOT_EXPONENT;
    }
}

static void build_light(struct frame_light *out, const lam_light *light, const lam_mat4 *space, int index)
{
    frame_light_init(out, light);
    out->light = index;
    out->source = light;
    store3(out->position, mat4_point(space, light->position));
    store3(out->axis, v3_unit(mat4_vector(space, light->direction)));
    store_rgb(out->diffuse, light->diffuse);
    store_rgb(out->specular, light->specular);
    out->occluded = light->occluded;
}

static bool add_light(struct frame *frame, const lam_scene *scene, const lam_light *light, int index,
                      const lam_mat4 *view, lam_error *error)
{
    lam_mat4 space;
    if (!light_space(scene, light, view, &space, error))
        return false;
    if (light->type == LAM_LIGHT_HEMISPHERE) {
        struct frame_hemisphere *out = &frame->hemispheres[frame->hemisphere_count++];
        for (; !light->by_diffuse && out > frame->hemispheres && out[-1].source->by_diffuse; out--)
            *out = out[-1];
        bool own = light->up.x != 0 || light->up.y != 0 || light->up.z != 0;
        const lam_mat4 *by = own ? &space : view;
        store3(out->up, v3_unit(mat4_vector(by, own ? light->up : from_y_up(scene->up, v3(0, 1, 0)))));
        store_rgb(out->sky, light->sky);
        store_rgb(out->ground, light->ground);
        out->light = index;
        out->source = light;
        return true;
    }
    struct frame_light *positioned = light->type == LAM_LIGHT_AMBIENT ? NULL : &frame->lights[frame->light_count++];
    if (positioned)
        build_light(positioned, light, &space, index);
    if (positioned && frame->settings.gl1) {
        store_rgb(positioned->ambient, light->ambient);
    } else {
        frame->ambient[0] += light->ambient.r;
        frame->ambient[1] += light->ambient.g;
        frame->ambient[2] += light->ambient.b;
    }
    return true;
}

bool frame_lights_build(struct frame *frame, const lam_scene *scene, lam_rig rig, int only, const lam_mat4 *view,
                        lam_error *error)
{
    const bool none = frame->settings.output == LAM_OUTPUT_ENVIRONMENT;
    store_rgb(frame->ambient, only < 0 ? scene->ambient : (lam_rgb){0});
    for (int i = 0; i < scene->lights.count && !none; i++)
        if ((only < 0 || only == i) && !add_light(frame, scene, lam_scene_light(scene, i), i, view, error))
            return false;
    int count = frame->rig_count = lam_scene_rig_lights(scene, rig, frame->settings.ground, frame->rig);
    for (int i = 0; i < count && !none; i++)
        if ((only < 0 || only == scene->lights.count + i) && !add_light(frame, scene, &frame->rig[i], -1, view, error))
            return false;
    if (only >= scene->lights.count + count)
        return fail(error, LAM_BAD_ARGUMENT, "output_light is %d, but the frame has %d lights, counted from 0", only,
                    scene->lights.count + count);
    if (only >= 0 && frame->settings.output != LAM_OUTPUT_LIGHT && !frame->light_count)
        return fail(error, LAM_BAD_ARGUMENT, "%s: light %d comes from everywhere, expected one with a direction",
                    lam_output_name(frame->settings.output), only);
    return true;
}

bool frame_lights_add_lamp(struct frame *frame, const lam_scene *scene, const lam_mat4 *view, struct call_control *call,
                           lam_error *error)
{
    bool wanted =
        wants_shadows(&frame->settings) && frame->environment && !frame->settings.reference && !frame->settings.bounces;
    wanted &= lam_output_is_light(frame->settings.output) && !lam_output_is_one_light(frame->settings.output);
    bool lit = false;
    for (int i = 0; i < frame->range_count && wanted; i++) {
        lam_reflection model = frame->ranges[i].reflection;
        lit |= frame_is_physical(model);
        wanted &= frame_is_physical(model) || model == LAM_REFLECTION_NONE;
    }
    struct environment_lamp lamp = {.present = false};
    if (wanted && lit && !environment_lamp(frame->environment, &lamp, call, error))
        return false;
    if (!lamp.present)
        return true;
    lam_light *light = &frame->rig[frame->rig_count];
    *light = lam_light_default(LAM_LIGHT_DIRECTIONAL);
    light->name = "the environment's lamp";
    light->frame = LAM_FRAME_CAMERA;
    double d[3];
    for (int j = 0; j < 3; j++)
        d[j] = -(((double)frame->to_environment[0][j] * lamp.direction[0] +
                  (double)frame->to_environment[1][j] * lamp.direction[1]) +
                 (double)frame->to_environment[2][j] * lamp.direction[2]);
    light->direction = v3(d[0], d[1], d[2]);
    light->diffuse = (lam_rgb){lamp.color[0], lamp.color[1], lamp.color[2]};
    light->specular = (lam_rgb){0, 0, 0};
    light->angular_radius_rad = lamp.angular_radius_rad;
    light->occluded = 0.5f;
    frame->separate_lamp = true;
    return add_light(frame, scene, light, -1, view, error);
}
