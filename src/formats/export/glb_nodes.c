// glb_nodes.c: writes objects, lights (KHR_lights_punctual) and cameras as nodes with a matrix.
#include "glb.h"

#include "linear.h"

#include <lambent/light.h>

// Rotates a matrix from the scene's up axis to y up.
static lam_mat4 placed(const struct glb *glb, lam_mat4 m)
{
    lam_mat4 turn = lam_mat4_identity();
    lam_vec3 axes[3] = {export_turned(glb->e, v3(1, 0, 0)), export_turned(glb->e, v3(0, 1, 0)),
                        export_turned(glb->e, v3(0, 0, 1))};
    lam_up up = glb->e->from;
    if (up == LAM_UP_Y || up == LAM_UP_AUTO)
        return m;
    for (int i = 0; i < 3; i++) {
        turn.m[0][i] = axes[i].x;
        turn.m[1][i] = axes[i].y;
        turn.m[2][i] = axes[i].z;
    }
    return mat4_mul(&turn, &m);
}

static json_t *node(struct glb *glb, const char *name, lam_mat4 matrix)
{
    json_t *object = json_object(), *numbers = json_array();
    bool identity = true;
    matrix = placed(glb, matrix);
    for (int i = 0; i < 16; i++) {
        double x = matrix.m[i % 4][i / 4];
        identity &= x == (i % 5 == 0);
        glb_add(glb, numbers, json_real(x));
    }
    glb_set_name(glb, object, name);
    if (!identity)
        glb_set(glb, object, "matrix", json_incref(numbers));
    json_decref(numbers);
    return object;
}

// Adds a node for a part of an object, or for all parts (−1).
static bool add_part(struct glb *glb, const lam_object *object, int part, const char *name, lam_mat4 matrix)
{
    int mesh = glb_mesh_of(glb, object, part);
    json_t *item = mesh < 0 ? NULL : node(glb, name, matrix);
    if (!item)
        return mesh < 0 ? false : export_no_memory(glb->e, 100);
    glb_set(glb, item, "mesh", json_integer(mesh));
    glb_add(glb, glb->nodes, item);
    return true;
}

// glTF primitives have no names, so a mesh with named parts is written as one node for each part.
static bool add_object(struct glb *glb, const lam_object *object)
{
    const lam_mesh *m = scene_mesh(glb->e->scene, object->mesh);
    lam_mat4 matrix = object->transform;
    if (!mesh_items(m))
        return true;
    if (m->origin[0] != 0 || m->origin[1] != 0 || m->origin[2] != 0) {
        lam_mat4 origin = mat4_translate(m->origin[0], m->origin[1], m->origin[2]);
        matrix = mat4_mul(&matrix, &origin);
    }
    if (object->cull == LAM_CULL_FRONT)
        export_lose(glb->e, "culled front faces are visible: glTF can cull only back faces");
    if (object->back_material >= 0)
        export_lose(glb->e, "materials of back faces are omitted: glTF does not support them");
    if (object->one_sided)
        export_lose(glb->e, "back faces are no longer lit like front faces: glTF does not support this");
    bool named = false;
    for (uint32_t i = 0; i < m->part_count; i++)
        named |= m->parts[i].name != NULL;
    if (!named)
        return add_part(glb, object, -1, object->name, matrix);
    for (uint32_t i = 0; i < m->part_count; i++) {
        const lam_part *part = &m->parts[i];
        if (part->triangle_count && !add_part(glb, object, (int)i, part->name ? part->name : object->name, matrix))
            return false;
    }
    return true;
}

// --- lights

// Returns a transform with three perpendicular axes of equal length. The third axis is −direction.
static lam_mat4 looking(lam_vec3 position, lam_vec3 direction)
{
    lam_mat4 m = lam_mat4_identity();
    double length = v3_length(direction);
    lam_vec3 z = v3_scale(direction, -1), unit = v3_unit(z),
             aside = unit.y > 0.9 || unit.y < -0.9 ? v3(1, 0, 0) : v3(0, 1, 0);
    lam_vec3 x = v3_scale(v3_unit(v3_cross(aside, unit)), length), y = v3_cross(unit, x);
    const lam_vec3 columns[4] = {x, y, z, position};
    for (int i = 0; i < 4; i++) {
        m.m[0][i] = columns[i].x;
        m.m[1][i] = columns[i].y;
        m.m[2][i] = columns[i].z;
    }
    return m;
}

static void lose_fields(struct glb *glb, const lam_light *l)
{
    const lam_attenuation *a = &l->attenuation;
    bool distant = l->type == LAM_LIGHT_DIRECTIONAL;
    if (l->ambient.r > 0 || l->ambient.g > 0 || l->ambient.b > 0)
        export_lose(glb->e, "ambient parts of lights are omitted: glTF does not support them");
    if (l->specular.r != l->diffuse.r || l->specular.g != l->diffuse.g || l->specular.b != l->diffuse.b)
        export_lose(glb->e, "specular colours of lights are omitted: glTF uses the diffuse colour for both");
    if (!distant && (a->constant != 0 || a->linear != 0 || a->quadratic != 1))
        export_lose(glb->e, "the attenuation of lights becomes inverse-square: glTF supports no other");
    if (l->radius > 0 || l->angular_radius_rad > 0 || l->occluded > 0 || l->no_shadows)
        export_lose(glb->e, "sizes and shadows of lights are omitted: glTF does not support them");
    if (l->type == LAM_LIGHT_SPOT && !(l->outer_rad > 0))
        export_lose(glb->e, "spot lights with an exponent become soft cones with the same angle");
}

// The intensity in glTF (candela or lux) is π times Lambent's. In glTF, a white Lambertian surface reflects 1/π of the
// light. In Lambent, such a surface reflects all of the light.
static json_t *light(struct glb *glb, const lam_light *l)
{
    static const char *const words[LAM_LIGHT_TYPE_COUNT] = {
        [LAM_LIGHT_POINT] = "point", [LAM_LIGHT_DIRECTIONAL] = "directional", [LAM_LIGHT_SPOT] = "spot"};
    const float *c = &l->diffuse.r;
    double most = 0;
    json_t *color = json_array();
    for (int i = 0; i < 3; i++)
        most = (double)c[i] > most ? (double)c[i] : most;
    for (int i = 0; i < 3; i++)
        glb_add(glb, color, json_real(most > 0 ? (double)c[i] / most : 1));
    json_t *object = json_pack("{s:s, s:f, s:o}", "type", words[l->type], "intensity", most * PI, "color", color);
    glb_set_name(glb, object, l->name);
    if (l->range > 0 && l->type != LAM_LIGHT_DIRECTIONAL)
        glb_set(glb, object, "range", json_real((double)l->range));
    if (l->type == LAM_LIGHT_SPOT) {
        bool soft = l->outer_rad > 0, edge = l->cutoff_rad > 0 && (double)l->cutoff_rad < 2;
        double outer = soft ? (double)l->outer_rad : edge ? (double)l->cutoff_rad : PI / 2;
        double inner = soft ? (double)l->inner_rad : l->exponent > 0 ? 0 : outer * 0.99;
        glb_set(glb, object, "spot", json_pack("{s:f, s:f}", "innerConeAngle", inner, "outerConeAngle", outer));
    }
    lose_fields(glb, l);
    return object;
}

static void add_light(struct glb *glb, const lam_light *l)
{
    const lam_mat4 *placement = &glb->e->scene->placement;
    bool positioned = l->type == LAM_LIGHT_POINT || l->type == LAM_LIGHT_SPOT || l->type == LAM_LIGHT_DIRECTIONAL;
    if (!positioned) {
        export_lose(glb->e, "ambient and hemisphere lights are omitted: glTF does not support them");
        return;
    }
    if (l->frame != LAM_FRAME_WORLD && l->frame != LAM_FRAME_MODEL) {
        export_lose(glb->e, "lights that move with the camera or an object are omitted: glTF does not support them");
        return;
    }
    lam_vec3 position = l->position, direction = l->direction;
    if (l->frame == LAM_FRAME_MODEL) {
        position = mat4_point(placement, position);
        direction = mat4_vector(placement, direction);
    }
    int number = glb_add(glb, glb->lights, light(glb, l));
    json_t *item = node(glb, l->name, looking(position, v3_length(direction) > 0 ? direction : v3(0, 0, -1)));
    glb_set(glb, glb_extension(glb, item, "KHR_lights_punctual"), "light", json_integer(number));
    glb_add(glb, glb->nodes, item);
}

// --- cameras

static void add_camera(struct glb *glb, const lam_camera *c, const char *name)
{
    if (c->fx > 0) {
        export_lose(glb->e, "cameras with fx, fy, cx and cy are left out: glTF has no principal point");
        return;
    }
    lam_vec3 forward = v3_unit(v3_sub(c->target, c->eye));
    lam_mat4 m = looking(c->eye, forward);
    lam_vec3 z = v3_scale(forward, -1), side = v3_cross(c->up, z);
    double near_plane = c->near_plane, far_plane = c->far_plane;
    if (v3_length(side) > 1e-9) {
        lam_vec3 x = v3_unit(side), y = v3_cross(z, x);
        m.m[0][0] = x.x, m.m[1][0] = x.y, m.m[2][0] = x.z;
        m.m[0][1] = y.x, m.m[1][1] = y.y, m.m[2][1] = y.z;
    }
    // Lambent would fit a plane of 0 to the scene, but glTF requires numbers, except for the far plane of a perspective.
    const bool parallel = c->ortho_half_height > 0, near_missing = !(near_plane > 0) && (!parallel || !(far_plane > 0));
    if (near_missing || (parallel && !(far_plane > near_plane))) {
        lam_vec3 centre;
        double radius;
        lam_scene_sphere(glb->e->scene, -1, &centre, &radius);
        far_plane = far_plane > near_plane ? far_plane : v3_length(v3_sub(centre, c->eye)) + 2 * radius + 1e-3;
        near_plane = near_missing || near_plane >= far_plane ? far_plane / 10000 : near_plane;
        export_lose(glb->e, "cameras are written with fixed near and far planes: glTF requires numbers");
    }
    if (!(near_plane <= 1e30 && far_plane <= 1e30)) { // the reader's limits, which keep products of such numbers finite
        export_lose(glb->e, "cameras with planes beyond 1e30 units are left out");
        return;
    }
    json_t *object, *numbers;
    if (parallel) {
        numbers = json_pack("{s:f, s:f, s:f, s:f}", "xmag", c->ortho_half_height, "ymag", c->ortho_half_height, "znear",
                            near_plane > 0 ? near_plane : 0.0, "zfar", far_plane);
        object = json_pack("{s:s, s:o}", "type", "orthographic", "orthographic", numbers);
    } else {
        numbers = json_pack("{s:f, s:f}", "yfov", c->fovy_rad, "znear", near_plane);
        if (far_plane > near_plane)
            glb_set(glb, numbers, "zfar", json_real(far_plane));
        object = json_pack("{s:s, s:o}", "type", "perspective", "perspective", numbers);
    }
    glb_set_name(glb, object, name);
    int number = glb_add(glb, glb->cameras, object);
    json_t *item = node(glb, name, m);
    glb_set(glb, item, "camera", json_integer(number));
    glb_add(glb, glb->nodes, item);
}

bool glb_nodes(struct glb *glb)
{
    const struct lam_scene *s = glb->e->scene;
    for (int i = 0; i < s->objects.count; i++) {
        if (scene_shows(s, i) && !add_object(glb, scene_object(s, i)))
            return false;
        if (glb->failed || glb->bytes.failed || !export_is_whole(glb->e))
            return glb_error(glb);
    }
    for (int i = 0; i < s->lights.count; i++)
        add_light(glb, (const lam_light *)s->lights.items + i);
    if (glb->e->params->camera)
        add_camera(glb, glb->e->params->camera, NULL);
    for (int i = 0; i < s->cameras.count; i++) {
        const struct scene_camera *camera = (const struct scene_camera *)s->cameras.items + i;
        add_camera(glb, &camera->camera, camera->name);
    }
    return true;
}
