// test_export.c: lam_scene_export: wrong arguments, files, losses, and a mesh with all attributes of a vertex.

#include "test.h"

static lam_scene *quad(bool by_triangle)
{
    static const float positions[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, texcoords[] = {0, 0, 1, 0, 1, 1, 0, 1},
                       normals[] = {0, 0, 1};
    static const uint32_t indices[] = {0, 1, 2, 0, 2, 3}, zeros[6];
    static const uint8_t colors[] = {255, 0, 0, 255, 0, 255, 0, 128, 9, 8, 7, 6, 1, 2, 3, 255};
    lam_mesh mesh = {.name = "quad",
                     .positions = positions,
                     .vertex_count = 4,
                     .indices = indices,
                     .triangle_count = 2,
                     .normals = normals,
                     .normal_count = 1,
                     .normal_indices = zeros,
                     .texcoords = texcoords,
                     .texcoord_count = 4,
                     .colors = colors,
                     .color_count = by_triangle ? 2 : 4,
                     .colors_format = LAM_COLORS_SRGB8,
                     .colors_rate = by_triangle ? LAM_PER_TRIANGLE : LAM_PER_VERTEX};
    lam_error error;
    lam_scene *scene = lam_scene_make(&error);
    lam_object object = lam_object_default();
    object.mesh = lam_scene_add_mesh(scene, &mesh, &error);
    assert_true(object.mesh >= 0 && lam_scene_add_object(scene, &object, &error) >= 0);
    return scene;
}

TEST(test_arguments)
{
    lam_error error;
    lam_scene *scene = quad(false), *empty = lam_scene_make(&error);
    assert_null(lam_scene_export(NULL, "glb", NULL, &error));
    assert_int_equal(error.code, LAM_BAD_ARGUMENT);
    assert_null(lam_scene_export(scene, NULL, NULL, &error));
    assert_null(lam_scene_export(scene, "fbx", NULL, &error));
    assert_int_equal(error.code, LAM_UNSUPPORTED);
    lam_export_params newer = {0};
    newer.reserved[0] = 1;
    assert_null(lam_scene_export(scene, "glb", &newer, &error));
    assert_int_equal(error.code, LAM_BAD_ARGUMENT);
    lam_image picture = {.width = 1, .height = 1, .pixels = "abcd"};
    lam_export_params thumbnail = {.thumbnail = &picture};
    assert_null(lam_scene_export(scene, "obj", &thumbnail, &error));
    assert_int_equal(error.code, LAM_BAD_ARGUMENT);
    for (int i = 0; lam_export_format(i); i++) {
        assert_null(lam_scene_export(empty, lam_export_format(i), NULL, &error));
        assert_int_equal(error.code, LAM_BAD_ARGUMENT);
    }
    assert_null(lam_export_format(-1));
    lam_export_free(NULL);
    lam_scene_free(scene);
    lam_scene_free(empty);
}

// Exports and reads again: the same triangles, in a file named after the model.
TEST(test_round_trips)
{
    lam_error error;
    for (int by_triangle = 0; by_triangle < 2; by_triangle++) {
        AUTO_SCENE scene = quad(by_triangle);
        for (int i = 0; lam_export_format(i); i++) {
            const char *format = lam_export_format(i);
            lam_export_params params = {.name = "a.b"};
            lam_export *result = lam_scene_export(scene, format, &params, &error);
            assert_non_null(result);
            const char *name = lam_export_file_name(result, 0);
            assert_memory_equal(name, "a.", 2);
            assert_string_equal(name + 2, format);
            lam_bytes bytes = lam_export_file(result, 0);
            AUTO_SCENE again = lam_scene_load_memory(bytes.data, bytes.size, name, NULL, NULL, &error);
            assert_non_null(again);
            assert_int_equal(lam_scene_triangle_count(again), 2);
            bool colored = lam_scene_mesh(again, 0)->colors != NULL;
            assert_int_equal(colored, strcmp(format, "stl") != 0);
            assert_null(lam_export_file_name(result, -1));
            assert_null(lam_export_loss(result, 1000));
            assert_null(lam_export_file(result, 1000).data);
            lam_export_free(result);
        }
    }
}

// A camera that is written can be read again: planes that are missing are fitted to the scene, and a camera that is too
// far away is left out, with a sentence.
TEST(test_cameras)
{
    static const struct {
        double near_plane, far_plane, ortho_half_height;
        int cameras, losses;
    } rows[] = {{0.5, 9, 0, 1, 0}, {0, 0, 0, 1, 1}, {0, 9, 0, 1, 1},       {0.5, 0, 0, 1, 0}, {0, 0, 2, 1, 1},
                {0, 9, 2, 1, 0},   {9, 0, 2, 1, 1}, {1e31, 1e32, 0, 0, 1}, {1, 1e31, 2, 0, 1}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        lam_error error = {0};
        AUTO_SCENE scene = quad(false);
        lam_camera camera = lam_camera_default();
        camera.near_plane = rows[i].near_plane;
        camera.far_plane = rows[i].far_plane;
        camera.ortho_half_height = rows[i].ortho_half_height;
        lam_export *result = lam_scene_export(scene, "glb", &(lam_export_params){.camera = &camera}, &error);
        assert_non_null(result);
        int losses = 0;
        for (int k = 0; lam_export_loss(result, k); k++)
            losses += strstr(lam_export_loss(result, k), "cameras") != NULL;
        assert_int_equal(losses, rows[i].losses);
        lam_bytes bytes = lam_export_file(result, 0);
        AUTO_SCENE again = lam_scene_load_memory(bytes.data, bytes.size, "a.glb", NULL, NULL, &error);
        if (!again)
            fail_msg("row %zu: %s", i, error.text);
        assert_int_equal(lam_scene_camera_count(again), rows[i].cameras);
        lam_export_free(result);
    }
}
