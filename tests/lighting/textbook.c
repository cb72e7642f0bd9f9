// textbook.c: the lighting equations in double precision (textbook.h).
#include "textbook.h"

#include <math.h>
#include <string.h>

#define LANES 1
#include "lighting.h" // only for the numbers of kinds and models

typedef struct {
    double x, y, z;
} vector;

static vector take(const float *from) { return (vector){(double)from[0], (double)from[1], (double)from[2]}; }
static double inner(vector a, vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static double length(vector a) { return sqrt(inner(a, a)); }
static vector times(double s, vector a) { return (vector){s * a.x, s * a.y, s * a.z}; }
static vector plus(vector a, vector b) { return (vector){a.x + b.x, a.y + b.y, a.z + b.z}; }
#define PI 3.14159265358979323846
static vector cross(vector a, vector b)
{
    return (vector){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static vector minus(vector a, vector b) { return plus(a, times(-1, b)); }
static int none(vector a) { return length(a) < 1e-9; }
static vector normalize(vector a) { return none(a) ? (vector){0, 0, 0} : times(1 / length(a), a); }
static double limit(double x, double low, double high) { return x < low ? low : x > high ? high : x; }
static double raise(double base, double exponent) { return exponent == 0 ? 1 : base <= 0 ? 0 : pow(base, exponent); }

static void put(double *out, vector a)
{
    out[0] = a.x;
    out[1] = a.y;
    out[2] = a.z;
}

static double attenuation(const struct modes *modes, const float *in, double d)
{
    double a = 1, b = 0, c = 0;
    if (modes->falloff != FALLOFF_NONE) {
        a = (double)in[IN_CONSTANT];
        b = (double)in[IN_LINEAR];
        c = (double)in[IN_QUADRATIC];
    }
    double denominator = a + b * d + c * d * d;
    double result = denominator > 0 ? 1 / denominator : 0;
    if (modes->falloff == FALLOFF_RANGE)
        result *= limit(1 - pow(d * (double)in[IN_INVERSE_RANGE], 4), 0, 1);
    return result;
}

static double spot(const struct modes *modes, const float *in, double c)
{
    switch (modes->kind) {
    case LIGHT_SPOT_CUTOFF:
        return c < (double)in[IN_COS_CUTOFF] ? 0 : raise(c, (double)in[IN_EXPONENT]);
    case LIGHT_SPOT_EXPONENT:
        return raise(c, (double)in[IN_EXPONENT]);
    case LIGHT_SPOT_CONES:
        return pow(limit((c - (double)in[IN_COS_OUTER]) * (double)in[IN_INVERSE_WIDTH], 0, 1), 2);
    default:
        return 1;
    }
}

// --- the lobes

struct geometry {
    vector n, l, v, t;
    double n_l, theta_l, theta_v; // n.l; angles between t and l, t and v
    const float *parameters;      // in the order of LOBE_PARAMETERS
    int fibre;
};

struct reflected {
    double diffuse, base;
    int lit;        // there is a highlight if the eye sees the point
    int microfacet; // its S is the base itself
    int toned;      // Gooch's tone colours it
    double step;    // distance to the nearest edge
};

static struct reflected reflect_none(const struct geometry *g)
{
    (void)g;
    return (struct reflected){0};
}

static struct reflected reflect_lambert(const struct geometry *g)
{
    return (struct reflected){.diffuse = fmax(g->n_l, 0)};
}

static struct reflected reflect_phong(const struct geometry *g)
{
    vector r = minus(times(2 * g->n_l, g->n), g->l);
    return (struct reflected){.diffuse = fmax(g->n_l, 0), .base = inner(r, g->v), .lit = g->n_l > 0};
}

static struct reflected reflect_blinn_phong(const struct geometry *g)
{
    return (struct reflected){
        .diffuse = fmax(g->n_l, 0), .base = inner(g->n, normalize(plus(g->l, g->v))), .lit = g->n_l > 0};
}

// sin sin ∓ cos cos are −cos of the sum and cos of the difference of the angles.
static struct reflected reflect_thread(const struct geometry *g, double base, int gated)
{
    int there = !none(g->t) && !none(g->l) && (g->n_l > 0 || !gated);
    return (struct reflected){.diffuse = there ? sin(g->theta_l) : 0, .base = none(g->t) ? 0 : base, .lit = there};
}

static struct reflected reflect_kajiya_kay(const struct geometry *g)
{
    return reflect_thread(g, -cos(g->theta_l + g->theta_v), !g->fibre);
}

static struct reflected reflect_kajiya_kay_lecture(const struct geometry *g)
{
    return reflect_thread(g, cos(g->theta_l - g->theta_v), 0);
}

// Computed from the angles themselves.
static struct reflected reflect_oren_nayar(const struct geometry *g)
{
    double sigma = (double)g->parameters[2], square = sigma * sigma;
    double incoming = acos(limit(g->n_l, -1, 1)), outgoing = acos(limit(inner(g->n, g->v), -1, 1));
    vector l = normalize(minus(g->l, times(g->n_l, g->n))), v = normalize(minus(g->v, times(inner(g->n, g->v), g->n)));
    double a = 1 - 0.5 * square / (square + 0.33), b = 0.45 * square / (square + 0.09);
    double beside = fmax(inner(l, v), 0) * sin(fmax(incoming, outgoing)) * tan(fmin(incoming, outgoing));
    return (struct reflected){.diffuse = fmax(g->n_l, 0) * (a + b * beside)};
}

// glTF 2.0, appendix B, in its own form, times pi.
static struct reflected reflect_ggx(const struct geometry *g)
{
    double roughness = fmax((double)g->parameters[3], 0.045), alpha = roughness * roughness, square = alpha * alpha;
    double n_l = g->n_l, n_v = fabs(inner(g->n, g->v));
    vector h = normalize(plus(g->l, g->v));
    double n_h = inner(g->n, h), sine = length(cross(g->n, h));
    double d = square / (PI * pow(sine * sine + n_h * n_h * square, 2));
    double v = 0.5 / (n_l * sqrt(n_v * n_v * (1 - square) + square) + n_v * sqrt(n_l * n_l * (1 - square) + square));
    double mirrored = 0.04 + 0.96 * pow(1 - limit(inner(g->v, h), 0, 1), 5);
    int seen = n_l > 0 && inner(h, g->v) > 0;
    return (struct reflected){
        .diffuse = fmax(n_l, 0) * (1 - mirrored), .base = seen ? PI * d * v * n_l : 0, .lit = seen, .microfacet = 1};
}

// The number of the first step that n.l does not exceed, and a highlight of 0 or 1.
static struct reflected reflect_toon(const struct geometry *g)
{
    struct reflected r = reflect_blinn_phong(g);
    double steps = (double)g->parameters[5], level = fmax(g->n_l, 0) * steps;
    double highlight = raise(limit(r.base, 0, 1), (double)g->parameters[0]);
    r.diffuse = 0;
    for (int i = 0; i < 256 && i < level - 1e-5; i++)
        r.diffuse = (i + 1) / steps;
    r.base = highlight >= 0.5 ? 1 : 0;
    r.step = fmin(fabs(level - floor(level + 0.5)), fabs(highlight - 0.5));
    return r;
}

// Gooch et al. (1998) with alpha = 0.2 and beta = 0.6: the mix of cool and warm.
static struct reflected reflect_gooch(const struct geometry *g)
{
    double w = (1 + g->n_l) / 2;
    int seen = !none(g->n);
    return (struct reflected){.diffuse = seen ? (1 - w) * 0.2 + w * 0.6 : 0, .base = 1, .lit = seen, .toned = 1};
}

// Each row contains the hash over the results of all widths (printed by test_widths.c).
static const struct lobe {
    struct reflected (*of)(const struct geometry *g);
    uint64_t hash;
} lobes[LAM_REFLECTION_COUNT] = {
    [LAM_REFLECTION_NONE] = {reflect_none, 0x587cfd57bf96a6f0},
    [LAM_REFLECTION_LAMBERT] = {reflect_lambert, 0x0ddab406a9be3458},
    [LAM_REFLECTION_PHONG] = {reflect_phong, 0xaaf98f248c7e0654},
    [LAM_REFLECTION_BLINN_PHONG] = {reflect_blinn_phong, 0x64be24bc5d552f2b},
    [LAM_REFLECTION_KAJIYA_KAY] = {reflect_kajiya_kay, 0x7e895ba25bd9210a},
    [LAM_REFLECTION_KAJIYA_KAY_LECTURE] = {reflect_kajiya_kay_lecture, 0x7914335629de57cd},
    [LAM_REFLECTION_OREN_NAYAR] = {reflect_oren_nayar, 0xc42745003ceb023c},
    [LAM_REFLECTION_GGX] = {reflect_ggx, 0xa71be5c4cae324a9},
    [LAM_REFLECTION_TOON] = {reflect_toon, 0x06a7cedff0f5011b},
    [LAM_REFLECTION_GOOCH] = {reflect_gooch, 0x62cf9b7e6c0bab9b},
};

uint64_t textbook_hash(int model) { return lobes[model].hash; }

struct textbook textbook_light(const struct modes *modes, const float in[INPUTS])
{
    struct textbook result;
    memset(&result, 0, sizeof result);
    double *out = result.out;

    vector p = take(in + IN_POINT), n = normalize(take(in + IN_NORMAL)), tangent = take(in + IN_TANGENT);
    vector across = minus(tangent, times(inner(tangent, n), n));
    result.tangent_sine = none(tangent) ? 0 : length(across) / length(tangent);
    vector t = result.tangent_sine < 1e-4 ? (vector){0, 0, 0} : normalize(across); // convention 10
    vector v = modes->viewer == VIEWER_INFINITE ? (vector){0, 0, 1} : normalize(times(-1, p));

    vector l, axis = take(in + IN_DIRECTION);
    double d = 0, arrives = 1, narrowed = 1;
    if (modes->kind == LIGHT_DIRECTIONAL) {
        l = normalize(times(-1, axis));
    } else {
        vector to_light = minus(take(in + IN_POSITION), p);
        d = length(to_light);
        l = d > 0 ? times(1 / d, to_light) : (vector){0, 0, 0};
        arrives = d > 0 ? attenuation(modes, in, d) : 0;
        result.cone_cosine = limit(-inner(l, axis), -1, 1);
        narrowed = spot(modes, in, result.cone_cosine);
    }

    result.half_length = length(plus(l, v));
    struct geometry g = {n, l, v, t, .n_l = inner(n, l), .parameters = in + IN_PARAMETERS, .fibre = modes->fibre};
    g.theta_l = acos(limit(inner(t, l), -1, 1));
    g.theta_v = acos(limit(inner(t, v), -1, 1));
    struct reflected lobe = lobes[modes->model].of(&g);
    double base = lobe.microfacet ? lobe.base : limit(lobe.base, 0, 1);
    double specular = !lobe.lit || none(v) ? 0 : lobe.microfacet ? base : raise(base, (double)in[IN_SHININESS]);

    result.step = lobe.step;
    put(out + OUT_L, l);
    out[OUT_DISTANCE] = d;
    out[OUT_ATTENUATION] = arrives;
    out[OUT_SPOT] = narrowed;
    out[OUT_D] = lobe.diffuse;
    out[OUT_S] = specular;
    out[OUT_N_DOT_L] = g.n_l;
    out[OUT_BASE] = base;
    for (int i = 0; i < 3; i++) {
        double w = 0.5 + 0.5 * inner(n, take(in + IN_UP)), tint = (double)in[IN_TINT + i];
        double dome = none(n) ? 0 : (double)in[IN_SKY + i] * w + (double)in[IN_GROUND + i] * (1 - w);
        out[OUT_AMBIENT + i] = tint * ((double)in[IN_AMBIENT + i] + dome);
        out[OUT_DIFFUSE + i] = tint * (double)in[IN_DIFFUSE + i] * arrives * narrowed * lobe.diffuse;
        double warm = (1 + g.n_l) / 2, tone = !lobe.toned ? 1 : i == 2 ? 1 - warm : warm;
        out[OUT_SPECULAR + i] = (double)in[IN_SPECULAR + i] * arrives * narrowed * specular * tone;
        out[OUT_REFLECTION + i] = (double)in[IN_MIRROR + i] * (double)in[IN_ENVIRONMENT + i];
        out[OUT_SUM + i] = (double)in[IN_EMISSION + i] + out[OUT_AMBIENT + i] + out[OUT_DIFFUSE + i] +
                           out[OUT_SPECULAR + i] + out[OUT_REFLECTION + i];
    }
    return result;
}

// --- the environment

// A table of 32 roughnesses from 0.045 to 1 times 32 roots of n.v, with linear interpolation.
static double tabulated(const float table[1024], double n_v, double roughness)
{
    double x = 31 * sqrt(limit(n_v, 0, 1)), y = 31 * (limit(roughness, 0.045, 1) - 0.045) / (1 - 0.045);
    int column = x < 30 ? (int)x : 30, row = y < 30 ? (int)y : 30;
    double a = x - column, b = y - row, sum = 0;
    for (int i = 0; i < 4; i++)
        sum += (double)table[32 * (row + i / 2) + column + i % 2] * (i % 2 ? a : 1 - a) * (i / 2 ? b : 1 - b);
    return sum;
}

static const float albedos[1024] = {
#include "albedo.table"
};
static const float biases[1024] = {
#include "bias.table"
};

// docs/lighting/environment.md and physical.md: a dielectric and a metal, mixed at the end.
void textbook_environment(int viewer, const float in[INPUTS], double out[ENVIRONMENT_OUTPUTS], double *n_dot_v)
{
    vector p = take(in + IN_POINT), n = normalize(take(in + IN_NORMAL));
    vector v = viewer == VIEWER_INFINITE ? (vector){0, 0, 1} : normalize(times(-1, p));
    vector l = normalize(minus(take(in + IN_POSITION), p)), h = normalize(plus(l, v));
    double roughness = (double)in[IN_PARAMETERS + 3], metallic = (double)in[IN_PARAMETERS + 4];
    double n_v = fabs(inner(n, v)), whole = tabulated(albedos, n_v, roughness),
           bias = tabulated(biases, n_v, roughness);
    double grazing = pow(1 - limit(inner(v, h), 0, 1), 5);
    *n_dot_v = n_v;
    for (int i = 0; i < 3; i++) {
        double base = (double)in[IN_TINT + i], irradiance = (double)in[IN_SKY + i], around = (double)in[IN_GROUND + i];
        double glass = 0.04 * (whole - bias) + bias, metal = base * (whole - bias) + bias;
        double more_glass = 1 + 0.04 * (1 / whole - 1), more_metal = 1 + base * (1 / whole - 1);
        double matt = base * irradiance * (1 - glass);
        out[OUT_FRESNEL + i] = (1 - metallic) * more_glass * (0.04 + 0.96 * grazing) +
                               metallic * more_metal * (base + (1 - base) * grazing);
        out[OUT_SPLIT_SUM + i] =
            (1 - metallic) * (matt + more_glass * glass * around) + metallic * more_metal * metal * around;
        out[OUT_SPLIT_ALONE + i] = (1 - metallic) * (matt + glass * around) + metallic * metal * around;
    }
}
