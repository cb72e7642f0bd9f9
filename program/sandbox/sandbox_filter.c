// sandbox_filter.c: installs the seccomp filter, which allows the system calls needed for reading and drawing. All
// other calls fail with ENOSYS. The process therefore cannot run programs, create sockets or mount file systems. The
// process cannot create, trace, signal, measure or slow down other processes. It cannot create, rename or remove files
// or change file permissions. https://docs.kernel.org/userspace-api/seccomp_filter.html

// The filter returns ENOSYS instead of killing the process, so that C libraries that try a newer call fall back to an
// older call. The filter is written by hand because it consists of two lists, and libseccomp would be another library
// to load at every start.
#include "sandbox.h"

#if defined(__linux__) && (defined(__x86_64__) || defined(__aarch64__))

#include <errno.h>
#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sched.h>
#include <signal.h>
#include <stddef.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#if defined(__x86_64__)
#define ARCHITECTURE AUDIT_ARCH_X86_64
#else
#define ARCHITECTURE AUDIT_ARCH_AARCH64
#endif

// The calls that are allowed with any arguments. A call is omitted if this machine's headers do not define its number.
static const unsigned allowed[] = {
    // Files. Landlock decides which files can be opened, and the conditions below decide how.
    SYS_read,
    SYS_write,
    SYS_pread64,
    SYS_pwrite64,
    SYS_readv,
    SYS_writev,
    SYS_close,
    SYS_fstat,
    SYS_newfstatat,
    SYS_lseek,
    SYS_dup,
    SYS_dup3,
    SYS_getdents64,
    SYS_faccessat,
    SYS_readlinkat,
    SYS_fadvise64,
    SYS_statfs,
    SYS_fstatfs,
    SYS_getcwd,
    SYS_pipe2,
    SYS_ppoll,
    SYS_pselect6,
    // Memory, threads and time.
    SYS_brk,
    SYS_mmap,
    SYS_munmap,
    SYS_mremap,
    SYS_mprotect,
    SYS_madvise,
    SYS_futex,
    SYS_set_robust_list,
    SYS_set_tid_address,
    SYS_sched_yield,
    SYS_membarrier,
    SYS_nanosleep,
    SYS_gettimeofday,
    SYS_getrusage,
    SYS_times,
    SYS_sysinfo,
    SYS_uname,
    SYS_getrandom,
    SYS_restart_syscall,
    SYS_exit,
    SYS_exit_group,
    SYS_getcpu,
    // The process itself.
    SYS_rt_sigaction,
    SYS_rt_sigprocmask,
    SYS_rt_sigreturn,
    SYS_rt_sigpending,
    SYS_rt_sigtimedwait,
    SYS_rt_sigsuspend,
    SYS_sigaltstack,
    SYS_getpid,
    SYS_gettid,
    SYS_getppid,
    SYS_getuid,
    SYS_geteuid,
    SYS_getgid,
    SYS_getegid,
    SYS_wait4, // to wait for the writer
#ifdef SYS_statx
    SYS_statx,
#endif
#ifdef SYS_faccessat2
    SYS_faccessat2,
#endif
#ifdef SYS_close_range
    SYS_close_range,
#endif
#ifdef SYS_rseq
    SYS_rseq,
#endif
#ifdef SYS_futex_waitv
    SYS_futex_waitv,
#endif
#ifdef SYS_getrlimit
    SYS_getrlimit,
#endif
#if defined(__x86_64__) // x86-64 still supports the older calls
    SYS_stat,
    SYS_lstat,
    SYS_access,
    SYS_readlink,
    SYS_dup2,
    SYS_pipe,
    SYS_poll,
    SYS_select,
    SYS_getpgrp,
    SYS_time,
    SYS_arch_prctl,
    SYS_getdents,
#endif
};

// The additional calls of SANDBOX_SERVES.
static const unsigned served[] = {
    SYS_accept4,    SYS_recvfrom,  SYS_sendfile,    SYS_shutdown,          SYS_setsockopt,
    SYS_getsockopt, SYS_epoll_ctl, SYS_epoll_pwait, SYS_inotify_add_watch,
#if defined(__x86_64__)
    SYS_epoll_wait,
#endif
};

// Allows a call if one half (32 bits) of an argument, masked with `mask`, equals one of the values. All consecutive
// rows of a call must match.
struct condition {
    unsigned call;
    int half; // LOW(argument) or HIGH(argument)
    unsigned mask;
    int error; // the error returned if no value matches
    int count;
    unsigned values[6];
};

#define LOW(argument)  (2 * (argument))
#define HIGH(argument) (2 * (argument) + 1)
#define ALL            0xFFFFFFFFU
#define SELF           0xFFFFFFFEU // in the list of values, SELF means this process's ID
#define STARTER        0xFFFFFFFDU // the socket of lam_import_start

// The C library uses PR_SET_VMA to name its memory.
#ifndef PR_SET_VMA
#define PR_SET_VMA 0x53564d41
#endif
#ifndef MSG_FASTOPEN
#define MSG_FASTOPEN 0x20000000
#endif

enum {
    // Flags of open() that create or truncate a file. Before version 3, Landlock does not prevent O_TRUNC from emptying
    // a file that is opened for reading.
    MAKES = O_CREAT | O_TRUNC | (O_TMPFILE & ~O_DIRECTORY) | O_ASYNC,
    WRITES = O_WRONLY | O_RDWR,
    NAMESPACES =
        CLONE_NEWNS | CLONE_NEWCGROUP | CLONE_NEWUTS | CLONE_NEWIPC | CLONE_NEWUSER | CLONE_NEWPID | CLONE_NEWNET,
};

#define NEGATIVE 0x80000000U // a negative clock ID belongs to another process

static const struct condition conditions[] = {
    // Queries of the terminal's size and state. TIOCSTI, which types into the terminal, and FIOASYNC and SIOCSPGRP,
    // which redirect signals, stay forbidden.
    {SYS_ioctl, LOW(1), ALL, ENOSYS, 4, {TCGETS, TIOCGWINSZ, TIOCGPGRP, FIONREAD}},
    {SYS_prctl, LOW(0), ALL, ENOSYS, 5, {PR_SET_NAME, PR_GET_NAME, PR_SET_VMA, PR_GET_DUMPABLE, PR_GET_SECCOMP}},
    // Commands that redirect signals (F_SETOWN, O_ASYNC with F_SETFL), lock files or turn off appending to a journal
    // stay forbidden.
    {SYS_fcntl, LOW(1), ALL, ENOSYS, 5, {F_DUPFD, F_DUPFD_CLOEXEC, F_GETFD, F_SETFD, F_GETFL}},
    {SYS_sched_getaffinity, LOW(0), ALL, EPERM, 2, {0, SELF}},
    {SYS_clock_gettime, LOW(0), NEGATIVE, EPERM, 1, {0}},
    {SYS_clock_getres, LOW(0), NEGATIVE, EPERM, 1, {0}},
    {SYS_clock_nanosleep, LOW(0), NEGATIVE, EPERM, 1, {0}},
    // abort() and the exit after Ctrl-C send signals to the process itself.
    {SYS_kill, LOW(0), ALL, EPERM, 1, {SELF}},
    {SYS_tgkill, LOW(0), ALL, EPERM, 1, {SELF}},
    // The process may read its limits but not set them: the pointer to new limits must be NULL.
    {SYS_prlimit64, LOW(0), ALL, EPERM, 2, {0, SELF}},
    {SYS_prlimit64, LOW(2), ALL, EPERM, 1, {0}},
    {SYS_prlimit64, HIGH(2), ALL, EPERM, 1, {0}},
    // Asks the process that starts lambent-import for another one, and hands it two pipes (lam_import_start).
    {SYS_sendmsg, LOW(0), ALL, ENOSYS, 1, {STARTER}},
    {SYS_sendmsg, LOW(2), MSG_FASTOPEN, EPERM, 1, {0}},
    // New threads.
    {SYS_clone, LOW(0), CLONE_THREAD | NAMESPACES, EPERM, 1, {CLONE_THREAD}},
};

// The conditions of SANDBOX_SERVES, tested before the others. These conditions allow signals that end child processes
// or cancel their work (since version 6, Landlock blocks signals to other processes). The conditions also allow a new
// process to restrict itself and to install the stricter filter. MSG_FASTOPEN is excluded because it would connect a
// socket.
static const struct condition served_conditions[] = {
    {SYS_kill, LOW(1), ALL, ENOSYS, 2, {SIGKILL, SIGUSR1}},
    {SYS_kill, LOW(0), NEGATIVE, EPERM, 1, {0}},
    {SYS_prctl,
     LOW(0),
     ALL,
     ENOSYS,
     6,
     {PR_SET_NAME, PR_GET_NAME, PR_SET_VMA, PR_GET_DUMPABLE, PR_GET_SECCOMP, PR_SET_PDEATHSIG}},
    {SYS_seccomp, LOW(0), ALL, ENOSYS, 1, {SECCOMP_SET_MODE_FILTER}},
    {SYS_sendto, LOW(3), MSG_FASTOPEN, EPERM, 1, {0}},
    {SYS_sendmsg, LOW(2), MSG_FASTOPEN, EPERM, 1, {0}},
    {SYS_clone, LOW(0), NAMESPACES, EPERM, 1, {0}},
};

static const struct condition reads_alone[] = {
    {SYS_openat, LOW(2), MAKES | WRITES, EACCES, 1, {O_RDONLY}},
#if defined(__x86_64__)
    {SYS_open, LOW(1), MAKES | WRITES, EACCES, 1, {O_RDONLY}},
#endif
};
static const struct condition makes_nothing[] = {
    {SYS_openat, LOW(2), MAKES, EACCES, 1, {0}},
#if defined(__x86_64__)
    {SYS_open, LOW(1), MAKES, EACCES, 1, {0}},
#endif
};

#define COUNT(list) (sizeof(list) / sizeof *(list))

enum { MAX = 1024 };

struct program {
    struct sock_filter code[MAX];
    unsigned short length;
    unsigned self, starter;
};

static void put(struct program *p, unsigned short code, unsigned k, unsigned char jump_true, unsigned char jump_false)
{
    if (p->length < MAX)
        p->code[p->length] = (struct sock_filter){code, jump_true, jump_false, k};
    p->length++;
}

static void load(struct program *p, size_t offset) { put(p, BPF_LD | BPF_W | BPF_ABS, (unsigned)offset, 0, 0); }
static void end(struct program *p, unsigned result) { put(p, BPF_RET | BPF_K, result, 0, 0); }

// Adds a jump: the next `length` instructions run only for this call. The last of these instructions must return the
// result of the filter. The number of the call must already be loaded.
static void if_call(struct program *p, unsigned call, size_t length)
{
    put(p, BPF_JMP | BPF_JEQ | BPF_K, call, 0, (unsigned char)length);
}

static void allow(struct program *p, const unsigned *calls, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if_call(p, calls[i], 1);
        end(p, SECCOMP_RET_ALLOW);
    }
}

enum { BESIDE_VALUES = 3 }; // the number of instructions of a condition, not counting the comparisons

static void check(struct program *p, const struct condition *c)
{
    load(p, offsetof(struct seccomp_data, args) + 4 * (size_t)c->half); // both architectures are little-endian
    put(p, BPF_ALU | BPF_AND | BPF_K, c->mask, 0, 0);
    for (int k = 0; k < c->count; k++) {
        unsigned value = c->values[k] == SELF ? p->self : c->values[k] == STARTER ? p->starter : c->values[k];
        put(p, BPF_JMP | BPF_JEQ | BPF_K, value, (unsigned char)(c->count - k), 0);
    }
    end(p, SECCOMP_RET_ERRNO | (unsigned)c->error);
}

// Adds a list of conditions. If several lists contain a call, only the first of these lists applies.
static void allow_some(struct program *p, const struct condition *list, size_t count)
{
    for (size_t i = 0, next; i < count; i = next) {
        size_t length = 1;
        for (next = i; next < count && list[next].call == list[i].call; next++)
            length += (size_t)list[next].count + BESIDE_VALUES;
        if_call(p, list[i].call, length);
        for (; i < next; i++)
            check(p, &list[i]);
        end(p, SECCOMP_RET_ALLOW);
    }
}

static void build(struct program *p, unsigned kind)
{
    load(p, offsetof(struct seccomp_data, arch));
    put(p, BPF_JMP | BPF_JEQ | BPF_K, ARCHITECTURE, 1, 0); // the calls of 32-bit programs have other numbers
    end(p, SECCOMP_RET_KILL_PROCESS);
    load(p, offsetof(struct seccomp_data, nr));
    allow(p, allowed, COUNT(allowed));
    if (kind & SANDBOX_NO_FILES)
        kind |= SANDBOX_NO_OPENAT2;
    else if (kind & SANDBOX_OPENS_PIPES)
        allow_some(p, makes_nothing, COUNT(makes_nothing));
    else
        allow_some(p, reads_alone, COUNT(reads_alone));
#ifdef SYS_openat2
    if (!(kind & SANDBOX_NO_OPENAT2)) {
        static const unsigned openat2[] = {SYS_openat2};
        allow(p, openat2, 1);
    }
#endif
    if (kind & SANDBOX_SERVES) {
        allow(p, served, COUNT(served));
        allow_some(p, served_conditions, COUNT(served_conditions));
    }
    allow_some(p, conditions, COUNT(conditions));
    end(p, SECCOMP_RET_ERRNO | ENOSYS);
}

bool sandbox_filter_install(unsigned kind, int starter)
{
    struct program p;
    p.length = 0;
    p.self = (unsigned)getpid();
    p.starter = starter > 0 ? (unsigned)starter : UINT32_MAX;
    build(&p, kind);
    if (p.length > MAX) {
        errno = E2BIG;
        return false;
    }
    const struct sock_fprog filter = {p.length, p.code};
    // Applies the filter to all threads. If a thread cannot be synchronised, the call returns the thread's ID.
    return syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER, SECCOMP_FILTER_FLAG_TSYNC, &filter) == 0;
}

#else

bool sandbox_filter_install(unsigned kind, int starter)
{
    (void)kind, (void)starter;
    return false;
}

#endif
