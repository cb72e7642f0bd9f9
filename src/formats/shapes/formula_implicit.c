// formula_implicit.c: makes a mesh of the surface f(x, y, z) = 0 of a formula: finds the surface's box, and runs
// marching cubes.
#include "formula.h"

#include "fail.h"
#include "linear.h"
#include "shapes.h"

enum {
    CELLS = 96, // default number of cells along the longest side
    CELLS_MAX = 1024,
    SEARCH_CELLS = 64,
    SEARCH_POINTS = SEARCH_CELLS + 1,
    CHECKED_OPERATIONS = 1 << 20, // number of operations between two checks of the call's limits: a few milliseconds
};

// Half the side lengths of the cubes in which the surface is searched for. Textbook examples fit into the first cube,
// and most closed surfaces fit into the second.
static const double search_sides[] = {4, 16};

struct implicit {
    struct formula formula;
    struct call_control *call;
    int value_cost, gradient_cost; // cost of one evaluation; a sum costs 1
    int operations;                // operations since the last check of the call's limits
    bool ended;                    // the call is stopped: from now on f is NaN, which means outside
    double from[3], to[3];
    bool given[3]; // whether the range of an axis was given
};

// Returns the cost of the first `count` operations of a formula; a function takes as long as ten sums.
static int cost_of(const struct formula *formula, int count)
{
    int cost = 1;
    for (int i = 0; i < count; i++) {
        enum formula_op op = formula->nodes[i].op;
        bool sum = op < OP_POW || op == OP_CHAIN || op == OP_LESS || op == OP_NEG || op == OP_ABS;
        cost += sum ? 1 : 10;
    }
    return cost;
}

static bool has_ended(struct implicit *s, int operations)
{
    s->operations += operations;
    if (s->operations > CHECKED_OPERATIONS) {
        s->call->operations += (uint64_t)s->operations;
        s->operations = 0;
        s->ended |= !call_should_continue(s->call) ||
                    (s->call->operation_limit && s->call->operations > s->call->operation_limit);
    }
    return s->ended;
}

static bool fail_ended(const struct implicit *s, lam_error *error)
{
    if (!call_should_continue(s->call))
        return call_error(s->call, error);
    return fail(error, LAM_LIMIT,
                "formula: the implicit surfaces of the file need more than %llu operations; expected fewer segments, "
                "ranges of x, y and z, or simpler expressions (only formulas in scene files have this limit)",
                (unsigned long long)s->call->operation_limit);
}

static double value_at(void *user, lam_vec3 p)
{
    struct implicit *s = user;
    return has_ended(s, s->value_cost) ? __builtin_nan("") : formula_value(&s->formula, p);
}

static lam_vec3 gradient_at(void *user, lam_vec3 p)
{
    struct implicit *s = user;
    return has_ended(s, s->gradient_cost) ? v3(0, 0, 0) : formula_gradient(&s->formula, p);
}

// --- the box

static double step_of(double from, double to, int i) { return from + (to - from) * ((double)i / SEARCH_CELLS); }

// Searches a coarse lattice for edges that the surface crosses. Along each axis, gets the lowest and the highest
// lattice position of these edges. Returns false if the surface crosses no edge.
static bool find_crossings(struct implicit *s, bool *inside, int first[3], int last[3])
{
    static const int strides[3] = {1, SEARCH_POINTS, SEARCH_POINTS * SEARCH_POINTS};
    bool found = false;
    for (int k = 0; k < 3; k++) {
        first[k] = SEARCH_CELLS;
        last[k] = 0;
    }
    for (int i = 0; i < SEARCH_POINTS * strides[2]; i++) {
        int at[3] = {i % SEARCH_POINTS, i / strides[1] % SEARCH_POINTS, i / strides[2]};
        inside[i] = value_at(s, v3(step_of(s->from[0], s->to[0], at[0]), step_of(s->from[1], s->to[1], at[1]),
                                   step_of(s->from[2], s->to[2], at[2]))) < 0;
        for (int axis = 0; axis < 3; axis++) {
            if (!at[axis] || inside[i] == inside[i - strides[axis]])
                continue;
            found = true;
            for (int k = 0; k < 3; k++) {
                int low = at[k] - (k == axis);
                first[k] = low < first[k] ? low : first[k];
                last[k] = at[k] > last[k] ? at[k] : last[k];
            }
        }
    }
    return found;
}

// Replaces each missing range by the extent of the surface, plus one cell of the coarse lattice. Returns false if
// the surface was not found; the ranges are then the largest searched box.
static bool fit_box(struct implicit *s, bool *inside)
{
    enum { SEARCHES = sizeof search_sides / sizeof *search_sides };
    struct implicit fits[SEARCHES];
    int chosen = -1;
    for (int search = 0; search < SEARCHES; search++) {
        int first[3], last[3];
        for (int k = 0; k < 3; k++) {
            s->from[k] = s->given[k] ? s->from[k] : -search_sides[search];
            s->to[k] = s->given[k] ? s->to[k] : search_sides[search];
        }
        if (!find_crossings(s, inside, first, last))
            continue;
        struct implicit *fit = &fits[search];
        *fit = *s;
        bool closed = true;
        for (int k = 0; k < 3; k++) {
            if (s->given[k])
                continue;
            closed &= first[k] > 0 && last[k] < SEARCH_CELLS;
            fit->from[k] = step_of(s->from[k], s->to[k], first[k] > 0 ? first[k] - 1 : 0);
            fit->to[k] = step_of(s->from[k], s->to[k], last[k] < SEARCH_CELLS ? last[k] + 1 : SEARCH_CELLS);
        }
        if (closed || chosen < 0)
            chosen = search;
        if (closed)
            break;
    }
    if (chosen >= 0)
        *s = fits[chosen];
    return chosen >= 0;
}

static bool fail_empty(struct implicit *s, lam_error *error)
{
    bool inside = value_at(s, v3(s->from[0], s->from[1], s->from[2])) < 0;
    return fail(
        error, LAM_BAD_ARGUMENT,
        "formula: no surface found in x = %.10g..%.10g, y = %.10g..%.10g, z = %.10g..%.10g: the expression is %s "
        "there, expected one that is negative inside of the surface and positive outside",
        s->from[0], s->to[0], s->from[1], s->to[1], s->from[2], s->to[2],
        inside ? "negative everywhere" : "nowhere negative");
}

bool tessellate_implicit_formula(const lam_formula *formula, struct arena *arena, struct call_control *call,
                                 lam_mesh *mesh, lam_error *error)
{
    struct implicit s = {.call = call};
    const char *const texts[3] = {formula->x, formula->y, formula->z};
    int cells = formula->u_segments;
    if (cells < 0 || cells == 1 || cells > CELLS_MAX || formula->v_segments)
        return fail(error, LAM_BAD_ARGUMENT,
                    formula->v_segments ? "formula: an implicit surface needs a single number of segments"
                                        : "formula: segments is %d, expected 2 to %d cells (0: %d)",
                    cells, CELLS_MAX, CELLS);
    struct arena scratch;
    arena_start(&scratch, call);
    bool ok = formula_parse(formula->text, true, &scratch, &s.formula, error), fits = true;
    for (int k = 0; ok && k < 3; k++) {
        double range[2];
        s.given[k] = texts[k] != NULL;
        ok = !texts[k] || formula_range(&s.formula, (const char[]){"xyz"[k], 0}, texts[k], range, error);
        if (ok && texts[k]) {
            s.from[k] = range[0];
            s.to[k] = range[1];
        }
    }
    ok = ok && formula_finish(&s.formula, &scratch, error);
    if (ok) {
        s.value_cost = cost_of(&s.formula, s.formula.outputs[0] + 1);
        s.gradient_cost = cost_of(&s.formula, s.formula.count);
    }
    if (ok && !(s.given[0] && s.given[1] && s.given[2])) {
        bool *inside = arena_array(&scratch, SEARCH_POINTS * SEARCH_POINTS * SEARCH_POINTS, sizeof *inside);
        ok = inside || call_memory_error(call, SEARCH_POINTS * SEARCH_POINTS * SEARCH_POINTS, error);
        fits = ok && fit_box(&s, inside);
    }
    lam_implicit surface = {.value = value_at,
                            .gradient = gradient_at,
                            .user = &s,
                            .minimum = v3(s.from[0], s.from[1], s.from[2]),
                            .maximum = v3(s.to[0], s.to[1], s.to[2]),
                            .cells = cells ? cells : CELLS};
    ok = ok && (!fits || tessellate_implicit(&surface, arena, call, mesh, error));
    if (s.ended)
        ok = fail_ended(&s, error);
    else if (ok && !mesh->triangle_count)
        ok = fail_empty(&s, error);
    if (ok && formula->flip)
        formula_flip(mesh);
    arena_free(&scratch);
    return ok;
}
