// target_exr.c: fuzz target for reading EXR files.
#include "target_codec.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    keep_open("libOpenEXRCore-3_1.so.30");
    read_picture(&codec_exr, data, size, "fuzz.exr");
    return 0;
}
