// glsl_evaluate.c: evaluates the tree of a shader.
#include "glsl.h"

#include <stdio.h>
#include <string.h>

#include "elementary.h"
#include "linear.h"

enum { MAX_ARGUMENTS = 4 };
static double *address(struct glsl_program *p, int node, bool *swizzled);

// --- built-in functions

// The functions of each component, with their values for the arguments x, y and z.
// clang-format off
#define COMPONENTS(X) \
    X(radians, math_radians(x)) X(degrees, math_degrees(x)) X(sin, math_sin(x)) X(cos, math_cos(x)) \
    X(tan, math_tan(x)) X(asin, math_asin(x)) X(acos, math_acos(x)) X(atan, math_atan(x)) X(exp, math_exp(x)) \
    X(pow, x > 0 ? math_pow(x, y) : x == 0 && y > 0 ? 0 : (x - x) / (x - x)) \
    X(log, math_log(x)) X(exp2, math_pow(2, x)) X(log2, math_log(x) / math_log(2)) X(sqrt, math_sqrt(x)) \
    X(inversesqrt, 1 / math_sqrt(x)) X(abs, x < 0 ? -x : x) X(sign, (x > 0) - (x < 0)) X(floor, floor_of(x)) \
    X(ceil, -floor_of(-x)) X(round, floor_of(x + 0.5)) X(trunc, x < 0 ? -floor_of(-x) : floor_of(x)) \
    X(fract, x - floor_of(x)) X(mod, x - y * floor_of(x / y)) X(min, y < x ? y : x) X(max, x < y ? y : x) \
    X(clamp, x < y ? y : x > z ? z : x) X(mix, x + (y - x) * z) X(step, y < x ? 0 : 1) \
    X(smoothstep, smooth(x, y, z)) X(not, x == 0) X(lessThan, x < y) X(lessThanEqual, x <= y) \
    X(greaterThan, x > y) X(greaterThanEqual, x >= y) X(equal, x == y) X(notEqual, x != y) X(isnan, x != x) \
    X(isinf, x == x && x - x != 0)
#define OTHERS(X) \
    X(any, 0) X(all, 0) X(length, 0) X(distance, 0) X(dot, 0) X(cross, 0) X(normalize, 0) X(faceforward, 0) \
    X(reflect, 0) X(refract, 0) X(transpose, 0) X(inverse, 0) X(determinant, 0) X(matrixCompMult, 0) X(texture, 0) \
    X(texture2D, 0) X(textureLod, 0) X(texture2DLod, 0)
#define BUILTINS(X) COMPONENTS(X) OTHERS(X)
// clang-format on
enum builtin {
#define BUILTIN(name, value) F_##name,
    BUILTINS(BUILTIN)
#undef BUILTIN
        F_COUNT
};
static const char *const builtins[] = {
#define BUILTIN(name, value) #name,
    BUILTINS(BUILTIN)
#undef BUILTIN
};

int glsl_builtin(const char *name)
{
    for (int i = 0; i < F_COUNT; i++)
        if (strcmp(builtins[i], name) == 0)
            return i;
    return -1;
}

const char *glsl_builtin_name(int function) { return builtins[function]; }

bool glsl_is_dot(const struct glsl_program *p, int node)
{
    return p->nodes[node].kind == GLSL_BUILTIN && p->nodes[node].number == F_dot;
}

struct glsl_type glsl_builtin_type(int f, const struct glsl_type *a, int count)
{
    struct glsl_type t = count ? a[0] : (struct glsl_type){GLSL_FLOAT, 1, 4, 0, 0};
    for (int i = 1; i < count && f != F_refract && f <= F_isinf; i++)
        t = glsl_width(a[i]) > glsl_width(t) ? a[i] : t;
    if (f >= F_texture && f <= F_texture2DLod)
        t = (struct glsl_type){GLSL_FLOAT, 1, 4, 0, 0};
    else if (f == F_any || f == F_all)
        t = (struct glsl_type){GLSL_BOOL, 1, 1, 0, 0};
    else if (f >= F_not && f <= F_isinf)
        t.base = GLSL_BOOL;
    else if (f == F_length || f == F_distance || f == F_dot || f == F_determinant)
        t = (struct glsl_type){GLSL_FLOAT, 1, 1, 0, 0};
    else if (f == F_transpose)
        t = (struct glsl_type){GLSL_FLOAT, a[0].rows, a[0].columns, 0, 0};
    for (int i = 0; i < count && t.base == GLSL_INT; i++)
        t.base = a[i].base == GLSL_FLOAT ? GLSL_FLOAT : t.base;
    if (t.base == GLSL_INT && f < F_abs)
        t.base = GLSL_FLOAT;
    return t;
}

static double floor_of(double x) { return x - x == 0 && x < 1e15 && x > -1e15 ? math_floor(x) : x; }

static double smooth(double x, double y, double z)
{
    const double t = (z - x) / (y - x), u = t < 0 ? 0 : t > 1 ? 1 : t;
    return u * u * (3 - 2 * u);
}

static double component(enum builtin f, double x, double y, double z)
{
    switch (f) {
#define COMPONENT(name, value)                                                                                         \
    case F_##name:                                                                                                     \
        return value;
        COMPONENTS(COMPONENT)
#undef COMPONENT
    default:
        return 0;
    }
}

static double dot(const double *a, const double *b, int n)
{
    double sum = 0;
    for (int i = 0; i < n; i++)
        sum += a[i] * b[i];
    return sum;
}

// Computes the inverse (n by n, column-major) and returns the determinant: Gauss–Jordan elimination with pivots.
static double invert(const double *m, int n, double *out)
{
    double a[4][8] = {{0}}, determinant = 1;
    for (int c = 0; c < n; c++)
        for (int r = 0; r < n; r++) {
            a[r][c] = m[c * n + r];
            a[r][n + c] = r == c;
        }
    for (int k = 0; k < n; k++) {
        int pivot = k;
        for (int r = k + 1; r < n; r++)
            pivot = a[r][k] * a[r][k] > a[pivot][k] * a[pivot][k] ? r : pivot;
        double row[8], by = a[pivot][k];
        memcpy(row, a[pivot], sizeof row);
        memcpy(a[pivot], a[k], sizeof row);
        determinant *= pivot == k ? by : -by;
        for (int c = 0; c < 2 * n; c++)
            a[k][c] = row[c] / by;
        for (int r = 0; r < n; r++) {
            double times = r == k ? 0 : a[r][k];
            for (int c = 0; c < 2 * n && times != 0; c++)
                a[r][c] -= times * a[k][c];
        }
    }
    for (int c = 0; c < n; c++)
        for (int r = 0; r < n; r++)
            out[c * n + r] = a[r][n + c];
    return determinant;
}

static void vector_function(enum builtin f, const struct glsl_type *t, double *const *a, int n, double *out)
{
    double k;
    switch (f) {
    case F_normalize:
        k = 1 / math_sqrt(dot(a[0], a[0], n));
        for (int i = 0; i < n; i++)
            out[i] = a[0][i] * k;
        break;
    case F_faceforward:
        k = dot(a[2], a[1], n) < 0 ? 1 : -1;
        for (int i = 0; i < n; i++)
            out[i] = a[0][i] * k;
        break;
    case F_reflect:
        k = 2 * dot(a[1], a[0], n);
        for (int i = 0; i < n; i++)
            out[i] = a[0][i] - k * a[1][i];
        break;
    case F_refract: {
        double d = dot(a[1], a[0], n), eta = a[2][0];
        k = 1 - eta * eta * (1 - d * d);
        for (int i = 0; i < n; i++)
            out[i] = k < 0 ? 0 : eta * a[0][i] - (eta * d + math_sqrt(k)) * a[1][i];
        break;
    }
    case F_cross:
        for (int i = 0; i < 3; i++)
            out[i] = a[0][(i + 1) % 3] * a[1][(i + 2) % 3] - a[0][(i + 2) % 3] * a[1][(i + 1) % 3];
        break;
    case F_transpose:
        for (int c = 0; c < t[0].columns; c++)
            for (int r = 0; r < t[0].rows; r++)
                out[r * t[0].columns + c] = a[0][c * t[0].rows + r];
        break;
    case F_inverse:
        invert(a[0], t[0].rows, out);
        break;
    default: // matrixCompMult
        for (int i = 0; i < n; i++)
            out[i] = a[0][i] * a[1][i];
    }
}

static void call_builtin(struct glsl_program *p, const struct glsl_node *node, double *out)
{
    enum builtin f = (enum builtin)node->number;
    double *a[MAX_ARGUMENTS] = {0};
    struct glsl_type t[MAX_ARGUMENTS] = {{0}};
    int count = 0;
    for (int child = node->first; child >= 0 && count < MAX_ARGUMENTS; child = p->nodes[child].next) {
        t[count] = p->nodes[child].type;
        a[count++] = glsl_value(p, child);
    }
    const int n = count ? glsl_width(t[0]) : 0;
    double scratch[16], sum = 0;
    if (f <= F_isinf)
        for (int i = 0; i < glsl_width(node->type); i++) {
            double x[3] = {0};
            for (int k = 0; k < count && k < 3; k++)
                x[k] = a[k][glsl_width(t[k]) > 1 ? i : 0];
            const bool color = n > 2; // the picture cuts off colours at 1 in any case
            x[1] = color && f == F_min && x[1] == 1 ? x[0] : x[1];
            x[2] = color && f == F_clamp && x[2] == 1 && x[0] > 1 ? x[0] : x[2];
            out[i] =
                f == F_atan ? (count > 1 ? math_atan2(x[0], x[1]) : math_atan(x[0])) : component(f, x[0], x[1], x[2]);
        }
    else if (f == F_any || f == F_all) {
        for (int i = 0; i < n; i++)
            sum += a[0][i] != 0;
        out[0] = f == F_any ? sum > 0 : sum == n;
    } else if (f == F_distance) {
        for (int i = 0; i < n; i++)
            sum += (a[0][i] - a[1][i]) * (a[0][i] - a[1][i]);
        out[0] = math_sqrt(sum);
    } else if (f == F_length)
        out[0] = math_sqrt(dot(a[0], a[0], n));
    else if (f == F_dot)
        out[0] = dot(a[0], a[1], n);
    else if (f == F_determinant)
        out[0] = invert(a[0], t[0].rows, scratch);
    else if (f >= F_texture && f <= F_texture2DLod)
        memcpy(out, a[0], 4 * sizeof *out); // a sampler's value is the colour of its single texel
    else
        vector_function(f, t, a, n, out);
}

// --- operators

static bool compare(int op, double x, double y)
{
    return op == '<'                ? x < y
           : op == '>'              ? x > y
           : op == OP_LESS_EQUAL    ? x <= y
           : op == OP_GREATER_EQUAL ? x >= y
           : op == OP_AND           ? x != 0 && y != 0
           : op == OP_OR            ? x != 0 || y != 0
                                    : (x != 0) != (y != 0);
}

static double arithmetic(int op, double x, double y, bool whole)
{
    const bool exact = whole && x < 1e15 && x > -1e15 && y < 1e15 && y > -1e15; // not a number is not exact
    const int64_t i = exact ? (int64_t)x : 0, k = exact ? (int64_t)y : 0;
    // clang-format off
    switch (op) {
    case '+': return x + y;
    case '-': return x - y;
    case '*': return x * y;
    case '/': return !whole ? x / y : k ? (double)(i / k) : 0;
    case '%': return k ? (double)(i % k) : 0;
    case '&': return (double)(i & k);
    case '|': return (double)(i | k);
    case '^': return (double)(i ^ k);
    case OP_LEFT: return (double)((uint64_t)i << (k & 31));
    case OP_RIGHT: return (double)(i >> (k & 31));
    default: return compare(op, x, y);
    }
    // clang-format on
}

static bool is_matrix(struct glsl_type t) { return t.columns > 1; }

static void binary(const struct glsl_program *p, int op, struct glsl_type ta, const double *a, struct glsl_type tb,
                   const double *b, struct glsl_type t, double *out)
{
    double result[16] = {0};
    if (op == OP_EQUAL || op == OP_NOT_EQUAL) {
        bool same = true;
        for (int i = 0; i < glsl_size(p, ta); i++)
            same = same && a[i] == b[i];
        out[0] = same == (op == OP_EQUAL);
        return;
    }
    if (op == '*' && (is_matrix(ta) || is_matrix(tb)) && glsl_width(ta) > 1 && glsl_width(tb) > 1) {
        // A vector on the left is a row, on the right a column.
        bool row = !is_matrix(ta);
        int columns = is_matrix(tb) ? tb.columns : 1, rows = row ? 1 : ta.rows, inner = row ? ta.rows : ta.columns;
        for (int c = 0; c < columns; c++)
            for (int r = 0; r < rows; r++)
                for (int k = 0; k < inner; k++)
                    result[c * rows + r] += a[row ? k : k * ta.rows + r] * b[c * tb.rows + k];
    } else {
        bool whole = ta.base != GLSL_FLOAT && tb.base != GLSL_FLOAT;
        for (int i = 0; i < glsl_width(t); i++)
            result[i] = arithmetic(op, a[glsl_width(ta) > 1 ? i : 0], b[glsl_width(tb) > 1 ? i : 0], whole);
    }
    memcpy(out, result, (size_t)glsl_width(t) * sizeof *out);
}

// Stores a value in a variable or in some of its components.
static void store(struct glsl_program *p, int node, const double *from)
{
    bool swizzled = false;
    double *to = address(p, node, &swizzled);
    if (!swizzled) {
        memmove(to, from, (size_t)glsl_size(p, p->nodes[node].type) * sizeof *to);
        return;
    }
    double copy[4];
    memcpy(copy, from, (size_t)p->nodes[node].type.rows * sizeof *copy);
    for (int i = 0; i < p->nodes[node].type.rows; i++)
        to[p->nodes[node].number >> (2 * i) & 3] = copy[i];
}

static void construct(struct glsl_program *p, const struct glsl_node *node, double *out)
{
    const struct glsl_type t = node->type;
    const int size = glsl_size(p, t);
    const struct glsl_node *first = &p->nodes[node->first];
    if (first->next < 0 && is_matrix(t) && !t.count && (glsl_width(first->type) == 1 || is_matrix(first->type))) {
        const double *a = glsl_value(p, node->first);
        double result[16];
        for (int c = 0; c < t.columns; c++)
            for (int r = 0; r < t.rows; r++)
                result[c * t.rows + r] = !is_matrix(first->type)                           ? (r == c ? a[0] : 0)
                                         : c < first->type.columns && r < first->type.rows ? a[c * first->type.rows + r]
                                                                                           : r == c;
        memcpy(out, result, (size_t)size * sizeof *out);
        return;
    }
    int at = 0;
    for (int child = node->first; child >= 0; child = p->nodes[child].next) {
        const double *a = glsl_value(p, child);
        int n = glsl_size(p, p->nodes[child].type);
        bool fills = n == 1 && p->nodes[child].next < 0 && at == 0 && !t.count && t.base != GLSL_STRUCT;
        for (int i = 0; i < (fills ? size : n) && at < size; i++)
            p->memory[node->at + at++] = a[fills ? 0 : i];
    }
    for (int i = 0; i < size && t.base != GLSL_STRUCT; i++)
        out[i] = t.base == GLSL_INT ? component(F_trunc, out[i], 0, 0) : t.base == GLSL_BOOL ? out[i] != 0 : out[i];
}

// --- statements

enum jump { JUMP_NONE, JUMP_BREAK, JUMP_CONTINUE, JUMP_RETURN };
static enum jump run(struct glsl_program *p, int node, const struct glsl_function *f);

static void call(struct glsl_program *p, const struct glsl_node *node, double *out)
{
    const struct glsl_function *f = &p->functions[node->number];
    double *values[GLSL_PARAMETERS];
    int i = 0;
    for (int child = node->first; child >= 0; child = p->nodes[child].next)
        values[i++] = glsl_value(p, child);
    for (int k = 0; k < i; k++)
        if (f->out[k] & 1)
            memmove(p->memory + f->places[k], values[k], (size_t)glsl_size(p, f->types[k]) * sizeof *out);
    if (f->body >= 0)
        run(p, f->body, f);
    memmove(out, p->memory + f->result, (size_t)glsl_size(p, f->type) * sizeof *out);
    i = 0;
    for (int child = node->first; child >= 0; child = p->nodes[child].next, i++)
        if (f->out[i] & 2)
            store(p, child, p->memory + f->places[i]);
}

// Returns the address of an expression that can be assigned. With `swizzled`, the node selects the components.
static double *address(struct glsl_program *p, int node, bool *swizzled)
{
    const struct glsl_node *n = &p->nodes[node];
    if (n->kind == GLSL_SWIZZLE && swizzled) {
        *swizzled = true;
        return address(p, n->first, NULL);
    }
    if (n->kind == GLSL_MEMBER)
        return glsl_value(p, n->first) + n->number;
    if (n->kind != GLSL_INDEX)
        return glsl_value(p, node);
    const struct glsl_type t = p->nodes[n->first].type;
    const int step = glsl_size(p, n->type), count = t.count ? t.count : t.columns > 1 ? t.columns : t.rows;
    double *base = glsl_value(p, n->first), index = *glsl_value(p, p->nodes[n->first].next);
    return base + step * (index >= 0 && index < count ? (int)index : 0);
}

static void change(struct glsl_program *p, const struct glsl_node *n, double *out)
{
    const struct glsl_node *target = &p->nodes[n->first];
    const struct glsl_type one = {target->type.base, 1, 1, 0, 0};
    const int value = target->next;
    const double unit = 1;
    double old[16], result[16];
    if (n->kind == GLSL_ASSIGN && n->op == '=') {
        const double *from = glsl_value(p, value);
        store(p, n->first, from);
        memmove(out, from, (size_t)glsl_size(p, n->type) * sizeof *out);
        return;
    }
    memcpy(old, glsl_value(p, n->first), (size_t)glsl_width(target->type) * sizeof *old);
    if (n->kind == GLSL_ASSIGN)
        binary(p, n->op, target->type, old, p->nodes[value].type, glsl_value(p, value), target->type, result);
    else
        binary(p, n->op, target->type, old, one, &unit, target->type, result);
    store(p, n->first, result);
    memcpy(out, n->kind == GLSL_INCREMENT && n->number ? old : result, (size_t)glsl_width(target->type) * sizeof *out);
}

double *glsl_value(struct glsl_program *p, int node)
{
    const struct glsl_node *n = &p->nodes[node];
    double *out = p->memory + n->at;
    const double *a;
    p->steps--;
    if (p->steps < 0 || p->unsupported[0])
        return out;
    switch (n->kind) {
    case GLSL_MEMBER:
    case GLSL_INDEX:
        a = address(p, node, NULL);
        memmove(out, a, (size_t)glsl_size(p, n->type) * sizeof *out); // the value of this part, for the readings
        return (double *)a;
    case GLSL_SWIZZLE:
        a = glsl_value(p, n->first);
        for (int i = 0; i < n->type.rows; i++)
            out[i] = a[n->number >> (2 * i) & 3];
        break;
    case GLSL_UNARY:
        a = glsl_value(p, n->first);
        for (int i = 0; i < glsl_width(n->type); i++)
            out[i] = n->op == '-' ? -a[i] : n->op == '!' ? a[i] == 0 : a[i];
        break;
    case GLSL_BINARY: {
        const int right = p->nodes[n->first].next;
        a = glsl_value(p, n->first);
        if ((n->op == OP_AND && a[0] == 0) || (n->op == OP_OR && a[0] != 0)) {
            out[0] = n->op == OP_OR;
            break;
        }
        const double *b = glsl_value(p, right);
        binary(p, n->op, p->nodes[n->first].type, a, p->nodes[right].type, b, n->type, out);
        break;
    }
    case GLSL_ASSIGN:
    case GLSL_INCREMENT:
        change(p, n, out);
        break;
    case GLSL_CHOICE: {
        const int yes = p->nodes[n->first].next;
        a = glsl_value(p, *glsl_value(p, n->first) != 0 ? yes : p->nodes[yes].next);
        memmove(out, a, (size_t)glsl_size(p, n->type) * sizeof *out);
        break;
    }
    case GLSL_CONSTRUCT:
        construct(p, n, out);
        break;
    case GLSL_BUILTIN:
        call_builtin(p, n, out);
        break;
    case GLSL_CALL:
        call(p, n, out);
        break;
    case GLSL_GIVEN:
        memcpy(out, n->given, (size_t)glsl_width(n->type) * sizeof *out);
        break;
    default:
        break;
    }
    return out;
}

static enum jump loop(struct glsl_program *p, const struct glsl_node *n, const struct glsl_function *f)
{
    const int condition = p->nodes[n->first].next, step = p->nodes[condition].next, body = p->nodes[step].next;
    run(p, n->first, f);
    for (bool once = n->op == 'd'; p->steps > 0; once = false) {
        if (!once && p->nodes[condition].kind != GLSL_EMPTY && *glsl_value(p, condition) == 0)
            break;
        enum jump jump = run(p, body, f);
        if (jump == JUMP_RETURN)
            return jump;
        if (jump == JUMP_BREAK)
            break;
        run(p, step, f);
    }
    return JUMP_NONE;
}

static enum jump run(struct glsl_program *p, int node, const struct glsl_function *f)
{
    const struct glsl_node *n = &p->nodes[node];
    enum jump jump = JUMP_NONE;
    if (p->steps-- < 0)
        return JUMP_RETURN;
    switch (n->kind) {
    case GLSL_BLOCK:
        for (int child = n->first; child >= 0 && !jump; child = p->nodes[child].next)
            jump = run(p, child, f);
        return jump;
    case GLSL_IF: {
        const int yes = p->nodes[n->first].next, no = p->nodes[yes].next;
        if (*glsl_value(p, n->first) != 0)
            return run(p, yes, f);
        return no >= 0 ? run(p, no, f) : JUMP_NONE;
    }
    case GLSL_LOOP:
        return loop(p, n, f);
    case GLSL_RETURN:
        if (n->first >= 0 && f)
            memmove(p->memory + f->result, glsl_value(p, n->first), (size_t)glsl_size(p, f->type) * sizeof(double));
        return JUMP_RETURN;
    case GLSL_BREAK:
        return JUMP_BREAK;
    case GLSL_CONTINUE:
        return JUMP_CONTINUE;
    case GLSL_DISCARD:
        p->discarded = true;
        return JUMP_RETURN;
    case GLSL_EMPTY:
        return JUMP_NONE;
    default:
        glsl_value(p, node);
        return JUMP_NONE;
    }
}

bool glsl_run(struct glsl_program *p)
{
    p->discarded = false;
    for (int i = 0; i < p->initializer_count; i++)
        glsl_value(p, p->initializers[i]);
    run(p, p->main_body, NULL);
    return p->steps > 0 && !p->unsupported[0];
}
