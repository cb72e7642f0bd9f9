// info_facts.c: collects the facts about a model that both output formats of the command `info` print.
#include "info.h"

#include <lambent/light.h>
#include <lambent/material.h>

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

struct info_unit info_unit(const lam_scene *scene)
{
    static const struct info_unit units[] = {{"metre", "m", 1000},     {"millimetre", "mm", 1},
                                             {"centimetre", "cm", 10}, {"micrometre", "µm", 1e-3},
                                             {"inch", "in", 25.4},     {"foot", "ft", 304.8}};
    double millimetres = lam_scene_file_info(scene)->unit_m * 1000;
    for (size_t i = 0; millimetres > 0 && i < sizeof units / sizeof *units; i++)
        if (millimetres > 0.999 * units[i].millimetres && millimetres < 1.001 * units[i].millimetres)
            return units[i];
    return (struct info_unit){0};
}

const char *info_material_kind(const lam_material *material)
{
    return material->unlit ? "unlit" : material->physical ? "metallic-roughness" : "classic";
}

// Returns whether both formats print the field for every material.
static bool is_always_printed(const lam_field *field)
{
    static const size_t printed[] = {
        offsetof(lam_material, ambient),   offsetof(lam_material, diffuse),  offsetof(lam_material, diffuse.a),
        offsetof(lam_material, specular),  offsetof(lam_material, emission), offsetof(lam_material, shininess),
        offsetof(lam_material, physical),  offsetof(lam_material, unlit),    offsetof(lam_material, metallic),
        offsetof(lam_material, roughness),
    };
    for (size_t i = 0; i < sizeof printed / sizeof *printed; i++)
        if (field->offset == printed[i])
            return true;
    return false;
}

int info_changed_field(const lam_field *field, const lam_material *material, double numbers[4])
{
    if (is_always_printed(field))
        return 0;
    int count = lam_field_get_written(field, material, numbers);
    for (int i = 0; i < count; i++)
        if ((float)numbers[i] != (float)field->standard[i])
            return count;
    return 0;
}

const char *info_alpha_mode(const lam_material *material)
{
    return material->alpha_mode == LAM_ALPHA_MASK     ? "mask"
           : material->alpha_mode == LAM_ALPHA_OPAQUE ? "opaque"
                                                      : "blend";
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
