// obj_faces.c: completes the faces of an OBJ file after all vertices are read: adds missing normals and texture
// coordinates.
#include "obj.h"

#include "linear.h"
#include "normals.h"

#include <string.h>

// --- attributes that only some corners have

// Copies the `count` elements of an array to a new array with space for `more` further elements.
static float *grow(struct obj *obj, const float *array, size_t count, size_t more, size_t width, lam_error *error)
{
    float *larger = arena_array(&obj->scene->arena, count + more, width * sizeof *larger);
    if (!larger)
        return call_memory_error(obj->source->call, (count + more) * width * sizeof *larger, error), NULL;
    memcpy(larger, array, count * width * sizeof *larger);
    return larger;
}

// Sets missing texture coordinates of corners to (0, 0).
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

// Computes smooth normals for the triangles that have a corner without a normal, using only these triangles. Appends
// these normals to the normals of the file.
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
    if (!used || missing) { // scene_prepare computes all normals
        obj->normals = NULL;
        obj->normal_indices = NULL;
        obj->total.normals = 0;
    }
    return true;
}
