// importer.c: reads a whole source, and reports errors that name a line or a byte of the file.
#include "importer.h"

#include "fail.h"

#include <stdarg.h>
#include <stdio.h>

bool import_whole(struct import_source *source, lam_error *error)
{
    struct file_bytes whole;
    if (source->size == source->parts.size)
        return true;
    if (!file_read_rest(&source->parts, source->name, 0, source->pool, source->call, &whole, error))
        return false;
    file_release(source->file);
    *source->file = whole;
    source->bytes = source->parts.memory = whole.data;
    source->size = whole.size;
    return true;
}

static void fail_at(lam_error *error, const struct import_source *source, const char *kind, size_t position,
                    const char *format, va_list arguments)
{
    char sentence[sizeof error->text];
    vsnprintf(sentence, sizeof sentence, format, arguments);
    fail(error, LAM_CANNOT_READ, "%s:%s%zu: %s", source->name, kind, position, sentence);
}

bool fail_line(lam_error *error, const struct import_source *source, size_t line, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    if (error)
        fail_at(error, source, "", line, format, arguments);
    va_end(arguments);
    return false;
}

bool fail_byte(lam_error *error, const struct import_source *source, size_t offset, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    if (error)
        fail_at(error, source, " byte ", offset, format, arguments);
    va_end(arguments);
    return false;
}
