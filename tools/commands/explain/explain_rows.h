// explain_rows.h: aligned rows of an explanation, printed to standard output: a name, numbers, a remark.
#ifndef EXPLAIN_ROWS_H
#define EXPLAIN_ROWS_H

#include <lambent/lambent.h>

void row_label(int indent, const char *text); // and the blanks behind it
void row_three(int indent, const char *name, double x, double y, double z, const char *remark);
void row_heading(int indent, const char *name, const char *alpha); // the names of the columns
void row_vector(int indent, const char *name, lam_vec3 v, const char *remark);
void row_color(int indent, const char *name, lam_rgb c, const char *remark);
void row_number(int indent, const char *name, double x, const char *remark);
void row_angle(const char *name, double radians, const char *remark); // in degrees; NaN: none

static inline bool is_zero(lam_vec3 v) { return v.x == 0 && v.y == 0 && v.z == 0; }

// The matrices, and a triangle's corners and the point in each space (explain_places.c). Nothing of lines and points.
void explain_places(const lam_explanation *explanation, const lam_explained_fragment *fragment);

// The layers of a physical material (explain_layers.c): the ones for light from all directions; the reflected light of
// light 1 from one direction; the reflected environment light of each part of the surface. `explain_layers_over` writes
// the factors of the layers over the base, "(1 − share) · left · ", of those present.
void explain_layers(const lam_explained_layers *layers);
void explain_layers_over(char text[60], const lam_explained_layers *layers, float sheen_left);
void explain_light_layers(const lam_explained_light_layers *layers, const lam_explained_layers *all);
void explain_environment_parts(const lam_explained_point *point);

#endif
