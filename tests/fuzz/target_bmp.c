// target_bmp.c: fuzz target for reading BMP files.
#include "target_codec.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    read_picture(&codec_bmp, data, size, "fuzz.bmp");
    return 0;
}
