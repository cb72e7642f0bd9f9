// text_cursor.h: words and places in text files: keywords, names, what to show in a message.
#ifndef TEXT_CURSOR_H
#define TEXT_CURSOR_H

#include "arena.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// Everything up to the space counts as white, so that tabs, form feeds and stray control characters all
// separate words.
static inline bool text_white(uint8_t c) { return c <= ' '; }

static inline const uint8_t *text_skip_white(const uint8_t *at, const uint8_t *end)
{
    while (at < end && text_white(*at))
        at++;
    return at;
}

static inline const uint8_t *text_skip_word(const uint8_t *at, const uint8_t *end)
{
    while (at < end && !text_white(*at))
        at++;
    return at;
}

// The end of the line: at its '\n' or '\r', or `end`.
static inline const uint8_t *text_line_end(const uint8_t *at, const uint8_t *end)
{
    while (at < end && *at != '\n' && *at != '\r')
        at++;
    return at;
}

// Whether `at` begins with the word (given in lower case), in any case, followed by white space or the end.
bool text_is_word(const uint8_t *at, const uint8_t *end, const char *word);

// How often that word stands in the text, between white space.
size_t text_count_word(const uint8_t *at, const uint8_t *end, const char *word);

// The number, from 1, of the line that holds `at`; lines end in "\n", "\r\n" or "\r". Takes a pass: for
// messages only.
size_t text_line(const uint8_t *bytes, const uint8_t *at);

// What stands at `at`, for a message: the word in quotes, cut to 32 bytes, or "the end of the file". Returns `out`.
enum { TEXT_FOUND_SIZE = 48 };
const char *text_found(const uint8_t *at, const uint8_t *end, char out[TEXT_FOUND_SIZE]);

// A name from a file as a UTF-8 string: bytes that are not UTF-8, and control characters, become '?'. NULL:
// no memory.
char *text_name(struct arena *arena, const uint8_t *at, size_t length);

#endif
