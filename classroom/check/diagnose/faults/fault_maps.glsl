// fault_maps.glsl: the numbers of a material and the normal, which a shader may read from maps. They are correct unless
// faults are switched on. A map has one texel, which the uniforms contain as the sampler reads it (../contract/maps.h).
//
// fault_shader.c writes constants before this text. MAPS is defined if the shader under test reads maps, and FRAGMENT
// in the fragment shader. `maps` contains the bits of the maps that the shader reads. encoded_maps and tints_ambient
// (the ambient term includes the base colour) are flags.

uniform vec3 base_color;
uniform float metallic, roughness;

bool is(int bit); // fault_light.glsl

// The axes of the surface at a point, in the space of the lighting, and the texture coordinates.
struct Frame {
    vec4 tangent, bitangent; // axes of the mesh, from the vertex shader; tangent.w is the sign of the bitangent
    vec2 texture_coordinate;
    vec3 point;
};

#ifdef MAPS
// The bits of map_bit.
#define BASE_COLOR_MAP 1
#define METALLIC_ROUGHNESS_MAP 2
#define NORMAL_MAP 16
#define OCCLUSION_MAP 32
#define EMISSION_MAP 64

// Factors have other names in the shader, or are 1. The texel of a missing map is 1.
uniform vec3 base_factor, base_texel, emission_factor, emission_texel, normal_texel;
uniform vec4 metallic_roughness_texel;
uniform float metallic_factor, roughness_factor, occlusion;

bool has(int map) { return (maps & map) != 0; }

vec3 srgb_decoded(vec3 c) { return mix(pow((c + 0.055) / 1.055, vec3(2.4)), c / 12.92, lessThanEqual(c, vec3(0.04045))); }

vec3 decoded(vec3 texel)
{
    return !encoded_maps ? texel : (is(MAPS_OF_SRGB) ? srgb_decoded(texel) : pow(texel, vec3(2.2)));
}

vec3 surface_color()
{
    if (!has(BASE_COLOR_MAP)) {
        return is(ALBEDO_DECODED) ? pow(base_color, vec3(2.2)) : base_color;
    }
    vec3 texel = is(BASE_NOT_DECODED) ? base_texel : decoded(base_texel);
    texel = is(BASE_DECODED_TWICE) ? pow(texel, vec3(2.2)) : texel;
    if (is(BASE_MAP_ALONE)) {
        return texel;
    }
    return base_factor * (is(BASE_FACTOR_ALONE) ? vec3(1.0) : texel);
}

// A channel of the map of metalness and roughness.
float channel(float right)
{
    float x = is(METAL_ROUGH_RED) ? metallic_roughness_texel.r : right;
    return is(DATA_DECODED) ? pow(x, 2.2) : x;
}

float metal()
{
    if (!has(METALLIC_ROUGHNESS_MAP)) {
        float m = is(METAL_ROUGH_SWAPPED) ? roughness : metallic;
        return is(DATA_DECODED) ? pow(m, 2.2) : m;
    }
    float texel = channel(is(METAL_ROUGH_SWAPPED) || is(METAL_FROM_GREEN) ? metallic_roughness_texel.g : metallic_roughness_texel.b);
    texel = is(METAL_FROM_RED) ? metallic_roughness_texel.r : (is(METAL_FROM_ALPHA) ? metallic_roughness_texel.a : texel);
    return (is(DATA_MAP_ALONE) ? 1.0 : metallic_factor) * texel;
}

float rough()
{
    float r = is(METAL_ROUGH_SWAPPED) ? metallic : roughness;
    r = is(DATA_DECODED) ? pow(r, 2.2) : r;
    if (has(METALLIC_ROUGHNESS_MAP)) {
        float texel = channel(is(METAL_ROUGH_SWAPPED) || is(ROUGH_FROM_BLUE) ? metallic_roughness_texel.b : metallic_roughness_texel.g);
        texel = is(ROUGH_FROM_RED) ? metallic_roughness_texel.r : (is(ROUGH_FROM_ALPHA) ? metallic_roughness_texel.a : texel);
        r = (is(DATA_MAP_ALONE) ? 1.0 : roughness_factor) * texel;
    }
    return is(ROUGHNESS_INVERTED) ? 1.0 - r : r;
}

// Returns the light that the surface emits.
vec3 emitted()
{
    if (!has(EMISSION_MAP) || is(NO_EMISSION)) {
        return vec3(0.0);
    }
    vec3 texel = is(EMISSION_NOT_DECODED) ? emission_texel : decoded(emission_texel);
    return (is(EMISSION_MAP_ALONE) ? vec3(1.0) : emission_factor) * (is(EMISSION_DECODED_TWICE) ? pow(texel, vec3(2.2)) : texel);
}

// The factor of the light of lamps: the occlusion, if a fault applies it to more than the ambient term.
float lamp_occlusion() { return has(OCCLUSION_MAP) && is(OCCLUSION_OF_ALL) ? occlusion : 1.0; }
// The factor of the ambient term, which already contains the correct base colour.
vec3 ambient_factor()
{
    return has(BASE_COLOR_MAP) && tints_ambient ? surface_color() / max(base_color, 1e-6) : vec3(1.0);
}

#ifdef FRAGMENT
// Gets the tangent and the bitangent for a unit normal.
void axes_of(vec3 n, Frame f, out vec3 t, out vec3 b)
{
    vec3 px = dFdx(f.point), py = dFdy(f.point);
    vec2 ux = dFdx(f.texture_coordinate), uy = dFdy(f.texture_coordinate);
    float way = f.tangent.w;
    t = is(TANGENT_LONG) ? f.tangent.xyz : normalize(f.tangent.xyz);
    b = cross(n, t) * (is(SIGN_LOST) ? 1.0 : way);
    if (is(BITANGENT_BY_MODEL)) {
        b = is(TANGENT_LONG) ? f.bitangent.xyz : normalize(f.bitangent.xyz);
    }
    if (is(FRAME_INTERPOLATED)) {
        t = f.tangent.xyz;
        b = f.bitangent.xyz;
    }
    if (is(FRAME_DERIVED)) { // getNormalFromMap of LearnOpenGL
        t = normalize(px * uy.y - py * ux.y);
        b = -normalize(cross(n, t));
    }
    if (is(FRAME_DERIVED_SIGNED)) { // the sample viewer of glTF
        t = (uy.y * px - ux.y * py) / (ux.x * uy.y - uy.x * ux.y);
        t = normalize(t - n * dot(n, t));
        b = cross(n, t);
    }
    if (is(FRAME_COTANGENT)) { // Schueler's method, which three.js also uses
        vec3 a = cross(py, n), c = cross(n, px);
        t = a * ux.x + c * uy.x;
        b = a * ux.y + c * uy.y;
        float square = max(dot(t, t), dot(b, b));
        float scale = square == 0.0 ? 0.0 : inversesqrt(square);
        t *= scale;
        b *= scale;
    }
    if (is(BITANGENT_REVERSED)) {
        b = -b;
    }
    if (is(TANGENT_REVERSED)) {
        t = -t;
    }
    if (is(AXES_SWAPPED)) {
        vec3 other = t;
        t = b;
        b = other;
    }
}

// Returns a unit normal after the normal map. `raw` is the interpolated normal.
vec4 bumped(vec4 unit, vec4 raw, Frame f)
{
    if (!has(NORMAL_MAP) || is(BUMPS_MISSING)) {
        return unit;
    }
    vec3 texel = is(NORMAL_MAP_DECODED) ? pow(normal_texel, vec3(2.2)) : normal_texel;
    vec3 way = is(NORMAL_MAP_RAW) ? texel : texel * 2.0 - 1.0, n = unit.xyz, t, b, bent;
    axes_of(n, f, t, b);
    n = is(FRAME_INTERPOLATED) ? raw.xyz : n;
    bent = is(FRAME_TRANSPOSED) ? vec3(dot(t, way), dot(b, way), dot(n, way)) : t * way.x + b * way.y + n * way.z;
    if (is(NORMAL_MAP_AS_WORLD)) {
        bent = way;
    }
    return vec4(is(BENT_NORMAL_LONG) ? bent : normalize(bent), 0.0);
}
#else
vec4 bumped(vec4 unit, vec4 raw, Frame f) { return unit; }
#endif
#else
vec3 surface_color() { return is(ALBEDO_DECODED) ? pow(base_color, vec3(2.2)) : base_color; }
float metal() { return is(METAL_ROUGH_SWAPPED) ? roughness : metallic; }
float rough() { return is(ROUGHNESS_INVERTED) ? 1.0 - roughness : (is(METAL_ROUGH_SWAPPED) ? metallic : roughness); }
vec3 emitted() { return vec3(0.0); }
float lamp_occlusion() { return 1.0; }
vec3 ambient_factor() { return vec3(1.0); }
vec4 bumped(vec4 unit, vec4 raw, Frame f) { return unit; }
#endif
