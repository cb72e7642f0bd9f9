// behind.c: makes the levels of the picture behind rough and thick glass, and samples them.
#include "behind.h"

#define LANES 1
#include "functions.h"

#include <string.h>

static int half_of(int size) { return size > 1 ? size / 2 : 1; }

bool behind_make(struct behind *behind, struct buffer *memory, int width, int height, size_t tiles,
                 struct call_control *call, lam_error *error)
{
    size_t texels = 0, first[BEHIND_LEVELS];
    behind->levels = 0;
    for (int w = width, h = height;; w = half_of(w), h = half_of(h)) {
        int level = behind->levels++;
        first[level] = texels;
        behind->width[level] = w;
        behind->height[level] = h;
        texels += (size_t)w * (size_t)h;
        if ((w == 1 && h == 1) || behind->levels == BEHIND_LEVELS)
            break;
    }
    if (!buffer_reserve(memory, texels * 4 * sizeof(float) + tiles, call, error))
        return false;
    for (int level = 0; level < behind->levels; level++)
        behind->texels[level] = (float *)memory->data + 4 * first[level];
    behind->glass = (uint8_t *)((float *)memory->data + 4 * texels);
    memset(behind->glass, 0, tiles);
    memset(memory->data, 0, (size_t)width * (size_t)height * 4 * sizeof(float));
    return true;
}

// Consecutive texels of a level, starting with `first`, and their weights.
struct taps {
    int first, count;
    float weight[4];
};

static int clamped(int i, int count) { return i < 0 ? 0 : i < count ? i : count - 1; }

static const float *texel_at(const struct behind *behind, int level, int x, int y)
{
    size_t row = (size_t)clamped(y, behind->height[level]) * (size_t)behind->width[level];
    return behind->texels[level] + 4 * (row + (size_t)clamped(x, behind->width[level]));
}

// Texel `i` of the next level, which has `count` texels, covers several texels of this level, which has `size` texels.
// Returns these texels, with the covered fraction of each as its weight. A texel covers two texels, or three if the
// size is odd; the outer two of three are covered only partly.
static struct taps covered_taps(int i, int count, int size)
{
    if (size == 1)
        return (struct taps){0, 1, {1}};
    if (size % 2 == 0)
        return (struct taps){2 * i, 2, {0.5f, 0.5f}};
    float share = 1 / (float)size;
    return (struct taps){2 * i, 3, {(float)(count - i) * share, (float)count * share, (float)(i + 1) * share}};
}

static void sum_taps(const struct behind *behind, int level, const struct taps *across, const struct taps *down,
                     float out[4])
{
    for (int c = 0; c < 4; c++)
        out[c] = 0;
    for (int j = 0; j < down->count; j++)
        for (int i = 0; i < across->count; i++) {
            const float *texel = texel_at(behind, level, across->first + i, down->first + j);
            float weight = across->weight[i] * down->weight[j];
            for (int c = 0; c < 4; c++)
                out[c] += texel[c] * weight;
        }
}

void behind_fill(struct behind *behind)
{
    for (int level = 1; level < behind->levels; level++) {
        float *to = behind->texels[level];
        int width = behind->width[level], height = behind->height[level];
        for (int y = 0; y < height; y++)
            for (int x = 0; x < width; x++, to += 4) {
                struct taps across = covered_taps(x, width, behind->width[level - 1]);
                struct taps down = covered_taps(y, height, behind->height[level - 1]);
                sum_taps(behind, level - 1, &across, &down, to);
            }
    }
}

// Returns the texels around a position and their weights. The position is in texels; the centre of texel i is at i + ½.
static struct taps linear_taps(float position)
{
    float at = position - 0.5f;
    int first = (int)at - (at < 0);
    float t = at - (float)first;
    return (struct taps){first, 2, {1 - t, t}};
}

static struct taps spline_taps(float position)
{
    struct taps linear = linear_taps(position);
    float t = linear.weight[1], u = linear.weight[0], t2 = t * t, u2 = u * u;
    return (struct taps){linear.first - 1,
                         4,
                         {u2 * u * (1 / 6.0f), (4 + t2 * (3 * t - 6)) * (1 / 6.0f), (4 + u2 * (3 * u - 6)) * (1 / 6.0f),
                          t2 * t * (1 / 6.0f)}};
}

static void look_at_level(const struct behind *behind, int level, float x, float y, float out[4])
{
    x *= (float)behind->width[level] / (float)behind->width[0];
    y *= (float)behind->height[level] / (float)behind->height[0];
    struct taps across = level ? spline_taps(x) : linear_taps(x), down = level ? spline_taps(y) : linear_taps(y);
    sum_taps(behind, level, &across, &down, out);
}

// Clamps a coordinate to the picture.
static float inside(float x, int size) { return x > 0 ? x < (float)size ? x : (float)size : 0; }

void behind_look(const struct behind *behind, float x, float y, float square, float out[4])
{
    float last = (float)(behind->levels - 1), level = square > 1 ? 0.5f * log2_of(square) : 0;
    level = level < last ? level : last;
    int low = (int)level;
    float part = level - (float)low;
    x = inside(x, behind->width[0]);
    y = inside(y, behind->height[0]);
    look_at_level(behind, low, x, y, out);
    if (!(part > 0))
        return;
    float higher[4];
    look_at_level(behind, low + 1, x, y, higher);
    for (int c = 0; c < 4; c++)
        out[c] += (higher[c] - out[c]) * part;
}
