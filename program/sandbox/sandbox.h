// sandbox.h: drops the privileges that reading untrusted files does not need. Landlock removes access to files outside
// a few folders. A seccomp filter removes access to other programs, the network and other processes. Dropped privileges
// cannot be regained. The sandbox works on Linux on x86-64 and aarch64; other systems have no sandbox.
#ifndef SANDBOX_H
#define SANDBOX_H

#include "writer.h"

enum {
    SANDBOX_READ = 1,  // a file, or all files in a folder and its subfolders
    SANDBOX_WRITE = 2, // a pipe or a device (for regular files, see writer.h)
    // SANDBOX_MAKE lets the writer create a file, and replace a file that Lambent wrote. SANDBOX_REPLACE lets the
    // writer replace any file. The writer can access only the held folders (lam_path_held) of these paths. With
    // may_write, a path may also be a folder.
    SANDBOX_MAKE = 4,
    SANDBOX_REPLACE = 8,
};

struct sandbox_path {
    char *path;
    int access; // SANDBOX_…
};

// The paths that stay accessible.
struct sandbox_paths {
    struct sandbox_path *items;
    int count, capacity;
    bool failed;      // memory ran out; sandbox_enter then fails
    bool scene_files; // a scene file may name files anywhere (sandbox_start.c)
    bool imports;     // a model may need lambent-import (lam_import_start)
    bool serves;      // selects the filter SANDBOX_SERVES
    // Decides which files the writer may write; if NULL, SANDBOX_MAKE and SANDBOX_REPLACE decide. `writers` is the
    // number of threads that the writer serves (0 means 1).
    writer_rule *may_write;
    void *user;
    int writers;
};

// Adds a copy of a path. A path that does not exist when the sandbox is entered stays inaccessible.
void sandbox_add(struct sandbox_paths *paths, const char *path, int access);
void sandbox_paths_free(struct sandbox_paths *paths);

// The protections that are active, or available on this machine.
struct sandbox_state {
    int landlock;          // the kernel's Landlock version; 0 without Landlock
    bool filter;           // the seccomp filter
    bool reads_everything; // all files are readable
    const char *reason;    // why a protection is missing; NULL if both are active
    int starter;           // lam_import_start; not positive if models need no other program
};

// Returns the protections that the kernel offers. Changes nothing.
struct sandbox_state sandbox_offered(void);

// Enters the sandbox. Must be called before this thread starts others, because Landlock applies only to this thread and
// to threads that this thread starts later. The filter applies to all threads. Skips protections that the kernel lacks
// and reports them in `state`. Fails with LAM_LIMIT if memory runs out.
bool sandbox_enter(const struct sandbox_paths *paths, struct sandbox_state *state, lam_error *error);

// Lets this process, the writer, access only the folders in which it may write, if the kernel supports Landlock.
void sandbox_enter_writer(const struct sandbox_paths *paths);

// Writes one line such as "Landlock 7 and seccomp", "seccomp; Landlock is missing: …" or "off". Returns `out`.
enum { SANDBOX_TEXT_SIZE = 160 };
const char *sandbox_text(const struct sandbox_state *state, char out[SANDBOX_TEXT_SIZE]);

// Selects the system calls that the seccomp filter permits, as bits.
enum sandbox_filter {
    SANDBOX_DRAWS = 0, // reading and drawing: no processes, no sockets, files only read
    // Also accepts connections on listening sockets, watches files, and starts and ends processes of its own program.
    // These processes may then install SANDBOX_DRAWS. The process still cannot run programs, and cannot create, bind or
    // connect sockets.
    SANDBOX_SERVES = 1,
    SANDBOX_OPENS_PIPES = 2, // also opens existing files for writing, if Landlock permits it
    // Forbids openat2. Needed if Landlock does not prevent truncation, because a filter cannot check openat2's flags.
    SANDBOX_NO_OPENAT2 = 4,
    SANDBOX_NO_FILES = 8, // opens nothing
};

// sandbox_filter.c: installs a seccomp filter for all threads in addition to the active filters. `starter` is the
// result of lam_import_start, to which messages may be sent. Returns false and sets errno if the kernel rejects the
// filter.
bool sandbox_filter_install(unsigned kind, int starter);

#endif
