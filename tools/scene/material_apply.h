// material_apply.h: applies --material, --back-material and --hide to a scene.
#ifndef MATERIAL_APPLY_H
#define MATERIAL_APPLY_H

#include "material_option.h"
#include "option_groups.h"

#include <lambent/scene.h>

// Sets the front or back (`back`) material of a scene's objects. Error messages use `name` as the option's name.
bool material_option_set(const struct material_option *option, bool back, const char *name, lam_scene *scene,
                         lam_error *error);

// Hides the objects with this name (--hide). If there are no such objects, hides the parts with this name. If there are
// no such parts either, hides the surfaces with a material of this name. If the model does not contain the name, the
// function adds a warning (if `may_lack` is set) or fails.
bool material_option_hide(const char *target, bool may_lack, lam_scene *scene, lam_error *error);

// Hides the objects whose own name and whose material's name are not among the names (--only). Parts are already
// objects (lam_scene_split_parts). A name that the model does not contain is an error, or, if `may_lack` is set, a
// warning.
bool material_option_only(const struct texts *names, bool may_lack, lam_scene *scene, lam_error *error);

#endif
