// light_coverage.h: computes the share of a light with a size that few triangles cover, without rays. Define LANES before
// including this header.
//
// The triangles between the light and a cell of pixels are listed with one traversal of the hierarchy. At each fragment,
// a test of LANES fragments at a time in single precision excludes triangles that cannot cover any of the light. For the
// others, COVER_POINTS points of the light are tested at once. If more than BLOCKERS_MAX triangles are listed, or
// triangles transmit light, rays are used instead (penumbra.h).
#ifndef LIGHT_COVERAGE_H
#define LIGHT_COVERAGE_H

#include "light_rays.h"

#include <string.h>

// The batch whose light is computed.
struct pixel_rays {
    struct light_rays *rays;
    const struct ray_starts *starts;
    const struct ray_pixels *pixels;
    float (*passed)[RAY_STARTS_MAX];
    int channels;
    bool directional;
    double light[3], radius; // in the hierarchy's space
    int blocker_count;       // −1 if the blockers are not listed
    double middle[3];        // of the cell
};

// Cells with up to BLOCKERS_TRIED listed triangles, BLOCKERS_FEW of which may cover light at a fragment on average, need
// no rays. The light at a fragment is computed from up to BLOCKERS_COVER triangles. Lit cells with up to BLOCKERS_LIT
// listed triangles are checked with these.
enum { BLOCKERS_TRIED = 128, BLOCKERS_FEW = 6, BLOCKERS_COVER = 160, BLOCKERS_LIT = 512 };

// --- triangles that may block light on its way to a cell

// The hull of all rays from a cell: a cone with a rounded end, in the hierarchy's space.
struct shaft {
    double from[3], axis[3]; // `axis` has the length 1
    double radius, growth, length;
    double spread; // the largest difference between two directions of the shaft and the axis, all of length 1 along it
};

static bool shaft_of(const struct pixel_rays *s, const uint16_t *points, int count, struct shaft *shaft)
{
    double low[3], high[3], square = 0;
    for (int k = 0; k < 3; k++) {
        low[k] = high[k] = s->starts->origin[k][points[0]];
        for (int i = 1; i < count; i++) {
            double x = s->starts->origin[k][points[i]];
            low[k] = x < low[k] ? x : low[k];
            high[k] = x > high[k] ? x : high[k];
        }
        shaft->from[k] = 0.5 * (low[k] + high[k]);
        square += (high[k] - low[k]) * (high[k] - low[k]);
    }
    shaft->radius = 0.5 * __builtin_sqrt(square);
    double length = 0;
    for (int k = 0; k < 3; k++) {
        shaft->axis[k] = s->directional ? s->pixels->scratch->direction[k][points[0]] : s->light[k] - shaft->from[k];
        length += shaft->axis[k] * shaft->axis[k];
    }
    length = __builtin_sqrt(length);
    shaft->spread = (s->radius + (s->directional ? 0 : shaft->radius)) / length;
    for (int k = 0; k < 3; k++)
        shaft->axis[k] /= length;
    if (s->directional) {
        shaft->growth = s->radius;
        shaft->length = 1e30; // the ground may be far from the triangles
        return length > 0 && s->radius < 0.4;
    }
    // The sides of a cone that contains both balls are at most 1.1 times as far from the axis as the balls' sum, if the
    // light is not wide. Wide lights use rays.
    shaft->growth = s->radius / length;
    shaft->length = length;
    return s->radius + shaft->radius < 0.4 * length;
}

// Returns whether a box may intersect a shaft. The box is given by its centre and half of its size.
static bool shaft_meets(const struct shaft *shaft, const double centre[3], const double half[3])
{
    double along = 0, extent = 0, square = 0, size = 0;
    for (int k = 0; k < 3; k++) {
        double d = centre[k] - shaft->from[k];
        along += d * shaft->axis[k];
        extent += half[k] * __builtin_fabs(shaft->axis[k]);
        square += d * d;
        size += half[k] * half[k];
    }
    double last = along + extent, most = last < shaft->length ? last : shaft->length;
    if (last < -shaft->radius || along - extent > shaft->length + shaft->growth * shaft->length)
        return false;
    double reach = 1.1 * (shaft->radius + shaft->growth * (most > 0 ? most : 0)) + __builtin_sqrt(size) + 0x1p-18;
    return square - along * along <= reach * reach;
}

// Returns whether a triangle may cover light at a point of the shaft's ball (see below for the lines). Compared with the
// middle of the ball, n changes by at most the radius times an edge, and the direction to the light by at most the
// radius.
static bool shaft_meets_triangle(const struct shaft *shaft, const double p[3][3])
{
    double q[3][3], n[3][3], edge[3], normal[3] = {0}, height = 0;
    bool below = false, above = false;
    for (int c = 0; c < 3; c++)
        for (int k = 0; k < 3; k++)
            q[c][k] = p[c][k] - shaft->from[k];
    for (int c = 0, a = 1, b = 2; c < 3; a = b, b = c++) {
        double value = 0, size = 0;
        edge[c] = 0;
        for (int i = 0, j = 1, k = 2; i < 3; j = k, k = i++) {
            n[c][i] = q[a][j] * q[b][k] - q[a][k] * q[b][j];
            normal[i] += n[c][i];
            value += n[c][i] * shaft->axis[i];
            size += n[c][i] * n[c][i];
            edge[c] += (q[a][i] - q[b][i]) * (q[a][i] - q[b][i]);
        }
        // `axis` has the length 1: the light's radius and the ball are scaled accordingly
        double slack = __builtin_sqrt(size) * shaft->spread + __builtin_sqrt(edge[c]) * shaft->radius * 2 + 0x1p-20;
        below |= value + slack < 0;
        above |= value - slack > 0;
    }
    double area = 0;
    for (int k = 0; k < 3; k++) {
        height += n[0][k] * q[0][k];
        area += normal[k] * normal[k];
    }
    double slack = __builtin_sqrt(area) * shaft->radius + 0x1p-20;
    return !((below && above) || (height > slack && below) || (height < -slack && above));
}

// Adds the triangles of a leaf that may intersect the shaft. Returns false if there is no space for them.
static bool list_leaf(struct pixel_rays *s, const struct shaft *shaft, uint32_t first, uint32_t count)
{
    struct ray_scratch *scratch = s->pixels->scratch;
    const float *leaf = s->rays->hierarchy->leaves + LEAF_FLOATS * (size_t)first;
    for (uint32_t i = 0; i < count; i++) {
        double p[3][3], centre[3], half[3];
        for (uint32_t k = 0; k < 3; k++) {
            for (uint32_t c = 0; c < 3; c++)
                p[c][k] = (double)leaf[(3 * c + k) * count + i];
            double low = p[0][k] < p[1][k] ? p[0][k] : p[1][k], high = p[0][k] < p[1][k] ? p[1][k] : p[0][k];
            low = p[2][k] < low ? p[2][k] : low;
            high = p[2][k] > high ? p[2][k] : high;
            centre[k] = 0.5 * (low + high);
            half[k] = 0.5 * (high - low);
        }
        if (!shaft_meets(shaft, centre, half) || !shaft_meets_triangle(shaft, (const double(*)[3])p))
            continue;
        if (s->blocker_count == BLOCKERS_MAX)
            return false;
        for (int c = 0; c < 3; c++)
            for (int k = 0; k < 3; k++)
                scratch->corners[s->blocker_count][c][k] = (float)(p[c][k] - shaft->from[k]);
        scratch->blockers[s->blocker_count++] = leaf_number(leaf, count, i);
    }
    return true;
}

static bool list_tree(struct pixel_rays *s, const struct shaft *shaft)
{
    const struct hierarchy *h = s->rays->hierarchy;
    uint32_t stack[NODE_CHILDREN * HIERARCHY_DEPTH] = {0};
    for (int waiting = h->node_count > 0; waiting;) {
        const struct ray_node *node = &h->nodes[stack[--waiting]];
        for (int i = 0; i < NODE_CHILDREN; i++) {
            double centre[3], half[3];
            if (!(node->planes[0][0][i] <= node->planes[1][0][i]))
                continue; // no child
            for (int k = 0; k < 3; k++) {
                double low = (double)node->planes[0][k][i], high = (double)node->planes[1][k][i];
                centre[k] = 0.5 * (low + high);
                half[k] = 0.5 * (high - low);
            }
            if (!shaft_meets(shaft, centre, half))
                continue;
            if (!node->count[i])
                stack[waiting++] = node->child[i];
            else if (!list_leaf(s, shaft, node->child[i], node->count[i]))
                return false;
        }
    }
    return true;
}

// Lists the triangles that may block light on its way to a cell.
static void find_blockers(struct pixel_rays *s, const uint16_t *points, int count)
{
    struct shaft shaft;
    s->blocker_count = 0;
    bool found = !s->rays->frame->passes_rays && shaft_of(s, points, count, &shaft) && list_tree(s, &shaft);
    if (found)
        memcpy(s->middle, shaft.from, sizeof s->middle);
    else
        s->blocker_count = -1;
}

// --- coverage of the light by listed triangles, seen from a point
//
// The ray to the point (x, y) of the light has the direction D = d + x u + y v. It intersects a triangle with the corners
// q₀, q₁, q₂, relative to the origin of the ray, if D·(q_i × q_j) has the sign of q₀·(q₁ × q₂) for all three edges. To
// a light at a distance, D·n must also exceed q₀·n, so that the triangle is nearer than the light (n is the sum of the
// three cross products). All four are linear functions a + b x + c y.

struct light_line {
    double a, b, c;
};

// Returns 1 if a function is positive on the whole light, −1 if it is negative, otherwise 0.
static int line_side(struct light_line e) { return e.a * e.a > e.b * e.b + e.c * e.c ? (e.a > 0 ? 1 : -1) : 0; }

static struct light_line line_of(const struct pixel_rays *s, int point, const double n[3], double sign)
{
    const struct ray_scratch *aims = s->pixels->scratch;
    struct light_line e = {0};
    for (int k = 0; k < 3; k++) {
        e.a += sign * n[k] * aims->direction[k][point];
        e.b += sign * n[k] * aims->u[k][point];
        e.c += sign * n[k] * aims->v[k][point];
    }
    return e;
}

// Returns a power of two whose product with x is between 1 and 2. The edges of two triangles that meet are then scaled by
// the same number, so that no point of the light is between them.
static double inverse_power(double x)
{
    union {
        double number;
        uint64_t bits;
    } power = {x};
    uint64_t exponent = power.bits >> 52;
    power.bits = (exponent ? 2046 - exponent : 2045) << 52;
    return power.number;
}

// The lines that divide the light, with sums of absolute values between 1 and 2.
struct light_cuts {
    float a[4], b[4], c[4];
    int count;
};

LANE_FN uint32_t cut_group(const struct light_cuts *cuts, const struct light_pattern *pattern, int group)
{
    uint32_t bits = 0;
    for (int part = 0; part < COVER_GROUP; part += LANES) {
        num x = num_load(pattern->cover[0] + COVER_GROUP * group + part),
            y = num_load(pattern->cover[1] + COVER_GROUP * group + part);
        mask inside = (cuts->a[0] + cuts->b[0] * x) + cuts->c[0] * y >= 0.0f;
        for (int i = 1; i < cuts->count; i++)
            inside = both(inside, (cuts->a[i] + cuts->b[i] * x) + cuts->c[i] * y >= 0.0f);
        bits |= (uint32_t)mask_bits(inside) << part;
    }
    return bits;
}

// Adds the points on the positive side of all lines. Most groups of points are on one side of each line. The rounding
// errors of a group and of a point are below 2⁻²⁰ together.
LANE_FN void cut_points(const struct light_cuts *cuts, const struct light_pattern *pattern, uint32_t hit[COVER_GROUPS])
{
    for (int first = 0; first < COVER_GROUPS; first += LANES) {
        num x = num_load(pattern->group[0] + first), y = num_load(pattern->group[1] + first),
            radius = num_load(pattern->group[2] + first);
        mask outside = lane_numbers() < 0, cut = outside;
        for (int i = 0; i < cuts->count; i++) {
            num value = (cuts->a[i] + cuts->b[i] * x) + cuts->c[i] * y;
            num reach = radius * (absolute(num_of(cuts->b[i])) + absolute(num_of(cuts->c[i]))) + 0x1p-20f;
            outside = either(outside, value + reach < 0.0f);
            cut = either(cut, value - reach < 0.0f);
        }
        const unsigned divided = (unsigned)mask_bits(cut);
        for (unsigned bits = ~(unsigned)mask_bits(outside) & (unsigned)((1ull << LANES) - 1); bits; bits &= bits - 1) {
            const int i = __builtin_ctz(bits);
            hit[first + i] |= divided >> i & 1 ? cut_group(cuts, pattern, first + i) : UINT32_MAX;
        }
    }
}

// Adds the points of the light that a triangle covers. Returns false if it covers the whole light.
static bool cover_by(const struct pixel_rays *s, int point, uint32_t number, uint32_t hit[COVER_GROUPS])
{
    const struct hierarchy *h = s->rays->hierarchy;
    struct ray_triangle triangle;
    double q[3][3], n[4][3], height = 0;
    struct light_line e[4];
    int whole = 0, lines = s->directional ? 3 : 4;
    if (hierarchy_twin(h, number) == (uint32_t)s->starts->own[point])
        return true;
    hierarchy_triangle(h, number, &triangle);
    for (int c = 0; c < 3; c++)
        for (int k = 0; k < 3; k++)
            q[c][k] = triangle.p[c][k] - s->starts->origin[k][point];
    for (int c = 0, a = 1, b = 2; c < 3; a = b, b = c++)
        for (int i = 0, j = 1, k = 2; i < 3; j = k, k = i++)
            n[c][i] = q[a][j] * q[b][k] - q[a][k] * q[b][j];
    for (int k = 0; k < 3; k++) {
        n[3][k] = (n[0][k] + n[1][k]) + n[2][k];
        height += n[0][k] * q[0][k];
    }
    if (height == 0)
        return true;
    for (int c = 0; c < lines; c++) {
        e[c] = line_of(s, point, n[c], height < 0 ? -1 : 1);
        e[c].a -= c == 3 ? __builtin_fabs(height) : 0;
        int side = line_side(e[c]);
        if (side < 0)
            return true;
        whole += side;
    }
    _Alignas(64) double start[3][LANES];
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < DLANES; i++) // through_points reads DLANES points
            start[k][i] = s->starts->point[k][point];
    if (through_points(h, &triangle, (const double(*)[LANES])start, 1))
        return true;
    if (whole == lines)
        return false;
    struct light_cuts cuts = {.count = 0};
    for (int i = 0; i < lines; i++) {
        if (line_side(e[i]))
            continue;
        double scale = inverse_power(__builtin_fabs(e[i].a) + __builtin_fabs(e[i].b) + __builtin_fabs(e[i].c));
        cuts.a[cuts.count] = (float)(e[i].a * scale);
        cuts.b[cuts.count] = (float)(e[i].b * scale);
        cuts.c[cuts.count++] = (float)(e[i].c * scale);
    }
    cut_points(&cuts, s->rays->pattern, hit);
    return true;
}

// LANES points as floats, relative to the middle of their cell.
struct cover_packet {
    _Alignas(64) float from[3][LANES], direction[3][LANES], u[3][LANES], v[3][LANES];
    float reach[LANES], length[LANES]; // sums of absolute values of `from`, and of the other three
};

static void cover_packet_fill(struct cover_packet *p, const struct pixel_rays *s, const uint16_t *points, int count)
{
    const struct ray_scratch *aims = s->pixels->scratch;
    for (int i = 0; i < LANES; i++) {
        int at = points[i < count ? i : 0];
        p->reach[i] = p->length[i] = 0;
        for (int k = 0; k < 3; k++) {
            p->from[k][i] = (float)(s->starts->origin[k][at] - s->middle[k]);
            p->direction[k][i] = (float)aims->direction[k][at];
            p->u[k][i] = (float)aims->u[k][at];
            p->v[k][i] = (float)aims->v[k][at];
            p->reach[i] += __builtin_fabsf(p->from[k][i]);
            p->length[i] +=
                __builtin_fabsf(p->direction[k][i]) + __builtin_fabsf(p->u[k][i]) + __builtin_fabsf(p->v[k][i]);
        }
    }
}

LANE_FN num dot_rows(const float rows[3][LANES], const num n[3])
{
    return (num_load(rows[0]) * n[0] + num_load(rows[1]) * n[1]) + num_load(rows[2]) * n[2];
}

// Returns the points for which a triangle may cover some of the light. The error of a sum of products of two
// coordinates and a direction is less than 2⁻¹⁹ times the product of their largest values. The corners of the leaves are
// rounded to multiples of 2⁻²⁴.
LANE_FN unsigned may_cover(const struct cover_packet *p, const float corner[3][3])
{
    num q[3][3], size = num_of(0.0f), height = num_of(0.0f);
    mask below = lane_numbers() < 0, above = below; // edges whose function has one sign on the whole light
    for (int c = 0; c < 3; c++)
        for (int k = 0; k < 3; k++)
            q[c][k] = corner[c][k] - num_load(p->from[k]);
    for (int c = 0; c < 3; c++) {
        float own = (__builtin_fabsf(corner[c][0]) + __builtin_fabsf(corner[c][1])) + __builtin_fabsf(corner[c][2]);
        size = max_of(size, num_load(p->reach) + own);
    }
    num error = (size * 0x1p-19f + 0x1p-21f) * size;
    num margin = error * num_load(p->length);
    for (int c = 0, a = 1, b = 2; c < 3; a = b, b = c++) {
        num n[3];
        for (int i = 0, j = 1, k = 2; i < 3; j = k, k = i++)
            n[i] = q[a][j] * q[b][k] - q[a][k] * q[b][j];
        if (c == 0)
            height = (n[0] * q[0][0] + n[1] * q[0][1]) + n[2] * q[0][2];
        num x = dot_rows(p->u, n), y = dot_rows(p->v, n), middle = dot_rows(p->direction, n);
        num wide = square_root(x * x + y * y) * (1.0f + 0x1p-20f) + margin;
        below = either(below, middle + wide < 0.0f);
        above = either(above, middle - wide > 0.0f);
    }
    mask misses = both(below, above);
    misses = either(misses, either(both(height > error * size, below), both(height < -(error * size), above)));
    return ~mask_bits(misses);
}

// Returns whether few of the listed triangles may cover light at the fragments.
static bool few_cover(const struct pixel_rays *s, const uint16_t *points, int count)
{
    int found = 0;
    if (s->blocker_count < 0 || s->blocker_count > BLOCKERS_TRIED)
        return false;
    for (int first = 0; first < count; first += LANES) {
        struct cover_packet packet;
        int lanes = count - first < LANES ? count - first : LANES;
        cover_packet_fill(&packet, s, points + first, lanes);
        for (int n = 0; n < s->blocker_count; n++)
            found += __builtin_popcount(may_cover(&packet, s->pixels->scratch->corners[n]) & ((1u << lanes) - 1));
        if (found > BLOCKERS_FEW * count)
            return false;
    }
    return true;
}

// Computes the light at the fragments for which at most `most` of the listed triangles may cover it. Stores the other
// fragments in `rest`, and returns their number.
static int pass_listed(const struct pixel_rays *s, const uint16_t *points, int count, int most, uint16_t *rest)
{
    int left = 0;
    for (int first = 0; first < count; first += LANES) {
        struct cover_packet packet;
        uint32_t hit[LANES][COVER_GROUPS] = {{0}}, *may = s->pixels->scratch->may;
        int lanes = count - first < LANES ? count - first : LANES, triangles[LANES] = {0};
        unsigned open = 0, blocked = 0;
        cover_packet_fill(&packet, s, points + first, lanes);
        for (int n = 0; n < s->blocker_count; n++) {
            may[n] = may_cover(&packet, s->pixels->scratch->corners[n]);
            for (int i = 0; i < lanes; i++)
                triangles[i] += may[n] >> i & 1;
        }
        for (int i = 0; i < lanes; i++)
            if (triangles[i] <= most)
                open |= 1u << i;
            else
                rest[left++] = points[first + i];
        for (int n = 0; n < s->blocker_count; n++)
            for (unsigned bits = may[n] & open & ~blocked; bits; bits &= bits - 1) {
                int i = __builtin_ctz(bits);
                if (!cover_by(s, points[first + i], s->pixels->scratch->blockers[n], hit[i]))
                    blocked |= 1u << i;
            }
        for (unsigned bits = open; bits; bits &= bits - 1) {
            int i = __builtin_ctz(bits), covered = 0;
            for (int k = 0; k < COVER_GROUPS; k++)
                covered += __builtin_popcount(hit[i][k]);
            s->passed[0][points[first + i]] = blocked >> i & 1 ? 0 : 1 - (float)covered / COVER_POINTS;
        }
    }
    return left;
}

#endif
