// environment_lookups.c: looks up an environment in LANES directions at a time. This file is compiled once for each
// instruction set, with LANES and ISA defined (meson.build).
#include "environment.h"
#include "lighting.h"
#include "prefiltered_lookup.h"

_Static_assert((int)PREFILTERED_LAST == ENVIRONMENT_LEVELS - 1, "lobes.h and environment_light.h use the same levels");

LANE_FN vec3 load_rows(environment_rows rows, int at)
{
    return (vec3){num_load(rows[0] + at), num_load(rows[1] + at), num_load(rows[2] + at)};
}

LANE_FN void store_rows(environment_rows rows, int at, vec3 v)
{
    num_store(rows[0] + at, v.x);
    num_store(rows[1] + at, v.y);
    num_store(rows[2] + at, v.z);
}

LANE_FN vec3 to_environment_axes(const struct environment_view *view, vec3 w)
{
    const float(*m)[3] = view->to_environment;
    return vec3_of((m[0][0] * w.x + m[0][1] * w.y) + m[0][2] * w.z, (m[1][0] * w.x + m[1][1] * w.y) + m[1][2] * w.z,
                   (m[2][0] * w.x + m[2][1] * w.y) + m[2][2] * w.z);
}

LANE_FN vec3 vec3_of_color(struct cube_color c) { return vec3_of(c.r, c.g, c.b); }

// Works like cube_look, but gathers the four texels around each direction one channel at a time.
LANE_FN vec3 cube_gathered(const struct lam_environment *cube, vec3 direction)
{
    struct cube_position on_cube = cube_position(direction.x, direction.y, direction.z, cube->size);
    const float *texels = cube->texels, *below = texels + cube_row(cube);
    inum column = int_of(on_cube.s), row = int_of(on_cube.t), side = inum_of(cube->size + 2);
    num s = on_cube.s - num_of_int(column), t = on_cube.t - num_of_int(row), a[3], b[3], c[3], d[3], mixed[3];
    uint32_t at[LANES];
    inum_store((int32_t *)at, wrap_add(wrap_mul(wrap_add(wrap_mul(on_cube.face, side), row), side), column));
    gather3(texels, at, 3, a);
    gather3(texels + 3, at, 3, b);
    gather3(below, at, 3, c);
    gather3(below + 3, at, 3, d);
    for (int i = 0; i < 3; i++) {
        num upper = a[i] + (b[i] - a[i]) * s, lower = c[i] + (d[i] - c[i]) * s;
        mixed[i] = upper + (lower - upper) * t;
    }
    return vec3_of(mixed[0], mixed[1], mixed[2]);
}

// Works like prefiltered_look. If the material has no maps, all lanes read the same two levels.
LANE_FN vec3 prefiltered_gathered(const struct environment_light *light, num level, vec3 direction)
{
    inum first = int_of(min_of(level, num_of((float)(ENVIRONMENT_LEVELS - 2))));
    int number = ilane(first, 0);
    if (!all_lanes(num_of_int(first) == (float)number))
        return vec3_of_color(prefiltered_look(light, level, direction.x, direction.y, direction.z));
    vec3 a = cube_gathered(&light->level[number], direction), b = cube_gathered(&light->level[number + 1], direction);
    return add3(a, scale3(sub3(b, a), level - num_of_int(first)));
}

static void colors(const struct environment_view *view, environment_rows direction, int count, environment_rows out)
{
    for (int i = 0; i < count; i += LANES) {
        vec3 d = to_environment_axes(view, load_rows(direction, i));
        store_rows(out, i, vec3_of_color(cube_look(view->cube, d.x, d.y, d.z)));
    }
}

static void irradiance(const struct environment_view *view, environment_rows normal, int count, environment_rows out)
{
    for (int i = 0; i < count; i += LANES)
        store_rows(out, i, cube_gathered(&view->light->irradiance, to_environment_axes(view, load_rows(normal, i))));
}

static void prefiltered(const struct environment_view *view, environment_rows direction, const float *level, int count,
                        environment_rows out)
{
    for (int i = 0; i < count; i += LANES) {
        vec3 d = to_environment_axes(view, load_rows(direction, i));
        store_rows(out, i, prefiltered_gathered(view->light, num_load(level + i), d));
    }
}

static void densities(const struct environment_view *view, environment_rows direction, int count, float *out)
{
    const struct environment_samples *e = view->samples;
    const float half = 0.5f * (float)e->size;
    const num last = num_of((float)(e->size - 1)), zero = num_of(0.0f);
    for (int first = 0; first < count; first += LANES) {
        vec3 d = to_environment_axes(view, load_rows(direction, first));
        struct cube_position at = cube_point(d.x, d.y, d.z);
        inum column = int_of(min_of(max_of((at.s + 1.0f) * half, zero), last));
        inum row = int_of(min_of(max_of((at.t + 1.0f) * half, zero), last));
        float density[LANES];
        for (int i = 0; i < LANES; i++)
            density[i] = e->density[(ilane(at.face, i) * e->size + ilane(row, i)) * e->size + ilane(column, i)];
        num square = 1.0f + at.s * at.s + at.t * at.t;
        num_store(out + first, num_load(density) * (square * square_root(square)));
    }
}

const struct environment_lookups FOR_ISA(environment_lookups) = {colors, irradiance, prefiltered, densities};
