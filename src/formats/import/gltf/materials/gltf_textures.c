// gltf_textures.c: reads textures, samplers and images. Each material requests its maps while the material is read.
// Then the pictures of all maps are decoded in parallel.
#include "gltf_materials.h"

#include "gltf_data.h"
#include "gltf_json.h"

#include "codec.h"
#include "fail.h"
#include "linear.h"
#include "shown_name.h"
#include "texture_batch.h"
#include "webp_library.h"

#include <stdio.h>
#include <string.h>

// A picture of the file.
struct gltf_picture {
    bool wanted;
    struct texture_source source;
    struct file_bytes file; // the owner of the picture's bytes, unless they are in a buffer
};

struct gltf_map {
    struct gltf_map *next;
    struct gltf_map_request request;
    int picture; // index in gltf->pictures: 2 · image + values
    lam_texture_map map;
};

enum { VALUES = 2 };

bool gltf_textures_start(struct gltf *gltf)
{
    size_t images = gltf_list_size(gltf, "images"), materials = gltf_list_size(gltf, "materials");
    gltf->pictures = GLTF_ALLOC(gltf, VALUES * images, struct gltf_picture);
    gltf->texcoord_sets = arena_alloc_zeroed(gltf->scratch, (materials + 1) * sizeof *gltf->texcoord_sets);
    if (!gltf->pictures || !gltf->texcoord_sets)
        return gltf_no_memory(gltf, VALUES * images * sizeof *gltf->pictures);
    for (size_t i = 0; i < materials; i++)
        gltf->texcoord_sets[i][0] = gltf->texcoord_sets[i][1] = -1;
    return true;
}

// --- samplers

enum { NEAREST = 9728, LINEAR, NEAREST_MIPMAP_NEAREST = 9984, LINEAR_MIPMAP_NEAREST, NEAREST_MIPMAP_LINEAR };
enum { LINEAR_MIPMAP_LINEAR = 9987, CLAMP_TO_EDGE = 33071, MIRRORED_REPEAT = 33648, REPEAT = 10497 };

// Returns a number that must be in the list `allowed`, which begins with the default and ends with 0.
static int take_code(struct gltf *gltf, const struct place *place, const json_t *object, const char *key,
                     const int *allowed, const char *expected)
{
    const json_t *value = json_object_get(object, key);
    for (int i = 0; value && allowed[i]; i++)
        if (json_is_number(value) && json_number_value(value) == allowed[i])
            return allowed[i];
    if (value)
        gltf_note_wrong(gltf, KEY_OF(place, key), value, expected);
    return *allowed;
}

static lam_wrap wrap_of(int code)
{
    return code == CLAMP_TO_EDGE ? LAM_WRAP_CLAMP : code == MIRRORED_REPEAT ? LAM_WRAP_MIRROR : LAM_WRAP_REPEAT;
}

static void take_sampler(struct gltf *gltf, int index, lam_texture_map *map)
{
    static const int magnify[] = {LINEAR, NEAREST, 0}, wraps[] = {REPEAT, CLAMP_TO_EDGE, MIRRORED_REPEAT, 0};
    static const int minify[] = {LINEAR_MIPMAP_LINEAR,  NEAREST, LINEAR, NEAREST_MIPMAP_NEAREST, LINEAR_MIPMAP_NEAREST,
                                 NEAREST_MIPMAP_LINEAR, 0};
    if (index < 0)
        return; // without a sampler, the texture is repeated and filtered trilinearly
    const struct place *place = ELEMENT_OF(KEY_OF(NULL, "samplers"), (size_t)index);
    const json_t *object = gltf_list_item(gltf, "samplers", index);
    int large = take_code(gltf, place, object, "magFilter", magnify, "9728 (NEAREST) or 9729 (LINEAR)");
    int small = take_code(gltf, place, object, "minFilter", minify, "9728, 9729, or 9984 to 9987");
    int s = take_code(gltf, place, object, "wrapS", wraps, "33071, 33648 or 10497");
    int t = take_code(gltf, place, object, "wrapT", wraps, "33071, 33648 or 10497");
    map->wrap_s = wrap_of(s);
    map->wrap_t = wrap_of(t);
    map->magnify = large == NEAREST ? LAM_FILTER_NEAREST : LAM_FILTER_LINEAR;
    bool nearest = small == NEAREST || small == NEAREST_MIPMAP_NEAREST || small == NEAREST_MIPMAP_LINEAR;
    map->minify = nearest ? LAM_FILTER_NEAREST : LAM_FILTER_LINEAR;
    map->mip = small == NEAREST || small == LINEAR                                 ? LAM_MIP_NONE
               : small == NEAREST_MIPMAP_NEAREST || small == LINEAR_MIPMAP_NEAREST ? LAM_MIP_NEAREST
                                                                                   : LAM_MIP_LINEAR;
}

// --- pictures

// Returns the image of a texture. If AVIF or WebP can be decoded, this is the image of EXT_texture_avif or
// EXT_texture_webp; otherwise, it is the fallback image, or without one the WebP image. Returns −1 if there is none.
static int image_of(struct gltf *gltf, int texture)
{
    const struct place *place = ELEMENT_OF(KEY_OF(NULL, "textures"), (size_t)texture);
    const json_t *object = gltf_list_item(gltf, "textures", texture);
    int image = gltf_take_link(gltf, place, object, "source", "images");
    int avif_image = gltf_take_link(gltf, KEY_OF(KEY_OF(place, "extensions"), "EXT_texture_avif"),
                                    gltf_extension(object, "EXT_texture_avif"), "source", "images");
    int webp_image = gltf_take_link(gltf, KEY_OF(KEY_OF(place, "extensions"), "EXT_texture_webp"),
                                    gltf_extension(object, "EXT_texture_webp"), "source", "images");
    if (avif_image >= 0 && avif_is_installed())
        return avif_image;
    if (webp_image >= 0 && (image < 0 || webp_is_installed()))
        return webp_image;
    const char *format = gltf_extension(object, "KHR_texture_basisu") ? "KTX 2 (KHR_texture_basisu)"
                         : gltf_extension(object, "EXT_texture_avif") ? "AVIF (EXT_texture_avif)"
                         : gltf_extension(object, "MSFT_texture_dds") ? "DDS (MSFT_texture_dds)"
                                                                      : NULL;
    if (image < 0 && !json_object_get(object, "source") && format)
        gltf_note(gltf, place, "its only picture is %s, which this version cannot decode; drawn without it", format);
    else if (image < 0 && !json_object_get(object, "source"))
        gltf_note(gltf, place, "source is missing; drawn without this texture");
    return image;
}

// Returns the model's name followed by a position in the model, for messages. Returns NULL if memory runs out.
static const char *message_name(struct gltf *gltf, const char *place)
{
    size_t length = strlen(gltf->source->name) + strlen(place) + 3;
    char *name = arena_alloc(gltf->scratch, length);
    if (name)
        snprintf(name, length, "%s: %s", gltf->source->name, place);
    return name;
}

// Finds the bytes of a picture.
static bool find_bytes(struct gltf *gltf, int image, struct gltf_picture *picture)
{
    const struct place *place = ELEMENT_OF(KEY_OF(NULL, "images"), (size_t)image);
    const json_t *object = gltf_list_item(gltf, "images", image);
    const char *uri = NULL;
    char shown[SHOWN_NAME_SIZE], name[2 * SHOWN_NAME_SIZE + 64];
    int view = -1;
    bool embedded = !json_is_null(json_object_get(object, "bufferView"));
    if ((embedded && !gltf_take_index(gltf, place, object, "bufferView", "bufferViews", &view)) ||
        (view < 0 && !json_take_text(&gltf->json, place, object, "uri", &uri)))
        return false;
    bool is_file = uri && !gltf_is_data_uri(uri);
    snprintf(name, sizeof name, "images[%d]%s%s%s", image, is_file ? " (" : "", is_file ? shown_file(uri, shown) : "",
             is_file ? ")" : "");
    picture->source.name = message_name(gltf, name);
    if (!picture->source.name)
        return gltf_no_memory(gltf, sizeof name);
    if (view >= 0) {
        const struct gltf_view *bytes = gltf_view_at(gltf, view);
        if (!bytes)
            return false;
        picture->source.bytes = bytes->data;
        picture->source.size = bytes->size;
        return true;
    }
    if (!uri)
        return json_fail(&gltf->json, place, "found neither uri nor bufferView");
    if (!gltf_uri_read(gltf, KEY_OF(place, "uri"), uri, &picture->file))
        return false;
    picture->source.bytes = picture->file.data;
    picture->source.size = picture->file.size;
    return true;
}

// --- maps

// Reads KHR_texture_transform: offset, rotation, scale, and a set of texture coordinates that replaces the set of the
// textureInfo.
static void take_transform(struct gltf *gltf, const struct place *place, const json_t *info, size_t *set,
                           lam_texture_map *map)
{
    const json_t *object = gltf_extension(info, "KHR_texture_transform");
    const struct place *here = KEY_OF(KEY_OF(place, "extensions"), "KHR_texture_transform");
    double offset[2] = {0, 0}, scale[2] = {1, 1}, angle = 0;
    if (!object)
        return;
    gltf_take_numbers(gltf, here, object, "offset", 2, offset);
    gltf_take_numbers(gltf, here, object, "scale", 2, scale);
    gltf_take_factors(gltf, here, object, "rotation", 1, -1e6, 1e6, &angle);
    if (!gltf_take_whole(gltf, here, object, "texCoord", 0, 1000, set))
        gltf_forgive(gltf);
    double c = math_cos(angle), s = math_sin(angle);
    const double m[2][3] = {{c * scale[0], s * scale[1], offset[0]}, {-s * scale[0], c * scale[1], offset[1]}};
    for (int i = 0; i < 6; i++)
        map->transform[i / 3][i % 3] = (float)m[i / 3][i % 3];
    // A transform of zeros would mean the identity. A scale of 0 must show a single point of the picture, so a tiny
    // number is stored.
    if (scale[0] == 0 && scale[1] == 0)
        map->transform[0][0] = 1e-30f;
}

// Assigns the file's set `set` of texture coordinates to the first (0) or second (1) set of a material, and returns 0
// or 1. Returns −1 if the material already uses two other sets.
static int place_set(struct gltf *gltf, int material, size_t set)
{
    int *sets = gltf->texcoord_sets[material];
    for (int i = 0; i < 2; i++) {
        if (sets[i] < 0)
            sets[i] = (int)set;
        if (sets[i] == (int)set)
            return i;
    }
    return -1;
}

bool gltf_take_map(struct gltf *gltf, const struct place *place, const json_t *object, const char *key,
                   struct gltf_map_request request)
{
    const json_t *info = gltf_take_object(gltf, place, object, key);
    const struct place *here = KEY_OF(place, key);
    size_t set = 0;
    lam_texture_map map = {.channel = request.channel, .scale = request.scale, .offset = request.offset};
    if (!info)
        return true;
    int texture = gltf_take_link(gltf, here, info, "index", "textures");
    if (!json_object_get(info, "index"))
        gltf_note(gltf, here, "index is missing; drawn without this texture");
    if (!gltf_take_whole(gltf, here, info, "texCoord", 0, 1000, &set))
        gltf_forgive(gltf);
    take_transform(gltf, here, info, &set, &map);
    int image = texture < 0 ? -1 : image_of(gltf, texture);
    if (image < 0)
        return true;
    take_sampler(gltf,
                 gltf_take_link(gltf, ELEMENT_OF(KEY_OF(NULL, "textures"), (size_t)texture),
                                gltf_list_item(gltf, "textures", texture), "sampler", "samplers"),
                 &map);
    map.texcoords = place_set(gltf, request.material, set);
    if (map.texcoords < 0) {
        gltf_note(gltf, ELEMENT_OF(KEY_OF(NULL, "materials"), (size_t)request.material),
                  "its %s map is not drawn: it uses TEXCOORD_%zu, and other maps of the material use two other sets",
                  lam_map_name(request.slot), set);
        return true;
    }
    struct gltf_map *item = GLTF_ALLOC(gltf, 1, struct gltf_map);
    if (!item)
        return gltf_no_memory(gltf, sizeof *item);
    *item = (struct gltf_map){gltf->maps, request, VALUES * image + (int)request.values, map};
    gltf->maps = item;
    gltf->pictures[item->picture].wanted = true;
    return true;
}

int gltf_texcoord_set(const struct gltf *gltf, int32_t material, int which)
{
    int index = material - gltf->first_material;
    return material == gltf->default_material || index < 0 ? -1 : gltf->texcoord_sets[index][which];
}

// --- the end of the load

// Finds the bytes of the requested pictures. Fills `list` with the *count pictures that must be decoded.
static bool find_pictures(struct gltf *gltf, struct texture_source **list, size_t *count)
{
    bool raw = gltf->source->params->color == LAM_COLOR_RAW;
    for (size_t i = 0; i < VALUES * gltf_list_size(gltf, "images"); i++) {
        struct gltf_picture *picture = &gltf->pictures[i];
        if (!picture->wanted)
            continue;
        picture->source.values = raw ? LAM_TEXTURE_NUMBERS : (lam_texture_values)(i % VALUES);
        if (find_bytes(gltf, (int)(i / VALUES), picture))
            list[(*count)++] = &picture->source;
        else if (!gltf_forgive(gltf))
            return false;
        else
            picture->wanted = false;
    }
    return true;
}

// Sets a requested map in its material.
static bool add_map(struct gltf *gltf, const struct gltf_map *item)
{
    lam_texture *texture = gltf->pictures[item->picture].source.texture;
    lam_texture_map *map = arena_alloc(&gltf->scene->arena, sizeof *map);
    if (!map)
        return gltf_no_memory(gltf, sizeof *map);
    *map = item->map;
    map->texture = texture;
    gltf->file_images[item->picture / VALUES].textures[item->picture % VALUES] = texture;
    lam_material *materials = gltf->scene->materials.items;
    materials[gltf->first_material + item->request.material].maps[item->request.slot] = map;
    return scene_share_texture(gltf->scene, texture, gltf->json.error);
}

// Sets, in the materials, all maps whose pictures were read. Notes each content that could not be read.
static bool add_maps(struct gltf *gltf)
{
    for (size_t i = 0; i < VALUES * gltf_list_size(gltf, "images"); i++) {
        const struct texture_source *source = &gltf->pictures[i].source;
        if (!gltf->pictures[i].wanted || source->texture || source->first)
            continue;
        *gltf->json.error = source->error;
        if (!gltf_forgive(gltf))
            return false;
    }
    for (const struct gltf_map *item = gltf->maps; item; item = item->next)
        if (gltf->pictures[item->picture].source.texture && !add_map(gltf, item))
            return false;
    return true;
}

bool gltf_textures_finish(struct gltf *gltf)
{
    size_t images = gltf_list_size(gltf, "images"), count = 0;
    struct texture_source **list = GLTF_ALLOC(gltf, VALUES * images, struct texture_source *);
    if (!list)
        return gltf_no_memory(gltf, VALUES * images * sizeof *list);
    bool ok = find_pictures(gltf, list, &count);
    if (ok) {
        textures_decode(list, count, gltf->source->pool, gltf->source->call);
        ok = add_maps(gltf);
    }
    for (size_t i = 0; i < VALUES * images; i++) {
        file_release(&gltf->pictures[i].file);
        lam_texture_free(gltf->pictures[i].source.texture); // the scene keeps its own reference to the texture
    }
    return ok;
}
