// journal_sum.h: several journals of one batch together: finished, failed and missing pictures.
#ifndef JOURNAL_SUM_H
#define JOURNAL_SUM_H

#include <jansson.h>

#include "batch_shard.h"

// One journal, as its last run left it.
struct journal_part {
    char *path, *build, *options; // from malloc
    struct batch_shard shard;     // all zero: the batch has none
    size_t pictures;              // that the run was to have
    size_t written, failed;       // of its lines
    bool ended;                   // the run came to its end
    char *text;                   // the file
    size_t size;
};

// The latest line of a picture.
struct journal_entry {
    uint64_t output;  // hash of its path; 0: free
    const char *line; // `length` bytes, without the line's end
    size_t length;
    const char
        *folder; // the last line before it that names the folder of the pictures; ends with a line end; NULL: none
    int part;
    float ms; // from the beginning of the work to its end; 0: it failed
};

struct journal_sum {
    struct journal_part *parts;
    int part_count;
    struct journal_entry *entries; // in the order of the journals
    size_t count, capacity;
    size_t written, failed;
    size_t *slots, slot_count; // a hash table of places in `entries`, plus 1
    size_t doubles;            // pictures that two journals have
    char *first_double;        // "x.png is in a.jsonl and in b.jsonl", from malloc; NULL: none
};

// Adds a journal. Error: LAM_CANNOT_READ, LAM_BAD_ARGUMENT (not a journal; of other options or of another number of shards than
// those before), LAM_LIMIT.
bool journal_sum_add(struct journal_sum *sum, const char *path, lam_error *error);

// Adds the journals in a folder: the shards', in alphabetical order; if there are none, lambent.jsonl.
bool journal_sum_add_folder(struct journal_sum *sum, const char *folder, lam_error *error);

// Returns the record of an entry; the caller calls json_decref. Returns NULL if memory runs out.
json_t *journal_sum_record(const struct journal_sum *sum, size_t entry);

// Returns true if there is a journal for each shard, all have ended, and no picture is in two of them.
bool journal_sum_is_whole(const struct journal_sum *sum);
bool journal_sum_has_shard(const struct journal_sum *sum, int number);

void journal_sum_free(struct journal_sum *sum);

#endif
