// contract_reader.h: shared by the readers of a contract's file.
#ifndef CONTRACT_READER_H
#define CONTRACT_READER_H

#include "contract.h"
#include "json_reader.h"

struct contract_reader {
    struct json_reader json;
    struct arena *arena;
    struct contract *contract;
    struct contract_name *names; // contract->names while it is read
    int name_count;
};

extern const struct json_choice contract_spaces[]; // eye, world, object

// Whether the comment of an object, if it has one, is a text or a list of texts. Nothing reads it.
bool contract_check_comment(struct contract_reader *r, const struct place *place, const json_t *object);

// LAM_LIMIT. Returns false.
bool contract_no_memory(const struct contract_reader *r);

// Whether a text can be a name in GLSL; `plain`: one without members and lists.
bool contract_check_name(const struct contract_reader *r, const struct place *place, const char *name, bool plain);

// A list of texts, joined by `between`; NULL if it is empty. Each is checked if it must be a name.
bool contract_read_list(struct contract_reader *r, const struct place *place, const json_t *list, const char *between,
                        bool of_names, bool plain, const char **out);

// The parts of the file.
bool contract_read_names(struct contract_reader *r, const json_t *root);    // attributes, uniforms, built_ins
bool contract_read_varyings(struct contract_reader *r, const json_t *root); // after `space`
bool contract_read_defaults(struct contract_reader *r, const json_t *root); // undeclared
bool contract_read_constants(struct contract_reader *r, const json_t *root);
bool contract_read_prefix(struct contract_reader *r, const json_t *root);
bool contract_read_physical(struct contract_reader *r, const json_t *root);
bool contract_read_maps(struct contract_reader *r, const json_t *root);

#endif
