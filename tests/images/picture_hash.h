// picture_hash.h: draws a demonstration scene and hashes the picture, for the image table.
#ifndef PICTURE_HASH_H
#define PICTURE_HASH_H

#include "scenes.h"

#include <stddef.h>
#include <stdint.h>

// The hash of the pixels (FNV-1a, 64 bits), and of the file that contains them: PNG, or PFM for floats.
struct hashes {
    uint64_t pixels, file;
};

size_t picture_bytes(const lam_image *image);

// Draws twice, so that the second frame reuses the first one's memory. The image is freed with lam_image_free.
bool picture_draw(const struct demo *demo, lam_isa isa, int threads, lam_image *image, lam_error *error);

bool picture_hash(const lam_image *image, int threads, struct hashes *hashes, lam_error *error);

#endif
