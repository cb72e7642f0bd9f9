// netpbm.h: reads the text header of PPM and PFM.
#ifndef NETPBM_H
#define NETPBM_H

#include "codec.h"

struct netpbm_header {
    int width, height; // 1 … 65535
    double last;       // PPM: the largest value; PFM: the scale, whose sign states the byte order
    size_t pixels;     // the offset of the pixels
};

// Reads the header of a file whose first two bytes have been checked. The header consists of the width, the height and
// one more number, followed by one white-space character. The numbers are separated by white space and by comments,
// from '#' to the end of the line. `title` is the format's name.
bool netpbm_read_header(const struct picture_file *file, const char *title, struct netpbm_header *header,
                        lam_error *error);

#endif
