// batch_unit.h: the work on one model of a batch: selects the pictures to draw, draws them, and records the results.
#ifndef BATCH_UNIT_H
#define BATCH_UNIT_H

#include "batch_state.h"

// One model's work and its results. The arrays have picture_count elements.
struct batch_unit {
    struct batch_task task;
    int picture_count;              // task.plan->view_count
    struct batch_picture *pictures; // their states after the work
    char **outputs;                 // paths
    lam_bytes *contents;            // of a job that wants the pictures' files in its answer; NULL: they are written
    const char **classes;           // of failed pictures: the name of the exit code; static
    json_t **records;               // new lines of the journal; or, for the page, old ones (is_new)
    bool *is_new;
    char *out, *err; // messages; NULL: they were printed
    int code, warnings;
    bool interrupted;
};

// Makes the unit of a task with the states of its pictures. Fails with LAM_LIMIT.
bool batch_unit_start(struct batch_unit *unit, const struct batch *batch, const struct batch_task *task,
                      lam_error *error);
void batch_unit_free(struct batch_unit *unit);

// Finds the open pictures that --resume and --skip-same skip. True: some remain to draw. Any thread may call it.
bool batch_unit_look(struct batch_unit *unit, const struct batch *batch);

// Draws the open pictures. `cancel` stops it; NULL: Ctrl-C does. `capture`: messages are kept; else they are printed at once, and
// a terminal has a bar.
void batch_unit_draw(struct batch_unit *unit, const struct batch *batch, const struct options *options,
                     lam_device *device, const lam_cancel *cancel, bool capture);

// Makes all open pictures failed ones, of a class that has no report of its own; `text` names the model.
void batch_unit_fail(struct batch_unit *unit, const struct batch *batch, const char *class, int exit, const char *text);

#endif
