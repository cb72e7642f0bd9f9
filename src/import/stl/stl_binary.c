// stl_binary.c: binary STL: facets to corner positions, attribute words to colours.
//
// Two dialects put a colour of 3 × 5 bits into a facet's attribute word:
//   VisCAM, SolidView   bits 0–4 blue, 5–9 green, 10–14 red; bit 15 set: this facet has a colour
//   Materialise Magics  the header holds "COLOR=" and four bytes RGBA, the colour of the whole; bits 0–4 red,
//   5–9 green,
//                       10–14 blue; bit 15 clear: this facet has its own colour
// The words of other programs are counters, or junk; see colors_of for what is believed.
#include "stl.h"
#include "parallel_rows.h"
#include "fail.h"

#include <string.h>

// What a piece has seen of its attribute words.
struct words {
    uint32_t marked;          // how many have bit 15 set
    uint32_t unmarked_values; // of those without bit 15: 0: all zero; 1: one value, or zero; 2: several values
    uint16_t unmarked;        // that value
    bool any;                 // a word that is not 0
};

struct reading {
    const struct import_source *source;
    const uint8_t *facets;
    size_t count;
    float *positions;
    struct words *words; // one for each piece
    // For the pass over colours
    uint8_t *colors;
    uint8_t fallback[4]; // of facets that have none of their own
    bool magics;
};

static uint16_t word_of(const uint8_t *facet)
{
    return (uint16_t)(facet[STL_ATTRIBUTE] | facet[STL_ATTRIBUTE + 1] << 8);
}

static void words_add(struct words *words, uint16_t value)
{
    if (value == 0)
        return;
    words->any = true;
    if (value & 0x8000) {
        words->marked++;
    } else if (words->unmarked_values == 0) {
        words->unmarked_values = 1;
        words->unmarked = value;
    } else if (words->unmarked != value) {
        words->unmarked_values = 2;
    }
}

static bool fail_not_finite(const struct reading *reading, size_t first, size_t last, lam_error *error)
{
    for (size_t i = first; i < last; i++) {
        for (int c = 0; c < 9; c++) {
            uint32_t bits;
            memcpy(&bits, &reading->positions[9 * i + (size_t)c], 4);
            if ((bits & 0x7f800000) != 0x7f800000)
                continue;
            const uint8_t *facet = reading->facets + i * STL_FACET;
            return fail_byte(error, reading->source,
                             (size_t)(facet - reading->source->bytes) + STL_CORNERS + 4 * (size_t)c,
                             "facet %zu: found %s as %c of corner %d, expected a finite number", i + 1,
                             bits & 0x007fffff ? "NaN" : "infinity", "xyz"[c % 3], c / 3 + 1);
        }
    }
    return false;
}

static bool read_piece(void *user, size_t index, lam_error *error)
{
    const struct reading *reading = user;
    size_t first, last;
    parallel_rows_range(reading->count, index, &first, &last);
    struct words words = {0};
    uint32_t wrong = 0; // its top bit: an exponent of all ones was met
    const uint8_t *facet = reading->facets + first * STL_FACET;
    float *corners = reading->positions + 9 * first;
    for (size_t i = first; i < last; i++, facet += STL_FACET, corners += 9) {
        uint32_t bits[9];
        memcpy(bits, facet + STL_CORNERS, sizeof bits);
        memcpy(corners, bits, sizeof bits);
        for (int c = 0; c < 9; c++)
            wrong |= (bits[c] & 0x7fffffff) + 0x00800000;
        words_add(&words, word_of(facet));
    }
    reading->words[index] = words;
    return !(wrong & 0x80000000) || fail_not_finite(reading, first, last, error);
}

static uint8_t five_bits(unsigned value) { return (uint8_t)((value * 255 + 15) / 31); }

static bool color_piece(void *user, size_t index, lam_error *error)
{
    (void)error;
    const struct reading *reading = user;
    size_t first, last;
    parallel_rows_range(reading->count, index, &first, &last);
    for (size_t i = first; i < last; i++) {
        unsigned word = word_of(reading->facets + i * STL_FACET);
        bool own = (word >> 15) != (unsigned)reading->magics;
        uint8_t low = five_bits(word & 31), middle = five_bits(word >> 5 & 31), high = five_bits(word >> 10 & 31);
        uint8_t color[4] = {reading->magics ? low : high, middle, reading->magics ? high : low, 255};
        memcpy(reading->colors + 4 * i, own ? color : reading->fallback, 4);
    }
    return true;
}

// Decides whether the attribute words are colours, and sets dialect and fallback. They are, with "COLOR=" in
// the header, unless all are zero (then that colour serves for all); without it, if some have bit 15 set and
// those that do not are all zero or all the same, a default: anything more varied is no colour.
static bool colors_of(struct reading *reading, const struct words *words, bool *uniform)
{
    static const char key[] = "COLOR=";
    enum { KEY = sizeof key - 1 };
    const uint8_t *header = reading->source->bytes;
    memset(reading->fallback, 255, 4); // white: the material's own colour
    for (int at = 0; at + KEY + 4 <= STL_HEADER; at++) {
        if (memcmp(header + at, key, KEY) != 0)
            continue;
        // The fourth byte, its opacity, is left out: programs write 0 there and mean an opaque part.
        memcpy(reading->fallback, header + at + KEY, 3);
        reading->magics = true;
        *uniform = !words->any;
        return true;
    }
    return words->marked > 0 && words->unmarked_values < 2;
}

static bool read_colors(struct reading *reading, struct lam_scene *scene, lam_mesh *mesh, lam_error *error)
{
    struct words all = {0};
    for (size_t i = 0; i < parallel_rows_count(reading->count); i++) {
        const struct words *piece = &reading->words[i];
        all.any |= piece->any;
        all.marked |= piece->marked;
        if (piece->unmarked_values)
            words_add(&all, piece->unmarked);
        if (piece->unmarked_values == 2)
            all.unmarked_values = 2;
    }
    bool uniform = false;
    if (!colors_of(reading, &all, &uniform))
        return true;
    reading->colors = arena_array(&scene->arena, reading->count, 4);
    if (!reading->colors)
        return call_memory_error(reading->source->call, 4 * reading->count, error);
    if (uniform) {
        for (size_t i = 0; i < reading->count; i++)
            memcpy(reading->colors + 4 * i, reading->fallback, 4);
    } else if (!parallel_rows_run(reading->source, parallel_rows_count(reading->count), color_piece, reading, error)) {
        return false;
    }
    mesh->colors = reading->colors;
    mesh->color_count = (uint32_t)reading->count;
    mesh->colors_format = reading->source->params->color == LAM_COLOR_RAW ? LAM_COLORS_LINEAR8 : LAM_COLORS_SRGB8;
    mesh->colors_rate = LAM_PER_TRIANGLE;
    return true;
}

bool stl_load_binary(const struct import_source *source, struct lam_scene *scene, lam_mesh *mesh, lam_error *error)
{
    uint32_t promised;
    memcpy(&promised, source->bytes + STL_HEADER, 4);
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
#error "positions are copied as they lie in the file: this reader needs a little-endian machine"
#endif
    size_t capacity = source->size - STL_FACETS, present = capacity / STL_FACET;
    if (promised > present)
        return fail(error, LAM_CANNOT_READ,
                    "%s: the file is cut short: its header promises %u facets (%llu bytes), found %zu (%zu bytes)",
                    source->name, promised, (unsigned long long)STL_FACETS + (unsigned long long)STL_FACET * promised,
                    present, source->size);
    if (promised > STL_FACETS_MAX)
        return stl_fail_too_many(source, promised, error);
    if (promised == 0)
        return true;

    struct arena scratch;
    arena_start(&scratch, source->call);
    struct reading reading = {.source = source, .facets = source->bytes + STL_FACETS, .count = promised};
    size_t pieces = parallel_rows_count(promised);
    reading.positions = arena_array(&scene->arena, promised, 9 * sizeof(float));
    reading.words = arena_array(&scratch, pieces, sizeof *reading.words);
    bool done = reading.positions && reading.words;
    if (!done)
        call_memory_error(source->call, promised * 9 * sizeof(float), error);
    done = done && parallel_rows_run(source, pieces, read_piece, &reading, error) &&
           read_colors(&reading, scene, mesh, error);
    arena_free(&scratch);
    if (!done)
        return false;

    size_t extra = capacity - (size_t)promised * STL_FACET;
    if (extra > 0)
        scene_warn(scene, "%s: %zu bytes behind the last of %u facets are ignored", source->name, extra, promised);
    mesh->positions = reading.positions;
    mesh->vertex_count = 3 * promised;
    mesh->triangle_count = promised;
    return true;
}
