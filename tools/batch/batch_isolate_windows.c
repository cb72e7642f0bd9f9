// batch_isolate_windows.c: rejects --isolate on Windows, which cannot copy a process.
#include "batch.h"

#include "console.h"

void batch_isolate(struct batch *batch)
{
    lam_error error;
    complain(&error, LAM_UNSUPPORTED, "%s: lambent for Windows draws all models in one process",
             batch->options->batch.isolate ? "option '--isolate'" : "option '--resume' after a killed run");
    batch_stop(batch, &error);
}
