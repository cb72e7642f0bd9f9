// origin.h: decides whether a mesh gets an origin other than zero, and computes it, by one rule for every format.
//
// Positions are floats, good to 2⁻²⁴ of their size. A part that lies far from zero (survey coordinates, a car in its
// factory) would lose its detail, so a mesh carries an `origin` in double, and its positions are rounded to float after
// the origin was subtracted. Readers of files with more precision than floats do so themselves. For all others
// scene_measure subtracts it from the floats, which is exact: the drawing then has the detail of the floats, and its
// arithmetic loses no more of it.
#ifndef ORIGIN_H
#define ORIGIN_H

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

// An axis gets an origin when its largest coordinate is more than this many times the model's size (the longest side of
// its box): below, rounding moves a point by less than a millionth of that size, and the numbers stay the file's own.
#define ORIGIN_RATIO 16.0

// Works out the origin from the box of all coordinates, which must be finite: on each axis 0 when none is needed, else
// the box's middle, rounded to a multiple of the largest power of two that is not above the model's size, so that it
// is a short number. Returns whether any axis needs one. Values rounded to float will do for the question itself; then
// call again with doubles for the origin.
static inline bool origin_choose(const double minimum[3], const double maximum[3], double origin[3])
{
    // Halves, so that the size of a box from −1e308 to 1e308 does not overflow.
    double half_size = 0.0;
    for (int axis = 0; axis < 3; axis++) {
        double half = 0.5 * maximum[axis] - 0.5 * minimum[axis];
        if (half > half_size)
            half_size = half;
    }

    bool any = false;
    for (int axis = 0; axis < 3; axis++) {
        double lowest = minimum[axis], highest = maximum[axis];
        double max_distance = highest > -lowest ? highest : -lowest; // max |coordinate|, since lowest ≤ highest
        origin[axis] = 0.0;
        if (!(0.5 * max_distance > ORIGIN_RATIO * half_size))
            continue;
        any = true;
        double middle = 0.5 * lowest + 0.5 * highest;
        // The power of two: the size with its mantissa cleared.
        uint64_t bits;
        double size = 2.0 * half_size, step;
        memcpy(&bits, &size, sizeof bits);
        bits &= UINT64_C(0x7ff0000000000000);
        memcpy(&step, &bits, sizeof step);
        // Adding and subtracting 1.5 · 2⁵² rounds to a whole number below 2⁵¹; from there on the middle is one already,
        // as it is for a model without size, or one smaller than the smallest normal double.
        double steps = step > 0.0 ? middle / step : 0x1p52;
        if (steps > -0x1p51 && steps < 0x1p51)
            middle = ((steps + 0x1.8p52) - 0x1.8p52) * step;
        origin[axis] = middle;
    }
    return any;
}

#endif
