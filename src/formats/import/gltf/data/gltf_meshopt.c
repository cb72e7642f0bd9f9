// gltf_meshopt.c: decodes bufferViews that are compressed with KHR_meshopt_compression or its predecessor
// EXT_meshopt_compression. The meshoptimizer library does the decoding and is loaded on demand. The versions in Debian 12
// and 13 can decode neither version 1 of attributes nor the filter COLOR, so this file does.
// https://github.com/KhronosGroup/glTF/tree/main/extensions/2.0/Khronos/KHR_meshopt_compression
#include "gltf_data.h"

#include "gltf_json.h"

#include "dynamic_library.h"
#include "fail.h"
#include "remedy.h"

#include <string.h>

enum mode { ATTRIBUTES, TRIANGLES, INDICES };
enum filter { NO_FILTER, OCTAHEDRAL, QUATERNION, EXPONENTIAL, COLOR };

static const struct json_choice modes[] = {
    {"ATTRIBUTES", ATTRIBUTES}, {"TRIANGLES", TRIANGLES}, {"INDICES", INDICES}, {NULL, 0}};
static const struct json_choice filters[] = {{"NONE", NO_FILTER},        {"OCTAHEDRAL", OCTAHEDRAL},
                                             {"QUATERNION", QUATERNION}, {"EXPONENTIAL", EXPONENTIAL},
                                             {"COLOR", COLOR},           {NULL, 0}};

typedef int decode_fn(void *out, size_t count, size_t size, const unsigned char *bytes, size_t byte_count);
typedef void filter_fn(void *buffer, size_t count, size_t stride);

static const char *const decoder_names[] = {"meshopt_decodeVertexBuffer", "meshopt_decodeIndexBuffer",
                                            "meshopt_decodeIndexSequence"};
static const char *const filter_names[] = {NULL, "meshopt_decodeFilterOct", "meshopt_decodeFilterQuat",
                                           "meshopt_decodeFilterExp"};

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

// --- version 1 of attributes (appendix A of the specification): the differences between the bytes of consecutive
// elements, in groups of 16

enum { VERSION_1 = 0xa1, GROUP = 16, MAX_BLOCK = 256, MIN_TAIL = 24 };

struct stream {
    const uint8_t *at, *end;
};

// Reads numbers of 0, 1, 2, 4 or 8 bits. A number with all bits set, except 8, is followed by the real number in a byte
// after the group.
static bool read_group(struct stream *s, unsigned bits, uint8_t out[GROUP])
{
    const uint8_t *packed = s->at;
    if (s->end - s->at < GROUP * (int)bits / 8)
        return false;
    s->at += GROUP * bits / 8;
    for (unsigned i = 0; i < GROUP; i++) {
        unsigned shift = bits == 1 ? i % 8 : 8 - bits - i * bits % 8, mask = (1U << bits) - 1;
        unsigned value = bits ? packed[i * bits / 8] >> shift & mask : 0;
        if (bits && bits < 8 && value == mask) {
            if (s->at == s->end)
                return false;
            value = *s->at++;
        }
        out[i] = (uint8_t)value;
    }
    return true;
}

// Reads the differences at one byte of all elements of a block.
static bool read_bytes(struct stream *s, unsigned control, size_t count, uint8_t out[MAX_BLOCK])
{
    static const uint8_t widths[2][4] = {{0, 1, 2, 4}, {1, 2, 4, 8}};
    enum { ALL_ZERO = 2, PLAIN };
    const size_t groups = (count + GROUP - 1) / GROUP, size = control == PLAIN ? count : (groups + 3) / 4;
    const uint8_t *head = s->at;
    memset(out, 0, MAX_BLOCK);
    if (control == ALL_ZERO)
        return true;
    if ((size_t)(s->end - s->at) < size)
        return false;
    s->at += size;
    if (control == PLAIN)
        memcpy(out, head, count);
    for (size_t g = 0; g < groups && control != PLAIN; g++)
        if (!read_group(s, widths[control][head[g / 4] >> g % 4 * 2 & 3], out + GROUP * g))
            return false;
    return true;
}

// Adds differences to the four bytes of the previous element. The low bits of `mode` are the kind of the differences.
static bool add_channel(unsigned mode, const uint8_t *before, const uint8_t d[4], uint8_t out[4])
{
    uint32_t bits = d[0] | (uint32_t)d[1] << 8 | (uint32_t)d[2] << 16 | (uint32_t)d[3] << 24, turn = mode >> 4;
    for (int k = 0; mode == 0 && k < 4; k++)
        out[k] = (uint8_t)(before[k] + (d[k] >> 1 ^ -(d[k] & 1)));
    for (int k = 0; mode == 1 && k < 4; k += 2) {
        unsigned word = bits >> 8 * k & 0xffff,
                 sum = (before[k] | (unsigned)before[k + 1] << 8) + (word >> 1 ^ -(word & 1));
        out[k] = (uint8_t)sum;
        out[k + 1] = (uint8_t)(sum >> 8);
    }
    bits = bits >> turn | bits << (32 - turn) % 32;
    for (int k = 0; (mode & 15) == 2 && k < 4; k++)
        out[k] = (uint8_t)(before[k] ^ bits >> 8 * k);
    return mode <= 1 || (mode & 15) == 2;
}

static int decode_version_1(void *out, size_t count, size_t stride, const unsigned char *bytes, size_t size)
{
    const size_t channels = stride / 4, own = stride + channels, tail = own > MIN_TAIL ? own : MIN_TAIL;
    const size_t most = (8192 / stride & ~(size_t)15) < MAX_BLOCK ? 8192 / stride & ~(size_t)15 : MAX_BLOCK;
    if (size < 1 + tail)
        return -1;
    struct stream s = {bytes + 1, bytes + size - tail};
    const uint8_t *before = bytes + size - own, *kinds = bytes + size - channels;
    for (uint8_t *to = out; count;) {
        const size_t n = count < most ? count : most;
        const uint8_t *control = s.at;
        if ((size_t)(s.end - s.at) < channels)
            return -1;
        s.at += channels;
        for (size_t c = 0; c < channels; c++) {
            uint8_t d[4][MAX_BLOCK];
            for (size_t k = 0; k < 4; k++)
                if (!read_bytes(&s, control[c] >> 2 * k & 3, n, d[k]))
                    return -1;
            for (size_t i = 0; i < n; i++)
                if (!add_channel(kinds[c], (i ? to + (i - 1) * stride : before) + 4 * c,
                                 (uint8_t[]){d[0][i], d[1][i], d[2][i], d[3][i]}, to + i * stride + 4 * c))
                    return -1;
        }
        before = to + (n - 1) * stride;
        to += n * stride;
        count -= n;
    }
    return s.at == s.end ? 0 : -1;
}

// The filter COLOR (appendix B): luma, two signed chrominances and alpha, of as many bits as the highest bit of alpha
// says, become 8 or 16 bits.
static void decode_colors(void *buffer, size_t count, size_t stride)
{
    const int largest = stride == 4 ? UINT8_MAX : UINT16_MAX;
    for (size_t i = 0; i < count; i++) {
        uint8_t *byte = (uint8_t *)buffer + i * stride;
        uint16_t *word = (uint16_t *)(void *)byte; // arrays of the arena are aligned
        int y = stride == 4 ? byte[0] : word[0], a = stride == 4 ? byte[3] : word[3], scale = 1;
        int co = stride == 4 ? (int8_t)byte[1] : (int16_t)word[1],
            cg = stride == 4 ? (int8_t)byte[2] : (int16_t)word[2];
        while (scale < a)
            scale = 2 * scale + 1;
        a &= scale >> 1;
        const int channels[4] = {y + co - cg, y + cg, y - co - cg, a << 1 | (a & 1)};
        for (int c = 0; c < 4; c++) {
            int value = channels[c] < 0 ? 0 : channels[c] > scale ? scale : channels[c];
            value = (int)((float)value * ((float)largest / (float)scale) + 0.5f);
            if (stride == 4)
                byte[c] = (uint8_t)value;
            else
                word[c] = (uint16_t)value;
        }
    }
}

// --- views

// Finds the functions for a view. Returns false if they need the library and it is not installed.
static bool find_functions(struct gltf *gltf, const struct compressed *c, const uint8_t *bytes, decode_fn **decode,
                           filter_fn **filter)
{
    static const char *const names[] = {"libmeshoptimizer.so.2d", "libmeshoptimizer.so.2", "libmeshoptimizer.so"};
    *decode = c->mode == ATTRIBUTES && *bytes == VERSION_1 ? decode_version_1 : NULL;
    *filter = c->filter == COLOR ? decode_colors : NULL;
    if (*decode && (*filter || !c->filter))
        return true;
    for (size_t i = 0; i < sizeof names / sizeof *names && !gltf->meshopt; i++)
        gltf->meshopt = library_open(names[i], false, NULL);
    return gltf->meshopt && (*decode || library_find(gltf->meshopt, decoder_names[c->mode], (void *)decode)) &&
           (*filter || !c->filter || library_find(gltf->meshopt, filter_names[c->filter], (void *)filter));
}

bool gltf_meshopt_decode(struct gltf *gltf, const struct place *place, const json_t *view, struct gltf_view *out,
                         bool *done)
{
    const char *name;
    const json_t *object = extension_of(view, &name);
    const struct place *here = KEY_OF(KEY_OF(place, "extensions"), name);
    const uint8_t *bytes;
    struct compressed c;
    decode_fn *decode;
    filter_fn *filter;
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
    if (!gltf_buffer_bytes(gltf, here, c.buffer, c.offset, c.length, &bytes))
        return false;
    if (!find_functions(gltf, &c, bytes, &decode, &filter)) {
        const json_t *buffer = plain >= 0 ? gltf_list_item(gltf, "buffers", plain) : NULL;
        bool has_plain = buffer && (json_object_get(buffer, "uri") || !is_fallback(buffer));
        return has_plain || fail(gltf->json.error, LAM_UNSUPPORTED,
                                 "%s: is compressed by %s" REMEDY(
                                     ", and libmeshoptimizer is not installed (Debian's package libmeshoptimizer2d)",
                                     ", which this page cannot read; use the program lambent"),
                                 gltf->source->name, name);
    }
    uint8_t *decoded = arena_array(&gltf->scene->arena, c.count, c.stride);
    if (!decoded)
        return gltf_no_memory(gltf, c.count * c.stride);
    if (decode(decoded, c.count, c.stride, bytes, c.length) != 0)
        return json_fail(&gltf->json, here, "the compressed bytes are damaged");
    if (filter)
        filter(decoded, c.count, c.stride);
    *out = (struct gltf_view){
        .data = decoded, .size = c.count * c.stride, .stride = c.mode == ATTRIBUTES ? c.stride : 0, .buffer = -1};
    *done = true;
    return true;
}
