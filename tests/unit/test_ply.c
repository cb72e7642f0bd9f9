// test_ply.c: PLY: all formats and layouts, polygons, strips, colours, normals, origins, and errors. The file has more
// than 600 lines because it contains a table-like test for each feature and error message of one format.
#include "test.h"
#include "loading.h"

#define HEADER(FORMAT) "ply\nformat " FORMAT " 1.0\n"
#define XYZ            "property float x\nproperty float y\nproperty float z\n"
#define FACE(N)        "element face " N "\nproperty list uchar int vertex_indices\n"

// A unit square in the plane z = 0 with four vertices, for ASCII bodies.
#define SQUARE "0 0 0\n1 0 0\n1 1 0\n0 1 0\n"

static const char ascii[] =
    HEADER("ascii") "element vertex 4\n" XYZ FACE("2") "end_header\n" SQUARE "3 0 1 2\n3 0 2 3\n";

static const lam_mesh *mesh_of(const lam_scene *scene) { return lam_scene_mesh(scene, 0); }

TEST(test_ascii)
{
    AUTO_SCENE scene = load_text(ascii, "a.ply");
    const lam_mesh *mesh = mesh_of(scene);
    assert_string_equal(lam_scene_format(scene), "ply");
    assert_int_equal(lam_scene_up(scene), LAM_UP_Y);
    assert_int_equal(lam_scene_object_count(scene), 1);
    assert_int_equal(mesh->vertex_count, 4);
    assert_int_equal(mesh->triangle_count, 2);
    assert_corner(mesh, 0, 2, 1, 1, 0);
    assert_corner(mesh, 1, 2, 0, 1, 0);
}

// One mesh in every format: vertices with extra properties before, between and after, an element in between with lists,
// faces of a triangle and a quad with properties around the list, and a second list.
static void make_everything(struct made *file, const char *format)
{
    *file = (struct made){.big = strcmp(format, "binary_big_endian") == 0};
    put_text(file, "ply\r\ncomment first\r\nformat ");
    put_text(file, format);
    put_text(file, " 1.0\r\nobj_info x\r\nelement vertex 5\r\nproperty uchar mark\r\nproperty double x\r\n"
                   "property short y\r\nproperty list uchar ushort extra\r\nproperty float z\r\nproperty uint id\r\n"
                   "element edge 2\r\nproperty list uint char a\r\nproperty int b\r\n"
                   "element face 2\r\nproperty float area\r\nproperty list short ushort vertex_index\r\n"
                   "property list uchar float texcoord\r\nproperty char flag\r\nelement rest 0\r\nproperty int c\r\n"
                   "end_header\r\n");
    static const int corners[2][5] = {{3, 0, 1, 4}, {4, 0, 1, 2, 3}};
    static const double xy[5][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.5, -2}};
    char line[256];
    bool text = strcmp(format, "ascii") == 0;
    for (int v = 0; v < 5; v++) {
        if (text) {
            snprintf(line, sizeof line, "7 %g %g %d%s %g %d\r\n", xy[v][0], xy[v][1], v % 3,
                     v % 3 == 0   ? ""
                     : v % 3 == 1 ? " 11"
                                  : " 11 12",
                     0.25 * v, v);
            put_text(file, line);
            continue;
        }
        put_u8(file, 7);
        put_f64(file, xy[v][0]);
        put_u16(file, (uint16_t)(int16_t)xy[v][1]);
        put_u8(file, (uint8_t)(v % 3));
        for (int i = 0; i < v % 3; i++)
            put_u16(file, (uint16_t)(11 + i));
        put_f32(file, 0.25f * (float)v);
        put_u32(file, (uint32_t)v);
    }
    if (text) {
        put_text(file, "2 -1 -2 9\r\n0\t9\r\n");
    } else {
        put_u32(file, 2);
        put_u8(file, 0xff);
        put_u8(file, 0xfe);
        put_u32(file, 9);
        put_u32(file, 0);
        put_u32(file, 9);
    }
    for (int f = 0; f < 2; f++) {
        if (text) {
            put_text(file, f ? "1e3 4 0 1 2 3 2 0.5 0.25 -1\r\n" : "2.5 3 0 1 4 0 1\r\n");
            continue;
        }
        put_f32(file, 2.5f);
        put_u16(file, (uint16_t)corners[f][0]);
        for (int i = 1; i <= corners[f][0]; i++)
            put_u16(file, (uint16_t)corners[f][i]);
        put_u8(file, (uint8_t)(2 * f));
        for (int i = 0; i < 2 * f; i++)
            put_f32(file, 0.5f);
        put_u8(file, 1);
    }
}

TEST(test_everything)
{
    static const char *const formats[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    for (int i = 0; i < 3; i++) {
        struct made file;
        make_everything(&file, formats[i]);
        lam_scene *scene = load(&file, "a.ply");
        const lam_mesh *mesh = mesh_of(scene);
        assert_int_equal(mesh->vertex_count, 5);
        assert_int_equal(mesh->triangle_count, 3);
        assert_corner(mesh, 0, 0, 0, 0, 0);
        assert_corner(mesh, 0, 1, 1, 0, 0.25);
        assert_corner(mesh, 0, 2, 0.5, -2, 1);
        // The quad's two triangles contain its four corners.
        unsigned seen = 0;
        for (int c = 3; c < 9; c++)
            seen |= 1u << mesh->indices[c];
        assert_int_equal(seen, 15);
        lam_scene_free(scene);
        assert_same_for_threads(file.bytes, file.size, "a.ply");
        check_prefixes(file.bytes, file.size, "a.ply");
        check_allocations(file.bytes, file.size, "a.ply");
    }
}

static void put_square(struct made *file, const char *format, const char *vertex_header, const char *face_header)
{
    file->big = strcmp(format, "binary_big_endian") == 0;
    put_text(file, "ply\nformat ");
    put_text(file, format);
    put_text(file, " 1.0\nelement vertex 4\n");
    put_text(file, vertex_header);
    put_text(file, face_header);
    put_text(file, "end_header\n");
}

static const float square[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
static const uint32_t square_faces[2][3] = {{0, 1, 2}, {0, 2, 3}};

// A vertex that no face uses does not affect the bounds.
TEST(test_unused_vertex)
{
    for (uint32_t last = 2; last < 4; last++) {
        struct made file = {0};
        put_square(&file, "binary_little_endian", "property float x\nproperty float y\nproperty float z\n",
                   "element face 2\nproperty list uchar int vertex_indices\n");
        for (int i = 0; i < 12; i++)
            put_f32(&file, square[i / 3][i % 3] - (i == 11 ? 9 : 0));
        for (uint32_t f = 0; f < 2; f++) {
            const uint32_t corners[3] = {0, 1, f ? last : 2};
            put_u8(&file, 3);
            for (int k = 0; k < 3; k++)
                put_u32(&file, corners[k]);
        }
        lam_vec3 low;
        AUTO_SCENE scene = load(&file, "a.ply");
        assert_true(lam_scene_bounds(scene, &low, NULL) && low.z == (last == 3 ? -9 : 0));
    }
}

// The layout of most files, and the same with other types and properties around the list.
TEST(test_binary_triangles)
{
    static const char *const formats[] = {"binary_little_endian", "binary_big_endian"};
    for (int big = 0; big < 2; big++) {
        for (int layout = 0; layout < 4; layout++) {
            static const char *const headers[] = {FACE("2"),
                                                  "element face 2\nproperty list int ushort vertex_indices\n",
                                                  "element face 2\nproperty ushort a\nproperty list uchar "
                                                  "uint vertex_indices\nproperty uchar b\n",
                                                  FACE("2") "element behind 3\nproperty int a\n"};
            struct made file = {0};
            put_square(&file, formats[big], XYZ, headers[layout]);
            for (int i = 0; i < 12; i++)
                put_f32(&file, square[i / 3][i % 3]);
            for (int f = 0; f < 2; f++) {
                if (layout == 2)
                    put_u16(&file, 77);
                if (layout == 1)
                    put_u32(&file, 3);
                else
                    put_u8(&file, 3);
                for (int c = 0; c < 3; c++) {
                    if (layout == 1)
                        put_u16(&file, (uint16_t)square_faces[f][c]);
                    else
                        put_u32(&file, square_faces[f][c]);
                }
                if (layout == 2)
                    put_u8(&file, 77);
            }
            for (int i = 0; layout == 3 && i < 3; i++)
                put_u32(&file, 5);
            lam_scene *scene = load(&file, "a.ply");
            assert_memory_equal(mesh_of(scene)->indices, square_faces, sizeof square_faces);
            assert_memory_equal(mesh_of(scene)->positions, square, sizeof square);
            lam_scene_free(scene);
            // Bytes after the end are ignored.
            put_text(&file, "and more");
            scene = load(&file, "a.ply");
            assert_memory_equal(mesh_of(scene)->indices, square_faces, sizeof square_faces);
            lam_scene_free(scene);
            check_prefixes(file.bytes, file.size, "a.ply");
        }
    }
}

// Faces of other kinds that take as many bytes as triangles.
TEST(test_mixed_of_triangle_size)
{
    struct made file = {0};
    put_square(&file, "binary_little_endian", XYZ, FACE("2"));
    for (int i = 0; i < 12; i++)
        put_f32(&file, square[i / 3][i % 3]);
    put_u8(&file, 4);
    for (uint32_t i = 0; i < 4; i++)
        put_u32(&file, i);
    put_u8(&file, 2);
    put_u32(&file, 0);
    put_u32(&file, 1);
    lam_scene *scene = load(&file, "a.ply");
    assert_int_equal(mesh_of(scene)->triangle_count, 2);
    assert_string_equal(lam_scene_warning(scene, 0),
                        "a.ply: 1 of 2 faces have fewer than three corners and are ignored");
    lam_scene_free(scene);
    check_allocations(file.bytes, file.size, "a.ply");
}

TEST(test_vertex_attributes)
{
    AUTO_SCENE scene = load_text(HEADER("ascii") "element vertex 3\nproperty float nz\n" XYZ
                                                 "property float nx\nproperty float ny\nproperty float tx\n"
                                                 "property float ty\nproperty float tz\nproperty float u\n"
                                                 "property float v\n" FACE("1") "end_header\n"
                                                                                "1 0 0 0 0.5 0.25 3 0 4 0 1\n"
                                                                                "0 1 0 0 0 1 0 0 0 0.5 inf\n"
                                                                                "2 0 1 0 0 0 0 -7 0 0.5 0.75\n"
                                                                                "3 0 1 2\n",
                                 "a.ply");
    const lam_mesh *mesh = mesh_of(scene);
    static const float normals[] = {0.5f, 0.25f, 1, 0, 1, 0, 0, 0, 2};
    static const float tangents[] = {0.6f, 0, 0.8f, 1, 0, 0, 0, 1, 0, -1, 0, 1};
    static const float texcoords[] = {0, 1, 0, 0, 0.5f, 0.75f};
    assert_int_equal(mesh->normal_count, 3);
    assert_null(mesh->normal_indices);
    assert_memory_equal(mesh->normals, normals, sizeof normals);
    assert_int_equal(mesh->tangent_count, 3);
    for (int i = 0; i < 12; i++)
        assert_near((double)mesh->tangents[i], (double)tangents[i], 1e-7);
    assert_int_equal(mesh->texcoord_count, 3);
    assert_memory_equal(mesh->texcoords, texcoords, sizeof texcoords);
}

TEST(test_colors_bytes)
{
    static const char text[] =
        HEADER("ascii") "element vertex 3\n" XYZ "property uchar red\nproperty uchar green\nproperty uchar blue\n" FACE(
            "1") "end_header\n0 0 0 255 0 7\n1 0 0 1 2 3\n0 1 0 9 8 7\n3 0 1 2\n";
    static const uint8_t colors[] = {255, 0, 7, 255, 1, 2, 3, 255, 9, 8, 7, 255};
    lam_scene *scene = load_text(text, "a.ply");
    assert_int_equal(mesh_of(scene)->colors_format, LAM_COLORS_SRGB8);
    assert_int_equal(mesh_of(scene)->colors_rate, LAM_PER_VERTEX);
    assert_int_equal(mesh_of(scene)->color_count, 3);
    assert_memory_equal(mesh_of(scene)->colors, colors, sizeof colors);
    lam_scene_free(scene);
    scene = load_with(text, sizeof text - 1, "a.ply", &(lam_load_params){.color = LAM_COLOR_RAW});
    assert_int_equal(mesh_of(scene)->colors_format, LAM_COLORS_LINEAR8);
    assert_memory_equal(mesh_of(scene)->colors, colors, sizeof colors);
    lam_scene_free(scene);
}

// Numbers of every type are colours from 0 to 1 after their range is recognised, and then linear, by the sRGB curve unless
// raw. `rgb` is the colour of the first vertex, the brightest.
TEST(test_colors_ranges)
{
    static const struct {
        const char *type, *alpha, *first, *rest, *warning;
        double rgb[3], opacity;
    } rows[] = {
        {"float", "float", "1 0.5 0 0.25", "0 0 0 1", NULL, {1, 0.5, 0}, 0.25},
        {"double", "float", "0.5 0.25 nan 0.5", "0 -1 0 1", "are limited (3)", {0.5, 0.25, 0}, 0.5},
        {"float", "float", "1 0.5 0 1e30", "0 0 inf 1", "are limited (3)", {1, 0.5, 0}, 1},
        {"float",
         "float",
         "255 51 0 51",
         "0 0 0 255",
         "reach 255, so their range is taken as 0 to 255, not 0 to 1",
         {1, 0.2, 0},
         0.2},
        {"float",
         "uchar",
         "255 51 0 51",
         "0 0 0 255",
         "reach 255, so their range is taken as 0 to 255, not 0 to 1",
         {1, 0.2, 0},
         0.2},
        {"uchar", "float", "255 51 0 0.5", "0 0 0 1", NULL, {1, 0.2, 0}, 0.5},
        {"ushort", "ushort", "65535 13107 0 13107", "0 0 0 65535", NULL, {1, 0.2, 0}, 0.2},
        {"ushort",
         "uchar",
         "255 51 0 255",
         "0 0 0 255",
         "reach 255, so their range is taken as 0 to 255, not 0 to 65535",
         {1, 0.2, 0},
         1},
        {"short",
         "uchar",
         "255 51 0 255",
         "0 0 0 255",
         "reach 255, so their range is taken as 0 to 255, not 0 to 32767",
         {1, 0.2, 0},
         1},
        {"int", "int", "255 51 -1 51", "0 0 0 255", "are limited (1)", {1, 0.2, 0}, 0.2},
        {"uint",
         "uchar",
         "65535 13107 0 255",
         "0 0 0 255",
         "reach 65535, so their range is taken as 0 to 65535, not 0 to 255",
         {1, 0.2, 0},
         1},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        for (int raw = 0; raw < 2; raw++) {
            char text[1024];
            snprintf(text, sizeof text,
                     HEADER("ascii") "element vertex 3\n" XYZ
                                     "property %s red\nproperty %s green\nproperty %s blue\nproperty %s alpha\n" FACE(
                                         "1") "end_header\n0 0 0 %s\n1 0 0 %s\n0 1 0 %s\n3 0 1 2\n",
                     rows[i].type, rows[i].type, rows[i].type, rows[i].alpha, rows[i].first, rows[i].rest,
                     rows[i].rest);
            AUTO_SCENE scene = load_with(text, strlen(text), "a.ply",
                                         &(lam_load_params){.color = raw ? LAM_COLOR_RAW : LAM_COLOR_SRGB});
            const char *warning = lam_scene_warning(scene, 0);
            const float *colors = mesh_of(scene)->colors;
            assert_int_equal(mesh_of(scene)->colors_format, LAM_COLORS_LINEAR_F32);
            assert_true(rows[i].warning ? warning && strstr(warning, rows[i].warning) : !warning);
            for (int c = 0; c < 3; c++) {
                double s = rows[i].rgb[c], linear = s <= 0.04045 ? s / 12.92 : pow((s + 0.055) / 1.055, 2.4);
                assert_near((double)colors[c], raw ? s : linear, 1e-6);
            }
            assert_near((double)colors[3], rows[i].opacity, 1e-6);
        }
}

// Packed colours of the Point Cloud Library and base colours of Gaussian splats, and the warning about the rest.
TEST(test_colors_special)
{
    static const struct {
        const char *properties, *numbers, *warning;
        uint8_t bytes[4]; // sRGB
    } rows[] = {
        {"property uint rgb\n", "16744448", NULL, {255, 128, 0, 255}},
        {"property int rgba\n", "-2130739200", NULL, {255, 128, 0, 128}},
        {"property float rgb\n", "2.34180529e-38", NULL, {255, 0, 1, 255}},
        {"property uchar blue\nproperty float red\nproperty ushort green\n", "0 1 32896", NULL, {255, 128, 0, 255}},
        {"property double rgb\n", "2.34180529e-38", NULL, {255, 0, 1, 255}},
        {"property uchar diffuse_red\nproperty uchar diffuse_green\nproperty uchar diffuse_blue\n",
         "255 128 0",
         NULL,
         {255, 128, 0, 255}},
        {"property float f_dc_0\nproperty float f_dc_1\nproperty float f_dc_2\nproperty float opacity\n",
         "1.77245385 0 -9 1",
         "a.ply: contains data that is not drawn: opacity",
         {255, 128, 0, 255}},
        {"property float confidence\nproperty list uchar int names\nproperty uchar red\n",
         "1 0 7",
         "a.ply: contains data that is not drawn: confidence, names, red, element camera",
         {0, 0, 0, 0}},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char text[1024];
        snprintf(text, sizeof text, HEADER("ascii") "element vertex 1\n" XYZ "%s%send_header\n0 0 0 %s\n%s",
                 rows[i].properties, rows[i].bytes[3] ? "" : "element camera 1\nproperty int a\nproperty int b\n",
                 rows[i].numbers, rows[i].bytes[3] ? "" : "1 2\n");
        AUTO_SCENE scene = load_text(text, "a.ply");
        const lam_mesh *mesh = mesh_of(scene);
        if (rows[i].warning)
            assert_string_equal(lam_scene_warning(scene, 0), rows[i].warning);
        else
            assert_null(lam_scene_warning(scene, 0));
        if (mesh->colors_format == LAM_COLORS_LINEAR_F32)
            for (int c = 0; c < 3; c++) {
                double s = rows[i].bytes[c] / 255.0, linear = s <= 0.04045 ? s / 12.92 : pow((s + 0.055) / 1.055, 2.4);
                assert_near((double)((const float *)mesh->colors)[c], linear, 0.005);
            }
        else if (rows[i].bytes[3])
            assert_memory_equal(mesh->colors, rows[i].bytes, 4);
        else
            assert_null(mesh->colors);
    }
}

// Texture coordinates of vertices and of the corners of faces, and the numbers of the faces' textures.
TEST(test_textures)
{
    static const char text[] =
        HEADER("ascii") "comment TextureFile one.ppm\ncomment TextureFile two words.ppm\nelement vertex 4\n" XYZ
                        "element face 4\nproperty list uchar int vertex_indices\nproperty list uchar float texcoord\n"
                        "property int texnumber\nend_header\n" SQUARE
                        "4 0 1 2 3 8 0 0 1 0 1 1 0 1 1\n3 0 1 2 6 0.5 0 0.25 0 nan 1 1\n3 0 2 1 0 0\n3 0 2 3 2 7 8 5\n";
    static const float corners[][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}, {0.5f, 0}, {0.25f, 0},
                                       {0, 0}, {0, 0}, {0, 0}, {0, 0}, {7, 8}, {0, 0}, {0, 0}};
    static const lam_part parts[] = {{.triangle_count = 3, .material = 1},
                                     {.first_triangle = 3, .triangle_count = 1, .material = 0},
                                     {.first_triangle = 4, .triangle_count = 1, .material = -1}};
    AUTO_SCENE scene = load_text(text, "a.ply");
    const lam_mesh *mesh = mesh_of(scene);
    assert_int_equal(mesh->triangle_count, 5);
    for (size_t i = 0; i < 15; i++)
        assert_memory_equal(mesh->texcoords + 2 * (size_t)mesh->texcoord_indices[i], corners[i], sizeof *corners);
    assert_int_equal(mesh->part_count, 3);
    for (int i = 0; i < 3; i++) {
        assert_int_equal(mesh->parts[i].first_triangle, parts[i].first_triangle);
        assert_int_equal(mesh->parts[i].triangle_count, parts[i].triangle_count);
        assert_int_equal(mesh->parts[i].material, parts[i].material);
    }
    assert_int_equal(lam_scene_material_count(scene), 2);
    assert_string_equal(lam_scene_material(scene, 1)->map_names[LAM_MAP_DIFFUSE], "two words.ppm");
    assert_non_null(strstr(lam_scene_warning(scene, 0), "one.ppm"));
}

// Colours and normals of faces, repeated for the triangles of a polygon.
TEST(test_face_attributes)
{
    static const char text[] =
        HEADER("ascii") "element vertex 4\n" XYZ "element face 2\nproperty list uchar int vertex_indices\n"
                        "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                        "property uchar alpha\nproperty float nx\nproperty float ny\n"
                        "property float nz\nend_header\n" SQUARE
                        "4 0 1 2 3 10 20 30 40 0 0 1\n3 0 2 1 50 60 70 80 0 0 -1\n";
    static const uint8_t colors[] = {10, 20, 30, 40, 10, 20, 30, 40, 50, 60, 70, 80};
    static const float normals[] = {0, 0, 1, 0, 0, -1};
    static const uint32_t normal_indices[] = {0, 0, 0, 0, 0, 0, 1, 1, 1};
    lam_scene *scene = load_text(text, "a.ply");
    const lam_mesh *mesh = mesh_of(scene);
    assert_int_equal(mesh->triangle_count, 3);
    assert_int_equal(mesh->colors_rate, LAM_PER_TRIANGLE);
    assert_int_equal(mesh->color_count, 3);
    assert_memory_equal(mesh->colors, colors, sizeof colors);
    assert_int_equal(mesh->normal_count, 2);
    assert_memory_equal(mesh->normals, normals, sizeof normals);
    assert_memory_equal(mesh->normal_indices, normal_indices, sizeof normal_indices);
    lam_scene_free(scene);
    check_allocations(text, sizeof text - 1, "a.ply");
}

TEST(test_concave_polygon)
{
    // An L of six corners: a fan from its first corner would cover the notch.
    AUTO_SCENE scene = load_text(
        HEADER("ascii") "element vertex 6\n" XYZ FACE("1") "end_header\n"
                                                           "2 0 0\n2 1 0\n1 1 0\n1 2 0\n0 2 0\n0 0 0\n6 0 1 2 3 4 5\n",
        "a.ply");
    const lam_mesh *mesh = mesh_of(scene);
    assert_int_equal(mesh->triangle_count, 4);
    double area = 0;
    for (uint32_t t = 0; t < 4; t++) {
        lam_vec3 a = corner_at(mesh, t, 0), b = corner_at(mesh, t, 1), c = corner_at(mesh, t, 2);
        double twice = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        assert_true(twice >= 0);
        area += twice / 2;
    }
    assert_near(area, 3, 1e-12);
}

TEST(test_strips)
{
    static const char text[] = HEADER("ascii") "element vertex 6\n" XYZ
                                               "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
                                               "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n1 2 0\n"
                                               "10 0 1 2 3 -1 2 3 4 4 5\n";
    // Every second triangle has reversed winding; triangles with equal corners are skipped.
    static const uint32_t indices[] = {0, 1, 2, 2, 1, 3, 2, 3, 4};
    lam_scene *scene = load_text(text, "a.ply");
    assert_int_equal(mesh_of(scene)->triangle_count, 3);
    assert_memory_equal(mesh_of(scene)->indices, indices, sizeof indices);
    lam_scene_free(scene);
    check_prefixes(text, sizeof text - 1, "a.ply");
    check_allocations(text, sizeof text - 1, "a.ply");
}

// A part with details of a millimetre, 500 km from zero: doubles in binary, and decimals in ASCII although its type is
// float.
TEST(test_far_from_zero)
{
    static const double points[3][3] = {
        {500000.0001, 7e6, 0}, {500000.0012, 7000000.001, 0}, {500000.0023, 7e6, 0.001}};
    struct made file = {0};
    put_text(&file, HEADER("binary_little_endian") "element vertex 3\nproperty double x\nproperty double y\n"
                                                   "property double z\n" FACE("1") "end_header\n");
    for (int i = 0; i < 9; i++)
        put_f64(&file, points[i / 3][i % 3]);
    put_u8(&file, 3);
    for (uint32_t i = 0; i < 3; i++)
        put_u32(&file, i);
    lam_scene *binary = load(&file, "a.ply");
    lam_scene *text =
        load_text(HEADER("ascii") "element vertex 3\n" XYZ FACE(
                      "1") "end_header\n"
                           "500000.0001 7e6 0\n500000.0012 7000000.001 0\n500000.0023 7e6 0.001\n3 0 1 2\n",
                  "a.ply");
    for (uint32_t c = 0; c < 3; c++) {
        lam_vec3 p = corner_at(mesh_of(binary), 0, c);
        assert_near(p.x, points[c][0], 2e-9);
        assert_near(p.y, points[c][1], 2e-9);
        assert_near(p.z, points[c][2], 1e-9);
    }
    assert_same_mesh(mesh_of(binary), mesh_of(text));
    lam_scene_free(binary);
    lam_scene_free(text);

    // A model near zero has no origin: its floats are the file's numbers, rounded once. The second number is just above
    // the midpoint of two floats, where rounding through a double gives the wrong float.
    lam_scene *near =
        load_text(HEADER("ascii") "element vertex 3\nproperty double x\nproperty double y\nproperty double z\n" FACE(
                      "1") "end_header\n0.1 1.00000005960464477540 0\n1 0 0\n0 0 1\n3 0 1 2\n",
                  "a.ply");
    assert_true(mesh_of(near)->origin[0] == 0 && mesh_of(near)->origin[1] == 0);
    assert_true(mesh_of(near)->positions[0] == 0.1f && mesh_of(near)->positions[1] == 0x1.000002p0f);
    lam_scene_free(near);
}

TEST(test_header_errors)
{
    refuse_text("plyformat ascii 1.0\n", "a.ply", "a.ply:1: found 'plyformat', expected \"ply\"");
    refuse_text("ply\nformat text 1.0\n", "a.ply",
                "a.ply:2: found 'text', expected ascii, binary_little_endian or binary_big_endian");
    refuse_text("ply\nformat ascii 2.0\n", "a.ply", "a.ply:2: found '2.0', expected version 1.0");
    refuse_text("ply\nformat ascii 1.0\nelement vertex many\n", "a.ply",
                "a.ply:3: found 'many', expected the number of rows");
    refuse_text("ply\nformat ascii 1.0\nelement vertex -1\n", "a.ply",
                "a.ply:3: found '-1', expected the number of rows");
    refuse_text("ply\nformat ascii 1.0\nelement vertex 1\nproperty real x\n", "a.ply",
                "a.ply:4: found 'real', expected a type (char, uchar, short, ushort, int, uint, float or double)");
    refuse_text("ply\nformat ascii 1.0\nelement vertex 1\nproperty float\n", "a.ply",
                "a.ply:4: found the end of the line, expected a name");
    refuse_text("ply\nformat ascii 1.0\nelement face 1\nproperty list float int vertex_indices\n", "a.ply",
                "a.ply:4: found 'float', expected an integer type for a list's count");
    refuse_text("ply\nproperty float x\n", "a.ply",
                "a.ply:2: found 'property', expected an element before its properties");
    refuse_text("ply\nelement vertex 1\n" XYZ "end_header\n", "a.ply",
                "a.ply:6: found 'end_header', expected a format line before end_header");
    refuse_text("ply\nformat ascii 1.0\nvertex 3\n", "a.ply",
                "a.ply:3: the file ends in its header, expected \"end_header\"");
    // A zero byte anywhere in the header; in the body of a binary file, it is a number.
    static const char zero[] = HEADER("ascii") "comment a\0b\nelement vertex 3\n" XYZ FACE("1") "end_header\n0 0 0\n";
    refuse(zero, sizeof zero - 1, "a.ply", LAM_CANNOT_READ, "a.ply:3: found a zero byte in the header, expected text");
    static const char first[] = "ply \0\nformat ascii 1.0\n";
    refuse(first, sizeof first - 1, "a.ply", LAM_CANNOT_READ,
           "a.ply:1: found a zero byte in the header, expected text");
    refuse_text("ply\nformat ascii 1.0\n", "a.ply", "a.ply:2: the file ends in its header, expected \"end_header\"");
    refuse_text(
        HEADER("ascii") "element vertex 1\nproperty float x\nproperty float z\n" FACE("1") "end_header\n0 0\n3 0 0 0\n",
        "a.ply", "a.ply:3: element vertex has no property y, expected x, y and z");
    refuse_text(HEADER("ascii") "element vertex 1\n" XYZ
                                "element face 1\nproperty int vertex_indices\nend_header\n0 0 0\n1\n",
                "a.ply",
                "a.ply:7: element face has no list of corners, expected a property such as "
                "\"list uchar int vertex_indices\"");
    refuse_text(HEADER("ascii") "element vertex 1\n" XYZ "element face 1\nproperty list uchar float vertex_indices\n"
                                "end_header\n0 0 0\n3 0 0 0\n",
                "a.ply",
                "a.ply:7: element face has a list of corners with a floating-point type, expected an integer type");
    refuse_text(HEADER("ascii") "element vertex 1\n" XYZ "element vertex 1\n" XYZ FACE("1") "end_header\n0 0 0\n",
                "a.ply", "a.ply:7: element vertex appears twice, expected one");
}

// Blender once wrote its comment without "comment".
TEST(test_unknown_header_lines)
{
    static const char *const formats[] = {"ascii", "binary_little_endian"};
    for (int i = 0; i < 2; i++) {
        char text[512];
        int length =
            snprintf(text, sizeof text,
                     "ply\nformat %s 1.0\nCreated by Blender 2.42 - www.blender.org, source file: 'x'\nelement "
                     "vertex 3\n" XYZ "unknown\n" FACE("1") "end_header\n",
                     formats[i]);
        static const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
        static const unsigned char face[13] = {3, 0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0};
        if (i == 0)
            length += sprintf(text + length, "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
        else
            length += (int)(memcpy(text + length, corners, 36), memcpy(text + length + 36, face, 13), 49);
        AUTO_SCENE scene = load_with(text, (size_t)length, "a.ply", NULL);
        assert_int_equal(lam_scene_triangle_count(scene), 1);
        assert_string_equal(lam_scene_warning(scene, 0),
                            "a.ply:3: found 'Created', expected format, comment, element, property or end_header; the "
                            "line is ignored, and others");
        assert_null(lam_scene_warning(scene, 1));
    }
}

// A row usually ends with its line, but may continue on the next one.
TEST(test_numbers_left_over)
{
#define THREE HEADER("ascii") "element vertex 3\n" XYZ
    refuse_text(THREE FACE("1") "end_header\n0 0 0\n1 0 0 7 8\n0 1 0\n3 0 1 2\n", "a.ply",
                "a.ply:11: vertex 2 of 3: found '7' after z, its last property, expected the end of the line");
    refuse_text(
        THREE FACE("2") "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 255 0 0\n3 0 1 2 255 0 0\n", "a.ply",
        "a.ply:13: face 1 of 2: found '255' after vertex_indices, its last property, expected the end of the line");
    refuse_text(THREE "element user 2\nproperty int a\n" FACE("1") "end_header\n0 0 0\n1 0 0\n0 1 0\n1\n2 x\n3 0 1 2\n",
                "a.ply", "a.ply:16: user 2 of 2: found 'x' after a, its last property, expected the end of the line");
    // The first error of the file is reported.
    refuse_text(THREE FACE("1") "end_header\n0 zero 0\n1 0 0 7\n0 1 0\n3 0 1 2\n", "a.ply",
                "a.ply:10: vertex 1 of 3: found 'zero' as y, expected a number");
    refuse_text(THREE FACE("2") "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 9\n-3 0 1 2\n", "a.ply",
                "a.ply:13: face 1 of 2: found '9' as vertex_indices, expected an index from 0 to 2");
    // Rows over several lines, trailing white space, blank lines, and "\r\n".
    lam_scene *scene = load_text(THREE FACE("1") "end_header\n0 0\n0 \t\r\n\n1\n0\n0\n0 1 0\n3 0\n1 2", "a.ply");
    assert_corner(lam_scene_mesh(scene, 0), 0, 1, 1, 0, 0);
    assert_null(lam_scene_warning(scene, 0));
    lam_scene_free(scene);
    // Lines after the last row.
    scene = load_text(THREE FACE("1") "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n\n3 0 1 2\n", "a.ply");
    assert_string_equal(lam_scene_warning(scene, 0), "a.ply:15: found '3' after the last row, expected the end of the "
                                                     "file; the rest is ignored");
    lam_scene_free(scene);
}

// If all colours are transparent, they become opaque, because the picture would otherwise be empty.
TEST(test_clear_colors)
{
    static const struct {
        const char *text;
        int clear; // for three alpha values
    } rows[] = {
#define RGBA(type) "property " type " red\nproperty " type " green\nproperty " type " blue\nproperty " type " alpha\n"
        {THREE RGBA("uchar") FACE("1") "end_header\n0 0 0 9 9 9 0\n1 0 0 9 9 9 0\n0 1 0 9 9 9 0\n3 0 1 2\n", 3},
        {THREE RGBA("float") FACE("1") "end_header\n0 0 0 1 1 1 0\n1 0 0 1 1 1 0\n0 1 0 1 1 1 0\n3 0 1 2\n", 3},
        {THREE RGBA("uchar") FACE("1") "end_header\n0 0 0 9 9 9 0\n1 0 0 9 9 9 1\n0 1 0 9 9 9 0\n3 0 1 2\n", 2},
        {THREE FACE("1") RGBA("uchar") "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 9 9 9 0\n", 3},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        AUTO_SCENE scene = load_text(rows[i].text, "a.ply");
        const lam_mesh *mesh = lam_scene_mesh(scene, 0);
        bool floats = mesh->colors_format == LAM_COLORS_LINEAR_F32;
        for (uint32_t c = 0; c < mesh->color_count; c++) {
            float alpha = floats ? ((const float *)mesh->colors)[4 * c + 3]
                                 : (float)((const uint8_t *)mesh->colors)[4 * c + 3] / 255;
            assert_true(alpha == (rows[i].clear == 3 ? 1.0f : c == 1 ? 1.0f / 255 : 0.0f));
        }
        if (rows[i].clear == 3)
            assert_string_equal(
                lam_scene_warning(scene, 0),
                "a.ply: every material or colour is fully transparent (alpha 0); the picture would be empty, "
                "so everything is drawn opaque");
        assert_null(lam_scene_warning(scene, rows[i].clear == 3));
    }
}

TEST(test_body_errors)
{
    refuse_text(HEADER("ascii") "element vertex 4\n" FACE("1") "end_header\n3 0 1 2\n", "a.ply",
                "a.ply:3: element vertex has no property x, expected x, y and z");
#define VERTICES HEADER("ascii") "element vertex 4\n" XYZ
    refuse_text(VERTICES FACE("1") "end_header\n" SQUARE "3 0 1 4\n", "a.ply",
                "a.ply:14: face 1 of 1: found '4' as vertex_indices, expected an index from 0 to 3");
    refuse_text(VERTICES FACE("1") "end_header\n" SQUARE "3 0 -1 2\n", "a.ply",
                "a.ply:14: face 1 of 1: found '-1' as vertex_indices, expected an index from 0 to 3");
    refuse_text(VERTICES FACE("2") "end_header\n" SQUARE "3 0 1 2\n-3 0 1 2\n", "a.ply",
                "a.ply:15: face 2 of 2: found '-3' as vertex_indices, expected the number of items");
    refuse_text(VERTICES FACE("1") "end_header\n0 0 0\n1 zero 0\n1 1 0\n0 1 0\n3 0 1 2\n", "a.ply",
                "a.ply:11: vertex 2 of 4: found 'zero' as y, expected a number");
    refuse_text(VERTICES FACE("1") "end_header\n0 0 0\n1 nan 0\n1 1 0\n0 1 0\n3 0 1 2\n", "a.ply",
                "a.ply: contains nothing to draw: each triangle, line and point uses a vertex that is not finite");
    refuse_text(VERTICES "property uchar red\n" FACE("1") "end_header\n0 0 0 256\n1 0 0 0\n1 1 0 0\n0 1 0 0\n3 0 1 2\n",
                "a.ply", "a.ply:11: vertex 1 of 4: found '256' as red, expected a whole number from 0 to 255");
    refuse_text(VERTICES FACE("2") "end_header\n" SQUARE "3 0 1 2\n", "a.ply",
                "a.ply: the file is truncated: its header declares 2 rows of element \"face\", found 1 in 186 bytes");
    refuse_text(VERTICES FACE("1") "end_header\n" SQUARE "9 0 1 2\n", "a.ply",
                "a.ply: the file is truncated: its header declares 1 rows of element \"face\", found 0 in 186 bytes");
    refuse_text(HEADER("ascii") "element vertex 99999999999\n" XYZ FACE("1") "end_header\n" SQUARE, "a.ply",
                "a.ply: the file is truncated: its header declares 99999999999 rows of element \"vertex\", "
                "found at most 4 in 188 bytes");
    refuse_text(
        VERTICES FACE("3") "end_header\n" SQUARE, "a.ply",
        "a.ply: the file is truncated: its header declares 3 rows of element \"face\", found at most 1 in 178 bytes");
    refuse_text(HEADER("ascii") "element edge 1\nproperty int vertex1\nproperty int vertex2\nend_header\n0 1\n",
                "a.ply", "a.ply: the file contains edges and no vertices, expected element vertex");
    refuse_text(VERTICES "element edge 2\nproperty int vertex1\nproperty int vertex2\nend_header\n" SQUARE "0 1\n1 4\n",
                "a.ply", "a.ply: edge 2 of 2: found 4 as vertex2, expected a vertex from 0 to 3");
    refuse_text(HEADER("ascii") FACE("1") "end_header\n3 0 0 0\n", "a.ply",
                "a.ply: the file contains faces and no vertices, expected element vertex");
}

TEST(test_binary_errors)
{
    struct made file = {0};
    put_square(&file, "binary_little_endian", XYZ, FACE("2"));
    size_t body = file.size;
    for (int i = 0; i < 12; i++)
        put_f32(&file, square[i / 3][i % 3]);
    for (int f = 0; f < 2; f++) {
        put_u8(&file, 3);
        for (int c = 0; c < 3; c++)
            put_u32(&file, square_faces[f][c]);
    }
    char sentence[256];
    snprintf(sentence, sizeof sentence,
             "a.ply: the file is truncated: its header declares 2 rows of element \"face\", found 1 in %zu bytes",
             file.size - 1);
    refuse(file.bytes, file.size - 1, "a.ply", LAM_CANNOT_READ, sentence);

    // The offset is the same for the usual layout and for indexed rows.
    for (int walked = 0; walked < 2; walked++) {
        struct made bad = file;
        size_t second = body + 48 + 13;
        bad.bytes[second + 5] = 4;
        if (walked)
            put_u8(&bad, 0);
        snprintf(sentence, sizeof sentence,
                 "a.ply: byte %zu: face 2 of 2: found index 4 in vertex_indices, expected 0 to 3", second + 5);
        refuse(bad.bytes, bad.size, "a.ply", LAM_CANNOT_READ, sentence);
        memset(bad.bytes + second + 5, 0xff, 4);
        snprintf(sentence, sizeof sentence,
                 "a.ply: byte %zu: face 2 of 2: found index -1 in vertex_indices, expected 0 to 3", second + 5);
        refuse(bad.bytes, bad.size, "a.ply", LAM_CANNOT_READ, sentence);
    }
    uint32_t infinity = 0x7f800000;
    memcpy(file.bytes + body + 16, &infinity, 4);
    lam_scene *scene = load_with(file.bytes, file.size, "a.ply", NULL);
    assert_int_equal(mesh_of(scene)->triangle_count, 1);
    assert_string_equal(lam_scene_warning(scene, 0),
                        "a.ply: 1 vertices have coordinates that are not finite; 1 triangles, "
                        "lines or points that use them are left out");
    lam_scene_free(scene);

    struct made negative = {0};
    put_square(&negative, "binary_little_endian", XYZ, "element face 1\nproperty list char int vertex_indices\n");
    for (int i = 0; i < 12; i++)
        put_f32(&negative, square[i / 3][i % 3]);
    snprintf(sentence, sizeof sentence,
             "a.ply: byte %zu: face 1 of 1: found -2 as the number of items of vertex_indices, "
             "expected 0 or more",
             negative.size);
    put_u8(&negative, 0xfe);
    refuse(negative.bytes, negative.size, "a.ply", LAM_CANNOT_READ, sentence);
}

// Many pieces of every kind give the same result with every number of threads.
TEST(test_threads)
{
    enum { VERTICES_ACROSS = 130, FACES_ACROSS = VERTICES_ACROSS - 1 };
    size_t room = 4 << 20;
    char *text = malloc(room), *at = text;
    assert_non_null(text);
    at += sprintf(at,
                  HEADER("ascii") "element vertex %d\n" XYZ "property uchar red\nproperty uchar green\n"
                                  "property uchar blue\nproperty float nx\nproperty float ny\nproperty float nz\n"
                                  "element face %d\nproperty list uchar int vertex_indices\nend_header\n",
                  VERTICES_ACROSS * VERTICES_ACROSS, FACES_ACROSS * FACES_ACROSS);
    for (int i = 0; i < VERTICES_ACROSS * VERTICES_ACROSS; i++)
        at += sprintf(at, "%d.5 %d 0.%d %d 0 9 0 %d 1\n", i % VERTICES_ACROSS, i / VERTICES_ACROSS, i * 37 % 100,
                      i % 256, i % 3);
    for (int i = 0; i < FACES_ACROSS * FACES_ACROSS; i++) {
        int corner = i / FACES_ACROSS * VERTICES_ACROSS + i % FACES_ACROSS;
        at += i % 5 ? sprintf(at, "4 %d %d %d %d\n", corner, corner + 1, corner + VERTICES_ACROSS + 1,
                              corner + VERTICES_ACROSS)
                    : sprintf(at, "3 %d %d %d\n", corner, corner + 1, corner + VERTICES_ACROSS);
    }
    assert_true((size_t)(at - text) < room);
    assert_same_for_threads(text, (size_t)(at - text), "a.ply");
    free(text);
}

TEST(test_models)
{
    static const struct model models[] = {
        {"ply/derived/gallery.ply", 1189155},
        {"ply/derived/koala_normals.ply", 99994},
        {"ply/derived/spot_colour_ascii.ply", 5856},
        {"ply/derived/spot_colour_be_double.ply", 5856},
        {"ply/derived/spot_colour_le.ply", 5856},
        {"ply/draco/test_pos_color.ply", 224},
        {"ply/draco/test_pos_color_ascii.ply", 224},
        {"ply/magnum/ascii.ply", 1},
        {"ply/magnum/crlf.ply", 3},
        {"ply/magnum/custom-components.ply", 3},
        {"ply/magnum/empty.ply", 0},
        {"ply/magnum/per-face-colors-be.ply", 3},
        {"ply/magnum/per-face-normals-objectid.ply", 3},
        {"ply/magnum/positions-char-colors4-ushort-texcoords-uchar-indices-short-be.ply", 3},
        {"ply/magnum/positions-colors4-float-indices-int.ply", 3},
        {"ply/magnum/positions-colors4-normals-texcoords-float-indices-int-be-unaligned.ply", 3},
        {"ply/magnum/positions-float-indices-uint.ply", 3},
        {"ply/magnum/whitespace.ply", 3},
        {"ply/trimesh/featuretype.ply", 3476},
        {"ply/trimesh/fixed_top.ply", 4772},
    };
    check_models(models, sizeof models / sizeof *models);
}
