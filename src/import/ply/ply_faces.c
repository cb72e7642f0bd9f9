// ply_faces.c: triangulates the faces and the triangle strips of a PLY file.
#include "parallel_rows.h"
#include "fail.h"
#include "ply.h"
#include "triangulate.h"

#include <string.h>

enum { TRIANGLES_MAX = 1431655765 }; // (2³² − 1) ÷ 3: corners have 32-bit indices

static bool check_count(const struct import_source *source, uint64_t triangles, lam_error *error)
{
    if (triangles > TRIANGLES_MAX)
        return fail(error, LAM_LIMIT, "%s: %llu triangles, expected at most %d", source->name,
                    (unsigned long long)triangles, TRIANGLES_MAX);
    return call_check_triangles(source->call, source->name, triangles, "triangles", error);
}

struct polygons {
    const struct import_source *source;
    const struct ply_table *faces;
    const float *positions;
    uint32_t *first_triangles; // the first triangle of each chunk
    uint32_t *indices;
    uint32_t *face_of;    // the face of each triangle; NULL if not needed
    uint8_t *inner_edges; // same as lam_mesh.inner_edges; NULL if not needed
};

static uint32_t corners_of(const struct ply_table *faces, size_t face)
{
    return faces->starts[face + 1] - faces->starts[face];
}

static bool triangulate_chunk(void *user, size_t index, lam_error *error)
{
    const struct polygons *polygons = user;
    const struct ply_table *faces = polygons->faces;
    size_t first, last, triangle = polygons->first_triangles[index];
    parallel_rows_range(faces->count, index, &first, &last);
    struct triangulator triangulator;
    triangulator_start(&triangulator, polygons->source->call);
    bool done = true;
    for (size_t face = first; done && face < last; face++) {
        uint32_t count = corners_of(faces, face);
        if (count < 3)
            continue;
        const uint32_t *corners = faces->items + faces->starts[face];
        uint32_t *out = polygons->indices + 3 * triangle;
        if (count == 3)
            memcpy(out, corners, 3 * sizeof *out);
        else if ((done = triangulate(&triangulator, polygons->positions, corners, count, out))) {
            for (uint32_t i = 0; polygons->inner_edges && i < count - 2; i++)
                polygons->inner_edges[triangle + i] = triangulated_inner_edges(out + 3 * (size_t)i, count);
            for (uint32_t i = 0; i < 3 * (count - 2); i++)
                out[i] = corners[out[i]];
        }
        for (uint32_t i = 0; polygons->face_of && i < count - 2; i++)
            polygons->face_of[triangle + i] = (uint32_t)face;
        triangle += count - 2;
    }
    triangulator_stop(&triangulator);
    if (done)
        return true;
    if (!call_should_continue(polygons->source->call))
        return call_error(polygons->source->call, error);
    return call_memory_error(polygons->source->call, 0, error);
}

// Triangulates polygons of any size: sets mesh->indices and triangle_count, and face_of if `want_faces`.
static bool triangulate_polygons(struct polygons *polygons, bool want_faces, struct lam_scene *scene,
                                 struct arena *scratch, lam_mesh *mesh, lam_error *error)
{
    const struct import_source *source = polygons->source;
    const struct ply_table *faces = polygons->faces;
    size_t chunks = parallel_rows_count(faces->count), degenerate = 0;
    polygons->first_triangles = arena_array(scratch, chunks, sizeof *polygons->first_triangles);
    if (!polygons->first_triangles)
        return call_memory_error(source->call, chunks * sizeof *polygons->first_triangles, error);
    uint64_t triangles = 0;
    for (size_t face = 0; face < faces->count; face++) {
        if (face % PARALLEL_ROWS == 0)
            polygons->first_triangles[face / PARALLEL_ROWS] = (uint32_t)triangles;
        uint32_t count = corners_of(faces, face);
        degenerate += count < 3;
        triangles += count < 3 ? 0 : count - 2;
    }
    if (!check_count(source, triangles, error))
        return false;
    if (degenerate > 0)
        scene_warn(scene, "%s: %zu of %zu faces have fewer than three corners and are ignored", source->name,
                   degenerate, faces->count);
    polygons->indices = arena_array(&scene->arena, triangles, 3 * sizeof *polygons->indices);
    if (want_faces)
        polygons->face_of = arena_array(&scene->arena, triangles, sizeof *polygons->face_of);
    if (!polygons->indices || (want_faces && !polygons->face_of))
        return call_memory_error(source->call, triangles * 4 * sizeof *polygons->indices, error);
    if (source->params->polygon_edges && triangles > faces->count - degenerate) {
        polygons->inner_edges = arena_alloc_zeroed(&scene->arena, triangles);
        if (!polygons->inner_edges)
            return call_memory_error(source->call, triangles, error);
    }
    if (!parallel_rows_run(source, chunks, triangulate_chunk, polygons, error))
        return false;
    mesh->indices = polygons->indices;
    mesh->inner_edges = polygons->inner_edges;
    mesh->triangle_count = (uint32_t)triangles;
    return true;
}

// Uses the normals of the faces if the vertices have none: one normal per face, indexed by its corners.
static bool face_normals(const struct import_source *source, const struct ply_table *faces, const uint32_t *face_of,
                         struct lam_scene *scene, lam_mesh *mesh, lam_error *error)
{
    const float *normals = NULL;
    if (mesh->normals)
        return true;
    if (!ply_normals(source, faces, &scene->arena, &normals, error))
        return false;
    if (!normals)
        return true;
    uint32_t *indices = arena_array(&scene->arena, mesh->triangle_count, 3 * sizeof *indices);
    if (!indices)
        return call_memory_error(source->call, mesh->triangle_count * 3 * sizeof *indices, error);
    for (size_t t = 0; t < mesh->triangle_count; t++) {
        for (size_t c = 0; c < 3; c++)
            indices[3 * t + c] = face_of ? face_of[t] : (uint32_t)t;
    }
    mesh->normals = normals;
    mesh->normal_count = (uint32_t)faces->count;
    mesh->normal_indices = indices;
    return true;
}

// Uses the colours of the faces if the vertices have none: one colour per triangle.
static bool face_colors(const struct import_source *source, const struct ply_table *faces, const uint32_t *face_of,
                        struct lam_scene *scene, struct arena *scratch, lam_mesh *mesh, lam_error *error)
{
    const void *colors = NULL;
    lam_colors_format format = LAM_COLORS_NONE;
    if (mesh->colors)
        return true;
    if (!ply_colors(source, faces, face_of ? scratch : &scene->arena, &colors, &format, error))
        return false;
    if (!colors)
        return true;
    if (face_of) {
        size_t size = format == LAM_COLORS_LINEAR_F32 ? 4 * sizeof(float) : 4;
        uint8_t *repeated = arena_array(&scene->arena, mesh->triangle_count, size);
        if (!repeated)
            return call_memory_error(source->call, mesh->triangle_count * size, error);
        for (size_t t = 0; t < mesh->triangle_count; t++)
            memcpy(repeated + size * t, (const uint8_t *)colors + size * face_of[t], size);
        colors = repeated;
    }
    mesh->colors = colors;
    mesh->color_count = mesh->triangle_count;
    mesh->colors_format = format;
    mesh->colors_rate = LAM_PER_TRIANGLE;
    return true;
}

static bool load_faces(const struct import_source *source, const struct ply_table *faces, struct lam_scene *scene,
                       struct arena *scratch, lam_mesh *mesh, lam_error *error)
{
    struct polygons polygons = {.source = source, .faces = faces, .positions = mesh->positions};
    if (faces->starts) {
        bool own_normals = !mesh->normals && ply_find(faces->element, false, "nx") >= 0;
        bool own_colors = !mesh->colors && ply_find_colors(faces, (int[4]){0});
        if (!triangulate_polygons(&polygons, own_normals || own_colors, scene, scratch, mesh, error))
            return false;
    } else {
        if (!check_count(source, faces->count, error))
            return false;
        mesh->indices = faces->items;
        mesh->triangle_count = (uint32_t)faces->count;
    }
    return face_normals(source, faces, polygons.face_of, scene, mesh, error) &&
           face_colors(source, faces, polygons.face_of, scene, scratch, mesh, error);
}

bool ply_faces(const struct import_source *source, const struct ply_table *faces, struct lam_scene *scene,
               lam_mesh *mesh, lam_error *error)
{
    struct arena scratch;
    arena_start(&scratch, source->call);
    bool done = load_faces(source, faces, scene, &scratch, mesh, error);
    arena_free(&scratch);
    return done;
}

// Writes the triangles of a strip to `out` (may be NULL) and returns their number. Each item from the third on forms a
// triangle with the two items before it; the winding of every second triangle is reversed. Triangles with equal corners
// only connect parts of a strip and are skipped.
static size_t strip_triangles(const uint32_t *items, size_t count, uint32_t *out)
{
    size_t triangles = 0, length = 0; // items of the strip so far
    for (size_t i = 0; i < count; i++) {
        length = items[i] == PLY_RESTART ? 0 : length + 1;
        if (length < 3)
            continue;
        uint32_t a = items[i - 2], b = items[i - 1], c = items[i];
        if (a == b || b == c || a == c)
            continue;
        if (out) {
            bool turned = length % 2 == 0;
            out[3 * triangles] = turned ? b : a;
            out[3 * triangles + 1] = turned ? a : b;
            out[3 * triangles + 2] = c;
        }
        triangles++;
    }
    return triangles;
}

bool ply_strips(const struct import_source *source, const struct ply_table *strips, struct lam_scene *scene,
                lam_mesh *mesh, lam_error *error)
{
    uint64_t triangles = 0;
    for (size_t row = 0; row < strips->count; row++)
        triangles += strip_triangles(strips->items + strips->starts[row], corners_of(strips, row), NULL);
    if (!check_count(source, triangles, error))
        return false;
    uint32_t *indices = arena_array(&scene->arena, triangles, 3 * sizeof *indices), *out = indices;
    if (!indices)
        return call_memory_error(source->call, triangles * 3 * sizeof *indices, error);
    for (size_t row = 0; row < strips->count; row++)
        out += 3 * strip_triangles(strips->items + strips->starts[row], corners_of(strips, row), out);
    mesh->indices = indices;
    mesh->triangle_count = (uint32_t)triangles;
    return true;
}
