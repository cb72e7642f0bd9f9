// number.c: parses numbers in text with correct rounding, independently of the locale.
//
// There are three methods. If a method cannot guarantee the last bit of the result, the next method is used:
//  1. Few digits and a small power of ten: one exact operation (Clinger, "How to Read Floating Point Numbers
//     Accurately", 1990); for floats, a product in double, unless the product is near the midpoint of two floats.
//  2. One or two 64×64-bit products with a 128-bit power of five (Lemire, "Number Parsing at a Gigabyte per
//     Second", 2021).
//  3. Long division of exact big integers.
#include "number.h"

#include "number_powers.h"
#include "number_scan.h"

// The number (−1)^negative · digits · 10^exponent. `truncated` means that there were nonzero digits after the first 19.
struct decimal {
    uint64_t digits;
    int64_t exponent;
    bool negative, truncated;
    const uint8_t *first, *stop; // the run of digits and '.'
};

// The floating-point format of the result.
struct format {
    int mantissa_bits;         // stored bits
    int min_exponent_field;    // −bias: the exponent that the field 0 would represent
    int infinite;              // the exponent field of infinity
    int even_first, even_last; // range of powers of ten for which a product can be a midpoint
    // The limits of the power of ten. With a smaller power, any 19 digits give 0; with a larger power, they give
    // infinity.
    int min_power, max_power;
};
static const struct format format_double = {52, -1023, 0x7ff, -4, 23, -342, 308};
static const struct format format_float = {23, -127, 0xff, -17, 10, -65, 38};

static const uint8_t *skip_digits(const uint8_t *at, const uint8_t *end, uint64_t *value)
{
    uint64_t v = *value;
    while (end - at >= 8) {
        uint64_t eight = number_load8(at);
        unsigned count = number_digit_count(eight);
        v = v * number_integer_powers[count] + number_digits_value(eight, count);
        at += count;
        if (count < 8) {
            *value = v;
            return at;
        }
    }
    for (; at < end && (unsigned)(*at - '0') < 10; at++)
        v = v * 10 + (unsigned)(*at - '0');
    *value = v;
    return at;
}

// Reads the first 19 significant digits of a longer number.
static void take_leading(struct decimal *d, int64_t exponent_behind_run, const uint8_t *point)
{
    const uint8_t *at = d->first;
    while (at < d->stop && (*at == '0' || *at == '.'))
        at++;
    d->digits = 0;
    d->truncated = false;
    int taken = 0;
    for (; at < d->stop && taken < 19; at++) {
        if (*at == '.')
            continue;
        d->digits = d->digits * 10 + (unsigned)(*at - '0');
        taken++;
    }
    // Each dropped digit before the point adds one to the power of ten. Dropped digits after the point do not change
    // the power.
    int64_t left = d->stop - at;
    if (point && at <= point)
        left--; // the decimal point
    d->exponent = exponent_behind_run + left;
    for (; at < d->stop; at++) {
        if (*at != '0' && *at != '.')
            d->truncated = true;
    }
}

// Reads the sign, the digits and the exponent. Returns the position after the number, or NULL if there are no digits.
static const uint8_t *scan(const uint8_t *at, const uint8_t *end, struct decimal *d)
{
    *d = (struct decimal){0};
    if (at < end && (*at == '-' || *at == '+'))
        d->negative = *at++ == '-';
    d->first = at;
    const uint8_t *point = NULL;
    at = skip_digits(at, end, &d->digits);
    int64_t count = at - d->first;
    if (at < end && *at == '.') {
        point = at;
        at = skip_digits(at + 1, end, &d->digits);
        d->exponent = -(at - point - 1);
        count -= d->exponent;
    }
    if (count == 0)
        return NULL;
    d->stop = at;

    int64_t written = 0;
    if (at < end && (*at | 0x20) == 'e') {
        const uint8_t *power = at + 1;
        bool minus = false;
        if (power < end && (*power == '-' || *power == '+'))
            minus = *power++ == '-';
        if (power < end && (unsigned)(*power - '0') < 10) {
            for (; power < end && (unsigned)(*power - '0') < 10; power++) {
                if (written < INT64_C(1) << 48) // the limit is larger than the number of digits that fit into memory
                    written = written * 10 + (*power - '0');
            }
            at = power;
            written = minus ? -written : written;
        }
    }
    d->exponent += written;
    if (count > 19)
        take_leading(d, d->exponent, point);
    return at;
}

// --- method 2: 128-bit products

struct wide {
    uint64_t high, low;
};

static struct wide multiply(uint64_t a, uint64_t b)
{
    __extension__ unsigned __int128 product = (unsigned __int128)a * b;
    return (struct wide){(uint64_t)(product >> 64), (uint64_t)product};
}

// Computes the bits (without sign) nearest to digits · 10^power. Returns false if the last bit is uncertain.
static bool round_product(uint64_t digits, int64_t power, const struct format *format, uint64_t *bits)
{
    const uint64_t infinity = (uint64_t)format->infinite << format->mantissa_bits;
    if (digits == 0 || power < format->min_power) {
        *bits = 0;
        return true;
    }
    if (power > format->max_power) {
        *bits = infinity;
        return true;
    }
    int zeros = __builtin_clzll(digits);
    digits <<= zeros;
    const uint64_t *five = powers_of_five[power - POWER_FIRST];
    struct wide product = multiply(digits, five[0]);
    // The low half of the power of five matters only if its carry passes through all dropped bits.
    uint64_t cut = UINT64_MAX >> (format->mantissa_bits + 3);
    if ((product.high & cut) == cut) {
        uint64_t more = multiply(digits, five[1]).high;
        product.low += more;
        if (product.low < more)
            product.high++;
    }
    if (product.low == UINT64_MAX && (power < -27 || power > 55))
        return false;

    int top = (int)(product.high >> 63);
    int shift = top + 64 - format->mantissa_bits - 3;
    uint64_t mantissa = product.high >> shift; // one bit more than in the result
    // 217706/2^16 approximates log2(10), accurately enough to give the floor for every power in the table.
    int field = (int)((217706 * power) >> 16) + 63 + top - zeros - format->min_exponent_field;
    uint64_t hidden = UINT64_C(1) << format->mantissa_bits;
    if (field <= 0) { // denormal
        if (1 - field >= 64) {
            *bits = 0;
            return true;
        }
        mantissa >>= 1 - field;
        mantissa = (mantissa + (mantissa & 1)) >> 1;
        *bits = mantissa; // if rounding carries, the result is the smallest normal number, whose bits are correct too
        return true;
    }
    // If the number is exactly at the midpoint, round to even.
    if (product.low <= 1 && power >= format->even_first && power <= format->even_last && (mantissa & 3) == 1 &&
        mantissa << shift == product.high)
        mantissa &= ~UINT64_C(1);
    mantissa = (mantissa + (mantissa & 1)) >> 1;
    if (mantissa >= 2 * hidden) {
        mantissa = hidden;
        field++;
    }
    *bits = field >= format->infinite ? infinity : ((uint64_t)field << format->mantissa_bits | (mantissa & ~hidden));
    return true;
}

// --- method 3: big integers

// Unsigned big integers, lowest limb first. These integers are large enough for 770 digits times 10^308, and for the
// product of 10^(342 + 770) and a number below 2^64.
enum { LIMBS = 160, DIGITS_MAX = 770 };
struct big {
    uint32_t limb[LIMBS];
    int count; // without leading zeros
};

static void big_multiply_add(struct big *a, uint32_t factor, uint32_t plus)
{
    uint64_t carry = plus;
    for (int i = 0; i < a->count; i++) {
        carry += (uint64_t)a->limb[i] * factor;
        a->limb[i] = (uint32_t)carry;
        carry >>= 32;
    }
    if (carry)
        a->limb[a->count++] = (uint32_t)carry;
}

static void big_times_power_of_ten(struct big *a, int64_t power)
{
    for (; power >= 9; power -= 9)
        big_multiply_add(a, 1000000000, 0);
    big_multiply_add(a, (uint32_t)number_integer_powers[power], 0);
}

static void big_shift_left(struct big *a, int bits)
{
    int limbs = bits / 32, rest = bits % 32;
    if (a->count == 0)
        return;
    for (int i = a->count - 1; i >= 0; i--)
        a->limb[i + limbs] = a->limb[i];
    for (int i = 0; i < limbs; i++)
        a->limb[i] = 0;
    a->count += limbs;
    if (rest)
        big_multiply_add(a, UINT32_C(1) << rest, 0);
}

static int big_bits(const struct big *a) { return a->count ? a->count * 32 - __builtin_clz(a->limb[a->count - 1]) : 0; }

static int big_compare(const struct big *a, const struct big *b)
{
    if (a->count != b->count)
        return a->count < b->count ? -1 : 1;
    for (int i = a->count - 1; i >= 0; i--) {
        if (a->limb[i] != b->limb[i])
            return a->limb[i] < b->limb[i] ? -1 : 1;
    }
    return 0;
}

static void big_subtract(struct big *a, const struct big *b) // requires a ≥ b
{
    int64_t carry = 0;
    for (int i = 0; i < a->count; i++) {
        carry += (int64_t)a->limb[i] - (i < b->count ? b->limb[i] : 0);
        a->limb[i] = (uint32_t)carry;
        carry >>= 32;
    }
    while (a->count && a->limb[a->count - 1] == 0)
        a->count--;
}

// Reads up to DIGITS_MAX significant digits. No midpoint of two doubles has more than 767 digits, so one extra digit
// represents all later nonzero digits. Returns the power of ten to multiply by.
static int64_t big_digits(const struct decimal *d, struct big *a)
{
    const uint8_t *at = d->first;
    while (at < d->stop && (*at == '0' || *at == '.'))
        at++;
    int taken = 0;
    bool rest = false;
    for (; at < d->stop; at++) {
        if (*at == '.')
            continue;
        if (taken < DIGITS_MAX) {
            big_multiply_add(a, 10, (uint32_t)(*at - '0'));
            taken++;
        } else {
            rest |= *at != '0';
        }
    }
    // d->exponent refers to the first 19 digits, or to the last digit if there are fewer.
    int64_t power = taken > 19 ? d->exponent - (taken - 19) : d->exponent;
    if (rest) {
        big_multiply_add(a, 10, 1);
        power--;
    }
    return power;
}

// Returns the quotient over / under, by long division. `bits` is the number of bits by which `over` is longer than
// `under`, at least 0. Multiplies `under` by 2^bits; `over` receives the remainder times 2^bits.
static uint64_t divide(struct big *over, struct big *under, int bits)
{
    uint64_t quotient = 0;
    big_shift_left(under, bits);
    for (int i = bits; i >= 0; i--) {
        quotient <<= 1;
        if (big_compare(over, under) >= 0) {
            big_subtract(over, under);
            quotient |= 1;
        }
        if (i > 0)
            big_shift_left(over, 1); // has the same effect as dividing `under` by 2
    }
    return quotient;
}

// Returns the bits nearest to the number.
static uint64_t round_exactly(const struct decimal *d, const struct format *format)
{
    struct big over = {{0}, 0}, under = {{1}, 1};
    int64_t power = big_digits(d, &over);
    if (power >= 0)
        big_times_power_of_ten(&over, power);
    else
        big_times_power_of_ten(&under, -power);

    // Scale the numbers so that the last bit of the quotient is the last bit of the result.
    int precision = format->mantissa_bits + 1;
    int min_exponent = format->min_exponent_field + 2 - precision; // exponent of a denormal's last bit
    // the exponent of the number's first bit, or one higher
    int exponent = big_bits(&over) - big_bits(&under);
    // the quotient then has `precision` bits, or one more
    int last = exponent - precision;
    if (last < min_exponent)
        last = min_exponent;
    if (last > 0)
        big_shift_left(&under, last);
    else
        big_shift_left(&over, -last);

    int bits = big_bits(&over) - big_bits(&under);
    uint64_t quotient = bits >= 0 ? divide(&over, &under, bits) : 0;
    bool rest = over.count != 0;
    if (bits < 0) { // round up if the remainder is more than half of the last bit
        big_shift_left(&over, 1);
        int half = big_compare(&over, &under);
        return half > 0; // a remainder of exactly half is rounded to even, that is, to 0
    }
    // The remainder and the divisor were both shifted up by `bits`, so compare twice the remainder with the divisor.
    uint64_t hidden = UINT64_C(1) << format->mantissa_bits;
    bool up;
    if (quotient >= 2 * hidden) { // one bit too many
        up = (quotient & 1) && (rest || (quotient & 2));
        quotient >>= 1;
        last++;
    } else {
        big_shift_left(&over, 1);
        int half = big_compare(&over, &under);
        up = half > 0 || (half == 0 && (quotient & 1));
    }
    quotient += up;
    if (quotient < hidden)
        return quotient; // denormal
    if (quotient == 2 * hidden) {
        quotient = hidden;
        last++;
    }
    int field = last - min_exponent + 1;
    if (field >= format->infinite)
        return (uint64_t)format->infinite << format->mantissa_bits;
    return (uint64_t)field << format->mantissa_bits | (quotient & ~hidden);
}

static uint64_t round_decimal(const struct decimal *d, const struct format *format)
{
    uint64_t bits, above;
    if (round_product(d->digits, d->exponent, format, &bits) &&
        (!d->truncated || (round_product(d->digits + 1, d->exponent, format, &above) && above == bits)))
        return bits;
    return round_exactly(d, format);
}

// --- the public functions

// Parses "inf", "infinity", "nan" and "nan(…)", in upper or lower case. *bits receives the format's bits without the
// sign.
static const uint8_t *scan_special(const uint8_t *at, const uint8_t *end, const struct format *format, bool *negative,
                                   uint64_t *bits)
{
    *negative = false;
    if (at < end && (*at == '-' || *at == '+'))
        *negative = *at++ == '-';
    static const char *const words[] = {"infinity", "inf", "nan"};
    for (int w = 0; w < 3; w++) {
        const uint8_t *c = at;
        const char *letter = words[w];
        while (*letter && c < end && (*c | 0x20) == *letter) {
            c++;
            letter++;
        }
        if (*letter)
            continue;
        bool nan = w == 2;
        *bits = (uint64_t)format->infinite << format->mantissa_bits;
        *bits |= (uint64_t)nan << (format->mantissa_bits - 1);
        if (nan && c < end && *c == '(') {
            const uint8_t *inside = c + 1;
            while (inside < end &&
                   ((unsigned)(*inside - '0') < 10 || (unsigned)((*inside | 0x20) - 'a') < 26 || *inside == '_'))
                inside++;
            if (inside < end && *inside == ')')
                c = inside + 1;
        }
        return c;
    }
    return NULL;
}

static double double_of(uint64_t bits, bool negative)
{
    bits |= (uint64_t)negative << 63;
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

static float float_of(uint64_t bits, bool negative)
{
    uint32_t narrow = (uint32_t)bits | (uint32_t)negative << 31;
    float x;
    memcpy(&x, &narrow, sizeof x);
    return x;
}

// Finishes the parsing of a number if the fast paths of number_double and number_float do not apply. *bits receives the
// bits of the number without the sign. `after` is the result of scan for `d`; if it is NULL, only "inf" and "nan" are
// possible.
static const uint8_t *finish(const uint8_t *at, const uint8_t *end, const uint8_t *after, const struct format *format,
                             struct decimal *d, uint64_t *bits)
{
    if (!after)
        return scan_special(at, end, format, &d->negative, bits);
    *bits = round_decimal(d, format);
    return after;
}

const uint8_t *number_double(const uint8_t *at, const uint8_t *end, double *out)
{
    static const double powers[23] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                      1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
    struct decimal d;
    const uint8_t *after = scan(at, end, &d);
    if (after && d.digits <= UINT64_C(1) << 53 && d.exponent >= -22 && d.exponent <= 22 && !d.truncated) {
        double x = (double)d.digits;
        x = d.exponent < 0 ? x / powers[-d.exponent] : x * powers[d.exponent];
        *out = d.negative ? -x : x;
        return after;
    }
    uint64_t bits;
    after = finish(at, end, after, &format_double, &d, &bits);
    if (after)
        *out = double_of(bits, d.negative);
    return after;
}

const uint8_t *number_float(const uint8_t *at, const uint8_t *end, float *out)
{
    // 10^e for e from −28 to 18, each exact to half a unit in the last place. The product of 19 digits and one of these
    // powers is always a normal float.
    enum { LEAST = -28, MOST = 18 };
    static const double powers[] = {1e-28, 1e-27, 1e-26, 1e-25, 1e-24, 1e-23, 1e-22, 1e-21, 1e-20, 1e-19, 1e-18, 1e-17,
                                    1e-16, 1e-15, 1e-14, 1e-13, 1e-12, 1e-11, 1e-10, 1e-9,  1e-8,  1e-7,  1e-6,  1e-5,
                                    1e-4,  1e-3,  1e-2,  1e-1,  1e0,   1e1,   1e2,   1e3,   1e4,   1e5,   1e6,   1e7,
                                    1e8,   1e9,   1e10,  1e11,  1e12,  1e13,  1e14,  1e15,  1e16,  1e17,  1e18};
    struct decimal d;
    const uint8_t *after = scan(at, end, &d);
    if (after && d.exponent >= LEAST && d.exponent <= MOST) {
        double x = (double)d.digits * powers[d.exponent - LEAST];
        if (number_rounds_surely(x)) {
            *out = (float)(d.negative ? -x : x);
            return after;
        }
    }
    uint64_t bits;
    after = finish(at, end, after, &format_float, &d, &bits);
    if (after)
        *out = float_of(bits, d.negative);
    return after;
}

const uint8_t *number_int(const uint8_t *at, const uint8_t *end, int64_t *out)
{
    bool negative = false;
    if (at < end && (*at == '-' || *at == '+'))
        negative = *at++ == '-';
    const uint8_t *first = at;
    uint64_t value = 0, max = (uint64_t)INT64_MAX + negative;
    for (; at < end && (unsigned)(*at - '0') < 10; at++) {
        unsigned digit = (unsigned)(*at - '0');
        if (value > (max - digit) / 10)
            return NULL;
        value = value * 10 + digit;
    }
    if (at == first)
        return NULL;
    *out = (int64_t)(negative ? 0 - value : value);
    return at;
}

int number_hex_digit(char c)
{
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
}
