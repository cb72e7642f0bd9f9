// functions.h: powers, logarithms and inverse square roots, many at a time, bit-identical on every machine.
//
// The functions use only + − × and integer operations on the bits (lanes.h), without libm, tables or divisions. Each
// function's comment states its range and its error; tests/lighting/test_functions.c measures both. A function never
// returns NaN, unless the function's comment states otherwise.
#ifndef FUNCTIONS_H
#define FUNCTIONS_H

#include "lanes.h"

#define SMALLEST_NORMAL 1.17549435e-38f // = 2⁻¹²⁶

// Splits normal x > 0 exactly into 2^exponent · (1 + rest) with |rest| ≤ 1/3.
struct binary_parts {
    num exponent, rest;
};

LANE_FN struct binary_parts binary_parts_of(num x)
{
    inum above = wrap_sub(bits_of(x), inum_of(0x3f2aaaab));  // bits of 2/3
    inum mantissa = wrap_sub(bits_of(x), above & -0x800000); // without the bits of the exponent
    return (struct binary_parts){num_of_int(shift_right(above, 23)), num_of_bits(mantissa) - 1.0f};
}

// Computes log₂(1 + z) − 1.5·z for |z| ≤ 1/3 by a minimax polynomial with an error of 1.2e-9 before rounding. The
// result is at most 0.085, and 1.5·z is exact in a float, so the result and 1.5·z together are more precise than one
// float.
LANE_FN num log2_remainder(num z)
{
    num z2 = z * z, z4 = z2 * z2;
    num a = (z * -7.2134763e-1f - 5.7304937e-2f) + z2 * (z * -3.6066076e-1f + 4.8089349e-1f);
    num b = (z * -2.4091921e-1f + 2.8879759e-1f) + z2 * (z * -1.7290363e-1f + 2.0072298e-1f);
    num c = z * -1.9656924e-1f + 2.0720493e-1f;
    return z * (a + z4 * (b + z4 * c));
}

// Computes 2^f for |f| ≤ 0.5005 with a relative error of 1e-7 before rounding. The result is exactly 1 at 0.
LANE_FN num exp2_fraction(num f)
{
    num f2 = f * f;
    return (f * 6.9314700e-1f + 1.0f) +
           f2 * ((f * 5.5507299e-2f + 2.4022247e-1f) + f2 * (f * 1.3265090e-3f + 9.6713379e-3f));
}

// Computes a whole number n near y, and 2^n. Adding 1.5·2²³ + 127 rounds y to an integer and stores n + 127, the
// exponent field of a float, in the lowest bits. The result is meaningless but harmless for |y| > 126.
struct whole_power {
    num whole, power;
};

LANE_FN struct whole_power whole_power_of(num y)
{
    num shifted = y + 12583039.0f;
    return (struct whole_power){shifted - 12583039.0f, num_of_bits(shift_left(bits_of(shifted), 23))};
}

// Computes log₂ x within 1.2e-7 absolute and 2e-7 relative. The result is −126 for x below the smallest normal number
// and for NaN.
LANE_FN num log2_of(num x)
{
    struct binary_parts b = binary_parts_of(max_of(x, num_of(SMALLEST_NORMAL)));
    return b.exponent + (1.5f * b.rest + log2_remainder(b.rest));
}

// Computes 2^y with a relative error of at most 2.5e-7. The result is 0 for y below −126 and for NaN; y above 127.5 is
// treated as 127.5.
LANE_FN num exp2_of(num y)
{
    num x = min_of(y, num_of(127.5f));
    struct whole_power w = whole_power_of(min_of(x, num_of(127.0f)));
    return pick(y >= -126.0f, exp2_fraction(x - w.whole) * w.power, num_of(0.0f));
}

// Computes y = exponent · log₂ base as head + tail, for a normal base > 0 that is already split. A power needs y with
// an error of at most 2e-6 for y up to 126, and a float lacks two bits for this. Therefore the logarithm and the
// exponent are each split into a head of 12 bits and a tail. Head · head is then exact, and only small products are
// rounded. (The logarithm's head may be any nearby value, so a short estimate is used.) The split of the exponent is
// the same for every pixel, so the compiler moves it out of the loop.
struct two_parts {
    num head, tail;
};

LANE_FN struct two_parts scaled_log2(struct binary_parts b, num exponent)
{
    num line = 1.5f * b.rest;
    num curve = log2_remainder(b.rest);
    num guess = b.exponent + (line - 0.7f * (b.rest * b.rest));
    num log_head = num_of_bits(bits_of(guess) & -0x1000);
    num log_tail = ((b.exponent - log_head) + line) + curve;
    num exponent_head = num_of_bits(bits_of(exponent) & -0x1000);
    num exponent_tail = exponent - exponent_head;
    return (struct two_parts){exponent_head * log_head, exponent_tail * log_head + exponent * log_tail};
}

// Returns the smallest base that is not treated as 0. If the exponent is 0, no base is treated as 0, because 0⁰ = 1.
LANE_FN num min_base(num exponent) { return pick(exponent > 0.0f, num_of(SMALLEST_NORMAL), num_of(-__builtin_inff())); }

// Computes base^exponent for a base in 0…1 (a larger base is treated as 1) and any finite exponent ≥ 0. 0⁰ is 1. For
// exponents above 0, the result is 0 if the base is 0, negative, below the smallest normal number, or NaN. A result
// below the smallest normal number becomes 0, because calculations with denormals take two to three times as long. The
// relative error is at most 2e-6 for exponents up to 128, and 3e-6 for all others.
//
// Three functions compute the three steps, so that a loop over many powers overlaps the latencies of the steps. The
// first splits the base, the second computes its logarithm (with a head of −∞ if the power is 0), and the third
// computes the power of two.
LANE_FN struct binary_parts unit_parts_of(num base) { return binary_parts_of(min_of(base, num_of(1.0f))); }

LANE_FN struct two_parts unit_power_logarithm(num base, struct binary_parts parts, num exponent)
{
    struct two_parts y = scaled_log2(parts, exponent);
    y.head = pick(base >= min_base(exponent), y.head, num_of(-__builtin_inff()));
    return y;
}

LANE_FN num unit_power_of(struct two_parts y)
{
    num sum = y.head + y.tail;
    struct whole_power w = whole_power_of(sum);
    num fraction = (y.head - w.whole) + y.tail;
    return pick(sum >= -126.0f, exp2_fraction(fraction) * w.power, num_of(0.0f));
}

LANE_FN num unit_power(num base, num exponent)
{
    return unit_power_of(unit_power_logarithm(base, unit_parts_of(base), exponent));
}

// Works like unit_power, for any base ≥ 0. Results above 2^127.5 become about 2^127.5.
LANE_FN num power(num base, num exponent)
{
    struct two_parts y = scaled_log2(binary_parts_of(base), min_of(exponent, num_of(1.0e30f)));
    num sum = y.head + y.tail;
    struct whole_power w = whole_power_of(min_of(sum, num_of(127.0f)));
    num fraction = min_of((y.head - w.whole) + y.tail, num_of(0.51f)); // may slightly exceed ½ because of rounding
    mask some = both(base >= min_base(exponent), sum >= -126.0f);
    return pick(some, exp2_fraction(fraction) * w.power, num_of(0.0f));
}

// Computes 1/√x for normal x > 0 with a relative error of at most 9e-8. The result at 0 is about 3.6e19, so that 0 ·
// rsqrt(0) = 0. The first estimate is computed from the bits of x, by halving and negating the exponent. With the
// constants of the first step, the step's result is slightly too small. This makes the rounding error of x·y² smaller.
// The last step is of third order: with e = 1 − x·y², 1/√x = y/√(1 − e) = y·(1 + e/2 + 3e²/8 + …).
//
// Two functions compute the approximation and its refinement, so that loops can overlap the latencies of the two steps.
LANE_FN num rsqrt_near(num x)
{
    num y = num_of_bits(wrap_sub(inum_of(0x5f1ffff9), shift_right(bits_of(x), 1)));
    return y * (1.6808f - 0.7035f * ((x * y) * y));
}

LANE_FN num rsqrt_from(num x, num y)
{
    num e = 1.0f - (x * y) * y;
    return y + (y * e) * (0.5f + 0.375f * e);
}

LANE_FN num rsqrt(num x) { return rsqrt_from(x, rsqrt_near(x)); }

#endif
