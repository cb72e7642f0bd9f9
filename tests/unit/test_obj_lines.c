// test_obj_lines.c: the fast readers of OBJ lines for every instruction set of this machine read the same numbers as
// the C library.
#include "loading.h"

#include "cpu_features.h"
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

static int readers(obj_lines_reader *out[2])
{
    out[0] = obj_read_lines_scalar;
#if defined(__x86_64__)
    if (cpu_has(CPU_AVX512 | CPU_AVX512_VBMI)) {
        out[1] = obj_read_lines_avx512;
        return 2;
    }
#endif
    return 1;
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
    obj_lines_reader *all[2];
    int count = readers(all);
    memset(text + size, 0, FILE_PADDING);
    const uint8_t *begin = (const uint8_t *)text, *end = begin + size;
    for (int r = 0; r < count; r++) {
        struct obj obj = {
            .begin = begin, .end = end, .positions = found, .indices = found_corners, .total = {.positions = 1u << 31}};
        struct obj_chunk chunk = {.begin = begin, .end = end};
        struct obj_reader reader = {
            .obj = &obj, .chunk = &chunk, .end = end, .limit = {.positions = LINES, .triangles = LINES}};
        memset(found, 0xff, 3 * LINES * sizeof *found);
        memset(found_corners, 0xff, 3 * LINES * sizeof *found_corners);
        for (const uint8_t *at = begin; at < end;) {
            at = all[r](&reader, at, end);
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
}

static void positions(void **state)
{
    (void)state;
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
static void halves(void **state)
{
    (void)state;
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

static void triangles(void **state)
{
    (void)state;
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

// The fast path refuses lines of another form.
static void others(void **state)
{
    (void)state;
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
    obj_lines_reader *all[2];
    int count = readers(all);
    for (int r = 0; r < count; r++) {
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
                at = all[r](&reader, at, end);
            if ((at == NULL) != (lines[l].positions < 0) ||
                (at && (reader.next.positions != (uint64_t)lines[l].positions ||
                        reader.next.triangles != (uint64_t)lines[l].triangles)))
                fail_msg("reader %d: %s: %s", r, lines[l].line, at ? "read" : "refused");
        }
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(positions),
        cmocka_unit_test(halves),
        cmocka_unit_test(triangles),
        cmocka_unit_test(others),
    };
    return cmocka_run_group_tests_name("lines of OBJ files", tests, start, stop);
}
