// material_option.h: the values of --material and --back-material, and their effect on a scene.
#ifndef MATERIAL_OPTION_H
#define MATERIAL_OPTION_H

#include <lambent/lambent.h>

struct material_option {
    const char *target; // name of an object, part or material of the model; NULL: the whole model
    lam_color_mode mode;
    bool named;      // begins with a material's name, which replaces the whole material
    char text[1024]; // for lam_material_parse, and the target's name
};

// A text of lam_material_parse, with or without "@TARGET" after it.
bool material_option_parse(const char *text, lam_color_mode mode, struct material_option *option, lam_error *error);

// Returns the keys of the physical metal of a name, "diffuse=…,metallic=1,roughness=0.2", or NULL for other materials.
const char *material_option_metal(const char *name);

// A metal's name alone then selects the physical metal, which reflects the studio, instead of the classic table's row.
void material_option_mirror(struct material_option *option);

// Returns the material that the option makes of one.
lam_material material_option_apply(const struct material_option *option, lam_material material);

// Gives a scene's objects their new material, or (`back`) their back sides. `name` is the option's, for errors.
bool material_option_set(const struct material_option *option, bool back, const char *name, lam_scene *scene,
                         lam_error *error);

// Hides the objects of a name, or else its parts, or else the surfaces of its material (--hide).
bool material_option_hide(const char *target, lam_scene *scene, lam_error *error);

// A warning of the scene for each coefficient over 1.
void material_option_warn(const struct material_option *option, const char *name, lam_scene *scene);

// The same for the materials that the scene itself has: for the first few each, for the others together.
void materials_warn(lam_scene *scene);

// "; for 0 to 255 write #ff0000" if a colour's three numbers look like bytes, else "". Returns `text`.
enum { COLOR_ADVICE_SIZE = 40 };
const char *color_advice(const double rgb[3], char text[COLOR_ADVICE_SIZE]);

#endif
