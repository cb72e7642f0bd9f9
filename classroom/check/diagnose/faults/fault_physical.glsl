// fault_physical.glsl: the light of shaders with metalness and roughness, which is correct unless faults are switched
// on. It is the metallic-roughness material of glTF 2.0 (appendix B), or one of the accepted forms of this material.
//
// The unit is the library's: a white matt surface under a light of intensity 1 has the value 1. Published formulas are
// therefore multiplied by pi.

// The values of the enumerations in contract.h.
#define MASKING_SCHLICK 1
#define DIFFUSE_OF_MIX 1
#define DIFFUSE_WHOLE 2
#define TONE_REINHARD 1
#define ENCODING_GAMMA 1

const float PI = 3.14159265358979;

// The clamped cosines at a point. `cosine` is the n.l that the sum over the lights uses; a fault may leave it
// unclamped.
struct Angles { float nl, nv, nh, vh, cosine; };

float distribution(Angles a)
{
    float r = rough(), alpha = is(ALPHA_IS_ROUGHNESS) || is(ALPHA_IS_ROUGHNESS_D) ? r : r * r;
    float square = alpha * alpha, f = a.nh * a.nh * (square - 1.0) + 1.0;
    float D = square / (is(D_NOT_SQUARED) ? f : f * f);
    return is(D_TIMES_PI) ? D * PI : D; // times pi, because the intensities of the lights include pi
}

// The masking for one direction, divided by 2 n.l or 2 n.v: Smith's masking for GGX, or Schlick's approximation.
float smith(float x, float square) { return 1.0 / (x + sqrt(square + (1.0 - square) * x * x)); }
float schlick(float x, float k) { return 0.5 / (x * (1.0 - k) + k); }

bool is_schlick()
{
    if (is(USE_HEIGHT) || is(USE_SEPARABLE)) {
        return false;
    }
    return is(USE_SCHLICK) || is(USE_SCHLICK_IBL) || is(K_OF_ALPHA) || masking == MASKING_SCHLICK;
}

// Returns the absolute value of n.v, as in glTF's appendix B, because n.v is below 0 if an interpolated normal faces
// away. Shaders with Schlick's approximation clamp n.v instead, and then show no highlight at such points.
float eye_cosine(float nv) { return is(RIM_CUT) || is(RIM_CLAMPED) || is_schlick() ? max(nv, 0.0) : abs(nv); }

// Masking and shadowing, divided by 4 n.l n.v.
float visibility(Angles a)
{
    float r = rough(), alpha = is(ALPHA_IS_ROUGHNESS) || is(ALPHA_IS_ROUGHNESS_V) ? r : r * r, square = alpha * alpha;
    float four = 4.0 * a.nl * a.nv, k = (r + 1.0) * (r + 1.0) / 8.0, V;
    if (is(USE_SCHLICK_IBL)) {
        k = alpha / 2.0;
    } else if (is(K_OF_ALPHA)) {
        k = (alpha + 1.0) * (alpha + 1.0) / 8.0;
    }
    bool approximate = is_schlick();
    float l = approximate ? schlick(a.nl, k) : smith(a.nl, square), v = approximate ? schlick(a.nv, k) : smith(a.nv, square);
    if (is(NO_MASKING)) {
        V = 1.0 / (four + 0.0001);
    } else if (is(MASKING_OF_V) || is(MASKING_OF_L)) {
        V = (is(MASKING_OF_V) ? 2.0 * a.nv * v : 2.0 * a.nl * l) / (four + 0.0001);
    } else if (approximate) {
        V = four * l * v / (four + 0.0001); // the usual constant, which prevents a division by 0
    } else if (is(USE_SEPARABLE)) {
        V = l * v;
    } else {
        float sum = a.nl * sqrt(a.nv * a.nv * (1.0 - square) + square) + a.nv * sqrt(a.nl * a.nl * (1.0 - square) + square);
        V = sum > 0.0 ? 0.5 / sum : 0.0;
    }
    if (is(NOT_DIVIDED)) {
        return V * four;
    }
    if (is(DIVIDED_BY_4)) {
        return V * a.nl * a.nv;
    }
    if (is(DIVIDED_WITHOUT_4)) {
        return 4.0 * V;
    }
    return is(DIVIDED_TWICE) ? V / (four + 0.0001) : V;
}

vec3 fresnel(Angles a, vec3 f0)
{
    float c = is(FRESNEL_OF_NV) ? a.nv : (is(FRESNEL_OF_NH) ? a.nh : (is(FRESNEL_OF_NL) ? a.nl : a.vh));
    float x = is(FRESNEL_INVERTED) ? c : 1.0 - c;
    x = is(FRESNEL_LINEAR) ? x : x * x * x * x * x;
    return is(NO_FRESNEL) ? f0 : f0 + (1.0 - f0) * x;
}

// Gets the reflected light for a light of intensity 1: the diffuse and the specular part.
void reflect_physical(Angles a, out vec3 diffuse, out vec3 specular)
{
    float m = metal();
    vec3 base = surface_color();
    vec3 f0 = is(F0_CONSTANT) ? vec3(0.04) : (is(F0_IS_ALBEDO) ? base : mix(vec3(0.04), base, m));
    vec3 F = fresnel(a, f0), share = 1.0 - fresnel(a, vec3(0.04));
    int kind = is(SHARE_WHOLE) ? DIFFUSE_WHOLE : (is(SHARE_OF_MIX) ? DIFFUSE_OF_MIX : (is(SHARE_OF_DIELECTRIC) ? 0 : diffuse_share));
    if (kind == DIFFUSE_OF_MIX) {
        share = 1.0 - F;
    } else if (kind == DIFFUSE_WHOLE) {
        share = vec3(1.0);
    }
    if (!is(METAL_KEEPS_DIFFUSE)) {
        share *= 1.0 - m;
    }
    float cosine = is(NO_N_DOT_L) ? (is(LIT_SIDE_ALONE) && a.nl <= 0.0 ? 0.0 : 1.0) : a.cosine;
    diffuse = share * base * cosine * (is(DIFFUSE_TIMES_PI) ? PI : 1.0);
    specular = (a.nv > 0.0 || is(RIM_CLAMPED)) && a.nl > 0.0 ? F * (distribution(a) * visibility(a) * cosine) : vec3(0.0);
    if (is(SPECULAR_WITHOUT_N_DOT_L) && a.nl > 0.0) {
        specular /= a.nl;
    }
    if (is(FRESNEL_TWICE)) {
        specular *= F;
    }
    if (is(LIGHT_WITHOUT_PI)) {
        diffuse *= PI;
        specular *= PI;
    }
}

vec3 reinhard(vec3 c) { return c / (c + 1.0); }

vec3 toned(vec3 c)
{
    if (is(USE_NO_TONE)) {
        return c;
    }
    if (is(USE_EXPONENTIAL)) {
        return 1.0 - exp(-c);
    }
    if (is(USE_ACES)) { // Narkowicz's fit
        return clamp(c * (2.51 * c + 0.03) / (c * (2.43 * c + 0.59) + 0.14), 0.0, 1.0);
    }
    return is(USE_REINHARD) || tone == TONE_REINHARD ? reinhard(c) : c;
}

vec3 encoded(vec3 c)
{
    c = max(c, 0.0);
    if (is(USE_SRGB)) {
        c = min(c, 1.0);
        return mix(1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, 12.92 * c, lessThanEqual(c, vec3(0.0031308)));
    }
    bool gamma = is(USE_GAMMA) || encoding == ENCODING_GAMMA;
    return gamma && !is(NOT_ENCODED) ? pow(c, vec3(1.0 / 2.2)) : c;
}

// Returns the colour that the shader writes for a sum of light.
vec3 displayed(vec3 sum)
{
    return is(TONE_AFTER_ENCODING) ? toned(encoded(sum)) : encoded(toned(sum));
}
