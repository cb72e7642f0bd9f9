// batch_run.h: the loop over models that `lambent A B` and `lambent batch` share (docs/batch.md).
#ifndef BATCH_RUN_H
#define BATCH_RUN_H

#include "batch_plan.h"
#include "batch_use.h"

// Draws the planned models and writes the journal and the page. `journal` is the path of the journal, or NULL. Prints
// the messages of `batch` (errors and a summary) if `is_batch` is set, and otherwise the messages of `render`. Returns
// the program's exit code.
int batch_run(const struct batch_plan *plan, const char *journal, bool is_batch);

// Draws the planned models with `use->draw`. Errors are printed in
// the order of the models. Returns the result of `use->finish`, or the exit code of an error that ended the run.
int batch_use_run(const struct batch_plan *plan, const struct batch_use *use);

#endif
