// sandbox.c: restricts file access to given paths with Landlock. https://docs.kernel.org/userspace-api/landlock.html
//
// The constants of the interface are defined here because the headers of a distribution may be older than the kernel.
#include "sandbox.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <lambent/path.h>
#include <lambent/scene.h>

#include "console.h"

void sandbox_add(struct sandbox_paths *paths, const char *path, int access)
{
    if (paths->count && paths->items[paths->count - 1].access == access &&
        strcmp(paths->items[paths->count - 1].path, path) == 0)
        return; // avoids duplicates, since models often share a folder
    if (paths->count == paths->capacity) {
        int capacity = paths->capacity ? 2 * paths->capacity : 32;
        struct sandbox_path *grown = realloc(paths->items, (size_t)capacity * sizeof *grown);
        paths->failed |= !grown;
        if (!grown)
            return;
        paths->items = grown;
        paths->capacity = capacity;
    }
    char *copy = strdup(path);
    paths->failed |= !copy;
    if (copy)
        paths->items[paths->count++] = (struct sandbox_path){copy, access};
}

void sandbox_paths_free(struct sandbox_paths *paths)
{
    for (int i = 0; i < paths->count; i++)
        free(paths->items[i].path);
    free(paths->items);
    *paths = (struct sandbox_paths){0};
}

const char *sandbox_text(const struct sandbox_state *state, char out[SANDBOX_TEXT_SIZE])
{
    size_t used = 0;
    if (state->landlock)
        used = (size_t)snprintf(out, SANDBOX_TEXT_SIZE, "Landlock %d%s", state->landlock,
                                state->filter ? " and seccomp" : "");
    else
        used = (size_t)snprintf(out, SANDBOX_TEXT_SIZE, "%s", state->filter ? "seccomp" : "off");
    if (state->reason && used < SANDBOX_TEXT_SIZE)
        used += (size_t)snprintf(out + used, SANDBOX_TEXT_SIZE - used, "; %s", state->reason);
    if (state->landlock && state->reads_everything && used < SANDBOX_TEXT_SIZE)
        snprintf(out + used, SANDBOX_TEXT_SIZE - used, "; a scene file may name files anywhere");
    return out;
}

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(memory_sanitizer) || __has_feature(thread_sanitizer)
#define SANITIZED
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SANITIZED
#endif

#if defined(__linux__) && (defined(__x86_64__) || defined(__aarch64__)) && !defined(SANITIZED)

#include <linux/capability.h>
#include <sys/prctl.h>
#include <sys/syscall.h>

enum {
    CREATE_RULESET = 444,
    ADD_RULE = 445,
    RESTRICT_SELF = 446,
    RULESET_VERSION = 1 << 0, // a flag of CREATE_RULESET
    PATH_BENEATH = 1,         // a type of rule
};

// Access rights to files, by the version that introduced them.
enum {
    EXECUTE = 1 << 0,
    WRITE_FILE = 1 << 1,
    READ_FILE = 1 << 2,
    READ_DIR = 1 << 3,
    REMOVE_FILE = 1 << 5,
    MAKE_DIR = 1 << 7,
    MAKE_REG = 1 << 8,
    VERSION_1 = (1 << 13) - 1,
    REFER = 1 << 13,    // since version 2
    TRUNCATE = 1 << 14, // since TRUNCATE_VERSION
    TRUNCATE_VERSION = 3,
    IOCTL_DEV = 1 << 15, // since version 5
    OF_FILES = EXECUTE | WRITE_FILE | READ_FILE | TRUNCATE | IOCTL_DEV,
};

struct ruleset {
    uint64_t files;
    uint64_t network; // since version 4: binding and connecting TCP sockets
    uint64_t scoped;  // since version 6: sockets without a path, and signals
};

struct path_beneath {
    uint64_t allowed;
    int32_t folder;
} __attribute__((packed));

static bool under_valgrind(void)
{
    const char *preloaded = getenv("LD_PRELOAD");
    return preloaded && strstr(preloaded, "vgpreload");
}

static int landlock_version(void)
{
    long version = syscall(CREATE_RULESET, NULL, 0, RULESET_VERSION);
    return version > 0 ? (int)version : 0;
}

struct sandbox_state sandbox_offered(void)
{
    struct sandbox_state state = {0};
    if (under_valgrind()) { // Valgrind's own system calls would be filtered too
        state.reason = "Valgrind runs the program";
        return state;
    }
    state.landlock = landlock_version();
    state.filter = prctl(PR_GET_SECCOMP, 0, 0, 0, 0) >= 0;
    if (!state.landlock || !state.filter)
        state.reason = state.landlock ? "the kernel does not support seccomp filters"
                       : state.filter ? "the kernel does not support Landlock"
                                      : "the kernel supports neither Landlock nor seccomp filters";
    return state;
}

static uint64_t rights_of(int version)
{
    return (uint64_t)VERSION_1 | (version >= 2 ? REFER : 0) | (version >= TRUNCATE_VERSION ? TRUNCATE : 0) |
           (version >= 5 ? IOCTL_DEV : 0);
}

// Returns whether the process has run out of file handles or memory. Such an error is unrelated to the sandbox and to
// the path.
static bool is_exhausted(int reason) { return reason == EMFILE || reason == ENFILE || reason == ENOMEM; }

// Adds a rule for a path: access for this process, or for the writer. Returns false if the kernel rejects the rule, or if
// file handles or memory run out. A path that does not exist or cannot be opened needs no rule.
static bool add_path(int rules, const struct sandbox_path *path, uint64_t handled, bool is_writer)
{
    struct stat about;
    bool writes = path->access & (SANDBOX_MAKE | SANDBOX_REPLACE),
         opens = path->access & (SANDBOX_READ | SANDBOX_WRITE);
    if (is_writer ? !writes : !opens)
        return true;
    int file = is_writer ? lam_path_held(path->path) : lam_path_open(path->path, O_PATH | O_CLOEXEC);
    if (file < 0)
        return is_writer || !is_exhausted(errno);
    uint64_t allowed =
        (path->access & SANDBOX_READ ? READ_FILE | READ_DIR : 0) | (path->access & SANDBOX_WRITE ? WRITE_FILE : 0);
    if (is_writer)
        allowed = READ_FILE | READ_DIR | WRITE_FILE | TRUNCATE | REFER | MAKE_REG | MAKE_DIR | REMOVE_FILE;
    bool ok = fstat(file, &about) == 0;
    if (ok && !S_ISDIR(about.st_mode))
        allowed &= OF_FILES;
    struct path_beneath rule = {.allowed = allowed & handled, .folder = file};
    ok = ok && syscall(ADD_RULE, rules, PATH_BENEATH, &rule, 0) == 0;
    if (!is_writer)
        lam_path_close(file);
    return ok;
}

// Returns false and sets errno on failure.
static bool enter_landlock(const struct sandbox_paths *paths, bool is_writer, int version)
{
    struct ruleset set = {.files = rights_of(version), .network = 3, .scoped = 3};
    size_t size = version >= 6 ? sizeof set : version >= 4 ? 2 * sizeof(uint64_t) : sizeof(uint64_t);
    int rules = (int)syscall(CREATE_RULESET, &set, size, 0);
    if (rules < 0)
        return false;
    bool ok = true;
    for (int i = 0; ok && i < paths->count; i++)
        ok = add_path(rules, &paths->items[i], set.files, is_writer);
    ok = ok && syscall(RESTRICT_SELF, rules, 0) == 0;
    int reason = errno;
    close(rules);
    errno = reason;
    return ok;
}

// Drops the privileges of root. Keeps only the privilege to access any file. For example, CAP_PERFMON would reveal the
// environment of other processes in spite of Landlock.
static void drop_capabilities(void)
{
    struct __user_cap_header_struct header = {_LINUX_CAPABILITY_VERSION_3, 0};
    struct __user_cap_data_struct data[_LINUX_CAPABILITY_U32S_3];
    if (syscall(SYS_capget, &header, data) != 0)
        return;
    const unsigned kept = 1U << CAP_DAC_OVERRIDE | 1U << CAP_DAC_READ_SEARCH;
    for (int i = 0; i < _LINUX_CAPABILITY_U32S_3; i++) {
        data[i].permitted &= i ? 0 : kept;
        data[i].effective &= i ? 0 : kept;
        data[i].inheritable = 0;
    }
    syscall(SYS_capset, &header, data); // dropping privileges is always permitted
}

bool sandbox_enter(const struct sandbox_paths *paths, struct sandbox_state *state, lam_error *error)
{
    *state = sandbox_offered();
    if (paths->failed)
        return complain(error, LAM_MACHINE, "out of memory");
    if (!state->landlock && !state->filter)
        return true;
    if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) { // otherwise an executed program could gain privileges
        *state = (struct sandbox_state){.reason = "the kernel does not let a process drop privileges"};
        return true;
    }
    state->starter = paths->imports ? lam_import_start() : -1;
    drop_capabilities();
    if (state->landlock && !enter_landlock(paths, false, state->landlock)) {
        if (is_exhausted(errno))
            return complain(error, LAM_MACHINE, "cannot start the sandbox: %s", strerror(errno));
        state->landlock = 0;
        state->reason = "the kernel refuses Landlock";
    }
    unsigned kind = paths->serves ? SANDBOX_SERVES : SANDBOX_DRAWS;
    for (int i = 0; i < paths->count; i++)
        kind |= paths->items[i].access & SANDBOX_WRITE ? SANDBOX_OPENS_PIPES : 0;
    kind |= state->landlock < TRUNCATE_VERSION ? SANDBOX_NO_OPENAT2 : 0;
    if (state->filter && !sandbox_filter_install(kind, state->starter)) {
        state->filter = false;
        state->reason = state->landlock ? "the kernel refuses the seccomp filter"
                                        : "the kernel refuses Landlock and the seccomp filter";
    }
    return true;
}

void sandbox_enter_writer(const struct sandbox_paths *paths)
{
    struct sandbox_state offered = sandbox_offered();
    if (offered.landlock && prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0)
        enter_landlock(paths, true, offered.landlock);
}

#else

void sandbox_enter_writer(const struct sandbox_paths *paths) { (void)paths; }

struct sandbox_state sandbox_offered(void)
{
#ifdef SANITIZED
    return (struct sandbox_state){.reason = "this build has sanitizers"};
#else
    return (struct sandbox_state){.reason = "this system has neither Landlock nor seccomp filters"};
#endif
}

bool sandbox_enter(const struct sandbox_paths *paths, struct sandbox_state *state, lam_error *error)
{
    *state = sandbox_offered();
    return !paths->failed || complain(error, LAM_MACHINE, "out of memory");
}

#endif
