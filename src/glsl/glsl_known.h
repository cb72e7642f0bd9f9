// glsl_known.h: what a shader's choices decide in its texts.
#ifndef GLSL_KNOWN_H
#define GLSL_KNOWN_H

#include "glsl_rows.h"
#include "specialize.h"

// A table while it is made. Zero is empty; names and texts that are put there are not copied.
enum { KNOWN_MAX = 192, KNOWN_MADE_MAX = 32 };
struct known_table {
    struct known rows[KNOWN_MAX + 1];
    struct text made[KNOWN_MADE_MAX]; // texts of known_made and known_number
    struct known *of_made[KNOWN_MADE_MAX];
    int count, made_count;
};

void known_flag(struct known_table *table, const char *name, bool holds);
void known_text(struct known_table *table, const char *name, const char *text);
void known_number(struct known_table *table, const char *name, int number);
// A text that the caller writes.
struct text *known_made(struct known_table *table, const char *name);
// Appends a source with what the table decides, and frees the table.
void known_specialize(struct text *text, const char *source, struct known_table *table);
// Returns the rows, valid until known_free; NULL: out of memory.
const struct known *known_finish(struct known_table *table);
void known_free(struct known_table *table);

// The facts of a stage, under their names, and the words of its inputs and outputs, as all styles have them.
void known_facts(struct known_table *table, const struct glsl_facts *stage);
// Conditions of the equations.
void known_conditions(struct known_table *table, const struct glsl_facts *stage);

#endif
