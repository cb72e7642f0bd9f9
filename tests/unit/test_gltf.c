// test_gltf.c: glTF: containers, buffers, all types of accessors, triangles, nodes, materials, lights, cameras, and
// errors. The file has more than 600 lines because it contains a table-like test for each feature and error message of
// one format.
#include "test.h"
#include "gltf_document.h"

// Four corners of the unit square in the plane z = 0 (48 bytes), and its two triangles as shorts (12 bytes).
static void put_square(struct document *document)
{
    static const float corners[12] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    static const uint16_t indices[6] = {0, 1, 2, 0, 2, 3};
    *document = (struct document){0};
    put_floats(document, 12, corners);
    for (int i = 0; i < 6; i++)
        put_u16(&document->data, indices[i]);
}

#define ASSET "\"asset\": {\"version\": \"2.0\"}"
#define SCENE "\"scenes\": [{\"nodes\": [0]}], \"nodes\": [{\"mesh\": 0}]"
#define VIEWS                                                                                                          \
    "\"bufferViews\": [{\"buffer\": 0, \"byteLength\": 48}, {\"buffer\": 0, \"byteOffset\": 48, \"byteLength\": 12}]"
#define ACCESSORS                                                                                                      \
    "\"accessors\": [{\"bufferView\": 0, \"componentType\": 5126, \"count\": 4, \"type\": \"VEC3\"}, "                 \
    "{\"bufferView\": "                                                                                                \
    "1, \"componentType\": 5123, \"count\": 6, \"type\": \"SCALAR\"}]"
#define MESH   "\"meshes\": [{\"primitives\": [{\"attributes\": {\"POSITION\": 0}, \"indices\": 1}]}]"
#define SQUARE "{" ASSET ", " SCENE ", " MESH ", %B, " VIEWS ", " ACCESSORS "}"

static void check_square(const lam_scene *scene)
{
    const lam_mesh *mesh = lam_scene_mesh(scene, 0);
    assert_string_equal(lam_scene_format(scene), "gltf");
    assert_int_equal(lam_scene_up(scene), LAM_UP_Y);
    assert_int_equal(lam_scene_mesh_count(scene), 1);
    assert_int_equal(lam_scene_object_count(scene), 1);
    assert_int_equal(mesh->vertex_count, 4);
    assert_int_equal(mesh->triangle_count, 2);
    assert_corner(mesh, 0, 2, 1, 1, 0);
    assert_corner(mesh, 1, 2, 0, 1, 0);
    assert_int_equal(lam_scene_object(scene, 0)->cull, LAM_CULL_BACK); // doubleSided is false by default
    assert_false(lam_scene_object(scene, 0)->one_sided);
}

TEST(test_containers)
{
    struct document document;
    struct made file;
    put_square(&document);
    lam_scene *scene = load_document(&document, SQUARE);
    check_square(scene);
    lam_scene_free(scene);
    make_binary(&document, SQUARE, &file);
    scene = load(&file, "a.bin"); // content decides
    check_square(scene);
    lam_scene_free(scene);
    // Bytes after the end, and a byte order mark.
    put_text(&file, "more");
    scene = load(&file, "a.glb");
    assert_string_equal(lam_scene_warning(scene, 0), "a.glb: 4 bytes after the 540 of the file are ignored");
    lam_scene_free(scene);
    char marked[16400];
    snprintf(marked, sizeof marked, "\xef\xbb\xbf\n%s", document.text);
    scene = load_text(marked, "a");
    check_square(scene);
    lam_scene_free(scene);
}

// Zero copy: a float array and 32-bit indices are the file's own bytes.
TEST(test_in_place)
{
    struct document document;
    struct made file;
    put_square(&document);
    document.data.size = 48;
    for (uint32_t i = 0; i < 6; i++)
        put_u32(&document.data, (uint32_t[]){0, 1, 2, 0, 2, 3}[i]);
    make_binary(
        &document,
        "{" ASSET ", " SCENE ", " MESH ", %B, \"bufferViews\": [{\"buffer\": 0, \"byteLength\": 72}], "
        "\"accessors\": [{\"bufferView\": 0, \"componentType\": 5126, \"count\": 4, \"type\": \"VEC3\"}, "
        "{\"bufferView\": 0, \"byteOffset\": 48, \"componentType\": 5125, \"count\": 6, \"type\": \"SCALAR\"}]}",
        &file);
    AUTO_SCENE scene = load(&file, "a.glb");
    check_square(scene);
    const lam_mesh *mesh = lam_scene_mesh(scene, 0);
    assert_ptr_equal((const char *)mesh->indices - (const char *)mesh->positions, (void *)48);
}

// --- accessors

// One attribute of the square in every form.
struct attribute_row {
    const char *accessor; // the accessor's JSON without its view
    const char *view;     // additional keys of the view
    size_t size;
    const uint8_t *bytes;
    const float *expected;
    int count;
};

static lam_scene *load_attribute(const char *name, const char *accessor, const char *view, const void *bytes,
                                 size_t size, const char *material)
{
    struct document document;
    char json[4096];
    put_square(&document);
    put(&document.data, bytes, size);
    snprintf(json, sizeof json,
             "{" ASSET ", " SCENE
             ", \"materials\": [{%s}], \"meshes\": [{\"primitives\": [{\"attributes\": {\"POSITION\": "
             "0, \"%s\": 0, \"%s\": 2}, \"indices\": 1, \"material\": 0}]}], %%B, "
             "\"bufferViews\": [{\"buffer\": 0, \"byteLength\": 48}, {\"buffer\": 0, \"byteOffset\": 48, "
             "\"byteLength\": 12}, {\"buffer\": 0, \"byteOffset\": 60, \"byteLength\": %zu%s}], "
             "\"accessors\": [{\"bufferView\": 0, \"componentType\": 5126, \"count\": 4, \"type\": \"VEC3\"}, "
             "{\"bufferView\": 1, \"componentType\": 5123, \"count\": 6, \"type\": \"SCALAR\"}, "
             "{\"bufferView\": 2, %s}]}",
             material, strcmp(name, "NORMAL") == 0 ? "_OTHER" : "NORMAL", name, size, view, accessor);
    return load_document(&document, json);
}

TEST(test_types)
{
    static const int8_t i8[4][4] = {{0, 0, 127, 0}, {-128, 0, 0, 0}, {127, -127, 64, 0}, {1, 2, 3, 0}};
    static const int16_t i16[4][4] = {{0, 0, 32767, 0}, {-32768, 0, 0, 0}, {32767, -32767, 16384, 0}, {1, 2, 3, 0}};
    lam_scene *scene =
        load_attribute("NORMAL", "\"componentType\": 5120, \"normalized\": true, \"count\": 4, \"type\": \"VEC3\"",
                       ", \"byteStride\": 4", i8, sizeof i8, "");
    const float *n = lam_scene_mesh(scene, 0)->normals;
    for (int i = 0; i < 12; i++)
        assert_true(n[i] == fmaxf((float)i8[i / 3][i % 3] / 127.0f, -1.0f));
    lam_scene_free(scene);
    scene = load_attribute("NORMAL", "\"componentType\": 5122, \"normalized\": true, \"count\": 4, \"type\": \"VEC3\"",
                           ", \"byteStride\": 8", i16, sizeof i16, "");
    n = lam_scene_mesh(scene, 0)->normals;
    for (int i = 0; i < 12; i++)
        assert_true(n[i] == fmaxf((float)i16[i / 3][i % 3] / 32767.0f, -1.0f));
    lam_scene_free(scene);

    static const struct {
        int component, size;
        bool normalized;
        double divisor;
    } rows[] = {{5120, 1, false, 1}, {5120, 1, true, 127},   {5121, 1, false, 1}, {5121, 1, true, 255},
                {5122, 2, false, 1}, {5122, 2, true, 32767}, {5123, 2, false, 1}, {5123, 2, true, 65535}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        uint8_t bytes[16];
        char accessor[200], stride[40];
        double expected[8];
        for (int k = 0; k < 8; k++) { // two numbers of each element; one-byte numbers are four bytes apart
            int value = k * 31 - (rows[i].component % 2 == 0 ? 100 : 0);
            expected[k] = rows[i].normalized ? fmax(value / rows[i].divisor, -1) : value;
            if (rows[i].size == 1)
                bytes[k / 2 * 4 + k % 2] = (uint8_t)value;
            else
                memcpy(bytes + 2 * k, (uint16_t[]){(uint16_t)value}, 2);
        }
        snprintf(accessor, sizeof accessor,
                 "\"componentType\": %d, \"normalized\": %s, \"count\": 4, \"type\": \"VEC2\"", rows[i].component,
                 rows[i].normalized ? "true" : "false");
        snprintf(stride, sizeof stride, ", \"byteStride\": 4");
        scene = load_attribute("TEXCOORD_0", accessor, stride, bytes, 16, "");
        const lam_mesh *mesh = lam_scene_mesh(scene, 0);
        assert_int_equal(mesh->texcoord_count, 4);
        for (int k = 0; k < 8; k++)
            assert_near((double)mesh->texcoords[k], expected[k], 1e-6);
        lam_scene_free(scene);
    }
}

TEST(test_index_types)
{
    static const int components[] = {5121, 5123, 5125};
    for (int i = 0; i < 3; i++) {
        struct document document;
        char json[2000];
        put_square(&document);
        document.data.size = 48;
        for (uint32_t k = 0; k < 6; k++) {
            uint32_t index = (uint32_t[]){0, 1, 2, 0, 2, 3}[k];
            if (i == 0)
                put_u8(&document.data, (uint8_t)index);
            else if (i == 1)
                put_u16(&document.data, (uint16_t)index);
            else
                put_u32(&document.data, index);
        }
        snprintf(
            json, sizeof json,
            "{" ASSET ", " SCENE ", " MESH ", %%B, \"bufferViews\": [{\"buffer\": 0, \"byteLength\": 48}, "
            "{\"buffer\": 0, \"byteOffset\": 48, \"byteLength\": %d}], \"accessors\": [{\"bufferView\": 0, "
            "\"componentType\": 5126, \"count\": 4, \"type\": \"VEC3\"}, {\"bufferView\": 1, \"componentType\": %d, "
            "\"count\": 6, \"type\": \"SCALAR\"}]}",
            6 << i, components[i]);
        AUTO_SCENE scene = load_document(&document, json);
        check_square(scene);
    }
}

// Interleaved, at an offset, and sparse with and without a bufferView.
TEST(test_layouts)
{
    struct document document = {0};
    static const float rows[4][5] = {{9, 0, 0, 0, 9}, {9, 1, 0, 0, 9}, {9, 1, 1, 0, 9}, {9, 0, 1, 0, 9}};
    static const uint16_t indices[6] = {0, 1, 2, 0, 2, 3};
    put_floats(&document, 20, &rows[0][0]);
    for (int i = 0; i < 6; i++)
        put_u16(&document.data, indices[i]);
    lam_scene *scene = load_document(
        &document,
        "{" ASSET ", " SCENE ", " MESH ", %B, \"bufferViews\": [{\"buffer\": 0, \"byteLength\": 80, "
        "\"byteStride\": 20}, {\"buffer\": 0, \"byteOffset\": 80, \"byteLength\": 12}], "
        "\"accessors\": [{\"bufferView\": 0, \"byteOffset\": 4, \"componentType\": 5126, \"count\": 4, "
        "\"type\": \"VEC3\"}, {\"bufferView\": 1, \"componentType\": 5123, \"count\": 6, \"type\": \"SCALAR\"}]}");
    check_square(scene);
    lam_scene_free(scene);

    // Corner 2 moved to (5, 6, 7), and all corners zero except 1 and 3.
    for (int with_base = 0; with_base < 2; with_base++) {
        char json[3000];
        put_square(&document);
        put_u8(&document.data, 1);
        put_u8(&document.data, with_base ? 2 : 3);
        put_u16(&document.data, 0);
        put_floats(&document, 6, (float[]){1, 0, 0, 5, 6, 7});
        snprintf(json, sizeof json,
                 "{" ASSET ", " SCENE ", " MESH ", %%B, \"bufferViews\": [{\"buffer\": 0, \"byteLength\": 48}, "
                 "{\"buffer\": 0, \"byteOffset\": 48, \"byteLength\": 12}, {\"buffer\": 0, \"byteOffset\": 60, "
                 "\"byteLength\": 28}], \"accessors\": [{%s\"componentType\": 5126, \"count\": 4, \"type\": \"VEC3\", "
                 "\"sparse\": {\"count\": 2, \"indices\": {\"bufferView\": 2, \"componentType\": 5121}, "
                 "\"values\": {\"bufferView\": 2, \"byteOffset\": 4}}}, "
                 "{\"bufferView\": 1, \"componentType\": 5123, \"count\": 6, \"type\": \"SCALAR\"}]}",
                 with_base ? "\"bufferView\": 0, " : "");
        scene = load_document(&document, json);
        const lam_mesh *mesh = lam_scene_mesh(scene, 0);
        assert_corner(mesh, 0, 1, 1, 0, 0);
        assert_corner(mesh, 0, 2, with_base ? 5 : 0, with_base ? 6 : 0, with_base ? 7 : 0);
        assert_corner(mesh, 1, 2, with_base ? 0 : 5, with_base ? 1 : 6, with_base ? 0 : 7);
        lam_scene_free(scene);
    }
}

TEST(test_colors)
{
    static const uint8_t bytes[16] = {255, 0, 51, 128, 1, 2, 3, 255, 4, 5, 6, 7, 8, 9, 10, 11};
    static const uint16_t shorts[12] = {65535, 0, 13107, 1, 2, 3, 4, 5, 6, 7, 8, 9};
    static const float floats[16] = {1, 0, 0.25f, 0.5f, 2, -1, NAN, 3, 0, 0, 0, 0, 0, 0, 0, 1};
    const char *blend = "\"alphaMode\": \"BLEND\"";
    lam_scene *scene =
        load_attribute("COLOR_0", "\"componentType\": 5121, \"normalized\": true, \"count\": 4, \"type\": \"VEC4\"", "",
                       bytes, sizeof bytes, blend);
    const lam_mesh *mesh = lam_scene_mesh(scene, 0);
    assert_int_equal(mesh->colors_format, LAM_COLORS_LINEAR8);
    assert_int_equal(mesh->color_count, 4);
    assert_memory_equal(mesh->colors, bytes, sizeof bytes);
    lam_scene_free(scene);
    // An opaque material has no alpha, and ignores the alpha of its vertices.
    scene = load_attribute("COLOR_0", "\"componentType\": 5121, \"normalized\": true, \"count\": 4, \"type\": \"VEC4\"",
                           "", bytes, sizeof bytes, "");
    const uint8_t *eight = lam_scene_mesh(scene, 0)->colors;
    assert_true(eight[0] == 255 && eight[1] == 0 && eight[2] == 51 && eight[3] == 255 && eight[15] == 255);
    lam_scene_free(scene);
    scene = load_attribute("COLOR_0", "\"componentType\": 5121, \"normalized\": true, \"count\": 4, \"type\": \"VEC3\"",
                           ", \"byteStride\": 4", bytes, sizeof bytes, blend);
    eight = lam_scene_mesh(scene, 0)->colors;
    assert_true(eight[4] == 1 && eight[6] == 3 && eight[7] == 255 && eight[3] == 255);
    lam_scene_free(scene);
    scene = load_attribute("COLOR_0", "\"componentType\": 5123, \"normalized\": true, \"count\": 4, \"type\": \"VEC3\"",
                           "", shorts, sizeof shorts, "");
    mesh = lam_scene_mesh(scene, 0);
    const float *c = mesh->colors;
    assert_int_equal(mesh->colors_format, LAM_COLORS_LINEAR_F32);
    assert_true(c[0] == 1 && c[1] == 0 && c[2] == 13107 / 65535.0f && c[3] == 1 && c[4] == 1 / 65535.0f);
    lam_scene_free(scene);
    scene = load_attribute("COLOR_0", "\"componentType\": 5126, \"count\": 4, \"type\": \"VEC4\"", "", floats,
                           sizeof floats, blend);
    c = lam_scene_mesh(scene, 0)->colors;
    assert_true(c[2] == 0.25f && c[3] == 0.5f && c[4] == 2 && c[5] == 0 && c[6] == 0 && c[7] == 1);
    assert_string_equal(lam_scene_warning(scene, 0), "a.gltf: meshes[0].primitives[0].attributes.COLOR_0: 1 of its "
                                                     "numbers are not finite and became 0");
    lam_scene_free(scene);
}

// --- primitives

static lam_scene *load_mode(int mode, int count, const uint16_t *indices, bool indexed)
{
    struct document document = {0};
    char json[2000];
    for (int i = 0; i < 6; i++)
        put_floats(&document, 3, (float[]){(float)(i / 2), (float)(i % 2), 0});
    for (int i = 0; i < count; i++)
        put_u16(&document.data, indices ? indices[i] : 0);
    snprintf(json, sizeof json,
             "{" ASSET ", " SCENE
             ", \"meshes\": [{\"primitives\": [{\"attributes\": {\"POSITION\": 0}, \"mode\": %d%s}]}], "
             "%%B, \"bufferViews\": [{\"buffer\": 0, \"byteLength\": 72}%s], \"accessors\": [{\"bufferView\": 0, "
             "\"componentType\": 5126, \"count\": 6, \"type\": \"VEC3\"}, {%s\"componentType\": 5123, \"count\": %d, "
             "\"type\": \"SCALAR\"}]}",
             mode, indexed ? ", \"indices\": 1" : "",
             indexed ? ", {\"buffer\": 0, \"byteOffset\": 72, \"byteLength\": 40}" : "",
             indexed ? "\"bufferView\": 1, " : "", count);
    while (document.data.size < 112)
        put_u8(&document.data, 0);
    make_text(&document, json);
    lam_error error = {0};
    lam_scene *scene = lam_scene_load_memory(document.text, strlen(document.text), "a.gltf", NULL, NULL, &error);
    if (!scene)
        print_message("%s\n", error.text);
    return scene;
}

static void assert_triangles(const lam_scene *scene, uint32_t count, const uint32_t *corners)
{
    const lam_mesh *mesh = lam_scene_mesh(scene, 0);
    assert_int_equal(mesh->triangle_count, count);
    for (uint32_t i = 0; i < 3 * count; i++)
        assert_int_equal(mesh->indices ? mesh->indices[i] : i, corners[i]);
}

TEST(test_modes)
{
    lam_scene *scene = load_mode(5, 5, (uint16_t[]){0, 1, 2, 3, 4}, true);
    assert_triangles(scene, 3, (uint32_t[]){0, 1, 2, 1, 3, 2, 2, 3, 4});
    lam_scene_free(scene);
    scene = load_mode(6, 5, (uint16_t[]){5, 1, 2, 3, 4}, true);
    assert_triangles(scene, 3, (uint32_t[]){1, 2, 5, 2, 3, 5, 3, 4, 5});
    lam_scene_free(scene);
    // Repeated corners join two strips: the triangles between them are dropped, and the others keep their sides.
    scene = load_mode(5, 8, (uint16_t[]){0, 1, 2, 2, 3, 3, 4, 5}, true);
    assert_triangles(scene, 2, (uint32_t[]){0, 1, 2, 3, 5, 4});
    lam_scene_free(scene);
    scene = load_mode(5, 1, NULL, false);
    assert_triangles(scene, 4, (uint32_t[]){0, 1, 2, 1, 3, 2, 2, 3, 4, 3, 5, 4});
    lam_scene_free(scene);
    scene = load_mode(4, 1, NULL, false);
    assert_triangles(scene, 2, (uint32_t[]){0, 1, 2, 3, 4, 5});
    assert_null(lam_scene_mesh(scene, 0)->indices);
    lam_scene_free(scene);
    scene = load_mode(4, 5, (uint16_t[]){0, 1, 2, 3, 4}, true);
    assert_triangles(scene, 1, (uint32_t[]){0, 1, 2});
    assert_string_equal(lam_scene_warning(scene, 0),
                        "a.gltf: meshes[0].primitives[0]: the last 2 of 5 corners make no triangle");
    lam_scene_free(scene);
}

// Primitives with different attributes are separate meshes, with common data shared.
TEST(test_several_primitives)
{
    struct document document;
    put_square(&document);
    AUTO_SCENE scene = load_document(
        &document,
        "{" ASSET ", \"nodes\": [{\"mesh\": 0, \"name\": \"left\"}, {\"mesh\": 0, \"translation\": [2, 0, 0]}], "
        "\"materials\": [{\"name\": \"one\"}, {\"name\": \"two\", \"doubleSided\": true}], "
        "\"meshes\": [{\"name\": \"pair\", \"primitives\": [{\"attributes\": {\"POSITION\": 0}, \"indices\": 1, "
        "\"material\": 1}, "
        "{\"attributes\": {\"POSITION\": 0, \"NORMAL\": 0}, \"indices\": 1, \"material\": 0}, "
        "{\"attributes\": {\"POSITION\": 0}, \"mode\": 0}, {\"attributes\": {}}]}], "
        "%B, " VIEWS ", " ACCESSORS "}");
    assert_int_equal(lam_scene_mesh_count(scene), 3);
    assert_int_equal(lam_scene_object_count(scene), 6);
    assert_int_equal(lam_scene_point_count(scene), 8);
    assert_ptr_equal(lam_scene_mesh(scene, 0)->positions, lam_scene_mesh(scene, 1)->positions);
    assert_ptr_equal(lam_scene_mesh(scene, 0)->indices, lam_scene_mesh(scene, 1)->indices);
    assert_string_equal(lam_scene_mesh(scene, 1)->name, "pair");
    assert_string_equal(lam_scene_object(scene, 1)->name, "left");
    assert_string_equal(lam_scene_object(scene, 3)->name, "pair");
    assert_int_equal(lam_scene_object(scene, 0)->cull, LAM_CULL_NONE);
    assert_int_equal(lam_scene_object(scene, 1)->cull, LAM_CULL_BACK);
    assert_int_equal(lam_scene_mesh(scene, 0)->parts[0].material, 1);
    assert_int_equal(lam_scene_object(scene, 4)->mesh, 1);
    assert_true(lam_scene_object(scene, 4)->transform.m[0][3] == 2);
    assert_string_equal(lam_scene_warning(scene, 0),
                        "a.gltf: not drawn: primitives without the attribute POSITION (1)");
}

// Two meshes with the same positions, far from zero: each gets its origin, and neither moves the other.
TEST(test_shared_origin)
{
    struct document document = {0};
    for (int i = 0; i < 4; i++)
        put_floats(&document, 3, (float[]){1000 + (float)(i == 1 || i == 2), (float)(i > 1), 0});
    for (int i = 0; i < 6; i++)
        put_u16(&document.data, (uint16_t[]){0, 1, 2, 0, 2, 3}[i]);
    lam_scene *scene =
        load_document(&document, "{" ASSET ", \"nodes\": [{\"mesh\": 0}, {\"mesh\": 1}], \"meshes\": ["
                                 "{\"primitives\": [{\"attributes\": {\"POSITION\": 0}, \"indices\": 1}]}, "
                                 "{\"primitives\": [{\"attributes\": {\"POSITION\": 0}, \"indices\": 1}]}], "
                                 "%B, " VIEWS ", " ACCESSORS "}");
    for (int i = 0; i < 2; i++) {
        assert_true(lam_scene_mesh(scene, i)->origin[0] > 900);
        assert_corner(lam_scene_mesh(scene, i), 0, 1, 1001, 0, 0);
    }
    lam_scene_free(scene);
}

// A file without normals gets flat ones (section 3.7.2.1), unless the caller requests others.
TEST(test_normals)
{
    struct document document = {0};
    static const float corners[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, -1, 0, 0.2f};
    put_floats(&document, 12, corners);
    for (int i = 0; i < 6; i++)
        put_u16(&document.data, (uint16_t[]){0, 1, 2, 0, 2, 3}[i]);
    make_text(&document, SQUARE);
    for (int i = 0; i < 3; i++) {
        lam_load_params params = {.crease_angle_rad = i == 1 ? 1.0 : 0,
                                  .normals = i == 2 ? LAM_NORMALS_SMOOTH : LAM_NORMALS_FILE};
        AUTO_SCENE scene = load_with(document.text, strlen(document.text), "a.gltf", &params);
        const lam_mesh *mesh = lam_scene_mesh(scene, 0);
        const uint32_t *own = mesh->normal_indices ? mesh->normal_indices : mesh->indices;
        const float *a = mesh->normals + 3 * (size_t)own[0], *b = mesh->normals + 3 * (size_t)own[3];
        assert_int_equal(memcmp(a, b, 12) == 0, i > 0);
    }
}

// --- nodes

TEST(test_nodes)
{
    struct document document;
    put_square(&document);
    lam_scene *scene = load_document(
        &document,
        "{" ASSET ", \"scene\": 1, \"scenes\": [{\"name\": \"first\", \"nodes\": [3]}, {\"nodes\": [2]}], \"nodes\": ["
        "{\"mesh\": 0, \"scale\": [2, -3, 4], \"name\": \"leaf\"}, "
        "{\"matrix\": [0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 5, 6, 7, 1], \"children\": [0]}, "
        "{\"translation\": [1, 2, 3], \"rotation\": [0, 0, 1.4142135623730951, 1.4142135623730951], \"children\": [1, "
        "4]}, "
        "{\"mesh\": 0}, {\"mesh\": 0, \"extensions\": {\"KHR_node_visibility\": {\"visible\": false}}}], " MESH
        ", %B, " VIEWS ", " ACCESSORS "}");
    assert_int_equal(lam_scene_object_count(scene), 1);
    const lam_object *object = lam_scene_object(scene, 0);
    assert_string_equal(object->name, "leaf");
    // (x, y, z) → scaled (2x, −3y, 4z) → (4z + 5, −3y + 6, −2x + 7) → turned about z (−y, x) and moved
    static const double expected[3][4] = {{0, 3, 0, -5}, {0, 0, 4, 7}, {-2, 0, 0, 10}};
    for (int i = 0; i < 12; i++)
        assert_near(object->transform.m[i / 4][i % 4], expected[i / 4][i % 4], 1e-12);
    lam_scene_free(scene);
    static const struct {
        const char *wanted;
        int objects;
    } rows[] = {{"first", 1}, {"0", 1}, {"1", 1}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        scene = load_with(document.text, strlen(document.text), "a.gltf", &(lam_load_params){.scene = rows[i].wanted});
        assert_int_equal(lam_scene_object_count(scene), rows[i].objects);
        assert_int_equal(lam_scene_object(scene, 0)->transform.m[0][3] == 0, i < 2);
        lam_scene_free(scene);
    }
    lam_error error;
    assert_null(lam_scene_load_memory(document.text, strlen(document.text), "a.gltf",
                                      &(lam_load_params){.scene = "third"}, NULL, &error));
    assert_string_equal(error.text, "a.gltf: there is no scene 'third'; expected one of 0 ('first'), 1");
}

TEST(test_instances)
{
    struct document document;
    put_square(&document);
    put_floats(&document, 6, (float[]){1, 0, 0, 2, 0, 0});
    put_floats(&document, 6, (float[]){1, 1, 1, 2, 2, 2});
    for (int i = 0; i < 8; i++)
        put_u8(&document.data, (uint8_t[]){0, 0, 0, 127, 0, 127, 0, 0}[i]);
    AUTO_SCENE scene = load_document(
        &document,
        "{" ASSET
        ", \"scenes\": [{\"nodes\": [0]}], \"nodes\": [{\"mesh\": 0, \"translation\": [0, 10, 0], \"extensions\": "
        "{\"EXT_mesh_gpu_instancing\": {\"attributes\": {\"TRANSLATION\": 2, \"SCALE\": 3, \"ROTATION\": 4}}}}], " MESH
        ", %B, \"bufferViews\": [{\"buffer\": 0, \"byteLength\": 48}, {\"buffer\": 0, \"byteOffset\": 48, "
        "\"byteLength\": "
        "12}, {\"buffer\": 0, \"byteOffset\": 60, \"byteLength\": 56}], "
        "\"accessors\": [{\"bufferView\": 0, \"componentType\": 5126, \"count\": 4, \"type\": \"VEC3\"}, "
        "{\"bufferView\": "
        "1, \"componentType\": 5123, \"count\": 6, \"type\": \"SCALAR\"}, "
        "{\"bufferView\": 2, \"componentType\": 5126, \"count\": 2, \"type\": \"VEC3\"}, "
        "{\"bufferView\": 2, \"byteOffset\": 24, \"componentType\": 5126, \"count\": 2, \"type\": \"VEC3\"}, "
        "{\"bufferView\": 2, \"byteOffset\": 48, \"componentType\": 5120, \"normalized\": true, \"count\": 2, "
        "\"type\": "
        "\"VEC4\"}]}");
    assert_int_equal(lam_scene_mesh_count(scene), 1);
    assert_int_equal(lam_scene_object_count(scene), 2);
    const lam_mat4 *a = &lam_scene_object(scene, 0)->transform, *b = &lam_scene_object(scene, 1)->transform;
    assert_true(a->m[0][3] == 1 && a->m[1][3] == 10 && a->m[0][0] == 1);
    assert_true(b->m[0][3] == 2 && b->m[1][3] == 10 && b->m[1][1] == 2 && b->m[0][0] == -2); // half a turn about y
}

// A scale of 0 hides a node; a flat node is omitted with a warning.
TEST(test_zero_scale)
{
    struct document document;
    put_square(&document);
    AUTO_SCENE scene = load_document(
        &document, "{" ASSET ", \"nodes\": [{\"mesh\": 0, \"scale\": [0, 0, 0]}, {\"mesh\": 0, \"scale\": [1, 0, 1]}, "
                   "{\"mesh\": 0}], " MESH ", %B, " VIEWS ", " ACCESSORS "}");
    assert_int_equal(lam_scene_object_count(scene), 1);
    assert_string_equal(lam_scene_warning(scene, 0), "a.gltf: not drawn: meshes flattened by a node's scale of 0 (1)");
}

// --- materials, lights, cameras

static lam_scene *load_more(const char *more, const char *primitive, const lam_load_params *params)
{
    struct document document;
    char json[6000];
    put_square(&document);
    snprintf(
        json, sizeof json,
        "{" ASSET
        ", %s, \"meshes\": [{\"primitives\": [{\"attributes\": {\"POSITION\": 0}, \"indices\": 1%s}]}], %%B, " VIEWS
        ", " ACCESSORS "}",
        more, primitive);
    make_text(&document, json);
    return load_with(document.text, strlen(document.text), "a.gltf", params);
}

TEST(test_materials)
{
    lam_scene *scene = load_more(
        SCENE ", \"materials\": [{\"name\": \"plastic\", \"pbrMetallicRoughness\": {\"baseColorFactor\": [0.5, 0.25, "
              "1, 0.5], "
              "\"metallicFactor\": 0, \"roughnessFactor\": 0.5}, \"emissiveFactor\": [0, 1, 0.5], \"extensions\": "
              "{\"KHR_materials_emissive_strength\": {\"emissiveStrength\": 4}}}, "
              "{\"alphaMode\": \"BLEND\", \"pbrMetallicRoughness\": {\"baseColorFactor\": [1, 0.5, 0, 0.5], "
              "\"roughnessFactor\": 0}}, "
              "{\"extensions\": {\"KHR_materials_unlit\": {}}, \"pbrMetallicRoughness\": {\"baseColorFactor\": [0.1, "
              "0.2, 0.3, 1]}}, "
              "{\"extensions\": {\"KHR_materials_pbrSpecularGlossiness\": {\"diffuseFactor\": [0.1, 0.2, 0.3, 0.4], "
              "\"specularFactor\": [0.5, 0.6, 0.7], \"glossinessFactor\": 0}}, \"alphaMode\": \"MASK\", "
              "\"alphaCutoff\": 0.3}]",
        ", \"material\": 0", NULL);
    assert_int_equal(lam_scene_material_count(scene), 4);
    const lam_material *m = lam_scene_material(scene, 0);
    assert_string_equal(m->name, "plastic");
    assert_true(m->physical && !m->unlit && m->metallic == 0 && m->roughness == 0.5f);
    assert_true(m->diffuse.r == 0.5f && m->diffuse.g == 0.25f && m->ambient.b == 1);
    assert_true(m->diffuse.a == 1 && m->alpha_mode == LAM_ALPHA_OPAQUE);
    assert_true(m->emission.r == 0 && m->emission.g == 4 && m->emission.b == 2);
    m = lam_scene_material(scene, 1);
    assert_true(m->diffuse.a == 0.5f && m->diffuse.g == 0.5f && m->metallic == 1 && m->roughness == 0);
    m = lam_scene_material(scene, 2);
    assert_true(m->unlit && m->diffuse.g == 0.2f);
    // Specular-glossiness: a dielectric that reflects its specular colour, and everything at grazing angles
    m = lam_scene_material(scene, 3);
    assert_true(m->physical && m->roughness == 1 && m->diffuse.a == 0.4f);
    assert_true(m->alpha_mode == LAM_ALPHA_MASK && m->alpha_cutoff == 0.3f);
    assert_true(m->diffuse.b == 0.3f && m->metallic == 0 && m->ior == 0 && m->specular_weight == 1);
    assert_true(m->f0_color.r == 0.5f && m->f0_color.g == 0.6f && m->f0_color.b == 0.7f);
    assert_true(m->specular_glossiness == 1 && lam_scene_material(scene, 0)->specular_glossiness == 0);
    // As a classic material it keeps its values, minus the light that the specular part takes.
    lam_material classic = lam_material_as_classic(m);
    assert_near((double)classic.diffuse.b, 0.3 * (1 - 0.7), 1e-6);
    assert_near((double)classic.specular.r, 0.5 * 9 / 8, 1e-6);
    lam_scene_free(scene);
    // No material: the specification's default, rough white metal.
    scene = load_more(SCENE, "", NULL);
    m = lam_scene_material(scene, lam_scene_mesh(scene, 0)->parts[0].material);
    assert_true(m->physical && m->diffuse.r == 1 && m->metallic == 1 && m->roughness == 1);
    lam_scene_free(scene);
}

// The numbers of the layers' extensions, clamped to their ranges; an unlit material has none.
TEST(test_layers)
{
    static const char layers[] =
        "\"KHR_materials_ior\": {\"ior\": 0}, \"KHR_materials_specular\": {\"specularFactor\": 0.25, "
        "\"specularColorFactor\": [2, 0.5, -1]}, \"KHR_materials_clearcoat\": {\"clearcoatFactor\": 7, "
        "\"clearcoatRoughnessFactor\": 0.5}, \"KHR_materials_sheen\": {\"sheenColorFactor\": [0.5, 0.25, 3], "
        "\"sheenRoughnessFactor\": 0.75}, \"KHR_materials_anisotropy\": {\"anisotropyStrength\": 0.5, "
        "\"anisotropyRotation\": 13.5}, \"KHR_materials_iridescence\": {\"iridescenceFactor\": 0.5, "
        "\"iridescenceIor\": 0.5, \"iridescenceThicknessMinimum\": 50, \"iridescenceThicknessMaximum\": 700}, "
        "\"KHR_materials_transmission\": {\"transmissionFactor\": 0.5}, \"KHR_materials_volume\": "
        "{\"thicknessFactor\": 2, "
        "\"attenuationDistance\": 0.25, \"attenuationColor\": [0.5, 2, 0]}";
    char text[2000];
    snprintf(text, sizeof text,
             "%s, \"materials\": [{\"extensions\": {%s}}, {\"extensions\": {\"KHR_materials_unlit\": {}, %s}}, {}]",
             SCENE, layers, layers);
    AUTO_SCENE scene = load_more(text, ", \"material\": 0", NULL);
    const lam_material *m = lam_scene_material(scene, 0);
    assert_true(m->ior == 0 && m->specular_weight == 0.25f);
    assert_true(m->f0_color.r == 2 && m->f0_color.g == 0.5f && m->f0_color.b == 0);
    assert_true(m->clearcoat == 1 && m->clearcoat_roughness == 0.5f);
    assert_true(m->sheen_color.r == 0.5f && m->sheen_color.g == 0.25f && m->sheen_color.b == 1);
    assert_true(m->sheen_roughness == 0.75f && m->anisotropy == 0.5f);
    assert_near((double)m->anisotropy_rotation_rad, 13.5 - 4 * acos(-1.0), 1e-5); // minus two turns
    assert_true(m->iridescence == 0.5f && m->iridescence_ior == 1 && m->iridescence_thickness_min == 50 &&
                m->iridescence_thickness_max == 700);
    assert_true(m->transmission == 0.5f && m->thickness == 2 && m->attenuation_distance == 0.25f);
    assert_true(m->attenuation_color.r == 0.5f && m->attenuation_color.g == 1 && m->attenuation_color.b == 0);
    assert_non_null(strstr(lam_scene_warning(scene, 0),
                           "materials[0].extensions.KHR_materials_specular.specularColorFactor: found -1, which the "
                           "standard does not allow; 0 is used (and 4 more of this kind)"));
    assert_null(lam_scene_warning(scene, 1));
    for (int i = 1; i < 3; i++) {
        lam_material plain = lam_material_default();
        m = lam_scene_material(scene, i);
        assert_true(m->ior == plain.ior && m->specular_weight == 1 && m->f0_color.g == 1 && m->clearcoat == 0);
        assert_true(m->sheen_color.r == 0 && m->anisotropy == 0 && m->iridescence == 0 && m->transmission == 0);
    }
}

TEST(test_variants)
{
    static const struct {
        const char *variant;
        int material;
    } rows[] = {{NULL, 0}, {"night", 1}, {"1", 1}, {"day", 0}, {"noon", 1}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        AUTO_SCENE scene = load_more(SCENE ", \"materials\": [{}, {}], \"extensions\": {\"KHR_materials_variants\": "
                                           "{\"variants\": [{\"name\": \"day\"}, "
                                           "{\"name\": \"night\"}, {\"name\": \"noon\"}]}}",
                                     ", \"material\": 0, \"extensions\": {\"KHR_materials_variants\": {\"mappings\": "
                                     "[{\"material\": 1, \"variants\": [1, 2]}]}}",
                                     &(lam_load_params){.variant = rows[i].variant});
        assert_int_equal(lam_scene_mesh(scene, 0)->parts[0].material, rows[i].material);
    }
}

TEST(test_lights)
{
    AUTO_SCENE scene = load_more("\"nodes\": [{\"mesh\": 0}, {\"translation\": [1, 2, 3], \"name\": \"bulb\", "
                                 "\"extensions\": {\"KHR_lights_punctual\": "
                                 "{\"light\": 0}}, \"children\": [2]}, {\"rotation\": [0, 0.7071067811865476, 0, "
                                 "0.7071067811865476], \"scale\": [2, 2, "
                                 "2], \"extensions\": {\"KHR_lights_punctual\": {\"light\": 2}}}, "
                                 "{\"extensions\": {\"KHR_lights_punctual\": {\"light\": 1}}}], "
                                 "\"extensions\": {\"KHR_lights_punctual\": {\"lights\": [{\"type\": \"point\", "
                                 "\"color\": [1, 0.5, 0], \"intensity\": 20, "
                                 "\"range\": 5}, {\"type\": \"directional\", \"name\": \"sun\"}, {\"type\": \"spot\", "
                                 "\"intensity\": 3.141592653589793, "
                                 "\"spot\": {\"innerConeAngle\": 0.2, \"outerConeAngle\": 2}}]}}",
                                 "", NULL);
    const double pi = 3.14159265358979323846;
    assert_int_equal(lam_scene_light_count(scene), 3);
    const lam_light *l = lam_scene_light(scene, 0);
    assert_int_equal(l->type, LAM_LIGHT_POINT);
    assert_int_equal(l->frame, LAM_FRAME_MODEL);
    assert_string_equal(l->name, "bulb");
    assert_true(l->position.y == 2 && l->range == 5);
    assert_true(l->attenuation.constant == 0 && l->attenuation.linear == 0 && l->attenuation.quadratic == 1);
    assert_near((double)l->diffuse.r, 20 / pi, 1e-6);
    assert_near((double)l->specular.g, 10 / pi, 1e-6);
    l = lam_scene_light(scene, 1); // a child of the first, rotated to look along −x
    assert_int_equal(l->type, LAM_LIGHT_SPOT);
    assert_near(l->direction.x / sqrt(l->direction.x * l->direction.x + l->direction.z * l->direction.z), -1, 1e-9);
    assert_true(l->position.z == 3 && l->inner_rad == 0.2f);
    assert_near((double)l->outer_rad, pi / 2, 1e-6); // clamped to a right angle
    assert_near((double)l->diffuse.b, 1, 1e-6);
    l = lam_scene_light(scene, 2);
    assert_int_equal(l->type, LAM_LIGHT_DIRECTIONAL);
    assert_string_equal(l->name, "sun");
    assert_true(l->direction.z == -1);
    assert_near((double)l->diffuse.r, 1 / pi, 1e-7);
}

TEST(test_cameras)
{
    AUTO_SCENE scene = load_more(
        "\"nodes\": [{\"mesh\": 0}, {\"translation\": [0, 0, 9], \"camera\": 0, \"name\": \"eye\"}, {\"rotation\": [0, "
        "0.7071067811865476, 0, 0.7071067811865476], \"scale\": [3, 3, 3], \"camera\": 1}, {\"camera\": 2, "
        "\"translation\": [0, 0, 20]}], "
        "\"cameras\": [{\"type\": \"perspective\", \"perspective\": {\"yfov\": 0.5, \"znear\": 0.1, \"zfar\": 100}}, "
        "{\"type\": \"orthographic\", \"name\": \"plan\", \"orthographic\": {\"xmag\": 3, \"ymag\": 2, \"znear\": 0, "
        "\"zfar\": 50}}, "
        "{\"type\": \"perspective\", \"perspective\": {\"yfov\": 1, \"znear\": 0.25}}]",
        "", NULL);
    lam_camera camera;
    assert_int_equal(lam_scene_camera_count(scene), 3);
    assert_string_equal(lam_scene_camera_name(scene, 0), "eye");
    assert_string_equal(lam_scene_camera_name(scene, 1), "plan");
    assert_null(lam_scene_camera_name(scene, 2));
    assert_int_equal(lam_scene_find_camera(scene, "plan"), 1);
    assert_int_equal(lam_scene_find_camera(scene, "2"), 2);
    assert_int_equal(lam_scene_find_camera(scene, "3"), -1);
    assert_int_equal(lam_scene_find_camera(scene, "2x"), -1);
    assert_true(lam_scene_camera(scene, 0, &camera));
    assert_true(camera.eye.z == 9 && camera.target.z == 8 && camera.up.y == 1 && camera.fovy_rad == 0.5);
    assert_true(camera.near_plane == 0.1 && camera.far_plane == 100 && camera.ortho_half_height == 0);
    assert_true(lam_scene_camera(scene, 1, &camera));
    assert_true(camera.ortho_half_height == 2 && camera.near_plane == 0 && camera.far_plane == 50);
    assert_near(camera.target.x, -1, 1e-12);
    assert_true(lam_scene_camera(scene, 2, &camera)); // infinitely far: behind the scene
    assert_true(camera.near_plane == 0.25 && camera.far_plane > 20 && camera.far_plane < 21);
    assert_false(lam_scene_camera(scene, 3, &camera));
}

// --- files next to the model

struct shelf {
    const uint8_t *bytes;
    size_t size;
    char asked[100];
};

static bool open_from_shelf(void *user, const char *name, struct lam_bytes *bytes, lam_error *error)
{
    struct shelf *shelf = user;
    snprintf(shelf->asked, sizeof shelf->asked, "%s", name);
    if (strstr(name, "missing")) {
        *error = (lam_error){LAM_CANNOT_READ, "there is no such file"};
        return false;
    }
    bytes->size = shelf->size;
    bytes->data = malloc(shelf->size);
    memcpy(bytes->data, shelf->bytes, shelf->size);
    return true;
}

TEST(test_files)
{
    struct document document;
    put_square(&document);
    static const struct {
        const char *uri, *asked, *sentence;
        size_t length;
    } rows[] = {
        {"a.bin", "a.bin", NULL, 60},
        {"with%20blank%C3%A9.bin", "with blank\xc3\xa9.bin", NULL, 60},
        {"100%.bin", "100%.bin", NULL, 60},
        {"../../secret.bin", "secret.bin", NULL, 60},
        {"missing.bin", "missing.bin", "a.gltf: buffers[0].uri: there is no such file", 60},
        {"a.bin", "a.bin", "a.gltf: buffers[0].byteLength: found 61, but its data are only 60 bytes", 61},
        {"https://example.org/a.bin", "",
         "a.gltf: buffers[0].uri: found 'https://example.org/a.bin', expected a file beside the model or a data URI",
         60},
        {"data:text/plain,abc", "", "a.gltf: buffers[0].byteLength: found 60, but its data are only 3 bytes", 60},
        {"data:text/plain;base64,AB*C", "",
         "a.gltf: buffers[0].uri: character 25 of the data URI is not of base64 (found '*')", 60},
        {"data:;base64,ABCDE", "", "a.gltf: buffers[0].uri: the data URI is cut: its base64 has 5 characters", 60},
        {"data:none", "", "a.gltf: buffers[0].uri: this data URI lacks the ',' before its data", 60},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char buffer[300], text[16384];
        snprintf(buffer, sizeof buffer, "\"buffers\": [{\"byteLength\": %zu, \"uri\": \"%s\"}]", rows[i].length,
                 rows[i].uri);
        finish_text(SQUARE, buffer, text);
        struct shelf shelf = {document.data.bytes, document.data.size, ""};
        lam_load_params params = {.open = open_from_shelf, .user = &shelf};
        lam_error error = {0};
        AUTO_SCENE scene = lam_scene_load_memory(text, strlen(text), "a.gltf", &params, NULL, &error);
        assert_string_equal(shelf.asked, rows[i].asked);
        assert_string_equal(error.text, rows[i].sentence ? rows[i].sentence : "");
        if (!rows[i].sentence)
            check_square(scene);
    }
}

// --- errors

// The square with one piece of its text replaced.
static void replace(const char *piece, const char *by, struct document *document)
{
    char json[8000];
    const char *at = strstr(SQUARE, piece);
    if (!at)
        fail_msg("no piece '%s'", piece);
    snprintf(json, sizeof json, "%.*s%s%s", (int)(at - SQUARE), SQUARE, by, at + strlen(piece));
    put_square(document);
    make_text(document, json);
}

static void refuse_square(const char *piece, const char *by, lam_code code, const char *sentence)
{
    struct document document;
    char whole[600];
    replace(piece, by, &document);
    snprintf(whole, sizeof whole, "a.gltf%s", sentence);
    refuse(document.text, strlen(document.text), "a.gltf", code, whole);
}

TEST(test_errors)
{
    static const struct {
        const char *piece, *by, *sentence;
        lam_code code;
    } rows[] = {
        {"2.0", "1.0", ": asset.version: this is glTF 1.0, expected glTF 2.0", LAM_UNSUPPORTED},
        {"\"2.0\"", "\"2.1\", \"minVersion\": \"2.1\"",
         ": asset.minVersion: the file needs glTF 2.1, expected at most 2.0 (lam_load_params.lenient reads on)",
         LAM_UNSUPPORTED},
        {ASSET, ASSET ", \"extensionsRequired\": [\"KHR_nothing\"]",
         ": extensionsRequired: the file needs the extension 'KHR_nothing', which this version does not know "
         "(lam_load_params.lenient ignores it)",
         LAM_UNSUPPORTED},
        {"\"POSITION\": 0", "\"POSITION\": 7",
         ": meshes[0].primitives[0].attributes.POSITION: found 7, expected a number from 0 to 1 (accessors)",
         LAM_CANNOT_READ},
        {"\"POSITION\": 0", "\"POSITION\": 0.5",
         ": meshes[0].primitives[0].attributes.POSITION: found 0.5, expected a number from 0 to 1 (accessors)",
         LAM_CANNOT_READ},
        {"\"POSITION\": 0", "\"POSITION\": 1",
         ": meshes[0].primitives[0].attributes.POSITION: found SCALAR of UNSIGNED_SHORT, expected VEC3 of FLOAT, or of "
         "BYTE to UNSIGNED_SHORT",
         LAM_CANNOT_READ},
        {"\"indices\": 1", "\"indices\": 0",
         ": meshes[0].primitives[0].indices: found VEC3 of FLOAT, expected SCALAR of UNSIGNED_BYTE, UNSIGNED_SHORT or "
         "UNSIGNED_INT",
         LAM_CANNOT_READ},
        {"\"count\": 4", "\"count\": 3",
         ": meshes[0].primitives[0].indices: number 5 is 3, expected less than 3, the number of vertices",
         LAM_CANNOT_READ},
        {"\"count\": 4", "\"count\": 5",
         ": accessors[0]: 5 elements from byte 0 on, 12 apart, do not fit the 48 bytes of bufferView 0",
         LAM_CANNOT_READ},
        {"\"count\": 4", "\"count\": 4, \"byteOffset\": 4",
         ": accessors[0]: 4 elements from byte 4 on, 12 apart, do not fit the 48 bytes of bufferView 0",
         LAM_CANNOT_READ},
        {"\"count\": 4", "\"count\": 4, \"byteOffset\": 1e15",
         ": accessors[0]: 4 elements from byte 1000000000000000 on, 12 apart, do not fit the 48 bytes of bufferView 0",
         LAM_CANNOT_READ},
        {"\"count\": 4", "\"count\": 1e18", ": accessors[0].count: found 1e+18, expected a whole number of at least 1",
         LAM_CANNOT_READ},
        {"\"count\": 4", "\"nothing\": 4", ": accessors[0]: count is missing", LAM_CANNOT_READ},
        {"\"componentType\": 5126", "\"componentType\": 5124",
         ": accessors[0].componentType: found 5124, expected 5120, 5121, 5122, 5123, 5125 or 5126 (BYTE, "
         "UNSIGNED_BYTE, "
         "SHORT, UNSIGNED_SHORT, UNSIGNED_INT or FLOAT)",
         LAM_CANNOT_READ},
        {"\"type\": \"VEC3\"", "\"type\": \"VEC5\"",
         ": accessors[0].type: found \"VEC5\", expected SCALAR, VEC2, VEC3, VEC4, MAT2, MAT3 or MAT4", LAM_CANNOT_READ},
        {"\"bufferView\": 0", "\"bufferView\": 2",
         ": accessors[0].bufferView: found 2, expected a number from 0 to 1 (bufferViews)", LAM_CANNOT_READ},
        {"\"byteLength\": 48}", "\"byteLength\": 48, \"byteStride\": 8}",
         ": accessors[0]: its elements are 12 bytes long, but bufferView 0 has byteStride 8", LAM_CANNOT_READ},
        {"\"byteLength\": 48}", "\"byteLength\": 480}",
         ": bufferViews[0]: found bytes 0 to 480, but buffer 0 has only 60", LAM_CANNOT_READ},
        {"\"byteLength\": 48}", "\"byteLength\": -1}",
         ": bufferViews[0].byteLength: found -1, expected a whole number of at least 1", LAM_CANNOT_READ},
        {"\"buffer\": 0, \"byteLength\": 48", "\"buffer\": 1, \"byteLength\": 48",
         ": bufferViews[0].buffer: found 1, expected a number from 0 to 0 (buffers)", LAM_CANNOT_READ},
        {"%B", "\"buffers\": [{\"byteLength\": 60}]",
         ": buffers[0]: found no uri, and the file contains no binary chunk", LAM_CANNOT_READ},
        {"\"mesh\": 0", "\"mesh\": 1",
         ": contains no triangles in its scene; nodes[0].mesh: found 1, expected a number from 0 to 0 (meshes)",
         LAM_CANNOT_READ},
        {"\"POSITION\": 0", "\"NORMAL\": 0",
         ": contains nothing to draw: its primitives (1) have no attribute POSITION", LAM_CANNOT_READ},
        {"\"count\": 6",
         "\"count\": 6, \"sparse\": {\"count\": 1, \"indices\": {\"bufferView\": 0, \"componentType\": 5126}, "
         "\"values\": {\"bufferView\": 0}}",
         ": accessors[1].sparse.indices.componentType: found 5126, expected 5121, 5123 or 5125 (UNSIGNED_BYTE, "
         "UNSIGNED_SHORT or UNSIGNED_INT)",
         LAM_CANNOT_READ},
        {"\"count\": 6",
         "\"count\": 6, \"sparse\": {\"count\": 1, \"indices\": {\"bufferView\": 0, \"byteOffset\": 12, "
         "\"componentType\": 5125}, \"values\": {\"bufferView\": 0}}",
         ": accessors[1].sparse.indices: number 0 is 1065353216, expected less than 6, the accessor's count",
         LAM_CANNOT_READ},
        {ASSET, ASSET ",", ":1: column 30: found ',', expected a key in quotes", LAM_CANNOT_READ},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        refuse_square(rows[i].piece, rows[i].by, rows[i].code, rows[i].sentence);
    // A number that is not finite.
    struct document document;
    put_square(&document);
    memcpy(document.data.bytes + 16, (float[]){INFINITY}, 4);
    make_text(&document, SQUARE);
    AUTO_SCENE scene = load_text(document.text, "a.gltf");
    assert_string_equal(
        lam_scene_warning(scene, 0),
        "a.gltf: 1 vertices have coordinates that are not finite; 1 triangles, lines or points that use "
        "them are left out");
}

// What is wrong but not needed is left out, with one warning.
TEST(test_tolerated)
{
#define LIGHT(light)                                                                                                   \
    "\"mesh\": 0, \"extensions\": {\"KHR_lights_punctual\": {\"light\": 0}}}], \"extensions\": "                       \
    "{\"KHR_lights_punctual\": {\"lights\": [" light "]}}, \"x\": [{"
#define CAMERA(camera)     "\"mesh\": 0, \"camera\": 0}], \"cameras\": [" camera "], \"x\": [{"
#define MATERIAL(material) "\"mesh\": 0}], \"materials\": [" material "], \"x\": [{"
#define WITHOUT            "; drawn without it"
    static const struct {
        const char *piece, *by, *warning; // NULL: no warning
    } rows[] = {
        {"{\"version\": \"2.0\"}", "{}", ": asset.version is missing; the file is read as glTF 2.0"},
        {"2.0", "two", ": asset.version: found \"two\", expected a version such as \"2.0\"" WITHOUT},
        {ASSET, ASSET ", \"materials\": 3", ": materials: found 3, expected a list of objects" WITHOUT},
        {ASSET, ASSET ", \"materials\": null", ": materials: found null, expected a list of objects" WITHOUT},
        {ASSET, ASSET ", \"materials\": [[]]", ": materials[0]: found a list of 0, expected an object, { … }" WITHOUT},
        {ASSET, ASSET ", \"extensions\": 1", ": extensions: found 1, expected an object, { … }" WITHOUT},
        {ASSET, ASSET ", \"extensionsUsed\": [1]",
         ": extensionsUsed[0]: found 1, expected the name of an extension" WITHOUT},
        {ASSET, ASSET ", \"extensionsRequired\": [\"EXT_texture_avif\", \"KHR_mesh_quantization\"]", NULL},
        {ASSET, ASSET ", \"extensionsRequired\": [\"EXT_materials_fur\"]",
         ": extensions that this version does not draw: EXT_materials_fur"},
        {"\"POSITION\": 0", "\"POSITION\": 0, \"TEXCOORD_0\": 0",
         ": meshes[0].primitives[0].attributes.TEXCOORD_0: found VEC3 of FLOAT, expected VEC2 of FLOAT, or of BYTE to "
         "UNSIGNED_SHORT" WITHOUT},
        {"\"POSITION\": 0}", "\"POSITION\": 0, \"NORMAL\": 2}",
         ": meshes[0].primitives[0].attributes.NORMAL: found 2, expected a number from 0 to 1 (accessors)" WITHOUT},
        {"\"indices\": 1", "\"indices\": 1, \"mode\": 7",
         ": meshes[0].primitives[0].mode: found 7, expected a whole number from 0 to 6" WITHOUT},
        {"\"indices\": 1", "\"indices\": 1, \"material\": 0",
         ": meshes[0].primitives[0].material: found 0, but the file has no materials" WITHOUT},
        {"\"indices\": 1", "\"indices\": 1, \"material\": null",
         ": meshes[0].primitives[0].material: found null; drawn as if it were missing"},
        {"\"count\": 4", "\"count\": 4, \"byteOffset\": null",
         ": accessors[0].byteOffset: found null; drawn as if it were missing"},
        {"\"byteLength\": 48}", "\"byteLength\": 48, \"byteStride\": 0}", NULL},
        {"\"mesh\": 0", "\"mesh\": 0, \"name\": 7", ": nodes[0].name: found 7, expected a string" WITHOUT},
        {"\"mesh\": 0", "\"mesh\": 0, \"children\": [0]",
         ": nodes[0]: this node is its own ancestor; it is drawn without a parent"},
        {"\"mesh\": 0", "\"mesh\": 0, \"children\": [1, 1]}, {\"name\": \"x\"",
         ": nodes[0].children[1]: node 1 is a child of node 0 already; it is drawn once"},
        {"\"mesh\": 0", "\"mesh\": 0, \"children\": [\"x\", 7]",
         ": nodes[0].children[0]: found \"x\", expected a number from 0 to 0 (nodes)" WITHOUT
         " (and 1 more of this kind)"},
        {"\"mesh\": 0", "\"mesh\": 0, \"skin\": 0}], \"skins\": [{}], \"x\": [{",
         ": skins[0].joints: expected a list of at least one node" WITHOUT},
        {"\"mesh\": 0", "\"mesh\": 0, \"matrix\": [1, 2]",
         ": nodes[0].matrix: found a list of 2, expected a list of 16 numbers" WITHOUT},
        {"\"mesh\": 0", "\"mesh\": 0, \"matrix\": [1,0,0,1, 0,1,0,0, 0,0,1,0, 0,0,0,1]",
         ": nodes[0].matrix: its last row is 1 0 0 1; 0 0 0 1 is used"},
        {"\"mesh\": 0", "\"mesh\": 0, \"scale\": 1e300",
         ": nodes[0].scale: found 1e+300, expected a list of 3 numbers" WITHOUT},
        {"{\"nodes\": [0]}", "{\"nodes\": [4]}",
         ": scenes[0].nodes[0]: found 4, expected a number from 0 to 0 (nodes)" WITHOUT " (and 1 more of this kind)"},
        {"{\"nodes\": [0]}", "{\"nodes\": []}",
         ": scenes[0].nodes: the scene lists no nodes; all nodes of the file are drawn"},
        {"\"mesh\": 0", LIGHT("{\"type\": \"area\"}"),
         ": extensions.KHR_lights_punctual.lights[0].type: found \"area\", expected directional, point or "
         "spot" WITHOUT},
        {"\"mesh\": 0", LIGHT("{\"type\": \"point\", \"range\": 3.4028234663852886e38}"), NULL},
        {"\"mesh\": 0", LIGHT("{\"type\": \"spot\", \"spot\": {\"innerConeAngle\": 9e99}, \"intensity\": -1}"),
         ": extensions.KHR_lights_punctual.lights[0].intensity: found -1, which the standard does not allow; 0 is "
         "used"},
        {"\"mesh\": 0", LIGHT(""),
         ": nodes[0].extensions.KHR_lights_punctual.light: names none of the file's 0 lights"},
        {"\"mesh\": 0",
         CAMERA("{\"type\": \"perspective\", \"perspective\": {\"yfov\": 1, \"znear\": 1, \"zfar\": 3.4e38}}"), NULL},
        {"\"mesh\": 0",
         CAMERA("{\"type\": \"perspective\", \"perspective\": {\"yfov\": 1, \"znear\": 1, \"zfar\": 0.5}}"),
         ": cameras[0].perspective.zfar: found 0.5, expected more than znear, 1; drawn without it"},
        {"\"mesh\": 0", CAMERA("{\"type\": \"perspective\", \"perspective\": {\"yfov\": -1, \"znear\": 1}}"),
         ": cameras[0].perspective: yfov is missing or wrong (-1)" WITHOUT},
        {"\"mesh\": 0", CAMERA("{}"), ": cameras[0]: type is missing" WITHOUT},
        {"\"mesh\": 0", MATERIAL("{\"alphaMode\": \"GLASS\"}"),
         ": materials[0].alphaMode: found \"GLASS\", expected OPAQUE, MASK or BLEND" WITHOUT},
        {"\"mesh\": 0", MATERIAL("{\"normalTexture\": {\"index\": 0}}, {\"normalTexture\": {\"index\": 0}}"),
         ": materials[0].normalTexture.index: found 0, but the file has no textures" WITHOUT
         " (and 1 more of this kind)"},
        {"\"mesh\": 0",
         MATERIAL("{\"extensions\": {\"KHR_materials_emissive_strength\": {\"emissiveStrength\": 1e40}}}"),
         ": materials[0].extensions.KHR_materials_emissive_strength.emissiveStrength: found 1e+40; 1e+30 is used"},
        {"\"mesh\": 0",
         MATERIAL(
             "{\"emissiveTexture\": {\"index\": 0}}, {\"emissiveTexture\": {\"index\": 1}}], \"textures\": [{}, {}"),
         ": textures[0]: source is missing; drawn without this texture (and 1 more of this kind)"},
        {"\"mesh\": 0",
         MATERIAL("{\"emissiveTexture\": {\"index\": 0}}], \"textures\": [{\"extensions\": {\"KHR_texture_basisu\": "
                  "{\"source\": 0}}}], \"images\": [{}"),
         ": textures[0]: its only picture is KTX 2 (KHR_texture_basisu), which this version cannot decode; drawn "
         "without it"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct document document;
        char whole[600];
        replace(rows[i].piece, rows[i].by, &document);
        snprintf(whole, sizeof whole, "a.gltf%s", rows[i].warning ? rows[i].warning : "");
        if (rows[i].warning)
            warn_once(document.text, strlen(document.text), "a.gltf", NULL, whole);
        AUTO_SCENE scene = load_text(document.text, "a.gltf");
        check_square(scene);
        assert_true(rows[i].warning || !lam_scene_warning(scene, 0));
    }
}

TEST(test_binary_errors)
{
    struct document document;
    struct made file, other;
    put_square(&document);
    make_binary(&document, SQUARE, &file);
    static const struct {
        size_t at;
        uint32_t value;
        const char *sentence;
        lam_code code;
    } rows[] = {
        {4, 1, "a.glb: byte 4: this is binary glTF 1.0, expected glTF 2.0", LAM_UNSUPPORTED},
        {8, 10000, "a.glb: the file is truncated: its header declares 10000 bytes, found 540", LAM_CANNOT_READ},
        {8, 19, "a.glb: byte 8: the header declares 19 bytes, expected at least 20", LAM_CANNOT_READ},
        {12, 5000, "a.glb: byte 12: chunk 0 declares 5000 bytes, but only 520 are left in the file", LAM_CANNOT_READ},
        {16, 0x004e4942, "a.glb: byte 16: the first chunk is of type 0x004e4942, expected the JSON text (0x4e4f534a)",
         LAM_CANNOT_READ},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        other = file;
        memcpy(other.bytes + rows[i].at, &rows[i].value, 4);
        refuse(other.bytes, other.size, "a.glb", rows[i].code, rows[i].sentence);
    }
    refuse(file.bytes, 15, "a.glb", LAM_CANNOT_READ,
           "a.glb: the file is truncated: found 15 bytes, expected at least 20");
    check_prefixes(file.bytes, file.size, "a.glb");
    check_allocations(file.bytes, file.size, "a.glb");
    assert_same_for_threads(file.bytes, file.size, "a.glb");
    make_text(&document, SQUARE);
    check_prefixes(document.text, strlen(document.text), "a.gltf");
    check_allocations(document.text, strlen(document.text), "a.gltf");
}

TEST(test_lenient)
{
    struct document document;
    put_square(&document);
    make_text(&document,
              "{" ASSET ", \"extensionsRequired\": [\"KHR_nothing\"], \"extensionsUsed\": [\"KHR_nothing\"], " SCENE
              ", " MESH ", %B, " VIEWS ", " ACCESSORS "}");
    lam_scene *scene = load_with(document.text, strlen(document.text), "a.gltf", &(lam_load_params){.lenient = true});
    check_square(scene);
    assert_string_equal(lam_scene_warning(scene, 0), "a.gltf: extensions that this version does not draw: KHR_nothing");
    lam_scene_free(scene);
    static const struct {
        const char *piece, *by, *warning;
    } rows[] = {
        {"\"2.0\"", "\"2.1\", \"minVersion\": \"2.1\"", NULL},
        {"2.0", "3.0", NULL},
        {"\"primitives\": [", "\"primitives\": [{\"attributes\": {\"POSITION\": 7}}, ",
         "a.gltf: meshes[0].primitives[0].attributes.POSITION: found 7, expected a number from 0 to 1 (accessors); "
         "drawn "
         "without it"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        lam_error error = {0};
        replace(rows[i].piece, rows[i].by, &document);
        assert_null(lam_scene_load_memory(document.text, strlen(document.text), "a.gltf", NULL, NULL, &error));
        scene = load_with(document.text, strlen(document.text), "a.gltf", &(lam_load_params){.lenient = true});
        check_square(scene);
        if (rows[i].warning)
            assert_string_equal(lam_scene_warning(scene, 0), rows[i].warning);
        lam_scene_free(scene);
    }
    replace("\"POSITION\": 0", "\"POSITION\": 7", &document); // nothing is left
    lam_error error = {0};
    assert_null(lam_scene_load_memory(document.text, strlen(document.text), "a.gltf",
                                      &(lam_load_params){.lenient = true}, NULL, &error));
    assert_string_equal(error.text, "a.gltf: contains no triangles in its scene; meshes[0].primitives[0].attributes."
                                    "POSITION: found 7, expected a number from 0 to 1 (accessors)");
}

// A long file read in parallel pieces gives the same mesh with any number of threads, and the first error.
TEST(test_threads)
{
    enum { VERTICES = 20000 };
    size_t size = 28 + 600 + VERTICES * 20;
    uint8_t *file = calloc(1, size);
    char *json = (char *)file + 20;
    int length = sprintf(json,
                         "{" ASSET ", " SCENE
                         ", \"meshes\": [{\"primitives\": [{\"attributes\": {\"POSITION\": 0, \"TEXCOORD_0\": 1, "
                         "\"COLOR_0\": 2}}]}], \"buffers\": [{\"byteLength\": %d}], \"bufferViews\": [{\"buffer\": 0, "
                         "\"byteLength\": %d, "
                         "\"byteStride\": 20}], \"accessors\": [{\"bufferView\": 0, \"componentType\": 5126, "
                         "\"count\": %d, \"type\": \"VEC3\"}, "
                         "{\"bufferView\": 0, \"byteOffset\": 12, \"componentType\": 5123, \"normalized\": true, "
                         "\"count\": %d, \"type\": "
                         "\"VEC2\"}, {\"bufferView\": 0, \"byteOffset\": 16, \"componentType\": 5121, \"normalized\": "
                         "true, \"count\": %d, "
                         "\"type\": \"VEC3\"}]}",
                         VERTICES * 20, VERTICES * 20, VERTICES, VERTICES, VERTICES);
    while (length % 4)
        json[length++] = ' ';
    uint32_t header[5] = {0x46546c67, 2, (uint32_t)(28 + length + VERTICES * 20), (uint32_t)length, 0x4e4f534a};
    memcpy(file, header, 20);
    memcpy(json + length, (uint32_t[]){VERTICES * 20, 0x004e4942}, 8);
    uint8_t *rows = (uint8_t *)json + length + 8;
    for (int i = 0; i < VERTICES; i++) {
        memcpy(rows + 20 * i, (float[]){(float)(i * 7 % 100), (float)(i * 13 % 101), (float)(i % 17)}, 12);
        memcpy(rows + 20 * i + 12, (uint16_t[]){(uint16_t)(i * 3), (uint16_t)(i * 5)}, 4);
        memcpy(rows + 20 * i + 16, (uint32_t[]){(uint32_t)i * 77}, 4);
    }
    assert_same_for_threads(file, header[2], "a.glb");
    memcpy(rows + 20 * 19000, (float[]){NAN}, 4);
    memcpy(rows + 20 * 9000 + 4, (float[]){NAN}, 4);
    assert_same_for_threads(file, header[2], "a.glb");
    free(file);
}
