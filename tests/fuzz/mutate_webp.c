// mutate_webp.c: changes a chunk of a WebP file and updates the sizes.
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

enum { HEAD = 12, NAME_FIRST = 1, ROUND = 2, PADDING = 0 };

static bool head_probe(const uint8_t *data) { return memcmp(data, "RIFF", 4) == 0 && memcmp(data + 8, "WEBP", 4) == 0; }

static void head_put(uint8_t *data, size_t size)
{
    const uint32_t rest = (uint32_t)size - 8;
    memcpy(data,
           (uint8_t[]){'R', 'I', 'F', 'F', (uint8_t)rest, (uint8_t)(rest >> 8), (uint8_t)(rest >> 16),
                       (uint8_t)(rest >> 24), 'W', 'E', 'B', 'P'},
           HEAD);
}

#include "mutate_chunks.h"
