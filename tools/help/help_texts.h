// help_texts.h: the subjects of the help, and texts generated from the tables.
#ifndef HELP_TEXTS_H
#define HELP_TEXTS_H

#include "help.h"

#include <lambent/fields.h>

// --- finds subjects, commands, options and keys whose texts contain given words.

// Prints the heading, and a row for each entry whose name or summary contains all of the words. If there is no such
// entry, also searches details and prose. Returns false and prints nothing if this search finds nothing either.
bool help_search(int count, char **words, const char *heading);

// --- defines the subjects of `lambent help TOPIC`. The man page and docs/command-line.md also contain these texts.

enum topic_table { TOPIC_NO_TABLE, TOPIC_LIGHT_FIELDS, TOPIC_MATERIAL_FIELDS, TOPIC_EXIT_CODES };

struct topic {
    const char *name; // the argument of `lambent help WORD`
    const char *title;
    uint64_t groups;        // bit g is set if the options of group g belong to the subject
    enum topic_table table; // shown below the options
    const char *text;       // paragraphs with `code` in back quotes, also printed in the man page; may be NULL
};

extern const struct topic topics[]; // in the order of the man page; ends with a NULL name

// --- prints the tables of material and light fields for the documentation.

void field_tables_markdown(void);
void field_tables_man(void);
void field_tables_text(const lam_field *(*row)(int)); // for `help`: the rows of lam_light_field or lam_material_field

// Returns the default as text.
const char *field_standard(const lam_field *field, char text[80]);

// --- prints texts generated from the tables on standard output.

void generate_man(void);      // manual.c
void generate_markdown(void); // manual.c
void generate_bash(void);     // complete.c
void generate_zsh(void);
void generate_fish(void);
void generate_scene_schema(void); // scene_schema.c

#endif
