// test_furnace.c: a white metal in a uniform environment returns all of its light (the white furnace); this tests the
// lobe and the table of its single-scattering albedo.

#define LANES 1
#include "test.h"
#include "lighting.h"

#define PI 3.14159265358979323846

// The integral of S over all directions of light, divided by pi, in double. It uses a grid of half vectors h in which
// microfacets with normal h are evenly dense, so a sharp lobe needs no finer grid; the grid is finer far from the
// normal, where a grazing v sees most of them.
static double albedo(double n_dot_v, double roughness)
{
    enum { RINGS = 400, SECTORS = 100 };
    double alpha = roughness * roughness, square = alpha * alpha, sum = 0;
    double v_x = sqrt(1 - n_dot_v * n_dot_v);
    for (int i = 0; i < RINGS; i++) {
        double rest = 1 - (i + 0.5) / RINGS, u = 1 - rest * rest * rest, h_z = sqrt((1 - u) / (1 + (square - 1) * u)),
               h_r = sqrt(1 - h_z * h_z);
        for (int k = 0; k < SECTORS; k++) {
            double h_x = h_r * cos((k + 0.5) / SECTORS * PI), v_h = v_x * h_x + n_dot_v * h_z;
            double l_z = 2 * v_h * h_z - n_dot_v;
            if (l_z <= 0 || v_h <= 0)
                continue;
            double masked = l_z * sqrt(n_dot_v * n_dot_v * (1 - square) + square);
            double shadowed = n_dot_v * sqrt(l_z * l_z * (1 - square) + square);
            sum += 3 * rest * rest * 4 * (0.5 / (masked + shadowed)) * l_z * v_h / h_z;
        }
    }
    return sum / (RINGS * SECTORS);
}

TEST(test_table)
{
    double worst = 0, mean = 0;
    int count = 0;
    for (double roughness = 0.045; roughness <= 1; roughness += 0.0191)
        for (double root = 0.02; root <= 1; root += 0.049) {
            double n_dot_v = root * root;
            double error =
                fabs((double)single_scattering((float)n_dot_v, (float)roughness) - albedo(n_dot_v, roughness));
            worst = error > worst ? error : worst;
            mean += error;
            count++;
        }
    print_message("single scattering: %.2g off at most, %.2g in the mean\n", worst, mean / count);
    assert_true(worst < 0.025 && mean / count < 6e-4); // the largest error at grazing angles on smooth surfaces
    assert_true(single_scattering(2, 3) == single_scattering(1, 1) &&
                single_scattering(-1, 0) == single_scattering(0, 0));
}

// The lobe itself, over a plain grid of directions, for sufficiently wide lobes.
TEST(test_white_furnace)
{
    enum { RINGS = 600, SECTORS = 600 };
    for (float roughness = 0.4f; roughness < 1.05f; roughness += 0.2f)
        for (float n_dot_v = 0.2f; n_dot_v < 1.05f; n_dot_v += 0.2f) {
            float z = fminf(n_dot_v, 1), rough = fminf(roughness, 1);
            surface s = {.n = {0, 0, 1}, .v = {sqrtf(1 - z * z), 0, z}};
            fresnel f = fresnel_of((vec3){1, 1, 1}, 1, scattering_gain(s, rough));
            double sum = 0;
            for (int i = 0; i < RINGS; i++) {
                double l_z = (i + 0.5) / RINGS, l_r = sqrt(1 - l_z * l_z);
                for (int k = 0; k < SECTORS; k++) {
                    double angle = (k + 0.5) / SECTORS * PI;
                    vec3 l = {(float)(l_r * cos(angle)), (float)(l_r * sin(angle)), (float)l_z};
                    light_source light = with_fresnel((light_source){.specular = {1, 1, 1}}, f, s.v, l);
                    sum += (double)(microfacet_of(ggx_lobe(s, l, rough)).specular * light.specular.y);
                }
            }
            double returned = sum * 2 / (RINGS * SECTORS); // 2 pi / pi
            if (fabs(returned - 1) > 0.01)
                fail_msg("roughness %g, n.v %g: a white metal returns %.4f of the light", (double)rough, (double)z,
                         returned);
        }
}
