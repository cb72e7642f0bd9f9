// material_kinds.c: converts classic materials to metallic–roughness materials and back.
#include "linear.h"

#include <lambent/material.h>

static const double dielectric_f0 = 0.04; // index of refraction 1.5

static float mixed(double from, double to, double share) { return (float)(from + (to - from) * share); }

static double within(double x, double low, double high) { return x < low ? low : x > high ? high : x; }

// Finds the reflectance of the dielectric at normal incidence. The reflectance is 0.04, except for specular–glossiness
// materials.
static void dielectric_f0_of(const lam_material *m, double f0[3])
{
    const float *color = &m->f0_color.r;
    double ior = (double)m->ior, boundary = (ior - 1) * (ior - 1) / ((ior + 1) * (ior + 1));
    for (int i = 0; i < 3; i++)
        f0[i] = m->specular_glossiness > 0 ? within(boundary * (double)color[i], 0, 1) * (double)m->specular_weight
                                           : dielectric_f0;
}

lam_material lam_material_as_classic(const lam_material *material)
{
    lam_material m = *material;
    if (!m.physical)
        return m;
    const lam_rgba base = m.diffuse;
    double metallic = (double)m.metallic, slope = (double)m.roughness * (double)m.roughness; // α of the GGX lobe
    double exponent = within(2 / within(slope * slope, 1e-12, 1) - 2, 1, 4096), energy = (exponent + 8) / 8;
    m.physical = false;
    m.ambient = (lam_rgb){base.r, base.g, base.b};
    double f0[3];
    dielectric_f0_of(&m, f0);
    double largest = f0[0] > f0[1] ? f0[0] : f0[1];
    largest = largest > f0[2] ? largest : f0[2];
    double matt = 1 - (double)m.specular_glossiness * largest;
    m.diffuse.r = mixed((double)base.r * matt, 0, metallic);
    m.diffuse.g = mixed((double)base.g * matt, 0, metallic);
    m.diffuse.b = mixed((double)base.b * matt, 0, metallic);
    m.specular.r = (float)(energy * (double)mixed(f0[0], (double)base.r, metallic));
    m.specular.g = (float)(energy * (double)mixed(f0[1], (double)base.g, metallic));
    m.specular.b = (float)(energy * (double)mixed(f0[2], (double)base.b, metallic));
    m.shininess = (float)exponent;
    return m;
}

// Returns the metalness for which some base colour gives kd and f0: the solution of
//    kd = base (1 − metallic),   f0 = 0.04 (1 − metallic) + base metallic
// for the brightest channel of f0.
static double metallic_of(double kd, double f0)
{
    if (f0 <= dielectric_f0)
        return 0;
    // With base = kd/(1 − m): 0.04 (1 − m)² + kd m − f0 (1 − m) = 0
    double a = dielectric_f0, b = f0 + kd - 2 * dielectric_f0, c = dielectric_f0 - f0;
    return within((-b + math_sqrt(b * b - 4 * a * c)) / (2 * a), 0, 1);
}

lam_material lam_material_as_physical(const lam_material *material)
{
    lam_material m = *material;
    if (m.physical)
        return m;
    double exponent = within((double)m.shininess, 1, 4096), energy = (exponent + 8) / 8;
    const float *kd = &material->diffuse.r, *ks = &material->specular.r, *kr = &material->reflectivity.r;
    const bool mirror = kr[0] > 0 || kr[1] > 0 || kr[2] > 0;
    const bool matt = !mirror && ks[0] == 0 && ks[1] == 0 && ks[2] == 0;
    double f0[3];
    for (int i = 0; i < 3; i++) // a mirror reflects at least the share kr
        f0[i] = within((double)kr[i] > (double)ks[i] / energy ? (double)kr[i] : (double)ks[i] / energy, 0, 1);
    int brightest = f0[1] > f0[0] ? 1 : 0;
    brightest = f0[2] > f0[brightest] ? 2 : brightest;
    double metallic = metallic_of((double)kd[brightest], f0[brightest]);
    float *base = &m.diffuse.r;
    for (int i = 0; i < 3; i++) {
        double metal = metallic > 0 ? within((f0[i] - dielectric_f0 * (1 - metallic)) / metallic, 0, 1) : 0;
        base[i] = (float)within((double)kd[i] + metallic * metal, 0, 1);
    }
    m.physical = true;
    m.metallic = (float)metallic;
    m.roughness = mirror ? 0 : matt ? 1 : (float)math_sqrt(math_sqrt(2 / (exponent + 2)));
    return m;
}
