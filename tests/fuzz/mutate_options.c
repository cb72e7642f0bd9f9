// mutate_options.c: changes the options or the file of an input that begins with 24 bytes of options, without shifting one
// into the other.
#include "mutate.h"

enum { OPTIONS = 24 };

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t capacity, unsigned seed)
{
    struct parts parts = {.random = seed};
    random_below(&parts, 1);
    if (size < OPTIONS || capacity <= OPTIONS)
        return LLVMFuzzerMutate(data, size, capacity);
    if (random_below(&parts, 2)) {
        for (uint32_t n = 1 + random_below(&parts, 3); n > 0; n--)
            data[random_below(&parts, OPTIONS)] = (uint8_t)random_below(&parts, 256);
        return size;
    }
    return OPTIONS + LLVMFuzzerMutate(data + OPTIONS, size - OPTIONS, capacity - OPTIONS);
}
