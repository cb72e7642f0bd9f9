// scene_normals.c: implements lam_scene_make_normals.
#include "scene_internal.h"

#include "fail.h"
#include "float_state.h"

bool lam_scene_make_normals(lam_scene *scene, lam_normals normals, double crease_angle_rad, int threads,
                            const lam_control *control, lam_error *error)
{
    if (!scene)
        return fail(error, LAM_BAD_ARGUMENT, "lam_scene_make_normals: the scene is NULL");
    if ((unsigned)normals > LAM_NORMALS_FACET)
        return fail(error, LAM_BAD_ARGUMENT, "lam_scene_make_normals: normals is %d, expected 0 to 2", normals);
    if (!(crease_angle_rad >= 0 && crease_angle_rad <= 3.15))
        return fail(error, LAM_BAD_ARGUMENT, "lam_scene_make_normals: the crease angle is %g, expected 0 to pi",
                    crease_angle_rad);
    struct pool *pool = pool_make(threads);
    if (!pool)
        return fail_memory(error, 0);
    struct call_control call;
    call_start(&call, control);
    uint64_t state = float_state_enter();
    scene->arena.call = &call;
    bool ok = scene_prepare(scene, normals, crease_angle_rad, pool, &call, error);
    scene_built(scene);
    float_state_leave(state);
    pool_free(pool);
    return ok;
}
