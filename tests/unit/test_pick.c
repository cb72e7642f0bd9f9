// test_pick.c: lam_pick finds the same surface at a pixel's centre as lam_explain and the picture.

#include "test.h"
#include "device_fixture.h"

enum { WIDTH = 60, HEIGHT = 44, STEP = 5 }; // pixels between two compared ones

static int add(lam_scene *scene, const char *shape, double x, int material)
{
    lam_object object = lam_object_default();
    object.mesh = lam_scene_add_shape(scene, shape, &(lam_shape_params){.slices = 24, .stacks = 12}, NULL);
    object.transform = lam_mat4_rotation((lam_vec3){1, 2, 3}, 1.0 + x);
    object.transform.m[0][3] = x;
    object.material = material;
    return lam_scene_add_object(scene, &object, NULL);
}

static int material_of(lam_scene *scene, lam_alpha_mode mode, float alpha)
{
    lam_material material = lam_material_default();
    material.alpha_mode = mode;
    material.diffuse.a = alpha;
    material.alpha_cutoff = 0.5f;
    return lam_scene_add_material(scene, &material, NULL);
}

// The fragment of an explained pixel that is nearest to the eye.
static const lam_explained_fragment *nearest(const lam_explanation *e, const lam_camera *camera, double *distance)
{
    const lam_explained_fragment *found = NULL;
    *distance = 1e308;
    for (int i = 0; i < e->fragment_count; i++) {
        lam_vec3 p = e->fragments[i].points[0].world_position, eye = camera->eye;
        double away =
            sqrt((p.x - eye.x) * (p.x - eye.x) + (p.y - eye.y) * (p.y - eye.y) + (p.z - eye.z) * (p.z - eye.z));
        if (!e->fragments[i].ground && e->fragments[i].color.a > 0 && away < *distance) {
            *distance = away;
            found = &e->fragments[i];
        }
    }
    return found;
}

// Compares the pixels of a grid, except pixels on an edge, where rounding decides. Returns how many show a surface.
static int compare(const lam_scene *scene, const lam_camera *camera)
{
    lam_error error = {0};
    const lam_draw_params params = {.samples = 1};
    int surfaces = 0, others = 0;
    for (int y = 0; y < HEIGHT; y += STEP)
        for (int x = 0; x < WIDTH; x += STEP) {
            const lam_pick_pixel pixel = {.width = WIDTH, .height = HEIGHT, .x = x, .y = y};
            lam_picked picked;
            SUCCEEDS(lam_pick(scene, camera, &params, &pixel, NULL, &picked, &error));
            lam_explanation *e =
                lam_explain(device, scene, camera, &params, WIDTH, HEIGHT, LAM_RGBA8, x, y, NULL, &error);
            assert_non_null(e);
            double distance;
            const lam_explained_fragment *fragment = nearest(e, camera, &distance);
            surfaces += fragment != NULL;
            bool same = fragment ? picked.object == fragment->object && picked.triangle == fragment->triangle &&
                                       picked.mesh == fragment->mesh
                                 : picked.object == -1;
            if (same && fragment && camera->ortho_half_height == 0)
                same = fabs(picked.distance - distance) < 2e-3;
            if (same && fragment) {
                lam_vec3 p = fragment->points[0].world_position, q = picked.position;
                same = fabs(p.x - q.x) + fabs(p.y - q.y) + fabs(p.z - q.z) < 5e-3;
            }
            others += !same;
            if (!same)
                print_error("(%d, %d): object %d triangle %u at %g, expected object %d triangle %u at %g\n", x, y,
                            picked.object, picked.triangle, picked.distance, fragment ? fragment->object : -1,
                            fragment ? fragment->triangle : 0, distance);
            lam_explanation_free(e);
        }
    if (others > 1)
        fail_msg("%d of %d pixels differ", others, WIDTH * HEIGHT / STEP / STEP);
    return surfaces;
}

TEST(as_explained)
{
    AUTO_SCENE scene = lam_scene_make(NULL);
    int glass = material_of(scene, LAM_ALPHA_BLEND, 0.25f), hole = material_of(scene, LAM_ALPHA_MASK, 0.25f),
        clear = material_of(scene, LAM_ALPHA_BLEND, 0);
    add(scene, "torus", -1.5, -1);
    add(scene, "sphere", 0.25, -1);
    add(scene, "cube", 1, glass);
    int masked = add(scene, "sphere", 0.75, hole), invisible = add(scene, "sphere", 0.75, clear);
    lam_camera camera = lam_camera_fit(scene, WIDTH, HEIGHT, NULL);
    int surfaces = compare(scene, &camera);
    assert_true(surfaces > 15);
    const lam_view flat = {.orthographic = true, .from_angles = true, .azimuth_rad = 2, .elevation_rad = -0.5};
    lam_camera orthographic = lam_camera_fit(scene, WIDTH, HEIGHT, &flat);
    assert_true(compare(scene, &orthographic) > 15);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) { // culled surfaces are not found
            lam_picked picked;
            assert_true(
                lam_pick(scene, &camera, NULL, &(lam_pick_pixel){WIDTH, HEIGHT, x, y, {0}}, NULL, &picked, NULL));
            assert_true(picked.object != masked && picked.object != invisible);
        }
    lam_scene_hide_object(scene, 1, true, NULL);
    assert_true(compare(scene, &camera) < surfaces);
    lam_object object = *lam_scene_object(scene, 0);
    object.cull = LAM_CULL_FRONT;
    object.transform.m[1][1] *= -1; // and mirrored
    assert_true(lam_scene_set_object(scene, 0, &object, NULL));
    assert_true(compare(scene, &camera) > 5);
}

TEST(lines_and_points)
{
    const float positions[] = {-1, -1, 0, 1, 1, 0, -1, 1, 0, 1, -1, 0, 0, 0.7f, 0};
    AUTO_SCENE scene = lam_scene_make(NULL);
    lam_object object = lam_object_default();
    object.mesh =
        lam_scene_add_mesh(scene, &(lam_mesh){.positions = positions, .vertex_count = 4, .line_count = 2}, NULL);
    lam_scene_add_object(scene, &object, NULL);
    object.mesh =
        lam_scene_add_mesh(scene, &(lam_mesh){.positions = positions, .vertex_count = 5, .point_count = 5}, NULL);
    int points = lam_scene_add_object(scene, &object, NULL);
    lam_camera camera = lam_camera_fit(scene, WIDTH, HEIGHT, NULL);
    assert_true(compare(scene, &camera) > 5);
    camera = (lam_camera){.eye = {0, 0.7, 5}, .target = {0, 0.7, 0}, .up = {0, 1, 0}, .fovy_rad = 0.5};
    lam_picked picked;
    assert_true(lam_pick(scene, &camera, NULL, &(lam_pick_pixel){41, 41, 20, 20, {0}}, NULL, &picked, NULL));
    assert_int_equal(picked.object, points);
    assert_int_equal(picked.triangle, 4);
}

static void refused(lam_scene *scene, lam_camera camera, lam_pick_pixel pixel, const char *text)
{
    lam_error error = {0};
    lam_picked picked;
    assert_false(lam_pick(scene, &camera, NULL, &pixel, NULL, &picked, &error));
    assert_int_equal(error.code, LAM_BAD_ARGUMENT);
    assert_non_null(strstr(error.text, text));
}

TEST(bad_arguments)
{
    AUTO_SCENE scene = lam_scene_make(NULL);
    add(scene, "cube", 0, -1);
    lam_camera camera = lam_camera_fit(scene, WIDTH, HEIGHT, NULL), nowhere = camera;
    nowhere.fovy_rad = 4;
    refused(scene, camera, (lam_pick_pixel){10, 10, 10, 3, {0}}, "the pixel (10, 3) lies outside");
    refused(scene, camera, (lam_pick_pixel){10, 10, 3, -1, {0}}, "the pixel (3, -1) lies outside");
    refused(scene, camera, (lam_pick_pixel){0, 10, 0, 0, {0}}, "0×10 pixels");
    refused(scene, camera, (lam_pick_pixel){10, 10, 1, 1, {1}}, "does not know");
    refused(scene, nowhere, (lam_pick_pixel){10, 10, 1, 1, {0}}, "fovy");
    refused(NULL, camera, (lam_pick_pixel){10, 10, 1, 1, {0}}, "scene is NULL");
    lam_cancel cancel = {0};
    lam_cancel_raise(&cancel);
    lam_error error;
    lam_picked picked;
    assert_false(lam_pick(scene, &camera, NULL, &(lam_pick_pixel){10, 10, 5, 5, {0}}, &(lam_control){.cancel = &cancel},
                          &picked, &error));
    assert_int_equal(error.code, LAM_CANCELLED);
}

FIXTURE(set_up, tear_down)
