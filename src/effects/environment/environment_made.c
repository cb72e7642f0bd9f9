// environment_made.c: computes the built-in environments with + − × ÷ √ only.
#include "environment.h"
#include "fail.h"
#include "float_state.h"
#include "linear.h"
#include "lock.h"

#include <stdlib.h>
#include <string.h>

enum { SIDE = 256 }; // texels per side of a face

struct rgb {
    double c[3];
};

static struct rgb mix(struct rgb a, struct rgb b, double share)
{
    for (int i = 0; i < 3; i++)
        a.c[i] += (b.c[i] - a.c[i]) * share;
    return a;
}

// Returns 0 for x below `low`, 1 for x above `high`, and a smooth cubic function of x between them.
static double ramp(double low, double high, double x)
{
    double t = (x - low) / (high - low);
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    return t * t * (3 - 2 * t);
}

// Returns x to the power 2^n.
static double squared(double x, int n)
{
    for (; n > 0; n--)
        x *= x;
    return x;
}

// Returns the light of a clear afternoon. The sky is blue above and pale at the horizon, and the ground is brown. The
// sun is in front on the right (+X +Z), a third of the way up.
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

// Adds a round lamp: full light where the cosine of the angle to its direction is above `full`, none below `none`.
static void add_lamp(struct rgb *light, lam_vec3 d, lam_vec3 direction, double none, double full, struct rgb lamp)
{
    double share = ramp(none, full, v3_dot(d, v3_unit(direction)));
    for (int i = 0; i < 3; i++)
        light->c[i] += share * lamp.c[i];
}

// Returns the light on a meadow at noon: the sky with a bright sun, which casts a shadow, over green ground.
static struct rgb outdoor(lam_vec3 d)
{
    static const struct rgb far = {{0.27, 0.27, 0.19}}, grass = {{0.12, 0.135, 0.075}}, sun = {{310, 290, 250}};
    struct rgb light = mix(mix(far, grass, ramp(0, 0.6, -d.y)), sky(d), ramp(-0.02, 0.02, d.y));
    add_lamp(&light, d, v3(0.6, 0.9, 0.65), 0.9975, 0.9988, sun);
    return light;
}

// Returns the light of a tent of white cloth: all of it shines, most above and towards the front on the left.
static struct rgb soft(lam_vec3 d)
{
    static const struct rgb low = {{0.34, 0.33, 0.32}}, high = {{0.95, 0.96, 1.0}}, panel = {{0.85, 0.83, 0.8}};
    struct rgb light = mix(low, high, ramp(-0.8, 0.9, d.y));
    add_lamp(&light, d, v3(-0.7, 0.7, 0.8), 0.2, 0.95, panel);
    return light;
}

// Returns the light of a street at night: a deep blue sky with a moon, dark ground, a glow of the town at the horizon,
// and street lamps.
static struct rgb night(lam_vec3 d)
{
    static const struct rgb zenith = {{0.012, 0.02, 0.055}}, town = {{0.16, 0.1, 0.06}},
                            ground = {{0.018, 0.016, 0.015}}, moon = {{32, 38, 50}}, sodium = {{42, 24, 8}},
                            lantern = {{18, 17, 15}};
    static const lam_vec3 lamps[] = {{-0.9, 0.3, 0.5}, {0.95, 0.22, 0.3}, {0.5, 0.12, -0.9}, {-0.45, 0.1, -0.9}};
    double up = d.y > 0 ? d.y : 0;
    struct rgb light = mix(ground, mix(zenith, town, squared(1 - up, 3)), ramp(-0.02, 0.02, d.y));
    add_lamp(&light, d, v3(-0.35, 0.8, 0.75), 0.996, 0.9975, moon);
    for (int i = 0; i < 4; i++)
        add_lamp(&light, d, lamps[i], 0.997, 0.9985, i % 2 ? lantern : sodium);
    return light;
}

// Returns the light of a white cyclorama: a wall that curves into the floor, lit from a large panel above. The side of
// the camera (+X +Z) is darker, so that edges and polished surfaces stand out.
static struct rgb cyclorama(lam_vec3 d)
{
    static const struct rgb floor_color = {{0.72, 0.72, 0.72}}, wall = {{1, 1, 1}}, dark = {{0.25, 0.25, 0.26}},
                            panel = {{0.6, 0.6, 0.6}}, key = {{1.6, 1.55, 1.5}};
    struct rgb light = mix(floor_color, wall, ramp(-0.7, 0.1, d.y));
    light = mix(light, dark, ramp(0.1, 0.8, v3_dot(d, v3_unit(v3(0.5, -0.1, 0.85)))));
    add_lamp(&light, d, v3(0, 1, 0), 0.75, 0.85, panel);
    add_lamp(&light, d, v3(-0.75, 0.6, 0.6), 0.9, 0.94, key);
    return light;
}

// The studio for physical materials is a cubic room around the origin. The lamps are small and bright. A clear coat
// therefore shows a few sharp highlights, and the colour below the coat stays saturated between the highlights. The
// brightest lamp, on the ceiling, lights the tops of objects. The objects' shadows on a ground are therefore short and
// soft. A tall lamp in front lights the sides that face the viewer. A tall lamp at the right is weaker. The three
// visible faces of a cube therefore differ in brightness. The lamp behind the object is high, and lights the rims of
// black objects and rounded tops. Metals mirror a bright horizon between a dark floor and dim walls, and a large dim
// lamp at the left. A horizontal white surface receives 1.1 (irradiance / π), which the tone curve maps to 0.9. Each
// face of the cube map is a wall of the room.
struct lamp {
    double intensity;
    struct rgb color;
    double center_s, center_t; // position along the face's rows and columns, in room coordinates
    double half_width, half_height;
};
#define WHITE {{1.00, 0.97, 0.92}}
#define COOL  {{0.82, 0.90, 1.00}}
static const struct lamp lamps[LAM_FACE_COUNT] = {[LAM_FACE_PY] = {14, WHITE, -0.3, 0.1, 0.2, 0.24},
                                                  [LAM_FACE_NX] = {0.5, WHITE, 0.24, 0.48, 0.2, 0.56},
                                                  [LAM_FACE_PX] = {10, COOL, -0.3, -0.02, 0.12, 0.22},
                                                  [LAM_FACE_PZ] = {13.5, WHITE, -0.2, 0.26, 0.13, 0.24},
                                                  [LAM_FACE_NZ] = {17, COOL, -0.12, 0.75, 0.3, 0.11}};

// Returns 1 if |x| is below `half_width`, and decreases smoothly to 0 just beyond it.
static double soft_edge(double x, double half_width)
{
    const double edge = 0.03;
    return ramp(-half_width - edge, -half_width, x < 0 ? x : -x);
}

// Returns the light of the walls at a height in the room, −1 … 1. The colour changes from the floor's colour to the
// wall's colour, with a bright band at the horizon.
static struct rgb wall_at(double height)
{
    static const struct rgb floor_color = {{0.085, 0.0825, 0.08}}, wall = {{0.066, 0.068, 0.076}},
                            horizon = {{0.426, 0.441, 0.45}};
    struct rgb light = mix(floor_color, wall, ramp(-1, 0.2, height));
    double band = ramp(-0.42, 0, height) - ramp(0, 0.36, height);
    for (int i = 0; i < 3; i++)
        light.c[i] += band * horizon.c[i];
    return light;
}

// Computes a row of the studio. All texels of a row are at the same height in the room.
static void studio_row(int face, int t, float *texels)
{
    const struct lamp *lamp = &lamps[face];
    double d[3], across[3], down[3];
    cube_direction(face, 0, 1, 0, across);
    cube_direction(face, 0, 0, 1, down);
    int s_axis = across[0] != 0 ? 0 : 2, t_axis = down[1] != 0 ? 1 : 2;
    cube_direction(face, SIDE, 0, 2 * t + 1 - SIDE, d);
    struct rgb wall = wall_at(d[1] / SIDE);
    double row = lamp->intensity * soft_edge(d[t_axis] / SIDE - lamp->center_t, lamp->half_height);
    for (int s = 0; s < SIDE; s++) {
        double x = across[s_axis] * (2 * s + 1 - SIDE) / SIDE;
        double light = row > 0 ? row * soft_edge(x - lamp->center_s, lamp->half_width) : 0;
        for (int channel = 0; channel < 3; channel++)
            *texels++ = (float)(wall.c[channel] + light * lamp->color.c[channel]);
    }
}

static const struct {
    const char *name;
    struct rgb (*color)(lam_vec3 direction); // NULL: studio_row
} table[] = {{"sky", sky},         {"studio", NULL}, {"soft", soft},
             {"outdoor", outdoor}, {"night", night}, {"cyclorama", cyclorama}};
enum { COUNT = sizeof table / sizeof *table };

const char *lam_environment_built_in_name(int index) { return index >= 0 && index < COUNT ? table[index].name : NULL; }

static void fill(struct lam_environment *cube, struct rgb (*color)(lam_vec3 direction))
{
    for (int face = 0; face < LAM_FACE_COUNT; face++)
        for (int t = 0; t < SIDE; t++) {
            float *texels = cube_texel(cube, face, 0, t);
            if (!color)
                studio_row(face, t, texels);
            for (int s = 0; color && s < SIDE; s++) {
                double d[3];
                cube_direction(face, SIDE, 2 * s + 1 - SIDE, 2 * t + 1 - SIDE, d);
                struct rgb c = color(v3_unit(v3(d[0], d[1], d[2])));
                for (int channel = 0; channel < 3; channel++)
                    *texels++ = (float)c.c[channel];
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
                fill(cube, table[i].color);
            float_state_leave(state);
            return cube;
        }
    }
    fail(error, LAM_BAD_ARGUMENT,
         "environment: '%s' is not built in, expected sky, studio, soft, outdoor, night or cyclorama",
         name ? name : "");
    return NULL;
}

// --- the studio for scenes without lights

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
