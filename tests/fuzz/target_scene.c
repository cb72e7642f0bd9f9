// target_scene.c: fuzz target for scene files; every file that one names is the same small model.
#include "target.h"

#include <lambent/image.h>

#include <string.h>

static bool open_model(void *user, const char *name, struct lam_bytes *bytes, lam_error *error)
{
    static const char model[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    (void)user;
    if (strstr(name, "none")) {
        *error = (lam_error){LAM_CANNOT_READ, "there is no such file"};
        return false;
    }
    bytes->size = sizeof model - 1;
    bytes->data = malloc(bytes->size);
    if (!bytes->data)
        abort();
    memcpy(bytes->data, model, bytes->size);
    return true;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    load_model(data, size, "fuzz.json", open_model, NULL, NULL);
    return 0;
}
