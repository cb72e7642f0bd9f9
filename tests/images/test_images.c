// test_images.c: every demonstration scene, drawn with every instruction set and thread count, has exactly the recorded
// bytes. `make test` draws each scene with each instruction set, with a varying thread count, and slow builds with a
// third of the instruction sets; the test long-images draws all combinations.
//
//   test-images              compares with tests/images/expected/
//   test-images --update     records the pictures of the plain kernels (look at the pictures before you commit them)
//
// A failure leaves NAME.actual.png and NAME.difference.png in the working directory.
#include "picture_hash.h"
#include "share.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#ifndef EXPECTED // for a call by hand, from the root of the sources
#define EXPECTED "tests/images/expected"
#endif

// The recorded hashes: lines "name pixels file".
static bool recorded(const char *name, struct hashes *hashes)
{
    FILE *file = fopen(EXPECTED "/hashes.txt", "r");
    char line[256], found[64];
    unsigned long long pixels, bytes;
    bool is = false;
    while (file && !is && fgets(line, sizeof line, file))
        is = sscanf(line, "%63s %llx %llx", found, &pixels, &bytes) == 3 && strcmp(found, name) == 0;
    if (file)
        fclose(file);
    if (is)
        *hashes = (struct hashes){pixels, bytes};
    return is;
}

// Writes pictures that show the difference.
static void leave_pictures(const char *name, const lam_image *actual)
{
    lam_image expected = {0};
    lam_error error;
    char path[512];
    snprintf(path, sizeof path, "%s.actual.%s", name, actual->format == LAM_RGBA8 ? "png" : "pfm");
    lam_image_save(actual, path, NULL, &error);
    snprintf(path, sizeof path, EXPECTED "/%s.png", name);
    if (actual->format != LAM_RGBA8 || !lam_image_load(&expected, path, NULL, &error))
        return;
    lam_difference difference;
    if (lam_image_compare(actual, &expected, &difference, &error)) {
        uint8_t *to = expected.pixels;
        const uint8_t *from = actual->pixels;
        for (size_t i = 0; i < picture_bytes(actual); i++) {
            int apart = abs(to[i] - from[i]) * 16;
            to[i] = i % 4 == 3 ? 255 : (uint8_t)(apart > 255 ? 255 : apart);
        }
        snprintf(path, sizeof path, "%s.difference.png", name);
        lam_image_save(&expected, path, NULL, &error);
        print_message("%s: largest difference %g/255, %.2f %% of pixels off by more than 1/255\n", name,
                      difference.maximum * 255, difference.share_over_1 * 100);
    }
    lam_image_free(&expected);
}

static const int threads[] = {1, 2, 5};
enum { THREAD_COUNTS = sizeof threads / sizeof *threads };

static void check_scene(void **state)
{
    const struct demo_row *row = *state;
    struct demo demo;
    lam_error error = {0};
    if (!demo_build(row, &demo, &error))
        fail_msg("%s: %s", row->name, error.text);
    struct hashes expected;
    if (!recorded(row->name, &expected))
        fail_msg("%s: no hash is recorded; test-images --update records it", row->name);
    size_t number = (size_t)(row - demos);
    for (int isa = LAM_ISA_SCALAR; isa < LAM_ISA_COUNT; isa++)
        for (int t = 0; t < THREAD_COUNTS && lam_isa_usable((lam_isa)isa); t++) {
            bool is_slow = IS_SLOW_BUILD && !is_taken(number / THREAD_COUNTS + (size_t)isa, 3);
            if (is_slow || !is_taken(number + (size_t)isa + (size_t)t, THREAD_COUNTS))
                continue;
            lam_image image;
            struct hashes hashes;
            if (!picture_draw(&demo, (lam_isa)isa, threads[t], &image, &error) ||
                !picture_hash(&image, threads[t], &hashes, &error))
                fail_msg("%s: %s", row->name, error.text);
            if (hashes.pixels != expected.pixels)
                leave_pictures(row->name, &image);
            lam_image_free(&image);
            if (hashes.pixels != expected.pixels)
                fail_msg("%s: %s with %d threads drew %016llx, recorded is %016llx", row->name,
                         lam_isa_name((lam_isa)isa), threads[t], (unsigned long long)hashes.pixels,
                         (unsigned long long)expected.pixels);
            if (hashes.file != expected.file)
                fail_msg("%s: %s with %d threads wrote a file %016llx, recorded is %016llx", row->name,
                         lam_isa_name((lam_isa)isa), threads[t], (unsigned long long)hashes.file,
                         (unsigned long long)expected.file);
        }
    lam_scene_free(demo.scene);
}

static int update(void)
{
    FILE *file = fopen(EXPECTED "/hashes.txt", "w");
    if (!file) {
        perror(EXPECTED "/hashes.txt");
        return 1;
    }
    for (int i = 0; i < demo_count; i++) {
        struct demo demo;
        lam_error error = {0};
        lam_image image;
        struct hashes hashes;
        if (!demo_build(&demos[i], &demo, &error) || !picture_draw(&demo, LAM_ISA_SCALAR, 1, &image, &error) ||
            !picture_hash(&image, 1, &hashes, &error)) {
            fprintf(stderr, "%s: %s\n", demos[i].name, error.text);
            return 1;
        }
        fprintf(file, "%s %016llx %016llx\n", demos[i].name, (unsigned long long)hashes.pixels,
                (unsigned long long)hashes.file);
        char path[512];
        snprintf(path, sizeof path, EXPECTED "/%s.png", demos[i].name);
        if (image.format == LAM_RGBA8 && !lam_image_save(&image, path, NULL, &error))
            fprintf(stderr, "%s\n", error.text);
        lam_image_free(&image);
        lam_scene_free(demo.scene);
    }
    return fclose(file) == 0 ? 0 : 1;
}

int main(int argc, char **argv)
{
    if (argc > 1 && strcmp(argv[1], "--update") == 0)
        return update();
    printf("# instruction sets:"); // tests/emulated.py checks that all expected ones are listed
    for (int isa = LAM_ISA_SCALAR; isa < LAM_ISA_COUNT; isa++) {
        if (lam_isa_usable((lam_isa)isa))
            printf(" %s", lam_isa_name((lam_isa)isa));
    }
    printf("\n");
    struct CMUnitTest *tests = calloc((size_t)demo_count, sizeof *tests);
    for (int i = 0; i < demo_count; i++)
        tests[i] = (struct CMUnitTest){demos[i].name, check_scene, NULL, NULL, (void *)(uintptr_t)&demos[i]};
    // The macro cannot be used, because the compiler does not know the table's length.
    int failed = _cmocka_run_group_tests("images", tests, (size_t)demo_count, NULL, NULL);
    free(tests);
    return failed;
}
