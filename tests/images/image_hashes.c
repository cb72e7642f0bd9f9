// image_hashes.c: prints the hashes of the image table as this build draws it, for machines on which the test framework
// does not run (tests/web.py compares them with tests/images/expected/hashes.txt):
//
//   image-hashes [NUMBER OF [THREADS]]    lines "ISA NAME PIXELS FILE"; with two numbers, scenes NUMBER, NUMBER + OF, ...; one thread
//
// It exits with 1 and a message if something cannot be drawn.
#include "picture_hash.h"

#include <stdio.h>
#include <stdlib.h>

int main(int argc, char **argv)
{
    int first = argc >= 3 ? atoi(argv[1]) : 0, step = argc >= 3 ? atoi(argv[2]) : 1,
        threads = argc == 4 ? atoi(argv[3]) : 1;
    for (int i = first; step > 0 && i < demo_count; i += step) {
        struct demo demo;
        lam_error error = {0};
        if (!demo_build(&demos[i], &demo, &error)) {
            fprintf(stderr, "%s: %s\n", demos[i].name, error.text);
            return 1;
        }
        for (int isa = LAM_ISA_SCALAR; isa < LAM_ISA_COUNT; isa++) {
            lam_image image;
            struct hashes hashes;
            if (!lam_isa_usable((lam_isa)isa))
                continue;
            if (!picture_draw(&demo, (lam_isa)isa, threads, &image, &error) ||
                !picture_hash(&image, 1, &hashes, &error)) {
                fprintf(stderr, "%s, %s: %s\n", demos[i].name, lam_isa_name((lam_isa)isa), error.text);
                return 1;
            }
            printf("%s %s %016llx %016llx\n", lam_isa_name((lam_isa)isa), demos[i].name,
                   (unsigned long long)hashes.pixels, (unsigned long long)hashes.file);
            lam_image_free(&image);
        }
        lam_scene_free(demo.scene);
    }
    return 0;
}
