// environment_samples.c: selects fixed directions towards the light of an environment.
#define LANES 1
#include "cube_lookup.h"

#include "environment.h"
#include "fail.h"
#include "linear.h"

enum { DENSITY_SIZE = 128 }; // approximate size of the copy used for importance sampling

// Returns the fraction whose binary digits are the bits of `i` in reverse order.
static double radical_inverse(uint32_t i)
{
    double value = 0, digit = 0.5;
    for (; i; i >>= 1, digit /= 2)
        value += i & 1 ? digit : 0;
    return value;
}

// For each texel in a row of a face, stores the brightness times the solid angle in `weights`. Returns the sum.
static double weigh_row(const struct lam_environment *cube, int face, int t, double *weights)
{
    double sum = 0;
    for (int s = 0; s < cube->size; s++) {
        const float *texel = cube_texel(cube, face, s, t);
        double light = (double)texel[0] + (double)texel[1] + (double)texel[2];
        weights[s] = light * (double)texel_weight(cube->size, s, t);
        sum += weights[s];
    }
    return sum;
}

// Returns the direction of a point on a face (coordinates −1 to 1), and the light from this direction.
static struct sampled_light light_at(const struct lam_environment *cube, const float to_environment[3][3], int face,
                                     double across, double down, double density)
{
    double d[3], square = 1 + across * across + down * down;
    cube_direction(face, 1, across, down, d);
    lam_vec3 unit = v3_scale(v3(d[0], d[1], d[2]), 1 / math_sqrt(square));
    struct cube_color color = cube_look(cube, (float)unit.x, (float)unit.y, (float)unit.z);
    struct sampled_light light = {.density = (float)(density * square * math_sqrt(square)),
                                  .color = {color.r, color.g, color.b}};
    for (int i = 0; i < 3; i++)
        light.direction[i] = (float)((double)to_environment[0][i] * unit.x + (double)to_environment[1][i] * unit.y +
                                     (double)to_environment[2][i] * unit.z);
    return light;
}

struct drawing {
    const struct lam_environment *cube, *small;
    const float (*to_environment)[3];
    // The brightness of each row of the small copy, of each texel in one row, and of the whole copy.
    double *rows, *weights, total;
};

// Selects directions towards the environment's light. The first coordinate of a point selects the row, and the second
// selects the texel in the row. After the selection, the remainders of both coordinates give the position in the texel.
static void draw_lights(const struct drawing *d, struct environment_samples *out)
{
    int size = d->small->size, row = 0, weighed = -1;
    double below = 0; // the sum of the previous rows
    for (int i = 0; i < out->light_count; i++) {
        double at = (i + 0.5) / out->light_count * d->total;
        while (row + 1 < LAM_FACE_COUNT * size && at >= below + d->rows[row])
            below += d->rows[row++];
        int face = row / size, t = row % size, s = 0;
        if (weighed != row)
            weigh_row(d->small, face, t, d->weights);
        weighed = row;
        double in_row = radical_inverse((uint32_t)i) * d->rows[row], before = 0;
        while (s + 1 < size && in_row >= before + d->weights[s])
            before += d->weights[s++];
        double along = d->weights[s] > 0 ? (in_row - before) / d->weights[s] : 0.5;
        double through = d->rows[row] > 0 ? (at - below) / d->rows[row] : 0.5;
        along = along < 1 ? along : 1;
        through = through < 1 ? through : 1;
        out->light[i] = light_at(d->cube, d->to_environment, face, 2 * (s + along) / size - 1,
                                 2 * (t + through) / size - 1, (double)out->density[row * size + s]);
    }
}

// Computes the sums of the rows, and the density.
static void weigh(struct drawing *d, float *density)
{
    int size = d->small->size, rows = LAM_FACE_COUNT * size;
    d->total = 0;
    for (int row = 0; row < rows; row++)
        d->total += d->rows[row] = weigh_row(d->small, row / size, row % size, d->weights);
    double area = 4.0 / ((double)size * size);
    for (int row = 0; row < rows; row++) {
        weigh_row(d->small, row / size, row % size, d->weights);
        for (int s = 0; s < size; s++)
            density[row * size + s] = d->total > 0 ? (float)(d->weights[s] / (d->total * area)) : 0;
    }
}

bool environment_samples_make(struct environment_samples *samples, const struct lam_environment *cube,
                              const float to_environment[3][3], int count, struct buffer *storage,
                              struct call_control *call, lam_error *error)
{
    struct cube_chain chain;
    if (!cube_chain_make(&chain, cube, NULL, call, error))
        return false;
    struct drawing d = {.cube = cube, .small = cube_chain_near(&chain, DENSITY_SIZE), .to_environment = to_environment};
    size_t size = (size_t)d.small->size, rows = LAM_FACE_COUNT * size;
    *samples = (struct environment_samples){.light_count = count, .size = (int)size};
    size_t bytes =
        (rows + size) * sizeof(double) + (size_t)count * sizeof(struct sampled_light) + rows * size * sizeof(float);
    bool ok = buffer_reserve(storage, bytes, call, error);
    if (ok) {
        d.rows = storage->data;
        d.weights = d.rows + rows;
        samples->light = (struct sampled_light *)(d.weights + size);
        float *density = (float *)(samples->light + count);
        samples->density = density;
        weigh(&d, density);
        if (!(d.total > 0)) // a black environment has no directions towards light
            samples->light_count = 0;
        draw_lights(&d, samples);
    }
    cube_chain_free(&chain);
    return ok;
}
