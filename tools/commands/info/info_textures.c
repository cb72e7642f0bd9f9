// info_textures.c: lists the textures of a model's materials without duplicates, and the file's pictures that no
// material uses.
#include "info.h"

#include <stdlib.h>
#include <string.h>

#include <lambent/material.h>

#include "console.h"

static void add(struct info_textures *textures, const lam_texture *texture, const lam_file_image *image)
{
    textures->items[textures->count++] = (struct info_texture){.texture = texture, .image = image};
}

// Adds the textures that were made from the picture: one for colours, one for other values, or both. If no material
// uses the picture, adds the picture without a texture.
static void add_image(struct info_textures *textures, const lam_file_image *image)
{
    for (int values = 0; values < 2; values++)
        if (image->textures[values])
            add(textures, image->textures[values], image);
    if (!image->textures[0] && !image->textures[1])
        add(textures, NULL, image);
}

int info_texture_find(const struct info_textures *textures, const lam_texture *texture)
{
    for (int i = 0; texture && i < textures->count; i++)
        if (textures->items[i].texture == texture)
            return i;
    return -1;
}

bool info_textures_list(const lam_scene *scene, struct info_textures *textures, lam_error *error)
{
    const lam_file_info *file = lam_scene_file_info(scene);
    int materials = lam_scene_material_count(scene);
    size_t room = 2 * (size_t)file->image_count + (size_t)materials * LAM_MAP_COUNT + 1;
    *textures = (struct info_textures){.items = calloc(room, sizeof *textures->items)};
    if (!textures->items)
        return complain(error, LAM_MACHINE, "out of memory");
    for (int i = 0; i < file->image_count; i++)
        add_image(textures, &file->images[i]);
    for (int i = 0; i < materials; i++)
        for (int map = 0; map < LAM_MAP_COUNT; map++) {
            const lam_texture_map *read = lam_scene_material(scene, i)->maps[map];
            if (!read)
                continue;
            if (info_texture_find(textures, read->texture) < 0)
                add(textures, read->texture, NULL);
            for (int k = 0; k < textures->count; k++) // images with the same contents share a texture
                textures->items[k].slots |= textures->items[k].texture == read->texture ? 1u << map : 0;
        }
    return true;
}

const char *info_texture_file(const struct info_texture *texture, const char *model)
{
    const char *name = texture->image ? texture->image->file : lam_texture_name(texture->texture);
    const char *slash = strrchr(model, '/');
    size_t folder = slash ? (size_t)(slash + 1 - model) : 0;
    return name && !texture->image && strncmp(name, model, folder) == 0 ? name + folder : name;
}

const char *info_texture_format(const struct info_texture *texture)
{
    if (texture->image)
        return texture->image->format;
    const char *name = lam_texture_name(texture->texture), *point = NULL;
    for (; name && *name; name++)
        point = *name == '.' ? name + 1 : *name == '/' ? NULL : point;
    return point && *point ? point : NULL;
}

const char *info_color_space(const struct info_texture *texture)
{
    return !texture->texture ? NULL : lam_texture_values_of(texture->texture) == LAM_TEXTURE_COLOR ? "srgb" : "linear";
}
