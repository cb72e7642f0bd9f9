// light.c: default lights, validation of lights, and the built-in rigs.
#include "fail.h"
#include "fields.h"
#include "linear.h"

#include <lambent/light.h>
#include <lambent/scene.h>

// Also sets the fields of other light types, because a program may change the type later.
lam_light lam_light_default(lam_light_type type)
{
    lam_light light = {.type = type};
    for (int own = 0; own <= 1; own++)
        for (int i = 0; lam_light_field(i); i++)
            if (field_is_of(lam_light_field(i), type) == own)
                field_set_standard(lam_light_field(i), &light);
    return light;
}

// --- Checks

static const lam_light_type_info types[LAM_LIGHT_TYPE_COUNT] = {
    [LAM_LIGHT_AMBIENT] = {.word = "ambient", .summary = "the same from everywhere"},
    [LAM_LIGHT_HEMISPHERE] = {.word = "hemisphere", .summary = "from a sky over a ground"},
    [LAM_LIGHT_POINT] = {.word = "point", .summary = "from a position in all directions"},
    [LAM_LIGHT_DIRECTIONAL] = {.word = "directional", .summary = "parallel, from infinitely far"},
    [LAM_LIGHT_SPOT] = {.word = "spot", .summary = "from a position in a cone"},
};

const lam_light_type_info *lam_light_type_describe(lam_light_type type)
{
    return (unsigned)type < LAM_LIGHT_TYPE_COUNT ? &types[type] : NULL;
}

static bool fail_field(lam_error *error, const lam_light *light, const char *field, double found, const char *expected)
{
    return fail(error, LAM_BAD_ARGUMENT, "%s light%s%s%s: %s is %g, expected %s", types[light->type].word,
                light->name ? " '" : "", light->name ? light->name : "", light->name ? "'" : "", field, found,
                expected);
}

// Checks the relations between a spot's angles; their ranges have already been checked.
static bool check_cone(const lam_light *light, lam_error *error)
{
    double inner = (double)light->inner_rad, outer = (double)light->outer_rad, cutoff = (double)light->cutoff_rad;
    if ((outer > 0 || inner > 0) && inner >= outer)
        return fail_field(error, light, "inner_rad", inner, "less than outer_rad");
    if (cutoff > PI / 2 + 1e-6 && cutoff <= PI - 1e-6)
        return fail_field(error, light, "cutoff_rad", cutoff, "a half angle from 0 to π/2, or π (no cone)");
    return true;
}

bool lam_light_check(const lam_light *light, lam_error *error)
{
    if (!light)
        return fail(error, LAM_BAD_ARGUMENT, "light is NULL, expected a light");
    if (!check_reserved("light", light, error))
        return false;
    if ((unsigned)light->type > LAM_LIGHT_SPOT)
        return fail(error, LAM_BAD_ARGUMENT, "light: type is %d, expected 0 to %d", (int)light->type,
                    (int)LAM_LIGHT_SPOT);
    if ((unsigned)light->frame > LAM_FRAME_VIEW)
        return fail_field(error, light, "frame", (double)light->frame,
                          "0 (world), 1 (camera), 2 (object), 3 (model) or 4 (view)");
    struct field_fault fault;
    for (int i = 0; lam_light_field(i); i++)
        if (field_is_of(lam_light_field(i), light->type) && !field_fits(lam_light_field(i), light, &fault))
            return fail_field(error, light, fault.name, fault.found, fault.expected);
    return light->type != LAM_LIGHT_SPOT || check_cone(light, error);
}

// --- Rigs

// Returns a directional light in the camera's frame. `from` is the direction to the light: x right, y up, z towards the
// viewer.
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

// Makes the default rig; suit_scene changes it for curved models and terrains. The key light is near: 3.2 times half the
// box's diagonal from the centre, in front and to the left, so that the light varies across a flat face. The key light's
// strength ranges from 1.15 on the near side of the model to 0.85 on the far side. The fill light is near too, so that
// the faces that turn away from the key light vary as well. The rim light comes from above and behind. Tops are
// brightest, left sides darker and right sides darkest, so that the three visible faces of a cube differ at each
// azimuth. At the corner of the box that is nearest to the key light, a point reflects kd times at most
//
//  0.66·1.15 (key) + 0.19 (sky) = 0.95
//
// Only the key light casts shadows (--shadows, --ground), and these shadows are soft. The other lights represent large
// bright surfaces; ambient occlusion approximates the shadows of their light.
static int studio(lam_light *lights)
{
    lights[0] = lam_light_default(LAM_LIGHT_POINT);
    lights[0].name = "key";
    lights[0].frame = LAM_FRAME_VIEW;
    lights[0].position = v3(-1.23, 1.29, 2.66);
    lights[0].attenuation = (lam_attenuation){0.75f, 0, 0.0244f}; // the attenuation is 1 at the centre
    lights[0].diffuse = (lam_rgb){0.66f, 0.66f, 0.66f};
    lights[0].specular = (lam_rgb){0.9f, 0.9f, 0.9f};
    lights[0].occluded = 0.6f;
    lights[0].radius = 0.4f;
    lights[1] = camera_light("fill", v3(0.95, 0.25, -0.28), 0.06f, 0.10f);
    lights[1].type = LAM_LIGHT_POINT;
    lights[1].frame = LAM_FRAME_VIEW;
    lights[1].position = v3(2.0, 0.53, -0.59);
    lights[1].attenuation = (lam_attenuation){0, 0, 0.217f}; // 1 at the centre
    lights[1].occluded = 1;
    lights[1].no_shadows = true;
    lights[2] = camera_light("rim", v3(-0.53, 0.66, -0.55), 0.46f, 0.30f);
    lights[2].occluded = 0.6f;
    lights[2].no_shadows = true;
    lights[3] = lam_light_default(LAM_LIGHT_HEMISPHERE);
    lights[3].name = "sky";
    lights[3].sky = (lam_rgb){0.195f, 0.195f, 0.195f};
    lights[3].ground = (lam_rgb){0.066f, 0.066f, 0.066f};
    lights[3].by_diffuse = true;
    return 4;
}

static int headlight(lam_light *lights)
{
    lights[0] = camera_light("headlight", v3(0.0, 0.0, 1.0), 1.0f, 1.0f);
    return 1;
}

// Returns three lights as in portrait photography. The sum of all lights is at most 0.8 + 0.4·cos 73° + 0.05, which is
// below 1. The key light is twice as strong as the fill light.
static int three_point(lam_light *lights)
{
    lights[0] = camera_light("key", v3(-1.0, 1.0, 1.0), 0.8f, 0.8f);
    lights[1] = camera_light("fill", v3(1.0, 0.25, 1.0), 0.4f, 0.4f);
    lights[2] = camera_light("back", v3(0.5, 1.0, -1.0), 0.6f, 0.6f);
    lights[3] = lam_light_default(LAM_LIGHT_AMBIENT);
    lights[3].name = "ambient";
    lights[3].ambient = (lam_rgb){0.05f, 0.05f, 0.05f};
    return 4;
}

// Returns the light used by the first program of a typical lighting course.
static int lecture(lam_light *lights)
{
    lights[0] = lam_light_default(LAM_LIGHT_POINT);
    lights[0].name = "lecture";
    lights[0].position = v3(1.0, 2.0, 3.0);
    lights[0].ambient = (lam_rgb){0.1f, 0.1f, 0.1f};
    return 1;
}

int lam_rig_lights(lam_rig rig, lam_light *lights)
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
