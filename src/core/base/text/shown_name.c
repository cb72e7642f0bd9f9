// shown_name.c: shortens names from files for messages.
#include "shown_name.h"

#include <lambent/text.h>

#include <string.h>

static const unsigned char *next_character(const unsigned char *at, const unsigned char *end)
{
    int step = lam_utf8_length(at, (size_t)(end - at));
    return at + (step ? step : 1);
}

// Writes at most `limit` characters, and a final 0. Returns the address of the first byte that was not written. *to
// receives the address of the final 0.
static const unsigned char *write_characters(const unsigned char *at, const unsigned char *end, int limit, char **to)
{
    for (int count = 0; at < end && count < limit; count++) {
        int step = lam_utf8_length(at, (size_t)(end - at));
        uint32_t hidden = lam_utf8_hidden(at, (size_t)(end - at));
        if (hidden && (hidden < 0xa0 || hidden == 0xfffd)) { // lam_utf8_show replaces the others
            *(*to)++ = '?';
        } else {
            memcpy(*to, at, (size_t)step);
            *to += step;
        }
        at = next_character(at, end);
    }
    **to = 0;
    return at;
}

const char *shown_name_of(const void *bytes, size_t length, char out[SHOWN_NAME_SIZE])
{
    const unsigned char *at = bytes, *end = at + length;
    char *to = out;
    if (write_characters(at, end, SHOWN_CHARACTERS, &to) < end)
        memcpy(to, "…", sizeof "…");
    return out;
}

const char *shown_name(const char *name, char out[SHOWN_NAME_SIZE]) { return shown_name_of(name, strlen(name), out); }

const char *shown_file(const char *name, char out[SHOWN_NAME_SIZE])
{
    const unsigned char *at = (const unsigned char *)name, *end = at + strlen(name), *rest;
    char *to = out;
    if (write_characters(at, end, SHOWN_CHARACTERS, &to) == end)
        return out;
    to = out;
    rest = write_characters(at, end, SHOWN_FILE_HEAD, &to);
    memcpy(to, "…", sizeof "…");
    to += sizeof "…" - 1;
    const unsigned char *ahead = rest; // `ahead` is ahead of `rest` by the number of characters to show at the end
    for (int i = SHOWN_FILE_HEAD; i < SHOWN_CHARACTERS; i++)
        ahead = next_character(ahead, end);
    for (; ahead < end; ahead = next_character(ahead, end))
        rest = next_character(rest, end);
    write_characters(rest, end, SHOWN_CHARACTERS, &to);
    return out;
}
