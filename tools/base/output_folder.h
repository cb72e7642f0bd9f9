// output_folder.h: the folder that a file is written to.
#ifndef OUTPUT_FOLDER_H
#define OUTPUT_FOLDER_H

#include <lambent/base.h>

// Returns the folder of a path, from malloc: "." if it names none. Returns NULL if memory runs out.
char *output_folder_of(const char *path);

// Makes the missing folder of a path that output_check has accepted, with those above it. Error: LAM_CANNOT_WRITE.
bool output_make_folder(const char *path, lam_error *error);

#endif
