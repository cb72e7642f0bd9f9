// ply_edges.c: reads lines from the element `edge`, whose rows contain the vertices of both ends.
#include "fail.h"
#include "ply_load.h"
#include "shown_name.h"

static bool fail_end(const struct import_source *source, const struct ply_table *edges, size_t row, int property,
                     int64_t found, uint32_t vertices, lam_error *error)
{
    return fail(error, LAM_CANNOT_READ, "%s: %s %zu of %zu: found %lld as %s, expected a vertex from 0 to %u",
                source->name, edges->element->name, row + 1, edges->count, (long long)found,
                edges->element->properties[property].name, vertices - 1);
}

bool ply_edges(const struct import_source *source, const struct ply_table *edges, struct lam_scene *scene,
               lam_mesh *mesh, lam_error *error)
{
    static const char *const names[] = {"vertex1", "vertex2"};
    int ends[2];
    ply_find_all(edges, names, 2, ends); // ply.c has checked that both exist
    if (edges->count > UINT32_MAX / 2)
        return fail(error, LAM_LIMIT, "%s: the file has %zu edges, expected at most %u", source->name, edges->count,
                    UINT32_MAX / 2);
    uint32_t *indices = arena_array(&scene->arena, edges->count, 2 * sizeof *indices);
    if (!indices)
        return call_memory_error(source->call, edges->count * 2 * sizeof *indices, error);
    for (size_t row = 0; row < edges->count; row++)
        for (size_t i = 0; i < 2; i++) {
            const uint8_t *at = edges->rows + row * edges->stride + edges->offsets[ends[i]];
            int64_t vertex = ply_load_integer(at, edges->types[ends[i]], edges->swapped);
            if (vertex < 0 || vertex >= mesh->vertex_count)
                return fail_end(source, edges, row, ends[i], vertex, mesh->vertex_count, error);
            indices[2 * row + i] = (uint32_t)vertex;
        }
    mesh->indices = indices;
    mesh->line_count = (uint32_t)edges->count;
    if (mesh->colors)
        return true;
    if (!ply_colors(source, edges, &scene->arena, &mesh->colors, &mesh->colors_format, error))
        return false;
    mesh->color_count = mesh->colors ? mesh->line_count : 0;
    mesh->colors_rate = LAM_PER_TRIANGLE;
    return true;
}
