// field_tables.h: prints the tables of material and light fields for the documentation.
#ifndef FIELD_TABLES_H
#define FIELD_TABLES_H

#include <lambent/fields.h>

void field_tables_markdown(void);
void field_tables_man(void);
void field_tables_text(const lam_field *(*row)(int)); // for `help`: the rows of lam_light_field or lam_material_field

// Returns the default as text.
const char *field_standard(const lam_field *field, char text[80]);

#endif
