// progress.h: a bar on the terminal for work that takes a while.
#ifndef PROGRESS_H
#define PROGRESS_H

#include <lambent/base.h>

struct progress {
    bool allowed; // standard error is a terminal and nobody asked for quiet
    double start_ms, drawn_ms;
    double from, span; // the part of the whole that the running call is
    const char *model;
    bool shown;
};

void progress_start(struct progress *progress, const char *model, bool allowed);

// The next call is this part of the whole, shares of 1.
void progress_phase(struct progress *progress, double from, double span);

// lam_control's callback; `user` is a struct progress.
void progress_tell(void *user, double share, const char *step);

// Takes the bar away again.
void progress_end(struct progress *progress);

// Milliseconds since some fixed moment.
double clock_ms(void);

#endif
