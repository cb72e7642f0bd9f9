// test_functions.c: compares power, exp2, log2, inverse root and the sRGB curves with libm in double, within the errors
// promised in functions.h and encoding.h, and at their limits. Every width gives the same bits (test_widths.c), so one
// is enough here.

#include "test.h"
#include "random.h"
#include "widths.h"

enum { BLOCK = 4096 };

static const struct width *one_lane(void)
{
    const struct width *width[1];
    assert_int_equal(widths_usable(width, 1), 1);
    return width[0];
}

static float of(enum function function, float a, float b)
{
    float x[16], y[16], out[16];
    for (int i = 0; i < 16; i++) {
        x[i] = a;
        y[i] = b;
    }
    one_lane()->apply(function, x, y, out, 16);
    return out[0];
}

// The largest relative error of base^exponent over bases with bits first, first + step, … last, if the true result is a
// normal number.
static double power_error(enum function function, float first, float last, uint32_t step, float exponent)
{
    static float base[BLOCK], exponents[BLOCK], out[BLOCK];
    double worst = 0;
    uint64_t bits = bits_of_float(first), end = bits_of_float(last);
    for (int i = 0; i < BLOCK; i++)
        exponents[i] = exponent;
    while (bits <= end) {
        int count = 0;
        for (; count < BLOCK && bits <= end; bits += step)
            base[count++] = float_of_bits((uint32_t)bits);
        for (int i = count; i < BLOCK; i++)
            base[i] = 1;
        one_lane()->apply(function, base, exponents, out, BLOCK);
        for (int i = 0; i < count; i++) {
            double y = (double)exponent * log2((double)base[i]), want = exp2(y);
            if (y <= -126 || y >= 127.5) {
                assert_true(y > 0 ? out[i] > 0x1p127f && out[i] < INFINITY
                                  : out[i] >= 0 && (double)out[i] < 0x1.00001p-126);
                continue;
            }
            worst = fmax(worst, fabs((double)out[i] - want) / want);
        }
    }
    return worst;
}

TEST(test_power)
{
    static const float exponents[] = {0.01f,  0.4f, 1,      2,      2.4f,   5,      10,      27.8974f,
                                      50,     64,   95.7f,  100.1f, 110.9f, 120.7f, 126.99f, 127.3f,
                                      127.9f, 128,  150.3f, 180.7f, 200,    217.7f, 256,     500,
                                      777.7f, 1000, 3000,   10000,  1e5f,   1e6f,   1e7f,    1e9f};
    double low = 0, high = 0, over = 0;
    for (unsigned i = 0; i < sizeof exponents / sizeof *exponents; i++) {
        float e = exponents[i];
        for (enum function f = FUNCTION_POWER; f <= FUNCTION_UNIT_POWER; f++) {
            double error = fmax(power_error(f, 0x1p-126f, 1, 4099, e), power_error(f, 0.5f, 1, 37, e));
            if (e <= 128)
                low = fmax(low, error);
            else
                high = fmax(high, error);
        }
        over = fmax(over, power_error(FUNCTION_POWER, 1, 0x1.fffffep127f, 4099, e));
    }
    print_message("power: largest relative error %.3g up to exponent 128, %.3g beyond, %.3g for bases over 1\n", low,
                  high, over);
    assert_true(low > 1e-7 && low <= 2e-6);
    assert_true(high <= 3e-6);
    assert_true(over <= 3e-6);
}

TEST(test_power_edges)
{
    static const float exponents[] = {0x1p-149f, 1e-30f, 0.5f, 1, 27.8f, 1e4f, 1e30f, 0x1.fffffep127f};
    for (enum function f = FUNCTION_POWER; f <= FUNCTION_UNIT_POWER; f++) {
        static const float bases[] = {0, -0.0f, 0x1p-149f, 0x1p-130f, 0x1p-126f, 0.3f, 1, -1, -INFINITY};
        for (unsigned i = 0; i < sizeof bases / sizeof *bases; i++) // 0⁰ = 1, and x⁰ = 1
            assert_true(of(f, bases[i], 0) == 1);
        for (unsigned i = 0; i < sizeof exponents / sizeof *exponents; i++) {
            float e = exponents[i];
            assert_true(of(f, 1, e) == 1);
            assert_true(of(f, 0, e) == 0);
            assert_true(of(f, -0.0f, e) == 0);
            assert_true(of(f, -0.5f, e) == 0);
            assert_true(of(f, -INFINITY, e) == 0);
            assert_true(of(f, NAN, e) == 0);
            assert_true(of(f, 0x1p-127f, e) == 0); // below the smallest normal number
        }
        assert_true(of(f, 0.5f, 1e4f) == 0); // clamped, not denormal
        assert_true(of(f, 0.5f, 130) == 0);
        assert_true(of(f, 0x1.fffffep-1f, 0x1.fffffep127f) == 0);
    }
    assert_true(of(FUNCTION_UNIT_POWER, 1.5f, 10) == 1);
    assert_true(of(FUNCTION_UNIT_POWER, INFINITY, 10) == 1);
    assert_true(of(FUNCTION_POWER, 2, 10) == 1024);
    static const float large[] = {2, 1e10f, 0x1.fffffep127f, INFINITY};
    for (int i = 0; i < 4; i++) {
        float result = of(FUNCTION_POWER, large[i], 1e38f);
        assert_true(result > 0x1p127f && result < INFINITY);
    }
}

// No result is between 0 and the smallest normal number, except for the last digit of that number itself.
TEST(test_no_denormals)
{
    for (float base = 0.01f; base < 1; base += 0.003f) {
        for (float e = 1; e < 3000; e *= 1.01f) {
            float result = of(FUNCTION_UNIT_POWER, base, e);
            assert_true(result == 0 || result > 0x1.ffffep-127f);
        }
    }
}

TEST(test_exp2_and_log2)
{
    static float x[BLOCK], out[BLOCK];
    struct random r = {5};
    double exp2_error = 0, log2_absolute = 0, log2_relative = 0;
    for (int round = 0; round < 200; round++) {
        for (int i = 0; i < BLOCK; i++)
            x[i] = random_between(&r, -126, 127.5f) * (i % 4 == 0 ? 0.01f : 1.0f);
        one_lane()->apply(FUNCTION_EXP2, x, x, out, BLOCK);
        for (int i = 0; i < BLOCK; i++)
            exp2_error = fmax(exp2_error, fabs((double)out[i] / exp2((double)x[i]) - 1));
        for (int i = 0; i < BLOCK; i++)
            x[i] = i % 2 ? float_of_bits(0x800000 + random_bits(&r) % 0x7f000000) : random_between(&r, 0.5f, 2);
        one_lane()->apply(FUNCTION_LOG2, x, x, out, BLOCK);
        for (int i = 0; i < BLOCK; i++) {
            double want = log2((double)x[i]), error = fabs((double)out[i] - want);
            if (fabs(want) <= 1)
                log2_absolute = fmax(log2_absolute, error);
            if (want != 0)
                log2_relative = fmax(log2_relative, error / fabs(want));
        }
    }
    print_message("exp2 %.3g; log2 %.3g absolute up to 1, %.3g relative\n", exp2_error, log2_absolute, log2_relative);
    assert_true(exp2_error <= 2.5e-7);
    assert_true(log2_absolute <= 1.2e-7);
    assert_true(log2_relative <= 2e-7);
    for (int n = -126; n <= 127; n++) { // whole powers are exact both ways
        assert_true(of(FUNCTION_EXP2, (float)n, 0) == (float)exp2(n));
        assert_true(of(FUNCTION_LOG2, (float)exp2(n), 0) == (float)n);
    }
    assert_true(of(FUNCTION_EXP2, -127, 0) == 0 && of(FUNCTION_EXP2, -INFINITY, 0) == 0 &&
                of(FUNCTION_EXP2, NAN, 0) == 0);
    assert_true(of(FUNCTION_EXP2, INFINITY, 0) == of(FUNCTION_EXP2, 127.5f, 0) &&
                of(FUNCTION_EXP2, 1e9f, 0) < INFINITY);
    assert_true(of(FUNCTION_LOG2, 0, 0) == -126 && of(FUNCTION_LOG2, -3, 0) == -126 &&
                of(FUNCTION_LOG2, NAN, 0) == -126);
}

TEST(test_rsqrt)
{
    static float x[BLOCK], out[BLOCK];
    double worst = 0;
    for (uint32_t bits = bits_of_float(1); bits < bits_of_float(4); bits += 3 * BLOCK) { // two binades cover all cases
        for (uint32_t i = 0; i < BLOCK; i++)
            x[i] = float_of_bits(bits + 3 * i);
        one_lane()->apply(FUNCTION_INVERSE_ROOT, x, x, out, BLOCK);
        for (int i = 0; i < BLOCK; i++)
            worst = fmax(worst, fabs((double)out[i] * sqrt((double)x[i]) - 1));
    }
    struct random r = {11};
    for (int round = 0; round < 100; round++) {
        for (int i = 0; i < BLOCK; i++)
            x[i] =
                float_of_bits(bits_of_float(1e-30f) + random_bits(&r) % (bits_of_float(1e30f) - bits_of_float(1e-30f)));
        one_lane()->apply(FUNCTION_INVERSE_ROOT, x, x, out, BLOCK);
        for (int i = 0; i < BLOCK; i++)
            worst = fmax(worst, fabs((double)out[i] * sqrt((double)x[i]) - 1));
    }
    print_message("inverse root %.3g\n", worst);
    assert_true(worst <= 9e-8);
    assert_true(isfinite(of(FUNCTION_INVERSE_ROOT, 0, 0)) && isfinite(of(FUNCTION_INVERSE_ROOT, -0.0f, 0)));
}

static double encoded(double x) { return x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1 / 2.4) - 0.055; }
static double decoded(double x) { return x <= 0.04045 ? x / 12.92 : pow((x + 0.055) / 1.055, 2.4); }

TEST(test_srgb)
{
    double encode = 0, decode = 0;
    for (int i = 0; i <= 100000; i++) {
        float x = (float)i / 100000;
        encode = fmax(encode, fabs((double)of(FUNCTION_SRGB_ENCODE, x, 0) - encoded((double)x)));
        decode = fmax(decode, fabs((double)of(FUNCTION_SRGB_DECODE, x, 0) - decoded((double)x)));
    }
    print_message("sRGB: encoding %.3g, decoding %.3g\n", encode, decode);
    assert_true(encode <= 1e-6 && decode <= 1e-6);
    for (int k = 0; k < 256; k++) {
        float linear = of(FUNCTION_SRGB_DECODE, (float)k / 255, 0);
        assert_true(of(FUNCTION_BYTE, of(FUNCTION_SRGB_ENCODE, linear, 0), 0) == (float)k);
    }
    for (enum function f = FUNCTION_SRGB_ENCODE; f <= FUNCTION_SRGB_DECODE; f++) {
        assert_true(of(f, 0, 0) == 0 && of(f, 1, 0) == 1);
        assert_true(of(f, -1, 0) == 0 && of(f, -INFINITY, 0) == 0 && of(f, NAN, 0) == 0);
        assert_true(of(f, 2, 0) == 1 && of(f, INFINITY, 0) == 1);
        assert_true(of(f, 0x1p-149f, 0) >= 0);
    }
}

TEST(test_bytes)
{
    for (int k = 0; k < 255; k++) {
        assert_true(of(FUNCTION_BYTE, ((float)k + 0.49f) / 255, 0) == (float)k);
        assert_true(of(FUNCTION_BYTE, ((float)k + 0.51f) / 255, 0) == (float)(k + 1));
    }
    assert_true(of(FUNCTION_BYTE, 0, 0) == 0 && of(FUNCTION_BYTE, 1, 0) == 255);
    assert_true(of(FUNCTION_BYTE, -5, 0) == 0 && of(FUNCTION_BYTE, 1e30f, 0) == 255);
    assert_true(of(FUNCTION_BYTE, NAN, 0) == 0 && of(FUNCTION_BYTE, INFINITY, 0) == 255);
}
