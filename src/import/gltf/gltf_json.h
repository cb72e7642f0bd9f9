// gltf_json.h: reads the JSON text of a glTF file: its lists, and indices into them.
#ifndef GLTF_JSON_H
#define GLTF_JSON_H

#include "gltf.h"

// Parses the text into gltf->root and checks that the file's top-level lists contain objects. Returns false on error.
bool gltf_json_parse(struct gltf *gltf, const uint8_t *text, size_t size);
void gltf_json_free(struct gltf *gltf);

// These functions return the length of a top-level list of the file ("accessors"), and one of its elements.
size_t gltf_list_size(const struct gltf *gltf, const char *list);
const json_t *gltf_list_item(const struct gltf *gltf, const char *list, int index);

// Returns an object's extension with this name, or NULL if the object does not use the extension.
const json_t *gltf_extension(const json_t *object, const char *name);

// Gets a whole number in [min, max]. *out is unchanged if the key is missing. Returns false if the value is wrong.
bool gltf_take_whole(struct gltf *gltf, const struct place *place, const json_t *object, const char *key, double min,
                     double max, size_t *out);
// Gets an index into a top-level list of the file. *index is −1 if the key is missing.
bool gltf_take_index(struct gltf *gltf, const struct place *place, const json_t *object, const char *key,
                     const char *list, int *index);
// Like gltf_take_index, but for a given value instead of the value of a key.
bool gltf_index_of(struct gltf *gltf, const struct place *place, const json_t *value, const char *list, int *index);

// Gets `count` numbers. *out is unchanged if the key is missing.
bool gltf_take_numbers(struct gltf *gltf, const struct place *place, const json_t *object, const char *key,
                       size_t count, double *out);

// Gets a factor of `count` numbers whose range the standard limits. Numbers outside [min, max] are clamped. If clamping
// changes a number by more than a rounding error, a single warning is added for the whole file.
bool gltf_take_factors(struct gltf *gltf, const struct place *place, const json_t *object, const char *key,
                       size_t count, double min, double max, double *out);

// Gets the weights of morph targets; *out is NULL if there are none.
bool gltf_take_weights(struct gltf *gltf, const struct place *place, const json_t *object, double **out, size_t *count);

// These functions return the value of a key, which must be an object, or a list of objects. They return NULL if the key
// is missing. If the value is wrong, they also set *ok to false.
const json_t *gltf_take_object(struct gltf *gltf, const struct place *place, const json_t *object, const char *key,
                               bool *ok);
const json_t *gltf_take_list(struct gltf *gltf, const struct place *place, const json_t *object, const char *key,
                             bool *ok);

// Returns the name of an object, copied into the scene. Returns NULL if the object has no name, or if memory runs out
// (*ok becomes false).
const char *gltf_name(struct gltf *gltf, const json_t *object, bool *ok);

// Returns the index of the element of `list` (NULL means empty) whose name is `wanted`. If no name matches, `wanted`
// may be an index. Returns −1 if there is no such element; the error then lists the elements, and calls an element
// `what`.
int gltf_find_named(struct gltf *gltf, const json_t *list, const char *wanted, const char *what);

#endif
