// obj_faces.c: completes the faces of an OBJ file after all vertices are read: adds missing normals and texture
// coordinates.
#include "obj.h"

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
    if (!used || obj->is_cloud) { // a face of two corners may use them
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

void obj_complete_normals(struct obj *obj)
{
    bool used = false, missing = false;
    for (size_t c = 0; c < obj->chunk_count; c++) {
        used |= obj->chunks[c].normal_used;
        missing |= obj->chunks[c].normal_missing;
    }
    used &= !obj->is_cloud;
    obj->scene->normals_missing |= used && missing; // scene_repair computes these normals
    obj->normal_indices = used ? obj->normal_indices : NULL;
    if (!used && !(obj->is_cloud && obj->total.normals == obj->total.positions)) {
        if (obj->is_cloud && obj->total.normals)
            scene_warn(
                obj->scene, "%s: found %llu normals for %llu points, expected one for each point; they are ignored",
                obj->source->name, (unsigned long long)obj->total.normals, (unsigned long long)obj->total.positions);
        obj->normals = NULL;
        obj->total.normals = 0;
    }
}
