// mesh_build.c: splits polygons into triangles, and adds meshes to the scene, for all formats.
#include "mesh_build.h"

#include "loop_status.h"
#include "triangulate.h"

enum { TASK_POLYGONS = 1024, SMALL_POLYGON = 64 };

// A thread's scratch memory.
struct splitter {
    struct triangulator triangulator;
    struct arena large; // for the corners of large polygons
};

struct splitting {
    const struct mesh_polygons *polygons;
    uint8_t *inner_edges; // NULL if not requested
    struct splitter *splitters;
    struct loop_status loop;
};

// Replaces a polygon's corners with the corners of its triangles. `copy` is scratch memory for `count` corners.
static inline void reorder(uint32_t *at, uint32_t count, const uint32_t *triples, uint32_t *copy)
{
    for (uint32_t i = 0; i < count; i++)
        copy[i] = at[i];
    for (uint32_t i = 0; i < 3 * (count - 2); i++)
        at[i] = copy[triples[i]];
}

static bool split_polygon(const struct splitting *splitting, struct mesh_polygon polygon, struct splitter *splitter)
{
    uint32_t count = polygon.count, corner_count = 3 * (count - 2), *const *arrays = splitting->polygons->corners;
    uint32_t small_corners[SMALL_POLYGON], small_triples[3 * (SMALL_POLYGON - 2)];
    uint32_t *corners = small_corners, *triples = small_triples;
    if (count > SMALL_POLYGON) {
        arena_free(&splitter->large);
        corners = arena_array(&splitter->large, count, sizeof *corners);
        triples = arena_array(&splitter->large, corner_count, sizeof *triples);
        if (!corners || !triples)
            return false;
    }
    size_t first = 3 * (size_t)polygon.first_triangle;
    if (!triangulate(&splitter->triangulator, splitting->polygons->positions, arrays[0] + first, count, triples))
        return false;
    for (uint32_t i = 0; splitting->inner_edges && i < count - 2; i++)
        splitting->inner_edges[polygon.first_triangle + i] = triangulated_inner_edges(triples + 3 * (size_t)i, count);
    for (int k = 0; k < 3; k++) {
        if (arrays[k] && count == 4) // the compiler unrolls the loops for this constant
            reorder(arrays[k] + first, 4, triples, corners);
        else if (arrays[k])
            reorder(arrays[k] + first, count, triples, corners);
    }
    return true;
}

static void split_polygons(void *user, size_t index, int thread)
{
    struct splitting *splitting = user;
    size_t first = index * TASK_POLYGONS, last = first + TASK_POLYGONS, count = splitting->polygons->count;
    last = last < count ? last : count;
    bool done = should_continue(&splitting->loop);
    for (size_t i = first; done && i < last; i++) {
        done = split_polygon(splitting, splitting->polygons->items[i], &splitting->splitters[thread]);
        if (!done)
            no_memory(&splitting->loop); // if the call was cancelled, mesh_triangulate reports the cancellation instead
    }
}

bool mesh_triangulate(const struct import_source *source, struct lam_scene *scene, const struct mesh_polygons *polygons,
                      const uint8_t **inner_edges, lam_error *error)
{
    struct call_control *call = source->call;
    struct splitting splitting = {.polygons = polygons, .loop = {.call = call}};
    if (polygons->count == 0)
        return true;
    if (source->params->polygon_edges) {
        *inner_edges = splitting.inner_edges = arena_alloc_zeroed(&scene->arena, polygons->triangles);
        if (!splitting.inner_edges)
            return call_memory_error(call, (size_t)polygons->triangles, error);
    }
    struct arena memory;
    arena_start(&memory, call);
    size_t threads = (size_t)pool_threads(source->pool);
    splitting.splitters = arena_array(&memory, threads, sizeof *splitting.splitters);
    if (!splitting.splitters) {
        arena_free(&memory);
        return call_memory_error(call, threads * sizeof *splitting.splitters, error);
    }
    for (size_t t = 0; t < threads; t++) {
        triangulator_start(&splitting.splitters[t].triangulator, call);
        arena_start(&splitting.splitters[t].large, call);
    }
    pool_run(source->pool, (polygons->count + TASK_POLYGONS - 1) / TASK_POLYGONS, split_polygons, &splitting);
    for (size_t t = 0; t < threads; t++) {
        triangulator_stop(&splitting.splitters[t].triangulator);
        arena_free(&splitting.splitters[t].large);
    }
    arena_free(&memory);
    if (!call_should_continue(call))
        return call_error(call, error);
    return !splitting.loop.out_of_memory || call_memory_error(call, polygons->items[0].count * sizeof(uint32_t), error);
}

bool mesh_add_object(struct lam_scene *scene, const lam_mesh *mesh, const char *name, lam_error *error)
{
    if (!mesh_items(mesh))
        return true;
    lam_object object = lam_object_default();
    object.name = name;
    object.mesh = scene_adopt_mesh(scene, mesh, error);
    return object.mesh >= 0 && scene_adopt_object(scene, &object, error) >= 0;
}
