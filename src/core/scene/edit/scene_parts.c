// scene_parts.c: makes an object of each part of a mesh. The new meshes share the arrays of the mesh.
#include "scene_internal.h"

#include "fail.h"
#include "float_state.h"

#include <string.h>

// Finds the smallest and the largest position index of a part.
static void find_range(const lam_mesh *mesh, size_t first, size_t count, uint32_t range[2])
{
    range[0] = UINT32_MAX;
    range[1] = 0;
    for (size_t i = first; i < first + count; i++) {
        const uint32_t at = mesh->indices ? mesh->indices[i] : (uint32_t)i;
        range[0] = at < range[0] ? at : range[0];
        range[1] = at > range[1] ? at : range[1];
    }
}

// Makes the values of an attribute begin at the part's first position, or its own indices at the part's first corner.
static const float *part_values(const float *values, uint32_t *count, const uint32_t **own, uint32_t width,
                                size_t first, uint32_t base)
{
    if (!values)
        return NULL;
    if (*own) {
        *own += first;
        return values;
    }
    *count -= base;
    return values + (size_t)width * base;
}

static bool part_mesh(lam_scene *scene, const lam_mesh *mesh, const lam_part *part, lam_mesh *out, lam_error *error)
{
    const size_t sides = mesh_corners(mesh) / mesh_items(mesh), first = part->first_triangle * sides,
                 count = part->triangle_count * sides;
    uint32_t range[2], *indices = NULL;
    find_range(mesh, first, count, range);
    *out = *mesh;
    out->exact_area = out->exact_volume = 0;
    if (mesh->indices) {
        out->indices = indices = arena_array(&scene->arena, count, sizeof *indices);
        for (size_t i = 0; indices && i < count; i++)
            indices[i] = mesh->indices[first + i] - range[0];
    }
    lam_part *own = arena_alloc(&scene->arena, sizeof *own);
    if (!own || (mesh->indices && !indices))
        return call_memory_error(scene->arena.call, count * sizeof *indices, error);
    *own = *part;
    own->first_triangle = 0;
    out->parts = own;
    out->part_count = 1;
    out->name = part->name;
    uint32_t *items = mesh->line_count    ? &out->line_count
                      : mesh->point_count ? &out->point_count
                                          : &out->triangle_count;
    *items = part->triangle_count;
    out->positions += 3 * (size_t)range[0];
    out->vertex_count = range[1] - range[0] + 1;
    out->normals = part_values(out->normals, &out->normal_count, &out->normal_indices, 3, first, range[0]);
    out->texcoords = part_values(out->texcoords, &out->texcoord_count, &out->texcoord_indices, 2, first, range[0]);
    out->second_texcoords = part_values(out->second_texcoords, &out->second_texcoord_count,
                                        &out->second_texcoord_indices, 2, first, range[0]);
    out->tangents = part_values(out->tangents, &out->tangent_count, &out->tangent_indices, 4, first, range[0]);
    const size_t size = mesh->colors_format == LAM_COLORS_LINEAR_F32 ? 16 : 4;
    const bool by_index = mesh->colors_rate != LAM_PER_TRIANGLE && mesh->color_indices;
    const uint32_t skipped = mesh->colors_rate == LAM_PER_TRIANGLE ? part->first_triangle : by_index ? 0 : range[0];
    if (mesh->colors) {
        out->colors = (const char *)mesh->colors + skipped * size;
        out->color_count -= skipped;
        out->color_indices = by_index ? mesh->color_indices + first : NULL;
    }
    if (mesh->smoothing_groups)
        out->smoothing_groups += part->first_triangle;
    if (mesh->inner_edges)
        out->inner_edges += part->first_triangle;
    return true;
}

static bool split_object(lam_scene *scene, lam_object object, lam_error *error)
{
    const lam_mesh mesh = *scene_mesh(scene, object.mesh);
    const char *name = object.name;
    for (uint32_t i = 0; i < mesh.part_count; i++) {
        lam_mesh part;
        if (!mesh.parts[i].triangle_count)
            continue;
        if (!part_mesh(scene, &mesh, &mesh.parts[i], &part, error) ||
            (object.mesh = scene_append(scene, &scene->meshes, &part, sizeof part, error)) < 0)
            return false;
        object.name = part.name && *part.name ? part.name : name;
        if (scene_append(scene, &scene->objects, &object, sizeof object, error) < 0)
            return false;
    }
    return true;
}

bool lam_scene_split_parts(lam_scene *scene, lam_error *error)
{
    if (!scene || scene->cut)
        return fail(error, LAM_BAD_ARGUMENT, scene ? "the scene has sections; remove them first" : "the scene is NULL");
    const struct scene_list before = scene->objects;
    scene->objects = (struct scene_list){0};
    uint64_t state = float_state_enter();
    bool ok = true;
    for (int i = 0; ok && i < before.count; i++) {
        const lam_object *object = (const lam_object *)before.items + i;
        ok = scene_mesh(scene, object->mesh)->part_count > 1
                 ? split_object(scene, *object, error)
                 : scene_append(scene, &scene->objects, object, sizeof *object, error) >= 0;
    }
    ok = ok && scene_measure(scene, NULL, error);
    float_state_leave(state);
    if (!ok) {
        scene->objects = before;
        scene->meshes.count = scene->extents.count;
    }
    return ok;
}
