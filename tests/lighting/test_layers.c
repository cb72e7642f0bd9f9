// test_layers.c: compares the layers of physical materials (src/lighting/layers.h) with the formulas of the Khronos
// extensions in double precision, implemented independently with libm: random materials under random light, for every
// set of layers; then numbers that can be checked by hand, and the table of the sheen's albedo.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <lambent/material.h>

#include "random.h"

#define LANES 1
#include "lighting.h"

#define PI 3.14159265358979323846

typedef struct {
    double x, y, z;
} vector;

static double dot(vector a, vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static vector sum(vector a, vector b) { return (vector){a.x + b.x, a.y + b.y, a.z + b.z}; }
static vector times(double s, vector a) { return (vector){s * a.x, s * a.y, s * a.z}; }
static vector across(vector a, vector b)
{
    return (vector){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static vector unit(vector a) { return times(1 / sqrt(dot(a, a)), a); }
static double clamp(double x, double low, double high) { return x < low ? low : x > high ? high : x; }
static double largest(const double c[3]) { return fmax(fmax(c[0], c[1]), c[2]); }

// A material and a light at a point.
struct point {
    vector n, v, l, t, coat_n;
    double base[3], metallic, roughness, ior, weight, glossy, color[3], coat, coat_roughness, sheen[3], sheen_roughness,
        strength, iridescence, film_ior, film, transmission;
};

// --- the texts

// KHR_materials_iridescence, "Iridescence Fresnel".
static void sensitivity(double opd, const double shift[3], double rgb[3])
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

static double schlick(double f0, double c) { return f0 + (1 - f0) * pow(1 - c, 5); }

static void iridescent_fresnel(double film_ior, const double f0[3], double thickness, double c, double out[3])
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
static double ggx(vector n, vector v, vector l, double roughness)
{
    double alpha = pow(fmax(roughness, 0.045), 2), square = alpha * alpha, n_l = dot(n, l), n_v = fabs(dot(n, v));
    vector h = unit(sum(l, v)), sine = across(n, h);
    double d = square / (PI * pow(dot(sine, sine) + pow(dot(n, h), 2) * square, 2));
    double smith =
        0.5 / (n_l * sqrt(n_v * n_v * (1 - square) + square) + n_v * sqrt(n_l * n_l * (1 - square) + square));
    return n_l > 0 ? PI * d * smith * n_l : 0;
}

// KHR_materials_anisotropy.
static double anisotropic(const struct point *p)
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
static double sheen_l(double x, double alpha)
{
    double part = pow(1 - alpha, 2);
    double a = 21.5473 * (1 - part) + 25.3245 * part, b = 3.82987 * (1 - part) + 3.32435 * part;
    double c = 0.19823 * (1 - part) + 0.16801 * part, d = -1.97760 * (1 - part) - 1.27393 * part;
    double e = -4.32054 * (1 - part) - 4.85967 * part;
    return a / (1 + b * pow(x, c)) + d * x + e;
}

static double sheen_lambda(double c, double alpha)
{
    return c < 0.5 ? exp(sheen_l(c, alpha)) : exp(2 * sheen_l(0.5, alpha) - sheen_l(1 - c, alpha));
}

static double charlie(vector n, vector v, vector l, double roughness)
{
    double alpha = pow(fmax(roughness, 0.045), 2), n_l = dot(n, l), n_v = fabs(dot(n, v));
    vector h = across(n, unit(sum(l, v)));
    double d = (2 + 1 / alpha) * pow(sqrt(dot(h, h)), 1 / alpha) / (2 * PI);
    if (n_l <= 0)
        return 0;
    return PI * n_l * d / ((1 + sheen_lambda(n_v, alpha) + sheen_lambda(n_l, alpha)) * 4 * n_v * n_l);
}

// All layers, one over another. The albedos of sheen and GGX come from their tables, which other tests check.
static void layered_textbook(const struct point *p, int set, double *diffuse, double specular[3])
{
    double n_l = dot(p->n, p->l), n_v = fabs(dot(p->n, p->v)), c = dot(p->v, unit(sum(p->l, p->v)));
    double f0[3], metal[3], dielectric_f[3], metal_f[3], f90 = 1, mean = p->roughness;
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
    double s = ggx(p->n, p->v, p->l, p->roughness);
    if (set & LAYER_ANISOTROPY) {
        double ab = pow(fmax(p->roughness, 0.045), 2), at = ab + (1 - ab) * p->strength * p->strength;
        mean = pow(at * ab, 0.25);
        s = anisotropic(p);
    }
    double gain = 1 / (double)single_scattering((float)n_v, (float)mean) - 1;
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

// --- random points

static vector random_direction(struct random *r)
{
    for (;;) {
        vector d = {(double)random_between(r, -1, 1), (double)random_between(r, -1, 1),
                    (double)random_between(r, -1, 1)};
        if (dot(d, d) > 0.01 && dot(d, d) < 1)
            return unit(d);
    }
}

static double share(struct random *r) { return (double)random_between(r, 0, 1); }

static vec3 narrow(vector a) { return (vec3){(float)a.x, (float)a.y, (float)a.z}; }
static vector widen(vec3 a) { return (vector){(double)a.x, (double)a.y, (double)a.z}; }

static struct point random_point(struct random *r)
{
    struct point p = {.n = {0, 0, 1}};
    p.v = random_direction(r);
    p.l = random_direction(r);
    p.coat_n = unit(sum(p.n, times(0.3, random_direction(r))));
    double angle = share(r) * 2 * PI;
    p.t = (vector){cos(angle), sin(angle), 0};
    // The numbers are floats, like the numbers of a material.
    p.v = widen(narrow(p.v)), p.l = widen(narrow(p.l)), p.t = widen(narrow(p.t)), p.coat_n = widen(narrow(p.coat_n));
    for (int i = 0; i < 3; i++) {
        p.base[i] = share(r);
        p.color[i] = 3 * share(r);
        p.sheen[i] = share(r);
    }
    p.metallic = share(r);
    p.roughness = 0.1 + 0.9 * share(r);
    p.ior = 1 + 2 * share(r);
    p.weight = share(r);
    p.glossy = share(r);
    p.coat = share(r);
    p.coat_roughness = 0.1 + 0.9 * share(r);
    p.sheen_roughness = 0.2 + 0.8 * share(r);
    p.strength = share(r);
    p.iridescence = share(r);
    p.film_ior = 1 + share(r);
    p.film = 1000 * share(r);
    p.transmission = share(r);
    return p;
}

static layer_values layers_from(const struct point *p)
{
    layer_values m = {.base = {(float)p->base[0], (float)p->base[1], (float)p->base[2]},
                      .metallic = (float)p->metallic,
                      .roughness = (float)p->roughness,
                      .ior = (float)p->ior,
                      .specular_weight = (float)p->weight,
                      .f0_color = {(float)p->color[0], (float)p->color[1], (float)p->color[2]},
                      .specular_glossiness = (float)p->glossy,
                      .clearcoat = (float)p->coat,
                      .clearcoat_roughness = (float)p->coat_roughness,
                      .clearcoat_normal = narrow(p->coat_n),
                      .sheen_color = {(float)p->sheen[0], (float)p->sheen[1], (float)p->sheen[2]},
                      .sheen_roughness = (float)p->sheen_roughness,
                      .anisotropy = (float)p->strength,
                      .stretch = narrow(p->t),
                      .iridescence = (float)p->iridescence,
                      .iridescence_ior = (float)p->film_ior,
                      .film = (float)p->film,
                      .transmission = (float)p->transmission};
    return m;
}

static void test_random_points(void **state)
{
    (void)state;
    struct random r = {2026};
    enum { SETS = LAYER_VOLUME, POINTS = 300 };
    double worst = 0;
    for (int set = 0; set < SETS; set++)
        for (int i = 0; i < POINTS; i++) {
            struct point p = random_point(&r);
            double n_l = dot(p.n, p.l), c_l = dot(p.coat_n, p.l), c_v = dot(p.coat_n, p.v), diffuse, specular[3];
            vector half = sum(p.l, p.v);
            // If the last digit decides between everything and nothing, or if it is most of l + v, either is right.
            if (fabs(n_l) < 1e-4 || fabs(c_l) < 1e-4 || fabs(c_v) < 1e-4 || dot(half, half) < 0.01 ||
                fabs(dot(p.n, p.v)) < 0.01)
                continue;
            layered_textbook(&p, set, &diffuse, specular);
            surface s = {.n = narrow(p.n), .v = narrow(p.v), .t = narrow(p.t)};
            layered m = layered_of(s, layers_from(&p), 1, set);
            lobe_value lobe = microfacet_of(ggx_lobe(s, narrow(p.l), m.roughness));
            layered_value value = layered_light(s, m, narrow(p.l), lobe, set);
            const float *found = &value.specular.x;
            double allowed = 5e-6 * (1 + largest(specular)) * (set & LAYER_IRIDESCENCE ? 4 : 1);
            for (int k = 0; k < 3; k++) {
                double error = fabs((double)found[k] - specular[k]);
                if (!(error <= allowed))
                    fail_msg("set %d, point %d: specular %d is %.8g, the text gives %.8g", set, i, k, (double)found[k],
                             specular[k]);
                worst = fmax(worst, error / allowed);
            }
            if (!(fabs((double)value.diffuse - diffuse) <= allowed))
                fail_msg("set %d, point %d: diffuse is %.8g, the text gives %.8g", set, i, (double)value.diffuse,
                         diffuse);
        }
    print_message("layers: %.2g of the error that is allowed\n", worst);
}

// Layers with neutral numbers do not change lobes.h and sum.h.
static void test_neutral(void **state)
{
    (void)state;
    struct random r = {7};
    for (int i = 0; i < 2000; i++) {
        struct point p = random_point(&r);
        layer_values given = layers_from(&p);
        given.ior = 1.5f;
        given.specular_weight = 1;
        given.specular_glossiness = 0;
        given.f0_color = (vec3){1, 1, 1};
        given.clearcoat = given.anisotropy = given.iridescence = given.transmission = 0;
        given.sheen_color = (vec3){0, 0, 0};
        surface s = {.n = narrow(p.n), .v = narrow(p.v), .t = narrow(p.t)};
        layered m = layered_of(s, given, 1, LAYER_VOLUME - 1);
        lobe_value plain = microfacet_of(ggx_lobe(s, narrow(p.l), given.roughness));
        layered_value value = layered_light(s, m, narrow(p.l), plain, LAYER_VOLUME - 1);
        fresnel f = fresnel_of(given.base, given.metallic, scattering_gain(s, given.roughness));
        light_source light = with_fresnel((light_source){.specular = {1, 1, 1}}, f, s.v, narrow(p.l));
        float allowed = 2e-5f * (1 + plain.specular);
        assert_true(fabsf(value.diffuse - plain.diffuse) <= 2e-6f);
        assert_true(fabsf(value.specular.x - plain.specular * light.specular.x) <= allowed);
        assert_true(fabsf(value.specular.z - plain.specular * light.specular.z) <= allowed);
        surroundings e = {{0.3f, 0.4f, 0.5f}, {0.6f, 0.7f, 0.8f}, 0, 0};
        e.albedo = single_scattering(eye_cosine(s), given.roughness);
        e.bias = schlick_scattering(eye_cosine(s), given.roughness);
        vec3 kd = scale3(given.base, 1 - given.metallic);
        returned_light around = surroundings_light(f, kd, e),
                       layered_around = layered_surroundings(s, m, kd, e, e, LAYER_VOLUME - 1);
        assert_true(fabsf(around.diffuse.x - layered_around.diffuse.x) <= 2e-6f);
        assert_true(fabsf(around.specular.y - layered_around.specular.y) <= 2e-6f);
    }
}

static void make_unit(const double v[3], double out[3])
{
    double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int c = 0; c < 3; c++)
        out[c] = v[c] / length;
}

static vec3 narrow3(const double v[3]) { return (vec3){(float)v[0], (float)v[1], (float)v[2]}; }

// Specular antialiasing: compares the variance of normals with differences of unit normals, Toksvig's length, and the
// wider lobe.
static void test_widening(void **state)
{
    (void)state;
    struct random r = {11};
    for (int i = 0; i < 2000; i++) {
        double normal[3], slope[2][3], sum = 0;
        const double scale = (double)random_between(&r, 0.5f, 2.5f), step = 1e-6;
        for (int c = 0; c < 3; c++) {
            normal[c] = scale * (double)random_between(&r, -1, 1) + (c == 2 ? 2 : 0);
            slope[0][c] = (double)random_between(&r, -0.2f, 0.2f);
            slope[1][c] = (double)random_between(&r, -0.2f, 0.2f);
        }
        for (int k = 0; k < 2; k++) {
            double before[3], after[3], here[2][3];
            for (int c = 0; c < 3; c++) {
                here[0][c] = normal[c] - step * slope[k][c];
                here[1][c] = normal[c] + step * slope[k][c];
            }
            make_unit(here[0], before);
            make_unit(here[1], after);
            for (int c = 0; c < 3; c++)
                sum += pow((after[c] - before[c]) / (2 * step), 2) / 12;
        }
        float found = normal_variance(narrow3(normal), narrow3(slope[0]), narrow3(slope[1]));
        assert_true(fabs((double)found - sum) <= 1e-5 * (1 + sum));
        double roughness = (double)random_between(&r, 0.05f, 1), alpha = roughness * roughness;
        double wide = pow(fmin(alpha * alpha + fmin(2 * sum, 0.18), 1), 0.25);
        assert_true(fabs((double)widened_roughness((float)roughness, (float)sum) - wide) <= 2e-6);
    }
    assert_true(widened_roughness(0.3f, 0) == 0.3f && widened_roughness(0, 1) > 0.65f && widened_roughness(1, 9) == 1);
    assert_true(map_variance((vec3){0, 0, 1}, 1, 5) == 0 && map_variance((vec3){0, 0, 0.5f}, 1, -2) == 0);
    double r_length = 0.803;
    assert_true(fabs((double)map_variance((vec3){0.48f, 0, 0.64f}, 2, 3) - 4 * (1 - r_length) / r_length) < 1e-6);
}

// Numbers from the texts.
static void test_known_answers(void **state)
{
    (void)state;
    surface s = {.n = {0, 0, 1}, .v = {0, 0, 1}, .t = {1, 0, 0}};
    layer_values m = {
        .base = {1, 0.5f, 0.25f}, .roughness = 1, .ior = 3, .specular_weight = 0.5f, .f0_color = {1, 0.2f, 9}};
    layered y = layered_of(s, m, 0, LAYER_DIELECTRIC); // ((3 - 1) / (3 + 1))^2 = 1/4; the blue is clamped to 1
    assert_true(y.dielectric.x == 0.125f && fabsf(y.dielectric.y - 0.025f) < 1e-8f && y.dielectric.z == 0.5f);
    assert_true(y.grazing == 0.5f);
    m.ior = 0; // reflects everything
    m.specular_weight = 1;
    m.f0_color = (vec3){1, 1, 1};
    y = layered_of(s, m, 0, LAYER_DIELECTRIC);
    assert_true(layered_light(s, y, s.v, microfacet_of(ggx_lobe(s, s.v, y.roughness)), LAYER_DIELECTRIC).diffuse == 0 &&
                y.dielectric.x == 1);
    // Glass that transmits everything: the light from behind, times base and 1 - 0.04; half of it after half of the
    // distance after which the volume passes a quarter.
    m.transmission = 1;
    m.path = 0.5f;
    m.attenuation_log = (vec3){-2, -2, 0};
    y = layered_of(s, m, 0, LAYER_TRANSMISSION | LAYER_VOLUME);
    vec3 through = layered_transmittance(s, y, m, LAYER_TRANSMISSION | LAYER_VOLUME);
    assert_true(fabsf(through.x - 0.48f) < 1e-6f && fabsf(through.y - 0.24f) < 1e-6f &&
                fabsf(through.z - 0.24f) < 1e-6f);
    // A coat reflects 4 % of the light from straight above, and dims the light of the surface below.
    m.clearcoat = 1;
    m.clearcoat_normal = s.n;
    y = layered_of(s, m, 0, LAYER_CLEARCOAT);
    terms t = cover_terms(start_terms((vec3){1, 1, 1}, (vec3){1, 1, 1}), y, LAYER_CLEARCOAT);
    assert_true(fabsf(t.emission.x - 0.96f) < 1e-6f && fabsf(t.ambient.y - 0.96f) < 1e-6f);
    // Cosines of full turns.
    for (float turns = 0; turns < 3; turns += 0.037f)
        assert_true(fabs((double)cosine_of_turns(turns) - cos(2 * PI * (double)turns)) < 1e-6);
}

// Compares the table of the sheen's albedo with the integral of the lobe, if it is wide enough for a plain grid.
static void test_sheen_table(void **state)
{
    (void)state;
    enum { RINGS = 300, SECTORS = 300 };
    for (double roughness = 0.3; roughness <= 1.01; roughness += 0.1)
        for (double z = 0.15; z < 1; z += 0.2) {
            vector n = {0, 0, 1}, v = {sqrt(1 - z * z), 0, z};
            double total = 0;
            for (int i = 0; i < RINGS; i++) {
                double l_z = (i + 0.5) / RINGS, l_r = sqrt(1 - l_z * l_z);
                for (int k = 0; k < SECTORS; k++) {
                    double angle = (k + 0.5) / SECTORS * PI;
                    total += charlie(n, v, (vector){l_r * cos(angle), l_r * sin(angle), l_z}, roughness);
                }
            }
            double albedo = total * 2 / (RINGS * SECTORS);
            if (fabs(albedo - (double)sheen_albedo((float)z, (float)roughness)) > 0.01)
                fail_msg("roughness %g, n.v %g: the table has %.4f, the integral is %.4f", roughness, z,
                         (double)sheen_albedo((float)z, (float)roughness), albedo);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_widening), cmocka_unit_test(test_known_answers),
                                       cmocka_unit_test(test_neutral), cmocka_unit_test(test_random_points),
                                       cmocka_unit_test(test_sheen_table)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
