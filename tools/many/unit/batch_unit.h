// batch_unit.h: processes one model of a batch: selects the pictures to draw, draws them and records the results.
#ifndef BATCH_UNIT_H
#define BATCH_UNIT_H

#include "batch_state.h"

// The work on one model, and the results of the work. The arrays have picture_count elements.
struct batch_unit {
    struct batch_task task;
    int picture_count;              // task.plan->view_count
    struct batch_picture *pictures; // the states of the pictures after the work
    char **outputs;                 // paths
    lam_bytes *contents;            // the encoded pictures for a job's answer; NULL if files are written
    const char **classes;           // for failed pictures, the name of the exit code (a static string)
    json_t **records;               // new records for the journal, or old records for the page (see is_new)
    bool *is_new;
    char *out, *err; // the messages; NULL if the messages were printed directly
    int code, warnings;
    bool interrupted;
};

// Makes a unit for a task, with the states of the task's pictures. Fails with LAM_LIMIT.
bool batch_unit_start(struct batch_unit *unit, const struct batch *batch, const struct batch_task *task,
                      lam_error *error);
void batch_unit_free(struct batch_unit *unit);

// Finds the open pictures that --resume or --skip-same skips, and changes their state. Returns true if pictures remain
// to be drawn. Any thread may call it.
bool batch_unit_look(struct batch_unit *unit, const struct batch *batch);

// Draws the open pictures. `cancel` stops the drawing. If `cancel` is NULL, Ctrl-C stops the drawing. If `capture` is
// set, stores the messages in `unit`. Otherwise prints them immediately, and shows a progress bar on a terminal.
void batch_unit_draw(struct batch_unit *unit, const struct batch *batch, const struct options *options,
                     lam_device *device, const lam_cancel *cancel, bool capture);

// Marks all open pictures as failed with an error class. Call this if the drawing process ended without a report, for
// example in a crash. The message `text` must name the model.
// `by_machine`: batch_is_by_machine. If a model's process ends without a report in ATTEMPTS_OF_MACHINE attempts, the
// model is the cause.
enum { ATTEMPTS_OF_MACHINE = 3 };
void batch_unit_fail(struct batch_unit *unit, const struct batch *batch, const char *class, int exit, bool by_machine,
                     const char *text);

#endif
