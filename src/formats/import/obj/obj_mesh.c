// obj_mesh.c: builds the scene's mesh from the arrays that were read, and warns about faces.
#include "obj.h"

static void warn_faces(struct obj *obj)
{
    uint64_t faces = 0, numbers = 0;
    const uint8_t *face = NULL, *number = NULL;
    bool texcoords = false, normals = false;
    for (size_t c = 0; c < obj->chunk_count; c++) {
        const struct obj_chunk *chunk = &obj->chunks[c];
        faces += chunk->short_faces;
        numbers += chunk->nonfinite_numbers;
        face = face ? face : chunk->short_faces ? chunk->first_short_face : NULL;
        number = number ? number : chunk->nonfinite_numbers ? chunk->first_nonfinite : NULL;
        texcoords |= chunk->texcoord_unknown;
        normals |= chunk->normal_unknown;
    }
    const char *name = obj->source->name;
    if (faces)
        scene_warn(obj->scene, "%s:%zu: a face of fewer than three corners is ignored, the first of %llu", name,
                   obj_line_number(obj, face), (unsigned long long)faces);
    if (numbers)
        scene_warn(obj->scene, "%s:%zu: a texture coordinate that is not finite is set to 0, the first of %llu", name,
                   obj_line_number(obj, number), (unsigned long long)numbers);
    if (texcoords)
        scene_warn(obj->scene, "%s: faces or lines refer to texture coordinates, but the file contains none", name);
    if (normals)
        scene_warn(obj->scene,
                   "%s: faces refer to normals, but the file contains none; lambent computes smooth normals", name);
}

static bool add_mesh(struct obj *obj, lam_error *error)
{
    const struct obj_counts *total = &obj->total;
    lam_mesh mesh = {
        .name = obj->object_name,
        .origin = {obj->origin[0], obj->origin[1], obj->origin[2]},
        .positions = obj->positions,
        .vertex_count = (uint32_t)total->positions,
        .indices = obj->is_cloud ? NULL : obj->indices,
        .triangle_count = (uint32_t)total->triangles,
        .point_count = obj->is_cloud ? (uint32_t)total->positions : 0,
        .normals = obj->normals,
        .normal_count = (uint32_t)total->normals,
        .normal_indices = obj->normal_indices,
        .texcoords = obj->texcoords,
        .texcoord_count = (uint32_t)total->texcoords,
        .texcoord_indices = obj->texcoord_indices,
        .colors = obj->colors,
        .color_count = obj->colors ? (uint32_t)total->positions : 0,
        .colors_format = obj->colors ? LAM_COLORS_LINEAR_F32 : LAM_COLORS_NONE,
        .smoothing_groups = obj->smoothing_groups,
        .inner_edges = obj->inner_edges,
        .parts = obj->part_count ? obj->parts : NULL,
        .part_count = obj->part_count,
    };
    return mesh_add_object(obj->scene, &mesh, obj->object_name, error);
}

bool obj_complete(struct obj *obj, lam_error *error)
{
    call_progress(obj->source->call, 0.7, "read");
    // saved for lines, because obj_complete_texcoords drops the array if no face uses it
    const float *texcoords = obj->texcoords;
    struct mesh_polygons polygons = {
        .items = obj->polygons,
        .count = (size_t)obj->total.polygons,
        .positions = obj->positions,
        .corners = {obj->indices, obj->texcoord_indices, obj->normal_indices},
        .triangles = obj->total.triangles,
    };
    if (!mesh_triangulate(obj->source, obj->scene, &polygons, &obj->inner_edges, error) ||
        !obj_read_statements(obj, error) || !obj_complete_texcoords(obj, error))
        return false;
    obj_complete_normals(obj);
    warn_faces(obj);
    return add_mesh(obj, error) && obj_strokes_add(obj, texcoords, error);
}
