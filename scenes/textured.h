// textured.h: the scenes of textured.c.
#ifndef TEXTURED_H
#define TEXTURED_H

#include "scenes.h"

bool textured_physical(struct demo *d, lam_error *error);
bool textured_classic(struct demo *d, lam_error *error);
bool textured_gouraud(struct demo *d, lam_error *error);
bool textured_converted(struct demo *d, lam_error *error);
bool textured_masked(struct demo *d, lam_error *error);
bool textured_shadows(struct demo *d, lam_error *error);

#endif
