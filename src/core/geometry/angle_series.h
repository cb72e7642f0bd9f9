// angle_series.h: approximates the arctangent of a double or of lanes of doubles, for angle weights.
#ifndef ANGLE_SERIES_H
#define ANGLE_SERIES_H

// Computes atan t for t in 0…1 and z = t². The error is at most 3e-6 rad, which is accurate enough for a weight. The
// polynomial interpolates atan at the six Chebyshev nodes of z.
#define ANGLE_SERIES(t, z)                                                                                             \
    ((t) * (0.9999948346338877 +                                                                                       \
            (z) * (-0.33295711032247277 +                                                                              \
                   (z) * (0.1953465900279569 +                                                                         \
                          (z) * (-0.12044858521312099 + (z) * (0.05658998519974516 + (z) * -0.013130382075233026))))))

#endif
