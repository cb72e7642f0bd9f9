// test.h: a test program. TEST(name) { … } defines a test and adds it to the program's list; the tests run in the order
// of the file. FIXTURE names functions that run before the first test and after the last test.
#ifndef TEST_H
#define TEST_H

#include <lambent/lambent.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <cmocka.h>

static struct CMUnitTest test_list[64];
static size_t test_count;
static CMFixtureFunction test_set_up, test_tear_down;

static inline void test_add(struct CMUnitTest test)
{
    if (test_count == sizeof test_list / sizeof *test_list)
        abort(); // enlarge the list
    test_list[test_count++] = test;
}

// Further arguments are members of CMUnitTest, such as .setup_func = make_folder.
#define TEST(NAME, ...)                                                                                                \
    static void NAME(void);                                                                                            \
    static void run_##NAME(void **cmocka_state)                                                                        \
    {                                                                                                                  \
        (void)cmocka_state;                                                                                            \
        NAME();                                                                                                        \
    }                                                                                                                  \
    __attribute__((constructor)) static void add_##NAME(void)                                                          \
    {                                                                                                                  \
        test_add((struct CMUnitTest){.name = #NAME, .test_func = run_##NAME, __VA_ARGS__});                            \
    }                                                                                                                  \
    static void NAME(void)

#define FIXTURE(SET_UP, TEAR_DOWN)                                                                                     \
    __attribute__((constructor)) static void add_fixture(void)                                                         \
    {                                                                                                                  \
        test_set_up = SET_UP;                                                                                          \
        test_tear_down = TEAR_DOWN;                                                                                    \
    }

// Fails with the text of the variable `error` if a call or a pointer is false.
#define SUCCEEDS(CALL)                                                                                                 \
    do {                                                                                                               \
        if (!(CALL))                                                                                                   \
            fail_msg("%s", error.text);                                                                                \
    } while (0)

// Declares a variable that is freed at the end of its block.
#define AUTO(TYPE, NAME, FREE)                                                                                         \
    static inline void free_##NAME(TYPE *at) { FREE; }
AUTO(lam_scene *, scene, lam_scene_free(*at))
AUTO(lam_device *, device, lam_device_free(*at))
AUTO(lam_image, image, lam_image_free(at))
AUTO(lam_bytes, bytes, lam_bytes_free(at))
#undef AUTO
#define AUTO_SCENE  __attribute__((cleanup(free_scene))) lam_scene *
#define AUTO_DEVICE __attribute__((cleanup(free_device))) lam_device *
#define AUTO_IMAGE  __attribute__((cleanup(free_image))) lam_image
#define AUTO_BYTES  __attribute__((cleanup(free_bytes))) lam_bytes

int main(void) { return _cmocka_run_group_tests("tests", test_list, test_count, test_set_up, test_tear_down); }

#endif
