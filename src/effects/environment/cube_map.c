// cube_map.c: implements cube maps in memory: reference counting and lookup.
#include "environment.h"
#include "fail.h"
#include "float_state.h"
#include "linear.h"
#include "pages.h"

#define LANES 1
#include "cube_lookup.h"

#include <stdlib.h>

struct lam_environment *cube_make(int size, lam_error *error)
{
    struct lam_environment *cube = malloc(sizeof *cube);
    size_t bytes = cube_bytes(size) + CUBE_TEXELS_AFTER, held;
    float *texels = cube ? pages_get(bytes, &held) : NULL;
    if (!texels) {
        free(cube);
        fail_memory(error, bytes);
        return NULL;
    }
    *cube = (struct lam_environment){.references = 1, .size = size, .texels = texels, .held = held};
    return cube;
}

struct lam_environment *cube_share(const struct lam_environment *cube)
{
    struct lam_environment *shared = (struct lam_environment *)(uintptr_t)cube;
    if (shared)
        __atomic_add_fetch(&shared->references, 1, __ATOMIC_RELAXED);
    return shared;
}

void lam_environment_free(lam_environment *cube)
{
    if (!cube || __atomic_sub_fetch(&cube->references, 1, __ATOMIC_ACQ_REL) > 0)
        return;
    environment_light_free(cube->light);
    pages_free(cube->texels, cube->held);
    free(cube);
}

int lam_environment_size(const lam_environment *cube) { return cube ? cube->size : 0; }

lam_rgb lam_environment_sample(const lam_environment *cube, lam_vec3 direction)
{
    lam_vec3 d = v3_unit(direction);
    if (!cube || !v3_finite(d) || (d.x == 0 && d.y == 0 && d.z == 0))
        return (lam_rgb){0, 0, 0};
    uint64_t state = float_state_enter();
    struct cube_color c = cube_look(cube, (float)d.x, (float)d.y, (float)d.z);
    float_state_leave(state);
    return (lam_rgb){c.r, c.g, c.b};
}
