// test_large_files.c: large STL and PLY files, which are read in parts, give the same scenes and errors as in memory.
#include "test.h"
#include "large_file.h"

enum { SIDE = 260, VERTICES = SIDE * SIDE, TRIANGLES = 2 * (SIDE - 1) * (SIDE - 1) };

static bool big; // numbers of more than a byte are written big-endian

static void add(const void *from, size_t count)
{
    assert_true(size + count <= ROOM);
    memcpy(text + size, from, count);
    size += count;
}

static void add_number(const void *number, size_t count)
{
    const uint8_t *from = number;
    for (size_t i = 0; i < count; i++) // the tests run on little-endian machines
        add(from + (big ? count - 1 - i : i), 1);
}

static void add_text(const char *line) { add(line, strlen(line)); }
static void add_u8(unsigned n) { add(&(uint8_t){(uint8_t)n}, 1); }
static void add_u16(unsigned n) { add_number(&(uint16_t){(uint16_t)n}, 2); }
static void add_u32(uint32_t n) { add_number(&n, 4); }
static void add_f32(float n) { add_number(&n, 4); }
static void add_f64(double n) { add_number(&n, 8); }

static float position(int vertex, int axis)
{
    return axis == 0   ? (float)(vertex % SIDE) * 0.5f
           : axis == 1 ? (float)(vertex / SIDE) * 0.25f
                       : (float)(vertex * 37 % 101) * 0.125f;
}

// The vertex of a triangle's corner.
static int corner(int triangle, int c)
{
    int square = triangle / 2, a = square / (SIDE - 1) * SIDE + square % (SIDE - 1);
    const int corners[2][3] = {{a, a + 1, a + SIDE + 1}, {a, a + SIDE + 1, a + SIDE}};
    return corners[triangle % 2][c];
}

// Loads the file from disk and from memory, and compares the scenes, or the errors. Returns whether it loaded.
static bool load_both(const char *format)
{
    bool loaded = false;
    write_file();
    assert_true(size >= FILE_HEAD - 1);
    for (int threads = 1; threads <= 3; threads += 2) {
        lam_error errors[2] = {0};
        lam_load_params params = {.threads = threads, .format = format};
        lam_scene *scenes[2] = {lam_scene_load(path, &params, NULL, &errors[0]),
                                lam_scene_load_memory(text, size, path, &params, NULL, &errors[1])};
        loaded = scenes[0] != NULL;
        assert_int_equal(errors[0].code, errors[1].code);
        assert_string_equal(errors[0].text, errors[1].text);
        assert_int_equal(loaded, scenes[1] != NULL);
        for (int i = 0; loaded && i < lam_scene_mesh_count(scenes[0]); i++)
            assert_same_mesh(lam_scene_mesh(scenes[0], i), lam_scene_mesh(scenes[1], i));
        for (int w = 0; loaded && (lam_scene_warning(scenes[0], w) || lam_scene_warning(scenes[1], w)); w++)
            assert_string_equal(lam_scene_warning(scenes[0], w), lam_scene_warning(scenes[1], w));
        lam_scene_free(scenes[0]);
        lam_scene_free(scenes[1]);
    }
    return loaded;
}

// Whether the file can be loaded within a memory limit that has no room for both the whole file and the result of
// `kept` bytes.
static bool fits(size_t kept)
{
    lam_error error;
    lam_scene *scene = lam_scene_load(path, &(lam_load_params){.normals_when_drawn = true, .threads = 2},
                                      &(lam_control){.memory_limit_bytes = kept + size / 4 * 3}, &error);
    lam_scene_free(scene);
    return scene != NULL;
}

// --- STL

// `word` is the attribute of every third facet. From facet `shuffled` on, the facets are in an order in which
// neighbours are far apart.
static void make_shuffled_stl(const char *header, unsigned word, int shuffled)
{
    size = 0;
    add_text(header);
    while (size < 80)
        add_u8(' ');
    add_u32(TRIANGLES);
    for (int t = 0; t < TRIANGLES; t++) {
        for (int i = 0; i < 3; i++)
            add_f32(0);
        for (int c = 0; c < 9; c++)
            add_f32(position(corner(t < shuffled ? t : (int)(t * INT64_C(7919) % TRIANGLES), c / 3), c % 3));
        add_u16(t % 3 ? 0 : word);
    }
}

static void make_stl(const char *header, unsigned word) { make_shuffled_stl(header, word, TRIANGLES); }

TEST(stl_files)
{
    make_stl("a header", 0);
    assert_true(load_both(NULL));
    assert_true(fits(36 * TRIANGLES));
    make_stl("a header", 0x8000 | 31); // colours of VisCAM
    assert_true(load_both(NULL));
    make_stl("COLOR=\1\2\3\4", 0x1234); // colours of Materialise Magics
    assert_true(load_both(NULL));
    make_stl("COLOR=\1\2\3\4", 0);
    assert_true(load_both(NULL));
    make_stl("a header", 0);
    add_text("text after the last facet");
    assert_true(load_both("stl"));
}

static lam_scene *load_stl(int threads, lam_normals normals)
{
    lam_error error;
    const lam_load_params params = {.threads = threads, .normals = normals, .crease_angle_rad = 3.14159};
    lam_scene *scene = lam_scene_load(path, &params, NULL, &error);
    assert_non_null(scene);
    return scene;
}

// The facets of a large file share vertices, if neighbours are close in the file. The mesh is the same for any number
// of threads. All corners at a position get the same smooth normal, also if two windows of the file have a vertex there.
TEST(stl_vertices)
{
    make_stl("a header", 0);
    write_file();
    lam_scene *one = load_stl(1, LAM_NORMALS_FILE), *three = load_stl(3, LAM_NORMALS_FILE),
              *facets = load_stl(3, LAM_NORMALS_FACET);
    const lam_mesh *mesh = lam_scene_mesh(one, 0);
    assert_same_mesh(mesh, lam_scene_mesh(three, 0));
    assert_int_equal(lam_scene_mesh(facets, 0)->vertex_count, mesh->vertex_count);
    assert_in_range(mesh->vertex_count, VERTICES + 1, VERTICES + VERTICES / 8);
    const float **normals = calloc(VERTICES, sizeof *normals);
    assert_non_null(normals);
    for (int t = 0; t < TRIANGLES; t++)
        for (int k = 0; k < 3; k++) {
            size_t c = 3 * (size_t)t + (size_t)k;
            int vertex = corner(t, k);
            for (int axis = 0; axis < 3; axis++)
                assert_true(mesh->positions[3 * (size_t)mesh->indices[c] + (size_t)axis] == position(vertex, axis));
            const float *normal = mesh->normals + 3 * (size_t)mesh->normal_indices[c];
            if (!normals[vertex])
                normals[vertex] = normal;
            assert_memory_equal(normals[vertex], normal, 3 * sizeof *normal);
        }
    free(normals);
    lam_scene_free(one);
    lam_scene_free(three);
    lam_scene_free(facets);
    for (int shuffled = 0; shuffled <= TRIANGLES / 2; shuffled += TRIANGLES / 2) { // all facets, or the second half
        make_shuffled_stl("a header", 0, shuffled);
        assert_true(load_both(NULL));
        AUTO_SCENE scene = load_stl(2, LAM_NORMALS_FILE);
        assert_null(lam_scene_mesh(scene, 0)->indices);
    }
}

TEST(stl_errors)
{
    const float nan = __builtin_nanf("");
    make_stl("a header", 0);
    memcpy(text + 84 + 50 * 20000 + 12, &nan, 4);
    memcpy(text + 84 + 50 * 40000 + 16, &nan, 4);
    assert_true(load_both(NULL));
    make_stl("a header", 0);
    size -= 51;
    assert_false(load_both("stl"));
    size = 84;
    while (size < 2 << 20)
        add_u8('x');
    text[0] = 'x';
    assert_false(load_both("stl"));
}

// --- PLY

struct layout {
    const char *format;       // NULL: binary_little_endian
    const char *corners;      // the list of the faces; NULL: "uchar int"
    bool doubles, far;        // positions; far from zero
    bool normals, bytes;      // of the vertices; colours as bytes
    bool face_colors, mixed;  // a quad between the triangles
    bool list_first, trailer; // an element with lists before the vertices; one after the faces
    bool tags, shorts;        // a list at each vertex; colours as 16-bit numbers up to 255
};

static void add_faces(const struct layout *layout, bool wide)
{
    for (int t = 0; t < TRIANGLES; t++) {
        bool quad = layout->mixed && t == TRIANGLES / 2;
        if (wide)
            add_u16(quad ? 4 : 3);
        else
            add_u8(quad ? 4 : 3);
        for (int c = 0; c < 3 + quad; c++)
            add_u32((uint32_t)corner(t, c % 3));
        for (int i = 0; layout->face_colors && i < 3; i++)
            add_u8((unsigned)(t + i) & 255);
    }
}

static void make_ply(struct layout layout)
{
    char header[512];
    const char *type = layout.doubles ? "double" : "float";
    big = layout.format && strstr(layout.format, "big");
    size = 0;
    snprintf(header, sizeof header,
             "ply\nformat %s 1.0\n%selement vertex %d\nproperty %s x\nproperty %s y\nproperty %s z\n%s%s"
             "%selement face %d\nproperty list %s vertex_indices\n%s%send_header\n",
             layout.format ? layout.format : "binary_little_endian",
             layout.list_first ? "element extra 2\nproperty list uchar short a\n" : "", VERTICES, type, type, type,
             layout.normals ? "property float nx\nproperty float ny\nproperty float nz\n" : "",
             layout.bytes    ? "property uchar red\nproperty uchar green\nproperty uchar blue\n"
             : layout.shorts ? "property ushort red\nproperty ushort green\nproperty ushort blue\n"
                             : "",
             layout.tags ? "property list uchar uchar tags\n" : "", TRIANGLES,
             layout.corners ? layout.corners : "uchar int",
             layout.face_colors ? "property uchar red\nproperty uchar green\nproperty uchar blue\n" : "",
             layout.trailer ? "element rest 3\nproperty int a\n" : "");
    add_text(header);
    for (int i = 0; layout.list_first && i < 2; i++) {
        add_u8(1);
        add_u16(7);
    }
    for (int v = 0; v < VERTICES; v++) {
        for (int axis = 0; axis < 3; axis++) {
            double x = (double)position(v, axis) + (layout.far && axis == 0 ? 1e7 : 0);
            if (layout.doubles)
                add_f64(x);
            else
                add_f32((float)x);
        }
        for (int i = 0; layout.normals && i < 3; i++)
            add_f32(i == 2 ? 1.0f : (float)(v % 7) * 0.01f);
        for (int i = 0; layout.bytes && i < 3; i++)
            add_u8((unsigned)(v + i) & 255);
        for (int i = 0; layout.shorts && i < 3; i++)
            add_u16((unsigned)(v + i) & 255);
        for (int i = 0; layout.tags && i <= v % 3; i++)
            add_u8((unsigned)(i ? v & 255 : v % 3));
    }
    add_faces(&layout, layout.corners && strncmp(layout.corners, "ushort", 6) == 0);
    for (int i = 0; layout.trailer && i < 3; i++)
        add_u32(0);
}

TEST(ply_files)
{
    const struct layout layouts[] = {
        {0},
        {.format = "binary_big_endian"},
        {.corners = "uchar uint"},
        {.corners = "ushort int"},
        {.normals = true, .bytes = true},
        {.doubles = true, .far = true, .normals = true},
        {.format = "binary_big_endian", .doubles = true, .bytes = true},
        {.shorts = true},
        {.format = "binary_big_endian", .shorts = true, .tags = true},
        {.face_colors = true},
        {.mixed = true},
        {.mixed = true, .face_colors = true, .normals = true},
        {.list_first = true},
        {.tags = true},
        {.tags = true, .mixed = true},
        {.trailer = true},
    };
    for (size_t i = 0; i < sizeof layouts / sizeof *layouts; i++) {
        make_ply(layouts[i]);
        assert_true(load_both(NULL));
        if (i == 0)
            assert_true(fits(12 * (VERTICES + TRIANGLES)));
        size += 3; // bytes after the last row
        load_both(NULL);
    }
}

TEST(ply_errors)
{
    const struct layout layouts[] = {
        {0},
        {.format = "binary_big_endian"},
        {.doubles = true, .normals = true},
        {.mixed = true},
        {.face_colors = true},
    };
    for (size_t i = 0; i < sizeof layouts / sizeof *layouts; i++) {
        make_ply(layouts[i]);
        size_t vertices = (size_t)(strstr(text, "end_header\n") + 11 - text), whole = size;
        memset(text + whole - 30, 0x77, 4);
        assert_false(load_both(NULL)); // an index, or a number of corners
        make_ply(layouts[i]);
        memset(text + vertices + 48 * 9001, 0xff, 24); // not a number
        assert_true(load_both(NULL));
        make_ply(layouts[i]);
        size = whole - 5;
        assert_false(load_both(NULL));
        size = vertices + 5000;
        while (size < 1 << 20)
            add_u8(0);
        size = (1 << 20) + 1;
        load_both(NULL);
    }
    make_ply((struct layout){0});
    memcpy(strstr(text, "float y"), "float q", 7);
    assert_false(load_both(NULL));
}

// Inserts `count` bytes at an offset.
static void insert(size_t at, int byte, size_t count)
{
    assert_true(size + count <= ROOM);
    memmove(text + at + count, text + at, size - at);
    memset(text + at, byte, count);
    size += count;
}

// The header ends before, at and after the end of the bytes that are read first. Such a file is read in parts or as a
// whole, with the same result.
TEST(ply_headers)
{
    for (int past = -12; past <= 2; past += past < -2 ? 5 : 1) { // the whole line "end_header", a part of it, or none
        make_ply((struct layout){.format = past % 2 ? "binary_big_endian" : NULL});
        const size_t line = (size_t)(FILE_HEAD + past) - (size_t)(strstr(text, "end_header\n") + 11 - text);
        insert(4, 'c', line);
        memcpy(text + 4, "comment ", 8);
        text[4 + line - 1] = '\n';
        assert_true(load_both(NULL));
    }
}

// Headers without an end, and long headers of text files, of sizes at which the reader's method changes.
TEST(ply_long_headers)
{
    static const struct {
        const char *first, *last; // around the filled bytes
        int fill;
        bool loads;
    } rows[] = {
        {"ply\n", "", 0, false},
        {"ply\n", "", 'c', false},
        {"ply\r", "", '\r', false},
        {"ply\n", "", '\n', false},
        {"ply\nformat binary_little_endian 1.0\ncomment ", "", 'c', false},
        {"ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float x\n", "end_header", ' ', false},
        {"ply\ncomment ", "\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n", 'c', false},
        {"ply\ncomment ",
         "\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
         "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
         'c', true},
        {"ply\rcomment ",
         "\rformat ascii 1.0\relement vertex 3\rproperty float x\rproperty float y\rproperty float z\rend_header\r"
         "0 0 0\r1 0 0\r0 1 0\r",
         '\n', true},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        for (size_t total = FILE_HEAD - 1; total <= FILE_HEAD + 1; total++) {
            size = 0;
            add_text(rows[i].first);
            insert(size, rows[i].fill, total - size - strlen(rows[i].last));
            add_text(rows[i].last);
            assert_int_equal(load_both(NULL), rows[i].loads);
        }
}

// Every format is recognised from the first bytes of a large file as from the whole file.
TEST(beginnings)
{
    static const struct {
        const char *first, *last;
        char fill;
        bool loads;
    } rows[] = {
        {"# a comment\n#", "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", 'c', false}, // looks like a comment only
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\n#", "\nf 1 2 3\n", 'c', true},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\n", "f 1 2 3\n", '\n', true},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "", 0, false},
        {"solid a\nfacet normal 0 0 1\nouter loop\n",
         "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n", ' ', true},
        {"solid ", "\nendsolid\n", 's', false},
        {"", "{\"asset\":{\"version\":\"2.0\"}}", ' ', false},
        {"{", "\"asset\":{\"version\":\"2.0\"}}", ' ', false},
        {"glTF\2", "", 7, false},
        {"{\"lambent\":1,", "\"objects\":[{\"shape\":\"cube\"}]}", ' ', true},
        {"{", "\"lambent\":1,\"objects\":[{\"shape\":\"cube\"}]}", ' ', false},
        {"PK\3\4", "_rels/.rels 3D/a.model", 'k', false},
        {"", "", 0, false},
        {"", "", 'x', false},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        for (size_t total = 2 * FILE_HEAD - 1; total <= 2 * FILE_HEAD + 1; total++) {
            size = 0;
            add_text(rows[i].first);
            insert(size, rows[i].fill, total - size - strlen(rows[i].last));
            add_text(rows[i].last);
            bool loads = load_both(NULL);
            if (loads != rows[i].loads)
                fail_msg("row %zu, %zu bytes: %s", i, total, loads ? "a scene" : "an error");
        }
}

TEST(can_be_stopped)
{
    make_ply((struct layout){0});
    assert_true(load_both(NULL));
    check_stops(1 << 20);
}

// Each allocation fails in turn: the file is refused for want of memory; nothing leaks.
TEST(memory)
{
    const struct layout layouts[] = {{0}, {.normals = true, .bytes = true}, {.mixed = true}};
    for (size_t i = 0; i < 4; i++) {
        if (i < 3)
            make_ply(layouts[i]);
        else
            make_stl("a header", 0x8000);
        assert_true(load_both(NULL));
        int refused = 0;
        for (long countdown = 0; countdown < 40; countdown++) {
            lam_error error = {0};
            arena_fail_after(countdown);
            AUTO_SCENE scene = lam_scene_load(path, &(lam_load_params){.threads = 1}, NULL, &error);
            arena_fail_after(-1);
            if (!scene)
                assert_int_equal(error.code, LAM_MACHINE);
            refused += !scene;
        }
        assert_true(refused >= 3);
    }
}

FIXTURE(start, stop)
