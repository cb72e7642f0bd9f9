// journal.h: reads and writes journals: files with one JSON line for each finished or failed picture.
//
// After a picture is written, a single write() appends the picture's line. If the run is killed, at worst the last line
// is truncated and lacks its line end. During a run, FILE.running beside the journal lists the models in progress and
// their processes. A killed run leaves FILE.running behind.
#ifndef JOURNAL_H
#define JOURNAL_H

#include <jansson.h>

#include <lambent/base.h>

#include "foreign.h"

struct journal;

// How to open a journal. START renames an existing journal to FILE.before. RESUME and SAME read the existing journal
// and append lines to it; RESUME requires the same options.
enum journal_way { JOURNAL_START, JOURNAL_RESUME, JOURNAL_SAME };

// The contents of the line that begins a run.
struct journal_run {
    const char *options; // batch_options_text, and the names of the pictures
    const char *folder;  // the folder of the pictures, ending in '/', as written in the key `output` of the lines
    const char *shard;   // "2/3"; NULL if there are no shards
    size_t pictures;     // the number of pictures of the whole run, including pictures that are already written
};

// Opens a journal. `slots` is the maximum number of models drawn at the same time. Fails with LAM_BAD_ARGUMENT (the
// options differ), LAM_CANNOT_READ, LAM_CANNOT_WRITE (also if another run uses the journal) or LAM_LIMIT.
struct journal *journal_open(const char *path, enum journal_way way, const struct journal_run *run, int slots,
                             lam_error *error);

// Returns the latest line for a picture's path. With SAME, also compares the paths relative to the folder of the
// pictures, because the name of this folder may be written differently. Returns NULL if there is no line. The caller
// calls json_decref.
json_t *journal_find(const struct journal *journal, const char *output);

// Appends a record. Only one thread at a time may call this function. Fails with LAM_CANNOT_WRITE.
bool journal_add(struct journal *journal, const json_t *record, lam_error *error);

// Returns the string value of a key, or "" if the record contains no such string.
struct foreign journal_value(const json_t *record, const char *key);

// Sets a key of a record to `text` (journal_text), or to null if `text` is NULL.
void journal_set_text(json_t *record, const char *key, const char *text);

// Returns a record as a line with its line end, allocated with malloc, or NULL if memory runs out.
char *journal_line(const json_t *record);

// Returns the path of FILE.running, which journal_close removes.
const char *journal_running_path(const struct journal *journal);

// Writes a model and the process that draws the model to a slot of FILE.running. A NULL model frees the slot.
void journal_begin(struct journal *journal, int slot, int process, const char *model);

// Calls `visit` for each model that a killed run was drawing. Passes the process that was drawing the model, and the
// machine of this process.
void journal_each_running(const struct journal *journal,
                          void (*visit)(void *user, const char *model, int process, const char *host), void *user);

// Reads a whole file into memory allocated with malloc, and appends a zero byte. Returns NULL and sets errno on
// failure; errno is 0 if the file does not exist.
char *journal_read(const char *path, size_t *size);

// Closes the journal. `done` means that the run was completed, `exit` is the run's exit code. If FILE.running contains the slots of this run, the
// function removes the file, unless `interrupted` is set. NULL is allowed.
void journal_close(struct journal *journal, bool done, int exit, bool interrupted);

// Converts text for JSON: bytes that are not UTF-8 become U+FFFD and two hexadecimal digits. The result is allocated
// with malloc. Returns NULL if memory runs out.
char *journal_text(const char *text);

// Returns the path from which journal_text made `text`, allocated with malloc. Returns NULL if memory runs out.
char *journal_path(const char *text);

#endif
