// picture.c: allocates the pictures that codecs fill, within the limits of the call.
#include "codec.h"
#include "fail.h"
#include "pixels.h"

#include <stdlib.h>

static size_t bytes_of(const lam_image *image)
{
    return image->pixels ? (size_t)image->width * (size_t)image->height * pixel_bytes(image->format) : 0;
}

bool picture_size_check(const struct picture_file *file, uint32_t width, uint32_t height, lam_error *error)
{
    uint64_t limit = call_pixel_limit(file->call), pixels = (uint64_t)width * height;
    if (width < 1 || height < 1 || width > 65535 || height > 65535)
        return fail(error, LAM_LIMIT, "%s: a picture of %u×%u pixels, expected 1 to 65535 on a side", file->name, width,
                    height);
    return pixels <= limit || fail(error, LAM_LIMIT,
                                   "%s: a picture of %u×%u pixels, which are %llu, expected at most %llu "
                                   "(lam_control.pixel_limit)",
                                   file->name, width, height, (unsigned long long)pixels, (unsigned long long)limit);
}

bool picture_make(const struct picture_file *file, uint32_t width, uint32_t height, lam_pixel_format format,
                  lam_image *image, lam_error *error)
{
    return picture_make_larger(file, width, height, format, 0, image, error);
}

bool picture_make_larger(const struct picture_file *file, uint32_t width, uint32_t height, lam_pixel_format format,
                         size_t more, lam_image *image, lam_error *error)
{
    *image = (lam_image){0};
    if (!picture_size_check(file, width, height, error))
        return false;
    size_t bytes = (size_t)width * height * pixel_bytes(format);
    // The time for decoding depends on the pixels more than on the bytes.
    if (!call_unpack(file->call, (uint64_t)width * height * 4, error))
        return false;
    if (file->call && !call_charge(file->call, bytes))
        return call_memory_error(file->call, bytes, error);
    if (image_make_larger(image, (int)width, (int)height, format, more, error))
        return true;
    if (file->call)
        call_refund(file->call, bytes);
    return false;
}

bool picture_step_check(const struct picture_file *file, uint32_t width, uint32_t height, size_t own, lam_error *error)
{
    // Accepted even in the smallest file, because 4096×4096 pixels of one colour need only a few bytes.
    enum { PLAIN_PIXELS = 1 << 24, TABLES = 4 << 20 };
    uint64_t pixels = (uint64_t)width * height, more = call_expansion_limit(file->call);
    uint64_t most = PLAIN_PIXELS + (more < UINT32_MAX ? file->size * more : UINT32_MAX);
    if (pixels > most)
        return fail(error, LAM_LIMIT,
                    "%s: %u×%u pixels, expected at most %llu for a file of %zu bytes (lam_control.expansion_limit)",
                    file->name, width, height, (unsigned long long)most, file->size);
    if (file->call && !call_charge(file->call, own))
        return call_memory_error(file->call, own, error);
    void *volatile memory = malloc(own + TABLES); // volatile, so that the unused memory is really allocated
    free(memory);
    if (!memory && file->call)
        call_refund(file->call, own);
    return memory || fail_memory(error, own + TABLES);
}

void picture_free(struct call_control *call, lam_image *image)
{
    if (call)
        call_refund(call, bytes_of(image));
    lam_image_free(image);
}
