// threemf_layers.c: reads multiproperties of the materials extension, which combine elements of several groups as
// layers.
//
// Layers are mixed into one texture if each colour layer has the same colour in all elements, and all textures use the
// same coordinates. Otherwise, the layers become one colour per element, which multiplies the first texture.
#include "threemf_model.h"

#include "fail.h"
#include "shown_name.h"

#ifdef HAVE_3MF

#define LANES 4 // the four channels of a texel
#include "codec.h"
#include "encoding.h"
#include "texture_levels.h"

#include <lambent/material.h>

#include <string.h>

enum { WHITE }; // the index of each part's first colour

static bool take_layers(struct threemf_xml *xml, const char *list, struct threemf_layers *layers)
{
    struct threemf_part *part = reader_of(xml)->part;
    char shown[SHOWN_NAME_SIZE];
    for (const char *at = list; !model_at_end(at);) {
        uint32_t id;
        bool good = layers->count < LAYERS_MAX && model_next_number(&at, INT32_MAX, &id);
        const struct threemf_resource *group = good ? threemf_resource_at(part, (int32_t)id) : NULL;
        if (!group || group->kind == RESOURCE_OBJECT || group->kind == RESOURCE_TEXTURE ||
            group->kind == RESOURCE_MULTI || group->kind == RESOURCE_DISPLAY)
            return properties_fault(xml, "found pids=\"%s\", expected ids of up to %d groups before it",
                                    shown_name(list, shown), LAYERS_MAX);
        layers->groups[layers->count++] = (int32_t)(group - (const struct threemf_resource *)part->resources.items);
    }
    return true;
}

// Reads the blend methods of all layers except the first.
static void take_methods(const char *blend, struct threemf_layers *layers)
{
    for (int i = 1; blend && i < layers->count && !model_at_end(blend); i++) {
        blend += strspn(blend, " \t\r\n");
        size_t length = strcspn(blend, " \t\r\n");
        layers->multiply[i] = length == 8 && memcmp(blend, "multiply", 8) == 0;
        blend += length;
    }
}

bool begin_multis(struct threemf_xml *xml, const char *const *attributes)
{
    struct model_reader *reader = reader_of(xml);
    struct threemf_resource *group = model_add_resource(xml, attributes, RESOURCE_MULTI);
    const char *list = threemf_attribute(attributes, "pids");
    if (!group)
        return false;
    if (!list)
        return properties_fault(xml, "the attribute pids is missing");
    struct threemf_layers *layers = arena_alloc_zeroed(reader->file->scratch, sizeof *layers);
    if (!layers)
        return threemf_no_memory(reader->file, sizeof *layers);
    if (!take_layers(xml, list, layers) || model_group(reader)->faulty)
        return model_group(reader)->faulty;
    take_methods(threemf_attribute(attributes, "blendmethods"), layers);
    layers->texture = layers->base = -1;
    for (int i = 0; i < layers->count; i++) {
        const struct threemf_resource *layer = model_resource(reader->part, layers->groups[i]);
        bool is_texture = layer->kind == RESOURCE_TEXCOORDS;
        layers->texture_count += is_texture;
        if (is_texture && layers->texture < 0) {
            layers->texture = i;
            group->material = layer->material;
        }
    }
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

static const lam_texture_map *map_of(const struct threemf *file, const struct threemf_resource *layer)
{
    return lam_scene_material(file->scene, layer->material)
        ->maps[LAM_MAP_DIFFUSE]; // a NULL map means that the picture could not be read
}

// Checks whether the layers of the element have the same colours and texture coordinates as the first element's layers.
static void compare_with_first(struct threemf_part *part, struct threemf_layers *layers, const uint32_t *indices,
                               bool is_first)
{
    const float *texcoords = part->texcoords.items;
    uint32_t first_texcoord = 0;
    for (int i = 0; i < layers->count; i++) {
        const struct threemf_resource *layer = model_resource(part, layers->groups[i]);
        uint32_t element = layer->first + indices[i];
        if (layer->kind != RESOURCE_TEXCOORDS) {
            if (is_first)
                layers->colors[i] = element;
            layers->varies |=
                memcmp((const float *)part->colors.items + 4 * (size_t)element,
                       (const float *)part->colors.items + 4 * (size_t)layers->colors[i], 4 * sizeof(float)) != 0;
        } else if (i == layers->texture) {
            first_texcoord = element;
        } else {
            layers->varies |= memcmp(texcoords + 2 * (size_t)element, texcoords + 2 * (size_t)first_texcoord,
                                     2 * sizeof *texcoords) != 0;
        }
    }
}

// Reads an element of multiproperties: combines the colours of its layers into one colour. If there is a texture, this
// colour multiplies it.
bool begin_multi(struct threemf_xml *xml, const char *const *attributes)
{
    struct model_reader *reader = reader_of(xml);
    struct threemf_part *part = reader->part;
    const struct threemf_resource *group = model_group(reader);
    const char *list = threemf_attribute(attributes, "pindices"), *at = list ? list : "";
    char shown[SHOWN_NAME_SIZE];
    float color[4] = {1, 1, 1, 1};
    uint32_t indices[LAYERS_MAX] = {0}; // layers that the list omits use index 0
    if (group->faulty)
        return true;
    struct threemf_layers *layers = group->layers;
    for (int i = 0; i < layers->count; i++) {
        const struct threemf_resource *layer = model_resource(part, layers->groups[i]);
        bool is_texture = layer->kind == RESOURCE_TEXCOORDS;
        if (model_at_end(at) ? layer->count == 0 : !model_next_number(&at, layer->count, &indices[i]))
            return properties_fault(xml, "found pindices=\"%s\", expected the number of an element of each layer",
                                    shown_name(list ? list : "", shown));
        bool multiply = i == 0 || (layers->texture >= 0 && i > layers->texture) || layers->multiply[i];
        if (!is_texture)
            blend_layer(color, threemf_color(part, layer, indices[i]), multiply);
    }
    compare_with_first(part, layers, indices, group->count == 0);
    struct threemf_pair *row = threemf_add(reader->file, &part->pairs, sizeof *row);
    if (!row || (layers->texture_count < layers->count && !model_add_color(reader->file, part, color)))
        return false;
    if (layers->texture_count < layers->count)
        row->color = (uint32_t)part->colors.count - 1;
    if (layers->texture >= 0)
        row->texcoord = model_resource(part, layers->groups[layers->texture])->first + indices[layers->texture];
    model_group(reader)->count++;
    return true;
}

// --- mixing layers into one texture

struct mixed_layer {
    const lam_texture_map *map; // NULL means the layer is a colour
    texel color;
    bool multiply;
};

// Blends one texel as blend_layer does.
static texel blend_texel(texel below, texel color, bool multiply)
{
    texel mixed = below + color[3] * (color - below);
    mixed[3] = below[3] + color[3] * (1 - below[3]);
    return multiply ? below * color : mixed;
}

// Returns the mix of the layers at a texel of a picture of this size.
static texel mix_texel(const struct mixed_layer *layers, int count, int x, int y, int width, int height)
{
    texel out = {1, 1, 1, 1};
    for (int i = 0; i < count; i++) {
        const lam_texture_map *map = layers[i].map;
        texel color = layers[i].color;
        if (map && map->texture->levels[0].width == width && map->texture->levels[0].height == height) {
            color = texel_at(map->texture, 0, x, y);
        } else if (map) {
            lam_rgba sample = lam_texture_sample(map, (x + 0.5) / width, (y + 0.5) / height, 0);
            color = (texel){sample.r, sample.g, sample.b, sample.a};
        }
        out = blend_texel(out, color, i == 0 || layers[i].multiply);
    }
    return out;
}

// Mixes the layers texel by texel, at the size of the largest picture. The scene owns the texture.
static bool mix_texture(struct threemf *file, const struct mixed_layer *layers, int count, lam_texture **out)
{
    const struct picture_file picture = {NULL, 0, file->source->name, file->source->call};
    bool raw = file->source->params->color == LAM_COLOR_RAW;
    int width = 1, height = 1;
    lam_image image;
    for (int i = 0; i < count; i++) {
        const lam_texture *texture = layers[i].map ? layers[i].map->texture : NULL;
        width = texture && texture->levels[0].width > width ? texture->levels[0].width : width;
        height = texture && texture->levels[0].height > height ? texture->levels[0].height : height;
    }
    if (!picture_make(&picture, (uint32_t)width, (uint32_t)height, LAM_RGBA8, &image, file->error))
        return false;
    uint8_t *pixel = image.pixels;
    for (int y = 0; y < height; y++) {
        if (!picture_continues(&picture, y, file->error)) {
            picture_free(picture.call, &image);
            return false;
        }
        for (int x = 0; x < width; x++, pixel += 4) {
            texel mixed = mix_texel(layers, count, x, y, width, height);
            inum bytes = byte_of(raw ? mixed : srgb_encode(mixed));
            for (int c = 0; c < 3; c++)
                pixel[c] = (uint8_t)bytes[c];
            pixel[3] = (uint8_t)(mixed[3] * 255 + 0.5f);
        }
    }
    *out = texture_of_image(&image, raw ? LAM_TEXTURE_NUMBERS : LAM_TEXTURE_COLOR, NULL, picture.call, file->error);
    return *out && scene_adopt_texture(file->scene, *out, file->error);
}

// Returns whether multiplying the colours and the texture is exact: there is one texture, and no layer is blended with
// the layers below it.
static bool needs_no_mixing(const struct threemf_layers *layers)
{
    bool mixes = layers->texture_count > 1;
    for (int i = layers->texture > 0 ? layers->texture : 1; i < layers->count; i++)
        mixes |= !layers->multiply[i];
    return !mixes;
}

// Collects the layers of the group. Returns false if these layers cannot be mixed into one texture.
static bool collect_layers(struct model_reader *reader, const struct threemf_layers *layers, struct mixed_layer *out)
{
    const lam_texture_map *first = NULL;
    for (int i = 0; i < layers->count; i++) {
        const struct threemf_resource *layer = model_resource(reader->part, layers->groups[i]);
        out[i] = (struct mixed_layer){.multiply = layers->multiply[i]};
        if (layer->kind == RESOURCE_TEXCOORDS) {
            out[i].map = map_of(reader->file, layer);
            first = first ? first : out[i].map;
            if (!out[i].map || out[i].map->wrap_s != first->wrap_s || out[i].map->wrap_t != first->wrap_t)
                return false;
        } else {
            out[i].color =
                *(const texel_memory *)((const float *)reader->part->colors.items + 4 * (size_t)layers->colors[i]);
        }
    }
    return !layers->varies;
}

// Adds a material with the mixed texture. Copies the material's other fields from the base material `base`, or from the
// default material if `base` is −1.
static int add_mixed_material(struct threemf *file, const lam_texture_map *like, lam_texture *texture, int base)
{
    lam_material material = base >= 0 ? *lam_scene_material(file->scene, base) : lam_material_default();
    lam_texture_map *map = arena_alloc(&file->scene->arena, sizeof *map);
    if (!map)
        return threemf_no_memory(file, sizeof *map), -1;
    *map = *like;
    map->texture = texture;
    material.maps[LAM_MAP_DIFFUSE] = map;
    material.diffuse = (lam_rgba){1, 1, 1, 1};
    material.ambient = (lam_rgb){1, 1, 1};
    return scene_adopt_material(file->scene, &material, file->error);
}

bool end_multis(struct threemf_xml *xml)
{
    struct model_reader *reader = reader_of(xml);
    struct threemf *file = reader->file;
    struct threemf_resource *group = model_group(reader);
    struct threemf_layers *layers = group->layers;
    struct mixed_layer mixed[LAYERS_MAX];
    if (group->faulty || !layers || layers->texture < 0 || !group->count || needs_no_mixing(layers))
        return end_group(xml);
    if (!collect_layers(reader, layers, mixed)) {
        file->multiplied_layers++;
        return end_group(xml);
    }
    lam_texture *texture;
    if (!mix_texture(file, mixed, layers->count, &texture))
        return false;
    const struct threemf_resource *lowest = model_resource(reader->part, layers->groups[0]);
    if (lowest->kind == RESOURCE_BASE)
        layers->base = lowest->material + (int)(layers->colors[0] - lowest->first);
    group->material = add_mixed_material(file, mixed[layers->texture].map, texture, layers->base);
    struct threemf_pair *pairs = (struct threemf_pair *)reader->part->pairs.items + group->first;
    for (uint32_t i = 0; i < group->count; i++)
        pairs[i].color = WHITE;
    return group->material >= 0 && end_group(xml);
}

#endif
