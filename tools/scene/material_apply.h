// material_apply.h: applies --material, --back-material and --hide to a scene.
#ifndef MATERIAL_APPLY_H
#define MATERIAL_APPLY_H

#include "material_option.h"

// Sets the front or back (`back`) material of a scene's objects. Error messages use `name` as the option's name.
bool material_option_set(const struct material_option *option, bool back, const char *name, lam_scene *scene,
                         lam_error *error);

// Hides the objects with this name; if there are none, the parts; if there are none either, the surfaces with a
// material of this name (--hide). If the model has no such name, adds a warning if it `may_lack` one, and fails
// otherwise.
bool material_option_hide(const char *target, bool may_lack, lam_scene *scene, lam_error *error);

#endif
