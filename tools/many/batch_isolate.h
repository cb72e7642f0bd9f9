// batch_isolate.h: draws each model of a pass in a separate process.
#ifndef BATCH_ISOLATE_H
#define BATCH_ISOLATE_H

#include "batch_pass.h"

// Draws the models of the pass, batch->workers at a time. This process must have no other thread.
void batch_isolate(struct batch *batch);

#endif
