// uniform_semantic.c: computes the value of each uniform in a reference scene.
#include "contract.h"

#include "linear.h"

static struct uniform_value color(lam_rgb c, float strength, float alpha)
{
    return (struct uniform_value){{c.r * strength, c.g * strength, c.b * strength, alpha}};
}

static struct uniform_value vector(lam_vec3 v, float w)
{
    return (struct uniform_value){{(float)v.x, (float)v.y, (float)v.z, w}};
}

// Returns the factor whose product with the map's texel is the given colour.
static struct uniform_value color_factor(const struct reference_scene *s, enum map_number number, lam_rgb c,
                                         float alpha)
{
    return (struct uniform_value){
        {map_factor(s, number, c.r), map_factor(s, number, c.g), map_factor(s, number, c.b), alpha}};
}

// Returns a colour, such as the diffuse colour of a light, divided by the texel of the base colour map. The shader
// multiplies the result by this texel.
static struct uniform_value without_texel(const struct reference_scene *s, struct uniform_value c)
{
    const float base[] = {s->diffuse.r, s->diffuse.g, s->diffuse.b};
    for (int i = 0; i < 3 && s->tints_ambient; i++)
        c.v[i] *= map_factor(s, NUMBER_BASE_COLOR, base[i]) / base[i];
    return c;
}

static struct uniform_value number(float x) { return (struct uniform_value){{x}}; }

struct uniform_value matrix_value(const lam_mat4 *m)
{
    struct uniform_value out = {{0}};
    for (int c = 0; c < 4; c++)
        for (int r = 0; r < 4; r++)
            out.v[4 * c + r] = (float)m->m[r][c];
    return out;
}

static lam_rgb product(lam_rgb a, lam_rgb b) { return (lam_rgb){a.r * b.r, a.g * b.g, a.b * b.b}; }

static lam_rgb total_ambient(const struct reference_scene *s)
{
    lam_rgb sum = {0, 0, 0};
    for (int i = 0; i < s->light_count && !s->dims_ambient; i++)
        sum = (lam_rgb){sum.r + s->lights[i].ambient.r, sum.g + s->lights[i].ambient.g, sum.b + s->lights[i].ambient.b};
    return sum;
}

// Returns the matrix that transforms world space to the space `frame`.
static lam_mat4 matrix_to(lam_light_frame frame, const struct reference_matrices *m)
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

// Returns the numbers of a spot light's cone: the cosine of the cutoff and the exponent. The other two numbers are for
// shaders with two angles. They make the edge at the cutoff hard, or remove the edge if the light is not a spot.
static struct uniform_value cone(const struct reference_light *light)
{
    if (light->cutoff_deg <= 0)
        return (struct uniform_value){{-1, light->exponent, -2, 1}};
    float cosine = (float)math_cos(math_radians((double)light->cutoff_deg));
    return (struct uniform_value){{cosine, light->exponent, cosine, 1e5f}};
}

// Returns the factor for the intensities of lights. Published shaders with metalness and roughness divide the reflected
// light by pi. Lambent's intensities include pi: a white surface that faces a light of intensity 1 has the value 1.
static float light_scale(const struct reference_scene *s) { return s->is_radiance ? (float)PI : 1; }

// Returns the inverse transpose of the matrix that transforms the model's space to `space`.
static struct uniform_value normal_matrix(lam_light_frame space, const struct reference_matrices *m)
{
    if (space == LAM_FRAME_CAMERA)
        return matrix_value(&m->normal4);
    lam_mat4 inverse = lam_mat4_identity(), out = inverse;
    if (space == LAM_FRAME_WORLD)
        mat4_inverse_affine(&m->model, &inverse);
    for (int r = 0; r < 4; r++)
        for (int c = 0; c < 4; c++)
            out.m[r][c] = inverse.m[c][r];
    return matrix_value(&out);
}

struct uniform_value uniform_semantic_value(enum uniform_semantic semantic, int index, lam_light_frame space,
                                            const struct reference_scene *s, const struct reference_matrices *m)
{
    static const struct reference_light none = {
        .type = LAM_LIGHT_POINT, .position = {1, 1, 1}, .to_light = {0, 0, 1}, .attenuation = {1, 0, 0}};
    const struct reference_light *light = index >= 0 && index < s->light_count ? &s->lights[index] : &none;
    const float *a = light->attenuation;
    if (is_map(semantic))
        return map_texel(semantic, s);
    const lam_mat4 to = matrix_to(space, m), view_projection = mat4_mul(&m->projection, &m->view);
    const lam_vec3 to_light = v3_unit(mat4_vector(&to, light->to_light));
    const struct uniform_value position = light_position(light, &to), edge = cone(light);
    const float kind = light->type == LAM_LIGHT_DIRECTIONAL ? 0 : light->type == LAM_LIGHT_POINT ? 1 : 2;
    const struct uniform_value base = color_factor(s, NUMBER_BASE_COLOR, s->diffuse, s->alpha);
    // The values of all roles. The values of attributes and of SEMANTIC_ZERO are 0.
    const struct uniform_value values[SEMANTIC_COUNT] = {
        [SEMANTIC_MODEL_VIEW] = matrix_value(&m->model_view),
        [SEMANTIC_PROJECTION] = matrix_value(&m->projection),
        [SEMANTIC_MODEL_VIEW_PROJECTION] = matrix_value(&m->model_view_projection),
        [SEMANTIC_MODEL] = matrix_value(&m->model),
        [SEMANTIC_VIEW] = matrix_value(&m->view),
        [SEMANTIC_VIEW_PROJECTION] = matrix_value(&view_projection),
        [SEMANTIC_NORMAL_MATRIX] = normal_matrix(space, m),
        [SEMANTIC_AMBIENT] = without_texel(s, color(s->ambient, s->ka, 1)),
        [SEMANTIC_AMBIENT_PRODUCT] = without_texel(s, color(product(s->ambient, total_ambient(s)), s->ka, 1)),
        [SEMANTIC_DIFFUSE] = s->physical ? base : color(s->diffuse, s->kd, s->alpha),
        // A metal does not scatter light, so the diffuse product of a metal is 0. `metallic` is 0 if the shader has no
        // name for it.
        [SEMANTIC_DIFFUSE_PRODUCT] = color(product(s->diffuse, light->color), s->kd * (1 - s->metallic), s->alpha),
        [SEMANTIC_SPECULAR] = color(s->specular, s->ks, 1),
        [SEMANTIC_SPECULAR_PRODUCT] = color(product(s->specular, light->specular), s->ks, 1),
        [SEMANTIC_LIGHT_AMBIENT_PRODUCT] = color(product(s->ambient, light->ambient), s->ka, 1),
        [SEMANTIC_KA] = number(map_factor(s, NUMBER_OCCLUSION, s->ka)),
        [SEMANTIC_KD] = number(s->kd),
        [SEMANTIC_KS] = number(s->ks),
        [SEMANTIC_COLOR] = s->physical ? base : color(s->diffuse, 1, s->alpha),
        [SEMANTIC_SPECULAR_COLOR] = color(s->specular, 1, 1),
        [SEMANTIC_SHININESS] = number(s->shininess),
        [SEMANTIC_LIGHT_POSITION] = position,
        [SEMANTIC_LIGHT_X] = number(position.v[0]),
        [SEMANTIC_LIGHT_Y] = number(position.v[1]),
        [SEMANTIC_LIGHT_Z] = number(position.v[2]),
        [SEMANTIC_LIGHT_DIRECTION] = vector(to_light, 0),
        [SEMANTIC_LIGHT_TRAVEL] = vector(v3_scale(to_light, -1), 0),
        [SEMANTIC_METALLIC] = number(map_factor(s, NUMBER_METALLIC, s->metallic)),
        [SEMANTIC_ROUGHNESS] = number(map_factor(s, NUMBER_ROUGHNESS, s->roughness)),
        [SEMANTIC_ROUGHNESS_ANGLE] = number(s->roughness_angle_rad),
        [SEMANTIC_LIGHT_KIND] = number(kind),
        [SEMANTIC_LIGHT_COLOR] = color(light->color, light_scale(s), 1),
        [SEMANTIC_LIGHT_SPECULAR] = color(light->specular, light_scale(s), 1),
        [SEMANTIC_LIGHT_AMBIENT] = color(light->ambient, 1, 1),
        [SEMANTIC_AMBIENT_LIGHT] = color(total_ambient(s), 1, 1),
        [SEMANTIC_ATTENUATION_CONSTANT] = number(a[0]),
        [SEMANTIC_ATTENUATION_LINEAR] = number(a[1]),
        [SEMANTIC_ATTENUATION_QUADRATIC] = number(a[2]),
        [SEMANTIC_ATTENUATION] = {{a[0], a[1], a[2]}},
        [SEMANTIC_CONE] = edge,
        [SEMANTIC_CUTOFF] = number(edge.v[0]),
        // almost equal to the cutoff, so that edges are hard
        [SEMANTIC_OUTER_CUTOFF] = number(edge.v[0] - (light->cutoff_deg > 0 ? 1e-6f : 0.1f)),
        [SEMANTIC_SPOT_EXPONENT] = number(light->exponent),
        [SEMANTIC_EMISSION] = color_factor(s, NUMBER_EMISSION, s->emission, 1),
        [SEMANTIC_ONE] = {{1, 1, 1, 1}},
        [SEMANTIC_FACTOR] = {{0.4f, 0.35f, 0.3f, 1}},
        [SEMANTIC_MAP_ROW_U] = {{1, 0, 0, 1}},
        [SEMANTIC_MAP_ROW_V] = {{0, 1, 0, 0}},
        [SEMANTIC_LIGHT_COUNT] = number((float)s->light_count),
        [SEMANTIC_FLAT] = number(s->flat),
        [SEMANTIC_EYE_POSITION] = vector(mat4_point(&to, s->eye), 1),
    };
    return values[semantic];
}
