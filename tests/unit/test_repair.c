// test_repair.c: vertices that are not finite and normals without a direction, in every format (scene_repair.c).
#include "test.h"
#include "gltf_document.h"

// The unit square in the plane z = 0. Its other vertices, 4 and 5, are not finite or not used.
#define PLY(VERTICES, FACES, MORE)                                                                                     \
    "ply\nformat ascii 1.0\nelement vertex " VERTICES "\nproperty float x\nproperty float y\nproperty float z\n" MORE  \
    "element face " FACES "\nproperty list uchar int vertex_indices\n"
#define CLOUD                                                                                                          \
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"                  \
    "property float nx\nproperty float ny\nproperty float nz\nend_header\n"
#define NORMAL_WORDS "property float nx\nproperty float ny\nproperty float nz\n"
#define OBJ_SQUARE   "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"

static const struct row {
    const char *name, *text;
    int vertices, items;  // named in the warning; 0 vertices: no warning
    int triangles, other; // drawn: triangles, and lines or points
} rows[] = {
    {"a.obj", OBJ_SQUARE "v nan 0 0\nv 0 inf 0\nf 1 2 3 4\n", 2, 0, 2, 0},
    {"a.obj", OBJ_SQUARE "v nan 0 0\nv 0 1e39 0\nf 1 2 3 4\nf 1 2 5 3 4\nf 1 2 6\n", 2, 4, 2, 0},
    {"a.obj", OBJ_SQUARE "v 0 0 -inf\nl 1 2 5 3 4\n", 1, 2, 0, 2},
    {"a.obj", OBJ_SQUARE "v 0 0 -inf\np 1 2 5 3 4\n", 1, 1, 0, 4},
    {"a.obj", "v 0 0 0\nv nan nan nan\nv 1 0 0\n", 1, 1, 0, 2},
    {"a.obj", "v 5e6 0 0\nv 5000001 0 0\nv 5e6 1 0\nv nan 0 1e39\nf 1 2 3\nf 1 2 4\n", 1, 1, 1, 0}, // with an origin
    {"a.ply", PLY("5", "2", "") "end_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\ninf 0 0\n4 0 1 2 3\n4 0 1 4 3\n", 1, 2, 2, 0},
    {"a.ply", PLY("4", "1", "") "end_header\n5e6 0 0\n5000001 0 0\n5e6 1 0\nnan 0 0\n3 0 1 2\n", 1, 0, 1, 0},
    {"a.ply", CLOUD "0 0 0 0 0 1\n1 -inf 0 0 0 1\n0 1 0 0 0 1\n", 1, 1, 0, 2},
    {"a.stl",
     "solid a\nfacet outer loop vertex 0 0 0 vertex 1 0 0 vertex 1 1 0 endloop endfacet\nfacet outer loop vertex "
     "0 0 0 vertex 1 nan 1e39 vertex 1 1 0 endloop endfacet endsolid a\nsolid b\nfacet outer loop vertex 0 0 1 "
     "vertex 1 0 1 vertex 1 1 1 endloop endfacet\nendsolid b\n",
     1, 1, 2, 0},
    {"a.stl",
     "solid a\nfacet outer loop vertex 5e6 0 0 vertex 5000001 0 0 vertex 5e6 1 0 endloop endfacet\nfacet outer "
     "loop vertex nan 0 0 vertex 1 0 0 vertex 1 1 0 endloop endfacet endsolid a\n",
     1, 1, 1, 0},
};

TEST(test_positions)
{
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        for (int threads = 1; threads <= 3; threads += 2) {
            const struct row *row = &rows[i];
            lam_scene *scene =
                load_with(row->text, strlen(row->text), row->name, &(lam_load_params){.threads = threads});
            char expected[256];
            snprintf(
                expected, sizeof expected,
                "%s: %d vertices have coordinates that are not finite; %d triangles, lines or points that use them "
                "are left out",
                row->name, row->vertices, row->items);
            assert_string_equal(lam_scene_warning(scene, 0), expected);
            assert_null(lam_scene_warning(scene, 1));
            uint32_t triangles = 0, other = 0;
            for (int m = 0; m < lam_scene_mesh_count(scene); m++) {
                const lam_mesh *mesh = lam_scene_mesh(scene, m);
                triangles += mesh->triangle_count;
                other += mesh->line_count + mesh->point_count;
                uint32_t parts = 0;
                for (uint32_t p = 0; p < mesh->part_count; p++)
                    parts += mesh->parts[p].triangle_count;
                assert_true(!mesh->part_count || parts == mesh->triangle_count + mesh->line_count + mesh->point_count);
                for (uint32_t v = 0; v < 3 * mesh->vertex_count; v++)
                    assert_true(isfinite(mesh->positions[v]));
            }
            assert_int_equal(triangles, row->triangles);
            assert_int_equal(other, row->other);
            lam_vec3 low, high;
            assert_true(lam_scene_bounds(scene, &low, &high) && high.x - low.x <= 1 && high.y - low.y <= 1);
            lam_scene_free(scene);
        }
}

// Colours, smoothing groups, materials and texture coordinates stay with their triangles.
TEST(test_attributes)
{
    lam_scene *scene = load_text(PLY("5", "3", "") "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                                                   "end_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\ninf 0 0\n3 0 1 2 1 2 3\n"
                                                   "3 0 1 4 4 5 6\n3 0 2 3 7 8 9\n",
                                 "a.ply");
    static const uint8_t colors[] = {1, 2, 3, 255, 7, 8, 9, 255};
    assert_int_equal(lam_scene_mesh(scene, 0)->color_count, 2);
    assert_memory_equal(lam_scene_mesh(scene, 0)->colors, colors, sizeof colors);
    lam_scene_free(scene);
    scene = load_text(OBJ_SQUARE "v nan 0 0\nvt 0 0\nvt 1 0\nvt 0 1\ns 1\ng a\nf 1/1 2/2 5/3\nf 1/1 2/2 3/3\ng b\ns 2\n"
                                 "f 1/3 2/2 5/1\nf 1/2 3/3 4/1\n",
                      "a.obj");
    const lam_mesh *mesh = lam_scene_mesh(scene, 0);
    static const uint32_t texcoords[] = {0, 1, 2, 1, 2, 0}, groups[] = {1, 2};
    assert_memory_equal(mesh->texcoord_indices, texcoords, sizeof texcoords);
    assert_memory_equal(mesh->smoothing_groups, groups, sizeof groups);
    assert_int_equal(mesh->part_count, 2);
    assert_int_equal(mesh->parts[1].first_triangle, 1);
    assert_int_equal(mesh->parts[1].triangle_count, 1);
    lam_scene_free(scene);
}

// All normals of the square's corners are (0, 0, 1), except the file's own where `own` is set.
TEST(test_normals)
{
    static const struct {
        const char *name, *text;
        int bad, all; // in the warning
        bool own;     // corner 0 has the normal (1, 0, 0)
    } cases[] = {
        {"a.obj", OBJ_SQUARE "vn 0 0 0\nf 1//1 2//1 3//1 4//1\n", 1, 1, false},
        {"a.obj", OBJ_SQUARE "vn nan 0 1\nvn 2 0 0\nf 1//2 2//1 3//1 4//1\n", 1, 2, true},
        {"a.obj", OBJ_SQUARE "vn 0 0 0\nvn 2 0 0\nf 1//2 2 3//1\nf 1//2 3//1 4//1\n", 1, 2, true},
        {"a.obj", OBJ_SQUARE "vn 1e-30 0 0\nvn 0 0 1e30\nf 1//1 2//2 3//2 4//2\n", 0, 0, true},
        {"a.ply",
         PLY("4", "1", NORMAL_WORDS) "end_header\n0 0 0 0 0 0\n1 0 0 0 0 -0\n1 1 0 0 0 0\n0 1 0 0 0 0\n4 0 1 2 3\n", 4,
         4, false},
        {"a.ply",
         PLY("4", "1", NORMAL_WORDS) "end_header\n0 0 0 7 0 0\n1 0 0 0 0 inf\n1 1 0 0 0 0\n0 1 0 0 0 1\n4 0 1 2 3\n", 2,
         4, true},
        {"a.ply", PLY("4", "1", "") NORMAL_WORDS "end_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3 0 nan 0\n", 1, 1,
         false},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        AUTO_SCENE scene = load_text(cases[i].text, cases[i].name);
        const lam_mesh *mesh = lam_scene_mesh(scene, 0);
        char expected[200];
        snprintf(expected, sizeof expected,
                 "%s: %d of %d normals are zero or not finite; they are computed, or left out for lines and points",
                 cases[i].name, cases[i].bad, cases[i].all);
        if (cases[i].bad)
            assert_string_equal(lam_scene_warning(scene, 0), expected);
        assert_null(lam_scene_warning(scene, cases[i].bad != 0));
        for (uint32_t c = 0; c < 3 * mesh->triangle_count; c++) {
            uint32_t element = mesh->normal_indices ? mesh->normal_indices[c] : mesh->indices[c];
            const float *n = mesh->normals + 3 * (size_t)element;
            double length = sqrt((double)(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]));
            bool own = cases[i].own && mesh->indices[c] == 0;
            assert_near((double)n[own ? 0 : 2] / length, 1, 1e-6);
        }
    }
}

// Points without a normal become a mesh without normals, which is unlit.
TEST(test_points)
{
    lam_scene *scene = load_text(CLOUD "0 0 0 0 0 1\n1 0 0 nan 0 1\n0 1 0 1 0 0\n", "a.ply");
    assert_int_equal(lam_scene_object_count(scene), 2);
    assert_int_equal(lam_scene_mesh(scene, 0)->point_count, 2);
    assert_non_null(lam_scene_mesh(scene, 0)->normals);
    assert_int_equal(lam_scene_mesh(scene, 1)->point_count, 1);
    assert_null(lam_scene_mesh(scene, 1)->normals);
    assert_int_equal(lam_scene_mesh(scene, 1)->indices[0], 1);
    lam_scene_free(scene);
    scene = load_text(CLOUD "0 0 0 0 0 0\n1 0 0 0 0 0\n0 1 0 0 0 0\n", "a.ply");
    assert_int_equal(lam_scene_object_count(scene), 1);
    assert_null(lam_scene_mesh(scene, 0)->normals);
    lam_scene_free(scene);
}

// Texture coordinates of vertices, and of the corners of faces.
TEST(test_texcoords)
{
    static const char *const texts[] = {
        PLY("4", "1", "property float s\nproperty float t\n") "end_header\n0 0 0 nan 1\n1 0 0 1 0\n1 1 0 1 -inf\n0 1 0 "
                                                              "0 1\n4 0 1 2 3\n",
        PLY("4", "1", "") "property list uchar float texcoord\n"
                          "end_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3 8 nan 1 1 0 1 -inf 0 1\n"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        AUTO_SCENE scene = load_text(texts[i], "a.ply");
        assert_string_equal(lam_scene_warning(scene, 0), "a.ply: 2 texture coordinates are not finite and become 0");
        assert_null(lam_scene_warning(scene, 1));
        const float *st = lam_scene_mesh(scene, 0)->texcoords;
        assert_true(st[0] == 0 && st[1] == 0 && st[2] == 1 && st[4] == 0 && st[5] == 0 && st[7] == 1);
    }
}

// glTF: meshes that share their vertices; normals as floats and as normalised bytes; flat normals replace missing ones.
TEST(test_gltf)
{
    for (int bytes = 0; bytes < 2; bytes++)
        for (int bad = 0; bad < 2; bad++) {
            static const float corners[15] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 9, 9, 0};
            struct document document = {0};
            put_floats(&document, 15, corners);
            if (bad)
                memcpy(document.data.bytes + 48, (float[]){NAN}, 4);
            for (int i = 0; i < 15; i++)
                put_u32(&document.data, 0); // the normals
            static const uint16_t indices[10] = {0, 1, 2, 0, 2, 3, 0, 1, 4, 0};
            for (int i = 0; i < 10; i++)
                put_u16(&document.data, indices[i]);
            char json[2048];
            snprintf(
                json, sizeof json,
                "{\"asset\": {\"version\": \"2.0\"}, \"scenes\": [{\"nodes\": [0]}], \"nodes\": [{\"mesh\": 0}], "
                "\"meshes\": [{\"primitives\": [{\"attributes\": {\"POSITION\": 0, \"NORMAL\": 1}, \"indices\": 2}, "
                "{\"attributes\": {\"POSITION\": 0, \"NORMAL\": 1}, \"indices\": 3}]}], %%B, \"bufferViews\": "
                "[{\"buffer\": 0, \"byteLength\": 60}, {\"buffer\": 0, \"byteOffset\": 60, \"byteLength\": 60%s}, "
                "{\"buffer\": 0, \"byteOffset\": 120, \"byteLength\": 20}], \"accessors\": [{\"bufferView\": 0, "
                "\"componentType\": 5126, \"count\": 5, \"type\": \"VEC3\"}, {\"bufferView\": 1, \"componentType\": "
                "%s, \"count\": 5, \"type\": \"VEC3\"}, {\"bufferView\": 2, \"componentType\": 5123, \"count\": 6, "
                "\"type\": \"SCALAR\"}, {\"bufferView\": 2, \"byteOffset\": 12, \"componentType\": 5123, \"count\": 3, "
                "\"type\": \"SCALAR\"}]%s}",
                bytes ? ", \"byteStride\": 12" : "", bytes ? "5120, \"normalized\": true" : "5126",
                bytes ? ", \"extensionsUsed\": [\"KHR_mesh_quantization\"], \"extensionsRequired\": "
                        "[\"KHR_mesh_quantization\"]"
                      : "");
            make_text(&document, json);
            AUTO_SCENE scene = load_text(document.text, "a.gltf");
            assert_int_equal(lam_scene_mesh(scene, 0)->triangle_count, 2);
            assert_int_equal(lam_scene_mesh(scene, 1)->triangle_count, !bad);
            assert_true(lam_scene_mesh(scene, 0)->normals[2] == 1);
            assert_string_equal(
                lam_scene_warning(scene, bad),
                "a.gltf: 5 of 5 normals are zero or not finite; they are computed, or left out for lines "
                "and points");
            assert_null(lam_scene_warning(scene, bad + 1));
        }
}
