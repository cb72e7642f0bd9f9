// widths.c: the list of all widths in this program.
#include "widths.h"

#include "cpu_features.h"

extern const struct width width_1, width_4, width_8, width_16;
#ifdef WIDTHS_X86
extern const struct width width_4_sse4, width_8_avx2, width_16_avx512;
#endif

int widths_usable(const struct width *usable[], int room)
{
    static const struct width *const all[] = {
        &width_1,      &width_4,      &width_8,         &width_16,
#ifdef WIDTHS_X86
        &width_4_sse4, &width_8_avx2, &width_16_avx512,
#endif
    };
    int count = 0;
    for (unsigned i = 0; i < sizeof all / sizeof *all && count < room; i++) {
        if (cpu_has((unsigned)all[i]->features))
            usable[count++] = all[i];
    }
    return count;
}
