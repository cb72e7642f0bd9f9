// frame_rays.c: computes the data that rays need: the frame's draws and lights, in world space and in double precision.
#include "rays.h"

#include "linear.h"

#include <lambent/light.h>

#include <string.h>

static void find_rounding(struct frame_draw *draw, const lam_scene *scene, double end)
{
    if (draw->ground) { // its positions are relative to its middle
        for (int i = 0; i < 3; i++)
            draw->rounding[i] = 0x1p-23 * end;
        return;
    }
    const struct scene_extent *extent = scene_extent(scene, scene_object(scene, draw->object)->mesh);
    const double *o = draw->mesh->origin, low[3] = {extent->minimum.x, extent->minimum.y, extent->minimum.z},
                 high[3] = {extent->maximum.x, extent->maximum.y, extent->maximum.z};
    for (int j = 0; j < 3; j++) {
        double largest = o[j] - low[j] > high[j] - o[j] ? o[j] - low[j] : high[j] - o[j];
        for (int i = 0; i < 3; i++)
            draw->rounding[i] += 0x1p-23 * __builtin_fabs(draw->world[i][j]) * largest;
    }
}

// `end` is the radius of the ground.
static void place_draw(struct frame_draw *draw, const lam_scene *scene, const lam_mat4 *eye_to_world, double end)
{
    const double *origin = draw->mesh->origin;
    lam_mat4 from = mat4_translate(origin[0], origin[1], origin[2]);
    lam_mat4 world = draw->strokes  ? *eye_to_world
                     : draw->ground ? from
                                    : mat4_mul(&scene_object(scene, draw->object)->transform, &from);
    double cofactors[3][3], largest = 0;
    mat4_normal_matrix(&world, cofactors);
    for (int i = 0; i < 9; i++) {
        double c = cofactors[i / 3][i % 3] < 0 ? -cofactors[i / 3][i % 3] : cofactors[i / 3][i % 3];
        largest = c > largest ? c : largest;
    }
    double scale = (draw->mirrored ? -1 : 1) / (largest > 0 ? largest : 1);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 4; j++)
            draw->world[i][j] = world.m[i][j];
        for (int j = 0; j < 3; j++)
            draw->world_normal[i][j] = cofactors[i][j] * scale;
    }
    if (frame_draw_casts(draw))
        find_rounding(draw, scene, end);
}

// Returns the matrix from a light's frame to world space (frame.c has found the object).
static lam_mat4 world_of(const lam_scene *scene, const lam_light *light, const lam_mat4 *eye_to_world)
{
    switch (light->frame) {
    case LAM_FRAME_CAMERA:
        return *eye_to_world;
    case LAM_FRAME_VIEW: { // from the scene's centre, along the camera's axes
        lam_mat4 world = *eye_to_world;
        lam_vec3 low, high, middle = v3(0, 0, 0);
        if (lam_scene_bounds(scene, &low, &high))
            middle = v3_scale(v3_add(low, high), 0.5);
        world.m[0][3] = middle.x;
        world.m[1][3] = middle.y;
        world.m[2][3] = middle.z;
        return world;
    }
    case LAM_FRAME_MODEL:
        return scene->placement;
    case LAM_FRAME_OBJECT:
        for (int i = 0; i < scene->objects.count; i++) {
            const lam_object *object = scene_object(scene, i);
            if (!light->object || (object->name && strcmp(object->name, light->object) == 0))
                return object->transform;
        }
        break;
    case LAM_FRAME_WORLD:
        break;
    }
    return lam_mat4_identity();
}

static void store(double out[3], lam_vec3 v)
{
    out[0] = v.x;
    out[1] = v.y;
    out[2] = v.z;
}

static void place_lights(struct frame *frame, const lam_scene *scene, const lam_mat4 *eye_to_world)
{
    bool any = false;
    for (int i = 0; i < frame->light_count; i++) {
        struct frame_light *light = &frame->lights[i];
        const lam_light *source = light->source;
        lam_mat4 world = world_of(scene, source, eye_to_world);
        store(light->world_position, mat4_point(&world, source->position));
        store(light->world_axis, v3_unit(mat4_vector(&world, source->direction)));
        light->casts_shadows = !source->no_shadows;
        light->radius =
            light->kind == LIGHT_DIRECTIONAL ? math_tan((double)source->angular_radius_rad) : (double)source->radius;
        any |= light->casts_shadows;
    }
    frame->settings.shadows = any;
}

void frame_rays_build(struct frame *frame, const lam_scene *scene, const lam_mat4 *view)
{
    lam_mat4 eye_to_world = lam_mat4_identity();
    mat4_inverse_affine(view, &eye_to_world); // a rotation and a translation
    memcpy(frame->eye_to_world, eye_to_world.m, sizeof frame->eye_to_world);
    if (frame->settings.shadows)
        place_lights(frame, scene, &eye_to_world);
    for (int i = 0; i < frame->draw_count && (frame_has_rays(frame) || frame->draws_edges); i++)
        place_draw(&frame->draws[i], scene, &eye_to_world, frame->ground.end);
}
