// target_hdr.c: fuzz target for reading Radiance files.
#include "target_codec.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    read_picture(&codec_hdr, data, size, "fuzz.hdr");
    return 0;
}
