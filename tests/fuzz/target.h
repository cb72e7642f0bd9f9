// target.h: shared by the fuzz targets. Each target_*.c defines LLVMFuzzerTestOneInput for one format and links with
// libFuzzer (clang -fsanitize=fuzzer) or with replay.c, which runs the corpus and its mutations in the normal test run.
#ifndef TARGET_H
#define TARGET_H

#include <lambent/lambent.h>

#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

// Libraries from packages are not instrumented. libFuzzer therefore measures the progress in them by the error message:
// its letters (without numbers) select one of these counters. Other code does not read them.
enum { SENTENCES = 4096 };
__attribute__((section("__libfuzzer_extra_counters"), used)) static uint8_t sentences[SENTENCES];

static inline void note_sentence(const char *text)
{
    uint32_t hash = 5381;
    for (; *text; text++) {
        if (*text < '0' || *text > '9')
            hash = hash * 33 + (uint8_t)*text;
    }
    sentences[hash % SENTENCES] = 1;
}

// Invariant for every input: a valid scene, or an error with a message. It frees the scene.
static inline void check_scene(lam_scene *scene, const lam_error *error)
{
    note_sentence(scene ? "" : error->text);
    uint64_t shown = scene ? lam_scene_triangle_count(scene) : 0;
    for (int i = 0; scene && i < lam_scene_mesh_count(scene); i++)
        shown += lam_scene_mesh(scene, i)->line_count + (uint64_t)lam_scene_mesh(scene, i)->point_count;
    if (scene ? shown == 0 : error->code == LAM_OK || !error->text[0])
        abort();
    for (int i = 0; scene && i < lam_scene_mesh_count(scene); i++) {
        const lam_mesh *mesh = lam_scene_mesh(scene, i);
        for (size_t c = 0; c < 3 * (size_t)mesh->triangle_count; c++) {
            if ((mesh->indices ? mesh->indices[c] : c) >= mesh->vertex_count)
                abort();
            if (mesh->normals && mesh->normal_indices && mesh->normal_indices[c] >= mesh->normal_count)
                abort();
        }
        for (size_t n = 0; n < 3 * (size_t)mesh->vertex_count; n++) {
            if (!(mesh->positions[n] - mesh->positions[n] == 0)) // not finite
                abort();
        }
    }
    lam_scene_free(scene);
}

// Reads a model. Memory and time are limited, so that inputs with excessive cost are found.
static inline void load_model(const uint8_t *data, size_t size, const char *name, lam_open_fn *open, void *user,
                              const char *animation)
{
    lam_load_params params = {.threads = 1, .open = open, .user = user, .animation = animation};
    lam_control control = {.memory_limit_bytes = 256 << 20, .time_limit_s = 20};
    lam_error error = {0};
    lam_scene *scene = lam_scene_load_memory(data, size, name, &params, &control, &error);
    check_scene(scene, &error);
}

#endif
