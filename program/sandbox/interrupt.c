// interrupt.c: sets a flag on signals such as Ctrl-C, so that a run stops cleanly and leaves no partial files.
#include "interrupt.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <unistd.h>

#include "writer.h"

static lam_cancel cancel;
static int caught; // accessed atomically: any thread may receive the signal

static void catch (int number)
{
    __atomic_store_n(&caught, number, __ATOMIC_RELAXED);
    lam_cancel_raise(&cancel);
}

void interrupt_start(void)
{
    static const int signals[] = {SIGINT, SIGTERM, SIGHUP};
    for (size_t i = 0; i < sizeof signals / sizeof signals[0]; i++) {
        struct sigaction old,
            action = {.sa_handler = catch, .sa_flags = (int)SA_RESETHAND}; // without SA_RESTART, a signal interrupts a
                                                                           // read
        sigemptyset(&action.sa_mask);
        if (sigaction(signals[i], NULL, &old) == 0 && old.sa_handler != SIG_IGN)
            sigaction(signals[i], &action, NULL);
    }
}

const lam_cancel *interrupt_flag(void) { return &cancel; }
bool interrupted(void) { return __atomic_load_n(&caught, __ATOMIC_RELAXED) != 0; }

void interrupt_finish(void)
{
    writer_end();
    fflush(stdout);
    signal(caught, SIG_DFL);
    raise(caught);
    _exit(128 + caught); // reached only if the signal is blocked
}

void interrupt_with_parent(pid_t parent)
{
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) // the parent ended before prctl, so no signal will come
        _exit(1);
}
