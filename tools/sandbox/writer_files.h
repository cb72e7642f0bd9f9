// writer_files.h: checks of paths that the writer may replace, and sets of files of which all or none are replaced. These functions run in the process that
// writes: the writer, or without a sandbox the program itself.
#ifndef WRITER_FILES_H
#define WRITER_FILES_H

#include "writer.h"

// Checks a path against its right: WRITER_IMPLIED, a file that is not regular, and a file that exists already. The caller checks WRITER_NEW_OR_OURS.
// Error: LAM_CANNOT_WRITE.
bool writer_files_check(const char *path, enum writer_right right, lam_error *error);

// Writes a file whole or not at all, and makes its missing folder.
bool writer_files_save(const char *path, const lam_bytes *bytes, bool durable, lam_error *error);

// Writes the contents to a hidden file beside the path. Any thread. Errors: LAM_CANNOT_WRITE, LAM_LIMIT.
bool writer_files_stage(const char *path, const lam_bytes *bytes, lam_error *error);

// Renames the hidden files to their names, in the order in which they were staged. After a failure the others are removed.
bool writer_files_commit(lam_error *error);

// Removes the hidden files.
void writer_files_drop(void);

#endif
