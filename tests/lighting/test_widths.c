// test_widths.c: every width and instruction set gives the same bits, on ordinary numbers and on any bit pattern, and
// so does every compiler and build type: one recorded hash covers all results.

#include "test.h"

#include <sys/mman.h>

#include "points.h"
#include "textbook.h"

#define LANES 1
#include "lighting.h"

// Covers all results of the functions; the hashes of the lobes are in textbook.c. A hash changes only if the last bits
// of an equation or a function change. First look at test_functions and test_equations, and then record the new hash.
#define RECORDED_HASH 0x0deec07b96d48e47u

#define RECORDED_ENVIRONMENT_HASH 0x176ccf1841b8bfb2u

enum { WIDTHS_MAX = 16, NUMBERS = 1 << 16 };

// The processor selects the NaN; the tests only require that the result is a NaN.
static uint32_t bits_for_comparison(float x) { return x == x ? bits_of_float(x) : 0x7fc00000; }

static uint64_t hash_of(uint64_t hash, const float *x, int count)
{
    for (int i = 0; i < count; i++)
        hash = (hash ^ bits_for_comparison(x[i])) * 0x100000001b3ull; // FNV-1a, by words
    return hash;
}

static void assert_same(const float *a, const float *b, int count, const char *width, int what)
{
    for (int i = 0; i < count; i++) {
        if (bits_for_comparison(a[i]) != bits_for_comparison(b[i]))
            fail_msg("%s, %d, number %d: %.9g (%08x), one lane %.9g (%08x)", width, what, i, (double)b[i],
                     bits_of_float(b[i]), (double)a[i], bits_of_float(a[i]));
    }
}

static const float specials[] = {
    0.0f,
    -0.0f,
    1.0f,
    -1.0f,
    0.5f,
    2.0f,
    INFINITY,
    -INFINITY,
    NAN,
    0x1p-149f,
    -0x1p-149f,
    0x1p-126f,
    0x1.fffffcp-127f,
    0x1.fffffep127f,
    -0x1.fffffep127f,
    0x1.fffffep-1f,
    0x1.000002p0f,
    128.0f,
    -126.0f,
    -126.5f,
    127.5f,
    127.49f,
    1e30f,
    0.04045f,
    0.0031308f,
    0x1.555556p-1f,
    0x1.555554p-1f,
    27.8974f,
    1000.0f,
    10000.0f,
};
enum { SPECIALS = sizeof specials / sizeof *specials };

// Special values with each other, then any bits, then numbers in 0…1 with common exponents.
static void fill_numbers(float *a, float *b)
{
    struct random r = {2026};
    for (int i = 0; i < NUMBERS; i++) {
        a[i] = float_of_bits(random_bits(&r));
        b[i] = float_of_bits(random_bits(&r));
        if (i < SPECIALS * SPECIALS) {
            a[i] = specials[i % SPECIALS];
            b[i] = specials[i / SPECIALS];
        } else if (i > NUMBERS / 2) {
            a[i] = random_between(&r, 0, 1);
            b[i] = random_between(&r, 0, 200);
        }
    }
}

static uint64_t hash_of_functions(void)
{
    const struct width *widths[WIDTHS_MAX];
    int count = widths_usable(widths, WIDTHS_MAX);
    assert_true(count >= 4);
    float *memory = malloc(4 * NUMBERS * sizeof(float));
    assert_non_null(memory);
    float *a = memory, *b = a + NUMBERS, *first = b + NUMBERS, *out = first + NUMBERS;
    fill_numbers(a, b);
    uint64_t hash = 0xcbf29ce484222325ull;
    for (enum function f = 0; f < FUNCTION_COUNT; f++) {
        widths[0]->apply(f, a, b, first, NUMBERS);
        hash = hash_of(hash, first, NUMBERS);
        for (int w = 1; w < count; w++) {
            widths[w]->apply(f, a, b, out, NUMBERS);
            assert_same(first, out, NUMBERS, widths[w]->name, (int)f);
        }
    }
    free(memory);
    return hash;
}

static uint64_t hash_of_lobe(int model)
{
    const struct width *widths[WIDTHS_MAX];
    int count = widths_usable(widths, WIDTHS_MAX);
    struct points *first = malloc(sizeof *first), *p = malloc(sizeof *p);
    assert_non_null(first);
    assert_non_null(p);
    struct random r = {77 + (uint64_t)model};
    uint64_t hash = 0xcbf29ce484222325ull;
    for (int kind = LIGHT_POINT; kind <= LIGHT_SPOT_CONES; kind++) {
        for (int variant = 0; variant < 4; variant++) {
            struct modes m = {kind, (kind + model + variant) % 3, model, variant & 1, variant >> 1};
            points_fill(first, 1 + random_bits(&r));
            if (variant == 3) { // any value in some inputs
                for (int i = 0; i < POINTS; i++)
                    first->in[random_bits(&r) % INPUTS][i] =
                        i % 2 ? specials[random_bits(&r) % SPECIALS] : float_of_bits(random_bits(&r));
            }
            memcpy(p->in, first->in, sizeof p->in);
            points_light(first, widths[0], &m);
            hash = hash_of(hash, first->out[0], OUTPUTS * POINTS);
            for (int w = 1; w < count; w++) {
                points_light(p, widths[w], &m);
                assert_same(first->out[0], p->out[0], OUTPUTS * POINTS, widths[w]->name, kind * 10 + model);
            }
        }
    }
    free(first);
    free(p);
    return hash;
}

// The environment's light: for ordinary numbers, and with any value in some inputs.
static uint64_t hash_of_environment(void)
{
    const struct width *widths[WIDTHS_MAX];
    int count = widths_usable(widths, WIDTHS_MAX);
    struct points *first = malloc(sizeof *first), *p = malloc(sizeof *p);
    assert_non_null(first);
    assert_non_null(p);
    struct random r = {4711};
    uint64_t hash = 0xcbf29ce484222325ull;
    for (int turn = 0; turn < 8; turn++) {
        points_fill(first, 1 + random_bits(&r));
        for (int i = 0; i < POINTS && turn > 5; i++)
            first->in[random_bits(&r) % INPUTS][i] =
                i % 2 ? specials[random_bits(&r) % SPECIALS] : float_of_bits(random_bits(&r));
        memcpy(p->in, first->in, sizeof p->in);
        points_environment(first, widths[0], turn & 1);
        hash = hash_of(hash, first->out[0], ENVIRONMENT_OUTPUTS * POINTS);
        for (int w = 1; w < count; w++) {
            points_environment(p, widths[w], turn & 1);
            assert_same(first->out[0], p->out[0], ENVIRONMENT_OUTPUTS * POINTS, widths[w]->name, turn);
        }
    }
    free(first);
    free(p);
    return hash;
}

TEST(test_environment_light)
{
    uint64_t hash = hash_of_environment();
    if (hash != RECORDED_ENVIRONMENT_HASH)
        fail_msg("hash of environment light is 0x%016llx, recorded 0x%016llx", (unsigned long long)hash,
                 (unsigned long long)RECORDED_ENVIRONMENT_HASH);
}

TEST(test_same_bits)
{
    int wrong = 0;
    for (int model = LAM_REFLECTION_AUTO; model < LAM_REFLECTION_COUNT; model++) { // AUTO: the functions
        uint64_t hash = model ? hash_of_lobe(model) : hash_of_functions();
        uint64_t recorded = model ? textbook_hash(model) : RECORDED_HASH;
        if (hash != recorded)
            print_error("hash of %s is 0x%016llx, recorded 0x%016llx\n",
                        model ? lam_reflection_describe((lam_reflection)model)->word : "the functions",
                        (unsigned long long)hash, (unsigned long long)recorded);
        wrong += hash != recorded;
    }
    assert_int_equal(wrong, 0);
}

// Every width finds the same numbers, bit for bit, and accesses nothing after the last one, at the end of the page.
TEST(test_gather)
{
    enum { PLACES = 64, PAGE = 4096 };
    const struct width *widths[WIDTHS_MAX];
    int count = widths_usable(widths, WIDTHS_MAX);
    char *pages = mmap(NULL, 2 * PAGE, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    assert_true(pages != MAP_FAILED);
    assert_int_equal(mprotect(pages + PAGE, PAGE, PROT_NONE), 0);
    struct random r = {5};
    for (int stride = 3; stride <= 4; stride++) {
        int rows = PAGE / 4 / stride;
        float *from = (float *)(void *)(pages + PAGE) - ((rows - 1) * stride + 3);
        for (int i = 0; i < (rows - 1) * stride + 3; i++)
            from[i] = float_of_bits(random_bits(&r) & 0x7f7fffff); // any finite number
        uint32_t at[PLACES];
        for (int i = 0; i < PLACES; i++)
            at[i] = i % 3 == 0 ? (uint32_t)rows - 1 : random_bits(&r) % (uint32_t)rows;
        for (int w = 0; w < count; w++) {
            float columns[3][PLACES];
            widths[w]->gather(from, at, stride, (float *const[]){columns[0], columns[1], columns[2]}, PLACES);
            for (int i = 0; i < PLACES; i++)
                for (int k = 0; k < 3; k++)
                    if (memcmp(&columns[k][i], &from[at[i] * (uint32_t)stride + (uint32_t)k], 4) != 0)
                        fail_msg("%s: stride %d, place %d, number %d", widths[w]->name, stride, i, k);
        }
    }
    munmap(pages, 2 * PAGE);
}
