// sandbox_filter.c: the seccomp filter: the system calls that reading, drawing and writing need. Others do not exist for
// this process (ENOSYS): no program is run, no socket made, no other process traced, signalled or made, no file system
// mounted, no kernel module loaded. https://docs.kernel.org/userspace-api/seccomp_filter.html
//
// ENOSYS and not an end of the process: C libraries that try a newer call go on with the older one. Written by hand: it is
// a list and five tests of arguments, and libseccomp would be one more library to open at every start.
#include "sandbox.h"

#if defined(__linux__) && (defined(__x86_64__) || defined(__aarch64__))

#include <errno.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sched.h>
#include <signal.h>
#include <stddef.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#if defined(__x86_64__)
#define ARCHITECTURE AUDIT_ARCH_X86_64
#else
#define ARCHITECTURE AUDIT_ARCH_AARCH64
#endif

// Allowed with any arguments. Calls that this machine's headers lack have no number here.
static const unsigned allowed[] = {
    // Files: Landlock decides which.
    SYS_read,
    SYS_write,
    SYS_pread64,
    SYS_pwrite64,
    SYS_readv,
    SYS_writev,
    SYS_openat,
    SYS_close,
    SYS_fstat,
    SYS_newfstatat,
    SYS_lseek,
    SYS_fcntl,
    SYS_dup,
    SYS_dup3,
    SYS_getdents64,
    SYS_faccessat,
    SYS_readlinkat,
    SYS_linkat,
    SYS_unlinkat,
    SYS_mkdirat,
    SYS_renameat2,
    SYS_fchmod,
    SYS_fchmodat,
    SYS_ftruncate,
    SYS_fallocate,
    SYS_fsync,
    SYS_fdatasync,
    SYS_fadvise64,
    SYS_statfs,
    SYS_fstatfs,
    SYS_getcwd,
    SYS_umask,
    SYS_pipe2,
    SYS_ppoll,
    SYS_pselect6,
    SYS_flock,
    // Memory, threads and time.
    SYS_brk,
    SYS_mmap,
    SYS_munmap,
    SYS_mremap,
    SYS_mprotect,
    SYS_madvise,
    SYS_mincore,
    SYS_futex,
    SYS_set_robust_list,
    SYS_get_robust_list,
    SYS_set_tid_address,
    SYS_sched_yield,
    SYS_sched_getaffinity,
    SYS_sched_setaffinity,
    SYS_sched_getscheduler,
    SYS_sched_getparam,
    SYS_getpriority,
    SYS_membarrier,
    SYS_nanosleep,
    SYS_clock_nanosleep,
    SYS_clock_gettime,
    SYS_clock_getres,
    SYS_gettimeofday,
    SYS_getrusage,
    SYS_times,
    SYS_sysinfo,
    SYS_uname,
    SYS_getrandom,
    SYS_restart_syscall,
    SYS_exit,
    SYS_exit_group,
    SYS_setitimer,
    SYS_getitimer,
    SYS_timer_create,
    SYS_timer_settime,
    SYS_timer_delete,
    SYS_getcpu,
    // Itself.
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
    SYS_getpgid,
    SYS_getsid,
    SYS_getgroups,
    SYS_capget,
#ifdef SYS_statx
    SYS_statx,
#endif
#ifdef SYS_openat2
    SYS_openat2,
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
#ifdef SYS_renameat
    SYS_renameat,
#endif
#ifdef SYS_fchmodat2
    SYS_fchmodat2,
#endif
#ifdef SYS_futex_waitv
    SYS_futex_waitv,
#endif
#if defined(__x86_64__) // which still has the calls of before
    SYS_open,
    SYS_stat,
    SYS_lstat,
    SYS_access,
    SYS_readlink,
    SYS_link,
    SYS_unlink,
    SYS_mkdir,
    SYS_rename,
    SYS_chmod,
    SYS_dup2,
    SYS_pipe,
    SYS_poll,
    SYS_select,
    SYS_getpgrp,
    SYS_time,
    SYS_arch_prctl,
    SYS_alarm,
    SYS_getdents,
#endif
};

// The further calls of SANDBOX_SERVES.
static const unsigned served[] = {
    SYS_accept4,    SYS_recvfrom,   SYS_sendto,    SYS_sendmsg,     SYS_sendfile,          SYS_shutdown,
    SYS_setsockopt, SYS_getsockopt, SYS_epoll_ctl, SYS_epoll_pwait, SYS_inotify_add_watch, SYS_wait4,
#if defined(__x86_64__)
    SYS_epoll_wait,
#endif
};

// Allowed where the low half of an argument is one of some values: programs pass no others here.
struct condition {
    unsigned call;
    int argument;
    int count;
    unsigned values[6];
};

// PR_SET_VMA names memory, which the C library does to its own.
#ifndef PR_SET_VMA
#define PR_SET_VMA 0x53564d41
#endif

// The terminal's size and state; never TIOCSTI, which types into it.
static const struct condition conditions[] = {
    {SYS_ioctl, 1, 4, {TCGETS, TIOCGWINSZ, TIOCGPGRP, FIONREAD}},
    {SYS_prctl, 0, 5, {PR_SET_NAME, PR_GET_NAME, PR_SET_VMA, PR_GET_DUMPABLE, PR_GET_SECCOMP}},
};

// Those of SANDBOX_SERVES: signals that end its processes or cancel their work (Landlock lets none out from version 6 on), what a new
// process does to itself, and its stricter filter.
static const struct condition served_conditions[] = {
    {SYS_kill, 1, 2, {SIGKILL, SIGUSR1}},
    {SYS_prctl, 0, 6, {PR_SET_NAME, PR_GET_NAME, PR_SET_VMA, PR_GET_DUMPABLE, PR_GET_SECCOMP, PR_SET_PDEATHSIG}},
    {SYS_seccomp, 0, 1, {SECCOMP_SET_MODE_FILTER}},
};

enum {
    ALLOWED = sizeof allowed / sizeof *allowed,
    SERVED = sizeof served / sizeof *served,
    CONDITIONS = sizeof conditions / sizeof *conditions,
    SERVED_CONDITIONS = sizeof served_conditions / sizeof *served_conditions,
    NAMESPACES =
        CLONE_NEWNS | CLONE_NEWCGROUP | CLONE_NEWUTS | CLONE_NEWIPC | CLONE_NEWUSER | CLONE_NEWPID | CLONE_NEWNET,
    MAX = 3 * (ALLOWED + SERVED)
};

struct program {
    struct sock_filter code[MAX];
    unsigned short length;
};

static void put(struct program *p, unsigned short code, unsigned k, unsigned char jump_true, unsigned char jump_false)
{
    if (p->length < MAX)
        p->code[p->length] = (struct sock_filter){code, jump_true, jump_false, k};
    p->length++;
}

static void load(struct program *p, size_t offset) { put(p, BPF_LD | BPF_W | BPF_ABS, (unsigned)offset, 0, 0); }
static void end(struct program *p, unsigned result) { put(p, BPF_RET | BPF_K, result, 0, 0); }

#define ARGUMENT(n)      (offsetof(struct seccomp_data, args) + 8 * (size_t)(n)) // its low half: both machines begin with it
#define ARGUMENT_HIGH(n) (ARGUMENT(n) + 4)
#define NO_SUCH_CALL     (SECCOMP_RET_ERRNO | ENOSYS)

// After the number of a call is loaded: `length` instructions for this call alone, which end the program.
static void if_call(struct program *p, unsigned call, unsigned char length)
{
    put(p, BPF_JMP | BPF_JEQ | BPF_K, call, 0, length);
}

static void allow(struct program *p, const unsigned *calls, size_t count)
{
    for (size_t i = 0; i < count; i++) { // x32's numbers are above all of these
        put(p, BPF_JMP | BPF_JEQ | BPF_K, calls[i], 0, 1);
        end(p, SECCOMP_RET_ALLOW);
    }
}

// The first condition of a call decides.
static void allow_some(struct program *p, const struct condition *list, size_t count)
{
    for (const struct condition *c = list; c < list + count; c++) {
        if_call(p, c->call, (unsigned char)(c->count + 3));
        load(p, ARGUMENT(c->argument));
        for (int k = 0; k < c->count; k++)
            put(p, BPF_JMP | BPF_JEQ | BPF_K, c->values[k], (unsigned char)(c->count - k), 0);
        end(p, NO_SUCH_CALL);
        end(p, SECCOMP_RET_ALLOW);
    }
}

static void build(struct program *p, unsigned self, enum sandbox_filter kind)
{
    load(p, offsetof(struct seccomp_data, arch));
    put(p, BPF_JMP | BPF_JEQ | BPF_K, ARCHITECTURE, 1, 0); // else calls of 32 bits, with other numbers
    end(p, SECCOMP_RET_KILL_PROCESS);
    load(p, offsetof(struct seccomp_data, nr));
    allow(p, allowed, ALLOWED);
    if (kind == SANDBOX_SERVES) {
        allow(p, served, SERVED);
        allow_some(p, served_conditions, SERVED_CONDITIONS);
    }
    allow_some(p, conditions, CONDITIONS);
    // A new thread; a new process where it serves; never a new name space.
    if_call(p, SYS_clone, 5);
    load(p, ARGUMENT(0));
    put(p, BPF_ALU | BPF_AND | BPF_K, (kind == SANDBOX_SERVES ? 0 : CLONE_THREAD) | NAMESPACES, 0, 0);
    put(p, BPF_JMP | BPF_JEQ | BPF_K, kind == SANDBOX_SERVES ? 0 : CLONE_THREAD, 1, 0);
    end(p, SECCOMP_RET_ERRNO | EPERM);
    end(p, SECCOMP_RET_ALLOW);
    // Signals to itself, as abort() and the end after Ctrl-C send them.
    static const unsigned signals[] = {SYS_kill, SYS_tgkill};
    for (size_t i = 0; i < 2; i++) {
        if_call(p, signals[i], 4);
        load(p, ARGUMENT(0));
        put(p, BPF_JMP | BPF_JEQ | BPF_K, self, 1, 0);
        end(p, SECCOMP_RET_ERRNO | EPERM);
        end(p, SECCOMP_RET_ALLOW);
    }
    // Limits are read and not set: the pointer to new ones is NULL.
    if_call(p, SYS_prlimit64, 6);
    load(p, ARGUMENT(2));
    put(p, BPF_JMP | BPF_JEQ | BPF_K, 0, 0, 2);
    load(p, ARGUMENT_HIGH(2));
    put(p, BPF_JMP | BPF_JEQ | BPF_K, 0, 1, 0);
    end(p, SECCOMP_RET_ERRNO | EPERM);
    end(p, SECCOMP_RET_ALLOW);
#ifdef SYS_getrlimit
    if_call(p, SYS_getrlimit, 1);
    end(p, SECCOMP_RET_ALLOW);
#endif
    end(p, NO_SUCH_CALL);
}

bool sandbox_filter_install(enum sandbox_filter kind)
{
    struct program p;
    p.length = 0;
    build(&p, (unsigned)getpid(), kind);
    if (p.length > MAX) {
        errno = E2BIG;
        return false;
    }
    const struct sock_fprog filter = {p.length, p.code};
    // All threads at once; of a thread that cannot be held to it, its number is returned.
    return syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER, SECCOMP_FILTER_FLAG_TSYNC, &filter) == 0;
}

#else

bool sandbox_filter_install(enum sandbox_filter kind)
{
    (void)kind;
    return false;
}

#endif
