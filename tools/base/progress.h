// progress.h: draws the progress bar on the terminal.
#ifndef PROGRESS_H
#define PROGRESS_H

#include <lambent/base.h>

struct progress {
    bool allowed; // standard error is a terminal, and --quiet is not given
    double start_ms, drawn_ms;
    double from, span; // the running call's part of the whole
    const char *model;
    bool shown;
    void (*show)(double share); // called in place of the bar, with the share of the whole; NULL: the bar
};

void progress_start(struct progress *progress, const char *model, bool allowed);

// Declares the next call to be this part of the whole, as fractions of 1. NULL: nobody watches.
void progress_phase(struct progress *progress, double from, double span);

// lam_control's callback; `user` is a struct progress.
void progress_update(void *user, double share, const char *step);

// Erases the bar.
void progress_end(struct progress *progress);

// Milliseconds since an arbitrary fixed time.
double clock_ms(void);

#endif
