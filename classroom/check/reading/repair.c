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
enum { MAX_BEAM = 5, SPACES = 3 };
static const int64_t repair_steps = 60000000;

struct tried {
    int side, node, change, space, state;
    struct glsl_node before;
    double mean;
};

// --- which parts depend on what

enum { ON_NORMAL = 1, ON_POINT = 2, ON_EYE = 4, ON_LIGHT = 8 };

// Finds what the values of the nodes depend on, by comparing the memory after evaluations.
static bool find_dependence(struct reading *r, uint8_t *out[2])
{
    struct reading_sample *base = r->samples + 3, changed;
    double *before[2];
    for (int side = 0; side < 2; side++) {
        before[side] = arena_array(r->arena, (size_t)r->sides[side].used, sizeof(double));
        out[side] = arena_alloc_zeroed(r->arena, (size_t)r->sides[side].node_count);
        if (!before[side] || !out[side])
            return false;
    }
    for (int bit = 0; bit < 4; bit++) {
        reading_evaluate(r, base);
        for (int side = 0; side < 2; side++)
            memcpy(before[side], r->sides[side].memory, (size_t)r->sides[side].used * sizeof(double));
        changed = *base;
        for (int k = 0; k < 3; k++)
            for (int i = 0; i < 3; i++) {
                changed.normals[k][i] = bit == 0 ? base->normals[k][(i + 1) % 3] : base->normals[k][i];
                changed.positions[k][i] += bit == 1 ? 0.1 * (i + 1) : 0;
            }
        for (int i = 0; i < 3 && bit == 2; i++) {
            changed.eye[i] = base->eye[i] + 0.3 * (i + 1);
            memcpy(changed.matrices, r->samples[9].matrices, sizeof changed.matrices);
        }
        for (int i = 0; i < 3 * READ_LIGHTS && bit == 3; i++)
            changed.lights[i / 3][i % 3] += 0.2 * (i % 3 + 1);
        reading_evaluate(r, &changed);
        for (int side = 0; side < 2; side++)
            for (int i = 0; i < r->sides[side].node_count; i++) {
                const struct glsl_node *n = &r->sides[side].nodes[i];
                for (int c = 0; c < glsl_width(n->type) && n->kind <= GLSL_GIVEN; c++)
                    if (r->sides[side].memory[n->at + c] != before[side][n->at + c])
                        out[side][i] |= (uint8_t)(1u << bit);
            }
    }
    return true;
}

// --- changes

static bool is_call(const struct glsl_program *p, int node, const char *name)
{
    return p->nodes[node].kind == GLSL_BUILTIN && strcmp(glsl_builtin_name(p->nodes[node].number), name) == 0;
}

// Returns whether a number is added to a constant, possibly after a multiplication: 0.5 * dot(n, l) + 0.5.
static bool is_shifted(const struct glsl_program *p, int node)
{
    for (int level = 0, at = node; level < 2; level++) {
        int parent = -1;
        for (int i = 0; i < p->node_count && parent < 0; i++)
            for (int c = p->nodes[i].first; c >= 0; c = p->nodes[c].next)
                parent = c == at ? i : parent;
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
    if (n->kind > GLSL_GIVEN || n->kind == GLSL_ASSIGN || n->kind == GLSL_CONSTANT || !depends)
        return false;
    const struct glsl_node *left = n->first >= 0 ? &p->nodes[n->first] : n;
    const int kept = change == CHANGE_LEFT ? n->first : n->first >= 0 ? left->next : -1;
    const bool place = depends & (ON_POINT | ON_LIGHT), seen = place || depends & ON_EYE;
    // clang-format off
    switch (change) {
    case CHANGE_UNIT: return vector && n->type.rows == 3 && !is_call(p, node, "normalize") && parent != 1;
    case CHANGE_SIGN: return vector && n->kind != GLSL_UNARY;
    case CHANGE_CLAMP: return number && depends & ON_NORMAL && !is_call(p, node, "max") && parent != 2 && !is_shifted(p, node);
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
static int lower(struct glsl_program *p, int node)
{
    int copy = p->node_count++;
    p->nodes[copy] = p->nodes[node];
    p->nodes[copy].next = -1;
    p->nodes[node].first = copy;
    p->nodes[node].at = p->used;
    p->used += 16;
    return copy;
}

static void apply(struct reading *r, struct tried *t)
{
    struct glsl_program *p = &r->sides[t->side];
    struct glsl_node *n = &p->nodes[t->node];
    int copy, zero;
    t->before = *n;
    switch (t->change) {
    case CHANGE_UNIT:
        lower(p, t->node);
        n->kind = GLSL_BUILTIN;
        n->number = glsl_builtin("normalize");
        break;
    case CHANGE_SIGN:
        lower(p, t->node);
        n->kind = GLSL_UNARY;
        n->op = '-';
        break;
    case CHANGE_CLAMP:
        copy = lower(p, t->node);
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
    p->nodes[t->node] = t->before;
    p->node_count = nodes[t->side];
    p->used = used[t->side];
}

// --- names

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

// Names the mistake of a change that makes the shader right.
static const char *name_of(struct reading *r, struct tried *t)
{
    struct glsl_program *p = &r->sides[t->side];
    struct reading_sample *s = r->samples + 5;
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
    double nl = 0;
    for (int i = 0; i < 3; i++)
        nl += r->right[0][RIGHT_NORMAL][i] * r->right[0][RIGHT_LIGHT][i];
    switch (t->change) {
    case CHANGE_UNIT:
        return which == 'n' || (t->side == 0 && !which)
                   ? (r->form.late_normal ? "normal-never-unit" : "normal-not-unit")
               : which == 'l' ? "light-not-unit"
               : which == 'h' ? (is_mean(r, x) ? "half-is-mean" : "half-not-unit")
               : which == 'v' ? "half-of-raw-eye"
                              : NULL;
    case CHANGE_SIGN:
        return which == 'n'   ? "normal-inward"
               : which == 'l' ? "light-backwards"
               : which == 'v' ? "eye-backwards"
               : which == 'r' ? "reflect-sign"
                              : NULL;
    case CHANGE_CLAMP:
        return x[0] - nl < 0.05 && nl - x[0] < 0.05 ? "no-clamp" : NULL;
    case CHANGE_ABS:
        return "abs-of-n.l";
    case CHANGE_PLUS:
        return "light-plus-point";
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
        return which == 'n'                         ? "n.r-for-v.r"
               : along(x, s->eye_axis)              ? "viewer-infinite"
               : along(x, r->right[0][RIGHT_POINT]) ? "eye-at-origin"
                                                    : NULL;
    default:
        return along(x, s->lights[0]) ? "point-as-direction" : NULL;
    }
}

static const char *name_form(const struct reading_form *f)
{
    static const char *const early[] = {
        NULL, "light-unit-too-early", "eye-unit-too-early", "unit-too-early", NULL, NULL, NULL, NULL};
    return f->early & 4 ? (f->phong ? "reflection-in-vertex-shader" : "half-in-vertex-shader") : early[f->early];
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

static const char *matrix_named(const struct reading *r, int role)
{
    for (int i = 0; i < r->leaf_count; i++)
        if (!r->leaves[i].attribute && r->leaves[i].choices[r->leaves[i].chosen].role == role)
            return r->leaves[i].name;
    return NULL;
}

static void replacement(const struct reading *r, const struct tried *t, const char *old, char *out, size_t capacity)
{
    const struct glsl_program *p = &r->sides[t->side];
    const struct glsl_node *n = &p->nodes[t->node];
    const char *normal = NULL,
               *matrix = matrix_named(r, t->space == READ_EYE_SPACE ? READ_NORMAL_EYE : READ_NORMAL_WORLD),
               *model = matrix_named(r, t->space == READ_EYE_SPACE ? READ_MODEL_VIEW : READ_MODEL);
    out[0] = 0;
    for (int i = 0; i < r->leaf_count; i++)
        if (r->leaves[i].attribute && r->leaves[i].choices[r->leaves[i].chosen].role == READ_NORMAL)
            normal = r->leaves[i].name;
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
        if (p->vertex && normal && n->type.rows == 3 && matrix)
            snprintf(out, capacity, "%s(%s) * %s", "normalize(mat3", matrix, normal);
        else if (p->vertex && normal && n->type.rows == 3 && model)
            snprintf(out, capacity, "normalize(transpose(inverse(mat3(%s))) * %s", model, normal);
        if (out[0])
            snprintf(out + strlen(out), capacity - strlen(out), "%s)", strchr(normal, '4') ? ".xyz" : "");
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
}

// --- the search

static int pass(struct reading *r, uint8_t *const depends[2], int state_from, int state_to, struct tried beam[MAX_BEAM],
                struct repair *out, const char *also[MAX_REPAIRS], int *also_count)
{
    int found = 0, beam_count = 0;
    for (int k = state_from; k < state_to && !found; k++)
        for (int change = 0; change < CHANGES; change++)
            for (int side = 0; side < 2; side++) {
                const int count = r->sides[side].node_count;
                uint8_t *parents = arena_alloc_zeroed(r->arena, (size_t)count + 1); // 1: normalize, 2: max
                for (int i = 0; i < count && parents; i++)
                    for (int c = r->sides[side].nodes[i].first; c >= 0; c = r->sides[side].nodes[c].next)
                        parents[c] = is_call(&r->sides[side], i, "normalize") ? 1
                                     : is_call(&r->sides[side], i, "max")     ? 2
                                                                              : 0;
                for (int node = 0; node < count && parents && !r->spent; node++)
                    for (int space = 0;
                         space < (change >= CHANGE_NORMAL ? 2 : 1) &&
                         suits(&r->sides[side], node, change, depends[side], parents[node]) && found < MAX_REPAIRS;
                         space++) {
                        const int nodes[2] = {r->sides[0].node_count, r->sides[1].node_count},
                                  used[2] = {r->sides[0].used, r->sides[1].used};
                        struct tried t = {.side = side, .node = node, .change = change, .space = space, .state = k};
                        if (r->sides[side].node_count + 4 > r->sides[side].node_capacity)
                            return found;
                        reading_restore(r, &r->nearest[k]);
                        apply(r, &t);
                        bool right = reading_test_forms(r, false);
                        t.mean = r->mean;
                        undo(r, &t, nodes, used);
                        if (right) {
                            const char *mistake = name_of(r, &t);
                            bool known = !mistake || (found && strcmp(out->mistake, mistake) == 0);
                            for (int i = 0; i < *also_count; i++)
                                known = known || strcmp(also[i], mistake) == 0;
                            if (!mistake || (found && known))
                                continue;
                            if (!found)
                                describe(r, &t, mistake, out);
                            else if (*also_count < MAX_REPAIRS)
                                also[(*also_count)++] = mistake;
                            found++;
                        } else if (beam && !found && t.mean < 0.7 * r->nearest[k].mean) {
                            int at = beam_count < MAX_BEAM ? beam_count++ : MAX_BEAM - 1;
                            if (at == MAX_BEAM - 1 && beam_count == MAX_BEAM && beam[at].mean > 0 &&
                                beam[at].mean <= t.mean)
                                continue;
                            for (; at > 0 && beam[at - 1].mean > t.mean; at--)
                                beam[at] = beam[at - 1];
                            beam[at] = t;
                        }
                    }
            }
    return found;
}

int repair_find(struct reading *r, struct repair out[MAX_REPAIR_STEPS], const char *also[MAX_REPAIRS], int *also_count)
{
    uint8_t *depends[2];
    struct tried beam[MAX_BEAM] = {{0}};
    *also_count = 0;
    r->steps = repair_steps;
    r->spent = false;
    r->needs_highlight = declarations_uses(r->sides[0].text, "pow") || declarations_uses(r->sides[1].text, "pow");
    for (int k = 0; k < r->nearest_count; k++) {
        reading_restore(r, &r->nearest[k]);
        if (reading_test_forms(r, true)) {
            const char *name = name_form(&r->form);
            out[0] = (struct repair){.mistake = name};
            if (name)
                return 1;
        }
    }
    if (!r->nearest_count)
        return 0;
    reading_restore(r, &r->nearest[0]);
    if (!find_dependence(r, depends))
        return 0;
    if (pass(r, depends, 0, r->nearest_count, beam, &out[0], also, also_count))
        return 1;
    for (int i = 0; i < MAX_BEAM && beam[i].mean > 0; i++) {
        const int nodes[2] = {r->sides[0].node_count, r->sides[1].node_count},
                  used[2] = {r->sides[0].used, r->sides[1].used};
        const struct reading_state kept = r->nearest[beam[i].state];
        reading_restore(r, &kept);
        const char *mistake = name_of(r, &beam[i]);
        if (!mistake)
            continue;
        describe(r, &beam[i], mistake, &out[1]);
        apply(r, &beam[i]);
        int found = 0;
        if (reading_test_forms(r, true) && name_form(&r->form)) {
            out[0] = (struct repair){.mistake = name_form(&r->form)};
            found = 1;
        } else
            found = pass(r, depends, beam[i].state, beam[i].state + 1, NULL, &out[0], also, also_count);
        undo(r, &beam[i], nodes, used);
        if (found) {
            *also_count = 0;
            return 2;
        }
    }
    return 0;
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
