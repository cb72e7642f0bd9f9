// test_curves.c: compares the equations at single values with the conventions' formulas in double.
#include "test.h"

#include <lambent/light_eval.h>

static void near(double found, double expected, double most)
{
    if (!(fabs(found - expected) <= most))
        fail_msg("found %.9g, expected %.9g", found, expected);
}

TEST(attenuation)
{
    lam_light light = lam_light_default(LAM_LIGHT_POINT);
    near(lam_attenuation_at(&light, 7), 1, 0);
    light.attenuation = (lam_attenuation){1, 0.54f, 0.2f};
    for (double d = 0; d < 50; d += 0.7)
        near(lam_attenuation_at(&light, (float)d), 1 / (1 + 0.54 * d + 0.2 * d * d), 2e-7);
    light.range = 10;
    near(lam_attenuation_at(&light, 5), (1 - 0.0625) / (1 + 2.7 + 5), 2e-7);
    near(lam_attenuation_at(&light, 10), 0, 0);
    light.attenuation = (lam_attenuation){0, 0, 1};
    near(lam_attenuation_at(&light, 0), 0, 0);
    light = lam_light_default(LAM_LIGHT_DIRECTIONAL);
    near(lam_attenuation_at(&light, 100), 1, 0);
}

TEST(spot)
{
    lam_light light = lam_light_default(LAM_LIGHT_SPOT);
    light.cutoff_rad = 0.5f;
    light.exponent = 8;
    for (double a = 0; a < 1.5; a += 0.05)
        near(lam_spot_at(&light, a), a <= 0.5 + 1e-6 ? pow(cos(a), 8) : 0, 1e-6);
    near(lam_spot_at(&light, 0.5), pow(cos(0.5), 8), 1e-6); // the edge itself is lit
    light.cutoff_rad = 0;
    near(lam_spot_at(&light, 1.2), pow(cos(1.2), 8), 1e-6);
    near(lam_spot_at(&light, 2.0), 0, 0);
    light.inner_rad = 0.2f;
    light.outer_rad = 0.6f;
    for (double a = 0; a < 1.5; a += 0.05) {
        double part = fmin(fmax((cos(a) - cos(0.6)) / (cos(0.2) - cos(0.6)), 0), 1);
        near(lam_spot_at(&light, a), part * part, 3e-6);
    }
    light = lam_light_default(LAM_LIGHT_POINT);
    near(lam_spot_at(&light, 3), 1, 0);
}

TEST(highlight)
{
    const float alphas[] = {0, 1, 10, 50, 1000};
    for (int i = 0; i < 5; i++)
        for (double a = 0; a < 1.55; a += 0.05) {
            double alpha = (double)alphas[i];
            near(lam_highlight_at(LAM_REFLECTION_PHONG, alphas[i], a), pow(cos(a), alpha), 2e-7 * (alpha + 5));
            near(lam_highlight_at(LAM_REFLECTION_BLINN_PHONG, alphas[i], a), pow(cos(a / 2), alpha),
                 2e-7 * (alpha + 5));
        }
    near(lam_highlight_at(LAM_REFLECTION_LAMBERT, 10, 0), 0, 0);
    near(lam_highlight_at(LAM_REFLECTION_PHONG, 10, 2), 0, 0);
    near(lam_highlight_at(LAM_REFLECTION_AUTO, 4, 1), pow(cos(0.5), 4), 1e-6);
}
