// target_model.c: fuzz target for model files of one format, given by the extension of NAME.
#include "target.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    load_model(data, size, NAME, NULL, NULL, NULL);
    return 0;
}
