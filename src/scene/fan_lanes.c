// fan_lanes.c: compiled once for each instruction set (meson.build, with ISA and LANES): plain loops that the
// compiler turns into wide registers. Choices are made without branches, and nothing is divided by zero.
#include "fan_lanes.h"

#include "linear.h"
#include "weld.h"

#include <string.h>

static inline uint32_t bits_of(float x)
{
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits == 0x80000000u ? 0 : bits;
}

static inline uint32_t key_of(float x, float y, float z)
{
    return (bits_of(x) * 0x9e3779b1u ^ bits_of(y) * 0x85ebca77u) + bits_of(z) * 0xc2b2ae3du;
}

static size_t whole_steps(size_t count) { return (count + FAN_STEP - 1) / FAN_STEP * FAN_STEP; }

// As look() of normals_fan.c, operation by operation.
static void look(struct fan_corners *c, size_t count)
{
    count = whole_steps(count);
    for (size_t i = 0; i < count; i++) {
        double ax = (double)c->next[0][i] - (double)c->here[0][i],
               ay = (double)c->next[1][i] - (double)c->here[1][i],
               az = (double)c->next[2][i] - (double)c->here[2][i];
        double bx = (double)c->before[0][i] - (double)c->here[0][i],
               by = (double)c->before[1][i] - (double)c->here[1][i],
               bz = (double)c->before[2][i] - (double)c->here[2][i];
        double x = ay * bz - az * by, y = az * bx - ax * bz, z = ax * by - ay * bx;
        double length = __builtin_sqrt(x * x + y * y + z * z);
        int spans = (length > 0) & (length < 1e300);
        double scale = 1 / (spans ? length : 1);
        x = spans ? x * scale : 0;
        y = spans ? y * scale : 0;
        z = spans ? z * scale : 0;
        // angle_of(length, dot)
        double dot = ax * bx + ay * by + az * bz, across = dot < 0 ? -dot : dot;
        int steep = length > across;
        double larger = steep ? length : across;
        double t = (steep ? across : length) / (spans ? larger : 1), s = t * t;
        double angle =
            t *
            (0.9999948346338877 +
             s * (-0.33295711032247277 +
                  s * (0.1953465900279569 +
                       s * (-0.12044858521312099 + s * (0.05658998519974516 + s * -0.013130382075233026)))));
        angle = steep ? PI / 2 - angle : angle;
        angle = dot < 0 ? PI - angle : angle;
        angle = spans ? angle : 0;
        c->normal[0][i] = x;
        c->normal[1][i] = y;
        c->normal[2][i] = z;
        c->weighted[0][i] = x * angle;
        c->weighted[1][i] = y * angle;
        c->weighted[2][i] = z * angle;
        c->spans[i] = (uint32_t)spans;
    }
    for (size_t i = 0; i < count; i++) {
        c->next_key[i] = key_of(c->next[0][i], c->next[1][i], c->next[2][i]);
        c->before_key[i] = key_of(c->before[0][i], c->before[1][i], c->before[2][i]);
    }
}

static inline double magnitude(double x) { return x < 0 ? -x : x; }

// As v3_unit (linear.c), where it need not scale first.
static void unit(struct fan_sums *s, size_t count)
{
    count = whole_steps(count);
    for (size_t i = 0; i < count; i++) {
        double x = s->sum[0][i], y = s->sum[1][i], z = s->sum[2][i];
        double most = magnitude(x) > magnitude(y) ? magnitude(x) : magnitude(y);
        most = most > magnitude(z) ? most : magnitude(z);
        int plain = (most >= 1e-140) & (most <= 1e140);
        double length = __builtin_sqrt(x * x + y * y + z * z);
        length = plain ? length : 1;
        s->unit[0][i] = (float)(x / length);
        s->unit[1][i] = (float)(y / length);
        s->unit[2][i] = (float)(z / length);
        s->plain[i] = (uint32_t)plain;
    }
}

static void ask(const float *points, size_t count, const struct fan_filter *filter, uint64_t *hashes,
                uint32_t *has)
{
    const uint32_t *words = filter->bits;
    const unsigned shift = filter->shift;
    for (size_t i = 0; i < count; i++) {
        uint32_t bits[3] = {bits_of(points[3 * i]), bits_of(points[3 * i + 1]), bits_of(points[3 * i + 2])};
        hashes[i] = position_hash(bits);
    }
    for (size_t i = 0; i < count; i++) {
        uint32_t bit = (uint32_t)(hashes[i] >> shift);
        has[i] = words[bit / 32] >> bit % 32 & 1;
    }
}

#define JOIN(a, b) a##b
#define NAME(isa)  JOIN(fan_lanes_, isa)
extern const struct fan_lanes NAME(ISA);
const struct fan_lanes NAME(ISA) = {.lanes = LANES, .look = look, .unit = unit, .ask = ask};
