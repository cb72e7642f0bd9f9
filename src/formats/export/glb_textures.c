// glb_textures.c: writes material maps: images as PNG in the buffer, samplers, transforms.
#include "glb.h"

#include "linear.h"
#include "texture_levels.h"

#include <string.h>

// Pictures with equal bytes are written once. Such duplicates exist because the importer reads a picture twice if
// materials use it both as colours and as numbers.
static bool is_same(const lam_texture *a, const lam_texture *b)
{
    if (a == b)
        return true;
    const struct texture_level *x = &a->levels[0], *y = &b->levels[0];
    return a->bytes && b->bytes && x->width == y->width && x->height == y->height && a->channels == b->channels &&
           memcmp(a->bytes, b->bytes, (size_t)x->width * (size_t)x->height * (size_t)a->channels) == 0;
}

// Returns the index of a texture's image, or −1 if the image cannot be written.
static int image_of(struct glb *glb, const lam_texture *texture)
{
    for (int i = 0; i < glb->pictures.count; i++) {
        const struct glb_image *image = (const struct glb_image *)glb->pictures.items + i;
        if (is_same(image->texture, texture))
            return image->index;
    }
    struct glb_image image = {texture, -1};
    lam_bytes png;
    if (export_texture(glb->e, texture, &png)) {
        int view = glb_add_view(glb, png.data, png.size, 0);
        json_t *object = json_pack("{s:i, s:s}", "bufferView", view, "mimeType", "image/png");
        lam_bytes_free(&png);
        image.index = glb_add(glb, glb->images, object);
    } else if (texture->bytes) {
        glb->failed = true;
    }
    glb->failed |= !glb_append(glb, &glb->pictures, &image, sizeof image);
    return image.index;
}

static int wrap_code(lam_wrap wrap) { return wrap == LAM_WRAP_CLAMP ? 33071 : wrap == LAM_WRAP_MIRROR ? 33648 : 10497; }

// Returns the index of the sampler, or −1 for the default sampler, which repeats the texture and filters between mip
// levels.
static int sampler_of(struct glb *glb, const lam_texture_map *map)
{
    static const int minify[2][3] = {{9987, 9985, 9729}, {9986, 9984, 9728}}; // indexed by filter (linear, nearest) and
                                                                              // by lam_mip
    if (!map->wrap_s && !map->wrap_t && !map->magnify && !map->minify && !map->mip)
        return -1;
    json_t *object =
        json_pack("{s:i, s:i, s:i, s:i}", "magFilter", map->magnify ? 9728 : 9729, "minFilter",
                  minify[map->minify][map->mip], "wrapS", wrap_code(map->wrap_s), "wrapT", wrap_code(map->wrap_t));
    for (size_t i = 0; i < json_array_size(glb->samplers); i++)
        if (json_equal(json_array_get(glb->samplers, i), object)) {
            json_decref(object);
            return (int)i;
        }
    return glb_add(glb, glb->samplers, object);
}

static int texture_of(struct glb *glb, const lam_texture_map *map, int image)
{
    json_t *object = json_pack("{s:i}", "source", image);
    int sampler = sampler_of(glb, map);
    if (sampler >= 0)
        glb_set(glb, object, "sampler", json_integer(sampler));
    for (size_t i = 0; i < json_array_size(glb->textures); i++)
        if (json_equal(json_array_get(glb->textures, i), object)) {
            json_decref(object);
            return (int)i;
        }
    return glb_add(glb, glb->textures, object);
}

// Writes KHR_texture_transform: the matrix (c·sx, s·sy, x; −s·sx, c·sy, y) as offset, rotation and scale.
static void put_transform(struct glb *glb, json_t *info, const lam_texture_map *map)
{
    double m[2][3];
    bool zero = true, plain;
    for (int i = 0; i < 6; i++) {
        m[i / 3][i % 3] = (double)map->transform[i / 3][i % 3];
        zero &= m[i / 3][i % 3] == 0;
    }
    plain = zero || (m[0][0] == 1 && m[0][1] == 0 && m[0][2] == 0 && m[1][0] == 0 && m[1][1] == 1 && m[1][2] == 0);
    if (plain)
        return;
    bool turned = m[0][1] != 0 || m[1][0] != 0;
    double scale[2] = {m[0][0], m[1][1]}, angle = 0;
    if (turned) {
        angle = math_atan2(-m[1][0], m[0][0]);
        scale[0] = math_sqrt(m[0][0] * m[0][0] + m[1][0] * m[1][0]);
        scale[1] = math_sin(angle) * m[0][1] + math_cos(angle) * m[1][1];
        double skew = math_cos(angle) * m[0][1] - math_sin(angle) * m[1][1];
        if (skew > 1e-5 || skew < -1e-5)
            export_lose(glb->e,
                        "skewed texture coordinates of maps are omitted: glTF supports only scales and rotations");
    }
    json_t *object = glb_extension(glb, info, "KHR_texture_transform");
    glb_set(glb, object, "offset", json_pack("[ff]", m[0][2], m[1][2]));
    glb_set(glb, object, "scale", json_pack("[ff]", scale[0], scale[1]));
    if (turned)
        glb_set(glb, object, "rotation", json_real(angle));
}

json_t *glb_texture(struct glb *glb, const lam_texture_map *map)
{
    int image = map ? image_of(glb, map->texture) : -1;
    if (image < 0)
        return NULL;
    json_t *info = json_pack("{s:i}", "index", texture_of(glb, map, image));
    if (map->texcoords)
        glb_set(glb, info, "texCoord", json_integer(map->texcoords));
    put_transform(glb, info, map);
    return info;
}
