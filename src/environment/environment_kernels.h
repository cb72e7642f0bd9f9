// environment_kernels.h: the sums by which an environment becomes light, compiled once for each instruction set (meson.build).
// The lanes are texels: every set gives the same bytes.
#ifndef ENVIRONMENT_KERNELS_H
#define ENVIRONMENT_KERNELS_H

#include "environment_light.h"

// A part of a lobe, seen from its axis.
struct cell {
    float x, y, z; // unit, z along the lobe's axis
    float weight;  // all of them sum to 1
    const struct lam_environment *cube;
};
enum { CELLS_MAX = 1024 };
struct lobe_cells {
    int near, count; // the far ones follow the near ones
    struct cell cell[CELLS_MAX];
};

// The texels of a small copy of a cube, each with the one in the opposite direction.
struct cube_sums {
    size_t count;
    struct opposite_texels {
        float direction[3], share;       // unit; of the sphere, of either
        float light[3], light_behind[3]; // times the share
    } pair[];
};

struct environment_kernels {
    // Row t of a face of `out`: the sums of the cells from `first` to `end`, and of a cube that holds the sums of others; NULL:
    // none.
    void (*prefilter_row)(const struct lobe_cells *cells, int first, int end, const struct lam_environment *others,
                          struct lam_environment *out, int face, int t);
    // The same from all texels of a small copy. `alpha` < 0: the irradiance; else GGX's lobe of that alpha = roughness².
    void (*cube_sums_row)(const struct cube_sums *sums, double alpha, struct lam_environment *out, int face, int t);
};

extern const struct environment_kernels environment_kernels_scalar, environment_kernels_avx2,
    environment_kernels_avx512;

// The unit direction of a texel.
void texel_direction(int size, int face, int s, int t, float out[3]);

#endif
