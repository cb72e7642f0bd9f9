// target_gltf.c: fuzz target for glTF files, text and binary; they can refer to the files in small_files.h.
#include "small_files.h"
#include "target.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    load_model(data, size, "fuzz.gltf", open_small, NULL, NULL);
    if (memmem(data, size, "\"animations\"", 12)) // files without an animation refuse it
        load_model(data, size, "fuzz.gltf", open_small, NULL, "0");
    return 0;
}
