// interrupt.h: sets a flag on signals such as Ctrl-C, so that a run stops cleanly and leaves no partial files. Also
// ends child processes when their parent ends.
#ifndef INTERRUPT_H
#define INTERRUPT_H

#include <lambent/base.h>
#include <sys/types.h>

// Handles SIGINT, SIGTERM and SIGHUP unless the parent process ignores them. A second signal ends the program
// immediately.
void interrupt_start(void);

const lam_cancel *interrupt_flag(void);
bool interrupted(void);

// Writes pending output and ends the program with the received signal, so that the parent process sees the cause. For
// example, after Ctrl-C a shell reports 130 and ends the loop that called the program.
void interrupt_finish(void) __attribute__((noreturn));

// Must be called in a new process, with the ID of the parent process. When the thread that started the new process
// ends, the system kills the new process.
void interrupt_with_parent(pid_t parent);

#endif
