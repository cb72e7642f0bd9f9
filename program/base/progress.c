// progress.c: draws the progress bar on the terminal.
#include "progress.h"

#include <stdio.h>
#include <string.h>
#include <time.h>

#include "console.h"

// The bar appears after half a second and changes at most 20 times a second.
static const double first_ms = 500, pause_ms = 50;

enum { BAR = 24, NAME = 28 };

double clock_ms(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec * 1e3 + (double)t.tv_nsec * 1e-6;
}

void progress_start(struct progress *progress, const char *model, bool allowed)
{
    *progress = (struct progress){.allowed = allowed, .model = model, .start_ms = clock_ms(), .span = 1};
}

void progress_phase(struct progress *progress, double from, double span)
{
    if (!progress)
        return;
    progress->from = from;
    progress->span = span;
}

void progress_update(void *user, double share, const char *step)
{
    struct progress *progress = user;
    double now = clock_ms();
    if (progress->show && now - progress->drawn_ms >= pause_ms) {
        progress->drawn_ms = now;
        progress->show(progress->from + progress->span * share);
    }
    if (!progress->allowed || now - progress->start_ms < first_ms || now - progress->drawn_ms < pause_ms)
        return;
    progress->drawn_ms = now;
    progress->shown = true;
    share = progress->from + progress->span * share;
    int filled = share >= 1 ? BAR : share > 0 ? (int)(share * BAR) : 0;
    char bar[BAR + 1];
    memset(bar, '.', BAR);
    memset(bar, '#', (size_t)filled);
    bar[BAR] = 0;
    size_t length = strlen(progress->model);
    const char *color = console_has_colors() ? "\033[36m" : "", *plain = console_has_colors() ? "\033[0m" : "";
    fprintf(stderr, "\r\033[K%s%s  %s[%s]%s %3d %%  %s", length > NAME ? "..." : "",
            progress->model + (length > NAME ? length - NAME : 0), color, bar, plain,
            filled == BAR ? 100 : (int)(share * 100), step ? step : "");
    fflush(stderr);
}

void progress_end(struct progress *progress)
{
    if (progress->shown)
        fputs("\r\033[K", stderr);
    progress->shown = false;
}
