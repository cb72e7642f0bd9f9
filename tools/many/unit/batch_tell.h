// batch_tell.h: the messages of a batch, in the order of the models, a line of progress, a summary.
#ifndef BATCH_TELL_H
#define BATCH_TELL_H

#include "batch_shard.h"
#include "exit_codes.h"
#include "options.h"

enum { TALLY_CLASSES = 12 };

// Counts of pictures.
struct batch_tally {
    struct batch_shard shard;
    size_t total, written, failed, same, before, failed_before; // before: by the runs of the journal
    size_t cancelled;                                           // jobs
    size_t warnings;
    struct {
        const char *name;
        size_t count;
    } classes[TALLY_CLASSES]; // of the failed ones
    size_t retried;           // of `failed`, those to be retried
    double start_ms;
    bool has_progress; // on the terminal
    double drawn_ms;   // when the line of progress was last drawn
    bool shown;
};

// Returns the place of the class.
int batch_count_class(struct batch_tally *tally, const char *name);

// Draws the line of progress anew, at most ten times a second; and takes it away.
void batch_show_progress(struct batch_tally *tally);
void batch_hide_progress(struct batch_tally *tally);

// One line at the end, on standard error.
void batch_say_summary(const struct batch_tally *tally, bool interrupted);

// The messages of a model.
struct batch_text {
    char *out, *err; // from malloc; NULL: nothing
    bool ready;
};

// Messages in the order of the models, whatever order they come in.
struct batch_texts {
    struct batch_text *list;
    size_t count, next;
};

// Takes over a model's messages, and prints the messages that are due. `ok`: all of its pictures are written.
void batch_print(struct batch_texts *texts, size_t model, char *out, char *err, bool ok, struct batch_tally *tally);
// Prints the rest, and frees the list.
void batch_print_rest(struct batch_texts *texts, struct batch_tally *tally);

#endif
