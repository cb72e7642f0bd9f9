// occlusion_kernels.h: the steps of screen_occlusion_find, compiled for each instruction set (occlusion_kernels.c).
#ifndef OCCLUSION_KERNELS_H
#define OCCLUSION_KERNELS_H

#include "cpu_features.h"
#include "occlusion.h"

// The steps for the rows of cells from `first` to `end` − 1:
// the depths of the cells (with step 2), their occlusion, the filter, and the pixels of the cells.
// Each step processes all rows before the next step begins.
struct occlusion_kernels {
    void (*cell_rows)(const struct screen_occlusion *occlusion, int first, int end);
    void (*occlude_rows)(const struct screen_occlusion *occlusion, int first, int end);
    void (*smooth_rows)(const struct screen_occlusion *occlusion, int first, int end);
    void (*pixel_rows)(const struct screen_occlusion *occlusion, int first, int end);
};

CPU_VERSIONS(const struct occlusion_kernels, occlusion_kernels);

#endif
