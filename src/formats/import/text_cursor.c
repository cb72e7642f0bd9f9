// text_cursor.c: reads words, lines and names in text files.
#include "text_cursor.h"

#include <stdio.h>
#include <string.h>

bool text_is_word(const uint8_t *at, const uint8_t *end, const char *word)
{
    for (; *word; word++, at++) {
        if (at == end || (uint8_t)((unsigned)(*at - 'A') < 26 ? *at + 'a' - 'A' : *at) != (uint8_t)*word)
            return false;
    }
    return at == end || text_white(*at);
}

size_t text_count_word(const uint8_t *at, const uint8_t *end, const char *word)
{
    size_t count = 0;
    bool white = true; // whether white space precedes `at`
    for (; at < end; at++) {
        if (white && (*at | 0x20) == (uint8_t)word[0] && text_is_word(at, end, word))
            count++;
        white = text_white(*at);
    }
    return count;
}

size_t text_line(const uint8_t *bytes, const uint8_t *at)
{
    size_t line = 1;
    for (; bytes < at; bytes++)
        line += *bytes == '\n' || (*bytes == '\r' && bytes[1] != '\n');
    return line;
}

const char *text_found(const uint8_t *at, const uint8_t *end, char out[TEXT_FOUND_SIZE])
{
    // Examines more bytes than a message shows, so that shown_name_of can shorten the word.
    const uint8_t *near = end - at < SHOWN_NAME_SIZE ? end : at + SHOWN_NAME_SIZE, *stop = text_skip_word(at, near);
    char shown[SHOWN_NAME_SIZE];
    if (stop > at)
        snprintf(out, TEXT_FOUND_SIZE, "'%s'", shown_name_of(at, (size_t)(stop - at), shown));
    else
        snprintf(out, TEXT_FOUND_SIZE, "%s", at < end ? "white space" : "the end of the file");
    return out;
}

char *text_name(struct arena *arena, const uint8_t *at, size_t length)
{
    length = strnlen((const char *)at, length);
    char *name = arena_alloc(arena, 3 * length + 1), *to = name;
    for (size_t i = 0; name && i < length;) {
        int step = lam_utf8_length(at + i, length - i);
        memcpy(to, step ? (const char *)at + i : "\xef\xbf\xbd", step ? (size_t)step : 3);
        to += step ? step : 3;
        i += step ? (size_t)step : 1;
    }
    if (name)
        *to = 0;
    return name;
}

const uint8_t *text_name_end(const uint8_t *at, const uint8_t *end)
{
    for (const uint8_t *c = at; c < end; c++)
        if (*c == '#' && (c > at ? text_white(c[-1]) : c + 1 == end || text_white(c[1])))
            end = c;
    while (end > at && text_white(end[-1]))
        end--;
    return end;
}
