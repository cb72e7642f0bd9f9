// test_stl.c: STL: recognising binary and ASCII files, colours, parts, and errors.
#include "test.h"
#include "loading.h"

static const char one_facet[] = "solid thing\n"
                                "  facet normal 0 0 1\n"
                                "    outer loop\n"
                                "      vertex 0 0 0\n"
                                "      vertex 1.5 0 0\n"
                                "      vertex 0 2e1 -0.25\n"
                                "    endloop\n"
                                "  endfacet\n"
                                "endsolid thing\n";

static void put_header(struct made *file, const char *text, uint32_t facets)
{
    uint8_t header[80];
    memset(header, ' ', sizeof header);
    memcpy(header, text, strlen(text));
    put(file, header, sizeof header);
    put_u32(file, facets);
}

// Facet number n: a corner at (n, 0, 0), and two next to it.
static void put_facet(struct made *file, int n, uint16_t word)
{
    float numbers[12] = {0, 0, 1, (float)n, 0, 0, (float)n + 1, 0, 0, (float)n, 1, 0.5f};
    for (int i = 0; i < 12; i++)
        put_f32(file, numbers[i]);
    put_u16(file, word);
}

static const uint8_t *color_of(const lam_mesh *mesh, uint32_t triangle)
{
    assert_int_equal(mesh->colors_rate, LAM_PER_TRIANGLE);
    assert_int_equal(mesh->color_count, mesh->triangle_count);
    return (const uint8_t *)mesh->colors + 4 * triangle;
}

static void assert_color(const lam_mesh *mesh, uint32_t triangle, int r, int g, int b)
{
    const uint8_t *color = color_of(mesh, triangle);
    assert_int_equal(color[0], r);
    assert_int_equal(color[1], g);
    assert_int_equal(color[2], b);
    assert_int_equal(color[3], 255);
}

TEST(test_ascii)
{
    AUTO_SCENE scene = load_text(one_facet, "a.stl");
    const lam_mesh *mesh = lam_scene_mesh(scene, 0);
    assert_string_equal(lam_scene_format(scene), "stl");
    assert_int_equal(lam_scene_up(scene), LAM_UP_Z);
    assert_int_equal(lam_scene_object_count(scene), 1);
    assert_int_equal(mesh->triangle_count, 1);
    assert_corner(mesh, 0, 1, 1.5, 0, 0);
    assert_corner(mesh, 0, 2, 0, 20, -0.25);
    assert_int_equal(mesh->part_count, 1);
    assert_string_equal(mesh->parts[0].name, "thing");
}

// Keywords in any case, lines broken anywhere, every line end, a byte order mark, normals that are not numbers, a facet
// outside a solid, an empty solid, invalid UTF-8 in a name.
TEST(test_ascii_oddities)
{
    static const char text[] =
        "\xef\xbb\xbf\t SOLID two words\there \r\nFACET normal nan -nan(ind) nan OUTER\vloop vertex 1 2 3 "
        "Vertex 4 5 6\r"
        "vertex 7 8 9 endloop\fendfacet\r\nEndSolid two words\r\n"
        "solid empty\nendsolid empty\n"
        "facet normal outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet\n"
        "solid caf\xe9\nfacet outer loop vertex 0 0 0 vertex 2 0 0 vertex 0 1 0 endloop endfacet\nendsolid\n";
    AUTO_SCENE scene = load_text(text, "odd.stl");
    const lam_mesh *mesh = lam_scene_mesh(scene, 0);
    assert_int_equal(mesh->triangle_count, 3);
    assert_corner(mesh, 0, 2, 7, 8, 9);
    assert_corner(mesh, 2, 1, 2, 0, 0);
    assert_int_equal(mesh->part_count, 3);
    assert_string_equal(mesh->parts[0].name, "two words\there");
    assert_null(mesh->parts[1].name);
    assert_string_equal(mesh->parts[2].name, "caf\xef\xbf\xbd");
    for (uint32_t i = 0; i < 3; i++) {
        assert_int_equal(mesh->parts[i].first_triangle, i);
        assert_int_equal(mesh->parts[i].triangle_count, 1);
    }
}

// A file that ends between two facets may be truncated.
TEST(test_ascii_without_end)
{
#define ONE "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
    static const struct {
        const char *text, *warning; // NULL: none
    } rows[] = {
        {"solid a\n" ONE "endsolid a\n", NULL},
        {"solid a\n" ONE "endsolid", NULL},
        {"solid a\nendsolid a\nsolid b\n" ONE "endsolid b\n", NULL},
        {ONE, NULL}, // no solid, no end
        {"solid a\n" ONE "endsolid a\n" ONE, NULL},
        {"solid a\n" ONE,
         "a.stl:9: found the end of the file, expected \"endsolid\" for the solid in line 1; the file may "
         "be cut short"},
        {"\nsolid\n" ONE ONE "\n",
         "a.stl:18: found the end of the file, expected \"endsolid\" for the solid in line 2; the "
         "file may be cut short"},
        {"solid a\n" ONE "solid b\n" ONE "endsolid b\n",
         "a.stl:9: found 'solid', expected \"endsolid\" for the solid in line 1"},
        {"solid a\n" ONE "solid b\n" ONE, "a.stl:9: found 'solid', expected \"endsolid\" for the solid in line 1, the "
                                          "first of several solids without \"endsolid\""},
        {"solid a\n" ONE "endsolid a\nsolid b\n", "a.stl:11: found the end of the file, expected \"endsolid\" for the "
                                                  "solid in line 10; the file may be cut short"},
        // far from zero, where the text is read twice
        {"solid a\nfacet normal 0 0 1\nouter loop\nvertex 1e6 0 0\nvertex 1000001 0 0\nvertex 1e6 1 "
         "0\nendloop\nendfacet\n",
         "a.stl:9: found the end of the file, expected \"endsolid\" for the solid in line 1; the file may be cut "
         "short"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        AUTO_SCENE scene = load_text(rows[i].text, "a.stl");
        const char *warning = lam_scene_warning(scene, 0);
        if (rows[i].warning ? !warning || strcmp(warning, rows[i].warning) != 0 : warning != NULL)
            fail_msg("row %zu: %s", i, warning ? warning : "no warning");
        assert_null(lam_scene_warning(scene, 1));
    }
}

// A text with a zero byte is not a binary file.
TEST(test_ascii_with_zero)
{
    static const char text[] = "solid a\n" ONE ONE "endsolid a\n";
    char changed[sizeof text];
    int lines = 1;
    for (size_t at = 5; at < sizeof text - 1; at++) {
        lines = 1;
        for (size_t i = 0; i < at; i++)
            lines += text[i] == '\n';
        memcpy(changed, text, sizeof text);
        changed[at] = 0;
        char wanted[80];
        snprintf(wanted, sizeof wanted, "a.stl:%d: found a zero byte, expected text", lines);
        refuse(changed, sizeof text - 1, "a.stl", LAM_CANNOT_READ, wanted);
    }
    // This also holds far behind the part that determines the format.
    size_t size = 200 * (sizeof ONE - 1) + 8;
    char *large = malloc(size);
    memcpy(large, "solid a\n", 8);
    for (int i = 0; i < 200; i++)
        memcpy(large + 8 + (size_t)i * (sizeof ONE - 1), ONE, sizeof ONE - 1);
    large[size - 3] = 0;
    refuse(large, size, "a.stl", LAM_CANNOT_READ, "a.stl:1401: found a zero byte, expected text");
    free(large);
}

TEST(test_ascii_in_one_line)
{
    AUTO_SCENE scene = load_text("solid all of it facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 "
                                 "endloop endfacet endsolid",
                                 "line.stl");
    const lam_mesh *mesh = lam_scene_mesh(scene, 0);
    assert_int_equal(mesh->triangle_count, 1);
    assert_string_equal(mesh->parts[0].name, "all of it");
}

// A part with details of a millimetre, 500 km from zero.
TEST(test_ascii_far_from_zero)
{
    lam_scene *scene =
        load_text("solid far\nfacet normal 0 0 1\nouter loop\nvertex 500000.0001 0 0.5\n"
                  "vertex 500000.0012 0.001 0.5\nvertex 500000.0023 0 0.5\nendloop\nendfacet\nendsolid\n",
                  "far.stl");
    const lam_mesh *mesh = lam_scene_mesh(scene, 0);
    assert_true(mesh->origin[0] != 0 && mesh->origin[1] == 0 && mesh->origin[2] != 0);
    assert_near(corner_at(mesh, 0, 0).x, 500000.0001, 1e-9);
    assert_near(corner_at(mesh, 0, 1).x, 500000.0012, 1e-9);
    assert_near(corner_at(mesh, 0, 2).x, 500000.0023, 1e-9);
    lam_scene_free(scene);
}

TEST(test_ascii_errors)
{
    refuse_text("Dear reader,\nthis is a letter and no model at all, though its name says so, and it is long "
                "enough for "
                "a header.\n",
                "a.stl",
                "a.stl: not an STL file: found 'Dear' at its start and 112 bytes, expected \"solid\" and facets, "
                "or a binary "
                "header of 84 bytes and facets");
    refuse_text("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 O 0\n", "a.stl",
                "a.stl:5: facet 1: found 'O', expected a number");
    refuse_text("solid a\r\nfacet normal 0 0 1\r\nouter loop\r\nvertex 0 0 1.5mm\r\n", "a.stl",
                "a.stl:4: facet 1: found '1.5mm', expected a number");
    refuse_text("solid a\rfacet normal 0 0 1\router loop\rvertex 0 0 inf\rvertex 0 0 0 vertex 1 1 1 endloop "
                "endfacet\r",
                "a.stl",
                "a.stl: contains nothing to draw: each triangle, line and point uses a vertex that is not finite");
    refuse_text("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\n", "a.stl",
                "a.stl:6: facet 1: found 'endloop', expected \"vertex\"");
    refuse_text("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 0\n",
                "a.stl", "a.stl:7: facet 1: found 'vertex', expected \"endloop\"");
    refuse_text("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n", "a.stl",
                "a.stl:5: facet 1: found the end of the file, expected \"vertex\"");
    refuse_text("solid a\nfacet normal 0 0 1\n  ring\n", "a.stl", "a.stl:3: facet 1: found 'ring', expected \"outer\"");
    refuse_text("solid a\ntriangle\nfacet\n", "a.stl",
                "a.stl:2: facet 1: found 'triangle', expected \"facet\", \"endsolid\" or \"solid\"");
}

TEST(test_binary)
{
    // A header that begins with "solid", and a name that contains "facet", do not make it ASCII.
    struct made file = {0};
    put_header(&file, "solid facet endsolid", 2);
    put_facet(&file, 3, 0);
    put_facet(&file, -7, 0);
    lam_scene *scene = load(&file, "no ending");
    const lam_mesh *mesh = lam_scene_mesh(scene, 0);
    assert_string_equal(lam_scene_format(scene), "stl");
    assert_int_equal(mesh->triangle_count, 2);
    assert_int_equal(mesh->vertex_count, 6);
    assert_null(mesh->indices);
    assert_null(mesh->colors);
    assert_null(lam_scene_warning(scene, 0));
    assert_corner(mesh, 0, 0, 3, 0, 0);
    assert_corner(mesh, 1, 1, -6, 0, 0);
    assert_corner(mesh, 1, 2, -7, 1, 0.5);
    lam_scene_free(scene);

    // Bytes after the last facet cause a warning, and the extension determines the format.
    put_text(&file, "more");
    scene = load(&file, "a.stl");
    assert_int_equal(lam_scene_mesh(scene, 0)->triangle_count, 2);
    assert_string_equal(lam_scene_warning(scene, 0), "a.stl: 4 bytes after the last of 2 facets are ignored");
    lam_scene_free(scene);
}

TEST(test_binary_errors)
{
    struct made file = {0};
    put_header(&file, "solid cut", 3);
    put_facet(&file, 0, 0);
    put_facet(&file, 1, 0);
    refuse(file.bytes, file.size - 1, "a.stl", LAM_CANNOT_READ,
           "a.stl: the file is truncated: its header declares 3 facets (234 bytes), found 1 (183 bytes)");

    struct made empty = {0};
    put_header(&empty, "nothing", 0);
    lam_error error = {0};
    assert_null(lam_scene_load_memory(empty.bytes, empty.size, "a.stl", NULL, NULL, &error));
    assert_int_equal(error.code, LAM_CANNOT_READ);
    assert_non_null(strstr(error.text, "no triangles"));
}

// Facets with a corner that is not finite are left out, for any number of threads, with shared vertices (stl_shared.c) or
// without. The NaN of facet 7 has the bits of an unused entry of stl_shared.c.
TEST(test_not_finite)
{
    for (uint32_t facets = 30000; facets <= 70000; facets += 40000) {
        size_t size = 84 + 50 * (size_t)facets;
        uint8_t *bytes = calloc(1, size);
        assert_non_null(bytes);
        uint32_t infinity = 0x7f800000, left_out = 1;
        memcpy(bytes + 80, &facets, 4);
        for (uint32_t i = 0; i < facets; i++) // each facet has an area
            memcpy(bytes + 84 + 50 * (size_t)i + 24, (float[]){1, 0, 0, 0, 1, (float)(i % 7)}, 24);
        memset(bytes + 84 + 50 * 7 + 24, 0xff, 12);
        for (size_t facet = 9000; facet < facets; facet += 3000, left_out++)
            memcpy(bytes + 84 + 50 * facet + 12, &infinity, 4);
        for (int threads = 1; threads <= 5; threads += 2) {
            char expected[256];
            snprintf(expected, sizeof expected,
                     "a.stl: %u vertices have coordinates that are not finite; %u triangles, lines or points that use "
                     "them are left out",
                     left_out, left_out);
            AUTO_SCENE scene = load_with(bytes, size, "a.stl", &(lam_load_params){.threads = threads});
            assert_int_equal(lam_scene_mesh(scene, 0)->triangle_count, facets - left_out);
            assert_string_equal(lam_scene_warning(scene, 0), expected);
            assert_null(lam_scene_warning(scene, 1));
            assert_corner(lam_scene_mesh(scene, 0), 7, 2, 0, 1, 1); // facet 8
        }
        free(bytes);
    }
}

TEST(test_colors_viscam)
{
    struct made file = {0};
    put_header(&file, "viscam", 3);
    put_facet(&file, 0, 0x8000 | 31 << 10);     // red
    put_facet(&file, 1, 0x8000 | 16 << 5 | 31); // green 16, blue 31
    put_facet(&file, 2, 0);                     // none
    lam_scene *scene = load(&file, "a.stl");
    const lam_mesh *mesh = lam_scene_mesh(scene, 0);
    assert_int_equal(mesh->colors_format, LAM_COLORS_SRGB8);
    assert_color(mesh, 0, 255, 0, 0);
    assert_color(mesh, 1, 0, 132, 255);
    assert_color(mesh, 2, 255, 255, 255);
    lam_scene_free(scene);

    scene = load_with(file.bytes, file.size, "a.stl", &(lam_load_params){.color = LAM_COLOR_RAW});
    assert_int_equal(lam_scene_mesh(scene, 0)->colors_format, LAM_COLORS_LINEAR8);
    lam_scene_free(scene);

    file = (struct made){0}; // some programs set only bit 15, in every facet
    put_header(&file, "viscam", 2);
    put_facet(&file, 0, 0x8000);
    put_facet(&file, 1, 0x8000);
    scene = load(&file, "a.stl");
    assert_null(lam_scene_mesh(scene, 0)->colors);
    lam_scene_free(scene);
}

TEST(test_colors_magics)
{
    struct made file = {0};
    put_header(&file, "made by somebody COLOR=\x10\x20\x30\xff,MATERIAL=", 2);
    put_facet(&file, 0, 31);     // red: its own
    put_facet(&file, 1, 0x8000); // the header's
    lam_scene *scene = load(&file, "a.stl");
    assert_color(lam_scene_mesh(scene, 0), 0, 255, 0, 0);
    assert_color(lam_scene_mesh(scene, 0), 1, 0x10, 0x20, 0x30);
    lam_scene_free(scene);

    // If all words are zero, the header's colour becomes the material's, so that options can replace it.
    memset(file.bytes + 84 + 48, 0, 2);
    memset(file.bytes + 134 + 48, 0, 2);
    scene = load(&file, "a.stl");
    assert_null(lam_scene_mesh(scene, 0)->colors);
    lam_rgba color = lam_scene_default_material(scene)->diffuse;
    assert_true(fabsf(color.r - 0.00518f) < 1e-4f && fabsf(color.g - 0.01444f) < 1e-4f &&
                fabsf(color.b - 0.02956f) < 1e-4f);
    lam_scene_free(scene);
}

// Attribute words that are not colours: counters, and random words, some with bit 15 set.
TEST(test_colors_junk)
{
    static const uint16_t words[][3] = {{0, 0, 0}, {1, 2, 3}, {0x8123, 0x0456, 0x1789}};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        struct made file = {0};
        put_header(&file, "junk", 3);
        for (int f = 0; f < 3; f++)
            put_facet(&file, f, words[i][f]);
        AUTO_SCENE scene = load(&file, "a.stl");
        assert_null(lam_scene_mesh(scene, 0)->colors);
    }
}

TEST(test_threads)
{
    enum { FACETS = 20011 };
    size_t size = 84 + 50 * FACETS;
    uint8_t *bytes = calloc(1, size);
    assert_non_null(bytes);
    uint32_t count = FACETS, random = 1;
    memcpy(bytes + 80, &count, 4);
    for (size_t facet = 0; facet < FACETS; facet++) {
        for (size_t i = 0; i < 12; i++) {
            random = random * 1664525 + 1013904223;
            float number = (float)(int)(random >> 16) * 0.001f;
            memcpy(bytes + 84 + 50 * facet + 4 * i, &number, 4);
        }
        uint16_t word = (uint16_t)(0x8000 | random >> 17);
        memcpy(bytes + 84 + 50 * facet + 48, &word, 2);
    }
    assert_same_for_threads(bytes, size, "a.stl");
    free(bytes);
}

TEST(test_cut_anywhere)
{
    struct made file = {0};
    put_header(&file, "solid binary COLOR=abcd", 2);
    put_facet(&file, 0, 1);
    put_facet(&file, 1, 0x8000);
    check_prefixes(file.bytes, file.size, "a.stl");
    check_prefixes(one_facet, sizeof one_facet - 1, "a.stl");
}

TEST(test_out_of_memory)
{
    struct made file = {0};
    put_header(&file, "COLOR=abcd", 2);
    put_facet(&file, 0, 1);
    put_facet(&file, 1, 0x8000);
    check_allocations(file.bytes, file.size, "a.stl");
    check_allocations(one_facet, sizeof one_facet - 1, "a.stl");
}

TEST(test_models)
{
    static const struct model models[] = {
        {"stl/derived/fish.stl", 21568},
        {"stl/derived/koala.stl", 99994},
        {"stl/derived/wingnut_ascii.stl", 6090},
        {"stl/derived/wingnut_solid_header.stl", 6090},
        {"stl/panda/hand.stl", 200},
        {"stl/panda/link0.stl", 200},
        {"stl/panda/link5.stl", 300},
        {"stl/trimesh/20mm-xyz-cube.stl", 260},
        {"stl/trimesh/featuretype.STL", 3476},
        {"stl/trimesh/multibody.stl", 32},
        {"stl/trimesh/octagonal_pocket.stl", 3262},
        {"stl/trimesh/two_objects_mixed_case_names.stl", 24},
        {"stl/ur3/base.stl", 7992},
        {"stl/ur3/forearm.stl", 4934},
        {"stl/ur3/shoulder.stl", 7865},
        {"stl/ur3/upperarm.stl", 10263},
        {"stl/ur3/wrist1.stl", 3672},
        {"stl/ur3/wrist2.stl", 3671},
    };
    check_models(models, sizeof models / sizeof *models);
}
