// unsupported_formats.h: recognises unsupported formats by content or name, so that an error can name them.
#ifndef UNSUPPORTED_FORMATS_H
#define UNSUPPORTED_FORMATS_H

#include <stddef.h>
#include <stdint.h>

struct unsupported_format {
    const char *name;    // "a PNG picture"
    const char *instead; // the ending of a format that programs of this 3D format export; NULL: it is no 3D format
};

// NULL: not recognised.
const struct unsupported_format *unsupported_format_of(const uint8_t *bytes, size_t size);

// Returns the 3D format whose files have this ending (without its dot); NULL: not known.
const struct unsupported_format *unsupported_format_named(const char *ending);

#endif
