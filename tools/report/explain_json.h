// explain_json.h: prints an explained pixel as one line of JSON, for programs and the viewer's page.
#ifndef EXPLAIN_JSON_H
#define EXPLAIN_JSON_H

#include "job.h"

#include <lambent/device.h>
#include <lambent/explain.h>
#include <lambent/light.h>

#include <stdio.h>

void explain_json(FILE *file, const lam_explanation *explanation, const struct job *job);

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
