// target_jpeg.c: fuzz target for reading JPEG files.
#include "target.h"

#include "codec.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    lam_image image = {0};
    lam_error error = {0};
    if (codec_jpeg.read(&(struct picture_file){data, size, "fuzz.jpg", NULL}, &image, &error)
            ? !image.pixels
            : image.pixels || !error.text[0])
        abort();
    lam_image_free(&image);
    return 0;
}
