// attack.c: a library with system calls that injected code could try; test_attack.py preloads it into the program.
// Right after the program has entered its sandbox, it makes system calls from the main thread and from a thread that it
// starts, and later from a thread that the program starts. It writes a line for each: "MODE THREAD NAME ERROR", with
// the error number, or 0 if the call succeeded.
//
// The environment contains its parameters: ATTACK_LOG, a file; ATTACK_FOLDER, a folder with the file "victim";
// ATTACK_PROCESS, the number of another process; ATTACK_WRITE, paths separated by ':' that the writer is asked to
// write; ATTACK_NOW, the names of calls, each between spaces, that are made immediately, without a sandbox. No call
// harms the machine if it succeeds.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <linux/capability.h>
#include <linux/fs.h>
#include <linux/openat2.h>
#include <linux/seccomp.h>
#include <pthread.h>
#include <sched.h>
#include <signal.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <sys/uio.h>
#include <unistd.h>

static int log_file = -1, read_file = -1, written_file = -1, folder_file = -1, server = -1;
static long process;
static char folder[200], victim[300], fresh[300], other[300];
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

static long call(long number, long a, long b, long c, long d, long e, long f)
{
    long result;
#if defined(__x86_64__)
    register long r10 __asm__("r10") = d, r8 __asm__("r8") = e, r9 __asm__("r9") = f;
    __asm__ volatile("syscall"
                     : "=a"(result)
                     : "a"(number), "D"(a), "S"(b), "d"(c), "r"(r10), "r"(r8), "r"(r9)
                     : "rcx", "r11", "memory");
#else
    register long x8 __asm__("x8") = number, x0 __asm__("x0") = a, x1 __asm__("x1") = b, x2 __asm__("x2") = c,
                     x3 __asm__("x3") = d, x4 __asm__("x4") = e, x5 __asm__("x5") = f;
    __asm__ volatile("svc 0" : "+r"(x0) : "r"(x8), "r"(x1), "r"(x2), "r"(x3), "r"(x4), "r"(x5) : "memory");
    result = x0;
#endif
    return result;
}

#define TRY(name, ...) try(mode, thread, name, (const long[7]){__VA_ARGS__})
#define P(pointer)     ((long)(uintptr_t)(pointer))

static void say(const char *mode, const char *thread, const char *name, long result)
{
    char line[200];
    int length =
        snprintf(line, sizeof line, "%s %s %s %ld\n", mode, thread, name, result < 0 && result > -4096 ? -result : 0);
    if (call(SYS_write, log_file, P(line), length, 0, 0, 0) < 0) // a drawing process of the viewer has closed it
        call(SYS_write, STDERR_FILENO, P(line), length, 0, 0, 0);
}

static int is_wanted(const char *name)
{
    const char *only = getenv("ATTACK_NOW");
    char spaced[100];
    snprintf(spaced, sizeof spaced, " %s ", name);
    return !only || strstr(only, spaced);
}

static long try(const char *mode, const char *thread, const char *name, const long a[7])
{
    long result = is_wanted(name) ? call(a[0], a[1], a[2], a[3], a[4], a[5], a[6]) : -ENOSYS;
    if (is_wanted(name))
        say(mode, thread, name, result);
    return result;
}

// A call that returns a file, which is then closed.
#define TRY_OPEN(name, ...)                                                                                            \
    do {                                                                                                               \
        long file = TRY(name, __VA_ARGS__);                                                                            \
        if (file >= 0)                                                                                                 \
            call(SYS_close, file, 0, 0, 0, 0, 0);                                                                      \
    } while (0)

static void change_files(const char *mode, const char *thread)
{
    struct timespec times[2] = {{1, 0}, {1, 0}};
    char link[60];
    TRY("fchmod", SYS_fchmod, read_file, 04777);
    TRY("fchmodat", SYS_fchmodat, AT_FDCWD, P(victim), 04777);
    TRY("fchmodat2", 452, AT_FDCWD, P(victim), 04777, 0);
    TRY("fchown", SYS_fchown, read_file, 1, 1);
    TRY("fchownat", SYS_fchownat, AT_FDCWD, P(victim), 1, 1, 0);
    TRY("utimensat", SYS_utimensat, AT_FDCWD, P(victim), P(times), 0);
    TRY("futimens", SYS_utimensat, read_file, 0, P(times), 0);
    TRY("setxattr", SYS_setxattr, P(victim), P("user.a"), P("b"), 1, 0);
    TRY("fsetxattr", SYS_fsetxattr, read_file, P("user.a"), P("b"), 1, 0);
    TRY("truncate", SYS_truncate, P(victim), 1);
    TRY("ftruncate", SYS_ftruncate, written_file, 1);
    TRY("fallocate", SYS_fallocate, written_file, 3 /* punch a hole */, 0, 1);
    TRY("flock", SYS_flock, read_file, 2);
    TRY("lease", SYS_fcntl, read_file, F_SETLEASE, F_RDLCK);
    TRY("lock", SYS_fcntl, written_file, F_SETLK, P(&(struct flock){.l_type = F_WRLCK}));
    TRY("attributes", SYS_ioctl, read_file, FS_IOC_SETFLAGS, P(&(long){0x80}));
    TRY_OPEN("open-write", SYS_openat, AT_FDCWD, P(victim), O_WRONLY);
    TRY_OPEN("open-read-write", SYS_openat, AT_FDCWD, P(victim), O_RDWR);
    TRY_OPEN("open-empty", SYS_openat, AT_FDCWD, P(victim), O_RDONLY | O_TRUNC);
    TRY_OPEN("open-append", SYS_openat, folder_file, P("victim"), O_WRONLY | O_APPEND);
    TRY_OPEN("openat2-write", SYS_openat2, AT_FDCWD, P(victim), P((&(struct open_how){.flags = O_WRONLY})),
             sizeof(struct open_how));
    TRY_OPEN("openat2-empty", SYS_openat2, AT_FDCWD, P(victim), P((&(struct open_how){.flags = O_RDONLY | O_TRUNC})),
             sizeof(struct open_how));
    TRY_OPEN("openat2-setuid", SYS_openat2, AT_FDCWD, P(fresh),
             P((&(struct open_how){.flags = O_CREAT | O_WRONLY, .mode = 04777})), sizeof(struct open_how));
    TRY_OPEN("make-setuid", SYS_openat, AT_FDCWD, P(fresh), O_CREAT | O_WRONLY, 04777);
    TRY_OPEN("make-unnamed", SYS_openat, AT_FDCWD, P(folder), O_TMPFILE | O_RDWR, 0777);
    snprintf(link, sizeof link, "/proc/self/fd/%d", read_file);
    TRY_OPEN("reopen", SYS_openat, AT_FDCWD, P(link), O_RDWR);
    TRY_OPEN("own-memory", SYS_openat, AT_FDCWD, P("/proc/self/mem"), O_RDWR);
    TRY("mkdir", SYS_mkdirat, AT_FDCWD, P(other), 0777);
    TRY("mknod", SYS_mknodat, AT_FDCWD, P(other), S_IFIFO | 0666, 0);
    TRY("symlink", SYS_symlinkat, P("/etc/passwd"), AT_FDCWD, P(other));
    TRY("link", SYS_linkat, AT_FDCWD, P(victim), AT_FDCWD, P(other), 0);
    TRY("link-handle", SYS_linkat, AT_FDCWD, P(link), AT_FDCWD, P(other), AT_SYMLINK_FOLLOW);
    TRY("rename", SYS_renameat2, AT_FDCWD, P(victim), AT_FDCWD, P(other), 0);
    TRY("unlink", SYS_unlinkat, AT_FDCWD, P(victim), 0);
    TRY("unlink-renamed", SYS_unlinkat, AT_FDCWD, P(other), 0);
    TRY("mount", SYS_mount, P("a"), P(folder), P("no such"), 0, 0);
    TRY("chroot", SYS_chroot, P(folder));
    TRY("chdir", SYS_chdir, P("/"));
    TRY("watch", SYS_inotify_init1, 0);
    TRY("watch-all", SYS_fanotify_init, 0, 0);
    TRY("by-handle", SYS_open_by_handle_at, AT_FDCWD, P(victim), O_RDWR);
    TRY("umask", SYS_umask, 0);
#if defined(__x86_64__)
    TRY("chmod", SYS_chmod, P(victim), 04777);
    TRY("chown", SYS_chown, P(victim), 1, 1);
    TRY_OPEN("creat", SYS_creat, P(fresh), 04777);
    TRY_OPEN("old-open-empty", SYS_open, P(victim), O_RDONLY | O_TRUNC);
    TRY_OPEN("old-open-make", SYS_open, P(fresh), O_RDWR | O_CREAT, 0777);
    TRY("old-unlink", SYS_unlink, P(victim));
    TRY("old-rename", SYS_rename, P(victim), P(other));
#endif
}

static void change_processes(const char *mode, const char *thread)
{
    cpu_set_t set;
    struct sched_param order = {0};
    struct rlimit limit[2] = {{1, 1}};
    struct {
        uint32_t size, policy;
        uint64_t flags;
        int32_t nice;
        uint32_t priority;
        uint64_t times[3];
    } attributes = {.size = 48, .nice = 10};
    char byte;
    struct iovec here = {&byte, 1}, there = {&byte, 1};
    siginfo_t about = {.si_signo = SIGUSR1, .si_code = SI_QUEUE};
    struct __user_cap_header_struct capabilities = {_LINUX_CAPABILITY_VERSION_3, (int)process};
    struct __user_cap_data_struct data[2];
    struct timespec time;
    char memory[60];
    CPU_ZERO(&set);
    CPU_SET(0, &set);
    TRY("setaffinity", SYS_sched_setaffinity, process, sizeof set, P(&set));
    TRY("setaffinity-own", SYS_sched_setaffinity, 0, sizeof set, P(&set));
    TRY("getaffinity", SYS_sched_getaffinity, process, sizeof set, P(&set));
    TRY("setpriority", SYS_setpriority, PRIO_PROCESS, process, 10);
    TRY("getpriority", SYS_getpriority, PRIO_PROCESS, process);
    TRY("ioprio_set", SYS_ioprio_set, 1, process, (3 << 13));
    TRY("ioprio_get", SYS_ioprio_get, 1, process);
    TRY("setscheduler", SYS_sched_setscheduler, process, SCHED_BATCH, P(&order));
    TRY("getscheduler", SYS_sched_getscheduler, process);
    TRY("sched_setattr", SYS_sched_setattr, process, P(&attributes), 0);
    TRY("sched_getattr", SYS_sched_getattr, process, P(&attributes), sizeof attributes, 0);
    TRY("setparam", SYS_sched_setparam, process, P(&order));
    TRY("getparam", SYS_sched_getparam, process, P(&order));
    TRY("limits", SYS_prlimit64, process, RLIMIT_NOFILE, 0, P(limit));
    TRY("set-limits", SYS_prlimit64, process, RLIMIT_CORE, P(limit), 0);
    TRY("set-own-limits", SYS_prlimit64, 0, RLIMIT_CORE, P(limit), 0);
    TRY("kill", SYS_kill, process, SIGUSR2);
    TRY("kill-usr1", SYS_kill, process, SIGUSR1);
    TRY("kill-group", SYS_kill, -process, 0);
    TRY("kill-all", SYS_kill, -1, 0);
    TRY("kill-parent", SYS_kill, getppid(), SIGCONT);
    TRY("tkill", SYS_tkill, process, SIGUSR2);
    TRY("tgkill", SYS_tgkill, process, process, SIGUSR2);
    TRY("queue", SYS_rt_sigqueueinfo, process, SIGUSR2, P(&about));
    TRY("queue-thread", SYS_rt_tgsigqueueinfo, process, process, SIGUSR2, P(&about));
    TRY_OPEN("pidfd_open", SYS_pidfd_open, process, 0);
    TRY("pidfd_send_signal", SYS_pidfd_send_signal, folder_file, SIGUSR2, 0, 0);
    TRY("pidfd_getfd", SYS_pidfd_getfd, folder_file, 0, 0);
    TRY("read-memory", SYS_process_vm_readv, process, P(&here), 1, P(&there), 1, 0);
    TRY("write-memory", SYS_process_vm_writev, process, P(&here), 1, P(&there), 1, 0);
    TRY("process_madvise", SYS_process_madvise, folder_file, P(&here), 1, 20, 0);
    TRY("process_mrelease", 448, folder_file, 0);
    TRY("move_pages", SYS_move_pages, process, 0, 0, 0, 0, 0);
    TRY("migrate_pages", SYS_migrate_pages, process, 64, P(memory), P(memory));
    TRY("kcmp", SYS_kcmp, getpid(), process, 1, 0, 0);
    TRY("ptrace", SYS_ptrace, PTRACE_SEIZE, process, 0, 0);
    TRY("getpgid", SYS_getpgid, process);
    TRY("getsid", SYS_getsid, process);
    TRY("setpgid", SYS_setpgid, process, process);
    TRY("setsid", SYS_setsid, 0);
    TRY("robust-list", SYS_get_robust_list, process, P(memory), P(memory + 8));
    TRY("capget", SYS_capget, P(&capabilities), P(data));
    TRY("clock", SYS_clock_gettime, (~process << 3) | 2, P(&time));
    TRY("clock-resolution", SYS_clock_getres, (~process << 3) | 2, P(&time));
    TRY("clock-set", SYS_clock_settime, 0, 0);
    snprintf(memory, sizeof memory, "/proc/%ld/environ", process);
    TRY_OPEN("environment", SYS_openat, AT_FDCWD, P(memory), O_RDONLY);
    TRY("perf", SYS_perf_event_open, P(&attributes), process, -1, -1, 0);
    TRY("waits", SYS_waitid, 0, 0, 0, 4 | 1, 0);
    TRY("subreaper", SYS_prctl, PR_SET_CHILD_SUBREAPER, 1);
    TRY("dumpable", SYS_prctl, PR_SET_DUMPABLE, 1);
    TRY("oom", SYS_openat, AT_FDCWD, P("/proc/self/oom_score_adj"), O_WRONLY);
}

static void direct_signals(const char *mode, const char *thread)
{
    struct f_owner_ex owner = {F_OWNER_PID, (pid_t)process};
    int number = (int)process, on = 1;
    struct itimerval timer;
    memset(&timer, 0, sizeof timer);
    TRY("F_SETOWN", SYS_fcntl, 0, F_SETOWN, process);
    TRY("F_SETOWN-socket", SYS_fcntl, server, F_SETOWN, process);
    TRY("F_SETOWN_EX", SYS_fcntl, server, F_SETOWN_EX, P(&owner));
    TRY("F_GETOWN", SYS_fcntl, server, F_GETOWN);
    TRY("F_SETSIG", SYS_fcntl, server, F_SETSIG, SIGKILL);
    TRY("O_ASYNC", SYS_fcntl, server, F_SETFL, O_ASYNC | O_NONBLOCK);
    TRY("F_SETFL", SYS_fcntl, log_file, F_SETFL, 0); // a journal that cannot be appended to any more
    TRY("FIOASYNC", SYS_ioctl, server, FIOASYNC, P(&on));
    TRY("FIOSETOWN", SYS_ioctl, server, 0x8901, P(&number));
    TRY("SIOCSPGRP", SYS_ioctl, server, 0x8902, P(&number));
    TRY("TIOCSTI", SYS_ioctl, 0, TIOCSTI, P("a"));
    TRY("TIOCSPGRP", SYS_ioctl, 0, TIOCSPGRP, P(&number));
    TRY("F_NOTIFY", SYS_fcntl, folder_file, F_NOTIFY, 1);
    TRY("alarm", SYS_setitimer, ITIMER_REAL, P(&timer), 0);
    TRY("timer", SYS_timer_create, 0, 0, P(&(int){0}));
}

static void make_more(const char *mode, const char *thread)
{
    char *const words[] = {"/bin/true", NULL};
    char parameters[200] = {0};
    struct sockaddr_in_like {
        unsigned short family, port;
        unsigned char address[4], zero[8];
    } to = {AF_INET, 0x5000, {127, 0, 0, 1}, {0}};
    TRY("run", SYS_execve, P("/bin/no-such-program"), P(words), P(words + 1));
    TRY("run-handle", SYS_execveat, read_file, P(""), P(words), P(words + 1), AT_EMPTY_PATH);
    TRY_OPEN("memfd", SYS_memfd_create, P("a"), 0);
    TRY_OPEN("memfd-secret", SYS_memfd_secret, 0);
    TRY("name-space", SYS_unshare, CLONE_NEWUSER);
    TRY("enter-name-space", SYS_setns, folder_file, 0);
    TRY_OPEN("socket", SYS_socket, AF_INET, SOCK_STREAM, 0);
    TRY_OPEN("unix-socket", SYS_socket, AF_UNIX, SOCK_STREAM, 0);
    TRY_OPEN("netlink", SYS_socket, 16, SOCK_RAW, 0);
    TRY("connect", SYS_connect, server, P(&to), sizeof to);
    TRY("bind", SYS_bind, server, P(&to), sizeof to);
    TRY("fast-open", SYS_sendto, server, P("a"), 1, 0x20000000 | MSG_NOSIGNAL, P(&to), sizeof to);
    TRY("fast-open-message", SYS_sendmsg, server, P((&(struct msghdr){.msg_name = &to, .msg_namelen = sizeof to})),
        0x20000000 | MSG_NOSIGNAL);
    TRY("shared-memory", SYS_shmget, 0, 4096, 01600);
    TRY("messages", SYS_msgget, 0, 01600);
    TRY("semaphores", SYS_semget, 0, 1, 01600);
    TRY_OPEN("mq_open", SYS_mq_open, P("lambent-attack"), O_CREAT | O_RDWR, 0600, 0);
    TRY("keys", SYS_keyctl, 0, -3, 0);
    TRY("add_key", SYS_add_key, P("user"), P("a"), P("b"), 1, -3);
    TRY_OPEN("io_uring", SYS_io_uring_setup, 1, P(parameters));
    TRY_OPEN("userfaultfd", SYS_userfaultfd, 1);
    TRY("bpf", SYS_bpf, 0, P(parameters), sizeof parameters);
    TRY("personality", SYS_personality, 0x0040000);
    TRY("setuid", SYS_setuid, getuid());
    TRY("sync", SYS_sync);
    TRY("host-name", SYS_sethostname, P("a"), -1);
    TRY("splice", SYS_splice, read_file, 0, written_file, 0, 1, 0);
    TRY("copy-range", SYS_copy_file_range, read_file, 0, written_file, 0, 1, 0);
    if (strcmp(mode, "serves") == 0) // its drawing processes
        return;
    if (TRY("fork", SYS_clone, SIGCHLD) == 0)
        call(SYS_exit_group, 0, 0, 0, 0, 0, 0);
}

// Asks the writer, on each existing socket, for files that do not belong to this run. The answers are lam_errors.
static void ask_writer(const char *mode, const char *thread)
{
    const char *paths = getenv("ATTACK_WRITE");
    for (int file = 3; paths && file < 200; file++) {
        struct stat about;
        if (file == server || fstat(file, &about) != 0 || !S_ISSOCK(about.st_mode))
            continue;
        for (const char *at = paths; *at;) {
            size_t length = strcspn(at, ":");
            char request[600];
            struct {
                uint32_t action, path_size;
                uint64_t bytes;
            } head = {0, (uint32_t)length + 1, 4};
            for (; head.action <= 3; head.action++) {
                struct {
                    int code;
                    char text[508];
                } answer = {.code = -1};
                head.bytes = head.action == 2 ? 0 : 4;
                memcpy(request, &head, sizeof head);
                memcpy(request + sizeof head, at, length);
                request[sizeof head + length] = 0;
                memcpy(request + sizeof head + length + 1, "evil", 4);
                call(SYS_write, file, P(request), (long)(sizeof head + length + 1 + head.bytes), 0, 0, 0);
                call(SYS_read, file, P(&answer), sizeof answer, 0, 0, 0);
                char what[400];
                snprintf(what, sizeof what, "write-%u:%.*s", head.action, (int)length, at);
                say(mode, thread, what, answer.code ? -1000 - answer.code : 0);
            }
            at += length + (at[length] == ':');
        }
        return;
    }
}

static void attack(const char *mode, const char *thread)
{
    change_processes(mode, thread);
    direct_signals(mode, thread);
    make_more(mode, thread);
    if (strcmp(thread, "worker") != 0) // another thread of the program may be asking for its picture
        ask_writer(mode, thread);
    change_files(mode, thread);
}

static const char *current;

static void *in_thread(void *user)
{
    attack(current, "thread");
    return user;
}

static int ready; // the sandbox is active; the next thread of the program also attacks

static void act(const char *mode)
{
    pthread_t thread;
    int (*make)(pthread_t *, const pthread_attr_t *, void *(*)(void *), void *) = dlsym(RTLD_NEXT, "pthread_create");
    pthread_mutex_lock(&lock);
    current = mode;
    attack(mode, "main");
    if (make(&thread, NULL, in_thread, NULL) == 0)
        pthread_join(thread, NULL);
    __atomic_store_n(&ready, 1, __ATOMIC_RELEASE);
    pthread_mutex_unlock(&lock);
}

__attribute__((constructor)) static void prepare(void)
{
    const char *log = getenv("ATTACK_LOG"), *place = getenv("ATTACK_FOLDER"), *number = getenv("ATTACK_PROCESS");
    if (!log || !place || !number)
        return;
    snprintf(folder, sizeof folder, "%s", place);
    snprintf(victim, sizeof victim, "%s/victim", place);
    snprintf(fresh, sizeof fresh, "%s/fresh", place);
    snprintf(other, sizeof other, "%s/other", place);
    process = atol(number);
    log_file = open(log, O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0666);
    // Handles that a caller may have left open.
    read_file = open(victim, O_RDONLY | O_CLOEXEC);
    written_file = open(victim, O_RDWR | O_CLOEXEC);
    folder_file = open(place, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    server = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (getenv("ATTACK_NOW"))
        act("free");
}

// The filter is the last part of a sandbox. A process that serves others has a filter that is followed by the filters
// of those.
long syscall(long number, ...)
{
    long a[6];
    va_list more;
    va_start(more, number);
    for (int i = 0; i < 6; i++)
        a[i] = va_arg(more, long);
    va_end(more);
    long result = call(number, a[0], a[1], a[2], a[3], a[4], a[5]);
    if (result >= 0 && number == SYS_seccomp && a[0] == SECCOMP_SET_MODE_FILTER && log_file >= 0) {
        const char *mode = getenv("ATTACK_MODE");
        static int times;
        act(mode && strcmp(mode, "serves") == 0 && times++ ? "drawing" : mode ? mode : "draws");
    }
    if (result < 0 && result > -4096) {
        errno = (int)-result;
        return -1;
    }
    return result;
}

struct start {
    void *(*run)(void *);
    void *user;
    int acts;
};

static void *run(void *user)
{
    struct start start = *(struct start *)user;
    free(user);
    if (start.acts) {
        pthread_mutex_lock(&lock);
        attack(current, "worker");
        pthread_mutex_unlock(&lock);
    }
    return start.run(start.user);
}

int pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*function)(void *), void *user)
{
    int (*make)(pthread_t *, const pthread_attr_t *, void *(*)(void *), void *) = dlsym(RTLD_NEXT, "pthread_create");
    struct start *start = malloc(sizeof *start);
    int once = 1;
    *start = (struct start){function, user,
                            __atomic_compare_exchange_n(&ready, &once, 2, 0, __ATOMIC_ACQ_REL, __ATOMIC_ACQUIRE)};
    return make(thread, attributes, run, start);
}
