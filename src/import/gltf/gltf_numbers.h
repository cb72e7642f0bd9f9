// gltf_numbers.h: the numbers of accessors as floats, as indices and as colours.
#ifndef GLTF_NUMBERS_H
#define GLTF_NUMBERS_H

#include "gltf.h"

// The numbers as floats, `width` for each element one after the other: the file's own bytes where they already are
// that, else converted into the scene's arena; kept for the next call. Normalised integers become −1…1 or 0…1 (section
// 3.6.2.2). NULL: an error.
//
// Numbers that are not finite are an error at `place` (`required`), or become 0 with a warning.
const float *gltf_floats(struct gltf *gltf, const struct place *place, struct gltf_accessor *accessor, bool required);

// The numbers of a SCALAR accessor of an unsigned type, which was checked; sets accessor->max_index. NULL: an error.
const uint32_t *gltf_indices(struct gltf *gltf, const struct place *place, struct gltf_accessor *accessor);

// Element `index` of an accessor as `width` floats, for accessors with few of them. `sparse` is not applied.
void gltf_element(const struct gltf_accessor *accessor, size_t index, float *out);

// Colours of VEC3 or VEC4 as a mesh has them. `opaque`: an alpha is 1, whatever the file says.
struct gltf_colors {
    const void *items;
    lam_colors_format format;
};
bool gltf_colors(struct gltf *gltf, const struct place *place, struct gltf_accessor *accessor, bool opaque,
                 struct gltf_colors *out);

#endif
