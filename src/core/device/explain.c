// explain.c: implements lam_explain: draws one tile with a recorder, and completes the recorded values.
#include "device_type.h"
#include "recorder.h"
#include "scene_internal.h"

#include "camera_lens.h"
#include "fail.h"

#include <stdlib.h>
#include <string.h>

// Computes the angle from the cross and the dot product, because this method is also accurate for small angles.
static double angle_between(lam_vec3 a, lam_vec3 b)
{
    if (v3_dot(a, a) == 0 || v3_dot(b, b) == 0)
        return __builtin_nan("");
    return math_atan2(v3_length(v3_cross(a, b)), v3_dot(a, b));
}

// Transforms a point from eye space to world space and to the space of the object's mesh. The rectangles of lines and
// points are already in eye space.
static void leave_eye_space(const lam_camera *camera, const lam_object *object, lam_explained_point *point)
{
    lam_mat4 view = mat4_look_at(camera->eye, camera->target, camera->up), to_world, to_mesh;
    if (!mat4_inverse_affine(&view, &to_world) || !mat4_inverse_affine(&object->transform, &to_mesh))
        return;
    point->world_position = mat4_point(&to_world, point->mesh_position);
    point->mesh_position = mat4_point(&to_mesh, point->world_position);
}

// Returns a texture coordinate after wrapping, 0…1.
static double wrapped(double s, lam_wrap wrap)
{
    if (wrap == LAM_WRAP_CLAMP)
        return s > 1 ? 1 : s > 0 ? s : 0;
    if (!(s > -1e15 && s < 1e15))
        return 0;
    int64_t whole = (int64_t)s - ((double)(int64_t)s > s);
    double part = s - (double)whole;
    return wrap == LAM_WRAP_MIRROR && (whole & 1) ? 1 - part : part;
}

static void complete_map(lam_explained_map *map, const lam_texture_map *given)
{
    double s = (double)map->s, t = (double)map->t;
    const float(*m)[3] = given->transform;
    bool turned = false;
    for (int i = 0; i < 6; i++)
        turned |= m[i / 3][i % 3] != 0;
    double at_s = turned ? (double)m[0][0] * s + (double)m[0][1] * t + (double)m[0][2] : s;
    double at_t = turned ? (double)m[1][0] * s + (double)m[1][1] * t + (double)m[1][2] : t;
    map->texture = lam_texture_name(given->texture);
    map->width = lam_texture_width(given->texture, 0);
    map->height = lam_texture_height(given->texture, 0);
    map->column = (float)(wrapped(at_s, given->wrap_s) * map->width);
    map->row = (float)(wrapped(at_t, given->wrap_t) * map->height);
    for (int axis = 0; axis < 2; axis++) {
        float *v = axis ? map->down : map->across, ds = v[0], dt = v[1];
        v[0] = (turned ? m[0][0] * ds + m[0][1] * dt : ds) * (float)map->width;
        v[1] = (turned ? m[1][0] * ds + m[1][1] * dt : dt) * (float)map->height;
    }
}

// The following functions compute values from the recorded values.
static const lam_mat4 identity = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};

static void complete_angles(lam_explained_point *point)
{
    for (int n = 0; n < point->light_count; n++) {
        lam_explained_light *light = (lam_explained_light *)(uintptr_t)&point->lights[n];
        light->theta_rad = angle_between(point->n, light->l);
        light->phi_rad = angle_between(light->r, point->v);
        light->psi_rad = angle_between(point->n, light->h);
    }
}

// --- positions of a triangle from its mesh to the window

static lam_explained_place place_of(const struct frame_draw *draw, lam_vec3 origin, lam_vec3 p, int width, int height)
{
    lam_explained_place out = {.mesh_position = v3_add(origin, p)};
    const double at[4] = {p.x, p.y, p.z, 1}, none = __builtin_nan("");
    double eye[3] = {0}, pixel[4] = {0};
    for (int column = 0; column < 4; column++) {
        for (int row = 0; row < 3; row++)
            eye[row] += (double)draw->eye[row][column] * at[column];
        for (int row = 0; row < 4; row++)
            pixel[row] += (double)draw->pixel[row][column] * at[column];
    }
    const double w = pixel[3];
    out.eye_position = v3(eye[0], eye[1], eye[2]);
    out.clip[0] = 2 * pixel[0] / width - w; // the frame's matrix maps positions to pixels, with y downwards
    out.clip[1] = w - 2 * pixel[1] / height;
    out.clip[2] = pixel[2];
    out.clip[3] = w;
    const double size[3] = {width, height, 1};
    for (int k = 0; k < 3; k++) {
        out.ndc[k] = w > 0 ? out.clip[k] / w : none;
        out.window[k] = (out.ndc[k] + 1) * size[k] / 2;
    }
    return out;
}

static const struct frame_draw *draw_of(const struct frame *frame, const lam_explained_fragment *fragment)
{
    for (int i = 0; i < frame->draw_count; i++)
        if (fragment->ground ? frame->draws[i].ground
                             : !frame->draws[i].ground && frame->draws[i].object == fragment->object)
            return &frame->draws[i];
    return NULL;
}

static void complete_matrices(struct recorder *recorder, lam_explained_fragment *fragment, const lam_object *object,
                              const lam_camera *camera, const struct frame *frame)
{
    lam_explained_matrices *matrices = recorder_alloc(recorder, 1, sizeof *matrices);
    if (!matrices)
        return;
    const lam_mat4 view = mat4_look_at(camera->eye, camera->target, camera->up);
    matrices->model_view = object ? mat4_mul(&view, &object->transform) : view;
    matrices->projection = camera_projection(camera, recorder->out->width, recorder->out->height,
                                             (double)frame->near_plane, (double)frame->far_plane);
    const double determinant = mat4_determinant3(&matrices->model_view);
    mat4_normal_matrix(&matrices->model_view, matrices->normal);
    for (int i = 0; i < 9; i++)
        matrices->normal[i / 3][i % 3] = determinant != 0 ? matrices->normal[i / 3][i % 3] / determinant : 0;
    fragment->matrices = matrices;
}

// Completes the positions, whose normals are already set.
static void complete_places(struct recorder *recorder, lam_explained_fragment *fragment, const struct frame *frame)
{
    const struct frame_draw *draw = draw_of(frame, fragment);
    lam_explained_place *places = (lam_explained_place *)(uintptr_t)fragment->places;
    if (!draw || !places)
        return;
    const lam_mesh *mesh = draw->mesh;
    const lam_vec3 origin = v3(mesh->origin[0], mesh->origin[1], mesh->origin[2]);
    const int width = recorder->out->width, height = recorder->out->height;
    lam_vec3 point = {0, 0, 0};
    for (size_t k = 0; k < 3; k++) {
        const size_t corner = 3 * (size_t)fragment->triangle + k;
        const float *given = mesh->positions + 3 * (mesh->indices ? mesh->indices[corner] : corner);
        lam_vec3 p = v3((double)given[0], (double)given[1], (double)given[2]);
        const lam_vec3 n = places[k].normal;
        places[k] = place_of(draw, origin, p, width, height);
        places[k].normal = v3_dot(n, n) > 0 ? v3_unit(n) : n;
        point = v3_add(point, v3_scale(p, (double)fragment->weights[k]));
    }
    places[3] = place_of(draw, origin, point, width, height);
    const double *a = places[0].window, *b = places[1].window, *c = places[2].window;
    fragment->winding = (c[0] - b[0]) * (a[1] - b[1]) - (c[1] - b[1]) * (a[0] - b[0]);
}

static void complete(struct recorder *recorder, const lam_scene *scene, const lam_camera *camera,
                     const struct frame *frame)
{
    for (int i = 0; i < recorder->out->fragment_count; i++) {
        lam_explained_fragment *fragment = &recorder->fragments[i];
        const lam_object *object = fragment->ground ? NULL : lam_scene_object(scene, fragment->object);
        const lam_mesh *mesh = object ? lam_scene_mesh(scene, object->mesh) : &frame->ground.mesh;
        fragment->object_name = object ? object->name : NULL;
        fragment->mesh = object ? object->mesh : -1;
        for (int k = 0; k < fragment->map_count; k++) {
            lam_explained_map *map = (lam_explained_map *)(uintptr_t)&fragment->maps[k];
            complete_map(map, fragment->surface.maps[map->map]);
        }
        fragment->corners = mesh->line_count ? 2 : mesh->point_count ? 1 : 3;
        if (mesh_is_strokes(mesh))
            fragment->triangle /= mesh->point_count ? (uint32_t)frame->point_triangles : 2;
        complete_places(recorder, fragment, frame);
        if (fragment->places)
            complete_matrices(recorder, fragment, object, camera, frame);
        for (int k = 0; k < fragment->point_count; k++) {
            lam_explained_point *point = (lam_explained_point *)(uintptr_t)&fragment->points[k];
            if (mesh_is_strokes(mesh)) {
                leave_eye_space(camera, object, point);
            } else {
                point->mesh_position =
                    v3_add(v3(mesh->origin[0], mesh->origin[1], mesh->origin[2]), point->mesh_position);
                point->world_position = mat4_point(object ? &object->transform : &identity, point->mesh_position);
            }
            complete_angles(point);
        }
    }
}

// An explanation and the arena that owns its memory.
struct explanation {
    lam_explanation values; // must come first, because its pointer is cast to the struct
    struct arena arena;
};

// Copies the frame's lights, because the next picture may overwrite them.
static void copy_lights(struct recorder *recorder, const struct frame *frame)
{
    lam_light *lights = recorder_alloc(recorder, (size_t)frame->light_count, sizeof *lights);
    for (int i = 0; lights && i < frame->light_count; i++)
        lights[i] = *frame->lights[i].source;
    recorder->out->lights = lights;
    recorder->out->light_count = lights ? frame->light_count : 0;
}

static void take_frame(lam_explanation *out, const struct frame *frame)
{
    out->samples = frame->settings.samples;
    out->color = frame->settings.color;
    out->shading = frame->settings.shading;
    out->reflection =
        out->fragment_count ? out->fragments[0].reflection : frame_reflection(frame, &frame->default_material);
    out->distant_viewer = frame->distant_viewer;
    out->gl1 = frame->settings.gl1;
    out->has_environment = frame->environment != NULL;
    out->background = frame->settings.background;
    out->exposure = frame->exposure;
    out->tone = frame->settings.tone;
    out->reference = frame->environment_lights ? frame->settings.reference : 0;
}

static bool check_place(const lam_device *device, const lam_draw_params *params, int width, int height,
                        lam_pixel_format format, int x, int y, lam_error *error)
{
    if (!device)
        return fail(error, LAM_BAD_ARGUMENT, "lam_explain: device is NULL");
    if (params && params->output != LAM_OUTPUT_PICTURE)
        return fail(error, LAM_BAD_ARGUMENT,
                    "explain: output is not the picture; an explanation contains all terms of the picture's pixel");
    if (lam_device_isa(device) == LAM_ISA_AUTO)
        return fail(error, LAM_UNSUPPORTED, "the device '%s' cannot explain its pixels, the CPU device can",
                    lam_device_name(device));
    if (format != LAM_RGBA8 && format != LAM_RGBA32F)
        return fail(error, LAM_BAD_ARGUMENT, "lam_explain: format is %d, expected LAM_RGBA8 or LAM_RGBA32F",
                    (int)format);
    if (x < 0 || y < 0 || x >= width || y >= height)
        return fail(error, LAM_BAD_ARGUMENT,
                    "pixel %d,%d is outside the picture of %d×%d pixels, expected 0,0 to %d,%d", x, y, width, height,
                    width - 1, height - 1);
    return true;
}

lam_explanation *lam_explain(lam_device *device, const lam_scene *scene, const lam_camera *camera,
                             const lam_draw_params *params, int width, int height, lam_pixel_format format, int x,
                             int y, const lam_control *control, lam_error *error)
{
    lam_image image = {0};
    if (!check_place(device, params, width, height, format, x, y, error) ||
        !lam_image_make(&image, width, height, format, error))
        return NULL;
    struct explanation *explanation = calloc(1, sizeof *explanation);
    if (!explanation) {
        fail_memory(error, sizeof *explanation);
        lam_image_free(&image);
        return NULL;
    }
    lam_explanation *out = &explanation->values;
    *out = (lam_explanation){.x = x, .y = y, .width = width, .height = height, .format = format};
    struct recorder recorder = {.out = out};
    arena_start(&recorder.arena, NULL);
    lam_draw_params surfaces = params ? *params : (lam_draw_params){0}; // wireframe and edges are not lit
    surfaces.wireframe = surfaces.no_surfaces = false;
    surfaces.edges = 0;
    surfaces.bounces = 0;
    device->recorder = &recorder;
    bool ok = true;
    if (params && params->bounces) {
        lam_draw_params paths = surfaces;
        paths.bounces = params->bounces;
        ok = lam_draw(device, scene, camera, &paths, &image, control, error);
    }
    ok = ok && lam_draw(device, scene, camera, &surfaces, &image, control, error);
    device->recorder = NULL;
    lam_image_free(&image);
    explanation->arena = recorder.arena;
    if (!ok) {
        lam_explanation_free(out);
        return NULL;
    }
    take_frame(out, &device->frame);
    out->stops = (params ? params->exposure : 0) + device->frame.brightened;
    copy_lights(&recorder, &device->frame);
    complete(&recorder, scene, camera, &device->frame);
    explanation->arena = recorder.arena; // the recorder's arena has grown, so it is copied back
    if (recorder.failed) {
        lam_explanation_free(out);
        fail(error, LAM_MACHINE, "out of memory");
        return NULL;
    }
    return out;
}

void lam_explanation_free(lam_explanation *explanation)
{
    if (!explanation)
        return;
    struct explanation *whole = (struct explanation *)explanation;
    arena_free(&whole->arena);
    free(whole);
}
