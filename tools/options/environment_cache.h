// environment_cache.h: caches environments for many scenes and threads: each is read, and its light prepared, once.
#ifndef ENVIRONMENT_CACHE_H
#define ENVIRONMENT_CACHE_H

#include <lambent/lambent.h>

struct environment_cache;

// NULL: out of memory; then nothing is kept.
struct environment_cache *environment_cache_make(void);
void environment_cache_free(struct environment_cache *cache); // NULL is fine

// Sets the environment of a scene: a built-in one, one file or six, as `--environment` has it, in `color`. An
// environment is reused while its files are unchanged; the latest few are kept. `cache` NULL: it is read. The memory of
// reading is counted by the call that reads. Errors: as lam_environment_load, LAM_BAD_ARGUMENT.
bool environment_cache_set(struct environment_cache *cache, const char *text, lam_color_mode color, lam_scene *scene,
                           double rotation_rad, const lam_control *control, lam_error *error);

#endif
