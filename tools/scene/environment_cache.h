// environment_cache.h: shares environments among scenes and threads. An environment is read only once, and its light is
// prepared only once.
#ifndef ENVIRONMENT_CACHE_H
#define ENVIRONMENT_CACHE_H

#include <lambent/scene.h>

struct environment_cache;

// Returns NULL if memory runs out.
struct environment_cache *environment_cache_make(void);
void environment_cache_free(struct environment_cache *cache); // accepts NULL

// Reads an environment with the colour mode `color`, and sets the scene's environment. `text` is a value of
// --environment: a built-in name, one file or six files. A cached environment is reused if its files are unchanged. The
// cache keeps only the most recent environments. If `cache` is NULL, the environment is always read. The memory counts
// towards the limit of the call that reads the environment. Fails like lam_environment_load, and with LAM_BAD_ARGUMENT.
bool environment_cache_set(struct environment_cache *cache, const char *text, lam_color_mode color, lam_scene *scene,
                           double rotation_rad, const lam_control *control, lam_error *error);

#endif
