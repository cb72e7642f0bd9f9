// textured.c: scenes whose materials have maps. The pictures of the maps are computed with whole numbers only, so that
// they are the same on every machine.
#include "textured.h"

#include <lambent/light.h>

#include <string.h>

enum { SIDE = 48 }; // not a power of two

static int random_byte(unsigned *state)
{
    *state = *state * 1664525u + 1013904223u;
    return (int)(*state >> 24);
}

// Computes the channels of one pixel of a picture of SIDE² pixels.
typedef void pixel_fn(int x, int y, unsigned *state, uint8_t out[4]);

static lam_texture *paint(pixel_fn *pixel, lam_texture_values values, const char *name, lam_error *error)
{
    static const int bytes = SIDE * SIDE * 4;
    uint8_t pixels[SIDE * SIDE * 4];
    unsigned state = 7;
    memset(pixels, 255, (size_t)bytes);
    for (int i = 0; i < SIDE * SIDE; i++)
        pixel(i % SIDE, i / SIDE, &state, pixels + 4 * (size_t)i);
    lam_image image = {.width = SIDE, .height = SIDE, .format = LAM_RGBA8, .pixels = pixels};
    return lam_texture_make(&image, values, name, error);
}

// Bricks with joints.
static bool is_joint(int x, int y) { return y % 12 == 0 || (x + y / 12 % 2 * 12) % 24 == 0; }

static void brick_color(int x, int y, unsigned *state, uint8_t out[4])
{
    int noise = random_byte(state) / 8;
    out[0] = (uint8_t)(is_joint(x, y) ? 170 : 150 + noise);
    out[1] = (uint8_t)(is_joint(x, y) ? 165 : 60 + noise);
    out[2] = (uint8_t)(is_joint(x, y) ? 150 : 40 + noise / 2);
}

// The channels are occlusion, roughness and metalness, as in glTF.
static void brick_numbers(int x, int y, unsigned *state, uint8_t out[4])
{
    out[0] = is_joint(x, y) ? 60 : 255;
    out[1] = (uint8_t)(is_joint(x, y) ? 230 : 70 + random_byte(state) / 4);
    out[2] = x / 24 % 2 == y / 24 % 2 ? 230 : 20;
}

static void brick_normal(int x, int y, unsigned *state, uint8_t out[4])
{
    (void)state;
    out[0] = (uint8_t)(is_joint(x + 1, y) && !is_joint(x, y) ? 190 : 128);
    out[1] = (uint8_t)(is_joint(x, y + 1) && !is_joint(x, y) ? 60 : 128);
    out[2] = 240;
}

static void glow(int x, int y, unsigned *state, uint8_t out[4])
{
    (void)state;
    bool lit = (x - 12) * (x - 12) + (y - 30) * (y - 30) < 25;
    out[0] = out[1] = lit ? 220 : 0;
    out[2] = lit ? 60 : 0;
}

static void leaves(int x, int y, unsigned *state, uint8_t out[4])
{
    int u = x % 16 - 8, v = y % 16 - 8, noise = random_byte(state) / 4;
    out[0] = (uint8_t)(40 + noise / 2);
    out[1] = (uint8_t)(110 + noise);
    out[2] = 40;
    out[3] = (uint8_t)(u * u + 3 * v * v < 60 ? 255 : u * u + 3 * v * v < 80 ? 128 : 0);
}

static bool add_textured(struct demo *d, const char *shape, lam_material *m, lam_vec3 move, lam_error *error)
{
    lam_shape_params params = {.slices = 32, .stacks = 24};
    lam_object o = lam_object_default();
    o.mesh = lam_scene_add_shape(d->scene, shape, &params, error);
    o.material = lam_scene_add_material(d->scene, m, error);
    o.transform.m[0][3] = move.x;
    o.transform.m[1][3] = move.y;
    o.transform.m[2][3] = move.z;
    return o.mesh >= 0 && o.material >= 0 && lam_scene_add_object(d->scene, &o, error) >= 0;
}

bool textured_light_up(struct demo *d, lam_error *error)
{
    lam_light l = lam_light_default(LAM_LIGHT_POINT);
    l.position = (lam_vec3){3, 4, 5};
    l.diffuse = l.specular = (lam_rgb){0.8f, 0.8f, 0.8f};
    lam_scene_set_ambient(d->scene, (lam_rgb){0.15f, 0.15f, 0.18f});
    d->params.rig = LAM_RIG_NONE;
    d->camera = lam_camera_fit(d->scene, d->width, d->height, NULL);
    return lam_scene_add_light(d->scene, &l, error) >= 0;
}

enum { PICTURES = 4 };

static bool bricks(struct demo *d, bool physical, lam_error *error)
{
    lam_texture *t[PICTURES] = {paint(brick_color, LAM_TEXTURE_COLOR, "bricks", error),
                                paint(brick_numbers, LAM_TEXTURE_NUMBERS, "numbers", error),
                                paint(brick_normal, LAM_TEXTURE_NUMBERS, "normals", error),
                                paint(glow, LAM_TEXTURE_COLOR, "glow", error)};
    bool ok = t[0] && t[1] && t[2] && t[3];
    const float turned[2][3] = {{2, 0.5f, 0.1f}, {-0.5f, 2, 0.3f}};
    lam_texture_map color = {.texture = t[0]}, normal = {.texture = t[2], .scale = 0.8f, .wrap_s = LAM_WRAP_MIRROR};
    lam_texture_map occlusion = {.texture = t[1], .scale = 0.75f, .offset = 0.25f};
    lam_texture_map roughness = {.texture = t[1], .channel = 1}, metallic = {.texture = t[1], .channel = 2};
    lam_texture_map emission = {.texture = t[3], .wrap_s = LAM_WRAP_CLAMP, .magnify = LAM_FILTER_NEAREST};
    memcpy(color.transform, turned, sizeof turned);
    memcpy(normal.transform, turned, sizeof turned);
    lam_material m = lam_material_default();
    m.diffuse = (lam_rgba){1, 1, 1, 1};
    m.ambient = (lam_rgb){1, 1, 1};
    m.emission = (lam_rgb){0.8f, 0.8f, 0.8f};
    m.specular = (lam_rgb){0.5f, 0.5f, 0.5f};
    m.physical = physical;
    m.metallic = m.roughness = 1;
    m.shininess = 40;
    m.maps[LAM_MAP_DIFFUSE] = &color;
    m.maps[LAM_MAP_NORMAL] = &normal;
    m.maps[LAM_MAP_EMISSION] = &emission;
    m.maps[LAM_MAP_OCCLUSION] = &occlusion;
    m.maps[physical ? LAM_MAP_ROUGHNESS : LAM_MAP_SHININESS] = &roughness;
    m.maps[physical ? LAM_MAP_METALLIC : LAM_MAP_SPECULAR] = physical ? &metallic : &occlusion;
    ok = ok && add_textured(d, "sphere", &m, (lam_vec3){-1.1, 0, 0}, error) &&
         add_textured(d, "torus", &m, (lam_vec3){1.2, 0, 0}, error) && textured_light_up(d, error);
    for (int i = 0; i < PICTURES; i++)
        lam_texture_free(t[i]);
    return ok;
}

bool textured_physical(struct demo *d, lam_error *error) { return bricks(d, true, error); }
bool textured_classic(struct demo *d, lam_error *error) { return bricks(d, false, error); }

bool textured_gouraud(struct demo *d, lam_error *error)
{
    d->params.shading = LAM_SHADING_GOURAUD;
    return bricks(d, false, error);
}

bool textured_surround(struct demo *d, const char *name, double rotation_rad, lam_error *error)
{
    lam_environment *environment = lam_environment_built_in(name, error);
    bool ok = environment && lam_scene_set_environment(d->scene, environment, rotation_rad, error);
    lam_environment_free(environment);
    return ok;
}

bool textured_environment(struct demo *d, lam_error *error)
{
    d->params.shading = LAM_SHADING_GOURAUD;
    bool ok = bricks(d, true, error);
    for (int i = 0; ok && i < lam_scene_material_count(d->scene); i++) {
        lam_material m = *lam_scene_material(d->scene, i);
        m.metallic = 0.2f; // for the whole surface, because the map is left out
        ok = lam_scene_set_material(d->scene, i, &m, error);
    }
    return ok && textured_surround(d, "studio", 0, error);
}

bool textured_converted(struct demo *d, lam_error *error)
{
    d->params.reflection = LAM_REFLECTION_PHONG;
    return bricks(d, true, error);
}

bool textured_masked(struct demo *d, lam_error *error)
{
    lam_texture *t = paint(leaves, LAM_TEXTURE_COLOR, "leaves", error);
    lam_texture_map map = {.texture = t};
    lam_material solid = lam_material_default(), m = lam_material_default();
    m.diffuse = (lam_rgba){1, 1, 1, 1};
    m.maps[LAM_MAP_DIFFUSE] = &map;
    m.alpha_mode = LAM_ALPHA_MASK;
    m.alpha_cutoff = 0.4f;
    bool ok = t && add_textured(d, "sphere", &m, (lam_vec3){-1.1, 0, 0}, error) &&
              add_textured(d, "torus", &solid, (lam_vec3){-0.6, 0, -0.4}, error);
    m.alpha_mode = LAM_ALPHA_BLEND;
    ok = ok && add_textured(d, "sphere", &m, (lam_vec3){1.1, 0, 0}, error) && textured_light_up(d, error);
    lam_texture_free(t);
    return ok;
}

// The objects of textured_masked over a floor. Light falls through the places that are left out or blended.
bool textured_shadows(struct demo *d, lam_error *error)
{
    lam_material m = lam_material_default();
    d->params.shadows = true;
    if (!textured_masked(d, error) || !add_textured(d, "plane", &m, (lam_vec3){-0.8, -1.05, -0.6}, error) ||
        !add_textured(d, "plane", &m, (lam_vec3){1.25, -1.05, -0.6}, error))
        return false;
    lam_light l = lam_light_default(LAM_LIGHT_DIRECTIONAL);
    l.direction = (lam_vec3){0.1, -1, -0.5};
    l.diffuse = (lam_rgb){0.7f, 0.7f, 0.7f};
    lam_view view = {.from_angles = true, .elevation_rad = 0.6};
    d->camera = lam_camera_fit(d->scene, d->width, d->height, &view);
    return lam_scene_add_light(d->scene, &l, error) >= 0;
}

// A scene with every map of the layers. The coat has the normals of the bricks, and the sphere below the coat is
// smooth.
bool textured_layers(struct demo *d, lam_error *error)
{
    lam_texture *t[PICTURES] = {paint(brick_color, LAM_TEXTURE_COLOR, "bricks", error),
                                paint(brick_numbers, LAM_TEXTURE_NUMBERS, "numbers", error),
                                paint(brick_normal, LAM_TEXTURE_NUMBERS, "normals", error),
                                paint(glow, LAM_TEXTURE_COLOR, "glow", error)};
    bool ok = t[0] && t[1] && t[2] && t[3];
    const lam_texture_map color = {.texture = t[0]}, normal = {.texture = t[2], .scale = 0.8f};
    const lam_texture_map red = {.texture = t[1]}, green = {.texture = t[1], .channel = 1};
    const lam_texture_map blue = {.texture = t[1], .channel = 2};
    lam_material m[2] = {lam_material_default(), lam_material_default()};
    for (int i = 0; i < 2; i++) {
        m[i].physical = true;
        m[i].diffuse = (lam_rgba){0.3f, 0.4f, 0.5f, 1};
        m[i].roughness = 0.4f;
        m[i].ior = 2;
        m[i].maps[LAM_MAP_SPECULAR_WEIGHT] = &blue;
        m[i].maps[LAM_MAP_F0_COLOR] = &color;
    }
    m[0].clearcoat = 1;
    m[0].clearcoat_roughness = 0.5f;
    m[0].maps[LAM_MAP_CLEARCOAT] = &red;
    m[0].maps[LAM_MAP_CLEARCOAT_ROUGHNESS] = &green;
    m[0].maps[LAM_MAP_CLEARCOAT_NORMAL] = &normal;
    m[0].sheen_color = (lam_rgb){1, 1, 1};
    m[0].sheen_roughness = 0.8f;
    m[0].maps[LAM_MAP_SHEEN_COLOR] = &color;
    m[0].maps[LAM_MAP_SHEEN_ROUGHNESS] = &green;
    m[1].metallic = 0.8f;
    m[1].maps[LAM_MAP_NORMAL] = &normal;
    m[1].anisotropy = 1;
    m[1].anisotropy_rotation_rad = 0.5f;
    m[1].maps[LAM_MAP_ANISOTROPY] = &red; // all three channels
    m[1].iridescence = 1;
    m[1].iridescence_thickness_min = 200;
    m[1].iridescence_thickness_max = 600;
    m[1].maps[LAM_MAP_IRIDESCENCE] = &blue;
    m[1].maps[LAM_MAP_IRIDESCENCE_THICKNESS] = &green;
    m[1].clearcoat = 0.5f;
    ok = ok && add_textured(d, "sphere", &m[0], (lam_vec3){-1.1, 0, 0}, error) &&
         add_textured(d, "torus", &m[1], (lam_vec3){1.2, 0, 0}, error) && textured_light_up(d, error);
    for (int i = 0; i < PICTURES; i++)
        lam_texture_free(t[i]);
    return ok;
}
