// target_obj.c: fuzz target for OBJ files; bytes after a zero byte are the MTL file that the model may name.
#include "target.h"

#include <lambent/image.h>

#include <string.h>

struct input {
    const uint8_t *materials;
    size_t size;
};

static bool open_materials(void *user, const char *name, struct lam_bytes *bytes, lam_error *error)
{
    const struct input *input = user;
    if (!strstr(name, ".mtl")) {
        *error = (lam_error){LAM_CANNOT_READ, "there is no such file"};
        return false;
    }
    bytes->size = input->size;
    bytes->data = malloc(input->size + 1);
    if (!bytes->data)
        abort();
    memcpy(bytes->data, input->materials, input->size);
    return true;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const uint8_t *zero = size ? memchr(data, 0, size) : NULL;
    size_t model = zero ? (size_t)(zero - data) : size;
    struct input input = {.materials = data + model + (zero != NULL), .size = zero ? size - model - 1 : 0};
    load_model(data, model, "fuzz.obj", open_materials, &input, NULL);
    return 0;
}
