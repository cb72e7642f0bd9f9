// environment_kernels.h: the sums that convert an environment to the light that materials receive. The code is compiled
// once for each instruction set (meson.build). Each lane is one texel, so the results are identical with every
// instruction set.
#ifndef ENVIRONMENT_KERNELS_H
#define ENVIRONMENT_KERNELS_H

#include "cpu_features.h"
#include "environment_light.h"

// A cell of a lobe, relative to the lobe's axis.
struct cell {
    float x, y, z; // unit vector; z is along the lobe's axis
    float weight;  // the weights of a lobe sum to 1
    const struct lam_environment *cube;
};
enum { CELLS_MAX = 1024 };
struct lobe_cells {
    int near, count; // the far cells follow the near cells
    struct cell cell[CELLS_MAX];
};

// The texels of a small copy of a cube, each paired with the texel in the opposite direction.
struct cube_sums {
    size_t count;
    struct opposite_texels {
        float direction[3], share;       // a unit vector; the fraction of the sphere that each texel covers
        float light[3], light_behind[3]; // the texel's light times `share`
    } pair[];
};

struct environment_kernels {
    // Computes row t of a face of `out`. Each texel is the sum of the cells from `first` to `end`, plus the texel at
    // the same position in `others` (may be NULL), which contains the sums of the other cells.
    void (*prefilter_row)(const struct lobe_cells *cells, int first, int end, const struct lam_environment *others,
                          struct lam_environment *out, int face, int t);
    // Computes row t of a face of `out`, and the texels in the opposite directions, from all texels of a small copy. If
    // `alpha` is below 0, the row contains the irradiance. Otherwise the row contains the environment prefiltered with
    // the GGX lobe, with alpha = roughness². `face` is LAM_FACE_PX, LAM_FACE_PY or LAM_FACE_PZ.
    void (*cube_sums_row)(const struct cube_sums *sums, double alpha, struct lam_environment *out, int face, int t);
};

CPU_VERSIONS(const struct environment_kernels, environment_kernels);

// Returns the texel whose direction is opposite to the direction of a texel of LAM_FACE_PX, LAM_FACE_PY or LAM_FACE_PZ.
// On the opposite face, the order of the rows is reversed. On LAM_FACE_NY, the order of the columns is reversed instead
// (cube_direction).
static inline float *cube_opposite(const struct lam_environment *cube, int face, int s, int t)
{
    int last = cube->size - 1;
    bool upper = face == LAM_FACE_PY;
    return cube_texel(cube, face + 1, upper ? last - s : s, upper ? t : last - t);
}

// Computes the unit direction of a texel.
void texel_direction(int size, int face, int s, int t, float out[3]);

#endif
