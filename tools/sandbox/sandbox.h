// sandbox.h: drops the privileges that reading a stranger's file does not need: files outside a few folders (Landlock),
// other programs, the network, other processes (a seccomp filter). Dropped privileges cannot be regained. Linux on
// x86-64 and aarch64; elsewhere there is none.
#ifndef SANDBOX_H
#define SANDBOX_H

#include "writer.h"

enum {
    SANDBOX_READ = 1,  // a file, or all files of a folder and below it
    SANDBOX_WRITE = 2, // a pipe or a device; files are written by the writer (writer.h)
    // For the writer: a file that it may make, and replace if Lambent wrote it, or if anyone did.
    SANDBOX_MAKE = 4,
    SANDBOX_REPLACE = 8,
};

struct sandbox_path {
    char *path;
    int access; // SANDBOX_…
};

// The files that stay within reach.
struct sandbox_paths {
    struct sandbox_path *items;
    int count, capacity;
    bool failed;      // memory was out: sandbox_enter fails
    bool scene_files; // some of them may name files anywhere (sandbox_start.c)
    bool serves;      // the filter is SANDBOX_SERVES
    // The files that the writer writes, and the number of threads that it serves (0: one). NULL: SANDBOX_MAKE and SANDBOX_REPLACE.
    writer_rule *may_write;
    void *user;
    int writers;
};

// Adds a path, which is copied. Paths that do not exist when the sandbox is entered stay inaccessible.
void sandbox_add(struct sandbox_paths *paths, const char *path, int access);
void sandbox_paths_free(struct sandbox_paths *paths);

// The protections in force, or available on this machine.
struct sandbox_state {
    int landlock;          // the kernel's version of Landlock; 0: none
    bool filter;           // the seccomp filter
    bool reads_everything; // files may be read anywhere
    const char *reason;    // why one of them is missing; NULL: both are active
};

// Returns the protections that the kernel offers. Changes nothing.
struct sandbox_state sandbox_offered(void);

// Enters the sandbox: this thread and threads that it starts later, and the filter for all threads; call it before
// threads start. Protections that the kernel lacks are skipped, and `state` reports it. False with LAM_LIMIT: out of
// memory.
bool sandbox_enter(const struct sandbox_paths *paths, struct sandbox_state *state, lam_error *error);

// One line: "Landlock 7 and seccomp", "seccomp; Landlock is missing: …", "off". Returns `out`.
enum { SANDBOX_TEXT_SIZE = 160 };
const char *sandbox_text(const struct sandbox_state *state, char out[SANDBOX_TEXT_SIZE]);

// The system calls that the seccomp filter permits a process: bits.
enum sandbox_filter {
    SANDBOX_DRAWS = 0, // read and draw: no other process, no socket, and files are opened for reading alone
    SANDBOX_SERVES =
        1, // also: accept connections on sockets that listen already, watch files, make processes of its own program, which may
    // then install SANDBOX_DRAWS, and end them. No socket is made, bound or connected, no program is run.
    SANDBOX_OPENS_PIPES = 2, // existing files may be opened for writing, if Landlock permits it
    SANDBOX_NO_OPENAT2 =
        4, // whose flags no filter sees: for kernels whose Landlock does not keep files from being emptied
};

// sandbox_filter.c: installs a seccomp filter for all threads, in addition to filters in force. Returns false if the
// kernel refuses; errno says why.
bool sandbox_filter_install(unsigned kind);

#endif
