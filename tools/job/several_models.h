// several_models.h: places several models in one picture.
#ifndef SEVERAL_MODELS_H
#define SEVERAL_MODELS_H

#include <lambent/scene.h>

// The values of --arrange.
enum arrange { ARRANGE_ROW, ARRANGE_GRID, ARRANGE_AS_IS };

// Turns the scenes to the up axis of the first, places them side by side, and moves them into one scene. Frees all
// scenes, also on failure. The caller frees the result, which is NULL on failure.
lam_scene *several_models_join(lam_scene **scenes, int count, enum arrange arrange, lam_error *error);

#endif
