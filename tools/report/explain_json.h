// explain_json.h: prints an explained pixel as one line of JSON, for programs and the viewer's page.
#ifndef EXPLAIN_JSON_H
#define EXPLAIN_JSON_H

#include <stdio.h>

#include <lambent/explain.h>

#include "job.h"

void explain_json(FILE *file, const lam_explanation *explanation, const struct job *job);

#endif
