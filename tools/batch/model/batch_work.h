// batch_work.h: the work on one model of a batch, and the state of the batch: messages, counts and the pictures drawn.
#ifndef BATCH_WORK_H
#define BATCH_WORK_H

#include "batch_shard.h"
#include "console.h"
#include "job.h"
#include "journal.h"
#include "options.h"
#include "sandbox.h"

#include <jansson.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <sys/mman.h>

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

// --- A counter shared by processes, which limits the number of pictures on a page.

// Allocates a counter with the value 0 in memory that is shared with child processes. Returns NULL if memory runs out.
static inline atomic_int *shared_count_make(void)
{
    void *memory = mmap(NULL, sizeof(atomic_int), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    return memory == MAP_FAILED ? NULL : memory;
}

static inline void shared_count_free(atomic_int *count)
{
    if (count)
        munmap(count, sizeof *count);
}

// Increments the counter. Returns false if the counter had already reached `most`.
static inline bool shared_count_take(atomic_int *count, int most) { return atomic_fetch_add(count, 1) < most; }

// --- the interface for commands that draw many models but write no pictures, for example to compute hashes or to
// compare models.
//
// These commands share the loop over the models, including its workers, processes, sandbox, messages and counts. The
// results for a model are stored in the model's record.

enum { BATCH_RECEIVER_FILES = 3 };
struct batch_receiver {
    // Draws a model of the plan. `job` contains the options, the model, the device and the start time. The loop reports
    // the job's warnings and frees the job. The function stores its results in the object `found`, which becomes part
    // of the model's record. Any thread may call `draw`; with --isolate, the loop calls it in another process.
    bool (*draw)(void *user, size_t model, struct job *job, struct progress *progress, json_t *found, lam_error *error);
    // Adds the paths that a model needs in addition to its own folder. May be NULL.
    void (*reach)(void *user, size_t model, struct sandbox_paths *paths);
    // Decides which files a process in the sandbox may write. NULL allows no files.
    writer_rule *right;
    const char
        *files[BATCH_RECEIVER_FILES]; // these files, and the folders in which it may write; NULL if there are fewer
    // Called after the last model, unless the run was interrupted. Receives the records of all models; `failed` is the
    // number of failed models. Returns the exit code. The loop owns the records.
    int (*finish)(void *user, json_t *const *records, size_t failed);
    void *user;
};

// --- draws one model: all of its pictures, with their messages and records.

// A model to draw.
struct batch_drawing {
    const struct options *options;
    const char *options_text; // the options as text for the keys; NULL if records have no keys
    bool has_records;         // whether records are needed
    const char *model;
    const lam_bytes *model_bytes; // the bytes of the model that `model` names; NULL if the model is a file
    const struct job_view *views; // the views of the pictures
    char *const *outputs;         // the paths of the pictures
    lam_bytes *contents;          // receives the pictures; NULL if the pictures are written to the paths
    const int *attempts;          // the attempt number of each picture, starting at 1
    int view_count;
    bool one_of_many;                 // several models are drawn with the same options
    bool several;                     // the command line has several views or sizes
    const char *transforms;           // the file to which the cameras are written, or NULL
    bool makes_folders;               // creates the pictures' folders even if the user gave the pictures' paths
    const lam_cancel *cancel;         // stops the drawing; if NULL, only Ctrl-C does
    const struct batch_receiver *use; // its functions receive the picture; NULL if the picture is written to a file
    size_t index;                     // the index of the model in the plan, for `use`
};

// The resources for drawing a model.
struct batch_artist {
    lam_device *device;
    struct environment_cache *environments; // NULL if each model reads its own environment
    FILE *out;                              // receives reports
    bool has_bar;                           // a progress bar on the terminal
    bool warns;                             // prints warnings; errors are always printed
    bool is_talkative;                      // prints a line for each picture
};

struct batch_outcome {
    enum { BATCH_INTERRUPTED, BATCH_WRITTEN, BATCH_FAILED } kind;
    const char *class; // the name of the picture's exit code
    bool by_machine;   // batch_is_by_machine
};

struct batch_result {
    struct batch_outcome *outcomes; // the outcome of each picture
    json_t **records;               // the record of each picture; NULL if not needed or interrupted
    int record_count;
    int warnings;
    int code; // the highest exit code
    bool interrupted;
};

// Draws the model. Reports errors as messages and in the records. The caller frees the result.
void batch_draw(const struct batch_drawing *drawing, const struct batch_artist *artist, struct batch_result *result);
void batch_result_free(struct batch_result *result);

// Returns whether the machine caused an error, not the model: no space, memory, descriptors or processes. A later run
// draws the picture again.
bool batch_is_by_machine(const lam_error *error);

// Makes the record of a failed picture. Call this if the drawing process ended without a report.
json_t *batch_record_failed(const struct batch_drawing *drawing, int view, const char *name, int exit, bool by_machine,
                            const char *text);

// --- the state of a batch: the result of each picture, and the running workers.

// The state of a picture.
enum picture_outcome {
    PICTURE_OPEN, // not drawn yet
    PICTURE_WRITTEN,
    PICTURE_SAME,          // --skip-same: the picture is unchanged and is not drawn again
    PICTURE_BEFORE,        // --resume: an earlier run has written the picture
    PICTURE_FAILED,        // failed, but may be retried
    PICTURE_FAILED_BEFORE, // failed in an earlier run and is not retried
};

struct batch_picture {
    uint8_t outcome;   // enum picture_outcome
    uint8_t class;     // for a failed picture, the index of its class in tally.classes
    uint16_t attempts; // attempts so far, including earlier runs
    bool by_machine;   // for a failed picture, whether the machine caused the failure (batch_is_by_machine)
};

struct batch_job;
struct batch_jobs;

// The task of a worker: a model in the batch's plan or in a job's own plan.
struct batch_task {
    const struct batch_plan *plan; // the options, the views and the names
    size_t model;                  // the index in the plan
    const char *options_text;      // the options as text, from which the pictures' keys are computed; or NULL
    struct batch_job *job;         // NULL if the plan belongs to the batch
};

struct batch {
    const struct batch_plan *plan; // with --jobs, this plan contains no models
    const struct options *options;
    bool is_batch;
    char *options_text;               // NULL if there are no keys
    struct batch_jobs *jobs;          // --jobs (batch.h); NULL if the plan contains all models
    const struct batch_receiver *use; // receives the pictures; NULL if the pictures are written to files
    enum journal_way way;
    struct journal *journal;
    int workers, threads;                   // threads of each worker
    struct environment_cache *environments; // shared by all models; NULL if each process loads its own

    pthread_mutex_t lock;           // protects the following members
    pthread_cond_t changed;         // signals that a worker is done
    pthread_cond_t moved;           // signals that `next` has reached `read_from`, or that a worker is done
    struct batch_picture *pictures; // the pictures of all models in order
    json_t **records;               // the records of all pictures, in the same order; NULL if not needed
    bool *taken;                    // for each model, whether a worker has taken the model in this pass
    size_t next;                    // the next model that this pass considers
    size_t read_from;               // the position of the thread that reads ahead
    int drawing;                    // the number of busy workers
    struct batch_tally tally;
    struct batch_texts texts;
    int code; // the highest exit code
    bool interrupted;
    bool failed;   // an error has ended the run, so no further model is started
    int stop_code; // the exit code of this error
};

// Returns the states of the pictures of a model in the batch's plan.
static inline struct batch_picture *batch_pictures_of(const struct batch *b, size_t model)
{
    return b->pictures + model * (size_t)b->plan->view_count;
}

// Reports an error after which no further model is started. Any thread may call it.
void batch_stop(struct batch *batch, const lam_error *error);

// --- processes one model of a batch: selects the pictures to draw, draws them and records the results.

// The work on one model, and the results of the work. The arrays have picture_count elements.
struct batch_work {
    struct batch_task task;
    int picture_count;              // task.plan->view_count
    struct batch_picture *pictures; // the states of the pictures after the work
    char **outputs;                 // paths
    char *transforms;               // the path of the file of cameras, or NULL
    lam_bytes *contents;            // the encoded pictures for a job's answer; NULL if files are written
    const char **classes;           // for failed pictures, the name of the exit code (a static string)
    json_t **records;               // new records for the journal, or old records for the page (see is_new)
    bool *is_new;
    struct { // the open pictures, in order, and their indices
        struct job_view *views;
        char **outputs;
        int *attempts, *which;
    } open;
    char *out, *err; // the messages; NULL if the messages were printed directly
    int code, warnings;
    bool interrupted;
};

// Starts the work on a task, with the states of the task's pictures. Fails with LAM_LIMIT.
bool batch_work_start(struct batch_work *work, const struct batch *batch, const struct batch_task *task,
                      lam_error *error);
void batch_work_free(struct batch_work *work);

// Finds the open pictures that --resume or --skip-same skips, and changes their state. Returns true if pictures remain
// to be drawn. Any thread may call it.
bool batch_work_look(struct batch_work *work, const struct batch *batch);

// Draws the open pictures. `cancel` stops the drawing. If `cancel` is NULL, Ctrl-C stops the drawing. If `capture` is
// set, stores the messages in `work`. Otherwise prints them immediately, and shows a progress bar on a terminal.
void batch_work_draw(struct batch_work *work, const struct batch *batch, const struct options *options,
                     lam_device *device, const lam_cancel *cancel, bool capture);

// Marks all open pictures as failed with an error class. Call this if the drawing process ended without a report, for
// example in a crash. The message `text` must name the model.
// `by_machine`: batch_is_by_machine. If a model's process ends without a report in ATTEMPTS_OF_MACHINE attempts, the
// model is the cause.
enum { ATTEMPTS_OF_MACHINE = 3 };
void batch_work_fail(struct batch_work *work, const struct batch *batch, const char *class, int exit, bool by_machine,
                     const char *text);

#endif
