// journal_sum.h: combines several journals of one batch, to find the batch's finished, failed and missing pictures.
#ifndef JOURNAL_SUM_H
#define JOURNAL_SUM_H

#include <jansson.h>

#include "batch_shard.h"

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
