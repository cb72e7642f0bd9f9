// test_number.c: numbers are rounded correctly, compared with the C library on random and hard cases.
#include "test.h"
#include "number.h"
#include "number_scan.h"

static uint64_t state = 88172645463325252u;

static uint64_t random64(void)
{
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return state;
}

// The payload of a NaN is arbitrary, so one pattern represents all.
static uint64_t bits_of_double(double x)
{
    uint64_t bits;
    if (x != x)
        return UINT64_MAX;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static uint32_t bits_of_float(float x)
{
    uint32_t bits;
    if (x != x)
        return UINT32_MAX;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

// Reads the text with every function, from a block that ends with it, so that the sanitizer detects reads past the end.
// It compares bits and length with the C library's.
static void check(const char *text)
{
    size_t length = strlen(text);
    uint8_t *exact = malloc(length + 1); // never of size 0
    uint8_t *padded = calloc(1, length + 64);
    memcpy(exact, text, length);
    memcpy(padded, text, length);
    char *stop;
    double wide = strtod(text, &stop), got_wide = -7;
    const uint8_t *behind = number_double(exact, exact + length, &got_wide);
    if (stop == text) {
        assert_null(behind);
    } else {
        if (!behind || behind - exact != stop - text || bits_of_double(wide) != bits_of_double(got_wide))
            fail_msg("'%.60s…': double %a read as %a", text, wide, got_wide);
    }
    float narrow = strtof(text, &stop), got_narrow = -7, got_quick = -7;
    behind = number_float(exact, exact + length, &got_narrow);
    const uint8_t *quick = number_float_quick(padded, padded + length, &got_quick);
    if (stop == text) {
        assert_null(behind);
        assert_null(quick);
    } else {
        if (!behind || behind - exact != stop - text || bits_of_float(narrow) != bits_of_float(got_narrow))
            fail_msg("'%.60s…': float %a read as %a", text, (double)narrow, (double)got_narrow);
        if (!quick || quick - padded != stop - text || bits_of_float(narrow) != bits_of_float(got_quick))
            fail_msg("'%.60s…': float %a quickly read as %a", text, (double)narrow, (double)got_quick);
    }
    free(exact);
    free(padded);
}

TEST(test_forms)
{
    static const char *const texts[] = {
        "0",
        "-0",
        "+0",
        "0.0",
        "-0.000",
        ".5",
        "5.",
        "+1",
        "-.25",
        "1e5",
        "1E5",
        "1e+5",
        "1e-5",
        "1e",
        "1e+",
        "1e-x",
        "1.5.5",
        "--1",
        "+-1",
        ".",
        "-",
        "+",
        "",
        "e5",
        ".e5",
        "inf",
        "-inf",
        "INF",
        "Infinity",
        "infinit",
        "nan",
        "-NaN",
        "nan(12)",
        "nan(",
        "nan(ind)",
        "nanx",
        "in",
        "1,5",
        "1 2",
        "12345678",
        "123456789",
        "1234567.12345678",
        "12345678.1",
        "0.12345678",
        "0.123456789012345",
        "0.1234567890123456",
        "99999999",
        "00000000012",
        "1e400",
        "-1e400",
        "1e-400",
        "1e999999999999999999999",
        "1e-999999999999999999999",
        "0e999999999999999999999",
        "340282346638528859811704183484516925440",
        "340282356779733661637539395458142568447",
        "340282356779733661637539395458142568448",
        "3.4028236e38",
        "1.17549435e-38",
        "1.1754943e-38",
        "1e-45",
        "7e-46",
        "7.006492321624085e-46",
        "7.006492321624086e-46",
        "1.401298464324817e-45",
        "4.9406564584124654e-324",
        "2.4703282292062327e-324",
        "2.4703282292062328e-324",
        "2.2250738585072011e-308",
        "2.2250738585072014e-308",
        "1.7976931348623157e308",
        "1.7976931348623158e308",
        "1.7976931348623159e308",
        "9007199254740993",
        "9007199254740992.5",
        "9007199254740993.0000000000000000000000000000000000001",
        "16777217",
        "16777217.0",
        "16777219",
        "16777216.9999999",
        "16777217.00000001",
        "5e-324",
        "1e23",
        "8.5e22",
        "6.02214076e23",
        "1e22",
        "1e-22",
        "18446744073709551615",
        "18446744073709551616",
        "99999999999999999999",
        "0.1",
        "0.2",
        "0.3",
        "3.14159265358979",
        "1e",
        "4.35",
        "179769313486231570000000000000000000000",
        "500000.123456",
        "-71.058880",
        "0.000000",
        "0.00000000000000000000000000000000000000000000001",
        "100000000000000000000000000000000000000",
    };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        check(texts[i]);
    // Not hexadecimal; the C library would read 16.
    float x;
    const uint8_t *hex = (const uint8_t *)"0x10\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0";
    assert_ptr_equal(number_float(hex, hex + 4, &x), hex + 1);
    assert_true(x == 0);
}

// Plain decimals as in files.
TEST(test_plain)
{
    char text[128];
    for (int i = 0; i < 400000; i++) {
        uint64_t r = random64();
        int decimals = (int)(r % 18);
        double scale = pow(10, (double)(r >> 8 & 15) - 6);
        snprintf(text, sizeof text, "%.*f", decimals, ((double)(random64() >> 11) * 0x1p-52 - 1) * scale);
        check(text);
    }
}

// Random bits, printed short and long, with and without an exponent.
TEST(test_random)
{
    char text[1200];
    for (int i = 0; i < 300000; i++) {
        uint64_t bits = random64();
        double x;
        memcpy(&x, &bits, sizeof x);
        if (x - x != 0)
            continue;
        snprintf(text, sizeof text, "%.*e", (int)(random64() % 25), x);
        check(text);
        uint32_t narrow = (uint32_t)random64();
        float f;
        memcpy(&f, &narrow, sizeof f);
        if (f - f != 0)
            continue;
        snprintf(text, sizeof text, "%.*g", (int)(random64() % 12) + 1, (double)f);
        check(text);
        snprintf(text, sizeof text, "%llu%llue%d", (unsigned long long)random64(), (unsigned long long)(bits % 1000),
                 (int)(random64() % 700) - 360);
        check(text);
    }
}

// The exact midpoint of two neighbours, and numbers just above and below it.
TEST(test_middles)
{
    static char text[2400];
    for (int i = 0; i < 4000; i++) {
        double middle;
        if (i % 2) { // between floats, exact as a double; every eighth denormal
            uint32_t bits = (uint32_t)random64() & 0x7fffffff;
            if (i % 8 == 1)
                bits &= 0x007fffff;
            if (bits >= 0x7f800000)
                continue;
            float f;
            memcpy(&f, &bits, sizeof f);
            middle = 0.5 * ((double)f + (double)nextafterf(f, INFINITY));
            if (middle - middle != 0)
                continue;
            snprintf(text, sizeof text, "%.160f", middle);
        } else { // between doubles: digits of the exact sum of x and half a unit, in long double
            uint64_t bits = random64() & INT64_MAX;
            if (i % 8 == 0)
                bits &= UINT64_C(0x000fffffffffffff);
            if (bits >> 52 == 0x7ff)
                continue;
            memcpy(&middle, &bits, sizeof middle);
            long double x = ((long double)middle + (long double)nextafter(middle, (double)INFINITY)) / 2;
            snprintf(text, sizeof text, "%.1100Lf", x);
        }
        check(text);
        size_t length = strlen(text);
        memset(text + length, '0', 500);
        text[length + 500] = 0;
        check(text);
        strcpy(text + length + 500, "1");
        check(text);
        text[length] = 0;
        for (size_t at = length; at-- > 0;) { // the last digit that is not 0, minus one
            if (text[at] > '0' && text[at] <= '9') {
                text[at]--;
                memset(text + length, '9', 700);
                text[length + 700] = 0;
                break;
            }
        }
        check(text);
    }
}

TEST(test_long)
{
    static char text[3000];
    for (int i = 0; i < 2000; i++) {
        size_t length = 20 + (size_t)(random64() % 900), point = (size_t)(random64() % length);
        for (size_t k = 0; k < length; k++)
            text[k] = k == point ? '.' : random64() % 4 ? (char)('0' + random64() % 10) : '0';
        snprintf(text + length, 20, "e%d", (int)(random64() % 800) - 500 - (int)(point % 300));
        check(text);
    }
}

TEST(test_int)
{
    static const struct {
        const char *text;
        int length; // −1: refused
        int64_t value;
    } rows[] = {
        {"0", 1, 0},
        {"-1", 2, -1},
        {"+17x", 3, 17},
        {"9223372036854775807", 19, INT64_MAX},
        {"9223372036854775808", -1, 0},
        {"-9223372036854775808", 20, INT64_MIN},
        {"-9223372036854775809", -1, 0},
        {"", -1, 0},
        {"-", -1, 0},
        {"x", -1, 0},
        {"99999999999999999999999", -1, 0},
        {"12.5", 2, 12},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const uint8_t *text = (const uint8_t *)rows[i].text;
        int64_t value = 5;
        const uint8_t *behind = number_int(text, text + strlen(rows[i].text), &value);
        if (rows[i].length < 0) {
            assert_null(behind);
        } else {
            assert_ptr_equal(behind, text + rows[i].length);
            assert_true(value == rows[i].value);
        }
    }
}
