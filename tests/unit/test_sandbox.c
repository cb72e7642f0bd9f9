// test_sandbox.c: tries forbidden operations from inside the program's sandbox: files outside, links, programs,
// sockets, other processes, 32-bit system calls; and allowed operations. Each attempt is a separate process, which
// enters the sandbox and ends with its error number.
#include "test.h"
#include "sandbox.h"

#include <errno.h>
#include <fcntl.h>
#include <linux/openat2.h>
#include <pthread.h>
#include <sched.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/mount.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <sys/un.h>
#include <sys/wait.h>

static char top[] = "/tmp/lambent-sandbox-XXXXXX"; // with the folders in, out and secret
static struct sandbox_state offered;

static void path_of(const char *name, char path[200]) { snprintf(path, 200, "%s/%s", top, name); }

static void put(const char *name)
{
    char path[200];
    path_of(name, path);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(name, file);
    fclose(file);
}

static void folder(const char *name)
{
    char path[200];
    path_of(name, path);
    assert_int_equal(mkdir(path, 0777), 0);
}

static int make_files(void **state)
{
    (void)state;
    char path[200], target[200];
    offered = sandbox_offered();
    assert_non_null(mkdtemp(top));
    folder("in");
    folder("in/below");
    folder("out");
    folder("secret");
    put("in/model");
    put("in/below/texture");
    put("out/old");
    path_of("out/pipe", path);
    assert_int_equal(mkfifo(path, 0666), 0);
    put("secret/file");
    path_of("in/link", path);
    path_of("secret/file", target);
    assert_int_equal(symlink(target, path), 0);
    path_of("in/folder-link", path);
    assert_int_equal(symlink("../secret", path), 0);
    return 0;
}

static int remove_files(void **state)
{
    (void)state;
    char command[100];
    snprintf(command, sizeof command, "rm -rf %s", top);
    return system(command);
}

static void enter(unsigned kind)
{
    struct sandbox_paths paths = {.serves = kind == SANDBOX_SERVES};
    struct sandbox_state state;
    char path[200];
    path_of("in", path);
    sandbox_add(&paths, path, SANDBOX_READ);
    path_of("out/pipe", path);
    sandbox_add(&paths, path, SANDBOX_WRITE);
    sandbox_add(&paths, "/no such folder", SANDBOX_READ);
    if (!sandbox_enter(&paths, &state, NULL) || state.reason)
        _exit(250);
    sandbox_paths_free(&paths);
}

// --- attempts: 0, or an errno

static int error_of(long result) { return result < 0 ? errno : 0; }

static int opens(const char *name, int flags)
{
    char path[200];
    path_of(name, path);
    return error_of(open(path, flags | O_CLOEXEC, 0666));
}

static int read_inside(void) { return opens("in/model", O_RDONLY) | opens("in/below/texture", O_RDONLY); }
static int write_pipe(void) { return opens("out/pipe", O_WRONLY | O_NONBLOCK); }
static int make_file(void) { return opens("out/new", O_WRONLY | O_CREAT | O_EXCL); }
static int empty_model(void) { return opens("in/model", O_RDONLY | O_TRUNC); }
static int empty_model_again(void)
{
    char path[200];
    struct open_how how = {.flags = O_RDONLY | O_TRUNC | O_CLOEXEC};
    path_of("in/model", path);
    return error_of(syscall(SYS_openat2, AT_FDCWD, path, &how, sizeof how));
}
static int make_program(void)
{
    char path[200];
    path_of("out/program", path);
    return error_of(open(path, O_WRONLY | O_CREAT, 04777));
}
static int change_mode(void)
{
    char path[200];
    path_of("in/model", path);
    return error_of(chmod(path, 04777));
}
static int rename_old(void)
{
    char from[200], to[200];
    path_of("out/old", from);
    path_of("out/other", to);
    return error_of(rename(from, to));
}
static int make_folder(void)
{
    char path[200];
    path_of("out/more", path);
    return error_of(mkdir(path, 0777));
}
static int unnamed_file(void)
{
    char path[200], link[64], name[200];
    path_of("out", path);
    int file = open(path, O_TMPFILE | O_WRONLY, 0666);
    if (file < 0)
        return errno;
    snprintf(link, sizeof link, "/proc/self/fd/%d", file);
    path_of("out/unnamed", name);
    return error_of(linkat(AT_FDCWD, link, AT_FDCWD, name, AT_SYMLINK_FOLLOW));
}

static void *touch(void *user)
{
    *(int *)user = 1;
    return NULL;
}
static int thread_inside(void)
{
    pthread_t thread;
    int ran = 0, error = pthread_create(&thread, NULL, touch, &ran);
    return error ? error : pthread_join(thread, NULL) || !ran;
}
static int signal_itself(void) { return error_of(kill(getpid(), 0)); }
static int ask_limit(void)
{
    struct rlimit limit;
    return error_of(getrlimit(RLIMIT_AS, &limit));
}

static int secret(void) { return opens("secret/file", O_RDONLY); }
static int system_file(void) { return error_of(open("/etc/passwd", O_RDONLY)); }
static int dots(void) { return opens("in/../secret/file", O_RDONLY); }
static int dots_of_folder(void)
{
    char path[200];
    path_of("in", path);
    int in = open(path, O_RDONLY | O_DIRECTORY);
    return in < 0 ? 0 : error_of(openat(in, "../secret/file", O_RDONLY));
}
static int link_out(void) { return opens("in/link", O_RDONLY); }
static int folder_link_out(void) { return opens("in/folder-link/file", O_RDONLY); }
static int own_memory(void) { return error_of(open("/proc/self/mem", O_RDWR)); }
static int change_model(void) { return opens("in/model", O_WRONLY); }
static int truncate_model(void)
{
    char path[200];
    path_of("in/model", path);
    return error_of(truncate(path, 0));
}
static int remove_model(void)
{
    char path[200];
    path_of("in/model", path);
    return error_of(unlink(path));
}
static int add_to_model(void) { return opens("in/new", O_WRONLY | O_CREAT); }
static int read_output(void) { return opens("out/old", O_RDONLY); }
static int take_secret(void)
{
    char from[200], to[200];
    path_of("secret/file", from);
    path_of("out/taken", to);
    return error_of(link(from, to));
}
static int make_symlink(void)
{
    char path[200];
    path_of("out/symlink", path);
    return error_of(symlink("/etc/passwd", path));
}
static int list_secret(void)
{
    char path[200];
    path_of("secret", path);
    return error_of(open(path, O_RDONLY | O_DIRECTORY));
}

static int run_program(void)
{
    char *const words[] = {"/bin/true", NULL};
    return error_of(execve("/bin/true", words, words + 1));
}
static int run_own_memory(void)
{
    char *const words[] = {"a", NULL};
    int file = (int)syscall(SYS_memfd_create, "a", 0);
    return file < 0 ? errno : error_of(syscall(SYS_execveat, file, "", words, words + 1, AT_EMPTY_PATH));
}
static int make_process(void)
{
    pid_t child = fork();
    if (child == 0)
        _exit(0);
    return error_of(child);
}
static int make_user_space(void) { return error_of(unshare(CLONE_NEWUSER)); }
static int inet_socket(void) { return error_of(socket(AF_INET, SOCK_STREAM, 0)); }
static int unix_socket(void) { return error_of(socket(AF_UNIX, SOCK_DGRAM, 0)); }
static int socket_pair(void)
{
    int pair[2];
    return error_of(socketpair(AF_UNIX, SOCK_STREAM, 0, pair));
}
static int trace_parent(void) { return error_of(ptrace(PTRACE_ATTACH, getppid(), NULL, NULL)); }
static int traced(void) { return error_of(ptrace(PTRACE_TRACEME, 0, NULL, NULL)); }
static int read_parent(void)
{
    char byte;
    struct iovec here = {&byte, 1}, there = {top, 1};
    return error_of(process_vm_readv(getppid(), &here, 1, &there, 1, 0));
}
static int signal_parent(void) { return error_of(kill(getppid(), 0)); }
static int signal_all(void) { return error_of(kill(-1, 0)); }
static int raise_limit(void)
{
    struct rlimit limit = {1 << 20, 1 << 20};
    return error_of(setrlimit(RLIMIT_CORE, &limit));
}
static int mount_file_system(void) { return error_of(mount("a", "/tmp", "tmpfs", 0, NULL)); }
static int change_root(void) { return error_of(chroot("/tmp")); }
static int load_filter_code(void) { return error_of(syscall(SYS_bpf, 0, NULL, 0)); }
static int uring(void)
{
    char parameters[200] = {0};
    return error_of(syscall(SYS_io_uring_setup, 1, parameters));
}
static int perf(void) { return error_of(syscall(SYS_perf_event_open, NULL, 0, -1, -1, 0)); }
static int keys(void) { return error_of(syscall(SYS_keyctl, 0, 0)); }
static int type_into_terminal(void) { return error_of(ioctl(0, TIOCSTI, "a")); }
static int core_of_itself(void) { return error_of(prctl(PR_SET_DUMPABLE, 1, 0, 0, 0)); }
static int open_by_handle(void) { return error_of(syscall(SYS_open_by_handle_at, 0, NULL, 0)); }

struct attempt {
    const char *name;
    int (*run)(void);
    int expected; // an errno, or −1 for any
};

#define ATTEMPT(name, expected) {#name, name, expected}
static const struct attempt attempts[] = {
    ATTEMPT(read_inside, 0),
    ATTEMPT(write_pipe, ENXIO), // nobody reads it
    ATTEMPT(make_file, EACCES),
    ATTEMPT(make_folder, ENOSYS),
    ATTEMPT(rename_old, ENOSYS),
    ATTEMPT(make_program, EACCES),
    ATTEMPT(empty_model, EACCES),
    ATTEMPT(empty_model_again, EACCES),
    ATTEMPT(change_mode, ENOSYS),
    ATTEMPT(unnamed_file, EACCES),
    ATTEMPT(thread_inside, 0),
    ATTEMPT(signal_itself, 0),
    ATTEMPT(ask_limit, 0),
    ATTEMPT(secret, EACCES),
    ATTEMPT(system_file, EACCES),
    ATTEMPT(dots, EACCES),
    ATTEMPT(dots_of_folder, EACCES),
    ATTEMPT(link_out, EACCES),
    ATTEMPT(folder_link_out, EACCES),
    ATTEMPT(own_memory, EACCES),
    ATTEMPT(change_model, EACCES),
    ATTEMPT(truncate_model, -1), // EACCES by Landlock 3, and the filter does not allow the call
    ATTEMPT(remove_model, ENOSYS),
    ATTEMPT(add_to_model, EACCES),
    ATTEMPT(read_output, EACCES),
    ATTEMPT(take_secret, ENOSYS),
    ATTEMPT(make_symlink, ENOSYS),
    ATTEMPT(list_secret, EACCES),
    ATTEMPT(run_program, ENOSYS),
    ATTEMPT(run_own_memory, ENOSYS),
    ATTEMPT(make_process, EPERM),
    ATTEMPT(make_user_space, ENOSYS),
    ATTEMPT(inet_socket, ENOSYS),
    ATTEMPT(unix_socket, ENOSYS),
    ATTEMPT(socket_pair, ENOSYS),
    ATTEMPT(trace_parent, ENOSYS),
    ATTEMPT(traced, ENOSYS),
    ATTEMPT(read_parent, ENOSYS),
    ATTEMPT(signal_parent, EPERM),
    ATTEMPT(signal_all, EPERM),
    ATTEMPT(raise_limit, EPERM),
    ATTEMPT(mount_file_system, ENOSYS),
    ATTEMPT(change_root, ENOSYS),
    ATTEMPT(load_filter_code, ENOSYS),
    ATTEMPT(uring, ENOSYS),
    ATTEMPT(perf, ENOSYS),
    ATTEMPT(keys, ENOSYS),
    ATTEMPT(type_into_terminal, ENOSYS),
    ATTEMPT(core_of_itself, ENOSYS),
    ATTEMPT(open_by_handle, ENOSYS),
};

// The status of a process that enters the sandbox, or not, and runs an attempt.
static int status_of(const struct attempt *attempt, bool sandboxed, unsigned kind)
{
    int status = 0;
    fflush(NULL);
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        if (sandboxed)
            enter(kind);
        _exit(attempt->run());
    }
    assert_true(waitpid(child, &status, 0) == child);
    return status;
}

static void need_sandbox(void)
{
    if (!offered.reason)
        return;
    print_message("skipped: %s\n", offered.reason);
    skip();
}

TEST(test_attempts)
{
    need_sandbox();
    int wrong = 0;
    for (size_t i = 0; i < sizeof attempts / sizeof *attempts; i++) {
        int status = status_of(&attempts[i], true, SANDBOX_DRAWS),
            error = WIFEXITED(status) ? WEXITSTATUS(status) : 255;
        bool good = attempts[i].expected < 0 ? error != 0 && error < 250 : error == attempts[i].expected;
        if (!good)
            print_message("%s: %d %s\n", attempts[i].name, error, strerror(error));
        wrong += !good;
    }
    assert_int_equal(wrong, 0);
}

// The filter for a kernel without Landlock, or with a Landlock that cannot control truncation: Landlock forbids nothing
// here.
static int with_filter(const struct attempt *attempt, unsigned kind)
{
    int status = 0;
    fflush(NULL);
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0)
        _exit(prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) || !sandbox_filter_install(kind, -1) ? 250 : attempt->run());
    assert_true(waitpid(child, &status, 0) == child);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 255;
}

TEST(test_filter_alone)
{
    need_sandbox();
    static const struct attempt alone[] = {ATTEMPT(read_inside, 0),        ATTEMPT(secret, 0),
                                           ATTEMPT(empty_model, EACCES),   ATTEMPT(empty_model_again, ENOSYS),
                                           ATTEMPT(make_program, EACCES),  ATTEMPT(change_model, EACCES),
                                           ATTEMPT(make_file, EACCES),     ATTEMPT(unnamed_file, EACCES),
                                           ATTEMPT(change_mode, ENOSYS),   ATTEMPT(rename_old, ENOSYS),
                                           ATTEMPT(remove_model, ENOSYS),  ATTEMPT(make_folder, ENOSYS),
                                           ATTEMPT(truncate_model, ENOSYS)};
    for (size_t i = 0; i < sizeof alone / sizeof *alone; i++) {
        int error = with_filter(&alone[i], SANDBOX_DRAWS | SANDBOX_NO_OPENAT2);
        if (error != alone[i].expected)
            fail_msg("%s: %d %s", alone[i].name, error, strerror(error));
    }
    static const struct attempt pipe = ATTEMPT(write_pipe, ENXIO), make = ATTEMPT(make_file, EACCES);
    assert_int_equal(with_filter(&pipe, SANDBOX_DRAWS), EACCES);
    assert_int_equal(with_filter(&pipe, SANDBOX_OPENS_PIPES), ENXIO);
    assert_int_equal(with_filter(&make, SANDBOX_OPENS_PIPES), EACCES);
}

// A server with its listening socket starts processes, which can use the stricter filter, and nothing else is allowed.
static int stricter_process(void)
{
    return !sandbox_filter_install(SANDBOX_DRAWS, -1) ? EINVAL : make_process() == EPERM ? 0 : ECHILD;
}

static int ends_process(void)
{
    pid_t child = fork();
    if (child == 0) {
        pause();
        _exit(0);
    }
    return child < 0 || kill(child, SIGKILL) != 0 ? errno : waitpid(child, NULL, 0) == child ? 0 : ECHILD;
}

static int stop_parent(void) { return error_of(kill(getppid(), SIGSTOP)); }

TEST(test_server)
{
    need_sandbox();
    static const struct attempt served[] = {ATTEMPT(read_inside, 0),           ATTEMPT(thread_inside, 0),
                                            ATTEMPT(make_process, 0),          ATTEMPT(stricter_process, 0),
                                            ATTEMPT(ends_process, 0),          ATTEMPT(secret, EACCES),
                                            ATTEMPT(system_file, EACCES),      ATTEMPT(dots, EACCES),
                                            ATTEMPT(link_out, EACCES),         ATTEMPT(change_model, EACCES),
                                            ATTEMPT(run_program, ENOSYS),      ATTEMPT(run_own_memory, ENOSYS),
                                            ATTEMPT(inet_socket, ENOSYS),      ATTEMPT(unix_socket, ENOSYS),
                                            ATTEMPT(socket_pair, ENOSYS),      ATTEMPT(stop_parent, ENOSYS),
                                            ATTEMPT(make_user_space, ENOSYS),  ATTEMPT(trace_parent, ENOSYS),
                                            ATTEMPT(raise_limit, EPERM),       ATTEMPT(type_into_terminal, ENOSYS),
                                            ATTEMPT(mount_file_system, ENOSYS)};
    for (size_t i = 0; i < sizeof served / sizeof *served; i++) {
        int status = status_of(&served[i], true, SANDBOX_SERVES), error = WIFEXITED(status) ? WEXITSTATUS(status) : 255;
        if (error != served[i].expected)
            fail_msg("%s: %d %s", served[i].name, error, strerror(error));
    }
}

// The attempts are valid: without the sandbox, they succeed.
TEST(test_without)
{
    static const struct attempt free_ones[] = {ATTEMPT(secret, 0),
                                               ATTEMPT(system_file, 0),
                                               ATTEMPT(dots, 0),
                                               ATTEMPT(dots_of_folder, 0),
                                               ATTEMPT(link_out, 0),
                                               ATTEMPT(read_output, 0),
                                               ATTEMPT(run_program, 0),
                                               ATTEMPT(make_process, 0),
                                               ATTEMPT(folder_link_out, 0),
                                               ATTEMPT(inet_socket, 0),
                                               ATTEMPT(unix_socket, 0),
                                               ATTEMPT(socket_pair, 0),
                                               ATTEMPT(make_file, 0),
                                               ATTEMPT(empty_model_again, 0),
                                               ATTEMPT(change_mode, 0),
                                               ATTEMPT(make_program, 0),
                                               ATTEMPT(traced, 0),
                                               ATTEMPT(list_secret, 0),
                                               ATTEMPT(signal_parent, 0)};
    for (size_t i = 0; i < sizeof free_ones / sizeof *free_ones; i++) {
        int status = status_of(&free_ones[i], false, SANDBOX_DRAWS);
        if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
            fail_msg("%s: %d", free_ones[i].name, status);
    }
}

// The filter also applies to a thread that started earlier.
static int go;
static void *try_later(void *user)
{
    while (!__atomic_load_n(&go, __ATOMIC_ACQUIRE))
        sched_yield();
    *(int *)user = inet_socket();
    return NULL;
}
static int older_thread(void)
{
    pthread_t thread;
    int error = 0;
    if (pthread_create(&thread, NULL, try_later, &error) != 0)
        return 251;
    enter(SANDBOX_DRAWS);
    __atomic_store_n(&go, 1, __ATOMIC_RELEASE);
    pthread_join(thread, NULL);
    return error;
}

TEST(test_threads)
{
    need_sandbox();
    static const struct attempt attempt = ATTEMPT(older_thread, ENOSYS);
    int status = status_of(&attempt, false, SANDBOX_DRAWS);
    assert_true(WIFEXITED(status));
    assert_int_equal(WEXITSTATUS(status), ENOSYS);
}

#if defined(__x86_64__)
// getpid() through the 32-bit interface, whose numbers mean other calls: the process ends, or the kernel does not
// support it.
static int call_of_32_bits(void)
{
    long result;
    __asm__ volatile("int $0x80" : "=a"(result) : "a"(20L) : "memory", "r8", "r9", "r10", "r11");
    return result == getpid() ? 0 : 251;
}

TEST(test_32_bits)
{
    need_sandbox();
    static const struct attempt attempt = ATTEMPT(call_of_32_bits, 0);
    int status = status_of(&attempt, true, SANDBOX_DRAWS);
    assert_true(WIFSIGNALED(status));
    assert_true(WTERMSIG(status) == SIGSYS || WTERMSIG(status) == SIGSEGV);
}
#endif

TEST(test_text)
{
    char text[SANDBOX_TEXT_SIZE];
    assert_string_equal(sandbox_text(&(struct sandbox_state){.landlock = 3, .filter = true}, text),
                        "Landlock 3 and seccomp");
    assert_string_equal(sandbox_text(&(struct sandbox_state){.filter = true, .reason = "no"}, text), "seccomp; no");
    assert_string_equal(sandbox_text(&(struct sandbox_state){.reason = "no"}, text), "off; no");
    assert_string_equal(
        sandbox_text(&(struct sandbox_state){.landlock = 3, .filter = true, .reads_everything = true}, text),
        "Landlock 3 and seccomp; a scene file may name files anywhere");
    assert_true(offered.reason || (offered.landlock && offered.filter));
}

FIXTURE(make_files, remove_files)
