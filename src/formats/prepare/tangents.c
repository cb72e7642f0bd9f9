// tangents.c: computes tangents of a scene's meshes with MikkTSpace.
#include "mikktspace.h"
#include "prepare.h"

#include "fail.h"
#include "float_state.h"

#include <lambent/material.h>

// Returns the first map of a material that uses tangents.
static const lam_texture_map *normal_map_at(const struct lam_scene *scene, int material)
{
    bool there = material >= 0 && material < scene->materials.count;
    if (!there)
        return NULL;
    const lam_material *m = (const lam_material *)scene->materials.items + material;
    return m->maps[LAM_MAP_NORMAL]             ? m->maps[LAM_MAP_NORMAL]
           : m->maps[LAM_MAP_CLEARCOAT_NORMAL] ? m->maps[LAM_MAP_CLEARCOAT_NORMAL]
                                               : m->maps[LAM_MAP_ANISOTROPY];
}

// Returns the first map that uses a mesh's tangents, or NULL if there is none. Searches the materials of the mesh's
// parts, then the materials of the mesh's objects.
static const lam_texture_map *normal_map_of(const struct lam_scene *scene, int mesh)
{
    const lam_mesh *m = scene_mesh(scene, mesh);
    const lam_texture_map *map = NULL;
    for (uint32_t i = 0; !map && i < m->part_count; i++)
        map = normal_map_at(scene, m->parts[i].material);
    for (int i = 0; !map && i < scene->objects.count; i++)
        if (scene_object(scene, i)->mesh == mesh)
            map = normal_map_at(scene, scene_object(scene, i)->material);
    return map;
}

// Tangents follow the texture coordinates after the map's transform, so that the slopes of a rotated or mirrored map
// still describe the same bumps. glTF says "the texture coordinates associated with the normal texture" (section
// 3.7.2.1), and does not say whether KHR_texture_transform applies. three.js and Khronos' sample renderer also use the
// transformed coordinates. `t_down` means that the second transformed coordinate grows downwards in the picture. A
// transform that only shifts and scales needs no new coordinates.
static bool transformed_texcoords(lam_mesh *seen, const lam_texture_map *map, struct arena *arena, bool *t_down)
{
    const float(*m)[3] = map->transform;
    bool given = false;
    for (int i = 0; i < 6; i++)
        given |= m[i / 3][i % 3] != 0;
    *t_down = true;
    if (!given)
        return true;
    if (m[0][0] > 0 && m[0][1] == 0 && m[1][0] == 0) {
        *t_down = m[1][1] > 0;
        return true;
    }
    float *out = arena_alloc(arena, (size_t)seen->texcoord_count * sizeof(float[2]));
    for (size_t i = 0; out && i < seen->texcoord_count; i++)
        for (int c = 0; c < 2; c++)
            out[2 * i + (size_t)c] = m[c][0] * seen->texcoords[2 * i] + m[c][1] * seen->texcoords[2 * i + 1] + m[c][2];
    seen->texcoords = out;
    return out != NULL;
}

// Computes the tangents of one mesh, for the texture coordinates of `map`, or for the first set of texture coordinates
// if `map` is NULL.
static bool make_tangents(struct lam_scene *scene, lam_mesh *mesh, const lam_texture_map *map,
                          struct call_control *call, lam_error *error)
{
    lam_mesh seen = *mesh;
    struct mesh_tangents made;
    if (map && map->texcoords == 1) {
        seen.texcoords = mesh->second_texcoords;
        seen.texcoord_count = mesh->second_texcoord_count;
        seen.texcoord_indices = mesh->second_texcoord_indices;
    }
    if (mesh->tangents || !seen.texcoords || !mesh->normals || !mesh->triangle_count)
        return true;
    bool t_down = false;
    if (map && !transformed_texcoords(&seen, map, &scene->arena, &t_down))
        return call_memory_error(call, (size_t)seen.texcoord_count * sizeof(float[2]), error);
    if (!mikktspace(&made, &seen, t_down, &scene->arena, call, error))
        return false;
    mesh->tangents = made.tangents;
    mesh->tangent_count = made.count;
    mesh->tangent_indices = made.indices;
    return true;
}

bool scene_needs_tangents(const struct lam_scene *scene)
{
    bool needed = false;
    for (int i = 0; !needed && i < scene->meshes.count; i++)
        needed = !scene_mesh(scene, i)->tangents && normal_map_of(scene, i);
    return needed;
}

bool scene_make_tangents(struct lam_scene *scene, bool all, struct call_control *call, lam_error *error)
{
    bool ok = true;
    for (int i = 0; ok && i < scene->meshes.count; i++) {
        lam_mesh *mesh = (lam_mesh *)scene->meshes.items + i;
        const lam_texture_map *map = normal_map_of(scene, i);
        ok = (!all && !map) || make_tangents(scene, mesh, map, call, error);
    }
    return ok;
}

bool lam_scene_make_tangents(lam_scene *scene, const lam_control *control, lam_error *error)
{
    if (!scene)
        return fail(error, LAM_BAD_ARGUMENT, "lam_scene_make_tangents: the scene is NULL");
    struct call_control call;
    call_start(&call, control);
    uint64_t state = float_state_enter();
    scene->arena.call = &call;
    bool ok = (scene->deferred_crease_rad <= 0 || scene_prepare(scene, LAM_NORMALS_FILE, 0, NULL, &call, error)) &&
              scene_make_tangents(scene, true, &call, error);
    scene_built(scene);
    float_state_leave(state);
    return ok;
}
