// gltf_nodes.c: reads the node tree (section 3.5): transforms, parents, and the nodes of the selected scene.
#include "gltf.h"
#include "gltf_json.h"
#include "linear.h"

#include <math.h>

lam_mat4 gltf_transform(const double translation[3], const double rotation[4], const double scale[3])
{
    double x = rotation[0], y = rotation[1], z = rotation[2], w = rotation[3];
    const double turn[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
                               {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
                               {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
    lam_mat4 m = lam_mat4_identity();
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++)
            m.m[i][j] = turn[i][j] * scale[j];
        m.m[i][3] = translation[i];
    }
    return m;
}

void gltf_unit_quaternion(double q[4])
{
    double length = math_sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (int i = 0; i < 4; i++)
        q[i] = length > 0 ? q[i] / length : i == 3;
}

static bool read_node(struct gltf *gltf, const struct place *place, const json_t *object, struct gltf_node *node)
{
    *node = (struct gltf_node){
        .parent = -1, .matrix = {[0] = 1, [5] = 1, [10] = 1, [15] = 1}, .rotation = {0, 0, 0, 1}, .scale = {1, 1, 1}};
    node->has_matrix = json_is_array(json_object_get(object, "matrix"));
    const json_t *visibility = gltf_extension(object, "KHR_node_visibility");
    const struct place *here = KEY_OF(KEY_OF(place, "extensions"), "KHR_node_visibility");
    gltf_take_numbers(gltf, place, object, "matrix", 16, node->matrix);
    gltf_take_numbers(gltf, place, object, "translation", 3, node->translation);
    gltf_take_numbers(gltf, place, object, "rotation", 4, node->rotation);
    gltf_take_numbers(gltf, place, object, "scale", 3, node->scale);
    node->visible = gltf_take_flag(gltf, here, visibility, "visible", true);
    gltf_unit_quaternion(node->rotation);
    const double *m = node->matrix;
    // Rounded numbers in the last row are accepted; gltf_nodes_place sets the row to exactly 0 0 0 1.
    bool affine = m[3] * m[3] + m[7] * m[7] + m[11] * m[11] + (m[15] - 1) * (m[15] - 1) < 1e-10;
    if (node->has_matrix && !affine)
        gltf_note(gltf, KEY_OF(place, "matrix"), "its last row is %.6g %.6g %.6g %.6g; 0 0 0 1 is used", m[3], m[7],
                  m[11], m[15]);
    return gltf_take_weights(gltf, place, object, &node->weights, &node->weight_count);
}

// Sets `parent` as the parent of each node in its list of children. A node keeps its first parent.
static void read_children(struct gltf *gltf, int parent)
{
    const json_t *object = gltf_list_item(gltf, "nodes", parent), *list = json_object_get(object, "children");
    const struct place *place = KEY_OF(ELEMENT_OF(KEY_OF(NULL, "nodes"), (size_t)parent), "children");
    if (list && !json_is_array(list))
        gltf_note_wrong(gltf, place, list, "a list of nodes");
    for (size_t i = 0; i < json_array_size(list); i++) {
        int child;
        const struct place *here = ELEMENT_OF(place, i);
        if (!gltf_index_of(gltf, here, json_array_get(list, i), "nodes", &child))
            gltf_forgive(gltf);
        else if (gltf->nodes[child].parent >= 0)
            gltf_note(gltf, here, "node %d is a child of node %d already; it is drawn once", child,
                      gltf->nodes[child].parent);
        else
            gltf->nodes[child].parent = parent;
    }
}

// Sets node_order: depth first, roots in the file's order. Nodes that are not reached from any root form a cycle, whose
// first node becomes a root.
static bool order_nodes(struct gltf *gltf)
{
    size_t count = (size_t)gltf->node_count;
    int *order = GLTF_ALLOC(gltf, count, int), *stack = GLTF_ALLOC(gltf, count, int);
    bool *reached = GLTF_ALLOC(gltf, count, bool);
    int ordered = 0, depth = 0;
    if (!order || !stack || !reached)
        return gltf_no_memory(gltf, count * sizeof *order);
    for (size_t i = 0; i < 2 * count; i++) {
        int root = (int)(i % count);
        if (reached[root] || (i < count && gltf->nodes[root].parent >= 0))
            continue;
        if (gltf->nodes[root].parent >= 0)
            gltf_note(gltf, ELEMENT_OF(KEY_OF(NULL, "nodes"), (size_t)root),
                      "this node is its own ancestor; it is drawn without a parent");
        gltf->nodes[root].parent = -1;
        for (reached[stack[depth++] = root] = true; depth > 0;) {
            int node = stack[--depth];
            const json_t *children = json_object_get(gltf_list_item(gltf, "nodes", node), "children");
            order[ordered++] = node;
            for (size_t k = json_array_size(children); k-- > 0;) {
                double number = json_number_value(json_array_get(children, k)); // wrong children are noted already
                int child = number >= 0 && number < gltf->node_count ? (int)number : root;
                if (!reached[child] && gltf->nodes[child].parent == node)
                    reached[stack[depth++] = child] = true;
            }
        }
    }
    gltf->node_order = order;
    return true;
}

// Marks the roots of the scene to draw: the scene that the caller requests, otherwise the file's default scene,
// otherwise the first scene. If a file contains no scenes, all of its nodes are drawn. Some files list nodes that are
// not roots; the parents of such nodes still determine their transforms.
static bool mark_roots(struct gltf *gltf)
{
    const char *wanted = gltf->source->params->scene;
    int scene = gltf_take_link(gltf, NULL, gltf->root, "scene", "scenes");
    if (wanted && (scene = gltf_find_named(gltf, json_object_get(gltf->root, "scenes"), wanted, "scene")) < 0)
        return false;
    scene = scene < 0 && gltf_list_size(gltf, "scenes") ? 0 : scene;
    gltf->scene->file.scene = scene;
    const json_t *list = scene < 0 ? NULL : json_object_get(gltf_list_item(gltf, "scenes", scene), "nodes");
    const struct place *place = KEY_OF(ELEMENT_OF(KEY_OF(NULL, "scenes"), (size_t)scene), "nodes");
    bool any = false;
    for (size_t i = 0; i < json_array_size(list); i++) {
        int node;
        if (gltf_index_of(gltf, ELEMENT_OF(place, i), json_array_get(list, i), "nodes", &node)) {
            if (gltf->nodes[node].in_scene)
                gltf_note(gltf, ELEMENT_OF(place, i), "node %d is listed already; it is drawn once", node);
            any = gltf->nodes[node].in_scene = true;
        } else
            gltf_forgive(gltf);
    }
    if (!any && scene >= 0)
        gltf_note(gltf, place, "the scene lists no nodes; all nodes of the file are drawn");
    for (int i = 0; !any && i < gltf->node_count; i++)
        gltf->nodes[i].in_scene = gltf->nodes[i].parent < 0;
    return true;
}

bool gltf_nodes_read(struct gltf *gltf)
{
    gltf->node_count = (int)gltf_list_size(gltf, "nodes");
    gltf->nodes = GLTF_ALLOC(gltf, gltf->node_count, struct gltf_node);
    if (!gltf->nodes)
        return gltf_no_memory(gltf, (size_t)gltf->node_count * sizeof *gltf->nodes);
    for (int i = 0; i < gltf->node_count; i++)
        if (!read_node(gltf, ELEMENT_OF(KEY_OF(NULL, "nodes"), (size_t)i), gltf_list_item(gltf, "nodes", i),
                       &gltf->nodes[i]))
            return false;
    for (int i = 0; i < gltf->node_count; i++)
        read_children(gltf, i);
    if (!order_nodes(gltf) || !mark_roots(gltf))
        return false;
    for (int i = 0; i < gltf->node_count; i++) {
        struct gltf_node *node = &gltf->nodes[gltf->node_order[i]];
        node->in_scene |= node->parent >= 0 && gltf->nodes[node->parent].in_scene;
    }
    return true;
}

void gltf_nodes_place(struct gltf *gltf)
{
    for (int i = 0; i < gltf->node_count; i++) {
        struct gltf_node *node = &gltf->nodes[gltf->node_order[i]];
        lam_mat4 own = gltf_transform(node->translation, node->rotation, node->scale);
        for (int j = 0; node->has_matrix && j < 16; j++)
            if (j % 4 < 3)
                own.m[j % 4][j / 4] = node->matrix[j];
        node->world = node->parent >= 0 ? mat4_mul(&gltf->nodes[node->parent].world, &own) : own;
        node->visible &= node->parent < 0 || gltf->nodes[node->parent].visible;
        bool finite = true;
        for (int j = 0; j < 12; j++)
            finite &= math_finite(node->world.m[j / 4][j % 4]);
        if (finite)
            continue;
        gltf_note(gltf, ELEMENT_OF(KEY_OF(NULL, "nodes"), (size_t)gltf->node_order[i]),
                  "its transform is not finite; drawn without this node");
        node->world = lam_mat4_identity();
        node->visible = false;
    }
}

// --- reads the file's cameras (section 3.10).

#define LIMIT 1e30 // greater numbers mean infinity (some exporters write FLT_MAX)

static bool read_camera(struct gltf *gltf, int index, lam_camera *camera)
{
    static const struct json_choice words[] = {{"perspective", 0}, {"orthographic", 1}, {NULL, 0}};
    const json_t *object = gltf_list_item(gltf, "cameras", index);
    const struct place *place = ELEMENT_OF(KEY_OF(NULL, "cameras"), (size_t)index);
    int parallel = -1;
    if (!json_take_word(&gltf->json, place, object, "type", words, &parallel))
        return false;
    if (parallel < 0)
        return json_fail(&gltf->json, place, "type is missing");
    const char *key = words[parallel].name, *size_key = parallel ? "ymag" : "yfov";
    const struct place *here = KEY_OF(place, key);
    const json_t *numbers = gltf_take_object(gltf, place, object, key);
    double size = 0, near_plane = parallel ? -1 : 0, far_plane = HUGE_VAL;
    gltf_take_factors(gltf, here, numbers, size_key, 1, -HUGE_VAL, HUGE_VAL, &size);
    gltf_take_factors(gltf, here, numbers, "znear", 1, -HUGE_VAL, HUGE_VAL, &near_plane);
    gltf_take_factors(gltf, here, numbers, "zfar", 1, -HUGE_VAL, HUGE_VAL, &far_plane);
    size = parallel && size < 0 ? -size : size;
    if (!(size > 1e-6 && (parallel ? size < LIMIT : size < PI - 1e-6)))
        return json_fail(&gltf->json, here, "%s is missing or wrong (%.10g)", size_key, size);
    if (!(near_plane < LIMIT && (parallel ? near_plane >= 0 : near_plane > 0)))
        return json_fail(&gltf->json, here, "znear is missing or wrong (%.10g)", near_plane);
    if (far_plane <= near_plane)
        gltf_note(gltf, KEY_OF(here, "zfar"), "found %.10g, expected more than znear, %.10g; drawn without it",
                  far_plane, near_plane);
    *(parallel ? &camera->ortho_half_height : &camera->fovy_rad) = size;
    camera->near_plane = near_plane;
    // 0 means that lam_scene_camera fits the far plane to the scene
    camera->far_plane = far_plane > near_plane && far_plane < LIMIT ? far_plane : 0;
    return true;
}

static bool add_camera(struct gltf *gltf, int node_index)
{
    const json_t *object = gltf_list_item(gltf, "nodes", node_index);
    const struct place *place = ELEMENT_OF(KEY_OF(NULL, "nodes"), (size_t)node_index);
    const lam_mat4 *world = &gltf->nodes[node_index].world;
    struct scene_camera camera = {.camera = lam_camera_default()};
    int index = gltf_take_link(gltf, place, object, "camera", "cameras");
    bool ok = true;
    if (index < 0)
        return true;
    if (!read_camera(gltf, index, &camera.camera))
        return gltf_forgive(gltf);
    if (!(camera.name = gltf_name(gltf, object, &ok)) && ok)
        camera.name = gltf_name(gltf, gltf_list_item(gltf, "cameras", index), &ok);
    // The scale of nodes is ignored (section 3.10.1).
    lam_vec3 forward = v3_unit(mat4_vector(world, v3(0, 0, -1))), up = v3_unit(mat4_vector(world, v3(0, 1, 0)));
    if (v3_length(forward) == 0 || v3_length(up) == 0)
        return ok;
    camera.camera.eye = v3(world->m[0][3], world->m[1][3], world->m[2][3]);
    camera.camera.target = v3_add(camera.camera.eye, forward);
    camera.camera.up = up;
    return ok && scene_append(gltf->scene, &gltf->scene->cameras, &camera, sizeof camera, gltf->json.error) >= 0;
}

bool gltf_cameras_add(struct gltf *gltf)
{
    for (int i = 0; i < gltf->node_count; i++)
        if (gltf->nodes[gltf->node_order[i]].in_scene && !add_camera(gltf, gltf->node_order[i]))
            return false;
    return true;
}
