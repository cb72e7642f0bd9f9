// stl.h: internals of the STL importer.
#ifndef STL_H
#define STL_H

#include "fail.h"
#include "parallel_rows.h"

// A binary STL consists of a header of 80 bytes, the number of facets (32 bits, little-endian), and 50 bytes per facet.
// A facet is a normal and three corners (three floats each), followed by an attribute of 16 bits.
enum {
    STL_HEADER = 80,
    STL_FACETS = 84,
    STL_FACET = 50,
    STL_CORNERS = 12,   // offset of the corners in a facet, after its normal
    STL_ATTRIBUTE = 48, // offset of the attribute in a facet
};

// Each function sets all members of the mesh except its name; triangle_count remains 0 if the file contains no facets.
bool stl_load_binary(const struct import_source *source, struct lam_scene *scene, lam_mesh *mesh, lam_error *error);
bool stl_load_ascii(const struct import_source *source, struct lam_scene *scene, lam_mesh *mesh, lam_error *error);

// Statistics of the attribute words of a chunk.
struct stl_words {
    uint32_t marked;          // number of words with bit 15 set
    uint32_t unmarked_values; // number of different nonzero words without bit 15: 0, 1, or 2 for more than one
    uint16_t unmarked;        // the first nonzero word without bit 15
    bool any;                 // whether any word is not 0
    bool colored;             // whether any word contains more than bit 15
};

static inline uint16_t stl_word_of(const uint8_t *facet)
{
    return (uint16_t)(facet[STL_ATTRIBUTE] | facet[STL_ATTRIBUTE + 1] << 8);
}

static inline void stl_add_word(struct stl_words *words, uint16_t value)
{
    if (value == 0)
        return;
    words->any = true;
    words->colored |= (value & 0x7fff) != 0;
    if (value & 0x8000) {
        words->marked++;
    } else if (words->unmarked_values == 0) {
        words->unmarked_values = 1;
        words->unmarked = value;
    } else if (words->unmarked != value) {
        words->unmarked_values = 2;
    }
}

// Reads the facets of a large file as a mesh with shared vertices: sets the positions, indices and vertex_count of the
// mesh, and `words` of each chunk. Returns false if the facets share few vertices, if memory runs out, if a number is
// not finite, or if the file cannot be read; the caller then reads the facets without sharing, and reports the error.
bool stl_share_vertices(const struct import_source *source, const struct row_bytes *facets, struct stl_words *words,
                        struct lam_scene *scene, lam_mesh *mesh);

enum { STL_FACETS_MAX = 1431655765 }; // (2³² − 1) ÷ 3: corners have 32-bit indices

// Returns whether a file may have this many facets. Otherwise fails with LAM_LIMIT.
static inline bool stl_check_count(const struct import_source *source, uint64_t facets, lam_error *error)
{
    if (facets > STL_FACETS_MAX)
        return fail(error, LAM_LIMIT, "%s: %llu facets, expected at most %d", source->name, (unsigned long long)facets,
                    STL_FACETS_MAX);
    return call_check_triangles(source->call, source->name, facets, "facets", error);
}

#endif
