// batch_tell.h: prints the messages of a batch in the order of the models, a progress line and a summary.
#ifndef BATCH_TELL_H
#define BATCH_TELL_H

#include "batch_shard.h"
#include "exit_codes.h"
#include "options.h"

enum { TALLY_CLASSES = 12 };

// Counts of pictures.
struct batch_tally {
    struct batch_shard shard;
    // `before` and `failed_before` count pictures that the journal lists from earlier runs
    size_t total, written, failed, same, before, failed_before;
    size_t cancelled; // the number of cancelled jobs
    size_t warnings;
    struct {
        const char *name;
        size_t count;
    } classes[TALLY_CLASSES]; // the failures by class
    size_t by_machine;        // failures that the machine caused (batch_is_by_machine); `failed` includes these
    size_t by_machine_in_row; // since the latest written picture
    size_t retried;           // failed pictures that wait for a retry; `failed` includes these
    double start_ms;
    bool has_progress; // the terminal shows a progress line
    double drawn_ms;   // when the progress line was last drawn
    bool shown;
};

// Counts a failure of the class `name`. Returns the index of the class in `classes`.
int batch_count_class(struct batch_tally *tally, const char *name);

// batch_show_progress redraws the progress line, at most ten times per second. batch_hide_progress removes the line.
void batch_show_progress(struct batch_tally *tally);
void batch_hide_progress(struct batch_tally *tally);

// Prints one summary line to standard error.
void batch_say_summary(const struct batch_tally *tally, bool interrupted);

// The messages of one model.
struct batch_text {
    char *out, *err; // the messages, allocated with malloc; NULL if there are none
    bool ready;
};

// The messages of all models. The messages are printed in the order of the models, regardless of the order in which
// models finish.
struct batch_texts {
    struct batch_text *list;
    size_t count, next;
};

// Takes ownership of a model's messages, and then prints the messages of all models that come before the first
// unfinished model in the batch. `ok` means that all of the model's pictures are written.
void batch_print(struct batch_texts *texts, size_t model, char *out, char *err, bool ok, struct batch_tally *tally);
// Prints the remaining messages and frees the list.
void batch_print_rest(struct batch_texts *texts, struct batch_tally *tally);

#endif
