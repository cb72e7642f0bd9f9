// target_hdr.c: fuzz target for reading Radiance files.
#include "target.h"

#include "codec.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    lam_image image = {0};
    lam_error error = {0};
    if (codec_hdr.read(&(struct picture_file){data, size, "fuzz.hdr", NULL}, &image, &error)
            ? !image.pixels
            : image.pixels || !error.text[0])
        abort();
    lam_image_free(&image);
    return 0;
}
