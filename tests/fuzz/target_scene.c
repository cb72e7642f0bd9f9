// target_scene.c: fuzz target for scene files; they can refer to the models and pictures in small_files.h.
#include "small_files.h"
#include "target.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    load_model(data, size, "fuzz.json", open_small, NULL, NULL);
    return 0;
}
