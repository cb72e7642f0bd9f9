// target_ply.c: fuzz target for PLY files.
#include "target.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    load_model(data, size, "fuzz.ply", NULL, NULL, NULL);
    return 0;
}
