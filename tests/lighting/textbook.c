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

struct textbook textbook_light(const struct modes *modes, const float in[INPUTS])
{
    struct textbook result;
    memset(&result, 0, sizeof result);
    double *out = result.out;

    vector p = take(in + IN_POINT), n = normalize(take(in + IN_NORMAL)), tangent = take(in + IN_TANGENT);
    vector t = normalize(minus(tangent, times(inner(tangent, n), n)));
    result.tangent_sine = none(tangent) ? 0 : length(minus(tangent, times(inner(tangent, n), n))) / length(tangent);
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

    double n_l = inner(n, l), diffuse = 0, specular = 0, base = 0, shininess = (double)in[IN_SHININESS];
    vector r = minus(times(2 * n_l, n), l), h = normalize(plus(l, v));
    result.half_length = length(plus(l, v));
    double theta_l = acos(limit(inner(t, l), -1, 1)), theta_v = acos(limit(inner(t, v), -1, 1));
    int gated = 1, seen = !none(v);
    switch (modes->model) {
    case LAM_REFLECTION_LAMBERT:
        diffuse = fmax(n_l, 0);
        break;
    case LAM_REFLECTION_PHONG:
        diffuse = fmax(n_l, 0);
        base = limit(inner(r, v), 0, 1);
        specular = n_l > 0 && seen ? raise(base, shininess) : 0;
        break;
    case LAM_REFLECTION_BLINN_PHONG:
        diffuse = fmax(n_l, 0);
        base = limit(inner(n, h), 0, 1);
        specular = n_l > 0 && seen ? raise(base, shininess) : 0;
        break;
    case LAM_REFLECTION_KAJIYA_KAY:
    case LAM_REFLECTION_KAJIYA_KAY_LECTURE:
        // sin sin ∓ cos cos are −cos of the sum and cos of the difference of the angles.
        base = modes->model == LAM_REFLECTION_KAJIYA_KAY ? -cos(theta_l + theta_v) : cos(theta_l - theta_v);
        base = limit(base, 0, 1);
        gated = modes->model == LAM_REFLECTION_KAJIYA_KAY && !modes->fibre;
        if (!none(t) && !none(l) && (n_l > 0 || !gated)) {
            diffuse = sin(theta_l);
            specular = seen ? raise(base, shininess) : 0;
        }
        break;
    }
    if (modes->model == LAM_REFLECTION_NONE)
        base = 0;

    put(out + OUT_L, l);
    out[OUT_DISTANCE] = d;
    out[OUT_ATTENUATION] = arrives;
    out[OUT_SPOT] = narrowed;
    out[OUT_D] = diffuse;
    out[OUT_S] = specular;
    out[OUT_N_DOT_L] = n_l;
    out[OUT_BASE] = base;
    for (int i = 0; i < 3; i++) {
        double w = 0.5 + 0.5 * inner(n, take(in + IN_UP)), tint = (double)in[IN_TINT + i];
        double dome = none(n) ? 0 : (double)in[IN_SKY + i] * w + (double)in[IN_GROUND + i] * (1 - w);
        out[OUT_AMBIENT + i] = tint * ((double)in[IN_AMBIENT + i] + dome);
        out[OUT_DIFFUSE + i] = tint * (double)in[IN_DIFFUSE + i] * arrives * narrowed * diffuse;
        out[OUT_SPECULAR + i] = (double)in[IN_SPECULAR + i] * arrives * narrowed * specular;
        out[OUT_REFLECTION + i] = (double)in[IN_MIRROR + i] * (double)in[IN_ENVIRONMENT + i];
        out[OUT_SUM + i] = (double)in[IN_EMISSION + i] + out[OUT_AMBIENT + i] + out[OUT_DIFFUSE + i] +
                           out[OUT_SPECULAR + i] + out[OUT_REFLECTION + i];
    }
    return result;
}
