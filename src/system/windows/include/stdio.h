// stdio.h: extends mingw-w64's header with file names in UTF-8, streams that do not convert line endings, and memory
// streams.
#ifndef WINDOWS_STDIO_H
#define WINDOWS_STDIO_H

#include_next <stdio.h>

FILE *windows_fopen(const char *path, const char *mode);
int windows_rename(const char *from, const char *to); // replaces a file
int windows_fclose(FILE *file);
int windows_fflush(FILE *file);
#define fopen                                      windows_fopen
#define rename                                     windows_rename
#define renameat(from_folder, from, to_folder, to) windows_rename(from, to)
// fclose and fflush store the text of a memory stream.
#define fclose windows_fclose
#define fflush windows_fflush

FILE *open_memstream(char **text, size_t *size);
FILE *fmemopen(void *data, size_t size, const char *mode); // only for writing
ssize_t getline(char **line, size_t *capacity, FILE *file);

#endif
