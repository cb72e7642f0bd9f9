// test_color.c: the sRGB curve, colours as users write them, and recomputed normals of a scene.

#include "test.h"
#include "srgb.h"

static void assert_near(double found, double expected, double tolerance)
{
    if (!(fabs(found - expected) <= tolerance))
        fail_msg("found %.17g, expected %.17g", found, expected);
}

TEST(curve_is_the_standard)
{
    for (int i = 0; i <= 10000; i++) {
        double encoded = i / 10000.0;
        double expected = encoded <= 0.04045 ? encoded / 12.92 : pow((encoded + 0.055) / 1.055, 2.4);
        assert_near(srgb_linear(encoded), expected, 4e-16);
    }
    assert_true(srgb_linear(0) == 0 && srgb_linear(-1) == 0 && srgb_linear((double)NAN) == 0);
    assert_near(srgb_linear(1), 1, 1e-15);
    assert_true(srgb_linear(2) > srgb_linear(1.5));
}

static lam_rgba parsed(const char *text, lam_color_mode mode)
{
    lam_rgba color = {9, 9, 9, 9};
    lam_error error = {0};
    if (!lam_color_parse(text, mode, &color, &error))
        fail_msg("%s: %s", text, error.text);
    return color;
}

static void assert_color(lam_rgba c, double r, double g, double b, double a)
{
    assert_near((double)c.r, r, 1e-6);
    assert_near((double)c.g, g, 1e-6);
    assert_near((double)c.b, b, 1e-6);
    assert_near((double)c.a, a, 1e-6);
}

TEST(colors_in_every_form)
{
    double half = srgb_linear(128 / 255.0), fifth = srgb_linear(0.2);
    assert_color(parsed("#ff8000", LAM_COLOR_SRGB), 1, half, 0, 1);
    assert_color(parsed("#FF8000", LAM_COLOR_RAW), 1, 128 / 255.0, 0, 1);
    assert_color(parsed("#ff800033", LAM_COLOR_SRGB), 1, half, 0, 0.2); // alpha is never decoded
    assert_color(parsed("#f30", LAM_COLOR_SRGB), 1, fifth, 0, 1);
    assert_color(parsed("white", LAM_COLOR_SRGB), 1, 1, 1, 1);
    assert_color(parsed("Gray", LAM_COLOR_SRGB), half, half, half, 1);
    assert_color(parsed("grey", LAM_COLOR_RAW), 128 / 255.0, 128 / 255.0, 128 / 255.0, 1);
    assert_color(parsed("transparent", LAM_COLOR_SRGB), 0, 0, 0, 0);
    assert_color(parsed("0.25/2/0", LAM_COLOR_SRGB), 0.25, 2, 0, 1); // numbers are linear, and may exceed 1
    assert_color(parsed("0.25/1e-1/0/0.5", LAM_COLOR_RAW), 0.25, 0.1, 0, 0.5);
    assert_color(parsed("0.25", LAM_COLOR_SRGB), 0.25, 0.25, 0.25, 1); // one number for all three
}

TEST(wrong_colors_are_told)
{
    static const char *const wrong[] = {"",         "#",          "#1",      "#12",       "#1234",   "#12345",
                                        "#1234567", "#123456789", "#gggggg", "whit",      "whitee",  "-1",
                                        "1/2",      "1/2/",       "1/2/3/",  "1/2/3/4/5", "1/2/3/2", "-1/0/0",
                                        "nan/0/0",  "inf/0/0",    "1/2/x",   "1 /2/3",    " white",  "255,0,0"};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        lam_rgba color;
        lam_error error = {0};
        if (lam_color_parse(wrong[i], LAM_COLOR_SRGB, &color, &error))
            fail_msg("'%s' was taken for a colour", wrong[i]);
        assert_int_equal(error.code, LAM_BAD_ARGUMENT);
        assert_non_null(strstr(error.text, "expected a colour"));
    }
    lam_error error = {0};
    assert_false(lam_color_parse(NULL, LAM_COLOR_SRGB, NULL, &error));
    assert_int_equal(error.code, LAM_BAD_ARGUMENT);
}

TEST(normals_made_anew)
{
    lam_error error = {0};
    AUTO_SCENE scene = lam_scene_make(&error);
    assert_non_null(scene);
    int mesh = lam_scene_add_shape(scene, "sphere", &(lam_shape_params){.slices = 16, .stacks = 8}, &error);
    assert_true(mesh >= 0);
    const float *own = lam_scene_mesh(scene, mesh)->normals;
    assert_true(lam_scene_make_normals(scene, LAM_NORMALS_FILE, 0, 1, NULL, &error));
    assert_ptr_equal(lam_scene_mesh(scene, mesh)->normals, own);

    assert_true(lam_scene_make_normals(scene, LAM_NORMALS_FACET, 0, 2, NULL, &error));
    const lam_mesh *m = lam_scene_mesh(scene, mesh);
    for (uint32_t t = 0; t < m->triangle_count; t++) { // all three corners have the same normal
        const float *n[3];
        for (uint32_t c = 0; c < 3; c++)
            n[c] = m->normals + 3 * (m->normal_indices ? m->normal_indices[3 * t + c] : 3 * t + c);
        assert_memory_equal(n[0], n[1], 12);
        assert_memory_equal(n[0], n[2], 12);
    }
    assert_false(lam_scene_make_normals(scene, LAM_NORMALS_SMOOTH, 4, 0, NULL, &error));
    assert_int_equal(error.code, LAM_BAD_ARGUMENT);
    lam_cancel cancel = {1};
    assert_false(lam_scene_make_normals(scene, LAM_NORMALS_SMOOTH, 0, 0, &(lam_control){.cancel = &cancel}, &error));
    assert_int_equal(error.code, LAM_CANCELLED);
}
