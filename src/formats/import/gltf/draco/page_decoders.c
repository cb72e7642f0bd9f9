// page_decoders.c: calls the Draco decoders that the surrounding web page provides. Draco and meshoptimizer are in a
// second WebAssembly module (web/decoders.py). JavaScript (web/decoders.js) calls that module and copies the bytes
// between the memories of the two modules. expat is a part of the module itself.
#include "draco_module.h"

#include <expat.h>
#include <stdbool.h>
#include <string.h>

#define IMPORT(name) __attribute__((import_module("env"), import_name(#name)))

void *page_library(const char *name);
bool page_library_find(void *library, const char *name, void *function);

// Returns whether the module is loaded. If not, the page downloads the module and then reads the file again.
int web_decoders(void) IMPORT(web_decoders);
// Stores the mesh's handle and its numbers of vertices and triangles in `out`. This function and the next one return
// the same results as the members of draco_functions.
int web_draco_decode(const uint8_t *bytes, size_t size, uint32_t out[3], char *reason) IMPORT(web_draco_decode);
int web_draco_attribute(uint32_t mesh, uint32_t id, int component, int width, void *out, char *reason)
    IMPORT(web_draco_attribute);
void web_draco_triangles(uint32_t mesh, uint32_t *out) IMPORT(web_draco_triangles);
void web_draco_free(uint32_t mesh) IMPORT(web_draco_free);
// `kind` is 0 for vertices, 1 for triangles, 2 for a sequence of indices. Returns 0 or an error number.
int web_meshopt_decode(int kind, void *out, size_t count, size_t stride, const uint8_t *bytes, size_t size)
    IMPORT(web_meshopt_decode);
// `kind` is 0 for the octahedral filter, 1 for the quaternion filter, 2 for the exponential filter.
void web_meshopt_filter(int kind, void *data, size_t count, size_t stride) IMPORT(web_meshopt_filter);

// The WebAssembly module of the decoders does not count memory, because the browser limits memory.
static int decode(const uint8_t *bytes, size_t size, struct draco_memory *memory, void **mesh, uint32_t *vertices,
                  uint32_t *triangles, char reason[DRACO_REASON_SIZE])
{
    uint32_t out[3] = {0};
    (void)memory;
    strcpy(reason, "the decoder failed");
    int result = web_draco_decode(bytes, size, out, reason);
    *mesh = (void *)(uintptr_t)out[0];
    *vertices = out[1];
    *triangles = out[2];
    return result;
}

static int attribute(const void *mesh, uint32_t id, int component, int width, void *out, char reason[DRACO_REASON_SIZE])
{
    strcpy(reason, "the decoder failed");
    return web_draco_attribute((uint32_t)(uintptr_t)mesh, id, component, width, out, reason);
}

static void triangles(const void *mesh, uint32_t *out) { web_draco_triangles((uint32_t)(uintptr_t)mesh, out); }
static void free_mesh(void *mesh) { web_draco_free((uint32_t)(uintptr_t)mesh); }

static const struct draco_functions *draco_functions(void)
{
    static const struct draco_functions functions = {DRACO_MODULE_VERSION, decode, attribute, triangles, free_mesh};
    return &functions;
}

static int vertices(void *out, size_t count, size_t stride, const uint8_t *bytes, size_t size)
{
    return web_meshopt_decode(0, out, count, stride, bytes, size);
}

static int triangle_indices(void *out, size_t count, size_t stride, const uint8_t *bytes, size_t size)
{
    return web_meshopt_decode(1, out, count, stride, bytes, size);
}

static int index_sequence(void *out, size_t count, size_t stride, const uint8_t *bytes, size_t size)
{
    return web_meshopt_decode(2, out, count, stride, bytes, size);
}

static void octahedral(void *data, size_t count, size_t stride) { web_meshopt_filter(0, data, count, stride); }
static void quaternions(void *data, size_t count, size_t stride) { web_meshopt_filter(1, data, count, stride); }
static void exponential(void *data, size_t count, size_t stride) { web_meshopt_filter(2, data, count, stride); }

static const struct {
    const char *name;
    void (*function)(void);
} functions[] = {
#define EXPAT(name) {#name, (void (*)(void))name}
    EXPAT(XML_ParserCreate_MM),
    EXPAT(XML_ParserFree),
    EXPAT(XML_SetUserData),
    EXPAT(XML_SetElementHandler),
    EXPAT(XML_SetCharacterDataHandler),
    EXPAT(XML_SetStartDoctypeDeclHandler),
    EXPAT(XML_Parse),
    EXPAT(XML_StopParser),
    EXPAT(XML_GetErrorCode),
    EXPAT(XML_ErrorString),
    EXPAT(XML_GetCurrentLineNumber),
    EXPAT(XML_GetCurrentByteIndex),
    EXPAT(XML_SetReparseDeferralEnabled),
    {"lambent_draco_functions", (void (*)(void))draco_functions},
    {"meshopt_decodeVertexBuffer", (void (*)(void))vertices},
    {"meshopt_decodeIndexBuffer", (void (*)(void))triangle_indices},
    {"meshopt_decodeIndexSequence", (void (*)(void))index_sequence},
    {"meshopt_decodeFilterOct", (void (*)(void))octahedral},
    {"meshopt_decodeFilterQuat", (void (*)(void))quaternions},
    {"meshopt_decodeFilterExp", (void (*)(void))exponential},
};

void *page_library(const char *name)
{
    if (strncmp(name, "libexpat", 8) == 0)
        return (void *)(uintptr_t)functions;
    bool known = strcmp(name, "lambent-draco.so") == 0 || strncmp(name, "libmeshoptimizer", 16) == 0;
    return known && web_decoders() ? (void *)(uintptr_t)functions : NULL;
}

bool page_library_find(void *library, const char *name, void *function)
{
    for (size_t i = 0; library && i < sizeof functions / sizeof *functions; i++)
        if (strcmp(functions[i].name, name) == 0) {
            memcpy(function, &functions[i].function, sizeof functions[i].function);
            return true;
        }
    return false;
}
