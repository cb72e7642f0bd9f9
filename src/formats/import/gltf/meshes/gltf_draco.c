// gltf_draco.c: reads primitives compressed with Draco. A separate module calls Draco's library; this file opens the
// module on demand. https://github.com/KhronosGroup/glTF/tree/main/extensions/2.0/Khronos/KHR_draco_mesh_compression
#include "draco/draco_module.h"
#include "dynamic_library.h"
#include "fail.h"
#include "gltf_data.h"
#include "gltf_json.h"
#include "gltf_meshes.h"
#include "remedy.h"

#include <string.h>

#define NAME "KHR_draco_mesh_compression"

// Loads the module. *functions stays NULL if the module or Draco's library is missing.
static void find_functions(struct gltf *gltf, const struct draco_functions **functions)
{
    const struct draco_functions *(*get)(void) = NULL;
    *functions = NULL;
    if (!gltf->draco)
        gltf->draco = library_open_own("lambent-draco.so");
    if (gltf->draco && library_find(gltf->draco, "lambent_draco_functions", (void *)&get) &&
        get()->version == DRACO_MODULE_VERSION)
        *functions = get();
}

// The state while a primitive is decoded.
struct decoding {
    struct gltf *gltf;
    const struct place *place; // the position of the extension in the file
    const struct draco_functions *functions;
    int view;
    void *mesh;
    uint32_t vertices, triangles;
};

// Checks the result of a function in the module, and reports an error if the function failed. Returns false on error.
static bool succeeded(const struct decoding *d, const struct place *place, int result, const char *reason)
{
    return result > 0 ||
           (result < 0 ? gltf_no_memory(d->gltf, 0)
                       : json_fail(&d->gltf->json, place, "the compressed bytes are damaged: %s", reason));
}

// Allocates contiguous memory for the accessor's elements.
static uint8_t *make_elements(const struct decoding *d, struct gltf_accessor *accessor)
{
    accessor->stride = (size_t)accessor->width * gltf_component_size(accessor->component);
    uint8_t *elements = arena_array(&d->gltf->scene->arena, accessor->count, accessor->stride);
    if (!elements)
        gltf_no_memory(d->gltf, accessor->count * accessor->stride);
    return elements;
}

static void keep(const struct decoding *d, struct gltf_accessor *accessor, const uint8_t *elements)
{
    accessor->data = elements;
    accessor->buffer = -1;
    accessor->draco_view = d->view + 1;
}

static bool decode_attribute(const struct decoding *d, const struct place *place, const json_t *id,
                             struct gltf_accessor *accessor)
{
    char reason[DRACO_REASON_SIZE];
    double number = json_is_number(id) ? json_number_value(id) : -1;
    if (!(number >= 0 && number <= UINT32_MAX && number == (double)(uint32_t)number))
        return json_unexpected(&d->gltf->json, place, id, "the number of an attribute");
    if (accessor->count != d->vertices)
        return json_fail(&d->gltf->json, place,
                         "the compressed mesh has %u vertices, expected %zu, the accessor's count", d->vertices,
                         accessor->count);
    uint8_t *elements = make_elements(d, accessor);
    if (!elements || !succeeded(d, place,
                                d->functions->attribute(d->mesh, (uint32_t)number, accessor->component, accessor->width,
                                                        elements, reason),
                                reason))
        return false;
    keep(d, accessor, elements);
    return true;
}

static bool decode_attributes(const struct decoding *d, const struct place *primitive_place, const json_t *primitive,
                              const json_t *ids)
{
    const json_t *attributes = json_object_get(primitive, "attributes");
    const struct place *here = KEY_OF(primitive_place, "attributes");
    const char *name;
    json_t *id;
    json_object_foreach((json_t *)(uintptr_t)ids, name, id)
    {
        struct gltf_accessor *accessor;
        const struct place *at = KEY_OF(KEY_OF(d->place, "attributes"), name);
        if (!gltf_take_accessor(d->gltf, here, attributes, name, &accessor))
            return false;
        if (!accessor)
            return json_fail(&d->gltf->json, at, "the primitive has no attribute of this name");
        if (!decode_attribute(d, at, id, accessor))
            return false;
    }
    return true;
}

// Writes the corners with the integer type that the primitive's indices declare. A primitive without indices uses its
// vertices in order.
static bool decode_indices(const struct decoding *d, const struct place *primitive_place, const json_t *primitive,
                           bool strip)
{
    struct gltf *gltf = d->gltf;
    struct gltf_accessor *accessor;
    const struct place *here = KEY_OF(primitive_place, "indices");
    size_t count = 3 * (size_t)d->triangles;
    if (!gltf_take_accessor(gltf, primitive_place, primitive, "indices", &accessor))
        return false;
    if (!accessor)
        return json_fail(&gltf->json, primitive_place, "indices is missing; a compressed mesh needs indices");
    if (accessor->width != 1 ||
        (accessor->component != GLTF_U8 && accessor->component != GLTF_U16 && accessor->component != GLTF_U32))
        return true; // gltf_indices reports this error
    if (strip)
        // the file declares the number of indices of a strip, but the decoded mesh contains separate triangles
        accessor->count = count;
    if (accessor->count != count)
        return json_fail(&gltf->json, here, "the compressed mesh has %zu corners, expected %zu, the accessor's count",
                         count, accessor->count);
    uint32_t *corners = arena_array(gltf->scratch, count, sizeof *corners);
    uint8_t *elements = corners ? make_elements(d, accessor) : NULL;
    if (!elements)
        return corners || gltf_no_memory(gltf, count * sizeof *corners);
    d->functions->triangles(d->mesh, corners);
    size_t size = gltf_component_size(accessor->component);
    for (size_t i = 0; i < count; i++) {
        if (size < 4 && corners[i] >> (8 * size))
            return json_fail(&gltf->json, here, "number %zu of the compressed mesh is %u, which exceeds its type", i,
                             corners[i]);
        memcpy(elements + i * size, &corners[i], size); // little-endian, like glTF's buffers
    }
    keep(d, accessor, elements);
    return true;
}

// Returns whether the bufferView has already been decoded, for example for another pose of this primitive.
static bool is_decoded(struct gltf *gltf, const json_t *primitive, int view)
{
    const json_t *position = json_object_get(json_object_get(primitive, "attributes"), "POSITION");
    double number = json_is_number(position) ? json_number_value(position) : -1;
    return number >= 0 && number < (double)gltf_list_size(gltf, "accessors") &&
           gltf->accessors[(size_t)number].draco_view == view + 1;
}

// Returns whether the primitive's accessors also refer to uncompressed bytes.
static bool has_plain_bytes(struct gltf *gltf, const json_t *primitive)
{
    const json_t *position = json_object_get(json_object_get(primitive, "attributes"), "POSITION");
    double number = json_is_number(position) ? json_number_value(position) : -1;
    bool there = number >= 0 && number < (double)gltf_list_size(gltf, "accessors");
    return there && json_object_get(gltf_list_item(gltf, "accessors", (int)number), "bufferView");
}

// Calls call_charge for the memory that Draco's own code will allocate.
static bool charge_claim(const struct decoding *d, const struct gltf_view *view, size_t *charged)
{
    struct gltf *gltf = d->gltf;
    struct draco_claim claim;
    if (!draco_header_read(view->data, view->size, &claim))
        return json_fail(&gltf->json, d->place, "the compressed bytes are damaged: they contain no mesh header");
    if (!call_check_triangles(gltf->source->call, gltf->source->name, claim.faces, "triangles", gltf->json.error))
        return false;
    uint64_t points_max = 3 * call_triangle_limit(gltf->source->call);
    if (claim.points > points_max)
        return fail(gltf->json.error, LAM_LIMIT,
                    "%s: %u vertices, expected at most %llu, three for each triangle (lam_control.triangle_limit)",
                    gltf->source->name, claim.points, (unsigned long long)points_max);
    uint64_t bytes = draco_claim_bytes(&claim);
    if (bytes > SIZE_MAX || !call_charge(gltf->source->call, (size_t)bytes))
        return gltf_no_memory(gltf, (size_t)bytes);
    *charged = (size_t)bytes;
    return true;
}

// Memory that decoding may use beyond the declared sizes. The memory is granted in steps of one megabyte. At each step,
// grant() checks whether the call may continue, so that a long decoding can be stopped.
struct grants {
    struct call_control *call;
    size_t refused;
};

static int grant(struct draco_memory *memory, size_t bytes)
{
    struct grants *grants = memory->user;
    if (!call_should_continue(grants->call) || !call_charge(grants->call, bytes)) {
        grants->refused = bytes;
        return 0;
    }
    memory->granted += bytes;
    return 1;
}

static bool decode(struct decoding *d, const struct place *place, const json_t *primitive, const json_t *ids,
                   bool strip)
{
    char reason[DRACO_REASON_SIZE];
    struct grants grants = {.call = d->gltf->source->call};
    struct draco_memory memory = {.grant = grant, .user = &grants};
    const struct gltf_view *view = gltf_view_at(d->gltf, d->view);
    if (!view || !charge_claim(d, view, &memory.granted))
        return false;
    int result = d->functions->decode(view->data, view->size, &memory, &d->mesh, &d->vertices, &d->triangles, reason);
    bool ok = call_should_continue(grants.call) || call_error(grants.call, d->gltf->json.error);
    if (!ok && result > 0)
        d->functions->free(d->mesh);
    ok = ok && (result >= 0 ? succeeded(d, d->place, result, reason) : gltf_no_memory(d->gltf, grants.refused));
    if (ok) {
        ok = decode_attributes(d, place, primitive, ids) && decode_indices(d, place, primitive, strip);
        d->functions->free(d->mesh);
    }
    call_refund(grants.call, memory.granted);
    return ok;
}

bool gltf_draco_decode(struct gltf *gltf, const struct place *place, const json_t *primitive, size_t *mode)
{
    const json_t *object = gltf_extension(primitive, NAME);
    struct decoding d = {.gltf = gltf, .place = KEY_OF(KEY_OF(place, "extensions"), NAME), .view = -1};
    if (!object)
        return true;
    if (*mode != GLTF_TRIANGLES && *mode != GLTF_TRIANGLE_STRIP)
        return json_fail(&gltf->json, KEY_OF(place, "mode"), "found %zu, expected 4 or 5 for a compressed mesh", *mode);
    if (!gltf_take_index(gltf, d.place, object, "bufferView", "bufferViews", &d.view))
        return false;
    const json_t *ids = gltf_take_object(gltf, d.place, object, "attributes");
    if (d.view < 0 || !ids)
        return json_fail(&gltf->json, d.place, "%s is missing", d.view < 0 ? "bufferView" : "attributes");
    find_functions(gltf, &d.functions);
    if (!d.functions)
        return has_plain_bytes(gltf, primitive) ||
               fail(gltf->json.error, LAM_UNSUPPORTED,
                    "%s: is compressed by " NAME REMEDY(", and its decoder is not installed (the module "
                                                        "lambent-draco.so, and Debian's package libdraco7)",
                                                        ", which this page cannot read; use the program lambent"),
                    gltf->source->name);
    bool strip = *mode == GLTF_TRIANGLE_STRIP;
    *mode = GLTF_TRIANGLES;
    return is_decoded(gltf, primitive, d.view) || decode(&d, place, primitive, ids, strip);
}

// --- reads the declared sizes of a mesh compressed with Draco. https://google.github.io/draco/spec/ (version 2.2),
// sections "Draco Header", "Metadata", "Sequential Connectivity Decode" and "EdgeBreaker Decode"; older versions are
// read as in Draco's decoder.

enum { TRIANGULAR_MESH = 1, SEQUENTIAL = 0, EDGEBREAKER = 1, HAS_METADATA = 0x8000, METADATA_DEPTH = 16 };

struct draco_cursor {
    const uint8_t *at, *end;
    bool ok; // false if the bytes ended too early
};

static const uint8_t *skip(struct draco_cursor *r, uint64_t bytes)
{
    const uint8_t *from = r->at;
    r->ok = r->ok && bytes <= (uint64_t)(r->end - r->at);
    if (!r->ok)
        return NULL;
    r->at += bytes;
    return from;
}

static uint32_t read_u8(struct draco_cursor *r)
{
    const uint8_t *at = skip(r, 1);
    return at ? *at : 0;
}

static uint32_t read_u32(struct draco_cursor *r)
{
    const uint8_t *at = skip(r, 4);
    return at ? at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24 : 0;
}

// Reads a number that is stored with seven bits per byte, the lowest bits first.
static uint32_t read_varint(struct draco_cursor *r)
{
    uint64_t number = 0;
    for (int shift = 0; shift < 35; shift += 7) {
        uint32_t byte = read_u8(r);
        number |= (uint64_t)(byte & 127) << shift;
        if (!(byte & 128)) {
            r->ok = r->ok && number <= UINT32_MAX;
            return (uint32_t)number;
        }
    }
    r->ok = false;
    return 0;
}

static void skip_metadata(struct draco_cursor *r, int depth)
{
    r->ok = r->ok && depth < METADATA_DEPTH;
    for (uint32_t entries = read_varint(r); r->ok && entries > 0; entries--) {
        skip(r, read_u8(r)); // the name
        skip(r, read_varint(r));
    }
    for (uint32_t inside = read_varint(r); r->ok && inside > 0; inside--) {
        skip(r, read_u8(r));
        skip_metadata(r, depth + 1);
    }
}

static void skip_all_metadata(struct draco_cursor *r)
{
    for (uint32_t attributes = read_varint(r); r->ok && attributes > 0; attributes--) {
        read_varint(r); // skips the attribute's id
        skip_metadata(r, 0);
    }
    skip_metadata(r, 0);
}

bool draco_header_read(const uint8_t *bytes, size_t size, struct draco_claim *out)
{
    struct draco_cursor r = {.at = bytes, .end = bytes + size, .ok = true};
    *out = (struct draco_claim){0};
    const uint8_t *magic = skip(&r, 5);
    if (!magic || memcmp(magic, "DRACO", 5) != 0)
        return false;
    uint32_t major = read_u8(&r), version = major << 8 | read_u8(&r), type = read_u8(&r), method = read_u8(&r);
    uint32_t flags = read_u8(&r);
    flags |= read_u8(&r) << 8;
    if (!r.ok || type != TRIANGULAR_MESH || method > EDGEBREAKER)
        return false;
    if (version >= 0x103 && flags & HAS_METADATA)
        skip_all_metadata(&r);
    if (method == SEQUENTIAL) {
        out->faces = version < 0x202 ? read_u32(&r) : read_varint(&r);
        out->points = version < 0x202 ? read_u32(&r) : read_varint(&r);
        return r.ok;
    }
    read_u8(&r);         // skips the edge coding method
    if (version < 0x200) // number of vertices added by splits
        read_u32(&r);
    else if (version < 0x202)
        read_varint(&r);
    out->points = version < 0x200 ? read_u32(&r) : read_varint(&r);
    out->faces = version < 0x200 ? read_u32(&r) : read_varint(&r);
    return r.ok;
}

uint64_t draco_claim_bytes(const struct draco_claim *claim)
{
    enum { PER_FACE = 96, PER_POINT = 192 };
    return (uint64_t)claim->faces * PER_FACE + (uint64_t)claim->points * PER_POINT;
}
