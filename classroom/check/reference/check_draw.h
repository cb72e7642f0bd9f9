// check_draw.h: draws the pictures of a request with any painter.
#ifndef CHECK_DRAW_H
#define CHECK_DRAW_H

#include <lambent/check.h>

// Implements lam_check_draw.
bool check_draw(const void *request, size_t size, const lam_check_painter *painter, lam_bytes *out, lam_error *error);

#endif
