// target_obj.c: fuzz target for OBJ files; bytes after a zero byte are the MTL file that the model may name.
#include "small_files.h"
#include "target.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const uint8_t *zero = size ? memchr(data, 0, size) : NULL;
    size_t model = zero ? (size_t)(zero - data) : size;
    struct small_files files = {zero ? zero + 1 : (const void *)"", zero ? size - model - 1 : 0};
    load_model(data, model, "fuzz.obj", open_small, &files, NULL);
    return 0;
}
