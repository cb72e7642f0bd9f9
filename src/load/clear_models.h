// clear_models.h: makes a fully transparent scene visible, because its picture would be empty.
#ifndef CLEAR_MODELS_H
#define CLEAR_MODELS_H

#include "scene_internal.h"

// If every triangle is fully transparent because of its material or its colours, makes these opaque and warns: some
// programs write opaque materials like that (MeshLab: `Tr 1` without `d`; colours with an alpha of 0). Otherwise warns
// of fully transparent materials in MTL files. There is one warning in either case. `name` is the name of the file.
void show_clear_scene(struct lam_scene *scene, const char *name);

#endif
