// diagnostics.h: the messages of a report: the compiler's messages, hints, and unknown names.
#ifndef DIAGNOSTICS_H
#define DIAGNOSTICS_H

#include <lambent/check.h>

#include "arena.h"

struct diagnostics {
    struct arena *arena; // owns the strings
    lam_check_diagnostic *items;
    int count;
    bool failed; // out of memory
};

// Adds a message. Ignores repeated messages, and messages beyond a fixed count.
__attribute__((format(printf, 5, 6))) void diagnostics_add(struct diagnostics *diagnostics,
                                                           lam_check_diagnostic_kind kind, const char *file, int line,
                                                           const char *format, ...);

#endif
