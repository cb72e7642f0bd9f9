// exact_cover.h: computes the coverage of a triangle in integers, for tests of coverage.
#ifndef EXACT_COVER_H
#define EXACT_COVER_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

// Twice the signed area of (a, b, p), in squares of 1/256 pixel, y down.
static inline int64_t exact_area(const int64_t a[2], const int64_t b[2], const int64_t p[2])
{
    return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
}

// Whether the triangle of these three corners (x, y in pixels, depth) covers a point, in 1/256 pixel, by the top-left rule, and
// the depth there.
static inline bool exact_cover(const double *corners, const int64_t p[2], double *depth)
{
    int64_t v[3][2];
    for (int k = 0; k < 3; k++)
        for (int a = 0; a < 2; a++)
            v[k][a] = (int64_t)floor(corners[3 * k + a] * 256 + 0.5);
    for (int a = 0; a < 2; a++)
        if ((p[a] < v[0][a] && p[a] < v[1][a] && p[a] < v[2][a]) ||
            (p[a] > v[0][a] && p[a] > v[1][a] && p[a] > v[2][a]))
            return false;
    int64_t area = exact_area(v[0], v[1], v[2]);
    if (area == 0)
        return false;
    double sum = 0;
    *depth = 0;
    for (int k = 0; k < 3; k++) {
        const int64_t *a = v[(k + 1) % 3], *b = v[(k + 2) % 3];
        int64_t e = area < 0 ? -exact_area(a, b, p) : exact_area(a, b, p);
        int64_t dx = area > 0 ? b[0] - a[0] : a[0] - b[0], dy = area > 0 ? b[1] - a[1] : a[1] - b[1];
        bool top_or_left = dy < 0 || (dy == 0 && dx > 0);
        if (e < 0 || (e == 0 && !top_or_left))
            return false;
        *depth += (double)e * corners[3 * k + 2];
        sum += (double)e;
    }
    *depth /= sum;
    return true;
}

#endif
