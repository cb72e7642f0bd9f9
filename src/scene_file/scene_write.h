// scene_write.h: the inside of writing scene files.
#ifndef SCENE_WRITE_H
#define SCENE_WRITE_H

#include "scene_reader.h"

struct scene_writer {
    const struct lam_scene *scene;
    const char *path;   // of the file, for messages
    const char *folder; // that it will lie in, absolute
    bool ok;            // false: Jansson ran out of memory somewhere
    lam_error *error;
};

// Give `value` (NULL: it could not be made) away to an object or a list.
void put(struct scene_writer *w, json_t *object, const char *key, json_t *value);
void append(struct scene_writer *w, json_t *list, json_t *value);

// JSON as people read it: a line for each key at the top, and for each element of a list of objects. Every number has
// as many digits as it needs to be read back as the same bits.
bool scene_print(const json_t *root, lam_bytes *out, lam_error *error);

#endif
