// gltf_numbers.c: reads the numbers of accessors as floats, indices and colours, in parallel chunks.
#include "gltf_data.h"

#include "gltf_json.h"
#include "parallel_rows.h"

#include <string.h>

#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
#error "numbers are copied without byte swapping: this reader needs a little-endian machine"
#endif

// --- one element

static inline uint16_t load_16(const uint8_t *at)
{
    uint16_t bits;
    memcpy(&bits, at, sizeof bits);
    return bits;
}

static inline uint32_t load_32(const uint8_t *at)
{
    uint32_t bits;
    memcpy(&bits, at, sizeof bits);
    return bits;
}

static inline float at_least_minus_one(float x) { return x > -1.0f ? x : -1.0f; }

// Converts elements [first, last) to floats. Matrices of one- and two-byte numbers are not supported, because their
// columns are padded.
static void convert(const struct gltf_accessor *a, size_t first, size_t last, float *out)
{
    size_t width = (size_t)a->width, stride = a->stride;
    if (!a->data) {
        memset(out, 0, (last - first) * width * sizeof *out);
        return;
    }
    const uint8_t *row = a->data + first * stride;
#define EACH(SIZE, VALUE)                                                                                              \
    for (size_t i = first; i < last; i++, row += stride) {                                                             \
        const uint8_t *at = row;                                                                                       \
        for (size_t c = 0; c < width; c++, at += SIZE)                                                                 \
            *out++ = VALUE;                                                                                            \
    }                                                                                                                  \
    break
#define NORMALIZED(component) (2 * (component) + 1)
    switch (2 * a->component + a->normalized) {
    case NORMALIZED(GLTF_I8):
        EACH(1, at_least_minus_one((float)(int8_t)*at / 127.0f));
    case 2 * GLTF_I8:
        EACH(1, (float)(int8_t)*at);
    case NORMALIZED(GLTF_U8):
        EACH(1, (float)*at / 255.0f);
    case 2 * GLTF_U8:
        EACH(1, (float)*at);
    case NORMALIZED(GLTF_I16):
        EACH(2, at_least_minus_one((float)(int16_t)load_16(at) / 32767.0f));
    case 2 * GLTF_I16:
        EACH(2, (float)(int16_t)load_16(at));
    case NORMALIZED(GLTF_U16):
        EACH(2, (float)load_16(at) / 65535.0f);
    case 2 * GLTF_U16:
        EACH(2, (float)load_16(at));
    case 2 * GLTF_U32:
    case NORMALIZED(GLTF_U32):
        EACH(4, (float)load_32(at));
    default:
        for (size_t i = first; i < last; i++, row += stride, out += width)
            memcpy(out, row, width * sizeof *out);
    }
#undef NORMALIZED
#undef EACH
}

// --- sparse accessors

static uint32_t index_at(int component, const uint8_t *run, size_t i)
{
    return component == GLTF_U8 ? run[i] : component == GLTF_U16 ? load_16(run + 2 * i) : load_32(run + 4 * i);
}

// Calls put(user, element, value) for each element that a sparse accessor replaces. Returns false if an index is out of
// range.
static bool each_sparse(struct gltf *gltf, const struct gltf_accessor *a,
                        void (*put)(void *user, size_t element, const uint8_t *value), void *user)
{
    size_t element = gltf_component_size(a->component) * (size_t)a->width;
    const struct place *place = KEY_OF(ELEMENT_OF(KEY_OF(NULL, "accessors"), (size_t)(a - gltf->accessors)), "sparse");
    for (size_t i = 0; i < a->sparse_count; i++) {
        uint32_t index = index_at(a->sparse_component, a->sparse_indices, i);
        if (index >= a->count)
            return json_fail(&gltf->json, KEY_OF(place, "indices"),
                             "number %zu is %u, expected less than %zu, the accessor's count", i, index, a->count);
        put(user, index, a->sparse_values + i * element);
    }
    return true;
}

struct sparse_floats {
    const struct gltf_accessor *accessor;
    float *out;
};

static void put_floats(void *user, size_t element, const uint8_t *value)
{
    const struct sparse_floats *floats = user;
    struct gltf_accessor one = *floats->accessor;
    one.data = value;
    convert(&one, 0, 1, floats->out + element * (size_t)one.width);
}

// --- floats

struct conversion {
    struct gltf *gltf;
    const struct place *place;
    const struct gltf_accessor *accessor;
    float *out;
    bool required;
    uint32_t replaced; // the number of values that were not finite; atomic
};

static bool convert_chunk(void *user, size_t index, lam_error *error)
{
    (void)error;
    const struct conversion *conversion = user;
    size_t first, last;
    parallel_rows_range(conversion->accessor->count, index, &first, &last);
    convert(conversion->accessor, first, last, conversion->out + first * (size_t)conversion->accessor->width);
    return true;
}

static bool is_finite_bits(uint32_t bits) { return (bits & 0x7f800000) != 0x7f800000; }

static bool check_chunk(void *user, size_t index, lam_error *error)
{
    struct conversion *conversion = user;
    size_t first, last, width = (size_t)conversion->accessor->width;
    parallel_rows_range(conversion->accessor->count, index, &first, &last);
    const uint8_t *bytes = (const uint8_t *)conversion->out;
    uint32_t nonfinite = 0; // bit 31: a number is NaN or infinite
    for (size_t i = first * width; i < last * width; i++)
        nonfinite |= (load_32(bytes + 4 * i) & 0x7fffffff) + 0x00800000;
    if (!(nonfinite & 0x80000000))
        return true;
    for (size_t i = first * width; i < last * width; i++) {
        uint32_t bits = load_32(bytes + 4 * i);
        if (is_finite_bits(bits))
            continue;
        if (conversion->required)
            return error && json_fail(&conversion->gltf->json, conversion->place,
                                      "element %zu: found %s as number %zu, expected a finite number", i / width,
                                      bits & 0x007fffff ? "NaN" : "infinity", i % width + 1);
        conversion->out[i] = 0;
        __atomic_add_fetch(&conversion->replaced, 1, __ATOMIC_RELAXED);
    }
    return true;
}

static bool check_finite(struct gltf *gltf, const struct place *place, const struct gltf_accessor *a, float *floats,
                         bool required)
{
    struct conversion checking = {.gltf = gltf, .place = place, .accessor = a, .out = floats, .required = required};
    if (a->component == GLTF_F32 &&
        !parallel_rows_run(gltf->source, parallel_rows_count(a->count), check_chunk, &checking, gltf->json.error))
        return false;
    if (checking.replaced)
        gltf_note(gltf, place, "%u of its numbers are not finite and became 0", checking.replaced);
    return true;
}

// Returns whether the elements are stored contiguously, as in an array of 4-byte numbers.
static bool in_place(const struct gltf_accessor *a, int component)
{
    return a->data && a->component == component && a->stride == 4 * (size_t)a->width && !a->sparse_count &&
           (uintptr_t)a->data % 4 == 0;
}

static float *convert_all(struct gltf *gltf, const struct gltf_accessor *a, struct arena *arena)
{
    size_t bytes = a->count * (size_t)a->width * sizeof(float);
    struct conversion conversion = {.accessor = a, .out = arena_array(arena, bytes, 1)};
    struct sparse_floats sparse = {a, conversion.out};
    if (!conversion.out)
        return gltf_no_memory(gltf, bytes), NULL;
    return parallel_rows_run(gltf->source, parallel_rows_count(a->count), convert_chunk, &conversion,
                             gltf->json.error) &&
                   each_sparse(gltf, a, put_floats, &sparse)
               ? conversion.out
               : NULL;
}

const float *gltf_floats(struct gltf *gltf, const struct place *place, struct gltf_accessor *a, int flags)
{
    bool keep = flags & GLTF_KEEP, own_bytes = in_place(a, GLTF_F32);
    if (a->floats[1])
        return a->floats[1];
    if (!a->floats[0] || (keep && !own_bytes)) {
        // The load owns the file's bytes and may therefore change the numbers in place.
        float *floats =
            own_bytes ? (float *)(uintptr_t)a->data : convert_all(gltf, a, keep ? &gltf->scene->arena : gltf->scratch);
        if (!floats || (!(flags & GLTF_AS_THEY_ARE) && !check_finite(gltf, place, a, floats, flags & GLTF_REQUIRED)))
            return NULL;
        a->floats[keep] = floats;
    }
    if (keep && own_bytes) {
        gltf_buffer_keep(gltf, a->buffer);
        a->floats[1] = a->floats[0] ? a->floats[0] : a->floats[1];
    }
    return a->floats[keep];
}

// --- indices

struct indexing {
    const struct gltf_accessor *accessor;
    uint32_t *out; // NULL means the numbers are used in place
    uint32_t max;  // atomic
};

static bool index_chunk(void *user, size_t index, lam_error *error)
{
    (void)error;
    struct indexing *indexing = user;
    const struct gltf_accessor *a = indexing->accessor;
    size_t first, last, stride = a->stride;
    uint32_t max = 0, *out = indexing->out;
    parallel_rows_range(a->count, index, &first, &last);
    if (!a->data) {
        memset(out + first, 0, (last - first) * sizeof *out);
        return true;
    }
    const uint8_t *at = a->data + first * stride;
#define EACH(VALUE)                                                                                                    \
    for (size_t i = first; i < last; i++, at += stride) {                                                              \
        uint32_t value = VALUE;                                                                                        \
        out[i] = value;                                                                                                \
        max = value > max ? value : max;                                                                               \
    }
    if (!out)
        for (size_t i = first; i < last; i++, at += 4)
            max = load_32(at) > max ? load_32(at) : max;
    else if (a->component == GLTF_U8)
        EACH(*at)
    else if (a->component == GLTF_U16)
        EACH(load_16(at))
    else
        EACH(load_32(at))
#undef EACH
    uint32_t seen = __atomic_load_n(&indexing->max, __ATOMIC_RELAXED);
    while (max > seen &&
           !__atomic_compare_exchange_n(&indexing->max, &seen, max, false, __ATOMIC_RELAXED, __ATOMIC_RELAXED))
        ;
    return true;
}

static void put_index(void *user, size_t element, const uint8_t *value)
{
    const struct indexing *indexing = user;
    indexing->out[element] = index_at(indexing->accessor->component, value, 0);
}

static uint32_t max_of(const uint32_t *indices, size_t count)
{
    uint32_t max = 0;
    for (size_t i = 0; i < count; i++)
        max = indices[i] > max ? indices[i] : max;
    return max;
}

const uint32_t *gltf_indices(struct gltf *gltf, const struct place *place, struct gltf_accessor *a)
{
    char words[64];
    if (a->indices)
        return a->indices;
    if (a->width != 1 || a->normalized ||
        (a->component != GLTF_U8 && a->component != GLTF_U16 && a->component != GLTF_U32)) {
        json_fail(&gltf->json, place, "found %s, expected SCALAR of UNSIGNED_BYTE, UNSIGNED_SHORT or UNSIGNED_INT",
                  gltf_accessor_words(a, words));
        return NULL;
    }
    struct indexing indexing = {.accessor = a};
    bool keep = in_place(a, GLTF_U32);
    if (!keep && !(indexing.out = arena_array(&gltf->scene->arena, a->count, sizeof *indexing.out)))
        return gltf_no_memory(gltf, a->count * sizeof *indexing.out), NULL;
    if (!parallel_rows_run(gltf->source, parallel_rows_count(a->count), index_chunk, &indexing, gltf->json.error) ||
        !each_sparse(gltf, a, put_index, &indexing))
        return NULL;
    if (a->sparse_count)
        indexing.max = max_of(indexing.out, a->count);
    if (keep)
        gltf_buffer_keep(gltf, a->buffer);
    a->max_index = indexing.max;
    a->indices = keep ? (const uint32_t *)(const void *)a->data : indexing.out;
    return a->indices;
}

// --- colours

struct coloring {
    const struct gltf_accessor *accessor;
    const float *floats; // the accessor's numbers; NULL means that the accessor's bytes are used
    bool opaque;
    void *out; // may be `floats` itself
};

static float clean_channel(float x) { return x >= 0.0f ? x : 0.0f; }

static bool color_chunk(void *user, size_t index, lam_error *error)
{
    (void)error;
    const struct coloring *coloring = user;
    const struct gltf_accessor *a = coloring->accessor;
    size_t first, last, width = (size_t)a->width;
    parallel_rows_range(a->count, index, &first, &last);
    for (size_t i = first; coloring->floats && i < last; i++) {
        const float *in = coloring->floats + i * width;
        float *out = (float *)coloring->out + 4 * i;
        float alpha = width == 4 && !coloring->opaque ? clean_channel(in[3]) : 1.0f;
        for (int c = 0; c < 3; c++)
            out[c] = clean_channel(in[c]);
        out[3] = alpha < 1.0f ? alpha : 1.0f;
    }
    if (coloring->floats)
        return true;
    const uint8_t *at = a->data + first * a->stride;
    uint8_t *out = coloring->out;
    for (size_t i = first; i < last; i++, at += a->stride) {
        memcpy(out + 4 * i, at, 3);
        out[4 * i + 3] = width == 4 && !coloring->opaque ? at[3] : 255;
    }
    return true;
}

bool gltf_colors(struct gltf *gltf, const struct place *place, struct gltf_accessor *a, bool opaque,
                 struct gltf_colors *out)
{
    opaque |= a->width == 3;
    bool bytes = a->component == GLTF_U8 && a->data && !a->sparse_count;
    out->format = bytes ? LAM_COLORS_LINEAR8 : LAM_COLORS_LINEAR_F32;
    out->items = a->colors[opaque];
    if (out->items)
        return true;
    struct coloring coloring = {.accessor = a, .opaque = opaque};
    if (!bytes && !(coloring.floats = gltf_floats(gltf, place, a, GLTF_KEEP)))
        return false;
    if (bytes && !opaque && a->stride == 4) {
        gltf_buffer_keep(gltf, a->buffer);
        out->items = a->colors[opaque] = a->data;
        return true;
    }
    // Colours of four floats are clamped in place.
    coloring.out = bytes || opaque ? arena_array(&gltf->scene->arena, a->count, bytes ? 4 : 4 * sizeof(float))
                                   : (float *)(uintptr_t)coloring.floats;
    if (!coloring.out)
        return gltf_no_memory(gltf, a->count * 4 * sizeof(float));
    if (!parallel_rows_run(gltf->source, parallel_rows_count(a->count), color_chunk, &coloring, gltf->json.error))
        return false;
    out->items = a->colors[opaque] = coloring.out;
    return true;
}
