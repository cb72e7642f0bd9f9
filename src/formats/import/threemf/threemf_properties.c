// threemf_properties.c: reads property groups: base materials of the core, and colours, textures and composite
// materials of the materials extension 1.2 (multiproperties: threemf_layers.c; display properties: threemf_display.c).
// https://github.com/3MFConsortium/spec_materials
#include "threemf_model.h"

#include "fail.h"
#include "shown_name.h"

#ifdef HAVE_3MF

#include "number.h"
#include "texture_batch.h"

#include <lambent/material.h>

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

const float *threemf_color(const struct threemf_part *part, const struct threemf_resource *group, uint32_t index)
{
    return (const float *)part->colors.items + 4 * (size_t)(group->first + index);
}

bool properties_fault(struct threemf_xml *xml, const char *format, ...)
{
    struct model_reader *reader = reader_of(xml);
    char sentence[300], shown[SHOWN_NAME_SIZE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(sentence, sizeof sentence, format, arguments);
    va_end(arguments);
    if (!model_group(reader)->faulty)
        scene_warn(reader->file->scene, "%s: %s:%zu: %s; drawn without this group", reader->file->source->name,
                   shown_name(xml->part, shown), threemf_xml_line(xml), sentence);
    model_group(reader)->faulty = true;
    return true;
}

bool properties_start(struct threemf *file, struct threemf_part *part)
{
    lam_rgba neutral = lam_material_default().diffuse;
    return model_add_color(file, part, (float[]){1, 1, 1, 1}) &&
           model_add_color(file, part, (float[]){neutral.r, neutral.g, neutral.b, 1});
}

bool end_group(struct threemf_xml *xml)
{
    reader_of(xml)->group = -1;
    return true;
}

bool properties_take_color(struct threemf_xml *xml, const char *const *attributes, const char *name, float out[4])
{
    const char *text = threemf_attribute(attributes, name);
    char shown[SHOWN_NAME_SIZE];
    lam_rgba color;
    if (!text)
        return threemf_xml_fail(xml, "the attribute %s is missing", name);
    size_t digits = *text == '#' ? strspn(text + 1, "0123456789abcdefABCDEF") : 0;
    if ((digits != 6 && digits != 8) || text[1 + digits] ||
        !lam_color_parse(text, reader_of(xml)->file->source->params->color, &color, NULL))
        return threemf_xml_fail(xml, "found %s=\"%s\", expected a colour as #RRGGBB or #RRGGBBAA", name,
                                shown_name(text, shown));
    memcpy(out, (float[]){color.r, color.g, color.b, color.a}, 4 * sizeof *out);
    return true;
}

// --- base materials

bool begin_base_materials(struct threemf_xml *xml, const char *const *attributes)
{
    struct model_reader *reader = reader_of(xml);
    struct threemf_resource *group = model_add_resource(xml, attributes, RESOURCE_BASE);
    if (!group)
        return false;
    group->first = (uint32_t)reader->part->colors.count;
    group->material = reader->file->scene->materials.count;
    return threemf_take_number(xml, attributes, "displaypropertiesid", &reader->display, &reader->has_display);
}

bool begin_base(struct threemf_xml *xml, const char *const *attributes)
{
    struct model_reader *reader = reader_of(xml);
    struct threemf *file = reader->file;
    lam_material material = lam_material_default();
    const char *name = threemf_attribute(attributes, "name");
    float color[4] = {0};
    if (!properties_take_color(xml, attributes, "displaycolor", color) || !model_add_color(file, reader->part, color))
        return false;
    material.name = name && *name ? arena_string(&file->scene->arena, name) : NULL;
    if (name && *name && !material.name)
        return threemf_no_memory(file, strlen(name));
    material.diffuse = (lam_rgba){color[0], color[1], color[2], color[3]};
    material.ambient = (lam_rgb){color[0], color[1], color[2]};
    uint32_t index = model_group(reader)->count++;
    int added = scene_adopt_material(file->scene, &material, file->error);
    return added >= 0 && model_want_display(xml, attributes, added, index);
}

// --- colours

bool begin_color_group(struct threemf_xml *xml, const char *const *attributes)
{
    struct threemf_resource *group = model_add_resource(xml, attributes, RESOURCE_COLORS);
    if (group)
        group->first = (uint32_t)reader_of(xml)->part->colors.count;
    return group != NULL;
}

bool begin_color(struct threemf_xml *xml, const char *const *attributes)
{
    struct model_reader *reader = reader_of(xml);
    float color[4] = {0};
    if (!properties_take_color(xml, attributes, "color", color) || !model_add_color(reader->file, reader->part, color))
        return false;
    model_group(reader)->count++;
    return true;
}

// --- textures

static lam_wrap wrap_of(const char *const *attributes, const char *name)
{
    const char *style = threemf_attribute(attributes, name);
    return !style || strcmp(style, "wrap") == 0 ? LAM_WRAP_REPEAT
           : strcmp(style, "mirror") == 0       ? LAM_WRAP_MIRROR
                                                : LAM_WRAP_CLAMP;
}

// Decodes a picture of the package, unless a picture with the same contents was read before. The scene owns the texture.
// Warns and sets *out to NULL if the picture cannot be read.
static bool decode_picture(struct threemf *file, const char *path, lam_texture **out)
{
    char name[SHOWN_NAME_SIZE + 512], shown[SHOWN_NAME_SIZE];
    lam_error *error = file->error, reason = {0};
    bool raw = file->source->params->color == LAM_COLOR_RAW;
    struct texture_source source = {.values = raw ? LAM_TEXTURE_NUMBERS : LAM_TEXTURE_COLOR}, *found = NULL;
    snprintf(name, sizeof name, "%s: %s", file->source->name, shown_name(path, shown));
    file->error = &reason;
    bool read = threemf_package_read_whole(file, path, &source.bytes, &source.size), known = false;
    for (size_t i = 0; read && !known && i < file->pictures.count; i++) {
        found = (struct texture_source *)file->pictures.items + i;
        known = texture_source_order(found, &source) == 0;
    }
    if (!known && (found = read ? threemf_add(file, &file->pictures, sizeof *found) : NULL)) {
        *found = source;
        found->texture = texture_decode(source.bytes, source.size, name, source.values, file->source->call, &reason);
    }
    file->error = error;
    *out = found ? found->texture : NULL;
    if (known || *out)
        return known || scene_adopt_texture(file->scene, *out, error);
    if (!texture_is_optional(&reason)) {
        if (error)
            *error = reason;
        return false;
    }
    scene_warn(file->scene, "%s; drawn without it", reason.text);
    return true;
}

bool begin_texture(struct threemf_xml *xml, const char *const *attributes)
{
    struct model_reader *reader = reader_of(xml);
    struct threemf_resource *texture = model_add_resource(xml, attributes, RESOURCE_TEXTURE);
    const char *path = threemf_attribute(attributes, "path");
    const char *filter = threemf_attribute(attributes, "filter");
    lam_texture *picture;
    if (!texture)
        return false;
    if (!path || !*path)
        return threemf_xml_fail(xml, "the attribute path is missing");
    if (!decode_picture(reader->file, path, &picture))
        return false;
    lam_filter how = filter && strcmp(filter, "nearest") == 0 ? LAM_FILTER_NEAREST : LAM_FILTER_LINEAR;
    texture->map = (lam_texture_map){.texture = picture,
                                     .wrap_s = wrap_of(attributes, "tilestyleu"),
                                     .wrap_t = wrap_of(attributes, "tilestylev"),
                                     .magnify = how,
                                     .minify = how};
    return true;
}

// Returns a white material with the texture, or the default material if the texture's picture could not be read.
static int add_textured_material(struct threemf *file, const lam_texture_map *map)
{
    lam_material material = lam_material_default();
    lam_texture_map *copy = map->texture ? arena_alloc(&file->scene->arena, sizeof *copy) : NULL;
    if (copy) {
        *copy = *map;
        material.maps[LAM_MAP_DIFFUSE] = copy;
        material.diffuse = (lam_rgba){1, 1, 1, 1};
        material.ambient = (lam_rgb){1, 1, 1};
    } else if (map->texture)
        return threemf_no_memory(file, sizeof *copy), -1;
    return scene_adopt_material(file->scene, &material, file->error);
}

bool begin_texcoord_group(struct threemf_xml *xml, const char *const *attributes)
{
    struct model_reader *reader = reader_of(xml);
    struct threemf_resource *group = model_add_resource(xml, attributes, RESOURCE_TEXCOORDS);
    uint32_t id;
    if (!group || !threemf_take_number(xml, attributes, "texid", &id, NULL))
        return false;
    const struct threemf_resource *texture = threemf_resource_at(reader->part, (int32_t)id);
    if (!texture || texture->kind != RESOURCE_TEXTURE)
        return properties_fault(xml, "found texid=\"%u\", expected the id of a texture2d before it", id);
    group->first = (uint32_t)reader->part->texcoords.count;
    group->material = add_textured_material(reader->file, &texture->map);
    return group->material >= 0;
}

// The origin of 3MF's texture coordinates is the lower left corner.
bool begin_texcoord(struct threemf_xml *xml, const char *const *attributes)
{
    struct model_reader *reader = reader_of(xml);
    float *row = threemf_add(reader->file, &reader->part->texcoords, 2 * sizeof *row);
    if (!row || !threemf_take_float(xml, attributes, "u", &row[0]) ||
        !threemf_take_float(xml, attributes, "v", &row[1]))
        return false;
    for (int i = 0; i < 2; i++)
        row[i] = row[i] - row[i] == 0 ? row[i] : 0; // not finite
    row[1] = 1 - row[1];
    model_group(reader)->count++;
    return true;
}

// --- composite materials: weighted mixtures of base materials

bool begin_composites(struct threemf_xml *xml, const char *const *attributes)
{
    struct model_reader *reader = reader_of(xml);
    struct threemf_resource *group = model_add_resource(xml, attributes, RESOURCE_COLORS);
    const char *list = threemf_attribute(attributes, "matindices");
    uint32_t id;
    char shown[SHOWN_NAME_SIZE];
    if (!group || !threemf_take_number(xml, attributes, "matid", &id, NULL))
        return false;
    const struct threemf_resource *base = threemf_resource_at(reader->part, (int32_t)id);
    if (!base || base->kind != RESOURCE_BASE)
        return properties_fault(xml, "found matid=\"%u\", expected the id of basematerials before it", id);
    if (!list)
        return properties_fault(xml, "the attribute matindices is missing");
    group->first = (uint32_t)reader->part->colors.count;
    group->base = (int32_t)(base - (const struct threemf_resource *)reader->part->resources.items);
    reader->base_count = 0;
    for (const char *at = list; !model_at_end(at);)
        if (reader->base_count == LAYERS_MAX ||
            !model_next_number(&at, base->count, &reader->bases[reader->base_count++]))
            return properties_fault(xml, "found matindices=\"%s\", expected up to %d numbers below %u",
                                    shown_name(list, shown), LAYERS_MAX, base->count);
    return true;
}

bool begin_composite(struct threemf_xml *xml, const char *const *attributes)
{
    struct model_reader *reader = reader_of(xml);
    struct threemf_part *part = reader->part;
    const struct threemf_resource *group = model_group(reader), *base = model_resource(part, group->base);
    const char *list = threemf_attribute(attributes, "values");
    char shown[SHOWN_NAME_SIZE];
    float sum = 0, mixed[4] = {0};
    if (group->faulty)
        return true;
    const uint8_t *at = (const uint8_t *)list, *end = list ? at + strlen(list) : NULL;
    for (int i = 0; list && i < reader->base_count && !model_at_end((const char *)at); i++) {
        float share;
        at = number_float(at + strspn((const char *)at, " \t\r\n"), end, &share);
        if (!at || !(share >= 0 && share <= 1e6f))
            return properties_fault(xml, "found values=\"%s\", expected up to %d shares from 0 to 1",
                                    shown_name(list, shown), reader->base_count);
        const float *color = threemf_color(part, base, reader->bases[i]);
        for (int c = 0; c < 4; c++)
            mixed[c] += share * color[c];
        sum += share;
    }
    for (int c = 0; c < 4; c++)
        mixed[c] = sum > 0 ? mixed[c] / sum : 1;
    model_group(reader)->count++;
    return model_add_color(reader->file, part, mixed);
}

#endif
