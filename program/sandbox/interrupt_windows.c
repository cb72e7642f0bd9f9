// interrupt_windows.c: sets a flag on Ctrl-C, so that a run stops cleanly and leaves no partial
// files. Windows calls the handler in a separate thread.
#include "interrupt.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>

#include "writer.h"

static lam_cancel cancel;
static volatile sig_atomic_t caught;

// A second Ctrl-C ends the program, because Windows removes the handler before calling it.
static void catch (int number)
{
    caught = number;
    lam_cancel_raise(&cancel);
}

void interrupt_start(void) { signal(SIGINT, catch); }

const lam_cancel *interrupt_flag(void) { return &cancel; }
bool interrupted(void) { return caught != 0; }

void interrupt_finish(void)
{
    writer_end();
    fflush(stdout);
    _exit(128 + caught);
}
