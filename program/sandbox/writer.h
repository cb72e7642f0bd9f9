// writer.h: writes files in a small process outside the sandbox, because the process inside may not write files.
//
// The writer starts before an untrusted file is read. The writer accepts a path and the complete contents, checks that
// the run may write this path, and replaces the file atomically (lam_bytes_save). The process inside the sandbox
// therefore does not need write access to any folder, and even compromised code cannot change other files. The writer
// accepts no requests to run programs or to read files. The writer ends when the process that it serves ends.
#ifndef WRITER_H
#define WRITER_H

#include <lambent/image.h>
#include <sys/types.h>

// The writer's access rights to a file. The file must be regular or missing. The writer follows a link only if the user
// named the link when the program started (lam_path_hold).
enum writer_right {
    WRITER_NONE,
    WRITER_NEW,         // a new file
    WRITER_NEW_OR_OURS, // a new file, or a file that this run wrote or that is marked as Lambent's
    WRITER_ANY,         // replaces any existing file
    WRITER_REMOVES,     // the file may only be removed
};

// Returns the access right that the writer has for a path. Called in the writer, by one thread at a time.
typedef enum writer_right writer_rule(void *user, const char *path);

// Starts the writer with paths->may_write as its rule, and with one connection for each of paths->writers threads. With
// Landlock, it can access only the folders of `paths` in which it may write (sandbox.h). The writer writes files of at
// most `largest` bytes (0 means unlimited). Must be called before threads start. Fails with LAM_LIMIT.
struct sandbox_paths;
bool writer_start(const struct sandbox_paths *paths, uint64_t largest, lam_error *error);

// Returns whether this process or its parent has started the writer.
bool writer_is_there(void);

// Returns the process ID of the writer, or of this process if there is no writer. The ID is part of the names of
// unfinished files.
pid_t writer_process(void);

// Detaches this process from a writer that a child process continues to use. Returns the writer's process ID for
// waitpid(), or 0 if there was no writer.
pid_t writer_leave(void);

// Lets the writer end without waiting for it. Nothing can be written afterwards.
void writer_finish(void);

// Like writer_finish, but waits until the writer has ended.
void writer_end(void);

// Writes a file completely or not at all. Creates the folder if it is missing. Without a writer, this process writes
// the file. Any thread may call this function. `durable` is as in lam_save_params. Fails with LAM_CANNOT_WRITE or
// LAM_LIMIT.
bool writer_save(const char *path, const lam_bytes *bytes, bool durable, lam_error *error);

// A file of a set. Without a writer, `right` is checked; otherwise the writer's own rule decides. Only a file that the
// user named may be a pipe or a device.
struct writer_file {
    const char *path;
    lam_bytes bytes;
    enum writer_right right;
    bool is_named;
};

// Writes all of the files or none. When all files are complete, the writer gives the files their names, in the given
// order. The folders of the files must exist. After a signal, or if the disk is full, any existing files are unchanged.
// Fails with LAM_CANNOT_WRITE or LAM_LIMIT.
bool writer_save_all(const struct writer_file *files, int count, lam_error *error);

// Removes a file whose right is WRITER_REMOVES. Failure is not reported.
void writer_remove(const char *path);

// --- checks paths before files are replaced, and replaces sets of files together. The writer calls these
// functions. Without a sandbox, the program itself calls these functions.

// Checks that the path is missing or a regular file, and not a link that the user did not name. The caller checks
// WRITER_NEW_OR_OURS. Fails with LAM_CANNOT_WRITE.
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

// Removes a file. Failure is not reported.
void writer_files_remove(const char *path);

#endif
