// mutate_glb.c: changes the JSON or the buffer of a binary glTF file and updates the sizes.
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

enum { HEAD = 12, NAME_FIRST = 0, ROUND = 4, PADDING = ' ' };

static bool head_probe(const uint8_t *data) { return memcmp(data, "glTF", 4) == 0; }

static void head_put(uint8_t *data, size_t size)
{
    memcpy(data,
           (uint8_t[]){'g', 'l', 'T', 'F', 2, 0, 0, 0, (uint8_t)size, (uint8_t)(size >> 8), (uint8_t)(size >> 16),
                       (uint8_t)(size >> 24)},
           HEAD);
}

#include "mutate_chunks.h"
