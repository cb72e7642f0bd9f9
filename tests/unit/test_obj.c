// test_obj.c: OBJ and MTL: every form of statement, every error and warning, and results that do not depend on the
// number of threads and the size of chunks.
// The file has more than 600 lines because it contains a table-like test for each feature and error message of one
// format.
#include "test.h"
#include "obj.h"

#include <lambent/image.h>

// --- help

struct library {
    const char *name, *text;
};

static bool open_library(void *user, const char *name, struct lam_bytes *bytes, lam_error *error)
{
    for (const struct library *library = user; library && library->name; library++) {
        if (strcmp(library->name, name) != 0)
            continue;
        bytes->size = strlen(library->text);
        bytes->data = malloc(bytes->size + 1);
        memcpy(bytes->data, library->text, bytes->size);
        return true;
    }
    error->code = LAM_CANNOT_READ;
    snprintf(error->text, sizeof error->text, "%s: no such file", name);
    return false;
}

static lam_scene *load_with(const char *text, lam_load_params params, const struct library *libraries, lam_error *error)
{
    params.open = open_library;
    params.user = (void *)(uintptr_t)libraries;
    if (params.threads == 0)
        params.threads = 1;
    return lam_scene_load_memory(text, strlen(text), "t.obj", &params, NULL, error);
}

// Bytes that are not from malloc, and the number of open files.
static bool open_constant(void *user, const char *name, struct lam_bytes *bytes, lam_error *error)
{
    (void)name, (void)error;
    static char library[] = "newmtl a\nKd 1 0 0\n";
    *bytes = (lam_bytes){library, sizeof library - 1};
    ++*(int *)user;
    return true;
}

static void release_constant(void *user, struct lam_bytes *bytes)
{
    assert_string_equal((char *)bytes->data, "newmtl a\nKd 1 0 0\n");
    *(int *)user += 99;
}

TEST(releases_what_the_caller_opened)
{
    static const char text[] = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n";
    int calls = 0;
    lam_load_params params = {.threads = 1, .open = open_constant, .release = release_constant, .user = &calls};
    AUTO_SCENE scene = lam_scene_load_memory(text, sizeof text - 1, "t.obj", &params, NULL, NULL);
    assert_non_null(scene);
    assert_int_equal(calls, 100); // opened once, released once
    assert_true(lam_scene_material(scene, 0)->diffuse.r == 1);
}

static lam_scene *load(const char *text)
{
    lam_error error;
    lam_scene *scene = load_with(text, (lam_load_params){0}, NULL, &error);
    SUCCEEDS(scene);
    return scene;
}

#define TRIANGLE "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
#define SQUARE   "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"

static void expect_error(const char *text, lam_code code, const char *sentence)
{
    lam_error error = {0};
    lam_scene *scene = load_with(text, (lam_load_params){.format = "obj"}, NULL, &error);
    if (scene)
        fail_msg("loaded, expected: %s", sentence);
    assert_string_equal(error.text, sentence);
    assert_int_equal(error.code, code);
}

// Expects this warning, and no second one.
static void expect_warning(const char *text, const struct library *libraries, const char *sentence)
{
    lam_error error = {0};
    AUTO_SCENE scene = load_with(text, (lam_load_params){0}, libraries, &error);
    SUCCEEDS(scene);
    assert_non_null(lam_scene_warning(scene, 0));
    assert_string_equal(lam_scene_warning(scene, 0), sentence);
    assert_null(lam_scene_warning(scene, 1));
}

static const float *position(const lam_mesh *mesh, uint32_t corner)
{
    return mesh->positions + 3 * mesh->indices[corner];
}

static void expect_part(const lam_mesh *mesh, uint32_t index, const char *name, uint32_t first, uint32_t count,
                        int material)
{
    assert_true(index < mesh->part_count);
    const lam_part *part = &mesh->parts[index];
    if (name)
        assert_string_equal(part->name, name);
    else
        assert_null(part->name);
    assert_int_equal(part->first_triangle, first);
    assert_int_equal(part->triangle_count, count);
    assert_int_equal(part->material, material);
}

// --- faces

TEST(test_face_forms)
{
    static const char *const forms[] = {
        TRIANGLE "f 1 2 3\n",
        TRIANGLE "f 1 2 3", // no line end
        TRIANGLE "f -3 -2 -1\n",
        TRIANGLE "f +1 +2 +3\n",
        TRIANGLE "f 1/ 2/ 3/\n",
        TRIANGLE "f 1// 2// 3//\n",
        "\xef\xbb\xbf" TRIANGLE "f 1 2 3\n",
        "v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3\r\n",
        "v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r",
        "\tv\t0 0\t0  \n  v 1 0 0\n v 0 1 0\t\n  f  1\t2   3  \n",
        "v 0 0 0 # first\nv 1 0 0 #\nv 0 1 0 # f 9 9 9\nf 1 2 3 # done \\\n# \\\n",
        "v 0 \\\n0 0\nv 1 0 0\\\n\nv 0 1 0\nf 1 \\\r\n 2\\\n 3\n",
        "f 1 2 3\n" TRIANGLE, // before its vertices
        "v 0 0 0 1\nv 1.0 0 0 0.5\nv 0 1e0 -0.0 2\nf 00000001 0000000002 3\n",
        "# nothing\n\n#\\\n" TRIANGLE "#f 1 1 1\nf 1 2 3\n#",
    };
    static const float expected[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    for (size_t i = 0; i < sizeof forms / sizeof *forms; i++) {
        AUTO_SCENE scene = load(forms[i]);
        const lam_mesh *mesh = lam_scene_mesh(scene, 0);
        assert_int_equal(mesh->triangle_count, 1);
        for (uint32_t c = 0; c < 3; c++)
            for (int k = 0; k < 3; k++)
                assert_true(position(mesh, c)[k] == expected[3 * c + (uint32_t)k]);
        assert_null(lam_scene_warning(scene, 0));
        assert_string_equal(lam_scene_format(scene), "obj");
        assert_int_equal(lam_scene_up(scene), LAM_UP_Y);
    }
}

TEST(test_attributes)
{
    AUTO_SCENE scene = load(SQUARE "vt 0 0\nvt 1\nvt 0.5 0.25 7\nvn 0 0 1\nvn 0 1 0\n"
                                   "f 1/1/1 2/2/2 3/3/-1\nf -4/-3/-2 3/-1/2 4//1\n");
    const lam_mesh *mesh = lam_scene_mesh(scene, 0);
    assert_int_equal(mesh->triangle_count, 2);
    static const uint32_t normals[6] = {0, 1, 1, 0, 1, 0}, texcoords[6] = {0, 1, 2, 0, 2, 3};
    assert_memory_equal(mesh->normal_indices, normals, sizeof normals);
    assert_memory_equal(mesh->texcoord_indices, texcoords, sizeof texcoords);
    assert_int_equal(mesh->texcoord_count, 4); // one more, for the corner without coordinates
    static const float numbers[8] = {0, 0, 1, 0, 0.5f, 0.25f, 0, 0};
    assert_memory_equal(mesh->texcoords, numbers, sizeof numbers);
    assert_true(mesh->normals[3] == 0 && mesh->normals[4] == 1 && mesh->normals[5] == 0);
}

// Corners with normals keep them; faces without normals get computed ones.
TEST(test_missing_normals)
{
    const char *text = SQUARE "vn 1 0 0\nf 1//1 2//1 3//1\nf 1 3 4\n";
    lam_scene *scene = load(text);
    const lam_mesh *mesh = lam_scene_mesh(scene, 0);
    for (uint32_t corner = 0; corner < 6; corner++) {
        const float *n = mesh->normals + 3 * mesh->normal_indices[corner];
        assert_true(mesh->normal_indices[corner] < mesh->normal_count);
        assert_true(n[0] == (corner < 3 ? 1 : 0) && n[1] == 0 && n[2] == (corner < 3 ? 0 : 1));
    }
    lam_scene_free(scene);
    lam_error error;
    scene = load_with(text, (lam_load_params){.normals = LAM_NORMALS_SMOOTH}, NULL, &error);
    mesh = lam_scene_mesh(scene, 0);
    for (uint32_t i = 0; i < mesh->normal_count; i++)
        assert_true(mesh->normals[3 * i + 2] == 1);
    lam_scene_free(scene);
}

TEST(test_polygons)
{
    // A concave quad and a concave pentagon next to a triangle; attributes follow their corners.
    lam_scene *scene =
        load("v 0 0 0\nv 2 0 0\nv 0.3 0.3 0\nv 0 2 0\nv 2 2 0\nvt 0 0\nvt 2 0\nvt 0.3 0.3\nvt 0 2\nvt 2 2\n"
             "f 1/1 2/2 3/3 4/4\nf 2/2 5/5 3/3\nf 4/4 1/1 2/2 5/5 3/3\n");
    const lam_mesh *mesh = lam_scene_mesh(scene, 0);
    assert_int_equal(mesh->triangle_count, 6);
    double areas[6];
    for (uint32_t t = 0; t < 6; t++) {
        const float *a = position(mesh, 3 * t), *b = position(mesh, 3 * t + 1), *c = position(mesh, 3 * t + 2);
        areas[t] = ((double)b[0] - (double)a[0]) * ((double)c[1] - (double)a[1]) -
                   ((double)b[1] - (double)a[1]) * ((double)c[0] - (double)a[0]);
        assert_true(areas[t] > 0);
        for (uint32_t k = 0; k < 3; k++) {
            const float *p = position(mesh, 3 * t + k), *s = mesh->texcoords + 2 * mesh->texcoord_indices[3 * t + k];
            assert_true(p[0] == s[0] && p[1] == s[1]);
        }
    }
    assert_true(areas[0] + areas[1] > 1.19 && areas[0] + areas[1] < 1.21);
    lam_scene_free(scene);
}

// One face of a few thousand corners, written on continued lines.
TEST(test_large_polygon)
{
    enum { HALF = 3000 };
    char *text = malloc(64 * 2 * HALF), *at = text;
    for (int i = 0; i < HALF; i++)
        at += sprintf(at, "v %d %d 0\n", i, i % 2);
    for (int i = HALF; i-- > 0;)
        at += sprintf(at, "v %d %d 0\n", i, i % 2 + 3);
    at += sprintf(at, "f");
    for (int i = 1; i <= 2 * HALF; i++)
        at += sprintf(at, i % 10 ? " %d" : " %d\\\n", i);
    at += sprintf(at, "\n");
    AUTO_SCENE scene = load(text);
    assert_int_equal(lam_scene_triangle_count(scene), 2 * HALF - 2);
    free(text);
}

TEST(test_warnings)
{
    expect_warning(TRIANGLE "f 1 2 3\nf 1 2\nf\nf 3\n", NULL,
                   "t.obj:5: a face of fewer than three corners is ignored, the first of 3");
    expect_warning(TRIANGLE "l 1\nf 1 2 3\nl\nl 2 3\n", NULL, "t.obj: 2 lines of fewer than two vertices are ignored");
    expect_warning(TRIANGLE "p\nf 1 2 3\n", NULL, "t.obj: 1 points without a vertex are ignored");
    expect_warning(TRIANGLE "f 1 2 3\ncstype bezier\ncurv 0 1 1 2 3\n", NULL,
                   "t.obj:5: free-form curves and surfaces are not drawn: 'cstype' is the first of 2 such statements");
    expect_warning(TRIANGLE "f 1 2 3\nfoo bar\n\nbaz\n", NULL,
                   "t.obj:5: unknown statement 'foo', the first of 2 that are ignored");
    expect_warning(TRIANGLE "f 1/1 2/2 3/3\n", NULL,
                   "t.obj: faces or lines refer to texture coordinates, but the file contains none");
    expect_warning(TRIANGLE "f 1//1 2//1 3//1\n", NULL,
                   "t.obj: faces refer to normals, but the file contains none; lambent computes smooth normals");
    expect_warning(TRIANGLE "vn 0 0 1\nvn nan 0 0\nf 1//1 2//1 3//1\n", NULL,
                   "t.obj: 1 of 2 normals are zero or not finite; they are computed, or left out for lines and points");
    expect_warning(TRIANGLE "vt nan 0\nf 1/1 2/1 3/1\n", NULL,
                   "t.obj:4: a texture coordinate that is not finite is set to 0, the first of 1");
    expect_warning(TRIANGLE "l 1/1 2/2\nf 1 2 3\n", NULL,
                   "t.obj: faces or lines refer to texture coordinates, but the file contains none");
    expect_warning(TRIANGLE "v 1 nan 3\nf 1 2 3\nf 1 2 4\n", NULL,
                   "t.obj: 1 vertices have coordinates that are not finite; 1 triangles, lines or points that use them "
                   "are left out");
    expect_warning("mtllib a.mtl\n" TRIANGLE "usemtl x\nf 1 2 3\nusemtl y\n", NULL,
                   "a.mtl: no such file; its materials are drawn in neutral grey");
    expect_warning(TRIANGLE "usemtl x\nf 1 2 3\nusemtl y\n", NULL,
                   "t.obj:4: uses the material 'x' but names no material file; it is drawn in neutral grey");
    static const struct library libraries[] = {{"a.mtl", "newmtl x\n"}, {NULL, NULL}};
    expect_warning("mtllib a.mtl\n" TRIANGLE "usemtl x\nf 1 2 3\nusemtl y\nf 1 2 3\n", libraries,
                   "t.obj:7: no material file defines the material 'y'; it is drawn in neutral grey");
    expect_warning("v 0 0 0 255 0 0\nv 1 0 0 0 255 0\nv 0 1 0 0 0 255\nf 1 2 3\n", NULL,
                   "t.obj: vertex colours reach 255, so their range is taken as 0 to 255, not 0 to 1");
}

TEST(test_errors)
{
    expect_error("v 0 0\n" TRIANGLE "f 1 2 3\n", LAM_CANNOT_READ,
                 "t.obj:1: found the end of the line, expected a coordinate (v x y z)");
    expect_error(TRIANGLE "v 1 2 x3\nf 1 2 3\n", LAM_CANNOT_READ,
                 "t.obj:4: found 'x3', expected a coordinate (v x y z)");
    expect_error(TRIANGLE "v 1 2 0x10\nf 1 2 3\n", LAM_CANNOT_READ,
                 "t.obj:4: found '0x10', expected a coordinate (v x y z)");
    expect_error(TRIANGLE "v 1 2 -1e39\nf 1 2 4\n", LAM_CANNOT_READ,
                 "t.obj: contains nothing to draw: each triangle, line and point uses a vertex that is not finite");
    expect_error(TRIANGLE "v 1 2 3 red\nf 1 2 3\n", LAM_CANNOT_READ,
                 "t.obj:4: found 'red', expected a weight or a colour after the position");
    expect_error(TRIANGLE "f 0 1 2\n", LAM_CANNOT_READ, "t.obj:4: a face names vertex 0, expected an index from 1");
    expect_error(TRIANGLE "\n\nf 1 2 4\n", LAM_CANNOT_READ, "t.obj:6: a face names vertex '4', but the file has 3");
    expect_error(TRIANGLE "f 1 2 99999999999999999999\n", LAM_CANNOT_READ,
                 "t.obj:4: found '99999999999999999999', expected a vertex");
    expect_error(TRIANGLE "f -1 -2 -4\n", LAM_CANNOT_READ,
                 "t.obj:4: a face names vertex '-4', counted back, but only 3 precede it");
    expect_error(TRIANGLE "f 1 2 x\n", LAM_CANNOT_READ, "t.obj:4: found 'x', expected a vertex");
    expect_error(TRIANGLE "f 1 2 3x\n", LAM_CANNOT_READ,
                 "t.obj:4: found 'x', expected a space between a face's corners (v, v/t, v//n or v/t/n)");
    expect_error(TRIANGLE "f 1 2 2.5\n", LAM_CANNOT_READ,
                 "t.obj:4: found '.5', expected a space between a face's corners (v, v/t, v//n or v/t/n)");
    expect_error(TRIANGLE "vt 0 0\nf 1/1 2/1 3/2\n", LAM_CANNOT_READ,
                 "t.obj:5: a face names texture coordinate '2', but the file has 1");
    expect_error(TRIANGLE "vn 0 0 1\nf 1//1 2//1 3//y\n", LAM_CANNOT_READ, "t.obj:5: found 'y', expected a normal");
    expect_error(TRIANGLE "vn 0 0\nf 1//1 2//1 3//1\n", LAM_CANNOT_READ,
                 "t.obj:4: found the end of the line, expected a normal's coordinate (vn x y z)");
    expect_error(TRIANGLE "f 1 2 3\nf 1 2 7\nf 8 1 2\n", LAM_CANNOT_READ,
                 "t.obj:5: a face names vertex '7', but the file has 3");
    expect_error("", LAM_CANNOT_READ, "t.obj: contains no triangles, lines or points");
    expect_error(TRIANGLE "l 1 4\n", LAM_CANNOT_READ, "t.obj:4: a line names vertex 4, but the file has 3");
    expect_error(TRIANGLE "p 0\n", LAM_CANNOT_READ, "t.obj:4: a point names vertex 0, expected an index from 1");
    expect_error(TRIANGLE "l 1 -4\n", LAM_CANNOT_READ,
                 "t.obj:4: a line names vertex -4, counted back, but only 3 precede it");
    expect_error(TRIANGLE "l 1 x\n", LAM_CANNOT_READ, "t.obj:4: found 'x', expected the number of a vertex");
    expect_error(TRIANGLE "l 1 2x\n", LAM_CANNOT_READ,
                 "t.obj:4: found 'x', expected a space between vertices (v or v/t)");
    expect_error(TRIANGLE "vt 0 0\nl 1/1 2/2\n", LAM_CANNOT_READ,
                 "t.obj:5: a line names texture coordinate 2, but the file has 1");
    expect_error(TRIANGLE "cstype bspline\nsurf 0 1 0 1 1 2 3\n", LAM_UNSUPPORTED,
                 "t.obj:4: contains no faces, only free-form curves and surfaces ('cstype'), which this version "
                 "cannot draw");
    // A zero byte in the middle.
    lam_error error;
    static const char zero[] = TRIANGLE "f 1 2\0 3\n";
    lam_load_params params = {.format = "obj", .threads = 1};
    assert_null(lam_scene_load_memory(zero, sizeof zero - 1, "t.obj", &params, NULL, &error));
    assert_non_null(strstr(error.text, "t.obj:4: found "));
}

// --- parts, groups, smoothing

TEST(test_parts)
{
    static const struct library libraries[] = {
        {"my red.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue sky\nKd 0 0 1\n"},
        {"b.mtl", "newmtl green\nKd 0 1 0\nnewmtl red\nKd 0 0 0\n"},
        {NULL, NULL},
    };
    lam_error error;
    lam_scene *scene = load_with(TRIANGLE "mtllib my red.mtl\nmtllib b.mtl\n"
                                          "f 1 2 3\n"
                                          "g left hand \nf 1 2 3\nf 1 2 3\n"
                                          "usemtl red\nf 1 2 3\nusemtl red\nf 1 2 3\n"
                                          "o body\nf 1 2 3\ng arm\nusemtl blue sky\nf 1 2 3\ng\nf 1 2 3\n"
                                          "g empty\nusemtl green\n",
                                 (lam_load_params){0}, libraries, &error);
    assert_non_null(scene);
    assert_null(lam_scene_warning(scene, 0));
    assert_int_equal(lam_scene_material_count(scene), 4);
    const lam_mesh *mesh = lam_scene_mesh(scene, 0);
    assert_int_equal(mesh->part_count, 6);
    expect_part(mesh, 0, NULL, 0, 1, -1);
    expect_part(mesh, 1, "left hand", 1, 2, -1);
    expect_part(mesh, 2, "left hand", 3, 2, 0);
    expect_part(mesh, 3, "body", 5, 1, 0);
    expect_part(mesh, 4, "body/arm", 6, 1, 1);
    expect_part(mesh, 5, "body", 7, 1, 1);
    assert_string_equal(mesh->name, "body");
    lam_scene_free(scene);

    // Several files on one line, the first one missing.
    scene =
        load_with("mtllib a.mtl b.mtl\n" TRIANGLE "usemtl green\nf 1 2 3\n", (lam_load_params){0}, libraries, &error);
    assert_string_equal(lam_scene_warning(scene, 0), "a.mtl: no such file; its materials are drawn in neutral grey");
    expect_part(lam_scene_mesh(scene, 0), 0, NULL, 0, 1, 0);
    lam_scene_free(scene);

    // A path that leads out of the model's folder is confined to it.
    scene =
        load_with("mtllib ..\\x\\b.mtl\n" TRIANGLE "usemtl green\nf 1 2 3\n", (lam_load_params){0}, libraries, &error);
    assert_int_equal(lam_scene_material_count(scene), 2);
    lam_scene_free(scene);
}

TEST(test_smoothing)
{
    lam_scene *scene = load(SQUARE "f 1 2 3\ns 3\nf 1 2 3\nf 1 3 4\ns off\nf 1 2 3\ns 1\nf 1 2 3\ns 0\nf 1 3 4\n");
    static const uint32_t groups[] = {0, 3, 3, 0, 1, 0};
    const lam_mesh *mesh = lam_scene_mesh(scene, 0);
    assert_memory_equal(mesh->smoothing_groups, groups, sizeof groups);
    lam_scene_free(scene);
    scene = load(SQUARE "s off\nf 1 2 3\n"); // the same as no smoothing group
    assert_null(lam_scene_mesh(scene, 0)->smoothing_groups);
    lam_scene_free(scene);
}

// --- numbers

TEST(test_colors)
{
    lam_error error;
    const char *text = "v 0 0 0 1 0.5 0\nv 1 0 0\nv 0 1 0 0.25 1 1 1\nf 1 2 3\n";
    lam_scene *scene = load_with(text, (lam_load_params){.color = LAM_COLOR_RAW}, NULL, &error);
    const lam_mesh *mesh = lam_scene_mesh(scene, 0);
    assert_int_equal(mesh->colors_format, LAM_COLORS_LINEAR_F32);
    assert_int_equal(mesh->color_count, 3);
    static const float raw[12] = {1, 0.5f, 0, 1, 1, 1, 1, 1, 0.25f, 1, 1, 1};
    assert_memory_equal(mesh->colors, raw, sizeof raw);
    lam_scene_free(scene);
    scene = load(text);
    const float *colors = lam_scene_mesh(scene, 0)->colors;
    assert_true(colors[1] > 0.2140f && colors[1] < 0.2141f); // ((0.5 + 0.055)/1.055)^2.4
    assert_true(colors[2] == 0 && colors[4] > 0.999999f);
    lam_scene_free(scene);
}

// Vertex colours of ZBrush: eight hexadecimal digits for each vertex, on several lines; the others are white.
TEST(test_mrgb)
{
    lam_error error;
    const char *text = SQUARE "#MRGB ffff0000FF00ff33\n#MRGB 003300ff12\nf 1 2 3 4\n";
    AUTO_SCENE scene = load_with(text, (lam_load_params){.color = LAM_COLOR_RAW}, NULL, &error);
    static const float colors[16] = {1, 0, 0, 1, 0, 1, 0.2f, 1, 0.2f, 0, 1, 1, 1, 1, 1, 1};
    assert_memory_equal(lam_scene_mesh(scene, 0)->colors, colors, sizeof colors);
    assert_non_null(strstr(lam_scene_warning(scene, 0), "found '12' in #MRGB, expected eight hexadecimal digits"));
    static const char *const rows[][2] = {{"ffff0000FF00ff33ff0000ffff000000", NULL},
                                          {"ffff0000FF00ff33ff0000ff", "#MRGB gives colours to 3 of 4 vertices"},
                                          {"ffff0000FF00ffzz", "found 'FF00ffzz' in #MRGB"},
                                          {"ffff0000FF00ff33ff0000ffff000000ff000000", "found 'ff000000' in #MRGB"},
                                          {"?", "found '?' in #MRGB"}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char other[200];
        snprintf(other, sizeof other, SQUARE "#MRGB %s\nf 1 2 3 4\n", rows[i][0]);
        AUTO_SCENE one = load_with(other, (lam_load_params){0}, NULL, &error);
        const char *warning = lam_scene_warning(one, 0);
        assert_true(rows[i][1] ? warning && strstr(warning, rows[i][1]) && !lam_scene_warning(one, 1) : !warning);
    }
}

// A file of vertices only is a cloud of points, with one normal for each vertex or none.
TEST(test_cloud)
{
    lam_scene *scene = load("v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nvn 0 0 1\nvn 0 1 0\n");
    const lam_mesh *mesh = lam_scene_mesh(scene, 0);
    assert_int_equal(mesh->point_count, 2);
    assert_null(mesh->indices);
    assert_true(((const float *)mesh->colors)[5] == 1 && mesh->normals[4] == 1);
    lam_scene_free(scene);
    scene = load("v 0 0 0\nv 1 0 0\nvn 0 0 1\n");
    assert_int_equal(lam_scene_mesh(scene, 0)->point_count, 2);
    assert_null(lam_scene_mesh(scene, 0)->normals);
    assert_non_null(strstr(lam_scene_warning(scene, 0), "found 1 normals for 2 points"));
    lam_scene_free(scene);
}

// A detail of a millimetre is preserved 500 km from zero.
TEST(test_origin)
{
    lam_scene *scene =
        load("v 500000.001 4e6 -7.0005\nv 500001.002 4000000.5 -7\nv 500000.003 4000001.25 -6\nf 1 2 3\n");
    const lam_mesh *mesh = lam_scene_mesh(scene, 0);
    static const double expected[9] = {500000.001, 4e6, -7.0005, 500001.002, 4000000.5, -7, 500000.003, 4000001.25, -6};
    assert_true(mesh->origin[0] != 0 && mesh->origin[1] != 0 && mesh->origin[2] == 0);
    for (int i = 0; i < 9; i++) {
        double off = mesh->origin[i % 3] + (double)mesh->positions[i] - expected[i];
        assert_true(off < 1e-6 && off > -1e-6);
    }
    lam_scene_free(scene);
    scene = load("v 5 0 0\nv 6.1 0 0\nv 5 1 0\nf 1 2 3\n");
    mesh = lam_scene_mesh(scene, 0);
    assert_true(mesh->origin[0] == 0 && mesh->positions[3] == 6.1f);
    lam_scene_free(scene);
}

// --- MTL

static const lam_material *load_material(const char *mtl, lam_color_mode color, lam_scene **scene)
{
    struct library libraries[] = {{"a.mtl", mtl}, {NULL, NULL}};
    lam_error error;
    *scene = load_with("mtllib a.mtl\n" TRIANGLE "f 1 2 3\n", (lam_load_params){.color = color}, libraries, &error);
    assert_non_null(*scene);
    return lam_scene_material(*scene, 0);
}

TEST(test_mtl)
{
    lam_scene *scene;
    const lam_material *m =
        load_material("# x\r\n\tnewmtl  shiny \r\nKa 0.1 0.2 0.3\r\nKd 0.5 0.25 1\r\nKs 1 1 1\r\nKe 2\r\n"
                      "Ns 96.5\r\nillum 2\r\nTr 0.9\r\nd 0.75\r\nNi 1.45\r\n",
                      LAM_COLOR_RAW, &scene);
    assert_string_equal(m->name, "shiny");
    assert_true(m->ambient.r == 0.1f && m->ambient.g == 0.2f && m->ambient.b == 0.3f);
    assert_true(m->diffuse.r == 0.5f && m->diffuse.g == 0.25f && m->diffuse.b == 1 && m->diffuse.a == 0.75f);
    assert_true(m->specular.r == 1 && m->emission.r == 2 && m->emission.b == 2 && m->shininess == 96.5f);
    assert_int_equal(m->illum, 2);
    assert_null(lam_scene_warning(scene, 0));
    lam_scene_free(scene);

    // Ka 1 1 1 is ignored; sRGB is decoded; without Ks there is no highlight; d takes precedence in either order.
    m = load_material("newmtl a\nKa 1 1 1\nKd 0.5 0.5 0.5\nd 0.5\nTr 0.1\n", LAM_COLOR_SRGB, &scene);
    assert_true(m->diffuse.r > 0.2140f && m->diffuse.r < 0.2141f);
    assert_true(m->ambient.r == m->diffuse.r && m->specular.r == 0 && m->diffuse.a == 0.5f);
    lam_scene_free(scene);

    m = load_material("newmtl a\nKd 0.5 0.5 0.5\nKs 1 1 1\nillum 1\nTr 0.25\n", LAM_COLOR_RAW, &scene);
    assert_true(m->specular.r == 0 && m->diffuse.a == 0.75f && m->ambient.r == 0.5f);
    lam_scene_free(scene);

    m = load_material("newmtl a\nKd 0.5 0.25 0\nKs 1 1 1\nillum 0\n", LAM_COLOR_RAW, &scene);
    assert_true(m->emission.r == 0.5f && m->emission.g == 0.25f && m->diffuse.r == 0 && m->ambient.r == 0 &&
                m->specular.r == 0 && m->diffuse.a == 1);
    lam_scene_free(scene);
}

// A black Kd under a map is white, whatever the other colours are.
TEST(test_mtl_black)
{
    static const struct {
        const char *mtl;
        float diffuse;
        const char *warning;
    } rows[] = {
        {"newmtl a\nKd 0 0 0\nmap_Kd t.png\n", 1, "black Kd and a map_Kd"},
        {"newmtl a\nmap_Kd t.png\nKa 0 0 0\nKd 0\n", 1, "black Kd and a map_Kd"},
        {"newmtl a\nKd 0 0 0\nKs 1 1 1\nKe 1 1 1\nmap_Kd t.png\n", 1, "black Kd and a map_Kd"},
        {"newmtl a\nmap_Kd t.png\n", 1, "t.png"},
        {"newmtl a\nKd 0 0 0.5\nmap_Kd t.png\n", 0, "t.png"},
        {"newmtl a\nKd 0 0 0\nKs 1 1 1\n", 0, NULL},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        lam_scene *scene;
        const lam_material *m = load_material(rows[i].mtl, LAM_COLOR_RAW, &scene);
        assert_true(m->diffuse.r == rows[i].diffuse);
        assert_true(rows[i].warning ? strstr(lam_scene_warning(scene, 0), rows[i].warning) != NULL
                                    : !lam_scene_warning(scene, 0));
        lam_scene_free(scene);
    }
}

// '#' begins a comment after white space, and options may follow the name of a map.
TEST(test_names)
{
    static const struct {
        const char *statement, *name, *options; // a map_Kd
    } rows[] = {
        {"tex.png # the map", "tex.png", NULL},
        {"C#.png", "C#.png", NULL},
        {"#1.png\t#x", "#1.png", NULL},
        {"my tex.png -bm 1", "my tex.png", "-bm 1"},
        {"-o 1 tex.png  -s 1 2 3 -clamp on # x", "tex.png", "-o 1  -s 1 2 3 -clamp on"},
        {"tex -s 1.png", "tex -s 1.png", NULL},
        {"tex -bm", "tex -bm", NULL},
        {"-s 1 7", "7", "-s 1"},
        {"a -b c.png", "a -b c.png", NULL},
        {"# none", NULL, NULL},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char mtl[200];
        lam_scene *scene;
        snprintf(mtl, sizeof mtl, "newmtl a # b\nmap_Kd %s\n", rows[i].statement);
        const lam_material *m = load_material(mtl, LAM_COLOR_RAW, &scene);
        assert_string_equal(m->name, "a");
        if (rows[i].name)
            assert_string_equal(m->map_names[LAM_MAP_DIFFUSE], rows[i].name);
        else
            assert_null(m->map_names[LAM_MAP_DIFFUSE]);
        if (rows[i].options)
            assert_string_equal(m->map_options[LAM_MAP_DIFFUSE], rows[i].options);
        else
            assert_null(m->map_options[LAM_MAP_DIFFUSE]);
        lam_scene_free(scene);
    }
    static const struct library libraries[] = {{"a.mtl", "newmtl x#1\nKd 1 0 0\n"}, {NULL, NULL}};
    lam_error error;
    AUTO_SCENE scene = load_with("mtllib a.mtl # the file\n" TRIANGLE "usemtl x#1 # red\ng part # 1\nf 1 2 3\n",
                                 (lam_load_params){0}, libraries, &error);
    assert_null(lam_scene_warning(scene, 0));
    expect_part(lam_scene_mesh(scene, 0), 0, "part", 0, 1, 0);
}

// Ns 0 removes the highlight if there is one; a small exponent does not.
TEST(test_mtl_exponents)
{
    static const struct {
        const char *mtl;
        float specular, shininess;
        bool warned;
    } rows[] = {
        {"newmtl a\nKs 1 1 1\nNs 0\n", 0, 0, true},         {"newmtl a\nNs 0\nKs 1 1 1\nillum 2\n", 0, 0, true},
        {"newmtl a\nKs 1 1 1\nNs 0.01\n", 1, 0.01f, false}, {"newmtl a\nKs 1 1 1\n", 1, 32, false},
        {"newmtl a\nKs 0 0 0\nNs 0\n", 0, 0, false},        {"newmtl a\nKs 1 1 1\nNs 0\nillum 1\n", 0, 0, false},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        lam_scene *scene;
        const lam_material *m = load_material(rows[i].mtl, LAM_COLOR_RAW, &scene);
        assert_true(m->specular.r == rows[i].specular && m->shininess == rows[i].shininess);
        assert_int_equal(lam_scene_warning(scene, 0) != NULL, rows[i].warned);
        lam_scene_free(scene);
    }
}

TEST(test_mtl_maps)
{
    lam_scene *scene;
    const lam_material *m = load_material("newmtl a\nmap_Kd -s 1 1 1 -o 0.5 0 -clamp on my picture.png\nmap_Ka\n"
                                          "map_Bump -bm 0.5 b.png\nrefl -type sphere r.png\nnorm n.png\ndisp -s 2 7\n"
                                          "map_Pr rough.png\n",
                                          LAM_COLOR_RAW, &scene);
    assert_string_equal(m->map_names[LAM_MAP_DIFFUSE], "my picture.png");
    assert_string_equal(m->map_options[LAM_MAP_DIFFUSE], "-s 1 1 1 -o 0.5 0 -clamp on");
    assert_string_equal(m->map_names[LAM_MAP_BUMP], "b.png");
    assert_string_equal(m->map_options[LAM_MAP_BUMP], "-bm 0.5");
    assert_string_equal(m->map_options[LAM_MAP_REFLECTION], "-type sphere");
    assert_string_equal(m->map_names[LAM_MAP_NORMAL], "n.png");
    assert_string_equal(m->map_names[LAM_MAP_DISPLACEMENT], "7");
    assert_null(m->map_options[LAM_MAP_NORMAL]);
    assert_null(m->map_names[LAM_MAP_AMBIENT]);
    assert_true(m->diffuse.r == 1); // the texture's own colour
    assert_string_equal(m->map_names[LAM_MAP_ROUGHNESS], "rough.png");
    assert_string_equal(lam_scene_warning(scene, 0),
                        "t.obj: 1 reflection map (refl) is not drawn: materials mirror the scene's environment, which "
                        "they have in common");
    assert_string_equal(lam_scene_warning(scene, 1), "t.obj: 1 map of materials that this version does not draw");
    for (int i = 2; i <= 5; i++) // none of the pictures exists
        assert_non_null(strstr(lam_scene_warning(scene, i), "drawn without this texture"));
    assert_null(lam_scene_warning(scene, 6));
    lam_scene_free(scene);
}

// Options with invalid or absurd numbers: a warning each, and the map without the option.
TEST(test_mtl_options)
{
    static const struct {
        const char *mtl, *sentence;
    } rows[] = {
        {"map_Kd -s nan inf x.ppm", "option -s of its diffuse map is nan, expected numbers from -1000000 to 1000000"},
        {"map_Kd -s 1 -inf x.ppm", "option -s of its diffuse map is -inf, expected numbers from -1000000 to 1000000"},
        {"map_Kd -o 1e38 x.ppm", "option -o of its diffuse map is 1e+38, expected numbers from -1000000 to 1000000"},
        {"map_Kd -mm 0 1e9 x.ppm", "option -mm of its diffuse map is 1e+09, expected numbers from -1000000 to 1000000"},
        {"map_Bump -bm 1e30 x.ppm", "option -bm of its bump map is 1e+30, expected numbers from -1000000 to 1000000"},
        {"map_d -imfchan q x.ppm", "option -imfchan of its opacity map is 'q', expected r, g, b, m, l or z"},
        {"map_Kd -s 2 3 -clamp on x.ppm", NULL},
        {"map_d -imfchan l x.ppm", NULL},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char mtl[200], sentence[300];
        lam_error error = {0};
        snprintf(mtl, sizeof mtl, "newmtl a\n%s\n", rows[i].mtl);
        const struct library libraries[] = {{"a.mtl", mtl}, {"x.ppm", "P6\n1 1\n255\nabc"}, {NULL, NULL}};
        lam_scene *scene =
            load_with("mtllib a.mtl\n" TRIANGLE "usemtl a\nf 1 2 3\n", (lam_load_params){0}, libraries, &error);
        assert_non_null(scene);
        const lam_material *m = lam_scene_material(scene, 0);
        int maps = 0;
        for (int slot = 0; slot < LAM_MAP_COUNT; slot++) {
            const lam_texture_map *map = m->maps[slot];
            maps += map != NULL;
            for (int k = 0; map && k < 6; k++)
                assert_true(fabsf(map->transform[k / 3][k % 3]) <= 3);
            assert_true(!map || (fabsf(map->scale) <= 1 && map->offset == 0));
        }
        assert_int_equal(maps, 1);
        if (rows[i].sentence) {
            snprintf(sentence, sizeof sentence, "t.obj: material 'a': %s; it is ignored", rows[i].sentence);
            assert_string_equal(lam_scene_warning(scene, 0), sentence);
        }
        assert_null(lam_scene_warning(scene, rows[i].sentence != NULL));
        lam_scene_free(scene);
    }
}

TEST(test_mtl_warnings)
{
    static const struct {
        const char *mtl, *sentence;
    } rows[] = {
        {"Kd 1 1 1\nnewmtl a\n", "a.mtl:1: 'Kd' before the first newmtl is ignored"},
        {"newmtl a\nKq 1\nKz 2\n", "a.mtl:2: unknown statement 'Kq' and others"},
        {"newmtl a\nNs -3\n", "a.mtl:2: Ns -3 is out of range, 0 is used"},
        {"newmtl a\nNs nan\n", "a.mtl:2: Ns nan is out of range, 0 is used"},
        {"newmtl a\nd 1.5\n", "a.mtl:2: d 1.5 is out of range, 1 is used"},
        {"newmtl a\nKd -1 0 0\n", "a.mtl:2: Kd -1 is out of range, 0 is used"},
        {"newmtl a\nKd red\n", "a.mtl:2: found 'red', expected a number; the statement is ignored"},
        {"newmtl a\nKd\n", "a.mtl:2: found the end of the line, expected a number; the statement is ignored"},
        {"newmtl a\nKd spectral x.rfl\n", "a.mtl:2: Kd as a spectral curve is not supported, expected r g b"},
        {"newmtl a\nKs xyz 1 1 1\n", "a.mtl:2: Ks as a CIE XYZ colour is not supported, expected r g b"},
        {"newmtl a\nillum 99\n", "a.mtl:2: illum is not one of the models 0 to 10; it is ignored"},
        {"newmtl a\nKs 1 1 1\nNs 0.000\nillum 2\n",
         "a.mtl:3: with Ns 0 the highlight would cover all lit points; it is omitted"},
        {"newmtl a\nNs 0\nKs 1\nnewmtl b\nNs 0\nKs 1\n",
         "a.mtl:2: with Ns 0 the highlight would cover all lit points; it is omitted, here and in other materials"},
        {"newmtl a\nd 0\n", "a.mtl:2: material 'a' is fully transparent (d 0)"},
        {"newmtl a\nd 1\nnewmtl b\n\nTr 1.000\nnewmtl c\nd 0\n",
         "a.mtl:5: material 'b' is fully transparent (Tr 1), the first of 2"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct library libraries[] = {{"a.mtl", rows[i].mtl}, {NULL, NULL}};
        expect_warning("mtllib a.mtl\n" TRIANGLE "f 1 2 3\n", libraries, rows[i].sentence);
    }
}

// If the picture would be empty, everything is drawn opaque, because MeshLab writes Tr 1 for opaque materials. One
// warning states this.
TEST(test_clear)
{
#define OPAQUE "; the picture would be empty, so everything is drawn opaque"
    static const struct {
        const char *faces, *mtl;
        float a, b; // opacities of the materials
        const char *warning;
    } rows[] = {
        {"usemtl a\nf 1 2 3\n", "newmtl a\nKd 1 0 0\nTr 1.000000\nillum 2\nnewmtl b\n", 1, 1,
         "a.mtl:3: material 'a' is fully transparent (Tr 1)" OPAQUE},
        {"usemtl a\nf 1 2 3\n", "newmtl a\nillum 4\nd 0\nnewmtl b\nd 0.5\n", 1, 0.5f,
         "a.mtl:3: material 'a' is fully transparent (d 0)" OPAQUE},
        {"usemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\n", "newmtl a\nTr 1\nnewmtl b\nd 0\n", 1, 1,
         "a.mtl:2: material 'a' is fully transparent (Tr 1), the first of 2" OPAQUE},
        // Something is visible, so nothing changes.
        {"usemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\n", "newmtl a\nTr 1\nnewmtl b\nTr 0.999\n", 0, 1 - 0.999f,
         "a.mtl:2: material 'a' is fully transparent (Tr 1)"},
        {"f 1 2 3\nusemtl a\nf 1 2 3\n", "newmtl a\nTr 1\nnewmtl b\n", 0, 1,
         "a.mtl:2: material 'a' is fully transparent (Tr 1)"},
        // A material that no face uses is ignored.
        {"usemtl b\nf 1 2 3\n", "newmtl a\nTr 1\nnewmtl b\n", 0, 1,
         "a.mtl:2: material 'a' is fully transparent (Tr 1)"},
        {"usemtl b\nusemtl a\nf 1 2 3\n", "newmtl a\nTr 1\nnewmtl b\n", 1, 1,
         "a.mtl:2: material 'a' is fully transparent (Tr 1)" OPAQUE},
        // d decides in either order.
        {"usemtl a\nf 1 2 3\n", "newmtl a\nTr 1\nd 1\nnewmtl b\nd 1\nTr 1\n", 1, 1, NULL},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct library libraries[] = {{"a.mtl", rows[i].mtl}, {NULL, NULL}};
        char text[300];
        lam_error error;
        snprintf(text, sizeof text, "mtllib a.mtl\n" TRIANGLE "%s", rows[i].faces);
        AUTO_SCENE scene = load_with(text, (lam_load_params){0}, libraries, &error);
        assert_non_null(scene);
        float a = lam_scene_material(scene, 0)->diffuse.a, b = lam_scene_material(scene, 1)->diffuse.a;
        const char *warning = lam_scene_warning(scene, 0);
        if (a != rows[i].a || b != rows[i].b ||
            (warning ? strcmp(warning, rows[i].warning ? rows[i].warning : "") != 0 : rows[i].warning != NULL))
            fail_msg("row %zu: %g, %g, %s", i, (double)a, (double)b, warning ? warning : "no warning");
        assert_null(lam_scene_warning(scene, warning ? 1 : 0));
    }
}

// --- threads and chunks

#define MIXED                                                                                                          \
    "# a model\nmtllib a.mtl\no thing\n" SQUARE                                                                        \
    "v 2 2 2 0.5 1 0 # coloured\nvt 0 0\nvn 0 0 1\ng one\ns 1\nf 1//1 2//1 "                                           \
    "3//1\nusemtl x\nf -5/1 -4 \\\n -3 -2\nf 1 2 3 \\\n4 5\n\n  f 1/1/1 2/1/1 5/-1/-1\nl 1 2\nv 3 1 4\nf "             \
    "-1 1 2\n"                                                                                                         \
    "o other\ns off\nf 1 2 6\nf 6 5 4 3 2 1\nfoo\nf 1 2\n"

static bool no_companion(const struct import_source *source, const char *name, struct arena *arena,
                         struct companion *out, lam_error *error)
{
    (void)source, (void)arena;
    *out = (struct companion){0};
    snprintf(error->text, sizeof error->text, "%s: none", name);
    error->code = LAM_CANNOT_READ;
    return false;
}

static struct lam_scene *load_chunked(const char *text, size_t size, size_t chunk_bytes, struct pool *pool,
                                      lam_error *error)
{
    struct call_control call;
    static const lam_load_params params;
    call_start(&call, NULL);
    struct file_bytes file;
    assert_true(file_copy(text, size, NULL, &file, error));
    struct import_source source = {.name = "t.obj",
                                   .parts = {.file = -1, .memory = file.data, .size = file.size},
                                   .bytes = file.data,
                                   .size = file.size,
                                   .params = &params,
                                   .pool = pool,
                                   .call = &call,
                                   .open = no_companion};
    struct lam_scene *scene = scene_make(NULL, error);
    if (scene && !obj_load_chunked(&source, scene, chunk_bytes, error)) {
        lam_scene_free(scene);
        scene = NULL;
    }
    file_release(&file);
    return scene;
}

static void expect_equal(const struct lam_scene *a, const struct lam_scene *b)
{
    const lam_mesh *m = lam_scene_mesh(a, 0), *n = lam_scene_mesh(b, 0);
    assert_int_equal(m->triangle_count, n->triangle_count);
    assert_int_equal(m->vertex_count, n->vertex_count);
    assert_int_equal(m->normal_count, n->normal_count);
    assert_int_equal(m->part_count, n->part_count);
    size_t corners = 3 * (size_t)m->triangle_count;
    assert_memory_equal(m->positions, n->positions, 12 * m->vertex_count);
    assert_memory_equal(m->colors, n->colors, 16 * m->color_count);
    assert_memory_equal(m->indices, n->indices, 4 * corners);
    assert_memory_equal(m->normal_indices, n->normal_indices, 4 * corners);
    assert_memory_equal(m->texcoord_indices, n->texcoord_indices, 4 * corners);
    assert_memory_equal(m->normals, n->normals, 12 * m->normal_count);
    assert_memory_equal(m->smoothing_groups, n->smoothing_groups, 4 * m->triangle_count);
    for (uint32_t i = 0; i < m->part_count; i++) {
        assert_string_equal(m->parts[i].name, n->parts[i].name);
        assert_int_equal(m->parts[i].first_triangle, n->parts[i].first_triangle);
    }
    for (int i = 0; lam_scene_warning(a, i) || lam_scene_warning(b, i); i++)
        assert_string_equal(lam_scene_warning(a, i), lam_scene_warning(b, i));
}

TEST(test_threads_and_chunks)
{
    lam_error error;
    static const char text[] = MIXED MIXED MIXED MIXED;
    struct lam_scene *plain = load_chunked(text, strlen(text), 1 << 20, NULL, &error);
    assert_non_null(plain);
    static const int threads[] = {1, 2, 5};
    static const size_t chunks[] = {1, 7, 64, 100, 1000};
    for (int t = 0; t < 3; t++) {
        struct pool *pool = pool_make(threads[t]);
        for (int c = 0; c < 5; c++) {
            struct lam_scene *scene = load_chunked(text, strlen(text), chunks[c], pool, &error);
            assert_non_null(scene);
            expect_equal(plain, scene);
            lam_scene_free(scene);
        }
        // The first error is reported.
        static const char wrong[] = TRIANGLE MIXED "f 1 2 x\nf 1 2 y\nf 1 2 z\n" MIXED "v a\n";
        for (int c = 0; c < 5; c++) {
            assert_null(load_chunked(wrong, strlen(wrong), chunks[c], pool, &error));
            assert_non_null(strstr(error.text, "found 'x', expected a vertex"));
        }
        pool_free(pool);
    }
    lam_scene_free(plain);
}

// Every prefix of a file loads or fails with an error, and so does the file with any one byte changed.
TEST(test_damage)
{
    static const char text[] = MIXED;
    static const char bytes[] = {0, '\n', '\\', '#', '/', '-', ' ', 'f', '9', '\r', (char)0xff};
    for (size_t size = 0; size < sizeof text; size++) {
        lam_error error = {0};
        struct lam_scene *scene = load_chunked(text, size, 50, NULL, &error);
        assert_true(scene || error.text[0]);
        lam_scene_free(scene);
    }
    for (size_t at = 0; at + 1 < sizeof text; at++) {
        for (size_t b = 0; b < sizeof bytes; b++) {
            char copy[sizeof text];
            memcpy(copy, text, sizeof text);
            copy[at] = bytes[b];
            lam_error error = {0};
            struct lam_scene *scene = load_chunked(copy, sizeof text - 1, 50, NULL, &error);
            assert_true(scene || error.text[0]);
            lam_scene_free(scene);
        }
    }
}

TEST(test_memory)
{
    static const struct library libraries[] = {{"a.mtl", "newmtl x\nKd 1 1 1\nmap_Kd -s 1 1 1 a.png\n"}, {NULL, NULL}};
    for (long countdown = 0; countdown < 1000; countdown++) {
        lam_error error = {0};
        arena_fail_after(countdown);
        lam_scene *scene = load_with(MIXED, (lam_load_params){0}, libraries, &error);
        arena_fail_after(-1);
        if (!scene) {
            assert_int_equal(error.code, LAM_MACHINE);
            continue;
        }
        // A warning may be lost if memory is insufficient; all other allocations must succeed.
        bool all = lam_scene_warning(scene, 2) != NULL;
        lam_scene_free(scene);
        if (all)
            return;
    }
    fail();
}

TEST(test_control)
{
    lam_cancel cancel = {0};
    lam_cancel_raise(&cancel);
    lam_error error;
    static const char text[] = TRIANGLE "f 1 2 3\n";
    lam_control control = {.cancel = &cancel};
    assert_null(lam_scene_load_memory(text, strlen(text), "t.obj", NULL, &control, &error));
    assert_int_equal(error.code, LAM_CANCELLED);
    control = (lam_control){.memory_limit_bytes = 1000};
    assert_null(lam_scene_load_memory(text, strlen(text), "t.obj", NULL, &control, &error));
    assert_int_equal(error.code, LAM_LIMIT);
}
