// prepare.h: the steps between reading a model file and drawing it.
#ifndef PREPARE_H
#define PREPARE_H

#include "scene_internal.h"

// Repairs the meshes of a file directly after it is read. Triangles, lines and points that use a vertex whose position
// is not finite are left out, and a file without any other fails with LAM_CANNOT_READ. A normal that is zero or not
// finite is no normal. If a mesh contains no other normal, its array is dropped; otherwise the missing normals are
// computed, and lines and points without a normal become a mesh without normals. Adds one warning for each kind.
bool scene_repair(struct lam_scene *scene, const char *name, lam_normals normals, double crease_angle_rad,
                  struct pool *pool, lam_error *error);

// Assigns a white material to surfaces that have vertex colours but no material, because the default grey would darken
// the colours. Call this function directly after a scene is read. Returns false if memory runs out.
bool scene_give_colors_white(struct lam_scene *scene, lam_error *error);
// Computes MikkTSpace tangents for meshes without tangents whose material uses a normal map. If `all` is set, every
// mesh that has normals and texture coordinates but no tangents gets MikkTSpace tangents. The tangents follow the
// texture coordinates of the normal map. The memory counts towards the limit of `call`.
bool scene_make_tangents(struct lam_scene *scene, bool all, struct call_control *call, lam_error *error);

#endif
