// test_layers.c: compares the layers of physical materials (src/core/lighting/layers.h) with the formulas of the Khronos
// extensions in double precision, implemented independently with libm: random materials under random light, for every
// set of layers; then numbers that can be checked by hand, and the table of the sheen's albedo.

#include "test.h"

#include <lambent/material.h>

#include "random.h"

#include "layered_textbook.h"

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

TEST(test_random_points)
{
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
TEST(test_neutral)
{
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
TEST(test_widening)
{
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
TEST(test_known_answers)
{
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
TEST(test_sheen_table)
{
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

// The integral of anisotropic microfacets over all directions of light, divided by pi, in double, and the integral with
// Schlick's weight. In the grid of half vectors, microfacets are evenly dense in each ring; rings are denser far from
// the normal.
static void stretched_integral(double alpha_t, double alpha_b, double n_v, double turn, double out[2])
{
    enum { RINGS = 120, SECTORS = 360 };
    double sine = sqrt(1 - n_v * n_v);
    struct point p = {.n = {0, 0, 1}, .t = {1, 0, 0}, .v = {sine * cos(turn), sine * sin(turn), n_v}};
    out[0] = out[1] = 0;
    for (int i = 0; i < RINGS; i++) {
        double rest = 1 - (i + 0.5) / RINGS, u = 1 - pow(rest, 4), slope = sqrt(u / (1 - u));
        for (int k = 0; k < SECTORS; k++) {
            double angle = (k + 0.5) * 2 * PI / SECTORS;
            vector h = unit((vector){alpha_t * slope * cos(angle), alpha_b * slope * sin(angle), 1});
            double v_h = dot(p.v, h);
            vector l = sum(times(2 * v_h, h), times(-1, p.v));
            if (v_h <= 0 || l.z <= 0)
                continue;
            double root_v = sqrt(pow(alpha_t * p.v.x, 2) + pow(alpha_b * p.v.y, 2) + n_v * n_v);
            double root_l = sqrt(pow(alpha_t * l.x, 2) + pow(alpha_b * l.y, 2) + l.z * l.z);
            double share = 4 * pow(rest, 3) * 0.5 / (l.z * root_v + n_v * root_l) * l.z * 4 * v_h / h.z;
            out[0] += share / (RINGS * SECTORS);
            out[1] += share / (RINGS * SECTORS) * pow(1 - v_h, 5);
        }
    }
}

// The albedo of brushed metal is within 5 % of the integral for every pair of roughnesses and every direction.
TEST(test_stretched_albedo)
{
    double worst = 0, mean = 0, bias = 0;
    int count = 0;
    for (double roughness = 0.05; roughness < 1; roughness += 0.19)
        for (double strength = 0.2; strength < 1.01; strength += 0.2)
            for (double n_v = 0.1; n_v < 1; n_v += 0.22)
                for (double turn = 0; turn < 1.6; turn += PI / 8) {
                    double ab = roughness * roughness, at = ab + (1 - ab) * strength * strength, expected[2];
                    double sine = sqrt(1 - n_v * n_v);
                    stretched_integral(at, ab, n_v, turn, expected);
                    vec3 v = {(float)(sine * cos(turn)), (float)(sine * sin(turn)), (float)n_v};
                    layered found = stretched_scattering((layered){.alpha_t = (float)at, .alpha_b = (float)ab}, v);
                    double error = fabs((double)found.albedo / expected[0] - 1);
                    if (error > 0.05)
                        fail_msg("roughness %g, anisotropy %g, n.v %g, %g turns: %.4f, the integral is %.4f", roughness,
                                 strength, n_v, turn / (2 * PI), (double)found.albedo, expected[0]);
                    worst = fmax(worst, error);
                    bias = fmax(bias, fabs((double)found.bias - expected[1]));
                    mean += error;
                    count++;
                }
    print_message("two roughnesses: %.1f %% off at most, %.1f %% in the mean, bias %.3f\n", 100 * worst,
                  100 * mean / count, bias);
    assert_true(mean / count < 0.015 && bias < 0.02);
}
