// threemf_mesh.c: converts the triangles of an object to a mesh of the scene, with a part for each material.
#include "threemf.h"

#include "fail.h"
#include "shown_name.h"

#ifdef HAVE_3MF

#include <stdlib.h>
#include <string.h>

enum { WHITE, NEUTRAL }; // the indices of each part's first two colours
enum { PLAIN = -1 };     // material of triangles that have neither a base material nor a texture

// The material, colours and texture coordinates that a triangle's properties define.
struct surface {
    int material;
    uint32_t colors[3], texcoords[3];
    bool colored, textured; // whether the triangle has its own colours, and whether it has its own texture coordinates
};

struct mesh_maker {
    struct threemf *file;
    const struct threemf_part *part;
    const struct threemf_object *object;
    struct arena *scratch;
    int *materials;               // per triangle
    uint32_t *colors, *texcoords; // 3 per triangle
    bool colored, textured;
};

static bool fail_object(const struct mesh_maker *maker, const char *what, uint32_t number)
{
    char shown[SHOWN_NAME_SIZE];
    return fail(maker->file->error, LAM_CANNOT_READ,
                "%s: %s:%zu: object %d: found %s %u, expected one that the part has", maker->file->source->name,
                shown_name(maker->part->path, shown), maker->object->line, maker->object->id, what, number);
}

static bool is_group(const struct threemf_resource *resource)
{
    return resource && resource->kind != RESOURCE_OBJECT && resource->kind != RESOURCE_TEXTURE &&
           resource->kind != RESOURCE_DISPLAY;
}

static bool resolve(const struct mesh_maker *maker, const struct threemf_property *property, struct surface *out)
{
    const struct threemf_resource *group = threemf_resource_at(maker->part, property->group);
    *out = (struct surface){.material = PLAIN};
    if (!property->group || (group && group->faulty)) {
        out->colors[0] = out->colors[1] = out->colors[2] = NEUTRAL;
        return true;
    }
    if (!is_group(group))
        return fail_object(maker, "properties with the id", (uint32_t)property->group);
    for (int i = 0; i < 3; i++) {
        uint32_t index = property->index[i];
        if (index >= group->count)
            return fail_object(maker, "the property", index);
        if (group->kind == RESOURCE_COLORS) {
            out->colors[i] = group->first + index;
        } else if (group->kind == RESOURCE_TEXCOORDS) {
            out->texcoords[i] = group->first + index;
        } else if (group->kind == RESOURCE_MULTI) {
            const struct threemf_pair *pair =
                (const struct threemf_pair *)maker->part->pairs.items + group->first + index;
            out->colors[i] = pair->color;
            out->texcoords[i] = pair->texcoord;
        }
    }
    out->material = group->kind == RESOURCE_BASE ? group->material + (int)property->index[0] : group->material;
    out->colored = group->kind == RESOURCE_COLORS || group->kind == RESOURCE_MULTI;
    out->textured = group->material >= 0 && (group->kind == RESOURCE_TEXCOORDS || group->kind == RESOURCE_MULTI);
    return true;
}

// Finds the surface of each triangle. If a triangle has the same properties as the previous triangle, the properties
// are not looked up again.
static bool resolve_all(struct mesh_maker *maker)
{
    const struct threemf_object *object = maker->object;
    const struct threemf_property whole = {object->group, {object->index, object->index, object->index}};
    const struct threemf_property *before = NULL;
    struct surface surface = {.material = PLAIN};
    for (uint32_t t = 0; t < object->triangle_count; t++) {
        const struct threemf_property *property = object->properties ? &object->properties[t] : &whole;
        if (t % 65536 == 0 && !call_should_continue(maker->file->source->call))
            return call_error(maker->file->source->call, maker->file->error);
        if ((!before || memcmp(before, property, sizeof *property) != 0) && !resolve(maker, property, &surface))
            return false;
        before = property;
        maker->materials[t] = surface.material;
        memcpy(maker->colors + 3 * (size_t)t, surface.colors, sizeof surface.colors);
        memcpy(maker->texcoords + 3 * (size_t)t, surface.texcoords, sizeof surface.texcoords);
        maker->colored |= surface.colored;
        maker->textured |= surface.textured;
    }
    return true;
}

static int by_number(const void *a, const void *b)
{
    uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return x < y ? -1 : x > y;
}

// Lists the triangles as (material + 1) · 2³² + index, sorted by material. Returns NULL if memory runs out.
static uint64_t *order_triangles(const struct mesh_maker *maker, size_t count, size_t *materials)
{
    uint64_t *order = arena_array(maker->scratch, count, sizeof *order);
    bool sorted = true;
    *materials = 1;
    for (size_t t = 0; order && t < count; t++) {
        order[t] = (uint64_t)(maker->materials[t] + 1) << 32 | t;
        sorted &= t == 0 || order[t] > order[t - 1];
    }
    if (order && !sorted)
        qsort(order, count, sizeof *order, by_number);
    for (size_t t = 1; order && t < count; t++)
        *materials += order[t] >> 32 != order[t - 1] >> 32;
    return order;
}

// Reorders a list of three numbers per triangle.
static bool move_triangles(const struct mesh_maker *maker, const uint64_t *order, size_t count, uint32_t *list)
{
    uint32_t *old = arena_array(maker->scratch, 3 * count, sizeof *old);
    if (!old)
        return threemf_no_memory(maker->file, 3 * count * sizeof *old);
    memcpy(old, list, 3 * count * sizeof *old);
    for (size_t t = 0; t < count; t++)
        memcpy(list + 3 * t, old + 3 * (uint32_t)order[t], 3 * sizeof *old);
    return true;
}

// Sorts the triangles by material, and lists the parts.
static bool sort_parts(const struct mesh_maker *maker, lam_mesh *mesh)
{
    size_t count = maker->object->triangle_count, materials;
    const uint64_t *order = order_triangles(maker, count, &materials);
    lam_part *parts = order ? arena_array(&maker->file->scene->arena, materials, sizeof *parts) : NULL;
    if (!parts)
        return threemf_no_memory(maker->file, count * sizeof *order + materials * sizeof *parts);
    mesh->parts = parts;
    mesh->part_count = (uint32_t)materials;
    for (size_t t = 0, part = 0; t < count; part++) {
        size_t first = t;
        while (t < count && order[t] >> 32 == order[first] >> 32)
            t++;
        parts[part] = (lam_part){.first_triangle = (uint32_t)first,
                                 .triangle_count = (uint32_t)(t - first),
                                 .material = (int32_t)(order[first] >> 32) - 1};
    }
    return materials == 1 || (move_triangles(maker, order, count, maker->object->indices) &&
                              move_triangles(maker, order, count, maker->colors) &&
                              move_triangles(maker, order, count, maker->texcoords));
}

static bool take_properties(struct mesh_maker *maker, lam_mesh *mesh)
{
    const struct threemf_part *part = maker->part;
    struct arena *arena = &maker->file->scene->arena;
    size_t count = maker->object->triangle_count;
    maker->materials = arena_array(maker->scratch, count, sizeof *maker->materials);
    maker->colors = arena_array(arena, 3 * count, sizeof *maker->colors);
    maker->texcoords = arena_array(arena, 3 * count, sizeof *maker->texcoords);
    if (!maker->materials || !maker->colors || !maker->texcoords)
        return threemf_no_memory(maker->file, count * 28);
    if (!resolve_all(maker) || !sort_parts(maker, mesh))
        return false;
    if (maker->colored) {
        mesh->colors = part->scene_colors;
        mesh->color_count = (uint32_t)part->colors.count;
        mesh->colors_format = LAM_COLORS_LINEAR_F32;
        mesh->color_indices = maker->colors;
    }
    if (maker->textured) {
        mesh->texcoords = part->scene_texcoords;
        mesh->texcoord_count = (uint32_t)part->texcoords.count;
        mesh->texcoord_indices = maker->texcoords;
    }
    return true;
}

bool threemf_mesh_make(struct threemf *file, struct threemf_part *part, struct threemf_object *object)
{
    if (object->made)
        return true;
    object->made = true;
    if (!object->triangle_count)
        return true;
    lam_mesh mesh = {.name = object->name,
                     .positions = object->positions,
                     .vertex_count = object->vertex_count,
                     .indices = object->indices,
                     .triangle_count = object->triangle_count};
    if (object->properties || object->group) {
        struct arena scratch;
        arena_start(&scratch, file->source->call);
        struct mesh_maker maker = {.file = file, .part = part, .object = object, .scratch = &scratch};
        bool ok = take_properties(&maker, &mesh);
        arena_free(&scratch);
        if (!ok)
            return false;
    }
    object->mesh = scene_adopt_mesh(file->scene, &mesh, file->error);
    return object->mesh >= 0;
}

#endif
