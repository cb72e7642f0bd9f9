// text_cursor.h: reads words, lines and names in text files.
#ifndef TEXT_CURSOR_H
#define TEXT_CURSOR_H

#include "arena.h"
#include "shown_name.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// Every byte with a code up to the code of the space is white space: tabs, form feeds and control characters separate
// words.
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

// Returns the position of the line's '\n' or '\r', or `end` if there is none.
static inline const uint8_t *text_line_end(const uint8_t *at, const uint8_t *end)
{
    while (at < end && *at != '\n' && *at != '\r')
        at++;
    return at;
}

// Returns the end of a name, without white space and a comment after it. '#' after white space begins a comment. At the
// beginning of a name it does so only if white space follows.
const uint8_t *text_name_end(const uint8_t *at, const uint8_t *end);

// Returns whether the word at `at` is `word` (lower case), ignoring case.
bool text_is_word(const uint8_t *at, const uint8_t *end, const char *word);

// Returns how often the word occurs in the text.
size_t text_count_word(const uint8_t *at, const uint8_t *end, const char *word);

// Returns the line number of `at`, from 1; lines end in "\n", "\r\n" or "\r". The function takes linear time, so use it
// only for messages.
size_t text_line(const uint8_t *bytes, const uint8_t *at);

// Formats the word at `at` for a message, in quotes and shortened by shown_name. Writes "white space" or "the end of
// the file" if there is no word. Returns `out`.
enum { TEXT_FOUND_SIZE = SHOWN_NAME_SIZE + 2 };
const char *text_found(const uint8_t *at, const uint8_t *end, char out[TEXT_FOUND_SIZE]);

// Copies a name to a UTF-8 string: invalid bytes become U+FFFD, and a zero byte ends the name. Returns NULL if memory runs
// out.
char *text_name(struct arena *arena, const uint8_t *at, size_t length);

#endif
