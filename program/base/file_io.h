// file_io.h: reads and writes open files completely, and opens only regular files.
#ifndef FILE_IO_H
#define FILE_IO_H

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

#endif
