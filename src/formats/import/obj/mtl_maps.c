// mtl_maps.c: reads the maps of MTL materials: their options, and their pictures, which are decoded together.
#include "mtl_maps.h"

#include "companion.h"
#include "number.h"
#include "shown_name.h"
#include "text_cursor.h"
#include "texture_batch.h"

#include "fail.h"

#include <lambent/material.h>

#include <stdio.h>
#include <string.h>
#include <strings.h>

// A picture that one or more maps use, identified by its name, the folder of the material's file, and by whether its
// values are colours.
struct picture {
    const char *name, *folder;
    struct companion file;
    struct texture_source source;
};

struct pictures {
    const struct import_source *source;
    struct picture *items;
    size_t count;
    const struct mtl_set *set;
    const lam_material *materials; // of the scene
};

static bool is_color(int slot)
{
    return slot == LAM_MAP_AMBIENT || slot == LAM_MAP_DIFFUSE || slot == LAM_MAP_SPECULAR || slot == LAM_MAP_EMISSION;
}

static bool is_drawn(int slot) { return slot != LAM_MAP_DISPLACEMENT && slot != LAM_MAP_REFLECTION; }

// --- options

struct options {
    const uint8_t *at, *end;
    // For warnings: the material, and the option that is being read.
    struct lam_scene *scene;
    const char *file, *material, *option;
    int slot;
};

enum { OPTION_MAX = 1000000 }; // larger texture coordinates are too imprecise to select a texel

static void warn_option(const struct options *o, const char *found, const char *expected)
{
    char shown[SHOWN_NAME_SIZE];
    shown_name(o->material ? o->material : "", shown);
    scene_warn(o->scene, "%s: material '%s': option %s of its %s map is %s, expected %s; it is ignored", o->file, shown,
               o->option, lam_map_name((lam_map)o->slot), found, expected);
}

// Reads up to `most` numbers and returns their count.
static int take_numbers(struct options *o, float *out, int most)
{
    int count = 0;
    while (count < most && o->at < o->end) {
        const uint8_t *after = number_float(o->at, o->end, &out[count]);
        if (!after || after != text_skip_word(o->at, o->end))
            break;
        o->at = text_skip_white(after, o->end);
        count++;
    }
    return count;
}

// Reads numbers that affect the map. If one of the option's numbers is out of range, ignores all numbers of the option,
// with a warning.
static int take_checked(struct options *o, float *out, int most)
{
    float numbers[3];
    int count = take_numbers(o, numbers, most);
    for (int i = 0; i < count; i++)
        if (!(numbers[i] >= -OPTION_MAX && numbers[i] <= OPTION_MAX)) {
            char found[32];
            snprintf(found, sizeof found, "%g", (double)numbers[i]);
            warn_option(o, found, "numbers from -1000000 to 1000000");
            return 0;
        }
    memcpy(out, numbers, (size_t)count * sizeof *out);
    return count;
}

static bool take_word(struct options *o, const char *word)
{
    if (!text_is_word(o->at, o->end, word))
        return false;
    o->option = word;
    o->at = text_skip_white(text_skip_word(o->at, o->end), o->end);
    return true;
}

// Gets the channel of -imfchan; m, l and z are the matte (alpha), the luminance and the depth. Returns false for other
// letters.
static bool take_channel(struct options *o, int *channel)
{
    static const char letters[] = "rgbmlz";
    const char *found = o->at < o->end ? strchr(letters, *o->at | 32) : NULL;
    char text[TEXT_FOUND_SIZE];
    bool known = found && *found;
    if (known)
        *channel = found - letters < 4 ? (int)(found - letters) : 0;
    else
        warn_option(o, text_found(o->at, o->end, text), "r, g, b, m, l or z");
    o->at = text_skip_white(text_skip_word(o->at, o->end), o->end);
    return known;
}

// In MTL, t points up. The options -s and -o apply before t is flipped.
static void set_transform(lam_texture_map *map, const float scale[2], const float offset[2])
{
    const float m[2][3] = {{scale[0], 0, offset[0]}, {0, -scale[1], 1 - offset[1]}};
    memcpy(map->transform, m, sizeof m);
}

static lam_texture_map map_of(struct lam_scene *scene, const char *file, const lam_material *material, int slot,
                              bool *channel_given)
{
    const char *text = material->map_options[slot];
    const uint8_t *begin = (const uint8_t *)(text ? text : "");
    struct options o = {begin, begin + strlen((const char *)begin), scene, file, material->name, NULL, slot};
    float scale[3] = {1, 1, 1}, offset[3] = {0, 0, 0}, unused[3], range[2] = {0, 1}, bump = 1;
    lam_texture_map map = {0};
    o.at = text_skip_white(o.at, o.end);
    while (o.at < o.end) {
        if (take_word(&o, "-s")) {
            if (take_checked(&o, scale, 3) == 1)
                scale[1] = scale[0];
        } else if (take_word(&o, "-o")) {
            take_checked(&o, offset, 3);
        } else if (take_word(&o, "-mm")) {
            take_checked(&o, range, 2);
        } else if (take_word(&o, "-bm")) {
            take_checked(&o, &bump, 1);
        } else if (take_word(&o, "-clamp")) {
            map.wrap_s = map.wrap_t = take_word(&o, "on") ? LAM_WRAP_CLAMP : LAM_WRAP_REPEAT;
        } else if (take_word(&o, "-imfchan")) {
            *channel_given |= take_channel(&o, &map.channel);
        } else {
            o.at = text_skip_white(text_skip_word(o.at, o.end), o.end);
            take_numbers(&o, unused, 3);
        }
    }
    set_transform(&map, scale, offset);
    map.offset = range[0];
    map.scale = range[1] * bump;
    return map;
}

// --- pictures

static struct picture *picture_of(struct pictures *pictures, const lam_material *material, int slot)
{
    const struct mtl_folder *folders = pictures->set->folders.items;
    const char *name = material->map_names[slot], *folder = "";
    for (int i = 0; i < pictures->set->folders.count && folders[i].first <= material - pictures->materials; i++)
        folder = folders[i].folder;
    lam_texture_values values =
        is_color(slot) && pictures->source->params->color != LAM_COLOR_RAW ? LAM_TEXTURE_COLOR : LAM_TEXTURE_NUMBERS;
    for (size_t i = 0; i < pictures->count; i++)
        if (pictures->items[i].source.values == values && strcmp(pictures->items[i].name, name) == 0 &&
            strcmp(pictures->items[i].folder, folder) == 0)
            return &pictures->items[i];
    struct picture *picture = &pictures->items[pictures->count++];
    *picture = (struct picture){.name = name, .folder = folder, .source = {.values = values}};
    return picture;
}

// --- materials

// Returns whether the opacity map is the alpha of the diffuse map's picture.
static bool is_own_alpha(const lam_material *m)
{
    return m->map_names[LAM_MAP_OPACITY] && m->map_names[LAM_MAP_DIFFUSE] &&
           strcmp(m->map_names[LAM_MAP_OPACITY], m->map_names[LAM_MAP_DIFFUSE]) == 0;
}

static bool add_map(struct lam_scene *scene, const char *file, lam_material *material, int slot, lam_texture *texture,
                    lam_error *error)
{
    bool channel_given = false;
    lam_texture_map *map = arena_alloc(&scene->arena, sizeof *map);
    if (!map)
        return call_memory_error(scene->arena.call, sizeof *map, error);
    *map = map_of(scene, file, material, slot, &channel_given);
    map->texture = texture;
    // The opacity of a picture is its alpha, or its grey value if it has no alpha.
    if (slot == LAM_MAP_OPACITY && !channel_given)
        map->channel = texture->opaque ? 0 : 3;
    bool nothing = map->scale == 0 && map->offset == 0; // lam_texture_map interprets a scale of 0 as 1
    if (nothing || (slot == LAM_MAP_OPACITY && map->channel == 3 && is_own_alpha(material)))
        return true; // the alpha of the diffuse map is already used
    material->maps[slot] = map;
    if (slot == LAM_MAP_DIFFUSE && material->illum == 0 && !material->map_names[LAM_MAP_EMISSION])
        material->maps[LAM_MAP_EMISSION] = map; // unlit: the surface emits the map's colour
    return scene_share_texture(scene, texture, error);
}

// Visits all maps, to list their pictures or to set the maps in materials.
typedef bool map_fn(struct pictures *pictures, struct lam_scene *scene, lam_material *material, int slot,
                    lam_error *error);

static bool list_map(struct pictures *pictures, struct lam_scene *scene, lam_material *material, int slot,
                     lam_error *error)
{
    (void)scene, (void)error;
    picture_of(pictures, material, slot);
    return true;
}

static bool give_map(struct pictures *pictures, struct lam_scene *scene, lam_material *material, int slot,
                     lam_error *error)
{
    lam_texture *texture = picture_of(pictures, material, slot)->source.texture;
    return !texture || add_map(scene, pictures->source->name, material, slot, texture, error);
}

static bool for_each_map(struct pictures *pictures, struct lam_scene *scene, map_fn *run, lam_error *error)
{
    for (int i = 0; i < scene->materials.count; i++) {
        lam_material *material = (lam_material *)scene->materials.items + i;
        if (!call_should_continue(pictures->source->call)) // `run` looks through all pictures
            return call_error(pictures->source->call, error);
        for (int slot = 0; slot < LAM_MAP_COUNT; slot++)
            if (is_drawn(slot) && material->map_names[slot] && !run(pictures, scene, material, slot, error))
                return false;
    }
    return true;
}

static size_t count_maps(const struct lam_scene *scene)
{
    size_t count = 0;
    for (int i = 0; i < scene->materials.count; i++)
        for (int slot = 0; slot < LAM_MAP_COUNT; slot++)
            count += is_drawn(slot) && lam_scene_material(scene, i)->map_names[slot];
    return count;
}

// Opens the pictures. Fills `list` with the *count pictures that must be decoded.
static bool open_pictures(struct pictures *pictures, struct lam_scene *scene, struct arena *memory,
                          struct texture_source **list, size_t *count, lam_error *error)
{
    for (size_t i = 0; i < pictures->count; i++) {
        struct picture *picture = &pictures->items[i];
        struct texture_source *source = &picture->source;
        if (!call_should_continue(pictures->source->call))
            return call_error(pictures->source->call, error);
        bool noted = false; // the same name, with values of the other kind
        for (size_t k = 0; k < i; k++)
            noted |= strcmp(pictures->items[k].name, picture->name) == 0;
        if (companion_find(pictures->source, noted ? NULL : scene, picture->name, picture->folder, memory,
                           &picture->file, &source->error)) {
            source->bytes = picture->file.file.data;
            source->size = picture->file.file.size;
            source->name = picture->file.shown;
            list[(*count)++] = source;
        } else if (!texture_is_optional(&source->error)) {
            if (error)
                *error = source->error;
            return false;
        }
    }
    return true;
}

static bool check_pictures(const struct pictures *pictures, struct lam_scene *scene, lam_error *error)
{
    for (size_t i = 0; i < pictures->count; i++) {
        const struct texture_source *source = &pictures->items[i].source;
        if (source->texture || source->first)
            continue;
        if (!texture_is_optional(&source->error)) {
            if (error)
                *error = source->error;
            return false;
        }
        scene_warn(scene, "%s; drawn without this texture", source->error.text);
    }
    return true;
}

bool mtl_maps_read(const struct import_source *source, struct lam_scene *scene, const struct mtl_set *set,
                   struct arena *memory, lam_error *error)
{
    size_t most = count_maps(scene), count = 0;
    if (!most)
        return true;
    struct pictures pictures = {source, arena_array(memory, most, sizeof *pictures.items), 0, set,
                                scene->materials.items};
    struct texture_source **list = arena_array(memory, most, sizeof *list);
    if (!pictures.items || !list)
        return call_memory_error(source->call, most * sizeof *pictures.items, error);
    bool ok =
        for_each_map(&pictures, scene, list_map, error) && open_pictures(&pictures, scene, memory, list, &count, error);
    if (ok) {
        textures_decode(list, count, source->pool, source->call);
        ok = check_pictures(&pictures, scene, error) && for_each_map(&pictures, scene, give_map, error);
    }
    for (size_t i = 0; i < pictures.count; i++) {
        file_release(&pictures.items[i].file.file);
        lam_texture_free(pictures.items[i].source.texture);
    }
    return ok;
}
