// stl.c: the STL importer: recognises binary and ASCII files by content. stl_binary.c and stl_ascii.c read them.
#include "stl.h"

#include "mesh_build.h"
#include "text_cursor.h"

#include <string.h>

enum kind { NEITHER, ASCII, BINARY_EXACT, BINARY_LOOSE };

static uint32_t declared_facets(const uint8_t *bytes)
{
    const uint8_t *at = bytes + STL_HEADER;
    return (uint32_t)at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
}

enum { SAMPLE = 1024 }; // number of bytes that are inspected

// Text contains no zero byte. A binary STL with fewer than 16 million facets contains a zero byte, because the high
// byte of its number of facets is zero.
static bool has_zero(const uint8_t *bytes, size_t size) { return memchr(bytes, 0, size < SAMPLE ? size : SAMPLE); }

// ASCII files begin with "solid" (some with "facet"), and contain "facet" or "endsolid" near the start. "solid" alone
// is not enough, because many binary files also begin with this word. A file with a zero byte is treated as text if the
// byte is between the words of a facet; the text reader then reports the byte.
static bool looks_ascii(const uint8_t *bytes, size_t size)
{
    const uint8_t *end = bytes + (size < SAMPLE ? size : SAMPLE), *at = bytes;
    if (size >= 3 && memcmp(at, "\xef\xbb\xbf", 3) == 0) // a byte order mark
        at += 3;
    at = text_skip_white(at, end);
    if (has_zero(bytes, size))
        return (text_is_word(at, end, "solid") || text_is_word(at, end, "facet")) &&
               text_count_word(at, end, "facet") && text_count_word(at, end, "vertex");
    if (text_is_word(at, end, "facet"))
        return true;
    return text_is_word(at, end, "solid") &&
           (size < SAMPLE || text_count_word(at, end, "facet") || text_count_word(at, end, "endsolid"));
}

// Tests the size first. A text file cannot have the size 84 + 50 · count by chance, because four characters, read as a
// binary count, give a count above 10⁸.
static enum kind detect_kind(const uint8_t *bytes, size_t size, size_t file_size)
{
    bool has_header = size >= STL_FACETS;
    uint64_t expected = has_header ? STL_FACETS + (uint64_t)STL_FACET * declared_facets(bytes) : 0;
    if (has_header && file_size == expected)
        return BINARY_EXACT;
    if (looks_ascii(bytes, size))
        return ASCII;
    return has_header && has_zero(bytes, size) ? BINARY_LOOSE : NEITHER;
}

static int stl_probe(const uint8_t *bytes, size_t size, size_t file_size)
{
    switch (detect_kind(bytes, size, file_size)) {
    case BINARY_EXACT:
    case ASCII:
        return 2;
    // The file is truncated or contains bytes after the last facet, so the file's extension decides.
    case BINARY_LOOSE:
        return 1;
    default:
        return 0;
    }
}

static bool stl_load(struct import_source *source, struct lam_scene *scene, lam_error *error)
{
    char found[TEXT_FOUND_SIZE];
    lam_mesh mesh = {0};
    switch (detect_kind(source->bytes, source->size, source->parts.size)) {
    case ASCII:
        if (!import_whole(source, error) || !stl_load_ascii(source, scene, &mesh, error))
            return false;
        break;
    case NEITHER:
        return fail(error, LAM_CANNOT_READ,
                    "%s: not an STL file: found %s at its start and %zu bytes, expected \"solid\" and facets, or a "
                    "binary header of %d bytes and facets",
                    source->name, text_found(source->bytes, source->bytes + source->size, found), source->parts.size,
                    STL_FACETS);
    default:
        if (!stl_load_binary(source, scene, &mesh, error))
            return false;
    }
    return mesh_add_object(scene, &mesh, NULL, error);
}

const struct importer importer_stl = {
    .name = "stl",
    .extensions = "stl",
    .up = LAM_UP_Z,
    .may_lie = true,
    .probe = stl_probe,
    .load = stl_load,
};
