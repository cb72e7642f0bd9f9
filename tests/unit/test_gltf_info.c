// test_gltf_info.c: the information in a glTF file: lam_scene_file_info.
#include "test.h"
#include "gltf_document.h"

// Three corners of a triangle in the plane z = 0.
static void put_triangle(struct document *document)
{
    static const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    *document = (struct document){0};
    put_floats(document, 9, corners);
}

#define MESH                                                                                                           \
    "\"nodes\": [{\"mesh\": 0}], \"meshes\": [{\"primitives\": [{\"attributes\": {\"POSITION\": 0}}]}], %B, "          \
    "\"bufferViews\": [{\"buffer\": 0, \"byteLength\": 36}]"
#define POSITIONS "{\"bufferView\": 0, \"componentType\": 5126, \"count\": 3, \"type\": \"VEC3\"}"

TEST(test_everything)
{
    struct document document;
    put_triangle(&document);
    AUTO_SCENE scene = load_document(
        &document,
        "{\"asset\": {\"version\": \"2.0\", \"generator\": \"by hand\", \"copyright\": \"nobody\"}, " MESH
        ", \"accessors\": [" POSITIONS
        ", {\"componentType\": 5126, \"count\": 2, \"type\": \"SCALAR\", \"max\": [1.5]}, "
        "{\"componentType\": 5126, \"count\": 2, \"type\": \"SCALAR\", \"max\": [0.25]}, "
        "{\"componentType\": 5126, \"count\": 2, \"type\": \"SCALAR\"}], "
        "\"scene\": 1, \"scenes\": [{\"name\": \"empty\"}, {\"nodes\": [0]}], "
        "\"animations\": [{\"name\": \"walk\", \"channels\": [{}, {}], \"samplers\": [{\"input\": 2}, {\"input\": "
        "1}]}, "
        "{\"channels\": [], \"samplers\": [{\"input\": 3}, {\"input\": 99}, {\"input\": -1}, {\"input\": \"x\"}, "
        "{}]}], "
        "\"images\": [{\"uri\": \"skin.png\", \"name\": \"skin\"}, {\"uri\": \"data:image/webp;base64,AA==\"}, "
        "{\"bufferView\": 0, \"mimeType\": \"image/jpeg\"}, {\"uri\": \"noend\"}], "
        "\"extensions\": {\"KHR_materials_variants\": {\"variants\": [{\"name\": \"red\"}, {}]}}, "
        "\"extensionsUsed\": [\"KHR_materials_variants\", \"KHR_materials_dispersion\", \"NONE_such\", \"KHR_xmp\"], "
        "\"extensionsRequired\": [\"KHR_materials_variants\", \"KHR_mesh_quantization\"]}");
    const lam_file_info *info = lam_scene_file_info(scene);
    assert_string_equal(info->version, "2.0");
    assert_string_equal(info->generator, "by hand");
    assert_string_equal(info->copyright, "nobody");
    assert_true(info->scene_count == 2 && info->scene == 1);
    assert_string_equal(info->scenes[0], "empty");
    assert_null(info->scenes[1]);
    assert_int_equal(info->variant_count, 2);
    assert_string_equal(info->variants[0], "red");
    assert_null(info->variants[1]);
    assert_int_equal(info->animation_count, 2);
    assert_string_equal(info->animations[0].name, "walk");
    assert_true(info->animations[0].length_s == 1.5 && info->animations[0].channel_count == 2);
    assert_true(!info->animations[1].name && info->animations[1].length_s == 0);
    static const char *const images[4][3] = {
        {"skin", "skin.png", "png"}, {NULL, NULL, "webp"}, {NULL, NULL, "jpeg"}, {NULL, "noend", NULL}};
    assert_int_equal(info->image_count, 4);
    assert_true(!info->images[0].textures[0] && !info->images[0].textures[1]); // no material uses it
    for (int i = 0; i < 4; i++) {
        const char *found[3] = {info->images[i].name, info->images[i].file, info->images[i].format};
        for (int k = 0; k < 3; k++) {
            assert_int_equal(found[k] == NULL, images[i][k] == NULL);
            if (found[k])
                assert_string_equal(found[k], images[i][k]);
        }
    }
    static const struct {
        const char *name;
        bool required;
        lam_extension_support support;
    } extensions[] = {{"KHR_materials_variants", true, LAM_EXTENSION_READ},
                      {"KHR_materials_dispersion", false, LAM_EXTENSION_IGNORED},
                      {"NONE_such", false, LAM_EXTENSION_UNKNOWN},
                      {"KHR_xmp", false, LAM_EXTENSION_NO_EFFECT},
                      {"KHR_mesh_quantization", true, LAM_EXTENSION_READ}};
    assert_int_equal(info->extension_count, 5);
    for (int i = 0; i < 5; i++) {
        assert_string_equal(info->extensions[i].name, extensions[i].name);
        assert_int_equal(info->extensions[i].required, extensions[i].required);
        assert_int_equal(info->extensions[i].support, extensions[i].support);
    }
    assert_true(lam_scene_memory(scene) > 36 && lam_scene_memory(scene) < 1 << 22);
}

TEST(test_nothing)
{
    struct document document;
    put_triangle(&document);
    lam_scene *scene = load_document(&document, "{\"asset\": {\"version\": \"2.0\", \"generator\": 7}, " MESH
                                                ", \"accessors\": [" POSITIONS "]}");
    const lam_file_info *info = lam_scene_file_info(scene);
    assert_null(info->generator);
    assert_null(info->copyright);
    assert_int_equal(info->scene, -1);
    assert_int_equal(
        info->scene_count + info->variant_count + info->animation_count + info->image_count + info->extension_count, 0);
    lam_scene_free(scene);
    scene = lam_scene_make(NULL);
    info = lam_scene_file_info(scene);
    assert_true(info && !info->version && !info->scene_count && !info->scene);
    lam_scene_free(scene);
    assert_null(lam_scene_file_info(NULL));
    assert_int_equal(lam_scene_memory(NULL), 0);
}
