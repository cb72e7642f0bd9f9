// explain_layers.c: prints how the layers of a physical material divide the light at a point (docs/lighting/layers.md).
#include "explain.h"

#include <stdio.h>

void explain_layers_over(char text[60], const lam_explained_layers *layers, float sheen_left)
{
    snprintf(text, 60, "%s%s", layers->coat > 0 ? "(1 − share) · " : "", sheen_left < 1 ? "left · " : "");
}

// For one light, prints the fraction of the light that each layer reflects (docs/lighting/layers.md).
void explain_light_layers(const lam_explained_light_layers *layers, const lam_explained_layers *all)
{
    row_color(4, "base", layers->base, "F S");
    if (layers->sheen_left < 1 || !is_black(layers->sheen)) {
        row_number(4, "left", (double)layers->sheen_left, "the smaller 1 − max(sheen_color) E, at |n·v| and at n·l");
        row_color(4, "sheen", layers->sheen, "sheen_color π D V n·l, with D and V of the fibres");
    }
    if (all->coat > 0)
        row_number(4, "coat", (double)layers->coat, "share · S of the coat");
}

// Prints the properties of the layers that are the same for all lights.
void explain_layers(const lam_explained_layers *layers)
{
    printf("\n  layers\n");
    row_color(4, "f0", layers->dielectric_f0, "of the dielectric, along the normal");
    row_color(4, "f0 of the metal", layers->metal_f0, "");
    if (layers->matt < 1)
        row_number(4, "matt", (double)layers->matt, "(1 − transmission) (1 − specular_glossiness · max f0)");
    if (!is_black(layers->transmittance))
        row_color(4, "transmittance", layers->transmittance, "multiplies the light from behind the surface");
    if (layers->behind_x != 0 || layers->behind_y != 0)
        row_three(4, "bent by", (double)layers->behind_x, (double)layers->behind_y, 0,
                  "pixels by which the picture behind is shifted to the right and down");
    if (layers->behind_blur > 0)
        row_number(4, "blurred over", (double)layers->behind_blur,
                   "pixels: height · 1024^(roughness · min(2 ior − 2, 1) − 1), at most height / 8");
    if (layers->sheen_left < 1)
        row_number(4, "left", (double)layers->sheen_left,
                   "1 − max(sheen_color) E(|n·v|): the light that the sheen transmits to the base");
    if (!is_zero(layers->coat_normal))
        row_vector(4, "n_c", layers->coat_normal, "the coat's normal");
    if (layers->coat > 0)
        row_number(4, "share", (double)layers->coat, "of the coat: clearcoat (0.04 + 0.96 (1 − |n_c·v|)⁵)");
}

// Prints the environment light that each layer reflects. The diffuse part belongs to the diffuse term, and the other
// parts belong to the specular term.
void explain_environment_parts(const lam_explained_point *p)
{
    const lam_explained_layers *layers = p->layers;
    lam_rgb diffuse = p->environment_diffuse;
    if (!layers) {
        row_color(4, "diffuse part", diffuse, "base (1 − metallic) ⊙ irradiance/π (1 − (0.04 scale + bias))");
        row_color(4, "mirrored part", p->environment_specular, "prefiltered ⊙ (f0 scale + bias)");
        return;
    }
    char text[200], under[60];
    explain_layers_over(under, layers, layers->sheen_left);
    snprintf(text, sizeof text, "%s%sbase (1 − metallic) ⊙ irradiance/π (1 − max(f0 scale + bias))", under,
             layers->matt < 1 ? "matt · " : "");
    row_color(4, "diffuse part", diffuse, text);
    snprintf(text, sizeof text, "%sprefiltered ⊙ (f0 scale + bias)", under);
    row_color(4, "mirrored part", layers->mirrored_part, text);
    if (layers->sheen_left < 1 || !is_black(layers->sheen_part))
        row_color(4, "sheen part", layers->sheen_part,
                  layers->coat > 0 ? "(1 − share) · sheen_color E(|n·v|) ⊙ irradiance/π"
                                   : "sheen_color E(|n·v|) ⊙ irradiance/π");
    if (layers->coat > 0) {
        snprintf(text, sizeof text, "around the mirror image of v about n_c, at level %.7g",
                 (double)layers->coat_level);
        row_color(4, "prefiltered, coat", layers->coat_prefiltered, text);
        row_number(4, "scale + bias, coat", (double)layers->coat_albedo, "");
        row_color(4, "coat part", layers->coat_part, "share · (scale + bias) · prefiltered, of the coat");
    }
}
