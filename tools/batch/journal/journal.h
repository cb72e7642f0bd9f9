// journal.h: reads and writes journals: files with one JSON line for each finished or failed picture.
//
// After a picture is written, a single write() appends the picture's line. If the run is killed, at worst the last line
// is truncated and lacks its line end. During a run, FILE.running beside the journal lists the models in progress and
// their processes. A killed run leaves FILE.running behind.
#ifndef JOURNAL_H
#define JOURNAL_H

#include "batch_shard.h"
#include "foreign.h"
#include "options.h"

#include <lambent/base.h>

#include <jansson.h>

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

// --- computes the hash of everything that determines a picture: the options with their defaults, the program's version
// and the contents of files.

// Returns the options that determine a picture, allocated with malloc: one `name=value` per line, including defaults,
// but without side and size. If an option names files, the text contains the files' hashes. Returns NULL on failure;
// LAM_CANNOT_READ means that a file named by an option cannot be read.
char *batch_options_text(const struct options *options, lam_error *error);

// Returns the options of the command line that affect the picture, as typed: "--size 256 --light 'eye=1/2/3'". Relative
// paths are unchanged. The text is allocated with malloc. Returns NULL if memory runs out.
char *batch_options_given(const struct options *options);

// Formats the first options that differ between two texts, as "--size 512 … --size 256", for use in a message.
void batch_options_difference(const char *then, const char *now, char text[300]);

// The inputs of one picture's key.
struct batch_key_parts {
    const char *options; // batch_options_text
    // The same options, parsed; for a scene file, the key includes the names of the typed options.
    const struct options *parsed;
    const char *model;   // the name of a built-in shape; used if no file was read
    const char *format;  // the model's format: lam_scene_format
    const char *picture; // the extension of the picture's name
    const struct job_view *view;
    const char *const *files; // hashes of the files, or "absent"
    int file_count;
};
uint64_t batch_key(const struct batch_key_parts *parts);

// --- combines several journals of one batch, to find the batch's finished, failed and missing pictures.

// The state of one journal after its last run.
struct journal_part {
    char *path, *build, *options; // allocated with malloc
    struct batch_shard shard;     // all zero if the batch has no shards
    size_t pictures;              // the number of planned pictures
    size_t written, failed;       // numbers of pictures
    bool ended;                   // whether the run was completed
    int exit;                     // the exit code of the run; −1 if the journal does not contain it
    char *text;                   // the contents of the file
    size_t size;
};

// The latest line of a picture.
struct journal_entry {
    uint64_t output;  // the hash of the picture's path; 0 if free
    const char *line; // `length` bytes, without the line's end
    size_t length;
    const char *folder; // the last line (with its line end) before `line` that names the pictures' folder; or NULL
    int part;
    float ms; // the duration of the work; 0 if the picture failed
};

struct journal_sum {
    struct journal_part *parts;
    int part_count;
    struct journal_entry *entries; // in the order of the journals
    size_t count, capacity;
    size_t written, failed;
    size_t *slots, slot_count; // a hash table; a slot contains an index in `entries` plus 1, or 0
    size_t doubles;            // number of pictures that are in two journals
    char *first_double;        // "x.png is in a.jsonl and in b.jsonl", allocated with malloc, or NULL
};

// Adds a journal. Fails with LAM_CANNOT_READ, LAM_LIMIT or LAM_BAD_ARGUMENT (the file is not a journal, or the options
// or the number of shards differ from the previous journals).
bool journal_sum_add(struct journal_sum *sum, const char *path, lam_error *error);

// Adds the journals in a folder: the journals of shards in alphabetical order or, if there are none, lambent.jsonl.
bool journal_sum_add_folder(struct journal_sum *sum, const char *folder, lam_error *error);

// Returns the record of an entry; the caller calls json_decref. Returns NULL if memory runs out.
json_t *journal_sum_record(const struct journal_sum *sum, size_t entry);

// Returns true if each shard has a completed journal and no picture is in two journals.
bool journal_sum_is_whole(const struct journal_sum *sum);

// Returns the exit code of the whole batch: an exit code of a run other than EXIT_SOME_FAILED, if there is one, else
// EXIT_SOME_FAILED if a run ended with it or if a part is missing.
int journal_sum_exit(const struct journal_sum *sum);
bool journal_sum_has_shard(const struct journal_sum *sum, int number);

void journal_sum_free(struct journal_sum *sum);

#endif
