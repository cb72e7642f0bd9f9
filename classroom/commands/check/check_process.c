// check_process.c: runs the tested shaders in a separate process, another instance of this program. The process is
// stopped when it exceeds its time or memory limit. A crash is reported as a verdict.
//
// The time limit applies to the processor time of all threads, so that other load on the machine does not make a shader
// appear endless. The processor may be idle while a graphics card works, so the elapsed time is also limited, to
// WALL_TIMES times the limit of processor time.
#include "check.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/auxv.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "child.h"
#include "console.h"
#include "file_io.h"
#include "interrupt.h"

enum { MAX_BYTES = 1 << 30, READ_BYTES = 1 << 16, WALL_TIMES = 20 };
// Exit codes of the drawing process in addition to lam_code: the process ran out of memory, or the driver called
// exit().
enum { EXIT_MEMORY = 200, EXIT_DRIVER = 201 };

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define SANITIZED 1
#endif
#endif

// --- the drawing process

// Called if the driver aborts. Returns true if the process cannot allocate half of the memory limit. The process has
// then probably run out of memory.
static rlim_t memory_limit;
static bool is_out_of_memory(void)
{
    if (!memory_limit)
        return false;
    size_t size = (size_t)memory_limit / 2;
    // NOLINTNEXTLINE(bugprone-signal-handler,cert-sig30-c): a system call, and nothing else, in a process that ends
    void *more = mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (more == MAP_FAILED)
        return true;
    // NOLINTNEXTLINE(bugprone-signal-handler,cert-sig30-c): likewise
    munmap(more, size);
    return false;
}

#ifndef SANITIZED
static void on_crash(int number)
{
    if (is_out_of_memory())
        _exit(EXIT_MEMORY);
    signal(number, SIG_DFL);
    raise(number);
}
#endif

// The worker ends with _exit(), so only the driver can have called exit().
static void on_exit_of_driver(void) { _exit(is_out_of_memory() ? EXIT_MEMORY : EXIT_DRIVER); }

static uint64_t max_resident_bytes(void)
{
    struct rusage usage;
    return getrusage(RUSAGE_SELF, &usage) == 0 ? (uint64_t)usage.ru_maxrss * 1024 : 0;
}

// Exits as soon as the process exceeds its memory limit. The system reports the largest amount of memory that the
// process has ever used. This includes the time before exec(), when the process was a copy of the parent. If the parent
// is larger than the limit, the limit is therefore raised.
static void *watch_memory(void *unused)
{
    const struct timespec pause = {.tv_nsec = 2000000};
    const uint64_t inherited = max_resident_bytes(), limit = inherited > memory_limit ? inherited : memory_limit;
    while (max_resident_bytes() <= limit)
        nanosleep(&pause, NULL);
    _exit(EXIT_MEMORY);
    return unused;
}

// Sets two limits: on the memory in use, which a thread watches, and on allocations. The second limit includes a
// margin, because the stacks of the driver's threads need more allocated memory than they use.
static void bound_memory(const char *bytes)
{
    memory_limit = (rlim_t)strtoull(bytes, NULL, 10);
#ifndef SANITIZED // sanitizers allocate more than any limit
    const rlim_t margin = (rlim_t)512 << 20;
    setrlimit(RLIMIT_DATA, &(struct rlimit){memory_limit + margin, memory_limit + margin});
    static const int crashes[] = {SIGSEGV, SIGBUS, SIGABRT, SIGILL, SIGTRAP};
    for (size_t i = 0; i < sizeof crashes / sizeof *crashes; i++)
        signal(crashes[i], on_crash);
#endif
    atexit(on_exit_of_driver);
    pthread_t watch;
    if (pthread_create(&watch, NULL, watch_memory, NULL) == 0)
        pthread_detach(watch);
}

void check_worker(const char *memory)
{
    setrlimit(RLIMIT_CORE, &(struct rlimit){0, 0});
    bound_memory(memory);
    int answer = dup(STDOUT_FILENO), nowhere = open("/dev/null", O_WRONLY);
    if (answer < 0 || nowhere < 0 || dup2(nowhere, STDOUT_FILENO) < 0 || dup2(nowhere, STDERR_FILENO) < 0)
        _exit(LAM_LIMIT); // drivers print to both streams, so both are redirected
    struct child_bytes request = {0};
    lam_bytes drawn = {0};
    lam_error error = {0};
    enum child_read got = CHILD_READ;
    while (got == CHILD_READ)
        got = request.size <= MAX_BYTES ? child_read(STDIN_FILENO, &request, READ_BYTES) : CHILD_MEMORY;
    bool ok = got == CHILD_CLOSED || complain(&error, LAM_MACHINE, "out of memory");
    ok = ok && lam_check_draw(request.data, request.size, NULL, &drawn, &error);
    int code = ok ? 0 : (int)error.code;
    if (!write_all(answer, ok ? drawn.data : error.text, ok ? drawn.size : strlen(error.text)))
        code = LAM_CANNOT_WRITE;
    // The result has been sent, so crashes of the driver during exit do not matter.
    _exit(code);
}

// --- the waiting process

static double now_s(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

// Limits the processor time of the process. The system enforces this limit even if the parent process dies.
static void bound_time(double limit_s)
{
    rlim_t seconds = (rlim_t)limit_s + 2;
    setrlimit(RLIMIT_CPU, &(struct rlimit){seconds, seconds + 1});
}

// Returns the processor time of all threads, or 0 if the time is unknown.
static double processor_time_s(pid_t pid)
{
    clockid_t clock;
    struct timespec t;
    if (clock_getcpuclockid(pid, &clock) != 0 || clock_gettime(clock, &t) != 0)
        return 0;
    return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

// Replaces the process by a new instance of this program. If /proc is missing, starts the program from `path`.
static void become_worker(const char *memory, const char *path)
{
    execl("/proc/self/exe", "lambent-classroom", CHECK_WORKER, memory, (char *)NULL);
    execl(path, "lambent-classroom", CHECK_WORKER, memory, (char *)NULL);
}

// The arguments of the drawing process. The arguments are formatted before fork(). After fork() in a process with
// threads, the child may only make system calls.
struct worker {
    double time_limit_s;
    const char *path;
    char memory[32];
};

static void work(void *user, int from, int to)
{
    const struct worker *worker = user;
    bound_time(worker->time_limit_s);
    if (dup2(from, STDIN_FILENO) >= 0 && dup2(to, STDOUT_FILENO) >= 0)
        become_worker(worker->memory, worker->path);
    _exit(127);
}

static bool start(struct child *child, const struct check_process *how, lam_error *error)
{
    const char *path = (const char *)getauxval(AT_EXECFN);
    struct worker worker = {.time_limit_s = how->time_limit_s, .path = path ? path : "lambent-classroom"};
    snprintf(worker.memory, sizeof worker.memory, "%llu", (unsigned long long)how->memory_limit_bytes);
    if (!child_start(child, work, &worker))
        return complain(error, LAM_MACHINE, "cannot start the drawing process: %s", strerror(errno));
    fcntl(child->to, F_SETFL, O_NONBLOCK);
    fcntl(child->from, F_SETFL, O_NONBLOCK);
    return true;
}

// Sends as many bytes as the pipe accepts. If the pipe is closed at the other end, the process has died, and its exit
// status follows.
static void send_some(struct child *child, const lam_bytes *request, size_t *sent)
{
    ssize_t n = write(child->to, (const char *)request->data + *sent, request->size - *sent);
    if (n > 0)
        *sent += (size_t)n;
    if (*sent == request->size || (n < 0 && errno != EAGAIN && errno != EINTR))
        child_send_end(child);
}

lam_check_draw_status check_process(void *user, const lam_bytes *request, lam_bytes *drawn, lam_error *error)
{
    const struct check_process *how = user;
    struct child child;
    signal(SIGPIPE, SIG_IGN);
    if (!start(&child, how, error))
        return LAM_CHECK_DRAW_FAILED;
    double end = now_s() + WALL_TIMES * how->time_limit_s;
    size_t sent = 0;
    struct child_bytes answer = {0};
    bool open = true, late = false;
    while (open && !late && !interrupted()) {
        struct pollfd wait[2] = {{child.from, POLLIN, 0}, {child.to, POLLOUT, 0}};
        late = now_s() > end || processor_time_s(child.pid) > how->time_limit_s;
        if (late || poll(wait, child.to >= 0 ? 2 : 1, 50) <= 0)
            continue;
        if (child.to >= 0 && wait[1].revents)
            send_some(&child, request, &sent);
        if (wait[0].revents)
            open = answer.size <= MAX_BYTES && child_read(child.from, &answer, READ_BYTES) == CHILD_READ;
    }
    if (open)
        child_kill(&child);
    int status = child_wait(&child);
    *drawn = (lam_bytes){answer.data, answer.size};
    if (late || (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU))
        return LAM_CHECK_DRAW_TIMEOUT;
    if (interrupted()) {
        complain(error, LAM_CANCELLED, "interrupted");
        return LAM_CHECK_DRAW_FAILED;
    }
    if (WIFSIGNALED(status))
        return LAM_CHECK_DRAW_CRASHED;
    if (WEXITSTATUS(status) == 0)
        return LAM_CHECK_DRAW_DONE;
    if (WEXITSTATUS(status) == EXIT_MEMORY)
        return LAM_CHECK_DRAW_MEMORY;
    if (WEXITSTATUS(status) == 127) {
        complain(error, LAM_LIMIT,
                 "cannot start the drawing process: neither /proc/self/exe nor the program's own path can be executed");
        return LAM_CHECK_DRAW_FAILED;
    }
    if (WEXITSTATUS(status) > LAM_CANCELLED) // the driver called exit()
        return LAM_CHECK_DRAW_CRASHED;
    complain(error, (lam_code)WEXITSTATUS(status), "%.*s", (int)(drawn->size < 480 ? drawn->size : 480),
             drawn->data ? (const char *)drawn->data : "the drawing process failed");
    return LAM_CHECK_DRAW_FAILED;
}
