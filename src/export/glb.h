// glb.h: the state of writing a glTF file: the trees of its JSON, and the bytes of its buffer.
#ifndef GLB_H
#define GLB_H

#include "export.h"

#include <jansson.h>

// The accessors for the arrays of a scene's mesh in the buffer; −1: none.
struct glb_arrays {
    bool ready;
    int position, normal, texcoords[2], tangent, color;
    int first_indices; // of its parts, one after the other
    int first_mesh;    // the latest of the file's meshes that is made of it (glb_mesh.before); −1: none
};

// A mesh of the file: a mesh of the scene with the materials of an object.
struct glb_mesh {
    int material; // the object's; −1: the parts' materials
    bool double_sided;
    int before; // another one of the same mesh of the scene; −1: none
};

struct glb_image {
    const lam_texture *texture;
    int index; // in `images`; −1: it cannot be written
};

struct glb {
    struct exporting *e;
    json_t *root, *accessors, *views, *meshes, *materials, *nodes, *images, *textures, *samplers, *lights, *cameras,
        *used;
    struct text bytes;         // the buffer
    struct glb_arrays *arrays; // of the scene's meshes
    struct scene_list own;     // struct glb_mesh, of each of the file's
    int *material_index
        [2]; // by whether both sides are seen: of each material, then the default one; −1: not written yet
    struct scene_list pictures; // struct glb_image
    int thumbnail;              // its image
    bool failed;                // out of memory in a tree
};

// Sets a member or adds an element, and takes ownership of the value. If the value is NULL, records that memory ran
// out.
void glb_set(struct glb *glb, json_t *object, const char *key, json_t *value);
int glb_add(struct glb *glb, json_t *list, json_t *value); // returns its number

void glb_set_name(struct glb *glb, json_t *object, const char *name); // NULL, or not UTF-8: none
json_t *glb_floats(struct glb *glb, const float *numbers, int count);

// Lists an extension in extensionsUsed, and returns its object in `object`, creating it if it is missing.
json_t *glb_extension(struct glb *glb, json_t *object, const char *name);

// Appends bytes to the buffer, aligned to four, as a view. Returns its number. `target`: of the view, or 0 if there is
// none.
int glb_add_view(struct glb *glb, const void *bytes, size_t size, int target);

bool glb_append(struct glb *glb, struct scene_list *list, const void *item, size_t size);

// Returns the number of the file's mesh for an object. −1: out of memory.
int glb_mesh_of(struct glb *glb, const lam_object *object);

// Returns the number of a material (−1: the default one).
int glb_material(struct glb *glb, int material, bool double_sided);

// Returns the object that refers to a map's texture, with its set and transform, or NULL if there is no map, or its
// picture cannot be written.
json_t *glb_texture(struct glb *glb, const lam_texture_map *map);

// Nodes: the scene's objects, lights and cameras.
bool glb_nodes(struct glb *glb);

#endif
