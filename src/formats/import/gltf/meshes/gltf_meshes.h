// gltf_meshes.h: the modules that read meshes (section 3.7), skins and animations. Each primitive becomes a mesh of the
// scene.
#ifndef GLTF_MESHES_H
#define GLTF_MESHES_H

#include "gltf.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// --- reads skins (section 3.7.3): the matrices of a skin's joints.

struct gltf_skin {
    lam_mat4 *joints; // from the mesh's bind space to the file's space
    size_t count;
};

// Returns the skin with this index, which must be valid. Its matrices are computed from the current transforms of the
// nodes. Returns NULL on error.
const struct gltf_skin *gltf_skin_at(struct gltf *gltf, int index);

// --- primitives

// A mesh of the file. Each of its primitives is one mesh of the scene.
struct gltf_primitive {
    int mesh;     // index in the scene; −1 means the primitive is empty
    bool skinned; // the mesh's positions are in the file's space
};
struct gltf_mesh {
    bool ready;
    int count;
    struct gltf_primitive *primitives;
};

bool gltf_meshes_start(struct gltf *gltf);

// Returns a mesh of the file. The mesh is created on first use and shared by all nodes that refer to it. Returns NULL
// on error.
const struct gltf_mesh *gltf_mesh_at(struct gltf *gltf, int index);

// Returns a separate copy of the mesh for one node, deformed by `skin` (may be NULL) and by morph targets. The weights
// of the targets are node->weights or, if node->weights is NULL, the mesh's own weights.
const struct gltf_mesh *gltf_mesh_deformed(struct gltf *gltf, int index, const struct gltf_node *node,
                                           const struct gltf_skin *skin);

// --- evaluates an animation at one time (section 3.11).

// Sets the animated values of the JSON tree for the requested time: transforms and weights of nodes, and the properties
// that KHR_animation_pointer names. If no animation is requested, the values remain as in the file.
bool gltf_animation_apply(struct gltf *gltf);

// --- applies morph targets (section 3.7.2.2) and skins (section 3.7.3.3) to a primitive.

// The changes that a node makes to its mesh.
struct gltf_deformation {
    const double *weights; // weights of the morph targets
    size_t weight_count;
    const struct gltf_skin *skin; // may be NULL
};

// Replaces the mesh's positions, normals, tangents, colours and texture coordinates with changed copies, if a skin or
// morph targets with nonzero weights change them. Sets *skinned to true if the positions are now in the file's space,
// otherwise to false.
bool gltf_deform(struct gltf *gltf, const struct place *place, const json_t *primitive,
                 const struct gltf_deformation *deformation, lam_mesh *mesh, bool *skinned);

// --- converts triangles, strips and fans to triangles, and lines, loops and strips to lines (section 3.7.2.1).

// The values of "mode" (section 5.24.4).
enum {
    GLTF_POINTS,
    GLTF_LINES,
    GLTF_LINE_LOOP,
    GLTF_LINE_STRIP,
    GLTF_TRIANGLES,
    GLTF_TRIANGLE_STRIP,
    GLTF_TRIANGLE_FAN
};

// Sets the indices and the triangle_count of the mesh from the indices of the primitive. `mode` must be one of the
// three modes for triangles. Checks that every index is below mesh->vertex_count. Drops the degenerate triangles of
// strips and fans, that is, triangles that use a vertex twice.
bool gltf_triangles(struct gltf *gltf, const struct place *place, const json_t *primitive, size_t mode, lam_mesh *mesh);

// Works like gltf_triangles, but for lines and points, and sets line_count or point_count.
bool gltf_strokes(struct gltf *gltf, const struct place *place, const json_t *primitive, size_t mode, lam_mesh *mesh);

// --- primitives compressed with Draco (KHR_draco_mesh_compression).

// Decodes a compressed primitive's attributes and indices into its accessors, and sets *mode to the mode of the decoded
// triangles. If the decoder is not installed, the accessors' uncompressed bytes are used; a file without such bytes is
// an error.
bool gltf_draco_decode(struct gltf *gltf, const struct place *place, const json_t *primitive, size_t *mode);

// --- reads the declared sizes of a mesh compressed with Draco, before the decoder allocates memory for the mesh.

struct draco_claim {
    uint32_t faces;
    uint32_t points; // a lower bound: one vertex may become several points
};

// Returns false if the header cannot be read. The decoder would also fail on such a file.
bool draco_header_read(const uint8_t *bytes, size_t size, struct draco_claim *out);

// Returns an upper bound on the memory that the decoder needs for the declared sizes. The decoder needs tables of
// corners and edges, and stores the attributes twice: as in the file and as in the mesh.
uint64_t draco_claim_bytes(const struct draco_claim *claim);

#endif
