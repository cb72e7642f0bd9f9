// repair.c: finds the mistake of a shader that no reading explains: changes one part of the source after the other until
// the shader is right.
//
// The part that must change, and its value, show the mistake. The line of the mistake and the advice therefore come from
// the shader's own text.
//
// The file is longer than 600 lines because it contains one function for each kind of change.
#include "reading.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "elementary.h"

enum change {
    CHANGE_UNIT,   // normalize(X)
    CHANGE_SIGN,   // -X
    CHANGE_CLAMP,  // max(X, 0)
    CHANGE_ABS,    // abs(X) becomes max(X, 0)
    CHANGE_PLUS,   // + becomes -
    CHANGE_LEFT,   // X * Y becomes X
    CHANGE_RIGHT,  // X * Y becomes Y
    CHANGE_NORMAL, // X becomes the right vector; the next changes likewise
    CHANGE_POINT,
    CHANGE_EYE,
    CHANGE_LIGHT,
    CHANGES
};
enum { MAX_BEAM = 4, MAX_EARLY = 3, SPACES = 3 };
enum { PARENT_NORMALIZE = 1, PARENT_MAX, PARENT_WRITES };
static const int64_t repair_steps = 60000000;

struct tried {
    int side, node, change, space, wrong;
    struct glsl_node before;
    double mean;
    const char *mistake;       // its name
    struct glsl_symbol *input; // that is normalized at all uses
};

// --- which parts depend on what

enum { ON_NORMAL = 1, ON_POINT = 2, ON_EYE = 4, ON_LIGHT = 8 };

// Finds what the values of the nodes depend on, by comparing the memory after evaluations.
static bool find_dependence(struct reading *r, uint8_t *out[2])
{
    struct reading_sample *base = &r->pair[0], changed;
    double *before[2];
    for (int side = 0; side < 2; side++) {
        before[side] = arena_array(r->arena, (size_t)r->sides[side].used, sizeof(double));
        out[side] = arena_alloc_zeroed(r->arena, (size_t)r->sides[side].node_count + 8);
        if (!before[side] || !out[side])
            return false;
    }
    for (int run = 0; run < 9; run++) { // several normals, because steps have the same value for many
        const int bit = run < 4 ? run : 0;
        const struct reading_sample *normal = bit ? base : run ? &r->samples[READ_TURNS + 7 * run] : &r->pair[1];
        reading_evaluate(r, base);
        for (int side = 0; side < 2; side++)
            memcpy(before[side], r->sides[side].memory, (size_t)r->sides[side].used * sizeof(double));
        changed = *base;
        for (int k = 0; k < 3; k++)
            for (int i = 0; i < 3; i++) {
                changed.normals[k][i] = normal->normals[k][i];
                changed.positions[k][i] += bit == 1 ? 0.1 * (i + 1) : 0;
            }
        for (int i = 0; i < 3 && bit == 2; i++) {
            changed.eye[i] = base->eye[i] + 0.3 * (i + 1);
            memcpy(changed.matrices, r->samples[READ_TURNS + 9].matrices, sizeof changed.matrices);
        }
        for (int i = 0; i < 3 * READ_LIGHTS && bit == 3; i++)
            changed.lights[i / 3][i % 3] += 0.2 * (i % 3 + 1);
        reading_evaluate(r, &changed);
        for (int side = 0; side < 2; side++)
            for (int i = 0; i < r->sides[side].node_count; i++) {
                const struct glsl_node *n = &r->sides[side].nodes[i];
                for (int c = 0; c < glsl_width(n->type) && n->kind <= GLSL_GIVEN; c++) {
                    double d = r->sides[side].memory[n->at + c] - before[side][n->at + c];
                    if (!(d < 1e-10 && d > -1e-10)) // more than a rounding error
                        out[side][i] |= (uint8_t)(1u << bit);
                }
            }
    }
    return true;
}

// --- changes

static bool is_call(const struct glsl_program *p, int node, const char *name)
{
    return p->nodes[node].kind == GLSL_BUILTIN && strcmp(glsl_builtin_name(p->nodes[node].number), name) == 0;
}

static int parent_of(const struct glsl_program *p, int node)
{
    for (int i = 0; i < p->node_count; i++)
        for (int c = p->nodes[i].first; c >= 0; c = p->nodes[c].next)
            if (c == node)
                return i;
    return -1;
}

// Returns whether a number is added to a constant, possibly after a multiplication: 0.5 * dot(n, l) + 0.5.
static bool is_shifted(const struct glsl_program *p, int node)
{
    for (int level = 0, at = node; level < 2; level++) {
        const int parent = parent_of(p, at);
        if (parent < 0 || p->nodes[parent].kind != GLSL_BINARY)
            return false;
        for (int c = p->nodes[parent].first; c >= 0; c = p->nodes[c].next)
            if (strchr("+-", p->nodes[parent].op) && p->nodes[c].kind == GLSL_CONSTANT)
                return true;
        at = parent;
    }
    return false;
}

static bool suits(const struct glsl_program *p, int node, int change, const uint8_t *all, unsigned parent)
{
    const unsigned depends = all[node];
    const struct glsl_node *n = &p->nodes[node];
    const bool vector = n->type.columns == 1 && n->type.rows >= 3 && n->type.base == GLSL_FLOAT && !n->type.count,
               number = glsl_width(n->type) == 1 && n->type.base == GLSL_FLOAT && !n->type.count;
    if (n->kind > GLSL_GIVEN || n->kind == GLSL_ASSIGN || n->kind == GLSL_CONSTANT || !depends ||
        parent == PARENT_WRITES)
        return false;
    const struct glsl_node *left = n->first >= 0 ? &p->nodes[n->first] : n;
    const int kept = change == CHANGE_LEFT ? n->first : n->first >= 0 ? left->next : -1;
    const bool place = depends & (ON_POINT | ON_LIGHT), seen = place || depends & ON_EYE;
    // clang-format off
    switch (change) {
    case CHANGE_UNIT: return vector && n->type.rows == 3 && !is_call(p, node, "normalize") && parent != PARENT_NORMALIZE;
    case CHANGE_SIGN: return vector && n->kind != GLSL_UNARY;
    case CHANGE_CLAMP: return number && depends & ON_NORMAL && !is_call(p, node, "max") && parent != PARENT_MAX && !is_shifted(p, node);
    case CHANGE_ABS: return is_call(p, node, "abs") && number;
    case CHANGE_PLUS: return n->kind == GLSL_BINARY && n->op == '+' && vector && depends & (ON_POINT | ON_NORMAL);
    case CHANGE_LEFT:
    case CHANGE_RIGHT: return n->kind == GLSL_BINARY && n->op == '*' && depends & ON_NORMAL && n->type.columns == 1 && kept >= 0 && glsl_width(p->nodes[kept].type) == glsl_width(n->type) && (all[kept] & (ON_NORMAL | ON_EYE)) > ON_EYE;
    case CHANGE_NORMAL: return vector && depends & ON_NORMAL;
    case CHANGE_POINT: return vector && depends & ON_POINT && !(depends & ON_NORMAL);
    case CHANGE_EYE: return vector && !p->vertex && seen && n->type.rows == 3;
    default: return vector && !p->vertex && place && n->type.rows == 3;
    }
    // clang-format on
}

// Puts a copy of the node below the node.
static int lower(struct reading *r, int side, int node)
{
    struct glsl_program *p = &r->sides[side];
    int copy = p->node_count++;
    r->dots[side][copy] = r->dots[side][node];
    p->nodes[copy] = p->nodes[node];
    p->nodes[copy].next = -1;
    p->nodes[node].first = copy;
    p->nodes[node].at = p->used;
    p->used += 16;
    return copy;
}

// Returns the symbol of a vector that the fragment shader uses several times, if the node is its first use. A change
// normalizes it at all uses.
static struct glsl_symbol *shared_input(struct glsl_program *p, int node)
{
    struct glsl_symbol *found = NULL;
    int uses = 0;
    for (int i = 0; i < p->node_count && !p->vertex && p->nodes[node].kind == GLSL_VARIABLE; i++)
        if (p->nodes[i].kind == GLSL_VARIABLE && p->nodes[i].at == p->nodes[node].at) {
            if (i < node)
                return NULL;
            uses++;
        }
    for (int i = 0; i < p->symbol_count && uses > 1; i++)
        if (p->symbols[i].storage == GLSL_INPUT && p->symbols[i].at == p->nodes[node].at && !p->symbols[i].unit)
            found = &p->symbols[i];
    return found;
}

static void apply(struct reading *r, struct tried *t)
{
    struct glsl_program *p = &r->sides[t->side];
    struct glsl_node *n = &p->nodes[t->node];
    int copy, zero;
    t->before = *n;
    switch (t->change) {
    case CHANGE_UNIT:
        if ((t->input = shared_input(p, t->node))) {
            t->input->unit = true;
            break;
        }
        lower(r, t->side, t->node);
        n->kind = GLSL_BUILTIN;
        n->number = glsl_builtin("normalize");
        break;
    case CHANGE_SIGN:
        lower(r, t->side, t->node);
        n->kind = GLSL_UNARY;
        n->op = '-';
        break;
    case CHANGE_CLAMP:
        copy = lower(r, t->side, t->node);
        zero = p->node_count++;
        p->nodes[zero] = (struct glsl_node){
            .kind = GLSL_CONSTANT, .type = {GLSL_FLOAT, 1, 1, 0, 0}, .first = -1, .next = -1, .at = p->used};
        p->memory[p->used++] = 0;
        p->nodes[copy].next = zero;
        n->kind = GLSL_BUILTIN;
        n->number = glsl_builtin("max");
        break;
    case CHANGE_ABS:
        zero = p->node_count++;
        p->nodes[zero] = (struct glsl_node){
            .kind = GLSL_CONSTANT, .type = {GLSL_FLOAT, 1, 1, 0, 0}, .first = -1, .next = -1, .at = p->used};
        p->memory[p->used++] = 0;
        p->nodes[n->first].next = zero;
        n->number = glsl_builtin("max");
        break;
    case CHANGE_PLUS:
        n->op = '-';
        break;
    case CHANGE_LEFT:
    case CHANGE_RIGHT: {
        int next = n->next, from = t->change == CHANGE_LEFT ? n->first : p->nodes[n->first].next;
        *n = p->nodes[from];
        n->next = next;
        break;
    }
    default:
        n->kind = GLSL_GIVEN;
        n->given = r->right[t->space][t->change == CHANGE_NORMAL  ? RIGHT_NORMAL
                                      : t->change == CHANGE_POINT ? RIGHT_POINT
                                      : t->change == CHANGE_EYE   ? RIGHT_EYE
                                                                  : RIGHT_LIGHT];
        n->at = p->used;
        p->used += 16;
    }
}

static void undo(struct reading *r, const struct tried *t, const int nodes[2], const int used[2])
{
    struct glsl_program *p = &r->sides[t->side];
    if (t->change == CHANGE_ABS)
        p->nodes[t->before.first].next = -1;
    if (t->input)
        t->input->unit = false;
    p->nodes[t->node] = t->before;
    p->node_count = nodes[t->side];
    p->used = used[t->side];
}

// --- names

static const char *named(const struct reading *r, int role)
{
    for (int i = 0; i < r->leaf_count; i++)
        if (!r->leaves[i].attribute && r->leaves[i].choices[r->leaves[i].chosen].role == role)
            return r->leaves[i].name;
    return NULL;
}

static double cosine(const double *a, const double *b)
{
    double ab = 0, aa = 0, bb = 0;
    for (int i = 0; i < 3; i++) {
        ab += a[i] * b[i];
        aa += a[i] * a[i];
        bb += b[i] * b[i];
    }
    return aa > 0 && bb > 0 ? ab / math_sqrt(aa * bb) : 0;
}

static bool along(const double *a, const double *b)
{
    double c = cosine(a, b);
    return c > 1 - 1e-9 || c < -1 + 1e-9;
}

static void times(const double *m, const double *v, double w, bool transposed, double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = transposed ? m[4 * i] * v[0] + m[4 * i + 1] * v[1] + m[4 * i + 2] * v[2]
                            : m[i] * v[0] + m[4 + i] * v[1] + m[8 + i] * v[2] + m[12 + i] * w;
}

// Names a wrong normal (in the vertex shader, of the last vertex; in the fragment shader, interpolated).
static const char *name_normal(const struct reading *r, const struct tried *t, const double *x,
                               const struct reading_sample *s)
{
    static const struct {
        int matrix;
        double w;
        bool transposed;
        const char *mistake;
    } rows[] = {
        {READ_MODEL, 0, false, "normal-by-model-view"},    {READ_MODEL_VIEW, 0, false, "normal-by-model-view"},
        {READ_MODEL, 1, false, "normal-as-point"},         {READ_MODEL_VIEW, 1, false, "normal-as-point"},
        {READ_ALL, 0, false, "normal-clip-space"},         {READ_VIEW_PROJECTION, 0, false, "normal-clip-space"},
        {READ_MODEL_VIEW, 0, true, "normal-by-transpose"}, {READ_MODEL, 0, true, "normal-by-transpose"},
        {READ_OTHER, 0, false, "normal-by-inverse"},       {READ_VIEW, 0, false, "normal-object-space"},
        {READ_ALL, 1, false, "normal-clip-space"}};
    if (cosine(x, r->right[t->space][RIGHT_NORMAL]) > 0.999)
        return "normal-not-unit";
    if (along(x, r->right[READ_EYE_SPACE][RIGHT_NORMAL]))
        return "normal-eye-space";
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        double sum[3] = {0}, one[3];
        for (int k = t->side ? 0 : 2; k < 3; k++) {
            times(s->matrices[rows[i].matrix], s->normals[k], rows[i].w, rows[i].transposed, one);
            for (int c = 0; c < 3; c++)
                sum[c] += (t->side ? s->weights[k] : 1) * one[c];
        }
        if (along(x, sum))
            return rows[i].mistake;
    }
    if (along(x, t->side ? s->normals[0] : s->normals[2]))
        return "normal-object-space";
    double p[3] = {0};
    for (int k = t->side ? 0 : 2; k < 3; k++)
        for (int c = 0; c < 3; c++)
            p[c] += (t->side ? s->weights[k] : 1) * s->normals[k][c];
    if (along(x, p))
        return "normal-object-space";
    return along(x, r->right[t->space][RIGHT_POINT]) ? "position-as-normal" : NULL;
}

static const char *name_point(const struct tried *t, const double *x, const struct reading_sample *s)
{
    double object[3] = {0}, clip[3];
    for (int k = t->side ? 0 : 2; k < 3; k++)
        for (int c = 0; c < 3; c++)
            object[c] += (t->side ? s->weights[k] : 1) * s->positions[k][c];
    times(s->matrices[READ_ALL], object, 1, false, clip);
    return along(x, object) ? "point-in-object-space" : along(x, clip) ? "clip-space-vectors" : NULL;
}

// Returns which right vector a value points along: 'n', 'l', 'v', 'h' or 'r'; 0 for none. The reading is set.
static char vector_of(const struct reading *r, int space, const double *x)
{
    const double *n = r->right[space][RIGHT_NORMAL], *v = r->right[space][RIGHT_EYE], *l = r->right[space][RIGHT_LIGHT];
    double h[3], m[3], nl = n[0] * l[0] + n[1] * l[1] + n[2] * l[2];
    for (int i = 0; i < 3; i++) {
        h[i] = l[i] + v[i];
        m[i] = 2 * nl * n[i] - l[i];
    }
    double c = cosine(x, n); // an interpolated normal that is not yet normalized may lean a little
    return c * c > 0.99 ? 'n' : along(x, l) ? 'l' : along(x, v) ? 'v' : along(x, h) ? 'h' : along(x, m) ? 'r' : 0;
}

// Returns whether a half vector is (l + v)/2.
static bool is_mean(const struct reading *r, const double *x)
{
    double xx = 0, hh = 0;
    for (int i = 0; i < 3; i++) {
        double h = r->right[0][RIGHT_LIGHT][i] + r->right[0][RIGHT_EYE][i];
        xx += x[i] * x[i];
        hh += h * h;
    }
    return xx > 0.24 * hh && xx < 0.26 * hh;
}

// Returns whether a direction to the eye is the difference of an eye, whose space is stated, and a point in another space.
static bool is_mixed(const struct reading *r, const struct reading_sample *s, const double *x)
{
    bool stated = false;
    for (int i = 0; i < r->leaf_count; i++)
        stated = stated || (r->leaves[i].choice_count == 1 && r->leaves[i].choices[0].role == READ_EYE);
    for (int space = 1; space < SPACES; space++) {
        double v[3];
        for (int i = 0; i < 3; i++)
            v[i] = s->eye[i] - r->right[space][RIGHT_POINT][i];
        if (stated && along(x, v))
            return true;
    }
    return false;
}

// Names the mistake of a change that makes the shader right.
static const char *name_of(struct reading *r, struct tried *t)
{
    struct glsl_program *p = &r->sides[t->side];
    struct reading_sample *s = &r->pair[0];
    double x[4] = {0};
    char which = 0;
    if (!reading_evaluate(r, s)) // the value without the change
        return NULL;
    if (t->side == 0)
        reading_set_right(r, s, 2); // the memory contains the values of the last vertex
    memcpy(x, p->memory + p->nodes[t->node].at,
           (size_t)(p->nodes[t->node].type.rows < 4 ? p->nodes[t->node].type.rows : 4) * sizeof *x);
    for (int space = 0; space < SPACES && !which; space++)
        which = vector_of(r, space, x);
    const int parent = parent_of(p, t->node);
    const bool is_input = p->nodes[t->node].kind == GLSL_VARIABLE && p->nodes[t->node].number == GLSL_INPUT && t->side;
    double closest = 0.95;
    int equal[SPACES] = {0};
    bool point = false; // the vector is added to another, and is the point itself
    for (int space = 0; space < SPACES && parent >= 0 && p->nodes[parent].op == '+'; space++)
        for (int i = 0; i < 3; i++) {
            double d = x[i] - r->right[space][RIGHT_POINT][i];
            equal[space] += d < 1e-9 && d > -1e-9;
            point = point || equal[space] == 3;
        }
    double nl = 0;
    for (int i = 0; i < 3; i++)
        nl += r->right[0][RIGHT_NORMAL][i] * r->right[0][RIGHT_LIGHT][i];
    switch (t->change) {
    case CHANGE_UNIT:
        for (int i = 0; i < SPACES * RIGHT_VECTORS && which != 'n' && is_input; i++) { // normalized at the vertices
            const double c =
                i % RIGHT_VECTORS == RIGHT_POINT ? 0 : cosine(x, r->right[i / RIGHT_VECTORS][i % RIGHT_VECTORS]);
            which = c > closest ? "pnvl"[i % RIGHT_VECTORS] : which;
            closest = c > closest ? c : closest;
        }
        return which == 'n' || (t->side == 0 && !which)
                   ? (r->form.late_normal ? "normal-never-unit" : "normal-not-unit")
               : which == 'l' ? "light-not-unit"
               : which == 'h' ? (is_mean(r, x) ? "half-is-mean" : "half-not-unit")
               : which == 'v' ? "half-of-raw-eye"
                              : NULL;
    case CHANGE_SIGN:
        return which == 'n'   ? "normal-inward"
               : which == 'l' ? "light-backwards"
               : which == 'v' ? (point ? "light-plus-point" : "eye-backwards")
               : which == 'r' ? "reflect-sign"
                              : NULL;
    case CHANGE_CLAMP:
        return x[0] - nl < 0.05 && nl - x[0] < 0.05 ? "no-clamp" : NULL;
    case CHANGE_ABS:
        return "abs-of-n.l";
    case CHANGE_PLUS: { // a colour may also be a sum
        const struct glsl_node *a = &p->nodes[p->nodes[t->node].first], *b = &p->nodes[a->next];
        double l[3];
        for (int i = 0; i < 3; i++)
            l[i] = p->memory[a->at + (a->type.rows > 1 ? i : 0)] - p->memory[b->at + (b->type.rows > 1 ? i : 0)];
        for (int space = 0; space < SPACES; space++)
            if (along(l, r->right[space][RIGHT_LIGHT]))
                return "light-plus-point";
        return NULL;
    }
    case CHANGE_LEFT:
    case CHANGE_RIGHT: {
        const struct glsl_node *n = &p->nodes[t->node],
                               *dropped = &p->nodes[t->change == CHANGE_LEFT ? p->nodes[n->first].next : n->first];
        double d = glsl_width(dropped->type) == 1 ? p->memory[dropped->at] - (nl > 0 ? nl : 0) : 1;
        return d < 1e-9 && d > -1e-9 ? "specular-times-n.l" : NULL;
    }
    case CHANGE_NORMAL:
        return name_normal(r, t, x, s);
    case CHANGE_POINT:
        return name_point(t, x, s);
    case CHANGE_EYE:
        return which == 'n'                                                                        ? "n.r-for-v.r"
               : along(x, s->eye_axis)                                                             ? "viewer-infinite"
               : along(x, r->right[0][RIGHT_POINT]) && (named(r, READ_VIEW) || named(r, READ_EYE)) ? "eye-at-origin"
               : is_mixed(r, s, x)                                                                 ? "spaces-mixed"
                                                                                                   : NULL;
    default:
        return along(x, s->lights[0]) ? "point-as-direction" : NULL;
    }
}

static const char *name_form(const struct reading_form *f)
{
    static const char *const early[] = {
        NULL, "light-unit-too-early", "eye-unit-too-early", "unit-too-early", NULL, NULL, NULL, NULL};
    return f->shaded      ? "specular-times-n.l"
           : f->early & 4 ? (f->phong ? "reflection-in-vertex-shader" : "half-in-vertex-shader")
                          : early[f->early];
}

// --- texts

// Copies words of the source.
static void copy_words(const struct glsl_program *p, int from, int to, char *out, size_t capacity)
{
    size_t at = 0;
    out[0] = 0;
    for (int i = from; i < to && at + 70 < capacity; i++) {
        const char *text = p->text->words[i].text, *before = i > from ? p->text->words[i - 1].text : "";
        bool joined = i == from || strchr(".,;)(]", text[0]) || strchr("[", text[0]) || strchr("(.[!", before[0]);
        bool twin = i > from && strchr("=<>&|+-", before[0]) && (text[0] == '=' || text[0] == before[0]);
        at += (size_t)snprintf(out + at, capacity - at, "%s%s", joined || twin ? "" : " ", text);
    }
}

static void replacement(const struct reading *r, const struct tried *t, const char *old, char *out, size_t capacity)
{
    const struct glsl_program *p = &r->sides[t->side];
    const struct glsl_node *n = &p->nodes[t->node];
    const struct reading_leaf *normal = NULL;
    const char *matrix = named(r, t->space == READ_EYE_SPACE ? READ_NORMAL_EYE : READ_NORMAL_WORLD),
               *model = named(r, t->space == READ_EYE_SPACE ? READ_MODEL_VIEW : READ_MODEL);
    out[0] = 0;
    for (int i = 0; i < r->leaf_count; i++)
        if (r->leaves[i].attribute && r->leaves[i].choices[r->leaves[i].chosen].role == READ_NORMAL)
            normal = &r->leaves[i];
    char part[180];
    switch (t->change) {
    case CHANGE_UNIT:
        snprintf(out, capacity, "normalize(%s)", old);
        break;
    case CHANGE_SIGN:
        snprintf(out, capacity, n->kind == GLSL_BINARY ? "(-(%s))" : "(-%s)", old);
        break;
    case CHANGE_CLAMP:
        snprintf(out, capacity, "max(%s, 0.0)", old);
        break;
    case CHANGE_ABS:
        copy_words(p, p->nodes[n->first].word, p->nodes[n->first].end, part, sizeof part);
        snprintf(out, capacity, "max(%s, 0.0)", part);
        break;
    case CHANGE_LEFT:
    case CHANGE_RIGHT: {
        const struct glsl_node *kept = &p->nodes[t->change == CHANGE_LEFT ? n->first : p->nodes[n->first].next];
        copy_words(p, kept->word, kept->end, out, capacity);
        break;
    }
    case CHANGE_NORMAL:
        if (p->vertex && normal && n->type.rows == 3 && (matrix || model)) {
            const char *components = normal->type.rows == 4 ? ".xyz" : "";
            snprintf(part, sizeof part, matrix ? "mat3(%s)" : "transpose(inverse(mat3(%s)))", matrix ? matrix : model);
            if (r->rows)
                snprintf(out, capacity, "normalize(%.90s%s * %.90s)", normal->name, components, part);
            else
                snprintf(out, capacity, "normalize(%.90s * %.90s%s)", part, normal->name, components);
        }
        break;
    default:
        break;
    }
}

static void describe(const struct reading *r, const struct tried *t, const char *mistake, struct repair *out)
{
    const struct glsl_program *p = &r->sides[t->side];
    const struct glsl_node *n = &p->nodes[t->node];
    char old[180];
    *out = (struct repair){.mistake = mistake, .side = t->side, .first = n->word, .end = n->end};
    if (n->word >= p->text->word_count)
        return;
    out->at = p->text->words[n->word].line;
    copy_words(p, n->word, n->end, old, sizeof old);
    if (t->change == CHANGE_PLUS) {
        const struct glsl_node *a = &p->nodes[n->first], *b = &p->nodes[a->next];
        char left[100], right[100];
        copy_words(p, a->word, a->end, left, sizeof left);
        copy_words(p, b->word, b->end, right, sizeof right);
        snprintf(out->text, sizeof out->text, "%.98s - %.98s", left, right);
    } else
        replacement(r, t, old, out->text, sizeof out->text);
    snprintf(out->line, sizeof out->line, "%s", old);
    snprintf(out->write, sizeof out->write, "%s", out->text);
    if (t->input) // the text would change one use
        out->text[0] = 0;
}

// --- shaders that are no sums of terms

// Returns whether the shader computes steps, rims, ramps or shifted cosines: functions of a cosine that no sum of terms
// contains.
static bool is_stylized(const struct reading *r, uint8_t *const depends[2])
{
    static const char *const functions[] = {"floor", "ceil", "step",    "smoothstep",
                                            "fract", "exp",  "texture", "texture2D"};
    for (int side = 0; side < 2; side++)
        for (int i = 0; i < r->sides[side].node_count; i++) {
            const struct glsl_program *p = &r->sides[side];
            const struct glsl_node *n = &p->nodes[i];
            bool on_normal = false, constant = false, any = false;
            for (int c = n->kind < GLSL_BLOCK ? n->first : -1; c >= 0; c = p->nodes[c].next) {
                any = any || depends[side][c] & ON_NORMAL;
                on_normal = on_normal || (depends[side][c] & ON_NORMAL && glsl_width(p->nodes[c].type) == 1);
                bool fixed = p->nodes[c].kind == GLSL_CONSTANT || (strchr("<>", n->op) && !depends[side][c]);
                constant = constant || (fixed && p->memory[p->nodes[c].at] != 0);
            }
            for (size_t f = 0; f < sizeof functions / sizeof *functions; f++)
                if (any && is_call(p, i, functions[f]))
                    return true;
            if (n->kind == GLSL_BINARY && n->op == '/' && depends[side][n->first] & ON_NORMAL &&
                depends[side][p->nodes[n->first].next] & ON_NORMAL) // a tone curve
                return true;
            if (n->kind == GLSL_BINARY && on_normal && constant && (strchr("-<>", n->op) || glsl_is_dot(p, n->first)))
                return true;
            if (glsl_is_dot(p, i) && depends[side][i] & ON_NORMAL && is_shifted(p, i))
                return true;
        }
    return false;
}

// Returns whether negative values of a cosine have no effect.
static bool is_clamped(struct reading *r, int side, int node)
{
    struct tried t = {.side = side, .node = node, .change = CHANGE_CLAMP};
    const int nodes[2] = {r->sides[0].node_count, r->sides[1].node_count},
              used[2] = {r->sides[0].used, r->sides[1].used};
    double before[3];
    bool same = true;
    for (int k = 0; k < READ_TURNS && same; k++) {
        struct reading_sample *s = r->samples + (k % READ_POINTS) * READ_TURNS + k;
        if (!reading_evaluate(r, s))
            continue;
        memcpy(before, s->color, sizeof before);
        apply(r, &t);
        same = reading_evaluate(r, s) && memcmp(before, s->color, sizeof before) == 0;
        undo(r, &t, nodes, used);
    }
    return same;
}

// Returns whether all cosines are right, and one is n.l, in the last reading_count_wrong of a shader that computes steps,
// rims, ramps or shifted cosines.
static bool is_right_in_general(struct reading *r, uint8_t *const depends[2])
{
    bool right = true, lit = false;
    for (int side = 0; side < 2; side++)
        for (int i = 0; i < r->sides[side].node_count && right; i++)
            if (r->dots[side][i].depends && glsl_is_dot(&r->sides[side], i)) {
                bool on_light = depends[side][i] & ON_LIGHT, on_eye = depends[side][i] & ON_EYE;
                lit = lit || (on_light && r->dots[side][i].diffuse);
                right = !on_light || on_eye || is_shifted(&r->sides[side], i) || is_clamped(r, side, i);
            }
    return right && lit;
}

// --- the search

// Whether a change leaves all cosines as they are.
static bool is_neutral(int change) { return change >= CHANGE_CLAMP && change <= CHANGE_RIGHT && change != CHANGE_PLUS; }

struct search {
    struct reading *r;
    uint8_t *depends[2];
    int nodes[2];           // before the changes
    double *first;          // scratch memory of find_varying
    uint8_t *varies;        // of each node before the changes
    bool general, negative; // the shader need not be a sum of terms; its colours are negative at some samples
};

// Returns whether the shader is right after a change.
static bool mends(struct search *s, const struct tried *t, int copy, bool helps)
{
    if (!s->general)
        return reading_test_forms(s->r, FORMS_RIGHT);
    s->depends[t->side][copy] = s->depends[t->side][t->node]; // the change may have put the node there
    return t->wrong == 0 && (helps || (t->change == CHANGE_CLAMP && s->negative)) &&
           is_right_in_general(s->r, s->depends);
}

static void mark_parents(const struct glsl_program *p, uint8_t *parents)
{
    for (int i = 0; i < p->node_count; i++)
        for (int c = p->nodes[i].first; c >= 0; c = p->nodes[c].next)
            parents[c] = is_call(p, i, "normalize") ? PARENT_NORMALIZE : is_call(p, i, "max") ? PARENT_MAX : 0;
    for (int i = 0; i < p->node_count; i++) {
        int c = p->nodes[i].kind == GLSL_ASSIGN || p->nodes[i].kind == GLSL_INCREMENT ? p->nodes[i].first : -1;
        for (; c >= 0; c = p->nodes[c].kind >= GLSL_MEMBER && p->nodes[c].kind <= GLSL_SWIZZLE ? p->nodes[c].first : -1)
            parents[c] = PARENT_WRITES;
    }
}

// Marks the functions of numbers, such as cosines, that run at the samples of a point (bit 0) and vary between them (bit 1).
static void find_varying(struct reading *r, const int nodes[2], double *first, uint8_t *out)
{
    static const double not_run = -2e33;
    for (int t = 0; t < 2 * READ_TURNS; t += 3) { // first marks the values as not evaluated, then reads them
        if (t % 2)
            reading_evaluate(r, &r->samples[READ_TURNS + t / 2]);
        for (int i = 0; i < nodes[0] + nodes[1]; i++) {
            struct glsl_program *p = &r->sides[i >= nodes[0]];
            const struct glsl_node *n = &p->nodes[i < nodes[0] ? i : i - nodes[0]];
            if (n->kind != GLSL_BUILTIN || glsl_width(n->type) != 1)
                continue;
            double *x = p->memory + n->at;
            if (t % 2 && *x != not_run) {
                first[i] = out[i] ? first[i] : *x;
                out[i] |= *x - first[i] < 1e-9 && first[i] - *x < 1e-9 ? 1 : 3;
            }
            *x = not_run;
        }
    }
}

// Returns whether a function's number always is 0 or 1 after the changes, such as a clamped cosine. Such changes mend nothing:
// they remove a term that no sum of terms contains. A distance may become constant.
static bool removes_term(struct search *s, struct tried *t)
{
    struct reading *r = s->r;
    const int nodes[2] = {r->sides[0].node_count, r->sides[1].node_count},
              used[2] = {r->sides[0].used, r->sides[1].used}, count = s->nodes[0] + s->nodes[1];
    uint8_t *varies = arena_alloc_zeroed(r->arena, (size_t)count);
    if (!varies)
        return true;
    apply(r, t);
    find_varying(r, s->nodes, s->first, varies);
    undo(r, t, nodes, used);
    for (int i = 0; i < count; i++)
        if (s->varies[i] == 3 && varies[i] == 1 && s->first[i] * s->first[i] - s->first[i] < 1e-9 &&
            s->first[i] > -1e-9)
            return true;
    return false;
}

// Keeps a change that makes the shader right. Returns whether it has a name of its own.
static bool keep_right(struct search *s, struct tried *t, int depth, bool found)
{
    struct reading *r = s->r;
    const char *mistake = name_of(r, t);
    bool known = !mistake || removes_term(s, t) || (found && strcmp(r->repairs[depth].mistake, mistake) == 0);
    for (int i = 0; i < r->also_count; i++)
        known = known || strcmp(r->also[i], mistake) == 0;
    if (known)
        return false;
    if (!found)
        describe(r, t, mistake, &r->repairs[depth]);
    else if (r->also_count < MAX_REPAIRS)
        r->also[r->also_count++] = mistake;
    return true;
}

// Tries each change alone. A change is tested if fewer cosines are wrong after it. Returns the number of right changes;
// `best` receives the others with a name that help most.
static int try_each(struct search *s, int wrong, int depth, struct tried best[MAX_BEAM], int *best_count)
{
    struct reading *r = s->r;
    const double *position = r->sides[0].memory + glsl_symbol(&r->sides[0], "gl_Position")->at;
    int found = 0;
    double color[3], clip[4];
    reading_count_wrong(r, true);
    memcpy(color, r->pair[1].color, sizeof color);
    memcpy(clip, position, sizeof clip);
    for (int change = 0; change < CHANGES; change++)
        for (int side = 0; side < 2; side++) {
            const int count = r->sides[side].node_count;
            uint8_t *parents = arena_alloc_zeroed(r->arena, (size_t)count + 8);
            if (!parents || count + 8 > r->sides[side].node_capacity)
                return found;
            mark_parents(&r->sides[side], parents);
            for (int i = 0; i < count * 2 && !r->spent && found < MAX_REPAIRS; i++) {
                struct tried t = {.side = side, .node = i / 2, .change = change, .space = i % 2};
                const int nodes[2] = {r->sides[0].node_count, r->sides[1].node_count},
                          used[2] = {r->sides[0].used, r->sides[1].used};
                if ((t.space && change < CHANGE_NORMAL) ||
                    !suits(&r->sides[side], t.node, change, s->depends[side], parents[t.node]))
                    continue;
                apply(r, &t);
                t.wrong = reading_count_wrong(r, true);
                // If no cosine is wrong, or can become wrong, the colour must change.
                const bool same = memcmp(color, r->pair[1].color, sizeof color) == 0,
                           moves = memcmp(clip, position, sizeof clip) != 0, helps = t.wrong < wrong && !moves,
                           may = t.wrong <= wrong && (is_neutral(change) || (!wrong && !same)),
                           right = (helps || (may && !moves)) && mends(s, &t, nodes[side], helps);
                t.mean = r->mean;
                undo(r, &t, nodes, used);
                if (right)
                    found += keep_right(s, &t, depth, found);
                if (right || !helps || found || !(t.mistake = name_of(r, &t)))
                    continue;
                int at = *best_count;
                while (at > 0 && best[at - 1].wrong > t.wrong)
                    at--;
                if (at == MAX_BEAM)
                    continue;
                *best_count += *best_count < MAX_BEAM;
                memmove(best + at + 1, best + at, (size_t)(*best_count - 1 - at) * sizeof *best);
                best[at] = t;
            }
        }
    return found;
}

// Finds changes that are right together, greedily. Returns their number.
static int descend(struct search *s, int wrong, int depth)
{
    struct reading *r = s->r;
    struct tried best[MAX_BEAM];
    int best_count = 0;
    if (try_each(s, wrong, depth, best, &best_count))
        return depth + 1;
    for (int i = 0; i < best_count && depth + 1 < MAX_REPAIR_STEPS && i < (depth ? 1 : MAX_BEAM) && !r->spent; i++) {
        const int nodes[2] = {r->sides[0].node_count, r->sides[1].node_count},
                  used[2] = {r->sides[0].used, r->sides[1].used};
        describe(r, &best[i], best[i].mistake, &r->repairs[depth]);
        r->repairs[depth].after = best[i].mean;
        apply(r, &best[i]);
        int found;
        if (best[i].wrong && depth < MAX_EARLY && reading_test_forms(r, FORMS_EARLY) && name_form(&r->form)) {
            r->repairs[depth + 1] = (struct repair){.mistake = name_form(&r->form)};
            found = depth + 2;
        } else
            found = descend(s, best[i].wrong, depth + 1);
        undo(r, &best[i], nodes, used);
        if (found) {
            r->also_count = 0;
            return found;
        }
    }
    return 0;
}

// Returns whether a colour is negative, with the values of the inputs or with one of the colours 0.
static bool has_negative(struct reading *r)
{
    bool found = false;
    for (int i = 0; i < r->leaf_count && !found; i++) {
        const struct reading_leaf *leaf = &r->leaves[i];
        double kept[2][4] = {{0}};
        if (leaf->attribute || leaf->geometric || leaf->node >= 0 || leaf->type.columns > 1)
            continue;
        for (int back = 0; back < 2; back++) {
            for (int side = 0; side < 2; side++)
                for (int c = 0; c < leaf->type.rows && leaf->at[side] >= 0; c++) {
                    double *value = r->sides[side].memory + leaf->at[side] + c;
                    kept[side][c] = back ? kept[side][c] : *value;
                    *value = back ? kept[side][c] : 0;
                }
            for (int k = 0; k < READ_TURNS && !back; k++) {
                const double *color = r->samples[k].color;
                found = found || (reading_evaluate(r, &r->samples[k]) &&
                                  (color[0] < -1e-6 || color[1] < -1e-6 || color[2] < -1e-6));
            }
        }
    }
    return found;
}

int repair_find(struct reading *r)
{
    struct search s = {.r = r};
    struct repair *out = r->repairs;
    r->also_count = 0;
    r->steps = repair_steps;
    r->spent = false;
    r->needs_highlight = declarations_uses(r->sides[0].text, "pow") || declarations_uses(r->sides[1].text, "pow");
    memset(out, 0, sizeof r->repairs);
    for (int k = 0; k < r->nearest_count; k++) {
        const bool shaded =
            !reading_restore(r, &r->nearest[k]) && r->light_count > 1; // of one light, a change shows the line
        if ((shaded || (k < MAX_EARLY && r->nearest[k].wrong)) &&
            reading_test_forms(r, shaded ? FORMS_SHADED : FORMS_EARLY) && name_form(&r->form)) {
            out[0] = (struct repair){.mistake = name_form(&r->form)};
            r->mean = r->nearest[k].mean;
            return 1;
        }
    }
    int closest = 0, fewest = READ_MANY;
    for (int k = 0; k < r->nearest_count; k++) {
        fewest = r->nearest[k].wrong < fewest ? r->nearest[k].wrong : fewest;
        closest = r->nearest[k].mean < r->nearest[closest].mean ? k : closest;
    }
    // First one change of any reading, then one change of the likeliest if the shader is no sum, then several changes of the likeliest.
    for (int pass = 0; pass < 3; pass++)
        for (int k = 0; k < r->nearest_count && !r->spent; k++) {
            struct tried best[MAX_BEAM];
            int best_count = 0;
            s.general = pass == 1;
            if ((pass == 1 && r->nearest[k].wrong && (k != closest || r->nearest[k].wrong > fewest)) ||
                (pass == 2 && k >= MAX_EARLY && k != closest) || reading_restore(r, &r->nearest[k]) == READ_MANY ||
                !find_dependence(r, s.depends) || (s.general && !is_stylized(r, s.depends)))
                continue;
            for (int side = 0; side < 2; side++)
                s.nodes[side] = r->sides[side].node_count;
            const size_t count = (size_t)(s.nodes[0] + s.nodes[1]);
            if (!(s.first = arena_array(r->arena, count, sizeof *s.first)) ||
                !(s.varies = arena_alloc_zeroed(r->arena, count)))
                return 0;
            find_varying(r, s.nodes, s.first, s.varies);
            s.negative = s.general && has_negative(r);
            const int wrong = reading_count_wrong(r, true);
            int found = pass == 2 ? descend(&s, wrong, 0) : try_each(&s, wrong, 0, best, &best_count);
            r->mean = r->nearest[k].mean;
            if (found)
                return pass == 2 ? found : 1;
        }
    return 0;
}

bool repair_accepts(struct reading *r)
{
    uint8_t *depends[2];
    for (int k = 0; k < r->nearest_count; k++)
        if (!reading_restore(r, &r->nearest[k]) && !r->nearest[k].wrong && find_dependence(r, depends) &&
            (is_stylized(r, depends) || r->light_count >= 5 || r->nearest[k].mean <= 1e-7) &&
            is_right_in_general(r, depends)) {
            r->form = (struct reading_form){.general = true, .gate = true};
            return true;
        }
    return false;
}

// --- the mended source

static void put(struct text *out, const char *word, const char *before, bool line)
{
    bool joined = strlen(word) == 1 && strlen(before) == 1 && strchr("=&|+-<>^", word[0]) &&
                  strchr("=!<>+-*/&|^", before[0]) && (word[0] == '=' || word[0] == before[0]);
    text_print(out, "%s%s", line ? "\n" : joined ? "" : " ", word);
}

char *repair_text(const struct declarations *d, const struct repair *repairs, int count, int side)
{
    struct text out = {0};
    if (d->version)
        text_print(&out, "#version %d %s\n", d->version, d->profile);
    for (int i = 0; i < d->word_count; i++) {
        const struct word *w = &d->words[i];
        int mended = -1;
        for (int k = 0; k < count; k++)
            mended = repairs[k].side == side && repairs[k].text[0] && repairs[k].first == i ? k : mended;
        put(&out,
            mended >= 0    ? repairs[mended].text
            : w->number[0] ? w->number
                           : w->text,
            i ? d->words[i - 1].text : "", i && w->line != w[-1].line);
        if (mended >= 0)
            i = repairs[mended].end - 1;
    }
    text_add(&out, "\n");
    if (out.failed)
        free(out.bytes);
    return out.failed ? NULL : out.bytes;
}
