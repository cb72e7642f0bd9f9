// glsl_constants.h: the conditions and names in a shader's sources that the choices determine.
#ifndef GLSL_CONSTANTS_H
#define GLSL_CONSTANTS_H

#include "glsl_declarations.h"
#include "glsl_text.h"

// A table under construction. A zeroed table is empty. Names and strings are not copied.
enum { CONSTANT_MAX = 192, CONSTANT_MADE_MAX = 32 };
struct constant_table {
    struct constant rows[CONSTANT_MAX + 1];
    struct text made[CONSTANT_MADE_MAX]; // strings from constant_made and constant_number
    struct constant *of_made[CONSTANT_MADE_MAX];
    int count, made_count;
};

void constant_flag(struct constant_table *table, const char *name, bool holds);
void constant_text(struct constant_table *table, const char *name, const char *text);
void constant_number(struct constant_table *table, const char *name, int number);
// Adds a row with an empty replacement for a name. Returns the replacement; the caller appends the text to it.
struct text *constant_made(struct constant_table *table, const char *name);
// Specialises a source with the table, appends the result, and frees the table.
void constant_specialize(struct text *text, const char *source, struct constant_table *table);
// Returns the rows, valid until constant_free, or NULL if memory runs out.
const struct constant *constant_finish(struct constant_table *table);
void constant_free(struct constant_table *table);

// Adds the properties of a stage, by name, and the keywords that declare its inputs and outputs. All styles use these rows.
void constant_stage(struct constant_table *table, const struct glsl_stage *stage);
// Adds the conditions in the equations.
void constant_conditions(struct constant_table *table, const struct glsl_stage *stage);

#endif
