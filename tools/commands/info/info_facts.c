// info_facts.c: what both forms of the command `info` say of a model.
#include "info.h"

#include <string.h>

struct info_counts info_count(const lam_scene *scene)
{
    struct info_counts counts = {0};
    for (int i = 0; i < lam_scene_mesh_count(scene); i++) {
        const lam_mesh *mesh = lam_scene_mesh(scene, i);
        counts.parts += mesh->parts ? mesh->part_count : 1;
        counts.triangles += mesh->triangle_count;
        counts.vertices += mesh->vertex_count;
    }
    return counts;
}

const char *info_format(const lam_scene *scene)
{
    const char *format = lam_scene_format(scene);
    return *format ? format : "shape";
}

const char *info_unit(const lam_scene *scene) { return strcmp(info_format(scene), "gltf") == 0 ? "metre" : NULL; }

const char *info_material_kind(const lam_material *material)
{
    return material->unlit ? "unlit" : material->physical ? "metallic-roughness" : "classic";
}

const char *info_support(lam_extension_support support)
{
    switch (support) {
    case LAM_EXTENSION_READ:
        return "supported";
    case LAM_EXTENSION_NO_EFFECT:
        return "no effect";
    case LAM_EXTENSION_IGNORED:
        return "ignored";
    default:
        return "unknown";
    }
}

lam_rgb info_light_color(const lam_light *light, double *intensity)
{
    lam_rgb c = light->type == LAM_LIGHT_AMBIENT      ? light->ambient
                : light->type == LAM_LIGHT_HEMISPHERE ? light->sky
                                                      : light->diffuse;
    float largest = c.r > c.g ? c.r : c.g;
    largest = c.b > largest ? c.b : largest;
    *intensity = (double)largest;
    return largest > 0 ? (lam_rgb){c.r / largest, c.g / largest, c.b / largest} : c;
}
