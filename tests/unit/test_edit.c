// test_edit.c: replacing, hiding and removing meshes and objects: the pictures equal the pictures of a scene built in
// the final form.

#include "test.h"
#include "device_fixture.h"
#include "temporary_folder.h"

enum { SIZE = 96, BYTES = SIZE * SIZE * 4 };

static int add(lam_scene *scene, const char *shape, double x)
{
    lam_object object = lam_object_default();
    object.name = shape;
    object.mesh = lam_scene_add_shape(scene, shape, &(lam_shape_params){.slices = 24, .stacks = 12}, NULL);
    object.transform.m[0][3] = x;
    object.transform.m[1][0] = 0.25; // not a transform that maps boxes to boxes
    return lam_scene_add_object(scene, &object, NULL);
}

// Distant points, which change the boxes and the size of all points.
static int add_points(lam_scene *scene)
{
    static const float positions[] = {5, 5, 5, 5, 6, 5, 6, 5, 5};
    lam_object object = lam_object_default();
    object.mesh =
        lam_scene_add_mesh(scene, &(lam_mesh){.positions = positions, .vertex_count = 3, .point_count = 3}, NULL);
    return lam_scene_add_object(scene, &object, NULL);
}

static uint8_t *draw(const lam_scene *scene)
{
    lam_error error;
    uint8_t *bytes = malloc(BYTES);
    assert_non_null(bytes);
    lam_image image = {.width = SIZE, .height = SIZE, .format = LAM_RGBA8, .pixels = bytes};
    lam_camera camera = lam_camera_fit(scene, SIZE, SIZE, NULL);
    lam_draw_params params = {.samples = 1, .shadows = true, .ground = LAM_GROUND_CHECKER, .wireframe = true};
    SUCCEEDS(lam_draw(device, scene, &camera, &params, &image, NULL, &error));
    return bytes;
}

// Compares the pictures of two scenes, drawn alternately by one device, and frees `expected`.
static void same(const lam_scene *scene, lam_scene *expected)
{
    uint8_t *found = draw(scene), *wanted = draw(expected);
    assert_memory_equal(found, wanted, BYTES);
    free(found);
    free(wanted);
    lam_scene_free(expected);
}

static lam_scene *scene_of(const char *first, const char *second)
{
    lam_scene *scene = lam_scene_make(NULL);
    assert_non_null(scene);
    if (first)
        assert_true(add(scene, first, -1.25) >= 0);
    if (second)
        assert_true(add(scene, second, 1.25) >= 0);
    return scene;
}

TEST(hidden_is_absent)
{
    AUTO_SCENE scene = scene_of("torus", "cube");
    int points = add_points(scene);
    uint8_t *whole = draw(scene);
    assert_true(lam_scene_hide_object(scene, points, true, NULL));
    same(scene, scene_of("torus", "cube"));
    assert_true(lam_scene_hide_object(scene, 0, true, NULL));
    same(scene, scene_of(NULL, "cube"));
    assert_true(lam_scene_hide_object(scene, 0, false, NULL));
    assert_true(lam_scene_hide_mesh(scene, 1, true, NULL));
    same(scene, scene_of("torus", NULL));
    assert_true(lam_scene_hide_mesh(scene, 1, false, NULL));
    assert_true(lam_scene_hide_object(scene, points, false, NULL));
    uint8_t *again = draw(scene);
    assert_memory_equal(whole, again, BYTES);
    lam_object object = *lam_scene_object(scene, 0);
    object.hidden = true;
    assert_true(lam_scene_set_object(scene, 0, &object, NULL) && lam_scene_hide_object(scene, points, true, NULL));
    same(scene, scene_of(NULL, "cube"));
    free(whole);
    free(again);
}

TEST(all_hidden_is_empty)
{
    AUTO_SCENE scene = scene_of("torus", NULL);
    lam_scene_hide_object(scene, 0, true, NULL);
    lam_vec3 low, high, centre;
    double radius;
    assert_false(lam_scene_bounds(scene, &low, &high));
    assert_false(lam_scene_sphere(scene, -1, &centre, &radius));
    same(scene, scene_of(NULL, NULL));
}

TEST(removed_is_absent)
{
    AUTO_SCENE scene = scene_of("torus", "cube");
    assert_true(lam_scene_remove_object(scene, 0, NULL));
    assert_int_equal(lam_scene_object_count(scene), 1);
    same(scene, scene_of(NULL, "cube"));
    assert_true(lam_scene_remove_mesh(scene, 0, NULL)); // no object uses it
    assert_int_equal(lam_scene_mesh_count(scene), 1);
    assert_int_equal(lam_scene_object(scene, 0)->mesh, 0);
    same(scene, scene_of(NULL, "cube"));
    assert_true(add(scene, "torus", -1.25) == 1);
    assert_true(lam_scene_remove_mesh(scene, 0, NULL)); // with its object
    assert_int_equal(lam_scene_object_count(scene), 1);
    same(scene, scene_of("torus", NULL));
}

TEST(replaced_is_the_new_one)
{
    lam_scene *scene = scene_of("torus", "cube"), *other = scene_of("sphere", "cone");
    uint64_t memory = 0;
    for (int i = 0; i < 40; i++) { // addresses are reused: new data must not be mistaken for old data
        assert_true(lam_scene_set_mesh(scene, 0, lam_scene_mesh(other, i & 1), NULL));
        same(scene, scene_of(i & 1 ? "cone" : "sphere", "cube"));
        if (i == 1)
            memory = lam_scene_memory(scene);
    }
    assert_true(lam_scene_memory(scene) == memory);                            // nothing of the replaced meshes remains
    assert_true(lam_scene_set_mesh(scene, 0, lam_scene_mesh(scene, 0), NULL)); // by itself
    same(scene, scene_of("cone", "cube"));
    assert_true(lam_scene_remove_mesh(scene, 0, NULL));
    same(scene, scene_of(NULL, "cube"));
    lam_scene_free(other);
    lam_scene_free(scene);
}

// Far from zero and without normals, it gets an origin and smooth normals, like an added mesh.
TEST(replaced_as_added)
{
    const float positions[] = {4000, 4000, 0, 4001, 4000, 0, 4000, 4001, 0, 4000, 4000, 1};
    const uint32_t indices[] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2};
    const lam_mesh mesh = {.positions = positions, .vertex_count = 4, .indices = indices, .triangle_count = 4};
    lam_scene *scene = scene_of("torus", NULL), *expected = lam_scene_make(NULL);
    lam_object object = *lam_scene_object(scene, 0);
    object.mesh = lam_scene_add_mesh(expected, &mesh, NULL);
    lam_scene_add_object(expected, &object, NULL);
    assert_true(lam_scene_set_mesh(scene, 0, &mesh, NULL));
    assert_true(lam_scene_mesh(scene, 0)->normals && lam_scene_mesh(scene, 0)->origin[0] != 0);
    same(scene, expected);
    lam_scene_free(scene);
}

TEST(mark_brings_back)
{
    lam_scene *scene = scene_of("torus", "cube"), *other = scene_of("sphere", "cone");
    assert_true(lam_scene_set_mesh(scene, 1, lam_scene_mesh(other, 0), NULL)); // before the mark
    assert_true(lam_scene_mark(scene, NULL));
    for (int i = 0; i < 3; i++) {
        assert_true(lam_scene_set_mesh(scene, 1, lam_scene_mesh(other, 1), NULL));
        assert_true(lam_scene_hide_object(scene, 0, true, NULL));
        same(scene, scene_of(NULL, "cone"));
        assert_true(lam_scene_remove_mesh(scene, i & 1, NULL));
        assert_true(lam_scene_reset(scene, NULL));
        same(scene, scene_of("torus", "sphere"));
    }
    lam_scene_free(other);
    lam_scene_free(scene);
}

static void refused(bool ok, const lam_error *error, const char *text)
{
    assert_false(ok);
    assert_int_equal(error->code, LAM_BAD_ARGUMENT);
    assert_string_equal(error->text, text);
}

TEST(bad_arguments)
{
    lam_error error;
    AUTO_SCENE scene = scene_of("torus", "cube");
    const float infinite[] = {0, 0, 0, 1, 0, 0, 0, 1.0f / 0.0f, 0};
    refused(lam_scene_set_mesh(scene, 2, lam_scene_mesh(scene, 0), &error), &error, "mesh: 2 of 2");
    refused(lam_scene_set_mesh(scene, 0, NULL, &error), &error, "mesh: the mesh is NULL");
    refused(lam_scene_set_mesh(scene, 0, &(lam_mesh){.positions = infinite, .vertex_count = 3, .triangle_count = 1},
                               &error),
            &error, "mesh: positions contain a number that is not finite");
    refused(lam_scene_hide_object(scene, -1, true, &error), &error, "object: -1 of 2");
    refused(lam_scene_hide_mesh(scene, 2, true, &error), &error, "mesh: 2 of 2");
    refused(lam_scene_remove_object(scene, 2, &error), &error, "object: 2 of 2");
    refused(lam_scene_remove_mesh(scene, -1, &error), &error, "mesh: -1 of 2");
    refused(lam_scene_remove_mesh(NULL, 0, &error), &error, "mesh: the scene is NULL");
    same(scene, scene_of("torus", "cube")); // nothing has changed
}

TEST(scene_files)
{
    lam_error error;
    strcpy(folder, "/tmp/lambent-edit-XXXXXX");
    assert_non_null(mkdtemp(folder));
    const char *path = in_folder("scene.json");
    AUTO_SCENE scene = scene_of("torus", "cube");
    assert_true(lam_scene_hide_object(scene, 0, true, NULL));
    const lam_picture_settings settings = {.draw = {.ground = LAM_GROUND_CHECKER}}; // draw() has a ground
    assert_true(lam_scene_save(scene, &settings, path, &error));
    lam_scene *read = lam_scene_load(path, NULL, NULL, &error);
    assert_non_null(read);
    assert_int_equal(lam_scene_object_count(read), 1);
    same(scene, read);
    assert_true(lam_scene_set_mesh(scene, 1, lam_scene_mesh(scene, 0), NULL));
    assert_false(lam_scene_save(scene, NULL, path, &error));
    assert_int_equal(error.code, LAM_UNSUPPORTED);
    assert_non_null(strstr(error.text, "object 1 ('cube')"));
    remove_folder(NULL);
}

FIXTURE(set_up, tear_down)
