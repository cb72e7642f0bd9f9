// outputs.c: the table of outputs, the names of grounds, and the lights of a frame.
#include "outputs.h"
#include "scene_internal.h"

#include <lambent/device.h>
#include <lambent/light.h>

// clang-format off
const struct output_row output_rows[LAM_OUTPUT_COUNT] = {
    [LAM_OUTPUT_PICTURE] = {"picture", "the picture", .terms = TERMS_ALL},
    [LAM_OUTPUT_AMBIENT] = {"ambient", "the ambient term", .terms = TERM_AMBIENT},
    [LAM_OUTPUT_DIFFUSE] = {"diffuse", "the diffuse term of all lights; on physical materials, also the environment's diffuse light",
                            .terms = TERM_DIFFUSE},
    [LAM_OUTPUT_SPECULAR] = {"specular", "the highlights of all lights; on physical materials, also the environment's reflection",
                             .terms = TERM_SPECULAR},
    [LAM_OUTPUT_EMISSION] = {"emission", "the light that the surface emits", .terms = TERM_EMISSION},
    [LAM_OUTPUT_REFLECTION] = {"reflection", "the environment's reflection on classic materials", .terms = TERM_REFLECTION},
    [LAM_OUTPUT_LIGHT] = {"light", "the contribution of one light, given by its name or its number (the first light is 1)",
                          .terms = TERM_AMBIENT | TERM_DIFFUSE | TERM_SPECULAR, .one_light = true, .lit = true},
    [LAM_OUTPUT_NORMALS] = {"normals", "normals in eye space: (n + 1)/2", OUTPUT_VECTOR, CODE_SIGNED, .terms = TERMS_ALL},
    [LAM_OUTPUT_TANGENTS] = {"tangents", "tangents in eye space: (t + 1)/2", OUTPUT_VECTOR, CODE_SIGNED, .terms = TERMS_ALL,
                             .flag = "output_tangents"},
    [LAM_OUTPUT_DEPTH] = {"depth", "distance from the eye along the view direction: the nearest point is white, the farthest point black",
                          OUTPUT_GEOMETRY, CODE_DEPTH, .terms = TERMS_ALL, .flag = "output_depth"},
    [LAM_OUTPUT_N_L] = {"n.l", "cosine of the angle between the normal and the direction to the light: max(n.l, 0)",
                        OUTPUT_VECTOR, CODE_PLAIN, .terms = TERMS_ALL, .one_light = true, .flag = "output_n_l"},
    [LAM_OUTPUT_N_H] = {"n.h", "cosine of the angle between the normal and the half vector: max(n.h, 0)",
                        OUTPUT_VECTOR, CODE_PLAIN, .terms = TERMS_ALL, .one_light = true},
    [LAM_OUTPUT_FACING] = {"facing", "front faces are blue, back faces are red", OUTPUT_GEOMETRY, CODE_SIDES, .terms = TERMS_ALL, .flag = "output_facing"},
    [LAM_OUTPUT_IDS] = {"ids", "a colour for each triangle", OUTPUT_GEOMETRY, CODE_IDS, .terms = TERMS_ALL, .flag = "output_ids"},
    [LAM_OUTPUT_COVERAGE] = {"coverage", "the fraction of a pixel's samples that the model covers", OUTPUT_COUNT, CODE_PLAIN, .terms = TERMS_ALL},
    [LAM_OUTPUT_OVERDRAW] = {"overdraw", "c/(c + 3) for a pixel that c triangles cover", OUTPUT_COUNT, CODE_OVERDRAW, .terms = TERMS_ALL},
    [LAM_OUTPUT_CLIPPED] = {"clipped", "red if a channel of the picture is above 1, blue if a channel is below 0", OUTPUT_CLIPPED,
                            .terms = TERMS_ALL},
    [LAM_OUTPUT_BASE_COLOR] = {"base-color", "the base colour of a physical material, or the diffuse colour of a classic one, multiplied by "
                               "maps and vertex colours", OUTPUT_MATERIAL, CODE_COLOR, .terms = TERMS_ALL,
                               .flag = "shows_base_color"},
    [LAM_OUTPUT_ROUGHNESS] = {"roughness", "the roughness of physical materials", OUTPUT_MATERIAL, CODE_PLAIN, .terms = TERMS_ALL, .flag = "shows_roughness"},
    [LAM_OUTPUT_METALLIC] = {"metallic", "the metalness of physical materials", OUTPUT_MATERIAL, CODE_PLAIN, .terms = TERMS_ALL},
    [LAM_OUTPUT_OCCLUSION] = {"occlusion", "the value of the occlusion map", OUTPUT_MATERIAL, CODE_PLAIN, .terms = TERMS_ALL, .flag = "shows_occlusion"},
    [LAM_OUTPUT_LOD] = {"lod", "level of detail of the base colour map, divided by 10", OUTPUT_MATERIAL, CODE_LEVEL, .terms = TERMS_ALL},
    [LAM_OUTPUT_AMBIENT_OCCLUSION] = {"ao", "ambient occlusion: the fraction of surrounding light that reaches the point",
                                      OUTPUT_GEOMETRY, CODE_PLAIN, .terms = TERMS_ALL, .flag = "output_occlusion"},
    [LAM_OUTPUT_ENVIRONMENT] = {"environment", "the light that surfaces of all materials reflect from the environment",
                                .terms = TERM_DIFFUSE | TERM_SPECULAR | TERM_REFLECTION, .lit = true},
    [LAM_OUTPUT_NORMALS_WORLD] = {"normals-world", "normals in world space: (n + 1)/2", OUTPUT_VECTOR, CODE_SIGNED, .terms = TERMS_ALL,
                                  .drawn = LAM_OUTPUT_NORMALS},
    [LAM_OUTPUT_OBJECT_ID] = {"object-id", "labels: the number of the object, counted from 1", OUTPUT_GEOMETRY, CODE_LABEL, .terms = TERMS_ALL,
                              .drawn = LAM_OUTPUT_IDS},
    [LAM_OUTPUT_PART_ID] = {"part-id", "labels: the number of the part, counted from 1 over all objects", OUTPUT_GEOMETRY, CODE_LABEL,
                            .terms = TERMS_ALL, .drawn = LAM_OUTPUT_IDS},
};
// clang-format on

static const struct output_row *row_of(lam_output output)
{
    return (unsigned)output < LAM_OUTPUT_COUNT ? &output_rows[output] : NULL;
}

const char *lam_output_name(lam_output output) { return row_of(output) ? row_of(output)->name : NULL; }
const char *lam_output_summary(lam_output output) { return row_of(output) ? row_of(output)->summary : NULL; }
bool lam_output_is_light(lam_output output) { return row_of(output) && row_of(output)->kind == OUTPUT_LIGHT; }
bool lam_output_is_one_light(lam_output output) { return row_of(output) && row_of(output)->one_light; }

static const char *const ground_names[LAM_GROUND_COUNT] = {"off", "shadow", "checker", "color"};

const char *lam_ground_name(lam_ground ground)
{
    return (unsigned)ground < LAM_GROUND_COUNT ? ground_names[ground] : NULL;
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
