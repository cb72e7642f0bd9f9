// import_error.c: errors that name a line or a byte of the file.
#include "importer.h"

#include "fail.h"

#include <stdarg.h>
#include <stdio.h>

static bool fail_at(lam_error *error, const char *place, const char *format, va_list arguments)
{
    char sentence[sizeof error->text];
    vsnprintf(sentence, sizeof sentence, format, arguments);
    return fail(error, LAM_CANNOT_READ, "%s: %s", place, sentence);
}

bool fail_line(lam_error *error, const struct import_source *source, size_t line, const char *format, ...)
{
    if (!error)
        return false;
    char place[sizeof error->text];
    snprintf(place, sizeof place, "%s:%zu", source->name, line);
    va_list arguments;
    va_start(arguments, format);
    fail_at(error, place, format, arguments);
    va_end(arguments);
    return false;
}

bool fail_byte(lam_error *error, const struct import_source *source, size_t offset, const char *format, ...)
{
    if (!error)
        return false;
    char place[sizeof error->text];
    snprintf(place, sizeof place, "%s: byte %zu", source->name, offset);
    va_list arguments;
    va_start(arguments, format);
    fail_at(error, place, format, arguments);
    va_end(arguments);
    return false;
}
