// role.c: the table of roles. docs/check.md and the schema of contract files are generated from this table.
#include "contract.h"
#include "elementary.h"

#define UNIFORM  ROLE_UNIFORM
#define LIGHT    (ROLE_UNIFORM | ROLE_LIGHT)
#define CONSTANT ROLE_CONSTANT

const struct role roles[] = {
    {SEMANTIC_POSITION, "position", ROLE_ATTRIBUTE, TYPE_VECTOR, "position of the vertex in the model's space"},
    {SEMANTIC_NORMAL, "normal", ROLE_ATTRIBUTE, TYPE_VECTOR, "normal of the vertex in the model's space"},
    {SEMANTIC_TEXCOORD, "texture_coordinate", ROLE_ATTRIBUTE, TYPE_VEC2 | TYPE_VECTOR,
     "texture coordinate; 0 if no map is read"},
    {SEMANTIC_TANGENT, "tangent", ROLE_ATTRIBUTE, TYPE_VECTOR,
     "unit tangent of the vertex (the direction in which u increases) in the model's space; w: the sign of the "
     "bitangent"},
    {SEMANTIC_BITANGENT, "bitangent", ROLE_ATTRIBUTE, TYPE_VECTOR, "unit bitangent: w cross(normal, tangent)"},
    {SEMANTIC_MODEL, "model", UNIFORM, TYPE_MATRIX, "model to world space"},
    {SEMANTIC_VIEW, "view", UNIFORM, TYPE_MATRIX, "world to eye space"},
    {SEMANTIC_PROJECTION, "projection", UNIFORM, TYPE_MATRIX, "eye to clip space"},
    {SEMANTIC_MODEL_VIEW, "model_view", UNIFORM, TYPE_MATRIX, "model to eye space"},
    {SEMANTIC_VIEW_PROJECTION, "view_projection", UNIFORM, TYPE_MATRIX, "world to clip space"},
    {SEMANTIC_MODEL_VIEW_PROJECTION, "model_view_projection", UNIFORM, TYPE_MATRIX, "model to clip space"},
    {SEMANTIC_NORMAL_MATRIX, "normal_matrix", UNIFORM | ROLE_IN_SPACE, TYPE_MATRIX,
     "inverse transpose of the matrix from model space to lighting space"},
    {SEMANTIC_EYE_POSITION, "eye_position", UNIFORM | ROLE_IN_SPACE, TYPE_VECTOR, "position of the eye"},
    {SEMANTIC_AMBIENT, "ambient", UNIFORM, TYPE_VECTOR | TYPE_SAMPLER, "ka: the ambient colour, times its strength"},
    {SEMANTIC_DIFFUSE, "diffuse", UNIFORM, TYPE_VECTOR | TYPE_SAMPLER, "kd; a: the opacity"},
    {SEMANTIC_SPECULAR, "specular", UNIFORM, TYPE_VECTOR | TYPE_SAMPLER, "ks"},
    {SEMANTIC_AMBIENT_PRODUCT, "ambient_product", UNIFORM, TYPE_VECTOR, "ka times the light's ambient colour"},
    {SEMANTIC_DIFFUSE_PRODUCT, "diffuse_product", UNIFORM, TYPE_VECTOR, "kd times the light's diffuse colour"},
    {SEMANTIC_SPECULAR_PRODUCT, "specular_product", UNIFORM, TYPE_VECTOR, "ks times the light's specular colour"},
    {SEMANTIC_LIGHT_AMBIENT_PRODUCT, "light_ambient_product", UNIFORM, TYPE_VECTOR,
     "ka times the ambient colour of one light; the light's attenuation dims this product"},
    {SEMANTIC_KA, "ambient_strength", UNIFORM | CONSTANT, TYPE_SCALAR, "ka without its colour"},
    {SEMANTIC_KD, "diffuse_strength", UNIFORM | CONSTANT, TYPE_SCALAR, "kd without its colour"},
    {SEMANTIC_KS, "specular_strength", UNIFORM | CONSTANT, TYPE_SCALAR, "ks without its colour"},
    {SEMANTIC_COLOR, "color", UNIFORM | CONSTANT, TYPE_VECTOR | TYPE_SAMPLER, "colour of the surface"},
    {SEMANTIC_SPECULAR_COLOR, "specular_color", UNIFORM | CONSTANT, TYPE_VECTOR, "colour of the highlight"},
    {SEMANTIC_SHININESS, "shininess", UNIFORM | CONSTANT, TYPE_SCALAR, "exponent of the highlight"},
    {SEMANTIC_METALLIC, "metallic", UNIFORM, TYPE_SCALAR, "0: a dielectric, 1: a metal"},
    {SEMANTIC_ROUGHNESS, "roughness", UNIFORM, TYPE_SCALAR,
     "0: a mirror, 1: matt; alpha is the square of the roughness"},
    {SEMANTIC_ROUGHNESS_ANGLE, "roughness_angle", UNIFORM, TYPE_SCALAR, "Oren-Nayar's sigma, in radians"},
    {SEMANTIC_ROUGHNESS_ANGLE, "toon_steps", UNIFORM, TYPE_SCALAR, "number of steps of toon shading"},
    {SEMANTIC_EMISSION, "emission", UNIFORM, TYPE_VECTOR, "factor of the emission map; 0 if there is no emission map"},
    {SEMANTIC_BASE_COLOR_MAP, "base_color_map", UNIFORM, TYPE_SAMPLER, "map of the base colour"},
    {SEMANTIC_METALLIC_ROUGHNESS_MAP, "metallic_roughness_map", UNIFORM, TYPE_SAMPLER,
     "map of roughness (green) and metalness (blue)"},
    {SEMANTIC_METALLIC_MAP, "metallic_map", UNIFORM, TYPE_SAMPLER, "map of metalness: grey"},
    {SEMANTIC_ROUGHNESS_MAP, "roughness_map", UNIFORM, TYPE_SAMPLER, "map of roughness: grey"},
    {SEMANTIC_NORMAL_MAP, "normal_map", UNIFORM, TYPE_SAMPLER, "map of normals; decode 0...1 to -1...1"},
    {SEMANTIC_OCCLUSION_MAP, "occlusion_map", UNIFORM, TYPE_SAMPLER,
     "map of occlusion (grey); its value multiplies the ambient term"},
    {SEMANTIC_EMISSION_MAP, "emission_map", UNIFORM, TYPE_SAMPLER, "map of the emitted light"},
    {SEMANTIC_MAP_ROW_U, "map_row_u", UNIFORM, TYPE_VECTOR,
     "first row of a map's matrix, where 1, 0, 0 selects the mesh's u; w is 1, the factor of the texel"},
    {SEMANTIC_MAP_ROW_V, "map_row_v", UNIFORM, TYPE_VECTOR,
     "second row of a map's matrix, where 0, 1, 0 selects the mesh's v; w is 0, which is added to the texel"},
    {SEMANTIC_AMBIENT_LIGHT, "ambient_light", UNIFORM | CONSTANT, TYPE_VECTOR, "the sum of La over all lights"},
    {SEMANTIC_LIGHT_POSITION, "light_position", LIGHT | ROLE_IN_SPACE, TYPE_VECTOR, "position of the light"},
    {SEMANTIC_LIGHT_X, "light_x", LIGHT | ROLE_IN_SPACE, TYPE_SCALAR, "x of the light's position"},
    {SEMANTIC_LIGHT_Y, "light_y", LIGHT | ROLE_IN_SPACE, TYPE_SCALAR, "y of the light's position"},
    {SEMANTIC_LIGHT_Z, "light_z", LIGHT | ROLE_IN_SPACE, TYPE_SCALAR, "z of the light's position"},
    {SEMANTIC_LIGHT_DIRECTION, "light_direction", LIGHT | CONSTANT | ROLE_IN_SPACE, TYPE_VECTOR,
     "unit direction to the light"},
    {SEMANTIC_LIGHT_TRAVEL, "light_travel", LIGHT | ROLE_IN_SPACE, TYPE_VECTOR,
     "unit direction in which the light travels; a spot's axis"},
    {SEMANTIC_LIGHT_COLOR, "light_color", LIGHT | CONSTANT, TYPE_VECTOR, "Ld, the light's diffuse colour"},
    {SEMANTIC_LIGHT_SPECULAR, "light_specular", LIGHT | CONSTANT, TYPE_VECTOR, "Ls, the light's specular colour"},
    {SEMANTIC_LIGHT_AMBIENT, "light_ambient", LIGHT | CONSTANT, TYPE_VECTOR, "La, the light's ambient colour"},
    {SEMANTIC_ATTENUATION_CONSTANT, "attenuation_constant", LIGHT | CONSTANT, TYPE_SCALAR, "a of 1/(a + b d + c d^2)"},
    {SEMANTIC_ATTENUATION_LINEAR, "attenuation_linear", LIGHT | CONSTANT, TYPE_SCALAR,
     "b of 1/(a + b d + c d^2), where d is the distance"},
    {SEMANTIC_ATTENUATION_QUADRATIC, "attenuation_quadratic", LIGHT | CONSTANT, TYPE_SCALAR,
     "c of 1/(a + b d + c d^2)"},
    {SEMANTIC_ATTENUATION, "attenuation", LIGHT, TYPE_VECTOR, "a, b, c, and 0"},
    {SEMANTIC_CONE, "cone", LIGHT, TYPE_VECTOR,
     "spot light: cosine of the cutoff, exponent, cosine of the outer angle, 1/width; for other lights, the first "
     "number is -1"},
    {SEMANTIC_CUTOFF, "cutoff_cosine", LIGHT, TYPE_SCALAR, "cosine of a spot's cutoff; -1 for other lights"},
    {SEMANTIC_OUTER_CUTOFF, "outer_cosine", LIGHT, TYPE_SCALAR,
     "cosine of the angle at which a spot's light ends, just outside the cutoff"},
    {SEMANTIC_SPOT_EXPONENT, "spot_exponent", LIGHT, TYPE_SCALAR, "exponent of a spot's falloff"},
    {SEMANTIC_LIGHT_COUNT, "light_count", UNIFORM, TYPE_SCALAR, "number of lights"},
    {SEMANTIC_LIGHT_KIND, "light_kind", LIGHT, TYPE_SCALAR, "0: directional, 1: point, 2: spot"},
    {SEMANTIC_FLAT, "flat", UNIFORM, TYPE_SCALAR, "flat shading: the values of each triangle's last vertex"},
    {SEMANTIC_ZERO, "zero", ROLE_ATTRIBUTE | UNIFORM,
     TYPE_SCALAR | TYPE_VEC2 | TYPE_VECTOR | TYPE_MATRIX | TYPE_SAMPLER, "0: the scenes contain no such feature"},
    {SEMANTIC_FACTOR, "factor", ROLE_ATTRIBUTE | UNIFORM, TYPE_SCALAR | TYPE_VEC2 | TYPE_VECTOR | TYPE_SAMPLER,
     "a colour or strength that is the same in every scene; only for contracts that allow any strengths"},
    {SEMANTIC_ONE, "one", UNIFORM, TYPE_SCALAR | TYPE_VEC2 | TYPE_VECTOR, "1"},
};
const int role_count = sizeof roles / sizeof *roles;

const struct role *role_of(enum uniform_semantic semantic)
{
    for (int i = 0; i < role_count; i++)
        if (roles[i].semantic == semantic)
            return &roles[i];
    return &roles[role_count - 1];
}

// --- the factors and texels of maps.

// glTF uses only green and blue. If a shader reads red or alpha by mistake, the shader receives these numbers.
static const float unread_red = 0.9f, unread_alpha = 0.7f;

// The maps that can multiply each number.
static const enum uniform_semantic maps_of[][2] = {
    [NUMBER_BASE_COLOR] = {SEMANTIC_BASE_COLOR_MAP, SEMANTIC_BASE_COLOR_MAP},
    [NUMBER_METALLIC] = {SEMANTIC_METALLIC_ROUGHNESS_MAP, SEMANTIC_METALLIC_MAP},
    [NUMBER_ROUGHNESS] = {SEMANTIC_METALLIC_ROUGHNESS_MAP, SEMANTIC_ROUGHNESS_MAP},
    [NUMBER_OCCLUSION] = {SEMANTIC_OCCLUSION_MAP, SEMANTIC_OCCLUSION_MAP},
    [NUMBER_EMISSION] = {SEMANTIC_EMISSION_MAP, SEMANTIC_EMISSION_MAP},
};

static unsigned bits_of(enum map_number number) { return map_bit(maps_of[number][0]) | map_bit(maps_of[number][1]); }

float map_factor(const struct reference_scene *s, enum map_number number, float whole)
{
    unsigned bits = bits_of(number);
    if (!(s->maps & bits))
        return whole;
    return s->factors & bits ? 0.5f + 0.5f * whole : 1;
}

static float texel_of(const struct reference_scene *s, enum map_number number, float whole)
{
    return s->maps & bits_of(number) ? whole / map_factor(s, number, whole) : 1;
}

static float encoded(const struct reference_scene *s, float x)
{
    return s->encoded_maps && x > 0 ? (float)math_pow((double)x, 1 / 2.2) : x;
}

static struct uniform_value color(const struct reference_scene *s, enum map_number number, lam_rgb whole)
{
    return (struct uniform_value){{encoded(s, texel_of(s, number, whole.r)), encoded(s, texel_of(s, number, whole.g)),
                                   encoded(s, texel_of(s, number, whole.b)), 1}};
}

static struct uniform_value grey(float x) { return (struct uniform_value){{x, x, x, 1}}; }

struct uniform_value map_texel(enum uniform_semantic map, const struct reference_scene *s)
{
    const lam_vec3 n = s->bump;
    switch (map) {
    case SEMANTIC_BASE_COLOR_MAP: // in classic shaders, colours are separate inputs, so the map is white
        return s->physical ? color(s, NUMBER_BASE_COLOR, s->diffuse) : grey(1);
    case SEMANTIC_METALLIC_ROUGHNESS_MAP:
        return (struct uniform_value){{unread_red, texel_of(s, NUMBER_ROUGHNESS, s->roughness),
                                       texel_of(s, NUMBER_METALLIC, s->metallic), unread_alpha}};
    case SEMANTIC_METALLIC_MAP:
        return grey(texel_of(s, NUMBER_METALLIC, s->metallic));
    case SEMANTIC_ROUGHNESS_MAP:
        return grey(texel_of(s, NUMBER_ROUGHNESS, s->roughness));
    case SEMANTIC_NORMAL_MAP:
        if (n.x == 0 && n.y == 0 && n.z == 0)
            return (struct uniform_value){{0.5f, 0.5f, 1, 1}};
        return (struct uniform_value){
            {(float)(0.5 * n.x + 0.5), (float)(0.5 * n.y + 0.5), (float)(0.5 * n.z + 0.5), 1}};
    case SEMANTIC_OCCLUSION_MAP:
        return grey(texel_of(s, NUMBER_OCCLUSION, s->occlusion));
    case SEMANTIC_EMISSION_MAP:
        return color(s, NUMBER_EMISSION, s->emission);
    default:
        return (struct uniform_value){{0}};
    }
}
