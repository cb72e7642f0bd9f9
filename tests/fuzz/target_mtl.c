// target_mtl.c: fuzz target for MTL files, read with a model that uses two materials and has texture coordinates.
#include "small_files.h"
#include "target.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const char model[] = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 1\nvt 0 0\nvt 1 0\nvt 0 1\n"
                                "usemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 2/1 4/2 3/3\n";
    struct small_files files = {data ? data : (const void *)"", size};
    load_model((const uint8_t *)model, sizeof model - 1, "fuzz.obj", open_small, &files, NULL);
    return 0;
}
