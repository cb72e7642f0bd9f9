// explain.h: prints an explained pixel on standard output as text.
#ifndef EXPLAIN_H
#define EXPLAIN_H

#include "vectors.h"

#include <lambent/explain.h>

struct job;
void explain_text(const lam_explanation *explanation, const struct job *job);

// --- prints aligned rows of an explanation to standard output: a name, numbers and a remark.

void row_label(int indent, const char *text); // pads the label with blanks
void row_three(int indent, const char *name, double x, double y, double z, const char *remark);
void row_heading(int indent, const char *name, const char *alpha); // prints the names of the columns
void row_vector(int indent, const char *name, lam_vec3 v, const char *remark);
void row_color(int indent, const char *name, lam_rgb c, const char *remark);
void row_number(int indent, const char *name, double x, const char *remark);
void row_angle(const char *name, double radians, const char *remark); // prints degrees; NaN means no angle

// Prints the matrices, and the coordinates of a triangle's corners and of the explained point in each space
// (explain_places.c). Prints nothing for lines and points.
void explain_places(const lam_explanation *explanation, const lam_explained_fragment *fragment);

// Print the layers of a physical material (explain_layers.c): the properties that are the same for all lights, the
// fraction of one light that each layer reflects, and the environment light that each layer reflects.
// explain_layers_over writes the factors by which the sheen and the coat dim the base: "(1 − share) · left · ".
void explain_layers(const lam_explained_layers *layers);
void explain_layers_over(char text[60], const lam_explained_layers *layers, float sheen_left);
void explain_light_layers(const lam_explained_light_layers *layers, const lam_explained_layers *all);
void explain_environment_parts(const lam_explained_point *point);

#endif
