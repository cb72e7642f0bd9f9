// interrupt.h: signals such as Ctrl-C set a flag, so that a run stops cleanly and leaves no partial files; and processes that end with
// their parent.
#ifndef INTERRUPT_H
#define INTERRUPT_H

#include <lambent/base.h>
#include <sys/types.h>

// Catches SIGINT, SIGTERM and SIGHUP (unless the parent process ignores them). A second signal ends the program
// at once.
void interrupt_start(void);

const lam_cancel *interrupt_flag(void);
bool interrupted(void);

// Ends the program with the received signal, so that the parent process sees the cause: a shell shows 130 for Ctrl-C
// and stops its loop.
void interrupt_finish(void) __attribute__((noreturn));

// Called in a new process: kills it when the thread that started it ends. `parent`: the process of that thread.
void interrupt_with_parent(pid_t parent);

#endif
