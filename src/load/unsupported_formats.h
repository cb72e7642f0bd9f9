// unsupported_formats.h: kinds of files that are recognised by content, so that an error can name them.
#ifndef UNSUPPORTED_FORMATS_H
#define UNSUPPORTED_FORMATS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct unsupported_format {
    const char *name; // "a PNG picture"
    bool is_model;    // a 3D format
};

// NULL: not recognised.
const struct unsupported_format *unsupported_format_of(const uint8_t *bytes, size_t size);

#endif
