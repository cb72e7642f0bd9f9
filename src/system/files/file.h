// file.h: reads and writes whole files.
#ifndef FILE_H
#define FILE_H

#include "arena.h"
#include "call_control.h"
#include "pool.h"

// Files are read into memory in parallel chunks. Files are not mapped into memory, because SIGBUS would kill the
// process if another program shortened a mapped file. Mapping would not be faster: page faults take at least as long as
// copying from the page cache into huge pages. At least FILE_PADDING zero bytes follow the last byte, so a parser may
// read past the end.
enum { FILE_PADDING = 64 };

struct file_bytes {
    const uint8_t *data;
    size_t size;
    size_t held;               // size of the address range at `data`; 0 if `data` is not owned
    struct call_control *call; // the bytes count towards this call's memory limit until they are released; may be NULL
};

// Reads a regular file, or standard input if the path is "-". Folders, pipes, devices and sockets are never opened,
// because opening one can block forever or have side effects. `pool` and `call` may be NULL. Errors: LAM_CANNOT_READ
// (the file does not exist, is not a regular file, cannot be read, or was shortened while it was read), LAM_LIMIT,
// LAM_CANCELLED.
bool file_read(const char *path, struct pool *pool, struct call_control *call, struct file_bytes *out,
               lam_error *error);

// Fails with LAM_CANNOT_READ if the bytes are a pointer of Git LFS, which a repository contains instead of a large file.
bool file_check_pointer(const struct file_bytes *file, const char *name, lam_error *error);

// Reads a regular file that another file refers to. Messages use `shown` as the path (NULL means the path itself), and
// "-" is an ordinary name. `folder` is the length of the folder at the start of the path, as path_within returns it.
// The rest of the path is opened below that folder without following links, even links created since path_within was
// called. If `folder` is 0, the path is opened without this restriction. `fresh` means that the call has not read this
// file before, so its bytes count as input (call_add_input).
bool file_read_named(const char *path, size_t folder, const char *shown, bool fresh, struct pool *pool,
                     struct call_control *call, struct file_bytes *out, lam_error *error);

// Checks that a path is a regular file, before another library opens it. Fails with LAM_CANNOT_READ if the path is not
// a regular file.
bool file_check_regular(const char *path, lam_error *error);

// Resolves every link and ".." in a path (path_real). If the resolved path is the folder or is inside the folder, returns
// this path, allocated with malloc. A `folder` of "" is the current folder. Returns NULL if the path is outside
// (*outside is then true) or cannot be resolved (errno is then set). Sets *length to the length of the folder at the start of the
// result, including the final '/', or to 0 if the path is the folder itself.
char *path_within(const char *path, const char *folder, bool *outside, size_t *length);

// These functions belong to <lambent/path.h>. path_real returns the absolute path without links, allocated with malloc,
// or NULL and sets errno. path_open_in opens a path whose first `folder` bytes, including the '/', name a folder. It opens
// the rest below that folder without following links.
char *path_real(const char *path);
int path_open_in(const char *path, size_t folder, int flags);

// Returns the reason of a failed call on a path as text. The text is static or in `buffer`.
enum { PATH_REASON_SIZE = 128 };
const char *path_reason(int reason, char buffer[PATH_REASON_SIZE]);

// A size at which a reader changes its method: `usual`, or `small` in the fuzzing build (-Dfuzz=true), so that its inputs
// of a few kilobytes reach both methods.
#ifdef SMALL_THRESHOLDS
#define THRESHOLD(usual, small) (small)
#else
#define THRESHOLD(usual, small) (usual)
#endif

// A source of bytes: an open file, or memory that file_bytes own. Any thread may read sections of a file.
struct file_parts {
    int file;              // −1 if the bytes are in memory
    const uint8_t *memory; // all bytes, if they are in memory
    size_t size;
};
// Opens a file as file_read does, and reads its first FILE_HEAD bytes to *head. If the file is small, or its size is
// unknown in advance (standard input), *head contains all of its bytes, and is the memory of *out. After an error too,
// the caller closes *out and releases *head.
enum { FILE_HEAD = THRESHOLD(64 << 10, 2 << 10) };
bool file_open_parts(const char *path, struct call_control *call, struct file_parts *out, struct file_bytes *head,
                     lam_error *error);
// Reads `bytes` bytes at an offset; these bytes must be inside the file. Fails with LAM_CANNOT_READ; the message names
// `path`.
bool file_read_part(const struct file_parts *parts, const char *path, size_t offset, void *to, size_t bytes,
                    lam_error *error);
// Reads all bytes of the file from offset `from` on.
bool file_read_rest(const struct file_parts *parts, const char *path, size_t from, struct pool *pool,
                    struct call_control *call, struct file_bytes *out, lam_error *error);
void file_close_parts(struct file_parts *parts);

// These functions allocate padded memory in the form that file_read returns. file_hold fills the memory with zeros;
// file_copy fills the memory with a copy of `bytes`.
bool file_hold(size_t size, struct call_control *call, struct file_bytes *out, lam_error *error);
bool file_copy(const void *bytes, size_t size, struct call_control *call, struct file_bytes *out, lam_error *error);

void file_release(struct file_bytes *bytes);

// Moves the ownership of the bytes to the arena, without copying them. Returns false if memory runs out; `bytes` then
// still owns the memory.
bool file_move_to_arena(struct file_bytes *bytes, struct arena *arena);

// Writes a file completely or not at all, and leaves no temporary file, even if a signal ends the process during the
// call (file_write.c). The function keeps the read and write permissions of an existing file, but removes the execute
// permission. A symbolic link is kept, and its target is replaced. A path that is not a regular file (/dev/stdout, a
// pipe) is written directly. With `durable`, the file and its folder are on disk when the call returns. After a power
// failure, either the old file or the new file is then complete. `call` may be NULL. Errors: LAM_CANNOT_WRITE, and the
// errors of `call`: LAM_CANCELLED, LAM_LIMIT.
bool file_write(const char *path, const void *data, size_t size, bool durable, struct call_control *call,
                lam_error *error);

// Writes a file with the given method, for tests. FILE_NAMED is the method for file systems without unnamed files.
enum file_way { FILE_UNNAMED = 0, FILE_NAMED = 1, FILE_DURABLE = 2 }; // FILE_DURABLE is a flag
bool file_write_by(unsigned way, const char *path, const void *data, size_t size, struct call_control *call,
                   lam_error *error);

// These functions return the last component of a path, and the path's extension after the last '.' ("" if there is
// none).
const char *path_name(const char *path);
const char *path_ending(const char *path);

#endif
