// clear_models.h: makes a fully transparent scene visible, because its picture would otherwise be empty.
#ifndef CLEAR_MODELS_H
#define CLEAR_MODELS_H

#include "scene_internal.h"

// If the materials and colours make every triangle fully transparent, makes them opaque and warns. Some programs write
// opaque models in this form: MeshLab writes `Tr 1` without `d`, or colours with an alpha of 0. Otherwise warns of
// fully transparent materials in MTL files. There is at most one warning. `name` is the name of the file.
void show_clear_scene(struct lam_scene *scene, const char *name);

#endif
