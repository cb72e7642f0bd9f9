// stl.h: internals of the STL importer.
#ifndef STL_H
#define STL_H

#include "fail.h"
#include "importer.h"

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
