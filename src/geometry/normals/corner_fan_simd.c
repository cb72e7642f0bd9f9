// corner_fan_simd.c: compiled once for each instruction set (meson.build, with ISA and LANES): loops over positions
// side by side that the compiler turns into wide registers. Choices are made without branches, and nothing is
// divided by zero.
#include "corner_fan_simd.h"

#include "lanes.h"
#include "linear.h"

#include <string.h>

static bool any_of(const fan_numbers numbers)
{
    uint32_t any = 0;
    for (uint32_t p = 0; p < FAN_PLACES; p++)
        any |= numbers[p];
    return any != 0;
}

// Ascending in each lane. They most often are.
static void sort(fan_numbers *rows, uint32_t count)
{
    fan_numbers wrong = {0};
    for (uint32_t i = 0; i + 1 < count; i++)
        for (uint32_t p = 0; p < FAN_PLACES; p++)
            wrong[p] |= rows[i][p] > rows[i + 1][p];
    for (uint32_t end = any_of(wrong) ? count : 0; end > 1; end--)
        for (uint32_t i = 0; i + 1 < end; i++)
            for (uint32_t p = 0; p < FAN_PLACES; p++) {
                uint32_t a = rows[i][p], b = rows[i + 1][p];
                rows[i][p] = a < b ? a : b;
                rows[i + 1][p] = a < b ? b : a;
            }
}

// The numbers of the vertices around, and the smoothing groups.
static void fetch_vertices(struct fan_block *b, const lam_mesh *mesh)
{
    for (uint32_t i = 0; i < b->count; i++) {
        uint32_t *triangle = b->triangles[i];
        fan_numbers place;
        for (uint32_t p = 0; p < FAN_PLACES; p++) {
            uint32_t corner = b->corners[i][p];
            triangle[p] = corner / 3;
            place[p] = corner - 3 * triangle[p];
            b->next_vertex[i][p] = corner + 1 - 3 * (place[p] == 2);
            b->before_vertex[i][p] = corner - 1 + 3 * (place[p] == 0);
        }
        for (uint32_t p = 0; mesh->indices && p < FAN_PLACES; p += LANES) {
            inum vertex[3], k = inum_load((const int32_t *)place + p);
            igather3(mesh->indices, triangle + p, 3, vertex);
            inum_store((int32_t *)b->next_vertex[i] + p, ipick(k == 0, vertex[1], ipick(k == 1, vertex[2], vertex[0])));
            inum_store((int32_t *)b->before_vertex[i] + p,
                       ipick(k == 0, vertex[2], ipick(k == 1, vertex[0], vertex[1])));
        }
        for (uint32_t p = 0; mesh->smoothing_groups && p < FAN_PLACES; p++)
            b->groups[i][p] = mesh->smoothing_groups[triangle[p]];
    }
}

static void fetch_points(const lam_mesh *mesh, const fan_numbers vertices, float out[3][FAN_PLACES])
{
    for (uint32_t p = 0; p < FAN_PLACES; p += LANES) {
        num point[3];
        gather3(mesh->positions, vertices + p, 3, point);
        for (int a = 0; a < 3; a++)
            num_store(out[a] + p, point[a]);
    }
}

static void fetch(struct fan_block *b, const lam_mesh *mesh)
{
    fan_numbers here;
    fetch_vertices(b, mesh);
    for (uint32_t p = 0; p < FAN_PLACES; p++)
        here[p] = mesh->indices ? mesh->indices[b->corners[0][p]] : b->corners[0][p];
    fetch_points(mesh, here, b->here);
    for (uint32_t i = 0; i < b->count; i++) {
        fetch_points(mesh, b->next_vertex[i], b->next[i]);
        fetch_points(mesh, b->before_vertex[i], b->before[i]);
    }
}

// As look() of corner_fan.c, operation by operation; at one position, 0 and −0 are the same.
static void look(struct fan_block *b)
{
    memset(b->flat, 0, sizeof b->flat);
    for (uint32_t i = 0; i < b->count; i++)
        for (uint32_t p = 0; p < FAN_PLACES; p++) {
            double ax = (double)b->next[i][0][p] - (double)b->here[0][p],
                   ay = (double)b->next[i][1][p] - (double)b->here[1][p],
                   az = (double)b->next[i][2][p] - (double)b->here[2][p];
            double bx = (double)b->before[i][0][p] - (double)b->here[0][p],
                   by = (double)b->before[i][1][p] - (double)b->here[1][p],
                   bz = (double)b->before[i][2][p] - (double)b->here[2][p];
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
                t * (0.9999948346338877 +
                     s * (-0.33295711032247277 +
                          s * (0.1953465900279569 +
                               s * (-0.12044858521312099 + s * (0.05658998519974516 + s * -0.013130382075233026)))));
            angle = steep ? PI / 2 - angle : angle;
            angle = dot < 0 ? PI - angle : angle;
            double weight = spans ? length * angle : 0;
            b->normal[i][0][p] = x;
            b->normal[i][1][p] = y;
            b->normal[i][2][p] = z;
            b->weighted[i][0][p] = x * weight;
            b->weighted[i][1][p] = y * weight;
            b->weighted[i][2][p] = z * weight;
            b->flat[p] |= 1 - (uint32_t)spans;
        }
}

// Which corners are joined to which, by join_few() of corner_fan.c. No coordinate is NaN: equal floats are
// equal bits, but for the sign of zero.
static void link(struct fan_block *b, double least_cosine, bool grouped)
{
    memset(b->links, 0, b->count * sizeof *b->links);
    for (uint32_t i = 0; i < b->count; i++)
        for (uint32_t j = i + 1; j < b->count; j++) {
            fan_numbers near;
            for (uint32_t p = 0; p < FAN_PLACES; p++) {
                double cosine = b->normal[i][0][p] * b->normal[j][0][p] + b->normal[i][1][p] * b->normal[j][1][p] +
                                b->normal[i][2][p] * b->normal[j][2][p];
                near[p] = cosine >= least_cosine;
            }
            if (grouped)
                for (uint32_t p = 0; p < FAN_PLACES; p++)
                    near[p] &= (b->groups[i][p] == b->groups[j][p]) & (b->groups[i][p] != 0);
            for (uint32_t p = 0; p < FAN_PLACES; p++) {
                uint32_t after = (b->next[i][0][p] == b->before[j][0][p]) & (b->next[i][1][p] == b->before[j][1][p]) &
                                 (b->next[i][2][p] == b->before[j][2][p]);
                uint32_t ahead = (b->next[j][0][p] == b->before[i][0][p]) & (b->next[j][1][p] == b->before[i][1][p]) &
                                 (b->next[j][2][p] == b->before[i][2][p]);
                uint32_t joined = (after | ahead) & near[p];
                b->links[i][p] |= joined << j;
                b->links[j][p] |= joined << i;
            }
        }
}

// Adds what is joined to the members; whether there was any.
static bool spread(const struct fan_block *b, fan_numbers members)
{
    fan_numbers more;
    memcpy(more, members, sizeof more);
    for (uint32_t i = 0; i < b->count; i++)
        for (uint32_t p = 0; p < FAN_PLACES; p++)
            more[p] |= -(more[p] >> i & 1) & b->links[i][p];
    fan_numbers differ;
    for (uint32_t p = 0; p < FAN_PLACES; p++)
        differ[p] = more[p] ^ members[p];
    memcpy(members, more, sizeof more);
    return any_of(differ);
}

// As v3_unit (linear.c), which need not scale where the square is neither large nor small. By itself, since
// gcc does not make the loop wide inside of others.
static __attribute__((noinline)) void unit(double sum[3][FAN_PLACES], float out[3][FAN_PLACES])
{
    fan_numbers odd;
    for (uint32_t p = 0; p < FAN_PLACES; p++) {
        double x = sum[0][p], y = sum[1][p], z = sum[2][p], squared = x * x + y * y + z * z;
        int extreme = !((squared > 1e-270) & (squared < 1e270));
        double length = __builtin_sqrt(extreme ? 1 : squared);
        out[0][p] = (float)(x / length);
        out[1][p] = (float)(y / length);
        out[2][p] = (float)(z / length);
        odd[p] = (uint32_t)extreme;
    }
    for (uint32_t p = 0; any_of(odd) && p < FAN_PLACES; p++)
        if (odd[p]) {
            lam_vec3 n = v3_unit(v3(sum[0][p], sum[1][p], sum[2][p]));
            out[0][p] = (float)n.x;
            out[1][p] = (float)n.y;
            out[2][p] = (float)n.z;
        }
}

// Sums in the order of the corners; one that is no member adds 0, which changes nothing.
static void sum(const struct fan_block *b, const fan_numbers members, float out[3][FAN_PLACES])
{
    double total[3][FAN_PLACES] = {0};
    for (uint32_t i = 0; i < b->count; i++)
        for (uint32_t p = 0; p < FAN_PLACES; p++) {
            double counts = (double)(int32_t)(members[p] >> i & 1);
            total[0][p] += b->weighted[i][0][p] * counts;
            total[1][p] += b->weighted[i][1][p] * counts;
            total[2][p] += b->weighted[i][2][p] * counts;
        }
    unit(total, out);
}

static void make(struct fan_block *b, const lam_mesh *mesh, double least_cosine)
{
    sort(b->corners, b->count);
    fetch(b, mesh);
    look(b);
    link(b, least_cosine, mesh->smoothing_groups != NULL);
    fan_numbers left;
    for (uint32_t p = 0; p < FAN_PLACES; p++)
        left[p] = (1u << b->count) - 1;
    for (b->fans = 0; any_of(left); b->fans++) {
        uint32_t *members = b->members[b->fans];
        for (uint32_t p = 0; p < FAN_PLACES; p++)
            members[p] = left[p] & -left[p];
        while (spread(b, members))
            ;
        for (uint32_t p = 0; p < FAN_PLACES; p++)
            left[p] &= ~members[p];
        sum(b, members, b->unit[b->fans]);
    }
}

static uint32_t find(struct fan_block *b, const struct number_set *triangles, uint32_t first)
{
    const uint64_t *bits = triangles->bits;
    const uint32_t *before = triangles->before;
    fan_numbers seen = {0}, with_some = {0};
    uint32_t fans = 0;
    for (uint32_t i = 0; i < b->count; i++)
        for (uint32_t p = 0; p < FAN_PLACES; p++) {
            uint64_t number = (uint64_t)first + b->triangles[i][p];
            uint64_t up_to = bits[number / 64] << (63 - number % 64), is_seen = up_to >> 63;
            uint64_t place = before[number / 64] + (uint64_t)count_bits(up_to) - is_seen;
            seen[p] |= (uint32_t)is_seen << i;
            b->elements[i][p] = 3 * place + b->corners[i][p] - 3 * (uint64_t)b->triangles[i][p];
        }
    for (uint32_t p = 0; p < FAN_PLACES; p++)
        seen[p] = p < b->places && !b->flat[p] ? seen[p] : 0;
    for (uint32_t f = 0; f < b->fans; f++)
        for (uint32_t p = 0; p < FAN_PLACES; p++) {
            b->members[f][p] &= seen[p];
            with_some[p] += b->members[f][p] != 0;
        }
    for (uint32_t p = 0; p < FAN_PLACES; p++)
        fans += with_some[p];
    return fans;
}

#define JOIN(a, b) a##b
#define NAME(isa)  JOIN(fan_lanes_, isa)
extern const struct fan_lanes NAME(ISA);
const struct fan_lanes NAME(ISA) = {.lanes = LANES, .make = make, .find = find};
