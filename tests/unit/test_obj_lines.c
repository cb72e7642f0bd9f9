// test_obj_lines.c: the fast reader of OBJ lines reads the same numbers as the C library.
#include "test.h"
#include "loading.h"

#include "obj.h"

enum { LINES = 20000, ROOM = 128 * LINES };

static char *text;
static float *expected, *found;
static uint32_t *expected_corners, *found_corners;

static uint64_t random_state;
static uint64_t next_random(void)
{
    random_state ^= random_state << 13;
    random_state ^= random_state >> 7;
    random_state ^= random_state << 17;
    return random_state;
}

#pragma GCC diagnostic ignored "-Wformat-nonliteral"

// A position line with numbers of that form; up to `digits` digits of each are random.
static size_t make_position(char *at, const char *form, uint64_t digits, const char *end, float *out)
{
    size_t length = 1;
    at[0] = 'v';
    for (int i = 0; i < 3; i++) {
        char number[64];
        double x = (double)(next_random() % digits) / (double)digits * (next_random() % 3 ? 2 : 2000);
        snprintf(number, sizeof number, form, next_random() % 2 ? -x : x);
        out[i] = strtof(number, NULL);
        length += (size_t)sprintf(at + length, " %s", number);
    }
    return length + (size_t)sprintf(at + length, "%s", end);
}

static void check(size_t size, uint64_t positions, uint64_t triangles)
{
    memset(text + size, 0, FILE_PADDING);
    const uint8_t *begin = (const uint8_t *)text, *end = begin + size;
    struct obj obj = {
        .begin = begin, .end = end, .positions = found, .indices = found_corners, .total = {.positions = 1u << 31}};
    struct obj_chunk chunk = {.begin = begin, .end = end};
    struct obj_reader reader = {
        .obj = &obj, .chunk = &chunk, .end = end, .limit = {.positions = LINES, .triangles = LINES}};
    memset(found, 0xff, 3 * LINES * sizeof *found);
    memset(found_corners, 0xff, 3 * LINES * sizeof *found_corners);
    for (const uint8_t *at = begin; at < end;) {
        at = obj_read_lines(&reader, at, end);
        assert_non_null(at);
    }
    assert_int_equal(reader.next.positions, positions);
    assert_int_equal(reader.next.triangles, triangles);
    assert_memory_equal(found, expected, 3 * positions * sizeof *found);
    assert_memory_equal(found_corners, expected_corners, 3 * triangles * sizeof *found_corners);
    float low[3] = {0}, high[3] = {0};
    for (uint64_t i = 0; i < 3 * positions; i++) {
        low[i % 3] = expected[i] < low[i % 3] ? expected[i] : low[i % 3];
        high[i % 3] = expected[i] > high[i % 3] ? expected[i] : high[i % 3];
    }
    for (int i = 0; i < 3; i++)
        assert_true(reader.low[i] == low[i] && reader.high[i] == high[i]);
}

TEST(positions)
{
    static const char *const forms[] = {"%.6f",  "%.1f",  "%.2f", "%.7f", "%.8f", "%.9f", "%.10f", "%.14f",
                                        "%.15f", "%.18f", "%.9g", "%g",   "%.3e", "%.0f", "%+.5f", "%#.0f"};
    static const uint64_t digits[] = {10, 1000000, UINT64_C(1) << 53};
    random_state = 88172645463325252u;
    for (size_t f = 0; f < sizeof forms / sizeof *forms; f++) {
        for (size_t d = 0; d < 3; d++) {
            size_t size = 0;
            for (int i = 0; i < LINES / 10; i++)
                size += make_position(text + size, forms[f], digits[d], i % 7 ? "\n" : "\r\n", expected + 3 * i);
            check(size, LINES / 10, 0);
        }
    }
}

// Decimals next to the midpoint of two floats, where the rounding of a product must not decide.
TEST(halves)
{
    size_t size = 0;
    for (int i = 0; i < LINES; i++) {
        text[size++] = 'v';
        for (int k = 0; k < 3; k++) {
            // The midpoint of a float between 1 and 2 and the next one has 25 bits; it is written with 15 digits, and
            // with one digit changed.
            double middle = 1 + (double)(2 * (next_random() % (1 << 23)) + 1) / (1 << 24);
            char number[64];
            snprintf(number, sizeof number, k ? "%.14f" : "%.7f", middle);
            expected[3 * i + k] = strtof(number, NULL);
            size += (size_t)sprintf(text + size, " %s", number);
        }
        text[size++] = '\n';
    }
    check(size, LINES, 0);
}

TEST(triangles)
{
    size_t size = 0;
    for (int i = 0; i < LINES; i++) {
        text[size++] = 'f';
        for (int k = 0; k < 3; k++) {
            static const uint32_t most[] = {9, 99, 999, 9999, 99999, 999999, 9999999, 99999999, 2147483647};
            uint32_t corner = (uint32_t)(next_random() % most[next_random() % 9]) + 1;
            expected_corners[3 * i + k] = corner - 1;
            // Leading zeros, and more than one space, are also allowed.
            size += (size_t)sprintf(text + size, i % 50 == 49 ? "  %u" : i % 50 == 48 ? " 00%u" : " %u", corner);
        }
        size += (size_t)sprintf(text + size, "%s", i % 9 ? "\n" : i % 2 ? " \n" : "\r\n");
    }
    check(size, 0, LINES);
}

// Texture coordinates, normals, and faces of three to six corners that name what is kept: v/t, v//n or v/t/n.
TEST(attributes)
{
    enum { CORNERS = 6, COUNT = LINES / 20 };
    static uint32_t corners[3][3 * (CORNERS - 2) * COUNT], read[3][3 * (CORNERS - 2) * COUNT];
    static struct mesh_polygon polygons[COUNT];
    static float texcoords[2 * COUNT], normals[3 * COUNT], made[COUNT][5];
    for (int layout = 1; layout < 4; layout++) { // 1: texture coordinates, 2: normals
        size_t size = 0, triangles = 0, polygon_count = 0;
        for (int i = 0; i < COUNT; i++) {
            char number[5][32];
            for (int k = 0; k < 5; k++) {
                sprintf(number[k], i % 3 ? "%.9f" : "%.4g", (double)(next_random() % 2000000) / 1e6 - 1);
                made[i][k] = strtof(number[k], NULL);
            }
            const char *line_end = i % 5 ? "\n" : i % 2 ? " \n" : "\r\n";
            size += (size_t)sprintf(text + size, "vt %s %s%svn %s %s %s%sf", number[0], number[1], line_end, number[2],
                                    number[3], number[4], line_end);
            size_t count = i % 4 ? 3 : 3 + next_random() % (CORNERS - 2);
            for (size_t c = 0; c < count; c++) {
                uint32_t *to[3] = {&corners[0][3 * triangles + c], &corners[1][3 * triangles + c],
                                   &corners[2][3 * triangles + c]};
                for (int k = 0; k < 3; k++)
                    *to[k] = (uint32_t)(next_random() % (k ? 20000000 : 20000));
                size += (size_t)sprintf(text + size, " %u", *to[0] + 1);
                if (layout & 1)
                    size += (size_t)sprintf(text + size, "/%u", *to[1] + 1);
                if (layout & 2)
                    size += (size_t)sprintf(text + size, layout & 1 ? "/%u" : "//%u", *to[2] + 1);
            }
            size += (size_t)sprintf(text + size, "%s", line_end);
            polygon_count += count > 3;
            triangles += count - 2;
        }
        memset(text + size, 0, FILE_PADDING);
        const uint8_t *begin = (const uint8_t *)text, *end = begin + size;
        struct obj obj = {.begin = begin,
                          .end = end,
                          .positions = found,
                          .texcoords = texcoords,
                          .normals = normals,
                          .indices = read[0],
                          .texcoord_indices = layout & 1 ? read[1] : NULL,
                          .normal_indices = layout & 2 ? read[2] : NULL,
                          .polygons = polygons,
                          .total = {.positions = 20000, .texcoords = 20000000, .normals = 20000000}};
        struct obj_chunk chunk = {.begin = begin, .end = end};
        struct obj_counts limit = {
            .texcoords = COUNT, .normals = COUNT, .triangles = triangles, .polygons = polygon_count};
        struct obj_reader reader = {.obj = &obj, .chunk = &chunk, .end = end, .limit = limit};
        memset(read, 0, sizeof read);
        for (const uint8_t *at = begin; at < end;) {
            at = obj_read_lines(&reader, at, end);
            assert_non_null(at);
        }
        assert_memory_equal(&reader.next, &limit, sizeof limit);
        assert_int_equal(chunk.texcoord_used, layout & 1);
        assert_int_equal(chunk.normal_used, layout >> 1);
        assert_false((layout & 1 && chunk.texcoord_missing) || (layout & 2 && chunk.normal_missing));
        for (int i = 0; i < COUNT; i++) {
            assert_memory_equal(texcoords + 2 * i, made[i], 2 * sizeof(float));
            assert_memory_equal(normals + 3 * i, made[i] + 2, 3 * sizeof(float));
        }
        size_t p = 0, at = 0;
        for (size_t t = 0; t < triangles;) {
            size_t count = p < polygon_count && polygons[p].first_triangle == t ? polygons[p++].count : 3;
            for (int k = 0; k < 3; k++)
                if (k == 0 || layout & k)
                    assert_memory_equal(read[k] + 3 * t, corners[k] + 3 * t, count * sizeof(uint32_t));
            t += count - 2;
            at += count;
        }
        assert_int_equal(p, polygon_count);
        assert_true(at >= 3 * COUNT);
    }
}

// Every reader reads or refuses a damaged face exactly as obj_read_line, which has no fast path.
static const uint8_t *read_line_by_line(struct obj_reader *reader, const uint8_t *line, const uint8_t *end)
{
    while (line && line < end)
        line = obj_read_line(reader, line);
    return line;
}

TEST(damaged_faces)
{
    enum { CORNERS = 16 };
    static const char *const forms[] = {"f %u %u %u\n", "f %u/%u %u/%u %u/%u\n", "f %u//%u %u//%u %u//%u\r\n",
                                        "f %u/%u/%u %u/%u/%u %u/%u/%u\n"};
    static const char bytes[] = "0189/ -.x#\r\t/ 0";
    const uint8_t *(*const all[2])(struct obj_reader *, const uint8_t *, const uint8_t *) = {read_line_by_line,
                                                                                             obj_read_lines};
    const int count = 2;
    for (int i = 0; i < 4 * LINES; i++) {
        const int layout = (int)(next_random() % 4); // 1: texture coordinates, 2: normals
        uint32_t n[9];
        for (int k = 0; k < 9; k++)
            n[k] = (uint32_t)(next_random() % (next_random() % 2 ? 12 : 110000));
        size_t size =
            (size_t)sprintf(text, forms[next_random() % 4], n[0], n[1], n[2], n[3], n[4], n[5], n[6], n[7], n[8]);
        for (uint64_t damages = next_random() % 3; damages; damages--)
            text[2 + next_random() % (size - 3)] = bytes[next_random() % (sizeof bytes - 1)];
        memset(text + size, 0, FILE_PADDING);
        uint32_t indices[3][3][CORNERS];
        struct obj_chunk chunks[3];
        struct obj_counts next[3];
        bool read[3];
        memset(indices, 0, sizeof indices);
        memset(chunks, 0, sizeof chunks);
        for (int r = 0; r < count; r++) {
            struct mesh_polygon polygons[4];
            const uint8_t *begin = (const uint8_t *)text, *end = begin + size;
            struct obj obj = {.begin = begin,
                              .end = end,
                              .positions = found,
                              .texcoords = found,
                              .normals = found,
                              .indices = indices[r][0],
                              .texcoord_indices = layout & 1 ? indices[r][1] : NULL,
                              .normal_indices = layout & 2 ? indices[r][2] : NULL,
                              .polygons = polygons,
                              .total = {.positions = 100000, .texcoords = 100001, .normals = 100002}};
            struct obj_reader reader = {
                .obj = &obj, .chunk = &chunks[r], .end = end, .limit = {.triangles = CORNERS / 3, .polygons = 4}};
            const uint8_t *at = begin;
            while (at && at < end)
                at = all[r](&reader, at, end);
            read[r] = at != NULL;
            next[r] = reader.next;
            // Only attributes that are kept can be missing.
            chunks[r].texcoord_missing &= layout & 1;
            chunks[r].normal_missing &= layout >> 1;
            const size_t corners = reader.next.triangles + 2 * (reader.next.triangles > 0);
            if (read[r] != read[0] || memcmp(&next[r], &next[0], sizeof next[0]) != 0 ||
                memcmp(&chunks[r], &chunks[0], sizeof chunks[0]) != 0)
                fail_msg("reader %d, layout %d: %s", r, layout, text);
            for (int k = 0; read[r] && k < 3; k++)
                if (memcmp(indices[r][k], indices[0][k], corners * sizeof(uint32_t)) != 0)
                    fail_msg("reader %d, layout %d, indices %d: %s", r, layout, k, text);
        }
    }
}

// The fast path refuses lines of another form.
TEST(others)
{
    static const struct {
        const char *line;
        int positions, triangles; // that it makes; −1 if it is refused
    } lines[] = {
        {"v 1.0 2.0 3.0 4.0\n", 1, 0},
        {"v 1.0 2.0\n", -1, 0},
        {"v 1.0 2.0 3.0.0\n", -1, 0},
        {"v 1.0 2.-0 3.0\n", -1, 0},
        {"v 1.0.2.0 3.0 4.0\n", -1, 0},
        {"v 1.0 -.5 .5\n", 1, 0},
        {"v 1. 2. 3.\n", 1, 0},
        {"v 1.0 2.0 3.0 # x\n", 1, 0},
        {"v -1.0- 2.0 3.0\n", -1, 0},
        {"v 1.0 2.0 3.x\n", -1, 0},
        {"v  1.0 2.0 3.0\n", 1, 0},
        {"v 1.0 2.0 -\n", -1, 0},
        {"v 1 2 3\n", 1, 0},
        {"v 1.0 2.0 3/0\n", -1, 0},
        {"v 1.0 2.0 --3.0\n", -1, 0},
        {"f 1 2 3 4\n", 0, 2},
        {"f 1 2\n", 0, 0},
        {"f 1 2 0\n", -1, 0},
        {"f 1/2 3\n", 0, 0},
        {"f 1 2 -1\n", -1, 0},
        {"f 1 2 4294967296\n", -1, 0},
        {"f 1 2 x\n", -1, 0},
        {"f 1 2.5 3\n", -1, 0},
        {"f 1 2 123456789012345678901234567890\n", -1, 0},
        {"f1 2 3\n", 0, 0},
        {"\n", 0, 0},
        {"vn 1 2 3\n", 0, 0},
        {"f 1 2 3\\\n\n", 0, 1},
        {"v 1.0 2.0 \\\n3.0\n", 1, 0},
        {"v 1.0 2.0 3.0", 1, 0},
    };
    static struct obj_statement statements[8];
    static struct mesh_polygon polygons[8];
    for (size_t l = 0; l < sizeof lines / sizeof *lines; l++) {
        size_t size = (size_t)sprintf(text, "%s", lines[l].line);
        memset(text + size, 0, FILE_PADDING);
        const uint8_t *begin = (const uint8_t *)text, *end = begin + size, *at = begin;
        struct obj obj = {.begin = begin,
                          .end = end,
                          .positions = found,
                          .indices = found_corners,
                          .statements = statements,
                          .polygons = polygons,
                          .total = {.positions = 4000000000u}};
        struct obj_chunk chunk = {.begin = begin, .end = end};
        struct obj_reader reader = {.obj = &obj,
                                    .chunk = &chunk,
                                    .end = end,
                                    .limit = {.positions = 8, .triangles = 8, .others = 8, .polygons = 8}};
        while (at && at < end)
            at = obj_read_lines(&reader, at, end);
        if ((at == NULL) != (lines[l].positions < 0) || (at && (reader.next.positions != (uint64_t)lines[l].positions ||
                                                                reader.next.triangles != (uint64_t)lines[l].triangles)))
            fail_msg("%s: %s", lines[l].line, at ? "read" : "refused");
    }
}

static int start(void **state)
{
    (void)state;
    text = malloc(ROOM);
    expected = malloc(3 * LINES * sizeof *expected);
    found = malloc(3 * LINES * sizeof *found);
    expected_corners = malloc(3 * LINES * sizeof *expected_corners);
    found_corners = malloc(3 * LINES * sizeof *found_corners);
    return text && expected && found && expected_corners && found_corners ? 0 : -1;
}

static int stop(void **state)
{
    (void)state;
    free(text);
    free(expected);
    free(found);
    free(expected_corners);
    free(found_corners);
    return 0;
}

FIXTURE(start, stop)
