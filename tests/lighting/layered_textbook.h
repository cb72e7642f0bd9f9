// layered_textbook.h: the layers of physical materials (src/core/lighting/layers.h) in double precision, written from the
// formulas of the Khronos extensions independently with libm.
#ifndef LAYERED_TEXTBOOK_H
#define LAYERED_TEXTBOOK_H

#include <math.h>

#define LANES 1
#include "lighting.h"

#ifndef PI
#define PI 3.14159265358979323846
#endif

typedef struct {
    double x, y, z;
} vector;

static inline double dot(vector a, vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline vector sum(vector a, vector b) { return (vector){a.x + b.x, a.y + b.y, a.z + b.z}; }
static inline vector times(double s, vector a) { return (vector){s * a.x, s * a.y, s * a.z}; }
static inline vector across(vector a, vector b)
{
    return (vector){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static inline vector unit(vector a) { return times(1 / sqrt(dot(a, a)), a); }
static inline double clamp(double x, double low, double high) { return x < low ? low : x > high ? high : x; }
static inline double largest(const double c[3]) { return fmax(fmax(c[0], c[1]), c[2]); }

// A material and a light at a point.
struct point {
    vector n, v, l, t, coat_n;
    double base[3], metallic, roughness, ior, weight, glossy, color[3], coat, coat_roughness, sheen[3], sheen_roughness,
        strength, iridescence, film_ior, film, transmission;
};

// --- the texts

// KHR_materials_iridescence, "Iridescence Fresnel".
static inline void sensitivity(double opd, const double shift[3], double rgb[3])
{
    static const double val[3] = {5.4856e-13, 4.4201e-13, 5.2481e-13}, pos[3] = {1.6810e+06, 1.7953e+06, 2.2084e+06},
                        var[3] = {4.3278e+09, 9.3046e+09, 6.6121e+09};
    static const double to_rgb[3][3] = {
        {3.2404542, -1.5371385, -0.4985314}, {-0.9692660, 1.8760108, 0.0415560}, {0.0556434, -0.2040259, 1.0572252}};
    double phase = 2 * PI * opd * 1e-9, xyz[3];
    for (int i = 0; i < 3; i++)
        xyz[i] = val[i] * sqrt(2 * PI * var[i]) * cos(pos[i] * phase + shift[i]) * exp(-phase * phase * var[i]);
    xyz[0] +=
        9.7470e-14 * sqrt(2 * PI * 4.5282e+09) * cos(2.2399e+06 * phase + shift[0]) * exp(-4.5282e+09 * phase * phase);
    for (int i = 0; i < 3; i++)
        rgb[i] = (to_rgb[i][0] * xyz[0] + to_rgb[i][1] * xyz[1] + to_rgb[i][2] * xyz[2]) / 1.0685e-7;
}

static inline double schlick(double f0, double c) { return f0 + (1 - f0) * pow(1 - c, 5); }

static inline void iridescent_fresnel(double film_ior, const double f0[3], double thickness, double c, double out[3])
{
    double inside = sqrt(1 - (1 - c * c) / (film_ior * film_ior));
    double r12 = schlick(pow((film_ior - 1) / (film_ior + 1), 2), c), t121 = 1 - r12;
    double opd = 2 * film_ior * thickness * inside, phi[3], second[3], cm[3], r123[3];
    for (int i = 0; i < 3; i++) {
        double root = sqrt(fmin(f0[i] + 0.0001, 0.9999)), index = (1 + root) / (1 - root);
        double r23 = schlick(pow((index - film_ior) / (index + film_ior), 2), inside);
        phi[i] = PI + (index < film_ior ? PI : 0);
        double product = clamp(r12 * r23, 1e-5, 0.9999), rs = t121 * t121 * r23 / (1 - product);
        r123[i] = sqrt(product);
        out[i] = r12 + rs;
        cm[i] = rs - t121;
    }
    for (int m = 1; m <= 2; m++) {
        double shift[3] = {m * phi[0], m * phi[1], m * phi[2]};
        sensitivity(m * opd, shift, second);
        for (int i = 0; i < 3; i++) {
            cm[i] *= r123[i];
            out[i] += cm[i] * 2 * second[i];
        }
    }
    for (int i = 0; i < 3; i++)
        out[i] = fmax(out[i], 0);
}

// glTF 2.0, appendix B: pi D V n.l.
static inline double ggx(vector n, vector v, vector l, double roughness)
{
    double alpha = pow(fmax(roughness, 0.045), 2), square = alpha * alpha, n_l = dot(n, l), n_v = fabs(dot(n, v));
    vector h = unit(sum(l, v)), sine = across(n, h);
    double d = square / (PI * pow(dot(sine, sine) + pow(dot(n, h), 2) * square, 2));
    double smith =
        0.5 / (n_l * sqrt(n_v * n_v * (1 - square) + square) + n_v * sqrt(n_l * n_l * (1 - square) + square));
    return n_l > 0 ? PI * d * smith * n_l : 0;
}

// KHR_materials_anisotropy.
static inline double anisotropic(const struct point *p)
{
    double ab = pow(fmax(p->roughness, 0.045), 2), at = ab + (1 - ab) * p->strength * p->strength;
    vector b = across(p->n, p->t), h = unit(sum(p->l, p->v));
    double n_l = dot(p->n, p->l), n_v = fabs(dot(p->n, p->v));
    double d = 1 / (PI * at * ab * pow(pow(dot(h, p->t) / at, 2) + pow(dot(h, b) / ab, 2) + pow(dot(h, p->n), 2), 2));
    double root_v = sqrt(pow(at * dot(p->v, p->t), 2) + pow(ab * dot(p->v, b), 2) + n_v * n_v);
    double root_l = sqrt(pow(at * dot(p->l, p->t), 2) + pow(ab * dot(p->l, b), 2) + n_l * n_l);
    return n_l > 0 ? PI * d * n_l * 0.5 / (n_l * root_v + n_v * root_l) : 0;
}

// KHR_materials_sheen.
static inline double sheen_l(double x, double alpha)
{
    double part = pow(1 - alpha, 2);
    double a = 21.5473 * (1 - part) + 25.3245 * part, b = 3.82987 * (1 - part) + 3.32435 * part;
    double c = 0.19823 * (1 - part) + 0.16801 * part, d = -1.97760 * (1 - part) - 1.27393 * part;
    double e = -4.32054 * (1 - part) - 4.85967 * part;
    return a / (1 + b * pow(x, c)) + d * x + e;
}

static inline double sheen_lambda(double c, double alpha)
{
    return c < 0.5 ? exp(sheen_l(c, alpha)) : exp(2 * sheen_l(0.5, alpha) - sheen_l(1 - c, alpha));
}

static inline double charlie(vector n, vector v, vector l, double roughness)
{
    double alpha = pow(fmax(roughness, 0.045), 2), n_l = dot(n, l), n_v = fabs(dot(n, v));
    vector h = across(n, unit(sum(l, v)));
    double d = (2 + 1 / alpha) * pow(sqrt(dot(h, h)), 1 / alpha) / (2 * PI);
    if (n_l <= 0)
        return 0;
    return PI * n_l * d / ((1 + sheen_lambda(n_v, alpha) + sheen_lambda(n_l, alpha)) * 4 * n_v * n_l);
}

// All layers, one over another. The albedos of sheen and GGX are those of the product, which other tests check.
static inline void layered_textbook(const struct point *p, int set, double *diffuse, double specular[3])
{
    double n_l = dot(p->n, p->l), n_v = fabs(dot(p->n, p->v)), c = dot(p->v, unit(sum(p->l, p->v)));
    double f0[3], metal[3], dielectric_f[3], metal_f[3], f90 = 1;
    for (int i = 0; i < 3; i++) {
        f0[i] = 0.04;
        if (set & LAYER_DIELECTRIC) {
            f0[i] = fmin(pow((p->ior - 1) / (p->ior + 1), 2) * p->color[i], 1) * p->weight;
            f90 = p->weight;
        }
        metal[i] = p->base[i];
        dielectric_f[i] = f0[i] + (f90 - f0[i]) * pow(1 - c, 5);
        metal_f[i] = schlick(metal[i], c);
    }
    if (set & LAYER_IRIDESCENCE) {
        double film[3];
        iridescent_fresnel(p->film_ior, f0, p->film, c, film);
        for (int i = 0; i < 3; i++)
            dielectric_f[i] += (film[i] - dielectric_f[i]) * p->iridescence;
        iridescent_fresnel(p->film_ior, metal, p->film, c, film);
        for (int i = 0; i < 3; i++)
            metal_f[i] += (film[i] - metal_f[i]) * p->iridescence;
    }
    double s = ggx(p->n, p->v, p->l, p->roughness), albedo = (double)single_scattering((float)n_v, (float)p->roughness);
    if (set & LAYER_ANISOTROPY) {
        double ab = pow(fmax(p->roughness, 0.045), 2), at = ab + (1 - ab) * p->strength * p->strength;
        vec3 v = {(float)dot(p->v, p->t), (float)dot(p->v, across(p->n, p->t)), (float)n_v};
        albedo = (double)stretched_scattering((layered){.alpha_t = (float)at, .alpha_b = (float)ab}, v).albedo;
        s = anisotropic(p);
    }
    double gain = 1 / albedo - 1;
    *diffuse = fmax(n_l, 0) * fmax(1 - largest(dielectric_f), 0);
    if (set & LAYER_DIELECTRIC) // KHR_materials_pbrSpecularGlossiness where `glossy` is 1
        *diffuse *= 1 - p->glossy * largest(f0);
    if (set & LAYER_TRANSMISSION)
        *diffuse *= 1 - p->transmission;
    for (int i = 0; i < 3; i++)
        specular[i] = s * ((1 - p->metallic) * dielectric_f[i] * (1 + f0[i] * gain) +
                           p->metallic * metal_f[i] * (1 + metal[i] * gain));
    if (set & LAYER_SHEEN) {
        double top = largest(p->sheen), at_v = 1 - top * (double)sheen_albedo((float)n_v, (float)p->sheen_roughness),
               at_l = 1 - top * (double)sheen_albedo((float)fmax(n_l, 0), (float)p->sheen_roughness);
        double left = fmax(fmin(at_v, at_l), 0), fibres = charlie(p->n, p->v, p->l, p->sheen_roughness);
        *diffuse *= left;
        for (int i = 0; i < 3; i++)
            specular[i] = specular[i] * left + p->sheen[i] * fibres;
    }
    if (set & LAYER_CLEARCOAT) {
        double along = fabs(dot(p->v, p->coat_n)), share = p->coat * schlick(0.04, along);
        double coat_gain = 0.04 * (1 / (double)single_scattering((float)along, (float)p->coat_roughness) - 1);
        double coat = share * (1 + coat_gain) * ggx(p->coat_n, p->v, p->l, p->coat_roughness);
        *diffuse *= 1 - share;
        for (int i = 0; i < 3; i++)
            specular[i] = specular[i] * (1 - share) + coat;
    }
}

#endif
