// explain.h: an explained pixel as text for people and as JSON.
#ifndef EXPLAIN_H
#define EXPLAIN_H

#include "job.h"

// On standard output.
void explain_text(const lam_explanation *explanation, const char *model);
void explain_json(const lam_explanation *explanation, const char *model);

// The names that options have for these.
const char *explain_shading(lam_shading shading);
const char *explain_frame(lam_light_frame frame);

#endif
