// gltf_json.h: reads the JSON text of a glTF file: its lists, and indices into them.
#ifndef GLTF_JSON_H
#define GLTF_JSON_H

#include "gltf.h"

#include <lambent/fields.h>

// Parses the text into gltf->root. Returns false on error.
bool gltf_json_parse(struct gltf *gltf, const uint8_t *text, size_t size);
void gltf_json_free(struct gltf *gltf);

// These functions return the length of a top-level list of the file ("accessors"), and one of its elements.
size_t gltf_list_size(const struct gltf *gltf, const char *list);
const json_t *gltf_list_item(const struct gltf *gltf, const char *list, int index);

// Returns an object's extension with this name, or NULL if the object does not use the extension.
const json_t *gltf_extension(const json_t *object, const char *name);

// --- needed values: a wrong value is an error, but null is noted and treated as missing

// Gets a whole number in [min, max]. *out is unchanged if the key is missing. Returns false if the value is wrong.
bool gltf_take_whole(struct gltf *gltf, const struct place *place, const json_t *object, const char *key, double min,
                     double max, size_t *out);
// Gets an index into a top-level list of the file. *index is −1 if the key is missing.
bool gltf_take_index(struct gltf *gltf, const struct place *place, const json_t *object, const char *key,
                     const char *list, int *index);
// Like gltf_take_index, but for a given value instead of the value of a key.
bool gltf_index_of(struct gltf *gltf, const struct place *place, const json_t *value, const char *list, int *index);

// --- optional values: a wrong value is noted and then treated as missing
//
// A file is refused only if geometry that it needs is missing or out of bounds. All else that is wrong is noted: the
// model is drawn without it, and the load ends with one warning for each kind of problem (gltf_warn_problems).

// Notes a problem that the sentence describes. Problems whose places differ only in indices are of one kind.
void gltf_note(struct gltf *gltf, const struct place *place, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
// Notes "found KIND, expected …; drawn without it".
void gltf_note_wrong(struct gltf *gltf, const struct place *place, const json_t *found, const char *expected);
// Notes the error that a function has just reported, so that the load continues without what the function reads.
// Returns false if the error is not about the file's contents: memory, limits, or a cancelled call.
bool gltf_forgive(struct gltf *gltf);
// Like gltf_forgive, but for geometry, which only a lenient load draws without.
static inline bool gltf_skip(struct gltf *gltf) { return gltf->source->params->lenient && gltf_forgive(gltf); }
// Adds the warnings to the scene. If the scene contains no objects, returns false and reports the first problem or, if
// there are no problems, `otherwise`.
bool gltf_warn_problems(struct gltf *gltf, const char *otherwise);

// Returns an index into a top-level list of the file, or −1.
int gltf_take_link(struct gltf *gltf, const struct place *place, const json_t *object, const char *key,
                   const char *list);
// Gets `count` numbers.
void gltf_take_numbers(struct gltf *gltf, const struct place *place, const json_t *object, const char *key,
                       size_t count, double *out);
// Gets a factor of `count` numbers. Numbers outside [min, max] are clamped, and noted if the difference exceeds a
// rounding error. Limits of 1e6 and more are not limits of the standard.
void gltf_take_factors(struct gltf *gltf, const struct place *place, const json_t *object, const char *key,
                       size_t count, double min, double max, double *out);
// Gets a field of lam_material or lam_light in `to`, if the object has the field's key. With `encoded`, colours are sRGB.
// Angles are not read.
void gltf_take_field(struct gltf *gltf, const struct place *place, const json_t *object, const lam_field *field,
                     bool encoded, void *to);
void gltf_take_word(struct gltf *gltf, const struct place *place, const json_t *object, const char *key,
                    const struct json_choice *words, int *out);
bool gltf_take_flag(struct gltf *gltf, const struct place *place, const json_t *object, const char *key, bool missing);

// Gets the weights of morph targets; *out is NULL if there are none. Returns false if memory runs out.
bool gltf_take_weights(struct gltf *gltf, const struct place *place, const json_t *object, double **out, size_t *count);

// These functions return the value of a key, which must be an object, or a list of objects, or NULL. An element of the
// list that is not an object acts as an empty object.
const json_t *gltf_take_object(struct gltf *gltf, const struct place *place, const json_t *object, const char *key);
const json_t *gltf_take_list(struct gltf *gltf, const struct place *place, const json_t *object, const char *key);

// Returns the name of an object, copied into the scene. Returns NULL if the object has no name, or if memory runs out
// (*ok becomes false).
const char *gltf_name(struct gltf *gltf, const json_t *object, bool *ok);

// Returns the index of the element of `list` (NULL means empty) whose name is `wanted`. If no name matches, `wanted`
// may be an index. Returns −1 if there is no such element; the error then lists the elements, and calls an element
// `what`.
int gltf_find_named(struct gltf *gltf, const json_t *list, const char *wanted, const char *what);

#endif
