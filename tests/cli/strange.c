// strange.c: a library that turns the machine into a strange one; test_machine.py preloads it into the program. STRANGE lists what is strange,
// separated by blanks: "NAME=ERRNO" (each call fails), "NAME=ERRNO/N" (each Nth call fails), "NAME=ERRNO@N" (only the Nth call fails), or
// "clock=SECONDS" (at each look, the wall clock has jumped forward or backward by this time).
#define _GNU_SOURCE
#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <linux/openat2.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/types.h>
#include <time.h>
#include <unistd.h>

#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

enum { NAMES = 64 };
static int calls[NAMES];

// Whether this call fails, with errno.
static int fails(const char *name)
{
    const char *text = getenv("STRANGE");
    size_t length = strlen(name);
    for (int i = 0; text && *text && i < NAMES; i++) {
        text += strspn(text, " ");
        if (strncmp(text, name, length) == 0 && text[length] == '=') {
            char *end;
            int reason = (int)strtol(text + length + 1, &end, 10),
                count = __atomic_add_fetch(&calls[i], 1, __ATOMIC_SEQ_CST);
            int number = *end == '/' || *end == '@' ? atoi(end + 1) : 1;
            if (*end == '@' ? count == number : count % number == 0) {
                errno = reason;
                return 1;
            }
        }
        text += strcspn(text, " ");
    }
    return 0;
}

// --- the clock

int clock_gettime(clockid_t clock, struct timespec *now)
{
    static int looks;
    const char *jump = getenv("STRANGE") ? strstr(getenv("STRANGE"), "clock=") : NULL;
    if (syscall(SYS_clock_gettime, clock, now) != 0)
        return -1;
    if (jump && (clock == CLOCK_REALTIME || clock == CLOCK_REALTIME_COARSE))
        now->tv_sec += __atomic_add_fetch(&looks, 1, __ATOMIC_SEQ_CST) % 2 ? atol(jump + 6) : -atol(jump + 6);
    return 0;
}

time_t time(time_t *at)
{
    struct timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    if (at)
        *at = now.tv_sec;
    return now.tv_sec;
}

// --- files

static int open_fails(int flags)
{
    int makes = flags & O_CREAT;
    return (flags & O_TMPFILE) == O_TMPFILE  ? fails("tmpfile")
           : makes                           ? fails("create")
           : (flags & O_ACCMODE) != O_RDONLY ? fails("open-write")
           : flags & O_PATH                  ? fails("open-path")
                                             : fails("open");
}

#define OPENS(name, before, given)                                                                                     \
    int name before                                                                                                    \
    {                                                                                                                  \
        va_list rest;                                                                                                  \
        va_start(rest, flags);                                                                                         \
        mode_t mode = va_arg(rest, mode_t);                                                                            \
        va_end(rest);                                                                                                  \
        return open_fails(flags) ? -1 : REAL(name) given;                                                              \
    }
OPENS(open, (const char *path, int flags, ...), (path, flags, mode))
OPENS(open64, (const char *path, int flags, ...), (path, flags, mode))
OPENS(openat, (int folder, const char *path, int flags, ...), (folder, path, flags, mode))
OPENS(openat64, (int folder, const char *path, int flags, ...), (folder, path, flags, mode))

#define FAILS(name, parameters, given)                                                                                 \
    int name parameters { return fails(#name) ? -1 : REAL(name) given; }
FAILS(linkat, (int a, const char *from, int b, const char *to, int flags), (a, from, b, to, flags))
FAILS(renameat, (int a, const char *from, int b, const char *to), (a, from, b, to))
FAILS(rename, (const char *from, const char *to), (from, to))
FAILS(unlinkat, (int folder, const char *name, int flags), (folder, name, flags))
FAILS(mkdirat, (int folder, const char *name, mode_t mode), (folder, name, mode))
FAILS(fsync, (int file), (file))
FAILS(flock, (int file, int how), (file, how))
FAILS(fchmod, (int file, mode_t mode), (file, mode))
FAILS(ftruncate64, (int file, off64_t size), (file, size))
FAILS(fstat64, (int file, struct stat64 *about), (file, about))
FAILS(fstatat64, (int folder, const char *path, struct stat64 *about, int flags), (folder, path, about, flags))
FAILS(faccessat, (int folder, const char *path, int mode, int flags), (folder, path, mode, flags))

int close(int file)
{
    int failed = fails("close"), reason = errno;
    if (REAL(close)(file) != 0)
        return -1;
    errno = failed ? reason : errno;
    return failed ? -1 : 0;
}

ssize_t read(int file, void *to, size_t size) { return fails("read") ? -1 : REAL(read)(file, to, size); }
ssize_t pread64(int file, void *to, size_t size, off64_t at)
{
    return fails("pread") ? -1 : REAL(pread64)(file, to, size, at);
}
ssize_t write(int file, const void *from, size_t size) { return fails("write") ? -1 : REAL(write)(file, from, size); }
ssize_t pwrite64(int file, const void *from, size_t size, off64_t at)
{
    return fails("pwrite") ? -1 : REAL(pwrite64)(file, from, size, at);
}

struct dirent64 *readdir64(DIR *folder) { return fails("readdir") ? NULL : REAL(readdir64)(folder); }

// --- memory

void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *block, size_t size);
void *malloc(size_t size) { return fails("malloc") ? NULL : __libc_malloc(size); }
void *calloc(size_t count, size_t size) { return fails("malloc") ? NULL : __libc_calloc(count, size); }
void *realloc(void *block, size_t size) { return fails("malloc") ? NULL : __libc_realloc(block, size); }

// --- kernels

int prctl(int option, ...)
{
    va_list rest;
    va_start(rest, option);
    long a = va_arg(rest, long), b = va_arg(rest, long), c = va_arg(rest, long), d = va_arg(rest, long);
    va_end(rest);
    const char *name = option == PR_GET_SECCOMP || option == PR_SET_SECCOMP ? "seccomp"
                       : option == PR_SET_NO_NEW_PRIVS                      ? "privileges"
                                                                            : "prctl";
    return fails(name) ? -1 : (int)syscall(SYS_prctl, option, a, b, c, d);
}

long syscall(long number, ...)
{
    static long (*real)(long, ...);
    va_list rest;
    va_start(rest, number);
    long a[6];
    for (int i = 0; i < 6; i++)
        a[i] = va_arg(rest, long);
    va_end(rest);
    if (!real)
        real = REAL(syscall);
    if (number == SYS_openat2) {
        const struct open_how *how = (const struct open_how *)a[2];
        if (fails("openat2") || open_fails((int)how->flags))
            return -1;
    }
    if (number >= 444 && number <= 446 &&
        (fails("landlock") || (number == 444 && !(a[2] & 1) && fails("landlock-create")) ||
         (number == 446 && fails("landlock-enter"))))
        return -1;
    if (number == SYS_seccomp && fails("seccomp"))
        return -1;
    return real(number, a[0], a[1], a[2], a[3], a[4], a[5]);
}
