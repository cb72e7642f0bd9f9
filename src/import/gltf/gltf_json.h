// gltf_json.h: reads the JSON text of a glTF file: its lists, and indices into them.
#ifndef GLTF_JSON_H
#define GLTF_JSON_H

#include "gltf.h"

// Parses the text into gltf->root and checks that the file's lists are lists of objects. Returns false if it is wrong.
bool gltf_json_parse(struct gltf *gltf, const uint8_t *text, size_t size);
void gltf_json_free(struct gltf *gltf);

// Returns a list of the file ("accessors"): its length, and one of its elements.
size_t gltf_list_size(const struct gltf *gltf, const char *list);
const json_t *gltf_list_item(const struct gltf *gltf, const char *list, int index);

// Returns the extension of an object, or NULL if it has none of this name.
const json_t *gltf_extension(const json_t *object, const char *name);

// A whole number in [min, max]. *out stays as it is where the key is missing. Returns false if it is wrong.
bool gltf_take_whole(struct gltf *gltf, const struct place *place, const json_t *object, const char *key, double min,
                     double max, size_t *out);
// An index into a list of the file; −1 where the key is missing.
bool gltf_take_index(struct gltf *gltf, const struct place *place, const json_t *object, const char *key,
                     const char *list, int *index);
// The same for a value without a key.
bool gltf_index_of(struct gltf *gltf, const struct place *place, const json_t *value, const char *list, int *index);

// `count` numbers. *out stays as it is where the key is missing.
bool gltf_take_numbers(struct gltf *gltf, const struct place *place, const json_t *object, const char *key,
                       size_t count, double *out);

// A factor of `count` numbers that the standard bounds: numbers outside of min…max are cut to it, and the file gets one warning. By more
// than rounding: numbers a little outside are cut without one.
bool gltf_take_factors(struct gltf *gltf, const struct place *place, const json_t *object, const char *key,
                       size_t count, double min, double max, double *out);

// The weights of morph targets; *out NULL: there are none.
bool gltf_take_weights(struct gltf *gltf, const struct place *place, const json_t *object, double **out, size_t *count);

// Returns the key's value, which is an object (or a list, only of objects); NULL if it is missing or, with *ok false,
// wrong.
const json_t *gltf_take_object(struct gltf *gltf, const struct place *place, const json_t *object, const char *key,
                               bool *ok);
const json_t *gltf_take_list(struct gltf *gltf, const struct place *place, const json_t *object, const char *key,
                             bool *ok);

// Returns the name of an object, copied into the scene. Returns NULL if it has none, or memory has run out (*ok becomes
// false).
const char *gltf_name(struct gltf *gltf, const json_t *object, bool *ok);

// Returns the element of a list (NULL: an empty one) that the caller names: by its name, else by its number from 0.
// Returns −1 with an error that lists them; `what` is the word for one.
int gltf_find_named(struct gltf *gltf, const json_t *list, const char *wanted, const char *what);

#endif
