// material_option.h: parses the values of --material and --back-material, and warns about coefficients above 1.
#ifndef MATERIAL_OPTION_H
#define MATERIAL_OPTION_H

#include <lambent/material.h>
#include <lambent/scene.h>

struct material_option {
    const char *target; // the name of an object, part or material; NULL means the whole model
    lam_color_mode mode;
    bool named;      // `text` starts with a material's name, so the option replaces the whole material
    char text[1024]; // the text for lam_material_parse, followed by the target's name
};

// Parses a text for lam_material_parse, optionally followed by "@TARGET".
bool material_option_parse(const char *text, lam_color_mode mode, struct material_option *option, lam_error *error);

// Returns `material` as changed by the option.
lam_material material_option_apply(const struct material_option *option, lam_material material);

// Adds a warning to the scene for each coefficient above 1.
void material_option_warn(const struct material_option *option, const char *name, lam_scene *scene);

// Adds these warnings for the scene's own materials: one for each of the first few coefficients, and a single warning
// for the other coefficients.
void materials_warn(lam_scene *scene);

// Writes "; for 0 to 255 write #ff0000" if the three channels of a colour look like bytes, otherwise "". Returns
// `text`.
enum { COLOR_ADVICE_SIZE = 40 };
const char *color_advice(const double rgb[3], char text[COLOR_ADVICE_SIZE]);

#endif
