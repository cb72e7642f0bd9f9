// batch_job.h: one job of --jobs: the request read from one line, with its options, plan and model.
#ifndef BATCH_JOB_H
#define BATCH_JOB_H

#include "batch_shard.h"
#include "options.h"

#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct batch_job {
    struct batch_job *next; // the next job in a list
    json_t *id;             // a string or an integer
    struct options options; // the options of the worker and of the job
    char **words;           // `options` points into these words
    int word_count;
    struct batch_plan plan; // the plan of one model
    lam_bytes bytes;        // the model's bytes; data is NULL for a file
    bool in_answer;         // the answer contains the pictures' files
    char *output;           // the job's output name, to which `options` points
    char *options_text;     // the options as text, for the pictures' keys; or NULL
    lam_cancel cancel;      // set to cancel the job
    bool cancelled;         // whether the job was cancelled
};

// Settings common to all jobs.
struct batch_job_rules {
    const struct options *options; // the options of the worker
    int threads, in_flight;        // threads per job, and the number of jobs that are drawn at the same time
    bool has_keys;                 // whether there is a journal
};

// The kind of a line. LINE_REFUSED means that the line is invalid; `error` contains the reason.
enum batch_line { LINE_JOB, LINE_CANCEL, LINE_REFUSED };

// Parses a line of JSON. Sets *id to the id in the line, even if the line is refused, and to NULL if the line contains
// no valid id. The line either describes a new job with this id, or cancels the job with this id. The caller calls
// json_decref for the id, and frees the job.
enum batch_line batch_job_read(const char *line, size_t size, const struct batch_job_rules *rules,
                               struct batch_job **job, json_t **id, lam_error *error);

void batch_job_free(struct batch_job *job); // NULL is allowed

// --- restricts the files of jobs to the folders of --allow-path.

// Checks the folders. Fails with LAM_BAD_ARGUMENT if one is not a folder.
bool job_roots_check(const struct options *options, lam_error *error);

// Returns whether a file is below one of the folders, without a link on the way. The file need not exist. With `writes`,
// the caller will write the file, so the file must not be a pipe or a device. Fails with LAM_CANNOT_WRITE if `writes` is
// set, otherwise with LAM_CANNOT_READ.
bool job_roots_have(const struct options *options, const char *path, bool writes, lam_error *error);

// --- makes jobs from the rows of a list (--list).

// Initially zero, except for `is_csv`. The caller calls json_decref for both values.
struct list_rows {
    bool is_csv;     // CSV, whose first line names the columns; otherwise JSON Lines
    json_t *columns; // of CSV; NULL before the first line
    json_t *outputs; // the names of the pictures so far, with their lines; NULL before the first
};

// Makes the text of a job from a row, for batch_job_read: `model` and `output` are keys of the job, other columns are its
// options, and the number of the line is its id. Sets *job to NULL for the first line of CSV; otherwise the caller frees
// it. Fails with LAM_BAD_ARGUMENT.
bool list_rows_take(struct list_rows *rows, const char *text, size_t size, uint64_t line, char **job, lam_error *error);

// --- reads lines from a file or a pipe, each no longer than a limit.

struct job_stream {
    int file;
    char *data; // unconsumed bytes, from `start` on
    size_t start, end, capacity;
    size_t searched; // the first bytes after `start`, in which no line end was found
    size_t limit;    // bytes per line
    uint64_t line;   // number of the last line taken, from 1
    bool skips;      // the rest of a line that is too long is being skipped
    bool ended;      // the end of the stream was reached
};

// Reads the available bytes once; waits if there are none. Returns false and sets errno on failure (ENOMEM: out of
// memory). The end of the stream is not a failure.
bool job_stream_read(struct job_stream *stream);

// Gets a complete line without its line end. At the end of the stream, also gets an incomplete line. The text is valid
// until the next call. TOO_LONG means that the line exceeded the limit; its bytes are discarded. NONE means there is no
// complete line yet, or the stream has ended.
enum job_line { JOB_LINE_NONE, JOB_LINE_WHOLE, JOB_LINE_TOO_LONG };
enum job_line job_stream_next(struct job_stream *stream, const char **text, size_t *size);

// --- the options of a job, given as words of a command line or as a JSON object.

// Makes the words for `value`: a list of words, an object such as {"size": 256, "light": ["a", "b"], "wireframe":
// true}, or nothing (NULL, null). The caller frees the words with job_words_free, even after an error. Fails with
// LAM_BAD_ARGUMENT or LAM_LIMIT.
bool job_words_make(const json_t *value, char ***words, int *count, lam_error *error);
void job_words_free(char **words, int count);

// Adds the words, which must stay valid, to the options. Fails with LAM_BAD_ARGUMENT if a word is invalid or an option
// does not concern the picture.
bool job_words_apply(char *const *words, int count, struct options *options, lam_error *error);

#endif
