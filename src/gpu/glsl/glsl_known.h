// glsl_known.h: the conditions and names in a shader's sources that the choices determine.
#ifndef GLSL_KNOWN_H
#define GLSL_KNOWN_H

#include "glsl_rows.h"
#include "specialize.h"

// A table under construction. A zeroed table is empty. Names and strings are not copied.
enum { KNOWN_MAX = 192, KNOWN_MADE_MAX = 32 };
struct known_table {
    struct known rows[KNOWN_MAX + 1];
    struct text made[KNOWN_MADE_MAX]; // strings from known_made and known_number
    struct known *of_made[KNOWN_MADE_MAX];
    int count, made_count;
};

void known_flag(struct known_table *table, const char *name, bool holds);
void known_text(struct known_table *table, const char *name, const char *text);
void known_number(struct known_table *table, const char *name, int number);
// Adds a row with an empty replacement for a name. Returns the replacement; the caller appends the text to it.
struct text *known_made(struct known_table *table, const char *name);
// Specialises a source with the table, appends the result, and frees the table.
void known_specialize(struct text *text, const char *source, struct known_table *table);
// Returns the rows, valid until known_free, or NULL if memory runs out.
const struct known *known_finish(struct known_table *table);
void known_free(struct known_table *table);

// Adds the facts of a stage, by name, and the keywords that declare its inputs and outputs. All styles use these rows.
void known_facts(struct known_table *table, const struct glsl_facts *stage);
// Adds the conditions in the equations.
void known_conditions(struct known_table *table, const struct glsl_facts *stage);

#endif
