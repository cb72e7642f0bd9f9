// diagnostics.h: what is told besides the pictures: the compiler's words, what they mean, names that are unknown.
#ifndef DIAGNOSTICS_H
#define DIAGNOSTICS_H

#include "arena.h"
#include "draw_request.h"
#include "shader_interface.h"

struct notes {
    struct arena *arena; // texts live here
    lam_check_note *items;
    int count;
    bool failed; // memory ran out
};

__attribute__((format(printf, 5, 6))) void notes_add(struct notes *notes, lam_check_note_kind kind, const char *file,
                                                     int line, const char *format, ...);

// The driver's log of a refused shader, line by line, and what its lines are known to mean.
void notes_of_refusal(struct notes *notes, const struct check_drawn *drawn, const struct reading *reading,
                      const lam_check_params *params);

// Names that the contract does not know, types that do not fit, in shaders that compile or not.
void notes_of_names(struct notes *notes, const struct check_drawn *drawn, const struct reading *reading,
                    const lam_check_params *params);

#endif
