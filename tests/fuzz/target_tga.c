// target_tga.c: fuzz target for reading TGA files.
#include "target_codec.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    read_picture(&codec_tga, data, size, "fuzz.tga");
    return 0;
}
