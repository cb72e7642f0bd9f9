// occlusion_kernels.c: ambient occlusion from screen-space depths (occlusion.h). Lanes are neighbouring cells. This file
// is compiled once for each instruction set, with LANES and ISA defined (meson.build).
#include "occlusion_kernels.h"

#include "occlusion_pattern.h"
#include "prelude_c.h"

enum { STEPS = 4, ROTATIONS = 16 };

// The minimum radius of cavity shading in cells, which keeps it visible in small pictures.
#define CAVITY_CELLS 3.0f
// Ridges are narrow lines and need a larger radius; otherwise they contain too few samples and break into dashes.
#define RIDGE_CELLS 10.0f
// The gain of surrounding light at the sharpest ridge.
#define RIDGE_GAIN 0.7f

// The positions of a slice's samples, as fractions of the radius: closer together near the point, where most occluders
// are.
static const float step_share[STEPS] = {0.1f, 0.25f, 0.45f, 0.7f};

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
    float cosine[LANES + 3], sine[LANES + 3], share[STEPS][LANES + 3];
};

static void fill_pattern_row(struct pattern_row *row, int y)
{
    for (int x = 0; x < LANES + 3; x++) {
        int place = (x & 3) + 4 * (y & 3), rotation = rotation_of[place];
        row->cosine[x] = cosines[rotation];
        row->sine[x] = cosines[rotation < 8 ? 8 - rotation : rotation - 8];
        for (int i = 0; i < STEPS; i++)
            row->share[i][x] = step_share[i] * (1.0f + 0.55f * jitter_of[place]);
    }
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
    return vec3_of((cell * column - 0.5f * (float)(o->width - 1)) * scale,
                   (0.5f * (float)(o->height - 1) - cell * row) * scale, -depth);
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

// The samples of a slice: steps of LANES cells, in cells along the longer axis of its direction.
struct slice {
    num column, row, step_x, step_y;
    num share[STEPS]; // fraction of the step
    num radius;       // eye units
};

// The share of light that one side occludes, and the side's depth below the surface's plane: sin² of the elevation.
struct side {
    num taken, fallen;
};

// Returns the share of one side's light that its samples occlude, as if the surface were seen from straight above. With
// the elevation e over the surface's plane, the share is sin² e up to the zenith and 2 − sin² e beyond the zenith (0 …
// 2), times the weight of the sample's distance. `up` is the normal divided by the length of its projection to the
// slice, and `along` is the direction to that side in both planes. Elevations are relative to the plane and not to the
// view direction, because samples are at whole cells, slightly beside the slice. The elevation of samples on the plane
// itself is then 0.
LANE_FN struct side side_of(const struct screen_occlusion *o, vec3 p, vec3 up, vec3 along, const struct slice *slice,
                            float side, bool ridges)
{
    num most = num_of(0.0f), fallen = num_of(0.0f), band = 1.0f / (OCCLUSION_FADING * slice->radius);
    float cell = (float)o->step;
    float middle_x = 0.5f * (float)(o->width - 1), middle_y = 0.5f * (float)(o->height - 1);
    num last_column = num_of((float)(o->grid_width - 1)), last_row = num_of((float)(o->grid_height - 1));
    for (int i = 0; i < STEPS; i++) {
        num share = side * slice->share[i];
        inum x = int_of(min_of(positive(slice->column + slice->step_x * share), last_column));
        inum y = int_of(min_of(positive(slice->row + slice->step_y * share), last_row));
        num depth = gather_float(o->cell_depth, y * o->stride + x);
        num scale = o->orthographic ? num_of(o->pixel_size) : depth * o->pixel_size;
        vec3 d = vec3_of((cell * num_of_int(x) - middle_x) * scale - p.x,
                         (middle_y - cell * num_of_int(y)) * scale - p.y, -depth - p.z);
        // An error of a thousandth of the distance is acceptable. Without a surface, the weight is 0.
        num square = dot3(d, d), inverse = rsqrt_near(square);
        num weight = saturate((slice->radius - square * inverse) * band);
        num height = dot3(d, up) * inverse, below = min_of(height, num_of(0.0f));
        if (ridges)
            fallen = max_of(fallen, min_of(below * below, num_of(1.0f)) * weight);
        num sine = positive(height), taken = min_of(sine * sine, num_of(1.0f));
        // Samples beyond the zenith occlude less if they are low over the plane, because they may be the plane itself
        // beside the slice.
        num cosine = min_of(side * dot3(d, along) * inverse, num_of(0.0f));
        taken = taken + 2.0f * (cosine * cosine) * min_of(4.0f * taken, num_of(1.0f));
        most = max_of(most, taken * weight);
    }
    return (struct side){most, fallen};
}

// Returns the light of a slice up to the horizon at angle h from the view vector; c and s are the cosine and the sine
// of h. The light is the integral of the cosine to the normal at angle n, weighted by the distance between slices,
// times 4. h and n have the same sign convention.
LANE_FN num slice_light(num h, num c, num s, num cos_n, num sin_n)
{
    num cos_both = (2.0f * (c * c) - 1.0f) * cos_n + 2.0f * (s * c) * sin_n; // cos(2 h - n)
    return cos_n + 2.0f * (h * sin_n) - cos_both;
}

// The elevation that blocks a given share of a side's light (side_taken), and its angle from the zenith.
struct horizon {
    num sine, cosine, zenith;
};

LANE_FN struct horizon horizon_of(num taken)
{
    num rest = 1.0f - taken, size = min_of(absolute(rest), num_of(1.0f));
    num cosine = square_root(size);
    cosine = pick(rest < 0.0f, -cosine, cosine);
    return (struct horizon){square_root(1.0f - size), cosine, 1.57079633f - angle_of(cosine)};
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
    c.cosine = num_load(pattern->cosine + (x & 3));
    c.sine = num_load(pattern->sine + (x & 3));
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

// Returns the share of the surrounding light that surfaces within `radius` do not block, for LANES cells from column x;
// with `ridges`, ridges are lightened by `gain`.
LANE_FN num unoccluded_at(const struct screen_occlusion *o, const struct pattern_row *pattern, int x, int y,
                          const struct cell_surface *c, num radius, bool ridges, num gain)
{
    num reach =
        min_of(radius / c->cell, num_of((float)(o->grid_width > o->grid_height ? o->grid_width : o->grid_height)));
    struct slice slice = {num_of_int(lane_numbers() + x) + 0.5f,
                          num_of((float)y) + 0.5f,
                          c->cosine * reach,
                          c->sine * reach,
                          {num_of(0.0f)},
                          radius};
    num longer = max_of(max_of(absolute(slice.step_x), absolute(slice.step_y)), num_of(1.0e-6f));
    num one_cell = 1.0f / longer;
    for (int i = 0; i < STEPS; i++) // at least one cell further than the previous step
        slice.share[i] = max_of(num_load(pattern->share[i] + (x & 3)), (float)(i + 1) * one_cell);
    struct side sides[2] = {side_of(o, c->p, c->up, c->along, &slice, 1.0f, ridges),
                            side_of(o, c->p, c->up, c->along, &slice, -1.0f, ridges)};
    struct horizon ahead = horizon_of(sides[0].taken), behind = horizon_of(sides[1].taken);
    // The horizons are rotated into the slice, in which the surface's plane is at angle_n + pi/2 ahead and angle_n -
    // pi/2 behind.
    num light_ahead = slice_light(c->angle_n + ahead.zenith, ahead.sine * c->cos_n - ahead.cosine * c->sin_n,
                                  ahead.sine * c->sin_n + ahead.cosine * c->cos_n, c->cos_n, c->sin_n);
    num light_behind = slice_light(c->angle_n - behind.zenith, behind.sine * c->cos_n + behind.cosine * c->sin_n,
                                   behind.sine * c->sin_n - behind.cosine * c->cos_n, c->cos_n, c->sin_n);
    num light = c->length * (light_ahead + light_behind);
    num all = c->length * (4.0f * (c->cos_n + c->angle_n * c->sin_n));
    num share = pick(all > 0.0f, saturate(light / all), num_of(1.0f));
    return ridges ? share * (1.0f + 0.5f * gain * (sides[0].fallen + sides[1].fallen)) : share;
}

// Combines the light at both radii.
LANE_FN num light_from_around(const struct screen_occlusion *o, const struct pattern_row *pattern, int x, int y,
                              num depth, num across, num down)
{
    struct cell_surface c = cell_surface_at(o, pattern, x, y, depth, across, down);
    num share = num_of(1.0f);
    if (o->radius > 0)
        share = unoccluded_at(o, pattern, x, y, &c, num_of(o->radius), false, num_of(0.0f));
    if (o->cavity_radius > 0) {
        num radius = num_of(o->cavity_radius), cells = radius / c.cell;
        num gain = (o->ridges ? RIDGE_GAIN : 0) * saturate((cells - CAVITY_CELLS) / (RIDGE_CELLS - CAVITY_CELLS));
        num cavity = unoccluded_at(o, pattern, x, y, &c, max_of(radius, CAVITY_CELLS * c.cell), true, gain);
        num valley = min_of(cavity, num_of(1.0f));
        share = share * (cavity * cavity * valley);
        if (o->deepens)
            share = share * (valley * valley * valley);
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

// --- the filter: five cells across, then down; the outer cells have half weight, so that each position of the pattern
// has the same total weight

// Adds a neighbour. Its weight depends on how closely its depth matches the surface, continued with this slope.
LANE_FN void add_neighbour(num *sum, num *weights, num value, num depth, num here, num slope, float offset,
                           num tolerance)
{
    float part = offset == 2.0f || offset == -2.0f ? 0.5f : 1.0f;
    num deviation = absolute(depth - (here + slope * offset));
    // In a scene as large as SCREEN_EMPTY, a pixel without a surface may appear to be on this surface.
    num weight = pick(depth < SCREEN_EMPTY, part * saturate(2.0f - deviation * tolerance), num_of(0.0f));
    *sum = *sum + weight * value;
    *weights = *weights + weight;
}

// Returns the inverse of the distance from the surface at which a neighbour's weight is one half.
LANE_FN num filter_tolerance(const struct screen_occlusion *o, num depth, num slope)
{
    float cell = (float)o->step * o->pixel_size;
    return 1.0f / (2.0f * (o->orthographic ? num_of(cell) : depth * cell) + absolute(slope));
}

static void smooth_rows_across(const struct screen_occlusion *o, int first, int end)
{
    for (int y = first; y < end; y++) {
        size_t row = row_at(o, y);
        const float *depth = o->cell_depth + row, *noisy = o->noisy + row;
        for (int x = 0; x < o->grid_width; x += LANES) {
            num here = num_load(depth + x), value = num_load(noisy + x);
            if (any_lane(here < SCREEN_EMPTY)) {
                num slope = num_load(o->slope_x + row + x), tolerance = filter_tolerance(o, here, slope);
                num sum = value, weights = num_of(1.0f);
                for (int offset = -2; offset <= 2; offset++)
                    if (offset != 0)
                        add_neighbour(&sum, &weights, num_load(noisy + x + offset), num_load(depth + x + offset), here,
                                      slope, (float)offset, tolerance);
                value = sum / weights;
            }
            num_store(o->smoothed + row + x, value);
        }
    }
}

static void smooth_rows_down(const struct screen_occlusion *o, int first, int end)
{
    for (int y = first; y < end; y++) {
        size_t row = row_at(o, y);
        for (int x = 0; x < o->grid_width; x += LANES) {
            num here = num_load(o->cell_depth + row + x), value = num_load(o->smoothed + row + x);
            if (any_lane(here < SCREEN_EMPTY)) {
                num slope = num_load(o->slope_y + row + x), tolerance = filter_tolerance(o, here, slope);
                num sum = value, weights = num_of(1.0f);
                for (int offset = -2; offset <= 2; offset++)
                    if (offset != 0)
                        add_neighbour(&sum, &weights, num_load(o->smoothed + row_at(o, y + offset) + x),
                                      num_load(o->cell_depth + row_at(o, y + offset) + x), here, slope, (float)offset,
                                      tolerance);
                value = sum / weights;
            }
            num_store(o->noisy + row + x, value);
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
            sum = sum + pick(shown, num_load(o->noisy + row + x + across), num_of(0.0f));
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
                           num_load(o->noisy + at),      num_load(o->cell_depth + at) < SCREEN_EMPTY};
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
                value[0] = num_load(o->noisy + at);
            for (int i = 0; i < pixels; i++) {
                value[i] = all_lanes(none) ? beside : pick(here[i] < SCREEN_EMPTY, value[i], beside);
                num_store(o->unoccluded + (size_t)i * o->plane + at, value[i]);
            }
        }
}

const struct occlusion_kernels FOR_ISA(occlusion_kernels) = {cell_rows, occlude_rows, smooth_rows_across,
                                                             smooth_rows_down, pixel_rows};
