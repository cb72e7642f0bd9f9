// reference_scene.c: the table of reference scenes, their meshes and matrices.
#include "reference_scene.h"

#include <stdlib.h>
#include <string.h>

#include <lambent/material.h>

#include "fail.h"
#include "linear.h"

#define AMBIENT  {0.30f, 0.45f, 0.90f}
#define DIFFUSE  {0.85f, 0.50f, 0.15f}
#define SPECULAR {0.55f, 0.75f, 0.95f}
#define COLORS   .ambient = AMBIENT, .diffuse = DIFFUSE, .specular = SPECULAR
#define MATTER   COLORS, .alpha = 1
#define STRETCHED                                                                                                      \
    .mesh = MESH_TEAPOT, .scale = {1.3, 0.8, 1.1}, .turn_axis = {0.3, 1, 0.2}, .turn_deg = 35,                         \
    .move = {0.2, -0.1, -0.3}, .eye = {1.1, 1.5, 3.1}, .target = {0.1, -0.1, -0.2}
#define BALL                                                                                                           \
    .scale = {0.9, 0.9, 0.9}, .turn_axis = {1, 1, 0}, .turn_deg = 20, .move = {0.3, 0.2, 0.1},                         \
    .eye = {-0.8, 0.9, 3.2}, .target = {0.2, 0.1, 0}
#define PATCH                                                                                                          \
    .scale = {1.8, 1, 1.1}, .turn_axis = {1, -0.3, 0.2}, .turn_deg = 50, .eye = {0.2, 1.2, 3.3}, .target = {0, 0, 0}
#define WHITE            .color = {1, 1, 1}, .specular = {1, 1, 1}, .ambient = {1, 1, 1}
#define TINTED           .color = {1, 0.9f, 0.7f}, .specular = {0.75f, 0.9f, 1}, .ambient = {0.9f, 0.8f, 1}
#define LIGHT(kind, ...) {.type = LAM_LIGHT_##kind, __VA_ARGS__}
#define LAMP             LIGHT(POINT, .position = {1.6, 2.2, 2.4}, WHITE, .attenuation = {0.6f, 0.1f, 0.04f})

const struct reference_scene reference_scenes[] = {
    {"all", "every term together, a stretched model, a nearby light", 0, STRETCHED, MATTER, .ka = 0.25f, .kd = 0.8f,
     .ks = 0.6f, .shininess = 20, .metallic = 0.3f, .roughness = 0.5f, .light_count = 1,
     .lights = {LIGHT(POINT, .position = {1.6, 2.2, 2.4}, TINTED, .attenuation = {0.6f, 0.1f, 0.04f})}},
    {"ambient", "the ambient term alone", NEED_AMBIENT, STRETCHED, MATTER, .ka = 0.8f, .shininess = 20, .metallic = 0,
     .roughness = 0.6f, .light_count = 1, .lights = {LAMP}},
    {"diffuse", "the diffuse term alone", 0, STRETCHED, MATTER, .kd = 0.9f, .shininess = 20, .metallic = 0,
     .roughness = 0.85f, .light_count = 1, .lights = {LAMP}},
    {"specular", "the specular term alone, a wide highlight", 0, STRETCHED, MATTER, .ks = 0.9f, .shininess = 8,
     .metallic = 1, .roughness = 0.45f, .light_count = 1, .lights = {LAMP}},
    {"highlight", "the specular term alone, a small highlight", NEED_SHININESS, .mesh = MESH_SPHERE, BALL, MATTER,
     .ks = 1, .shininess = 90, .metallic = 1, .roughness = 0.25f, .light_count = 1, .lights = {LAMP}},
    {"gate", "light from behind: no highlight where n.l is not above 0", 0, .mesh = MESH_SPHERE, BALL, MATTER,
     .ks = 0.9f, .kd = 0.1f, .shininess = 3, .metallic = 0, .roughness = 0.3f, .light_count = 1,
     .lights = {LIGHT(POINT, .position = {-1.2, 1.9, -2.4}, WHITE, .attenuation = {1, 0, 0})}},
    {"grazing", "a light just below a plane: not even a small highlight", 0, .mesh = MESH_PLANE, .scale = {1.5, 1, 1.6},
     .turn_axis = {0, 1, 0}, .eye = {0.3, 0.55, 3.4}, .target = {0, 0, 0}, MATTER, .kd = 0.5f, .ks = 1, .shininess = 40,
     .metallic = 0.5f, .roughness = 0.4f, .light_count = 1,
     .lights = {LIGHT(POINT, .position = {0.1, -0.15, -3}, WHITE, .attenuation = {1, 0, 0})}},
    {"coarse", "few triangles: interpolated normals are short", 0, .mesh = MESH_COARSE, .scale = {1.1, 0.6, 0.9},
     .turn_axis = {1, 1, 0}, .turn_deg = 20, .move = {0.3, 0.2, 0.1}, .eye = {-0.8, 0.9, 3.2}, .target = {0.2, 0.1, 0},
     MATTER, .kd = 0.6f, .ks = 0.6f, .shininess = 12, .metallic = 0.6f, .roughness = 0.4f, .light_count = 1,
     .lights = {LIGHT(POINT, .position = {0.6, 1.4, 2.2}, WHITE, .attenuation = {0.5f, 0.1f, 0.05f})}},
    {"near", "two large triangles and a light close to them", NEED_POINT, .mesh = MESH_PLANE, .scale = {1.6, 1, 1.6},
     .turn_axis = {1, 0, 0}, .turn_deg = 25, .eye = {0.4, 1.9, 3}, .target = {0, 0, 0}, MATTER, .kd = 1, .ks = 0.3f,
     .shininess = 10, .metallic = 0, .roughness = 0.4f, .light_count = 1,
     .lights = {LIGHT(POINT, .position = {0.35, 0.75, 0.3},
                      .to_light = {0, 0.906, 0.423}, // the plane's normal: the whole plane is in front of the light
                      WHITE, .attenuation = {0.4f, 0.3f, 0.6f})}},
    {"directional", "a light infinitely far away", NEED_DIRECTIONAL, STRETCHED, MATTER, .ka = 0.1f, .kd = 0.7f,
     .ks = 0.6f, .shininess = 14, .metallic = 0.4f, .roughness = 0.4f, .light_count = 1,
     .lights = {LIGHT(DIRECTIONAL, .to_light = {0.9, 1.3, 1.1}, TINTED, .attenuation = {1, 0, 0})}},
    {"close", "two large triangles near the eye, a light infinitely far away", NEED_DIRECTIONAL, .mesh = MESH_PLANE,
     .scale = {1.6, 1, 1.6}, .turn_axis = {0, 1, 0}, .turn_deg = 20, .eye = {0.3, 0.7, 1.3}, .target = {0, 0, 0},
     MATTER, .kd = 0.3f, .ks = 0.7f, .shininess = 12, .metallic = 1, .roughness = 0.35f, .light_count = 1,
     .lights = {LIGHT(DIRECTIONAL, .to_light = {-0.2, 0.7, -1.2}, WHITE, .attenuation = {1, 0, 0})}},
    {"lights", "three lights of different colours", NEED_LIGHTS, .mesh = MESH_SPHERE, BALL, MATTER, .ka = 0.15f,
     .kd = 0.8f, .ks = 0.5f, .shininess = 20, .metallic = 0.2f, .roughness = 0.4f, .light_count = 3,
     .lights = {LIGHT(POINT, .position = {2.2, 1.4, 1.8}, .color = {0.8f, 0.3f, 0.2f}, .specular = {0.3f, 0.6f, 0.9f},
                      .ambient = {0.3f, 0.3f, 0.3f}, .attenuation = {0.5f, 0.1f, 0.04f}),
                LIGHT(POINT, .position = {-2.4, 0.6, 1.2}, .color = {0.2f, 0.7f, 0.4f}, .specular = {0.9f, 0.5f, 0.2f},
                      .ambient = {0.2f, 0.4f, 0.1f}, .attenuation = {0.7f, 0.05f, 0.02f}),
                LIGHT(POINT, .position = {0.2, -2.2, 1.6}, .color = {0.3f, 0.4f, 0.9f}, .specular = {0.5f, 0.5f, 0.5f},
                      .ambient = {0.1f, 0.2f, 0.5f}, .attenuation = {0.9f, 0, 0.05f})}},
    {"spot", "a narrow cone of light from far away", NEED_SPOT, .mesh = MESH_SPHERE, BALL, MATTER, .ka = 0.1f,
     .kd = 0.8f, .ks = 0.5f, .shininess = 10, .metallic = 0.3f, .roughness = 0.5f, .light_count = 1,
     .lights = {LIGHT(SPOT, .position = {2.05, 2.65, 6.4}, .to_light = {0.25, 0.35, 0.9}, WHITE,
                      .attenuation = {0.6f, 0.02f, 0.004f}, .cutoff_deg = 7, .exponent = 60)}},
    {"wide spot", "a wide cone of light, close to a plane", NEED_SPOT, .mesh = MESH_PLANE, .scale = {1.6, 1, 1.6},
     .turn_axis = {1, 0, 0}, .turn_deg = 25, .eye = {0.4, 1.9, 3}, .target = {0, 0, 0}, MATTER, .kd = 0.9f, .ks = 0.3f,
     .shininess = 10, .metallic = 0, .roughness = 0.6f, .light_count = 1,
     .lights = {LIGHT(SPOT, .position = {0.35, 0.75, 0.3}, .to_light = {0, 0.906, 0.423}, WHITE,
                      .attenuation = {0.6f, 0.1f, 0.1f}, .cutoff_deg = 35, .exponent = 2)}},
    {"two sides", "the inside of a bowl: a back face is lit with -n", NEED_TWO_SIDES, .mesh = MESH_BOWL,
     .scale = {1, 1, 1}, .turn_axis = {1, 0, 0}, .turn_deg = 50, .eye = {0.3, 0.9, 3.3}, .target = {0, -0.1, 0}, MATTER,
     .ka = 0.1f, .kd = 0.8f, .ks = 0.5f, .shininess = 10, .metallic = 0.5f, .roughness = 0.5f, .light_count = 1,
     .lights = {LAMP}},
    {"flat", "flat shading", NEED_FLAT, .mesh = MESH_COARSE, BALL, MATTER, .ka = 0.15f, .kd = 0.7f, .ks = 0.5f,
     .shininess = 8, .flat = true, .metallic = 0.5f, .roughness = 0.4f, .light_count = 1, .lights = {LAMP}},
    {"bright", "colours above 1 at the vertices", NEED_VERTEX_LIT, .mesh = MESH_COARSE, BALL, MATTER, .kd = 1, .ks = 1,
     .shininess = 6, .metallic = 0, .roughness = 0.3f, .light_count = 1,
     .lights = {LIGHT(POINT, .position = {0.6, 1.4, 2.2}, .color = {3, 3, 3}, .specular = {2, 2, 2},
                      .ambient = {1, 1, 1}, .attenuation = {1, 0, 0})}},
    {"alpha", "a translucent material: alpha is the diffuse alpha", NEED_ALPHA, .mesh = MESH_SPHERE, BALL, COLORS,
     .alpha = 0.4f, .ka = 0.15f, .kd = 0.7f, .ks = 0.4f, .shininess = 10, .metallic = 0, .roughness = 0.5f,
     .light_count = 1, .lights = {LAMP}},
    {"bumps", "a normal map on a stretched patch, a nearby light", NEED_NORMAL_MAP, .mesh = MESH_PATCH, PATCH, MATTER,
     .ka = 0.1f, .kd = 0.8f, .ks = 0.4f, .shininess = 12, .metallic = 0.3f, .roughness = 0.45f,
     .bump = {0.42, -0.30, 0.78}, .light_count = 1, .lights = {LAMP}},
    {"bumps aside", "another normal map on that patch, a light from the side", NEED_NORMAL_MAP, .mesh = MESH_PATCH,
     PATCH, MATTER, .ka = 0.1f, .kd = 0.7f, .ks = 0.5f, .shininess = 10, .metallic = 0.8f, .roughness = 0.5f,
     .bump = {-0.25, -0.45, 0.80}, .light_count = 1,
     .lights = {LIGHT(POINT, .position = {-2.3, 1.1, 2}, WHITE, .attenuation = {0.6f, 0.1f, 0.04f})}},
    {"mirrored", "a normal map whose u is mirrored", NEED_NORMAL_MAP | NEED_TANGENT_SIGN, .mesh = MESH_PATCH_MIRRORED,
     PATCH, MATTER, .ka = 0.1f, .kd = 0.8f, .ks = 0.4f, .shininess = 12, .metallic = 0.3f, .roughness = 0.45f,
     .bump = {0.38, 0.36, 0.76}, .light_count = 1, .lights = {LAMP}},
    {"glow", "light that the surface emits", NEED_EMISSION_MAP, .mesh = MESH_SPHERE, BALL, MATTER, .ka = 0.1f,
     .kd = 0.5f, .ks = 0.3f, .shininess = 12, .metallic = 0.3f, .roughness = 0.5f, .emission = {0.30f, 0.12f, 0.45f},
     .light_count = 1, .lights = {LAMP}},
};
const int reference_scene_count = sizeof reference_scenes / sizeof reference_scenes[0];

int reference_scene_find(const char *name)
{
    for (int i = 0; i < reference_scene_count; i++)
        if (strcmp(reference_scenes[i].name, name) == 0)
            return i;
    return -1;
}

// --- meshes

// Computes the lower half of a sphere, which is open at the top. ∂p/∂u × ∂p/∂v points outward.
static void bowl(void *user, double u, double v, lam_surface_point *out)
{
    (void)user;
    double su = math_sin(u), cu = math_cos(u), sv = math_sin(v), cv = math_cos(v);
    out->p = v3(-sv * su, cv, sv * cu);
    out->dp_du = v3(-sv * cu, 0, -sv * su);
    out->dp_dv = v3(-cv * su, -sv, cv * cu);
}

static int add_mesh(lam_scene *scene, enum reference_mesh mesh, lam_error *error)
{
    switch (mesh) {
    case MESH_TEAPOT:
        return lam_scene_add_shape(scene, "teapot", &(lam_shape_params){.slices = 16, .stacks = 4}, error);
    case MESH_SPHERE:
        return lam_scene_add_shape(scene, "sphere", &(lam_shape_params){.slices = 32, .stacks = 16}, error);
    case MESH_COARSE:
        return lam_scene_add_shape(scene, "sphere", &(lam_shape_params){.slices = 9, .stacks = 6}, error);
    case MESH_PLANE:
    case MESH_PATCH:
    case MESH_PATCH_MIRRORED:
    case MESH_PATCH_DOWN:
    case MESH_PATCH_DOWN_MIRRORED:
        return lam_scene_add_shape(scene, "plane", &(lam_shape_params){.slices = 3, .stacks = 1}, error);
    case MESH_BOWL:
        return lam_scene_add_parametric(scene,
                                        &(lam_parametric){.surface = bowl,
                                                          .u_min = 0,
                                                          .u_max = 2 * PI,
                                                          .v_min = PI / 2,
                                                          .v_max = PI,
                                                          .u_segments = 24,
                                                          .v_segments = 8,
                                                          .u_closed = true},
                                        NULL, error);
    }
    return -1;
}

// Fills `points`, whose arrays have an element for every corner. `heads` contains the first vertex of each position, or
// −1. `next` contains, for each vertex, the next vertex at its position.
static void share_vertices(const lam_mesh *m, struct reference_points *points, int32_t *heads, int32_t *next)
{
    for (uint32_t p = 0; p < m->vertex_count; p++)
        heads[p] = -1;
    for (size_t i = 0; i < (size_t)points->count; i++) {
        size_t p = m->indices ? m->indices[i] : i;
        size_t n = m->normal_indices ? m->normal_indices[i] : p;
        int32_t v = heads[p];
        const float *tangent = m->tangents + 4 * (size_t)(m->tangent_indices ? m->tangent_indices[i] : p);
        while (v >= 0 && (memcmp(points->normals + 3 * (size_t)v, m->normals + 3 * n, 3 * sizeof(float)) != 0 ||
                          memcmp(points->tangents + 3 * (size_t)v, tangent, 3 * sizeof(float)) != 0))
            v = next[v];
        if (v < 0) {
            v = points->vertex_count++;
            next[v] = heads[p];
            heads[p] = v;
            for (size_t k = 0; k < 3; k++) {
                points->positions[3 * (size_t)v + k] = m->positions[3 * p + k] + (float)m->origin[k];
                points->normals[3 * (size_t)v + k] = m->normals[3 * n + k];
                points->tangents[3 * (size_t)v + k] = tangent[k];
            }
        }
        points->indices[i] = (uint16_t)v;
    }
}

static void put(float *out, lam_vec3 v)
{
    out[0] = (float)v.x;
    out[1] = (float)v.y;
    out[2] = (float)v.z;
}

// Computes texture coordinates and tangents. On a patch, whose normal is y, the texture is rotated by 30 degrees.
static void lay_texture(enum reference_mesh mesh, struct reference_points *points)
{
    const lam_vec3 up = v3(0, 1, 0), across = v3(math_cos(PI / 6), 0, -math_sin(PI / 6)), along = v3_cross(up, across);
    const bool patch = mesh >= MESH_PATCH;
    const bool mirrored = mesh == MESH_PATCH_MIRRORED || mesh == MESH_PATCH_DOWN_MIRRORED,
               down = mesh == MESH_PATCH_DOWN || mesh == MESH_PATCH_DOWN_MIRRORED;
    const lam_vec3 u = !patch ? v3(0.61, 0.23, -0.37) : v3_scale(across, mirrored ? -0.7 : 0.7),
                   v = !patch ? v3(-0.19, 0.67, 0.31) : v3_scale(along, down ? -0.7 : 0.7);
    for (size_t i = 0; i < (size_t)points->vertex_count; i++) {
        const float *p = points->positions + 3 * i, *n = points->normals + 3 * i, *t = points->tangents + 3 * i;
        lam_vec3 at = v3((double)p[0], (double)p[1], (double)p[2]),
                 normal = v3((double)n[0], (double)n[1], (double)n[2]);
        lam_vec3 tangent = patch ? v3_scale(across, mirrored ? -1 : 1) : v3((double)t[0], (double)t[1], (double)t[2]);
        double sign = mirrored ? -1 : 1;
        points->texture_coordinates[2 * i] = (float)(v3_dot(at, u) + 0.5);
        points->texture_coordinates[2 * i + 1] = (float)(v3_dot(at, v) + 0.5);
        put(points->surface_tangents + 4 * i, tangent);
        points->surface_tangents[4 * i + 3] = (float)sign;
        put(points->bitangents + 3 * i, v3_scale(v3_cross(normal, tangent), sign));
    }
}

bool reference_points(enum reference_mesh mesh, struct reference_points *points, lam_error *error)
{
    *points = (struct reference_points){0};
    lam_scene *scene = lam_scene_make(error);
    int index = scene ? add_mesh(scene, mesh, error) : -1;
    if (index < 0) {
        lam_scene_free(scene);
        return false;
    }
    const lam_mesh *m = lam_scene_mesh(scene, index);
    size_t count = 3 * (size_t)m->triangle_count, positions = (size_t)m->vertex_count;
    points->count = (int)count;
    points->positions = malloc(count * 3 * sizeof(float));
    points->normals = malloc(count * 3 * sizeof(float));
    points->tangents = malloc(count * 3 * sizeof(float));
    points->texture_coordinates = malloc(count * 2 * sizeof(float));
    points->surface_tangents = malloc(count * 4 * sizeof(float));
    points->bitangents = malloc(count * 3 * sizeof(float));
    points->indices = malloc(count * sizeof *points->indices);
    int32_t *heads = malloc((positions + count) * sizeof *heads);
    bool ok = points->positions && points->normals && points->tangents && points->texture_coordinates &&
              points->surface_tangents && points->bitangents && points->indices && heads;
    if (ok) {
        share_vertices(m, points, heads, heads + positions);
        lay_texture(mesh, points);
    } else {
        reference_points_free(points);
    }
    free(heads);
    lam_scene_free(scene);
    return ok || fail_memory(error, count * 20 * sizeof(float));
}

void reference_points_free(struct reference_points *points)
{
    free(points->positions);
    free(points->normals);
    free(points->tangents);
    free(points->texture_coordinates);
    free(points->surface_tangents);
    free(points->bitangents);
    free(points->indices);
    *points = (struct reference_points){0};
}

// --- matrices and the scene

enum { NEAR_CM = 50, FAR_CM = 1200, FIELD_DEG = 36 };

static lam_mat4 model_matrix(const struct reference_scene *s)
{
    lam_mat4 scale = mat4_scale(s->scale.x, s->scale.y, s->scale.z),
             turn = mat4_rotate(math_radians(s->turn_deg), s->turn_axis),
             move = mat4_translate(s->move.x, s->move.y, s->move.z);
    lam_mat4 both = mat4_mul(&turn, &scale);
    return mat4_mul(&move, &both);
}

static lam_camera camera_of(const struct reference_scene *s)
{
    return (lam_camera){.eye = s->eye,
                        .target = s->target,
                        .up = {0, 1, 0},
                        .fovy_rad = math_radians(FIELD_DEG),
                        .near_plane = NEAR_CM / 100.0,
                        .far_plane = FAR_CM / 100.0};
}

void reference_matrices(const struct reference_scene *s, struct reference_matrices *out)
{
    lam_camera camera = camera_of(s);
    out->model = model_matrix(s);
    out->view = lam_camera_view_matrix(&camera);
    out->model_view = mat4_mul(&out->view, &out->model);
    out->projection = mat4_perspective(camera.fovy_rad, 1, camera.near_plane, camera.far_plane);
    out->model_view_projection = mat4_mul(&out->projection, &out->model_view);
    lam_mat4 inverse = lam_mat4_identity();
    mat4_inverse_affine(&out->model_view, &inverse);
    for (int r = 0; r < 4; r++)
        for (int c = 0; c < 4; c++) {
            out->normal4.m[r][c] = inverse.m[c][r];
            if (r < 3 && c < 3)
                out->normal[r][c] = inverse.m[c][r];
        }
}

static lam_rgb times(lam_rgb a, float s) { return (lam_rgb){a.r * s, a.g * s, a.b * s}; }

static bool add_lights(lam_scene *scene, const struct reference_scene *s, lam_error *error)
{
    for (int i = 0; i < s->light_count; i++) {
        const struct reference_light *from = &s->lights[i];
        lam_light light = lam_light_default(from->type);
        light.position = from->position;
        light.direction = v3_scale(from->to_light, -1);
        light.ambient = from->ambient;
        light.diffuse = from->color;
        light.specular = from->specular;
        light.attenuation = (lam_attenuation){from->attenuation[0], from->attenuation[1], from->attenuation[2]};
        light.cutoff_rad = (float)math_radians((double)from->cutoff_deg);
        light.exponent = from->exponent;
        if (lam_scene_add_light(scene, &light, error) < 0)
            return false;
    }
    return true;
}

lam_scene *reference_to_scene(const struct reference_scene *s, lam_camera *camera, lam_error *error)
{
    lam_scene *scene = lam_scene_make(error);
    if (!scene)
        return NULL;
    lam_material material = lam_material_default();
    lam_rgb kd = times(s->diffuse, s->kd);
    material.ambient = times(s->ambient, s->ka);
    material.diffuse = (lam_rgba){kd.r, kd.g, kd.b, s->alpha};
    material.specular = times(s->specular, s->ks);
    material.shininess = s->shininess;
    material.physical = s->physical;
    material.metallic = s->metallic;
    material.roughness = s->roughness;
    material.roughness_angle_rad = s->roughness_angle_rad < 1.5f ? s->roughness_angle_rad : 0;
    material.toon_steps = s->roughness_angle_rad;
    material.emission = s->emission;
    lam_object object = lam_object_default();
    object.mesh = add_mesh(scene, s->mesh, error);
    object.material = object.mesh < 0 ? -1 : lam_scene_add_material(scene, &material, error);
    object.transform = model_matrix(s);
    if (object.mesh < 0 || object.material < 0 || lam_scene_add_object(scene, &object, error) < 0 ||
        !add_lights(scene, s, error)) {
        lam_scene_free(scene);
        return NULL;
    }
    *camera = camera_of(s);
    return scene;
}
