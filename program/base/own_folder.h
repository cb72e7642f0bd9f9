// own_folder.h: finds the folder of this program, for files that are installed beside it.
#ifndef OWN_FOLDER_H
#define OWN_FOLDER_H

#include <limits.h>
#include <stdbool.h>

// Writes the folder that contains the program's file, with a slash at its end. Links to the program are followed.
// Writes "" and returns false if the folder is unknown.
bool own_folder(char folder[PATH_MAX]);

#endif
