// threemf_paint.c: subdivides triangles that are painted with filaments, as PrusaSlicer and its relatives store them.
//
// A painting is a tree of subdivided triangles, written in hexadecimal digits that are read from the last to the first.
// The lower two bits of a digit are the number of sides that are split. If it is 0, the upper two bits are the number of
// the filament (0: not painted); 3 means 3 plus the next digit, and each digit of 15 adds 15 and continues. Otherwise,
// the upper two bits are the first corner, from which the table below counts; the subdivided triangles follow, the last
// one first.
#include "threemf_model.h"

#include "fail.h"

#ifdef HAVE_3MF

#include <string.h>

enum { SUBDIVISIONS_MAX = 32 };

struct painter {
    struct model_reader *reader;
    const char *begin, *at; // the digits that are left
    const struct threemf_property *unpainted;
    bool damaged;
};

// Returns 0 after the end, which makes an unpainted triangle.
static unsigned next_digit(struct painter *painter)
{
    static const char digits[] = "0123456789ABCDEFabcdef";
    const char *digit = painter->at > painter->begin ? strchr(digits, *--painter->at) : NULL;
    painter->damaged |= !digit;
    return !digit ? 0 : digit - digits < 16 ? (unsigned)(digit - digits) : (unsigned)(digit - digits) - 6;
}

// A slot of the table of midpoints (open addressing). A slot is free if `high` is 0; otherwise, low < high.
struct midpoint {
    uint32_t low, high, vertex; // the ends of the side, and the vertex between them
};

static struct midpoint *slot_of(struct midpoint *slots, size_t count, uint32_t a, uint32_t b)
{
    uint32_t low = a < b ? a : b, high = a < b ? b : a;
    size_t at = (size_t)(((uint64_t)high << 32 | low) * UINT64_C(0x9e3779b97f4a7c15) >> 20);
    while (slots[at & (count - 1)].high && (slots[at & (count - 1)].low != low || slots[at & (count - 1)].high != high))
        at++;
    return &slots[at & (count - 1)];
}

// Doubles the table if half of its slots are used.
static bool grow(struct model_reader *reader)
{
    struct threemf_rows *table = &reader->midpoints, more = {0};
    size_t old = reader->midpoint_slots, slots = old ? 2 * old : 256;
    if (2 * table->count < old)
        return true;
    if (!threemf_reserve(reader->file, &more, sizeof(struct midpoint), slots))
        return false;
    memset(more.items, 0, slots * sizeof(struct midpoint));
    for (const struct midpoint *slot = table->items; old > 0; slot++, old--)
        if (slot->high)
            *slot_of(more.items, slots, slot->low, slot->high) = *slot;
    more.count = table->count;
    threemf_rows_free(reader->file, table);
    *table = more;
    reader->midpoint_slots = slots;
    return true;
}

static bool find_midpoint(struct model_reader *reader, uint32_t a, uint32_t b, uint32_t *out)
{
    if (!grow(reader))
        return false;
    struct midpoint *slot = slot_of(reader->midpoints.items, reader->midpoint_slots, a, b);
    *out = a == b ? a : slot->vertex;
    if (a == b || slot->high)
        return true;
    *slot = (struct midpoint){a < b ? a : b, a < b ? b : a, (uint32_t)reader->positions.count};
    *out = slot->vertex;
    reader->midpoints.count++;
    float *middle = *out < INT32_MAX ? threemf_add(reader->file, &reader->positions, 3 * sizeof *middle) : NULL;
    const float *all = reader->positions.items;
    for (size_t i = 0; middle && i < 3; i++)
        middle[i] = 0.5f * all[3 * (size_t)a + i] + 0.5f * all[3 * (size_t)b + i];
    return middle || threemf_no_memory(reader->file, 3 * sizeof *middle);
}

static bool add_leaf(struct painter *painter, const uint32_t corners[3], unsigned filament)
{
    enum { LEAF_BYTES = 256 }; // a digit becomes a triangle, so subdivided triangles count as unpacked bytes
    struct threemf *file = painter->reader->file;
    struct threemf_property painted = {FILAMENT, {filament, 0, 0}};
    if (filament > file->filaments.count) {
        painter->damaged = true;
        filament = 0;
    }
    return call_unpack(file->source->call, LEAF_BYTES, file->error) &&
           model_add_triangle(painter->reader, corners, filament ? &painted : painter->unpainted);
}

// NOLINTNEXTLINE(misc-no-recursion): bounded by SUBDIVISIONS_MAX
static bool paint(struct painter *painter, const uint32_t corners[3], int depth)
{
    enum { A, B, C, AB, BC, CA };
    static const uint8_t pieces[4][4][3] = {
        [1] = {{A, B, BC}, {BC, C, A}},
        [2] = {{A, AB, CA}, {AB, B, CA}, {B, C, CA}},
        [3] = {{A, AB, CA}, {AB, B, BC}, {BC, C, CA}, {AB, BC, CA}},
    };
    unsigned code = next_digit(painter), splits = code & 3, upper = code >> 2;
    painter->damaged |= splits && depth == SUBDIVISIONS_MAX;
    if (!splits || depth == SUBDIVISIONS_MAX) {
        if (!splits && upper == 3) {
            for (code = 15; code == 15 && !painter->damaged; upper += code)
                code = next_digit(painter);
        }
        return add_leaf(painter, corners, splits ? 0 : upper);
    }
    uint32_t all[6] = {corners[upper % 3], corners[(upper + 1) % 3], corners[(upper + 2) % 3]};
    for (int side = 0; side < 3; side++) // one split: the side BC; two: the others
        if ((splits == 3 || (splits == 1) == (side == 1)) &&
            !find_midpoint(painter->reader, all[side], all[(side + 1) % 3], &all[AB + side]))
            return false;
    for (unsigned i = splits + 1; i-- > 0;) {
        const uint8_t *piece = pieces[splits][i];
        if (!paint(painter, (uint32_t[3]){all[piece[0]], all[piece[1]], all[piece[2]]}, depth + 1))
            return false;
    }
    return true;
}

bool paint_triangle(struct model_reader *reader, const char *painting, const uint32_t corners[3],
                    const struct threemf_property *property)
{
    struct painter painter = {reader, painting, painting + strlen(painting), property, false};
    bool ok = paint(&painter, corners, 0);
    if ((painter.damaged || painter.at > painter.begin) && !reader->file->damaged) {
        scene_warn(reader->file->scene, "%s: object %d: triangle %u: found a damaged painting; drawn as far as it goes",
                   reader->file->source->name, reader->object->id, reader->triangle);
        reader->file->damaged = true;
    }
    return ok;
}

bool paint_finish(struct model_reader *reader)
{
    for (size_t i = 0; reader->midpoints.count && i < reader->indices.count;) {
        uint32_t *triangle = (uint32_t *)reader->indices.items + 3 * i, corners[3], side = 0;
        const struct threemf_property property = ((struct threemf_property *)reader->properties.items)[i];
        const struct midpoint *middle = NULL;
        memcpy(corners, triangle, sizeof corners);
        for (; side < 3 && !(middle && middle->high); side++)
            middle = slot_of(reader->midpoints.items, reader->midpoint_slots, corners[side], corners[(side + 1) % 3]);
        if (!middle->high) {
            i++;
            continue;
        }
        triangle[side % 3] = middle->vertex; // cuts the triangle in two, and looks at both again
        corners[side - 1] = middle->vertex;
        if (!model_add_triangle(reader, corners, &property))
            return false;
    }
    return true;
}

#endif
