// gltf_objects.c: converts nodes with meshes to objects of the scene, and adds their instances
// (EXT_mesh_gpu_instancing).
#include "gltf.h"

#include "gltf_data.h"
#include "gltf_json.h"
#include "gltf_materials.h"
#include "gltf_meshes.h"

#include "linear.h"

// Adds the primitives of a mesh with a transform. If the transform flattens space to a line or a point, the primitives
// are invisible and are not added.
static bool add_mesh(struct gltf *gltf, const struct gltf_mesh *mesh, const char *name, int group,
                     const lam_mat4 *transform)
{
    double cofactors[3][3], determinant = mat4_determinant3(transform);
    mat4_normal_matrix(transform, cofactors);
    bool flat = determinant == 0, empty = true;
    for (int i = 0; i < 9; i++)
        empty &= cofactors[i / 3][i % 3] == 0;
    if (flat && empty)
        return true;
    if (flat || !math_finite(determinant)) {
        gltf->flattened++;
        return true;
    }
    for (int i = 0; i < mesh->count; i++) {
        if (mesh->primitives[i].mesh < 0)
            continue;
        lam_object object = lam_object_default();
        object.mesh = mesh->primitives[i].mesh;
        object.name = name;
        object.group = group;
        if (!mesh->primitives[i].skinned) // the node transform of a skinned mesh is ignored
            object.transform = *transform;
        int32_t material = scene_mesh(gltf->scene, object.mesh)->parts->material;
        object.cull = gltf_material_is_double_sided(gltf, material) ? LAM_CULL_NONE : LAM_CULL_BACK;
        if (scene_adopt_object(gltf->scene, &object, gltf->json.error) < 0)
            return false;
    }
    return true;
}

// A node's instances: arrays with 3, 4 and 3 numbers for each instance. NULL means that the attribute is missing.
struct instances {
    const float *translation, *rotation, *scale;
    size_t count;
};

// Checks that the call's limits allow all instances, before any instance is created.
static bool check_instances(struct gltf *gltf, const struct gltf_mesh *mesh, size_t count)
{
    struct call_control *call = gltf->source->call;
    uint64_t items = 0;
    size_t objects = 0;
    for (int i = 0; i < mesh->count; i++)
        if (mesh->primitives[i].mesh >= 0) {
            items += mesh_items(scene_mesh(gltf->scene, mesh->primitives[i].mesh));
            objects += count;
        }
    items = items && count > UINT64_MAX / items ? UINT64_MAX : items * count;
    if (!call_check_triangles(call, gltf->source->name, items, "triangles, lines and points of instances",
                              gltf->json.error))
        return false;
    if (!call_check_objects(call, gltf->source->name, (uint64_t)gltf->scene->objects.count + objects, gltf->json.error))
        return false;
    if (!call_charge(call, objects * sizeof(lam_object)))
        return gltf_no_memory(gltf, objects * sizeof(lam_object));
    // the memory of each object is counted again when the object is created
    call_refund(call, objects * sizeof(lam_object));
    return true;
}

// Once per 1024 objects, checks whether the call is cancelled or out of time. If so, returns false.
static bool continues(struct gltf *gltf, size_t number)
{
    struct call_control *call = gltf->source->call;
    return number % 1024 || call_should_continue(call) || call_error(call, gltf->json.error);
}

static bool take_instances(struct gltf *gltf, const struct place *place, const json_t *attributes, const char *key,
                           const struct gltf_mesh *mesh, int width, const float **out, size_t *count)
{
    char words[64];
    const struct place *here = KEY_OF(place, key);
    struct gltf_accessor *a;
    if (!gltf_take_accessor(gltf, place, attributes, key, &a))
        return false;
    if (!a)
        return true;
    if (a->width != width || a->type[0] != 'V' || (a->component != GLTF_F32 && (width == 3 || !a->normalized)))
        return json_fail(&gltf->json, here, "found %s, expected VEC%d of FLOAT%s", gltf_accessor_words(a, words), width,
                         width == 4 ? ", or of normalized BYTE or SHORT" : "");
    if (*count && a->count != *count)
        return json_fail(&gltf->json, here, "found %zu elements, but another attribute has %zu", a->count, *count);
    if (!*count && !check_instances(gltf, mesh, a->count))
        return false;
    *count = a->count;
    *out = gltf_floats(gltf, here, a, GLTF_REQUIRED);
    return *out;
}

static void copy_element(const float *numbers, size_t i, size_t width, double *out)
{
    for (size_t c = 0; numbers && c < width; c++)
        out[c] = (double)numbers[i * width + c];
}

static lam_mat4 instance_transform(const struct instances *instances, size_t i)
{
    double translation[3] = {0}, rotation[4] = {0, 0, 0, 1}, scale[3] = {1, 1, 1};
    copy_element(instances->translation, i, 3, translation);
    copy_element(instances->rotation, i, 4, rotation);
    copy_element(instances->scale, i, 3, scale);
    gltf_unit_quaternion(rotation);
    return gltf_transform(translation, rotation, scale);
}

static bool add_instances(struct gltf *gltf, const struct place *place, const json_t *extension,
                          const struct gltf_mesh *mesh, const char *name, int group, const lam_mat4 *world)
{
    struct instances instances = {0};
    const json_t *attributes = gltf_take_object(gltf, place, extension, "attributes");
    const struct place *here = KEY_OF(place, "attributes");
    if (!take_instances(gltf, here, attributes, "TRANSLATION", mesh, 3, &instances.translation, &instances.count) ||
        !take_instances(gltf, here, attributes, "ROTATION", mesh, 4, &instances.rotation, &instances.count) ||
        !take_instances(gltf, here, attributes, "SCALE", mesh, 3, &instances.scale, &instances.count))
        return false;
    if (!instances.count) {
        gltf_note(gltf, here, "found no TRANSLATION, ROTATION or SCALE; the mesh is drawn once");
        return add_mesh(gltf, mesh, name, group, world);
    }
    for (size_t i = 0; i < instances.count; i++) {
        lam_mat4 own = instance_transform(&instances, i), transform = mat4_mul(world, &own);
        if (!continues(gltf, i) || !add_mesh(gltf, mesh, name, group, &transform))
            return false;
    }
    return true;
}

static const struct gltf_mesh *mesh_of(struct gltf *gltf, const struct place *place, const json_t *object,
                                       const struct gltf_node *node, int mesh)
{
    int skin_index = gltf_take_link(gltf, place, object, "skin", "skins");
    const struct gltf_skin *skin = skin_index >= 0 ? gltf_skin_at(gltf, skin_index) : NULL;
    if (skin_index >= 0 && !skin && !gltf_forgive(gltf))
        return NULL;
    return skin || node->weights ? gltf_mesh_deformed(gltf, mesh, node, skin) : gltf_mesh_at(gltf, mesh);
}

static bool add_node(struct gltf *gltf, int index)
{
    const struct gltf_node *node = &gltf->nodes[index];
    const struct place *place = ELEMENT_OF(KEY_OF(NULL, "nodes"), (size_t)index);
    const json_t *object = gltf_list_item(gltf, "nodes", index);
    int mesh_index = gltf_take_link(gltf, place, object, "mesh", "meshes");
    bool ok = true;
    if (mesh_index < 0)
        return true;
    const struct gltf_mesh *mesh = mesh_of(gltf, place, object, node, mesh_index);
    const char *name = mesh ? gltf_name(gltf, object, &ok) : NULL;
    if (!mesh || !ok)
        return false;
    if (!name && mesh->count && mesh->primitives[0].mesh >= 0)
        name = scene_mesh(gltf->scene, mesh->primitives[0].mesh)->name;
    const json_t *instancing = gltf_extension(object, "EXT_mesh_gpu_instancing");
    const struct place *here = KEY_OF(KEY_OF(place, "extensions"), "EXT_mesh_gpu_instancing");
    const int group = node->parent < 0 ? 0 : gltf->nodes[node->parent].group;
    return instancing ? add_instances(gltf, here, instancing, mesh, name, group, &node->world) || gltf_skip(gltf)
                      : add_mesh(gltf, mesh, name, group, &node->world);
}

// Makes a group of a node with a name and children.
static bool add_group(struct gltf *gltf, int index)
{
    struct gltf_node *node = &gltf->nodes[index];
    const json_t *object = gltf_list_item(gltf, "nodes", index);
    bool ok = true;
    lam_group group = {.parent = node->parent < 0 ? 0 : gltf->nodes[node->parent].group};
    node->group = group.parent;
    if (!json_array_size(json_object_get(object, "children")) || !(group.name = gltf_name(gltf, object, &ok)))
        return ok;
    node->group = 1 + scene_append(gltf->scene, &gltf->scene->groups, &group, sizeof group, gltf->json.error);
    return node->group > 0;
}

bool gltf_objects_add(struct gltf *gltf)
{
    gltf_nodes_place(gltf);
    for (int i = 0; i < gltf->node_count; i++) {
        const struct gltf_node *node = &gltf->nodes[gltf->node_order[i]];
        if (!continues(gltf, (size_t)i) || !add_group(gltf, gltf->node_order[i]) ||
            (node->in_scene && node->visible && !add_node(gltf, gltf->node_order[i])))
            return false;
    }
    return true;
}
