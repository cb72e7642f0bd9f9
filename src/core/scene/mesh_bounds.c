// mesh_bounds.c: the used vertices of a mesh, bounding boxes of meshes and scenes, the origin of meshes far from zero,
// and translucency of vertex colours.
#include "scene_internal.h"

#include "linear.h"
#include "origin.h"

#include <float.h>
#include <string.h>

// Corners or colours per parallel chunk; constant, so that the result does not depend on the number of threads.
enum { CHUNK = 1 << 16 };

struct marking {
    const uint32_t *indices;
    size_t corners;
    uint8_t *used;
};

static void mark_chunk(void *user, size_t index, int thread)
{
    (void)thread;
    const struct marking *marking = user;
    const uint32_t *indices = marking->indices;
    uint8_t *used = marking->used;
    size_t first = index * (size_t)CHUNK, end = first + CHUNK;
    if (end > marking->corners)
        end = marking->corners;
    // Several threads may mark the same vertex with the same value.
    for (size_t i = first; i < end; i++)
        __atomic_store_n(&used[indices[i]], 1, __ATOMIC_RELAXED);
}

// Builds the list of used vertices if some vertices are unused. Returns false if memory runs out.
static bool find_used(struct lam_scene *scene, const lam_mesh *mesh, struct scene_extent *extent, struct pool *pool,
                      lam_error *error)
{
    size_t corners = mesh_corners(mesh);
    extent->used = NULL;
    extent->used_count = mesh->indices ? mesh->vertex_count : (uint32_t)corners;
    if (!mesh->indices)
        return true;
    struct arena scratch;
    arena_start(&scratch, scene->arena.call);
    uint8_t *used = arena_alloc_zeroed(&scratch, mesh->vertex_count + 1);
    bool ok = used || call_memory_error(scratch.call, mesh->vertex_count, error);
    if (ok) {
        struct marking marking = {mesh->indices, corners, used};
        pool_run(pool, (corners + CHUNK - 1) / CHUNK, mark_chunk, &marking);
        uint32_t count = 0;
        for (uint32_t i = 0; i < mesh->vertex_count; i++)
            count += used[i];
        if (count < mesh->vertex_count) {
            uint32_t *list = arena_array(&scene->arena, count, sizeof *list);
            ok = list || call_memory_error(scene->arena.call, count * sizeof *list, error);
            for (uint32_t i = 0, n = 0; ok && i < mesh->vertex_count; i++)
                if (used[i])
                    list[n++] = i;
            extent->used = list;
            extent->used_count = count;
        }
    }
    arena_free(&scratch);
    return ok;
}

struct alpha_search {
    const lam_mesh *mesh;
    int found; // atomic
};

static void search_chunk(void *user, size_t index, int thread)
{
    (void)thread;
    struct alpha_search *alpha_search = user;
    const lam_mesh *mesh = alpha_search->mesh;
    size_t first = index * (size_t)CHUNK, end = first + CHUNK;
    if (end > mesh->color_count)
        end = mesh->color_count;
    bool found = false;
    if (mesh->colors_format == LAM_COLORS_LINEAR_F32) {
        const float *alpha = (const float *)mesh->colors + 3;
        for (size_t i = first; i < end; i++)
            found |= alpha[4 * i] < 1;
    } else {
        const uint8_t *alpha = (const uint8_t *)mesh->colors + 3;
        for (size_t i = first; i < end; i++)
            found |= alpha[4 * i] < 255;
    }
    if (found)
        __atomic_store_n(&alpha_search->found, 1, __ATOMIC_RELAXED);
}

// Returns whether a mesh has a colour with an alpha below 1.
static bool has_translucent_colors(const lam_mesh *mesh, struct pool *pool)
{
    struct alpha_search alpha_search = {.mesh = mesh};
    if (mesh->colors)
        pool_run(pool, ((size_t)mesh->color_count + CHUNK - 1) / CHUNK, search_chunk, &alpha_search);
    return alpha_search.found;
}

struct shifting {
    const float *from;
    float *to;    // may be `from`
    size_t count; // the number of points, three values each
    double by[3];
};

// The result is clamped to finite numbers, because vertices that no triangle uses may be anywhere.
static float shifted(float value, double by)
{
    double moved = (double)value - by;
    return (float)(moved<-(double)FLT_MAX ? -(double)FLT_MAX : moved>(double) FLT_MAX ? (double)FLT_MAX : moved);
}

static void shift_chunk(void *user, size_t index, int thread)
{
    (void)thread;
    const struct shifting *shifting = user;
    size_t first = index * (size_t)CHUNK, end = first + CHUNK;
    if (end > shifting->count)
        end = shifting->count;
    for (size_t i = first; i < end; i++)
        for (int axis = 0; axis < 3; axis++)
            shifting->to[3 * i + axis] = shifted(shifting->from[3 * i + axis], shifting->by[axis]);
}

// If a mesh is far from zero, stores its positions relative to an origin, because drawing uses floats and would lose
// detail. The new positions are exact, because they are smaller than the old positions and multiples of the same power
// of two. The origin is also a multiple of this power. The scene owns the mesh's arrays; if several meshes share them,
// the mesh gets its own copy. Returns false if memory runs out.
static bool move_origin(struct lam_scene *scene, lam_mesh *mesh, struct aabb_tree *boxes, struct pool *pool,
                        lam_error *error)
{
    box_of_six whole;
    box_tree_whole(boxes, whole);
    const double low[3] = {(double)whole[0], (double)whole[1], (double)whole[2]};
    const double high[3] = {(double)whole[3], (double)whole[4], (double)whole[5]};
    struct shifting shifting = {mesh->positions, (float *)(uintptr_t)mesh->positions, mesh->vertex_count, {0}};
    if (!origin_choose(low, high, shifting.by))
        return true;
    if (scene->shared_arrays && !(shifting.to = arena_array(&scene->arena, shifting.count, 3 * sizeof(float))))
        return call_memory_error(scene->arena.call, shifting.count * 3 * sizeof(float), error);
    pool_run(pool, (shifting.count + CHUNK - 1) / CHUNK, shift_chunk, &shifting);
    mesh->positions = shifting.to;
    shifting.from = shifting.to = (float *)(uintptr_t)boxes->boxes;
    shifting.count = 2 * (boxes->first[boxes->levels - 1] + boxes->count[boxes->levels - 1]);
    pool_run(pool, (shifting.count + CHUNK - 1) / CHUNK, shift_chunk, &shifting);
    for (int axis = 0; axis < 3; axis++)
        mesh->origin[axis] += shifting.by[axis];
    return true;
}

bool scene_measure_mesh(struct lam_scene *scene, lam_mesh *mesh, struct scene_extent *extent, struct pool *pool,
                        lam_error *error)
{
    *extent = (struct scene_extent){.translucent = has_translucent_colors(mesh, pool)};
    if (scene->meshes.items == mesh && scene->first_all_used)
        extent->used_count = mesh->vertex_count;
    else if (!find_used(scene, mesh, extent, pool, error))
        return false;
    if (!box_tree_make(&extent->boxes, mesh, extent->used, extent->used_count, &scene->arena, pool, error))
        return false;
    if (!extent->used_count)
        return true;
    if (!move_origin(scene, mesh, &extent->boxes, pool, error))
        return false;
    box_of_six box;
    box_tree_whole(&extent->boxes, box);
    const double *o = mesh->origin;
    extent->minimum = v3((double)box[0] + o[0], (double)box[1] + o[1], (double)box[2] + o[2]);
    extent->maximum = v3((double)box[3] + o[0], (double)box[4] + o[1], (double)box[5] + o[2]);
    return true;
}

bool scene_measure(struct lam_scene *scene, struct pool *pool, lam_error *error)
{
    for (int i = scene->extents.count; i < scene->meshes.count; i++) {
        struct scene_extent extent;
        if (!scene_measure_mesh(scene, (lam_mesh *)scene->meshes.items + i, &extent, pool, error) ||
            scene_append(scene, &scene->extents, &extent, sizeof extent, error) < 0)
            return false;
    }
    return true;
}

static lam_vec3 lower(lam_vec3 a, lam_vec3 b)
{
    return v3(a.x < b.x ? a.x : b.x, a.y < b.y ? a.y : b.y, a.z < b.z ? a.z : b.z);
}

static lam_vec3 upper(lam_vec3 a, lam_vec3 b)
{
    return v3(a.x > b.x ? a.x : b.x, a.y > b.y ? a.y : b.y, a.z > b.z ? a.z : b.z);
}

// Returns whether the transform only scales and permutes axes, so that it maps boxes to boxes.
static bool keeps_boxes(const lam_mat4 *m)
{
    for (int i = 0; i < 3; i++)
        if ((m->m[i][0] != 0) + (m->m[i][1] != 0) + (m->m[i][2] != 0) != 1)
            return false;
    return true;
}

bool lam_scene_bounds(const lam_scene *scene, lam_vec3 *minimum, lam_vec3 *maximum)
{
    lam_vec3 low = v3(1e308, 1e308, 1e308), high = v3(-1e308, -1e308, -1e308);
    bool any = false;
    for (int i = 0; i < lam_scene_object_count(scene); i++) {
        const lam_object *object = scene_object(scene, i);
        const lam_mesh *mesh = scene_mesh(scene, object->mesh);
        const struct scene_extent *extent = scene_extent(scene, object->mesh);
        if (!extent->used_count || !scene_shows(scene, i))
            continue;
        any = true;
        if (keeps_boxes(&object->transform)) {
            lam_vec3 a = mat4_point(&object->transform, extent->minimum);
            lam_vec3 b = mat4_point(&object->transform, extent->maximum);
            low = lower(low, lower(a, b));
            high = upper(high, upper(a, b));
            continue;
        }
        for (uint32_t v = 0; v < extent->used_count; v++) {
            const float *p = mesh->positions + 3 * (size_t)(extent->used ? extent->used[v] : v);
            lam_vec3 w =
                mat4_point(&object->transform, v3((double)p[0] + mesh->origin[0], (double)p[1] + mesh->origin[1],
                                                  (double)p[2] + mesh->origin[2]));
            low = lower(low, w);
            high = upper(high, w);
        }
    }
    if (!any)
        low = high = v3(0, 0, 0);
    if (minimum)
        *minimum = low;
    if (maximum)
        *maximum = high;
    return any;
}
