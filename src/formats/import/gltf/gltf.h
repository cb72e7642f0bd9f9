// gltf.h: internals of the glTF 2.0 importer.
//
// The JSON text (gltf_json.c) of a .gltf, or of a .glb (gltf.c), describes buffers (gltf_buffers.c,
// gltf_accessors.c, gltf_meshopt.c) and typed arrays in them (gltf_accessors.c, gltf_numbers.c). The arrays become meshes
// (gltf_primitives.c, gltf_triangles.c, gltf_draco.c). The tree of nodes (gltf_nodes.c) places the meshes
// (gltf_objects.c), the lights (gltf_lights.c) and the cameras (gltf_nodes.c). Materials (gltf_materials.c) request
// textures, whose pictures are decoded together (gltf_textures.c). An animation first changes the values in the JSON
// tree (gltf_animation.c). If a mesh has morph targets or a skin (gltf_deform.c), its positions are copied and changed.
//
// Every count and index is checked when it is read. Errors name the position in the file: "ship.gltf:
// meshes[3].primitives[0].attributes.POSITION: found 12, …". Section numbers refer to the specification,
// https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html
#ifndef GLTF_H
#define GLTF_H

#include "importer.h"
#include "json_reader.h"

// A buffer: the model file's own bytes, another file, or a data URI. The buffer is read on first use.
struct gltf_buffer {
    const uint8_t *data; // NULL if not read yet
    size_t size;
    struct file_bytes file; // the owner of `data`, unless the model file owns it
    bool kept;              // the scene's arrays point into the buffer
};

// A bufferView: a range of a buffer's bytes.
struct gltf_view {
    const uint8_t *data; // NULL if not read yet
    size_t size, stride; // a stride of 0 means that the elements are contiguous
    int buffer;          // −1 if the bytes were decoded into the scene's memory
};

// componentType (section 3.6.2.2).
enum { GLTF_I8 = 5120, GLTF_U8, GLTF_I16, GLTF_U16, GLTF_U32 = 5125, GLTF_F32 };

// An accessor: a typed array.
struct gltf_accessor {
    bool ready;          // the members below are set
    const uint8_t *data; // the first element; NULL means all elements are zero
    int buffer;          // the buffer of `data`, or −1
    int draco_view;      // 1 + the view that `data` was decoded from (gltf_draco.c), or 0
    size_t count;        // elements
    size_t stride;       // bytes from one element to the next
    int component;       // GLTF_…
    int width;           // numbers per element
    const char *type;    // "VEC3"
    bool normalized;
    // Elements that replace elements of `data` (sparse accessors, section 3.6.2.3).
    size_t sparse_count;
    int sparse_component;
    const uint8_t *sparse_indices, *sparse_values;
    // These arrays are converted on first use, and are NULL until then.
    // `width` floats per element; floats[0] is kept until the load ends, floats[1] as long as the scene exists.
    const float *floats[2];
    const uint32_t *indices; // one per element
    uint32_t max_index;
    const void *colors[2]; // the colours in a format of lam_mesh: colors[0] with alpha, colors[1] with an alpha of 1
};

struct gltf {
    const struct import_source *source;
    struct lam_scene *scene;
    struct arena *scratch; // freed after the load
    struct json_reader json;
    json_t *root;
    size_t json_bytes;     // the memory of `root`, which counts towards the memory limit of the call
    const uint8_t *binary; // the .glb's BIN chunk, or NULL
    size_t binary_size;
    bool source_kept; // the scene's arrays point into the model file's own bytes

    struct gltf_buffer *buffers;
    struct gltf_view *views;
    struct gltf_accessor *accessors;
    void *meshopt;        // the library, opened when a bufferView needs it; NULL until then
    void *draco;          // the module, opened when a primitive needs it; NULL until then
    int first_material;   // the scene's index of the file's first material
    int default_material; // the scene's index of the material for primitives without a material; −1 if not created yet
    int variant;          // the requested variant, or −1
    struct gltf_problem *problems; // gltf_json.c: what is wrong in the file but not needed, in the file's order

    lam_file_image *file_images;   // one element for each image
    struct gltf_picture *pictures; // gltf_materials.h: two for each image of the file
    struct gltf_map *maps;         // the maps of materials, latest first
    // For each material, the file's numbers of the texture coordinate sets that the material uses, at most two; −1
    // marks an unused element.
    int (*texcoord_sets)[2];

    struct gltf_node *nodes;
    int node_count;
    const int *node_order;    // parents before children, children in the file's order
    struct gltf_mesh *meshes; // gltf_meshes.h

    // The numbers of skipped primitives, by the reason. Each reason causes one warning, or an error if the file
    // contains no other primitives.
    size_t without_positions, flattened;
    uint64_t morphed; // morphed vertices, counted once per target
};

#define GLTF_ALLOC(gltf, count, type) ((type *)arena_alloc_zeroed((gltf)->scratch, (size_t)(count) * sizeof(type)))

// Reports that `bytes` bytes of memory could not be allocated. Returns false.
bool gltf_no_memory(struct gltf *gltf, size_t bytes);

// --- reads the file's cameras (section 3.10).

// Adds the cameras of the scene's nodes.
bool gltf_cameras_add(struct gltf *gltf);

// --- reads .glb files: a header, and chunks that contain the JSON text and the binary buffer (section 4).

static inline bool gltf_is_binary(const uint8_t *bytes, size_t size)
{
    return size >= 4 && bytes[0] == 'g' && bytes[1] == 'l' && bytes[2] == 'T' && bytes[3] == 'F';
}

// --- checks the extensions that a file uses, and reports which of them are supported.

// Checks "asset" (section 3.2), and the extensions (section 3.12) that gltf_file_info_note found. Fails with LAM_UNSUPPORTED if
// the file requires a later version, or (unless the load is lenient) an unknown extension.
bool gltf_check_asset(struct gltf *gltf);
bool gltf_check_extensions(struct gltf *gltf);

lam_extension_support gltf_extension_support(const char *name);

// --- collects information about the file (lam_file_info).

// Stores the file's information in the scene; gltf_nodes_read stores the index of the selected scene. No buffers are
// read. Returns false if memory runs out.
bool gltf_file_info_note(struct gltf *gltf);

// --- reads the file's lights (KHR_lights_punctual).

// Adds the lights of the scene's nodes.
bool gltf_lights_add(struct gltf *gltf);

// --- reads the node tree (section 3.5).

struct gltf_node {
    int parent; // −1 for a root
    // The transform as a matrix, or as translation, rotation (a unit quaternion x y z w) and scale.
    bool has_matrix;
    double matrix[16]; // column by column
    double translation[3], rotation[4], scale[3];
    double *weights; // weights of morph targets; NULL means the mesh's weights
    size_t weight_count;
    int group;      // lam_object.group of the objects below the node
    bool visible;   // KHR_node_visibility: the node and all its ancestors are visible
    bool in_scene;  // the node belongs to the scene that is drawn
    lam_mat4 world; // transform from the node's space to the file's space
};

// Reads all nodes, checks that they form trees, and marks the nodes of the requested scene.
bool gltf_nodes_read(struct gltf *gltf);

// Computes node->world and node->visible for all nodes.
void gltf_nodes_place(struct gltf *gltf);

// Normalizes a quaternion; a zero quaternion becomes the identity.
void gltf_unit_quaternion(double q[4]);

lam_mat4 gltf_transform(const double translation[3], const double rotation[4], const double scale[3]);

// --- converts nodes with meshes to objects of the scene.

// Adds objects for the scene's nodes with meshes: one object for each primitive of the node's mesh. If the node has
// instances (EXT_mesh_gpu_instancing), adds these objects for each instance.
bool gltf_objects_add(struct gltf *gltf);

#endif
