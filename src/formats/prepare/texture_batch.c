// texture_batch.c: decodes the pictures of a model, each content once, in parallel.
#include "texture_batch.h"

#include "codec.h"
#include "fail.h"
#include "float_state.h"
#include "srgb.h"

#include <stdlib.h>
#include <string.h>

// Decodes the sRGB-encoded 16-bit values of a picture to linear values.
static bool decode_wide(lam_image *image, lam_error *error)
{
    size_t count = (size_t)image->width * (size_t)image->height;
    float *table = malloc(65536 * sizeof *table), *pixel = image->pixels;
    if (!table)
        return fail_memory(error, 65536 * sizeof *table);
    for (int i = 0; i < 65536; i++)
        table[i] = (float)srgb_linear(i / 65535.0);
    for (size_t i = 0; i < count; i++, pixel += 4)
        for (int channel = 0; channel < 3; channel++)
            pixel[channel] = table[(int)(pixel[channel] * 65535.0f + 0.5f)];
    free(table);
    return true;
}

struct lam_texture *texture_decode(const void *bytes, size_t size, const char *name, lam_texture_values values,
                                   struct call_control *call, lam_error *error)
{
    struct picture_file file = {bytes, size, name, call};
    lam_image image;
    bool wide = false;
    uint64_t state = float_state_enter();
    bool ok = picture_decode_wide(&file, &wide, &image, error);
    if (ok && wide && values == LAM_TEXTURE_COLOR) {
        ok = decode_wide(&image, error);
        if (!ok)
            picture_free(call, &image);
    } else if (ok && !wide && image.format == LAM_RGBA32F)
        texture_unpremultiply(&image);
    struct lam_texture *texture = ok ? texture_of_image(&image, values, name, call, error) : NULL;
    float_state_leave(state);
    return texture;
}

bool texture_is_optional(const lam_error *error)
{
    return error->code == LAM_CANNOT_READ || error->code == LAM_UNSUPPORTED || error->code == LAM_BAD_ARGUMENT;
}

int texture_source_order(const struct texture_source *a, const struct texture_source *b)
{
    if (a->values != b->values || a->size != b->size)
        return (a->values != b->values ? a->values < b->values : a->size < b->size) ? -1 : 1;
    return a->bytes == b->bytes ? 0 : memcmp(a->bytes, b->bytes, a->size);
}

// Sorts in the file's order; sources whose contents another source has come last.
static int by_position(const void *a, const void *b)
{
    const struct texture_source *x = *(struct texture_source *const *)a, *y = *(struct texture_source *const *)b;
    return !x->first != !y->first ? (x->first ? 1 : -1) : (x > y) - (x < y);
}

static int by_contents(const void *a, const void *b)
{
    int order = texture_source_order(*(struct texture_source *const *)a, *(struct texture_source *const *)b);
    return order ? order : by_position(a, b);
}

// Sets `first` in the sources whose contents an earlier source has, and moves them to the end of the list. Returns the
// number of the others.
static size_t find_contents(struct texture_source **list, size_t count)
{
    size_t contents = count;
    qsort(list, count, sizeof *list, by_contents);
    for (size_t i = 1; i < count; i++)
        if (texture_source_order(list[i - 1], list[i]) == 0) {
            list[i]->first = list[i - 1]->first ? list[i - 1]->first : list[i - 1];
            contents--;
        }
    qsort(list, count, sizeof *list, by_position);
    return contents;
}

// Returns whether the model can be loaded, with or without this texture.
static bool decode(struct texture_source *source, struct call_control *call)
{
    source->texture = texture_decode(source->bytes, source->size, source->name, source->values, call, &source->error);
    return source->texture || texture_is_optional(&source->error);
}

struct batch {
    struct texture_source **list;
    struct call_control *call;
};

static void decode_task(void *user, size_t index, int thread)
{
    const struct batch *batch = user;
    (void)thread;
    if (call_should_continue(batch->call) && !decode(batch->list[index], batch->call))
        call_stop_together(batch->call);
}

void textures_decode(struct texture_source **list, size_t count, struct pool *pool, struct call_control *call)
{
    size_t contents = find_contents(list, count);
    bool done = contents > 1 && pool_threads(pool) > 1;
    if (done) {
        call_together(call);
        pool_run(pool, contents, decode_task, &(struct batch){list, call});
        done = !call_apart(call) && call_should_continue(call);
    }
    for (size_t i = 0; i < contents && !done; i++)
        lam_texture_free(list[i]->texture), list[i]->texture = NULL;
    for (size_t i = 0; i < contents && !done; i++)
        done = !decode(list[i], call);
    for (size_t i = contents; i < count; i++)
        list[i]->texture = texture_share(list[i]->first->texture);
}
