// scene_repair.c: repairs the meshes of a file: leaves out items (triangles, lines and points) without a finite
// position, and computes normals that have no direction.
#include "prepare.h"

#include "fail.h"
#include "linear.h"
#include "normals.h"

#include <string.h>

struct repair {
    struct lam_scene *scene;
    struct pool *pool;
    struct arena scratch;
    lam_normals normals;
    double crease_angle_rad;
    bool any;                      // a position is not finite
    uint64_t vertices;             // without a finite position
    const float *counted;          // the last array of normals that the next numbers include
    uint64_t directionless, given; // normals without a direction, and all normals of these arrays
};

static bool no_memory(const struct repair *r, size_t bytes, lam_error *error)
{
    return call_memory_error(r->scratch.call, bytes, error);
}

// --- vectors

static bool is_finite(const float v[3]) { return (v[0] - v[0]) + (v[1] - v[1]) + (v[2] - v[2]) == 0; }
static bool is_zero(const float v[3]) { return v[0] == 0 && v[1] == 0 && v[2] == 0; }

static bool lacks_normal(const lam_mesh *mesh, uint32_t normal)
{
    return normal == UINT32_MAX || is_zero(mesh->normals + 3 * (size_t)normal);
}

// A pass over an array of vectors, in parallel chunks.
struct vectors {
    float *items;
    size_t count;
    bool normals;
    uint64_t bad; // vectors that are not finite, or normals without a direction; atomic
};

// Sets bad normals to zero. Normals whose squared length leaves the range of floats become unit normals.
static bool repair_normal(float *n)
{
    float square = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
    if (square >= 1e-30f && square <= 1e30f)
        return true;
    bool good = is_finite(n) && !is_zero(n);
    lam_vec3 unit = good ? v3_unit(v3((double)n[0], (double)n[1], (double)n[2])) : v3(0, 0, 0);
    n[0] = (float)unit.x, n[1] = (float)unit.y, n[2] = (float)unit.z;
    return good;
}

enum { CHUNK = 1 << 14 };

static void check_chunk(void *user, size_t index, int thread)
{
    struct vectors *vectors = user;
    size_t first = index * (size_t)CHUNK, end = first + CHUNK < vectors->count ? first + CHUNK : vectors->count;
    uint64_t bad = 0;
    (void)thread;
    for (size_t i = first; i < end; i++)
        bad += !(vectors->normals ? repair_normal(vectors->items + 3 * i) : is_finite(vectors->items + 3 * i));
    if (bad)
        __atomic_add_fetch(&vectors->bad, bad, __ATOMIC_RELAXED);
}

// Returns the number of bad vectors. The scene owns the array.
static uint64_t count_bad(const struct repair *r, const float *items, size_t count, bool normals)
{
    struct vectors vectors = {(float *)(uintptr_t)items, count, normals, 0};
    pool_run(r->pool, (count + CHUNK - 1) / CHUNK, check_chunk, &vectors);
    return vectors.bad;
}

// --- items

enum mark { KEPT, LEFT_OUT, UNLIT }; // of an item

// Replaces *pointer with a copy of the rows of `size` bytes that belong to items with this mark.
static bool keep_rows(struct repair *r, const void *pointer, const uint8_t *marks, uint8_t kept, size_t items,
                      size_t size, lam_error *error)
{
    const uint8_t **array = (const uint8_t **)(uintptr_t)pointer;
    uint8_t *copy = *array ? arena_array(&r->scene->arena, items, size) : NULL;
    if (*array && !copy)
        return no_memory(r, items * size, error);
    for (size_t i = 0, n = 0; *array && i < items; i++)
        if (marks[i] == kept)
            memcpy(copy + size * n++, *array + size * i, size);
    *array = copy;
    return true;
}

// Keeps the items with this mark.
static bool keep_items(struct repair *r, lam_mesh *mesh, const uint8_t *marks, uint8_t kept, lam_error *error)
{
    const size_t items = mesh_items(mesh), corner_bytes = mesh_corners(mesh) / items * 4;
    const size_t color = mesh->colors_format == LAM_COLORS_LINEAR_F32 ? 16 : 4;
    uint32_t *own = mesh->indices ? NULL : arena_array(&r->scratch, items, corner_bytes);
    for (size_t i = 0; own && i < mesh_corners(mesh); i++)
        own[i] = (uint32_t)i;
    if (!mesh->indices && !(mesh->indices = own))
        return no_memory(r, items * corner_bytes, error);
    const void *const corners[] = {&mesh->indices,          &mesh->normal_indices,
                                   &mesh->texcoord_indices, &mesh->second_texcoord_indices,
                                   &mesh->tangent_indices,  &mesh->color_indices};
    for (size_t i = 0; i < sizeof corners / sizeof *corners; i++)
        if (!keep_rows(r, corners[i], marks, kept, items, corner_bytes, error))
            return false;
    lam_part *parts = arena_array(&r->scene->arena, mesh->part_count, sizeof *parts);
    if (!parts)
        return no_memory(r, mesh->part_count * sizeof *parts, error);
    uint32_t count = 0;
    for (uint32_t p = 0; p < mesh->part_count; p++) {
        const lam_part *part = &mesh->parts[p];
        parts[p] = *part;
        parts[p].first_triangle = count;
        for (uint32_t i = 0; i < part->triangle_count; i++)
            count += marks[part->first_triangle + i] == kept;
        parts[p].triangle_count = count - parts[p].first_triangle;
    }
    mesh->parts = mesh->part_count ? parts : NULL;
    if (!keep_rows(r, &mesh->smoothing_groups, marks, kept, items, 4, error) ||
        !keep_rows(r, &mesh->inner_edges, marks, kept, items, 1, error) ||
        (mesh->colors_rate == LAM_PER_TRIANGLE && !keep_rows(r, &mesh->colors, marks, kept, items, color, error)))
        return false;
    count = 0;
    for (size_t i = 0; i < items; i++)
        count += marks[i] == kept;
    *(mesh->line_count ? &mesh->line_count : mesh->point_count ? &mesh->point_count : &mesh->triangle_count) = count;
    if (mesh->colors && mesh->colors_rate == LAM_PER_TRIANGLE)
        mesh->color_count = count;
    r->scene->first_all_used = false;
    return true;
}

static void drop_normals(lam_mesh *mesh)
{
    mesh->normals = NULL;
    mesh->normal_indices = NULL;
    mesh->normal_count = 0;
}

// Leaves out the items that use a vertex without a finite position. Lines and points without a normal become a mesh of
// their own, without normals.
static bool select_items(struct repair *r, int index, bool unlit, lam_error *error)
{
    struct lam_scene *scene = r->scene;
    lam_mesh *mesh = (lam_mesh *)scene->meshes.items + index, separate = *mesh;
    const size_t items = mesh_items(mesh), corners = mesh_corners(mesh) / items;
    uint8_t *marks = arena_alloc_zeroed(&r->scratch, items);
    if (!marks)
        return no_memory(r, items, error);
    for (size_t i = 0; i < items * corners; i++)
        if (!is_finite(mesh->positions + 3 * (size_t)mesh_element(NULL, mesh, i)))
            marks[i / corners] = LEFT_OUT;
        else if (unlit && marks[i / corners] == KEPT && lacks_normal(mesh, mesh_element(mesh->normal_indices, mesh, i)))
            marks[i / corners] = UNLIT;
    if ((memchr(marks, LEFT_OUT, items) || memchr(marks, UNLIT, items)) && !keep_items(r, mesh, marks, KEPT, error))
        return false;
    if (!memchr(marks, UNLIT, items))
        return true;
    if (!keep_items(r, &separate, marks, UNLIT, error))
        return false;
    drop_normals(&separate);
    scene->shared_arrays = true;
    int added = scene_append(scene, &scene->meshes, &separate, sizeof separate, error);
    for (int i = 0, count = scene->objects.count; added >= 0 && i < count; i++) {
        lam_object object = *scene_object(scene, i);
        bool uses = object.mesh == index;
        object.mesh = added;
        if (uses && scene_append(scene, &scene->objects, &object, sizeof object, error) < 0)
            return false;
    }
    return added >= 0;
}

// Computes the normals of corners without one, as if the mesh had no normals. Appends them to the normals of the file.
static bool complete_normals(struct repair *r, lam_mesh *mesh, lam_error *error)
{
    lam_mesh computed = *mesh;
    size_t lacking = 0, corners = mesh_corners(mesh);
    while (lacking < corners && !lacks_normal(mesh, mesh_element(mesh->normal_indices, mesh, lacking)))
        lacking++;
    if (lacking == corners)
        return true;
    const double crease_angle_rad = r->crease_angle_rad > 0 ? r->crease_angle_rad : math_radians(40);
    if (!normals_smooth(&computed, crease_angle_rad, &r->scratch, r->pool, r->scratch.call, error))
        return false;
    const size_t own = mesh->normal_count, count = own + computed.normal_count;
    float *normals = arena_array(&r->scene->arena, count, 3 * sizeof *normals);
    uint32_t *indices = arena_array(&r->scene->arena, corners, sizeof *indices);
    if (!normals || !indices)
        return no_memory(r, count * 3 * sizeof *normals, error);
    memcpy(normals, mesh->normals, own * 3 * sizeof *normals);
    memcpy(normals + 3 * own, computed.normals, (count - own) * 3 * sizeof *normals);
    for (size_t i = 0; i < corners; i++) {
        indices[i] = mesh_element(mesh->normal_indices, mesh, i);
        if (lacks_normal(mesh, indices[i]))
            indices[i] = (uint32_t)own + (computed.normal_indices ? computed.normal_indices[i] : (uint32_t)i);
    }
    mesh->normals = normals;
    mesh->normal_count = (uint32_t)count;
    mesh->normal_indices = indices;
    return true;
}

static bool repair_mesh(struct repair *r, int index, lam_error *error)
{
    lam_mesh *mesh = (lam_mesh *)r->scene->meshes.items + index;
    const bool strokes = mesh_is_strokes(mesh);
    uint64_t lacking = 0;
    if (!mesh_items(mesh))
        return true;
    if (mesh->normals && (r->normals == LAM_NORMALS_FILE || strokes))
        lacking = count_bad(r, mesh->normals, mesh->normal_count, true);
    if (lacking && mesh->normals != r->counted) { // meshes of glTF share arrays
        r->counted = mesh->normals;
        r->directionless += lacking;
        r->given += mesh->normal_count;
    }
    if (lacking && lacking == mesh->normal_count)
        drop_normals(mesh);
    bool unlit = strokes && lacking && mesh->normals,
         bad = count_bad(r, mesh->positions, mesh->vertex_count, false) > 0;
    r->any |= bad;
    return (!unlit && !bad) || select_items(r, index, unlit, error);
}

// Moves vertices without a finite position to zero. Several meshes may share the array.
static void move_vertices(struct repair *r, const lam_mesh *mesh)
{
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        float *position = (float *)(uintptr_t)mesh->positions + 3 * (size_t)v;
        if (!is_finite(position)) {
            memset(position, 0, 3 * sizeof *position);
            r->vertices++;
        }
    }
}

static uint64_t count_items(const struct lam_scene *scene)
{
    uint64_t items = 0;
    for (int i = 0; i < scene->meshes.count; i++)
        items += mesh_items(scene_mesh(scene, i));
    return items;
}

bool scene_repair(struct lam_scene *scene, const char *name, lam_normals normals, double crease_angle_rad,
                  struct pool *pool, lam_error *error)
{
    struct repair r = {.scene = scene, .pool = pool, .normals = normals, .crease_angle_rad = crease_angle_rad};
    arena_start(&r.scratch, scene->arena.call);
    bool ok = true;
    uint64_t before = count_items(scene);
    for (int i = 0, count = scene->meshes.count; ok && i < count; i++)
        ok = repair_mesh(&r, i, error);
    for (int i = 0; ok && r.any && i < scene->meshes.count; i++)
        move_vertices(&r, scene_mesh(scene, i));
    for (int i = 0; ok && (r.directionless || scene->normals_missing) && i < scene->meshes.count; i++)
        if (scene_mesh(scene, i)->normals && !mesh_is_strokes(scene_mesh(scene, i)) && normals == LAM_NORMALS_FILE)
            ok = complete_normals(&r, (lam_mesh *)scene->meshes.items + i, error);
    arena_free(&r.scratch);
    uint64_t left_out = before - count_items(scene);
    if (ok && before && left_out == before)
        return fail(error, LAM_CANNOT_READ,
                    "%s: contains nothing to draw: each triangle, line and point uses a vertex that is not finite",
                    name);
    if (ok && r.vertices)
        scene_warn(scene,
                   "%s: %llu vertices have coordinates that are not finite; %llu triangles, lines or points that "
                   "use them are left out",
                   name, (unsigned long long)r.vertices, (unsigned long long)left_out);
    if (ok && r.directionless)
        scene_warn(scene,
                   "%s: %llu of %llu normals are zero or not finite; they are computed, or left out for lines and "
                   "points",
                   name, (unsigned long long)r.directionless, (unsigned long long)r.given);
    scene->normals_missing = false;
    return ok;
}
