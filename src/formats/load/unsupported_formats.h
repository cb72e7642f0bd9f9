// unsupported_formats.h: recognises unsupported formats by content or name, so that an error can name them.
#ifndef UNSUPPORTED_FORMATS_H
#define UNSUPPORTED_FORMATS_H

#include <stddef.h>
#include <stdint.h>

struct unsupported_format {
    const char *name; // "a PNG picture"
    // The extension of a supported format to which the user can export the model; NULL if the file is not a 3D model.
    const char *instead;
};

// Returns NULL if the content is not recognised.
const struct unsupported_format *unsupported_format_of(const uint8_t *bytes, size_t size);

// Returns the 3D format with this file extension, or NULL if the extension is unknown. `ending` contains no dot.
const struct unsupported_format *unsupported_format_named(const char *ending);

#endif
