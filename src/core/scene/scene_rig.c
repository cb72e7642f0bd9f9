// scene_rig.c: places the lights of a rig in a scene, adapts the lights to the scene's form and materials, and selects
// the tone curve.
#include "scene_internal.h"

#include "environment.h"
#include "linear.h"
#include "up_axis.h"

#include <lambent/device.h>
#include <lambent/light.h>
#include <lambent/material.h>

#include <float.h>

// The smallest kd of a grey model that is lit for contrast, and the kd at which the brightest points are displayed
// nearly white.
#define GREY_MIN   0.3f
#define GREY_SHOWN 0.62

// Returns whether an object shows the default material.
static bool shows_default(const struct lam_scene *scene)
{
    bool shows = !scene->materials.count;
    for (int i = 0; i < scene->objects.count && !shows; i++) {
        const lam_mesh *mesh = scene_mesh(scene, scene_object(scene, i)->mesh);
        shows = scene_object(scene, i)->material < 0 && !mesh->part_count;
        for (uint32_t k = 0; scene_object(scene, i)->material < 0 && k < mesh->part_count && !shows; k++)
            shows = mesh->parts[k].material < 0;
    }
    return shows;
}

// Returns whether the environment, or the studio if there is none, lights the materials: all are physical.
static bool all_physical(const struct lam_scene *scene)
{
    if (!scene->environment && !environment_lookups_of(1)) // a build without effects has no studio
        return false;
    int physical = 0, classic = 0;
    for (int i = shows_default(scene) ? -1 : 0; i < scene->materials.count; i++) {
        const lam_material *material = i < 0 ? scene->default_material : lam_scene_material(scene, i);
        physical += material->physical && !material->unlit;
        classic += !material->physical && !material->unlit;
    }
    return physical && !classic;
}

bool scene_lit_by_environment(const struct lam_scene *scene)
{
    return !scene->lights.count && ((scene->environment && !scene->reflection_map) || all_physical(scene));
}

bool scene_needs_form(const struct lam_scene *scene) { return !scene->lights.count && !all_physical(scene); }

// Returns the largest kd of the materials if all are a grey of at least GREY_MIN without textures, and no mesh has
// colours; otherwise 0.
static double grey_reflectance(const struct lam_scene *scene)
{
    double largest = 0;
    for (int i = shows_default(scene) ? -1 : 0; i < scene->materials.count; i++) {
        const lam_material *m = i < 0 ? scene->default_material : lam_scene_material(scene, i);
        bool grey = m->diffuse.r == m->diffuse.g && m->diffuse.g == m->diffuse.b && m->emission.r == 0 &&
                    m->emission.g == 0 && m->emission.b == 0;
        if (!grey || !(m->diffuse.r >= GREY_MIN) || m->physical || m->unlit || m->maps[LAM_MAP_DIFFUSE])
            return 0;
        largest = (double)m->diffuse.r > largest ? (double)m->diffuse.r : largest;
    }
    for (int i = 0; i < scene->objects.count; i++)
        if (scene_mesh(scene, scene_object(scene, i)->mesh)->colors)
            return 0;
    return largest;
}

// Returns whether the studio is the only light.
static bool studio_only(const struct lam_scene *scene, lam_rig rig)
{
    bool studio = rig == LAM_RIG_STUDIO || (rig == LAM_RIG_AUTO && !scene_lit_by_environment(scene));
    return studio && !scene->lights.count;
}

// Returns whether a scene that only the studio lights suits LAM_TONE_CONTRAST: the scene is a curved model or a terrain,
// all materials are light grey without textures, and no mesh has colours. `ground`: as in lam_scene_rig_lights.
static bool suits_contrast(const struct lam_scene *scene, bool ground)
{
    return !ground && grey_reflectance(scene) > 0 && scene_form(scene) != FORM_FLAT;
}

// Returns whether light colours all surfaces: no material is unlit or emits light, so that no colour must stay as it is.
static bool all_lit(const struct lam_scene *scene)
{
    bool lit = true;
    for (int i = 0; i < scene->materials.count; i++) {
        const lam_material *m = lam_scene_material(scene, i);
        lit &= !m->unlit && !(m->emission.r > 0 || m->emission.g > 0 || m->emission.b > 0);
    }
    return lit;
}

static lam_rgb grey(double value) { return (lam_rgb){(float)value, (float)value, (float)value}; }

// Lights a grey model for LAM_TONE_CONTRAST: the key light is next to the eye and equally strong everywhere. For
// terrains, the key light comes from below the view's axis (suit_scene). The lights are dimmed for materials with a kd
// above GREY_SHOWN, so that no part of these materials is displayed as plain white.
static void suit_contrast(lam_light *key, lam_light *fill, lam_light *sky, enum scene_form form, double reflectance)
{
    const double share = reflectance > GREY_SHOWN ? GREY_SHOWN / reflectance : 1;
    const bool curved = form == FORM_CURVED;
    key->position = curved ? v3(-0.2, 0.3, 3.1) : v3(-0.45, -0.35, 3.1);
    key->attenuation = (lam_attenuation){1, 0, 0};
    key->diffuse = grey((curved ? 0.88 : 0.94) * share);
    key->specular = grey(0.2 * share);
    fill->diffuse = grey(0.03 * share);
    sky->sky = grey((curved ? 0.11 : 0.07) * share);
    sky->ground = grey(0.02 * share);
}

// A curved model is lit from near the eye, so that outlines are dark and small slopes are visible. At most, a point
// reflects 0.9·1.33 (key) + 0.07 (sky) = 1.27 times kd. A terrain is lit from below the view's axis, because
// light from above brightens all slopes alike: level ground is dark, and slopes that face the viewer are bright.
// Returns the number of lights: `count` if the faces are flat.
static int suit_scene(lam_light lights[LAM_RIG_LIGHTS_MAX], int count, const struct lam_scene *scene)
{
    enum scene_form form = scene_form(scene);
    lights[0].occluded = lights[2].occluded = 1;
    if (form == FORM_FLAT)
        return count;
    lights[2] = lights[3]; // no rim light
    lam_light *key = &lights[0], *fill = &lights[1], *sky = &lights[2];
    fill->type = LAM_LIGHT_DIRECTIONAL; // these models have no large faces that need a falloff
    fill->frame = LAM_FRAME_CAMERA;
    double reflectance = grey_reflectance(scene);
    if (reflectance > 0) {
        suit_contrast(key, fill, sky, form, reflectance);
    } else if (form == FORM_CURVED) {
        key->position = v3(-1.1, 1.1, 2.75);
        key->specular = grey(0.6);
        key->diffuse = grey(0.9);
        fill->diffuse = grey(0.03);
        sky->sky = grey(0.07);
        sky->ground = grey(0.02);
    } else {
        key->position = v3(-1.0, -0.7, 2.9);
        key->diffuse = grey(1.2);
        fill->diffuse = grey(0.05);
        sky->sky = grey(0.03);
        sky->ground = grey(0.02);
    }
    return 3;
}

// Divides; a quotient beyond the range of a float, for a tiny scene, becomes the largest float.
static float divided(float number, double by)
{
    double quotient = (double)number / by;
    return quotient < (double)FLT_MAX ? (float)quotient : FLT_MAX;
}

// Moves a light of a rig, which is defined for a scene of radius 1, to its position in this scene.
static void place_rig_light(const lam_scene *scene, lam_light *light)
{
    lam_vec3 low, high, centre = v3(0, 0, 0);
    double radius = 0;
    if (light->type != LAM_LIGHT_POINT && light->type != LAM_LIGHT_SPOT)
        return;
    if (light->frame == LAM_FRAME_WORLD)
        lam_scene_sphere(scene, -1, &centre, &radius);
    // uses half the diagonal of the bounding box, which needs no pass over the vertices
    else if (scene && lam_scene_bounds(scene, &low, &high))
        radius = 0.5 * v3_length(v3_sub(high, low));
    if (radius == 0)
        radius = 1;
    if (light->frame == LAM_FRAME_WORLD)
        light->position = from_y_up(lam_scene_up(scene), light->position);
    light->position = v3_add(centre, v3_scale(light->position, radius));
    light->radius = (float)((double)light->radius * radius);
    light->attenuation.linear = divided(light->attenuation.linear, radius);
    light->attenuation.quadratic = divided(light->attenuation.quadratic, radius * radius);
}

int lam_scene_rig_lights(const lam_scene *scene, lam_rig rig, bool ground, lam_light *lights)
{
    if (rig == LAM_RIG_AUTO)
        rig = lam_scene_light_count(scene) || scene_lit_by_environment(scene) ? LAM_RIG_NONE : LAM_RIG_STUDIO;
    int count = lam_rig_lights(rig, lights);
    if (rig == LAM_RIG_STUDIO && !ground)
        count = suit_scene(lights, count, scene);
    for (int i = 0; i < count; i++)
        place_rig_light(scene, &lights[i]);
    return count;
}

lam_tone lam_draw_tone(const lam_scene *scene, const lam_draw_params *params)
{
    const lam_reflection_info *model =
        params->reflection == LAM_REFLECTION_AUTO ? NULL : lam_reflection_describe(params->reflection);
    if (params->tone || params->color == LAM_COLOR_RAW || !scene || !studio_only(scene, params->rig) ||
        (model && (model->microfacet || params->reflection == LAM_REFLECTION_NONE)))
        return params->tone;
    // threads are bright far from the light's mirror direction, so the curve would make most of a solid white
    if (suits_contrast(scene, params->ground) && !(model && model->tangents))
        return LAM_TONE_CONTRAST;
    return all_lit(scene) ? LAM_TONE_SOFT : LAM_TONE_AUTO;
}
