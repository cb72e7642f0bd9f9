// file_io.h: reads and writes open files completely, and opens only regular files.
#ifndef FILE_IO_H
#define FILE_IO_H

#include <lambent/base.h>

#include <limits.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// Writes all bytes. Returns false and sets errno on failure.
bool write_all(int file, const void *bytes, size_t size);

// Reads exactly `size` bytes. Returns false and sets errno on failure; errno is 0 if the file contains fewer bytes.
bool read_all(int file, void *bytes, size_t size);

// Opens a regular file for reading, and sets *size to its size. Rejects folders, pipes and devices, since opening them
// can block forever or have side effects. Returns −1 and sets errno on failure; errno is 0 if the file is not a regular
// file.
int open_regular(const char *path, uint64_t *size);

// Reads the rest of a file, but at most `size` bytes. Returns false and sets errno on failure.
bool read_up_to(int file, char *bytes, size_t size, size_t *length);

// Closes all files but the standard streams, the handles of folders, and the files in `kept`.
void close_files(const int *kept, int count);

// Returns whether `path` is a folder or a link to a folder.
bool path_is_folder(const char *path);

// --- creates the folder to which a file is written.

// Returns the folder of a path, or "." if the path contains no folder. The result is allocated with malloc. Returns
// NULL if memory runs out.
char *output_folder_of(const char *path);

// Creates the folder of a path and the folder's parents, if they are missing. output_check must have accepted the path.
// Fails with LAM_CANNOT_WRITE.
bool output_make_folder(const char *path, lam_error *error);

// --- finds the folder of this program, for files that are installed beside it.

// Writes the folder that contains the program's file, with a slash at its end. Links to the program are followed.
// Writes "" and returns false if the folder is unknown.
bool own_folder(char folder[PATH_MAX]);

#endif
