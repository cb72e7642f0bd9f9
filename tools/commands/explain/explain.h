// explain.h: prints an explained pixel on standard output as text.
#ifndef EXPLAIN_H
#define EXPLAIN_H

#include <lambent/explain.h>

void explain_text(const lam_explanation *explanation, const char *model);

#endif
