// environment_made.c: the built-in environments, computed from + − × ÷ √ alone: a sky and a studio.
#include "cube_map.h"
#include "fail.h"
#include "float_state.h"
#include "linear.h"
#include "lock.h"

#include <stdlib.h>
#include <string.h>

enum { SIDE = 256 }; // texels on a face's side

struct rgb {
    double c[3];
};

static struct rgb mix(struct rgb a, struct rgb b, double share)
{
    for (int i = 0; i < 3; i++)
        a.c[i] += (b.c[i] - a.c[i]) * share;
    return a;
}

// 0 below `low`, 1 above `high`, a smooth cubic between.
static double ramp(double low, double high, double x)
{
    double t = (x - low) / (high - low);
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    return t * t * (3 - 2 * t);
}

// x to the power 2^n.
static double squared(double x, int n)
{
    for (; n > 0; n--)
        x *= x;
    return x;
}

// A clear afternoon: blue above, pale at the horizon, the sun a third up to the right in front (+X +Z), brown ground.
static struct rgb sky(lam_vec3 d)
{
    static const struct rgb zenith = {{0.10, 0.24, 0.62}}, horizon = {{0.72, 0.80, 0.88}},
                            near_ground = {{0.34, 0.31, 0.27}}, below = {{0.14, 0.12, 0.10}},
                            warm = {{1.00, 0.86, 0.62}};
    lam_vec3 sun = v3_unit(v3(0.6, 0.5, 0.65));
    double up = d.y > 0 ? d.y : 0, down = d.y < 0 ? -d.y : 0, toward = v3_dot(d, sun);
    struct rgb air = mix(zenith, horizon, squared(1 - up, 2));
    double glow = toward > 0 ? 0.25 * squared(toward, 4) + 0.8 * squared(toward, 7) : 0,
           disc = 30 * ramp(0.9975, 0.9988, toward);
    for (int i = 0; i < 3; i++)
        air.c[i] += warm.c[i] * (glow + disc);
    return mix(mix(near_ground, below, ramp(0, 0.7, down)), air, ramp(-0.015, 0.015, d.y));
}

// A lamp on a wall: 1 within half a width and half a height about a place, soft at its edges.
static double soft_box(double x, double y, double half_width, double half_height)
{
    const double edge = 0.06;
    x = x < 0 ? -x : x;
    y = y < 0 ? -y : y;
    return ramp(-half_width - edge, -half_width, -x) * ramp(-half_height - edge, -half_height, -y);
}

// A dark room, a cube about the origin: a broad lamp at the ceiling, a tall strip at the left, a wide dim one at the
// right, a small one behind, a floor that returns some of it.
static struct rgb studio(lam_vec3 d)
{
    double ax = d.x < 0 ? -d.x : d.x, ay = d.y < 0 ? -d.y : d.y, az = d.z < 0 ? -d.z : d.z;
    double major = ax > ay ? (ax > az ? ax : az) : (ay > az ? ay : az);
    lam_vec3 p = v3_scale(d, 1 / major); // on the walls
    static const struct rgb floor_color = {{0.16, 0.155, 0.15}}, wall = {{0.05, 0.052, 0.058}};
    struct rgb light = mix(floor_color, wall, ramp(-1, 0.2, p.y));
    double white = 0, cool = 0;
    if (ay == major && d.y > 0)
        white += 5.0 * soft_box(p.x, p.z - 0.15, 0.55, 0.4);
    else if (ax == major && d.x < 0)
        white += 3.5 * soft_box(p.z - 0.25, p.y - 0.1, 0.2, 0.65);
    else if (ax == major && d.x > 0)
        cool += 1.2 * soft_box(p.z - 0.1, p.y - 0.15, 0.6, 0.45);
    else if (az == major && d.z < 0)
        cool += 2.0 * soft_box(p.x - 0.45, p.y - 0.35, 0.15, 0.3);
    static const struct rgb white_color = {{1.00, 0.97, 0.92}}, cool_color = {{0.82, 0.90, 1.00}};
    for (int i = 0; i < 3; i++)
        light.c[i] += white * white_color.c[i] + cool * cool_color.c[i];
    return light;
}

static const struct {
    const char *name;
    struct rgb (*light)(lam_vec3 direction);
} table[] = {{"sky", sky}, {"studio", studio}};
enum { COUNT = sizeof table / sizeof *table };

const char *lam_environment_built_in_name(int index) { return index >= 0 && index < COUNT ? table[index].name : NULL; }

static void fill(struct lam_environment *cube, struct rgb (*light)(lam_vec3 direction))
{
    for (int face = 0; face < LAM_FACE_COUNT; face++) {
        for (int t = 0; t < SIDE; t++) {
            for (int s = 0; s < SIDE; s++) {
                double d[3];
                cube_direction(face, SIDE, 2 * s + 1 - SIDE, 2 * t + 1 - SIDE, d);
                struct rgb c = light(v3_unit(v3(d[0], d[1], d[2])));
                float *texel = cube_texel(cube, face, s, t);
                for (int channel = 0; channel < 3; channel++)
                    texel[channel] = (float)c.c[channel];
            }
        }
    }
    cube_close(cube);
}

lam_environment *lam_environment_built_in(const char *name, lam_error *error)
{
    for (int i = 0; name && i < COUNT; i++) {
        if (strcmp(name, table[i].name) == 0) {
            uint64_t state = float_state_enter();
            struct lam_environment *cube = cube_make(SIDE, error);
            if (cube)
                fill(cube, table[i].light);
            float_state_leave(state);
            return cube;
        }
    }
    fail(error, LAM_BAD_ARGUMENT, "environment: '%s' is not built in, expected sky or studio", name ? name : "");
    return NULL;
}

// --- the studio of scenes without lights

struct lazy_environment {
    lock one_maker;
    struct lam_environment *made;
};

struct lazy_environment *lazy_environment_make(void)
{
    struct lazy_environment *lazy = calloc(1, sizeof *lazy);
    if (lazy)
        lock_start(&lazy->one_maker);
    return lazy;
}

const struct lam_environment *lazy_environment_studio(struct lazy_environment *lazy, lam_error *error)
{
    lock_take(&lazy->one_maker);
    if (!lazy->made)
        lazy->made = lam_environment_built_in("studio", error);
    const struct lam_environment *made = lazy->made;
    lock_give(&lazy->one_maker);
    return made;
}

void lazy_environment_free(struct lazy_environment *lazy)
{
    if (!lazy)
        return;
    lam_environment_free(lazy->made);
    lock_end(&lazy->one_maker);
    free(lazy);
}
