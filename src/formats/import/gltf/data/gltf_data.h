// gltf_data.h: reads the numbers of accessors as floats, indices and colours.
#ifndef GLTF_DATA_H
#define GLTF_DATA_H

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

// --- accessors (section 3.6.2): typed arrays in the file's buffers.

bool gltf_accessors_start(struct gltf *gltf);

// Gets the accessor that a key of `object` refers to. *out is NULL if the key is missing. Returns false on error.
bool gltf_take_accessor(struct gltf *gltf, const struct place *place, const json_t *object, const char *key,
                        struct gltf_accessor **out);

// Returns the size in bytes of a number of this component type.
static inline size_t gltf_component_size(int component)
{
    return component <= GLTF_U8 ? 1 : component <= GLTF_U16 ? 2 : 4;
}

// Returns a description of the accessor's type: "VEC3 of FLOAT", "VEC4 of normalized UNSIGNED_BYTE".
const char *gltf_accessor_words(const struct gltf_accessor *accessor, char out[64]);

// --- buffers and bufferViews (section 3.6.1).

bool gltf_buffers_start(struct gltf *gltf);

// Returns the bufferView with this index, which gltf_take_index has checked. Reads its buffer. Returns NULL on error.
const struct gltf_view *gltf_view_at(struct gltf *gltf, int index);

// Gets a range of bytes of a buffer, and reads the buffer on first use. Returns false if the range is outside the
// buffer.
bool gltf_buffer_bytes(struct gltf *gltf, const struct place *place, int index, size_t offset, size_t length,
                       const uint8_t **out);

// Marks a buffer as kept: its bytes remain in memory as long as the scene exists, because an array of the scene points
// into them.
void gltf_buffer_keep(struct gltf *gltf, int buffer);

// Moves kept buffers to the scene and releases the others. Returns false if memory runs out.
bool gltf_buffers_end(struct gltf *gltf);

// --- compressed bufferViews (KHR_meshopt_compression).

// Decodes a compressed bufferView into memory of the scene. Sets *done to true if the bufferView was decoded. If
// meshoptimizer is needed and not installed, sets *done to false, and the caller must use the bufferView's
// uncompressed bytes. A bufferView without such bytes is an error. Returns false on error.
bool gltf_meshopt_decode(struct gltf *gltf, const struct place *place, const json_t *view, struct gltf_view *out,
                         bool *done);

// --- decodes file names given as URIs, and data URIs.

// Returns whether the URI itself contains the bytes ("data:…").
bool gltf_is_data_uri(const char *uri);

// Reads the target of a URI: a file in the model's folder, or the bytes of a data URI. The caller releases `out`.
bool gltf_uri_read(struct gltf *gltf, const struct place *place, const char *uri, struct file_bytes *out);

#endif
