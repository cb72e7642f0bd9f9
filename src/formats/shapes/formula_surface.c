// formula_surface.c: makes a mesh from a parametric formula, and chooses the mesh's resolution, seams and creases.
//
// Creases: the domain is cut along grid lines where the normals of the two sides differ, and along lines whose points
// coincide (a pole inside the domain). At these lines, each part of the domain has its own normals, computed from its
// own side.
//
// Seams: if two ends of the domain meet with equal normals, the surface is closed there (shapes_parametric.c). Parts of
// the domain, and ends that meet in another way, such as upside down on a Möbius strip, share their vertices but not
// their normals.
#include "formula.h"

#include "fail.h"
#include "float_state.h"
#include "linear.h"
#include "shapes.h"

#include <stdlib.h>
#include <string.h>

enum { SEGMENTS_MAX = 16384, LEAST_SEGMENTS = 16, MOST_CHOSEN = 512, PROBES = 17, PROBED_LINES = 65 };
// At the ends of a part, derivatives are one-sided: they are evaluated at this distance inside the part, as a fraction
// of the domain.
#define ASIDE 1e-7
// The maximum distance between the midpoint of an edge and the surface, as a fraction of the size.
#define SAGITTA (1.0 / 4000)
// If the normals of the two sides of a line differ by more than a degree, the line is a crease.
#define CREASE_COSINE 0.99985
// Border points closer than this fraction of the size are merged.
#define WELDED 2.5e-7

struct surface {
    struct formula formula;
    double from[2], to[2]; // the domain: u, v
    int segments[2];
    double size;
    bool undefined; // whether a point was not finite; the first such point
    double undefined_at[2];
    int undefined_axis;
};

struct patch {
    struct surface *surface;
    double from[2], to[2];
    double texture_from[2], texture_to[2];
};

static double length_of(lam_vec3 v) { return v3_length(v); }

static double step_of(double a, double b, int i, int n) { return i <= 0 ? a : i >= n ? b : (a * (n - i) + b * i) / n; }

static lam_surface_point evaluate(struct surface *s, double u, double v)
{
    lam_surface_point point;
    formula_evaluate(&s->formula, u, v, &point);
    double p[3] = {point.p.x, point.p.y, point.p.z};
    for (int a = 0; a < 3 && !s->undefined; a++)
        if (!(p[a] > -1e38 && p[a] < 1e38)) {
            s->undefined = true;
            s->undefined_at[0] = u;
            s->undefined_at[1] = v;
            s->undefined_axis = a;
        }
    return point;
}

// Returns a derivative at the end of a part. `own` is the formula's derivative at this end, which may not exist or may
// belong to the other side of a crease. `inner` is the derivative slightly inside the part.
static lam_vec3 one_sided(const struct surface *s, lam_vec3 own, lam_vec3 inner, int axis)
{
    double unit = s->size / (s->to[axis] - s->from[axis]);
    if (!v3_finite(inner))
        return v3_finite(own) ? own : v3(0, 0, 0);
    double lengths = length_of(own) + length_of(inner), difference = length_of(v3_sub(own, inner));
    return !v3_finite(own) || (difference > 1e-4 * lengths && lengths > 1e-5 * unit) ? inner : own;
}

static void patch_point(void *user, double u, double v, lam_surface_point *out)
{
    const struct patch *patch = user;
    struct surface *s = patch->surface;
    *out = evaluate(s, u, v);
    double at[2] = {u, v}, inner[2];
    bool end = false;
    for (int a = 0; a < 2; a++) {
        double h = ASIDE * (s->to[a] - s->from[a]);
        bool first = at[a] <= patch->from[a], last = at[a] >= patch->to[a];
        inner[a] = first ? at[a] + h : last ? at[a] - h : at[a];
        end |= first || last;
    }
    if (!end && v3_finite(out->dp_du) && v3_finite(out->dp_dv))
        return;
    if (!end) {
        inner[0] += ASIDE * (s->to[0] - s->from[0]);
        inner[1] += ASIDE * (s->to[1] - s->from[1]);
    }
    lam_surface_point near;
    formula_evaluate(&s->formula, inner[0], inner[1], &near);
    out->dp_du = one_sided(s, out->dp_du, near.dp_du, 0);
    out->dp_dv = one_sided(s, out->dp_dv, near.dp_dv, 1);
}

static bool measure(struct surface *s, lam_error *error)
{
    double low[3] = {1e300, 1e300, 1e300}, high[3] = {-1e300, -1e300, -1e300};
    for (int i = 0; i < PROBES * PROBES; i++) {
        lam_vec3 at = evaluate(s, step_of(s->from[0], s->to[0], i % PROBES, PROBES - 1),
                               step_of(s->from[1], s->to[1], i / PROBES, PROBES - 1))
                          .p;
        double p[3] = {at.x, at.y, at.z};
        for (int a = 0; a < 3 && !s->undefined; a++) {
            low[a] = p[a] < low[a] ? p[a] : low[a];
            high[a] = p[a] > high[a] ? p[a] : high[a];
            s->size = high[a] - low[a] > s->size ? high[a] - low[a] : s->size;
        }
    }
    return s->undefined || s->size > 0 ||
           fail(error, LAM_BAD_ARGUMENT, "formula: x, y and z are constant, expected a surface over u and v");
}

static bool fail_undefined(const struct surface *s, lam_error *error)
{
    return fail(error, LAM_BAD_ARGUMENT,
                "formula: %c is not a finite number at u = %.10g, v = %.10g; expected one everywhere from u = %.10g to "
                "%.10g and v = %.10g to %.10g",
                "xyz"[s->undefined_axis], s -> undefined_at[0], s -> undefined_at[1], s -> from[0], s -> to[0],
                s -> from[1], s -> to[1]);
}

// Returns the point at the position `along` on the probe line j of `lines`. Probe lines run along `axis`.
static lam_surface_point probe(struct surface *s, int axis, double along, int j, int lines)
{
    double across = step_of(s->from[!axis], s->to[!axis], j, lines - 1);
    return axis ? evaluate(s, across, along) : evaluate(s, along, across);
}

// Doubles the number of segments until no edge deviates from the surface by more than SAGITTA.
static int choose_segments(struct surface *s, int axis)
{
    int n = LEAST_SEGMENTS;
    for (; n < MOST_CHOSEN; n *= 2) {
        double most = 0;
        for (int j = 0; j < PROBES; j++) {
            lam_vec3 a = probe(s, axis, s->from[axis], j, PROBES).p;
            for (int i = 1; i <= n; i++) {
                lam_vec3 b = probe(s, axis, step_of(s->from[axis], s->to[axis], i, n), j, PROBES).p;
                lam_vec3 m = probe(s, axis, step_of(s->from[axis], s->to[axis], 2 * i - 1, 2 * n), j, PROBES).p;
                double off = length_of(v3_sub(m, v3_scale(v3_add(a, b), 0.5)));
                most = off > most ? off : most;
                a = b;
            }
        }
        if (most <= SAGITTA * s->size)
            break;
    }
    return n;
}

// Returns the unit normal, or zero if the derivatives do not determine it.
static lam_vec3 normal_at(const struct surface *s, const lam_surface_point *point)
{
    double u_unit = s->size / (s->to[0] - s->from[0]), v_unit = s->size / (s->to[1] - s->from[1]);
    if (!v3_finite(point->dp_du) || !v3_finite(point->dp_dv) || length_of(point->dp_du) < 1e-9 * u_unit ||
        length_of(point->dp_dv) < 1e-9 * v_unit)
        return v3(0, 0, 0);
    lam_vec3 cross = v3_cross(v3_unit(point->dp_du), v3_unit(point->dp_dv));
    return length_of(cross) < 1e-5 ? v3(0, 0, 0) : v3_unit(cross);
}

static int probed_lines(const struct surface *s, int axis)
{
    return s->segments[!axis] < PROBED_LINES ? s->segments[!axis] + 1 : PROBED_LINES;
}

// Returns whether the surface is cut along a line of the grid.
static bool is_cut(struct surface *s, int axis, double along)
{
    int lines = probed_lines(s, axis);
    double h = ASIDE * (s->to[axis] - s->from[axis]);
    lam_vec3 first = probe(s, axis, along, 0, lines).p;
    bool pole = true;
    for (int j = 0; j < lines; j++) {
        pole &= length_of(v3_sub(probe(s, axis, along, j, lines).p, first)) <= 1e-9 * s->size;
        lam_surface_point below = probe(s, axis, along - h, j, lines), above = probe(s, axis, along + h, j, lines);
        lam_vec3 a = normal_at(s, &below), b = normal_at(s, &above);
        if (v3_dot(a, a) > 0.5 && v3_dot(b, b) > 0.5 && v3_dot(a, b) < CREASE_COSINE)
            return true;
    }
    return pole;
}

// Returns whether both ends of an axis have the same points and normals.
static bool is_closed(struct surface *s, int axis)
{
    int lines = s->segments[!axis] + 1;
    double h = ASIDE * (s->to[axis] - s->from[axis]);
    for (int j = 0; j < lines; j++) {
        lam_vec3 a = probe(s, axis, s->from[axis], j, lines).p, b = probe(s, axis, s->to[axis], j, lines).p;
        if (length_of(v3_sub(a, b)) > 1e-9 * s->size)
            return false;
        lam_surface_point after = probe(s, axis, s->from[axis] + h, j, lines);
        lam_surface_point before = probe(s, axis, s->to[axis] - h, j, lines);
        lam_vec3 m = normal_at(s, &after), n = normal_at(s, &before);
        if (v3_dot(m, m) > 0.5 && v3_dot(n, n) > 0.5 && v3_dot(m, n) < CREASE_COSINE)
            return false;
    }
    return true;
}

// Lists the steps at which an axis is cut, including its ends. Returns their number, or 0 if the call is stopped.
static int find_cuts(struct surface *s, int axis, int *cuts, struct call_control *call)
{
    int count = 0;
    cuts[count++] = 0;
    for (int i = 1; i < s->segments[axis]; i++) {
        if (!call_should_continue(call))
            return 0;
        if (is_cut(s, axis, step_of(s->from[axis], s->to[axis], i, s->segments[axis])))
            cuts[count++] = i;
    }
    cuts[count++] = s->segments[axis];
    return count;
}

// --- The mesh of all parts

struct border_point {
    double along; // position along a direction that is chosen so that few vertices of a shape have the same position
    const float *p;
    uint32_t vertex;
};

static int by_place(const void *one, const void *other)
{
    const struct border_point *a = one, *b = other;
    if (a->along != b->along)
        return a->along < b->along ? -1 : 1;
    return a->vertex < b->vertex ? -1 : 1;
}

// Stores a common index for coinciding border vertices in same[vertex].
static void weld(const lam_mesh *mesh, const uint8_t *border, struct border_point *points, double size, uint32_t *same)
{
    size_t count = 0;
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        const float *p = mesh->positions + 3 * (size_t)i;
        same[i] = i;
        if (border[i])
            points[count++] =
                (struct border_point){0.8427 * (double)p[0] + 0.4591 * (double)p[1] + 0.2813 * (double)p[2], p, i};
    }
    qsort(points, count, sizeof *points, by_place);
    double near = WELDED * size;
    for (size_t i = 0; i < count; i++)
        for (size_t k = i + 1; k < count && points[k].along - points[i].along <= near; k++) {
            const float *p = points[i].p, *q = points[k].p;
            lam_vec3 d = v3((double)p[0] - (double)q[0], (double)p[1] - (double)q[1], (double)p[2] - (double)q[2]);
            if (v3_dot(d, d) > near * near)
                continue;
            uint32_t a = same[points[i].vertex], b = same[points[k].vertex];
            same[points[i].vertex] = same[points[k].vertex] = a < b ? a : b;
        }
    for (uint32_t i = 0; i < mesh->vertex_count; i++) // a chain of equal vertices leads to the lowest index
        same[i] = same[same[i]];
}

static lam_vec3 corner(const lam_mesh *mesh, size_t i)
{
    const float *p = mesh->positions + 3 * (size_t)mesh->indices[i];
    return v3((double)p[0], (double)p[1], (double)p[2]);
}

// If no derivative determines a normal, sets the normal to the mean of the normals of its triangles.
static void complete_normals(lam_mesh *mesh)
{
    float *normals = (float *)(uintptr_t)mesh->normals;
    uint8_t *is_missing = NULL;
    for (uint32_t n = 0; n < mesh->normal_count; n++) {
        const float *at = normals + 3 * (size_t)n;
        if (at[0] != 0 || at[1] != 0 || at[2] != 0)
            continue;
        is_missing = is_missing ? is_missing : calloc(mesh->normal_count, 1);
        if (!is_missing)
            return;
        is_missing[n] = 1;
    }
    for (size_t t = 0; is_missing && t < mesh->triangle_count; t++) {
        lam_vec3 a = corner(mesh, 3 * t), b = corner(mesh, 3 * t + 1), c = corner(mesh, 3 * t + 2);
        lam_vec3 facet = v3_cross(v3_sub(b, a), v3_sub(c, a));
        for (int k = 0; k < 3; k++) {
            uint32_t n = mesh->normal_indices[3 * t + (size_t)k];
            float *at = normals + 3 * (size_t)n;
            if (!is_missing[n])
                continue;
            at[0] += (float)facet.x;
            at[1] += (float)facet.y;
            at[2] += (float)facet.z;
        }
    }
    free(is_missing);
}

void formula_flip(lam_mesh *mesh)
{
    uint32_t *lists[2] = {(uint32_t *)(uintptr_t)mesh->indices, (uint32_t *)(uintptr_t)mesh->normal_indices};
    float *normals = (float *)(uintptr_t)mesh->normals, *tangents = (float *)(uintptr_t)mesh->tangents;
    for (int k = 0; k < 2 && lists[k]; k++)
        for (size_t t = 0; t < mesh->triangle_count; t++) {
            uint32_t second = lists[k][3 * t + 1];
            lists[k][3 * t + 1] = lists[k][3 * t + 2];
            lists[k][3 * t + 2] = second;
        }
    for (size_t i = 0; i < 3 * (size_t)mesh->normal_count; i++)
        normals[i] = 0.0f - normals[i];
    for (size_t i = 0; i < mesh->tangent_count; i++)
        tangents[4 * i + 3] = -1.0f;
}

// Welds the borders, and removes triangles without area and unused vertices.
static bool join(lam_mesh *mesh, const uint8_t *border, double size, struct arena *scratch, lam_error *error)
{
    uint32_t *same = arena_array(scratch, (size_t)mesh->vertex_count + 1, sizeof *same);
    struct border_point *points = arena_array(scratch, (size_t)mesh->vertex_count + 1, sizeof *points);
    if (!same || !points)
        return call_memory_error(scratch->call, mesh->vertex_count * sizeof *points, error);
    weld(mesh, border, points, size, same);
    uint32_t *indices = (uint32_t *)(uintptr_t)mesh->indices, *attributes = (uint32_t *)(uintptr_t)mesh->normal_indices;
    float *positions = (float *)(uintptr_t)mesh->positions;
    uint32_t kept = 0;
    for (size_t t = 0; t < mesh->triangle_count; t++) {
        uint32_t a = same[indices[3 * t]], b = same[indices[3 * t + 1]], c = same[indices[3 * t + 2]];
        if (a == b || b == c || c == a)
            continue;
        memmove(attributes + 3 * (size_t)kept, attributes + 3 * t, 3 * sizeof *attributes);
        indices[3 * (size_t)kept] = a;
        indices[3 * (size_t)kept + 1] = b;
        indices[3 * (size_t)kept + 2] = c;
        kept++;
    }
    mesh->triangle_count = kept;
    if (!kept)
        return fail(error, LAM_BAD_ARGUMENT,
                    "formula: x, y and z make a line or a point, expected a surface over u and v");
    uint32_t *moved = same; // no longer needed
    memset(moved, 0, mesh->vertex_count * sizeof *moved);
    for (size_t i = 0; i < 3 * (size_t)kept; i++)
        moved[indices[i]] = 1;
    uint32_t vertices = 0;
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        if (!moved[i])
            continue;
        memmove(positions + 3 * (size_t)vertices, positions + 3 * (size_t)i, 3 * sizeof *positions);
        moved[i] = vertices++;
    }
    mesh->vertex_count = vertices;
    for (size_t i = 0; i < 3 * (size_t)kept; i++)
        indices[i] = moved[indices[i]];
    return true;
}

static void place_texture(const struct patch *patches, const lam_parametric *surfaces, int count, lam_mesh *mesh)
{
    float *at = (float *)(uintptr_t)mesh->texcoords;
    for (int k = 0; k < count; k++) {
        size_t n = (size_t)(surfaces[k].u_segments + 1) * (size_t)(surfaces[k].v_segments + 1);
        for (; n; n--, at += 2)
            for (int a = 0; a < 2; a++)
                at[a] = (float)(patches[k].texture_from[a] +
                                (double)at[a] * (patches[k].texture_to[a] - patches[k].texture_from[a]));
    }
}

// Divides the domain into parts, and tessellates them.
static bool make(struct surface *s, struct arena *arena, struct arena *scratch, struct call_control *call,
                 lam_mesh *mesh, lam_error *error)
{
    int *cuts[2], counts[2];
    bool closed[2];
    for (int a = 0; a < 2; a++) {
        cuts[a] = arena_array(scratch, (size_t)s->segments[a] + 1, sizeof **cuts);
        if (!cuts[a])
            return call_memory_error(call, SEGMENTS_MAX * sizeof **cuts, error);
        counts[a] = find_cuts(s, a, cuts[a], call);
        if (!counts[a])
            return call_error(call, error);
        closed[a] = counts[a] == 2 && is_closed(s, a);
    }
    size_t total = (size_t)(counts[0] - 1) * (size_t)(counts[1] - 1);
    struct patch *patches = arena_array(scratch, total, sizeof *patches);
    lam_parametric *surfaces = arena_array(scratch, total, sizeof *surfaces);
    if (!patches || !surfaces || total > 1 << 28)
        return call_memory_error(call, total * (sizeof *patches + sizeof *surfaces), error);
    for (size_t k = 0; k < total; k++) {
        size_t index[2] = {k % (size_t)(counts[0] - 1), k / (size_t)(counts[0] - 1)};
        int steps[2];
        patches[k].surface = s;
        for (int a = 0; a < 2; a++) {
            int first = cuts[a][index[a]], last = cuts[a][index[a] + 1], n = s->segments[a];
            steps[a] = last - first;
            patches[k].from[a] = step_of(s->from[a], s->to[a], first, n);
            patches[k].to[a] = step_of(s->from[a], s->to[a], last, n);
            patches[k].texture_from[a] = (double)first / n;
            patches[k].texture_to[a] = (double)last / n;
        }
        surfaces[k] = (lam_parametric){.surface = patch_point,
                                       .user = &patches[k],
                                       .u_min = patches[k].from[0],
                                       .u_max = patches[k].to[0],
                                       .v_min = patches[k].from[1],
                                       .v_max = patches[k].to[1],
                                       .u_segments = steps[0],
                                       .v_segments = steps[1],
                                       .u_closed = closed[0],
                                       .v_closed = closed[1]};
    }
    uint8_t *border = NULL;
    bool made = tessellate_bordered(surfaces, (int)total, arena, call, mesh, scratch, &border, error);
    if (s->undefined)
        return fail_undefined(s, error);
    if (!made)
        return false;
    place_texture(patches, surfaces, (int)total, mesh);
    if (!join(mesh, border, s->size, scratch, error))
        return false;
    complete_normals(mesh);
    return true;
}

// Parses a parametric formula and its ranges.
static bool parse(const lam_formula *formula, struct arena *scratch, struct surface *s, lam_error *error)
{
    const char *whole = "0..2pi";
    const char *texts[2] = {formula->u ? formula->u : whole, formula->v ? formula->v : whole};
    bool ok = formula_parse(formula->text, false, scratch, &s->formula, error);
    for (int a = 0; ok && a < 2; a++) {
        double range[2];
        ok = formula_range(&s->formula, a ? "v" : "u", texts[a], range, error);
        if (ok) {
            s->from[a] = range[0];
            s->to[a] = range[1];
        }
    }
    return ok && formula_finish(&s->formula, scratch, error);
}

bool tessellate_formula(const lam_formula *formula, struct arena *arena, struct call_control *call, lam_mesh *mesh,
                        lam_error *error)
{
    struct surface s = {0};
    int given[2] = {formula->u_segments, formula->v_segments};
    for (int a = 0; a < 2; a++)
        if (given[a] < 0 || given[a] > SEGMENTS_MAX)
            return fail(error, LAM_BAD_ARGUMENT, "formula: %c_segments is %d, expected 1 to %d (0: chosen)", "uv"[a],
                        given[a], SEGMENTS_MAX);
    struct arena scratch;
    arena_start(&scratch, call);
    bool ok = parse(formula, &scratch, &s, error) && measure(&s, error);
    for (int a = 0; ok && a < 2; a++)
        s.segments[a] = given[a] || s.undefined ? given[a] : choose_segments(&s, a);
    if (ok && s.undefined)
        ok = fail_undefined(&s, error);
    ok = ok && make(&s, arena, &scratch, call, mesh, error);
    if (ok && formula->flip)
        formula_flip(mesh);
    arena_free(&scratch);
    return ok;
}

bool lam_formula_evaluate(const lam_formula *formula, lam_vec3 at, lam_formula_point *point, lam_error *error)
{
    struct surface s = {0};
    struct call_control call;
    struct arena scratch;
    uint64_t state = float_state_enter();
    call_start(&call, NULL);
    arena_start(&scratch, &call);
    *point = (lam_formula_point){.at = at};
    bool ok;
    if (formula->implicit) {
        ok = formula_parse(formula->text, true, &scratch, &s.formula, error) &&
             formula_finish(&s.formula, &scratch, error);
        if (ok) {
            point->value = formula_value(&s.formula, at);
            point->normal = formula_gradient(&s.formula, at);
        }
    } else if ((ok = parse(formula, &scratch, &s, error))) {
        lam_surface_point surface;
        point->at = v3(s.from[0] + at.x * (s.to[0] - s.from[0]), s.from[1] + at.y * (s.to[1] - s.from[1]), 0);
        formula_evaluate(&s.formula, point->at.x, point->at.y, &surface);
        point->p = surface.p;
        point->p_u = surface.dp_du;
        point->p_v = surface.dp_dv;
        point->normal = v3_cross(surface.dp_du, surface.dp_dv);
    }
    if (formula->flip)
        point->normal = v3_scale(point->normal, -1);
    arena_free(&scratch);
    float_state_leave(state);
    return ok;
}
