// mesh_build.c: splits polygons into triangles, converts vertex colours and adds meshes to the scene, for all formats.
#include "mesh_build.h"

#include "loop_status.h"
#include "parallel_rows.h"
#include "srgb.h"
#include "triangulate.h"

enum {
    TASK_POLYGONS = 1024,
    SMALL_POLYGON = 64,
    SPLIT_BYTES = 128, // memory for a corner of a large polygon while it is split
};

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

// Returns the polygon's first corner whose position is not finite, or `count` if there is none.
static uint32_t bad_corner(const struct mesh_polygons *polygons, size_t first, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        const float *p = polygons->positions + 3 * (size_t)polygons->corners[0][first + i];
        if ((p[0] - p[0]) + (p[1] - p[1]) + (p[2] - p[2]) != 0)
            return i;
    }
    return count;
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
    size_t first = 3 * (size_t)polygon.first_triangle, bad = bad_corner(splitting->polygons, first, count);
    for (int k = 0; k < 3 && bad < count; k++) {
        uint32_t *at = arrays[k] ? arrays[k] + first : NULL, one = at ? at[bad] : 0;
        for (uint32_t i = 0; at && i < corner_count; i++)
            at[i] = one;
    }
    if (bad < count)
        return true;
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
    // The memory of one thread with the largest polygon is counted, so that the number of threads does not decide whether
    // the call succeeds.
    size_t most = 0;
    for (size_t i = 0; i < polygons->count; i++)
        most = polygons->items[i].count > most ? polygons->items[i].count : most;
    most = most > SMALL_POLYGON ? most * SPLIT_BYTES : 0;
    if (!call_charge(call, most))
        return call_memory_error(call, most, error);
    call_refund(call, most);
    struct arena memory;
    arena_start(&memory, NULL);
    size_t threads = (size_t)pool_threads(source->pool);
    splitting.splitters = arena_array(&memory, threads, sizeof *splitting.splitters);
    if (!splitting.splitters) {
        arena_free(&memory);
        return call_memory_error(call, threads * sizeof *splitting.splitters, error);
    }
    for (size_t t = 0; t < threads; t++) {
        triangulator_start(&splitting.splitters[t].triangulator, call);
        arena_start(&splitting.splitters[t].large, NULL);
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

// --- colours

struct coloring {
    float *colors;
    size_t count;
    bool raw;
    float range[2]; // of red, green and blue, and of alpha
};

static bool convert_chunk(void *user, size_t index, lam_error *error)
{
    const struct coloring *coloring = user;
    size_t first, last;
    (void)error;
    parallel_rows_range(coloring->count, index, &first, &last);
    for (size_t i = 4 * first; i < 4 * last; i++) {
        bool alpha = i % 4 == 3;
        float c = coloring->colors[i] < 0 ? 1 : coloring->colors[i] / coloring->range[alpha];
        c = c > 1 ? 1 : c > 0 ? c : 0; // NaN becomes 0
        coloring->colors[i] = coloring->raw || alpha ? c : (float)srgb_linear((double)c);
    }
    return true;
}

bool mesh_convert_colors(const struct import_source *source, struct lam_scene *scene, float *colors, size_t count,
                         const struct color_range ranges[2], lam_error *error)
{
    struct coloring coloring = {.colors = colors, .count = count, .raw = source->params->color == LAM_COLOR_RAW};
    float largest[2] = {0, 0};
    size_t broken = 0;
    for (size_t i = 0; i < 4 * count; i++) {
        broken += !(colors[i] <= 65535);
        if (colors[i] > largest[i % 4 == 3] && colors[i] <= 65535)
            largest[i % 4 == 3] = colors[i];
    }
    if (broken)
        scene_warn(scene,
                   "%s: components of vertex colours that are negative, not numbers or above 65535 are limited (%zu)",
                   source->name, broken);
    for (int k = 0; k < 2; k++) {
        float most = largest[k], least = ranges[k].least, usual = ranges[k].usual;
        coloring.range[k] = usual == 0 ? 1 : most <= least ? least : most <= 255 ? 255 : usual > 255 ? usual : 65535;
        if (usual != 0 && coloring.range[k] != usual)
            scene_warn(scene, "%s: %s reach %g, so their range is taken as 0 to %g, not 0 to %g", source->name,
                       k ? "opacities of vertices" : "vertex colours", (double)most, (double)coloring.range[k],
                       (double)usual);
    }
    return parallel_rows_run(source, parallel_rows_count(count), convert_chunk, &coloring, error);
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
