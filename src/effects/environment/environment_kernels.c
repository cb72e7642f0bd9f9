// environment_kernels.c: computes sums over many directions, for LANES texels of a cube at a time. The build defines
// ISA and LANES.
#include "environment_kernels.h"

#include "cube_lookup.h"

#include <string.h>

enum { ROW_MAX = 64 }; // texels per side of cubes from cube_sums_row, a multiple of 16

// --- lobes divided into cells

// Two neighbouring texels of a row: red, green and blue of each, and two unused floats. The compiler's vector types
// round each float in the same way as scalar C.
typedef float texel_pair __attribute__((vector_size(32)));
typedef float texel_pair_memory __attribute__((vector_size(32), aligned(4), may_alias));
typedef double doubles __attribute__((vector_size(32)));

// The texels that LANES points read for a direction, and their weights.
struct positions {
    const float *upper, *lower; // the texels of the cube, and the same texels one row further down
    int32_t first[LANES];       // the index of the upper left texel's red
    float down[LANES];          // the weight of the lower texels
    float across[LANES][2];     // the weights of the left and the right texels
};

// Finds the texels of LANES directions. Multiplies their interpolation weights by `weight`.
LANE_FN void find_positions(struct positions *out, const struct lam_environment *cube, num x, num y, num z,
                            float weight)
{
    int side = cube->size + 2;
    float half = 0.5f * (float)cube->size, middle = half + 0.5f;
    num min = num_of(0.5f), max = num_of((float)cube->size + 0.5f);
    struct cube_side at = cube_side(x, y, z);
    num scale = half / at.major; // cube_position computes the same position, but rounds differently
    num across = min_of(max_of(at.across * scale + middle, min), max);
    num down = min_of(max_of(at.down * scale + middle, min), max);
    inum column = int_of(across), row = int_of(down);
    inum_store(out->first,
               wrap_mul(wrap_add(wrap_mul(wrap_add(wrap_mul(at.face, inum_of(side)), row), inum_of(side)), column),
                        inum_of(3)));
    num right = (across - num_of_int(column)) * weight, left = weight - right;
    out->upper = cube->texels;
    out->lower = cube->texels + cube_row(cube);
    num_store(out->down, down - num_of_int(row));
    for (int i = 0; i < LANES; i++) {
        out->across[i][0] = lane(left, i);
        out->across[i][1] = lane(right, i);
    }
}

// Repeats the weight of the left texel and the weight of the right texel for each channel. Both weights are loaded in
// one step.
static inline texel_pair beside(const float weights[2])
{
    double both_weights;
    memcpy(&both_weights, weights, sizeof both_weights);
    const texel_pair repeated = (texel_pair)(doubles){both_weights, both_weights, both_weights, both_weights};
    return __builtin_shufflevector(repeated, repeated, 0, 0, 0, 1, 5, 5, 6, 7);
}

// Adds the bilinearly interpolated light of `count` directions for each of LANES points. The sums of the left texels
// and of the right texels are separate until the end, and are then added.
static inline void add_light(texel_pair sums[LANES], const struct positions *positions, int count)
{
    for (int i = 0; i < LANES; i++) {
        texel_pair sum = sums[i];
        for (const struct positions *at = positions; at < positions + count; at++) {
            texel_pair upper = *(const texel_pair_memory *)(at->upper + at->first[i]),
                       lower = *(const texel_pair_memory *)(at->lower + at->first[i]);
            sum += (upper + (lower - upper) * at->down[i]) * beside(at->across[i]);
        }
        sums[i] = sum;
    }
}

struct frames {
    num x[3], y[3], z[3]; // z is the direction of a texel; x and y are unit vectors perpendicular to it
};

LANE_FN void make_unit(num v[3])
{
    num scale = 1.0f / square_root(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int i = 0; i < 3; i++)
        v[i] = v[i] * scale;
}

LANE_FN void cross(const num a[3], const num b[3], num out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

// Returns the coordinate frames of texels s … s + LANES − 1 of a row.
LANE_FN struct frames frames_of(int size, int face, int s, int t)
{
    double start[3], step[3];
    cube_direction(face, size, 2 * s + 1 - size, 2 * t + 1 - size, start);
    cube_direction(face, 0, 2, 0, step);
    struct frames f;
    for (int i = 0; i < 3; i++)
        f.z[i] = (float)start[i] + (float)step[i] * num_of_int(lane_numbers());
    make_unit(f.z);
    // x is perpendicular to the axis that is farthest from the direction.
    num a = f.z[0] * f.z[0], b = f.z[1] * f.z[1], c = f.z[2] * f.z[2], one = num_of(1), none = num_of(0);
    mask by_x = both(a <= b, a <= c), by_y = both(negate(by_x), b <= c);
    const num far[3] = {pick(by_x, one, none), pick(by_y, one, none), pick(either(by_x, by_y), none, one)};
    cross(far, f.z, f.x);
    make_unit(f.x);
    cross(f.z, f.x, f.y);
    return f;
}

// Computes one row. Each texel is the sum of the cells from `first` to `end`, plus the texel at the same position in
// `others` (may be NULL), which contains the sums of the other cells.
static void prefilter_row(const struct lobe_cells *cells, int first, int end, const struct lam_environment *others,
                          struct lam_environment *out, int face, int t)
{
    enum { TOGETHER = 8 }; // cells
    for (int s = 0; s < out->size; s += LANES) {
        struct frames f = frames_of(out->size, face, s, t);
        struct positions at[TOGETHER];
        texel_pair sum[LANES] = {{0}};
        int count = 0, next = first;
        if (others)
            find_positions(&at[count++], others, f.z[0], f.z[1], f.z[2], 1);
        for (; next < end || count; count = 0) {
            for (; next < end && count < TOGETHER; next++) {
                const struct cell *cell = &cells->cell[next];
                num d[3];
                for (int i = 0; i < 3; i++)
                    d[i] = f.x[i] * cell->x + f.y[i] * cell->y + f.z[i] * cell->z;
                find_positions(&at[count++], cell->cube, d[0], d[1], d[2], cell->weight);
            }
            add_light(sum, at, count);
        }
        for (int i = 0; i < LANES && s + i < out->size; i++)
            for (int c = 0; c < 3; c++)
                cube_texel(out, face, s + i, t)[c] = sum[i][c] + sum[i][3 + c];
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
    // With c = cos(angle) and (n.h)² = (1 + c) / 2, the GGX lobe is proportional to D(h) c ~ c / (1 − q (1 + c))² with
    // q = (1 − alpha²) / 2. The lobe is multiplied by alpha⁴, so that its maximum is 1.
    float q = alpha < 0 ? 0 : (float)((1 - alpha * alpha) / 2), square = (float)(alpha * alpha);
    for (int s = 0; s < cube->size; s += LANES) {
        num x = num_load(n[0] + s), y = num_load(n[1] + s), z = num_load(n[2] + s);
        num total = num_of(0), sum[3] = {total, total, total}, sum_behind[3] = {total, total, total};
        for (size_t i = 0; i < sums->count; i++) {
            const struct opposite_texels *from = &sums->pair[i];
            num along = x * from->direction[0] + y * from->direction[1] + z * from->direction[2];
            num cosine = absolute(along),
                weight = cosine; // the share of the direction's weight that lies above the horizon
            mask behind = along < 0.0f;
            if (q > 0) {
                num part = square / (1.0f - q * (1.0f + cosine));
                weight = cosine * (part * part);
            }
            total += weight * from->share;
            for (int c = 0; c < 3; c++) {
                num light = num_of(from->light[c]), light_behind = num_of(from->light_behind[c]);
                sum[c] += weight * pick(behind, light_behind, light);
                sum_behind[c] += weight * pick(behind, light, light_behind);
            }
        }
        for (int c = 0; c < 3; c++) {
            num mean = sum[c] / total, mean_behind = sum_behind[c] / total;
            for (int k = 0; k < LANES && s + k < cube->size; k++) {
                cube_texel(cube, face, s + k, t)[c] = lane(mean, k);
                cube_opposite(cube, face, s + k, t)[c] = lane(mean_behind, k);
            }
        }
    }
}

const struct environment_kernels FOR_ISA(environment_kernels) = {prefilter_row, cube_sums_row};
