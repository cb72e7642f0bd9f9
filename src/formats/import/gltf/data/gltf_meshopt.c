// gltf_meshopt.c: decodes bufferViews that are compressed with KHR_meshopt_compression or its predecessor
// EXT_meshopt_compression. The meshoptimizer library does the decoding and is loaded on demand. If its installed version
// is too old for a bufferView, Lambent reads the uncompressed bytes if the file has them.
// https://github.com/KhronosGroup/glTF/tree/main/extensions/2.0/Khronos/KHR_meshopt_compression
#include "gltf_data.h"

#include "gltf_json.h"

#include "dynamic_library.h"
#include "fail.h"
#include "remedy.h"

enum mode { ATTRIBUTES, TRIANGLES, INDICES };
enum filter { NO_FILTER, OCTAHEDRAL, QUATERNION, EXPONENTIAL, COLOR };

static const struct json_choice modes[] = {
    {"ATTRIBUTES", ATTRIBUTES}, {"TRIANGLES", TRIANGLES}, {"INDICES", INDICES}, {NULL, 0}};
static const struct json_choice filters[] = {{"NONE", NO_FILTER},        {"OCTAHEDRAL", OCTAHEDRAL},
                                             {"QUATERNION", QUATERNION}, {"EXPONENTIAL", EXPONENTIAL},
                                             {"COLOR", COLOR},           {NULL, 0}};

// Debian 12's version 0.18 has neither the colour filter nor version 1 of compressed attributes.
#define TOO_OLD "the installed libmeshoptimizer is too old"

typedef int decode_fn(void *out, size_t count, size_t size, const unsigned char *bytes, size_t byte_count);
typedef void filter_fn(void *buffer, size_t count, size_t stride);

static const char *const decoder_names[] = {"meshopt_decodeVertexBuffer", "meshopt_decodeIndexBuffer",
                                            "meshopt_decodeIndexSequence"};
static const char *const filter_names[] = {NULL, "meshopt_decodeFilterOct", "meshopt_decodeFilterQuat",
                                           "meshopt_decodeFilterExp", "meshopt_decodeFilterColor"};

// A compressed view, with the members of the extension.
struct compressed {
    int buffer, mode, filter;
    size_t offset, length, stride, count;
};

// Returns an object's extension by either name, or NULL.
static const json_t *extension_of(const json_t *object, const char **name)
{
    const json_t *found = gltf_extension(object, *name = "KHR_meshopt_compression");
    return found ? found : gltf_extension(object, *name = "EXT_meshopt_compression");
}

// Returns whether a buffer is only a placeholder, because other buffers contain all of its views in compressed form.
static bool is_fallback(const json_t *buffer)
{
    const char *name;
    return json_is_true(json_object_get(extension_of(buffer, &name), "fallback"));
}

static bool check(struct gltf *gltf, const struct place *place, const struct compressed *c)
{
    if (c->buffer < 0 || !c->length || !c->stride || !c->count)
        return json_fail(&gltf->json, place, "%s is missing",
                         c->buffer < 0 ? "buffer"
                         : !c->length  ? "byteLength"
                         : !c->stride  ? "byteStride"
                                       : "count");
    if (c->mode == ATTRIBUTES && c->stride % 4 != 0)
        return json_fail(&gltf->json, KEY_OF(place, "byteStride"), "found %zu, expected a multiple of 4 up to 256",
                         c->stride);
    if (c->mode != ATTRIBUTES && c->stride != 2 && c->stride != 4)
        return json_fail(&gltf->json, KEY_OF(place, "byteStride"), "found %zu, expected 2 or 4 for indices", c->stride);
    if (c->mode == TRIANGLES && c->count % 3 != 0)
        return json_fail(&gltf->json, KEY_OF(place, "count"), "found %zu, expected a multiple of 3 for triangles",
                         c->count);
    bool fits = c->filter == NO_FILTER || (c->mode == ATTRIBUTES && (c->filter == QUATERNION    ? c->stride == 8
                                                                     : c->filter == EXPONENTIAL ? true
                                                                                                : c->stride <= 8));
    return fits || json_fail(&gltf->json, KEY_OF(place, "filter"), "the filter %s does not support %s of %zu bytes",
                             filters[c->filter].name, modes[c->mode].name, c->stride);
}

static bool take(struct gltf *gltf, const struct place *place, const json_t *object, struct compressed *c)
{
    *c = (struct compressed){.buffer = -1};
    if (!gltf_take_index(gltf, place, object, "buffer", "buffers", &c->buffer) ||
        !gltf_take_whole(gltf, place, object, "byteOffset", 0, 9e15, &c->offset) ||
        !gltf_take_whole(gltf, place, object, "byteLength", 1, 9e15, &c->length) ||
        !gltf_take_whole(gltf, place, object, "byteStride", 1, 256, &c->stride) ||
        !gltf_take_whole(gltf, place, object, "count", 1, 4e9, &c->count) ||
        !json_take_word(&gltf->json, place, object, "mode", modes, &c->mode) ||
        !json_take_word(&gltf->json, place, object, "filter", filters, &c->filter))
        return false;
    if (!json_object_get(object, "mode"))
        return json_fail(&gltf->json, place, "mode is missing");
    return check(gltf, place, c);
}

// Loads the library and finds the functions for a view. Returns the reason if that fails, otherwise NULL.
static const char *find_functions(struct gltf *gltf, const struct compressed *c, decode_fn **decode, filter_fn **filter)
{
    static const char *const names[] = {"libmeshoptimizer.so.2d", "libmeshoptimizer.so.2", "libmeshoptimizer.so"};
    for (size_t i = 0; i < sizeof names / sizeof *names && !gltf->meshopt; i++)
        gltf->meshopt = library_open(names[i], false, NULL);
    if (!gltf->meshopt)
        return "libmeshoptimizer is not installed (Debian's package libmeshoptimizer2d)";
    bool found = library_find(gltf->meshopt, decoder_names[c->mode], (void *)decode) &&
                 (!c->filter || library_find(gltf->meshopt, filter_names[c->filter], (void *)filter));
    return found ? NULL : TOO_OLD;
}

static bool decode(struct gltf *gltf, const struct place *place, const struct compressed *c, decode_fn *decode_bytes,
                   filter_fn *filter, const char **missing, struct gltf_view *out)
{
    enum { REFUSES_VERSION = -1, VERSION_1 = 0xa1 }; // a result of the library; the first byte of the compressed data
    const uint8_t *bytes;
    if (!gltf_buffer_bytes(gltf, place, c->buffer, c->offset, c->length, &bytes))
        return false;
    uint8_t *plain = arena_array(&gltf->scene->arena, c->count, c->stride);
    if (!plain)
        return gltf_no_memory(gltf, c->count * c->stride);
    int failed = decode_bytes(plain, c->count, c->stride, bytes, c->length);
    if (failed == REFUSES_VERSION && c->mode == ATTRIBUTES && *bytes == VERSION_1)
        return *missing = TOO_OLD, true;
    if (failed)
        return json_fail(&gltf->json, place, "the compressed bytes are damaged");
    if (filter)
        filter(plain, c->count, c->stride);
    *out = (struct gltf_view){.data = plain, .size = c->count * c->stride, .buffer = -1};
    return true;
}

bool gltf_meshopt_decode(struct gltf *gltf, const struct place *place, const json_t *view, struct gltf_view *out,
                         bool *done)
{
    const char *name, *missing;
    const json_t *object = extension_of(view, &name);
    const struct place *here = KEY_OF(KEY_OF(place, "extensions"), name);
    struct compressed c;
    decode_fn *decode_bytes = NULL;
    filter_fn *filter = NULL;
    size_t length = 0;
    int plain = -1;
    *done = false;
    if (!object)
        return true;
    if (!take(gltf, here, object, &c) || !gltf_take_index(gltf, place, view, "buffer", "buffers", &plain) ||
        !gltf_take_whole(gltf, place, view, "byteLength", 1, 9e15, &length))
        return false;
    if (length != c.count * c.stride)
        return json_fail(&gltf->json, KEY_OF(place, "byteLength"), "found %zu, but %zu elements of %zu bytes are %zu",
                         length, c.count, c.stride, c.count * c.stride);
    missing = find_functions(gltf, &c, &decode_bytes, &filter);
    if (!missing && !decode(gltf, here, &c, decode_bytes, filter, &missing, out))
        return false;
    if (missing) {
        const json_t *buffer = plain >= 0 ? gltf_list_item(gltf, "buffers", plain) : NULL;
        bool has_plain = buffer && (json_object_get(buffer, "uri") || !is_fallback(buffer));
        return has_plain || fail(gltf->json.error, LAM_UNSUPPORTED,
                                 "%s: is compressed by %s, " REMEDY(
                                     "and %s", "which this page cannot read (%s); use the program lambent"),
                                 gltf->source->name, name, missing);
    }
    *done = true;
    out->stride = c.mode == ATTRIBUTES ? c.stride : 0;
    return true;
}
