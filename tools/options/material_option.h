// material_option.h: the values of --material and --back-material, and their effect on a scene.
#ifndef MATERIAL_OPTION_H
#define MATERIAL_OPTION_H

#include <lambent/lambent.h>

// Keys: the fields by their index in the table of lam_material_field, then a factor for each (of colours, named by their
// symbols: ka, kd, ks, kr), then shorthands.
enum { MATERIAL_COLOR = 2 * LAM_FIELDS_MAX, MATERIAL_SPECULAR_COLOR, MATERIAL_KEYS };

struct material_option {
    const char *target; // name of an object, part or material of the model; NULL: the whole model
    lam_material_id id; // a named material; LAM_MATERIAL_COUNT: none, keys left out stay as they are
    uint64_t given;     // bit for each key
    double numbers[MATERIAL_KEYS][4];
    char text[1024]; // `target` points into it: the struct must not be copied
};

// "NAME", "key=value,…" or "NAME,key=value,…", followed by "@WHERE"; option_table.c documents it.
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

// An option that changes nothing yet, and the change of one field that is a number.
void material_option_start(struct material_option *option);
void material_option_set_number(struct material_option *option, const char *key, double number);

#endif
