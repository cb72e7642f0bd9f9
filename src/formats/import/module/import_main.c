// import_main.c: the program lambent-import. It reads one file with a module, in a process of its own without any
// rights, so that a mistake in another project's reader can neither end nor control the program that wants the scene.
//
// Standard input is a struct import_request and the bytes of the file; standard output is a struct import_answer and
// the scene. The other process ends this one by closing its end of the standard input, which stays open until then.
#include "import_module.h"

#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "sandbox.h"

static FILE *out; // the pipe to the other process

// Sends the answer and ends the process.
static _Noreturn void answer(int result, const char *note, const struct import_scene *scene)
{
    static struct import_answer answer = {.version = IMPORT_MODULE_VERSION}; // static: there may be no memory
    const size_t json = scene ? (scene->json_size + 3) & ~(size_t)3 : 0, binary = scene ? scene->binary_size : 0;
    answer.size = scene ? 28 + (uint64_t)json + binary : 0;
    answer.unit_m = scene ? scene->unit_m : 0;
    struct rusage used;
    answer.memory = getrusage(RUSAGE_SELF, &used) == 0 ? (uint64_t)used.ru_maxrss * 1024 : 0;
    if (answer.size > UINT32_MAX) {
        answer.size = 0;
        result = IMPORT_NO_MEMORY;
    }
    answer.result = (uint32_t)result;
    snprintf(answer.note, sizeof answer.note, "%s", note);
    fwrite(&answer, sizeof answer, 1, out);
    if (answer.size) {
        const uint32_t head[5] = {0x46546c67, 2, (uint32_t)answer.size, (uint32_t)json, 0x4e4f534a};
        const uint32_t chunk[2] = {(uint32_t)binary, 0x004e4942};
        fwrite(head, sizeof head, 1, out);
        fwrite(scene->json, 1, scene->json_size, out);
        fwrite("   ", 1, json - scene->json_size, out);
        fwrite(chunk, sizeof chunk, 1, out);
        fwrite(scene->binary, 1, binary, out);
    }
    fflush(out);
    _exit(0);
}

static struct {
    uint8_t *bytes; // NULL before they have arrived
    size_t size;
} file;

// Replaces the C library's fopen in the libraries of the modules.
__attribute__((visibility("default"))) FILE *open_by_name(const char *name, const char *mode) __asm__("fopen");
FILE *open_by_name(const char *name, const char *mode)
{
    errno = ENOENT;
    return file.bytes && strcmp(name, IMPORT_FILE) == 0 ? fmemopen(file.bytes, file.size, mode) : NULL;
}

static void *end_with_parent(void *unused)
{
    struct pollfd wait = {.fd = STDIN_FILENO, .events = 0}; // a closed end is always reported
    (void)unused;
    poll(&wait, 1, -1); // no signal interrupts it
    _exit(1);
}

static const struct import_functions *open_module(const char *name, char note[IMPORT_NOTE_SIZE])
{
    char path[PATH_MAX + 64] = "";
    ssize_t length = readlink("/proc/self/exe", path, PATH_MAX);
    char *end = length > 0 ? strrchr(path, '/') : NULL;
    const struct import_functions *(*functions)(void) = NULL;
    if (end && !strchr(name, '/'))
        snprintf(end + 1, sizeof path - (size_t)(end + 1 - path), "lambent-%s.so", name);
    void *library = dlopen(path, RTLD_NOW | RTLD_LOCAL), *found = NULL;
    if (library)
        found = dlsym(library, "lambent_import_functions");
    memcpy(&functions, &found, sizeof found);
    const struct import_functions *module = functions ? functions() : NULL;
    snprintf(note, IMPORT_NOTE_SIZE, "%s", module ? "" : dlerror());
    return module;
}

// Drops every right that parsing does not need. Skips protections that the kernel lacks.
static void drop_rights(const struct import_request *request)
{
    const rlim_t size = request->memory < RLIM_INFINITY / 2 ? request->memory + (64 << 20) : RLIM_INFINITY;
    const struct rlimit memory = {size, size}, none = {0, 0}, time = {request->seconds, request->seconds + 1};
    setrlimit(RLIMIT_DATA, &memory); // without the code of libraries; the rest is for them and for stacks
    setrlimit(RLIMIT_CPU, &time);
    setrlimit(RLIMIT_CORE, &none);
    setrlimit(RLIMIT_FSIZE, &none);
    prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
    // Landlock without a rule: no file can be opened or run. The filter forbids this too.
    const uint64_t all_of_version_1 = (1 << 13) - 1;
    int rules = (int)syscall(444, &all_of_version_1, sizeof all_of_version_1, 0);
    if (rules >= 0)
        syscall(446, rules, 0);
    sandbox_filter_install(SANDBOX_NO_FILES, -1);
}

// Forks for each message until the other process has ended. Returns in the new processes, with their standard streams.
// This process has neither threads nor data.
static void serve(void)
{
    setsid(); // Ctrl-C reaches the other process alone
    for (pid_t process = 1; process;) {
        char byte;
        int files[2];
        union import_handles handles;
        struct iovec data = {&byte, 1};
        struct msghdr message = {
            .msg_iov = &data, .msg_iovlen = 1, .msg_control = &handles, .msg_controllen = sizeof handles};
        ssize_t size = recvmsg(STDIN_FILENO, &message, MSG_CMSG_CLOEXEC);
        const struct cmsghdr *head = size > 0 ? CMSG_FIRSTHDR(&message) : NULL;
        if (!head || head->cmsg_type != SCM_RIGHTS || head->cmsg_len != CMSG_LEN(sizeof files))
            _exit(0);
        memcpy(files, CMSG_DATA(head), sizeof files);
        process = fork();
        if (!process && (dup2(files[0], STDIN_FILENO) < 0 || dup2(files[1], STDOUT_FILENO) < 0))
            _exit(1);
        close(files[0]);
        close(files[1]);
    }
}

int main(int count, char **words)
{
    static char note[IMPORT_NOTE_SIZE];
    struct import_request request;
    struct import_scene scene = {0};
    pthread_t watcher;
    // The readers print to the standard streams, so the pipe moves away from there.
    int nothing = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (nothing < 0 || dup2(nothing, STDERR_FILENO) < 0)
        return 1;
    signal(SIGCHLD, SIG_IGN); // the system forgets processes that have ended
    if (count > 1 && strcmp(words[1], IMPORT_STARTER) == 0)
        serve();
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    int pipe = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, nothing);
    if (pipe < 0 || dup2(nothing, STDOUT_FILENO) < 0 || !(out = fdopen(pipe, "w")) ||
        fread(&request, sizeof request, 1, stdin) != 1)
        return 1;
#ifdef SYS_close_range
    syscall(SYS_close_range, pipe + 1, ~0U, 0);
#endif
    const struct import_functions *module = open_module(request.module, note);
    if (!module || module->version != IMPORT_MODULE_VERSION || request.version != IMPORT_MODULE_VERSION)
        answer(IMPORT_NO_MODULE, module ? "lambent-formats belongs to another version" : note, NULL);
    drop_rights(&request);
    file.size = request.size;
    file.bytes = file.size < SIZE_MAX - 64 ? calloc(1, file.size + 64) : NULL;
    if (!file.bytes || pthread_create(&watcher, NULL, end_with_parent, NULL) != 0)
        answer(IMPORT_NO_MEMORY, "", NULL);
    if (fread(file.bytes, 1, file.size, stdin) != file.size)
        return 1;
    int result = module->read(&request, file.bytes, &scene, note);
    answer(result, note, result == IMPORT_READ ? &scene : NULL);
}
