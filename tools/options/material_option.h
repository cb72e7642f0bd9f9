// material_option.h: the values of --material and --back-material, and what they do to a scene.
#ifndef MATERIAL_OPTION_H
#define MATERIAL_OPTION_H

#include <lambent/lambent.h>

struct material_option {
    const char *target; // name of an object, part or material of the model; NULL: the whole model
    lam_material_id id; // a named material; LAM_MATERIAL_COUNT: none, what is left out stays
    unsigned seen;      // bit for each key given
    lam_rgba colors[7]; // of each key that is a colour
    double numbers[7];  // of the others
    char text[1024];    // `target` points into it: the struct must not be copied
};

// "NAME", "key=value,…" or "NAME,key=value,…", with "@WHERE" behind; docs in the table of options.
bool material_option_parse(const char *text, lam_color_mode mode, struct material_option *option, lam_error *error);

// The material that the option makes of one.
lam_material material_option_apply(const struct material_option *option, lam_material material);

// Gives a scene's objects their new material, or (`back`) their back sides. `name` is the option's, for errors.
bool material_option_set(const struct material_option *option, bool back, const char *name, lam_scene *scene,
                         lam_error *error);

// A warning of the scene for each coefficient over 1.
void material_option_warn(const struct material_option *option, const char *name, lam_scene *scene);

// The same for the materials that the scene itself has: for the first few each, for the others together.
void materials_warn(lam_scene *scene);

// The changes of --shininess and --opacity; has_… tells which is given.
void material_option_plain(struct material_option *option, bool has_shininess, double shininess, bool has_opacity,
                           double opacity);

#endif
