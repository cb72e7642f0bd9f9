// reading.c: evaluates a shader at the samples, and compares its colours with sums of an ambient, a diffuse and a
// specular term.
//
// The file is longer than 600 lines, because the samples, the fit of the terms and the forms that are tried share their
// state.
#include "reading.h"

#include <string.h>

#include "elementary.h"

enum { STEPS_PER_RUN = 400000 };
static const double max_residual = 1e-5; // the largest difference from the sum, as a fraction of the largest colour
static const double not_run = -1e33;     // the value of an expression that is not evaluated
static const double min_factor = 1e-3;   // a smaller factor of a term is no evidence of lighting

const char *const reading_role_names[READ_ROLES] = {"factor",
                                                    "model",
                                                    "view",
                                                    "projection",
                                                    "model-view",
                                                    "view-projection",
                                                    "model-view-projection",
                                                    "normal-matrix",
                                                    "normal-matrix-world",
                                                    "inverse-view",
                                                    "light",
                                                    "direction",
                                                    "axis",
                                                    "eye",
                                                    "position",
                                                    "normal"};

// --- evaluation

static void to_space(const struct reading_sample *s, int space, const double in[4], double out[4])
{
    const double *m = space == READ_EYE_SPACE ? s->matrices[READ_VIEW] : s->matrices[READ_OTHER]; // world to object
    for (int r = 0; r < 4; r++) {
        out[r] = space == READ_WORLD_SPACE ? in[r] : 0;
        for (int c = 0; c < 4 && space != READ_WORLD_SPACE; c++)
            out[r] += m[4 * c + r] * in[c];
    }
}

static void subtract(const double a[3], const double b[3], double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = a[i] - b[i];
}

static double dot3(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static void unit3(double a[3])
{
    double length = math_sqrt(dot3(a, a));
    for (int i = 0; i < 3; i++)
        a[i] = length > 0 ? a[i] / length : 0;
}

static void weighted(const struct reading_sample *s, const double from[3][3], double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = s->weights[0] * from[0][i] + s->weights[1] * from[1][i] + s->weights[2] * from[2][i];
}

static void vector_value(const struct reading_sample *s, const struct reading_leaf *leaf, int element, double out[4])
{
    const struct reading_choice *choice = &leaf->choices[leaf->chosen];
    const int light = (leaf->light + element) % READ_LIGHTS;
    double world[4] = {0, 0, 0, 1}, center[3];
    if (choice->role == READ_EYE || choice->role == READ_LIGHT)
        memcpy(world, choice->role == READ_EYE ? s->eye : s->lights[light], 3 * sizeof *world);
    else {
        weighted(s, s->points, center);
        subtract(s->lights[light], center, world);
        unit3(world);
        if (choice->role == READ_AXIS)
            memcpy(world, s->axes[light], 3 * sizeof *world);
        world[3] = 0;
    }
    to_space(s, choice->space & 3, world, out);
    if (world[3] == 0)
        unit3(out);
    for (int i = 0; i < 3 && choice->space & 4; i++) // the opposite direction
        out[i] = -out[i];
}

static void set_leaf(struct reading *r, const struct reading_sample *s, struct reading_leaf *leaf)
{
    const int role = leaf->choices[leaf->chosen].role;
    if (leaf->attribute || (role == READ_OTHER && (!leaf->geometric || !leaf->choice_count)))
        return;
    for (int element = 0; element < (leaf->count ? leaf->count : 1); element++) {
        double value[16];
        if (role < READ_MATRICES && role != READ_OTHER) {
            const int n = leaf->type.rows;
            bool rows = r->rows && strncmp(leaf->name, "gl_", 3) != 0;
            for (int c = 0; c < n; c++)
                for (int k = 0; k < n; k++)
                    value[c * n + k] = s->matrices[role][rows ? 4 * k + c : 4 * c + k];
        } else if (role == READ_OTHER)
            memcpy(value, leaf->original, sizeof leaf->original);
        else
            vector_value(s, leaf, element, value);
        if (leaf->node >= 0)
            memcpy(leaf->given, value, sizeof leaf->given);
        for (int side = 0; side < 2 && leaf->node < 0; side++)
            if (leaf->at[side] >= 0)
                memcpy(r->sides[side].memory + leaf->at[side] + element * leaf->step, value,
                       (size_t)glsl_width(leaf->type) * sizeof *value);
    }
}

static bool run(struct reading *r, int side)
{
    struct glsl_program *p = &r->sides[side];
    p->steps = STEPS_PER_RUN;
    bool ok = glsl_run(p);
    r->steps -= STEPS_PER_RUN - p->steps;
    r->spent = r->spent || r->steps < 0;
    return ok;
}

static void put_right(struct reading *r, const struct reading_sample *s, enum reading_right which, const double v[3],
                      double w)
{
    const double world[4] = {v[0], v[1], v[2], w};
    for (int space = 0; space < 3; space++)
        to_space(s, space, world, r->right[space][which]);
}

static bool is_directional(const struct reading *r, int light)
{
    for (int i = 0; i < r->leaf_count; i++)
        if (r->leaves[i].geometric && r->leaves[i].choices[r->leaves[i].chosen].role == READ_LIGHT &&
            light >= r->leaves[i].light && light < r->leaves[i].light + (r->leaves[i].count ? r->leaves[i].count : 1))
            return false;
    return r->light_count > 0;
}

static void way(const struct reading *r, const struct reading_sample *s, int light, const double p[3], double out[3])
{
    double center[3];
    weighted(s, s->points, center);
    subtract(r->light_count ? s->lights[light] : s->eye, r->light_count && is_directional(r, light) ? center : p, out);
    unit3(out);
}

void reading_set_right(struct reading *r, const struct reading_sample *s, int k)
{
    double p[3], n[3], v[3], l[3];
    weighted(s, s->points, p);
    weighted(s, s->units, n);
    unit3(n);
    memcpy(p, k < 3 ? s->points[k] : p, sizeof p);
    memcpy(n, k < 3 ? s->units[k] : n, sizeof n);
    subtract(s->eye, p, v);
    way(r, s, 0, p, l);
    unit3(v);
    put_right(r, s, RIGHT_POINT, p, 1);
    put_right(r, s, RIGHT_NORMAL, n, 0);
    put_right(r, s, RIGHT_EYE, v, 0);
    put_right(r, s, RIGHT_LIGHT, l, 0);
}

static bool run_vertices(struct reading *r, struct reading_sample *s)
{
    struct glsl_program *vertex = &r->sides[0], *fragment = &r->sides[1];
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i < r->leaf_count; i++) {
            struct reading_leaf *leaf = &r->leaves[i];
            const int role = leaf->choices[leaf->chosen].role;
            if (!leaf->attribute || role == READ_OTHER)
                continue;
            double *to = vertex->memory + leaf->at[0];
            memcpy(to, role == READ_POSITION ? s->positions[k] : s->normals[k], 3 * sizeof *to);
            if (leaf->type.rows == 4)
                to[3] = role == READ_POSITION;
        }
        reading_set_right(r, s, k);
        if (!run(r, 0))
            return false;
        for (int i = 0; i < vertex->symbol_count; i++) {
            const struct glsl_symbol *out = &vertex->symbols[i],
                                     *in = out->storage != GLSL_OUTPUT
                                               ? NULL
                                               : glsl_symbol(fragment, strcmp(out->name, "gl_FrontColor") == 0
                                                                           ? "gl_Color"
                                                                           : out->name);
            if (!in || in->storage != GLSL_INPUT)
                continue;
            for (int c = 0; c < glsl_size(vertex, out->type); c++) {
                double *to = &fragment->memory[in->at + c], part = vertex->memory[out->at + c];
                *to = in->flat ? part : (k ? *to : 0) + s->weights[k] * part;
            }
            if (in->unit && k == 2)
                unit3(&fragment->memory[in->at]);
        }
    }
    return true;
}

bool reading_evaluate(struct reading *r, struct reading_sample *s)
{
    for (int i = 0; i < r->leaf_count; i++)
        set_leaf(r, s, &r->leaves[i]);
    if (!run_vertices(r, s))
        return false;
    reading_set_right(r, s, 3);
    if (!run(r, 1) || r->sides[1].discarded)
        return false;
    memcpy(s->color, r->sides[1].memory + r->output, sizeof s->color);
    for (int i = 0; i < 3; i++)
        if (!(s->color[i] - s->color[i] == 0))
            return false;
    return true;
}

// --- the terms of a right shader

static void view(const struct reading_sample *s, const struct reading_form *f, const double p[3], double out[3])
{
    if (f->infinite_viewer)
        memcpy(out, s->eye_axis, 3 * sizeof *out);
    else
        subtract(s->eye, p, out);
    unit3(out);
}

// Computes a vector at the point, or from the unit vectors at the vertices. `which`: 0 l, 1 v, 2 h.
static void direction(const struct reading *r, const struct reading_sample *s, const struct reading_form *f, int light,
                      int which, double out[3])
{
    double at[3][3], p[3], l[3], v[3];
    bool early = f->early >> which & 1;
    weighted(s, s->points, p);
    for (int k = 0; k < (early ? 3 : 1); k++) {
        way(r, s, light, early ? s->points[k] : p, l);
        view(s, f, early ? s->points[k] : p, v);
        if (which == 2 && !early) {
            direction(r, s, f, light, 0, l);
            direction(r, s, f, light, 1, v);
        }
        for (int i = 0; i < 3; i++)
            at[k][i] = which == 0 ? l[i] : which == 1 ? v[i] : l[i] + v[i];
        unit3(at[k]);
    }
    if (early)
        weighted(s, at, out);
    else
        memcpy(out, at[0], sizeof at[0]);
    unit3(out);
}

static double lobe(const struct reading_form *f, double nl, double base)
{
    bool gated = f->gate && nl <= 0;
    return gated || base <= 0 ? 0 : math_pow(base, f->exponent);
}

static double base_of(const struct reading_form *f, const double n[3], const double l[3], const double v[3],
                      const double h[3])
{
    return f->phong ? 2 * dot3(n, l) * dot3(n, v) - dot3(l, v) : dot3(n, h);
}

static int columns(const struct reading *r, const struct reading_sample *s, const struct reading_form *f, double *out)
{
    const int lights = r->light_count ? r->light_count : 1;
    double n[3], l[3], v[3], h[3];
    int count = 0;
    out[count++] = 1;
    for (int light = 0; light < lights; light++)
        for (int k = 0; k < (f->vertex ? 3 : 1) && count + 2 <= READ_COLUMNS; k++) {
            if (f->vertex) {
                memcpy(n, s->units[k], sizeof n);
                way(r, s, light, s->points[k], l);
                view(s, f, s->points[k], v);
                for (int i = 0; i < 3; i++)
                    h[i] = l[i] + v[i];
                unit3(h);
            } else {
                weighted(s, f->late_normal ? s->longs : s->units, n);
                unit3(n);
                direction(r, s, f, light, 0, l);
                direction(r, s, f, light, 1, v);
                direction(r, s, f, light, 2, h);
            }
            const double nl = dot3(n, l), weight = f->vertex ? s->weights[k] : 1;
            out[count++] = weight * (nl > 0 ? nl : 0);
            if (f->exponent > 0)
                out[count++] = weight * lobe(f, nl, base_of(f, n, l, v, h));
        }
    double shine = 0;
    for (int i = 2; i < count && f->shaded; i += 2)
        shine += out[i];
    for (int i = 2; i < count && f->shaded; i += 2)
        out[i] = out[i - 1] * shine;
    return count;
}

// --- the cosines

enum { COSINES = 16 * 4 * READ_LIGHTS + 1 };

// Computes the cosines of right vectors at the point or at the last vertex, and returns their number. At the point, the
// cosines of vectors that are normalized at the vertices follow from index *early on.
static int cosines(const struct reading *r, const struct reading_sample *s, bool vertex, double out[COSINES],
                   int *early)
{
    double n[3], l[3], v[3], h[3], p[3];
    int count = 0;
    out[count++] = 1;
    weighted(s, s->points, p);
    memcpy(p, vertex ? s->points[2] : p, sizeof p);
    for (int form = 0; form < (vertex || r->light_count > 4 ? 4 : 16); form++) {
        const struct reading_form f = {.infinite_viewer = form & 1, .early = (uint8_t)(form >> 2)};
        weighted(s, form & 2 ? s->longs : s->units, n);
        memcpy(n, vertex ? s->units[2] : n, sizeof n);
        unit3(n);
        if (form == 4)
            *early = count;
        for (int light = 0; light < (r->light_count ? r->light_count : 1); light++) {
            way(r, s, light, p, l);
            view(s, &f, p, v);
            if (f.early) {
                direction(r, s, &f, light, 0, l);
                direction(r, s, &f, light, 1, v);
            }
            for (int i = 0; i < 3; i++)
                h[i] = l[i] + v[i];
            unit3(h);
            const double nl = dot3(n, l), nv = dot3(n, v), lv = dot3(l, v);
            const double right[] = {nl, nv, dot3(n, h), 2 * nl * nv - lv};
            memcpy(out + count, right, sizeof right);
            count += sizeof right / sizeof *right;
        }
    }
    *early = *early ? *early : count;
    return count;
}

static bool is_small(double x) { return x < 1e-8 && x > -1e-8; }

static bool is_near(const double *a, const double *b)
{
    for (int i = 0; i < 3; i++)
        if (!is_small(a[i] - b[i]))
            return false;
    return true;
}

// Returns whether the arguments of dot() are the right normal and a fixed axis, such as the axis of a hemisphere.
static bool is_of_axis(const struct reading *r, const struct glsl_program *p, int node)
{
    const int first = p->nodes[node].first, second = p->nodes[first].next;
    for (int space = 0; space < 3; space++)
        for (int k = 0; k < 2; k++) {
            const struct glsl_node *a = &p->nodes[k ? second : first], *b = &p->nodes[k ? first : second];
            bool fixed = b->kind == GLSL_CONSTRUCT || b->kind == GLSL_GIVEN ||
                         (b->kind == GLSL_VARIABLE && b->number == GLSL_UNIFORM);
            for (int i = 0; i < r->leaf_count && fixed; i++) {
                const struct reading_leaf *leaf = &r->leaves[i];
                const bool mine = b->kind == GLSL_GIVEN      ? b->given == leaf->given
                                  : b->kind == GLSL_VARIABLE ? b->at == leaf->at[p == &r->sides[1]]
                                                             : false;
                fixed = !mine || leaf->attribute || !leaf->choices[leaf->chosen].role;
            }
            if (fixed && is_near(p->memory + a->at, r->right[space][RIGHT_NORMAL]))
                return true;
        }
    return false;
}

// Returns whether an argument of dot() points along n, v or l, or against them.
static bool has_right_vector(const struct reading *r, const struct glsl_program *p, int node)
{
    for (int c = p->nodes[node].first; c >= 0; c = p->nodes[c].next)
        for (int i = 0; i < 3 * RIGHT_VECTORS && p->nodes[c].type.rows > 2; i++) {
            const double *x = p->memory + p->nodes[c].at, *y = r->right[i / RIGHT_VECTORS][i % RIGHT_VECTORS];
            const double xy = dot3(x, y);
            if (y[3] == 0 && xy * xy > 0.999 * dot3(x, x) * dot3(y, y))
                return true;
        }
    return false;
}

// Makes two samples that differ in their normals, which face the first light.
static bool make_pair(const struct reading *r, const struct reading_sample *s, struct reading_sample pair[2])
{
    int found = 0;
    for (int t = 0; t < READ_TURNS && found < 2; t++) {
        double l[3], p[3];
        weighted(s, s->points, p);
        way(r, s, 0, p, l);
        if (dot3(s[t].units[2], l) <= 0.3 || dot3(s[t].units[0], l) <= 0 || dot3(s[t].units[1], l) <= 0)
            continue;
        pair[found] = found ? pair[0] : s[t];
        memcpy(pair[found].normals, s[t].normals, sizeof s->normals);
        memcpy(pair[found].longs, s[t].longs, sizeof s->longs);
        memcpy(pair[found++].units, s[t].units, sizeof s->units);
    }
    return found == 2;
}

int reading_count_wrong(struct reading *r, bool known)
{
    double right[2][2][COSINES];
    int wrong = 0, count = 0, early = 0;
    bool matters = known;
    if (!known && !make_pair(r, r->samples + READ_TURNS, r->pair))
        return READ_MANY;
    for (int k = 0; k < 2; k++) {
        for (int side = 0; side < 2; side++)
            for (int i = 0; i < r->sides[side].node_count; i++)
                if (glsl_is_dot(&r->sides[side], i))
                    r->sides[side].memory[r->sides[side].nodes[i].at] = not_run;
        if (!reading_evaluate(r, &r->pair[k]))
            return READ_MANY;
        for (int side = 0; side < 2; side++) {
            struct glsl_program *p = &r->sides[side];
            reading_set_right(r, &r->pair[k], side ? 3 : 2);
            early = 0;
            count = cosines(r, &r->pair[k], side == 0, right[k][side], &early);
            for (int i = 0; i < p->node_count; i++) {
                struct reading_dot *dot = &r->dots[side][i];
                const double x = glsl_is_dot(p, i) ? p->memory[p->nodes[i].at] : not_run, before = dot->value;
                bool same = false, near = false, along = false; // equal to a right or early cosine, or proportional
                dot->value = x;
                dot->diffuse = false;
                dot->ran = dot->ran || x != not_run;
                if (k && !known)
                    dot->depends = x != before && x != not_run;
                matters = matters || (k && dot->depends);
                for (int c = 0; c < count && k && dot->depends && x != not_run; c++) {
                    bool equal = is_small(x - right[1][side][c]);
                    same = same || (equal && c < early);
                    near = near || equal;
                    dot->diffuse = dot->diffuse || (equal && c % 4 == 1);
                    along = along || (x != 0 && is_small(x * right[0][side][c] - before * right[1][side][c]));
                }
                if (k && dot->depends && x != not_run && !same && !is_of_axis(r, p, i))
                    wrong += near ? 1 : along ? 2 : has_right_vector(r, p, i) ? 3 : 4;
                wrong += k && dot->ran && x == not_run && glsl_is_dot(p, i) ? 3 : 0;
            }
        }
    }
    return matters || memcmp(r->pair[0].color, r->pair[1].color, sizeof r->pair->color) ? wrong : READ_MANY;
}

// --- the fit

// Solves the normal equations; a column that adds nothing gets the factor 0.
static void solve(double a[READ_COLUMNS][READ_COLUMNS + 3], int n)
{
    for (int k = 0; k < n; k++) {
        if (a[k][k] < 1e-9) {
            for (int m = k; m < n + 3; m++)
                a[k][m] = 0;
            continue;
        }
        for (int i = 0; i < n; i++) {
            double times = i == k ? 0 : a[i][k] / a[k][k];
            for (int m = k; m < n + 3 && times != 0; m++)
                a[i][m] -= times * a[k][m];
        }
    }
}

static double color_of(const struct reading_form *f, double x)
{
    return f->gamma > 0 && x > 0 ? math_pow(x, f->gamma) : x;
}

// Tests the samples of one point. *lit receives the lights whose diffuse term is
// visible.
static bool test_point(struct reading *r, int point, const struct reading_form *f, uint32_t *lit, bool *shines)
{
    static _Thread_local double a[READ_COLUMNS][READ_COLUMNS + 3], c[READ_TURNS][READ_COLUMNS], colors[READ_TURNS][3];
    struct reading_sample *s = r->samples + point * READ_TURNS;
    const int n = columns(r, s, f, c[0]), turns = 12 + 3 * n < READ_TURNS ? 12 + 3 * n : READ_TURNS;
    double largest = 0;
    r->steps -= turns * 12 * n + n * n * n / 8; // the time of the fit, in steps of the evaluation
    r->spent = r->spent || r->steps < 0;
    memset(a, 0, (size_t)n * sizeof *a);
    for (int t = 0; t < turns; t++) {
        if (s[t].color[0] < -1e29 && !reading_evaluate(r, &s[t]))
            return false;
        columns(r, &s[t], f, c[t]);
        for (int i = 0; i < 3; i++) {
            double y = colors[t][i] = color_of(f, s[t].color[i]);
            largest = y > largest ? y : -y > largest ? -y : largest;
        }
        for (int k = 0; k < n; k++) {
            for (int m = 0; m < n; m++)
                a[k][m] += c[t][k] * c[t][m];
            for (int i = 0; i < 3; i++)
                a[k][n + i] += c[t][k] * colors[t][i];
        }
    }
    solve(a, n);
    double factors[READ_COLUMNS][3];
    const int step = (f->exponent > 0 ? 2 : 1) * (f->vertex ? 3 : 1);
    bool negative = false;
    for (int i = 0; i < READ_LIGHTS; i++) { // at the point or, if the vertices are lit, at the first vertex
        double p[3], way_of[3];
        weighted(s, s->points, p);
        subtract(s->lights[i], f->vertex ? s->points[0] : p, way_of);
        r->distance[point][i] = math_sqrt(dot3(way_of, way_of));
        r->strength[point][i] =
            1 + i * step < n && a[1 + i * step][1 + i * step] > 0
                ? (a[1 + i * step][n] + a[1 + i * step][n + 1] + a[1 + i * step][n + 2]) / a[1 + i * step][1 + i * step]
                : 0;
    }
    for (int k = 0; k < n; k++)
        for (int i = 0; i < 3; i++) {
            factors[k][i] = a[k][k] > 0 ? a[k][n + i] / a[k][k] : 0;
            bool specular = f->exponent > 0 && k % 2 == 0;
            negative = negative || (k && factors[k][i] * math_sqrt(a[k][k] > 0 ? a[k][k] : 0) < -1e-4 * largest);
            if (k && factors[k][i] > min_factor * largest && !specular)
                *lit |= 1u << (k - 1) / (f->exponent > 0 ? 2 : 1) / (f->vertex ? 3 : 1);
            *shines = *shines || (k && specular && factors[k][i] > min_factor * largest);
        }
    double sum = 0;
    r->worst = 0;
    for (int t = 0; t < turns; t++)
        for (int i = 0; i < 3; i++) {
            double y = 0;
            for (int k = 0; k < n; k++)
                y += factors[k][i] * c[t][k];
            y -= colors[t][i];
            y = y < 0 ? -y : y;
            sum += y;
            r->worst = y > r->worst ? y : r->worst;
        }
    r->worst /= largest > 0 ? largest : 1;
    sum /= (largest > 0 ? largest : 1) * 3 * turns;
    if (point == 0 && largest > 0 && *lit && sum < r->mean)
        r->mean = sum;
    return r->worst <= max_residual && !negative;
}

// Returns whether a light is brighter the farther away it is.
static bool grows(const struct reading *r, int light)
{
    for (int a = 0; a < READ_POINTS; a++)
        for (int b = 0; b < a; b++)
            if ((r->distance[a][light] - r->distance[b][light]) * (r->strength[a][light] - r->strength[b][light]) <=
                1e-6)
                return false;
    return true;
}

bool reading_test(struct reading *r, const struct reading_form *f)
{
    bool shines = false;
    uint32_t lit = 0; // a bit for each light
    for (int point = 0; point < READ_POINTS; point++)
        if (r->spent || !test_point(r, point, f, &lit, &shines))
            return false;
    for (int i = 0; i < r->leaf_count; i++) {
        const struct reading_leaf *leaf = &r->leaves[i];
        const int role = leaf->choices[leaf->chosen].role;
        if (leaf->geometric && (role == READ_LIGHT || role == READ_TO_LIGHT) && !(lit >> leaf->light & 1))
            return false; // this vector does not light the surface
        if (leaf->geometric && role == READ_LIGHT && grows(r, leaf->light))
            return false;
    }
    return lit && (shines || f->exponent <= 0);
}

// Finds the numbers that pow() gets as its second argument. Returns their count.
static int exponents(const struct reading *r, double out[6])
{
    static const double without[] = {2, 4, 8, 16, 32, 64}; // repeated multiplication
    int count = 0;
    bool found = false;
    for (int side = 0; side < 2; side++)
        for (int i = 0; i < r->sides[side].node_count; i++) {
            const struct glsl_program *p = &r->sides[side];
            const struct glsl_node *n = &p->nodes[i];
            if (n->kind != GLSL_BUILTIN || strcmp(glsl_builtin_name(n->number), "pow") != 0)
                continue;
            found = true;
            double x = p->memory[p->nodes[p->nodes[n->first].next].at];
            bool known = count == 6 || !(x > 0) || n->type.rows >= 3;
            for (int k = 0; k < count; k++)
                known = known || out[k] == x;
            if (!known)
                out[count++] = x;
        }
    for (int i = 0; i < 6 && !found; i++)
        out[count++] = without[i];
    return count;
}

// Finds the exponent that encodes the colour: pow(color, vec3(1.0 / 2.2)). Returns its inverse, or 0.
static double encoding(const struct reading *r)
{
    const struct glsl_program *p = &r->sides[1];
    for (int i = 0; i < p->node_count; i++) {
        const struct glsl_node *n = &p->nodes[i];
        if (n->kind == GLSL_BUILTIN && n->type.rows >= 3 && strcmp(glsl_builtin_name(n->number), "pow") == 0) {
            double x = p->memory[p->nodes[p->nodes[n->first].next].at];
            return x > 0 ? 1 / x : 0;
        }
    }
    return declarations_uses(p->text, "2.2") ? 2.2 : 0;
}

static bool has_role(const struct reading *r, int role)
{
    for (int i = 0; i < r->leaf_count; i++)
        if (r->leaves[i].geometric && r->leaves[i].choices[r->leaves[i].chosen].role == role)
            return true;
    return false;
}

// Returns whether the colours change if only the eye moves, as every highlight does.
static bool sees_eye(struct reading *r)
{
    for (int k = 0; k < 12; k++) {
        struct reading_sample *s = r->samples + (k % READ_POINTS) * READ_TURNS + k, moved = *s;
        const struct reading_sample *other = s - k + READ_TURNS - 1 - k;
        memcpy(moved.eye, other->eye, sizeof moved.eye);
        memcpy(moved.eye_axis, other->eye_axis, sizeof moved.eye_axis);
        memcpy(moved.matrices, other->matrices, sizeof moved.matrices);
        if (!reading_evaluate(r, s) || !reading_evaluate(r, &moved))
            return true;
        for (int i = 0; i < 3; i++)
            if (!is_small(s->color[i] - moved.color[i]))
                return true;
    }
    return false;
}

// Returns whether a stage calls dot() with the normal, in the reading of the last reading_count_wrong.
static bool is_lit(const struct reading *r, int side)
{
    for (int i = 0; i < r->sides[side].node_count; i++)
        if (r->dots[side][i].depends)
            return true;
    return false;
}

bool reading_test_forms(struct reading *r, enum reading_forms forms)
{
    double powers[7] = {0};
    for (int i = 0; i < READ_POINTS * READ_TURNS; i++)
        r->samples[i].color[0] = -1e30; // not evaluated
    r->tried++;
    r->mean = 1;
    if (!reading_evaluate(r, &r->samples[0]))
        return false;
    const struct declarations *fragment = r->sides[1].text;
    const double gamma = encoding(r);
    const bool has_eye = has_role(r, READ_EYE);
    const bool lit_later = declarations_uses(fragment, "dot") || declarations_uses(fragment, "normalize");
    const bool lit[] = {is_lit(r, 0), is_lit(r, 1)}, shines = sees_eye(r);
    int count = shines ? 1 + exponents(r, powers + 1) : 1;
    for (int k = 0; k < count; k++)
        for (int bits = 0; bits < 64; bits++)
            for (int early = forms == FORMS_EARLY; early < (forms == FORMS_EARLY ? 8 : 1); early++) {
                struct reading_form f = {.vertex = bits & 1,
                                         .phong = bits & 2,
                                         .gate = !(bits & 4),
                                         .late_normal = bits & 8,
                                         .infinite_viewer = bits & 16,
                                         .gamma = bits & 32 ? gamma : 0,
                                         .shaded = forms == FORMS_SHADED,
                                         .early = (uint8_t)early,
                                         .exponent = powers[k]};
                if ((k == 0 && (bits & 22 || r->needs_highlight || f.shaded)) || (f.infinite_viewer && has_eye) ||
                    (!f.vertex && (!lit_later || (lit[0] && !lit[1]))) || (f.vertex && !lit[0] && lit[1]) ||
                    (f.vertex && (f.late_normal || forms)) || (bits & 32 && gamma <= 0) ||
                    (f.vertex && r->light_count > 4))
                    continue;
                if (reading_test(r, &f)) {
                    r->form = f;
                    return true;
                }
            }
    return false;
}
