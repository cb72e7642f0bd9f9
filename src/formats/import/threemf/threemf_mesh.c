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
    uint32_t filament; // of the object
};

static bool is_group(const struct threemf_resource *resource)
{
    return resource && resource->kind != RESOURCE_OBJECT && resource->kind != RESOURCE_TEXTURE &&
           resource->kind != RESOURCE_DISPLAY;
}

// A triangle without standard properties has the colour of a filament if the file names filaments.
static void resolve_plain(const struct mesh_maker *maker, uint32_t filament, struct surface *out)
{
    *out = (struct surface){.material = threemf_filament_material(maker->file, filament ? filament : maker->filament)};
    for (int i = 0; i < 3 && out->material < 0; i++)
        out->colors[i] = NEUTRAL;
}

static void resolve(const struct mesh_maker *maker, const struct threemf_property *property, struct surface *out)
{
    struct threemf *file = maker->file;
    const struct threemf_resource *group = threemf_resource_at(maker->part, property->group);
    bool plain = property->group == FILAMENT, known = is_group(group);
    int corner = 0; // the first with an unknown property
    while (known && corner < 3 && property->index[corner] < group->count)
        corner++;
    known = known && corner == 3;
    if (plain || !known || group->faulty) {
        char shown[SHOWN_NAME_SIZE];
        if (!plain && !known && !(group && group->faulty) && !file->unknown) {
            scene_warn(file->scene,
                       "%s: %s:%zu: object %d: found an unknown property (pid=\"%d\", p%d=\"%u\"); drawn without such "
                       "properties",
                       file->source->name, shown_name(maker->part->path, shown), maker->object->line, maker->object->id,
                       property->group, corner + 1, property->index[corner]);
            file->unknown = true;
        }
        resolve_plain(maker, plain ? property->index[0] : 0, out);
        return;
    }
    *out = (struct surface){.material = PLAIN};
    for (int i = 0; i < 3; i++) {
        uint32_t index = property->index[i];
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
        if (!before || memcmp(before, property, sizeof *property) != 0)
            resolve(maker, property, &surface);
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

// Copies a list of three numbers per triangle to the scene's arena in a new order. Other meshes of the object may use
// the old list.
static bool move_triangles(const struct mesh_maker *maker, const uint64_t *order, size_t count, const uint32_t **list)
{
    uint32_t *moved = arena_array(&maker->file->scene->arena, 3 * count, sizeof *moved);
    if (!moved)
        return threemf_no_memory(maker->file, 3 * count * sizeof *moved);
    for (size_t t = 0; t < count; t++)
        memcpy(moved + 3 * t, *list + 3 * (uint32_t)order[t], 3 * sizeof *moved);
    *list = moved;
    return true;
}

// Sorts the triangles by material, lists the parts, and copies the lists that the mesh keeps.
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
    return (materials == 1 || move_triangles(maker, order, count, &mesh->indices)) &&
           (!maker->colored || move_triangles(maker, order, count, &mesh->color_indices)) &&
           (!maker->textured || move_triangles(maker, order, count, &mesh->texcoord_indices));
}

static bool take_properties(struct mesh_maker *maker, lam_mesh *mesh)
{
    const struct threemf_part *part = maker->part;
    size_t count = maker->object->triangle_count;
    maker->materials = arena_array(maker->scratch, count, sizeof *maker->materials);
    maker->colors = arena_array(maker->scratch, 3 * count, sizeof *maker->colors);
    maker->texcoords = arena_array(maker->scratch, 3 * count, sizeof *maker->texcoords);
    if (!maker->materials || !maker->colors || !maker->texcoords)
        return threemf_no_memory(maker->file, count * 28);
    if (!resolve_all(maker))
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
    return sort_parts(maker, mesh);
}

bool threemf_mesh_make(struct threemf *file, struct threemf_part *part, struct threemf_object *object,
                       uint32_t extruder, int *out)
{
    uint32_t filament = threemf_filament(file, extruder);
    *out = -1;
    if (!object->triangle_count)
        return true;
    if (!object->meshes)
        object->meshes = arena_alloc_zeroed(file->scratch, (file->filaments.count + 1) * sizeof *object->meshes);
    if (!object->meshes)
        return threemf_no_memory(file, file->filaments.count * sizeof *object->meshes);
    if ((*out = object->meshes[filament] - 1) >= 0)
        return true;
    lam_mesh mesh = {.name = object->name,
                     .positions = object->positions,
                     .vertex_count = object->vertex_count,
                     .indices = object->indices,
                     .triangle_count = object->triangle_count};
    if (object->properties || object->group || filament) {
        struct arena scratch;
        arena_start(&scratch, file->source->call);
        struct mesh_maker maker = {
            .file = file, .part = part, .object = object, .scratch = &scratch, .filament = filament};
        bool ok = take_properties(&maker, &mesh);
        arena_free(&scratch);
        if (!ok)
            return false;
    }
    *out = scene_adopt_mesh(file->scene, &mesh, file->error);
    object->meshes[filament] = *out + 1;
    return *out >= 0;
}

#endif
