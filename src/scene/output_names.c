// output.c: what a frame can show, by name, and the lights that it has.
#include "scene_internal.h"

#include <lambent/device.h>

static const char *const names[LAM_OUTPUT_COUNT] = {
    [LAM_OUTPUT_PICTURE] = "picture",   [LAM_OUTPUT_AMBIENT] = "ambient",   [LAM_OUTPUT_DIFFUSE] = "diffuse",
    [LAM_OUTPUT_SPECULAR] = "specular", [LAM_OUTPUT_EMISSION] = "emission", [LAM_OUTPUT_REFLECTION] = "reflection",
    [LAM_OUTPUT_LIGHT] = "light",       [LAM_OUTPUT_NORMALS] = "normals",   [LAM_OUTPUT_TANGENTS] = "tangents",
    [LAM_OUTPUT_DEPTH] = "depth",       [LAM_OUTPUT_N_L] = "n.l",           [LAM_OUTPUT_N_H] = "n.h",
    [LAM_OUTPUT_FACING] = "facing",     [LAM_OUTPUT_IDS] = "ids",           [LAM_OUTPUT_COVERAGE] = "coverage",
    [LAM_OUTPUT_OVERDRAW] = "overdraw", [LAM_OUTPUT_CLIPPED] = "clipped",
};

const char *lam_output_name(lam_output show) { return (unsigned)show < LAM_OUTPUT_COUNT ? names[show] : NULL; }

bool lam_output_is_light(lam_output show) { return (unsigned)show <= LAM_OUTPUT_LIGHT; }

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
