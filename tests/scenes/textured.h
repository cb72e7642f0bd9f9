// textured.h: declares the scenes of textured.c and layers.c.
#ifndef TEXTURED_H
#define TEXTURED_H

#include "scenes.h"

bool textured_physical(struct demo *d, lam_error *error);
bool textured_classic(struct demo *d, lam_error *error);
bool textured_gouraud(struct demo *d, lam_error *error);
bool textured_environment(struct demo *d, lam_error *error);
bool textured_converted(struct demo *d, lam_error *error);
bool textured_masked(struct demo *d, lam_error *error);
bool textured_shadows(struct demo *d, lam_error *error);
bool textured_layers(struct demo *d, lam_error *error);

bool layers_uniform(struct demo *d, lam_error *error);
bool layers_gouraud(struct demo *d, lam_error *error);
bool layers_environment(struct demo *d, lam_error *error);
bool layers_mapped_environment(struct demo *d, lam_error *error);
bool layers_leaning(struct demo *d, lam_error *error);
bool layers_transmission(struct demo *d, lam_error *error);
bool layers_refraction(struct demo *d, lam_error *error);

// Sets the built-in environment `name`, turned about the y axis.
bool textured_surround(struct demo *d, const char *name, double rotation_rad, lam_error *error);

// Adds a point light and ambient light in place of a rig, and fits the camera.
bool textured_light_up(struct demo *d, lam_error *error);

#endif
