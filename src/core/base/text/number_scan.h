// number_scan.h: parses the digits of numbers eight at a time, with a fast path for the short numbers in model files.
// number.c parses all other numbers.
#ifndef NUMBER_SCAN_H
#define NUMBER_SCAN_H

#include "number.h"

#include <string.h>

// Loads eight bytes; the first byte becomes the lowest byte of the result.
static inline uint64_t number_load8(const uint8_t *at)
{
    uint64_t eight;
    memcpy(&eight, at, 8);
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    eight = __builtin_bswap64(eight);
#endif
    return eight;
}

// Returns the number of digits, 0 … 8, before the first non-digit of eight bytes. A byte below '0' causes a borrow and
// a byte above '9' causes a carry, but both affect only later bytes.
static inline unsigned number_digit_count(uint64_t eight)
{
    uint64_t other = ((eight + 0x4646464646464646u) | (eight - 0x3030303030303030u)) & 0x8080808080808080u;
    return other ? (unsigned)__builtin_ctzll(other) / 8 : 8;
}

// Returns the value of the first `count` of eight bytes. These `count` bytes must be digits.
static inline uint64_t number_digits_value(uint64_t eight, unsigned count)
{
    // The digits are shifted to the end, with zeros before them. The shift is done in two steps, because a shift by 64
    // is undefined.
    uint64_t v = (eight - 0x3030303030303030u) << 4 * (8 - count) << 4 * (8 - count);
    // Neighbouring digits are joined as ten times the first plus the second: 8 digits become 4 pairs, then 2 groups of
    // four, then 1 number. One product does both steps, because the factor 10 · 2⁸ + 1 adds ten times the lower byte to
    // the upper byte.
    v = (v * (10 << 8 | 1) >> 8) & 0x00ff00ff00ff00ffu;
    v = (v * (100 << 16 | 1) >> 16) & 0x0000ffff0000ffffu;
    return v * (UINT64_C(10000) << 32 | 1) >> 32;
}

static const uint64_t number_integer_powers[20] = {
    1u,
    10u,
    100u,
    1000u,
    10000u,
    100000u,
    1000000u,
    10000000u,
    100000000u,
    1000000000u,
    10000000000u,
    100000000000u,
    1000000000000u,
    10000000000000u,
    100000000000000u,
    1000000000000000u,
    10000000000000000u,
    100000000000000000u,
    1000000000000000000u,
    10000000000000000000u,
};

// Returns whether a double with an error of at most 4 units in its last place rounds to the correct float. The result
// is false near the midpoint of two floats. |x| must be between 2^-126 and 2^127.
static inline bool number_rounds_surely(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    // A float drops the low 29 bits; at a midpoint only bit 28 is set.
    return ((bits & 0x1fffffff) - 0x0ffffffc) > 8;
}

// The powers 10^0 to 10^-15, each rounded once.
static const double number_tenths[16] = {1e0,  1e-1, 1e-2,  1e-3,  1e-4,  1e-5,  1e-6,  1e-7,
                                         1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13, 1e-14, 1e-15};

// Works like number_float, but is fast for [-]ddd.ddd with up to 7 + 15 digits. At least 24 bytes must be readable at
// `at`. Another byte, such as a space, must follow the number before `end`.
static inline const uint8_t *number_float_quick(const uint8_t *at, const uint8_t *end, float *out)
{
    bool negative = *at == '-';
    const uint8_t *digits = at + negative;
    uint64_t eight = number_load8(digits);
    unsigned whole = 1, fraction = 0;
    uint64_t value = (unsigned)(*digits - '0'); // in models of about unit size, most numbers have one digit before the
                                                // point
    if (digits[1] != '.' || value > 9) {
        whole = number_digit_count(eight);
        value = number_digits_value(eight, whole);
    }
    const uint8_t *stop = digits + whole;
    if (*stop == '.' && whole < 8) {
        eight = number_load8(++stop);
        fraction = number_digit_count(eight);
        value = value * number_integer_powers[fraction] + number_digits_value(eight, fraction);
        stop += fraction;
        if (fraction == 8) {
            eight = number_load8(stop);
            unsigned more = number_digit_count(eight);
            value = value * number_integer_powers[more] + number_digits_value(eight, more);
            stop += more;
            fraction += more;
        }
    }
    if (__builtin_expect(whole + fraction - 1 < 18 && whole < 8 && fraction < 16 && (*stop | 0x20) != 'e', 1)) {
        // Three roundings (`value` above 2^53, the power, the product) give an error of at most 3 units.
        double x = (double)(int64_t)value * number_tenths[fraction];
        if (__builtin_expect(number_rounds_surely(x), 1)) {
            *out = (float)(negative ? -x : x);
            return stop;
        }
    }
    return number_float(at, end, out);
}

#endif
