// write.h: internal functions for writing scene files.
#ifndef WRITE_H
#define WRITE_H

#include "description.h"

struct scene_writer {
    const struct lam_scene *scene;
    const char *path;   // the path of the file, for messages
    const char *folder; // the absolute path of the file's folder
    bool ok;            // false if Jansson ran out of memory
    lam_error *error;
};

// These functions move `value` into an object or a list. A NULL value means that memory ran out, and clears w->ok.
void put(struct scene_writer *w, json_t *object, const char *key, json_t *value);
void append(struct scene_writer *w, json_t *list, json_t *value);

// Prints JSON for human readers: one line for each top-level key, and for each element of a list of objects. Every
// number is written with enough digits to read back the same bits.
bool scene_print(const json_t *root, lam_bytes *out, lam_error *error);

#endif
