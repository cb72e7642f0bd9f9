// target_gltf.c: fuzz target for glTF files, text and binary; every file that one names is the same few bytes.
#include "target.h"

#include <lambent/image.h>

#include <string.h>

static bool open_buffer(void *user, const char *name, struct lam_bytes *bytes, lam_error *error)
{
    (void)user;
    if (strstr(name, "none")) {
        *error = (lam_error){LAM_CANNOT_READ, "there is no such file"};
        return false;
    }
    bytes->size = 256;
    bytes->data = calloc(1, bytes->size);
    if (!bytes->data)
        abort();
    for (size_t i = 0; i < bytes->size; i++)
        ((uint8_t *)bytes->data)[i] = (uint8_t)(i % 7);
    return true;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    load_model(data, size, "fuzz.gltf", open_buffer, NULL, NULL);
    if (memmem(data, size, "\"animations\"", 12)) // those without one refuse it
        load_model(data, size, "fuzz.gltf", open_buffer, NULL, "0");
    return 0;
}
