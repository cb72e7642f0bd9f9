// gltf_textures.c: reads textures, samplers and images. Each material requests its maps while the material is read.
// Then the pictures of all maps are decoded in parallel.
#include "gltf_textures.h"

#include "gltf_buffers.h"
#include "gltf_json.h"
#include "gltf_uri.h"

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

// Gets a number that must be in the list `allowed`, which ends with 0.
static bool take_code(struct gltf *gltf, const struct place *place, const json_t *object, const char *key,
                      const int *allowed, const char *expected, int *out)
{
    const json_t *value = json_object_get(object, key);
    if (!value)
        return true;
    for (; *allowed; allowed++)
        if (json_is_number(value) && json_number_value(value) == *allowed) {
            *out = *allowed;
            return true;
        }
    return json_unexpected(&gltf->json, KEY_OF(place, key), value, expected);
}

static lam_wrap wrap_of(int code)
{
    return code == CLAMP_TO_EDGE ? LAM_WRAP_CLAMP : code == MIRRORED_REPEAT ? LAM_WRAP_MIRROR : LAM_WRAP_REPEAT;
}

static bool take_sampler(struct gltf *gltf, int index, lam_texture_map *map)
{
    static const int magnify[] = {NEAREST, LINEAR, 0}, wraps[] = {REPEAT, CLAMP_TO_EDGE, MIRRORED_REPEAT, 0};
    static const int minify[] = {
        NEAREST, LINEAR, NEAREST_MIPMAP_NEAREST, LINEAR_MIPMAP_NEAREST, NEAREST_MIPMAP_LINEAR, LINEAR_MIPMAP_LINEAR, 0};
    if (index < 0)
        return true; // without a sampler, the texture is repeated and filtered trilinearly
    const struct place *place = ELEMENT_OF(KEY_OF(NULL, "samplers"), (size_t)index);
    const json_t *object = gltf_list_item(gltf, "samplers", index);
    int large = LINEAR, small = LINEAR_MIPMAP_LINEAR, s = REPEAT, t = REPEAT;
    if (!take_code(gltf, place, object, "magFilter", magnify, "9728 (NEAREST) or 9729 (LINEAR)", &large) ||
        !take_code(gltf, place, object, "minFilter", minify, "9728, 9729, or 9984 to 9987", &small) ||
        !take_code(gltf, place, object, "wrapS", wraps, "33071, 33648 or 10497", &s) ||
        !take_code(gltf, place, object, "wrapT", wraps, "33071, 33648 or 10497", &t))
        return false;
    map->wrap_s = wrap_of(s);
    map->wrap_t = wrap_of(t);
    map->magnify = large == NEAREST ? LAM_FILTER_NEAREST : LAM_FILTER_LINEAR;
    bool nearest = small == NEAREST || small == NEAREST_MIPMAP_NEAREST || small == NEAREST_MIPMAP_LINEAR;
    map->minify = nearest ? LAM_FILTER_NEAREST : LAM_FILTER_LINEAR;
    map->mip = small == NEAREST || small == LINEAR                                 ? LAM_MIP_NONE
               : small == NEAREST_MIPMAP_NEAREST || small == LINEAR_MIPMAP_NEAREST ? LAM_MIP_NEAREST
                                                                                   : LAM_MIP_LINEAR;
    return true;
}

// --- pictures

// Returns the image of a texture. If WebP can be decoded, or if there is no fallback image, this is the image of
// EXT_texture_webp; otherwise, it is the fallback image. Returns −1 on error.
static int image_of(struct gltf *gltf, int texture)
{
    const struct place *place = ELEMENT_OF(KEY_OF(NULL, "textures"), (size_t)texture);
    const json_t *object = gltf_list_item(gltf, "textures", texture);
    const json_t *webp = gltf_extension(object, "EXT_texture_webp");
    int image = -1, webp_image = -1;
    if (!gltf_take_index(gltf, place, object, "source", "images", &image) ||
        (webp && !gltf_take_index(gltf, KEY_OF(KEY_OF(place, "extensions"), "EXT_texture_webp"), webp, "source",
                                  "images", &webp_image)))
        return -1;
    if (webp_image >= 0 && (image < 0 || webp_is_installed()))
        image = webp_image;
    if (image < 0 && gltf_extension(object, "KHR_texture_basisu"))
        fail(gltf->json.error, LAM_UNSUPPORTED,
             "%s: textures[%d]: its only picture is KTX 2 (KHR_texture_basisu), which this version cannot decode",
             gltf->source->name, texture);
    else if (image < 0)
        json_fail(&gltf->json, place, "source is missing");
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
    if (!json_take_text(&gltf->json, place, object, "uri", &uri) ||
        !gltf_take_index(gltf, place, object, "bufferView", "bufferViews", &view))
        return false;
    bool is_file = uri && view < 0 && !gltf_is_data_uri(uri);
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
static bool take_transform(struct gltf *gltf, const struct place *place, const json_t *info, size_t *set,
                           lam_texture_map *map)
{
    const json_t *object = gltf_extension(info, "KHR_texture_transform");
    const struct place *here = KEY_OF(KEY_OF(place, "extensions"), "KHR_texture_transform");
    double offset[2] = {0, 0}, scale[2] = {1, 1}, angle = 0;
    if (!object)
        return true;
    if (!gltf_take_numbers(gltf, here, object, "offset", 2, offset) ||
        !gltf_take_numbers(gltf, here, object, "scale", 2, scale) ||
        !json_take_number(&gltf->json, here, object, "rotation", -1e6, 1e6, &angle) ||
        !gltf_take_whole(gltf, here, object, "texCoord", 0, 1000, set))
        return false;
    double c = math_cos(angle), s = math_sin(angle);
    const double m[2][3] = {{c * scale[0], s * scale[1], offset[0]}, {-s * scale[0], c * scale[1], offset[1]}};
    for (int i = 0; i < 6; i++)
        map->transform[i / 3][i % 3] = (float)m[i / 3][i % 3];
    // A transform of zeros would mean the identity. A scale of 0 must show a single point of the picture, so a tiny
    // number is stored.
    if (scale[0] == 0 && scale[1] == 0)
        map->transform[0][0] = 1e-30f;
    return true;
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
                   struct gltf_map_request request, bool *present)
{
    bool ok = true;
    const json_t *info = gltf_take_object(gltf, place, object, key, &ok);
    const struct place *here = KEY_OF(place, key);
    int texture = -1, sampler = -1;
    size_t set = 0;
    if (present)
        *present = info != NULL;
    if (!ok || !info)
        return ok;
    lam_texture_map map = {.channel = request.channel, .scale = request.scale, .offset = request.offset};
    if (!gltf_take_index(gltf, here, info, "index", "textures", &texture) ||
        !gltf_take_whole(gltf, here, info, "texCoord", 0, 1000, &set) || !take_transform(gltf, here, info, &set, &map))
        return false;
    if (texture < 0)
        return json_fail(&gltf->json, here, "index is missing");
    if (!gltf_take_index(gltf, ELEMENT_OF(KEY_OF(NULL, "textures"), (size_t)texture),
                         gltf_list_item(gltf, "textures", texture), "sampler", "samplers", &sampler) ||
        !take_sampler(gltf, sampler, &map))
        return false;
    int image = image_of(gltf, texture);
    if (image < 0)
        return false;
    map.texcoords = place_set(gltf, request.material, set);
    if (map.texcoords < 0) {
        scene_warn(gltf->scene,
                   "%s: materials[%d]: its %s map is not drawn: it uses a third set of texture coordinates",
                   gltf->source->name, request.material, lam_map_name(request.slot));
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
    lam_error *error = gltf->json.error, reason;
    bool raw = gltf->source->params->color == LAM_COLOR_RAW;
    for (size_t i = 0; i < VALUES * gltf_list_size(gltf, "images"); i++) {
        struct gltf_picture *picture = &gltf->pictures[i];
        if (!picture->wanted)
            continue;
        picture->source.values = raw ? LAM_TEXTURE_NUMBERS : (lam_texture_values)(i % VALUES);
        gltf->json.error = &reason;
        bool found = find_bytes(gltf, (int)(i / VALUES), picture);
        gltf->json.error = error;
        if (found) {
            list[(*count)++] = &picture->source;
        } else if (texture_is_optional(&reason)) {
            picture->source.error = reason;
        } else {
            *error = reason;
            return false;
        }
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

// Sets, in the materials, all maps whose pictures were read. Warns once for each content that could not be read.
static bool add_maps(struct gltf *gltf)
{
    for (size_t i = 0; i < VALUES * gltf_list_size(gltf, "images"); i++) {
        const struct texture_source *source = &gltf->pictures[i].source;
        if (!gltf->pictures[i].wanted || source->texture || source->first)
            continue;
        if (!texture_is_optional(&source->error)) {
            *gltf->json.error = source->error;
            return false;
        }
        scene_warn(gltf->scene, "%s; drawn without it", source->error.text);
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
