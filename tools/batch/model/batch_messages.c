// batch_messages.c: prints the messages of a batch.
#include "batch_work.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "console.h"
#include "progress.h"

static const double first_ms = 500, pause_ms = 100;

int batch_count_class(struct batch_tally *tally, const char *name)
{
    int i = 0;
    while (i < TALLY_CLASSES - 1 && tally->classes[i].name && strcmp(tally->classes[i].name, name) != 0)
        i++;
    tally->classes[i].name = name;
    tally->classes[i].count++;
    return i;
}

static size_t finished(const struct batch_tally *t)
{
    return t->written + t->failed - t->retried + t->same + t->before + t->failed_before;
}

// Formats a time as "0:07", "12:34" or "2:03:04".
static const char *clock_text(double seconds, char text[32])
{
    long s = seconds > 0 ? (long)(seconds + 0.5) : 0;
    if (s < 3600)
        snprintf(text, 32, "%ld:%02ld", s / 60, s % 60);
    else
        snprintf(text, 32, "%ld:%02ld:%02ld", s / 3600, s / 60 % 60, s % 60);
    return text;
}

void batch_show_progress(struct batch_tally *t)
{
    double now = clock_ms(), elapsed = now - t->start_ms;
    if (!t->has_progress || elapsed < first_ms || now - t->drawn_ms < pause_ms)
        return;
    size_t done = finished(t), drawn = t->written + t->failed;
    char left[32] = "?", failed[48] = "";
    if (drawn)
        clock_text(elapsed / 1e3 / (double)drawn * (double)(t->total - done), left);
    if (t->failed + t->failed_before)
        snprintf(failed, sizeof failed, "  %zu failed", t->failed + t->failed_before - t->retried);
    fprintf(stderr, "\r\033[K%s%zu of %zu%s  %d %%  %.3g a second  %s left%s", console_has_colors() ? "\033[36m" : "",
            done, t->total, console_has_colors() ? "\033[0m" : "", t->total ? (int)(100 * done / t->total) : 100,
            (double)drawn / (elapsed / 1e3), left, failed);
    fflush(stderr);
    t->drawn_ms = now;
    t->shown = true;
}

void batch_hide_progress(struct batch_tally *t)
{
    if (t->shown)
        fputs("\r\033[K", stderr);
    t->shown = false;
    t->drawn_ms = 0;
}

void batch_say_summary(const struct batch_tally *t, bool interrupted)
{
    double seconds = (clock_ms() - t->start_ms) / 1e3;
    char time[32];
    if (t->shard.count)
        say_plain("shard %d/%d: ", t->shard.number, t->shard.count);
    say_plain("%s%zu of %zu pictures written", interrupted ? "interrupted: " : "", t->written, t->total);
    if (t->same)
        say_plain(", %zu unchanged", t->same);
    if (t->before)
        say_plain(", %zu done before", t->before);
    if (t->cancelled)
        say_plain(", %zu cancelled", t->cancelled);
    size_t failed = t->failed + t->failed_before;
    if (failed)
        say_plain(", %zu failed", failed);
    const char *between = " (";
    for (int i = 0; i < TALLY_CLASSES; i++) {
        if (t->classes[i].count)
            say_plain("%s%s %zu", between, t->classes[i].name, t->classes[i].count);
        between = t->classes[i].count ? ", " : between;
    }
    if (between[0] == ',')
        say_plain(")");
    if (t->warnings)
        say_plain(", %zu warning%s", t->warnings, t->warnings == 1 ? "" : "s");
    if (seconds < 60)
        snprintf(time, sizeof time, "%.3g s", seconds);
    else
        clock_text(seconds, time);
    say_plain("; %s", time);
    if (t->written && seconds > 0)
        say_plain(", %.3g a second", (double)t->written / seconds);
    say_plain("\n");
}

static void print_text(const struct batch_text *text)
{
    if (text->err)
        fputs(text->err, stderr);
    if (text->out) {
        fputs(text->out, stdout);
        fflush(stdout); // shows each message immediately
    }
}

void batch_print(struct batch_texts *texts, size_t model, char *out, char *err, bool ok, struct batch_tally *tally)
{
    struct batch_text *text = &texts->list[model], again = {out, err, true};
    if (model < texts->next) { // a retry; the errors of the first attempt are already printed
        if (ok)
            print_text(&again);
        free(out);
        free(err);
        return;
    }
    *text = again;
    for (; texts->next < texts->count && texts->list[texts->next].ready; texts->next++) {
        text = &texts->list[texts->next];
        if ((text->out && *text->out) || (text->err && *text->err))
            batch_hide_progress(tally);
        print_text(text);
        free(text->out);
        free(text->err);
        *text = (struct batch_text){.ready = true};
    }
}

void batch_print_rest(struct batch_texts *texts, struct batch_tally *tally)
{
    batch_hide_progress(tally);
    for (size_t i = texts->next; texts->list && i < texts->count; i++) {
        print_text(&texts->list[i]);
        free(texts->list[i].out);
        free(texts->list[i].err);
    }
    free(texts->list);
    *texts = (struct batch_texts){0};
}
