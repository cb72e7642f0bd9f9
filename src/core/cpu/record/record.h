// record.h: the macro RECORD(…), a hook to which shade.c and lights.c pass their intermediate values. In the drawing
// kernels, the macro is empty. If compiled with RECORDING, it writes the values of one fragment to the recorder
// (recorder.h) of the group `g`, while the recorder is on.
#ifndef RECORD_H
#define RECORD_H

#ifdef RECORDING
#include "recorder.h"

static lam_rgb rgb_from(vec3 v) { return (lam_rgb){v.x, v.y, v.z}; }
static lam_vec3 double3(vec3 v) { return (lam_vec3){(double)v.x, (double)v.y, (double)v.z}; }
static lam_rgb rgb_of(const float v[3]) { return (lam_rgb){v[0], v[1], v[2]}; }

static lam_explained_point *current_point(const struct group *g)
{
    return &g->recorder->points[g->recorder->point_count - 1];
}

// The lists of a point are const for users of the explanation, but the recorder fills them.
static lam_explained_light *current_light(const struct group *g, int i)
{
    lam_explained_point *point = current_point(g);
    return point->lights ? (lam_explained_light *)(uintptr_t)&point->lights[i] : NULL;
}

static bool is_recording(const struct group *g) { return g->recorder && g->recorder->fragment; }

#define RECORD(...)                                                                                                    \
    do {                                                                                                               \
        if (is_recording(g))                                                                                           \
            __VA_ARGS__;                                                                                               \
    } while (0)
#else
#define RECORD(...) (void)(g)
static inline bool is_recording(const struct group *g) { return (void)g, false; }
#endif

#endif
