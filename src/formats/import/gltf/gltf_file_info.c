// gltf_file_info.c: collects information about the file: names, animation lengths, extensions. Values with a wrong type
// are treated as missing, because they do not affect the picture.
#include "gltf.h"

#include "gltf_json.h"

#include <string.h>

#define NEW(gltf, count, type) ((type *)arena_alloc_zeroed(&(gltf)->scene->arena, (size_t)(count) * sizeof(type)))

// Copies a string; *out is NULL if the key is missing or the string is empty. Returns false if memory runs out.
static bool take(struct gltf *gltf, const json_t *object, const char *key, const char **out)
{
    const char *text = json_string_value(json_object_get(object, key));
    *out = text && *text ? arena_string(&gltf->scene->arena, text) : NULL;
    return *out || !text || !*text;
}

static bool take_names(struct gltf *gltf, const json_t *list, const char *const **out, int *out_count)
{
    size_t count = json_array_size(list);
    const char **names = NEW(gltf, count, const char *);
    *out = names;
    *out_count = (int)count;
    for (size_t i = 0; names && i < count; i++)
        if (!take(gltf, json_array_get(list, i), "name", &names[i]))
            return false;
    return names;
}

// Returns the time of the last keyframe of a channel's sampler. glTF requires that the maximum of the input accessor
// states this time.
static double last_key(const struct gltf *gltf, const json_t *sampler)
{
    const json_t *accessors = json_object_get(gltf->root, "accessors"), *input = json_object_get(sampler, "input");
    double index = json_is_number(input) ? json_number_value(input) : -1;
    if (!(index >= 0 && index < (double)json_array_size(accessors)))
        return 0;
    const json_t *max = json_object_get(json_array_get(accessors, (size_t)index), "max");
    return json_number_value(json_array_get(max, 0));
}

static bool take_animations(struct gltf *gltf, lam_file_info *info)
{
    const json_t *list = json_object_get(gltf->root, "animations");
    size_t count = json_array_size(list);
    lam_file_animation *animations = NEW(gltf, count, lam_file_animation);
    info->animations = animations;
    info->animation_count = (int)count;
    for (size_t i = 0; animations && i < count; i++) {
        const json_t *object = json_array_get(list, i), *samplers = json_object_get(object, "samplers");
        animations[i].channel_count = (int)json_array_size(json_object_get(object, "channels"));
        for (size_t k = 0; k < json_array_size(samplers); k++) {
            double last = last_key(gltf, json_array_get(samplers, k));
            animations[i].length_s = last > animations[i].length_s ? last : animations[i].length_s;
        }
        if (!take(gltf, object, "name", &animations[i].name))
            return false;
    }
    return animations;
}

// Gets "png" from "image/png"; without a type, the file extension is used.
static bool take_format(struct gltf *gltf, const json_t *object, const lam_file_image *image, const char **out)
{
    const char *type = json_string_value(json_object_get(object, "mimeType")), *format = NULL;
    const char *uri = json_string_value(json_object_get(object, "uri"));
    if (!type && uri && strncmp(uri, "data:", 5) == 0)
        type = uri + 5;
    if (type && strncmp(type, "image/", 6) == 0)
        format = type + 6;
    else if (image->file)
        format = path_ending(image->file);
    size_t length = format ? strcspn(format, ";,") : 0;
    *out = length ? arena_string_of(&gltf->scene->arena, format, length) : NULL;
    return *out || !length;
}

static bool take_images(struct gltf *gltf, lam_file_info *info)
{
    const json_t *list = json_object_get(gltf->root, "images");
    size_t count = json_array_size(list);
    lam_file_image *images = NEW(gltf, count, lam_file_image);
    info->images = gltf->file_images = images;
    info->image_count = (int)count;
    for (size_t i = 0; images && i < count; i++) {
        const json_t *object = json_array_get(list, i);
        const char *uri = json_string_value(json_object_get(object, "uri"));
        bool embedded = !uri || strncmp(uri, "data:", 5) == 0 || json_object_get(object, "bufferView");
        if (!take(gltf, object, "name", &images[i].name) ||
            (!embedded && !take(gltf, object, "uri", &images[i].file)) ||
            !take_format(gltf, object, &images[i], &images[i].format))
            return false;
    }
    return images;
}

static bool holds(const json_t *list, const char *name)
{
    for (size_t i = 0; i < json_array_size(list); i++) {
        const char *other = json_string_value(json_array_get(list, i));
        if (other && strcmp(other, name) == 0)
            return true;
    }
    return false;
}

static bool take_extensions(struct gltf *gltf, lam_file_info *info)
{
    const json_t *lists[2] = {json_object_get(gltf->root, "extensionsUsed"),
                              json_object_get(gltf->root, "extensionsRequired")};
    lam_file_extension *extensions =
        NEW(gltf, json_array_size(lists[0]) + json_array_size(lists[1]), lam_file_extension);
    info->extensions = extensions;
    for (int which = 0; extensions && which < 2; which++) {
        for (size_t i = 0; i < json_array_size(lists[which]); i++) {
            const char *name = json_string_value(json_array_get(lists[which], i));
            if (!name || (which == 1 && holds(lists[0], name)))
                continue;
            lam_file_extension *extension = &extensions[info->extension_count++];
            *extension = (lam_file_extension){.name = arena_string(&gltf->scene->arena, name),
                                              .required = holds(lists[1], name),
                                              .support = gltf_extension_support(name)};
            if (!extension->name)
                return false;
        }
    }
    return extensions;
}

bool gltf_file_info_note(struct gltf *gltf)
{
    lam_file_info *info = &gltf->scene->file;
    info->unit_m = 1;
    const json_t *asset = json_object_get(gltf->root, "asset");
    const json_t *variants = json_object_get(gltf_extension(gltf->root, "KHR_materials_variants"), "variants");
    return (take(gltf, asset, "version", &info->version) && take(gltf, asset, "generator", &info->generator) &&
            take(gltf, asset, "copyright", &info->copyright) &&
            take_names(gltf, json_object_get(gltf->root, "scenes"), &info->scenes, &info->scene_count) &&
            take_names(gltf, variants, &info->variants, &info->variant_count) && take_animations(gltf, info) &&
            take_images(gltf, info) && take_extensions(gltf, info)) ||
           gltf_no_memory(gltf, 0);
}
