// target_webp.c: fuzz target for reading WebP files.
#include "target_codec.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    keep_open("libwebp.so.7");
    read_picture(&codec_webp, data, size, "fuzz.webp");
    return 0;
}
