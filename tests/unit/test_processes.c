// test_processes.c: a process ends with its parent, even if the parent ended before the process could request this.
#include "test.h"

#include <signal.h>
#include <sys/wait.h>

#include "interrupt.h"

// A grandchild that writes a byte for each time that it is still alive, until the pipe closes.
static void grandchild(pid_t parent, bool late, int answer)
{
    while (late && getppid() == parent)
        usleep(1000);
    interrupt_with_parent(parent);
    while (write(answer, "a", 1) == 1)
        usleep(1000);
    _exit(0);
}

// Starts both and returns the reading end of the pipe. The child lives until it is killed, or ends immediately
// (`late`).
static int start(bool late, pid_t *child)
{
    int pipes[2];
    assert_int_equal(pipe(pipes), 0);
    *child = fork();
    assert_true(*child >= 0);
    if (*child == 0) {
        pid_t parent = getpid();
        if (fork() == 0)
            grandchild(parent, late, pipes[1]);
        close(pipes[1]);
        while (!late)
            pause();
        _exit(0);
    }
    close(pipes[1]);
    return pipes[0];
}

TEST(killed_with_its_parent)
{
    pid_t child;
    char byte;
    int answers = start(false, &child);
    assert_int_equal(read(answers, &byte, 1), 1);
    kill(child, SIGKILL);
    waitpid(child, NULL, 0);
    alarm(20); // a process that stays would write forever
    while (read(answers, &byte, 1) > 0)
        continue;
    alarm(0);
    close(answers);
}

TEST(parent_that_has_ended_before)
{
    pid_t child;
    char byte;
    int answers = start(true, &child);
    waitpid(child, NULL, 0);
    assert_int_equal(read(answers, &byte, 1), 0); // the end: it has written nothing
    close(answers);
}
