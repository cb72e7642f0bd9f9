// test_materials.c: the default material and the named materials; default lights, their checks, and the rigs.

#include "test.h"

#include <lambent/fields.h>
#include <lambent/light.h>
#include <lambent/material.h>
#include <lambent/scene.h>

// The published table: ambient, diffuse, specular, shininess/128. Typed in independently of the library's table.
static const struct {
    lam_material_id id;
    const char *name;
    double n[10];
} published[] = {
    {LAM_MATERIAL_EMERALD, "emerald", {0.0215, 0.1745, 0.0215, 0.07568, 0.61424, 0.07568, 0.633, 0.727811, 0.633, 0.6}},
    {LAM_MATERIAL_JADE, "jade", {0.135, 0.2225, 0.1575, 0.54, 0.89, 0.63, 0.316228, 0.316228, 0.316228, 0.1}},
    {LAM_MATERIAL_OBSIDIAN,
     "obsidian",
     {0.05375, 0.05, 0.06625, 0.18275, 0.17, 0.22525, 0.332741, 0.328634, 0.346435, 0.3}},
    {LAM_MATERIAL_PEARL, "pearl", {0.25, 0.20725, 0.20725, 1, 0.829, 0.829, 0.296648, 0.296648, 0.296648, 0.088}},
    {LAM_MATERIAL_RUBY,
     "ruby",
     {0.1745, 0.01175, 0.01175, 0.61424, 0.04136, 0.04136, 0.727811, 0.626959, 0.626959, 0.6}},
    {LAM_MATERIAL_TURQUOISE,
     "turquoise",
     {0.1, 0.18725, 0.1745, 0.396, 0.74151, 0.69102, 0.297254, 0.30829, 0.306678, 0.1}},
    {LAM_MATERIAL_BRASS,
     "brass",
     {0.329412, 0.223529, 0.027451, 0.780392, 0.568627, 0.113725, 0.992157, 0.941176, 0.807843, 0.21794872}},
    {LAM_MATERIAL_BRONZE, "bronze", {0.2125, 0.1275, 0.054, 0.714, 0.4284, 0.18144, 0.393548, 0.271906, 0.166721, 0.2}},
    {LAM_MATERIAL_CHROME, "chrome", {0.25, 0.25, 0.25, 0.4, 0.4, 0.4, 0.774597, 0.774597, 0.774597, 0.6}},
    {LAM_MATERIAL_COPPER,
     "copper",
     {0.19125, 0.0735, 0.0225, 0.7038, 0.27048, 0.0828, 0.256777, 0.137622, 0.086014, 0.1}},
    {LAM_MATERIAL_GOLD,
     "gold",
     {0.24725, 0.1995, 0.0745, 0.75164, 0.60648, 0.22648, 0.628281, 0.555802, 0.366065, 0.4}},
    {LAM_MATERIAL_SILVER,
     "silver",
     {0.19225, 0.19225, 0.19225, 0.50754, 0.50754, 0.50754, 0.508273, 0.508273, 0.508273, 0.4}},
    {LAM_MATERIAL_BLACK_PLASTIC, "black-plastic", {0, 0, 0, 0.01, 0.01, 0.01, 0.50, 0.50, 0.50, 0.25}},
    {LAM_MATERIAL_CYAN_PLASTIC,
     "cyan-plastic",
     {0, 0.1, 0.06, 0, 0.50980392, 0.50980392, 0.50196078, 0.50196078, 0.50196078, 0.25}},
    {LAM_MATERIAL_GREEN_PLASTIC, "green-plastic", {0, 0, 0, 0.1, 0.35, 0.1, 0.45, 0.55, 0.45, 0.25}},
    {LAM_MATERIAL_RED_PLASTIC, "red-plastic", {0, 0, 0, 0.5, 0, 0, 0.7, 0.6, 0.6, 0.25}},
    {LAM_MATERIAL_WHITE_PLASTIC, "white-plastic", {0, 0, 0, 0.55, 0.55, 0.55, 0.70, 0.70, 0.70, 0.25}},
    {LAM_MATERIAL_YELLOW_PLASTIC, "yellow-plastic", {0, 0, 0, 0.5, 0.5, 0, 0.60, 0.60, 0.50, 0.25}},
    {LAM_MATERIAL_BLACK_RUBBER, "black-rubber", {0.02, 0.02, 0.02, 0.01, 0.01, 0.01, 0.4, 0.4, 0.4, 0.078125}},
    {LAM_MATERIAL_CYAN_RUBBER, "cyan-rubber", {0, 0.05, 0.05, 0.4, 0.5, 0.5, 0.04, 0.7, 0.7, 0.078125}},
    {LAM_MATERIAL_GREEN_RUBBER, "green-rubber", {0, 0.05, 0, 0.4, 0.5, 0.4, 0.04, 0.7, 0.04, 0.078125}},
    {LAM_MATERIAL_RED_RUBBER, "red-rubber", {0.05, 0, 0, 0.5, 0.4, 0.4, 0.7, 0.04, 0.04, 0.078125}},
    {LAM_MATERIAL_WHITE_RUBBER, "white-rubber", {0.05, 0.05, 0.05, 0.5, 0.5, 0.5, 0.7, 0.7, 0.7, 0.078125}},
    {LAM_MATERIAL_YELLOW_RUBBER, "yellow-rubber", {0.05, 0.05, 0, 0.5, 0.5, 0.4, 0.7, 0.7, 0.04, 0.078125}},
};

// IEC 61966-2-1.
static double linear(double encoded)
{
    return encoded <= 0.04045 ? encoded / 12.92 : pow((encoded + 0.055) / 1.055, 2.4);
}

static void assert_numbers(lam_material_id id, const double n[10])
{
    for (int mode = LAM_COLOR_SRGB; mode <= LAM_COLOR_RAW; mode++) {
        lam_material m = lam_material_named(id, (lam_color_mode)mode);
        const float found[9] = {m.ambient.r, m.ambient.g,  m.ambient.b,  m.diffuse.r, m.diffuse.g,
                                m.diffuse.b, m.specular.r, m.specular.g, m.specular.b};
        for (int i = 0; i < 9; i++)
            if (mode == LAM_COLOR_RAW)
                assert_true(found[i] == (float)n[i]);
            else
                assert_true(fabs((double)found[i] - linear(n[i])) <= 3e-7 * linear(n[i]));
        assert_true(m.shininess == (float)(n[9] * 128));
    }
}

TEST(test_named)
{
    assert_int_equal(sizeof published / sizeof *published, LAM_MATERIAL_COUNT);
    assert_int_equal(LAM_MATERIAL_COUNT, 24);
    for (int i = 0; i < LAM_MATERIAL_COUNT; i++) {
        assert_int_equal(published[i].id, i);
        assert_string_equal(lam_material_name(published[i].id), published[i].name);
        assert_int_equal(lam_material_find(published[i].name), i);
        assert_numbers(published[i].id, published[i].n);
        lam_material m = lam_material_named(published[i].id, LAM_COLOR_SRGB);
        assert_true(m.diffuse.a == 1.0f && m.emission.r == 0.0f && m.reflectivity.r == 0.0f && !m.fibre);
        assert_string_equal(m.name, published[i].name);
        assert_int_equal(m.illum, -1);
    }
    lam_material brass = lam_material_named(LAM_MATERIAL_BRASS, LAM_COLOR_SRGB);
    assert_true(fabs((double)brass.shininess - 27.8974) < 5e-5);
    assert_null(lam_material_name(LAM_MATERIAL_COUNT));
    assert_null(lam_material_name((lam_material_id)-1));
    lam_material none = lam_material_named(LAM_MATERIAL_COUNT, LAM_COLOR_SRGB), grey = lam_material_default();
    assert_memory_equal(&none.ambient, &grey.ambient, sizeof none.ambient);
}

TEST(test_find)
{
    assert_int_equal(lam_material_find("Black Plastic"), LAM_MATERIAL_BLACK_PLASTIC);
    assert_int_equal(lam_material_find("BLACK_PLASTIC"), LAM_MATERIAL_BLACK_PLASTIC);
    assert_int_equal(lam_material_find("bRaSs"), LAM_MATERIAL_BRASS);
    static const char *const none[] = {"", "bras", "brasss", "blackplastic", "black--plastic", " brass", "black-"};
    for (size_t i = 0; i < sizeof none / sizeof *none; i++)
        assert_int_equal(lam_material_find(none[i]), LAM_MATERIAL_COUNT);
    assert_int_equal(lam_material_find(NULL), LAM_MATERIAL_COUNT);
}

TEST(test_default_material)
{
    lam_material m = lam_material_default();
    assert_true(m.diffuse.a == 1.0f && m.illum == -1 && m.name == NULL);
    assert_true(m.diffuse.r == m.diffuse.g && m.diffuse.g == m.diffuse.b); // neutral
    assert_true(m.ambient.r == m.diffuse.r);
}

// --- Lights

TEST(test_default_lights)
{
    for (int type = LAM_LIGHT_AMBIENT; type <= LAM_LIGHT_SPOT; type++) {
        lam_light light = lam_light_default((lam_light_type)type);
        lam_error error = {0};
        assert_int_equal(light.type, type);
        assert_true(lam_light_check(&light, &error));
        assert_true(light.ambient.g == (type == LAM_LIGHT_AMBIENT ? 0.2f : 0.0f));
        assert_true(light.diffuse.g == 1.0f && light.specular.g == 1.0f);
        assert_true(light.attenuation.constant == 1.0f && light.attenuation.linear == 0.0f);
        assert_true(light.direction.z == -1.0);
    }
    assert_true(fabs((double)lam_light_default(LAM_LIGHT_SPOT).cutoff_rad - M_PI / 4) < 1e-7);
    assert_true(lam_light_default(LAM_LIGHT_HEMISPHERE).sky.r == 0.4f);
    assert_true(lam_light_default(LAM_LIGHT_HEMISPHERE).ground.r == 0.1f);
}

static void refused(const lam_light *light, const char *field)
{
    lam_error error = {0};
    assert_false(lam_light_check(light, &error));
    assert_int_equal(error.code, LAM_BAD_ARGUMENT);
    if (!strstr(error.text, field))
        fail_msg("'%s' does not name %s", error.text, field);
    assert_false(lam_light_check(light, NULL));
}

static void accepted(const lam_light *light)
{
    lam_error error = {0};
    SUCCEEDS(lam_light_check(light, &error));
}

// Sets a field of a light to an invalid number and expects an error that names it; lights of other types accept it.
#define BAD(type, field, value)                                                                                        \
    do {                                                                                                               \
        lam_light wrong_ = lam_light_default(type);                                                                    \
        wrong_.field = (value);                                                                                        \
        refused(&wrong_, #field);                                                                                      \
    } while (0)
#define GOOD(type, field, value)                                                                                       \
    do {                                                                                                               \
        lam_light right_ = lam_light_default(type);                                                                    \
        right_.field = (value);                                                                                        \
        accepted(&right_);                                                                                             \
    } while (0)

TEST(test_light_checks)
{
    BAD(LAM_LIGHT_AMBIENT, ambient.r, -0.1f);
    BAD(LAM_LIGHT_POINT, ambient.g, NAN);
    BAD(LAM_LIGHT_POINT, diffuse.b, INFINITY);
    BAD(LAM_LIGHT_DIRECTIONAL, specular.r, -1.0f);
    BAD(LAM_LIGHT_HEMISPHERE, sky.g, -1.0f);
    BAD(LAM_LIGHT_HEMISPHERE, ground.b, NAN);
    BAD(LAM_LIGHT_HEMISPHERE, up.y, (double)NAN);
    BAD(LAM_LIGHT_POINT, position.x, (double)INFINITY);
    BAD(LAM_LIGHT_SPOT, position.z, (double)NAN);
    BAD(LAM_LIGHT_SPOT, direction.z, (double)NAN);
    BAD(LAM_LIGHT_DIRECTIONAL, direction, ((lam_vec3){0, 0, 0}));
    BAD(LAM_LIGHT_SPOT, direction, ((lam_vec3){0, 0, 0}));
    BAD(LAM_LIGHT_POINT, attenuation.constant, -1.0f);
    BAD(LAM_LIGHT_POINT, attenuation.linear, -1.0f);
    BAD(LAM_LIGHT_SPOT, attenuation.quadratic, NAN);
    BAD(LAM_LIGHT_POINT, range, -1.0f);
    BAD(LAM_LIGHT_SPOT, exponent, -1.0f);
    BAD(LAM_LIGHT_SPOT, cutoff_rad, -0.1f);
    BAD(LAM_LIGHT_SPOT, cutoff_rad, 1.6f);
    BAD(LAM_LIGHT_SPOT, cutoff_rad, 3.2f);
    BAD(LAM_LIGHT_SPOT, inner_rad, 0.2f); // outer is 0
    BAD(LAM_LIGHT_SPOT, outer_rad, 1.6f);
    BAD(LAM_LIGHT_SPOT, type, (lam_light_type)9);
    BAD(LAM_LIGHT_SPOT, frame, (lam_light_frame)5);
    BAD(LAM_LIGHT_SPOT, occluded, 1.1f);
    lam_light cone = lam_light_default(LAM_LIGHT_SPOT);
    cone.inner_rad = cone.outer_rad = 0.5f;
    refused(&cone, "inner_rad");
    cone.inner_rad = 0.4f;
    accepted(&cone);
    cone.name = "lamp";
    cone.exponent = -2;
    refused(&cone, "'lamp'");
    assert_false(lam_light_check(NULL, NULL));

    GOOD(LAM_LIGHT_POINT, attenuation, ((lam_attenuation){0, 0, 0})); // means 1, 0, 0
    GOOD(LAM_LIGHT_POINT, attenuation, ((lam_attenuation){0, 0, 1}));
    GOOD(LAM_LIGHT_SPOT, cutoff_rad, 0.0f);
    GOOD(LAM_LIGHT_SPOT, cutoff_rad, (float)M_PI);
    GOOD(LAM_LIGHT_SPOT, cutoff_rad, (float)M_PI_2);
    GOOD(LAM_LIGHT_SPOT, outer_rad, (float)M_PI_2);
    GOOD(LAM_LIGHT_SPOT, exponent, 1000.0f);
    // Fields of other types.
    GOOD(LAM_LIGHT_AMBIENT, diffuse.r, NAN);
    GOOD(LAM_LIGHT_POINT, direction, ((lam_vec3){0, 0, 0}));
    GOOD(LAM_LIGHT_DIRECTIONAL, range, -1.0f);
    GOOD(LAM_LIGHT_HEMISPHERE, ambient.r, NAN);
}

// --- Rigs

TEST(test_rigs)
{
    lam_light lights[LAM_RIG_LIGHTS_MAX];
    assert_int_equal(lam_rig_lights(LAM_RIG_AUTO, lights), 0);
    assert_int_equal(lam_rig_lights(LAM_RIG_NONE, lights), 0);
    assert_int_equal(lam_rig_lights(LAM_RIG_HEADLIGHT, lights), 1);
    assert_int_equal(lights[0].type, LAM_LIGHT_DIRECTIONAL);
    assert_int_equal(lights[0].frame, LAM_FRAME_CAMERA);
    assert_true(lights[0].direction.x == 0 && lights[0].direction.y == 0 && lights[0].direction.z < 0);

    int count = lam_rig_lights(LAM_RIG_STUDIO, lights);
    assert_true(count >= 4 && count <= LAM_RIG_LIGHTS_MAX);
    int hemispheres = 0;
    for (int i = 0; i < count; i++) {
        accepted(&lights[i]);
        assert_non_null(lights[i].name);
        hemispheres += lights[i].type == LAM_LIGHT_HEMISPHERE;
        if (lights[i].type != LAM_LIGHT_HEMISPHERE) {
            const bool near = i < 2; // the key light and the fill light
            assert_int_equal(lights[i].type, near ? LAM_LIGHT_POINT : LAM_LIGHT_DIRECTIONAL);
            assert_int_equal(lights[i].frame, near ? LAM_FRAME_VIEW : LAM_FRAME_CAMERA);
        }
    }
    assert_int_equal(hemispheres, 1);
    // The key light comes from the upper left, in front.
    assert_true(lights[0].position.x < 0 && lights[0].position.y > 0 && lights[0].position.z > 0);
}

// Diffuse and ambient light of the rig on the default material, over all visible directions and camera elevations:
// never nearly black, never clipped.
TEST(test_studio_range)
{
    lam_light lights[LAM_RIG_LIGHTS_MAX];
    int count = lam_rig_lights(LAM_RIG_STUDIO, lights);
    lam_material m = lam_material_default();
    double least = 10, most = 0;
    for (int tilt = -60; tilt <= 60; tilt += 30) {
        double ux = 0, uy = cos(tilt * M_PI / 180), uz = sin(tilt * M_PI / 180);
        for (int a = 0; a < 360; a += 3)
            for (int b = 0; b <= 90; b += 3) { // b is measured from the view's axis
                double z = cos(b * M_PI / 180), r = sin(b * M_PI / 180);
                double x = r * cos(a * M_PI / 180), y = r * sin(a * M_PI / 180), sum = 0;
                for (int i = 0; i < count; i++) {
                    const lam_light *l = &lights[i];
                    if (l->type == LAM_LIGHT_HEMISPHERE) {
                        double up = 0.5 + 0.5 * (x * ux + y * uy + z * uz);
                        sum += (double)m.ambient.r * ((double)l->ground.r * (1 - up) + (double)l->sky.r * up);
                        continue;
                    }
                    bool stands = l->type == LAM_LIGHT_POINT; // on a ball as large as the model
                    lam_vec3 d =
                        stands ? (lam_vec3){x - l->position.x, y - l->position.y, z - l->position.z} : l->direction;
                    double square = d.x * d.x + d.y * d.y + d.z * d.z;
                    double cosine = -(d.x * x + d.y * y + d.z * z) / sqrt(square);
                    double reach =
                        stands ? 1 / ((double)l->attenuation.constant + (double)l->attenuation.quadratic * square) : 1;
                    sum += (double)m.diffuse.r * (double)l->diffuse.r * fmax(cosine, 0) * reach;
                }
                least = fmin(least, sum);
                most = fmax(most, sum);
            }
    }
    assert_true(least > 0.03);     // sRGB 50
    assert_true(most < 0.7);       // sRGB 218: darker than paper, with room for the highlight
    assert_true(most > 8 * least); // and the shape is visible
}

// For each number of a row, the default is valid, and numbers outside the range give an error with the field's name.
static void check_material_field(lam_scene *scene, const lam_field *field)
{
    const double wrong[] = {field->min - 1, field->max + 1, NAN};
    for (size_t i = 0; i < 3; i++) {
        lam_material m = lam_material_default();
        double numbers[4];
        int count = lam_field_get_written(field, &m, numbers);
        for (int k = 0; k < count; k++)
            assert_true((float)numbers[k] == (float)field->standard[k]);
        assert_true(lam_scene_add_material(scene, &m, NULL) >= 0);
        if (field->type == LAM_FIELD_FLAG)
            continue;
        numbers[count - 1] = wrong[i];
        lam_field_set(field, &m, numbers);
        lam_error error = {0};
        assert_int_equal(lam_scene_add_material(scene, &m, &error), -1);
        assert_int_equal(error.code, LAM_BAD_ARGUMENT);
        assert_non_null(strstr(error.text, field->name));
    }
}

TEST(test_fields)
{
    lam_scene *scene = lam_scene_make(NULL);
    assert_non_null(scene);
    int count = 0;
    for (; lam_material_field(count); count++)
        check_material_field(scene, lam_material_field(count));
    lam_scene_free(scene);
    assert_true(count >= 8);
    assert_null(lam_material_field(-1));
    // A light of each type has each key once.
    for (int type = LAM_LIGHT_AMBIENT; type <= LAM_LIGHT_SPOT; type++) {
        lam_light light = lam_light_default((lam_light_type)type);
        for (int i = 0; lam_light_field(i); i++) {
            const lam_field *field = lam_light_field(i);
            if (!(field->light_types >> type & 1))
                continue;
            for (int k = 0; k < i; k++)
                assert_true(strcmp(lam_light_field(k)->key, field->key) != 0 ||
                            !(lam_light_field(k)->light_types >> type & 1));
            lam_light wrong = light;
            double numbers[4];
            lam_field_get(field, &light, numbers);
            if (field->type == LAM_FIELD_FLAG) { // stored so that its default is false
                assert_true(numbers[0] == field->standard[0]);
                assert_false(*(const bool *)((const char *)&light + field->offset));
                for (int on = 0; on < 2; on++) {
                    double back[4] = {-1};
                    lam_field_set(field, &wrong, (double[4]){on});
                    lam_field_get(field, &wrong, back);
                    assert_true(back[0] == on);
                }
                continue;
            }
            numbers[0] = NAN;
            lam_field_set(field, &wrong, numbers);
            assert_false(lam_light_check(&wrong, NULL));
        }
        assert_true(lam_light_check(&light, NULL));
    }
}
