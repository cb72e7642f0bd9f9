// flatten.c: merges a scene into at most three meshes in world space, for formats without objects: triangles, lines and
// points.
#include "export.h"

#include "fail.h"
#include "linear.h"

#include <string.h>

// The sizes and arrays of a flat mesh that is being built.
struct flat {
    struct exporting *e;
    enum export_kind kind;
    size_t vertices, normals, texcoords, colors, corners, parts;
    bool has_normals, has_texcoords, has_colors;
    float *position, *normal, *texcoord, *color;
    uint32_t *index, *normal_index, *texcoord_index, *color_index;
    lam_part *part;
};

static enum export_kind kind_of(const lam_mesh *m)
{
    return m->line_count ? EXPORT_LINES : m->point_count ? EXPORT_POINTS : EXPORT_TRIANGLES;
}

static void count_mesh(struct flat *f, const lam_mesh *m)
{
    f->vertices += m->vertex_count;
    f->normals += m->normals ? m->normal_count : 0;
    f->texcoords += m->texcoords ? m->texcoord_count : 0;
    f->colors += m->colors ? m->color_count : 0;
    f->corners += mesh_corners(m);
    f->parts += m->parts ? m->part_count : 1;
    f->has_normals |= m->normals != NULL;
    f->has_texcoords |= m->texcoords != NULL;
    f->has_colors |= m->colors != NULL;
    if (m->tangents && strcmp(f->e->scene->format, "gltf") == 0)
        export_lose(f->e, "tangents are omitted: readers compute them");
    if (m->second_texcoords)
        export_lose(f->e, "a second set of texture coordinates is omitted: the format supports one");
}

static bool make_arrays(struct flat *f)
{
    struct arena *arena = f->e->arena;
    f->position = arena_array(arena, 3 * f->vertices, sizeof(float));
    f->normal = arena_array(arena, 3 * (f->normals + 1), sizeof(float));
    f->texcoord = arena_array(arena, 2 * (f->texcoords + 1), sizeof(float));
    f->color = arena_array(arena, 4 * (f->colors + 1), sizeof(float));
    f->index = arena_array(arena, f->corners, sizeof(uint32_t));
    f->normal_index = arena_array(arena, f->corners, sizeof(uint32_t));
    f->texcoord_index = arena_array(arena, f->corners, sizeof(uint32_t));
    f->color_index = arena_array(arena, f->corners, sizeof(uint32_t));
    f->part = arena_array(arena, f->parts, sizeof *f->part);
    return (f->position && f->normal && f->texcoord && f->color && f->index && f->normal_index && f->texcoord_index &&
            f->color_index && f->part) ||
           export_no_memory(f->e, f->vertices * 12 + f->corners * 28);
}

// Coordinates far from zero are stored relative to the origin of the first object's mesh.
static void put_positions(struct flat *f, const lam_mesh *m, const lam_mat4 *transform, const double origin[3])
{
    bool same = mat4_is_identity(transform) && memcmp(origin, m->origin, 3 * sizeof *origin) == 0;
    float *to = f->position + 3 * f->vertices;
    if (same) {
        memcpy(to, m->positions, 3 * (size_t)m->vertex_count * sizeof *to);
        return;
    }
    export_lose(f->e, "the objects' transforms are applied to the coordinates, which are then rounded to floats");
    for (size_t i = 0; i < m->vertex_count && export_continues(f->e, i); i++) {
        const float *p = m->positions + 3 * i;
        lam_vec3 world = mat4_point(
            transform, v3((double)p[0] + m->origin[0], (double)p[1] + m->origin[1], (double)p[2] + m->origin[2]));
        to[3 * i] = (float)(world.x - origin[0]);
        to[3 * i + 1] = (float)(world.y - origin[1]);
        to[3 * i + 2] = (float)(world.z - origin[2]);
    }
}

static void put_normals(struct flat *f, const lam_mesh *m, const lam_mat4 *transform)
{
    double matrix[3][3];
    float *to = f->normal + 3 * f->normals;
    mat4_normal_matrix(transform, matrix);
    if (mat4_is_identity(transform)) {
        memcpy(to, m->normals, 3 * (size_t)m->normal_count * sizeof *to);
        return;
    }
    for (size_t i = 0; i < m->normal_count && export_continues(f->e, i); i++) {
        const float *n = m->normals + 3 * i;
        double v[3];
        for (int k = 0; k < 3; k++)
            v[k] = matrix[k][0] * (double)n[0] + matrix[k][1] * (double)n[1] + matrix[k][2] * (double)n[2];
        lam_vec3 unit = v3_unit(v3(v[0], v[1], v[2]));
        to[3 * i] = (float)unit.x;
        to[3 * i + 1] = (float)unit.y;
        to[3 * i + 2] = (float)unit.z;
    }
}

// A mirroring transform reverses the winding of triangles, so two of their corners are swapped to keep the front side.
static size_t source_corner(const struct flat *f, size_t corner, bool mirrored)
{
    static const size_t swapped[3] = {0, 2, 1};
    return mirrored && f->kind == EXPORT_TRIANGLES ? corner - corner % 3 + swapped[corner % 3] : corner;
}

static void put_corners(struct flat *f, const lam_mesh *m, bool mirrored)
{
    for (size_t i = 0; i < mesh_corners(m) && export_continues(f->e, i); i++) {
        size_t c = source_corner(f, i, mirrored), to = f->corners + i;
        f->index[to] = (uint32_t)f->vertices + mesh_element(NULL, m, c);
        // UINT32_MAX marks a missing attribute; put_missing replaces this index.
        f->normal_index[to] = m->normals ? (uint32_t)f->normals + mesh_element(m->normal_indices, m, c) : UINT32_MAX;
        f->texcoord_index[to] =
            m->texcoords ? (uint32_t)f->texcoords + mesh_element(m->texcoord_indices, m, c) : UINT32_MAX;
        f->color_index[to] = m->colors ? (uint32_t)f->colors + export_color_element(m, c) : UINT32_MAX;
    }
}

static void put_parts(struct flat *f, const lam_mesh *m, const lam_object *object)
{
    size_t corners = f->kind == EXPORT_TRIANGLES ? 3 : f->kind == EXPORT_LINES ? 2 : 1;
    lam_part whole = {.triangle_count = mesh_items(m), .material = -1};
    for (uint32_t i = 0; i < (m->parts ? m->part_count : 1); i++) {
        lam_part part = m->parts ? m->parts[i] : whole;
        part.first_triangle += (uint32_t)(f->corners / corners);
        part.material = object->material >= 0 ? object->material : part.material;
        part.name = part.name ? part.name : object->name ? object->name : m->name;
        f->part[f->parts++] = part;
    }
}

static void put_object(struct flat *f, const lam_mesh *m, const lam_object *object, const double origin[3])
{
    put_positions(f, m, &object->transform, origin);
    if (m->normals)
        put_normals(f, m, &object->transform);
    if (m->texcoords)
        memcpy(f->texcoord + 2 * f->texcoords, m->texcoords, 2 * (size_t)m->texcoord_count * sizeof(float));
    for (size_t i = 0; m->colors && i < m->color_count && export_continues(f->e, i); i++)
        export_color(m, i, f->color + 4 * (f->colors + i));
    put_parts(f, m, object);
    put_corners(f, m, mat4_determinant3(&object->transform) < 0);
    f->vertices += m->vertex_count;
    f->normals += m->normals ? m->normal_count : 0;
    f->texcoords += m->texcoords ? m->texcoord_count : 0;
    f->colors += m->colors ? m->color_count : 0;
    f->corners += mesh_corners(m);
}

// Appends one default element to the attribute's array if some meshes lack the attribute. The corners of these meshes
// use the default element.
static void put_missing(struct flat *f, size_t corners)
{
    bool normals = false, texcoords = false;
    for (size_t i = 0; i < corners && export_continues(f->e, i); i++) {
        normals |= f->normal_index[i] == UINT32_MAX;
        texcoords |= f->texcoord_index[i] == UINT32_MAX;
        if (f->normal_index[i] == UINT32_MAX)
            f->normal_index[i] = (uint32_t)f->normals;
        if (f->texcoord_index[i] == UINT32_MAX)
            f->texcoord_index[i] = (uint32_t)f->texcoords;
        if (f->color_index[i] == UINT32_MAX)
            f->color_index[i] = (uint32_t)f->colors;
    }
    for (size_t i = 0; i < 4; i++)
        f->color[4 * f->colors + i] = 1;
    memset(f->normal + 3 * f->normals, 0, 3 * sizeof(float));
    memset(f->texcoord + 2 * f->texcoords, 0, 2 * sizeof(float));
    f->normals += normals;
    f->texcoords += texcoords;
}

static void lose_sides(struct exporting *e, const lam_object *object)
{
    if (object->back_material >= 0)
        export_lose(e, "materials of back faces are omitted: the format does not support them");
    if (object->one_sided)
        export_lose(e, "back faces are no longer lit like front faces: the format does not support this");
    if (object->cull != LAM_CULL_NONE)
        export_lose(e, "culled faces become visible: the format cannot cull faces");
}

static bool flatten(struct exporting *e, enum export_kind kind)
{
    const struct lam_scene *s = e->scene;
    struct flat size = {.e = e, .kind = kind}, f;
    const double *origin = NULL;
    lam_mesh *out = &e->flat[kind];
    for (int i = 0; i < s->objects.count; i++) {
        const lam_object *object = scene_object(s, i);
        const lam_mesh *m = scene_mesh(s, object->mesh);
        if (kind_of(m) != kind || !mesh_items(m) || !scene_shows(s, i))
            continue;
        origin = origin ? origin : m->origin;
        count_mesh(&size, m);
        lose_sides(e, object);
    }
    if (!size.corners)
        return true;
    if (size.vertices >= UINT32_MAX || size.corners >= UINT32_MAX || size.normals >= UINT32_MAX ||
        size.texcoords >= UINT32_MAX)
        return fail(e->error, LAM_LIMIT, "the scene has %zu vertices, more than a flat model file can number",
                    size.vertices);
    f = size;
    if (!export_is_whole(e) || !make_arrays(&f))
        return false;
    f.vertices = f.normals = f.texcoords = f.colors = f.corners = f.parts = 0;
    for (int i = 0; i < s->objects.count && export_asks(e); i++) {
        const lam_object *object = scene_object(s, i);
        const lam_mesh *m = scene_mesh(s, object->mesh);
        if (kind_of(m) == kind && mesh_items(m) && scene_shows(s, i))
            put_object(&f, m, object, origin);
    }
    put_missing(&f, f.corners);
    if (!export_is_whole(e))
        return false;
    *out = (lam_mesh){.origin = {origin[0], origin[1], origin[2]},
                      .positions = f.position,
                      .vertex_count = (uint32_t)f.vertices,
                      .indices = f.index,
                      .normals = f.has_normals ? f.normal : NULL,
                      .normal_count = (uint32_t)f.normals,
                      .normal_indices = f.normal_index,
                      .texcoords = f.has_texcoords ? f.texcoord : NULL,
                      .texcoord_count = (uint32_t)f.texcoords,
                      .texcoord_indices = f.texcoord_index,
                      .colors = f.has_colors ? f.color : NULL,
                      .color_count = (uint32_t)f.colors + 1,
                      .colors_format = LAM_COLORS_LINEAR_F32,
                      .color_indices = f.color_index,
                      .parts = f.part,
                      .part_count = (uint32_t)f.parts};
    uint32_t items = (uint32_t)(f.corners / (kind == EXPORT_TRIANGLES ? 3 : kind == EXPORT_LINES ? 2 : 1));
    *(kind == EXPORT_TRIANGLES ? &out->triangle_count
      : kind == EXPORT_LINES   ? &out->line_count
                               : &out->point_count) = items;
    return true;
}

bool export_flatten(struct exporting *e)
{
    for (int kind = 0; kind < EXPORT_KINDS; kind++)
        if (!flatten(e, (enum export_kind)kind))
            return false;
    return true;
}
