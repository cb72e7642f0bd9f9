// output_names.c: names outputs and grounds, and lists the lights of a frame.
#include "scene_internal.h"

#include <lambent/device.h>
#include <lambent/light.h>

static const char *const names[LAM_OUTPUT_COUNT] = {
    [LAM_OUTPUT_PICTURE] = "picture",
    [LAM_OUTPUT_AMBIENT] = "ambient",
    [LAM_OUTPUT_DIFFUSE] = "diffuse",
    [LAM_OUTPUT_SPECULAR] = "specular",
    [LAM_OUTPUT_EMISSION] = "emission",
    [LAM_OUTPUT_REFLECTION] = "reflection",
    [LAM_OUTPUT_LIGHT] = "light",
    [LAM_OUTPUT_ENVIRONMENT] = "environment",
    [LAM_OUTPUT_NORMALS] = "normals",
    [LAM_OUTPUT_TANGENTS] = "tangents",
    [LAM_OUTPUT_DEPTH] = "depth",
    [LAM_OUTPUT_N_L] = "n.l",
    [LAM_OUTPUT_N_H] = "n.h",
    [LAM_OUTPUT_FACING] = "facing",
    [LAM_OUTPUT_IDS] = "ids",
    [LAM_OUTPUT_COVERAGE] = "coverage",
    [LAM_OUTPUT_OVERDRAW] = "overdraw",
    [LAM_OUTPUT_CLIPPED] = "clipped",
    [LAM_OUTPUT_BASE_COLOR] = "base-color",
    [LAM_OUTPUT_ROUGHNESS] = "roughness",
    [LAM_OUTPUT_METALLIC] = "metallic",
    [LAM_OUTPUT_OCCLUSION] = "occlusion",
    [LAM_OUTPUT_LOD] = "lod",
    [LAM_OUTPUT_AMBIENT_OCCLUSION] = "ao",
};

const char *lam_output_name(lam_output output) { return (unsigned)output < LAM_OUTPUT_COUNT ? names[output] : NULL; }

static const char *const ground_names[LAM_GROUND_COUNT] = {"off", "shadow", "checker", "color"};

const char *lam_ground_name(lam_ground ground)
{
    return (unsigned)ground < LAM_GROUND_COUNT ? ground_names[ground] : NULL;
}

bool lam_output_is_light(lam_output output)
{
    return (unsigned)output <= LAM_OUTPUT_LIGHT || output == LAM_OUTPUT_ENVIRONMENT;
}

int lam_draw_lights(const lam_scene *scene, lam_rig rig, bool ground, lam_light *lights, int capacity)
{
    int count = lam_scene_light_count(scene);
    for (int i = 0; lights && i < count && i < capacity; i++)
        lights[i] = *lam_scene_light(scene, i);
    lam_light rig_lights[LAM_RIG_LIGHTS_MAX];
    int rig_count = lam_scene_rig_lights(scene, rig, ground, rig_lights);
    for (int i = 0; lights && i < rig_count && count + i < capacity; i++)
        lights[count + i] = rig_lights[i];
    return count + rig_count;
}
