// uniform_semantic.c: a reference scene as a contract can express it, and the value of each uniform.
#include "contract.h"

#include <string.h>

#include "linear.h"

// For contracts without specular colours or strengths: the surface has one colour, and the highlight the light's. A
// term is switched off by black.
static void use_single_color(struct reference_scene *s)
{
    if (s->kd == 0)
        s->diffuse = (lam_rgb){0, 0, 0};
    for (int i = 0; i < s->light_count; i++) {
        lam_rgb *c = &s->lights[i].specular;
        float on = s->ks > 0 ? 1 : 0;
        *c = (lam_rgb){c->r * s->specular.r * on, c->g * s->specular.g * on, c->b * s->specular.b * on};
    }
    s->specular = (lam_rgb){1, 1, 1};
    s->kd = s->ks = 1;
}

static void limit_light(const struct contract *contract, unsigned supports, int index, struct reference_light *light)
{
    unsigned rule = supports >> (RULE_FIRST + RULE_BITS * index), kind = rule & RULE_KIND;
    bool directional = kind ? kind == RULE_DIRECTIONAL : !(supports & NEED_POINT);
    if (rule & RULE_UNATTENUATED)
        memcpy(light->attenuation, (const float[]){1, 0, 0}, sizeof light->attenuation);
    if (light->type == LAM_LIGHT_POINT && directional) {
        light->type = LAM_LIGHT_DIRECTIONAL;
        light->to_light = light->position;
    }
    if (contract->attenuated_points)
        memcpy(light->attenuation, contract->attenuation, sizeof light->attenuation);
    if (!contract->has_attenuation || light->type == LAM_LIGHT_DIRECTIONAL)
        memcpy(light->attenuation, (const float[]){1, 0, 0}, sizeof light->attenuation);
    if (!contract->light_colors)
        light->color = light->specular = light->ambient = (lam_rgb){1, 1, 1};
}

// A point light has an axis too, which shaders of spots normalize: towards the model, so that every lit point is in
// front of it.
static void set_axis(struct reference_light *light, lam_vec3 target)
{
    lam_vec3 to_light = light->to_light;
    if (to_light.x == 0 && to_light.y == 0 && to_light.z == 0)
        light->to_light = v3_unit(v3_sub(light->position, target));
}

struct reference_scene contract_reference_scene(const struct contract *contract, unsigned supports,
                                                const struct reference_scene *reference_scene, int light_count)
{
    struct reference_scene s = *reference_scene;
    if (!contract->own_ambient_color)
        s.ambient = s.diffuse;
    if (!contract->has_ambient)
        s.ka = 0;
    // Unused entries of the list are black.
    while (s.light_count < light_count && s.light_count < MAX_SCENE_LIGHTS)
        s.lights[s.light_count++] = (struct reference_light){
            .type = s.lights[0].type, .position = {1, 2, 3}, .to_light = {1, 2, 3}, .attenuation = {1, 0, 0}};
    if (s.light_count > light_count)
        s.light_count = light_count;
    for (int i = 0; i < s.light_count; i++) {
        limit_light(contract, supports, i, &s.lights[i]);
        set_axis(&s.lights[i], s.target);
    }
    if (supports & RULE_NO_SPECULAR)
        s.ks = 0;
    s.flat |= (supports & RULE_FLAT) != 0;
    if (!contract->material_strengths && !contract->own_ambient_color)
        use_single_color(&s);
    if (contract->shininess > 0)
        s.shininess = contract->shininess;
    if (!(contract->supports & NEED_ALPHA))
        s.alpha = 1;
    return s;
}

// --- values

static struct uniform_value color(lam_rgb c, float strength, float alpha)
{
    return (struct uniform_value){{c.r * strength, c.g * strength, c.b * strength, alpha}};
}

static struct uniform_value vector(lam_vec3 v, float w)
{
    return (struct uniform_value){{(float)v.x, (float)v.y, (float)v.z, w}};
}

static struct uniform_value number(float x) { return (struct uniform_value){{x}}; }

struct uniform_value matrix_value(const lam_mat4 *m)
{
    struct uniform_value out;
    for (int c = 0; c < 4; c++)
        for (int r = 0; r < 4; r++)
            out.v[4 * c + r] = (float)m->m[r][c];
    return out;
}

static lam_rgb product(lam_rgb a, lam_rgb b) { return (lam_rgb){a.r * b.r, a.g * b.g, a.b * b.b}; }

static lam_rgb total_ambient(const struct reference_scene *s)
{
    lam_rgb sum = {0, 0, 0};
    for (int i = 0; i < s->light_count; i++)
        sum = (lam_rgb){sum.r + s->lights[i].ambient.r, sum.g + s->lights[i].ambient.g, sum.b + s->lights[i].ambient.b};
    return sum;
}

// From world space to the space of the contract's light positions.
static lam_mat4 light_matrix(lam_light_frame frame, const struct reference_matrices *m)
{
    lam_mat4 out = lam_mat4_identity();
    if (frame == LAM_FRAME_OBJECT)
        mat4_inverse_affine(&m->model, &out);
    else if (frame == LAM_FRAME_CAMERA)
        out = m->view;
    return out;
}

static struct uniform_value light_position(const struct reference_light *light, const lam_mat4 *to)
{
    return light->type == LAM_LIGHT_DIRECTIONAL ? vector(mat4_vector(to, light->to_light), 0)
                                                : vector(mat4_point(to, light->position), 1);
}

// Cosine of the cutoff, exponent, and for shaders with two angles a hard edge at the cutoff, or none.
static struct uniform_value cone(const struct reference_light *light)
{
    if (light->cutoff_deg <= 0)
        return (struct uniform_value){{-1, light->exponent, -2, 1}};
    float cosine = (float)math_cos(math_radians((double)light->cutoff_deg));
    return (struct uniform_value){{cosine, light->exponent, cosine, 1000}};
}

struct uniform_value uniform_semantic_value(enum uniform_semantic semantic, int index, const struct contract *contract,
                                            lam_light_frame light_frame, const struct reference_scene *s,
                                            const struct reference_matrices *m)
{
    static const struct reference_light none = {
        .type = LAM_LIGHT_POINT, .position = {1, 1, 1}, .to_light = {0, 0, 1}, .attenuation = {1, 0, 0}};
    const struct reference_light *light = index < s->light_count ? &s->lights[index] : &none;
    const float *a = light->attenuation;
    lam_mat4 to = light_matrix(light_frame, m);
    bool products =
        contract->products || (semantic >= SEMANTIC_AMBIENT_PRODUCT && semantic <= SEMANTIC_SPECULAR_PRODUCT);
    lam_rgb one = {1, 1, 1};
    switch (semantic) {
    case SEMANTIC_MODEL_VIEW:
        return matrix_value(&m->model_view);
    case SEMANTIC_PROJECTION:
        return matrix_value(&m->projection);
    case SEMANTIC_MODEL_VIEW_PROJECTION:
        return matrix_value(&m->model_view_projection);
    case SEMANTIC_MODEL:
        return matrix_value(&m->model);
    case SEMANTIC_VIEW:
        return matrix_value(&m->view);
    case SEMANTIC_NORMAL_MATRIX:
        return matrix_value(&m->normal4);
    case SEMANTIC_AMBIENT:
    case SEMANTIC_AMBIENT_PRODUCT:
        return color(product(s->ambient, products ? total_ambient(s) : one), s->ka, 1);
    case SEMANTIC_DIFFUSE:
    case SEMANTIC_DIFFUSE_PRODUCT:
        return color(product(s->diffuse, products ? light->color : one), s->kd, s->alpha);
    case SEMANTIC_SPECULAR:
    case SEMANTIC_SPECULAR_PRODUCT:
        return color(product(s->specular, products ? light->specular : one), s->ks, 1);
    case SEMANTIC_KA:
        return number(s->ka);
    case SEMANTIC_KD:
        return number(s->kd);
    case SEMANTIC_KS:
        return number(s->ks);
    case SEMANTIC_COLOR:
        return color(s->diffuse, 1, s->alpha);
    case SEMANTIC_SPECULAR_COLOR:
        return color(s->specular, 1, 1);
    case SEMANTIC_SHININESS:
        return number(s->shininess);
    case SEMANTIC_LIGHT_POSITION:
        return light_position(light, &to);
    case SEMANTIC_LIGHT_X:
    case SEMANTIC_LIGHT_Y:
    case SEMANTIC_LIGHT_Z:
        return number(light_position(light, &to).v[semantic - SEMANTIC_LIGHT_X]);
    case SEMANTIC_LIGHT_DIRECTION:
        return vector(v3_unit(mat4_vector(&to, light->to_light)), 0);
    case SEMANTIC_LIGHT_TRAVEL:
        return vector(v3_scale(v3_unit(mat4_vector(&to, light->to_light)), -1), 0);
    case SEMANTIC_LIGHT_COLOR:
        return color(light->color, 1, 1);
    case SEMANTIC_LIGHT_SPECULAR:
        return color(light->specular, 1, 1);
    case SEMANTIC_LIGHT_AMBIENT:
        return color(light->ambient, 1, 1);
    case SEMANTIC_AMBIENT_LIGHT:
        return color(total_ambient(s), 1, 1);
    case SEMANTIC_ATTENUATION_CONSTANT:
    case SEMANTIC_ATTENUATION_LINEAR:
    case SEMANTIC_ATTENUATION_QUADRATIC:
        return number(a[semantic - SEMANTIC_ATTENUATION_CONSTANT]);
    case SEMANTIC_ATTENUATION:
        return (struct uniform_value){{a[0], a[1], a[2]}};
    case SEMANTIC_CONE:
        return cone(light);
    case SEMANTIC_ONE:
        return number(1);
    case SEMANTIC_LIGHT_COUNT:
        return number((float)s->light_count);
    case SEMANTIC_FLAT:
        return number(s->flat);
    case SEMANTIC_LIGHT_IN_EYE:
        return light_position(light, &m->view);
    case SEMANTIC_EYE_POSITION:
        return vector((lam_vec3){0, 0, 0}, 1);
    default: // SEMANTIC_ZERO, and attributes
        return (struct uniform_value){{0}};
    }
}
