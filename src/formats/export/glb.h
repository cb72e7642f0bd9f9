// glb.h: the JSON and the buffer of a glTF file that is being written.
#ifndef GLB_H
#define GLB_H

#include "export.h"

#include <jansson.h>

// For each array of a mesh in the scene, the index of the array's accessor, or −1 if the mesh has no such array.
struct glb_arrays {
    bool ready;
    int position, normal, texcoords[2], tangent, color;
    int first_indices; // accessor of the first part's indices; the other parts follow
    // the latest mesh in the file that was made from this mesh in the scene, or −1; glb_mesh.before lists the earlier
    // meshes
    int first_mesh;
};

// A mesh in the file: a mesh in the scene, or one part of it, with the materials of an object.
struct glb_mesh {
    int part;     // −1: all parts
    int material; // the object's material; −1 if the parts' materials are used
    bool double_sided;
    int before; // the previous mesh in the file that was made from the same mesh in the scene, or −1
};

struct glb_image {
    const lam_texture *texture;
    int index; // the index in `images`; −1 if the picture cannot be written
};

struct glb {
    struct exporting *e;
    json_t *root, *accessors, *views, *meshes, *materials, *nodes, *images, *textures, *samplers, *lights, *cameras,
        *used;
    struct text bytes;         // the buffer
    struct glb_arrays *arrays; // one element per mesh of the scene
    struct scene_list own;     // struct glb_mesh: one element per mesh of the file
    // for each material, and then the default material, the material's index in the file: [0] one-sided, [1]
    // double-sided; −1 if not written yet
    int *material_index[2];
    struct scene_list pictures; // struct glb_image
    int thumbnail;              // index of the thumbnail's image
    bool failed;                // memory ran out while the JSON was built
};

// Sets a member or adds an element, and takes ownership of the value. If `value` is NULL, records that memory ran out.
void glb_set(struct glb *glb, json_t *object, const char *key, json_t *value);
int glb_add(struct glb *glb, json_t *list, json_t *value); // returns its index

void glb_set_name(struct glb *glb, json_t *object, const char *name); // sets nothing if the name is NULL or not UTF-8
json_t *glb_floats(struct glb *glb, const float *numbers, int count);

// Lists an extension in extensionsUsed. Returns the extension's JSON object, which is a member of `object`. If this
// member is missing, creates it.
json_t *glb_extension(struct glb *glb, json_t *object, const char *name);

// Appends bytes to the buffer, aligned to four bytes, and adds a bufferView for them. Returns the index of the
// bufferView. `target` is the bufferView's "target" in glTF, or 0.
int glb_add_view(struct glb *glb, const void *bytes, size_t size, int target);

// Fills the error with the reason why the file is incomplete, and returns false.
bool glb_error(struct glb *glb);

bool glb_append(struct glb *glb, struct scene_list *list, const void *item, size_t size);

// Writes the mesh for a part of an object (−1: all parts) unless it is already written, and returns the mesh's index in
// the file. Returns −1 if memory runs out.
int glb_mesh_of(struct glb *glb, const lam_object *object, int part);

// Writes a material (−1: the scene's default material) unless it is already written, and returns the material's index
// in the file.
int glb_material(struct glb *glb, int material, bool double_sided);

// Writes the nodes: the scene's objects, lights and cameras.
bool glb_nodes(struct glb *glb);

#endif
