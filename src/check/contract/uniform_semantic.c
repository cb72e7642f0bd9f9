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
    for (int i = 0; i < s.light_count; i++)
        limit_light(contract, supports, i, &s.lights[i]);
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

static int put_color(float out[16], lam_rgb c, float strength, float alpha)
{
    out[0] = c.r * strength;
    out[1] = c.g * strength;
    out[2] = c.b * strength;
    out[3] = alpha;
    return 4;
}

static int put_product(float out[16], lam_rgb c, float strength, lam_rgb light, float alpha)
{
    return put_color(out, (lam_rgb){c.r * light.r, c.g * light.g, c.b * light.b}, strength, alpha);
}

static int put_vector(float out[16], lam_vec3 v, float w)
{
    out[0] = (float)v.x;
    out[1] = (float)v.y;
    out[2] = (float)v.z;
    out[3] = w;
    return 4;
}

static int put_number(float out[16], float x)
{
    out[0] = x;
    return 1;
}

static int put_matrix(float out[16], const lam_mat4 *m)
{
    for (int c = 0; c < 4; c++)
        for (int r = 0; r < 4; r++)
            out[4 * c + r] = (float)m->m[r][c];
    return 16;
}

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

static int put_light_position(float out[16], const struct reference_light *light, const lam_mat4 *to)
{
    if (light->type == LAM_LIGHT_DIRECTIONAL)
        return put_vector(out, mat4_vector(to, light->to_light), 0);
    return put_vector(out, mat4_point(to, light->position), 1);
}

int uniform_semantic_value(enum uniform_semantic semantic, int index, const struct contract *contract,
                           lam_light_frame light_frame, const struct reference_scene *s,
                           const struct reference_matrices *m, float out[16])
{
    static const struct reference_light none = {
        .type = LAM_LIGHT_POINT, .position = {1, 1, 1}, .to_light = {0, 0, 1}, .attenuation = {1, 0, 0}};
    memset(out, 0, 16 * sizeof *out);
    const struct reference_light *light = index < s->light_count ? &s->lights[index] : &none;
    lam_mat4 to = light_matrix(light_frame, m);
    lam_rgb one = {1, 1, 1};
    bool products = contract->products;
    float place[16];
    put_light_position(place, light, &to);
    switch (semantic) {
    case SEMANTIC_MODEL_VIEW:
        return put_matrix(out, &m->model_view);
    case SEMANTIC_PROJECTION:
        return put_matrix(out, &m->projection);
    case SEMANTIC_MODEL_VIEW_PROJECTION:
        return put_matrix(out, &m->model_view_projection);
    case SEMANTIC_MODEL:
        return put_matrix(out, &m->model);
    case SEMANTIC_VIEW:
        return put_matrix(out, &m->view);
    case SEMANTIC_NORMAL_MATRIX:
        return put_matrix(out, &m->normal4);
    case SEMANTIC_AMBIENT:
        return put_product(out, s->ambient, s->ka, products ? total_ambient(s) : one, 1);
    case SEMANTIC_DIFFUSE:
        return put_product(out, s->diffuse, s->kd, products ? light->color : one, s->alpha);
    case SEMANTIC_SPECULAR:
        return put_product(out, s->specular, s->ks, products ? light->specular : one, 1);
    case SEMANTIC_AMBIENT_PRODUCT:
        return put_product(out, s->ambient, s->ka, total_ambient(s), 1);
    case SEMANTIC_DIFFUSE_PRODUCT:
        return put_product(out, s->diffuse, s->kd, light->color, s->alpha);
    case SEMANTIC_SPECULAR_PRODUCT:
        return put_product(out, s->specular, s->ks, light->specular, 1);
    case SEMANTIC_KA:
        return put_number(out, s->ka);
    case SEMANTIC_KD:
        return put_number(out, s->kd);
    case SEMANTIC_KS:
        return put_number(out, s->ks);
    case SEMANTIC_COLOR:
        return put_color(out, s->diffuse, 1, s->alpha);
    case SEMANTIC_SPECULAR_COLOR:
        return put_color(out, s->specular, 1, 1);
    case SEMANTIC_SHININESS:
        return put_number(out, s->shininess);
    case SEMANTIC_LIGHT_POSITION:
        memcpy(out, place, sizeof place);
        return 4;
    case SEMANTIC_LIGHT_X:
        return put_number(out, place[0]);
    case SEMANTIC_LIGHT_Y:
        return put_number(out, place[1]);
    case SEMANTIC_LIGHT_Z:
        return put_number(out, place[2]);
    case SEMANTIC_LIGHT_DIRECTION:
        return put_vector(out, v3_unit(mat4_vector(&to, light->to_light)), 0);
    case SEMANTIC_LIGHT_TRAVEL:
        return put_vector(out, v3_scale(v3_unit(mat4_vector(&to, light->to_light)), -1), 0);
    case SEMANTIC_LIGHT_COLOR:
        return put_color(out, light->color, 1, 1);
    case SEMANTIC_LIGHT_SPECULAR:
        return put_color(out, light->specular, 1, 1);
    case SEMANTIC_LIGHT_AMBIENT:
        return put_color(out, light->ambient, 1, 1);
    case SEMANTIC_AMBIENT_LIGHT:
        return put_color(out, total_ambient(s), 1, 1);
    case SEMANTIC_ATTENUATION_CONSTANT:
        return put_number(out, light->attenuation[0]);
    case SEMANTIC_ATTENUATION_LINEAR:
        return put_number(out, light->attenuation[1]);
    case SEMANTIC_ATTENUATION_QUADRATIC:
        return put_number(out, light->attenuation[2]);
    case SEMANTIC_ATTENUATION:
        memcpy(out, light->attenuation, sizeof light->attenuation);
        return 4;
    case SEMANTIC_CONE:
        out[0] = light->cutoff_deg > 0 ? (float)math_cos(math_radians((double)light->cutoff_deg)) : -1.0f;
        out[1] = light->exponent;
        out[2] = light->cutoff_deg > 0 ? out[0] : -2.0f; // a hard edge at the cutoff, or none
        out[3] = light->cutoff_deg > 0 ? 1000.0f : 1.0f;
        return 4;
    case SEMANTIC_ONE:
        return put_number(out, 1);
    case SEMANTIC_LIGHT_COUNT:
        return put_number(out, (float)s->light_count);
    case SEMANTIC_FLAT:
        return put_number(out, s->flat);
    case SEMANTIC_LIGHT_IN_EYE:
        return put_light_position(out, light, &m->view);
    case SEMANTIC_EYE_POSITION:
        return put_vector(out, (lam_vec3){0, 0, 0}, 1);
    default:
        return 16; // SEMANTIC_ZERO, and attributes
    }
}
