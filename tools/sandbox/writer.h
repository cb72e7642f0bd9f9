// writer.h: writes files in a small process outside the sandbox, because the process inside may not write any.
//
// The writer starts before an untrusted file is read. It accepts a path and the complete contents, checks that the run
// may write this path, and replaces the file atomically (lam_bytes_save). The process inside the sandbox therefore
// needs write access to no folder, and even compromised code can change no other file. The writer has no requests to
// run programs or read files, and it ends with the process that it serves.
#ifndef WRITER_H
#define WRITER_H

#include <sys/types.h>

#include <lambent/image.h>

enum writer_right {
    WRITER_NONE,
    WRITER_NEW_OR_OURS, // a new file, or one written by this run or marked as Lambent's
    WRITER_ANY,         // replaces any existing file
    WRITER_REMOVES,     // the file may only be removed
};

// Returns the right to a path. Called in the writer, by one thread at a time.
typedef enum writer_right writer_rule(void *user, const char *path);

// Starts the writer with `count` connections for as many threads. Must be called before threads start. Fails with
// LAM_LIMIT.
bool writer_start(writer_rule *rule, void *user, int count, lam_error *error);

// Returns whether this process or its parent has started the writer.
bool writer_is_there(void);

// Returns the writer's process ID, which is part of the names of its unfinished files, or this process's ID if there is
// no writer.
pid_t writer_process(void);

// Detaches this process from a writer that a child process continues to use. Returns its process ID for waitpid(), or 0
// if there was none.
pid_t writer_leave(void);

// Lets the writer end without waiting for it. Nothing can be written afterwards.
void writer_finish(void);

// Does the same and waits until the writer has ended.
void writer_end(void);

// Writes a file completely or not at all, and creates its missing folder. Without a writer, this process writes the
// file. Any thread may call it. `durable` is as in lam_save_params. Fails with LAM_CANNOT_WRITE or LAM_LIMIT.
bool writer_save(const char *path, const lam_bytes *bytes, bool durable, lam_error *error);

// Removes a file for which the rule returns WRITER_REMOVES, or a new file that this run wrote under WRITER_ANY. A
// failure is ignored.
void writer_remove(const char *path);

#endif
