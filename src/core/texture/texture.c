// texture.c: makes textures from pictures: levels, reference counts.
#include "fail.h"
#include "float_state.h"
#include "pages.h"
#include "pixels.h"
#include "srgb.h"
#include "texture_levels.h"

#include <stdlib.h>
#include <string.h>

// --- memory

static int levels_of(int width, int height)
{
    int count = 1;
    for (int side = width > height ? width : height; side > 1; side /= 2)
        count++;
    return count;
}

static int side_of(int side, int level) { return side >> level ? side >> level : 1; }

// Levels whose total size is at least this many bytes are allocated in separate huge pages, whose first access is
// faster.
#define PAGES_FROM ((size_t)2 << 20)

// Allocates a texture of this size with all its levels, except level 0 if level 0 consists of bytes. Fails with
// LAM_LIMIT.
static struct lam_texture *allocate(const lam_image *image, int channels, const char *name, struct call_control *call,
                                    lam_error *error)
{
    bool floats = image->format == LAM_RGBA32F;
    int levels = levels_of(image->width, image->height);
    size_t name_bytes = name ? strlen(name) + 1 : 0, table = 512 * sizeof(float), texels = 0;
    for (int level = floats ? 0 : 1; level < levels; level++)
        texels += (size_t)side_of(image->width, level) * (size_t)side_of(image->height, level);
    size_t floats_bytes = (texels * (size_t)channels + 1) * sizeof(float);
    size_t own = sizeof(struct lam_texture) + table + name_bytes;
    bool large = floats_bytes >= PAGES_FROM;
    if (call && !call_charge(call, own + floats_bytes))
        return call_memory_error(call, own + floats_bytes, error), NULL;
    struct lam_texture *texture = calloc(1, large ? own : own + floats_bytes);
    size_t held = 0;
    float *pages = texture && large ? pages_get(floats_bytes, &held) : NULL;
    if (!texture || (large && !pages)) {
        if (call)
            call_refund(call, own + floats_bytes);
        free(texture);
        fail_memory(error, own + floats_bytes);
        return NULL;
    }
    float *decode = (float *)(texture + 1), *next = large ? pages : decode + 512;
    *texture = (struct lam_texture){
        .references = 1, .level_count = levels, .channels = channels, .decode = decode, .pages = pages, .held = held};
    for (int level = 0; level < levels; level++) {
        struct texture_level *l = &texture->levels[level];
        *l = (struct texture_level){side_of(image->width, level), side_of(image->height, level), NULL};
        if (level == 0 && !floats)
            continue;
        l->floats = next;
        next += (size_t)l->width * (size_t)l->height * (size_t)channels;
    }
    if (name)
        texture->name = memcpy(large ? decode + 512 : next + 1, name, name_bytes);
    return texture;
}

struct lam_texture *texture_share(const struct lam_texture *texture)
{
    struct lam_texture *shared = (struct lam_texture *)(uintptr_t)texture;
    if (shared)
        __atomic_add_fetch(&shared->references, 1, __ATOMIC_RELAXED);
    return shared;
}

void lam_texture_free(lam_texture *texture)
{
    if (!texture || __atomic_sub_fetch(&texture->references, 1, __ATOMIC_ACQ_REL))
        return;
    free(texture->storage);
    pages_free(texture->pages, texture->held);
    free(texture);
}

// --- level 0

static size_t pixels_of(const lam_image *image) { return (size_t)image->width * (size_t)image->height; }

// Removes the alpha channel from an 8-bit picture if all alpha values are 255. Without the alpha channel, the picture
// needs a quarter less memory.
static void drop_opaque_alpha(lam_image *image, struct call_control *call)
{
    uint8_t *bytes = image->pixels;
    size_t count = pixels_of(image);
    unsigned all = 255;
    for (size_t i = 0; i < count; i++)
        all &= bytes[4 * i + 3];
    if (all != 255)
        return;
    for (size_t i = 0; i < count; i++)
        memmove(bytes + 3 * i, bytes + 4 * i, 3);
    void *smaller = realloc(bytes, 3 * count);
    image->pixels = smaller ? smaller : bytes;
    image->format = LAM_RGB8;
    if (call)
        call_refund(call, count);
}

// Returns the number of channels that a picture's texels need, or 0 if a value is not finite.
static int count_channels(const lam_image *image, const char *name, lam_error *error)
{
    const float *pixel = image->pixels;
    bool ones = true;
    if (image->format != LAM_RGBA32F)
        return image->format == LAM_RGB8 ? 3 : 4;
    for (size_t i = 0; i < 4 * pixels_of(image); i++) {
        if (!(pixel[i] - pixel[i] == 0)) {
            fail(error, LAM_BAD_ARGUMENT, "%s: pixel %zu, %zu contains a number that is not finite",
                 name ? name : "texture", i / 4 % (size_t)image->width, i / 4 / (size_t)image->width);
            return 0;
        }
        ones &= i % 4 != 3 || pixel[i] == 1;
    }
    return ones ? 3 : 4;
}

static void take_bytes(struct lam_texture *texture, lam_image *image)
{
    float *decode = (float *)(uintptr_t)texture->decode;
    for (int i = 0; i < 256; i++) {
        decode[i] = (float)(texture->values == LAM_TEXTURE_COLOR ? srgb_linear(i / 255.0) : i / 255.0);
        decode[256 + i] = (float)(i / 255.0);
    }
    texture->bytes = image->pixels;
    texture->storage = image->pixels;
    texture->opaque = texture->channels == 3;
    *image = (lam_image){0};
}

static void take_floats(struct lam_texture *texture, const lam_image *image)
{
    float *to = (float *)(uintptr_t)texture->levels[0].floats;
    const float *from = image->pixels;
    size_t channels = (size_t)texture->channels;
    texture->opaque = true;
    for (size_t i = 0; i < pixels_of(image); i++, from += 4, to += channels) {
        memcpy(to, from, channels * sizeof *to);
        texture->opaque &= from[3] >= 1;
    }
}

struct lam_texture *texture_of_image(lam_image *image, lam_texture_values values, const char *name,
                                     struct call_control *call, lam_error *error)
{
    struct lam_texture *texture = NULL;
    if (image->format == LAM_RGBA8)
        drop_opaque_alpha(image, call);
    int channels = 0;
    if (image->width > TEXTURE_SIDE_MAX || image->height > TEXTURE_SIDE_MAX)
        fail(error, LAM_LIMIT, "%s: %d×%d pixels, expected at most %d on a side", name ? name : "texture", image->width,
             image->height, TEXTURE_SIDE_MAX);
    else
        channels = count_channels(image, name, error);
    if (channels)
        texture = allocate(image, channels, name, call, error);
    if (texture) {
        texture->values = values;
        if (image->format == LAM_RGBA32F)
            take_floats(texture, image);
        else
            take_bytes(texture, image);
        mipmaps_make(texture);
    }
    if (image->pixels && call)
        call_refund(call, pixels_of(image) * pixel_bytes(image->format));
    lam_image_free(image);
    return texture;
}

void texture_unpremultiply(lam_image *image)
{
    float *pixel = image->pixels;
    for (size_t i = 0; i < (size_t)image->width * (size_t)image->height; i++, pixel += 4)
        for (int channel = 0; channel < 3 && pixel[3] > 0 && pixel[3] < 1; channel++)
            pixel[channel] /= pixel[3];
}

// --- public functions

static bool check_values(lam_texture_values values, lam_error *error)
{
    return (unsigned)values <= LAM_TEXTURE_NUMBERS ||
           fail(error, LAM_BAD_ARGUMENT, "texture: values %d is not one of lam_texture_values", (int)values);
}

lam_texture *lam_texture_make(const lam_image *image, lam_texture_values values, const char *name, lam_error *error)
{
    lam_image copy;
    if (!check_values(values, error) || !image_check(image, "texture", error) || !image_copy(image, &copy, error))
        return NULL;
    uint64_t state = float_state_enter();
    if (copy.format == LAM_RGBA32F)
        texture_unpremultiply(&copy);
    struct lam_texture *texture = texture_of_image(&copy, values, name, NULL, error);
    float_state_leave(state);
    return texture;
}

static const struct texture_level *level_of(const lam_texture *texture, int level)
{
    return texture && level >= 0 && level < texture->level_count ? &texture->levels[level] : NULL;
}

int lam_texture_width(const lam_texture *texture, int level)
{
    return level_of(texture, level) ? texture->levels[level].width : 0;
}

int lam_texture_height(const lam_texture *texture, int level)
{
    return level_of(texture, level) ? texture->levels[level].height : 0;
}

int lam_texture_levels(const lam_texture *texture) { return texture ? texture->level_count : 0; }

lam_texture_values lam_texture_values_of(const lam_texture *texture)
{
    return texture ? texture->values : LAM_TEXTURE_COLOR;
}

uint64_t lam_texture_memory(const lam_texture *texture)
{
    uint64_t bytes = 0;
    for (int i = 0; texture && i < texture->level_count; i++)
        bytes += (uint64_t)texture->levels[i].width * (uint64_t)texture->levels[i].height *
                 (uint64_t)texture->channels * (texture->levels[i].floats ? sizeof(float) : 1);
    return bytes;
}

const char *lam_texture_name(const lam_texture *texture) { return texture ? texture->name : NULL; }
