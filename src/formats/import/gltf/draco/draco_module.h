// draco_module.h: the interface of lambent-draco, a separate shared object that calls Draco's C++ library. gltf_draco.c
// loads the module on demand, so that programs start without it. The module never throws exceptions to its caller.
#ifndef DRACO_MODULE_H
#define DRACO_MODULE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// Increment this version with every change to the functions below.
enum { DRACO_MODULE_VERSION = 2 };

enum { DRACO_REASON_SIZE = 160 };

// The memory budget for decoding a mesh. A file of a few kilobytes can declare thousands of vertices with thousands of
// attributes each, so the sizes in the header give no useful bound.
struct draco_memory {
    size_t granted; // bytes
    // Requests more memory and adds the bytes to `granted`. Returns 0 if the request is refused; decoding then fails as
    // if memory had run out.
    int (*grant)(struct draco_memory *memory, size_t bytes);
    void *user;
};

struct draco_functions {
    int version;
    // Decodes a mesh. Returns 1 if *mesh and its numbers of vertices and triangles are set. Returns 0 if the bytes are
    // damaged, and explains this in `reason`. Returns −1 if the system's memory or the granted memory ran out.
    int (*decode)(const uint8_t *bytes, size_t size, struct draco_memory *memory, void **mesh, uint32_t *vertices,
                  uint32_t *triangles, char reason[DRACO_REASON_SIZE]);
    // Writes the attribute with this unique id to `out`: `width` numbers of a glTF component type for each vertex,
    // without gaps. Returns 1, 0 or −1, like `decode`.
    int (*attribute)(const void *mesh, uint32_t id, int component, int width, void *out,
                     char reason[DRACO_REASON_SIZE]);
    // Writes the indices of three vertices for each triangle.
    void (*triangles)(const void *mesh, uint32_t *out);
    void (*free)(void *mesh);
};

// The only C function that the shared object exports. The object also exports the C++ operators new and delete, which
// count the memory that Draco allocates.
const struct draco_functions *lambent_draco_functions(void);

#ifdef __cplusplus
}
#endif
#endif
