// light_markers.c: implements --show-lights: adds markers at the lights.
#include "light_markers.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <lambent/light.h>
#include <lambent/material.h>

#include "console.h"
#include "light_place.h"
#include "vectors.h"

static lam_vec3 unit(lam_vec3 v)
{
    double length = sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
    return length > 0 ? (lam_vec3){v.x / length, v.y / length, v.z / length} : (lam_vec3){0, -1, 0};
}

// Returns a transform with its origin at p. Its second axis has the direction d and the length `along`; its other axes
// have the length `size`.
static lam_mat4 placement(lam_vec3 p, lam_vec3 d, double size, double along)
{
    lam_vec3 other = fabs(d.y) < 0.9 ? (lam_vec3){0, 1, 0} : (lam_vec3){1, 0, 0};
    lam_vec3 x = unit(cross(d, other)), z = cross(x, d);
    return (lam_mat4){{{x.x * size, d.x * along, z.x * size, p.x},
                       {x.y * size, d.y * along, z.y * size, p.y},
                       {x.z * size, d.z * along, z.z * size, p.z},
                       {0, 0, 0, 1}}};
}

static int glowing(lam_scene *scene, lam_rgb color, lam_error *error)
{
    float most = color.r > color.g ? color.r : color.g;
    most = most > color.b ? most : color.b;
    lam_material m = {.diffuse = {0, 0, 0, 1}, .illum = -1, .name = "light marker"};
    m.emission = most > 0 ? (lam_rgb){color.r / most, color.g / most, color.b / most} : (lam_rgb){0.2f, 0.2f, 0.2f};
    return lam_scene_add_material(scene, &m, error);
}

// Adds a marker, and a larger dark one of which only the far side is visible: the outline of markers on a background of
// the light's colour.
static bool put(lam_scene *scene, int mesh, int material, int dark, lam_mat4 transform, lam_error *error)
{
    lam_object object = lam_object_default();
    object.name = "light marker";
    object.mesh = mesh;
    object.material = material;
    object.transform = transform;
    if (mesh < 0 || material < 0 || dark < 0 || lam_scene_add_object(scene, &object, error) < 0)
        return false;
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 3; column++)
            object.transform.m[row][column] *= 1.3;
    object.material = dark;
    object.cull = LAM_CULL_FRONT;
    return lam_scene_add_object(scene, &object, error) >= 0;
}

// Returns whether a sphere is outside the picture.
static bool is_outside(const struct job *job, lam_vec3 centre, double radius)
{
    const lam_camera *camera = &job->camera;
    lam_mat4 view = lam_camera_view_matrix(camera);
    lam_vec3 e = matrix_apply(&view, centre, 1);
    double depth = -e.z;
    if (camera->far_plane > camera->near_plane &&
        (depth + radius < camera->near_plane || depth - radius > camera->far_plane))
        return true;
    double x = fabs(e.x), y = fabs(e.y), lens[4], width = job->options->picture.width,
           height = job->options->picture.height;
    if (!lam_camera_intrinsics(camera, (int)width, (int)height, LAM_CONVENTION_OPENGL, lens))
        return x > camera->ortho_half_height * width / height + radius || y > camera->ortho_half_height + radius;
    // the slopes of the frustum's side that is on the sphere's side of the axis
    double kx = (e.x > 0 ? width - lens[2] : lens[2]) / lens[0], ky = (e.y > 0 ? lens[3] : height - lens[3]) / lens[1];
    return depth <= 0 || x > kx * depth + radius * sqrt(1 + kx * kx) || y > ky * depth + radius * sqrt(1 + ky * ky);
}

// The names of the first few lights, as text. A light without a name is listed by its number, counted from 1.
struct names {
    char text[160];
    int count, more; // the number of lights, and the number of lights that `text` omits
};

static void add_name(struct names *names, const lam_light *light, int number)
{
    enum { NAMED_MAX = 3, NAME_LENGTH_MAX = 32 };
    size_t length = strlen(names->text), room = sizeof names->text - length;
    names->count++;
    if (names->count > NAMED_MAX) {
        names->more++;
        return;
    }
    if (light->name)
        snprintf(names->text + length, room, "%s'%.*s'", length ? ", " : "", NAME_LENGTH_MAX, light->name);
    else
        snprintf(names->text + length, room, "%s%d", length ? ", " : "", number);
}

static void warn_outside(lam_scene *scene, const struct names *names)
{
    char text[300], more[32] = "";
    if (!names->count)
        return;
    if (names->more)
        snprintf(more, sizeof more, " and %d more", names->more);
    bool several = names->count > 1;
    snprintf(text, sizeof text, "option '--show-lights': the marker%s of light%s %s%s lie%s outside of the picture",
             several ? "s" : "", several ? "s" : "", names->text, more, several ? "" : "s");
    lam_scene_add_warning(scene, text);
}

bool light_markers_add(struct job *job, lam_error *error)
{
    lam_scene *scene = job->scene;
    lam_vec3 centre;
    double radius;
    int own = lam_scene_light_count(scene),
        count = lam_draw_lights(scene, job->rig, job->options->draw.ground, NULL, 0);
    if (!lam_scene_sphere(scene, -1, &centre, &radius))
        return true;
    lam_light *lights = calloc((size_t)count + 1, sizeof *lights);
    if (!lights)
        return complain(error, LAM_MACHINE, "out of memory");
    lam_draw_lights(scene, job->rig, job->options->draw.ground, lights, count);
    // The rig's lights are added to the scene first, because some of them depend on the scene's sphere, which the
    // markers enlarge.
    bool ok = true;
    for (int i = own; ok && i < count; i++)
        ok = lam_scene_add_light(scene, &lights[i], error) >= 0;
    job->rig = LAM_RIG_NONE;
    lam_shape_params few = {.slices = 24, .stacks = 12};
    int ball = ok ? lam_scene_add_shape(scene, "sphere", &few, error) : -1;
    int cone = ok ? lam_scene_add_shape(scene, "cone", &few, error) : -1;
    lam_material black = {.diffuse = {0, 0, 0, 1}, .illum = -1, .name = "light marker"};
    int dark = lam_scene_add_material(scene, &black, error);
    ok = ball >= 0 && cone >= 0 && dark >= 0;
    struct names outside = {0};
    for (int i = 0; ok && i < count; i++) {
        const lam_light *l = &lights[i];
        if (l->type == LAM_LIGHT_AMBIENT || l->type == LAM_LIGHT_HEMISPHERE)
            continue;
        lam_mat4 world = light_to_world(job, l);
        lam_vec3 d = unit(matrix_apply(&world, l->direction, 0)), p = matrix_apply(&world, l->position, 1);
        if (l->type == LAM_LIGHT_DIRECTIONAL)
            p = (lam_vec3){centre.x - 1.5 * radius * d.x, centre.y - 1.5 * radius * d.y, centre.z - 1.5 * radius * d.z};
        bool has_cone = l->type != LAM_LIGHT_POINT;
        lam_vec3 tip = {p.x + 0.09 * radius * d.x, p.y + 0.09 * radius * d.y, p.z + 0.09 * radius * d.z};
        if (is_outside(job, p, 0.03 * radius) && !(has_cone && !is_outside(job, tip, 0.06 * radius)))
            add_name(&outside, l, i + 1);
        int material = glowing(scene, l->diffuse, error);
        ok = put(scene, ball, material, dark, placement(p, d, 0.03 * radius, 0.03 * radius), error);
        if (has_cone)
            ok = ok && put(scene, cone, material, dark, placement(tip, d, 0.03 * radius, 0.06 * radius), error);
    }
    warn_outside(scene, &outside);
    free(lights);
    return ok;
}
