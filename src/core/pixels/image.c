// image.c: allocates the pixels of pictures.
#include "fail.h"
#include "pages.h"
#include "pixels.h"

#include <stdlib.h>

enum { MAX_SIDE = 65535 };

bool lam_image_make(lam_image *image, int width, int height, lam_pixel_format format, lam_error *error)
{
    return image_make_larger(image, width, height, format, 0, error);
}

bool image_make_larger(lam_image *image, int width, int height, lam_pixel_format format, size_t more, lam_error *error)
{
    if (!image)
        return fail(error, LAM_BAD_ARGUMENT, "image: none given");
    *image = (lam_image){0};
    if ((unsigned)format > LAM_RGB32F)
        return fail(error, LAM_BAD_ARGUMENT, "image: pixel format %d is not one of lam_pixel_format", (int)format);
    if (width < 1 || height < 1)
        return fail(error, LAM_BAD_ARGUMENT, "image: %d×%d pixels, expected at least 1×1", width, height);
    if (width > MAX_SIDE || height > MAX_SIDE)
        return fail(error, LAM_LIMIT, "image: %d×%d pixels, expected at largest %d×%d", width, height, MAX_SIDE,
                    MAX_SIDE);
    uint64_t bytes = (uint64_t)width * (uint64_t)height * pixel_bytes(format) + more; // below 2³⁷
    // The system may grant more memory than is available, and later kill the process when the process uses that memory.
    // At most half of the memory is used, because drawing and encoding also need memory.
    void *pixels = bytes <= SIZE_MAX && bytes <= pages_of_machine() / 2 ? pages_malloc((size_t)bytes) : NULL;
    if (!pixels)
        return fail(error, bytes <= pages_of_machine() / 2 ? LAM_MACHINE : LAM_LIMIT,
                    "image: %d×%d pixels need %.1f MB of memory, which is not available", width, height,
                    (double)bytes / 1e6);
    *image = (lam_image){.width = width, .height = height, .format = format, .owned = true, .pixels = pixels};
    return true;
}

void lam_image_free(lam_image *image)
{
    if (!image)
        return;
    if (image->owned)
        free(image->pixels);
    *image = (lam_image){0};
}

void lam_bytes_free(lam_bytes *bytes)
{
    if (!bytes)
        return;
    free(bytes->data);
    *bytes = (lam_bytes){0};
}

bool image_copy(const lam_image *image, lam_image *out, lam_error *error)
{
    if (!lam_image_make(out, image->width, image->height, working_format(image->format), error))
        return false;
    for (int y = 0; y < image->height; y++)
        pixels_to_working(image->format, image_row(image, y), image->width, image_row(out, y));
    return true;
}

bool image_working(const lam_image *image, lam_image *out, lam_error *error)
{
    bool tight = image_stride(image) == (ptrdiff_t)((size_t)image->width * pixel_bytes(image->format));
    if (!tight || image->format != working_format(image->format))
        return image_copy(image, out, error);
    *out = *image;
    out->owned = false;
    return true;
}
