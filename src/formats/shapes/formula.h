// formula.h: surfaces that a text defines, and their derivatives. The text is "x=…; y=…; z=…" over u and v, or an
// expression of x, y and z that is zero on the surface. docs/shapes.md describes the language.
//
// The parser converts a text to a list of operations (formula_graph.c). Equal operations are shared, and constants are
// evaluated. The list also contains the partial derivatives of the results, which are derived symbolically. Evaluating
// the surface takes one pass over the list.
#ifndef FORMULA_H
#define FORMULA_H

#include "arena.h"

#include <lambent/mesh.h>

enum {
    FORMULA_BYTES_MAX = 4096,  // the maximum length of a text in bytes
    FORMULA_DEPTH_MAX = 64,    // the maximum nesting of parentheses, signs and powers
    FORMULA_NODES_MAX = 16384, // the maximum number of operations, including derivatives
};

// NUMBER and the parameters have no operand. LESS: 1 if a < b, ½ if they are equal, otherwise 0. CHAIN: a · b, but 0 if
// b is 0. Derivatives contain CHAIN because of the chain rule: a may be infinite if b is 0.
enum formula_op {
    OP_NUMBER,
    OP_PARAMETER_0, // u or x
    OP_PARAMETER_1, // v or y
    OP_PARAMETER_2, // z of an implicit surface
    OP_ADD,
    OP_SUB,
    OP_MUL,
    OP_DIV,
    OP_POW,
    OP_CHAIN,
    OP_LESS,
    OP_ATAN2,
    OP_MIN,
    OP_MAX,
    OP_MOD,
    OP_HYPOT,
    OP_FIRST_UNARY,
    OP_NEG = OP_FIRST_UNARY,
    OP_SIN,
    OP_COS,
    OP_TAN,
    OP_ASIN,
    OP_ACOS,
    OP_ATAN,
    OP_SINH,
    OP_COSH,
    OP_TANH,
    OP_EXP,
    OP_LOG,
    OP_SQRT,
    OP_CBRT,
    OP_ABS,
    OP_SIGN,
    OP_FLOOR,
};

struct formula_node {
    enum formula_op op;
    int a, b;     // operands: earlier nodes
    double value; // the value of a NUMBER; evaluation also stores the value of each other node here
};

struct formula_graph {
    struct formula_node *nodes; // FORMULA_NODES_MAX
    int *slots;                 // hash table of nodes
    int count;
    bool full; // there are too many nodes, so results are meaningless
};

bool formula_graph_start(struct formula_graph *graph, struct arena *arena);

// Return the node of an operation, which may be an existing node or the node of a simpler operation.
int formula_number(struct formula_graph *graph, double value);
int formula_unary(struct formula_graph *graph, enum formula_op op, int a);
int formula_binary(struct formula_graph *graph, enum formula_op op, int a, int b);

// Appends the derivatives of the first `count` nodes with respect to `parameter` (OP_PARAMETER_0 or a later one);
// derivatives[i] belongs to node i.
void formula_differentiate(struct formula_graph *graph, int count, enum formula_op parameter, int *derivatives);

// A surface. Only one thread at a time may use a surface, because its nodes store the values.
struct formula {
    struct formula_node *nodes;
    int count;
    bool implicit;  // the parameters are x, y and z instead of u and v
    int outputs[9]; // x, y, z and their derivatives ∂/∂u and ∂/∂v; implicit: f and its gradient
    int name_count; // the definitions
    struct formula_name {
        const char *text; // position in the formula's text
        size_t length;
        int node;
    } *names;
    struct formula_graph graph;
};

// Parses a text, which must outlive the formula. Errors: LAM_BAD_ARGUMENT with the column, LAM_LIMIT.
bool formula_parse(const char *text, bool implicit, struct arena *arena, struct formula *formula, lam_error *error);

// Parses a range, "0..2pi", whose ends may use the constants that the formula defines. Error messages use `name`.
bool formula_range(struct formula *formula, const char *name, const char *text, double range[2], lam_error *error);

// Makes the list of operations for evaluation; formula_range must not be called afterwards.
bool formula_finish(struct formula *formula, struct arena *arena, lam_error *error);

// Evaluates a point of a parametric surface.
void formula_evaluate(const struct formula *formula, double u, double v, lam_surface_point *out);

// Return f and ∇f of an implicit surface; `formula` is a struct formula.
double formula_value(void *formula, lam_vec3 p);
lam_vec3 formula_gradient(void *formula, lam_vec3 p);

// Tessellates a parametric formula.
struct call_control;
bool tessellate_formula(const lam_formula *formula, struct arena *arena, struct call_control *call, lam_mesh *mesh,
                        lam_error *error);
// Tessellates an implicit formula.
bool tessellate_implicit_formula(const lam_formula *formula, struct arena *arena, struct call_control *call,
                                 lam_mesh *mesh, lam_error *error);

// Exchanges the front and the back of a mesh that the caller made.
void formula_flip(lam_mesh *mesh);

#endif
