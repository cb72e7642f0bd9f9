// draco_module.h: the interface of lambent-draco, a separate shared object that calls Draco's C++ library. gltf_draco.c
// loads it on demand, so that programs start without it. It never throws exceptions to its caller.
#ifndef DRACO_MODULE_H
#define DRACO_MODULE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// Increment it with every change of the functions below.
enum { DRACO_MODULE_VERSION = 2 };

enum { DRACO_REASON_SIZE = 160 };

// The memory budget of a decoding. A file of some kilobytes can declare thousands of attributes for each of thousands
// of vertices, so the header gives no useful bound.
struct draco_memory {
    size_t granted; // bytes
    // Requests more memory and adds it to `granted`. Returns 0 if there is no more memory; decoding then ends as if
    // memory had run out.
    int (*grant)(struct draco_memory *memory, size_t bytes);
    void *user;
};

struct draco_functions {
    int version;
    // Decodes a mesh. The result is 1 if *mesh and its numbers of vertices and triangles are set. It is 0 if the bytes
    // are damaged; `reason` then says why. It is −1 if memory or the granted memory ran out.
    int (*decode)(const uint8_t *bytes, size_t size, struct draco_memory *memory, void **mesh, uint32_t *vertices,
                  uint32_t *triangles, char reason[DRACO_REASON_SIZE]);
    // Writes the attribute with this unique id, `width` numbers of a glTF component type for each vertex, contiguously.
    // The results are the same.
    int (*attribute)(const void *mesh, uint32_t id, int component, int width, void *out,
                     char reason[DRACO_REASON_SIZE]);
    // Writes three vertices for each triangle.
    void (*triangles)(const void *mesh, uint32_t *out);
    void (*free)(void *mesh);
};

// The only symbol of the shared object, apart from C++'s operators new and delete, with which it counts Draco's memory.
const struct draco_functions *lambent_draco_functions(void);

#ifdef __cplusplus
}
#endif
#endif
