// frame.c: builds a frame from a scene, a camera and the draw parameters.
#include "frame.h"

#include "camera_lens.h"
#include "edges.h"
#include "environment.h"
#include "fail.h"
#include "fields.h"
#include "frame_ground.h"
#include "frame_lights.h"
#include "frame_strokes.h"
#include "linear.h"
#include "normals.h"
#include "rays.h"
#include "settings_check.h"
#include "up_axis.h"
#include "view_extents.h"

#include <lambent/light.h>

// Devices use the top bit of triangle numbers for other purposes.
#define TRIANGLES_MAX 0x7fffffffu

static float rounded(double x) { return (float)x; }

// Samples per pixel for pictures of at most TINY_SIDE² pixels, of at most SMALL_SIDE² pixels, and for larger pictures.
// With fewer samples, thin wires break into dashes.
enum { TINY_SIDE = 256, TINY_SAMPLES = 16, SMALL_SIDE = 512, SMALL_SAMPLES = 8, LARGE_SAMPLES = 4 };

int lam_default_samples(int width, int height)
{
    int64_t pixels = (int64_t)width * height;
    return pixels <= TINY_SIDE * TINY_SIDE     ? TINY_SAMPLES
           : pixels <= SMALL_SIDE * SMALL_SIDE ? SMALL_SAMPLES
                                               : LARGE_SAMPLES;
}

// Sets the near and the far plane so that they enclose all objects with a margin. In perspective, the near distance is
// at least 1/10000 of the far distance.
static void fit_planes(const lam_scene *scene, const lam_mat4 *view, bool orthographic, double *near_plane,
                       double *far_plane)
{
    lam_vec3 low, high;
    double nearest = 1e308, farthest = -1e308;
    *near_plane = 0.1;
    *far_plane = 100;
    if (!lam_scene_bounds(scene, &low, &high))
        return;
    for (int i = 0; i < 8; i++) {
        lam_vec3 corner = v3(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
        double distance = -mat4_point(view, corner).z;
        nearest = distance < nearest ? distance : nearest;
        farthest = distance > farthest ? distance : farthest;
    }
    double magnitude = farthest > 0 ? farthest : -farthest;
    double margin = (farthest - nearest) * 0.01 + magnitude * 1e-5;
    if (margin == 0)
        margin = 1e-6;
    *far_plane = farthest + margin;
    *near_plane = nearest - margin;
    if (!orthographic) {
        if (*far_plane <= 0) // all objects are behind the eye
            *far_plane = 1;
        if (*near_plane < *far_plane * 1e-4)
            *near_plane = *far_plane * 1e-4;
    }
}

// Returns the projection followed by the transform to pixels (y down), as the rows X·w, Y·w, z, w.
static lam_mat4 to_pixels(const lam_mat4 *projection, int width, int height)
{
    lam_mat4 m = *projection;
    for (int j = 0; j < 4; j++) {
        m.m[0][j] = (projection->m[0][j] + projection->m[3][j]) * (0.5 * width);
        m.m[1][j] = (projection->m[3][j] - projection->m[1][j]) * (0.5 * height);
    }
    return m;
}

// Sets up `draw` for an object and its mesh.
static void build_draw(struct frame_draw *draw, const lam_mesh *mesh, const lam_object *object, uint32_t first_id,
                       const lam_mat4 *view, const lam_mat4 *pixel)
{
    lam_mat4 origin = mat4_translate(mesh->origin[0], mesh->origin[1], mesh->origin[2]);
    lam_mat4 world = mat4_mul(&object->transform, &origin);
    lam_mat4 eye = mat4_mul(view, &world);
    lam_mat4 to_pixel = mat4_mul(pixel, &eye);
    double determinant = mat4_determinant3(&object->transform);
    *draw = (struct frame_draw){.mesh = mesh,
                                .first_id = first_id,
                                .mirrored = determinant < 0,
                                .one_sided = object->one_sided,
                                .cull = object->cull};
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            draw->pixel[i][j] = rounded(to_pixel.m[i][j]);
    double cofactors[3][3], largest = 0, largest_eye = 0;
    mat4_normal_matrix(&eye, cofactors);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            double c = cofactors[i][j] < 0 ? -cofactors[i][j] : cofactors[i][j];
            double e = eye.m[i][j] < 0 ? -eye.m[i][j] : eye.m[i][j];
            largest = c > largest ? c : largest;
            largest_eye = e > largest_eye ? e : largest_eye;
        }
    // The cofactor matrix is the inverse transpose times the determinant. Normals may have any length, so `scale`
    // removes only the determinant's sign.
    double scale = (draw->mirrored ? -1 : 1) / (largest > 0 ? largest : 1);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            draw->normal[i][j] = rounded(cofactors[i][j] * scale);
            draw->tangent[i][j] = rounded(eye.m[i][j] / (largest_eye > 0 ? largest_eye : 1));
        }
        for (int j = 0; j < 4; j++)
            draw->eye[i][j] = rounded(eye.m[i][j]);
    }
}

// Adds the ground as the frame's last triangles. The ground is lit like the scene. If an environment lights physical
// materials, the ground's material is physical; otherwise it is classic and matt.
static bool add_ground(struct frame *frame, uint64_t next, bool physical, const lam_mat4 *view, const lam_mat4 *pixel,
                       struct call_control *call, lam_error *error)
{
    struct frame_ground *ground = &frame->ground;
    if (!frame_ground_make(frame, view, pixel, call, error))
        return false;
    if (next + ground->mesh.triangle_count > TRIANGLES_MAX)
        return fail(error, LAM_LIMIT, "the scene has more than %u triangles", TRIANGLES_MAX);
    const lam_object object = {.transform = lam_mat4_identity(), .one_sided = true, .cull = LAM_CULL_BACK};
    struct frame_draw *draw = &frame->draws[frame->draw_count];
    build_draw(draw, &ground->mesh, &object, (uint32_t)next, view, pixel);
    draw->object = -1;
    draw->ground = true;
    draw->solid = frame->settings.bounces && ground->kind != LAM_GROUND_SHADOW;
    frame->passes_rays |= draw->solid; // it fades out
    ground->first_id = (uint32_t)next;
    bool by_environment = physical && frame->environment;
    lam_rgb color = frame->settings.ground_color;
    if (ground->kind == LAM_GROUND_SHADOW)
        color = (lam_rgb){1, 1, 1};
    else if (ground->kind == LAM_GROUND_CHECKER && color.r == 0 && color.g == 0 && color.b == 0)
        color = (lam_rgb){0.6f, 0.6f, 0.6f};
    lam_material *material = &ground->material;
    *material = lam_material_default();
    material->name = "ground";
    material->ambient = color;
    material->diffuse = (lam_rgba){color.r, color.g, color.b, 1};
    material->specular = material->emission = material->reflectivity = (lam_rgb){0, 0, 0};
    material->physical = by_environment;
    material->roughness = 1;
    material->alpha_mode = LAM_ALPHA_BLEND;
    frame->materials[frame->material_count] = material;
    bool blended = !output_is_value(frame->settings.output);
    frame->translucent |= blended;
    frame->ranges[frame->range_count++] =
        (struct frame_draw_range){ground->first_id,
                                  ground->mesh.triangle_count,
                                  frame->draw_count++,
                                  frame->material_count,
                                  frame->material_count,
                                  blended,
                                  by_environment ? LAM_REFLECTION_GGX : LAM_REFLECTION_LAMBERT,
                                  draw->solid,
                                  false};
    frame->material_count++;
    frame->triangle_count = (uint32_t)(next + ground->mesh.triangle_count);
    return true;
}

// Reserves storage for the frame's arrays, and divides it among them.
static bool allocate_arrays(struct frame *frame, const lam_scene *scene, struct call_control *call, lam_error *error)
{
    size_t objects = (size_t)scene->objects.count + 1, ranges = 1, strokes = 0, // the ground included
        lights = (size_t)scene->lights.count + LAM_RIG_LIGHTS_MAX + 1;
    for (int i = 0; i < scene->objects.count; i++) {
        const lam_mesh *mesh = scene_mesh(scene, scene_object(scene, i)->mesh);
        ranges += mesh->part_count ? mesh->part_count : 1;
        strokes += mesh_is_strokes(mesh);
    }
    size_t materials = 4 * ((size_t)scene->materials.count + 1) + 1,
           converted = frame_materials_to_convert(frame, scene);
    size_t bytes = objects * sizeof *frame->draws + ranges * sizeof *frame->ranges + lights * sizeof *frame->lights +
                   lights * sizeof *frame->hemispheres + (LAM_RIG_LIGHTS_MAX + 1) * sizeof *frame->rig +
                   materials * sizeof *frame->materials + converted * sizeof *frame->converted +
                   strokes * sizeof *frame->stroke_meshes + 64;
    if (!buffer_reserve(&frame->storage, bytes, call, error))
        return false;
    char *at = frame->storage.data;
    // Ranges are last, because they need the smallest alignment: all other elements contain a pointer or a double.
    frame->materials = (void *)at;
    at += materials * sizeof *frame->materials;
    frame->converted = (void *)at;
    at += converted * sizeof *frame->converted;
    frame->stroke_meshes = (void *)at;
    at += strokes * sizeof *frame->stroke_meshes;
    frame->draws = (void *)at;
    at += objects * sizeof *frame->draws;
    frame->lights = (void *)at;
    at += lights * sizeof *frame->lights;
    frame->hemispheres = (void *)at;
    at += lights * sizeof *frame->hemispheres;
    frame->rig = (void *)at;
    at += (LAM_RIG_LIGHTS_MAX + 1) * sizeof *frame->rig;
    frame->ranges = (void *)at;
    return true;
}

// Returns whether an output includes the light that physical materials reflect from the environment.
static bool shows_environment(lam_output output)
{
    return output_is_picture(output) || output == LAM_OUTPUT_DIFFUSE || output == LAM_OUTPUT_SPECULAR ||
           output == LAM_OUTPUT_ENVIRONMENT;
}

// Returns whether physical materials are lit with a physical model.
static bool uses_physical(const struct frame *frame)
{
    return frame->settings.reflection == LAM_REFLECTION_AUTO || frame_is_physical(frame->settings.reflection);
}

// Returns the built-in studio. The frame keeps the studio of the first scene for later scenes, because preparing the
// studio's light takes longer than drawing a small picture.
static const lam_environment *studio_of(struct frame *frame, const lam_scene *scene, lam_error *error)
{
    if (!frame->studio)
        frame->studio = cube_share(lazy_environment_studio(scene->studio, error));
    return frame->studio;
}

// Sets the environment, and the matrix from directions in eye space to the environment's axes. This matrix transforms
// eye space to world space, then the scene's up axis to +Y (as the fitted camera does), then applies the inverse of the
// environment's rotation.
static bool build_environment(struct frame *frame, const lam_scene *scene, const lam_mat4 *view, lam_error *error)
{
    bool lamp = wants_shadows(&frame->settings);
    frame->environment = scene->environment;
    if (!frame->environment && frame->settings.rig == LAM_RIG_AUTO && scene_lit_by_environment(scene) &&
        uses_physical(frame) &&
        (shows_environment(frame->settings.output) || frame->settings.output == LAM_OUTPUT_REFLECTION ||
         (lamp && lam_output_is_light(frame->settings.output))) &&
        !(frame->environment = studio_of(frame, scene, error)))
        return false;
    double s = math_sin(scene->environment_rotation_rad), c = math_cos(scene->environment_rotation_rad);
    for (int j = 0; j < 3; j++) {
        lam_vec3 axis = v3(view->m[j][0], view->m[j][1], view->m[j][2]); // eye axis j in world space
        lam_vec3 w = to_y_up(scene->up, axis);
        const double turned[3] = {c * w.x - s * w.z, w.y, s * w.x + c * w.z};
        for (int i = 0; i < 3; i++)
            frame->to_environment[i][j] = rounded(turned[i]);
    }
    return true;
}

// Decides for which draws the device computes facet normals at each point instead of before lighting. This is possible
// if each normal is used only for points of its own triangle.
static void leave_facets(struct frame *frame)
{
    if (!frame->makes_normals || frame->settings.shading != LAM_SHADING_PHONG || frame_has_rays(frame))
        return;
    frame->makes_normals = false;
    for (int i = 0; i < frame->draw_count; i++) {
        struct frame_draw *draw = &frame->draws[i];
        draw->facets = draw->crease_rad > 0 && draw->crease_rad <= FACET_CREASE_RAD;
        draw->crease_rad = draw->facets ? 0 : draw->crease_rad;
        frame->makes_normals |= draw->crease_rad > 0;
    }
}

// The radius of cavity shading, relative to half the diagonal of the scene's box.
#define CAVITY_RADIUS 0.05
// The smaller radius for LAM_TONE_CONTRAST, which shows narrow valleys. It is used if the scene is fine. Otherwise, dark
// lines would appear between the faces.
#define CONTRAST_CAVITY_RADIUS 0.02

// Selects the method of ambient occlusion. Call this function after the lights are set.
static void set_occlusion(struct frame *frame, const lam_scene *scene, bool physical)
{
    lam_draw_params *settings = &frame->settings;
    // A picture of one light or term uses the same occlusion as the whole picture.
    bool wanted =
        physical && (scene->environment || (settings->rig == LAM_RIG_AUTO && scene_lit_by_environment(scene)));
    for (int i = 0; i < scene->lights.count; i++)
        wanted |= lam_scene_light(scene, i)->occluded > 0;
    for (int i = 0; i < frame->rig_count; i++)
        wanted |= frame->rig[i].occluded > 0;
    bool lit = false; // whether an opaque surface is lit
    for (int i = 0; i < frame->range_count; i++)
        lit |= frame->ranges[i].reflection != LAM_REFLECTION_NONE &&
               (!frame->ranges[i].translucent || frame->draws[frame->ranges[i].draw].ground);
    wanted &= lit;
    bool shown = lam_output_is_light(settings->output) || settings->output == LAM_OUTPUT_CLIPPED;
    bool one_number = settings->output == LAM_OUTPUT_AMBIENT_OCCLUSION;
    bool automatic = !settings->occlusion;
    wanted &= ray_kernels_of(1) != NULL; // false in a build without effects
    if (automatic)
        settings->occlusion =
            one_number || (wanted && settings->shading == LAM_SHADING_PHONG) ? LAM_OCCLUSION_SCREEN : LAM_OCCLUSION_OFF;
    frame->widens_highlights = shown && (settings->specular_aa == LAM_SPECULAR_AA_ON ||
                                         (!settings->specular_aa && wanted && !settings->reference &&
                                          !settings->bounces && settings->shading == LAM_SHADING_PHONG));
    bool cavity = settings->cavity == LAM_CAVITY_ON ||
                  (!settings->cavity && automatic && wanted && settings->occlusion == LAM_OCCLUSION_SCREEN);
    // Paths find what is hidden. Only a ground that catches shadows is lit locally.
    if ((!shown && !one_number) || (settings->bounces && frame->ground.kind != LAM_GROUND_SHADOW)) {
        settings->occlusion = LAM_OCCLUSION_OFF;
        cavity = false;
    }
    lam_vec3 low, high;
    double half = lam_scene_bounds(scene, &low, &high) ? 0.5 * v3_length(v3_sub(high, low)) : 0;
    frame->occlusion_radius =
        settings->occlusion > LAM_OCCLUSION_OFF ? rounded(setting_number(settings, "ao_radius") * half) : 0;
    frame->cavity_radius =
        cavity ? rounded((frame->narrow_valleys ? CONTRAST_CAVITY_RADIUS : CAVITY_RADIUS) * half) : 0;
    if (frame->cavity_radius > 0 && settings->occlusion == LAM_OCCLUSION_OFF)
        settings->occlusion = LAM_OCCLUSION_SCREEN;
    if (!(half > 0))
        settings->occlusion = LAM_OCCLUSION_OFF; // the scene has no extent, so the occlusion radius would be 0
}

static void resolve_settings(struct frame *frame, const lam_draw_params *params, int width, int height)
{
    lam_draw_params *settings = &frame->settings;
    settings_resolve(params, settings);
    if (!params->paths && (settings->noise > 0 || settings->stop_after_s > 0))
        settings->paths = 65536;
    settings->occlusion_radius = params->occlusion_radius; // see setting_number
    frame->shown = params->output;
    if (output_rows[frame->shown].drawn)
        settings->output = output_rows[frame->shown].drawn;
    frame->width = width;
    frame->height = height;
    if (!settings->samples)
        settings->samples = lam_default_samples(width, height);
    if (settings->output != LAM_OUTPUT_PICTURE && settings->output != LAM_OUTPUT_CLIPPED)
        settings->bounces = 0;
    frame->path_bounces = settings->bounces;
    frame->path_first = frame->path_position = 0;
    frame->finished_tiles = NULL;
    frame->only_pixel = NULL;
    bool of_material = output_kind(params->output) == OUTPUT_MATERIAL;
    if (of_material)
        settings->shading = LAM_SHADING_PHONG;
    if (of_material || !settings->stage)
        settings->stage = settings->shading == LAM_SHADING_GOURAUD ? LAM_STAGE_VERTEX : LAM_STAGE_FRAGMENT;
    if (of_material && !frame_is_physical(params->reflection))
        settings->reflection = LAM_REFLECTION_AUTO;
}

// Sets the planes of the projection, and the distances that LAM_OUTPUT_DEPTH draws black and white.
static void set_planes(struct frame *frame, const lam_scene *scene, const lam_mat4 *view, double near_plane,
                       double far_plane)
{
    frame->near_plane = rounded(near_plane);
    frame->far_plane = rounded(far_plane);
    frame->depth_near = frame->depth_far = 0;
    double nearest, farthest;
    if (frame->settings.output == LAM_OUTPUT_DEPTH && view_extents_depth(scene, view, &nearest, &farthest)) {
        frame->depth_near = rounded(nearest > near_plane ? nearest : near_plane);
        frame->depth_far = rounded(farthest < far_plane ? farthest : far_plane);
    }
}

// Adds the scene's objects, with consecutive triangle numbers.
static bool build_draws(struct frame *frame, const lam_scene *scene, const struct stroke_view *strokes,
                        struct call_control *call, lam_error *error)
{
    uint64_t next = 0;
    int first_part = 0, parts = 0;
    for (int i = 0; i < scene->objects.count; i++, first_part += parts) {
        const lam_mesh *mesh = scene_mesh(scene, scene_object(scene, i)->mesh);
        parts = mesh->part_count ? (int)mesh->part_count : 1;
        uint64_t triangles = mesh_is_strokes(mesh)
                                 ? stroke_triangles(mesh, strokes->point_corners) * (uint64_t)mesh_items(mesh)
                                 : mesh->triangle_count;
        if (!triangles || !scene_shows(scene, i) || (frame->settings.no_surfaces && !mesh_is_strokes(mesh)))
            continue;
        if (next + triangles > TRIANGLES_MAX)
            return fail(error, LAM_LIMIT, "the scene has more than %u triangles", TRIANGLES_MAX);
        if (!call_check_triangles(call, "the scene", next + triangles, "triangles", error))
            return false;
        struct frame_draw *draw = &frame->draws[frame->draw_count];
        build_draw(draw, mesh, scene_object(scene, i), (uint32_t)next, strokes->view, strokes->pixel);
        draw->object = i;
        draw->first_part = first_part;
        draw->crease_rad = mesh->normals ? 0 : scene->deferred_crease_rad;
        if (mesh_is_strokes(mesh))
            frame_strokes_build(frame, draw, &scene_object(scene, i)->transform, strokes);
        frame->makes_normals |= draw->crease_rad > 0;
        frame_ranges_build(frame, scene, frame->draw_count++);
        next += triangles;
    }
    frame->triangle_count = (uint32_t)next;
    return true;
}

static void set_tone(struct frame *frame, const lam_scene *scene, bool physical)
{
    lam_draw_params *settings = &frame->settings;
    if (!physical)
        settings->tone = lam_draw_tone(scene, settings);
    if (!settings->tone)
        settings->tone = physical && settings->color != LAM_COLOR_RAW ? LAM_TONE_KHRONOS_NEUTRAL : LAM_TONE_NONE;
    const bool contrast = settings->tone == LAM_TONE_CONTRAST;
    frame->narrow_valleys = contrast && scene_is_fine(scene);
    frame->deep_valleys = frame->narrow_valleys || (!physical && scene_form(scene) == FORM_FLAT);
    if (!lam_output_is_light(settings->output))
        settings->tone = LAM_TONE_NONE;
}

static void leave_normals(struct frame *frame)
{
    // Flat shading uses face normals; coverage and overdraw need no normals.
    if (lam_output_is_light(frame->settings.output)
            ? frame->settings.shading == LAM_SHADING_FLAT && frame->settings.flat_normal == LAM_FLAT_NORMAL_FACE
            : frame->settings.output == LAM_OUTPUT_COVERAGE || frame->settings.output == LAM_OUTPUT_OVERDRAW ||
                  output_kind(frame->settings.output) == OUTPUT_MATERIAL)
        frame->makes_normals = false;
}

// Sets the background for glass, and the matrix from eye space to the picture.
static void set_glass(struct frame *frame, const lam_mat4 *pixel)
{
    static const lam_rgba white = {1, 1, 1, 1};
    if (frame->settings.background_environment > 0)
        frame->settings.background = (lam_rgba){0, 0, 0, 0}; // sky.h
    bool clear =
        // a picture of a single term excludes the background
        frame->settings.background.a <= 0 && output_is_picture(frame->settings.output);
    const lam_rgba *back = clear ? &white : &frame->settings.background;
    for (int c = 0; c < 3; c++)
        frame->glass_background[c] = (&back->r)[c] * back->a / frame->exposure;
    frame->glass_background[3] = back->a;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            frame->eye_pixel[i][j] = rounded(pixel->m[i == 2 ? 3 : i][j]);
}

bool frame_build(struct frame *frame, const lam_scene *scene, const lam_camera *camera, const lam_draw_params *params,
                 int width, int height, struct call_control *call, lam_error *error)
{
    if (!frame_camera_check(camera, error) || !frame_params_check(params, error))
        return false;
    const double ratio = camera->width ? (double)camera->width * height / ((double)camera->height * width) : 1;
    if (!(ratio > 0.99 && ratio < 1.01))
        return fail(error, LAM_BAD_ARGUMENT,
                    "camera: is for pictures of %dx%d pixels, but this one has %dx%d, another ratio", camera->width,
                    camera->height, width, height);
    resolve_settings(frame, params, width, height);
    const lam_draw_params *settings = &frame->settings;
    frame->lights_classic = scene->environment && !scene->reflection_map;
    if (!allocate_arrays(frame, scene, call, error))
        return false;
    frame->token = scene->token;
    frame->orthographic = camera->ortho_half_height > 0;
    frame->distant_viewer = frame->orthographic || settings->viewer == LAM_VIEWER_INFINITE;
    frame->draw_count = frame->range_count = frame->light_count = frame->hemisphere_count = 0;
    frame->triangle_count = 0;
    frame->translucent = frame->passes_rays = frame->tints_rays = frame->masked = frame->transmits = frame->refracts =
        frame->makes_normals = false;

    frame_materials_build(frame, scene);

    lam_mat4 view = mat4_look_at(camera->eye, camera->target, camera->up);
    frame_ground_place(frame, scene, camera, &view);
    double near_plane = camera->near_plane, far_plane = camera->far_plane;
    const struct camera_lens lens = camera_lens_of(camera, width, height);
    struct stroke_view stroke_view = {.view = &view, .orthographic = frame->orthographic};
    frame_strokes_size(&stroke_view, scene, frame);
    frame->point_triangles = (int)stroke_view.point_corners - 2;
    if (near_plane == 0 && far_plane == 0) {
        fit_planes(scene, &view, frame->orthographic, &near_plane, &far_plane);
        if (frame->ground.kind)
            frame_ground_planes(&frame->ground, &view, frame->orthographic, &near_plane, &far_plane);
        frame_strokes_near(scene, &stroke_view, lens.pixel[1], &near_plane);
    }
    set_planes(frame, scene, &view, near_plane, far_plane);
    const lam_mat4 projection = camera_projection(camera, width, height, near_plane, far_plane);
    if (!build_environment(frame, scene, &view, error))
        return false;
    lam_mat4 pixel = to_pixels(&projection, width, height);

    stroke_view.projection = &projection;
    stroke_view.pixel = &pixel;
    stroke_view.near_plane = near_plane;
    if (!frame_strokes_reserve(frame, scene, &stroke_view, call, error))
        return false;
    if (!build_draws(frame, scene, &stroke_view, call, error))
        return false;
    frame->brightened = frame_brighten_stops(frame, scene);
    frame->exposure = rounded(math_exp2(params->exposure + frame->brightened));
    set_glass(frame, &pixel);
    bool physical = false;
    for (int i = 0; i < frame->range_count; i++)
        physical |= frame_is_physical(frame->ranges[i].reflection);
    if (frame->ground.kind && !add_ground(frame, frame->triangle_count, physical, &view, &pixel, call, error))
        return false;
    frame->environment_lights = physical && frame->environment && shows_environment(frame->settings.output);
    leave_normals(frame);
    // If the reflection model is classic, the studio rig lights the materials that the environment would otherwise
    // light.
    bool by_rig = settings->rig == LAM_RIG_AUTO && !scene->lights.count && !uses_physical(frame);
    set_tone(frame, scene, physical);
    if (!frame_lights_build(frame, scene, by_rig ? LAM_RIG_STUDIO : settings->rig,
                            lam_output_is_one_light(frame->settings.output) ? settings->output_light : -1, &view,
                            error))
        return false;
    frame->separate_lamp = false;
    if (!frame_lights_add_lamp(frame, scene, &view, call, error))
        return false;
    frame->settings.shadows =
        (wants_shadows(settings) || settings->bounces) &&
        (lam_output_is_light(frame->settings.output) || frame->settings.output == LAM_OUTPUT_CLIPPED);
    frame->pixel_size = rounded(lens.pixel[1]);
    frame->pixel_aspect = rounded(lens.pixel[0] / lens.pixel[1]);
    for (int i = 0; i < 2; i++)
        frame->middle[i] = rounded(lens.middle[i]);
    set_occlusion(frame, scene, physical);
    for (int i = 0; i < 9; i++)
        frame->to_world[i / 3][i % 3] = rounded(view.m[i % 3][i / 3]);
    frame_edges_build(frame, scene, &view, &pixel);
    leave_facets(frame);
    if (frame_has_rays(frame) || frame->draws_edges)
        frame_rays_build(frame, scene, &view);
    return true;
}

void frame_free(struct frame *frame)
{
    buffer_free(&frame->storage);
    buffer_free(&frame->strokes);
    buffer_free(&frame->ground.memory);
    lam_environment_free(frame->studio);
    frame->studio = NULL;
}
