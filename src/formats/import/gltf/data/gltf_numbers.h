// gltf_numbers.h: reads the numbers of accessors as floats, indices and colours.
#ifndef GLTF_NUMBERS_H
#define GLTF_NUMBERS_H

#include "gltf.h"

// Returns the numbers as contiguous floats, `width` for each element. If the file's own bytes have this layout, they
// are returned directly; otherwise the numbers are converted and kept for the next call. Normalised integers become
// −1…1 or 0…1 (section 3.6.2.2). Returns NULL on error.
enum {
    GLTF_KEEP = 1, // the array lives as long as the scene, not only until the load ends
    // a number that is not finite is an error at `place`; without this flag, the number becomes 0 with a warning
    GLTF_REQUIRED = 2,
    GLTF_AS_THEY_ARE = 4, // numbers that are not finite remain, for scene_repair
};
const float *gltf_floats(struct gltf *gltf, const struct place *place, struct gltf_accessor *accessor, int flags);

// Returns the numbers of a checked SCALAR accessor of an unsigned type, and sets accessor->max_index. Returns NULL on
// error.
const uint32_t *gltf_indices(struct gltf *gltf, const struct place *place, struct gltf_accessor *accessor);

// Gets colours of type VEC3 or VEC4 in a format of lam_mesh. If `opaque` is set, alpha is 1 regardless of the file.
struct gltf_colors {
    const void *items;
    lam_colors_format format;
};
bool gltf_colors(struct gltf *gltf, const struct place *place, struct gltf_accessor *accessor, bool opaque,
                 struct gltf_colors *out);

#endif
