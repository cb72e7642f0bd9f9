// gltf_primitives.c: reads the primitives of meshes (section 3.7.2). Each primitive becomes a mesh of the scene.
//
// The primitives of one glTF mesh may use different attributes and materials. The meshes made from these primitives
// share common arrays. If possible, the arrays point directly into the file's data, without a copy.
#include "gltf_meshes.h"

#include "gltf_data.h"
#include "gltf_json.h"
#include "gltf_materials.h"

#include "fail.h"

#include <stdio.h>

bool gltf_meshes_start(struct gltf *gltf)
{
    size_t count = gltf_list_size(gltf, "meshes");
    gltf->meshes = GLTF_ALLOC(gltf, count, struct gltf_mesh);
    return gltf->meshes || gltf_no_memory(gltf, count * sizeof *gltf->meshes);
}

// The types that an attribute may have (section 3.7.2.1, and KHR_mesh_quantization).
enum { FLOATS = 1, BYTES = 2, NORMALIZED = 4, UNSIGNED_NORMALIZED = 8 };

struct attribute_rule {
    const char *name;
    int min_width, max_width, types;
    const char *expected;
};

static const struct attribute_rule position_rule = {"POSITION", 3, 3, FLOATS | BYTES | NORMALIZED,
                                                    "VEC3 of FLOAT, or of BYTE to UNSIGNED_SHORT"},
                                   normal_rule = {"NORMAL", 3, 3, FLOATS | NORMALIZED,
                                                  "VEC3 of FLOAT, or of normalized BYTE or SHORT"},
                                   tangent_rule = {"TANGENT", 4, 4, FLOATS | NORMALIZED,
                                                   "VEC4 of FLOAT, or of normalized BYTE or SHORT"},
                                   color_rule = {"COLOR_0", 3, 4, FLOATS | UNSIGNED_NORMALIZED,
                                                 "VEC3 or VEC4 of FLOAT, or of normalized UNSIGNED_BYTE or "
                                                 "UNSIGNED_SHORT"};

static bool has_type(const struct gltf_accessor *a, int types)
{
    bool unsigned_type = a->component == GLTF_U8 || a->component == GLTF_U16;
    if (a->component == GLTF_F32)
        return types & FLOATS;
    if (a->component == GLTF_U32)
        return false;
    return a->normalized ? types & NORMALIZED || (types & UNSIGNED_NORMALIZED && unsigned_type) : types & BYTES;
}

// Gets the accessor of an attribute, which must have `count` elements (0 means any number). *out is NULL if the
// primitive does not have this attribute.
static bool take_attribute(struct gltf *gltf, const struct place *place, const json_t *attributes,
                           const struct attribute_rule *rule, size_t count, struct gltf_accessor **out)
{
    char words[64];
    const struct place *here = KEY_OF(place, rule->name);
    if (!gltf_take_accessor(gltf, place, attributes, rule->name, out))
        return false;
    struct gltf_accessor *a = *out;
    if (!a)
        return true;
    if (!(rule->types & BYTES) && a->component != GLTF_F32)
        a->normalized = true; // integers are never normals or colours; some exporters omit the mark
    if (a->width < rule->min_width || a->width > rule->max_width || a->type[0] != 'V' || !has_type(a, rule->types))
        return json_fail(&gltf->json, here, "found %s, expected %s", gltf_accessor_words(a, words), rule->expected);
    if (count && a->count != count)
        return json_fail(&gltf->json, here, "found %zu elements, expected %zu, one for each POSITION", a->count, count);
    return true;
}

static bool take_floats(struct gltf *gltf, const struct place *place, const json_t *attributes,
                        const struct attribute_rule *rule, size_t count, const float **out, uint32_t *out_count)
{
    struct gltf_accessor *accessor;
    bool needed = rule == &position_rule, ok = take_attribute(gltf, place, attributes, rule, count, &accessor);
    if (ok && !accessor)
        return true;
    int as_they_are = needed || rule == &normal_rule ? GLTF_AS_THEY_ARE : 0;
    *out = ok ? gltf_floats(gltf, KEY_OF(place, rule->name), accessor, GLTF_KEEP | as_they_are) : NULL;
    *out_count = *out ? (uint32_t)accessor->count : 0;
    return *out || (!needed && gltf_forgive(gltf));
}

static bool take_colors(struct gltf *gltf, const struct place *place, const json_t *attributes, bool opaque,
                        lam_mesh *mesh)
{
    struct gltf_accessor *accessor;
    struct gltf_colors colors;
    bool ok = take_attribute(gltf, place, attributes, &color_rule, mesh->vertex_count, &accessor);
    if (ok && !accessor)
        return true;
    if (!ok || !gltf_colors(gltf, KEY_OF(place, color_rule.name), accessor, opaque, &colors))
        return gltf_forgive(gltf);
    mesh->colors = colors.items;
    mesh->colors_format = colors.format;
    mesh->color_count = mesh->vertex_count;
    return true;
}

// Gets the set of texture coordinates that the material uses, or the file's first set if the material uses none.
static bool take_texcoords(struct gltf *gltf, const struct place *place, const json_t *attributes, int which,
                           lam_mesh *mesh)
{
    int set = gltf_texcoord_set(gltf, mesh->parts->material, which);
    char name[32];
    snprintf(name, sizeof name, "TEXCOORD_%d", set >= 0 ? set : 0);
    const struct attribute_rule rule = {name, 2, 2, FLOATS | BYTES | NORMALIZED,
                                        "VEC2 of FLOAT, or of BYTE to UNSIGNED_SHORT"};
    if (set < 0 && which == 1)
        return true;
    return take_floats(gltf, place, attributes, &rule, mesh->vertex_count,
                       which ? &mesh->second_texcoords : &mesh->texcoords,
                       which ? &mesh->second_texcoord_count : &mesh->texcoord_count);
}

static bool take_attributes(struct gltf *gltf, const struct place *place, const json_t *attributes, bool opaque,
                            lam_mesh *mesh)
{
    size_t count = mesh->vertex_count;
    if (!take_floats(gltf, place, attributes, &normal_rule, count, &mesh->normals, &mesh->normal_count) ||
        !take_texcoords(gltf, place, attributes, 0, mesh) || !take_texcoords(gltf, place, attributes, 1, mesh) ||
        !take_colors(gltf, place, attributes, opaque, mesh))
        return false;
    // Tangents without normals are ignored (section 3.7.2.1).
    return !mesh->normals ||
           take_floats(gltf, place, attributes, &tangent_rule, count, &mesh->tangents, &mesh->tangent_count);
}

// Adds one part with the primitive's material, or the parts that LAMBENT_faces lists.
static bool add_parts(struct gltf *gltf, const struct place *place, const json_t *primitive, lam_mesh *mesh)
{
    const json_t *own = gltf_extension(primitive, "LAMBENT_faces");
    const struct place *here = own ? KEY_OF(KEY_OF(KEY_OF(place, "extensions"), "LAMBENT_faces"), "parts") : place;
    size_t left = mesh_items(mesh), count = own ? json_array_size(json_object_get(own, "parts")) : 1;
    lam_part *parts = arena_array(&gltf->scene->arena, count, sizeof *parts);
    bool named = true;
    if (!parts)
        return gltf_no_memory(gltf, count * sizeof *parts);
    for (size_t i = 0; i < count; i++) {
        const json_t *part = own ? json_array_get(json_object_get(own, "parts"), i) : primitive;
        const char *name = own ? gltf_name(gltf, part, &named) : NULL;
        size_t size = left;
        if (own && !gltf_take_whole(gltf, ELEMENT_OF(here, i), part, "triangles", 0, (double)left, &size))
            return false;
        parts[i] = (lam_part){.name = name ? name : mesh->name,
                              .first_triangle = (uint32_t)(mesh_items(mesh) - left),
                              .triangle_count = (uint32_t)size};
        left -= size;
        if (!gltf_take_material(gltf, own ? ELEMENT_OF(here, i) : place, part, &parts[i].material))
            return false;
    }
    mesh->parts = parts;
    mesh->part_count = (uint32_t)count;
    return named && ((count && !left) || json_fail(&gltf->json, here, "found %zu triangles of no part", left));
}

// Reads LAMBENT_faces, in which the modules for exact shapes mark the edges of the shape (docs/internals/import.md), with
// a number for each triangle as in lam_mesh.inner_edges, and state the area and volume of the shape.
static bool take_faces(struct gltf *gltf, const struct place *place, const json_t *primitive, lam_mesh *mesh)
{
    struct gltf_accessor *accessor = NULL;
    const struct place *here = KEY_OF(KEY_OF(place, "extensions"), "LAMBENT_faces");
    const json_t *own = gltf_extension(primitive, "LAMBENT_faces");
    bool ok = gltf_take_accessor(gltf, here, own, "inner", &accessor);
    gltf_take_factors(gltf, here, own, "area", 1, 0, 1e300, &mesh->exact_area);
    gltf_take_factors(gltf, here, own, "volume", 1, 0, 1e300, &mesh->exact_volume);
    if (!accessor)
        return ok;
    const uint32_t *numbers = gltf_indices(gltf, KEY_OF(here, "inner"), accessor);
    uint8_t *inner = numbers ? arena_array(&gltf->scene->arena, accessor->count, 1) : NULL;
    if (!inner)
        return numbers && gltf_no_memory(gltf, accessor->count);
    if (accessor->count != mesh->triangle_count)
        return json_fail(&gltf->json, KEY_OF(here, "inner"), "found %zu elements, expected %u, one for each triangle",
                         accessor->count, mesh->triangle_count);
    for (size_t i = 0; i < accessor->count; i++)
        inner[i] = numbers[i] & 15;
    mesh->inner_edges = inner;
    return true;
}

static bool make_primitive(struct gltf *gltf, const struct place *place, const json_t *primitive, const char *name,
                           const struct gltf_deformation *deformation, struct gltf_primitive *out)
{
    lam_mesh mesh = {.name = name};
    size_t mode = GLTF_TRIANGLES;
    *out = (struct gltf_primitive){.mesh = -1};
    const json_t *attributes = gltf_take_object(gltf, place, primitive, "attributes");
    const struct place *here = KEY_OF(place, "attributes");
    if (!gltf_take_whole(gltf, place, primitive, "mode", 0, 6, &mode))
        gltf_forgive(gltf);
    const json_t *position = json_object_get(attributes, "POSITION");
    if (!position || json_is_null(position)) {
        gltf->without_positions += json_is_object(primitive); // gltf_take_list has noted other values
        return true;
    }
    if (!gltf_draco_decode(gltf, place, primitive, &mode))
        return false;
    if (!take_floats(gltf, here, attributes, &position_rule, 0, &mesh.positions, &mesh.vertex_count))
        return false;
    bool ok = mode < GLTF_TRIANGLES ? gltf_strokes(gltf, place, primitive, mode, &mesh)
                                    : gltf_triangles(gltf, place, primitive, mode, &mesh);
    if (!ok || !take_faces(gltf, place, primitive, &mesh) || !add_parts(gltf, place, primitive, &mesh) ||
        !take_attributes(gltf, here, attributes, gltf_material_is_opaque(gltf, mesh.parts->material), &mesh))
        return false;
    if (!mesh_items(&mesh))
        return true;
    if (!gltf_deform(gltf, place, primitive, deformation, &mesh, &out->skinned))
        return false;
    out->mesh = scene_adopt_mesh(gltf->scene, &mesh, gltf->json.error);
    return out->mesh >= 0;
}

static bool make_mesh(struct gltf *gltf, int index, struct gltf_deformation deformation, struct gltf_mesh *mesh)
{
    const struct place *place = ELEMENT_OF(KEY_OF(NULL, "meshes"), (size_t)index);
    const json_t *object = gltf_list_item(gltf, "meshes", index);
    double *weights = NULL;
    bool ok = true;
    if (!call_should_continue(gltf->source->call))
        return call_error(gltf->source->call, gltf->json.error);
    if (!deformation.weights && !gltf_take_weights(gltf, place, object, &weights, &deformation.weight_count))
        return false;
    deformation.weights = deformation.weights ? deformation.weights : weights;
    const json_t *primitives = gltf_take_list(gltf, place, object, "primitives");
    if (!json_array_size(primitives))
        gltf_note(gltf, KEY_OF(place, "primitives"), "expected at least one; drawn without this mesh");
    const char *name = gltf_name(gltf, object, &ok);
    mesh->count = (int)json_array_size(primitives);
    mesh->primitives = ok ? GLTF_ALLOC(gltf, mesh->count, struct gltf_primitive) : NULL;
    if (ok && !mesh->primitives)
        ok = gltf_no_memory(gltf, json_array_size(primitives) * sizeof *mesh->primitives);
    for (int i = 0; ok && i < mesh->count; i++)
        ok = make_primitive(gltf, ELEMENT_OF(KEY_OF(place, "primitives"), (size_t)i),
                            json_array_get(primitives, (size_t)i), name, &deformation, &mesh->primitives[i]) ||
             gltf_skip(gltf);
    mesh->ready = ok;
    return ok;
}

const struct gltf_mesh *gltf_mesh_at(struct gltf *gltf, int index)
{
    struct gltf_mesh *mesh = &gltf->meshes[index];
    return mesh->ready || make_mesh(gltf, index, (struct gltf_deformation){0}, mesh) ? mesh : NULL;
}

const struct gltf_mesh *gltf_mesh_deformed(struct gltf *gltf, int index, const struct gltf_node *node,
                                           const struct gltf_skin *skin)
{
    struct gltf_deformation deformation = {node->weights, node->weight_count, skin};
    struct gltf_mesh *mesh = GLTF_ALLOC(gltf, 1, struct gltf_mesh);
    if (!mesh)
        gltf_no_memory(gltf, sizeof *mesh);
    return mesh && make_mesh(gltf, index, deformation, mesh) ? mesh : NULL;
}
