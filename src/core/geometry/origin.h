// origin.h: decides, by the same rule for every format, whether a mesh needs an origin other than zero, and computes
// the origin.
//
// Positions are floats, with a relative precision of 2⁻²⁴. A model far from zero (for example in survey coordinates)
// would lose detail. Therefore a mesh has an `origin` in double, which is subtracted before positions are rounded to
// float. Readers of file formats with more precision than floats subtract the origin themselves. For all other files,
// scene_measure subtracts the origin from the floats. This subtraction is exact, and later calculations then lose no
// more detail.
#ifndef ORIGIN_H
#define ORIGIN_H

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

// An axis gets an origin if its largest coordinate exceeds the model's size (the longest side of its box) times this
// number. Below this ratio, rounding moves a point by less than a millionth of the size, and the coordinates of the
// file are kept.
#define ORIGIN_RATIO 16.0

// Computes the origin from the box of all coordinates, which must be finite. If an axis needs no origin, origin[axis]
// is 0. Otherwise, origin[axis] is the box's centre, rounded to a multiple of the largest power of two that does not
// exceed the model's size. Returns whether any axis needs an origin. Float coordinates are precise enough for this
// decision; for the origin itself, call the function again with doubles.
static inline bool origin_choose(const double minimum[3], const double maximum[3], double origin[3])
{
    // The size is halved, so that it does not overflow for a box from −1e308 to 1e308.
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
        // The power of two is the size with its mantissa bits cleared.
        uint64_t bits;
        double size = 2.0 * half_size, step;
        memcpy(&bits, &size, sizeof bits);
        bits &= UINT64_C(0x7ff0000000000000);
        memcpy(&step, &bits, sizeof step);
        // Adding and subtracting 1.5 · 2⁵² rounds numbers below 2⁵¹ to integers. Larger numbers are already integers.
        // `step` is 0 if the model's size is below the smallest normal double. `steps` is then set to a large number,
        // so that nothing is rounded.
        double steps = step > 0.0 ? middle / step : 0x1p52;
        if (steps > -0x1p51 && steps < 0x1p51)
            middle = ((steps + 0x1.8p52) - 0x1.8p52) * step;
        origin[axis] = middle;
    }
    return any;
}

#endif
