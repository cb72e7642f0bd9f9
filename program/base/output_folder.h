// output_folder.h: creates the folder to which a file is written.
#ifndef OUTPUT_FOLDER_H
#define OUTPUT_FOLDER_H

#include <lambent/base.h>

// Returns the folder of a path, or "." if the path contains no folder. The result is allocated with malloc. Returns
// NULL if memory runs out.
char *output_folder_of(const char *path);

// Creates the folder of a path and the folder's parents, if they are missing. output_check must have accepted the path.
// Fails with LAM_CANNOT_WRITE.
bool output_make_folder(const char *path, lam_error *error);

#endif
