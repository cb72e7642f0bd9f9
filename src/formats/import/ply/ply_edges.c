// ply_edges.c: reads lines from the element `edge`, whose rows contain the indices of both end vertices.
#include "fail.h"
#include "ply_load.h"
#include "shown_name.h"

struct edges {
    const struct import_source *source;
    const struct ply_table *table;
    int ends[2]; // the properties vertex1 and vertex2
    uint32_t vertices;
    uint32_t *indices;
};

static bool read_chunk(void *user, size_t index, const uint8_t *at, lam_error *error)
{
    const struct edges *edges = user;
    const struct ply_table *table = edges->table;
    size_t first, last;
    parallel_rows_range(table->rows.count, index, &first, &last);
    for (size_t row = first; row < last; row++, at += table->rows.stride)
        for (size_t i = 0; i < 2; i++) {
            int end = edges->ends[i];
            int64_t vertex = ply_load_integer(at + table->offsets[end], table->types[end], table->swapped);
            if (vertex < 0 || vertex >= edges->vertices)
                return fail(error, LAM_CANNOT_READ,
                            "%s: %s %zu of %zu: found %lld as %s, expected a vertex from 0 to %u", edges->source->name,
                            table->element->name, row + 1, table->rows.count, (long long)vertex,
                            table->element->properties[end].name, edges->vertices - 1);
            edges->indices[2 * row + i] = (uint32_t)vertex;
        }
    return true;
}

bool ply_edges(const struct import_source *source, const struct ply_table *table, struct lam_scene *scene,
               lam_mesh *mesh, lam_error *error)
{
    static const char *const names[] = {"vertex1", "vertex2"};
    size_t count = table->rows.count;
    struct edges edges = {.source = source, .table = table, .vertices = mesh->vertex_count};
    struct ply_attributes own;
    ply_find_all(table, names, 2, edges.ends); // ply.c has checked that both exist
    if (count > UINT32_MAX / 2)
        return fail(error, LAM_LIMIT, "%s: the file has %zu edges, expected at most %u", source->name, count,
                    UINT32_MAX / 2);
    edges.indices = arena_array(&scene->arena, count, 2 * sizeof *edges.indices);
    if (!edges.indices)
        return call_memory_error(source->call, count * 2 * sizeof *edges.indices, error);
    if (!parallel_rows_read(source, &table->rows, read_chunk, &edges, error) ||
        !ply_read_attributes(source, scene, table, mesh->colors ? 0 : PLY_COLORS, &scene->arena, &own, error))
        return false;
    mesh->indices = edges.indices;
    mesh->line_count = (uint32_t)count;
    if (!own.colors)
        return true;
    mesh->colors = own.colors;
    mesh->color_count = mesh->line_count;
    mesh->colors_format = own.colors_format;
    mesh->colors_rate = LAM_PER_TRIANGLE;
    return true;
}
