// output.c: what a frame can show, by name, and the lights that it has.
#include "scene_internal.h"

#include <lambent/device.h>

static const char *const names[LAM_SHOW_COUNT] = {
    [LAM_SHOW_PICTURE] = "picture",   [LAM_SHOW_AMBIENT] = "ambient",   [LAM_SHOW_DIFFUSE] = "diffuse",
    [LAM_SHOW_SPECULAR] = "specular", [LAM_SHOW_EMISSION] = "emission", [LAM_SHOW_REFLECTION] = "reflection",
    [LAM_SHOW_LIGHT] = "light",       [LAM_SHOW_NORMALS] = "normals",   [LAM_SHOW_TANGENTS] = "tangents",
    [LAM_SHOW_DEPTH] = "depth",       [LAM_SHOW_N_L] = "n.l",           [LAM_SHOW_N_H] = "n.h",
    [LAM_SHOW_FACING] = "facing",     [LAM_SHOW_IDS] = "ids",           [LAM_SHOW_COVERAGE] = "coverage",
    [LAM_SHOW_OVERDRAW] = "overdraw", [LAM_SHOW_CLIPPED] = "clipped",
};

const char *lam_show_name(lam_show show) { return (unsigned)show < LAM_SHOW_COUNT ? names[show] : NULL; }

bool lam_show_is_light(lam_show show) { return (unsigned)show <= LAM_SHOW_LIGHT; }

int lam_draw_lights(const lam_scene *scene, lam_rig rig, lam_light *lights, int room)
{
    int count = lam_scene_light_count(scene);
    for (int i = 0; lights && i < count && i < room; i++)
        lights[i] = *lam_scene_light(scene, i);
    lam_light of_rig[LAM_RIG_LIGHTS_MAX];
    int more = lam_scene_rig_lights(scene, rig, of_rig);
    for (int i = 0; lights && i < more && count + i < room; i++)
        lights[count + i] = of_rig[i];
    return count + more;
}
