// picture_hash.c: draws a demonstration scene and hashes the picture.
#include "picture_hash.h"

#include "../fnv.h"

size_t picture_bytes(const lam_image *image)
{
    return (size_t)image->width * (size_t)image->height * (image->format == LAM_RGBA8 ? 4 : 16);
}

bool picture_draw(const struct demo *demo, lam_isa isa, int threads, lam_image *image, lam_error *error)
{
    lam_cpu_params params = {.threads = threads, .isa = isa};
    lam_device *device = lam_device_cpu(&params, error);
    *image = (lam_image){0};
    bool ok = device && lam_image_make(image, demo->width, demo->height, demo->format, error);
    for (int i = 0; ok && i < 2; i++)
        ok = lam_draw(device, demo->scene, &demo->camera, &demo->params, image, NULL, error);
    lam_device_free(device);
    if (!ok)
        lam_image_free(image);
    return ok;
}

bool picture_hash(const lam_image *image, int threads, struct hashes *hashes, lam_error *error)
{
    lam_bytes bytes = {0};
    lam_save_params params = {.threads = threads};
    const char *format = image->format == LAM_RGBA8 ? "png" : "pfm";
    if (!lam_image_encode(image, format, &params, &bytes, error))
        return false;
    *hashes = (struct hashes){hash_of(image->pixels, picture_bytes(image)), hash_of(bytes.data, bytes.size)};
    lam_bytes_free(&bytes);
    return true;
}
