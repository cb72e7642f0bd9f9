// netpbm.c: reads the text header of PPM and PFM.
#include "netpbm.h"

#include "fail.h"
#include "number.h"

static bool is_space(uint8_t c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

static const uint8_t *skip_space(const uint8_t *at, const uint8_t *end)
{
    while (at < end && (is_space(*at) || *at == '#')) {
        if (*at == '#')
            while (at < end && *at != '\n')
                at++;
        else
            at++;
    }
    return at;
}

bool netpbm_read_header(const struct picture_file *file, const char *title, struct netpbm_header *header,
                        lam_error *error)
{
    static const char *const words[3] = {"width", "height", "number after the height"};
    const uint8_t *bytes = file->bytes, *at = bytes + 2, *end = bytes + file->size;
    const char *name = file->name;
    double values[3];
    for (int i = 0; i < 3; i++) {
        const uint8_t *start = skip_space(at, end);
        at = start > at ? number_double(start, end, &values[i]) : NULL;
        if (!at || at == end || !is_space(*at))
            return fail(error, LAM_CANNOT_READ, "%s: byte %zu: no %s in the %s header", name, (size_t)(start - bytes),
                        words[i], title);
    }
    for (int i = 0; i < 2; i++) {
        if (values[i] > 65535)
            return fail(error, LAM_LIMIT, "%s: the %s header has a %s of %g, expected at most 65535", name, title,
                        words[i], values[i]);
        if (!(values[i] >= 1) || values[i] != (int)values[i])
            return fail(error, LAM_CANNOT_READ, "%s: the %s header has a %s of %g, expected 1 to 65535", name, title,
                        words[i], values[i]);
    }
    *header = (struct netpbm_header){(int)values[0], (int)values[1], values[2], (size_t)(at - bytes) + 1};
    return true;
}
