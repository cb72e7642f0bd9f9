// gltf.h: internals of the glTF 2.0 importer.
//
// The JSON text (gltf_json.c) of a .gltf, or of a .glb (gltf_container.c), describes buffers (gltf_buffers.c,
// gltf_views.c, gltf_meshopt.c) and typed arrays in them (gltf_accessors.c, gltf_numbers.c). The arrays become meshes
// (gltf_primitives.c, gltf_triangles.c, gltf_draco.c). The tree of nodes (gltf_nodes.c) places the meshes
// (gltf_objects.c), the lights (gltf_lights.c) and the cameras (gltf_cameras.c). Materials (gltf_materials.c) request
// textures, whose pictures are decoded together (gltf_textures.c). An animation first sets the transforms of the nodes
// (gltf_animation.c). If a mesh has morph targets or a skin (gltf_deform.c, gltf_skins.c), its positions are copied and
// changed.
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

    lam_file_image *file_images;   // one element for each image (gltf_file_info.h)
    struct gltf_picture *pictures; // gltf_textures.h: two for each image of the file
    struct gltf_map *maps;         // the maps of materials, latest first
    // For each material, the file's numbers of the texture coordinate sets that the material uses, at most two; −1
    // marks an unused element.
    int (*texcoord_sets)[2];

    struct gltf_node *nodes; // gltf_nodes.h
    int node_count;
    const int *node_order;    // parents before children, children in the file's order
    struct gltf_mesh *meshes; // gltf_primitives.h

    // The numbers of skipped primitives, by the reason. Each reason causes one warning, or an error if the file
    // contains no other primitives.
    size_t without_positions, flattened;
    uint64_t morphed; // morphed vertices, counted once per target
};

#define GLTF_ALLOC(gltf, count, type) ((type *)arena_alloc_zeroed((gltf)->scratch, (size_t)(count) * sizeof(type)))

// Reports that `bytes` bytes of memory could not be allocated. Returns false.
bool gltf_no_memory(struct gltf *gltf, size_t bytes);

#endif
