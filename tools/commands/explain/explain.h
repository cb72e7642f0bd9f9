// explain.h: prints an explained pixel, as text for people on standard output or as one line of JSON.
#ifndef EXPLAIN_H
#define EXPLAIN_H

#include <stdio.h>

#include <lambent/lambent.h>

void explain_text(const lam_explanation *explanation, const char *model);
void explain_json(FILE *file, const lam_explanation *explanation, const char *model);

#endif
