// target_formula.c: fuzz target for surfaces given as formulas (lam_formula, docs/shapes.md). An input is the text, and
// after a zero byte the range of u, and after another one the range of v. If it begins with '?', the text is an
// implicit surface, with the ranges of x and z.
#include "target.h"

#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *words[3] = {calloc(size + 3, 1)};
    if (!words[0])
        abort();
    if (size)
        memcpy(words[0], data, size);
    for (int i = 1; i < 3; i++)
        words[i] = words[i - 1] + strlen(words[i - 1]) + 1;
    const char *first = *words[1] ? words[1] : NULL, *second = first && *words[2] ? words[2] : NULL, *cut = "-2..2";
    lam_formula formula = {.text = words[0], .u = first, .v = second, .u_segments = 9, .v_segments = 6};
    if (*words[0] == '?') // z is searched with only one range, because a search takes longer than everything else
        formula = (lam_formula){.text = words[0] + 1,
                                .implicit = true,
                                .x = first ? first : cut,
                                .y = cut,
                                .z = second  ? second
                                     : first ? NULL
                                             : cut,
                                .u_segments = 9};
    lam_control control = {.memory_limit_bytes = 64 << 20, .time_limit_s = 20};
    lam_error error = {0};
    lam_scene *scene = lam_scene_make(NULL);
    if (!scene)
        abort();
    lam_object object = lam_object_default();
    object.mesh = lam_scene_add_formula(scene, &formula, &control, &error);
    if (object.mesh < 0 || lam_scene_add_object(scene, &object, &error) < 0) {
        lam_scene_free(scene);
        scene = NULL;
    }
    check_scene(scene, &error);
    free(words[0]);
    return 0;
}
