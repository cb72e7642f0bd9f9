// corner_fan_simd.c: contains loops over positions in parallel lanes, which the compiler vectorizes. The file is
// compiled once for each instruction set (meson.build, with ISA and LANES). The loops contain no branches and no
// divisions by zero.
#include "corner_fan.h"

#include "angle_series.h"
#include "lanes.h"
#include "linear.h"

#include <string.h>

static bool any_of(const fan_row numbers)
{
    uint32_t any = 0;
    for (uint32_t p = 0; p < FAN_POSITIONS; p++)
        any |= numbers[p];
    return any != 0;
}

// Sorts the corners at each position. Usually the corners are already in order.
static void sort(fan_row *rows, uint32_t count)
{
    fan_row wrong = {0};
    for (uint32_t i = 0; i + 1 < count; i++)
        for (uint32_t p = 0; p < FAN_POSITIONS; p++)
            wrong[p] |= rows[i][p] > rows[i + 1][p];
    for (uint32_t end = any_of(wrong) ? count : 0; end > 1; end--)
        for (uint32_t i = 0; i + 1 < end; i++)
            for (uint32_t p = 0; p < FAN_POSITIONS; p++) {
                uint32_t a = rows[i][p], b = rows[i + 1][p];
                rows[i][p] = a < b ? a : b;
                rows[i + 1][p] = a < b ? b : a;
            }
}

// Fetches the indices of the neighbouring vertices, and the smoothing groups.
static void fetch_vertices(struct corner_fan_block *b, const lam_mesh *mesh)
{
    for (uint32_t i = 0; i < b->count; i++) {
        uint32_t *triangle = b->triangles[i];
        fan_row k;
        for (uint32_t p = 0; p < FAN_POSITIONS; p++) {
            uint32_t corner = b->corners[i][p];
            triangle[p] = corner / 3;
            k[p] = corner - 3 * triangle[p];
            b->next_vertex[i][p] = corner + 1 - 3 * (k[p] == 2);
            b->previous_vertex[i][p] = corner - 1 + 3 * (k[p] == 0);
        }
        for (uint32_t p = 0; mesh->indices && p < FAN_POSITIONS; p += LANES) {
            inum vertex[3], at = inum_load((const int32_t *)k + p);
            igather3(mesh->indices, triangle + p, 3, vertex);
            inum_store((int32_t *)b->next_vertex[i] + p,
                       ipick(at == 0, vertex[1], ipick(at == 1, vertex[2], vertex[0])));
            inum_store((int32_t *)b->previous_vertex[i] + p,
                       ipick(at == 0, vertex[2], ipick(at == 1, vertex[0], vertex[1])));
        }
        for (uint32_t p = 0; mesh->smoothing_groups && p < FAN_POSITIONS; p++)
            b->groups[i][p] = mesh->smoothing_groups[triangle[p]];
    }
}

static void fetch_points(const lam_mesh *mesh, const fan_row vertices, float out[3][FAN_POSITIONS])
{
    for (uint32_t p = 0; p < FAN_POSITIONS; p += LANES) {
        num point[3];
        gather3(mesh->positions, vertices + p, 3, point);
        for (int a = 0; a < 3; a++)
            num_store(out[a] + p, point[a]);
    }
}

static void fetch(struct corner_fan_block *b, const lam_mesh *mesh)
{
    fan_row here;
    fetch_vertices(b, mesh);
    for (uint32_t p = 0; p < FAN_POSITIONS; p++)
        here[p] = mesh->indices ? mesh->indices[b->corners[0][p]] : b->corners[0][p];
    fetch_points(mesh, here, b->here);
    for (uint32_t i = 0; i < b->count; i++) {
        fetch_points(mesh, b->next_vertex[i], b->next[i]);
        fetch_points(mesh, b->previous_vertex[i], b->previous[i]);
    }
}

// Does the same as look() in corner_fan.c, with the same operations in the same order. Coordinates 0 and −0 are equal.
static void look(struct corner_fan_block *b)
{
    memset(b->flat, 0, sizeof b->flat);
    for (uint32_t i = 0; i < b->count; i++)
        for (uint32_t p = 0; p < FAN_POSITIONS; p++) {
            double ax = (double)b->next[i][0][p] - (double)b->here[0][p],
                   ay = (double)b->next[i][1][p] - (double)b->here[1][p],
                   az = (double)b->next[i][2][p] - (double)b->here[2][p];
            double bx = (double)b->previous[i][0][p] - (double)b->here[0][p],
                   by = (double)b->previous[i][1][p] - (double)b->here[1][p],
                   bz = (double)b->previous[i][2][p] - (double)b->here[2][p];
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
            double angle = ANGLE_SERIES(t, s);
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

// Finds the joined corners, like join_few() in corner_fan.c. No coordinate is NaN, so floats are equal if their bits
// are equal, except for the sign of zero. If `by_vertex` is set, also finds open vertices. The compiler makes a copy of
// the function for each case.
static inline __attribute__((always_inline)) void link(struct corner_fan_block *b, double min_cosine, bool grouped,
                                                       const bool by_vertex)
{
    fan_row with_next = {0}, with_previous = {0},
            pairs = {0}; // the corners with a shared edge, as bits, and their number
    memset(b->links, 0, b->count * sizeof *b->links);
    for (uint32_t i = 0; i < b->count; i++)
        for (uint32_t j = i + 1; j < b->count; j++) {
            fan_row near;
            for (uint32_t p = 0; p < FAN_POSITIONS; p++) {
                double cosine = b->normal[i][0][p] * b->normal[j][0][p] + b->normal[i][1][p] * b->normal[j][1][p] +
                                b->normal[i][2][p] * b->normal[j][2][p];
                near[p] = cosine >= min_cosine;
            }
            if (grouped)
                for (uint32_t p = 0; p < FAN_POSITIONS; p++)
                    near[p] &= (b->groups[i][p] == b->groups[j][p]) & (b->groups[i][p] != 0);
            for (uint32_t p = 0; p < FAN_POSITIONS; p++) {
                uint32_t after = (b->next[i][0][p] == b->previous[j][0][p]) &
                                 (b->next[i][1][p] == b->previous[j][1][p]) &
                                 (b->next[i][2][p] == b->previous[j][2][p]);
                uint32_t ahead = (b->next[j][0][p] == b->previous[i][0][p]) &
                                 (b->next[j][1][p] == b->previous[i][1][p]) &
                                 (b->next[j][2][p] == b->previous[i][2][p]);
                uint32_t joined = (after | ahead) & near[p];
                b->links[i][p] |= joined << j;
                b->links[j][p] |= joined << i;
                if (by_vertex) {
                    with_next[p] |= after << i | ahead << j;
                    with_previous[p] |= after << j | ahead << i;
                    pairs[p] += after + ahead;
                }
            }
        }
    const uint32_t all = (1u << b->count) - 1;
    for (uint32_t p = 0; p < FAN_POSITIONS; p++)
        b->open[p] = by_vertex ? (with_next[p] ^ all) | (with_previous[p] ^ all) | (pairs[p] ^ b->count) : 0;
    for (uint32_t i = 0; by_vertex && i < b->count; i++)
        for (uint32_t p = 0; p < FAN_POSITIONS; p++)
            b->open[p] |= (b->next[i][0][p] == b->previous[i][0][p]) & (b->next[i][1][p] == b->previous[i][1][p]) &
                          (b->next[i][2][p] == b->previous[i][2][p]);
}

// Adds to `members` every corner that is joined to a member. Returns whether any corner was added.
static bool spread(const struct corner_fan_block *b, fan_row members)
{
    fan_row more;
    memcpy(more, members, sizeof more);
    for (uint32_t i = 0; i < b->count; i++)
        for (uint32_t p = 0; p < FAN_POSITIONS; p++)
            more[p] |= -(more[p] >> i & 1) & b->links[i][p];
    fan_row differ;
    for (uint32_t p = 0; p < FAN_POSITIONS; p++)
        differ[p] = more[p] ^ members[p];
    memcpy(members, more, sizeof more);
    return any_of(differ);
}

// Normalises like v3_unit (linear.c), which does not scale the vector unless its square is very large or very small.
// This is a separate function, because gcc does not vectorize the loop inside other functions.
static __attribute__((noinline)) void unit(double sum[3][FAN_POSITIONS], float out[3][FAN_POSITIONS])
{
    fan_row odd;
    for (uint32_t p = 0; p < FAN_POSITIONS; p++) {
        double x = sum[0][p], y = sum[1][p], z = sum[2][p], squared = x * x + y * y + z * z;
        int extreme = !((squared > 1e-270) & (squared < 1e270));
        double length = __builtin_sqrt(extreme ? 1 : squared);
        out[0][p] = (float)(x / length);
        out[1][p] = (float)(y / length);
        out[2][p] = (float)(z / length);
        odd[p] = (uint32_t)extreme;
    }
    for (uint32_t p = 0; any_of(odd) && p < FAN_POSITIONS; p++)
        if (odd[p]) {
            lam_vec3 n = v3_unit(v3(sum[0][p], sum[1][p], sum[2][p]));
            out[0][p] = (float)n.x;
            out[1][p] = (float)n.y;
            out[2][p] = (float)n.z;
        }
}

// Sums the weighted normals of the members in the order of the corners. A corner that is not a member adds 0, which
// does not change the sum.
static void sum(const struct corner_fan_block *b, const fan_row members, float out[3][FAN_POSITIONS])
{
    double total[3][FAN_POSITIONS] = {0};
    for (uint32_t i = 0; i < b->count; i++)
        for (uint32_t p = 0; p < FAN_POSITIONS; p++) {
            double counts = (double)(int32_t)(members[p] >> i & 1);
            total[0][p] += b->weighted[i][0][p] * counts;
            total[1][p] += b->weighted[i][1][p] * counts;
            total[2][p] += b->weighted[i][2][p] * counts;
        }
    unit(total, out);
}

static void make(struct corner_fan_block *b, const lam_mesh *mesh, double min_cosine)
{
    sort(b->corners, b->count);
    fetch(b, mesh);
    look(b);
    if (b->by_vertex)
        link(b, min_cosine, mesh->smoothing_groups != NULL, true);
    else
        link(b, min_cosine, mesh->smoothing_groups != NULL, false);
    fan_row left;
    for (uint32_t p = 0; p < FAN_POSITIONS; p++)
        left[p] = (1u << b->count) - 1;
    for (b->fans = 0; any_of(left); b->fans++) {
        uint32_t *members = b->members[b->fans];
        for (uint32_t p = 0; p < FAN_POSITIONS; p++)
            members[p] = left[p] & -left[p];
        while (spread(b, members))
            ;
        for (uint32_t p = 0; p < FAN_POSITIONS; p++)
            left[p] &= ~members[p];
        sum(b, members, b->unit[b->fans]);
    }
}

static uint32_t locate(struct corner_fan_block *b, const lam_mesh *mesh, const struct rank_bitset *triangles,
                       uint32_t first, const uint64_t *done)
{
    const uint64_t *bits = triangles->bits;
    const uint32_t *ranks = triangles->ranks;
    fan_row wanted = {0}, with_some = {0};
    uint32_t fans = 0;
    for (uint32_t i = 0; i < b->count; i++)
        for (uint32_t p = 0; p < FAN_POSITIONS; p++) {
            uint64_t number = (uint64_t)first + b->triangles[i][p];
            uint64_t up_to = bits[number / 64] << (63 - number % 64), is_member = up_to >> 63;
            uint64_t index = ranks[number / 64] + (uint64_t)count_bits(up_to) - is_member;
            wanted[p] |= (uint32_t)is_member << i;
            b->elements[i][p] = 3 * index + b->corners[i][p] - 3 * (uint64_t)b->triangles[i][p];
        }
    for (uint32_t i = 0; done && i < b->count; i++)
        for (uint32_t p = 0; p < FAN_POSITIONS; p++) {
            uint32_t vertex = mesh->indices[b->corners[i][p]];
            wanted[p] &= ~((uint32_t)(done[vertex / 64] >> vertex % 64 & 1) << i);
        }
    for (uint32_t p = 0; p < FAN_POSITIONS; p++)
        wanted[p] = p < b->positions && !(b->flat[p] | b->open[p]) ? wanted[p] : 0;
    for (uint32_t f = 0; f < b->fans; f++)
        for (uint32_t p = 0; p < FAN_POSITIONS; p++) {
            b->members[f][p] &= wanted[p];
            with_some[p] += b->members[f][p] != 0;
        }
    for (uint32_t p = 0; p < FAN_POSITIONS; p++)
        fans += with_some[p];
    return fans;
}

extern const struct corner_fan_simd FOR_ISA(corner_fan_simd);
const struct corner_fan_simd FOR_ISA(corner_fan_simd) = {.lanes = LANES, .make = make, .locate = locate};
