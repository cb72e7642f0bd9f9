// ply_faces.c: triangulates the faces and the triangle strips of a PLY file.
#include "fail.h"
#include "mesh_build.h"
#include "ply.h"

#include <string.h>

enum { TRIANGLES_MAX = 1431655765 }; // (2³² − 1) ÷ 3: corners have 32-bit indices

static bool check_count(const struct import_source *source, uint64_t triangles, lam_error *error)
{
    if (triangles > TRIANGLES_MAX)
        return fail(error, LAM_LIMIT, "%s: %llu triangles, expected at most %d", source->name,
                    (unsigned long long)triangles, TRIANGLES_MAX);
    return call_check_triangles(source->call, source->name, triangles, "triangles", error);
}

// Splits the polygons in place; their rows already reserve space for the triangles. Stores the face of each triangle in
// `face_of` unless `face_of` is NULL.
static bool split_polygons(const struct import_source *source, const struct ply_table *faces, struct lam_scene *scene,
                           struct arena *scratch, uint32_t *face_of, lam_mesh *mesh, lam_error *error)
{
    size_t rows = faces->rows.count, most = mesh->triangle_count / 2, count = 0, degenerate = 0;
    most = most < rows ? most : rows;
    struct mesh_polygon *polygons = arena_array(scratch, most, sizeof *polygons);
    if (!polygons)
        return call_memory_error(source->call, most * sizeof *polygons, error);
    for (uint32_t face = 0, first = 0, triangles; face < rows; face++, first += triangles) {
        triangles = faces->starts[face + 1] / 3 - first;
        degenerate += triangles == 0;
        if (triangles > 1)
            polygons[count++] = (struct mesh_polygon){first, triangles + 2};
        for (uint32_t t = 0; face_of && t < triangles; t++)
            face_of[first + t] = face;
    }
    if (degenerate > 0)
        scene_warn(scene, "%s: %zu of %zu faces have fewer than three corners and are ignored", source->name,
                   degenerate, rows);
    uint32_t *wedges = (uint32_t *)(uintptr_t)mesh->texcoord_indices;
    struct mesh_polygons split = {polygons, count, mesh->positions, {faces->items, wedges}, mesh->triangle_count};
    return mesh_triangulate(source, scene, &split, &mesh->inner_edges, error);
}

// Uses the normals of the faces if the vertices have no normals. The corners of a face refer to the face's normal by
// index.
static bool face_normals(const struct import_source *source, const struct ply_table *faces, const uint32_t *face_of,
                         struct lam_scene *scene, lam_mesh *mesh, lam_error *error)
{
    struct ply_attributes own;
    if (!ply_read_attributes(source, scene, faces, PLY_NORMALS, &scene->arena, &own, error))
        return false;
    if (!own.normals)
        return true;
    uint32_t *indices = arena_array(&scene->arena, mesh->triangle_count, 3 * sizeof *indices);
    if (!indices)
        return call_memory_error(source->call, mesh->triangle_count * 3 * sizeof *indices, error);
    for (size_t t = 0; t < mesh->triangle_count; t++) {
        for (size_t c = 0; c < 3; c++)
            indices[3 * t + c] = face_of ? face_of[t] : (uint32_t)t;
    }
    mesh->normals = own.normals;
    mesh->normal_count = (uint32_t)faces->rows.count;
    mesh->normal_indices = indices;
    return true;
}

// Uses the colours of the faces if the vertices have no colours: one colour per triangle.
static bool face_colors(const struct import_source *source, const struct ply_table *faces, const uint32_t *face_of,
                        struct lam_scene *scene, struct arena *scratch, lam_mesh *mesh, lam_error *error)
{
    struct ply_attributes own;
    if (!ply_read_attributes(source, scene, faces, PLY_COLORS, face_of ? scratch : &scene->arena, &own, error))
        return false;
    if (!own.colors)
        return true;
    if (face_of) {
        size_t size = own.colors_format == LAM_COLORS_LINEAR_F32 ? 4 * sizeof(float) : 4;
        uint8_t *repeated = arena_array(&scene->arena, mesh->triangle_count, size);
        if (!repeated)
            return call_memory_error(source->call, mesh->triangle_count * size, error);
        for (size_t t = 0; t < mesh->triangle_count; t++)
            memcpy(repeated + size * t, (const uint8_t *)own.colors + size * face_of[t], size);
        own.colors = repeated;
    }
    mesh->colors = own.colors;
    mesh->color_count = mesh->triangle_count;
    mesh->colors_format = own.colors_format;
    mesh->colors_rate = LAM_PER_TRIANGLE;
    return true;
}

// Uses the texture coordinates of the corners of faces, in the order of faces->items.
static bool wedge_texcoords(const struct import_source *source, const struct ply_table *faces, struct lam_scene *scene,
                            lam_mesh *mesh, lam_error *error)
{
    size_t corners = 3 * (size_t)mesh->triangle_count;
    uint32_t *indices = arena_array(&scene->arena, corners, sizeof *indices);
    if (!indices)
        return call_memory_error(source->call, corners * sizeof *indices, error);
    for (size_t i = 0; i < corners; i++)
        indices[i] = (uint32_t)i;
    if (faces->odd_wedges)
        scene_warn(scene,
                   "%s: %zu of %zu faces have lists of texture coordinates of another length than two numbers for each "
                   "corner; missing numbers are 0",
                   source->name, faces->odd_wedges, faces->rows.count);
    ply_clear_texcoords(scene, source->name, faces->wedges, corners);
    mesh->texcoords = faces->wedges;
    mesh->texcoord_count = (uint32_t)corners;
    mesh->texcoord_indices = indices;
    return true;
}

// Makes a part of each sequence of triangles with the same texture. Other numbers mean no texture.
static bool texture_parts(const struct import_source *source, const struct ply_table *faces, const uint32_t *face_of,
                          int textures, struct lam_scene *scene, struct arena *scratch, lam_mesh *mesh,
                          lam_error *error)
{
    struct ply_attributes own;
    struct scene_list parts = {0};
    if (!ply_read_attributes(source, scene, faces, PLY_TEXNUMBERS, scratch, &own, error))
        return false;
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        float number = own.texnumbers[face_of ? face_of[t] : t];
        int material = number >= 0 && number < (float)textures ? (int)number : -1;
        lam_part *last = parts.count ? (lam_part *)parts.items + parts.count - 1 : NULL,
                 part = {.first_triangle = t, .triangle_count = 1, .material = material};
        if (last && last->material == material)
            last->triangle_count++;
        else if (!scene_list_append(&parts, &part, sizeof part, &scene->arena))
            return call_memory_error(source->call, (size_t)parts.count * sizeof part, error);
    }
    mesh->parts = parts.items;
    mesh->part_count = (uint32_t)parts.count;
    return true;
}

static bool load_faces(const struct import_source *source, const struct ply_table *faces, int textures,
                       struct lam_scene *scene, struct arena *scratch, lam_mesh *mesh, lam_error *error)
{
    size_t count = faces->rows.count;
    uint64_t triangles = faces->starts ? faces->starts[count] / 3 : count;
    bool own_normals = !mesh->normals && ply_find(faces->element, false, "nx") >= 0;
    bool own_colors = !mesh->colors && ply_find_colors(faces, (int[4]){0});
    bool own_textures = textures > 0 && ply_find(faces->element, false, "texnumber") >= 0;
    uint32_t *face_of = NULL;
    if (!check_count(source, triangles, error))
        return false;
    mesh->indices = faces->items;
    mesh->triangle_count = (uint32_t)triangles;
    if (faces->starts && (own_normals || own_colors || own_textures)) {
        face_of = arena_array(scratch, triangles, sizeof *face_of);
        if (!face_of)
            return call_memory_error(source->call, triangles * sizeof *face_of, error);
    }
    return (!faces->wedges || wedge_texcoords(source, faces, scene, mesh, error)) &&
           (!faces->starts || split_polygons(source, faces, scene, scratch, face_of, mesh, error)) &&
           (!own_normals || face_normals(source, faces, face_of, scene, mesh, error)) &&
           (!own_colors || face_colors(source, faces, face_of, scene, scratch, mesh, error)) &&
           (!own_textures || texture_parts(source, faces, face_of, textures, scene, scratch, mesh, error));
}

bool ply_faces(const struct import_source *source, const struct ply_table *faces, int textures, struct lam_scene *scene,
               lam_mesh *mesh, lam_error *error)
{
    struct arena scratch;
    arena_start(&scratch, source->call);
    bool done = load_faces(source, faces, textures, scene, &scratch, mesh, error);
    arena_free(&scratch);
    return done;
}

// Writes the triangles of a row's strip to `out` (may be NULL) and returns the number of triangles. Each item from the
// third on forms a triangle with the two items before it; the winding of every second triangle is reversed. Triangles
// with equal corners only connect parts of a strip and are skipped.
static size_t strip_triangles(const struct ply_table *strips, size_t row, uint32_t *out)
{
    const uint32_t *items = strips->items + strips->starts[row], room = strips->starts[row + 1] - strips->starts[row];
    size_t triangles = 0, length = 0; // items of the strip so far
    for (size_t i = 0; room > 0 && i < room / 3 + 2; i++) {
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
    for (size_t row = 0; row < strips->rows.count; row++)
        triangles += strip_triangles(strips, row, NULL);
    if (!check_count(source, triangles, error))
        return false;
    uint32_t *indices = arena_array(&scene->arena, triangles, 3 * sizeof *indices), *out = indices;
    if (!indices)
        return call_memory_error(source->call, triangles * 3 * sizeof *indices, error);
    for (size_t row = 0; row < strips->rows.count; row++)
        out += 3 * strip_triangles(strips, row, out);
    mesh->indices = indices;
    mesh->triangle_count = (uint32_t)triangles;
    return true;
}
