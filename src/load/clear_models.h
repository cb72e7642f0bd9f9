// clear_models.h: makes a fully transparent scene visible, because its picture would be empty.
#ifndef CLEAR_MODELS_H
#define CLEAR_MODELS_H

#include "scene_internal.h"

// If every triangle is fully transparent, by its material or by its colours, makes those opaque and warns: programs write
// opaque materials so (MeshLab: `Tr 1` without `d`; colours with an alpha of 0). Otherwise warns of the materials of
// MTL files that are fully transparent. One warning in either case. `name`: the file's.
void show_clear_scene(struct lam_scene *scene, const char *name);

#endif
