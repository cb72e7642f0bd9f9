// environment_kernels.c: sums over many directions for LANES texels of a cube at a time. ISA and LANES are given by the build.
#include "environment_kernels.h"

#include "cube_lookup.h"
#include "linear.h"

enum { ROW_MAX = 64 }; // texels on a side of cubes by cube_sums_row, a multiple of 16

// --- lobes as cells

// Red, green, blue and one number more of a place, and of two places: the compiler's vectors round each of them as plain C does.
typedef float channels __attribute__((vector_size(16)));
typedef float channels_memory __attribute__((vector_size(16), aligned(4), may_alias));
typedef float two_places __attribute__((vector_size(32)));

LANE_FN two_places texels_at(const float *first, const float *second)
{
    channels a = (channels) * (const channels_memory *)first, b = (channels) * (const channels_memory *)second;
    return __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7);
}

LANE_FN two_places shares_of(const float part[2])
{
    channels a = (channels){0} + part[0], b = (channels){0} + part[1];
    return __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7);
}

// Adds the light of LANES places times a weight, as cube_look has it, all channels of a place side by side.
LANE_FN void add_light(two_places sum[LANES / 2], const struct lam_environment *cube, const struct cube_place *place,
                       float weight)
{
    int side = cube->size + 2;
    int32_t first[LANES];
    float s[LANES], t[LANES];
    inum column = int_of(place->s), row = int_of(place->t);
    num_store(s, place->s - num_of_int(column));
    num_store(t, place->t - num_of_int(row));
    inum_store(first, wrap_add(wrap_mul(wrap_add(wrap_mul(place->face, inum_of(side)), row), inum_of(side)), column));
    for (int i = 0; i < LANES; i += 2) {
        const float *one = cube->texels + 3 * (ptrdiff_t)first[i], *two = cube->texels + 3 * (ptrdiff_t)first[i + 1];
        two_places a = texels_at(one, two), b = texels_at(one + 3, two + 3), across = shares_of(s + i);
        one += 3 * side;
        two += 3 * side;
        two_places c = texels_at(one, two), e = texels_at(one + 3, two + 3);
        two_places upper = a + (b - a) * across, lower = c + (e - c) * across;
        sum[i / 2] += (upper + (lower - upper) * shares_of(t + i)) * weight;
    }
}

// Two directions that make a frame with the unit vector n.
static void frame_around(lam_vec3 n, lam_vec3 *x, lam_vec3 *y)
{
    double a = n.x * n.x, b = n.y * n.y, c = n.z * n.z;
    lam_vec3 far = a <= b && a <= c ? v3(1, 0, 0) : b <= c ? v3(0, 1, 0) : v3(0, 0, 1);
    *x = v3_unit(v3_cross(far, n));
    *y = v3_cross(n, *x);
}

// A row of sums of the cells from `first` to `end`, and of a cube that holds the sums of others; NULL: none.
static void prefilter_row(const struct lobe_cells *cells, int first, int end, const struct lam_environment *others,
                          struct lam_environment *out, int face, int t)
{
    for (int s = 0; s < out->size; s += LANES) {
        float frame[9][LANES];
        for (int i = 0; i < LANES; i++) {
            double d[3];
            cube_direction(face, out->size, 2 * (s + i) + 1 - out->size, 2 * t + 1 - out->size, d);
            lam_vec3 axis[3];
            axis[2] = v3_unit(v3(d[0], d[1], d[2]));
            frame_around(axis[2], &axis[0], &axis[1]);
            for (int k = 0; k < 3; k++) {
                frame[k][i] = (float)axis[k].x;
                frame[3 + k][i] = (float)axis[k].y;
                frame[6 + k][i] = (float)axis[k].z;
            }
        }
        num m[9];
        for (int k = 0; k < 9; k++)
            m[k] = num_load(frame[k]);
        two_places sum[LANES / 2] = {{0}};
        if (others) {
            struct cube_place place = cube_place(m[2], m[5], m[8], others->size);
            add_light(sum, others, &place, 1);
        }
        for (int c = first; c < end; c++) {
            const struct cell *cell = &cells->cell[c];
            struct cube_place place = cube_place(m[0] * cell->x + m[1] * cell->y + m[2] * cell->z,
                                                 m[3] * cell->x + m[4] * cell->y + m[5] * cell->z,
                                                 m[6] * cell->x + m[7] * cell->y + m[8] * cell->z, cell->cube->size);
            add_light(sum, cell->cube, &place, cell->weight);
        }
        for (int i = 0; i < LANES && s + i < out->size; i++)
            for (int c = 0; c < 3; c++)
                cube_texel(out, face, s + i, t)[c] = sum[i / 2][4 * (i % 2) + c];
    }
}

// --- lobes over all texels of a small copy

static void cube_sums_row(const struct cube_sums *sums, double alpha, struct lam_environment *cube, int face, int t)
{
    float n[3][ROW_MAX] = {{0}};
    for (int s = 0; s < cube->size; s++) {
        float d[3];
        texel_direction(cube->size, face, s, t, d);
        for (int c = 0; c < 3; c++)
            n[c][s] = d[c];
    }
    // With c = cos(angle) and (n.h)² = (1 + c) / 2, GGX's lobe is D(h) c ~ c / (1 − q (1 + c))², q = (1 − alpha²) / 2; times
    // alpha⁴, at most 1.
    float q = alpha < 0 ? 0 : (float)((1 - alpha * alpha) / 2), square = (float)(alpha * alpha);
    for (int s = 0; s < cube->size; s += LANES) {
        num x = num_load(n[0] + s), y = num_load(n[1] + s), z = num_load(n[2] + s);
        num total = num_of(0), r = num_of(0), g = num_of(0), b = num_of(0);
        for (size_t i = 0; i < sums->count; i++) {
            const float *from = sums->texel[i];
            num cosine = max_of(x * from[0] + y * from[1] + z * from[2], num_of(0)), weight = cosine;
            if (q > 0) {
                num part = square / (1.0f - q * (1.0f + cosine));
                weight = cosine * (part * part);
            }
            total += weight * from[3];
            r += weight * from[4];
            g += weight * from[5];
            b += weight * from[6];
        }
        const num mean[3] = {r / total, g / total, b / total};
        for (int k = 0; k < LANES && s + k < cube->size; k++)
            for (int c = 0; c < 3; c++)
                cube_texel(cube, face, s + k, t)[c] = lane(mean[c], k);
    }
}

#define JOIN(a, b) a##b
#define NAME(isa)  JOIN(environment_kernels_, isa)

const struct environment_kernels NAME(ISA) = {prefilter_row, cube_sums_row};
