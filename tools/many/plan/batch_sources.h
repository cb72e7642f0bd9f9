// batch_sources.h: where the models of `batch` come from: operands, folders with all below them, lists of names.
#ifndef BATCH_SOURCES_H
#define BATCH_SOURCES_H

#include "batch_plan.h"

// Adds the models of an operand: a file, a built-in shape, a folder, "@FILE" or "-" (names on standard input). Errors:
// LAM_CANNOT_READ, LAM_LIMIT.
bool batch_add_operand(struct batch_plan *plan, const char *operand, lam_error *error);

// Adds the models of a folder and of all below it. Errors: LAM_CANNOT_READ (also if it has none), LAM_LIMIT.
bool batch_add_folder(struct batch_plan *plan, const char *folder, lam_error *error);

// The same, and a folder without models is no error.
bool batch_add_folder_if_any(struct batch_plan *plan, const char *folder, lam_error *error);

// Adds the models of a list, one on each line; "-": standard input.
bool batch_add_list(struct batch_plan *plan, const char *path, lam_error *error);

#endif
