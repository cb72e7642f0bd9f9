// writer_files.h: checks paths before files are replaced, and replaces sets of files together. The writer calls these
// functions. Without a sandbox, the program itself calls these functions.
#ifndef WRITER_FILES_H
#define WRITER_FILES_H

#include "writer.h"

// Checks whether the access right allows this path. The caller checks WRITER_NEW_OR_OURS. Fails with LAM_CANNOT_WRITE.
bool writer_files_check(const char *path, enum writer_right right, lam_error *error);

// Writes a file completely or not at all. Creates the folder if it is missing.
bool writer_files_save(const char *path, const lam_bytes *bytes, bool durable, lam_error *error);

// Writes the contents to a hidden file beside the path. Any thread may call this function. Fails with LAM_CANNOT_WRITE
// or LAM_LIMIT.
bool writer_files_stage(const char *path, const lam_bytes *bytes, lam_error *error);

// Gives the hidden files their final names, in the order in which they were staged. After a failure, removes the
// remaining hidden files.
bool writer_files_commit(lam_error *error);

// Removes the hidden files.
void writer_files_drop(void);

#endif
