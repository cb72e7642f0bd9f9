// highlight.c: finds the brightest highlight of a picture.
#include "highlight.h"

#include <stddef.h>
#include <stdint.h>

struct highlight highlight_find(const lam_image *whole, const lam_image *matt, int enlarged)
{
    int w = whole->width, h = whole->height, width = w / enlarged, height = h / (2 * enlarged);
    int span = w / 40 > 1 ? w / 40 : 1; // the size of the search window
    const uint8_t *a = whole->pixels, *b = matt->pixels;
    int64_t best = -1;
    int best_x = w / 2, best_y = h / 2;
    for (int y = 0; y + span <= h; y += (span + 1) / 2)
        for (int x = 0; x + span <= w; x += (span + 1) / 2) {
            int64_t sum = 0;
            for (int j = y; j < y + span; j++)
                for (int i = x; i < x + span; i++)
                    for (int k = 0; k < 3; k++) {
                        size_t at = 4 * ((size_t)j * (size_t)w + (size_t)i) + (size_t)k;
                        sum += a[at] - b[at];
                    }
            if (sum > best) {
                best = sum;
                best_x = x + span / 2;
                best_y = y + span / 2;
            }
        }
    struct highlight box = {best_x - width / 2, best_y - height / 2, width > 0 ? width : 1, height > 0 ? height : 1};
    box.left = box.left < 0 ? 0 : box.left > w - box.width ? w - box.width : box.left;
    box.top = box.top < 0 ? 0 : box.top > h - box.height ? h - box.height : box.top;
    return box;
}
