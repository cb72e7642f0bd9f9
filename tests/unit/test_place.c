// test_place.c: the sphere around a scene, moving and rotating it, rigs at their positions, lights in the model's
// frame, and materials of parts.

#include "test.h"

static const double PI_HALF = 1.57079632679489661923;

static lam_scene *shape_scene(const char *shape, double radius)
{
    lam_error error;
    lam_scene *scene = lam_scene_make(&error);
    assert_non_null(scene);
    lam_object object = lam_object_default();
    object.name = shape;
    object.mesh = lam_scene_add_shape(scene, shape, &(lam_shape_params){.radius = radius}, &error);
    assert_true(object.mesh >= 0);
    assert_int_equal(lam_scene_add_object(scene, &object, &error), 0);
    return scene;
}

static void near(double found, double expected, double most)
{
    if (!(fabs(found - expected) <= most))
        fail_msg("found %.12g, expected %.12g within %g", found, expected, most);
}

TEST(sphere_is_the_models)
{
    lam_scene *scene = shape_scene("sphere", 2.5);
    lam_object object = *lam_scene_object(scene, 0);
    object.transform.m[0][3] = 7;
    object.transform.m[1][1] = 3; // in world space, it is three times as high
    assert_true(lam_scene_set_object(scene, 0, &object, NULL));
    lam_vec3 centre;
    double radius;
    assert_true(lam_scene_sphere(scene, 0, &centre, &radius)); // in its own space, it is the sphere itself
    near(radius, 2.5, 1e-6);
    near(centre.x, 0, 1e-6);
    assert_true(lam_scene_sphere(scene, -1, &centre, &radius));
    near(radius, 7.5, 1e-5);
    near(centre.x, 7, 1e-5);
    assert_false(lam_scene_sphere(scene, 1, &centre, &radius));
    assert_true(radius == 0);
    lam_scene_free(scene);
    AUTO_SCENE empty = lam_scene_make(NULL);
    assert_false(lam_scene_sphere(empty, -1, &centre, &radius));
}

// A curve of points in the order along it, the same in a scattered order, and with other vertex numbers and an unused
// point far away. The search for the points that determine the camera visits few points of the first, all of the
// second, and boxes of another size in the third, and must find the same.
TEST(camera_does_not_depend_on_the_order)
{
    enum { COUNT = 36000, UNUSED = 5000, ORDERS = 3 };
    static float points[ORDERS][3 * (COUNT + 1)] = {[2] = {[3 * UNUSED] = 100}};
    static uint32_t indices[COUNT];
    for (int i = 0; i < COUNT; i++) {
        double a = i * 0.0007, r = 1 + 0.3 * sin(i * 0.0057);
        const float p[3] = {(float)(3 + r * cos(a)), (float)(0.4 * sin(3 * a) + 0.1 * r), (float)(r * sin(a) - 2)};
        memcpy(points[0] + 3 * i, p, sizeof p);
        memcpy(points[1] + (size_t)3 * ((size_t)i * 7919 % COUNT), p, sizeof p);
        indices[i] = (uint32_t)i + (i >= UNUSED);
        memcpy(points[2] + 3 * indices[i], p, sizeof p);
    }
    for (int turn = 0; turn < 12; turn++) {
        lam_camera cameras[ORDERS];
        for (int order = 0; order < ORDERS; order++) {
            lam_error error;
            AUTO_SCENE scene = lam_scene_make(&error);
            lam_mesh mesh = {.positions = points[order], .vertex_count = COUNT, .triangle_count = COUNT / 3};
            if (order == 2) {
                mesh.vertex_count++;
                mesh.indices = indices;
            }
            lam_object object = lam_object_default();
            object.mesh = lam_scene_add_mesh(scene, &mesh, &error);
            object.transform.m[0][1] = 0.25;
            object.transform.m[2][2] = turn % 3 ? 1 : -2;
            assert_true(object.mesh >= 0 && lam_scene_add_object(scene, &object, &error) >= 0);
            lam_view view = {.from_angles = true,
                             .azimuth_rad = 0.5 * turn,
                             .elevation_rad = 0.3 * turn - 1.5,
                             .orthographic = turn % 4 == 3};
            int width = turn % 2 ? 340 : 120, height = 200;
            cameras[order] = lam_camera_fit(scene, width, height, &view);
            // In addition, every point is inside the picture, and some point touches its border.
            lam_mat4 look = lam_camera_view_matrix(&cameras[order]);
            double farthest = 0;
            for (int i = 0; i < COUNT; i++) {
                const float *p = points[0] + 3 * i;
                double w[3] = {(double)p[0] + 0.25 * (double)p[1], (double)p[1],
                               (double)p[2] * object.transform.m[2][2]};
                double e[3];
                for (int k = 0; k < 3; k++)
                    e[k] = look.m[k][0] * w[0] + look.m[k][1] * w[1] + look.m[k][2] * w[2] + look.m[k][3];
                double half =
                    view.orthographic ? cameras[order].ortho_half_height : -e[2] * tan(cameras[order].fovy_rad / 2);
                double x = fabs(e[0]) / (half * width / height), y = fabs(e[1]) / half;
                farthest = fmax(farthest, fmax(x, y));
            }
            near(farthest, 0.92, 1e-5);
        }
        for (int order = 1; order < ORDERS; order++)
            assert_memory_equal(&cameras[0], &cameras[order], sizeof cameras[0]);
    }
}

// A scene with the given corners, as separate triangles of a strip.
static lam_scene *scene_of_points(const float *points, uint32_t count)
{
    lam_scene *scene = lam_scene_make(NULL);
    lam_mesh mesh = {.positions = points, .vertex_count = count, .triangle_count = count / 3};
    lam_object object = lam_object_default();
    object.mesh = lam_scene_add_mesh(scene, &mesh, NULL);
    assert_true(object.mesh >= 0 && lam_scene_add_object(scene, &object, NULL) >= 0);
    return scene;
}

// The smallest and largest projected coordinate on each axis; the picture is −1 to 1.
static void projected(const lam_camera *camera, int width, int height, const float *points, int count, double low[2],
                      double high[2])
{
    lam_mat4 view = lam_camera_view_matrix(camera);
    low[0] = low[1] = (double)INFINITY;
    high[0] = high[1] = -(double)INFINITY;
    for (int i = 0; i < count; i++) {
        const float *p = points + 3 * i;
        double e[3];
        for (int k = 0; k < 3; k++)
            e[k] =
                view.m[k][0] * (double)p[0] + view.m[k][1] * (double)p[1] + view.m[k][2] * (double)p[2] + view.m[k][3];
        double half = camera->ortho_half_height > 0 ? camera->ortho_half_height : -e[2] * tan(camera->fovy_rad / 2);
        const double at[2] = {e[0] / (half * width / height), e[1] / half};
        for (int k = 0; k < 2; k++) {
            low[k] = fmin(low[k], at[k]);
            high[k] = fmax(high[k], at[k]);
        }
    }
}

// Every vertex is inside the picture for any shape, and the vertices fill 92 % of the tighter side.
TEST(camera_fits_the_picture)
{
    static const int sizes[][2] = {{300, 600}, {600, 300}, {1, 1000}, {1000, 1}, {256, 256}};
    static const float points[] = {-1, 0, 0.5f, 2, 0.25f, -1, 0, 1.5f, 0, 0.5f, -0.75f, 1, 1, 1, 1, -0.5f, 0.5f, -2};
    AUTO_SCENE scene = scene_of_points(points, 6);
    for (size_t i = 0; i < 2 * sizeof sizes / sizeof *sizes; i++) {
        int width = sizes[i / 2][0], height = sizes[i / 2][1];
        lam_camera camera = lam_camera_fit(scene, width, height, &(lam_view){.orthographic = i % 2});
        double low[2], high[2];
        projected(&camera, width, height, points, 6, low, high);
        near(fmax(high[0] - low[0], high[1] - low[1]) / 2, 0.92, 1e-9);
        for (int k = 0; k < 2; k++)
            assert_true(low[k] >= -0.92 - 1e-9 && high[k] <= 0.92 + 1e-9);
    }
    lam_camera none = lam_camera_fit(scene, 0, -5, NULL), one = lam_camera_fit(scene, 1, 1, NULL);
    assert_memory_equal(&none, &one, sizeof one);
}

// A named side shows the model from the direction of its name, for either up axis.
TEST(sides_have_names)
{
    static const struct {
        const char *name;
        lam_vec3 y_up, z_up; // from the target to the eye
    } expected[] = {{"front", {0, 0, 1}, {0, -1, 0}}, {"back", {0, 0, -1}, {0, 1, 0}},
                    {"left", {-1, 0, 0}, {-1, 0, 0}}, {"right", {1, 0, 0}, {1, 0, 0}},
                    {"top", {0, 1, 0}, {0, 0, 1}},    {"bottom", {0, -1, 0}, {0, 0, -1}},
                    {"iso", {1, 1, 1}, {1, -1, 1}}};
    AUTO_SCENE scene = shape_scene("sphere", 1);
    for (size_t i = 0; i < 2 * sizeof expected / sizeof *expected; i++) {
        lam_side side = lam_side_find(expected[i / 2].name);
        assert_true(side < LAM_SIDE_COUNT);
        assert_string_equal(lam_side_name(side), expected[i / 2].name);
        lam_scene_set_up(scene, i % 2 ? LAM_UP_Z : LAM_UP_Y);
        lam_view view = lam_view_of_side(side);
        lam_camera camera = lam_camera_fit(scene, 64, 64, &view);
        lam_vec3 d = {camera.eye.x - camera.target.x, camera.eye.y - camera.target.y, camera.eye.z - camera.target.z};
        lam_vec3 e = i % 2 ? expected[i / 2].z_up : expected[i / 2].y_up;
        double scale = sqrt(d.x * d.x + d.y * d.y + d.z * d.z) / sqrt(e.x * e.x + e.y * e.y + e.z * e.z);
        near(d.x, e.x * scale, 1e-9);
        near(d.y, e.y * scale, 1e-9);
        near(d.z, e.z * scale, 1e-9);
    }
    lam_view plain = lam_view_of_side(LAM_SIDE_THREE_QUARTER);
    lam_camera a = lam_camera_fit(scene, 64, 64, &plain), b = lam_camera_fit(scene, 64, 64, NULL);
    assert_memory_equal(&a, &b, sizeof a);
    assert_int_equal(lam_side_find("frnt"), LAM_SIDE_COUNT);
    assert_int_equal(lam_side_find(NULL), LAM_SIDE_COUNT);
    assert_null(lam_side_name(LAM_SIDE_COUNT));
}

// Cameras given as text: omitted keys come from the scene. (tests/cli tests every error.)
TEST(cameras_in_words)
{
    AUTO_SCENE scene = shape_scene("cube", 1);
    lam_mat4 move = lam_mat4_identity();
    move.m[1][3] = 10;
    assert_true(lam_scene_transform(scene, &move, NULL));
    lam_scene_set_up(scene, LAM_UP_Z);
    lam_camera camera;
    lam_error error;
    assert_true(lam_camera_parse("eye=2/-1.5e1/4", scene, &camera, &error));
    assert_true(camera.eye.x == 2 && camera.eye.y == -15 && camera.target.y == 10 && camera.up.z == 1);
    near(camera.fovy_rad, PI_HALF / 3, 1e-15);
    assert_true(lam_camera_parse("eye=2/1/4,ortho=3,near=-1,far=9,target=1/1/1,up=1/0/0", NULL, &camera, &error));
    assert_true(camera.ortho_half_height == 3 && camera.near_plane == -1 && camera.target.z == 1 && camera.up.x == 1);
    lam_camera before = camera;
    static const char *const wrong[][2] = {{"eye=1/2", "three numbers"},        {"eye=inf/0/0", "three numbers"},
                                           {"ey=1/2/3", "did you mean 'eye'?"}, {"fovy=20", "'eye' is missing"},
                                           {"eye=0/0/1e999", "three numbers"},  {"", "key=value"}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        assert_false(lam_camera_parse(wrong[i][0], scene, &camera, &error));
        assert_int_equal(error.code, LAM_BAD_ARGUMENT);
        assert_non_null(strstr(error.text, wrong[i][1]));
        assert_memory_equal(&camera, &before, sizeof camera);
    }
}

// Materials and lights given as text. (tests/cli tests every error.)
TEST(materials_in_words)
{
    lam_material ruby = lam_material_named(LAM_MATERIAL_RUBY, LAM_COLOR_SRGB), m = lam_material_default();
    lam_error error;
    assert_true(lam_material_parse("Ruby,shininess=9,kd=0.5,opacity=0.25", LAM_COLOR_SRGB, &m, &error));
    assert_string_equal(m.name, ruby.name);
    assert_true(m.shininess == 9 && m.diffuse.a == 0.25f && m.specular.r == ruby.specular.r);
    near((double)m.diffuse.r, 0.5 * (double)ruby.diffuse.r, 1e-7);
    assert_true(lam_material_parse("ruby", LAM_COLOR_RAW, &m, &error));
    assert_true(m.diffuse.r == 0.61424f && ruby.diffuse.r < 0.34f); // raw: the published number; otherwise decoded
    m = lam_material_default();
    float shininess = m.shininess;
    assert_true(lam_material_parse("diffuse=0.1/0.2/0.3", LAM_COLOR_SRGB, &m, &error));
    assert_true(m.shininess == shininess && m.diffuse.g == 0.2f); // the others do not change
    lam_material before = m;
    static const char *const wrong[] = {"rubi", "", "shininess=-1", "kd=1,kd=2", "gold,ruby"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        assert_false(lam_material_parse(wrong[i], LAM_COLOR_SRGB, &m, &error));
        assert_int_equal(error.code, LAM_BAD_ARGUMENT);
        assert_memory_equal(&m, &before, sizeof m);
    }
}

TEST(lights_in_words)
{
    lam_scene *scene = shape_scene("sphere", 2), *empty = lam_scene_make(NULL);
    lam_mat4 move = lam_mat4_identity();
    move.m[1][3] = 10;
    assert_true(lam_scene_transform(scene, &move, NULL));
    lam_error error;
    const char *text = "spot:position=1r/2r/0,range=3r,cutoff=30,color=0.5,attenuation=1/0/1r,name=lamp";
    assert_int_equal(lam_scene_add_light_text(scene, text, NULL, &error), 0);
    const lam_light *light = lam_scene_light(scene, 0);
    near(light->position.x, 2, 1e-5);
    near(light->position.y, 14, 1e-5);
    near((double)light->range, 6, 1e-5);
    near((double)light->attenuation.quadratic, 0.25, 1e-6); // 1 at a distance of one radius
    near((double)light->cutoff_rad, PI_HALF / 3, 1e-6);
    near(light->direction.y, -4, 1e-5); // towards the middle of the scene
    assert_true(light->diffuse.g == 0.5f && light->specular.b == 0.5f);
    assert_string_equal(light->name, "lamp");
    lam_light_text_params params = {.centre = {1, 0, 0}, .radius = 5};
    assert_int_equal(lam_scene_add_light_text(scene, "point:position=0/1r/0", &params, &error), 1);
    near(lam_scene_light(scene, 1)->position.x, 1, 1e-12);
    near(lam_scene_light(scene, 1)->position.y, 5, 1e-12);
    assert_int_equal(lam_scene_add_light_text(NULL, text, NULL, &error), 0); // only checked
    assert_int_equal(lam_scene_add_light_text(NULL, "spot:cutof=3", NULL, &error), -1);
    assert_non_null(strstr(error.text, "did you mean 'cutoff'?"));
    assert_int_equal(lam_scene_add_light_text(empty, text, NULL, &error), -1);
    assert_non_null(strstr(error.text, "without r"));
    assert_int_equal(lam_scene_add_light_text(empty, "directional:direction=0/-1/0", NULL, &error), 0);
    assert_int_equal(lam_scene_light_count(empty), 1);
    lam_scene_free(scene);
    lam_scene_free(empty);
}

TEST(turning_and_moving)
{
    AUTO_SCENE scene = shape_scene("cube", 1);
    lam_error error;
    lam_mat4 move = lam_mat4_identity();
    move.m[0][3] = 4;
    assert_true(lam_scene_transform(scene, &move, &error));
    // x to −z about y, through the cube's own centre, which does not move.
    assert_true(lam_scene_rotate(scene, (lam_vec3){4, 0, 0}, (lam_vec3){0, 2, 0}, PI_HALF, &error));
    const lam_mat4 *m = &lam_scene_object(scene, 0)->transform;
    near(m->m[2][0], -1, 1e-12);
    near(m->m[0][2], 1, 1e-12);
    near(m->m[0][3], 4, 1e-12);
    near(m->m[2][3], 0, 1e-12);
    // It is refused, and nothing has moved.
    lam_mat4 flat = lam_mat4_identity(), bent = lam_mat4_identity(), lost = lam_mat4_identity(), before = *m;
    flat.m[1][1] = 0;
    bent.m[3][0] = 1;
    lost.m[0][0] = (double)NAN;
    const lam_mat4 *bad[] = {&flat, &bent, &lost, NULL};
    for (int i = 0; i < 4; i++) {
        assert_false(lam_scene_transform(scene, bad[i], &error));
        assert_int_equal(error.code, LAM_BAD_ARGUMENT);
    }
    assert_false(lam_scene_rotate(scene, (lam_vec3){0, 0, 0}, (lam_vec3){0, 0, 0}, 1, &error));
    assert_false(lam_scene_rotate(scene, (lam_vec3){0, 0, 0}, (lam_vec3){0, 1, 0}, (double)NAN, &error));
    assert_memory_equal(&before, &lam_scene_object(scene, 0)->transform, sizeof before);
}

TEST(rigs_stand_about_the_scene)
{
    AUTO_SCENE scene = shape_scene("sphere", 2);
    lam_mat4 move = lam_mat4_identity();
    move.m[1][3] = 10;
    assert_true(lam_scene_transform(scene, &move, NULL));
    lam_light lights[LAM_RIG_LIGHTS_MAX];
    assert_int_equal(lam_scene_rig_lights(scene, LAM_RIG_LECTURE, false, lights), 1);
    near(lights[0].position.x, 2, 1e-5);
    near(lights[0].position.y, 14, 1e-5);
    near(lights[0].position.z, 6, 1e-5);
    near((double)lights[0].ambient.g, 0.1, 1e-7);
    assert_true(lights[0].diffuse.r == 1 && lights[0].specular.b == 1 && lights[0].attenuation.constant == 1);
    assert_int_equal(lam_scene_rig_lights(scene, LAM_RIG_NONE, false, lights), 0);
    lam_light studio[LAM_RIG_LIGHTS_MAX];
    assert_int_equal(lam_scene_rig_lights(scene, LAM_RIG_AUTO, true, lights), lam_rig_lights(LAM_RIG_STUDIO, studio));
    for (int rig = 0; rig <= LAM_RIG_LECTURE; rig++)
        for (int i = 0, count = lam_rig_lights((lam_rig)rig, lights); i < count; i++)
            assert_true(lam_light_check(&lights[i], NULL));
    lam_light own = lam_light_default(LAM_LIGHT_POINT);
    assert_int_equal(lam_scene_add_light(scene, &own, NULL), 0);
    assert_int_equal(lam_scene_rig_lights(scene, LAM_RIG_AUTO, false, lights), 0);
}

enum { HILLS_SIDE = 33 };

// Hills of a height over a level square, as two objects that take turns by rows.
static lam_scene *hills(float height)
{
    static float points[3 * HILLS_SIDE * HILLS_SIDE];
    static uint32_t corners[2][6 * HILLS_SIDE * HILLS_SIDE];
    uint32_t counts[2] = {0, 0};
    for (int z = 0; z < HILLS_SIDE; z++)
        for (int x = 0; x < HILLS_SIDE; x++) {
            float *p = points + 3 * (z * HILLS_SIDE + x);
            p[0] = (float)x;
            uint32_t random = (uint32_t)(x * HILLS_SIDE + z) * 2654435769u;
            random = (random ^ random >> 15) * 2246822519u;
            p[1] = height * 0x1p-23f * (float)(random >> 8);
            p[2] = (float)z;
        }
    for (uint32_t z = 0; z + 1 < HILLS_SIDE; z++)
        for (uint32_t x = 0; x + 1 < HILLS_SIDE; x++) {
            uint32_t a = z * HILLS_SIDE + x, c = a + HILLS_SIDE, *at = corners[z % 2] + 3 * (size_t)counts[z % 2];
            memcpy(at, (uint32_t[]){a, c, c + 1, a, c + 1, a + 1}, 6 * sizeof *at);
            counts[z % 2] += 2;
        }
    lam_scene *scene = lam_scene_make(NULL);
    for (int i = 0; i < 2; i++) {
        lam_object object = lam_object_default();
        object.mesh = lam_scene_add_mesh(scene,
                                         &(lam_mesh){.positions = points,
                                                     .vertex_count = HILLS_SIDE * HILLS_SIDE,
                                                     .indices = corners[i],
                                                     .triangle_count = counts[i]},
                                         NULL);
        assert_true(lam_scene_add_object(scene, &object, NULL) >= 0);
    }
    return scene;
}

// The studio lights a terrain from the left and below the view's axis, whatever its axes, and nothing else.
TEST(terrains_are_lit_from_below)
{
    lam_light lights[LAM_RIG_LIGHTS_MAX];
    lam_scene *terrain = hills(0.4f), *level = hills(0), *steep = hills(4);
    assert_int_equal(lam_scene_rig_lights(terrain, LAM_RIG_AUTO, false, lights), 3);
    assert_true(lights[0].position.x < 0 && lights[0].position.y < 0 && lights[0].position.z > 0);
    assert_string_equal(lights[2].name, "sky");
    for (int i = 0; i < 3; i++)
        assert_true(lam_light_check(&lights[i], NULL));
    assert_int_equal(lam_scene_rig_lights(terrain, LAM_RIG_THREE_POINT, false, lights), 4);
    assert_int_equal(lam_scene_rig_lights(level, LAM_RIG_AUTO, false, lights), 4);
    lam_scene_rig_lights(steep, LAM_RIG_AUTO, false, lights);
    assert_true(lights[0].position.y > 0);
    assert_int_equal(lam_scene_rig_lights(terrain, LAM_RIG_AUTO, true, lights), 4); // with a ground
    lam_scene_set_up(terrain, LAM_UP_Z);                                            // it stands like a wall
    assert_int_equal(lam_scene_rig_lights(terrain, LAM_RIG_AUTO, false, lights), 4);
    assert_true(lam_scene_rotate(terrain, (lam_vec3){0, 0, 0}, (lam_vec3){1, 0, 0}, PI_HALF, NULL));
    assert_int_equal(lam_scene_rig_lights(terrain, LAM_RIG_AUTO, false, lights), 3);
    assert_true(lam_scene_hide_object(terrain, 0, true, NULL)); // the other half faces up too
    assert_int_equal(lam_scene_rig_lights(terrain, LAM_RIG_AUTO, false, lights), 3);
    lam_scene_free(terrain);
    lam_scene_free(level);
    lam_scene_free(steep);
}

// Without a ground, curved models have a strong key light and no rim light, however they are rotated. Models with flat
// faces have the lights of the rig, also if they consist of many triangles.
TEST(curved_models_have_their_own_light)
{
    static const struct {
        const char *shape;
        bool curved;
    } cases[] = {{"sphere", true}, {"teapot", true}, {"torus", true}, {"torus-knot", true}, {"cube", false}};
    lam_light lights[LAM_RIG_LIGHTS_MAX], studio[LAM_RIG_LIGHTS_MAX];
    const int all = lam_rig_lights(LAM_RIG_STUDIO, studio);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        AUTO_SCENE scene = shape_scene(cases[i].shape, 1);
        for (int turn = 0; turn < 3; turn++) {
            assert_int_equal(lam_scene_rig_lights(scene, LAM_RIG_AUTO, false, lights), all - cases[i].curved);
            assert_true((lights[0].diffuse.r > studio[0].diffuse.r) == cases[i].curved);
            assert_int_equal(lam_scene_rig_lights(scene, LAM_RIG_AUTO, true, lights), all);
            assert_true(lights[0].diffuse.r == studio[0].diffuse.r);
            assert_true(lam_scene_rotate(scene, (lam_vec3){0, 0, 0}, (lam_vec3){1, 2, 3}, 0.7, NULL));
        }
    }
    lam_scene *many = lam_scene_make(NULL), *cut = hills(0);
    lam_object object = lam_object_default();
    object.mesh = lam_scene_add_shape(many, "cube", NULL, NULL);
    for (int i = 0; i < 100; i++)
        assert_true(lam_scene_add_object(many, &object, NULL) >= 0);
    assert_true(lam_scene_triangle_count(many) >= 1024 && lam_scene_triangle_count(cut) >= 1024);
    assert_int_equal(lam_scene_rig_lights(many, LAM_RIG_AUTO, false, lights), all);
    assert_int_equal(lam_scene_rig_lights(cut, LAM_RIG_AUTO, false, lights), all);
    lam_scene_free(many);
    lam_scene_free(cut);
}

static void draw(lam_scene *scene, lam_image *image)
{
    lam_camera camera = lam_camera_default();
    AUTO_DEVICE device = lam_device_cpu(&(lam_cpu_params){.threads = 1}, NULL);
    assert_non_null(device);
    assert_true(lam_image_make(image, 24, 24, LAM_RGBA32F, NULL));
    assert_true(lam_draw(device, scene, &camera, &(lam_draw_params){.samples = 1}, image, NULL, NULL));
}

// A light in the model's frame moves with the model: it has the same effect as a light of the world at the position to
// which the transform moves it.
TEST(lights_go_with_the_model)
{
    lam_image images[2];
    for (int i = 0; i < 2; i++) {
        AUTO_SCENE scene = shape_scene("sphere", 1);
        lam_light light = lam_light_default(LAM_LIGHT_POINT);
        light.frame = i ? LAM_FRAME_WORLD : LAM_FRAME_MODEL;
        light.position = i ? (lam_vec3){3, 1, -1} : (lam_vec3){1, 1, 3};
        assert_int_equal(lam_scene_add_light(scene, &light, NULL), 0);
        assert_true(lam_scene_rotate(scene, (lam_vec3){0, 0, 0}, (lam_vec3){0, 1, 0}, PI_HALF, NULL));
        draw(scene, &images[i]);
    }
    const float *a = images[0].pixels, *b = images[1].pixels;
    double most = 0, brightest = 0;
    for (int i = 0; i < 24 * 24 * 4; i++) {
        most = fmax(most, fabs((double)a[i] - (double)b[i]));
        if (i % 4 < 3)
            brightest = fmax(brightest, (double)a[i]);
    }
    assert_true(most < 1e-5);
    assert_true(brightest > 0.3);
    lam_image_free(&images[0]);
    lam_image_free(&images[1]);
}

TEST(view_matrix)
{
    lam_camera camera = lam_camera_default();
    camera.eye = (lam_vec3){5, 0, 0};
    lam_mat4 view = lam_camera_view_matrix(&camera); // looks along −x: the world's x is the eye's z
    near(view.m[2][0], 1, 1e-15);
    near(view.m[2][3], -5, 1e-15);
    near(view.m[1][1], 1, 1e-15);
}

// --- meshes by hand

static const float square[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
static const float up_normals[] = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
static const uint32_t two_triangles[] = {0, 1, 2, 0, 2, 3};

static lam_scene *square_scene(const lam_part *parts, uint32_t part_count)
{
    lam_scene *scene = lam_scene_make(NULL);
    lam_mesh mesh = {.positions = square,
                     .vertex_count = 4,
                     .indices = two_triangles,
                     .triangle_count = 2,
                     .normals = up_normals,
                     .normal_count = 4,
                     .parts = parts,
                     .part_count = part_count};
    lam_object object = lam_object_default();
    object.mesh = lam_scene_add_mesh(scene, &mesh, NULL);
    assert_int_equal(object.mesh, 0);
    assert_int_equal(lam_scene_add_object(scene, &object, NULL), 0);
    return scene;
}

TEST(parts_change_their_material)
{
    lam_part parts[] = {{.name = "a", .triangle_count = 1, .material = -1},
                        {.name = "b", .first_triangle = 1, .triangle_count = 1, .material = -1}};
    AUTO_SCENE scene = square_scene(parts, 2);
    lam_material gold = lam_material_named(LAM_MATERIAL_GOLD, LAM_COLOR_SRGB);
    assert_int_equal(lam_scene_add_material(scene, &gold, NULL), 0);
    assert_true(lam_scene_set_part_material(scene, 0, 1, 0, NULL));
    assert_int_equal(lam_scene_mesh(scene, 0)->parts[0].material, -1);
    assert_int_equal(lam_scene_mesh(scene, 0)->parts[1].material, 0);
    assert_int_equal(parts[1].material, -1); // the caller's own array does not change
    lam_error error;
    assert_false(lam_scene_set_part_material(scene, 1, 0, 0, &error));
    assert_false(lam_scene_set_part_material(scene, 0, 2, 0, &error));
    assert_false(lam_scene_set_part_material(scene, 0, 0, 1, &error));
    assert_false(lam_scene_set_part_material(scene, 0, 0, -2, &error));
    assert_int_equal(error.code, LAM_BAD_ARGUMENT);
    lam_scene_add_warning(scene, "one");
    assert_string_equal(lam_scene_warning(scene, 0), "one");
}
