// scene_models.h: the models that the objects of a scene file show.
#ifndef SCENE_MODELS_H
#define SCENE_MODELS_H

#include "scene_reader.h"

// The mesh that an object names, and how to make it.
struct model_wanted {
    const struct place *place; // of the object
    const char *file, *shape;  // one of them, or the formula; the file as the scene names it
    const lam_formula *formula;
    lam_shape_params segments; // of a shape
    lam_normals normals;
    double crease_angle_rad; // 0: the default
    bool field_tangents;
    const char *scene, *variant, *animation; // of a glTF file, as in lam_load_params
    double time_s;
    const json_t *materials, *parts; // the object's changes of the model; NULL: none
};

// Adds the objects of a model to the scene. Objects that want the same share meshes and materials. *origin: the index of
// its record in scene->origins. *own: the meshes and materials are new, and get the object's changes.
bool add_model(struct scene_reader *r, const struct model_wanted *wanted, int *origin, bool *own);

#endif
