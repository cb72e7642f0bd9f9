// mesh_cut.c: cuts the triangles, lines and points of one mesh by a plane.
//
// A position exactly on the plane counts as removed, so every triangle is kept, removed or cut into a clean edge. The
// cut of an edge depends only on its two positions, so that triangles which share the edge get the same bits.
#include "section.h"

#include "fail.h"
#include "linear.h"

#include <string.h>

enum { CHECK_INTERVAL = 65536 };

static double height(const struct mesh_cut *cut, size_t corner)
{
    const float *p = cut->mesh->positions + 3 * (size_t)mesh_element(NULL, cut->mesh, corner);
    return cut->plane[0] * (double)p[0] + cut->plane[1] * (double)p[1] + cut->plane[2] * (double)p[2] + cut->plane[3];
}

static uint32_t add_point(struct mesh_cut *cut, size_t kept, double kept_height, size_t removed, double removed_height)
{
    struct cut_point *point = &cut->points[cut->point_count];
    const float *a = cut->mesh->positions + 3 * (size_t)mesh_element(NULL, cut->mesh, kept);
    const float *b = cut->mesh->positions + 3 * (size_t)mesh_element(NULL, cut->mesh, removed);
    *point = (struct cut_point){(uint32_t)kept, (uint32_t)removed, kept_height / (kept_height - removed_height), {0}};
    for (int k = 0; k < 3; k++)
        point->position[k] = (float)((double)a[k] + point->t * ((double)b[k] - (double)a[k]));
    return cut->point_count++ | NEW_CORNER;
}

static void add_item(struct mesh_cut *cut, uint32_t from, uint32_t part, const uint32_t *corners, uint32_t sides,
                     uint8_t inner)
{
    memcpy(cut->corners + (size_t)cut->items * sides, corners, sides * sizeof *corners);
    cut->inner[cut->items] = inner;
    cut->from[cut->items++] = from;
    cut->parts[part]++;
}

// Cuts a triangle of which one or two corners are kept. Bit k of the inner edges is the edge after corner k.
static void cut_triangle(struct mesh_cut *cut, uint32_t item, uint32_t part, const double heights[3])
{
    uint32_t polygon[4], count = 0, edge[2] = {0, 0};
    uint8_t inner = 0, before = cut->mesh->inner_edges ? cut->mesh->inner_edges[item] : 0;
    const uint8_t surface = before & 8; // an earlier plane made the triangle
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t next = (k + 1) % 3;
        size_t a = (size_t)item * 3 + k, b = (size_t)item * 3 + next;
        if (heights[k] < 0) {
            inner |= (uint8_t)((before >> k & 1) << count);
            polygon[count++] = (uint32_t)a;
            if (heights[next] >= 0) // leaves the kept side; the edge after this point is the cut
                edge[1] = polygon[count++] = add_point(cut, a, heights[k], b, heights[next]);
        } else if (heights[next] < 0) {
            inner |= (uint8_t)((before >> k & 1) << count);
            edge[0] = polygon[count++] = add_point(cut, b, heights[next], a, heights[k]);
        }
    }
    if (count == 3) {
        add_item(cut, item, part, polygon, 3, inner | surface);
    } else {
        const uint32_t halves[2][3] = {{polygon[0], polygon[1], polygon[2]}, {polygon[0], polygon[2], polygon[3]}};
        add_item(cut, item, part, halves[0], 3, (uint8_t)((inner & 3) | 4 | surface));
        add_item(cut, item, part, halves[1], 3, (uint8_t)(1 | (inner >> 1 & 6) | surface));
    }
    cut->edges[cut->edge_count++] = (struct cut_edge){{edge[0] & ~NEW_CORNER, edge[1] & ~NEW_CORNER}, part};
}

static void cut_line(struct mesh_cut *cut, uint32_t item, uint32_t part, const double heights[2])
{
    size_t kept = (size_t)item * 2 + (heights[0] >= 0), removed = (size_t)item * 2 + (heights[0] < 0);
    uint32_t ends[2] = {(uint32_t)kept, add_point(cut, kept, heights[kept & 1], removed, heights[removed & 1])};
    add_item(cut, item, part, ends, 2, 0);
}

static uint32_t sides_of(const lam_mesh *mesh) { return mesh->line_count ? 2 : mesh->point_count ? 1 : 3; }

bool mesh_cut_find(struct mesh_cut *cut, struct arena *memory, struct call_control *call, lam_error *error)
{
    const lam_mesh *mesh = cut->mesh;
    const uint32_t count = mesh_items(mesh), sides = sides_of(mesh), parts = mesh->part_count ? mesh->part_count : 1;
    uint32_t met = 0;
    if (count > (NEW_CORNER - 1) / 3)
        return fail(error, LAM_LIMIT, "a section has more than %u triangles", (NEW_CORNER - 1) / 3);
    for (uint32_t i = 0; i < count; i++) {
        unsigned kept = 0;
        for (uint32_t k = 0; k < sides; k++)
            kept += height(cut, (size_t)i * sides + k) < 0;
        cut->removed += kept < sides;
        met += kept && kept < sides;
        if (i % CHECK_INTERVAL == 0 && !call_should_continue(call))
            return call_error(call, error);
    }
    if (!cut->removed)
        return true;
    const uint64_t items = (uint64_t)count - cut->removed + 2 * (uint64_t)met;
    if (items > UINT32_MAX / 4)
        return fail(error, LAM_LIMIT, "a section has more than %u triangles", UINT32_MAX / 4);
    cut->corners = arena_array(memory, (size_t)items, sides * sizeof *cut->corners);
    cut->inner = arena_array(memory, (size_t)items, 1);
    cut->from = arena_array(memory, (size_t)items, sizeof *cut->from);
    cut->parts = arena_alloc_zeroed(memory, parts * sizeof *cut->parts);
    cut->caps = arena_alloc_zeroed(memory, parts * sizeof *cut->caps);
    cut->point_capacity = 2 * met;
    cut->points = arena_array(memory, cut->point_capacity, sizeof *cut->points);
    cut->edges = arena_array(memory, met, sizeof *cut->edges);
    if (!cut->corners || !cut->inner || !cut->from || !cut->parts || !cut->caps || !cut->points || !cut->edges)
        return call_memory_error(call, (size_t)items * 16, error);
    uint32_t part = 0;
    for (uint32_t i = 0; i < count; i++) {
        while (part + 1 < parts && i >= mesh->parts[part + 1].first_triangle)
            part++;
        double heights[3];
        unsigned kept = 0;
        for (uint32_t k = 0; k < sides; k++)
            kept += (heights[k] = height(cut, (size_t)i * sides + k)) < 0;
        const uint32_t whole[3] = {i * sides, i * sides + 1, i * sides + 2};
        if (kept == sides)
            add_item(cut, i, part, whole, sides, mesh->inner_edges ? mesh->inner_edges[i] : 0);
        else if (kept && sides == 3)
            cut_triangle(cut, i, part, heights);
        else if (kept)
            cut_line(cut, i, part, heights);
    }
    return true;
}

// --- the new mesh

// Copies an attribute with `width` floats for each element, and adds an element for each point. `own` is the
// attribute's index array.
static bool extend_floats(const struct mesh_cut *cut, const float *values, uint32_t count, const uint32_t *own,
                          uint32_t width, uint32_t spare, struct arena *memory, const float **out)
{
    float *all = arena_array(memory, (size_t)count + cut->point_count + spare, width * sizeof *all);
    if (!all)
        return false;
    memcpy(all, values, (size_t)count * width * sizeof *all);
    for (uint32_t i = 0; i < cut->point_count; i++) {
        const struct cut_point *p = &cut->points[i];
        const float *a = values + (size_t)mesh_element(own, cut->mesh, p->kept) * width;
        const float *b = values + (size_t)mesh_element(own, cut->mesh, p->removed) * width;
        float *to = all + ((size_t)count + i) * width;
        for (uint32_t k = 0; k < width; k++)
            to[k] = (float)((double)a[k] + p->t * ((double)b[k] - (double)a[k]));
        if (values == cut->mesh->positions)
            memcpy(to, p->position, sizeof p->position);
        if (width == 4) // the bitangent's sign
            to[3] = a[3];
    }
    *out = all;
    return true;
}

// Makes the index array of an attribute with `count` elements before. The corners of cut surfaces use the element of
// their point or, if `cap` is not UINT32_MAX, element `cap`.
static const uint32_t *indices_of(const struct mesh_cut *cut, uint32_t count, const uint32_t *own, uint32_t cap,
                                  size_t total, struct arena *memory)
{
    const uint32_t sides = sides_of(cut->mesh);
    uint32_t *out = arena_array(memory, total * sides, sizeof *out);
    size_t n = 0;
    for (; out && n < (size_t)cut->items * sides; n++) {
        const uint32_t corner = cut->corners[n];
        out[n] = corner & NEW_CORNER ? count + (corner & ~NEW_CORNER) : mesh_element(own, cut->mesh, corner);
    }
    const uint32_t parts = cut->mesh->part_count ? cut->mesh->part_count : 1;
    for (uint32_t part = 0; out && part < parts; part++)
        for (uint32_t i = 0; i < cut->caps[part].count * 3; i++)
            out[n++] = cap != UINT32_MAX ? cap : count + cut->caps[part].points[i];
    return out;
}

// Copies one element for each item, and for each triangle of a cut surface the element of a triangle at its edge.
static void *items_of(const struct mesh_cut *cut, const void *values, size_t size, size_t total, struct arena *memory)
{
    char *out = arena_array(memory, total, size);
    size_t n = 0;
    for (; out && n < cut->items; n++)
        memcpy(out + n * size, (const char *)values + cut->from[n] * size, size);
    const uint32_t parts = cut->mesh->part_count ? cut->mesh->part_count : 1;
    for (uint32_t part = 0; out && part < parts; part++)
        for (uint32_t i = 0; i < cut->caps[part].count; i++, n++)
            memcpy(out + n * size, (const char *)values + cut->points[cut->caps[part].points[3 * i]].kept / 3 * size,
                   size);
    return out;
}

// The colours of the points are not mixed in their encoding, because a mean of sRGB bytes is too dark; a point has the
// colour of its kept corner.
static bool extend_colors(const struct mesh_cut *cut, size_t total, struct arena *memory, lam_mesh *out)
{
    const lam_mesh *mesh = cut->mesh;
    const size_t size = mesh->colors_format == LAM_COLORS_LINEAR_F32 ? 16 : 4;
    if (mesh->colors_rate == LAM_PER_TRIANGLE) {
        out->colors = items_of(cut, mesh->colors, size, total, memory);
        out->color_count = (uint32_t)total;
        return out->colors != NULL;
    }
    char *all = arena_array(memory, (size_t)mesh->color_count + cut->point_count, size);
    if (!all)
        return false;
    memcpy(all, mesh->colors, mesh->color_count * size);
    for (uint32_t i = 0; i < cut->point_count; i++)
        memcpy(all + (mesh->color_count + (size_t)i) * size,
               (const char *)mesh->colors + mesh_element(mesh->color_indices, mesh, cut->points[i].kept) * size, size);
    out->colors = all;
    out->color_count = mesh->color_count + cut->point_count;
    out->color_indices = indices_of(cut, mesh->color_count, mesh->color_indices, UINT32_MAX, total, memory);
    return out->color_indices != NULL;
}

static bool extend_normals(const struct mesh_cut *cut, size_t total, struct arena *memory, lam_mesh *out)
{
    const lam_mesh *mesh = cut->mesh;
    const uint32_t cap = mesh->normal_count + cut->point_count;
    if (!extend_floats(cut, mesh->normals, mesh->normal_count, mesh->normal_indices, 3, 1, memory, &out->normals))
        return false;
    double largest = 0;
    for (int k = 0; k < 3; k++)
        largest = cut->plane[k] > largest ? cut->plane[k] : -cut->plane[k] > largest ? -cut->plane[k] : largest;
    for (int k = 0; k < 3; k++)
        ((float *)(uintptr_t)out->normals)[3 * (size_t)cap + (size_t)k] = (float)(cut->plane[k] / largest);
    out->normal_count = cap + 1;
    out->normal_indices = indices_of(cut, mesh->normal_count, mesh->normal_indices, cap, total, memory);
    return out->normal_indices != NULL;
}

static bool make_parts(const struct mesh_cut *cut, const int *materials, struct arena *memory, lam_mesh *out)
{
    const lam_mesh *mesh = cut->mesh;
    const lam_part whole = {.material = -1}, *before = mesh->part_count ? mesh->parts : &whole;
    const uint32_t parts = mesh->part_count ? mesh->part_count : 1;
    lam_part *all = arena_array(memory, (size_t)parts * 2, sizeof *all);
    uint32_t next = 0, count = parts;
    for (uint32_t i = 0; all && i < parts; i++) {
        all[i] = before[i];
        all[i].first_triangle = next;
        next += all[i].triangle_count = cut->parts[i];
    }
    for (uint32_t i = 0; all && i < parts; i++) {
        if (!cut->caps[i].count)
            continue;
        all[count] = before[i];
        all[count].first_triangle = next;
        all[count].material = materials[i];
        next += all[count++].triangle_count = cut->caps[i].count;
    }
    out->parts = all;
    out->part_count = count;
    return all != NULL;
}

static bool make_inner_edges(const struct mesh_cut *cut, size_t total, struct arena *memory, lam_mesh *out)
{
    uint8_t *all = arena_array(memory, total, 1);
    size_t n = cut->items;
    if (!all)
        return false;
    memcpy(all, cut->inner, n);
    for (uint32_t part = 0; part < (cut->mesh->part_count ? cut->mesh->part_count : 1); part++) {
        if (cut->caps[part].count)
            memcpy(all + n, cut->caps[part].inner, cut->caps[part].count);
        n += cut->caps[part].count;
    }
    out->inner_edges = all;
    return true;
}

bool mesh_cut_make(const struct mesh_cut *cut, const int *materials, struct arena *memory, lam_mesh *out,
                   struct call_control *call, lam_error *error)
{
    const lam_mesh *mesh = cut->mesh;
    size_t total = cut->items;
    for (uint32_t part = 0; part < (mesh->part_count ? mesh->part_count : 1); part++)
        total += cut->caps[part].count;
    if (total > UINT32_MAX / 3)
        return fail(error, LAM_LIMIT, "a section has more than %u triangles", UINT32_MAX / 3);
    *out = *mesh;
    out->exact_area = out->exact_volume = 0;
    uint32_t *count = mesh->line_count    ? &out->line_count
                      : mesh->point_count ? &out->point_count
                                          : &out->triangle_count;
    *count = (uint32_t)total;
    out->vertex_count = mesh->vertex_count + cut->point_count;
    bool ok = extend_floats(cut, mesh->positions, mesh->vertex_count, mesh->indices, 3, 0, memory, &out->positions) &&
              (out->indices = indices_of(cut, mesh->vertex_count, mesh->indices, UINT32_MAX, total, memory)) &&
              make_parts(cut, materials, memory, out);
    if (ok && mesh->normals)
        ok = extend_normals(cut, total, memory, out);
    const struct {
        size_t values, count, indices;
        uint32_t width;
    } rows[] = {
        {offsetof(lam_mesh, texcoords), offsetof(lam_mesh, texcoord_count), offsetof(lam_mesh, texcoord_indices), 2},
        {offsetof(lam_mesh, second_texcoords), offsetof(lam_mesh, second_texcoord_count),
         offsetof(lam_mesh, second_texcoord_indices), 2},
        {offsetof(lam_mesh, tangents), offsetof(lam_mesh, tangent_count), offsetof(lam_mesh, tangent_indices), 4}};
    for (size_t i = 0; ok && i < sizeof rows / sizeof *rows; i++) {
        const float **values = (const float **)((char *)out + rows[i].values);
        uint32_t *elements = (uint32_t *)((char *)out + rows[i].count);
        const uint32_t **indices = (const uint32_t **)((char *)out + rows[i].indices);
        if (!*values)
            continue;
        ok = (*indices = indices_of(cut, *elements, *indices, UINT32_MAX, total, memory)) != NULL &&
             extend_floats(cut, *values, *elements, *(const uint32_t *const *)((const char *)mesh + rows[i].indices),
                           rows[i].width, 0, memory, values);
        *elements += cut->point_count;
    }
    if (ok && mesh->colors)
        ok = extend_colors(cut, total, memory, out);
    if (ok && mesh->smoothing_groups)
        ok = (out->smoothing_groups = items_of(cut, mesh->smoothing_groups, 4, total, memory)) != NULL;
    if (ok && mesh->triangle_count)
        ok = make_inner_edges(cut, total, memory, out);
    return ok || call_memory_error(call, total * 16, error);
}
