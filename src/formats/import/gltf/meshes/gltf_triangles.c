// gltf_triangles.c: converts triangles, strips and fans to triangles, and lines, loops and strips to lines (section
// 3.7.2.1).
#include "gltf_meshes.h"

#include "gltf_data.h"
#include "gltf_json.h"

#include "fail.h"

static bool fail_index(struct gltf *gltf, const struct place *place, const struct gltf_accessor *accessor,
                       uint32_t vertex_count)
{
    size_t i = 0;
    while (accessor->indices[i] < vertex_count)
        i++;
    return json_fail(&gltf->json, place, "number %zu is %u, expected less than %u, the number of vertices", i,
                     accessor->indices[i], vertex_count);
}

// Gets the primitive's indices. Sets *indices to NULL if the primitive has none and uses all vertices in order.
static bool gltf_corners(struct gltf *gltf, const struct place *place, const json_t *primitive, uint32_t vertex_count,
                         const uint32_t **indices, size_t *count)
{
    struct gltf_accessor *accessor;
    const struct place *here = KEY_OF(place, "indices");
    *indices = NULL;
    *count = vertex_count;
    if (!gltf_take_accessor(gltf, place, primitive, "indices", &accessor))
        return false;
    if (!accessor)
        return true;
    *indices = gltf_indices(gltf, here, accessor);
    *count = accessor->count;
    if (!*indices)
        return false;
    uint32_t restart = accessor->component == GLTF_U8 ? UINT8_MAX : UINT16_MAX;
    if (accessor->max_index < vertex_count && accessor->max_index == restart && accessor->component != GLTF_U32)
        gltf_note(gltf, here, "found %u, the greatest index of its type, which glTF does not allow (primitive restart)",
                  restart);
    return accessor->max_index < vertex_count || fail_index(gltf, here, accessor, vertex_count);
}

// Gets the corners of triangle i, in the order of the specification.
static void corners_of(size_t mode, size_t i, size_t corner[3])
{
    bool strip = mode == GLTF_TRIANGLE_STRIP;
    corner[0] = strip ? i : i + 1;
    corner[1] = strip ? i + 1 + i % 2 : i + 2;
    corner[2] = strip ? i + 2 - i % 2 : 0;
}

static bool unroll(struct gltf *gltf, size_t mode, const uint32_t *indices, size_t count, lam_mesh *mesh)
{
    size_t triangles = count < 3 ? 0 : count - 2;
    uint32_t *out = arena_array(&gltf->scene->arena, triangles, 3 * sizeof *out), *at = out;
    if (!out)
        return gltf_no_memory(gltf, triangles * 3 * sizeof *out);
    for (size_t i = 0; i < triangles; i++) {
        size_t corner[3];
        corners_of(mode, i, corner);
        for (int c = 0; c < 3; c++)
            at[c] = indices ? indices[corner[c]] : (uint32_t)corner[c];
        if (at[0] != at[1] && at[1] != at[2] && at[2] != at[0])
            at += 3;
    }
    mesh->indices = out;
    mesh->triangle_count = (uint32_t)((at - out) / 3);
    return true;
}

bool gltf_triangles(struct gltf *gltf, const struct place *place, const json_t *primitive, size_t mode, lam_mesh *mesh)
{
    const uint32_t *indices;
    size_t count;
    if (!gltf_corners(gltf, place, primitive, mesh->vertex_count, &indices, &count))
        return false;
    size_t triangles = mode == GLTF_TRIANGLES ? count / 3 : count < 3 ? 0 : count - 2;
    if (triangles > UINT32_MAX / 3)
        return fail(gltf->json.error, LAM_LIMIT, "%s: a primitive of %zu triangles, expected at most %u",
                    gltf->source->name, triangles, UINT32_MAX / 3);
    if (!call_check_triangles(gltf->source->call, gltf->source->name, triangles, "triangles", gltf->json.error))
        return false;
    if (mode != GLTF_TRIANGLES)
        return unroll(gltf, mode, indices, count, mesh);
    mesh->indices = indices;
    mesh->triangle_count = (uint32_t)triangles;
    if (count % 3)
        gltf_note(gltf, place, "the last %zu of %zu corners make no triangle", count % 3, count);
    return true;
}

// Writes the lines of a strip or loop of `count` corners as pairs of corners.
static bool unroll_lines(struct gltf *gltf, const uint32_t *indices, size_t count, size_t lines, lam_mesh *mesh)
{
    uint32_t *out = arena_array(&gltf->scene->arena, lines, 2 * sizeof *out);
    if (!out)
        return gltf_no_memory(gltf, lines * 2 * sizeof *out);
    for (size_t i = 0; i < 2 * lines; i++) {
        size_t corner = (i / 2 + i % 2) % count;
        out[i] = indices ? indices[corner] : (uint32_t)corner;
    }
    mesh->indices = out;
    mesh->line_count = (uint32_t)lines;
    return true;
}

bool gltf_strokes(struct gltf *gltf, const struct place *place, const json_t *primitive, size_t mode, lam_mesh *mesh)
{
    const uint32_t *indices;
    size_t count;
    if (!gltf_corners(gltf, place, primitive, mesh->vertex_count, &indices, &count))
        return false;
    size_t lines = mode == GLTF_LINES ? count / 2 : count < 2 ? 0 : mode == GLTF_LINE_LOOP ? count : count - 1;
    if (count > UINT32_MAX / 2)
        return fail(gltf->json.error, LAM_LIMIT, "%s: a primitive of %zu points or ends of lines, expected at most %u",
                    gltf->source->name, count, UINT32_MAX / 2);
    if (mode == GLTF_LINE_LOOP || mode == GLTF_LINE_STRIP)
        return unroll_lines(gltf, indices, count, lines, mesh);
    mesh->indices = indices;
    mesh->point_count = mode == GLTF_POINTS ? (uint32_t)count : 0;
    mesh->line_count = mode == GLTF_LINES ? (uint32_t)lines : 0;
    if (mode == GLTF_LINES && count % 2)
        gltf_note(gltf, place, "the last of %zu corners makes no line", count);
    return true;
}
