// light.c: default lights, their checks, and the ready-made rigs.
#include "fail.h"
#include "linear.h"

#include <lambent/light.h>

lam_light lam_light_default(lam_light_type type)
{
    lam_light light = {
        .type = type,
        .direction = {0.0, 0.0, -1.0},
        .diffuse = {1.0f, 1.0f, 1.0f},
        .specular = {1.0f, 1.0f, 1.0f},
        .attenuation = {1.0f, 0.0f, 0.0f},
    };
    if (type == LAM_LIGHT_AMBIENT)
        light.ambient = (lam_rgb){0.2f, 0.2f, 0.2f};
    if (type == LAM_LIGHT_HEMISPHERE) {
        light.sky = (lam_rgb){0.4f, 0.4f, 0.4f};
        light.ground = (lam_rgb){0.1f, 0.1f, 0.1f};
    }
    if (type == LAM_LIGHT_SPOT)
        light.cutoff_rad = (float)(PI / 4);
    return light;
}

// --- Checks. Floats that stand for π and π/2 lie some 1e-7 beside them.

static const double HALF_TURN = PI + 1e-6, QUARTER_TURN = PI / 2 + 1e-6;

static const char *const type_words[] = {"ambient", "hemisphere", "point", "directional", "spot"};

static bool bad(lam_error *error, const lam_light *light, const char *field, double found, const char *expected)
{
    return fail(error, LAM_BAD_ARGUMENT, "%s light%s%s%s: %s is %g, expected %s", type_words[light->type],
                light->name ? " '" : "", light->name ? light->name : "", light->name ? "'" : "", field, found,
                expected);
}

static bool at_least_zero(const lam_light *light, const char *field, double value, lam_error *error)
{
    if (math_finite(value) && value >= 0)
        return true;
    return bad(error, light, field, value, "a finite number of 0 or more");
}

static bool color_fits(const lam_light *light, const char *r, const char *g, const char *b, lam_rgb color,
                       lam_error *error)
{
    return at_least_zero(light, r, (double)color.r, error) && at_least_zero(light, g, (double)color.g, error) &&
           at_least_zero(light, b, (double)color.b, error);
}
#define COLOR_FITS(light, field, error) color_fits(light, #field ".r", #field ".g", #field ".b", (light)->field, error)

static bool vector_fits(const lam_light *light, const char *x, const char *y, const char *z, lam_vec3 v,
                        lam_error *error)
{
    const char *finite = "a finite number";
    if (!math_finite(v.x))
        return bad(error, light, x, v.x, finite);
    if (!math_finite(v.y))
        return bad(error, light, y, v.y, finite);
    return math_finite(v.z) || bad(error, light, z, v.z, finite);
}
#define VECTOR_FITS(light, field, error)                                                                               \
    vector_fits(light, #field ".x", #field ".y", #field ".z", (light)->field, error)

static bool direction_fits(const lam_light *light, lam_error *error)
{
    if (!VECTOR_FITS(light, direction, error))
        return false;
    lam_vec3 d = light->direction;
    return d.x != 0 || d.y != 0 || d.z != 0 || bad(error, light, "direction", 0, "a vector that is not zero");
}

static bool reach_fits(const lam_light *light, lam_error *error)
{
    return at_least_zero(light, "attenuation.constant", (double)light->attenuation.constant, error) &&
           at_least_zero(light, "attenuation.linear", (double)light->attenuation.linear, error) &&
           at_least_zero(light, "attenuation.quadratic", (double)light->attenuation.quadratic, error) &&
           at_least_zero(light, "range", (double)light->range, error);
}

static bool cone_fits(const lam_light *light, lam_error *error)
{
    double inner = (double)light->inner_rad, outer = (double)light->outer_rad;
    double cutoff = (double)light->cutoff_rad;
    if (!at_least_zero(light, "inner_rad", inner, error) || !at_least_zero(light, "outer_rad", outer, error) ||
        !at_least_zero(light, "cutoff_rad", cutoff, error) ||
        !at_least_zero(light, "exponent", (double)light->exponent, error))
        return false;
    if (outer > QUARTER_TURN)
        return bad(error, light, "outer_rad", outer, "a half angle of at most π/2");
    if ((outer > 0 || inner > 0) && inner >= outer)
        return bad(error, light, "inner_rad", inner, "less than outer_rad");
    bool whole_sphere = cutoff > PI - 1e-6 && cutoff <= HALF_TURN;
    if (cutoff > QUARTER_TURN && !whole_sphere)
        return bad(error, light, "cutoff_rad", cutoff, "a half angle in 0 to π/2, or π");
    return true;
}

bool lam_light_check(const lam_light *light, lam_error *error)
{
    if (!light)
        return fail(error, LAM_BAD_ARGUMENT, "light is NULL, expected a light");
    if ((unsigned)light->type > LAM_LIGHT_SPOT)
        return fail(error, LAM_BAD_ARGUMENT, "light: type is %d, expected 0 to %d", (int)light->type,
                    (int)LAM_LIGHT_SPOT);
    if ((unsigned)light->frame > LAM_FRAME_MODEL)
        return bad(error, light, "frame", (double)light->frame, "0 (world), 1 (camera), 2 (object) or 3 (model)");
    if (light->type == LAM_LIGHT_HEMISPHERE)
        return COLOR_FITS(light, sky, error) && COLOR_FITS(light, ground, error) && VECTOR_FITS(light, up, error);
    if (!COLOR_FITS(light, ambient, error))
        return false;
    if (light->type == LAM_LIGHT_AMBIENT)
        return true;
    if (!COLOR_FITS(light, diffuse, error) || !COLOR_FITS(light, specular, error))
        return false;
    if (light->type == LAM_LIGHT_DIRECTIONAL)
        return direction_fits(light, error);
    if (!VECTOR_FITS(light, position, error) || !reach_fits(light, error))
        return false;
    return light->type == LAM_LIGHT_POINT || (direction_fits(light, error) && cone_fits(light, error));
}

// --- Rigs

// A directional light that moves with the camera. `from` points to where the light comes from: x right, y up, z
// towards the viewer.
static lam_light camera_light(const char *name, lam_vec3 from, float diffuse, float specular)
{
    lam_light light = lam_light_default(LAM_LIGHT_DIRECTIONAL);
    light.frame = LAM_FRAME_CAMERA;
    light.name = name;
    light.direction = v3_scale(from, -1.0);
    light.diffuse = (lam_rgb){diffuse, diffuse, diffuse};
    light.specular = (lam_rgb){specular, specular, specular};
    return light;
}

// The default look. What a point returns is its ka or kd times at most
//   0.74 (key) + 0.24·cos 79° (fill, where the key is full) + 0.17 (sky, seen from there) = 0.96
// (0.9 on top, where the rim light joins in), so that even a white material keeps its form and does not blow out; the
// default material's 0.72 ends at 0.69 (sRGB 215), with a highlight above it. A point that only the ground lights still
// has 0.72·0.06 (sRGB 58), and between the two stand the fill's side (about 0.2, sRGB 124) and the rim, which draws a
// line of light along the upper edges so that a model stands out from a dark page.
static int studio(lam_light lights[LAM_RIG_LIGHTS_MAX])
{
    lights[0] = camera_light("key", v3(-0.65, 0.75, 0.80), 0.74f, 0.9f);
    lights[1] = camera_light("fill", v3(0.95, 0.10, 0.55), 0.24f, 0.15f);
    lights[2] = camera_light("rim", v3(0.25, 0.70, -0.80), 0.28f, 0.30f);
    lights[3] = lam_light_default(LAM_LIGHT_HEMISPHERE);
    lights[3].name = "sky";
    lights[3].sky = (lam_rgb){0.20f, 0.20f, 0.20f};
    lights[3].ground = (lam_rgb){0.06f, 0.06f, 0.06f};
    return 4;
}

static int headlight(lam_light lights[LAM_RIG_LIGHTS_MAX])
{
    lights[0] = camera_light("headlight", v3(0.0, 0.0, 1.0), 1.0f, 1.0f);
    return 1;
}

// A portrait's three lights. Where key and fill both arrive in full a point returns its kd times 0.8 + 0.4·cos 73° +
// 0.05, below 1; on the fill's own side the ratio of key to fill is 2 to 1.
static int three_point(lam_light lights[LAM_RIG_LIGHTS_MAX])
{
    lights[0] = camera_light("key", v3(-1.0, 1.0, 1.0), 0.8f, 0.8f);
    lights[1] = camera_light("fill", v3(1.0, 0.25, 1.0), 0.4f, 0.4f);
    lights[2] = camera_light("back", v3(0.5, 1.0, -1.0), 0.6f, 0.6f);
    lights[3] = lam_light_default(LAM_LIGHT_AMBIENT);
    lights[3].name = "ambient";
    lights[3].ambient = (lam_rgb){0.05f, 0.05f, 0.05f};
    return 4;
}

// What a first program of a lighting course sets up.
static int lecture(lam_light lights[LAM_RIG_LIGHTS_MAX])
{
    lights[0] = lam_light_default(LAM_LIGHT_POINT);
    lights[0].name = "lecture";
    lights[0].position = v3(1.0, 2.0, 3.0);
    lights[0].ambient = (lam_rgb){0.1f, 0.1f, 0.1f};
    return 1;
}

int lam_rig_lights(lam_rig rig, lam_light lights[LAM_RIG_LIGHTS_MAX])
{
    switch (rig) {
    case LAM_RIG_STUDIO:
        return studio(lights);
    case LAM_RIG_HEADLIGHT:
        return headlight(lights);
    case LAM_RIG_THREE_POINT:
        return three_point(lights);
    case LAM_RIG_LECTURE:
        return lecture(lights);
    case LAM_RIG_AUTO:
    case LAM_RIG_NONE:
        break;
    }
    return 0;
}
