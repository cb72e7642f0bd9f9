// obj_faces.c: completes the faces of an OBJ file after all vertices are read: triangulates polygons, and adds missing
// normals and texture coordinates.
#include "obj.h"

#include "linear.h"
#include "normals.h"
#include "triangulate.h"

#include <string.h>

// --- polygons

struct triangulation {
    struct obj *obj;
    struct triangulator *triangulators; // one per thread
    struct arena *scratch;              // one per thread, for large polygons
    int failed;                         // atomic
};

enum { SMALL_POLYGON = 64 };

// Writes the polygon's corners to `at` in the order of its triangles. `corners` is a copy of the polygon at `at`.
static void reorder_corners(uint32_t *at, const uint32_t *corners, const uint32_t *triples, uint32_t corner_count)
{
    for (uint32_t i = 0; i < corner_count; i++)
        at[i] = corners[triples[i]];
}

static bool triangulate_polygon(struct triangulation *triangulation, struct obj_polygon polygon, int thread)
{
    struct obj *obj = triangulation->obj;
    uint32_t count = polygon.count, corner_count = 3 * (count - 2);
    uint32_t small_corners[SMALL_POLYGON], small_triples[3 * (SMALL_POLYGON - 2)];
    uint32_t *corners = small_corners, *triples = small_triples;
    if (count > SMALL_POLYGON) {
        struct arena *scratch = &triangulation->scratch[thread];
        arena_free(scratch);
        corners = arena_array(scratch, count, sizeof *corners);
        triples = arena_array(scratch, corner_count, sizeof *triples);
        if (!corners || !triples)
            return false;
    }
    size_t first = 3 * (size_t)polygon.first_triangle;
    memcpy(corners, obj->indices + first, count * sizeof *corners);
    if (!triangulate(&triangulation->triangulators[thread], obj->positions, corners, count, triples))
        return false;
    for (uint32_t i = 0; obj->inner_edges && i < count - 2; i++)
        obj->inner_edges[polygon.first_triangle + i] = triangulated_inner_edges(triples + 3 * (size_t)i, count);
    reorder_corners(obj->indices + first, corners, triples, corner_count);
    if (obj->texcoord_indices) {
        memcpy(corners, obj->texcoord_indices + first, count * sizeof *corners);
        reorder_corners(obj->texcoord_indices + first, corners, triples, corner_count);
    }
    if (obj->normal_indices) {
        memcpy(corners, obj->normal_indices + first, count * sizeof *corners);
        reorder_corners(obj->normal_indices + first, corners, triples, corner_count);
    }
    return true;
}

static void triangulate_piece(void *user, size_t index, int thread)
{
    struct triangulation *triangulation = user;
    struct obj *obj = triangulation->obj;
    uint64_t last = (index + 1) * OBJ_POLYGONS_PER_PIECE;
    if (last > obj->total.polygons)
        last = obj->total.polygons;
    if (!call_should_continue(obj->source->call))
        return;
    for (uint64_t i = index * OBJ_POLYGONS_PER_PIECE; i < last; i++) {
        if (__atomic_load_n(&triangulation->failed, __ATOMIC_RELAXED))
            return;
        if (!triangulate_polygon(triangulation, obj->polygons[i], thread))
            __atomic_store_n(&triangulation->failed, 1, __ATOMIC_RELAXED);
    }
}

bool obj_triangulate_polygons(struct obj *obj, lam_error *error)
{
    if (obj->total.polygons == 0)
        return true;
    struct call_control *call = obj->source->call;
    size_t threads = (size_t)pool_threads(obj->source->pool);
    struct triangulation triangulation = {.obj = obj};
    if (obj->source->params->polygon_edges) {
        obj->inner_edges = arena_alloc_zeroed(&obj->scene->arena, obj->total.triangles);
        if (!obj->inner_edges)
            return call_memory_error(call, (size_t)obj->total.triangles, error);
    }
    triangulation.triangulators = arena_array(&obj->memory, threads, sizeof *triangulation.triangulators);
    triangulation.scratch = arena_array(&obj->memory, threads, sizeof *triangulation.scratch);
    if (!triangulation.triangulators || !triangulation.scratch)
        return call_memory_error(call, threads * sizeof *triangulation.triangulators, error);
    for (size_t t = 0; t < threads; t++) {
        triangulator_start(&triangulation.triangulators[t], call);
        arena_start(&triangulation.scratch[t], call);
    }
    pool_run(obj->source->pool, (obj->total.polygons + OBJ_POLYGONS_PER_PIECE - 1) / OBJ_POLYGONS_PER_PIECE,
             triangulate_piece, &triangulation);
    for (size_t t = 0; t < threads; t++) {
        triangulator_stop(&triangulation.triangulators[t]);
        arena_free(&triangulation.scratch[t]);
    }
    if (!call_should_continue(call))
        return call_error(call, error);
    if (triangulation.failed)
        return call_memory_error(call, obj->polygons[0].count * sizeof(uint32_t), error);
    return true;
}

// --- attributes that only some corners have

// Copies the array and reserves space for `more` elements after its `count`.
static float *grow(struct obj *obj, const float *array, size_t count, size_t more, size_t width, lam_error *error)
{
    float *larger = arena_array(&obj->scene->arena, count + more, width * sizeof *larger);
    if (!larger) {
        call_memory_error(obj->source->call, (count + more) * width * sizeof *larger, error);
        return NULL;
    }
    memcpy(larger, array, count * width * sizeof *larger);
    return larger;
}

// Gives (0, 0) to corners without texture coordinates.
bool obj_complete_texcoords(struct obj *obj, lam_error *error)
{
    bool used = false, missing = false;
    for (size_t c = 0; c < obj->chunk_count; c++) {
        used |= obj->chunks[c].texcoord_used;
        missing |= obj->chunks[c].texcoord_missing;
    }
    if (!used) {
        obj->texcoords = NULL;
        obj->texcoord_indices = NULL;
        obj->total.texcoords = 0;
        return true;
    }
    if (!missing)
        return true;
    size_t count = (size_t)obj->total.texcoords;
    float *texcoords = grow(obj, obj->texcoords, count, 1, 2, error);
    if (!texcoords)
        return false;
    texcoords[2 * count] = texcoords[2 * count + 1] = 0;
    for (size_t i = 0; i < 3 * (size_t)obj->total.triangles; i++) {
        if (obj->texcoord_indices[i] == OBJ_MISSING)
            obj->texcoord_indices[i] = (uint32_t)count;
    }
    obj->texcoords = texcoords;
    obj->total.texcoords = count + 1;
    return true;
}

static bool lacks_normal(const uint32_t *corners)
{
    return corners[0] == OBJ_MISSING || corners[1] == OBJ_MISSING || corners[2] == OBJ_MISSING;
}

// Computes smooth normals for the triangles that have a corner without a normal, from these triangles only, and appends
// them to the file's normals.
static bool make_missing_normals(struct obj *obj, lam_error *error)
{
    const struct import_source *source = obj->source;
    size_t triangles = (size_t)obj->total.triangles, lacking = 0;
    for (size_t t = 0; t < triangles; t++)
        lacking += lacks_normal(obj->normal_indices + 3 * t);
    uint32_t *indices = arena_array(&obj->memory, 3 * lacking, sizeof *indices);
    uint32_t *groups = obj->smoothing_groups ? arena_array(&obj->memory, lacking, sizeof *groups) : NULL;
    if (!indices || (obj->smoothing_groups && !groups))
        return call_memory_error(source->call, 3 * lacking * sizeof *indices, error);
    for (size_t t = 0, to = 0; t < triangles; t++) {
        if (!lacks_normal(obj->normal_indices + 3 * t))
            continue;
        memcpy(indices + 3 * to, obj->indices + 3 * t, 3 * sizeof *indices);
        if (groups)
            groups[to] = obj->smoothing_groups[t];
        to++;
    }
    lam_mesh part = {
        .positions = obj->positions,
        .vertex_count = (uint32_t)obj->total.positions,
        .indices = indices,
        .triangle_count = (uint32_t)lacking,
        .smoothing_groups = groups,
    };
    double crease = source->params->crease_angle_rad;
    if (!normals_smooth(&part, crease > 0 ? crease : math_radians(40), &obj->memory, source->pool, source->call, error))
        return false;
    size_t own = (size_t)obj->total.normals;
    float *normals = grow(obj, obj->normals, own, part.normal_count, 3, error);
    if (!normals)
        return false;
    memcpy(normals + 3 * own, part.normals, (size_t)part.normal_count * 3 * sizeof *normals);
    for (size_t t = 0, from = 0; t < triangles; t++) {
        uint32_t *corners = obj->normal_indices + 3 * t;
        if (!lacks_normal(corners))
            continue;
        for (int c = 0; c < 3; c++) {
            if (corners[c] == OBJ_MISSING)
                corners[c] = (uint32_t)own + (part.normal_indices ? part.normal_indices[3 * from + (size_t)c]
                                                                  : (uint32_t)(3 * from + (size_t)c));
        }
        from++;
    }
    obj->normals = normals;
    obj->total.normals = own + part.normal_count;
    return true;
}

bool obj_complete_normals(struct obj *obj, lam_error *error)
{
    bool used = false, missing = false;
    for (size_t c = 0; c < obj->chunk_count; c++) {
        used |= obj->chunks[c].normal_used;
        missing |= obj->chunks[c].normal_missing;
    }
    if (used && missing && obj->source->params->normals == LAM_NORMALS_FILE)
        return make_missing_normals(obj, error);
    if (!used || missing) { // the scene computes all normals
        obj->normals = NULL;
        obj->normal_indices = NULL;
        obj->total.normals = 0;
    }
    return true;
}
