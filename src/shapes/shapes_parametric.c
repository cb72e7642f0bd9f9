// shapes_parametric.c: tessellates parametric surfaces p(u, v).
//
// The domain is divided into u_segments × v_segments cells of two triangles each, counter-clockwise seen from the side
// that ∂p/∂u × ∂p/∂v points to.
//
// Seams: if u (or v) is closed, the last column (row) has the position, normal and tangent of the first, bit for bit;
// only the texture coordinate differs.
//
// Poles: a row, or the first or last column, whose points coincide is one vertex. Degenerate triangles there are
// skipped. Each remaining triangle has its own corner at the pole, with the texture coordinate, tangent and normal of
// the centre of its cell. If these normals agree, the pole is smooth and all corners get their mean; otherwise it is a
// tip, as of a cone, and each corner keeps its normal.
//
// A zero derivative does not determine the tangent plane. It is replaced by the derivative at a point a ten-thousandth
// of the domain further inside, which approximates the one-sided limit.
#include "shapes.h"

#include "fail.h"
#include "linear.h"
#include "origin.h"

#include <string.h>

// Points closer than this fraction of the surface's size coincide; floats cannot represent the difference.
#define COINCIDENT 1e-9
// A derivative below this fraction of size per domain length counts as zero.
#define VANISHED 1e-9
// The distance from the boundary at which the one-sided limit is approximated, as a fraction of the domain.
#define INSET 1e-4
// A pole is smooth if the cosines of its normals with their mean are above this (0.08°).
#define SMOOTH_POLE (1 - 1e-6)

struct tessellation {
    const lam_parametric *surface;
    lam_mesh *mesh;
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
    lam_surface_point *row;
    uint32_t *ids[3]; // vertices of the previous row, the current row and the first row
};

// Returns the parameter at step i of n from a to b. The ends are exact; mirrored steps of a symmetric domain give
// mirrored bits.
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

// Returns x, moved by INSET of the domain towards its centre.
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

static bool row_is_pole(const struct tessellation *t)
{
    for (int i = 1; i <= t->surface->u_segments; i++)
        if (!coincide(t, t->row[0].p, t->row[i].p))
            return false;
    return true;
}

static bool add_position(struct tessellation *t, lam_vec3 p, uint32_t *id, lam_error *error)
{
    const double limit = 1e38; // below FLT_MAX, so that differences and lengths do not overflow
    double q[3] = {p.x - t->origin[0], p.y - t->origin[1], p.z - t->origin[2]};
    float *at = t->positions + 3 * (size_t)t->vertex;
    for (int a = 0; a < 3; a++) {
        if (!(q[a] > -limit && q[a] < limit))
            return fail(error, LAM_BAD_ARGUMENT,
                        "parametric surface: a point's coordinate is %g, expected a finite number below 1e38", q[a]);
        at[a] = (float)(q[a] + 0.0); // −0 becomes 0
    }
    *id = t->vertex++;
    return true;
}

static void set_attributes(struct tessellation *t, size_t at, lam_vec3 n, lam_vec3 tangent)
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

// Gives a smooth pole one normal: the mean over its columns, if they agree with it.
static void smooth_pole(struct tessellation *t, int j)
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

// Adds the attributes of row j; at a pole, the attributes of the centres of the cells.
static void add_attributes(struct tessellation *t, int j, bool pole)
{
    const lam_parametric *s = t->surface;
    int count = s->u_segments;
    double v = parameter(s->v_min, s->v_max, j, s->v_segments);
    for (int i = 0; i <= count; i++) {
        size_t at = attribute_at(t, i, j);
        bool column_pole = (i == 0 && t->first_column_pole) || (i == count && t->last_column_pole);
        double u = pole && i < count ? middle(s->u_min, s->u_max, i, count) : parameter(s->u_min, s->u_max, i, count);
        double at_v = column_pole && j < s->v_segments ? middle(s->v_min, s->v_max, j, s->v_segments) : v;
        t->texcoords[2 * at] = (float)((u - s->u_min) / (s->u_max - s->u_min));
        t->texcoords[2 * at + 1] = (float)((at_v - s->v_min) / (s->v_max - s->v_min));
        size_t same = s->v_closed && j == s->v_segments ? attribute_at(t, i, 0)
                      : s->u_closed && i == count       ? attribute_at(t, 0, j)
                                                        : at;
        if (same != at) {
            memcpy(t->normals + 3 * at, t->normals + 3 * same, 3 * sizeof(float));
            memcpy(t->tangents + 4 * at, t->tangents + 4 * same, 4 * sizeof(float));
            continue;
        }
        lam_surface_point moved;
        const lam_surface_point *point = &t->row[i];
        if (pole || column_pole) {
            moved = evaluate(t, u, at_v);
            point = &moved;
        }
        lam_vec3 normal, tangent;
        frame_at(t, u, at_v, point, &normal, &tangent);
        set_attributes(t, at, normal, tangent);
    }
    if (pole)
        smooth_pole(t, j);
}

// Adds the vertices of row j and stores them in ids[1].
static bool add_vertices(struct tessellation *t, int j, bool pole, lam_error *error)
{
    const lam_parametric *s = t->surface;
    uint32_t *before = t->ids[0], *ids = t->ids[1], *first = t->ids[2];
    int count = s->u_segments;
    for (int i = 0; i <= count; i++) {
        if (j > 0 && j == s->v_segments && s->v_closed)
            ids[i] = first[i];
        else if (i > 0 && (pole || (i == count && s->u_closed)))
            ids[i] = ids[0];
        else if (j > 0 && ((i == 0 && t->first_column_pole) || (i == count && t->last_column_pole)))
            ids[i] = before[i];
        else if (!add_position(t, t->row[i].p, &ids[i], error))
            return false;
        if (t->border && t->vertex && ids[i] == t->vertex - 1)
            t->border[ids[i]] = i == 0 || i == count || j == 0 || j == s->v_segments;
    }
    if (j == 0)
        memcpy(first, ids, (size_t)(count + 1) * sizeof *ids);
    return true;
}

struct cell_corner {
    uint32_t vertex, attribute;
};

static void add_triangle(struct tessellation *t, struct cell_corner a, struct cell_corner b, struct cell_corner c)
{
    if (a.vertex == b.vertex || b.vertex == c.vertex || c.vertex == a.vertex)
        return;
    struct cell_corner corners[3] = {a, b, c};
    for (int k = 0; k < 3; k++) {
        t->indices[t->corner] = corners[k].vertex;
        t->attributes[t->corner++] = corners[k].attribute;
    }
}

// Returns the corner (i, j) of cell (cell_i, cell_j). At a pole, each cell has its own attributes, at the index of the
// cell.
static struct cell_corner corner_of(const struct tessellation *t, int i, int j, int cell_i, int cell_j, uint32_t vertex,
                                    bool row_pole)
{
    bool column_pole = (i == 0 && t->first_column_pole) || (i == t->surface->u_segments && t->last_column_pole);
    return (struct cell_corner){vertex, (uint32_t)attribute_at(t, row_pole ? cell_i : i, column_pole ? cell_j : j)};
}

static void add_cells(struct tessellation *t, int j, bool pole_before, bool pole)
{
    const uint32_t *below = t->ids[0], *above = t->ids[1];
    for (int i = 0; i < t->surface->u_segments; i++) {
        struct cell_corner a = corner_of(t, i, j - 1, i, j - 1, below[i], pole_before);
        struct cell_corner b = corner_of(t, i + 1, j - 1, i, j - 1, below[i + 1], pole_before);
        struct cell_corner c = corner_of(t, i + 1, j, i, j - 1, above[i + 1], pole);
        struct cell_corner d = corner_of(t, i, j, i, j - 1, above[i], pole);
        add_triangle(t, a, b, c);
        add_triangle(t, a, c, d);
    }
}

static bool tessellate_one(struct tessellation *t, struct call_control *call, lam_error *error)
{
    const lam_parametric *s = t->surface;
    t->first_column_pole = !s->u_closed && column_is_pole(t, s->u_min);
    t->last_column_pole = !s->u_closed && column_is_pole(t, s->u_max);
    bool pole_before = false;
    for (int j = 0; j <= s->v_segments; j++) {
        if (!call_should_continue(call))
            return call_error(call, error);
        double v = parameter(s->v_min, s->v_max, j, s->v_segments);
        for (int i = 0; i <= s->u_segments; i++)
            t->row[i] = evaluate(t, parameter(s->u_min, s->u_max, i, s->u_segments), v);
        bool pole = row_is_pole(t);
        if (!add_vertices(t, j, pole, error))
            return false;
        add_attributes(t, j, pole);
        if (j > 0)
            add_cells(t, j, pole_before, pole);
        pole_before = pole;
        uint32_t *swap = t->ids[0];
        t->ids[0] = t->ids[1];
        t->ids[1] = swap;
    }
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

bool tessellate_bordered(const lam_parametric *surfaces, int count, struct arena *arena, struct call_control *call,
                         lam_mesh *mesh, struct arena *border_arena, uint8_t **border, lam_error *error)
{
    uint64_t attributes = 0, triangles = 0;
    int widest = 0;
    for (int k = 0; k < count; k++) {
        const lam_parametric *s = &surfaces[k];
        if (!check(s, error))
            return false;
        attributes += (uint64_t)(s->u_segments + 1) * (uint64_t)(s->v_segments + 1);
        triangles += 2 * (uint64_t)s->u_segments * (uint64_t)s->v_segments;
        widest = s->u_segments > widest ? s->u_segments : widest;
    }
    if (attributes > SHAPE_VERTICES_MAX)
        return fail(error, LAM_LIMIT, "parametric surface: %llu vertices, expected at most %d",
                    (unsigned long long)attributes, SHAPE_VERTICES_MAX);
    double low[3], high[3];
    if (!sample_box(surfaces, count, low, high, error))
        return false;

    struct tessellation t = {.mesh = mesh};
    origin_choose(low, high, t.origin);
    for (int a = 0; a < 3; a++)
        t.size = high[a] - low[a] > t.size ? high[a] - low[a] : t.size;
    size_t row = (size_t)widest + 1;
    struct arena scratch;
    arena_start(&scratch, call);
    t.row = arena_array(&scratch, row, sizeof *t.row);
    for (int k = 0; k < 3; k++)
        t.ids[k] = arena_array(&scratch, row, sizeof *t.ids[k]);
    t.positions = arena_array(arena, attributes, 3 * sizeof(float));
    t.normals = arena_array(arena, attributes, 3 * sizeof(float));
    t.tangents = arena_array(arena, attributes, 4 * sizeof(float));
    t.texcoords = arena_array(arena, attributes, 2 * sizeof(float));
    t.indices = arena_array(arena, 3 * triangles, sizeof(uint32_t));
    t.attributes = arena_array(arena, 3 * triangles, sizeof(uint32_t));
    if (border)
        t.border = *border = arena_alloc_zeroed(border_arena, attributes);
    bool ok = (!border || t.border) && t.row && t.ids[0] && t.ids[1] && t.ids[2] && t.positions && t.normals &&
              t.tangents && t.texcoords && t.indices && t.attributes;
    if (!ok)
        call_memory_error(call, attributes * 48 + triangles * 24, error);
    for (int k = 0; ok && k < count; k++) {
        t.surface = &surfaces[k];
        t.u_unit = t.size / (t.surface->u_max - t.surface->u_min);
        t.v_unit = t.size / (t.surface->v_max - t.surface->v_min);
        ok = tessellate_one(&t, call, error);
    }
    arena_free(&scratch);
    if (!ok)
        return false;
    *mesh = (lam_mesh){
        .origin = {t.origin[0], t.origin[1], t.origin[2]},
        .positions = t.positions,
        .vertex_count = t.vertex,
        .indices = t.indices,
        .triangle_count = (uint32_t)(t.corner / 3),
        .normals = t.normals,
        .normal_count = (uint32_t)attributes,
        .normal_indices = t.attributes,
        .texcoords = t.texcoords,
        .texcoord_count = (uint32_t)attributes,
        .texcoord_indices = t.attributes,
        .tangents = t.tangents,
        .tangent_count = (uint32_t)attributes,
        .tangent_indices = t.attributes,
    };
    return true;
}

bool tessellate_parametric(const lam_parametric *surfaces, int count, struct arena *arena, struct call_control *call,
                           lam_mesh *mesh, lam_error *error)
{
    return tessellate_bordered(surfaces, count, arena, call, mesh, NULL, NULL, error);
}
