// diagnostics.c: the list of messages in a report.
#include "diagnostics.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { MAX_DIAGNOSTICS = 64 };

void diagnostics_add(struct diagnostics *diagnostics, lam_check_diagnostic_kind kind, const char *file, int line,
                     const char *format, ...)
{
    char text[600];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    for (int i = 0; i < diagnostics->count; i++) // a duplicate
        if (diagnostics->items[i].line == line && strcmp(diagnostics->items[i].text, text) == 0)
            return;
    if (!diagnostics->items)
        diagnostics->items = arena_alloc(diagnostics->arena, MAX_DIAGNOSTICS * sizeof *diagnostics->items);
    char *kept = arena_string(diagnostics->arena, text);
    if (!diagnostics->items || !kept) {
        diagnostics->failed = true;
        return;
    }
    if (diagnostics->count < MAX_DIAGNOSTICS)
        diagnostics->items[diagnostics->count++] =
            (lam_check_diagnostic){.kind = kind, .file = file, .line = line, .text = kept};
}
