// text_builder.c: implements a string that grows as text is added.
#include "text_builder.h"

#include "fail.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ASK_EVERY = 256 << 10 }; // number of added bytes after which the call is checked again

// Marks the text as failed and returns false if the call must stop.
static bool may_grow(struct text *text, size_t more)
{
    if (!text->call)
        return true;
    if (text->length - text->asked >= ASK_EVERY) {
        text->asked = text->length;
        text->failed = !call_should_continue(text->call) && !call_error(text->call, &text->error);
    }
    if (!text->failed && more && !call_charge(text->call, more))
        text->failed = !call_memory_error(text->call, more, &text->error);
    return !text->failed;
}

void text_add_part(struct text *text, const char *more, size_t length)
{
    bool grows = text->length + length + 1 > text->capacity;
    size_t capacity = grows ? 2 * (text->length + length + 1) : text->capacity;
    if (text->failed || !may_grow(text, capacity - text->capacity))
        return;
    if (grows) {
        char *grown = realloc(text->bytes, capacity);
        if (!grown) {
            text->failed = true;
            fail_memory(&text->error, capacity);
            return;
        }
        text->bytes = grown;
        text->capacity = capacity;
    }
    if (length) // memcpy must not receive NULL, even for 0 bytes
        memcpy(text->bytes + text->length, more, length);
    text->length += length;
    text->bytes[text->length] = 0;
}

void text_add(struct text *text, const char *more) { text_add_part(text, more, strlen(more)); }

void text_print(struct text *text, const char *format, ...)
{
    char line[512];
    va_list arguments;
    va_start(arguments, format);
    int length = vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    if (length >= 0 && length < (int)sizeof line) {
        text_add_part(text, line, (size_t)length);
    } else if (!text->failed) {
        text->failed = true;
        fail(&text->error, LAM_BAD_ARGUMENT, "a line of generated text is longer than %zu bytes: '%.40s…'",
             sizeof line - 1, line);
    }
}

int text_add_chunk(const char *more, size_t length, void *text)
{
    text_add_part(text, more, length);
    return ((const struct text *)text)->failed ? -1 : 0;
}
