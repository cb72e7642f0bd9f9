// tangents.c: tangents of a scene's meshes, by MikkTSpace.
#include "mikktspace.h"
#include "scene_internal.h"

#include "fail.h"
#include "float_state.h"

bool scene_mesh_tangents(struct lam_scene *scene, lam_mesh *mesh, bool t_down, struct call_control *call,
                         lam_error *error)
{
    struct mesh_tangents made;
    if (!mikktspace(&made, mesh, t_down, &scene->arena, call, error))
        return false;
    mesh->tangents = made.tangents;
    mesh->tangent_count = made.count;
    mesh->tangent_indices = made.indices;
    return true;
}

bool lam_scene_make_tangents(lam_scene *scene, const lam_control *control, lam_error *error)
{
    if (!scene)
        return fail(error, LAM_BAD_ARGUMENT, "lam_scene_make_tangents: the scene is NULL");
    struct call_control call;
    call_start(&call, control);
    uint64_t state = float_state_enter();
    scene->arena.call = &call;
    bool ok = scene->deferred_crease_rad <= 0 || scene_prepare(scene, LAM_NORMALS_FILE, 0, NULL, &call, error);
    for (int i = 0; ok && i < scene->meshes.count; i++) {
        lam_mesh *mesh = (lam_mesh *)scene->meshes.items + i;
        if (!mesh->tangents && mesh->texcoords && mesh->normals && mesh->triangle_count)
            ok = scene_mesh_tangents(scene, mesh, false, &call, error);
    }
    scene_built(scene);
    float_state_leave(state);
    return ok;
}
