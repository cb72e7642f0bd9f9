// batch_state.c: the state of a batch.
#include "batch_state.h"

#include "console.h"
#include "exit_codes.h"

void batch_stop(struct batch *b, const lam_error *error)
{
    pthread_mutex_lock(&b->lock);
    int code = exit_code_of(error->code)->code;
    if (!b->failed) {
        batch_hide_progress(&b->tally);
        say_error(error->text);
    }
    b->stop_code = b->failed ? b->stop_code : code;
    b->failed = true;
    b->code = code > b->code ? code : b->code;
    pthread_mutex_unlock(&b->lock);
}
