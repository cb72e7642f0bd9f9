// threemf_display.c: reads display properties of the materials extension, which turn base materials into metals and
// dielectrics.
#include "threemf_model.h"

#include "fail.h"

#ifdef HAVE_3MF

#include <lambent/material.h>

#include <string.h>

// The surface that an element of display properties describes.
struct display {
    float metallic, roughness;
    bool specular; // `f0` is used instead of `metallic`
    float f0[4];
};

bool begin_display(struct threemf_xml *xml, const char *const *attributes)
{
    struct threemf_resource *group = model_add_resource(xml, attributes, RESOURCE_DISPLAY);
    if (group)
        group->first = (uint32_t)reader_of(xml)->displays.count;
    return group != NULL;
}

// Gets an optional number from 0 to 1. Warns and returns false if the number is out of range.
static bool take_share(struct threemf_xml *xml, const char *const *attributes, const char *name, float *out)
{
    if (!threemf_attribute(attributes, name))
        return true;
    if (!threemf_take_float(xml, attributes, name, out))
        return false;
    if (*out >= 0 && *out <= 1)
        return true;
    *out = *out > 0 ? 1 : 0;
    return properties_fault(xml, "%s is not a number from 0 to 1", name);
}

static bool add_display(struct threemf_xml *xml, const struct display *display)
{
    struct model_reader *reader = reader_of(xml);
    struct display *row = threemf_add(reader->file, &reader->displays, sizeof *row);
    if (row)
        *row = *display;
    model_group(reader)->count++;
    return row != NULL;
}

bool begin_metallic(struct threemf_xml *xml, const char *const *attributes)
{
    struct display display = {.metallic = 0, .roughness = 1};
    return take_share(xml, attributes, "metallicness", &display.metallic) &&
           take_share(xml, attributes, "roughness", &display.roughness) && add_display(xml, &display);
}

bool begin_specular(struct threemf_xml *xml, const char *const *attributes)
{
    static const char *const usual[] = {"specularcolor", "#383838", NULL};
    struct display display = {.specular = true};
    float glossiness = 0;
    if (!threemf_attribute(attributes, "specularcolor")
            ? !properties_take_color(xml, usual, "specularcolor", display.f0)
            : !properties_take_color(xml, attributes, "specularcolor", display.f0))
        return false;
    if (!take_share(xml, attributes, "glossiness", &glossiness))
        return false;
    display.roughness = 1 - glossiness;
    return add_display(xml, &display);
}

static void apply(const struct display *display, lam_material *material)
{
    material->physical = true;
    material->metallic = display->metallic;
    material->roughness = display->roughness;
    if (display->specular) { // a dielectric whose reflectance f0 is the specular colour, as in glTF
        material->ior = 0;
        material->f0_color = (lam_rgb){display->f0[0], display->f0[1], display->f0[2]};
        material->specular_glossiness = 1;
    }
}

void display_finish(struct model_reader *reader)
{
    const struct display_wish *wishes = reader->wishes.items;
    lam_material *materials = reader->file->scene->materials.items;
    for (size_t i = 0; i < reader->wishes.count; i++) {
        const struct threemf_resource *group = threemf_resource_at(reader->part, (int32_t)wishes[i].id);
        // Display properties that are translucent or use textures are ignored.
        if (group && group->kind == RESOURCE_DISPLAY && wishes[i].index < group->count)
            apply((const struct display *)reader->displays.items + group->first + wishes[i].index,
                  &materials[wishes[i].material]);
    }
    // Mixed layers over a base material use the surface properties of that material.
    for (size_t i = 0; i < reader->part->resources.count && reader->wishes.count; i++) {
        const struct threemf_resource *group = model_resource(reader->part, (int32_t)i);
        if (group->kind != RESOURCE_MULTI || !group->layers || group->layers->base < 0 || group->faulty)
            continue;
        lam_material *to = &materials[group->material];
        const lam_material before = *to;
        *to = materials[group->layers->base];
        to->diffuse = before.diffuse;
        to->ambient = before.ambient;
        memcpy(to->maps, before.maps, sizeof to->maps);
    }
}

#endif
