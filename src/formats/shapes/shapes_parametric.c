// shapes_parametric.c: tessellates parametric surfaces p(u, v).
//
// The domain is divided into u_segments × v_segments cells of two triangles each, counter-clockwise seen from the side
// that ∂p/∂u × ∂p/∂v points to.
//
// Seams: if u (or v) is closed, the last column (row) has the position, normal and tangent of the first, bit for bit;
// only the texture coordinate differs.
//
// Poles: if all points of a row, or of the first or last column, coincide, the row or the column is one vertex.
// Degenerate triangles at a pole are skipped. Each remaining triangle has its own corner at the pole, with the texture
// coordinate, tangent and normal of the centre of its cell. If these normals agree, the pole is smooth and all corners
// have the mean normal. Otherwise the pole is a tip, like the tip of a cone, and each corner keeps its normal.
//
// A zero derivative does not determine the tangent plane. The code then uses the derivative at a nearby point in the
// interior, at a distance of INSET times the domain's length. This derivative approximates the one-sided limit.
#include "shapes.h"

#include "fail.h"
#include "linear.h"
#include "loop_status.h"
#include "origin.h"
#include "pool.h"

#include <string.h>

// Two points coincide if their distance is below this fraction of the surface's size, because floats cannot represent
// the difference.
#define COINCIDENT 1e-9
// A derivative is treated as zero if it is below this fraction of the surface's size divided by the domain's length.
#define VANISHED 1e-9
// The distance between the boundary and the point whose derivative approximates the limit, as a fraction of the domain.
#define INSET 1e-4
// A pole is smooth if the cosine between each of its normals and their mean is above this limit (0.08°).
#define SMOOTH_POLE (1 - 1e-6)

enum {
    ROWS = 4,            // rows of a parallel task
    OF_THREAD = 1 << 12, // the minimum number of vertices per thread
};

// A row of vertices, numbered from left to right. A vertex belongs to the first row and column that contain it.
struct row {
    uint32_t first, middle, last; // the vertices of columns 0, 1 and u_segments
    bool single;                  // all columns have the vertex `first`
    bool owns_first, owns_middle, owns_last;
    bool pole;     // the points of the row coincide
    size_t corner; // the first corner of the cells between the previous row and this row
};

struct tessellation {
    const lam_parametric *surface;
    // The mesh's arrays, writable.
    float *positions, *normals, *tangents, *texcoords;
    uint32_t *indices, *attributes;
    double origin[3];
    double size;           // longest side of the bounding box of a coarse sample
    double u_unit, v_unit; // typical length of a derivative
    uint32_t vertex, attribute_base;
    size_t corner;
    bool first_column_pole, last_column_pole;
    uint8_t *border; // set for each vertex on the border; NULL if not requested
    struct row *rows;
    lam_surface_point *points; // rows of `widest` points, one for each thread
    size_t widest;
    struct loop_status loop;
    int failed; // the first row that could not be computed, or a number above all rows
};

// Returns the parameter at step i of n from a to b. The ends are exact. Mirrored steps of a symmetric domain give
// bit-identical mirrored parameters.
static double parameter(double a, double b, int i, int n)
{
    if (i <= 0)
        return a;
    if (i >= n)
        return b;
    return (a * (n - i) + b * i) / n;
}

// Returns the centre of cell i.
static double middle(double a, double b, int i, int n) { return parameter(a, b, 2 * i + 1, 2 * n); }

static lam_surface_point evaluate(const struct tessellation *t, double u, double v)
{
    lam_surface_point point = {0};
    t->surface->surface(t->surface->user, u, v, &point);
    return point;
}

static bool shorter(lam_vec3 v, double length) { return v3_dot(v, v) <= length * length; }

static bool coincide(const struct tessellation *t, lam_vec3 a, lam_vec3 b)
{
    return shorter(v3_sub(a, b), COINCIDENT * t->size);
}

// Returns x, moved towards the centre of the domain by INSET times the domain's length.
static double inside(double x, double low, double high)
{
    double step = INSET * (high - low);
    return x > 0.5 * low + 0.5 * high ? x - step : x + step;
}

// Computes the unit normal and tangent at a point. The normal is zero if no derivative determines it.
static void frame_at(const struct tessellation *t, double u, double v, const lam_surface_point *point, lam_vec3 *normal,
                     lam_vec3 *tangent)
{
    const lam_parametric *s = t->surface;
    double inner_u = inside(u, s->u_min, s->u_max), inner_v = inside(v, s->v_min, s->v_max);
    lam_vec3 du = point->dp_du, dv = point->dp_dv;
    double min_u = VANISHED * t->u_unit, min_v = VANISHED * t->v_unit;
    if (shorter(du, min_u))
        du = evaluate(t, u, inner_v).dp_du;
    if (shorter(du, min_u))
        du = evaluate(t, inner_u, v).dp_du;
    if (shorter(dv, min_v))
        dv = evaluate(t, inner_u, v).dp_dv;
    if (shorter(dv, min_v))
        dv = evaluate(t, u, inner_v).dp_dv;
    du = v3_unit(du);
    dv = v3_unit(dv);
    lam_vec3 cross = v3_cross(du, dv);
    if (shorter(cross, 1e-7)) { // parallel, as at the tip of a triangular patch
        lam_surface_point inner = evaluate(t, inner_u, inner_v);
        cross = v3_cross(v3_unit(inner.dp_du), v3_unit(inner.dp_dv));
    }
    *normal = v3_unit(cross);
    // Orthogonalize: rounding and the limit's error move ∂p/∂u out of the tangent plane.
    lam_vec3 n = *normal;
    *tangent = v3_unit(v3_sub(du, v3_scale(n, v3_dot(n, du))));
    if (shorter(*tangent, 0.5))
        *tangent = v3_unit(n.x * n.x < 0.5 ? v3_cross(v3(1, 0, 0), n) : v3_cross(v3(0, 1, 0), n));
}

// Returns whether all points of the boundary column at u coincide.
static bool column_is_pole(const struct tessellation *t, double u)
{
    const lam_parametric *s = t->surface;
    lam_vec3 first = evaluate(t, u, s->v_min).p;
    for (int j = 1; j <= s->v_segments; j++)
        if (!coincide(t, first, evaluate(t, u, parameter(s->v_min, s->v_max, j, s->v_segments)).p))
            return false;
    return true;
}

static bool row_is_pole(const struct tessellation *t, double v)
{
    const lam_parametric *s = t->surface;
    lam_vec3 first = evaluate(t, s->u_min, v).p;
    for (int i = 1; i <= s->u_segments; i++)
        if (!coincide(t, first, evaluate(t, parameter(s->u_min, s->u_max, i, s->u_segments), v).p))
            return false;
    return true;
}

static bool set_position(const struct tessellation *t, uint32_t vertex, lam_vec3 p, lam_error *error)
{
    const double limit = 1e38; // below FLT_MAX, so that differences and lengths do not overflow
    double q[3] = {p.x - t->origin[0], p.y - t->origin[1], p.z - t->origin[2]};
    float *at = t->positions + 3 * (size_t)vertex;
    for (int a = 0; a < 3; a++) {
        if (!(q[a] > -limit && q[a] < limit))
            return fail(error, LAM_BAD_ARGUMENT,
                        "parametric surface: a point's coordinate is %g, expected a finite number below 1e38", q[a]);
        at[a] = (float)(q[a] + 0.0); // −0 becomes 0
    }
    return true;
}

static void set_attributes(const struct tessellation *t, size_t at, lam_vec3 n, lam_vec3 tangent)
{
    float *normal = t->normals + 3 * at, *four = t->tangents + 4 * at;
    normal[0] = (float)(n.x + 0.0);
    normal[1] = (float)(n.y + 0.0);
    normal[2] = (float)(n.z + 0.0);
    four[0] = (float)(tangent.x + 0.0);
    four[1] = (float)(tangent.y + 0.0);
    four[2] = (float)(tangent.z + 0.0);
    four[3] = 1.0f; // n × t points along ∂p/∂v, since n is ∂p/∂u × ∂p/∂v
}

static size_t attribute_at(const struct tessellation *t, int i, int j)
{
    return t->attribute_base + (size_t)j * (size_t)(t->surface->u_segments + 1) + (size_t)i;
}

// Gives a smooth pole a single normal: the mean over its columns, if the normals of the columns agree with the mean.
static void smooth_pole(const struct tessellation *t, int j)
{
    int count = t->surface->u_segments;
    lam_vec3 sum = v3(0, 0, 0);
    for (int i = 0; i < count; i++) {
        const float *n = t->normals + 3 * attribute_at(t, i, j);
        sum = v3_add(sum, v3((double)n[0], (double)n[1], (double)n[2]));
    }
    lam_vec3 mean = v3_unit(sum);
    for (int i = 0; i < count; i++) {
        const float *n = t->normals + 3 * attribute_at(t, i, j);
        if (!(v3_dot(mean, v3((double)n[0], (double)n[1], (double)n[2])) > SMOOTH_POLE))
            return;
    }
    for (int i = 0; i <= count; i++) {
        const float *four = t->tangents + 4 * attribute_at(t, i, j);
        lam_vec3 tangent = v3((double)four[0], (double)four[1], (double)four[2]);
        tangent = v3_unit(v3_sub(tangent, v3_scale(mean, v3_dot(mean, tangent))));
        set_attributes(t, attribute_at(t, i, j), mean, tangent);
    }
}

static void copy_attributes(const struct tessellation *t, size_t to, size_t from)
{
    memcpy(t->normals + 3 * to, t->normals + 3 * from, 3 * sizeof(float));
    memcpy(t->tangents + 4 * to, t->tangents + 4 * from, 4 * sizeof(float));
}

// Returns whether row j is the last one of a surface that is closed along v. The normals and tangents of this row are
// copied from the first row after all other rows are computed.
static bool closes(const lam_parametric *s, int j) { return s->v_closed && j == s->v_segments; }

// Computes the attributes of row j; at a pole, the attributes of the centres of the cells.
static void set_row_attributes(const struct tessellation *t, int j, const lam_surface_point *points)
{
    const lam_parametric *s = t->surface;
    int count = s->u_segments;
    bool pole = t->rows[j].pole;
    double v = parameter(s->v_min, s->v_max, j, s->v_segments);
    for (int i = 0; i <= count; i++) {
        size_t at = attribute_at(t, i, j);
        bool column_pole = (i == 0 && t->first_column_pole) || (i == count && t->last_column_pole);
        double u = pole && i < count ? middle(s->u_min, s->u_max, i, count) : parameter(s->u_min, s->u_max, i, count);
        double at_v = column_pole && j < s->v_segments ? middle(s->v_min, s->v_max, j, s->v_segments) : v;
        t->texcoords[2 * at] = (float)((u - s->u_min) / (s->u_max - s->u_min));
        t->texcoords[2 * at + 1] = (float)((at_v - s->v_min) / (s->v_max - s->v_min));
        if (closes(s, j))
            continue;
        if (s->u_closed && i == count) {
            copy_attributes(t, at, attribute_at(t, 0, j));
            continue;
        }
        lam_surface_point moved;
        const lam_surface_point *point = &points[i];
        if (pole || column_pole) {
            moved = evaluate(t, u, at_v);
            point = &moved;
        }
        lam_vec3 normal, tangent;
        frame_at(t, u, at_v, point, &normal, &tangent);
        set_attributes(t, at, normal, tangent);
    }
    if (pole && !closes(s, j))
        smooth_pole(t, j);
}

static uint32_t vertex_at(const struct tessellation *t, int i, int j)
{
    const struct row *row = &t->rows[j];
    if (i == 0 || row->single)
        return row->first;
    return i == t->surface->u_segments ? row->last : row->middle + (uint32_t)i - 1;
}

// Writes the positions of the vertices that belong to row j.
static bool set_row_positions(const struct tessellation *t, int j, const lam_surface_point *points, lam_error *error)
{
    const lam_parametric *s = t->surface;
    const struct row *row = &t->rows[j];
    int count = s->u_segments;
    for (int i = 0; i <= count; i++) {
        if (!(i == 0 ? row->owns_first : i == count ? row->owns_last : row->owns_middle))
            continue;
        uint32_t vertex = vertex_at(t, i, j);
        if (!set_position(t, vertex, points[i].p, error))
            return false;
        if (t->border)
            t->border[vertex] = i == 0 || i == count || j == 0 || j == s->v_segments;
    }
    return true;
}

struct cell_corner {
    uint32_t vertex, attribute;
};

static bool is_triangle(uint32_t a, uint32_t b, uint32_t c) { return a != b && b != c && c != a; }

static void add_triangle(const struct tessellation *t, size_t *corner, struct cell_corner a, struct cell_corner b,
                         struct cell_corner c)
{
    if (!is_triangle(a.vertex, b.vertex, c.vertex))
        return;
    struct cell_corner corners[3] = {a, b, c};
    for (int k = 0; k < 3; k++) {
        t->indices[*corner] = corners[k].vertex;
        t->attributes[(*corner)++] = corners[k].attribute;
    }
}

// Writes the cells between row j − 1 and row j. At a pole, each cell has its own attributes, at the index of the cell.
static void set_cells(const struct tessellation *t, int j)
{
    const struct row *below = &t->rows[j - 1], *above = &t->rows[j];
    int count = t->surface->u_segments;
    uint32_t low = (uint32_t)attribute_at(t, 0, j - 1), high = (uint32_t)attribute_at(t, 0, j);
    uint32_t left[2] = {vertex_at(t, 0, j - 1), vertex_at(t, 0, j)};
    size_t corner = above->corner;
    for (int i = 0; i < count; i++) {
        uint32_t right[2] = {vertex_at(t, i + 1, j - 1), vertex_at(t, i + 1, j)}, at = (uint32_t)i;
        bool left_pole = i == 0 && t->first_column_pole, right_pole = i + 1 == count && t->last_column_pole;
        struct cell_corner a = {left[0], low + at}, b = {right[0], low + at + !below->pole};
        struct cell_corner c = {right[1], (right_pole ? low : high) + at + !above->pole};
        struct cell_corner d = {left[1], (left_pole ? low : high) + at};
        add_triangle(t, &corner, a, b, c);
        add_triangle(t, &corner, a, c, d);
        left[0] = right[0];
        left[1] = right[1];
    }
}

// Counts the corners of the cells between row j − 1 and row j. If there are no poles and at least two segments in u and
// in v, each cell has two triangles. With a single segment, the ends of the surface may be joined.
static size_t count_corners(const struct tessellation *t, int j)
{
    const lam_parametric *s = t->surface;
    size_t triangles = 0;
    if (!t->rows[j - 1].single && !t->rows[j].single && !t->first_column_pole && !t->last_column_pole &&
        s->u_segments > 1 && s->v_segments > 1)
        return 6 * (size_t)s->u_segments;
    for (int i = 0; i < s->u_segments; i++) {
        uint32_t a = vertex_at(t, i, j - 1), b = vertex_at(t, i + 1, j - 1), c = vertex_at(t, i + 1, j),
                 d = vertex_at(t, i, j);
        triangles += (size_t)is_triangle(a, b, c) + (size_t)is_triangle(a, c, d);
    }
    return 3 * triangles;
}

// Numbers the vertices and corners of all rows, so that the rows can be computed in any order.
static void number_rows(struct tessellation *t)
{
    const lam_parametric *s = t->surface;
    for (int j = 0; j <= s->v_segments && should_continue(&t->loop); j++) {
        struct row *row = &t->rows[j], *before = j > 0 ? row - 1 : row;
        bool pole = row_is_pole(t, parameter(s->v_min, s->v_max, j, s->v_segments)), joined = pole || s->u_closed;
        if (closes(s, j)) {
            *row = t->rows[0];
            row->owns_first = row->owns_middle = row->owns_last = false;
        } else {
            *row = (struct row){.single = pole,
                                .owns_first = j == 0 || !t->first_column_pole,
                                .owns_middle = !pole,
                                .owns_last = !joined && (j == 0 || !t->last_column_pole)};
            row->first = row->owns_first ? t->vertex++ : before->first;
            row->middle = t->vertex;
            t->vertex += row->owns_middle ? (uint32_t)s->u_segments - 1 : 0;
            row->last = row->owns_last ? t->vertex++ : joined ? row->first : before->last;
        }
        row->pole = pole;
        row->corner = t->corner;
        t->corner += j > 0 ? count_corners(t, j) : 0;
    }
}

static bool compute_row(const struct tessellation *t, int j, lam_surface_point *points, lam_error *error)
{
    const lam_parametric *s = t->surface;
    double v = parameter(s->v_min, s->v_max, j, s->v_segments);
    for (int i = 0; i <= s->u_segments; i++)
        points[i] = evaluate(t, parameter(s->u_min, s->u_max, i, s->u_segments), v);
    if (!set_row_positions(t, j, points, error))
        return false;
    set_row_attributes(t, j, points);
    if (j > 0)
        set_cells(t, j);
    return true;
}

static void rows_task(void *user, size_t index, int thread)
{
    struct tessellation *t = user;
    int first = (int)index * ROWS, last = t->surface->v_segments;
    last = first + ROWS - 1 < last ? first + ROWS - 1 : last;
    for (int j = first; j <= last && should_continue(&t->loop); j++) {
        if (compute_row(t, j, t->points + (size_t)thread * t->widest, NULL))
            continue;
        int known = __atomic_load_n(&t->failed, __ATOMIC_RELAXED);
        while (j < known &&
               !__atomic_compare_exchange_n(&t->failed, &known, j, false, __ATOMIC_RELAXED, __ATOMIC_RELAXED))
            ;
        return;
    }
}

static bool tessellate_one(struct tessellation *t, struct pool *pool, lam_error *error)
{
    const lam_parametric *s = t->surface;
    t->first_column_pole = !s->u_closed && column_is_pole(t, s->u_min);
    t->last_column_pole = !s->u_closed && column_is_pole(t, s->u_max);
    t->failed = s->v_segments + 1;
    number_rows(t);
    pool_run(pool, (size_t)s->v_segments / ROWS + 1, rows_task, t);
    if (!should_continue(&t->loop))
        return loop_error(&t->loop, 0, error);
    if (t->failed <= s->v_segments)
        return compute_row(t, t->failed, t->points, error); // computes the failed row again, to set `error`
    for (int i = 0; s->v_closed && i <= s->u_segments; i++)
        copy_attributes(t, attribute_at(t, i, s->v_segments), attribute_at(t, i, 0));
    if (s->v_closed && t->rows[s->v_segments].pole)
        smooth_pole(t, s->v_segments);
    t->attribute_base += (uint32_t)(s->u_segments + 1) * (uint32_t)(s->v_segments + 1);
    return true;
}

static bool check(const lam_parametric *s, lam_error *error)
{
    const char *kind = "parametric surface";
    if (!s->surface)
        return fail(error, LAM_BAD_ARGUMENT, "%s: the function `surface` is NULL", kind);
    if (!math_finite(s->u_min) || !math_finite(s->u_max) || !(s->u_min < s->u_max))
        return fail(error, LAM_BAD_ARGUMENT, "%s: u goes from %g to %g, expected finite numbers with u_min < u_max",
                    kind, s->u_min, s->u_max);
    if (!math_finite(s->v_min) || !math_finite(s->v_max) || !(s->v_min < s->v_max))
        return fail(error, LAM_BAD_ARGUMENT, "%s: v goes from %g to %g, expected finite numbers with v_min < v_max",
                    kind, s->v_min, s->v_max);
    if (s->u_segments < 1 || s->u_segments > 16384)
        return fail(error, LAM_BAD_ARGUMENT, "%s: u_segments is %d, expected 1 to 16384", kind, s->u_segments);
    if (s->v_segments < 1 || s->v_segments > 16384)
        return fail(error, LAM_BAD_ARGUMENT, "%s: v_segments is %d, expected 1 to 16384", kind, s->v_segments);
    return true;
}

// Computes the bounding box of a coarse sample of all surfaces, for tolerances and the origin.
static bool sample_box(const lam_parametric *surfaces, int count, double low[3], double high[3], lam_error *error)
{
    enum { STEPS = 8 };
    for (int a = 0; a < 3; a++) {
        low[a] = 1e308;
        high[a] = -1e308;
    }
    for (int k = 0; k < count; k++)
        for (int j = 0; j <= STEPS; j++)
            for (int i = 0; i <= STEPS; i++) {
                const lam_parametric *s = &surfaces[k];
                double u = parameter(s->u_min, s->u_max, i, STEPS), v = parameter(s->v_min, s->v_max, j, STEPS);
                lam_surface_point point = {0};
                s->surface(s->user, u, v, &point);
                if (!v3_finite(point.p))
                    return fail(error, LAM_BAD_ARGUMENT,
                                "parametric surface: the point at u = %g, v = %g is not finite", u, v);
                double p[3] = {point.p.x, point.p.y, point.p.z};
                for (int a = 0; a < 3; a++) {
                    low[a] = p[a] < low[a] ? p[a] : low[a];
                    high[a] = p[a] > high[a] ? p[a] : high[a];
                }
            }
    return true;
}

// Makes a pool of at most `threads` threads (0: one for each processor) for this many vertices, or returns NULL if one
// thread suffices.
static struct pool *make_pool(int threads, uint64_t vertices)
{
    uint64_t useful = vertices / OF_THREAD;
    threads = threads ? threads : lam_processors_available();
    threads = (uint64_t)threads < useful ? threads : (int)useful;
    return threads > 1 ? pool_make(threads) : NULL;
}

// The sums over a mesh's surfaces, and the largest numbers of segments.
struct sizes {
    uint64_t attributes, triangles;
    int widest, longest; // the largest numbers of segments in u and in v
};

static bool measure(const lam_parametric *surfaces, int count, struct sizes *sizes, lam_error *error)
{
    *sizes = (struct sizes){0};
    for (int k = 0; k < count; k++) {
        const lam_parametric *s = &surfaces[k];
        if (!check(s, error))
            return false;
        sizes->attributes += (uint64_t)(s->u_segments + 1) * (uint64_t)(s->v_segments + 1);
        sizes->triangles += 2 * (uint64_t)s->u_segments * (uint64_t)s->v_segments;
        sizes->widest = s->u_segments > sizes->widest ? s->u_segments : sizes->widest;
        sizes->longest = s->v_segments > sizes->longest ? s->v_segments : sizes->longest;
    }
    return sizes->attributes <= SHAPE_VERTICES_MAX ||
           fail(error, LAM_LIMIT, "parametric surface: %llu vertices, expected at most %d",
                (unsigned long long)sizes->attributes, SHAPE_VERTICES_MAX);
}

// Divides a block of memory into the arrays of the mesh.
static void place_arrays(struct tessellation *t, float *block, const struct sizes *sizes)
{
    t->positions = block;
    t->normals = t->positions + 3 * sizes->attributes;
    t->tangents = t->normals + 3 * sizes->attributes;
    t->texcoords = t->tangents + 4 * sizes->attributes;
    t->indices = (uint32_t *)(t->texcoords + 2 * sizes->attributes);
    t->attributes = t->indices + 3 * sizes->triangles;
}

static bool tessellate(const lam_parametric *surfaces, int count, const struct shape_request *request, lam_mesh *mesh,
                       struct arena *border_arena, uint8_t **border)
{
    struct sizes sizes;
    double low[3], high[3];
    if (!measure(surfaces, count, &sizes, request->error) || !sample_box(surfaces, count, low, high, request->error))
        return false;

    struct tessellation t = {.widest = (size_t)sizes.widest + 1, .loop = {.call = request->call}};
    origin_choose(low, high, t.origin);
    for (int a = 0; a < 3; a++)
        t.size = high[a] - low[a] > t.size ? high[a] - low[a] : t.size;
    struct arena scratch, of_threads; // the latter's memory is not counted, because the number of threads varies
    struct pool *pool = make_pool(request->threads, sizes.attributes);
    arena_start(&scratch, request->call);
    arena_start(&of_threads, NULL);
    t.points = arena_array(&of_threads, t.widest * (size_t)pool_threads(pool), sizeof *t.points);
    t.rows = arena_array(&scratch, (size_t)sizes.longest + 1, sizeof *t.rows);
    float *block = arena_array(request->arena, 12 * sizes.attributes + 6 * sizes.triangles, sizeof(float));
    if (block)
        place_arrays(&t, block, &sizes);
    if (border)
        t.border = *border = arena_alloc_zeroed(border_arena, sizes.attributes);
    bool ok = (!border || t.border) && t.points && t.rows && block;
    if (!ok)
        call_memory_error(request->call, sizes.attributes * 48 + sizes.triangles * 24, request->error);
    for (int k = 0; ok && k < count; k++) {
        t.surface = &surfaces[k];
        t.u_unit = t.size / (t.surface->u_max - t.surface->u_min);
        t.v_unit = t.size / (t.surface->v_max - t.surface->v_min);
        ok = tessellate_one(&t, pool, request->error);
    }
    pool_free(pool);
    arena_free(&scratch);
    arena_free(&of_threads);
    if (!ok)
        return false;
    *mesh = (lam_mesh){
        .origin = {t.origin[0], t.origin[1], t.origin[2]},
        .positions = t.positions,
        .vertex_count = t.vertex,
        .indices = t.indices,
        .triangle_count = (uint32_t)(t.corner / 3),
        .normals = t.normals,
        .normal_count = (uint32_t)sizes.attributes,
        .normal_indices = t.attributes,
        .texcoords = t.texcoords,
        .texcoord_count = (uint32_t)sizes.attributes,
        .texcoord_indices = t.attributes,
        .tangents = t.tangents,
        .tangent_count = (uint32_t)sizes.attributes,
        .tangent_indices = t.attributes,
    };
    return true;
}

bool tessellate_bordered(const lam_parametric *surfaces, int count, struct arena *arena, struct call_control *call,
                         lam_mesh *mesh, struct arena *scratch, uint8_t **border, lam_error *error)
{
    const struct shape_request request = {.arena = arena, .call = call, .error = error, .threads = 1};
    return tessellate(surfaces, count, &request, mesh, scratch, border);
}

bool tessellate_parametric(const lam_parametric *surfaces, int count, const struct shape_request *request,
                           lam_mesh *mesh)
{
    return tessellate(surfaces, count, request, mesh, NULL, NULL);
}
