// explain_json.h: prints an explained pixel as one line of JSON, for programs and the viewer's page.
#ifndef EXPLAIN_JSON_H
#define EXPLAIN_JSON_H

#include "job.h"
#include "vectors.h"

#include <lambent/device.h>
#include <lambent/explain.h>
#include <lambent/light.h>

#include <math.h>
#include <stdio.h>

// Evaluates the formula of the model at the explained point. Returns false if the model has no formula, or if nothing is
// visible.
bool explain_formula(const struct job *job, const lam_explanation *e, lam_formula_point *point);

void explain_json(FILE *file, const lam_explanation *explanation, const struct job *job);

// --- the last steps of a pixel, as formulas of a channel x (lam_tone_formula is the step before)

#define BYTE_FORMULA "floor(255 · x + ½)"

static inline const char *encoding_formula(lam_color_mode mode)
{
    return mode == LAM_COLOR_RAW ? "min(x, 1)" : "x ≤ 0.0031308 ? 12.92 · x : 1.055 · min(x, 1)^(1/2.4) − 0.055";
}

// Returns the colour of the surfaces in the pixel, before the tone curve and the background: exposure · sum ÷ alpha.
static inline lam_rgb exposed_color(const lam_explanation *e)
{
    const float factor = e->sum.a > 0 ? e->exposure / e->sum.a : 0;
    return (lam_rgb){e->sum.r * factor, e->sum.g * factor, e->sum.b * factor};
}

static inline lam_rgb curved_color(const lam_explanation *e)
{
    return e->tone == LAM_TONE_NONE ? exposed_color(e) : lam_tone_apply(e->tone, exposed_color(e));
}

// Returns the angle between v and the plane of n and l, in degrees. The angle φ between r and v is twice the angle ψ
// between n and h only if v is in this plane.
static inline double off_plane_deg(lam_vec3 v, lam_vec3 n, lam_vec3 l)
{
    const lam_vec3 across = cross(n, l);
    const double size = sqrt(dot(across, across)), sine = size > 1e-6 ? fabs(dot(v, across)) / size : 0;
    // rounded, because C libraries compute asin with different last bits
    return floor(in_degrees(asin(sine < 1 ? sine : 1)) * 1e9 + 0.5) / 1e9;
}

// Computes the plane a x + b y + c z + d = 0 of a triangle in its mesh: (a b c) is (p1 − p0) × (p2 − p0), normalised.
static inline void explain_plane(const lam_explained_fragment *f, double plane[4])
{
    const lam_vec3 first = f->places[0].mesh_position;
    const lam_vec3 n = cross(minus(f->places[1].mesh_position, first), minus(f->places[2].mesh_position, first));
    const double size = sqrt(dot(n, n));
    plane[0] = n.x / size, plane[1] = n.y / size, plane[2] = n.z / size;
    plane[3] = -dot(n, first) / size;
}

// --- returns the names that the command line uses for the values of an explanation.

static inline const char *shading_word(lam_shading shading)
{
    return shading == LAM_SHADING_PHONG ? "phong" : shading == LAM_SHADING_GOURAUD ? "gouraud" : "flat";
}

static inline const char *light_frame_word(lam_light_frame frame)
{
    static const char *const words[] = {[LAM_FRAME_WORLD] = "world",
                                        [LAM_FRAME_CAMERA] = "camera",
                                        [LAM_FRAME_OBJECT] = "object",
                                        [LAM_FRAME_MODEL] = "model",
                                        [LAM_FRAME_VIEW] = "view"};
    return words[frame];
}

#endif
