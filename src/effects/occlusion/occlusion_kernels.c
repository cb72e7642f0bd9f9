// occlusion_kernels.c: ambient occlusion from screen-space depths (occlusion.h). Lanes are neighbouring cells. This file
// is compiled once for each instruction set, with LANES and ISA defined (meson.build).
#include "occlusion_kernels.h"

#include "occlusion_pattern.h"
#include "prelude_c.h"

enum { STEPS = 12, CAVITY_STEPS = 4, SECTORS = 30, ROTATIONS = 16 };

// The minimum radius of cavity shading in cells, which keeps it visible in small pictures.
#define CAVITY_CELLS 3.0f
// The thickness of a surface without a back, as a share of the radius.
#define SHEET 0.5f

// Samples lower than this share of their distance from the point block less than half a byte.
#define LOW 0.05f

// The positions of a slice's samples, as fractions of the radius: closer together near the point, where most occluders
// are. Cavity shading uses every third.
static const float step_share[STEPS] = {0.012f, 0.054f, 0.111f, 0.178f, 0.253f, 0.335f,
                                        0.424f, 0.518f, 0.617f, 0.721f, 0.829f, 0.942f};

// The rotation of each pixel of the 4 x 4 pattern, in sixteenths of half a turn, and the shift of its steps. Neighbours
// differ greatly (Bayer's matrix and its transpose).
static const int32_t rotation_of[ROTATIONS] = {0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5};
static const float jitter_of[ROTATIONS] = {-0.47f, 0.28f, -0.28f, 0.47f, 0.03f, -0.22f, 0.22f, -0.03f,
                                           -0.34f, 0.41f, -0.41f, 0.34f, 0.16f, -0.09f, 0.09f, -0.16f};

// The cosines of pi k / 16. The sine of index k is the cosine of index 8 - k. Rotating the direction by pi gives the
// other side of the slice.
static const float cosines[ROTATIONS] = {
    1.0f, 0.98078528f,  0.92387953f,  0.83146961f,  0.70710678f,  0.55557023f,  0.38268343f,  0.19509032f,
    0.0f, -0.19509032f, -0.38268343f, -0.55557023f, -0.70710678f, -0.83146961f, -0.92387953f, -0.98078528f};

// A row of the pattern for LANES cells, which may begin at any of its four columns.
struct pattern_row {
    float cosine[LANES + 3], sine[LANES + 3], share[STEPS][LANES + 3], shift[LANES + 3], length[LANES + 3];
};

static void fill_pattern_row(struct pattern_row *row, int y)
{
    for (int x = 0; x < LANES + 3; x++) {
        int place = (x & 3) + 4 * (y & 3), rotation = rotation_of[place];
        row->cosine[x] = cosines[rotation];
        row->sine[x] = cosines[rotation < 8 ? 8 - rotation : rotation - 8];
        row->shift[x] = ((float)rotation_of[(place * 5 + 3) & 15] + 0.5f) / 16.0f;
        row->length[x] = 1.0f - OCCLUSION_FADING * ((float)rotation_of[(place * 3 + 7) & 15] + 0.5f) / 16.0f;
        for (int i = 0; i < STEPS; i++)
            row->share[i][x] = step_share[i] * (1.0f + 0.22f * jitter_of[place]);
    }
}

LANE_FN inum bits_set(inum bits)
{
    bits = bits - ((bits >> 1) & 0x55555555);
    bits = (bits & 0x33333333) + ((bits >> 2) & 0x33333333);
    bits = (bits + (bits >> 4)) & 0x0f0f0f0f;
    bits = bits + (bits >> 8);
    return (bits + (bits >> 16)) & 63;
}

// Returns the angle of a cosine in -1...1, within 7e-5 (Abramowitz and Stegun, 4.4.45).
LANE_FN num angle_of(num cosine)
{
    num x = absolute(cosine);
    num polynomial = 1.5707288f + x * (-0.2121144f + x * (0.0742610f + x * -0.0187293f));
    num angle = square_root(positive(1.0f - x)) * polynomial;
    return pick(cosine < 0.0f, 3.14159265f - angle, angle);
}

// Returns the eye-space position of a cell's surface. Columns and rows may be fractional.
LANE_FN vec3 screen_point(const struct screen_occlusion *o, num column, num row, num depth)
{
    num scale = o->orthographic ? num_of(o->pixel_size) : depth * o->pixel_size;
    float cell = (float)o->step;
    return vec3_of((cell * column - o->middle[0]) * (scale * o->pixel_aspect), (o->middle[1] - cell * row) * scale,
                   -depth);
}

// Returns the smaller of the changes of distance to the two neighbours, or 0 if neither neighbour contains a surface.
LANE_FN num slope_between(num before, num here, num after)
{
    num back = here - before, on = after - here;
    num slope = pick(absolute(on) < absolute(back), on, back);
    return pick(absolute(slope) < 0.5f * SCREEN_EMPTY, slope, num_of(0.0f)); // 0 if there is no surface on either side
}

// Returns the normal of the plane with these slopes, from the points one cell further.
LANE_FN vec3 screen_normal(const struct screen_occlusion *o, num column, num row, vec3 p, num depth, num across,
                           num down)
{
    vec3 right = sub3(screen_point(o, column + 1.0f, row, depth + across), p);
    vec3 below = sub3(screen_point(o, column, row + 1.0f, depth + down), p);
    return unit3(cross3(below, right));
}

// Returns the light of a slice up to the horizon at angle h from the view vector; c and s are the cosine and the sine
// of h. The light is the integral of the cosine to the normal at angle n, weighted by the distance between slices,
// times 4. h and n have the same sign convention.
LANE_FN num slice_light(num h, num c, num s, num cos_n, num sin_n)
{
    num cos_both = (2.0f * (c * c) - 1.0f) * cos_n + 2.0f * (s * c) * sin_n; // cos(2 h - n)
    return cos_n + 2.0f * (h * sin_n) - cos_both;
}

// LANES cells from column x: their surfaces, and their angles to the plane of each cell's slice.
struct cell_surface {
    vec3 p, up, along;
    num cosine, sine; // the slice's direction on the screen
    num length;       // the length of the normal's projection to the slice: 0 if they are perpendicular
    num cos_n, sin_n, angle_n;
    num cell; // side of a cell, eye units
};

LANE_FN struct cell_surface cell_surface_at(const struct screen_occlusion *o, const struct pattern_row *pattern, int x,
                                            int y, num depth, num across, num down)
{
    struct cell_surface c;
    num column = num_of_int(lane_numbers() + x), row = num_of((float)y);
    c.p = screen_point(o, column, row, depth);
    vec3 n = screen_normal(o, column, row, c.p, depth, across, down);
    vec3 v = o->orthographic ? vec3_of(num_of(0.0f), num_of(0.0f), num_of(1.0f)) : unit3(negate3(c.p));
    float cell = (float)o->step * o->pixel_size;
    c.cell = o->orthographic ? num_of(cell) : depth * cell;
    // On a surface that the eye sees at a grazing angle, the slices along the tilt receive most of the light: the angles
    // between the slices are squeezed towards the tilt, so that each slice has the same weight.
    num facing = min_of(positive(dot3(n, v)), num_of(1.0f)), tilt_x = n.x - v.x * facing, tilt_y = v.y * facing - n.y;
    num tilt = tilt_x * tilt_x + tilt_y * tilt_y, tilt_inverse = rsqrt_near(tilt);
    tilt_x = tilt_x * tilt_inverse;
    tilt_y = tilt_y * tilt_inverse;
    num slant = square_root(1.0f - facing * facing);
    num squeeze = square_root(facing / max_of(facing + angle_of(facing) * slant, num_of(1.0e-6f)));
    c.cosine = num_load(pattern->cosine + (x & 3));
    c.sine = num_load(pattern->sine + (x & 3));
    num parallel = (c.cosine * tilt_x + c.sine * tilt_y) * (1.0f - squeeze);
    c.cosine = c.cosine * squeeze + tilt_x * parallel;
    c.sine = c.sine * squeeze + tilt_y * parallel;
    num unit = rsqrt(c.cosine * c.cosine + c.sine * c.sine);
    c.cosine = c.cosine * unit;
    c.sine = c.sine * unit;
    // The slice's plane contains v and `way`, which points to the right or down in the picture.
    vec3 way = vec3_of(c.cosine, -c.sine, num_of(0.0f));
    vec3 beside = unit3(sub3(way, scale3(v, dot3(way, v)))), axis = cross3(beside, v);
    vec3 inside = sub3(n, scale3(axis, dot3(n, axis)));
    num square = dot3(inside, inside), inverse = rsqrt(square);
    c.length = square * inverse;
    c.cos_n = min_of(positive(dot3(inside, v) * inverse), num_of(1.0f));
    c.sin_n = min_of(max_of(dot3(inside, beside) * inverse, num_of(-1.0f)), num_of(1.0f));
    num angle = angle_of(c.cos_n);
    c.angle_n = pick(c.sin_n < 0.0f, -angle, angle);
    c.up = scale3(n, min_of(inverse, num_of(1.0e4f)));
    c.along = sub3(scale3(beside, c.cos_n), scale3(v, c.sin_n));
    return c;
}

// --- the sectors of a slice that the surfaces of all layers block (Therrien, Levesque and Gilet,
// "Screen Space Indirect Lighting with Visibility Bitmask", 2023)

// A sector's share of the light is the same for all sectors: the integral of the cosine to the normal, weighted by the
// distance between slices. Sectors are numbered from the horizon behind to the horizon ahead.
struct sectors {
    num middle, scale; // the number at the view vector, and sectors per unit of slice_light
    num shift;         // rounds up as many numbers as it rounds down, on average over the pattern
};

LANE_FN struct sectors sectors_of(const struct cell_surface *c, num shift)
{
    num scale = (float)SECTORS / (4.0f * (c->cos_n + c->angle_n * c->sin_n));
    num behind = 2.0f * c->cos_n + (2.0f * c->angle_n - 3.14159265f) * c->sin_n;
    return (struct sectors){scale * behind, scale, shift};
}

// Returns the number of the sector of a point at d from the cell's surface, ahead (side 1) or behind (side -1). Points
// below the surface's plane are at the horizon.
LANE_FN inum sector_of(const struct cell_surface *c, const struct sectors *sectors, vec3 d, float side)
{
    num inverse = rsqrt_near(dot3(d, d));
    num sine = min_of(positive(dot3(d, c->up) * inverse), num_of(1.0f));
    num cosine = square_root(1.0f - sine * sine), zenith = angle_of(sine);
    mask over = both(sine > 0.0f, side * dot3(d, c->along) < 0.0f); // beyond the zenith
    cosine = pick(over, -cosine, cosine);
    num n = side * c->angle_n, sin_n = side * c->sin_n, h = n + pick(over, -zenith, zenith);
    num light = slice_light(h, sine * c->cos_n - cosine * sin_n, sine * sin_n + cosine * c->cos_n, c->cos_n, sin_n);
    num number = sectors->middle + side * sectors->scale * pick(h > 0.0f, light, num_of(0.0f)) + sectors->shift;
    return int_of(min_of(positive(number), num_of((float)SECTORS)));
}

// The surfaces behind a sample, as seen from a cell: the direction to the sample at distance 1 (or in an orthographic
// view the sample at distance 0), the distances between which surfaces are inside the radius, the thickness of surfaces
// without a back, and the least height that matters.
struct column {
    num x, y, nearest, farthest, thickness, low;
    inum at; // the position in a layer
};

LANE_FN vec3 from_cell(const struct screen_occlusion *o, const struct cell_surface *c, const struct column *s,
                       num distance)
{
    num scale = o->orthographic ? num_of(1.0f) : distance;
    return sub3(vec3_of(s->x * scale, s->y * scale, -distance), c->p);
}

// Returns a bit for each sector that the column's surfaces block. Between a front and the following back, a body is
// solid. A surface without a back, and the surfaces around an eye inside a body (`hollow`), have a thickness.
LANE_FN inum blocked_by(const struct screen_occlusion *o, const struct cell_surface *c, const struct sectors *sectors,
                        const struct column *s, mask hollow, float side)
{
    inum blocked = inum_of(0), one = inum_of(1);
    num here = gather_float(o->layers, s->at);
    // The first surface is the highest over the cell's plane.
    num nearest = max_of(absolute(here), s->nearest);
    mask over = both(nearest<s->farthest, dot3(from_cell(o, c, s, nearest), c->up)> s->low);
    if (!any_lane(over))
        return blocked;
    mask inside = num_of(1.0f) < 0.0f; // between a front and its back
    for (int k = 1; k <= SCREEN_LAYERS; k++) {
        num next = k < SCREEN_LAYERS ? gather_float(o->layers + (size_t)k * o->plane, s->at) : num_of(SCREEN_EMPTY);
        mask solid = both(negate(hollow), both(here > 0.0f, next < 0.0f));
        num start = absolute(here), end = pick(solid, -next, start + s->thickness);
        mask used = both(both(over, negate(inside)), both(start<s->farthest, end> s->nearest));
        if (any_lane(used)) {
            inum a = sector_of(c, sectors, from_cell(o, c, s, max_of(start, s->nearest)), side);
            inum b = sector_of(c, sectors, from_cell(o, c, s, min_of(end, s->farthest)), side);
            inum bits = (one << imax_of(a, b)) - (one << imin_of(a, b));
            blocked = blocked | ipick(used, bits, inum_of(0));
        }
        if (!any_lane(absolute(next) < s->farthest))
            break;
        inside = solid;
        here = next;
    }
    return blocked;
}

// Returns the share of the surrounding light that surfaces within the radius do not block. Every `stride`th step is used.
LANE_FN num unblocked_at(const struct screen_occlusion *o, const struct pattern_row *pattern, int x, int y,
                         const struct cell_surface *c, num depth, num radius, int stride)
{
    int at = x & 3, longest = o->grid_width > o->grid_height ? o->grid_width : o->grid_height;
    num length = num_load(pattern->length + at) * radius;
    num reach = min_of(length / c->cell, num_of((float)longest)), step_x = c->cosine * reach * (1.0f / o->pixel_aspect),
        step_y = c->sine * reach;
    num one_cell = 1.0f / max_of(max_of(absolute(step_x), absolute(step_y)), num_of(1.0e-6f)), share = num_of(0.0f);
    num column = num_of_int(lane_numbers() + x), row = num_of((float)y), cell = num_of((float)o->step);
    num last_column = num_of((float)(o->grid_width - 1)), last_row = num_of((float)(o->grid_height - 1));
    struct sectors sectors = sectors_of(c, num_load(pattern->shift + at));
    mask hollow = num_load(o->layers + (size_t)y * (size_t)o->stride + (size_t)x) < 0.0f;
    inum blocked = inum_of(0);
    for (int i = stride / 2; i < STEPS; i += stride) {
        share = max_of(num_load(pattern->share[i] + at), share + one_cell); // at least one cell further
        for (float side = 1.0f; side >= -1.0f; side -= 2.0f) {
            inum to_x = int_of(min_of(positive(column + 0.5f + side * step_x * share), last_column));
            inum to_y = int_of(min_of(positive(row + 0.5f + side * step_y * share), last_row));
            num across = (num_of_int(to_x) - column) * (c->cell * o->pixel_aspect),
                down = (num_of_int(to_y) - row) * c->cell;
            num square = length * length - (across * across + down * down), half = square_root(positive(square));
            struct column s = {(cell * num_of_int(to_x) - o->middle[0]) * (o->pixel_size * o->pixel_aspect),
                               (o->middle[1] - cell * num_of_int(to_y)) * o->pixel_size,
                               depth - half,
                               depth + half,
                               SHEET * radius,
                               LOW * share * length,
                               to_y * o->stride + to_x};
            blocked = blocked | blocked_by(o, c, &sectors, &s, hollow, side);
        }
    }
    return 1.0f - num_of_int(bits_set(blocked)) * (1.0f / (float)SECTORS);
}

// Combines the light at both radii.
LANE_FN num light_from_around(const struct screen_occlusion *o, const struct pattern_row *pattern, int x, int y,
                              num depth, num across, num down)
{
    struct cell_surface c = cell_surface_at(o, pattern, x, y, depth, across, down);
    num share = num_of(1.0f);
    if (o->radius > 0)
        share = unblocked_at(o, pattern, x, y, &c, depth, num_of(o->radius), 1);
    if (o->cavity_radius > 0) {
        num radius = max_of(num_of(o->cavity_radius), CAVITY_CELLS * c.cell);
        num valley = unblocked_at(o, pattern, x, y, &c, depth, radius, STEPS / CAVITY_STEPS);
        share = share * (o->deepens ? valley * valley * valley : valley);
    }
    return share;
}

// --- the steps

// Cells of two by two pixels use the first pixel that shows a surface.
static void cell_rows(const struct screen_occlusion *o, int first, int end)
{
    for (int y = first; y < end; y++)
        for (int x = 0; x < o->grid_width; x += LANES) {
            size_t at = (size_t)y * (size_t)o->stride + (size_t)x;
            num depth = num_load(o->depth + at);
            for (int i = 1; i < 4; i++)
                depth = pick(depth < SCREEN_EMPTY, depth, num_load(o->depth + (size_t)i * o->plane + at));
            num_store(o->cell_depth + at, depth);
        }
}

// Returns a row of the grid, or the nearest existing row.
LANE_FN size_t row_at(const struct screen_occlusion *o, int y)
{
    return (size_t)(y < 0 ? 0 : y < o->grid_height ? y : o->grid_height - 1) * (size_t)o->stride;
}

static void occlude_rows(const struct screen_occlusion *o, int first, int end)
{
    for (int y = first; y < end; y++) {
        const float *depth = o->cell_depth + row_at(o, y);
        const float *above = o->cell_depth + row_at(o, y - 1), *below = o->cell_depth + row_at(o, y + 1);
        size_t row = row_at(o, y);
        struct pattern_row pattern;
        fill_pattern_row(&pattern, y);
        for (int x = 0; x < o->grid_width; x += LANES) {
            num here = num_load(depth + x);
            mask shown = here < SCREEN_EMPTY;
            num across = num_of(0.0f), down = num_of(0.0f), share = num_of(1.0f);
            if (any_lane(shown)) {
                here = pick(shown, here, num_of(1.0f));
                across = slope_between(num_load(depth + x - 1), here, num_load(depth + x + 1));
                down = slope_between(num_load(above + x), here, num_load(below + x));
                share = pick(shown, light_from_around(o, &pattern, x, y, here, across, down), num_of(1.0f));
            }
            num_store(o->slope_x + row + x, across);
            num_store(o->slope_y + row + x, down);
            num_store(o->noisy + row + x, share);
        }
    }
}

// --- the filter: five by five cells; the outer cells have half weight, so that each position of the pattern has the
// same total weight. Neighbours are weighted by how closely their depths match the surface, continued with its slopes.

static void smooth_rows(const struct screen_occlusion *o, int first, int end)
{
    float cell = (float)o->step * o->pixel_size;
    for (int y = first; y < end; y++) {
        size_t row = row_at(o, y);
        for (int x = 0; x < o->grid_width; x += LANES) {
            num here = num_load(o->cell_depth + row + x), value = num_load(o->noisy + row + x);
            if (any_lane(here < SCREEN_EMPTY)) {
                num across = num_load(o->slope_x + row + x), down = num_load(o->slope_y + row + x);
                // the inverse of the deviation at which a neighbour's weight is one half
                num inverse = 1.0f / (0.8f * (o->orthographic ? num_of(cell) : here * cell) +
                                      0.5f * max_of(absolute(across), absolute(down)));
                num sum = num_of(0.0f), weights = num_of(0.0f);
                for (int dy = -2; dy <= 2; dy++) {
                    size_t at = row_at(o, y + dy) + (size_t)x;
                    num middle = here + down * (float)dy;
                    for (int dx = -2; dx <= 2; dx++) {
                        float part = (dx * dx == 4 ? 0.5f : 1.0f) * (dy * dy == 4 ? 0.5f : 1.0f);
                        num depth = num_load(o->cell_depth + at + dx);
                        num deviation = absolute(depth - (middle + across * (float)dx)) * inverse;
                        // In a scene as large as SCREEN_EMPTY, a pixel without a surface may appear to be on this
                        // surface.
                        num weight = pick(depth < SCREEN_EMPTY, part * saturate(2.0f - deviation), num_of(0.0f));
                        sum = sum + weight * num_load(o->noisy + at + dx);
                        weights = weights + weight;
                    }
                }
                value = pick(weights > 0.0f, sum / weights, value);
            }
            num_store(o->smoothed + row + x, value);
        }
    }
}

// --- from cells to pixels

// Returns the mean of the surfaces in and beside cells, or 1 if there are none.
LANE_FN num beside_surfaces(const struct screen_occlusion *o, int x, int y)
{
    num sum = num_of(0.0f), count = num_of(0.0f), nearest = num_of(SCREEN_EMPTY);
    for (int down = -1; down <= 1; down++)
        for (int across = -1; across <= 1; across++)
            nearest = min_of(nearest, num_load(o->cell_depth + row_at(o, y + down) + x + across));
    if (!any_lane(nearest < SCREEN_EMPTY))
        return num_of(1.0f);
    for (int down = -1; down <= 1; down++)
        for (int across = -1; across <= 1; across++) {
            size_t row = row_at(o, y + down);
            mask shown = num_load(o->cell_depth + row + x + across) < SCREEN_EMPTY;
            sum = sum + pick(shown, num_load(o->smoothed + row + x + across), num_of(0.0f));
            count = count + pick(shown, num_of(1.0f), num_of(0.0f));
        }
    return pick(count > 0.0f, sum / max_of(count, num_of(1.0f)), num_of(1.0f));
}

// LANES cells, with the surface data that the pixels between them need.
struct cell_lanes {
    num depth, across, down, slopes, value;
    mask shown;
};

LANE_FN struct cell_lanes cells_at(const struct screen_occlusion *o, size_t at)
{
    struct cell_lanes c = {num_load(o->cell_depth + at), num_load(o->slope_x + at),
                           num_load(o->slope_y + at),    num_of(0.0f),
                           num_load(o->smoothed + at),   num_load(o->cell_depth + at) < SCREEN_EMPTY};
    c.slopes = absolute(c.across) + absolute(c.down);
    return c;
}

// The mean of the cells around LANES pixels on the same surface or, if there are none, of all cells with a surface.
struct between {
    num here, size, sum, weights;
};

LANE_FN struct between between_of(const struct screen_occlusion *o, num here)
{
    num pixel = o->orthographic ? num_of(o->pixel_size) : here * o->pixel_size;
    return (struct between){here, 2.0f * pixel, num_of(0.0f), num_of(0.0f)};
}

// Adds cells. `right` and `below` are the offsets of the pixels from these cells, in cells.
LANE_FN void add_cells(struct between *b, const struct cell_lanes *c, float right, float below)
{
    num there = right == 0.0f ? c->depth + c->down * below
                              : c->depth + (below == 0.0f ? c->across * right : c->across * right + c->down * below);
    num weight = max_of(saturate(2.0f - absolute(b->here - there) / (b->size + c->slopes)), num_of(1.0e-4f));
    weight = pick(c->shown, weight, num_of(0.0f));
    b->sum = b->sum + weight * c->value;
    b->weights = b->weights + weight;
}

LANE_FN num between_value(const struct between *b) { return b->sum / max_of(b->weights, num_of(1.0e-4f)); }

// Computes the pixels of LANES cells: the first pixel has the cell's value, the others are half a cell to the right and
// below. With `last`, there is no row below.
LANE_FN void pixels_between(const struct screen_occlusion *o, size_t at, const num here[4], bool last, num value[4])
{
    struct cell_lanes c = cells_at(o, at), beside = cells_at(o, at + 1);
    struct between right = between_of(o, here[1]), below = between_of(o, here[2]), across = between_of(o, here[3]);
    value[0] = c.value;
    add_cells(&right, &c, 0.5f, 0.0f);
    add_cells(&right, &beside, -0.5f, 0.0f);
    add_cells(&below, &c, 0.0f, 0.5f);
    add_cells(&across, &c, 0.5f, 0.5f);
    add_cells(&across, &beside, -0.5f, 0.5f);
    if (!last) {
        at += (size_t)o->stride;
        c = cells_at(o, at);
        beside = cells_at(o, at + 1);
        add_cells(&below, &c, 0.0f, -0.5f);
        add_cells(&across, &c, 0.5f, -0.5f);
        add_cells(&across, &beside, -0.5f, -0.5f);
    }
    value[1] = between_value(&right);
    value[2] = between_value(&below);
    value[3] = between_value(&across);
}

static void pixel_rows(const struct screen_occlusion *o, int first, int end)
{
    int pixels = o->step * o->step;
    for (int y = first; y < end; y++)
        for (int x = 0; x < o->grid_width; x += LANES) {
            size_t at = row_at(o, y) + (size_t)x;
            num here[4], value[4], beside = num_of(1.0f);
            mask shown = num_of(0.0f) < 1.0f, none = shown;
            for (int i = 0; i < pixels; i++) {
                here[i] = num_load(o->depth + (size_t)i * o->plane + at);
                shown = both(shown, here[i] < SCREEN_EMPTY);
                none = both(none, negate(here[i] < SCREEN_EMPTY));
            }
            if (!all_lanes(shown))
                beside = beside_surfaces(o, x, y);
            if (pixels > 1 && !all_lanes(none))
                pixels_between(o, at, here, y + 1 == o->grid_height, value);
            else
                value[0] = num_load(o->smoothed + at);
            for (int i = 0; i < pixels; i++) {
                value[i] = all_lanes(none) ? beside : pick(here[i] < SCREEN_EMPTY, value[i], beside);
                num_store(o->unoccluded + (size_t)i * o->plane + at, value[i]);
            }
        }
}

const struct occlusion_kernels FOR_ISA(occlusion_kernels) = {cell_rows, occlude_rows, smooth_rows, pixel_rows};
