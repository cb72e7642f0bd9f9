// classroom.c: starts the program lambent-classroom, which is installed beside this program.
#include "classroom.h"

#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "console.h"
#include "failure.h"
#include "file_io.h"
#include "output.h"

enum { READ_BYTES = 1 << 16, NOT_STARTED = 127, PATH_SIZE = PATH_MAX + 100 };

// Finds the program in folders relative to the folder of this program. The current folder and PATH are not searched,
// because they may contain other people's programs.
static bool find(const struct options *options, char path[PATH_SIZE], lam_error *error)
{
    static const char *const folders[] = {"", "../" LAMBENT_LIBEXECDIR "/lambent/"};
    char own[PATH_MAX];
    bool known = own_folder(own);
    for (size_t i = 0; known && i < sizeof folders / sizeof *folders; i++) {
        snprintf(path, PATH_SIZE, "%s%s" CLASSROOM_PROGRAM, own, folders[i]);
        if (access(path, X_OK) == 0) {
            options->line[0] = (char *)CLASSROOM_PROGRAM;
            return true;
        }
    }
    return complain(error, LAM_UNSUPPORTED,
                    "this needs the program " CLASSROOM_PROGRAM ", which is missing in %.300s; install the package "
                    "lambent-classroom",
                    known ? own : "this program's folder, which is unknown without /proc");
}

int classroom_run(int operand_count, char **operands, const struct options *options)
{
    char path[PATH_SIZE];
    lam_error error = {0};
    if (operand_count && is_model_name(operands[0]) &&
        !complain(&error, LAM_BAD_ARGUMENT,
                  "%.300s is a model, and the command checks or plots shading; lambent info --print MODEL checks a "
                  "model for 3D "
                  "printing",
                  operands[0]))
        return report_failure(&error, options);
    if (find(options, path, &error)) {
        fflush(stdout);
        execv(path, options->line);
        complain(&error, LAM_UNSUPPORTED, "%.300s cannot be started: %s", path, strerror(errno));
    }
    return report_failure(&error, options);
}

// --- the figure

struct start {
    char path[PATH_SIZE];
    char **line;
};

static void become_classroom(void *user, int from, int to)
{
    const struct start *start = user;
    if (dup2(from, STDIN_FILENO) >= 0 && dup2(to, STDOUT_FILENO) >= 0)
        execv(start->path, start->line);
    _exit(NOT_STARTED);
}

bool classroom_start(struct child *child, const struct options *options, lam_error *error)
{
    struct start start = {.line = options->line};
    return find(options, start.path, error) &&
           (child_start(child, become_classroom, &start) ||
            complain(error, LAM_MACHINE, "cannot start " CLASSROOM_PROGRAM ": %s", strerror(errno)));
}

bool classroom_ask(struct child *child, const struct options *options, const lam_bytes *request, lam_bytes *answer,
                   lam_error *error)
{
    (void)options;
    struct child_bytes got = {0};
    enum child_read state = CHILD_READ;
    void (*before)(int) = signal(SIGPIPE, SIG_IGN); // a process that has ended is reported by its status
    write_all(child->to, request->data, request->size);
    signal(SIGPIPE, before);
    child_send_end(child); // the process answers when the request is complete
    while (state == CHILD_READ)
        state = child_read(child->from, &got, READ_BYTES);
    int status = child_wait(child);
    *answer = (lam_bytes){got.data, got.size};
    if (state == CHILD_CLOSED && WIFEXITED(status) && WEXITSTATUS(status) == 0)
        return true;
    if (state == CHILD_MEMORY)
        complain(error, LAM_MACHINE, "out of memory");
    else if (WIFEXITED(status) && WEXITSTATUS(status) <= LAM_MACHINE)
        complain(error, (lam_code)WEXITSTATUS(status), "%.*s", (int)(got.size < 480 ? got.size : 480), got.data);
    else
        complain(error, LAM_MACHINE, CLASSROOM_PROGRAM " has ended without a figure");
    lam_bytes_free(answer);
    return false;
}

void classroom_end(struct child *child)
{
    if (child->to >= 0)
        child_wait(child); // without a request, the process ends
}
