// elementary.c: exponentials, logarithms, powers and related functions in double, in one fixed order of operations.
#include "elementary.h"

#include "linear.h"

#include <string.h>

#define LN2_HEAD 6.93147180369123816490e-01 // ln 2 in two summands, the first with 33 significant bits
#define LN2_TAIL 1.90821492927058770002e-10

double math_floor(double x)
{
    if (!(x > -0x1p52 && x < 0x1p52)) // already integral, infinite or NaN
        return x;
    double whole = (double)(long long)x;
    return whole > x ? whole - 1 : whole;
}

// Computes x · 2^n for |n| ≤ 2200. Only the last multiplication can overflow or round.
static double scaled(double x, int n)
{
    for (; n > 1000; n -= 1000)
        x *= 0x1p1000;
    for (; n < -1000; n += 1000)
        x *= 0x1p-1000;
    uint64_t bits = (uint64_t)(n + 1023) << 52;
    double power;
    memcpy(&power, &bits, sizeof power);
    return x * power;
}

// Computes e^(x + tail) by the Taylor series after subtracting a multiple of ln 2. The tail is below the rounding error
// of x.
static double exponential(double x, double tail)
{
    if (x != x)
        return x;
    if (x > 710)
        return __builtin_inf();
    if (x < -745.2)
        return 0;
    double whole = math_floor(x * 1.44269504088896340736 + 0.5);
    double r = ((x - whole * LN2_HEAD) - whole * LN2_TAIL) + tail; // |r| ≤ 0.35
    double sum = 0;
    for (int k = 14; k >= 2; k--)
        sum = (sum * r + 1) / k;
    return scaled(1 + (r + r * (r * sum)), (int)whole);
}

double math_exp(double x) { return exponential(x, 0); }

struct two_doubles {
    double head, tail;
};

// Computes a · b exactly (Dekker 1971), for factors far from overflow.
static struct two_doubles exact_product(double a, double b)
{
    double p = a * b, s = a * 134217729.0, t = b * 134217729.0;
    double a1 = s - (s - a), a2 = a - a1, b1 = t - (t - b), b2 = b - b1;
    return (struct two_doubles){p, ((a1 * b1 - p) + a1 * b2 + a2 * b1) + a2 * b2};
}

static struct two_doubles exact_sum(double a, double b)
{
    double sum = a + b, part = sum - a;
    return (struct two_doubles){sum, (a - (sum - part)) + (b - part)};
}

// Computes ln x for finite x > 0 with ten more bits of precision than a double. The function splits x = 2^n · m with m
// in [√½, √2) and uses ln m = 2 artanh s with s = (m − 1)/(m + 1). The tail of the result contains the rounding error
// of s.
static struct two_doubles logarithm(double x)
{
    int n = 0;
    if (x < 0x1p-1022) {
        x *= 0x1p54;
        n = -54;
    }
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    n += (int)(bits >> 52) - 1023;
    bits = (bits & 0x000fffffffffffff) | 0x3ff0000000000000;
    double m;
    memcpy(&m, &bits, sizeof m);
    if (m > 1.41421356237309504880) {
        m *= 0.5;
        n++;
    }
    double f = m - 1, below = m + 1, s = f / below;
    struct two_doubles sum = exact_sum(m, 1), product = exact_product(s, below);
    double s_tail = (((f - product.head) - product.tail) - s * sum.tail) / below;
    double z = s * s, series = 0;
    for (int k = 12; k >= 1; k--)
        series = (series + 1.0 / (2 * k + 1)) * z;
    struct two_doubles whole = exact_sum(n * LN2_HEAD, 2 * s); // the product is exact
    return (struct two_doubles){whole.head, whole.tail + (n * LN2_TAIL + (2 * s_tail + 2 * s * series))};
}

double math_log(double x)
{
    if (!(x > 0))
        return x == 0 ? -__builtin_inf() : __builtin_nan("");
    if (!math_finite(x))
        return x;
    struct two_doubles y = logarithm(x);
    return y.head + y.tail;
}

double math_pow(double a, double b)
{
    if (b == 0 || a == 1)
        return 1;
    if (a != a || b != b)
        return __builtin_nan("");
    bool whole = math_floor(b) == b, odd = whole && math_floor(b / 2) * 2 != b;
    if (a < 0 && !whole)
        return __builtin_nan("");
    double size = a < 0 ? -a : a, sign = a < 0 && odd ? -1 : 1;
    if (size == 0 || !math_finite(size) || !math_finite(b) || b > 1e300 || b < -1e300) {
        bool grows = (size > 1) == (b > 0);
        return size == 1 ? sign : grows ? sign * __builtin_inf() : 0;
    }
    struct two_doubles y = logarithm(size);
    double about = b * y.head;
    if (about > 720 || about < -760)
        return about > 0 ? sign * __builtin_inf() : 0;
    struct two_doubles product = exact_product(b, y.head);
    return sign * exponential(product.head, product.tail + b * y.tail);
}

double math_sinh(double x)
{
    if (x > -1 && x < 1) { // Taylor series: a difference of exponentials would lose digits
        double z = x * x, sum = 0;
        for (int k = 9; k >= 1; k--)
            sum = (sum + 1) * z / (2 * k * (2 * k + 1));
        return x + x * sum;
    }
    double half = math_exp(x > 0 ? x / 2 : -x / 2), e = half * 0.5 * half; // x/2 is used because e^x overflows before
                                                                           // sinh x does
    e = x > 20 || x < -20 ? e : e - 0.25 / e;
    return x > 0 ? e : -e;
}

double math_cosh(double x)
{
    double half = math_exp(x > 0 ? x / 2 : -x / 2), e = half * 0.5 * half;
    return e + 0.25 / e;
}

double math_tanh(double x)
{
    if (x > -0.5 && x < 0.5)
        return math_sinh(x) / math_cosh(x);
    double below = math_exp(x > 0 ? 2 * x : -2 * x) + 1, result = 1 - 2 / below;
    return x != x ? x : x > 0 ? result : -result;
}

double math_asin(double x)
{
    return x >= -1 && x <= 1 ? math_atan2(x, math_sqrt((1 - x) * (1 + x))) : __builtin_nan("");
}

double math_atan(double x)
{
    if (x != x)
        return x;
    return math_finite(x) ? math_atan2(x, 1) : x > 0 ? PI / 2 : -PI / 2;
}
