// writer.h: a small process outside of the sandbox that writes the files of the process inside, which may write none.
//
// It starts before a stranger's file is read, and does one thing: it takes a path and the whole contents, checks that the run may write
// this path, and replaces the file atomically (lam_bytes_save). So the process inside needs no right to any folder: whatever runs there
// can change no other file. It cannot be told to run or read anything, and ends with the process that it writes for.
#ifndef WRITER_H
#define WRITER_H

#include <sys/types.h>

#include <lambent/image.h>

enum writer_right {
    WRITER_NONE,
    WRITER_NEW_OR_OURS, // a new file, one that this run wrote, or one that says that Lambent wrote it
    WRITER_ANY,         // an existing file is replaced
    WRITER_REMOVES,     // the file may be removed, and not written
};

// The right to a path. It is called in the writer, by one thread at a time.
typedef enum writer_right writer_rule(void *user, const char *path);

// Starts the writer, which can serve `count` threads at once. Call it before threads start. Error: LAM_LIMIT.
bool writer_start(writer_rule *rule, void *user, int count, lam_error *error);

// Returns whether this process, or the one that made it, has started one.
bool writer_is_there(void);

// Its number, which is part of the names of its unfinished files; this process's if there is no writer.
pid_t writer_process(void);

// Leaves the writer to a process that was made since, and returns its number, for waitpid(). 0: there was none.
pid_t writer_leave(void);

// Nothing more will be written: lets the writer end, while this process does other things.
void writer_finish(void);

// The same, and waits for its end, so that nothing of this run is left.
void writer_end(void);

// Writes a file whole or not at all, and makes its missing folder; without a writer, this process does it. Any thread. `durable` as in
// lam_save_params. Errors: LAM_CANNOT_WRITE, LAM_LIMIT.
bool writer_save(const char *path, const lam_bytes *bytes, bool durable, lam_error *error);

// Removes a file that the rule has as WRITER_REMOVES, or a new one of WRITER_ANY that this run wrote. It is no error if that fails.
void writer_remove(const char *path);

#endif
