// interface_scene.c: changes a reference scene so that a pair of shaders can express the scene. Undeclared inputs have
// the contract's values, and terms that are not in the contract are switched off.
#include "contract.h"
#include "shader_interface.h"

#include <string.h>

#include "linear.h"

static bool declares(const struct shader_interface *r, enum uniform_semantic semantic)
{
    return shader_interface_declares(r, semantic);
}

static lam_rgb times(lam_rgb a, lam_rgb b) { return (lam_rgb){a.r * b.r, a.g * b.g, a.b * b.b}; }

static lam_rgb color_of(const struct default_color *color, lam_rgb scene, lam_rgb diffuse, lam_rgb light)
{
    switch (color->source) {
    case COLOR_GIVEN:
        return color->value;
    case COLOR_OF_DIFFUSE:
        return diffuse;
    case COLOR_OF_LIGHT:
        return light;
    case COLOR_OF_SCENE:
        break;
    }
    return scene;
}

// Returns whether the shader declares a name for the product of a term's colour and strength. The product may include
// the light's colour.
static bool has_product(const struct shader_interface *r, enum uniform_semantic term)
{
    return declares(r, term) ||
           declares(r, (enum uniform_semantic)(term + SEMANTIC_AMBIENT_PRODUCT - SEMANTIC_AMBIENT));
}

enum light_term { LIGHT_DIFFUSE, LIGHT_SPECULAR, LIGHT_AMBIENT };

static lam_rgb *light_color(struct reference_light *light, enum light_term term)
{
    return term == LIGHT_DIFFUSE ? &light->color : term == LIGHT_SPECULAR ? &light->specular : &light->ambient;
}

// Sets the strength of a term to the fixed value if the shader declares no name for the strength. A scene switches a
// term off by setting its strength to 0. If the shader does not declare the strength, the term's colour becomes black
// instead. If the shader does not declare this colour either, the colours of the lights become black. `color` is NULL
// if the shader does not declare the term's colour. `lit` is set if the shader declares the colours of the lights.
static void fix_strength(struct reference_scene *s, const struct default_number *fixed, float *strength, lam_rgb *color,
                         bool lit, enum light_term term)
{
    const lam_rgb black = {0, 0, 0};
    if (!fixed->given)
        return;
    if (*strength == 0 && color)
        *color = black;
    for (int i = 0; i < s->light_count && *strength == 0 && !color && lit; i++)
        *light_color(&s->lights[i], term) = black;
    *strength = fixed->value;
}

static void adapt_material(const struct shader_interface *r, struct reference_scene *s)
{
    const struct contract_defaults *d = &r->defaults;
    bool ambient = has_product(r, SEMANTIC_AMBIENT), diffuse = has_product(r, SEMANTIC_DIFFUSE),
         specular = has_product(r, SEMANTIC_SPECULAR);
    bool own_specular = specular || declares(r, SEMANTIC_SPECULAR_COLOR);
    bool own_diffuse = diffuse || declares(r, SEMANTIC_COLOR);
    bool lit_specular = declares(r, SEMANTIC_LIGHT_SPECULAR);
    bool lit_ambient = declares(r, SEMANTIC_LIGHT_AMBIENT) || declares(r, SEMANTIC_AMBIENT_LIGHT);
    // If the material has no specular colour, the highlight has the light's colour.
    if (!own_specular && lit_specular && d->specular_color.source != COLOR_OF_SCENE)
        for (int i = 0; i < s->light_count; i++)
            s->lights[i].specular = times(s->lights[i].specular, s->specular);
    if (!own_diffuse)
        s->diffuse = color_of(&d->diffuse_color, s->diffuse, s->diffuse, s->diffuse);
    // If the shader declares a name for the product of the diffuse colour and its strength, the product is also used
    // for the other terms.
    lam_rgb own_color =
        diffuse ? (lam_rgb){s->diffuse.r * s->kd, s->diffuse.g * s->kd, s->diffuse.b * s->kd} : s->diffuse;
    if (!ambient)
        s->ambient = color_of(&d->ambient_color, s->ambient, own_color, own_color);
    if (!own_specular)
        s->specular = color_of(&d->specular_color, s->specular, own_color, own_color);
    // A black colour cannot replace a missing strength if another term has the same colour.
    bool shared = (!ambient && d->ambient_color.source == COLOR_OF_DIFFUSE) ||
                  (!own_specular && d->specular_color.source == COLOR_OF_DIFFUSE);
    bool lit_diffuse = declares(r, SEMANTIC_LIGHT_COLOR) && lit_specular;
    // If the light has an ambient colour, this colour includes the ambient strength.
    struct default_number ambient_strength = d->ambient_strength;
    if (lit_ambient && !(r->constants >> SEMANTIC_KA & 1))
        ambient_strength.value = 1;
    if (!ambient && !declares(r, SEMANTIC_KA))
        fix_strength(s, &ambient_strength, &s->ka, NULL, lit_ambient, LIGHT_AMBIENT);
    if (!diffuse && !declares(r, SEMANTIC_KD))
        fix_strength(s, &d->diffuse_strength, &s->kd, own_diffuse && !shared ? &s->diffuse : NULL, lit_diffuse,
                     LIGHT_DIFFUSE);
    if (!specular && !declares(r, SEMANTIC_KS))
        fix_strength(s, &d->specular_strength, &s->ks, own_specular ? &s->specular : NULL, lit_specular,
                     LIGHT_SPECULAR);
}

// Adapts a scene to shaders with metalness and roughness, which have no separate strengths of the terms. If a scene
// shows only the ambient term, its lights therefore become black.
static void adapt_physical(const struct shader_interface *r, struct reference_scene *s)
{
    const struct contract_defaults *d = &r->defaults;
    const lam_rgb black = {0, 0, 0}, white = {1, 1, 1};
    bool own = declares(r, SEMANTIC_COLOR) || declares(r, SEMANTIC_DIFFUSE), dark = s->kd == 0 && s->ks == 0;
    s->physical = true;
    s->is_radiance = !r->contract->printed;
    if (!own)
        s->diffuse = color_of(&d->diffuse_color, s->diffuse, s->diffuse, s->diffuse);
    if (!has_product(r, SEMANTIC_AMBIENT))
        s->ambient = color_of(&d->ambient_color, s->ambient, s->diffuse, s->diffuse);
    s->specular = white;
    s->kd = s->ks = 1;
    if (!has_product(r, SEMANTIC_AMBIENT) && !declares(r, SEMANTIC_KA) && d->ambient_strength.given)
        s->ka = d->ambient_strength.value;
    s->metallic = declares(r, SEMANTIC_METALLIC) ? s->metallic : 0;
    s->roughness = declares(r, SEMANTIC_ROUGHNESS) ? s->roughness : 1;
    bool sum = !declares(r, SEMANTIC_LIGHT_AMBIENT) && !declares(r, SEMANTIC_AMBIENT_LIGHT);
    for (int i = 0; i < s->light_count; i++) {
        struct reference_light *light = &s->lights[i];
        light->color = dark ? black : light->color;
        light->specular = dark ? black : light->specular;
        if (sum && i > 0) // the ambient light is a single number
            light->ambient = black;
    }
}

// Scales a light whose attenuation was changed, so that it is as bright as before at the scene's centre. An unscaled
// inverse square would be too dark.
static void keep_brightness(const struct reference_scene *s, const float before[3], struct reference_light *light)
{
    const float *now = light->attenuation, d = (float)v3_length(v3_sub(light->position, s->target));
    float k = (now[0] + now[1] * d + now[2] * d * d) / (before[0] + before[1] * d + before[2] * d * d);
    light->color = (lam_rgb){light->color.r * k, light->color.g * k, light->color.b * k};
    light->specular = (lam_rgb){light->specular.r * k, light->specular.g * k, light->specular.b * k};
}

// A point light also has an axis, because the shaders of spotlights normalize the axis. The axis points towards the
// model, so that every lit point is in front of the light.
static void set_axis(struct reference_light *light, lam_vec3 target)
{
    lam_vec3 to_light = light->to_light;
    if (to_light.x == 0 && to_light.y == 0 && to_light.z == 0)
        light->to_light = v3_unit(v3_sub(light->position, target));
}

static void adapt_light(const struct shader_interface *r, int index, const struct reference_scene *s,
                        struct reference_light *light)
{
    const struct contract_defaults *d = &r->defaults;
    unsigned rule = r->supports >> (RULE_FIRST + RULE_BITS * index), kind = rule & RULE_KIND;
    bool directional = kind ? kind == RULE_DIRECTIONAL : !(r->supports & NEED_POINT);
    if (rule & RULE_UNATTENUATED)
        memcpy(light->attenuation, (const float[]){1, 0, 0}, sizeof light->attenuation);
    if (light->type == LAM_LIGHT_POINT && directional) {
        light->type = LAM_LIGHT_DIRECTIONAL;
        light->to_light = light->position;
    }
    if ((d->has_direction || d->has_position) && !shader_interface_uses(r, SEMANTIC_LIGHT_POSITION) &&
        !shader_interface_uses(r, SEMANTIC_LIGHT_DIRECTION) && !shader_interface_uses(r, SEMANTIC_LIGHT_TRAVEL)) {
        struct reference_matrices m;
        lam_mat4 to_world = lam_mat4_identity();
        reference_matrices(s, &m);
        if (r->light_frame == LAM_FRAME_CAMERA)
            mat4_inverse_affine(&m.view, &to_world);
        else if (r->light_frame == LAM_FRAME_OBJECT)
            to_world = m.model;
        light->type = d->has_direction ? LAM_LIGHT_DIRECTIONAL : LAM_LIGHT_POINT;
        light->to_light = mat4_vector(&to_world, d->direction);
        if (d->has_position) {
            light->position = mat4_point(&to_world, d->direction);
            light->to_light = (lam_vec3){0, 0, 0};
        }
    }
    bool attenuated = declares(r, SEMANTIC_ATTENUATION) || declares(r, SEMANTIC_ATTENUATION_CONSTANT) ||
                      declares(r, SEMANTIC_ATTENUATION_LINEAR) || declares(r, SEMANTIC_ATTENUATION_QUADRATIC);
    float before[3];
    memcpy(before, light->attenuation, sizeof before);
    if (!attenuated && d->has_attenuation)
        memcpy(light->attenuation, d->attenuation, sizeof light->attenuation);
    if (r->physical && light->type != LAM_LIGHT_DIRECTIONAL)
        keep_brightness(s, before, light);
    if (light->type == LAM_LIGHT_DIRECTIONAL)
        memcpy(light->attenuation, (const float[]){1, 0, 0}, sizeof light->attenuation);
    if (!declares(r, SEMANTIC_SPOT_EXPONENT) && !declares(r, SEMANTIC_CONE) && d->spot_exponent.given)
        light->exponent = d->spot_exponent.value;
    lam_rgb none = {0, 0, 0};
    if (!declares(r, SEMANTIC_LIGHT_COLOR) && !declares(r, SEMANTIC_DIFFUSE_PRODUCT))
        light->color = color_of(&d->light_color, light->color, none, none);
    if (!declares(r, SEMANTIC_LIGHT_SPECULAR) && !declares(r, SEMANTIC_SPECULAR_PRODUCT))
        light->specular = color_of(&d->light_specular, light->specular, none, light->color);
    if (!declares(r, SEMANTIC_LIGHT_AMBIENT) && !declares(r, SEMANTIC_AMBIENT_LIGHT) &&
        !declares(r, SEMANTIC_AMBIENT_PRODUCT))
        light->ambient = color_of(&d->light_ambient, light->ambient, none, light->color);
    set_axis(light, s->target);
}

// --- array elements of the lights

int shader_interface_light_count(const struct shader_interface *r)
{
    int count = 0;
    for (int g = 0; g < MAX_LIGHT_GROUPS; g++)
        count += r->groups[g].count;
    return count > 0 ? count : 1;
}

static unsigned kind_bit(lam_light_type type)
{
    return type == LAM_LIGHT_DIRECTIONAL ? NEED_DIRECTIONAL : type == LAM_LIGHT_SPOT ? NEED_SPOT : NEED_POINT;
}

// Returns a group that allows a light of this type and contains a free element, or −1. `taken` marks the used elements.
static int find_group(const struct shader_interface *r, lam_light_type type, const int taken[MAX_LIGHT_GROUPS])
{
    for (int g = 0; g < MAX_LIGHT_GROUPS; g++)
        if (taken[g] < r->groups[g].count && r->groups[g].kinds & kind_bit(type))
            return g;
    return -1;
}

int shader_interface_light(const struct shader_interface *r, const struct reference_scene *s, int group, int element)
{
    int taken[MAX_LIGHT_GROUPS] = {0};
    for (int i = 0; i < s->light_count; i++) {
        int g = find_group(r, s->lights[i].type, taken);
        if (g >= 0 && g == group && taken[g] == element)
            return i;
        if (g >= 0)
            taken[g]++;
    }
    return -1;
}

// Removes the lights for which there is no array element. Adds a black light if an element is free, so that a shader
// that reads only the last light draws black.
static void place_lights(const struct shader_interface *r, struct reference_scene *s)
{
    int taken[MAX_LIGHT_GROUPS] = {0}, kept = 0;
    for (int i = 0; i < s->light_count; i++) {
        int g = find_group(r, s->lights[i].type, taken);
        if (g < 0)
            continue;
        taken[g]++;
        s->lights[kept++] = s->lights[i];
    }
    s->light_count = kept;
    const int capacity = shader_interface_light_count(r), lit = 3; // `lit` is the maximum number of lights in a scene
    int room = lit;
    for (int g = 0; g < MAX_LIGHT_GROUPS; g++) // only an array may contain more lights
        room = r->groups[g].count == capacity && !r->contract->printed ? MAX_SCENE_LIGHTS : room;
    for (int g = 0; g < MAX_LIGHT_GROUPS; g++)
        for (; r->groups[g].count > taken[g] && s->light_count < room; taken[g]++) {
            struct reference_light *black = &s->lights[s->light_count++];
            *black = (struct reference_light){
                .type = r->groups[g].kinds & NEED_POINT         ? LAM_LIGHT_POINT
                        : r->groups[g].kinds & NEED_DIRECTIONAL ? LAM_LIGHT_DIRECTIONAL
                                                                : LAM_LIGHT_SPOT,
                .position = {1, 2, 3},
                .to_light = {1, 2, 3},
                .attenuation = {1, 0, 0},
            };
            if (kept && black->type != LAM_LIGHT_DIRECTIONAL && s->lights[0].type != LAM_LIGHT_DIRECTIONAL)
                memcpy(black->attenuation, s->lights[0].attenuation, sizeof black->attenuation);
        }
    // If an array has more elements than there are lights, puts a light into the last element, to detect shaders that
    // omit this element. In printed shaders, each element has its own kind.
    for (int g = 0; g < MAX_LIGHT_GROUPS; g++)
        if (kept > 1 && r->groups[g].count == s->light_count && capacity == s->light_count && !r->contract->printed) {
            struct reference_light last = s->lights[kept - 1];
            s->lights[kept - 1] = s->lights[s->light_count - 1];
            s->lights[s->light_count - 1] = last;
        }
}

// Sets the contents of maps. The scene's values do not change, because each value is the product of
// a factor and a texel.
static void adapt_maps(const struct shader_interface *r, struct reference_scene *s)
{
    // if the vertex shader computes the lighting, maps with a factor are not used (their texels are 1)
    s->maps = r->vertex_lit ? r->maps & ~r->factors : r->maps;
    s->factors = r->factors;
    s->encoded_maps = r->contract->maps.encoded;
    s->tints_ambient = s->physical && s->maps & map_bit(SEMANTIC_BASE_COLOR_MAP) &&
                       (r->contract->printed || r->defaults.ambient_color.source == COLOR_OF_DIFFUSE);
    s->occlusion = r->contract->terms & TERM_AMBIENT ? s->ka : 0.6f;
    if (s->mesh >= MESH_PATCH && r->contract->maps.v_down)
        s->mesh += MESH_PATCH_DOWN - MESH_PATCH;
}

// If the shader has its own strengths and colours, each term uses one channel: the ambient term is red, the diffuse
// term is green, and the specular term is blue. The fit finds the factors of the terms.
static void separate_terms(struct reference_scene *s)
{
    const lam_rgb white = {1, 1, 1}, black = {0, 0, 0};
    s->ambient = (lam_rgb){1, 0, 0};
    s->diffuse = (lam_rgb){0, 1, 0};
    s->specular = (lam_rgb){0, 0, 1};
    s->ka = s->kd = s->ks = s->alpha = 1;
    s->occlusion = 0;
    for (int i = 0; i < s->light_count; i++) {
        s->lights[i].color = s->lights[i].specular = white;
        s->lights[i].ambient = i ? black : white;
    }
}

struct reference_scene shader_interface_scene(const struct shader_interface *r,
                                              const struct reference_scene *reference_scene)
{
    struct reference_scene s = *reference_scene;
    unsigned terms = r->contract->terms;
    for (int i = 0; i < s.light_count; i++)
        adapt_light(r, i, &s, &s.lights[i]);
    place_lights(r, &s);
    if (r->physical) {
        adapt_physical(r, &s);
    } else {
        adapt_material(r, &s);
        lam_reflection model = r->printed_model ? r->printed_model : r->contract->reflection;
        s.roughness_angle_rad = model == LAM_REFLECTION_TOON                         ? 3
                                : shader_interface_uses(r, SEMANTIC_ROUGHNESS_ANGLE) ? s.roughness
                                                                                     : 0;
        s.metallic = s.roughness = 0;
    }
    s.ka = terms & TERM_AMBIENT ? s.ka : 0;
    s.kd = terms & TERM_DIFFUSE ? s.kd : 0;
    s.ks = terms & TERM_SPECULAR && !(r->supports & RULE_NO_SPECULAR) ? s.ks : 0;
    adapt_maps(r, &s);
    s.dims_ambient = r->gl1;
    s.flat |= (r->supports & RULE_FLAT) != 0;
    if (!declares(r, SEMANTIC_SHININESS) && r->defaults.shininess.given)
        s.shininess = r->defaults.shininess.value;
    if (!(r->contract->supports & NEED_ALPHA))
        s.alpha = 1;
    if (r->contract->any_strengths)
        separate_terms(&s);
    if (r->contract->any_strengths && !shader_interface_uses(r, SEMANTIC_SHININESS))
        s.shininess = 1;
    return s;
}
