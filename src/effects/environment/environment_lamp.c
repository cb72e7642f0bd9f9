// environment_lamp.c: finds the brightest lamp of an environment (environment.h).
//
// A texel is bright if its luminance exceeds BRIGHT times the mean. For each direction of a small cube, the light of
// all bright texels within LAMP_COSINE of this direction is summed. The direction with the largest sum is the lamp's
// direction, and the lamp consists of the texels of this sum. All sums are in double, in a fixed order.
#include "environment.h"

#include "fail.h"
#include "linear.h"
#include "lock.h"
#include "pages.h"

#include <stdlib.h>
#include <string.h>

#define BRIGHT       3.0
#define LAMP_COSINE  0.87 // cosine of 29.5 degrees
#define LEAST_SHARE  0.05 // a lamp with less than this fraction of the mean light is ignored
#define SOLID_ANGLE  12.566370614359172
#define RADIUS_LEAST 0.0047 // the angular radius of the sun, in radians
enum { LAMP_SIZE = 64, CANDIDATE_SIZE = 8 };

struct bright_texel {
    double direction[3], light[3], luminance, share; // `share` is the fraction of the sphere that the texel covers
};

static double luminance_of(const float *rgb)
{
    return (0.2126 * (double)rgb[0] + 0.7152 * (double)rgb[1]) + 0.0722 * (double)rgb[2];
}

static void texel_direction(int size, int face, int s, int t, double out[3])
{
    double d[3], square = 0;
    cube_direction(face, size, 2 * s + 1 - size, 2 * t + 1 - size, d);
    for (int i = 0; i < 3; i++)
        square += d[i] * d[i];
    for (int i = 0; i < 3; i++)
        out[i] = d[i] / math_sqrt(square);
}

static double dot(const double a[3], const double b[3]) { return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2]; }

static int list_bright(const struct lam_environment *cube, struct bright_texel *out, double *mean)
{
    double weights = 0, sum = 0;
    int count = 0, n = cube->size;
    for (int pass = 0; pass < 2; pass++) {
        if (pass == 1)
            *mean = sum / weights;
        for (int face = 0; face < LAM_FACE_COUNT; face++)
            for (int i = 0; i < n * n; i++) {
                const float *rgb = cube_texel(cube, face, i % n, i / n);
                double weight = (double)texel_weight(n, i % n, i / n), y = luminance_of(rgb);
                if (pass == 0) {
                    weights += weight;
                    sum += weight * y;
                } else if (y > BRIGHT * *mean) {
                    struct bright_texel *b = &out[count++];
                    texel_direction(n, face, i % n, i / n, b->direction);
                    for (int c = 0; c < 3; c++)
                        b->light[c] = (double)rgb[c];
                    b->luminance = y;
                    b->share = weight / weights;
                }
            }
    }
    return count;
}

static double light_about(const struct bright_texel *bright, int count, const double axis[3])
{
    double sum = 0;
    for (int i = 0; i < count; i++)
        if (dot(bright[i].direction, axis) > LAMP_COSINE)
            sum += bright[i].luminance * bright[i].share;
    return sum;
}

static void find_lamp(const struct lam_environment *cube, struct bright_texel *bright, struct environment_lamp *lamp)
{
    double mean = 0, most = 0, axis[3] = {0, 1, 0}, sum[3] = {0, 0, 0}, light[3] = {0, 0, 0}, total = 0, spread = 0;
    int count = list_bright(cube, bright, &mean);
    for (int i = 0; i < LAM_FACE_COUNT * CANDIDATE_SIZE * CANDIDATE_SIZE; i++) {
        int within = i % (CANDIDATE_SIZE * CANDIDATE_SIZE);
        double d[3];
        texel_direction(CANDIDATE_SIZE, i / (CANDIDATE_SIZE * CANDIDATE_SIZE), within % CANDIDATE_SIZE,
                        within / CANDIDATE_SIZE, d);
        double about = light_about(bright, count, d);
        if (about > most) {
            most = about;
            memcpy(axis, d, sizeof axis);
        }
    }
    *lamp = (struct environment_lamp){.present = most > LEAST_SHARE * mean && most > 0};
    if (!lamp->present)
        return;
    for (int i = 0; i < count; i++) {
        const struct bright_texel *b = &bright[i];
        if (!(dot(b->direction, axis) > LAMP_COSINE))
            continue;
        total += b->luminance * b->share;
        for (int c = 0; c < 3; c++) {
            light[c] += b->light[c] * b->share;
            sum[c] += b->luminance * b->share * b->direction[c];
        }
    }
    double length = math_sqrt(dot(sum, sum));
    for (int c = 0; c < 3; c++) {
        lamp->direction[c] = sum[c] / length;
        lamp->color[c] = (float)(light[c] * SOLID_ANGLE / PI);
    }
    // The mean of the cosines over a uniform disc of angular radius a is (1 + cos a) / 2.
    spread = 2 * length / total - 1;
    double radius = math_acos(spread);
    lamp->angular_radius_rad = (float)(radius > RADIUS_LEAST ? radius : RADIUS_LEAST);
}

static lock one_maker = LOCK_INITIALIZER;

bool environment_lamp(const struct lam_environment *cube, struct environment_lamp *lamp, struct call_control *call,
                      lam_error *error)
{
    const struct environment_light *light = environment_light(cube, 1, NULL, call, error);
    if (!light)
        return false;
    struct environment_light *kept = (struct environment_light *)(uintptr_t)light;
    bool ok = true;
    lock_take(&one_maker);
    if (!kept->lamp) {
        struct cube_chain chain;
        ok = cube_chain_make(&chain, cube, NULL, call, error);
        if (ok) {
            const struct lam_environment *small = cube_chain_near(&chain, LAMP_SIZE);
            size_t bytes =
                (size_t)LAM_FACE_COUNT * (size_t)small->size * (size_t)small->size * sizeof(struct bright_texel);
            struct bright_texel *bright = malloc(bytes);
            struct environment_lamp *found = malloc(sizeof *found);
            ok = (bright && found) || fail_memory(error, bytes);
            if (ok) {
                find_lamp(small, bright, found);
                kept->lamp = found;
            } else {
                free(found);
            }
            free(bright);
            cube_chain_free(&chain);
        }
    }
    if (ok)
        *lamp = *kept->lamp;
    lock_give(&one_maker);
    return ok;
}

// Subtracts the lamp's light from the irradiance.
static void take_lamp(struct lam_environment *irradiance, const struct lam_environment *whole,
                      const struct environment_lamp *lamp)
{
    int n = whole->size;
    for (int face = 0; face < LAM_FACE_COUNT; face++)
        for (int i = 0; i < n * n; i++) {
            const float *from = cube_texel(whole, face, i % n, i / n);
            float *to = cube_texel(irradiance, face, i % n, i / n);
            double d[3];
            texel_direction(n, face, i % n, i / n, d);
            double facing = dot(d, lamp->direction);
            for (int c = 0; c < 3; c++) {
                double rest = (double)from[c] - (facing > 0 ? facing : 0) * (double)lamp->color[c];
                to[c] = rest > 0 ? (float)rest : 0;
            }
        }
    cube_close(irradiance);
}

const struct environment_light *environment_light_without_lamp(const struct lam_environment *cube, unsigned needed,
                                                               struct pool *pool, struct call_control *call,
                                                               lam_error *error)
{
    struct environment_lamp lamp;
    const struct environment_light *whole =
        environment_light(cube, needed | 1u << ENVIRONMENT_LEVELS, pool, call, error);
    if (!whole || !environment_lamp(cube, &lamp, call, error))
        return NULL;
    if (!lamp.present)
        return whole;
    struct environment_light *kept = (struct environment_light *)(uintptr_t)whole, *rest;
    lock_take(&one_maker);
    rest = kept->without_lamp;
    size_t texels = (size_t)environment_light_first(ENVIRONMENT_LEVELS) * 3;
    if (!rest) {
        size_t bytes = (texels + 3) * sizeof(float) +
                       (size_t)environment_light_rows() * ENVIRONMENT_LIGHT_WIDTH * 3 * sizeof(float) +
                       CUBE_TEXELS_AFTER;
        rest = calloc(1, sizeof *rest);
        size_t held;
        float *memory = rest ? pages_get_sparse(bytes, &held) : NULL;
        if (memory) {
            // Copies the members one by one, because another thread may be adding levels and changing `made`.
            memcpy(rest->level, whole->level, sizeof rest->level);
            rest->held = held;
            rest->texels = memory;
            rest->irradiance = whole->irradiance;
            rest->irradiance.texels = memory + texels;
            take_lamp(&rest->irradiance, &whole->irradiance, &lamp);
            kept->without_lamp = rest;
        } else {
            free(rest);
            rest = NULL;
            fail_memory(error, bytes);
        }
    }
    if (rest && needed == ENVIRONMENT_LIGHT_ALL && !rest->made) { // in one block, for OpenGL
        memcpy(rest->texels, whole->texels, texels * sizeof(float));
        rest->made = 1;
    }
    lock_give(&one_maker);
    return rest;
}
