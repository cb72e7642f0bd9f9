// shown_name.c: shortens names from files for messages.
#include "shown_name.h"

#include <lambent/base.h>

#include <string.h>

// Detects the control characters U+0000 … U+001F and U+007F … U+009F; some terminals interpret the latter too.
static bool is_control(const unsigned char *at, int length)
{
    return length == 1 ? *at < 0x20 || *at == 0x7f : length == 2 && at[0] == 0xc2 && at[1] < 0xa0;
}

const char *shown_name_of(const void *bytes, size_t length, char out[SHOWN_NAME_SIZE])
{
    const unsigned char *at = bytes, *end = at + length;
    char *to = out;
    for (int count = 0; at < end; count++) {
        if (count == SHOWN_CHARACTERS) {
            memcpy(to, "…", sizeof "…");
            return out;
        }
        int step = lam_utf8_length(at, (size_t)(end - at));
        if (step == 0 || is_control(at, step)) {
            *to++ = '?';
            at += step ? step : 1;
        } else {
            memcpy(to, at, (size_t)step);
            to += step;
            at += step;
        }
    }
    *to = 0;
    return out;
}

const char *shown_name(const char *name, char out[SHOWN_NAME_SIZE]) { return shown_name_of(name, strlen(name), out); }
