// threemf_properties.c: groups of properties: base materials of the core, and colours, textures, composite materials and multiproperties of the
// materials extension 1.2. https://github.com/3MFConsortium/spec_materials
#include "threemf_model.h"

#include "fail.h"
#include "shown_name.h"

#ifdef HAVE_3MF

#include "number.h"
#include "texture_levels.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static struct threemf_resource *resource_of(struct threemf_part *part, int32_t index)
{
    return (struct threemf_resource *)part->resources.items + index;
}
static struct threemf_resource *open_group(struct model_reader *reader)
{
    return resource_of(reader->part, reader->group);
}

const float *threemf_color(const struct threemf_part *part, const struct threemf_resource *group, uint32_t index)
{
    return (const float *)part->colors.items + 4 * (size_t)(group->first + index);
}

static bool add_color(struct threemf *file, struct threemf_part *part, const float color[4])
{
    float *row = threemf_add(file, &part->colors, 4 * sizeof *row);
    if (row)
        memcpy(row, color, 4 * sizeof *row);
    return row != NULL;
}

bool properties_fault(struct threemf_xml *xml, const char *format, ...)
{
    struct model_reader *reader = reader_of(xml);
    char sentence[300], shown[SHOWN_NAME_SIZE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(sentence, sizeof sentence, format, arguments);
    va_end(arguments);
    if (!open_group(reader)->faulty)
        scene_warn(reader->file->scene, "%s: %s:%zu: %s; drawn without this group", reader->file->source->name,
                   shown_name(xml->part, shown), threemf_xml_line(xml), sentence);
    open_group(reader)->faulty = true;
    return true;
}

bool properties_start(struct threemf *file, struct threemf_part *part)
{
    lam_rgba neutral = lam_material_default().diffuse;
    return add_color(file, part, (float[]){1, 1, 1, 1}) &&
           add_color(file, part, (float[]){neutral.r, neutral.g, neutral.b, 1});
}

bool end_group(struct threemf_xml *xml)
{
    reader_of(xml)->group = -1;
    return true;
}

// "#RRGGBB" or "#RRGGBBAA", sRGB.
static bool take_color(struct threemf_xml *xml, const char *const *attributes, const char *name, float out[4])
{
    const char *text = threemf_attribute(attributes, NS_NONE, name);
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
    return true;
}

bool begin_base(struct threemf_xml *xml, const char *const *attributes)
{
    struct model_reader *reader = reader_of(xml);
    struct threemf *file = reader->file;
    lam_material material = lam_material_default();
    const char *name = threemf_attribute(attributes, NS_NONE, "name");
    float color[4] = {0};
    if (!take_color(xml, attributes, "displaycolor", color) || !add_color(file, reader->part, color))
        return false;
    material.name = name && *name ? arena_string(&file->scene->arena, name) : NULL;
    if (name && *name && !material.name)
        return threemf_no_memory(file, strlen(name));
    material.diffuse = (lam_rgba){color[0], color[1], color[2], color[3]};
    material.ambient = (lam_rgb){color[0], color[1], color[2]};
    open_group(reader)->count++;
    return scene_adopt_material(file->scene, &material, file->error) >= 0;
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
    if (!take_color(xml, attributes, "color", color) || !add_color(reader->file, reader->part, color))
        return false;
    open_group(reader)->count++;
    return true;
}

// --- textures

static lam_wrap wrap_of(const char *const *attributes, const char *name)
{
    const char *style = threemf_attribute(attributes, NS_NONE, name);
    return !style || strcmp(style, "wrap") == 0 ? LAM_WRAP_REPEAT
           : strcmp(style, "mirror") == 0       ? LAM_WRAP_MIRROR
                                                : LAM_WRAP_CLAMP;
}

// Whether a load continues without a picture that could not be read.
static bool can_do_without(const lam_error *error)
{
    return error->code == LAM_CANNOT_READ || error->code == LAM_UNSUPPORTED || error->code == LAM_BAD_ARGUMENT;
}

// Decodes a picture of the package. The scene owns it. *out NULL: it could not be read, and a warning says so.
static bool decode_picture(struct threemf *file, const char *path, lam_texture **out)
{
    const uint8_t *bytes;
    size_t size;
    char name[SHOWN_NAME_SIZE + 512], shown[SHOWN_NAME_SIZE];
    lam_error *error = file->error, reason = {0};
    bool raw = file->source->params->color == LAM_COLOR_RAW;
    snprintf(name, sizeof name, "%s: %s", file->source->name, shown_name(path, shown));
    file->error = &reason;
    *out = NULL;
    if (threemf_package_read_whole(file, path, &bytes, &size))
        *out = texture_decode(bytes, size, name, raw ? LAM_TEXTURE_NUMBERS : LAM_TEXTURE_COLOR, file->source->call,
                              &reason);
    file->error = error;
    if (*out)
        return scene_adopt_texture(file->scene, *out, error);
    if (!can_do_without(&reason)) {
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
    const char *path = threemf_attribute(attributes, NS_NONE, "path");
    const char *filter = threemf_attribute(attributes, NS_NONE, "filter");
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

// A white material with the texture. The default, without it, if its picture could not be read.
static int add_textured_material(struct threemf *file, const lam_texture_map *map)
{
    lam_material material = lam_material_default();
    lam_texture_map *copy = map->texture ? arena_alloc(&file->scene->arena, sizeof *copy) : NULL;
    if (copy) {
        *copy = *map;
        material.maps[LAM_MAP_DIFFUSE] = copy;
        material.diffuse = (lam_rgba){1, 1, 1, 1};
        material.ambient = (lam_rgb){1, 1, 1};
    } else if (map->texture) {
        threemf_no_memory(file, sizeof *copy);
        return -1;
    }
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
    row[1] = 1 - row[1];
    open_group(reader)->count++;
    return true;
}

// --- lists of numbers in attributes

// Reads the next whole number below `limit` of a list. False: there is none.
static bool next_number(const char **at, uint32_t limit, uint32_t *out)
{
    uint64_t value = 0;
    const char *digits = *at + strspn(*at, " \t\r\n");
    const char *end = digits;
    while (*end >= '0' && *end <= '9' && value <= INT32_MAX)
        value = 10 * value + (uint64_t)(*end++ - '0');
    *at = end;
    *out = (uint32_t)value;
    return end > digits && value < limit && (!*end || strchr(" \t\r\n", *end));
}

static bool at_end(const char *at) { return !at[strspn(at, " \t\r\n")]; }

// --- composite materials: base materials mixed by shares

bool begin_composites(struct threemf_xml *xml, const char *const *attributes)
{
    struct model_reader *reader = reader_of(xml);
    struct threemf_resource *group = model_add_resource(xml, attributes, RESOURCE_COLORS);
    const char *list = threemf_attribute(attributes, NS_NONE, "matindices");
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
    for (const char *at = list; !at_end(at);)
        if (reader->base_count == LAYERS_MAX || !next_number(&at, base->count, &reader->bases[reader->base_count++]))
            return properties_fault(xml, "found matindices=\"%s\", expected up to %d numbers below %u",
                                    shown_name(list, shown), LAYERS_MAX, base->count);
    return true;
}

bool begin_composite(struct threemf_xml *xml, const char *const *attributes)
{
    struct model_reader *reader = reader_of(xml);
    struct threemf_part *part = reader->part;
    const struct threemf_resource *group = open_group(reader), *base = resource_of(part, group->base);
    const char *list = threemf_attribute(attributes, NS_NONE, "values");
    char shown[SHOWN_NAME_SIZE];
    float sum = 0, mixed[4] = {0};
    if (group->faulty)
        return true;
    const uint8_t *at = (const uint8_t *)list, *end = list ? at + strlen(list) : NULL;
    for (int i = 0; list && i < reader->base_count && !at_end((const char *)at); i++) {
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
    open_group(reader)->count++;
    return add_color(reader->file, part, mixed);
}

// --- multiproperties: layers of other groups

static bool take_layers(struct threemf_xml *xml, const char *list, struct threemf_layers *layers)
{
    struct threemf_part *part = reader_of(xml)->part;
    char shown[SHOWN_NAME_SIZE];
    for (const char *at = list; !at_end(at);) {
        uint32_t id;
        bool good = layers->count < LAYERS_MAX && next_number(&at, INT32_MAX, &id);
        const struct threemf_resource *group = good ? threemf_resource_at(part, (int32_t)id) : NULL;
        if (!group || group->kind == RESOURCE_OBJECT || group->kind == RESOURCE_TEXTURE ||
            group->kind == RESOURCE_MULTI)
            return properties_fault(xml, "found pids=\"%s\", expected ids of up to %d groups before it",
                                    shown_name(list, shown), LAYERS_MAX);
        layers->groups[layers->count++] = (int32_t)(group - (const struct threemf_resource *)part->resources.items);
    }
    return true;
}

bool begin_multis(struct threemf_xml *xml, const char *const *attributes)
{
    struct model_reader *reader = reader_of(xml);
    struct threemf_resource *group = model_add_resource(xml, attributes, RESOURCE_MULTI);
    const char *list = threemf_attribute(attributes, NS_NONE, "pids");
    const char *blend = threemf_attribute(attributes, NS_NONE, "blendmethods");
    if (!group)
        return false;
    if (!list)
        return properties_fault(xml, "the attribute pids is missing");
    struct threemf_layers *layers = arena_alloc_zeroed(reader->file->scratch, sizeof *layers);
    if (!layers)
        return threemf_no_memory(reader->file, sizeof *layers);
    if (!take_layers(xml, list, layers) || open_group(reader)->faulty)
        return open_group(reader)->faulty;
    // The methods of the second layer on.
    for (int i = 1; blend && i < layers->count && !at_end(blend); i++) {
        blend += strspn(blend, " \t\r\n");
        size_t length = strcspn(blend, " \t\r\n");
        layers->multiply[i] = length == 8 && memcmp(blend, "multiply", 8) == 0;
        blend += length;
    }
    int textures = 0;
    for (int i = 0; i < layers->count; i++) {
        const struct threemf_resource *layer = resource_of(reader->part, layers->groups[i]);
        if (layer->kind == RESOURCE_TEXCOORDS && !textures++)
            group->material = layer->material;
    }
    reader->file->layered_textures += textures > 1;
    group->first = (uint32_t)reader->part->pairs.count;
    group->layers = layers;
    return true;
}

static void blend_layer(float below[4], const float color[4], bool multiply)
{
    float alpha = color[3];
    for (int c = 0; c < 3; c++)
        below[c] = multiply ? below[c] * color[c] : below[c] + alpha * (color[c] - below[c]);
    below[3] = multiply ? below[3] * alpha : below[3] + alpha * (1 - below[3]);
}

// The colours of an element's layers become one, which multiplies the texture if there is one.
bool begin_multi(struct threemf_xml *xml, const char *const *attributes)
{
    struct model_reader *reader = reader_of(xml);
    struct threemf_part *part = reader->part;
    const struct threemf_resource *group = open_group(reader);
    const char *list = threemf_attribute(attributes, NS_NONE, "pindices"), *at = list ? list : "";
    char shown[SHOWN_NAME_SIZE];
    float color[4] = {1, 1, 1, 1};
    struct threemf_pair pair = {0};
    bool textured = false, colored = false;
    if (group->faulty)
        return true;
    for (int i = 0; i < group->layers->count; i++) {
        const struct threemf_resource *layer = resource_of(part, group->layers->groups[i]);
        uint32_t index = 0; // of layers that the list leaves out
        if (at_end(at) ? layer->count == 0 : !next_number(&at, layer->count, &index))
            return properties_fault(xml, "found pindices=\"%s\", expected the number of an element of each layer",
                                    shown_name(list ? list : "", shown));
        if (layer->kind == RESOURCE_TEXCOORDS && !textured) {
            pair.texcoord = layer->first + index;
            textured = true;
        } else if (layer->kind != RESOURCE_TEXCOORDS) {
            blend_layer(color, threemf_color(part, layer, index), i == 0 || textured || group->layers->multiply[i]);
            colored = true;
        }
    }
    struct threemf_pair *row = threemf_add(reader->file, &part->pairs, sizeof *row);
    if (!row || (colored && !add_color(reader->file, part, color)))
        return false;
    if (colored)
        pair.color = (uint32_t)part->colors.count - 1;
    *row = pair;
    open_group(reader)->count++;
    return true;
}

#endif
