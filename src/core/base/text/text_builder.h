// text_builder.h: a string that grows as text is added.
#ifndef TEXT_BUILDER_H
#define TEXT_BUILDER_H

#include "call_control.h"

// A zeroed struct is empty. After a failure, further additions have no effect, and `error` contains the reason. The
// owner frees `bytes`.
struct text {
    char *bytes; // ends with 0; NULL if empty
    size_t length, capacity;
    bool failed;
    lam_error error;
    struct call_control *call; // the call whose memory limit includes the text; may be NULL
    size_t asked;              // the length at the last check
};

void text_add(struct text *text, const char *more);
void text_add_part(struct text *text, const char *more, size_t length);
int text_add_chunk(const char *more, size_t length, void *text); // for json_dump_callback; returns −1 after a failure
__attribute__((format(printf, 2, 3))) void text_print(struct text *text, const char *format, ...); // up to 511 bytes

#endif
