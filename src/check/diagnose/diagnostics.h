// diagnostics.h: what is told besides the pictures: the compiler's words, what they mean, names that are unknown.
#ifndef DIAGNOSTICS_H
#define DIAGNOSTICS_H

#include "arena.h"
#include "draw_request.h"
#include "shader_interface.h"

struct diagnostics {
    struct arena *arena; // texts live here
    lam_check_note *items;
    int count;
    bool failed; // memory ran out
};

__attribute__((format(printf, 5, 6))) void diagnostics_add(struct diagnostics *notes, lam_check_note_kind kind,
                                                           const char *file, int line, const char *format, ...);

// The driver's log of a refused shader, line by line, and what its lines are known to mean.
void diagnostics_of_refusal(struct diagnostics *notes, const struct check_drawn *drawn,
                            const struct shader_interface *reading, const lam_check_params *params);

// Names that the contract does not know, types that do not fit, in shaders that compile or not.
void diagnostics_of_names(struct diagnostics *notes, const struct check_drawn *drawn,
                          const struct shader_interface *reading, const lam_check_params *params);

#endif
