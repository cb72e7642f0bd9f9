// target_stl.c: fuzz target for STL files.
#include "target.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    load_model(data, size, "fuzz.stl", NULL, NULL, NULL);
    return 0;
}
