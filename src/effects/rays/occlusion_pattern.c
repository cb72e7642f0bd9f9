// occlusion_pattern.c: computes the rays of ambient occlusion.
#include "rays.h"

#include "linear.h"

// Inserts a 0 after each bit of a number from 0 to 1023.
static uint32_t spread_bits(uint32_t n)
{
    uint32_t spread = 0;
    for (int bit = 0; bit < 10; bit++)
        spread |= (n >> bit & 1) << (2 * bit);
    return spread;
}

// Returns the position of a point on the disc along a space-filling curve (Morton, 1966).
static uint32_t place_of(double x, double y)
{
    return spread_bits((uint32_t)(511.5 * (x + 1))) | spread_bits((uint32_t)(511.5 * (y + 1))) << 1;
}

void occlusion_pattern_fill(struct occlusion_pattern *pattern, int count)
{
    static const double golden_angle = 2.39996322972865332, length_step = 0.41421356237309505; // √2 − 1
    uint32_t places[OCCLUSION_RAYS_MAX];
    pattern->count = count;
    for (int i = 0; i < count; i++) {
        double share = (i + 0.5) / count, radius = math_sqrt(share), length = length_step * (i + 0.5);
        double x = radius * math_cos(golden_angle * i), y = radius * math_sin(golden_angle * i);
        uint32_t place = place_of(x, y);
        int at = i;
        for (; at > 0 && places[at - 1] > place; at--) { // stable insertion sort
            places[at] = places[at - 1];
            pattern->x[at] = pattern->x[at - 1];
            pattern->y[at] = pattern->y[at - 1];
            pattern->z[at] = pattern->z[at - 1];
            pattern->length[at] = pattern->length[at - 1];
        }
        places[at] = place;
        pattern->x[at] = x;
        pattern->y[at] = y;
        pattern->z[at] = math_sqrt(1 - share);
        pattern->length[at] = length - (int)length;
    }
    // Fills the elements that no ray uses but that a vector of lanes may read.
    for (int i = count; i < OCCLUSION_RAYS_MAX; i++) {
        pattern->x[i] = pattern->y[i] = pattern->length[i] = 0;
        pattern->z[i] = 1;
    }
    for (int i = 0; i < OCCLUSION_TURNS; i++) {
        pattern->cosine[i] = math_cos(2 * PI * i / OCCLUSION_TURNS);
        pattern->sine[i] = math_sin(2 * PI * i / OCCLUSION_TURNS);
    }
}
