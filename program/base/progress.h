// progress.h: draws the progress bar on the terminal.
#ifndef PROGRESS_H
#define PROGRESS_H

#include <lambent/base.h>

struct progress {
    bool allowed; // standard error is a terminal, and --quiet is not set
    double start_ms, drawn_ms;
    double from, span; // start and length of the current call's section, as fractions of the bar
    const char *model;
    bool shown;
    void (*show)(double share); // receives the total fraction; if NULL, the bar is drawn
};

void progress_start(struct progress *progress, const char *model, bool allowed);

// Sets the section of the bar that the next call fills. Does nothing if `progress` is NULL.
void progress_phase(struct progress *progress, double from, double span);

// Implements the callback of lam_control; `user` is a struct progress.
void progress_update(void *user, double share, const char *step);

// Erases the bar.
void progress_end(struct progress *progress);

// Returns the milliseconds since an arbitrary fixed time.
double clock_ms(void);

#endif
