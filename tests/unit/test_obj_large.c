// test_obj_large.c: large OBJ files read chunk by chunk give the same scene as files read as a whole.
#include "test.h"
#include "large_file.h"

#include "obj.h"
#include "share.h"

enum { SIDE = 210, VERTICES = SIDE * SIDE, SQUARES = (SIDE - 1) * (SIDE - 1) };

static size_t faces_begin;

// The style of a generated file.
struct style {
    const char *first;    // precedes everything
    const char *corner;   // of a face, for printf: its number, up to three times
    const char *line_end; // NULL: "\n"
    const char *number;   // NULL: "%.6f"
    bool texcoords, normals, quads, parts, mixed, last_line_open;
    double far; // added to x
};

__attribute__((format(printf, 1, 2))) static void add(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    size += (size_t)vsnprintf(text + size, ROOM - size, format, arguments);
    va_end(arguments);
    assert_true(size < ROOM - 4096);
}

#pragma GCC diagnostic ignored "-Wformat-nonliteral"

static void number(const struct style *style, double x)
{
    text[size++] = ' ';
    size += (size_t)snprintf(text + size, ROOM - size, style->number ? style->number : "%.6f", x);
}

static void corner(const struct style *style, int v)
{
    text[size++] = ' ';
    size += (size_t)snprintf(text + size, ROOM - size, style->corner ? style->corner : "%d", v, v, v);
}

static void make(struct style style)
{
    const char *line_end = style.line_end ? style.line_end : "\n";
    size = 0;
    add("%s", style.first ? style.first : "# a comment\n");
    for (int i = 0; i < VERTICES; i++) {
        double u = i % SIDE / (double)SIDE, v = i / SIDE / (double)SIDE;
        add("v");
        number(&style, style.far + 3 * u - 1);
        number(&style, v - 0.5);
        number(&style, i * 37 % 101 * 0.003);
        add("%s", line_end);
        if (style.texcoords)
            add("vt %.4f %.4f%s", u, v, line_end);
        if (style.normals)
            add("vn %.4f %.4f 1.0000%s", u - 0.5, v - 0.5, line_end);
    }
    faces_begin = size;
    for (int i = 0; i < SQUARES; i++) {
        int a = i / (SIDE - 1) * SIDE + i % (SIDE - 1) + 1, b = a + 1, c = a + SIDE + 1, d = a + SIDE;
        if (style.parts && i % 5000 == 0)
            add("g group %d%susemtl none%ss %d%s", i / 10000, line_end, line_end, i % 3, line_end);
        add("f");
        corner(&style, a);
        corner(&style, b);
        corner(&style, c);
        if (style.quads && i % 3 != 0) {
            corner(&style, d);
        } else {
            add("%sf", line_end);
            corner(&style, a);
            corner(&style, c);
            corner(&style, d);
        }
        add("%s", line_end);
        if (style.mixed && i == SQUARES / 2)
            style.corner = NULL;
    }
    if (style.last_line_open)
        size -= strlen(line_end);
    assert_true(size > 1 << 20);
}

// Whether obj_stream.c reads the file.
static bool served(int threads)
{
    lam_load_params params = {0};
    struct call_control call;
    struct pool *pool = pool_make(threads);
    struct file_bytes head;
    call_start(&call, NULL);
    struct import_source source = {.name = path, .path = path, .params = &params, .pool = pool, .call = &call};
    assert_true(pool && file_open_parts(path, &call, &source.parts, &head, NULL));
    struct lam_scene *scene = scene_make(&call, NULL);
    assert_non_null(scene);
    struct obj obj = {.source = &source, .scene = scene};
    arena_start(&obj.memory, &call);
    bool done = obj_read_stream(&obj);
    arena_free(&obj.memory);
    lam_scene_free(scene);
    file_close_parts(&source.parts);
    file_release(&head);
    assert_int_equal(call.memory_used, 0); // all charges are refunded
    pool_free(pool);
    return done;
}

static void assert_same_text(const char *a, const char *b)
{
    assert_int_equal(a != NULL, b != NULL);
    if (a)
        assert_string_equal(a, b);
}

static void assert_same_scene(const lam_scene *a, const lam_scene *b)
{
    const lam_mesh *m = lam_scene_mesh(a, 0), *n = lam_scene_mesh(b, 0);
    assert_same_mesh(m, n);
    size_t corners = 12 * (size_t)m->triangle_count;
    assert_int_equal(m->texcoord_count, n->texcoord_count);
    assert_true(same_array(m->texcoord_indices, n->texcoord_indices, corners));
    assert_true(same_array(m->smoothing_groups, n->smoothing_groups, corners / 3));
    for (uint32_t p = 0; p < m->part_count; p++) {
        assert_same_text(m->parts[p].name, n->parts[p].name);
        assert_int_equal(m->parts[p].first_triangle, n->parts[p].first_triangle);
        assert_int_equal(m->parts[p].triangle_count, n->parts[p].triangle_count);
        assert_int_equal(m->parts[p].material, n->parts[p].material);
    }
    lam_vec3 low[2], high[2];
    assert_true(lam_scene_bounds(a, &low[0], &high[0]) && lam_scene_bounds(b, &low[1], &high[1]));
    assert_memory_equal(&low[0], &low[1], sizeof *low);
    assert_memory_equal(&high[0], &high[1], sizeof *high);
    for (int w = 0; w == 0 || lam_scene_warning(a, w - 1); w++)
        assert_same_text(lam_scene_warning(a, w), lam_scene_warning(b, w));
}

// Loads the file from disk and from memory, and compares the scenes or the errors. It returns whether the file loaded.
static bool load_both(void)
{
    bool loaded = false;
    write_file();
    for (int threads = 1; threads <= 3; threads += 2) {
        lam_error errors[2] = {0};
        lam_load_params params = {.threads = threads};
        lam_scene *scenes[2] = {lam_scene_load(path, &params, NULL, &errors[0]),
                                lam_scene_load_memory(text, size, path, &params, NULL, &errors[1])};
        assert_int_equal(scenes[0] != NULL, scenes[1] != NULL);
        loaded = scenes[0] != NULL;
        if (loaded) {
            assert_same_scene(scenes[0], scenes[1]);
        } else {
            assert_int_equal(errors[0].code, errors[1].code);
            assert_string_equal(errors[0].text, errors[1].text);
        }
        for (int k = 0; k < 2; k++)
            lam_scene_free(scenes[k]);
    }
    return loaded;
}

// Typical files are read chunk by chunk.
TEST(usual_files)
{
    const struct style styles[] = {
        {0},
        {.line_end = "\r\n"},
        {.line_end = " \r\n"},
        {.first = "\xef\xbb\xbf# with a mark\n"},
        {.last_line_open = true},
        {.number = "%.9g"},
        {.number = "%.4f"},
        {.number = "%.8f"},
        {.number = "%.3e"},
        {.number = "%12.6f", .corner = "%7d"},
        {.quads = true},
        {.texcoords = true, .corner = "%d/%d"},
        {.normals = true, .corner = "%d//%d"},
        {.texcoords = true, .normals = true, .corner = "%d/%d/%d", .quads = true},
        {.texcoords = true, .normals = true},
        {.texcoords = true, .normals = true, .corner = "%d//%d", .quads = true},
        {.first = "o the only one\n\ns off\n"},
        {.first = "l 1 2\n", .number = "%.7f"},
    };
    for (size_t i = 0; i < sizeof styles / sizeof *styles; i++) {
        make(styles[i]);
        assert_true(load_both());
        for (int threads = 1; threads <= 3; threads++)
            assert_true(served(threads));
    }
}

// A vertex that no face uses does not affect the bounds.
TEST(unused_vertex)
{
    for (int quads = 0; quads < 2; quads++) {
        make((struct style){.quads = quads});
        add("v 0 0 99\n");
        assert_true(load_both());
        assert_true(served(2));
        lam_vec3 high;
        AUTO_SCENE scene = lam_scene_load(path, NULL, NULL, NULL);
        assert_true(lam_scene_bounds(scene, NULL, &high) && high.z < 1);
    }
}

// Groups, materials and smoothing groups between the faces. The warning about an undefined material contains its line.
TEST(statements)
{
    make((struct style){.parts = true, .quads = true});
    assert_true(load_both());
    assert_true(served(2));
    for (char *at = strstr(text, "usemtl"); at; at = strstr(at, "usemtl"))
        memcpy(at, "bevel ", 6);
    assert_true(load_both());
    assert_true(served(1));
    assert_true(served(3));
}

// Valid but unusual files are read as a whole.
TEST(unusual_files)
{
    const struct style styles[] = {
        {.far = 1e6},
        {.number = "%.6f 0.5 0.5", .first = "# colours\n"},
        {.normals = true, .corner = "%d//%d", .mixed = true},
        {.normals = false, .corner = "%d//%d"},
        {.corner = "%d/%d"},
    };
    for (size_t i = 0; i < sizeof styles / sizeof *styles; i++) {
        make(styles[i]);
        assert_true(load_both());
        assert_false(served(2));
    }
    make((struct style){0});
    add("f -1 -2 -3\n");
    assert_true(load_both());
    assert_false(served(1));
    make((struct style){0});
    add("v 1 2 3 0.5 0.25 0.125\n");
    assert_true(load_both());
    assert_false(served(2));
    make((struct style){0});
    add("# %0*d\nf 1 2 3\n", 40000, 1); // a line longer than TAIL
    assert_true(load_both());
    make((struct style){0});
    for (int i = 0; i < 6000; i++)
        add("g %d\n", i);
    add("f 1 2 3\n");
    assert_true(load_both());
}

// Line ends, continuations and comments at every position around the border of two pieces.
TEST(edges)
{
    static const char *const lines[] = {"f 1 2 \\\n3\n", "# a comment \\\nf 4 5 6\n", "v 1 \\\r\n2 3\n", "\n\n\n",
                                        "f 123 4567 89\r\n"};
    make((struct style){0});
    size_t whole = size;
    char *copy = malloc(whole);
    assert_non_null(copy);
    memcpy(copy, text, whole);
    for (size_t l = 0; l < sizeof lines / sizeof *lines; l++) {
        for (size_t shift = 0; shift < 14; shift++) {
            if (!is_taken(l + shift, 5))
                continue;
            // A comment as padding: the line begins shortly before the border.
            size_t edge = 256 << 10, at = edge - 400;
            memcpy(text, copy, whole);
            size = whole;
            while (text[at - 1] != '\n')
                at--;
            size_t next = at + 450;
            while (text[next - 1] != '\n')
                next++;
            size_t comment = edge - shift - at;
            memset(text + at, 'x', comment);
            text[at] = '#';
            text[at + comment - 1] = '\n';
            size_t length = strlen(lines[l]);
            memmove(text + at + comment + length, copy + next, whole - next);
            memcpy(text + at + comment, lines[l], length);
            size = at + comment + length + (whole - next);
            // Fewer vertices, without the faces of the last ones.
            size = (size_t)(strstr(text, "f 41") - text);
            assert_true(load_both());
        }
    }
    free(copy);
}

// Faces of vertices that are not finite are left out, also if the file is read in parts.
TEST(not_finite)
{
    make((struct style){0});
    add("v nan 1e39 2\nf 1 2 44101\nf 1 2 3 44101 5\n");
    assert_true(load_both());
    assert_true(served(2));
}

TEST(errors_are_those_of_small_files)
{
    static const char *const wrong[] = {"f 1 2 44101\n", "f 0 1 2\n",      "f 1 2\n",          "v 1 2\n",
                                        "v 1 2x 2\n",    "f 1 2 x\n",      "v 1 2 3 x\n",      "vn 1 2\n",
                                        "hello\n",       "f 1 2 -44101\n", "f 1 2 99999999\n", "f 1 2 4294967297\n"};
    for (size_t w = 0; w < sizeof wrong / sizeof *wrong; w++) {
        for (size_t place = 0; place < 3; place++) { // first, at a piece's edge, last
            if (!is_taken(w + place, 3))
                continue;
            make((struct style){.first = place == 0 ? wrong[w] : NULL});
            if (place == 1) {
                char *at = memchr(text + (512 << 10) - 5, '\n', 100), *behind = at + 1 + strlen(wrong[w]);
                behind = memchr(behind, '\n', 100);
                assert_true(at && behind);
                memset(at + 1, ' ', (size_t)(behind - at - 1));
                memcpy(at + 1, wrong[w], strlen(wrong[w]) - 1);
            } else if (place == 2) {
                add("%s", wrong[w]);
            }
            load_both();
            if (served(2))
                fail_msg("%s at place %zu is served", wrong[w], place);
        }
    }
    make((struct style){0});
    text[faces_begin + 100000] = 0;
    assert_false(load_both());
    make((struct style){0});
    size = faces_begin; // no faces: points
    assert_true(load_both());
    assert_false(served(2));
    make((struct style){.first = "# a comment\r", .line_end = "\r"}); // from old Macintosh programs
    assert_true(load_both());
    assert_false(served(2));
}

TEST(can_be_stopped)
{
    make((struct style){0});
    write_file();
    check_stops(2 << 20);
}

// Each allocation fails once: the file is refused, or read as a whole; nothing leaks.
TEST(memory)
{
    make((struct style){.normals = true, .corner = "%d//%d", .quads = true, .first = "o name\ng group\n"});
    write_file();
    int refused = 0;
    for (long countdown = 0; countdown < 30; countdown++) {
        arena_fail_after(countdown);
        refused += !served(1);
        arena_fail_after(-1);
    }
    assert_in_range(refused, 5, 29);
}

FIXTURE(start, stop)
