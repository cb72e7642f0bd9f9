// fail.c: fills a lam_error.
#include "fail.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

bool fail(lam_error *error, lam_code code, const char *format, ...)
{
    if (!error)
        return false;
    error->code = code;
    va_list arguments;
    va_start(arguments, format);
    int length = vsnprintf(error->text, sizeof error->text, format, arguments);
    va_end(arguments);
    if (length < 0)
        error->text[0] = 0;
    if (length >= (int)sizeof error->text) {
        size_t at = sizeof error->text - 4;
        while (at > 0 && ((unsigned char)error->text[at] & 0xc0) == 0x80) // do not cut a UTF-8 character
            at--;
        memcpy(error->text + at, "…", sizeof "…");
    }
    for (unsigned char *c = (unsigned char *)error->text; *c; c++)
        if (*c < 32 || *c == 127)
            *c = '?';
    return false;
}

bool fail_memory(lam_error *error, size_t bytes)
{
    return fail(error, LAM_MACHINE, "out of memory: %.1f MB more were needed", (double)bytes / 1e6);
}

bool reserved_words_are_zero(const char *what, const uint64_t *words, size_t count, lam_error *error)
{
    for (size_t i = 0; i < count; i++)
        if (words[i])
            return fail(error, LAM_BAD_ARGUMENT,
                        "%s: a field is set that Lambent " LAM_VERSION_TEXT
                        " does not know (reserved word %zu is not 0)",
                        what, i);
    return true;
}
