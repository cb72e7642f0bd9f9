// file.c: reads whole files.
#include "file.h"

#include "fail.h"
#include "pages.h"

#include <lambent/path.h>

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

const char *path_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

const char *path_ending(const char *path)
{
    const char *name = path_name(path);
    const char *dot = strrchr(name, '.');
    return dot && dot != name ? dot + 1 : "";
}

const char *path_reason(int reason, char buffer[PATH_REASON_SIZE])
{
    return reason == EMLINK  ? "a link is in the way, and no link is followed here"
           : reason == EXDEV ? "a link that leads out of the folder that was given; name the file, or allow its folder "
                               "(lam_load_params.allowed_paths)"
                             : strerror_r(reason, buffer, PATH_REASON_SIZE);
}

#ifndef ESTALE
#define ESTALE (-1) // Windows
#endif

static bool fail_system(lam_error *error, lam_code code, const char *path, const char *action)
{
    int reason = errno;
    char buffer[PATH_REASON_SIZE];
    const char *text = path_reason(reason, buffer);
    bool by_machine = reason == EMFILE || reason == ENFILE || reason == ENOMEM || reason == EIO || reason == ESTALE;
    return fail(error, by_machine ? LAM_MACHINE : code, "%s: cannot %s: %s", path, action, text);
}

bool file_hold(size_t size, struct call_control *call, struct file_bytes *out, lam_error *error)
{
    *out = (struct file_bytes){0};
    size_t wanted = size + FILE_PADDING;
    if (call && !call_charge(call, wanted))
        return call_memory_error(call, wanted, error);
    out->data = pages_get(wanted, &out->held);
    if (!out->data) {
        if (call)
            call_refund(call, wanted);
        return fail_memory(error, wanted);
    }
    out->size = size;
    out->call = call;
    return true;
}

void file_release(struct file_bytes *bytes)
{
    if (bytes->held) {
        pages_free((void *)(uintptr_t)bytes->data, bytes->held);
        if (bytes->call)
            call_refund(bytes->call, bytes->size + FILE_PADDING);
    }
    *bytes = (struct file_bytes){0};
}

bool file_move_to_arena(struct file_bytes *bytes, struct arena *arena)
{
    if (!bytes->held)
        return true;
    size_t charged = bytes->call == arena->call ? bytes->size + FILE_PADDING : 0;
    if (!arena_adopt(arena, (void *)(uintptr_t)bytes->data, bytes->held, charged))
        return false;
    bytes->held = 0;
    return true;
}

bool file_copy(const void *bytes, size_t size, struct call_control *call, struct file_bytes *out, lam_error *error)
{
    if (!file_hold(size, call, out, error))
        return false;
    if (size)
        memcpy((void *)(uintptr_t)out->data, bytes, size);
    return true;
}

// The size of one chunk of a parallel read.
enum { CHUNK = THRESHOLD(1 << 20, 1 << 10) };
struct parallel_read {
    int file;
    size_t from; // offset in the file
    uint8_t *to;
    size_t size;
    struct call_control *call;
    int failed;     // an errno, or −1 if the file ended early
    size_t reached; // offset of the failure
};

// Reads the bytes [at, end). Returns 0 on success, an errno, or −1 if the file ends early. On failure, *reached is the
// offset of the first byte that was not read.
static int read_range(int file, uint8_t *to, size_t at, size_t end, size_t *reached)
{
    while (at < end) {
        ssize_t got = pread(file, to, end - at, (off_t)at);
        if (got > 0) {
            at += (size_t)got;
            to += got;
        } else if (got == 0 || errno != EINTR) {
            *reached = at;
            return got == 0 ? -1 : errno;
        }
    }
    return 0;
}

// Reports a failure of read_range. `size` is the size of the file before it was read.
static bool fail_range(int failed, size_t reached, size_t size, const char *path, lam_error *error)
{
    if (failed == -1)
        return fail(error, LAM_CANNOT_READ, "%s: became shorter while it was read: ended at byte %zu of %zu", path,
                    reached, size);
    errno = failed;
    return fail_system(error, LAM_CANNOT_READ, path, "read");
}

static void read_chunk(void *user, size_t index, int thread)
{
    (void)thread;
    struct parallel_read *read_state = user;
    size_t at = index * (size_t)CHUNK;
    size_t end = at + CHUNK < read_state->size ? at + CHUNK : read_state->size;
    if (!call_should_continue(read_state->call) || __atomic_load_n(&read_state->failed, __ATOMIC_RELAXED))
        return;
    size_t reached;
    pages_prepare(read_state->to + at, end - at);
    int none = 0, reason = read_range(read_state->file, read_state->to + at, read_state->from + at,
                                      read_state->from + end, &reached);
    // If several chunks fail, the first failure is reported.
    if (reason &&
        __atomic_compare_exchange_n(&read_state->failed, &none, reason, false, __ATOMIC_RELAXED, __ATOMIC_RELAXED))
        read_state->reached = reached;
}

bool file_read_rest(const struct file_parts *parts, const char *path, size_t from, struct pool *pool,
                    struct call_control *call, struct file_bytes *out, lam_error *error)
{
    size_t size = parts->size - from;
    if (!file_hold(size, call, out, error))
        return false;
    struct parallel_read read_state = {
        .file = parts->file, .from = from, .to = (uint8_t *)(uintptr_t)out->data, .size = size, .call = call};
    pool_run(pool, (size + CHUNK - 1) / CHUNK, read_chunk, &read_state);
    bool ok = true;
    if (!call_should_continue(call))
        ok = call_error(call, error);
    else if (read_state.failed)
        ok = fail_range(read_state.failed, read_state.reached, parts->size, path, error);
    if (!ok)
        file_release(out);
    return ok;
}

// Waits until a stream is readable or a writer opens the pipe. Returns false if the call must stop.
static bool wait_readable(int file, struct call_control *call)
{
    while (call_should_continue(call)) {
        struct pollfd ready = {.fd = file, .events = POLLIN};
        int count = poll(&ready, 1, 50);
        if (count > 0 || (count < 0 && errno != EINTR))
            return true; // the read will report the error
    }
    return false;
}

// Doubles the capacity and keeps the bytes that were read.
static bool grow(struct file_bytes *bytes, size_t used, struct call_control *call, lam_error *error)
{
    struct file_bytes larger;
    if (!file_hold(bytes->size * 2, call, &larger, error))
        return false;
    memcpy((void *)(uintptr_t)larger.data, bytes->data, used);
    file_release(bytes);
    *bytes = larger;
    return true;
}

// Reads a pipe, a terminal or a device to its end. Some devices, such as /dev/zero, never end.
static bool read_stream(int file, const char *path, bool fresh, struct call_control *call, struct file_bytes *out,
                        lam_error *error)
{
    size_t used = 0, max = pages_of_machine() / 4;
    bool ok = file_hold(CHUNK, call, out, error), ended = false;
    while (ok && !ended) {
        if (used == out->size)
            ok = used >= max
                     ? fail(error, LAM_LIMIT, "%s: does not end within %.1f GB, a quarter of this machine's memory",
                            path, (double)max / 1e9)
                     : grow(out, used, call, error);
        if (ok && !wait_readable(file, call))
            ok = call_error(call, error);
        if (!ok)
            break;
        ssize_t got = read(file, (uint8_t *)(uintptr_t)out->data + used, out->size - used);
        ended = got == 0;
        if (got > 0)
            used += (size_t)got;
        else if (got < 0 && errno != EINTR && errno != EAGAIN)
            ok = fail_system(error, LAM_CANNOT_READ, path, "read");
        ok = ok && call_check_file(call, path, used, error);
    }
    if (!ok) {
        file_release(out);
        return false;
    }
    // The unused bytes after the file's data stay zero. They do not count towards the memory limit of the call.
    if (call)
        call_refund(call, out->size - used);
    call_add_input(call, fresh ? used : 0);
    out->size = used;
    return true;
}

static const char *kind_of(mode_t mode)
{
    return S_ISDIR(mode)                    ? "is a directory, expected a file"
           : S_ISFIFO(mode)                 ? "is a pipe, expected a regular file"
           : S_ISSOCK(mode)                 ? "is a socket, expected a regular file"
           : S_ISCHR(mode) || S_ISBLK(mode) ? "is a device, expected a regular file"
                                            : NULL;
}

bool file_check_regular(const char *path, lam_error *error)
{
    struct stat about;
    if (lam_path_stat(path, &about) != 0)
        return fail_system(error, LAM_CANNOT_READ, path, "open");
    const char *kind = kind_of(about.st_mode);
    return !kind || fail(error, LAM_CANNOT_READ, "%s: %s", path, kind);
}

enum { OPEN_FLAGS = O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY };

// Opens a regular file; folders, pipes and devices are never opened. Returns −1 on error. If `shown` is NULL, the path
// comes from the user.
static int open_regular(const char *path, size_t folder, const char *shown, struct stat *about, lam_error *error)
{
    const char *advice = shown ? "" : " (- is standard input)";
    shown = shown ? shown : path;
    int file = -1;
    bool found = lam_path_stat(path, about) == 0;
    if (found && !kind_of(about->st_mode)) {
        file = folder ? path_open_in(path, folder, OPEN_FLAGS) : lam_path_open(path, OPEN_FLAGS);
        found = file >= 0 && fstat(file, about) == 0; // another file may have replaced the file since stat
    }
    if (!found)
        fail_system(error, LAM_CANNOT_READ, shown, "open");
    else if (kind_of(about->st_mode))
        fail(error, LAM_CANNOT_READ, "%s: %s%s", shown, kind_of(about->st_mode),
             S_ISFIFO(about->st_mode) ? advice : "");
    else
        return file;
    if (file >= 0)
        close(file);
    return -1;
}

bool file_check_pointer(const struct file_bytes *file, const char *name, lam_error *error)
{
    static const char magic[] = "version https://git-lfs.github.com/spec/";
    return file->size < sizeof magic || memcmp(file->data, magic, sizeof magic - 1) != 0 ||
           fail(error, LAM_CANNOT_READ, "%s: is a Git LFS pointer, not the file itself; 'git lfs pull' fetches it",
                name);
}

static bool count_input(const struct file_parts *parts, const char *path, bool fresh, struct call_control *call,
                        lam_error *error)
{
    call_add_input(call, fresh ? parts->size : 0);
    return call_check_file(call, path, parts->size, error);
}

bool file_read_named(const char *path, size_t folder, const char *shown, bool fresh, struct pool *pool,
                     struct call_control *call, struct file_bytes *out, lam_error *error)
{
    struct stat about;
    *out = (struct file_bytes){0};
    int file = open_regular(path, folder, shown, &about, error);
    if (file < 0)
        return false;
    shown = shown ? shown : path;
    // Files generated by the kernel (/proc) report a size of 0.
    const struct file_parts parts = {.file = file, .size = (size_t)about.st_size};
    bool ok = about.st_size > 0 ? count_input(&parts, shown, fresh, call, error) &&
                                      file_read_rest(&parts, shown, 0, pool, call, out, error)
                                : read_stream(file, shown, fresh, call, out, error);
    close(file);
    if (ok && !(ok = file_check_pointer(out, shown, error)))
        file_release(out);
    return ok;
}

bool file_read(const char *path, struct pool *pool, struct call_control *call, struct file_bytes *out, lam_error *error)
{
    *out = (struct file_bytes){0};
    if (strcmp(path, "-") == 0)
        return read_stream(STDIN_FILENO, "standard input", true, call, out, error);
    return file_read_named(path, 0, NULL, true, pool, call, out, error);
}

char *path_within(const char *path, const char *folder, bool *outside, size_t *folder_length)
{
    char *real = path_real(path), *top = real ? path_real(*folder ? folder : ".") : NULL;
    size_t length = top ? strlen(top) : 0;
    bool begins = top && strncmp(real, top, length) == 0, same = begins && !real[length];
    *outside = top ? !(begins && (same || real[length] == '/' || top[length - 1] == '/')) : errno == EXDEV;
    *folder_length = same ? 0 : length + (length > 0 && top[length - 1] != '/');
    if (top && !*outside) {
        free(top);
        return real;
    }
    int reason = errno;
    free(top);
    free(real);
    errno = reason;
    return NULL;
}

bool file_open_parts(const char *path, struct call_control *call, struct file_parts *out, struct file_bytes *head,
                     lam_error *error)
{
    struct stat about;
    if (strcmp(path, "-") == 0 || lam_path_stat(path, &about) != 0 || !S_ISREG(about.st_mode) ||
        about.st_size <= FILE_HEAD) {
        bool done = file_read(path, NULL, call, head, error);
        *out = (struct file_parts){.file = -1, .memory = head->data, .size = head->size};
        return done;
    }
    *out = (struct file_parts){.file = open_regular(path, 0, NULL, &about, error), .size = (size_t)about.st_size};
    return out->file >= 0 && count_input(out, path, true, call, error) && file_hold(FILE_HEAD, call, head, error) &&
           file_read_part(out, path, 0, (uint8_t *)(uintptr_t)head->data, FILE_HEAD, error);
}

bool file_read_part(const struct file_parts *parts, const char *path, size_t offset, void *to, size_t bytes,
                    lam_error *error)
{
    size_t reached;
    int failed = read_range(parts->file, to, offset, offset + bytes, &reached);
    return !failed || fail_range(failed, reached, parts->size, path, error);
}

void file_close_parts(struct file_parts *parts)
{
    if (parts->file >= 0)
        close(parts->file);
    parts->file = -1;
}
