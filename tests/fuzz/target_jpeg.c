// target_jpeg.c: fuzz target for reading JPEG files.
#include "target_codec.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    read_picture(&codec_jpeg, data, size, "fuzz.jpg");
    return 0;
}
