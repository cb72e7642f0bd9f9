// srgb.c: converts sRGB-encoded numbers to linear light, using only + − × ÷.
#include "srgb.h"

#include <string.h>

// Returns the fifth root by Newton's method. The first estimate, computed from the exponent divided by five, has an
// error of at most 6 %. Each step squares the error, so five steps reduce the error below the precision of a double.
static double fifth_root(double x)
{
    uint64_t bits;
    double root;
    memcpy(&bits, &x, sizeof bits);
    bits = bits / 5 + UINT64_C(0x3ff0000000000000) / 5 * 4;
    memcpy(&root, &bits, sizeof root);
    for (int i = 0; i < 5; i++) {
        double fourth = (root * root) * (root * root);
        root -= (root - x / fourth) / 5;
    }
    return root;
}

double srgb_linear(double encoded)
{
    if (!(encoded > 0))
        return 0;
    if (encoded <= 0.04045)
        return encoded / 12.92;
    double base = (encoded + 0.055) / 1.055, square = base * base;
    return square * fifth_root(square); // base^2.4
}

// Uses bisection, because the curve is monotonic.
uint8_t srgb_byte(double linear)
{
    int low = 0, high = 255;
    while (low < high) {
        int middle = (low + high) / 2;
        if (srgb_linear((middle + 0.5) / 255) < linear)
            low = middle + 1;
        else
            high = middle;
    }
    return (uint8_t)low;
}
