// formula_graph.c: the operations of a formula: sharing, simplification, differentiation and evaluation.
#include "formula.h"

#include "elementary.h"
#include "linear.h"

#include <string.h>

enum { SLOTS = 2 * FORMULA_NODES_MAX };

bool formula_graph_start(struct formula_graph *graph, struct arena *arena)
{
    *graph = (struct formula_graph){.nodes = arena_array(arena, FORMULA_NODES_MAX, sizeof *graph->nodes),
                                    .slots = arena_array(arena, SLOTS, sizeof *graph->slots)};
    if (!graph->nodes || !graph->slots)
        return false;
    memset(graph->slots, 0xff, SLOTS * sizeof *graph->slots);
    return true;
}

// Rounding can move an argument of √x or an arc function just outside the domain. Such an argument is replaced by the
// boundary of the domain.
#define ROUNDING 1e-12

static double square_root(double x) { return x >= 0 ? math_sqrt(x) : x > -ROUNDING ? 0 : __builtin_nan(""); }

static double in_unit(double x) { return x > 1 && x < 1 + ROUNDING ? 1 : x < -1 && x > -1 - ROUNDING ? -1 : x; }

// Sine and cosine have no useful result beyond 1e9 (linear.h).
static bool has_angle(double x) { return x > -1e9 && x < 1e9; }

static double sign_of(double x) { return x > 0 ? 1 : x < 0 ? -1 : x; }

static double result_of(enum formula_op op, double a, double b)
{
    switch (op) {
    case OP_ADD:
        return a + b;
    case OP_SUB:
        return a - b;
    case OP_MUL:
        return a * b;
    case OP_DIV:
        return a / b;
    case OP_POW:
        return math_pow(a, b);
    case OP_CHAIN:
        return b == 0 ? 0 : a * b;
    case OP_LESS:
        return a < b ? 1 : a == b ? 0.5 : 0;
    case OP_ATAN2:
        return math_finite(a) && math_finite(b) ? math_atan2(a, b) : __builtin_nan("");
    case OP_MIN:
        return a != a || b != b ? __builtin_nan("") : a < b ? a : b;
    case OP_MAX:
        return a != a || b != b ? __builtin_nan("") : a > b ? a : b;
    case OP_MOD:
        return a - b * math_floor(a / b);
    case OP_HYPOT:
        return a != a || b != b ? __builtin_nan("") : v3_length(v3(a, b, 0));
    case OP_NEG:
        return -a;
    case OP_SIN:
        return has_angle(a) ? math_sin(a) : __builtin_nan("");
    case OP_COS:
        return has_angle(a) ? math_cos(a) : __builtin_nan("");
    case OP_TAN:
        return has_angle(a) ? math_tan(a) : __builtin_nan("");
    case OP_ASIN:
        return math_asin(in_unit(a));
    case OP_ACOS:
        a = in_unit(a);
        return a >= -1 && a <= 1 ? math_acos(a) : __builtin_nan("");
    case OP_ATAN:
        return math_atan(a);
    case OP_SINH:
        return math_sinh(a);
    case OP_COSH:
        return math_cosh(a);
    case OP_TANH:
        return math_tanh(a);
    case OP_EXP:
        return math_exp(a);
    case OP_LOG:
        return math_log(a);
    case OP_SQRT:
        return square_root(a);
    case OP_CBRT:
        return a < 0 ? -math_pow(-a, 1.0 / 3) : math_pow(a, 1.0 / 3);
    case OP_ABS:
        return a < 0 ? -a : a;
    case OP_SIGN:
        return sign_of(a);
    case OP_FLOOR:
        return math_floor(a);
    default:
        return 0;
    }
}

static int node_of(struct formula_graph *graph, enum formula_op op, int a, int b, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    uint64_t hash = bits ^ ((uint64_t)op << 56) ^ ((uint64_t)(uint32_t)a << 28) ^ (uint64_t)(uint32_t)b;
    hash = (hash ^ (hash >> 31)) * UINT64_C(0x9e3779b97f4a7c15);
    uint32_t slot = (uint32_t)(hash >> 40) % SLOTS;
    for (; graph->slots[slot] >= 0; slot = (slot + 1) % SLOTS) {
        const struct formula_node *n = &graph->nodes[graph->slots[slot]];
        if (n->op == op && n->a == a && n->b == b && memcmp(&n->value, &value, sizeof value) == 0)
            return graph->slots[slot];
    }
    if (graph->count == FORMULA_NODES_MAX) {
        graph->full = true;
        return 0;
    }
    graph->nodes[graph->count] = (struct formula_node){op, a, b, value};
    graph->slots[slot] = graph->count;
    return graph->count++;
}

int formula_number(struct formula_graph *graph, double value) { return node_of(graph, OP_NUMBER, 0, 0, value + 0.0); }

static bool is_number(const struct formula_graph *graph, int node) { return graph->nodes[node].op == OP_NUMBER; }

static bool is_value(const struct formula_graph *graph, int node, double value)
{
    return is_number(graph, node) && graph->nodes[node].value == value;
}

int formula_unary(struct formula_graph *graph, enum formula_op op, int a)
{
    if (op < OP_ADD)
        return node_of(graph, op, 0, 0, 0);
    if (is_number(graph, a))
        return formula_number(graph, result_of(op, graph->nodes[a].value, 0));
    if (op == OP_NEG && graph->nodes[a].op == OP_NEG)
        return graph->nodes[a].a;
    return node_of(graph, op, a, 0, 0);
}

int formula_binary(struct formula_graph *graph, enum formula_op op, int a, int b)
{
    if (is_number(graph, a) && is_number(graph, b))
        return formula_number(graph, result_of(op, graph->nodes[a].value, graph->nodes[b].value));
    if ((op == OP_ADD && is_value(graph, a, 0)) || ((op == OP_MUL || op == OP_CHAIN) && is_value(graph, a, 1)))
        return b;
    if (((op == OP_ADD || op == OP_SUB) && is_value(graph, b, 0)) ||
        ((op == OP_MUL || op == OP_DIV || op == OP_POW || op == OP_CHAIN) && is_value(graph, b, 1)))
        return a;
    if (op == OP_SUB && is_value(graph, a, 0))
        return formula_unary(graph, OP_NEG, b);
    if ((op == OP_CHAIN || op == OP_MUL) && (is_value(graph, a, 0) || is_value(graph, b, 0)))
        return formula_number(graph, 0);
    if (op == OP_DIV && is_value(graph, a, 0))
        return a;
    if (op == OP_POW && is_value(graph, b, 0))
        return formula_number(graph, 1);
    if (op == OP_POW && is_value(graph, b, 2))
        return node_of(graph, OP_MUL, a, a, 0);
    if (op == OP_POW && is_value(graph, b, 3))
        return node_of(graph, OP_MUL, node_of(graph, OP_MUL, a, a, 0), a, 0);
    return node_of(graph, op, a, b, 0);
}

// Differentiates the node f by the rule for its operation, from its operands a and b and their derivatives da and db.
static int rule(struct formula_graph *g, int f, int da, int db)
{
    const struct formula_node n = g->nodes[f];
    int a = n.a, b = n.b;
#define NUMBER(x)    formula_number(g, x)
#define ADD(x, y)    formula_binary(g, OP_ADD, x, y)
#define SUB(x, y)    formula_binary(g, OP_SUB, x, y)
#define MUL(x, y)    formula_binary(g, OP_MUL, x, y)
#define DIV(x, y)    formula_binary(g, OP_DIV, x, y)
#define CHAIN(x, y)  formula_binary(g, OP_CHAIN, x, y)
#define UNARY(op, x) formula_unary(g, op, x)
    switch (n.op) {
    case OP_ADD:
        return ADD(da, db);
    case OP_SUB:
        return SUB(da, db);
    case OP_MUL:
        return ADD(CHAIN(a, db), CHAIN(b, da));
    case OP_DIV:
        return SUB(CHAIN(DIV(NUMBER(1), b), da), CHAIN(DIV(f, b), db));
    case OP_POW:
        da = CHAIN(MUL(b, formula_binary(g, OP_POW, a, SUB(b, NUMBER(1)))), da);
        return is_value(g, db, 0) ? da : ADD(da, CHAIN(MUL(f, UNARY(OP_LOG, a)), db));
    case OP_CHAIN:
        return ADD(CHAIN(a, db), CHAIN(b, da));
    case OP_ATAN2: {
        int square = ADD(MUL(a, a), MUL(b, b));
        return SUB(CHAIN(DIV(b, square), da), CHAIN(DIV(a, square), db));
    }
    case OP_MIN:
        return ADD(CHAIN(da, formula_binary(g, OP_LESS, a, b)), CHAIN(db, formula_binary(g, OP_LESS, b, a)));
    case OP_MAX:
        return ADD(CHAIN(da, formula_binary(g, OP_LESS, b, a)), CHAIN(db, formula_binary(g, OP_LESS, a, b)));
    case OP_MOD:
        return SUB(da, CHAIN(UNARY(OP_FLOOR, DIV(a, b)), db));
    case OP_HYPOT:
        return ADD(CHAIN(DIV(a, f), da), CHAIN(DIV(b, f), db));
    case OP_NEG:
        return UNARY(OP_NEG, da);
    case OP_SIN:
        return CHAIN(UNARY(OP_COS, a), da);
    case OP_COS:
        return CHAIN(UNARY(OP_NEG, UNARY(OP_SIN, a)), da);
    case OP_TAN:
        return CHAIN(ADD(NUMBER(1), MUL(f, f)), da);
    case OP_ASIN:
        return CHAIN(DIV(NUMBER(1), UNARY(OP_SQRT, SUB(NUMBER(1), MUL(a, a)))), da);
    case OP_ACOS:
        return CHAIN(DIV(NUMBER(-1), UNARY(OP_SQRT, SUB(NUMBER(1), MUL(a, a)))), da);
    case OP_ATAN:
        return CHAIN(DIV(NUMBER(1), ADD(NUMBER(1), MUL(a, a))), da);
    case OP_SINH:
        return CHAIN(UNARY(OP_COSH, a), da);
    case OP_COSH:
        return CHAIN(UNARY(OP_SINH, a), da);
    case OP_TANH:
        return CHAIN(SUB(NUMBER(1), MUL(f, f)), da);
    case OP_EXP:
        return CHAIN(f, da);
    case OP_LOG:
        return CHAIN(DIV(NUMBER(1), a), da);
    case OP_SQRT:
        return CHAIN(DIV(NUMBER(0.5), f), da);
    case OP_CBRT:
        return CHAIN(DIV(NUMBER(1.0 / 3), MUL(f, f)), da);
    case OP_ABS:
        return CHAIN(UNARY(OP_SIGN, a), da);
    default: // numbers, and SIGN, FLOOR and LESS: the derivative is 0 except at steps
        return NUMBER(0);
    }
}

void formula_differentiate(struct formula_graph *graph, int count, enum formula_op parameter, int *derivatives)
{
    for (int i = 0; i < count && !graph->full; i++) {
        const struct formula_node *n = &graph->nodes[i];
        bool binary = n->op >= OP_ADD && n->op < OP_FIRST_UNARY, leaf = n->op < OP_ADD;
        derivatives[i] = n->op == parameter
                             ? formula_number(graph, 1)
                             : rule(graph, i, leaf ? 0 : derivatives[n->a], binary ? derivatives[n->b] : 0);
    }
}

// Computes the values of the first `count` nodes.
static const struct formula_node *evaluate(const struct formula *formula, int count, const double parameters[3])
{
    struct formula_node *nodes = formula->nodes;
    for (int i = 0; i < count; i++) {
        struct formula_node *n = &nodes[i];
        if (n->op >= OP_ADD)
            n->value = result_of(n->op, nodes[n->a].value, nodes[n->b].value);
        else if (n->op != OP_NUMBER)
            n->value = parameters[n->op - OP_PARAMETER_0];
    }
    return nodes;
}

double formula_value(void *user, lam_vec3 p)
{
    const struct formula *formula = user;
    int f = formula->outputs[0]; // f does not depend on later nodes
    return evaluate(formula, f + 1, (double[]){p.x, p.y, p.z})[f].value;
}

lam_vec3 formula_gradient(void *user, lam_vec3 p)
{
    const struct formula *formula = user;
    const struct formula_node *nodes = evaluate(formula, formula->count, (double[]){p.x, p.y, p.z});
    const int *at = formula->outputs;
    return v3(nodes[at[1]].value, nodes[at[2]].value, nodes[at[3]].value);
}

void formula_evaluate(const struct formula *formula, double u, double v, lam_surface_point *out)
{
    const struct formula_node *nodes = evaluate(formula, formula->count, (double[]){u, v, 0});
    const int *at = formula->outputs;
    out->p = v3(nodes[at[0]].value, nodes[at[1]].value, nodes[at[2]].value);
    out->dp_du = v3(nodes[at[3]].value, nodes[at[4]].value, nodes[at[5]].value);
    out->dp_dv = v3(nodes[at[6]].value, nodes[at[7]].value, nodes[at[8]].value);
}
