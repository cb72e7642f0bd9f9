// interrupt.h: Ctrl-C and its kin raise a flag, so that a run ends cleanly and leaves nothing half done.
#ifndef INTERRUPT_H
#define INTERRUPT_H

#include <lambent/base.h>

// Catches SIGINT, SIGTERM and SIGHUP (where the caller does not ignore them). A second one ends the program
// at once.
void interrupt_start(void);

const lam_cancel *interrupt_flag(void);
bool interrupted(void);

// Ends the program by the signal that came, so that the caller sees what happened: a shell shows 130 for
// Ctrl-C and stops its loop.
void interrupt_finish(void) __attribute__((noreturn));

#endif
