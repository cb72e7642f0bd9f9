// layers.c: scenes of spheres with physical materials and layers: index of refraction, clear coat, sheen, anisotropy,
// iridescence, transmission.
#include "textured.h"

#include <lambent/light.h>

enum { SPHERES = 8 };

static lam_material base_material(float metallic, float roughness)
{
    lam_material m = lam_material_default();
    m.diffuse = (lam_rgba){0.6f, 0.18f, 0.06f, 1};
    m.ambient = (lam_rgb){0.6f, 0.18f, 0.06f};
    m.physical = true;
    m.metallic = metallic;
    m.roughness = roughness;
    return m;
}

static void make_materials(lam_material m[SPHERES])
{
    m[0] = base_material(0, 0.3f);
    m[0].ior = 2.4f;
    m[1] = base_material(0, 0.3f);
    m[1].specular_weight = 0.8f;
    m[1].f0_color = (lam_rgb){0.5f, 4, 9};
    m[2] = base_material(0.3f, 0.8f);
    m[2].clearcoat = 1;
    m[2].clearcoat_roughness = 0.15f;
    m[3] = base_material(0, 0.9f);
    m[3].sheen_color = (lam_rgb){0.9f, 0.5f, 0.7f};
    m[3].sheen_roughness = 0.4f;
    m[4] = base_material(1, 0.35f);
    m[4].anisotropy = 0.9f;
    m[4].anisotropy_rotation_rad = 0.6f;
    m[5] = base_material(1, 0.3f);
    m[5].iridescence = 1;
    m[5].iridescence_thickness_max = 480;
    m[6] = base_material(0, 0.3f);
    m[6].iridescence = 0.8f;
    m[6].iridescence_ior = 1.8f;
    m[6].emission = (lam_rgb){0.05f, 0.1f, 0};
    m[6].clearcoat = 0.5f;
    m[7] = m[2]; // all layers
    m[7].ior = 1.8f;
    m[7].sheen_color = (lam_rgb){0.2f, 0.3f, 0.5f};
    m[7].sheen_roughness = 0.6f;
    m[7].anisotropy = 0.7f;
    m[7].iridescence = 0.5f;
}

bool layers_uniform(struct demo *d, lam_error *error)
{
    lam_shape_params params = {.slices = 32, .stacks = 24};
    lam_material m[SPHERES];
    lam_object o = lam_object_default();
    make_materials(m);
    o.mesh = lam_scene_add_shape(d->scene, "sphere", &params, error);
    bool ok = o.mesh >= 0;
    for (int i = 0; ok && i < SPHERES; i++) {
        o.material = lam_scene_add_material(d->scene, &m[i], error);
        o.transform.m[0][3] = 2.2 * (i % 4);
        o.transform.m[1][3] = i < 4 ? 2.2 : 0;
        ok = o.material >= 0 && lam_scene_add_object(d->scene, &o, error) >= 0;
    }
    return ok && textured_light_up(d, error);
}

bool layers_gouraud(struct demo *d, lam_error *error)
{
    d->params.shading = LAM_SHADING_GOURAUD;
    return layers_uniform(d, error);
}

bool layers_environment(struct demo *d, lam_error *error)
{
    return layers_uniform(d, error) && textured_surround(d, "studio", 0, error);
}

bool layers_mapped_environment(struct demo *d, lam_error *error)
{
    d->params.shading = LAM_SHADING_GOURAUD;
    return textured_layers(d, error) && textured_surround(d, "studio", 0, error);
}

// Squares that face the eye, with normals that lean. The normals at the left side of each square face away from the
// eye, and the light comes from the left. The materials are a metal, a brushed metal, sheen, and a coat.
bool layers_leaning(struct demo *d, lam_error *error)
{
    static const float positions[] = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0};
    static const float normals[] = {-1, 0, -0.5f, -0.2f, 0, 1, -0.2f, 0, 1, -1, 0.3f, -0.5f};
    static const uint32_t indices[] = {0, 1, 2, 0, 2, 3};
    lam_mesh mesh = {.positions = positions,
                     .vertex_count = 4,
                     .normals = normals,
                     .normal_count = 4,
                     .indices = indices,
                     .triangle_count = 2};
    lam_material m[SPHERES];
    lam_object o = lam_object_default();
    make_materials(m);
    m[5].iridescence = 0;
    m[5].roughness = 0.6f;
    m[7].metallic = 1;
    o.mesh = lam_scene_add_mesh(d->scene, &mesh, error);
    bool ok = o.mesh >= 0;
    for (int i = 0; ok && i < 4; i++) {
        static const int of[4] = {5, 4, 3, 7};
        o.material = lam_scene_add_material(d->scene, &m[of[i]], error);
        o.transform.m[0][3] = 2.2 * i;
        ok = o.material >= 0 && lam_scene_add_object(d->scene, &o, error) >= 0;
    }
    lam_light light = lam_light_default(LAM_LIGHT_DIRECTIONAL);
    light.direction = (lam_vec3){1, 0.1, -0.3};
    d->camera = lam_camera_fit(d->scene, d->width, d->height, NULL);
    return ok && lam_scene_add_light(d->scene, &light, error) >= 0;
}

// Balls of coloured glass in front of a white box and of one another, over a background. The last ball is tinted by its
// volume. With `refracts`, the first ball is rough, the second is thick, and the last is both. Otherwise light goes
// straight through the balls.
static bool glass_balls(struct demo *d, bool refracts, lam_error *error)
{
    static const lam_rgba colors[3] = {{1, 0.8f, 0.1f, 1}, {0.2f, 0.9f, 0.4f, 1}, {0.9f, 0.9f, 0.9f, 1}};
    lam_shape_params params = {.slices = 32, .stacks = 24};
    lam_object o = lam_object_default();
    lam_material white = lam_material_default();
    int ball = lam_scene_add_shape(d->scene, "sphere", &params, error);
    o.mesh = lam_scene_add_shape(d->scene, "cube", &params, error);
    o.material = lam_scene_add_material(d->scene, &white, error);
    o.transform.m[0][0] = 2;
    o.transform.m[1][1] = o.transform.m[2][2] = 0.5;
    o.transform.m[2][3] = -1.5;
    bool ok = ball >= 0 && o.mesh >= 0 && o.material >= 0 && lam_scene_add_object(d->scene, &o, error) >= 0;
    for (int i = 0; ok && i < 3; i++) {
        lam_material m = base_material(0, i == 2 || (i == 0 && refracts) ? 0.4f : 0);
        m.diffuse = colors[i];
        m.alpha_mode = LAM_ALPHA_OPAQUE;
        m.ior = i == 2 && !refracts ? 1 : 1.5f;
        m.transmission = i == 1 ? 0.6f : 1;
        m.thickness = i == 2 ? 0.8f : i == 1 && refracts ? 1.5f : 0;
        m.attenuation_distance = i == 2 ? 0.5f : 0;
        m.attenuation_color = (lam_rgb){0.9f, 0.3f, 0.5f};
        m.clearcoat = i == 0 ? 0.5f : 0;
        m.clearcoat_roughness = 0.3f;
        o = lam_object_default();
        o.mesh = ball;
        o.material = lam_scene_add_material(d->scene, &m, error);
        o.transform.m[0][3] = 1.5 * (i - 1);
        o.transform.m[2][3] = 0.4 * i;
        o.cull = refracts ? LAM_CULL_BACK : LAM_CULL_NONE;
        ok = o.material >= 0 && lam_scene_add_object(d->scene, &o, error) >= 0;
    }
    d->params.background = (lam_rgba){0.5f, 0.6f, 0.9f, 1};
    return ok && textured_light_up(d, error);
}

bool layers_transmission(struct demo *d, lam_error *error) { return glass_balls(d, false, error); }
bool layers_refraction(struct demo *d, lam_error *error) { return glass_balls(d, true, error); }
