// fail.c: fills a lam_error.
#include "fail.h"

#include <lambent/text.h>

#include <stdarg.h>
#include <stdio.h>

bool fail(lam_error *error, lam_code code, const char *format, ...)
{
    if (!error)
        return false;
    error->code = code;
    va_list arguments;
    va_start(arguments, format);
    char sentence[2 * sizeof error->text];
    if (vsnprintf(sentence, sizeof sentence, format, arguments) < 0)
        sentence[0] = 0;
    va_end(arguments);
    lam_utf8_show(sentence, error->text, sizeof error->text);
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
