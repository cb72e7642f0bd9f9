// scenes.c: demonstration scenes of shapes, materials, lights and cameras, and of special cases of the pipeline.
//
// This file is longer than 600 lines, because it has one function and one row for each scene.
#include "scenes.h"

#include "textured.h"

#include <lambent/light.h>

#include <stdio.h>
#include <string.h>

// --- shorthands

static int shape(struct demo *d, const char *name, int slices, int stacks, lam_error *error)
{
    lam_shape_params params = {.slices = slices, .stacks = stacks};
    return lam_scene_add_shape(d->scene, name, &params, error);
}

static int material(struct demo *d, lam_rgba diffuse, float specular, float shininess, lam_error *error)
{
    lam_material m = lam_material_default();
    m.ambient = (lam_rgb){diffuse.r, diffuse.g, diffuse.b};
    m.diffuse = diffuse;
    m.specular = (lam_rgb){specular, specular, specular};
    m.shininess = shininess;
    return lam_scene_add_material(d->scene, &m, error);
}

static int named(struct demo *d, lam_material_id id, lam_error *error)
{
    lam_material m = lam_material_named(id, d->params.color);
    return lam_scene_add_material(d->scene, &m, error);
}

// Adds a mesh, scaled and then translated.
static bool place(struct demo *d, int mesh, int mat, lam_vec3 scale, lam_vec3 move, lam_error *error)
{
    lam_object o = lam_object_default();
    o.mesh = mesh;
    o.material = mat;
    o.transform.m[0][0] = scale.x;
    o.transform.m[1][1] = scale.y;
    o.transform.m[2][2] = scale.z;
    o.transform.m[0][3] = move.x;
    o.transform.m[1][3] = move.y;
    o.transform.m[2][3] = move.z;
    return mesh >= 0 && lam_scene_add_object(d->scene, &o, error) >= 0;
}

static bool put(struct demo *d, int mesh, int mat, lam_error *error)
{
    return place(d, mesh, mat, (lam_vec3){1, 1, 1}, (lam_vec3){0, 0, 0}, error);
}

static void look(struct demo *d, lam_vec3 eye, lam_vec3 target, double fovy_deg)
{
    d->camera = lam_camera_default();
    d->camera.eye = eye;
    d->camera.target = target;
    d->camera.fovy_rad = fovy_deg * 3.14159265358979323846 / 180;
}

static void fit(struct demo *d) { d->camera = lam_camera_fit(d->scene, d->width, d->height, NULL); }

static bool point_light(struct demo *d, lam_vec3 position, lam_rgb color, lam_attenuation attenuation, lam_error *error)
{
    lam_light l = lam_light_default(LAM_LIGHT_POINT);
    l.position = position;
    l.diffuse = l.specular = color;
    l.attenuation = attenuation;
    return lam_scene_add_light(d->scene, &l, error) >= 0;
}

// --- one model in the default light, in different drawing modes

static bool one_shape(struct demo *d, const char *name, int slices, int stacks, lam_error *error)
{
    bool ok = put(d, shape(d, name, slices, stacks, error), -1, error);
    fit(d);
    return ok;
}

static bool teapot(struct demo *d, lam_error *error) { return one_shape(d, "teapot", 0, 0, error); }
static bool gyroid(struct demo *d, lam_error *error) { return one_shape(d, "gyroid", 0, 0, error); }
static bool metaballs(struct demo *d, lam_error *error) { return one_shape(d, "metaballs", 0, 0, error); }
static bool cone(struct demo *d, lam_error *error) { return one_shape(d, "cone", 48, 0, error); }
static bool cylinder(struct demo *d, lam_error *error) { return one_shape(d, "cylinder", 48, 0, error); }

static bool shaded_sphere(struct demo *d, lam_shading shading, lam_error *error)
{
    d->params.shading = shading;
    bool ok = put(d, shape(d, "sphere", 20, 10, error), named(d, LAM_MATERIAL_BRASS, error), error);
    fit(d);
    return ok && point_light(d, (lam_vec3){2, 3, 4}, (lam_rgb){1, 1, 1}, (lam_attenuation){1, 0, 0}, error);
}

static bool sphere_flat(struct demo *d, lam_error *e) { return shaded_sphere(d, LAM_SHADING_FLAT, e); }
static bool sphere_gouraud(struct demo *d, lam_error *e) { return shaded_sphere(d, LAM_SHADING_GOURAUD, e); }
static bool sphere_phong(struct demo *d, lam_error *e) { return shaded_sphere(d, LAM_SHADING_PHONG, e); }

static bool reflected_knot(struct demo *d, lam_reflection reflection, lam_error *error)
{
    d->params.reflection = reflection;
    bool ok = put(d, shape(d, "torus-knot", 160, 24, error),
                  material(d, (lam_rgba){0.5f, 0.15f, 0.1f, 1}, 0.6f, 24, error), error);
    fit(d);
    return ok && point_light(d, (lam_vec3){3, 4, 5}, (lam_rgb){1, 1, 0.9f}, (lam_attenuation){1, 0.02f, 0.005f}, error);
}

static bool knot_unlit(struct demo *d, lam_error *e) { return reflected_knot(d, LAM_REFLECTION_NONE, e); }
static bool knot_lambert(struct demo *d, lam_error *e) { return reflected_knot(d, LAM_REFLECTION_LAMBERT, e); }
static bool knot_phong(struct demo *d, lam_error *e) { return reflected_knot(d, LAM_REFLECTION_PHONG, e); }
static bool knot_blinn(struct demo *d, lam_error *e) { return reflected_knot(d, LAM_REFLECTION_BLINN_PHONG, e); }
static bool knot_kajiya(struct demo *d, lam_error *e) { return reflected_knot(d, LAM_REFLECTION_KAJIYA_KAY, e); }
static bool knot_lecture(struct demo *d, lam_error *e)
{
    return reflected_knot(d, LAM_REFLECTION_KAJIYA_KAY_LECTURE, e);
}

static bool knot_toon(struct demo *d, lam_error *e) { return reflected_knot(d, LAM_REFLECTION_TOON, e); }
static bool knot_gooch(struct demo *d, lam_error *e) { return reflected_knot(d, LAM_REFLECTION_GOOCH, e); }

// --- lights

static bool lights(struct demo *d, lam_error *error)
{
    int white = material(d, (lam_rgba){0.8f, 0.8f, 0.8f, 1}, 0.3f, 60, error);
    bool ok = place(d, shape(d, "plane", 8, 8, error), white, (lam_vec3){4, 1, 4}, (lam_vec3){0, -1, 0}, error) &&
              put(d, shape(d, "sphere", 64, 32, error), white, error) &&
              point_light(d, (lam_vec3){-2, 1, 1}, (lam_rgb){1, 0.3f, 0.2f}, (lam_attenuation){1, 0.54f, 0.2f}, error);
    lam_light sharp = lam_light_default(LAM_LIGHT_SPOT);
    sharp.position = (lam_vec3){2, 3, 0};
    sharp.direction = (lam_vec3){-0.2, -1, 0.3};
    sharp.cutoff_rad = 0.35f;
    sharp.exponent = 8;
    sharp.diffuse = sharp.specular = (lam_rgb){0.2f, 0.9f, 0.3f};
    lam_light soft = lam_light_default(LAM_LIGHT_SPOT);
    soft.position = (lam_vec3){0, 3, 2.5};
    soft.direction = (lam_vec3){0, -1, -0.1};
    soft.inner_rad = 0.2f;
    soft.outer_rad = 0.5f;
    soft.diffuse = soft.specular = (lam_rgb){0.3f, 0.4f, 1};
    soft.range = 6;
    lam_light wide = lam_light_default(LAM_LIGHT_SPOT);
    wide.position = (lam_vec3){-3, 2, -2};
    wide.direction = (lam_vec3){1, -1, 1};
    wide.cutoff_rad = 0;
    wide.exponent = 30;
    wide.attenuation = (lam_attenuation){0, 0, 0.2f};
    lam_light sun = lam_light_default(LAM_LIGHT_DIRECTIONAL);
    sun.direction = (lam_vec3){-1, -2, -1};
    sun.diffuse = sun.specular = (lam_rgb){0.15f, 0.15f, 0.1f};
    lam_light sky = lam_light_default(LAM_LIGHT_HEMISPHERE);
    sky.sky = (lam_rgb){0.1f, 0.1f, 0.2f};
    sky.ground = (lam_rgb){0.05f, 0.03f, 0};
    lam_light everywhere = lam_light_default(LAM_LIGHT_AMBIENT);
    everywhere.ambient = (lam_rgb){0.02f, 0.02f, 0.02f};
    const lam_light *all[] = {&sharp, &soft, &wide, &sun, &sky, &everywhere};
    for (int i = 0; i < 6; i++)
        ok = ok && lam_scene_add_light(d->scene, all[i], error) >= 0;
    look(d, (lam_vec3){0, 4, 6}, (lam_vec3){0, -0.3, 0}, 40);
    return ok;
}

static bool frames(struct demo *d, lam_error *error)
{
    int mesh = shape(d, "torus", 64, 32, error);
    lam_object o = lam_object_default();
    o.mesh = mesh;
    o.name = "ring";
    const double s = 0.86602540378443865, c = 0.5; // turned by 60° about x
    o.transform.m[1][1] = o.transform.m[2][2] = c;
    o.transform.m[1][2] = -s;
    o.transform.m[2][1] = s;
    bool ok = mesh >= 0 && lam_scene_add_object(d->scene, &o, error) >= 0;
    lam_rgb colors[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int i = 0; i < 3; i++) {
        lam_light l = lam_light_default(LAM_LIGHT_POINT);
        l.frame = (lam_light_frame)i;
        l.object = "ring";
        l.position = i == LAM_FRAME_CAMERA ? (lam_vec3){-3, 0, 0} : (lam_vec3){0, 3, 0.5};
        l.diffuse = l.specular = colors[i];
        ok = ok && lam_scene_add_light(d->scene, &l, error) >= 0;
    }
    look(d, (lam_vec3){1, 2, 4}, (lam_vec3){0, 0, 0}, 35);
    return ok;
}

// --- sides, transforms, cameras

// An open bowl. Both its sides are visible.
static void bowl_surface(void *user, double u, double v, lam_surface_point *out)
{
    (void)user;
    // A paraboloid over a square: y = (u² + v²)/2, so that everything is a polynomial. ∂v × ∂u points up; outward is
    // down.
    out->p = (lam_vec3){u, 0.5 * (u * u + v * v), v};
    out->dp_du = (lam_vec3){1, u, 0};
    out->dp_dv = (lam_vec3){0, v, 1};
}

static int bowl(struct demo *d, lam_error *error)
{
    lam_parametric p = {
        .surface = bowl_surface, .u_min = -1, .u_max = 1, .v_min = -1, .v_max = 1, .u_segments = 24, .v_segments = 24};
    return lam_scene_add_parametric(d->scene, &p, NULL, error);
}

static bool bowl_with(struct demo *d, bool one_sided, lam_cull cull, bool mirrored, lam_error *error)
{
    lam_object o = lam_object_default();
    o.mesh = bowl(d, error);
    o.material = material(d, (lam_rgba){0.2f, 0.4f, 0.8f, 1}, 0.4f, 40, error);
    o.back_material = material(d, (lam_rgba){0.8f, 0.2f, 0.1f, 1}, 0.4f, 10, error);
    o.one_sided = one_sided;
    o.cull = cull;
    o.transform.m[0][0] = mirrored ? -1 : 1;
    o.transform.m[1][1] = 1.5;
    look(d, (lam_vec3){1, 2.4, 3.4}, (lam_vec3){0, 0.5, 0}, 40);
    return o.mesh >= 0 && lam_scene_add_object(d->scene, &o, error) >= 0;
}

static bool two_sides(struct demo *d, lam_error *e) { return bowl_with(d, false, LAM_CULL_NONE, false, e); }
static bool two_sides_mirrored(struct demo *d, lam_error *e) { return bowl_with(d, false, LAM_CULL_NONE, true, e); }
static bool one_side(struct demo *d, lam_error *e) { return bowl_with(d, true, LAM_CULL_NONE, false, e); }
static bool culled_back(struct demo *d, lam_error *e) { return bowl_with(d, false, LAM_CULL_BACK, false, e); }
static bool culled_front(struct demo *d, lam_error *e) { return bowl_with(d, false, LAM_CULL_FRONT, true, e); }

static bool stretched(struct demo *d, lam_error *error)
{
    int gold = named(d, LAM_MATERIAL_GOLD, error), mesh = shape(d, "sphere", 48, 24, error);
    bool ok = place(d, mesh, gold, (lam_vec3){0.4, 1.6, 0.8}, (lam_vec3){-1, 0, 0}, error) &&
              place(d, mesh, gold, (lam_vec3){-0.9, 0.3, 0.9}, (lam_vec3){0.7, 0, 0}, error);
    fit(d);
    return ok;
}

static bool orthographic(struct demo *d, lam_error *error)
{
    int mesh = shape(d, "cube", 0, 0, error);
    bool ok = place(d, mesh, named(d, LAM_MATERIAL_JADE, error), (lam_vec3){1, 1, 1}, (lam_vec3){-0.7, 0, 0}, error) &&
              place(d, mesh, named(d, LAM_MATERIAL_RUBY, error), (lam_vec3){0.8, 0.8, 0.8}, (lam_vec3){0.3, 0.35, 0.4},
                    error);
    d->camera = lam_camera_fit(d->scene, d->width, d->height, &(lam_view){.orthographic = true});
    return ok;
}

static bool inside(struct demo *d, lam_error *error)
{
    bool ok = put(d, shape(d, "gyroid", 48, 0, error), named(d, LAM_MATERIAL_TURQUOISE, error), error);
    look(d, (lam_vec3){0.1, 0.05, 0.12}, (lam_vec3){-0.4, -0.2, -1}, 90);
    return ok;
}

// A ground of two triangles. It extends far behind the eye and is clipped at the near plane and at the guard band.
static bool ground(struct demo *d, lam_error *error)
{
    static const float corners[12] = {-20000, 0, 20000, 20000, 0, 20000, 20000, 0, -20000, -20000, 0, -20000};
    static const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    lam_mesh square = {.positions = corners, .vertex_count = 4, .indices = indices, .triangle_count = 2};
    bool ok = put(d, lam_scene_add_mesh(d->scene, &square, error), -1, error) &&
              place(d, shape(d, "sphere", 32, 16, error), named(d, LAM_MATERIAL_COPPER, error), (lam_vec3){1, 1, 1},
                    (lam_vec3){0, 1, -6}, error) &&
              point_light(d, (lam_vec3){2, 4, -3}, (lam_rgb){1, 1, 1}, (lam_attenuation){0.2f, 0.05f, 0.02f}, error);
    look(d, (lam_vec3){0, 1.5, 2}, (lam_vec3){0, 0.9, -6}, 50);
    d->camera.near_plane = 0.01;
    d->camera.far_plane = 1000;
    return ok;
}

static bool planes(struct demo *d, lam_error *error)
{
    bool ok = put(d, shape(d, "torus", 48, 24, error), named(d, LAM_MATERIAL_PEARL, error), error);
    look(d, (lam_vec3){1, 2, 2.5}, (lam_vec3){0, 0, 0}, 40);
    d->camera.near_plane = 2.9;
    d->camera.far_plane = 3.7;
    return ok;
}

static bool intersecting(struct demo *d, lam_error *error)
{
    bool ok = put(d, shape(d, "cube", 0, 0, error), named(d, LAM_MATERIAL_RED_PLASTIC, error), error) &&
              place(d, shape(d, "sphere", 64, 32, error), named(d, LAM_MATERIAL_CYAN_RUBBER, error),
                    (lam_vec3){0.8, 0.8, 0.8}, (lam_vec3){0.3, 0.25, 0.2}, error);
    fit(d);
    return ok;
}

// Triangles that are much thinner than the distance of samples and longer than the picture.
static bool slivers(struct demo *d, lam_error *error)
{
    enum { COUNT = 40 };
    float positions[COUNT * 9];
    for (int i = 0; i < COUNT; i++) {
        float t = (float)i / COUNT * 2 - 1;
        float corners[9] = {-1, t, 0, 1, -t, 0.2f * t, 1, -t + 0.004f * (float)(i + 1), 0.2f * t};
        memcpy(positions + 9 * i, corners, sizeof corners);
    }
    lam_mesh mesh = {.positions = positions, .vertex_count = 3 * COUNT, .triangle_count = COUNT};
    look(d, (lam_vec3){0, 0, 3}, (lam_vec3){0, 0, 0}, 40);
    return put(d, lam_scene_add_mesh(d->scene, &mesh, error), -1, error);
}

// --- translucent surfaces

static bool glass(struct demo *d, lam_error *error)
{
    int ball = shape(d, "sphere", 64, 32, error), box = shape(d, "cube", 0, 0, error);
    int red = material(d, (lam_rgba){0.8f, 0.1f, 0.1f, 0.4f}, 0.8f, 80, error);
    int green = material(d, (lam_rgba){0.1f, 0.7f, 0.2f, 0.4f}, 0.8f, 80, error);
    int blue = material(d, (lam_rgba){0.1f, 0.2f, 0.9f, 0.5f}, 0.8f, 80, error);
    int solid = material(d, (lam_rgba){0.7f, 0.6f, 0.4f, 1}, 0.2f, 20, error);
    bool ok = place(d, box, blue, (lam_vec3){0.8, 0.8, 0.8}, (lam_vec3){0, 0, 0}, error) &&
              place(d, ball, red, (lam_vec3){0.6, 0.6, 0.6}, (lam_vec3){-0.5, 0.1, 0.3}, error) &&
              place(d, ball, green, (lam_vec3){0.5, 0.5, 0.5}, (lam_vec3){0.4, 0.35, 0.3}, error) &&
              place(d, ball, solid, (lam_vec3){0.3, 0.3, 0.3}, (lam_vec3){0, -0.1, 0}, error);
    fit(d);
    return ok;
}

static bool clear_bowl(struct demo *d, lam_error *error)
{
    d->params.background = (lam_rgba){0.9f, 0.9f, 0.8f, 1};
    lam_object o = lam_object_default();
    o.mesh = bowl(d, error);
    o.material = material(d, (lam_rgba){0.2f, 0.4f, 0.8f, 0.5f}, 0.4f, 40, error);
    o.back_material = material(d, (lam_rgba){0.8f, 0.2f, 0.1f, 0.7f}, 0.4f, 10, error);
    look(d, (lam_vec3){1, 1.1, 3.4}, (lam_vec3){0, 0.45, 0}, 46);
    return o.mesh >= 0 && lam_scene_add_object(d->scene, &o, error) >= 0;
}

// Four bars, each above the next bar and below the previous bar. No order of drawing the bars is correct. The bars are
// translucent because of the alpha of their colours.
static bool over_and_under(struct demo *d, lam_error *error)
{
    static const float turns[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    static const uint8_t tints[4][3] = {{255, 60, 40}, {60, 220, 60}, {50, 90, 255}, {250, 210, 40}};
    static const float bar[4][3] = {{-1, -0.75f, 0.2f}, {1, -0.75f, -0.2f}, {1, -0.35f, -0.2f}, {-1, -0.35f, 0.2f}};
    static const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    d->params.reflection = LAM_REFLECTION_NONE;
    bool ok = true;
    for (int i = 0; i < 4; i++) {
        float p[4][3];
        uint8_t colors[4][4];
        for (int k = 0; k < 4; k++) {
            p[k][0] = turns[i][0] * bar[k][0] - turns[i][1] * bar[k][1];
            p[k][1] = turns[i][1] * bar[k][0] + turns[i][0] * bar[k][1];
            p[k][2] = bar[k][2];
            memcpy(colors[k], tints[i], 3);
            colors[k][3] = k == 0 || k == 3 ? 230 : 110;
        }
        lam_mesh mesh = {.positions = &p[0][0],
                         .vertex_count = 4,
                         .indices = indices,
                         .triangle_count = 2,
                         .colors = colors,
                         .color_count = 4,
                         .colors_format = LAM_COLORS_SRGB8};
        ok = ok && put(d, lam_scene_add_mesh(d->scene, &mesh, error), -1, error);
    }
    look(d, (lam_vec3){0.5, 0.4, 3}, (lam_vec3){0, 0, 0}, 45);
    return ok;
}

static bool coloured(struct demo *d, lam_rate rate, lam_error *error)
{
    static const float p[12] = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0};
    static const float n[3] = {0, 0, 1};
    static const uint32_t indices[6] = {0, 1, 2, 0, 2, 3}, normals[6] = {0};
    static const uint8_t colors[16] = {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 255};
    lam_mesh mesh = {.positions = p,
                     .vertex_count = 4,
                     .indices = indices,
                     .triangle_count = 2,
                     .normals = n,
                     .normal_count = 1,
                     .normal_indices = normals,
                     .colors = colors,
                     .color_count = 4,
                     .colors_format = LAM_COLORS_SRGB8,
                     .colors_rate = rate};
    look(d, (lam_vec3){1.5, 1, 3}, (lam_vec3){0, 0, 0}, 40);
    return put(d, lam_scene_add_mesh(d->scene, &mesh, error), -1, error);
}

static bool vertex_colours(struct demo *d, lam_error *e) { return coloured(d, LAM_PER_VERTEX, e); }
static bool triangle_colours(struct demo *d, lam_error *e) { return coloured(d, LAM_PER_TRIANGLE, e); }

// Adds a mesh of lines or points along a helix of `count` vertices round the y axis, with colours. With `normals`, the
// mesh is lit.
static int helix(struct demo *d, int count, double radius, bool lines, bool normals, lam_error *error)
{
    enum { MAX = 160 };
    float p[MAX * 3], n[MAX * 3];
    uint8_t colors[MAX * 4];
    uint32_t indices[MAX * 2];
    // Each step turns by 20 degrees. The sine and cosine of 20 degrees are written as numbers, because the functions of
    // different libraries do not agree in all bits.
    double s = 0, c = 1;
    for (int i = 0; i < count; i++) {
        double next_s = s * 0.9396926207859084 + c * 0.3420201433256687;
        double next_c = c * 0.9396926207859084 - s * 0.3420201433256687;
        s = next_s;
        c = next_c;
        const float normal[3] = {(float)c, 0, (float)s};
        const float at[3] = {(float)(radius * c), (float)(1.8 * i / count - 0.9), (float)(radius * s)};
        memcpy(n + 3 * i, normal, sizeof normal);
        memcpy(p + 3 * i, at, sizeof at);
        const uint8_t color[4] = {(uint8_t)(255 * i / count), 140, (uint8_t)(255 - 255 * i / count), 255};
        memcpy(colors + 4 * i, color, sizeof color);
        indices[2 * i] = (uint32_t)i;
        indices[2 * i + 1] = (uint32_t)i + 1;
    }
    lam_mesh mesh = {.positions = p,
                     .vertex_count = (uint32_t)count,
                     .indices = lines ? indices : NULL,
                     .normals = normals ? n : NULL,
                     .normal_count = normals ? (uint32_t)count : 0,
                     .colors = colors,
                     .color_count = (uint32_t)count,
                     .colors_format = LAM_COLORS_SRGB8,
                     .line_count = lines ? (uint32_t)count - 1 : 0,
                     .point_count = lines ? 0 : (uint32_t)count};
    return lam_scene_add_mesh(d->scene, &mesh, error);
}

// The first helix lies on the surface of the cylinder. It is fully visible, because lines are drawn nearer to the eye
// by their width.
static bool lines_and_points(struct demo *d, lam_error *error)
{
    static const float axis[6] = {0, -40, 0, 0, 40, 0};
    lam_mesh line = {.positions = axis, .vertex_count = 2, .line_count = 1};
    int emitting = material(d, (lam_rgba){0.1f, 0.1f, 0.1f, 1}, 0, 1, error);
    lam_material glow = emitting >= 0 ? *lam_scene_material(d->scene, emitting) : lam_material_default();
    glow.emission = (lam_rgb){0.7f, 0.2f, 0};
    bool ok = emitting >= 0 && lam_scene_set_material(d->scene, emitting, &glow, error) &&
              place(d, shape(d, "cylinder", 48, 1, error), named(d, LAM_MATERIAL_PEARL, error),
                    (lam_vec3){0.6, 0.9, 0.6}, (lam_vec3){0, 0, 0}, error) &&
              put(d, helix(d, 100, 0.602, true, true, error), -1, error) &&
              put(d, helix(d, 150, 0.9, false, true, error), -1, error) &&
              put(d, helix(d, 60, 1.1, false, false, error), -1, error) &&
              put(d, helix(d, 60, 1.1, true, false, error), -1, error) &&
              put(d, lam_scene_add_mesh(d->scene, &line, error), emitting, error);
    d->params.line_width = 2.5f;
    d->params.point_size = 5;
    look(d, (lam_vec3){1, 1.6, 3}, (lam_vec3){0, 0, 0}, 40);
    d->camera.near_plane = 0.5; // the axis is clipped above the eye
    d->camera.far_plane = 20;
    return ok;
}

// A model 500 km from the origin. Its picture is the same as near the origin.
static bool far_away(struct demo *d, lam_error *error)
{
    static const float p[12] = {0, 0, 0, 0.01f, 0, 0, 0, 0.01f, 0, 0, 0, 0.01f};
    static const uint32_t indices[12] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    lam_mesh mesh = {
        .origin = {5e5, 2e5, -3e5}, .positions = p, .vertex_count = 4, .indices = indices, .triangle_count = 4};
    bool ok = put(d, lam_scene_add_mesh(d->scene, &mesh, error), -1, error);
    fit(d);
    return ok;
}

// --- surroundings

static int mirror(struct demo *d, lam_rgb reflectivity, lam_error *error)
{
    lam_material m = {.diffuse = {0, 0, 0, 1}, .reflectivity = reflectivity};
    return lam_scene_add_material(d->scene, &m, error);
}

static bool surround(struct demo *d, const char *name, double rotation_rad, lam_error *error)
{
    d->params.rig = LAM_RIG_NONE;
    return textured_surround(d, name, rotation_rad, error) &&
           lam_scene_set_reflection_map(d->scene, lam_scene_environment(d->scene), rotation_rad, error);
}

static bool mirror_sky(struct demo *d, lam_error *error)
{
    bool ok = put(d, shape(d, "sphere", 48, 24, error), mirror(d, (lam_rgb){0.9f, 0.9f, 0.9f}, error), error) &&
              surround(d, "sky", 0, error);
    look(d, (lam_vec3){0.5, 0.6, 3.5}, (lam_vec3){0, 0, 0}, 38);
    return ok;
}

static bool mirror_studio(struct demo *d, lam_error *error)
{
    lam_material gold = lam_material_named(LAM_MATERIAL_GOLD, d->params.color);
    gold.reflectivity = (lam_rgb){0.9f, 0.65f, 0.25f};
    bool ok = put(d, shape(d, "teapot", 0, 0, error), lam_scene_add_material(d->scene, &gold, error), error) &&
              surround(d, "studio", 0.6, error);
    fit(d);
    return ok;
}

static bool mirror_gouraud(struct demo *d, lam_error *error)
{
    d->params.shading = LAM_SHADING_GOURAUD;
    bool ok = put(d, shape(d, "torus-knot", 160, 24, error), mirror(d, (lam_rgb){1, 1, 1}, error), error) &&
              surround(d, "sky", -2, error);
    lam_scene_set_up(d->scene, LAM_UP_Z);
    d->camera = lam_camera_fit(d->scene, d->width, d->height, &(lam_view){.orthographic = true});
    return ok;
}

// Classic materials in the light of the sky: one without a highlight, one with a broad and one with a narrow highlight, a
// metal, a mirror, and a matt one without a normal map under Gouraud shading's stage.
static bool environment_classic(struct demo *d, lam_error *error)
{
    static const lam_material materials[] = {
        {.diffuse = {0.8f, 0.8f, 0.8f, 1}},
        {.diffuse = {0.6f, 0.1f, 0.1f, 1}, .specular = {0.3f, 0.3f, 0.3f}, .shininess = 10},
        {.diffuse = {0.1f, 0.3f, 0.6f, 1}, .specular = {1, 1, 1}, .shininess = 300},
        {.diffuse = {0.1f, 0.08f, 0.02f, 1}, .specular = {6, 4.8f, 2}, .shininess = 60},
        {.diffuse = {0, 0, 0, 1}, .reflectivity = {0.9f, 0.9f, 0.9f}},
        {.diffuse = {0.5f, 0.5f, 0.5f, 1}, .reflectivity = {0.2f, 0.2f, 0.2f}}};
    int mesh = shape(d, "sphere", 32, 16, error);
    for (int i = 0; i < 6; i++)
        if (!place(d, mesh, lam_scene_add_material(d->scene, &materials[i], error), (lam_vec3){1, 1, 1},
                   (lam_vec3){2.2 * (i % 3) - 2.2, 1.1 - 2.2 * (i / 3), 0}, error))
            return false;
    look(d, (lam_vec3){0, 1.5, 15}, (lam_vec3){0, 0, 0}, 19);
    return textured_surround(d, "sky", 0.4, error);
}

// Spheres of four roughnesses, from a mirror to a matt surface, in the light of the studio. The first row is a
// dielectric, the second row is half a metal, and the third row is a metal.
static bool environment_light(struct demo *d, lam_error *error)
{
    static const float roughness[4] = {0.05f, 0.3f, 0.6f, 1}, metallic[3] = {0, 0.5f, 1};
    int mesh = shape(d, "sphere", 32, 16, error);
    for (int i = 0; i < 12; i++) {
        lam_material m = lam_material_default();
        m.physical = true;
        m.diffuse = (lam_rgba){0.9f, 0.45f, 0.15f, 1};
        m.roughness = roughness[i % 4];
        m.metallic = metallic[i / 4];
        if (!place(d, mesh, lam_scene_add_material(d->scene, &m, error), (lam_vec3){1, 1, 1},
                   (lam_vec3){2.2 * (i % 4) - 3.3, 2.2 - 2.2 * (i / 4), 0}, error))
            return false;
    }
    look(d, (lam_vec3){0, 1.5, 15}, (lam_vec3){0, 0, 0}, 26);
    return surround(d, "studio", 0.4, error);
}

static bool environment_reference(struct demo *d, lam_error *error)
{
    d->params.reference = 100;
    return environment_light(d, error);
}

// --- pixels

static bool with_samples(struct demo *d, int samples, lam_error *error)
{
    d->params.samples = samples;
    d->width = d->height = 80;
    return one_shape(d, "torus-knot", 96, 12, error);
}

static bool samples_1(struct demo *d, lam_error *e) { return with_samples(d, 1, e); }
static bool samples_2(struct demo *d, lam_error *e) { return with_samples(d, 2, e); }
static bool samples_8(struct demo *d, lam_error *e) { return with_samples(d, 8, e); }
static bool samples_16(struct demo *d, lam_error *e) { return with_samples(d, 16, e); }

static bool raw(struct demo *d, lam_error *error)
{
    d->params.color = LAM_COLOR_RAW;
    d->params.background = (lam_rgba){0.2f, 0.3f, 0.4f, 0.5f};
    return shaded_sphere(d, LAM_SHADING_PHONG, error);
}

static bool floats(struct demo *d, lam_error *error)
{
    d->format = LAM_RGBA32F;
    d->params.background = (lam_rgba){0.1f, 0.1f, 0.1f, 1};
    return shaded_sphere(d, LAM_SHADING_PHONG, error);
}

static bool nothing(struct demo *d, lam_error *error)
{
    (void)error;
    d->width = 70;
    d->height = 3;
    d->params.background = (lam_rgba){1, 0.5f, 0.25f, 0.75f};
    d->camera = lam_camera_default();
    return true;
}

// --- shadows

static bool light(struct demo *d, lam_light_type type, lam_vec3 position, lam_vec3 direction, float strength,
                  float radius, lam_error *error)
{
    lam_light l = lam_light_default(type);
    l.position = position;
    l.direction = direction;
    l.diffuse = l.specular = (lam_rgb){strength, strength, strength};
    l.outer_rad = type == LAM_LIGHT_SPOT ? 0.5f : 0;
    l.radius = radius;
    l.angular_radius_rad = radius * 0.1f;
    return lam_scene_add_light(d->scene, &l, error) >= 0;
}

// A coarse ball, a box and a knot on a floor. The terminator of the ball has no artefacts.
static bool shadowed(struct demo *d, float radius, lam_error *error)
{
    int floor = shape(d, "cube", 0, 0, error), ball = shape(d, "sphere", 16, 8, error);
    int knot = shape(d, "torus-knot", 60, 8, error);
    int grey = material(d, (lam_rgba){0.7f, 0.7f, 0.68f, 1}, 0.1f, 20, error);
    int red = material(d, (lam_rgba){0.7f, 0.2f, 0.15f, 1}, 0.4f, 40, error);
    d->params.shadows = true;
    look(d, (lam_vec3){2.5, 3.2, 6}, (lam_vec3){0, 0.1, 0}, 38);
    lam_scene_set_ambient(d->scene, (lam_rgb){0.15f, 0.15f, 0.15f});
    return place(d, floor, grey, (lam_vec3){6, 0.1, 6}, (lam_vec3){0, -1.1, 0}, error) &&
           place(d, ball, red, (lam_vec3){0.8, 0.8, 0.8}, (lam_vec3){1.2, -0.2, 0.6}, error) &&
           place(d, floor, red, (lam_vec3){0.4, 0.9, 0.4}, (lam_vec3){-1.6, -0.1, -0.4}, error) &&
           place(d, knot, -1, (lam_vec3){0.7, 0.7, 0.7}, (lam_vec3){0, 0.4, -1.2}, error) &&
           light(d, LAM_LIGHT_DIRECTIONAL, (lam_vec3){0, 0, 0}, (lam_vec3){-0.5, -1, -0.2}, 0.4f, radius, error) &&
           light(d, LAM_LIGHT_POINT, (lam_vec3){-1, 2.2, 2}, (lam_vec3){0, -1, 0}, 0.3f, radius, error) &&
           light(d, LAM_LIGHT_SPOT, (lam_vec3){2, 3, 1}, (lam_vec3){-0.6, -1, -0.4}, 0.4f, radius, error);
}

static bool shadows_hard(struct demo *d, lam_error *error) { return shadowed(d, 0, error); }
static bool shadows_soft(struct demo *d, lam_error *error)
{
    d->params.shadow_samples = 24;
    return shadowed(d, 0.3f, error);
}

// The same objects under light from all directions. Surfaces that are near one another occlude some of this light.
static bool occlusion_rays(struct demo *d, lam_error *error)
{
    d->params.occlusion = LAM_OCCLUSION_RAYS;
    d->params.occlusion_radius = 0.3f;
    d->params.occlusion_samples = 37;
    if (!shadowed(d, 0, error))
        return false;
    lam_scene_set_ambient(d->scene, (lam_rgb){0.7f, 0.7f, 0.7f});
    return true;
}
static bool shadows_gouraud(struct demo *d, lam_error *error)
{
    d->params.shading = LAM_SHADING_GOURAUD;
    return shadowed(d, 0, error);
}

// A turned box. Each side consists of three triangles that overlap. The corners are rounded to floats, so that the four
// corners of a side do not lie exactly in one plane.
static bool shadows_coplanar(struct demo *d, lam_error *error)
{
    float corners[8][3];
    uint32_t indices[54], *next = indices;
    lam_mat4 turn = lam_mat4_rotation((lam_vec3){1, 2, 3}, 0.7);
    for (uint32_t c = 0; c < 8; c++)
        for (int i = 0; i < 3; i++)
            corners[c][i] = (float)(turn.m[i][0] * (c & 1 ? 1 : -1) + turn.m[i][1] * (c & 2 ? 1 : -1) +
                                    turn.m[i][2] * (c & 4 ? 1 : -1));
    for (uint32_t side = 0; side < 6; side++) {
        uint32_t k = side / 2, low = side % 2 << k, u = 1u << (k + 1) % 3, v = 1u << (k + 2) % 3;
        uint32_t quad[4] = {low, low | (low ? u : v), low | u | v, low | (low ? v : u)};
        for (int i = 0; i < 9; i++)
            *next++ = quad["012023130"[i] - '0'];
    }
    lam_mesh mesh = {.positions = corners[0], .vertex_count = 8, .indices = indices, .triangle_count = 18};
    int grey = material(d, (lam_rgba){0.7f, 0.7f, 0.68f, 1}, 0, 1, error);
    d->params.shadows = true;
    bool ok = put(d, lam_scene_add_mesh(d->scene, &mesh, error), grey, error) &&
              light(d, LAM_LIGHT_DIRECTIONAL, (lam_vec3){0, 0, 0}, (lam_vec3){-1, -2, -1}, 0.7f, 0, error) &&
              light(d, LAM_LIGHT_POINT, (lam_vec3){-1, 3, 4}, (lam_vec3){0, 0, 0}, 0.3f, 0, error);
    fit(d);
    return ok;
}

static bool on_ground(struct demo *d, lam_ground kind, lam_error *error)
{
    bool ok = one_shape(d, "torus-knot", 80, 10, error);
    d->params.ground = kind;
    return ok;
}

static bool ground_shadow(struct demo *d, lam_error *error) { return on_ground(d, LAM_GROUND_SHADOW, error); }
static bool ground_checker(struct demo *d, lam_error *error)
{
    lam_scene_set_up(d->scene, LAM_UP_Z);
    bool ok = on_ground(d, LAM_GROUND_CHECKER, error);
    lam_view view = {.orthographic = true};
    d->camera = lam_camera_fit(d->scene, d->width, d->height, &view);
    return ok;
}

// --- light between surfaces

static int physical_material(struct demo *d, float metallic, float transmission, float thickness, lam_error *error)
{
    lam_material m = lam_material_default();
    m.physical = true;
    m.diffuse = (lam_rgba){0.8f, 0.9f, 0.85f, 1};
    m.metallic = metallic;
    m.roughness = 0.1f;
    m.transmission = transmission;
    m.thickness = thickness;
    return lam_scene_add_material(d->scene, &m, error);
}

// The objects of the shadows, with a glowing bar, a mirror and a ball of glass, on a checkerboard.
static bool bounces(struct demo *d, lam_error *error)
{
    lam_material glow = lam_material_default();
    glow.emission = (lam_rgb){4, 2, 0.5f};
    d->params.bounces = 5;
    d->params.paths = 6;
    d->params.ground = LAM_GROUND_CHECKER;
    int bar = shape(d, "cube", 0, 0, error), ball = shape(d, "sphere", 40, 20, error);
    return shadowed(d, 0.3f, error) &&
           place(d, bar, lam_scene_add_material(d->scene, &glow, error), (lam_vec3){0.1, 0.7, 0.1},
                 (lam_vec3){2, -0.3, -1}, error) &&
           place(d, ball, physical_material(d, 1, 0, 0, error), (lam_vec3){0.4, 0.4, 0.4}, (lam_vec3){-0.3, -0.6, 1.2},
                 error) &&
           place(d, ball, physical_material(d, 0, 1, 1, error), (lam_vec3){0.4, 0.4, 0.4}, (lam_vec3){0.2, -0.6, 2.2},
                 error);
}

// One reflection of the studio's light on a knot without normals, whose layers transmit.
static bool bounces_studio(struct demo *d, lam_error *error)
{
    d->params.bounces = 2;
    d->params.paths = 5;
    d->params.ground = LAM_GROUND_COLOR;
    d->params.ground_color = (lam_rgb){0.6f, 0.5f, 0.4f};
    bool ok = put(d, shape(d, "torus-knot", 80, 10, error), physical_material(d, 0.3f, 0.5f, 0, error), error);
    fit(d);
    return ok;
}

const struct demo_row demos[] = {
    {"teapot", "the Utah teapot in the studio light", teapot},
    {"gyroid", "an implicit surface with normals from the gradient", gyroid},
    {"metaballs", "an implicit surface: three balls that flow together", metaballs},
    {"cone", "a cone: smooth around, flat below, a clean tip", cone},
    {"cylinder", "a cylinder: smooth around, flat ends", cylinder},
    {"sphere-flat", "a coarse brass sphere, one colour for each triangle", sphere_flat},
    {"sphere-gouraud", "the same, lit at its vertices", sphere_gouraud},
    {"sphere-phong", "the same, lit at every pixel", sphere_phong},
    {"knot-unlit", "the diffuse colour alone", knot_unlit},
    {"knot-lambert", "diffuse light without a highlight", knot_lambert},
    {"knot-phong", "Phong's highlight", knot_phong},
    {"knot-blinn-phong", "Blinn's highlight: wider at the same exponent", knot_blinn},
    {"knot-kajiya-kay", "highlights along threads round the axis", knot_kajiya},
    {"knot-kajiya-kay-lecture", "the same with the lecture's sign", knot_lecture},
    {"knot-toon", "flat steps of light, a highlight with an edge", knot_toon},
    {"knot-gooch", "yellow towards the light, violet away from it", knot_gooch},
    {"lights", "every type of light on one sphere and a plane", lights},
    {"frames", "three lights: in world, camera and object space", frames},
    {"two-sides", "a bowl, blue outside, red inside", two_sides},
    {"two-sides-mirrored", "the same under a mirroring transform: still blue outside", two_sides_mirrored},
    {"one-side", "the same with two sides off: blue and dark inside", one_side},
    {"culled-back", "the inside is not drawn", culled_back},
    {"culled-front", "the outside is not drawn, mirrored", culled_front},
    {"stretched", "non-uniform scale and a mirror: highlights where they belong", stretched},
    {"orthographic", "two boxes without perspective", orthographic},
    {"inside", "the camera within the model", inside},
    {"ground", "a plane through the eye's own place, clipped in front of it", ground},
    {"planes", "a torus cut by the near and the far plane", planes},
    {"intersecting", "a sphere through a box", intersecting},
    {"slivers", "triangles thinner than a pixel and longer than the picture", slivers},
    {"translucent", "glass balls through a glass box, a solid one within: all seen in their depth", glass},
    {"translucent-sides", "a bowl whose sides let different shares of light through", clear_bowl},
    {"translucent-cycle", "four fading bars, each over the next: no order of drawing them is right", over_and_under},
    {"vertex-colours", "colours interpolated over a square", vertex_colours},
    {"triangle-colours", "a colour for each triangle", triangle_colours},
    {"lines", "lines and points: lit with normals, unlit without, one clipped above the eye", lines_and_points},
    {"far-away", "a centimetre of model 500 km from zero", far_away},
    {"mirror-sky", "a ball that mirrors a sky: the sun to the right in front, the horizon bent downwards", mirror_sky},
    {"mirror-studio", "a gold teapot among turned soft boxes", mirror_studio},
    {"mirror-gouraud", "a mirror lit at its vertices, Z up, without perspective", mirror_gouraud},
    {"environment-light", "metals and dielectrics of several roughnesses in the studio's light", environment_light},
    {"environment-classic", "classic materials in the light of the sky: matt, glossy, a metal, mirrors",
     environment_classic},
    {"environment-reference", "the same by the integral itself", environment_reference},
    {"textured", "bricks with every map of a metallic-roughness material, turned, mirrored at the seams",
     textured_physical},
    {"textured-classic", "the same maps on a classic material", textured_classic},
    {"textured-as-phong", "metallic-roughness maps under Phong's model", textured_converted},
    {"textured-gouraud", "lit at the vertices: the diffuse map stays sharp", textured_gouraud},
    {"textured-environment", "metallic-roughness maps in a studio, lit at the vertices", textured_environment},
    {"masked", "leaves: left out below half opacity to the left, blended to the right", textured_masked},
    {"shadows", "a ball, a box and a knot: hard shadows of a directional, a point and a spot light", shadows_hard},
    {"shadows-soft", "the same lights with a size", shadows_soft},
    {"shadows-leaves", "the leaves again: light falls through holes, and in part through glass", textured_shadows},
    {"shadows-coplanar", "a box whose sides are overlapping triangles: no side shadows itself", shadows_coplanar},
    {"shadows-gouraud", "the same, lit at the vertices", shadows_gouraud},
    {"occlusion-rays", "the things of the shadows under light from all around, occluded by rays", occlusion_rays},
    {"bounces", "lamps, a glowing bar, a mirror and glass on a checkerboard: light between surfaces", bounces},
    {"bounces-studio", "a knot of metal and glass on a coloured ground in the studio, with two bounces",
     bounces_studio},
    {"ground-shadow", "a ground that catches a soft shadow and occlusion, over nothing", ground_shadow},
    {"ground-checker", "a lit ground, orthographic, z up", ground_checker},
    {"layers", "index 2.4, blue f0, coat, sheen; brushed metal, films on metal and plastic, all layers at once",
     layers_uniform},
    {"layers-environment", "the same in a studio", layers_environment},
    {"layers-gouraud", "the same lit at the vertices", layers_gouraud},
    {"layers-leaning", "normals that face away from the eye: neither metals nor layers have holes there",
     layers_leaning},
    {"layers-transmission", "coloured glass over a box, a background and other glass; a volume that tints",
     layers_transmission},
    {"layers-refraction", "rough, thick and tinted glass over the same: blurred, bent; seen through one another",
     layers_refraction},
    {"textured-layers-environment", "every map of the layers in a studio, lit at the vertices",
     layers_mapped_environment},
    {"textured-layers", "a coat of bricks over a smooth ball, a brushed ring under a film: every map of the layers",
     textured_layers},
    {"samples-1", "no antialiasing", samples_1},
    {"samples-2", "2 samples a pixel", samples_2},
    {"samples-8", "8 samples a pixel", samples_8},
    {"samples-16", "16 samples a pixel", samples_16},
    {"raw", "numbers as the equations give them, over half a background", raw},
    {"floats", "linear floats", floats},
    {"nothing", "an empty scene: the background, in a picture narrower than a tile", nothing},
};
const int demo_count = sizeof demos / sizeof demos[0];

bool demo_build(const struct demo_row *row, struct demo *demo, lam_error *error)
{
    *demo = (struct demo){.width = 160, .height = 120, .params.samples = 4};
    demo->scene = lam_scene_make(error);
    if (!demo->scene)
        return false;
    if (row->build(demo, error))
        return true;
    lam_scene_free(demo->scene);
    demo->scene = NULL;
    return false;
}

bool demo_build_named(const char *name, struct demo *demo, lam_error *error)
{
    for (int i = 0; i < demo_count; i++)
        if (strcmp(demos[i].name, name) == 0)
            return demo_build(&demos[i], demo, error);
    if (error) {
        error->code = LAM_BAD_ARGUMENT;
        snprintf(error->text, sizeof error->text, "there is no scene '%.60s'", name);
    }
    return false;
}
