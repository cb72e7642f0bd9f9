// classroom.h: starts the program lambent-classroom, which contains the commands for teaching.
#ifndef CLASSROOM_H
#define CLASSROOM_H

#include <lambent/image.h>

#include "child.h"
#include "command_table.h"

#define CLASSROOM_PROGRAM "lambent-classroom"

// Replaces this process by lambent-classroom with the same command line. Must be called before a sandbox is entered.
// Returns an exit code if the program cannot be started, or if this program contains it (static builds).
command_fn classroom_run;

// Starts a process of lambent-classroom that draws the figure of `explain`. Must be called before a sandbox is entered.
// Fails with LAM_UNSUPPORTED if lambent-classroom is missing.
bool classroom_start(struct child *child, const struct options *options, lam_error *error);

// Sends the request for a figure to the process, and waits for the answer, which the caller frees.
bool classroom_ask(struct child *child, const struct options *options, const lam_bytes *request, lam_bytes *answer,
                   lam_error *error);

// Ends the process, if one was started.
void classroom_end(struct child *child);

#endif
