// contract_reader.h: declares the functions that read the sections of a contract's file.
#ifndef CONTRACT_READER_H
#define CONTRACT_READER_H

#include "contract.h"
#include "json_reader.h"

struct contract_reader {
    struct json_reader json;
    struct arena *arena;
    struct contract *contract;
    struct contract_name *names; // the names read so far, which become contract->names
    int name_count;
};

extern const struct json_choice contract_spaces[]; // eye, world, object

// Returns true if the object contains no comment, or if the comment is a string or an array of strings. The content of
// the comment is ignored.
bool contract_check_comment(struct contract_reader *r, const struct place *place, const json_t *object);

// Reports LAM_LIMIT. Returns false.
bool contract_no_memory(const struct contract_reader *r);

// Returns whether a text can be a name in GLSL. With `plain`, members and arrays are not allowed.
bool contract_check_name(const struct contract_reader *r, const struct place *place, const char *name, bool plain);

// Reads an array of strings and joins them with `between`; returns NULL if the array is empty. With `of_names`, each
// string must be a valid name.
bool contract_read_list(struct contract_reader *r, const struct place *place, const json_t *list, const char *between,
                        bool of_names, bool plain, const char **out);

// Read the sections of the file.
bool contract_read_names(struct contract_reader *r, const json_t *root);    // attributes, uniforms, built_ins
bool contract_read_varyings(struct contract_reader *r, const json_t *root); // after `space`
bool contract_read_defaults(struct contract_reader *r, const json_t *root); // undeclared
bool contract_read_constants(struct contract_reader *r, const json_t *root);
bool contract_read_prefix(struct contract_reader *r, const json_t *root);
bool contract_read_physical(struct contract_reader *r, const json_t *root);
bool contract_read_maps(struct contract_reader *r, const json_t *root);

#endif
