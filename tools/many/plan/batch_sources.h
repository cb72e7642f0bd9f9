// batch_sources.h: collects the models of `batch` from operands, folders with their subfolders, and lists of names.
#ifndef BATCH_SOURCES_H
#define BATCH_SOURCES_H

#include "batch_plan.h"

// Adds the models of an operand: a file, a built-in shape, a folder, "@FILE" or "-" (names on standard input). Fails
// with LAM_CANNOT_READ or LAM_LIMIT.
bool batch_add_operand(struct batch_plan *plan, const char *operand, lam_error *error);

// Adds the models of a folder and its subfolders. Fails with LAM_CANNOT_READ (also if there are no models) or
// LAM_LIMIT.
bool batch_add_folder(struct batch_plan *plan, const char *folder, lam_error *error);

// Like batch_add_folder, but a folder without models is not an error.
bool batch_add_folder_if_any(struct batch_plan *plan, const char *folder, lam_error *error);

// Adds the models of a list with one name per line; "-" means standard input.
bool batch_add_list(struct batch_plan *plan, const char *path, lam_error *error);

#endif
