// check_expect.c: draws the reference pictures, which show the output of correct shaders.
#include "check_run.h"

#include <string.h>

#include "arena.h"
#include "expectation.h"
#include "fail.h"
#include "render_cache.h"
#include "shader_interface.h"

// Returns x^(1/2.2) for x from 0 to 1. Newton's method solves y^11 = x^5 for y, starting at 1.
static double gamma_encoded(double x)
{
    double power = x * x * x * x * x, y = 1;
    for (int i = 0; i < 200 && x > 0; i++) {
        double y2 = y * y, y5 = y2 * y2 * y, step = (y5 * y5 * y - power) / (11 * y5 * y5);
        y -= step;
        if (step < 1e-9)
            break;
    }
    return x > 0 ? y : 0;
}

// Converts the light of a point to the colour that shaders with metalness and roughness write.
static void display(const struct physical_convention *c, float *pixels, size_t count)
{
    for (size_t i = 0; i < 4 * count; i++)
        if (i % 4 != 3) {
            double x = (double)pixels[i];
            x = c->tone == TONE_REINHARD ? x / (1 + x) : x;
            pixels[i] = (float)(c->encoding == ENCODING_GAMMA ? gamma_encoded(x < 1 ? x : 1) : x);
        }
}

// Returns whether the CPU device can draw the references. The device uses glTF's own equations, and the fault shader
// draws all other forms.
static bool is_of_device(const struct run *r)
{
    const struct physical_convention *c = &r->interface.contract->physical;
    return !r->interface.physical || (c->masking == MASKING_SMITH && c->diffuse == DIFFUSE_OF_DIELECTRIC);
}

static bool draw_by_shader(struct run *r, struct scene_comparison *scene, lam_error *error)
{
    const lam_check_params *p = r->params;
    const fault_set none = {0};
    if (!r->shader && !(r->shader = render_cache_take_shader(p->cache, &r->painter, r->size, 1, error)))
        return false;
    struct fault_model model = {&r->interface, r->frame, r->reflection};
    return fault_shader_draw(r->shader, &scene->reference_scene, &model, &none, scene->reference, error);
}

// Makes a scene that contains only the surfaces. If the shaders do not light both sides, the surfaces are one-sided.
static lam_scene *surfaces_of(const struct run *r, const struct reference_scene *s, lam_camera *camera,
                              lam_error *error)
{
    lam_scene *world = reference_to_scene(s, camera, error);
    if (world && !(r->interface.supports & NEED_TWO_SIDES)) {
        lam_object object = *lam_scene_object(world, 0);
        object.one_sided = true;
        lam_scene_set_object(world, 0, &object, NULL);
    }
    return world;
}

static bool draw_reference(struct run *r, lam_device *device, struct scene_comparison *scene, lam_error *error)
{
    const lam_vec3 bump = scene->reference_scene.bump;
    if (!is_of_device(r) || bump.x != 0 || bump.y != 0 || bump.z != 0) // only the fault shader draws such scenes
        return draw_by_shader(r, scene, error);
    lam_camera camera;
    struct reference_scene opaque = scene->reference_scene; // the shader under test is drawn without blending
    opaque.alpha = 1;
    lam_scene *world = surfaces_of(r, &opaque, &camera, error);
    lam_image image = {0};
    lam_draw_params draw = {
        .samples = 1,
        .rig = LAM_RIG_NONE,
        .reflection = r->reflection,
        .shading = scene->reference_scene.flat ? LAM_SHADING_FLAT
                   : r->interface.vertex_lit   ? LAM_SHADING_GOURAUD
                                               : LAM_SHADING_PHONG,
        .flat_normal = LAM_FLAT_NORMAL_VERTEX,
        .viewer = r->interface.infinite_viewer ? LAM_VIEWER_INFINITE : LAM_VIEWER_LOCAL,
        .gl1 = r->interface.gl1,
        .single_scattering = !r->interface.multiple_scattering,
    };
    bool ok = world && lam_image_make(&image, r->size, r->size, LAM_RGBA32F, error) &&
              lam_draw(device, world, &camera, &draw, &image, NULL, error);
    if (ok) {
        memcpy(scene->reference, image.pixels, 4 * (size_t)r->size * (size_t)r->size * sizeof(float));
        for (size_t i = 0; i < (size_t)r->size * (size_t)r->size; i++)
            scene->reference[4 * i + 3] *= scene->reference_scene.alpha;
        scene_comparison_apply_tone(r->interface.printed_tone, scene->reference, (size_t)r->size * (size_t)r->size);
        if (r->interface.physical)
            display(&r->interface.contract->physical, scene->reference, (size_t)r->size * (size_t)r->size);
    }
    lam_image_free(&image);
    lam_scene_free(world);
    return ok;
}

// Excludes pixels in which the surface normal changes, for example at edges in front of other surfaces. A browser's GPU
// may round corners to 1/16 of a pixel (WebGL: SUBPIXEL_BITS is at least 4), and the CPU device rounds them to 1/256.
// A difference in such pixels is therefore no evidence of a mistake.
static bool leave_out_turns(struct run *r, lam_device *device, struct scene_comparison *scene, lam_error *error)
{
    if (!r->painter.es_only || !is_of_device(r))
        return true;
    lam_camera camera;
    lam_image image = {0};
    struct reference_scene opaque = scene->reference_scene;
    opaque.alpha = 1;
    lam_scene *world = surfaces_of(r, &opaque, &camera, error);
    lam_draw_params draw = {.samples = 1,
                            .rig = LAM_RIG_NONE,
                            .output = LAM_OUTPUT_NORMALS,
                            .shading = opaque.flat ? LAM_SHADING_FLAT : LAM_SHADING_PHONG,
                            .flat_normal = LAM_FLAT_NORMAL_VERTEX};
    bool ok = world && lam_image_make(&image, r->size, r->size, LAM_RGBA32F, error) &&
              lam_draw(device, world, &camera, &draw, &image, NULL, error);
    if (ok)
        scene_comparison_leave_out_turns(scene, image.pixels, r->size);
    lam_image_free(&image);
    lam_scene_free(world);
    return ok;
}

// A possible expectation: bits of enum expectation.
struct candidate {
    unsigned expectation;
    double mean; // mean difference
    bool fits;
};

// Draws the references of the first `scene_count` scenes, and measures the difference.
static bool try_candidate(struct run *r, lam_device *device, int scene_count, struct candidate *c, lam_error *error)
{
    r->expectation = c->expectation;
    c->mean = 0;
    c->fits = true;
    for (int i = 0; i < scene_count; i++) {
        struct scene_comparison *scene = &r->scenes[i];
        scene->reference_scene = shader_interface_scene(&r->interface, scene->row);
        expectation_apply(c->expectation, &scene->reference_scene);
        if (!draw_reference(r, device, scene, error))
            return false;
        scene_comparison_find_inside(scene, r->size);
        if (!leave_out_turns(r, device, scene, error))
            return false;
        scene_comparison_sample(scene, scene->theirs, scene->samples);
        scene_comparison_sample(scene, scene->reference, r->numbers);
        struct difference d = scene_comparison_difference(scene, r->numbers, r->tolerance);
        c->mean += d.mean / scene_count;
        c->fits = c->fits && d.fits;
    }
    return true;
}

bool check_draw_references(struct run *r, lam_error *error)
{
    unsigned choices[MAX_EXPECTATIONS];
    int count = expectations_of(&r->interface, r->params->terms, choices);
    lam_device *device = lam_device_cpu(NULL, error);
    struct candidate best = {.mean = 1e9};
    bool ok = device;
    for (int i = 0; ok && !best.fits && i < count; i++) {
        struct candidate c = {.expectation = choices[i]};
        ok = try_candidate(r, device, r->scene_count, &c, error);
        if (ok && (c.fits || c.mean < best.mean))
            best = c;
    }
    if (ok && !best.fits) // the last combination may not be the best
        ok = try_candidate(r, device, r->scene_count, &best, error);
    lam_device_free(device);
    render_cache_keep_shader(r->params->cache, r->shader);
    r->shader = NULL;
    char text[400];
    expectation_describe(r->expectation, &r->interface, r->params->terms, text, sizeof text);
    if (ok && text[0] && r->interface.printed_model != LAM_REFLECTION_NONE)
        diagnostics_add(&r->diagnostics, LAM_CHECK_DIAGNOSTIC_HINT, NULL, 0, "%s", text);
    return ok;
}
