// stl_binary.c: reads binary STL: the positions of the facets, and colours from their attribute words.
//
// Two dialects store a colour of 3 × 5 bits in a facet's attribute word:
//
//  VisCAM, SolidView   bits 0–4 blue, 5–9 green, 10–14 red
//                      bit 15 set: the facet has a colour
//  Materialise Magics  bits 0–4 red, 5–9 green, 10–14 blue
//                      bit 15 clear: the facet has its own colour
//                      the header contains "COLOR=" and four bytes RGBA, the colour of the other facets
//
// Other programs store counters or undefined values in these words; colors_of decides whether they are colours.
#include "stl.h"
#include "parallel_rows.h"
#include "fail.h"
#include "srgb.h"

#include <lambent/material.h>

#include <string.h>

struct stl_binary_reader {
    const struct import_source *source;
    struct row_bytes facets;
    float *positions;
    struct stl_words *words; // one per chunk
    // Members for the pass that reads colours.
    uint8_t *colors;
    uint8_t fallback[4]; // the colour of facets without a colour of their own
    bool magics;
};

static bool read_chunk(void *user, size_t index, const uint8_t *facet, lam_error *error)
{
    const struct stl_binary_reader *reader = user;
    size_t first, last;
    parallel_rows_range(reader->facets.count, index, &first, &last);
    struct stl_words words = {0};
    float *corners = reader->positions + 9 * first;
    (void)error;
    for (size_t i = first; i < last; i++, facet += STL_FACET, corners += 9) {
        memcpy(corners, facet + STL_CORNERS, 9 * sizeof *corners);
        stl_add_word(&words, stl_word_of(facet));
    }
    reader->words[index] = words;
    return true;
}

static uint8_t five_bits(unsigned value) { return (uint8_t)((value * 255 + 15) / 31); }

static bool color_chunk(void *user, size_t index, const uint8_t *facet, lam_error *error)
{
    (void)error;
    const struct stl_binary_reader *reader = user;
    size_t first, last;
    parallel_rows_range(reader->facets.count, index, &first, &last);
    for (size_t i = first; i < last; i++, facet += STL_FACET) {
        unsigned word = stl_word_of(facet);
        bool own = (word >> 15) != (unsigned)reader->magics;
        uint8_t low = five_bits(word & 31), middle = five_bits(word >> 5 & 31), high = five_bits(word >> 10 & 31);
        uint8_t color[4] = {reader->magics ? low : high, middle, reader->magics ? high : low, 255};
        memcpy(reader->colors + 4 * i, own ? color : reader->fallback, 4);
    }
    return true;
}

// Returns whether facets have colours, and sets dialect and fallback. If the header contains "COLOR=", the attribute
// words are colours. If all attribute words are zero, the header's colour applies to the whole file instead (*uniform).
// Without "COLOR=", the words are colours if bit 15 is set in some of them, and the others are zero or all equal (a
// default value). Files whose only colour is black have no colours: some programs set only bit 15 in every word.
static bool colors_of(struct stl_binary_reader *reader, const struct stl_words *words, bool *uniform)
{
    static const char key[] = "COLOR=";
    enum { KEY = sizeof key - 1 };
    const uint8_t *header = reader->source->bytes;
    memset(reader->fallback, 255, 4); // white: the material's own colour
    for (int at = 0; at + KEY + 4 <= STL_HEADER; at++) {
        if (memcmp(header + at, key, KEY) != 0)
            continue;
        // The fourth byte, the opacity, is ignored, because programs write 0 for opaque models.
        memcpy(reader->fallback, header + at + KEY, 3);
        reader->magics = true;
        *uniform = !words->any;
        return !*uniform;
    }
    return words->marked > 0 && words->colored && words->unmarked_values < 2;
}

// A colour of the whole file is stored in the default material, so that options can replace it.
static bool set_material(struct stl_binary_reader *reader, struct lam_scene *scene, lam_error *error)
{
    bool raw = reader->source->params->color == LAM_COLOR_RAW;
    float rgb[3];
    for (int i = 0; i < 3; i++)
        rgb[i] = (float)(raw ? reader->fallback[i] / 255.0 : srgb_linear(reader->fallback[i] / 255.0));
    lam_material material = *lam_scene_default_material(scene);
    material.ambient = (lam_rgb){rgb[0], rgb[1], rgb[2]};
    material.diffuse = (lam_rgba){rgb[0], rgb[1], rgb[2], 1};
    return lam_scene_set_default_material(scene, &material, error);
}

static bool read_colors(struct stl_binary_reader *reader, struct lam_scene *scene, lam_mesh *mesh, lam_error *error)
{
    struct stl_words all = {0};
    for (size_t i = 0; i < parallel_rows_count(reader->facets.count); i++) {
        const struct stl_words *chunk = &reader->words[i];
        all.any |= chunk->any;
        all.colored |= chunk->colored;
        all.marked |= chunk->marked;
        if (chunk->unmarked_values)
            stl_add_word(&all, chunk->unmarked);
        if (chunk->unmarked_values == 2)
            all.unmarked_values = 2;
    }
    bool uniform = false;
    if (!colors_of(reader, &all, &uniform))
        return !uniform || set_material(reader, scene, error);
    size_t count = reader->facets.count;
    reader->colors = arena_array(&scene->arena, count, 4);
    if (!reader->colors)
        return call_memory_error(reader->source->call, 4 * count, error);
    if (!parallel_rows_read(reader->source, &reader->facets, color_chunk, reader, error))
        return false;
    mesh->colors = reader->colors;
    mesh->color_count = (uint32_t)count;
    mesh->colors_format = reader->source->params->color == LAM_COLOR_RAW ? LAM_COLORS_LINEAR8 : LAM_COLORS_SRGB8;
    mesh->colors_rate = LAM_PER_TRIANGLE;
    return true;
}

// Reads the facets without sharing their vertices.
static bool read_corners(struct stl_binary_reader *reader, struct lam_scene *scene, lam_mesh *mesh, lam_error *error)
{
    size_t facets = reader->facets.count;
    reader->positions = arena_array(&scene->arena, facets, 9 * sizeof(float));
    if (!reader->positions)
        return call_memory_error(reader->source->call, facets * 9 * sizeof(float), error);
    mesh->positions = reader->positions;
    mesh->vertex_count = 3 * (uint32_t)facets;
    return parallel_rows_read(reader->source, &reader->facets, read_chunk, reader, error);
}

bool stl_load_binary(const struct import_source *source, struct lam_scene *scene, lam_mesh *mesh, lam_error *error)
{
    uint32_t declared;
    memcpy(&declared, source->bytes + STL_HEADER, 4);
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
#error "positions are copied without byte swapping: this reader needs a little-endian machine"
#endif
    size_t body = source->parts.size - STL_FACETS, present = body / STL_FACET;
    if (declared > present)
        return fail(error, LAM_CANNOT_READ,
                    "%s: the file is truncated: its header declares %u facets (%llu bytes), found %zu (%zu bytes)",
                    source->name, declared, (unsigned long long)STL_FACETS + (unsigned long long)STL_FACET * declared,
                    present, source->parts.size);
    if (!stl_check_count(source, declared, error))
        return false;
    if (declared == 0)
        return true;

    struct arena scratch;
    arena_start(&scratch, source->call);
    struct stl_binary_reader reader = {.source = source,
                                       .facets = {.offset = STL_FACETS, .stride = STL_FACET, .count = declared}};
    size_t chunks = parallel_rows_count(declared);
    reader.words = arena_array(&scratch, chunks, sizeof *reader.words);
    bool done = reader.words || call_memory_error(source->call, chunks * sizeof *reader.words, error);
    done = done && (stl_share_vertices(source, &reader.facets, reader.words, scene, mesh) ||
                    read_corners(&reader, scene, mesh, error));
    done = done && read_colors(&reader, scene, mesh, error);
    arena_free(&scratch);
    if (!done)
        return false;

    size_t extra = body - (size_t)declared * STL_FACET;
    if (extra > 0)
        scene_warn(scene, "%s: %zu bytes after the last of %u facets are ignored", source->name, extra, declared);
    mesh->triangle_count = declared;
    return true;
}
