// mtl_maps.h: reads the textures that MTL materials name.
#ifndef MTL_MAPS_H
#define MTL_MAPS_H

#include "mtl.h"

// Reads the textures of the scene's materials (map_names, map_options) in parallel, and sets the maps of these
// materials. companion_find finds the pictures, also beside the material's file. A picture that cannot be read is
// omitted with a warning. `memory` is used only during the load.
bool mtl_maps_read(const struct import_source *source, struct lam_scene *scene, const struct mtl_set *set,
                   struct arena *memory, lam_error *error);

#endif
