// batch_pass.h: one pass over the models: selects the next model, and handles finished ones.
#ifndef BATCH_PASS_H
#define BATCH_PASS_H

#include "batch_unit.h"

// Begins a pass: 0: over all models that no earlier pass has drawn; later: over failed models that may be retried.
// Returns false if there is nothing to do, or an interrupt came.
bool batch_begin_pass(struct batch *batch, int pass);

// Begins a pass over the models that a killed run was drawing, and removes the files that its processes left. False:
// none.
bool batch_begin_suspects(struct batch *batch);
void batch_end_suspects(struct batch *batch);

// The next model of the pass, or the next job, which is waited for with `waits`. Returns false if there is none, or
// nothing more may begin. Any thread.
bool batch_take(struct batch *batch, struct batch_task *task, bool waits);

// Takes over the results of a unit: counts, lines of the journal, messages, the answer to a job. Any thread.
void batch_deliver(struct batch *batch, struct batch_unit *unit);

// Removes the temporary files that a process left beside a model's pictures when it was killed. `host`: the machine
// that ran it; NULL: this one.
void batch_remove_parts(const struct batch_plan *plan, size_t model, int process, const char *host);

#endif
