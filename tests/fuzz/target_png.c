// target_png.c: fuzz target for reading PNG files.
#include "target_codec.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    read_picture(&codec_png, data, size, "fuzz.png");
    return 0;
}
