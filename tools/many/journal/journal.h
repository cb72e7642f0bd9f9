// journal.h: a file with one JSON line for each picture that is done or has failed.
//
// A line is appended by one write() after its picture is in place, so that a run may end anywhere: at worst the last
// line is torn, which is seen by its missing end. During a run, FILE.running beside the journal lists the models in
// progress and their processes. A run that was killed leaves it behind.
#ifndef JOURNAL_H
#define JOURNAL_H

#include <jansson.h>

#include <lambent/base.h>

struct journal;

// How a journal is opened. START: an existing journal is kept as FILE.before. RESUME and SAME: it is read, and lines
// are added to it; for RESUME its options must be these.
enum journal_way { JOURNAL_START, JOURNAL_RESUME, JOURNAL_SAME };

// The contents of the line that begins a run.
struct journal_run {
    const char *options; // batch_options_text, and the names of the pictures
    const char *folder;  // that the pictures lie below, with its '/', as `output` of their lines begins
    const char *shard;   // "2/3"; NULL: there are no shards
    size_t pictures;     // of the whole run, those already written included
};

// `slots`: the most models that are drawn at once. Fails with LAM_BAD_ARGUMENT (other options; in use by another run),
// LAM_CANNOT_READ, LAM_CANNOT_WRITE, LAM_LIMIT.
struct journal *journal_open(const char *path, enum journal_way way, const struct journal_run *run, int slots,
                             lam_error *error);

// Returns the latest line of a picture, by its path; for SAME also by its path below the folder of the pictures,
// however that was spelled then. Returns NULL if there is none. The caller calls json_decref.
json_t *journal_find(const struct journal *journal, const char *output);

// Adds a record. One thread at a time. Error: LAM_CANNOT_WRITE.
bool journal_add(struct journal *journal, const json_t *record, lam_error *error);

// Returns a record as its line, from malloc, with its line end, or NULL if memory runs out.
char *journal_line(const json_t *record);

// Returns the path of FILE.running, which journal_close removes.
const char *journal_running_path(const struct journal *journal);

// Says that a slot's model is being drawn by a process; NULL: nothing is.
void journal_begin(struct journal *journal, int slot, int process, const char *model);

// The models that a killed run was drawing, with the process that did and its machine; calls `visit` for each.
void journal_each_running(const struct journal *journal,
                          void (*visit)(void *user, const char *model, int process, const char *host), void *user);

// Reads a whole file, with a zero after it; from malloc. NULL: `errno`, or 0 if there is none.
char *journal_read(const char *path, size_t *size);

// Closes it. `done`: the run came to its end. FILE.running is removed, also if the run failed, unless it was interrupted while it was drawing.
// NULL is fine.
void journal_close(struct journal *journal, bool done, bool interrupted);

// Text as JSON can store it, from malloc: bytes that are not UTF-8 become U+FFFD and two hexadecimal digits. Returns
// NULL if memory runs out.
char *journal_text(const char *text);

// Returns the path that journal_text has made such a text of, from malloc. Returns NULL if memory runs out.
char *journal_path(const char *text);

#endif
