// gltf_numbers.h: reads the numbers of accessors as floats, indices and colours.
#ifndef GLTF_NUMBERS_H
#define GLTF_NUMBERS_H

#include "gltf.h"

// The numbers as floats, `width` for each element one after the other: the file's own bytes if they have this layout,
// otherwise converted; kept for the next call. Normalised integers become −1…1 or 0…1 (section 3.6.2.2). NULL: an
// error.
enum {
    GLTF_KEEP = 1,     // the array lives as long as the scene, not only until the load ends
    GLTF_REQUIRED = 2, // a number that is not finite is an error at `place`; else it becomes 0 with a warning
};
const float *gltf_floats(struct gltf *gltf, const struct place *place, struct gltf_accessor *accessor, int flags);

// Returns the numbers of a SCALAR accessor of an unsigned type, which was checked; sets accessor->max_index. Returns
// NULL on error.
const uint32_t *gltf_indices(struct gltf *gltf, const struct place *place, struct gltf_accessor *accessor);

// Colours of VEC3 or VEC4 as a mesh has them. `opaque`: an alpha is 1, whatever the file says.
struct gltf_colors {
    const void *items;
    lam_colors_format format;
};
bool gltf_colors(struct gltf *gltf, const struct place *place, struct gltf_accessor *accessor, bool opaque,
                 struct gltf_colors *out);

#endif
