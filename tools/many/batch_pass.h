// batch_pass.h: runs one pass over the models: selects the next model, and processes the results of finished models.
#ifndef BATCH_PASS_H
#define BATCH_PASS_H

#include "batch_unit.h"

// Begins a pass. Pass 0 covers all models that have not been drawn. Later passes cover the failed models that may be
// retried. Returns false if there is nothing to do, or after an interrupt.
bool batch_begin_pass(struct batch *batch, int pass);

// Begins a pass over the models that a killed run was drawing, and removes the temporary files of its processes.
// Returns false if there are no such models.
bool batch_begin_suspects(struct batch *batch);
void batch_end_suspects(struct batch *batch);

// Gets the next model of the pass, or the next job. Waits for a job if `waits` is set. Returns false if there is no
// next model or job, or if the batch must not start any more models. Any thread may call this function.
bool batch_take(struct batch *batch, struct batch_task *task, bool waits);

// Processes the results of a unit: updates counters, writes journal lines and messages, and answers the job. Any thread
// may call this function.
void batch_deliver(struct batch *batch, struct batch_unit *unit);

// Removes the temporary files that a killed process left beside a model's pictures. `host` is the machine of the
// process; NULL means this machine.
void batch_remove_parts(const struct batch_plan *plan, size_t model, int process, const char *host);

#endif
