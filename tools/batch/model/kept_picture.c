// kept_picture.c: keeps a picture in the record of a model: its width, height and pixels, as base64.
#include "kept_picture.h"

#include <stdlib.h>

#include "base64.h"
#include "output.h"

void kept_picture_store(json_t *record, const char *key, const lam_image *picture, int most)
{
    lam_image small = {0};
    lam_error error;
    size_t length;
    if (!shrink_bytes(picture, most, &small, &error))
        return;
    char *text = base64_encode(small.pixels, 4 * (size_t)small.width * (size_t)small.height, &length);
    if (text)
        json_object_set_new(record, key, json_pack("[iis]", small.width, small.height, text));
    free(text);
    lam_image_free(&small);
}

bool kept_picture_load(const json_t *record, const char *key, lam_image *picture)
{
    const json_t *value = json_object_get(record, key), *pixels = json_array_get(value, 2);
    size_t size, at;
    uint8_t *bytes = pixels ? base64_decode(json_string_value(pixels), json_string_length(pixels), &size, &at) : NULL;
    if (!bytes)
        return false;
    *picture = (lam_image){.width = (int)json_integer_value(json_array_get(value, 0)),
                           .height = (int)json_integer_value(json_array_get(value, 1)),
                           .owned = true,
                           .pixels = bytes};
    return size == 4 * (size_t)picture->width * (size_t)picture->height;
}
