// batch_run.h: the loop over models that `lambent A B` and `lambent batch` share (docs/batch.md).
#ifndef BATCH_RUN_H
#define BATCH_RUN_H

#include "batch_plan.h"

// Draws the planned models and writes the journal and the page. `journal`: its path; NULL: none. `is_batch`: prints the
// messages of `batch` (errors and a summary) instead of `render`'s. Returns the program's exit code.
int batch_run(const struct batch_plan *plan, const char *journal, bool is_batch);

#endif
