// reading_roles.c: lists the inputs of a shader with their possible roles, and finds the cheapest right reading.
//
// The file is longer than 600 lines because the rules that exclude roles and the search share the list of inputs.
#include "reading.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "elementary.h"
#include "reference_scene.h"

enum { MAX_SUM = 12, MAX_CHAINS = 8 };
static const int64_t max_steps = 30000000,
                     test_steps = 20000000; // of the search, and of the tests of the likeliest readings
static const double dark = 0.5; // if no reading leaves a smaller residual, the numbers probably hide the light

// --- samples

static double noise(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return (double)(*state >> 8) / 8388608 - 1;
}

static lam_vec3 around(uint32_t *state)
{
    lam_vec3 v;
    do
        v = v3(noise(state), noise(state), noise(state));
    while (v3_dot(v, v) > 1 || v3_dot(v, v) < 0.05);
    return v3_unit(v);
}

static void put(double out[3], lam_vec3 v)
{
    out[0] = v.x;
    out[1] = v.y;
    out[2] = v.z;
}

static void put_matrix(double out[16], const lam_mat4 *m, bool transposed)
{
    for (int c = 0; c < 4; c++)
        for (int r = 0; r < 4; r++)
            out[4 * c + r] = transposed ? m->m[c][r] : m->m[r][c];
}

static void fill_matrices(struct reading_sample *s, const struct reference_scene *scene, struct reference_matrices *m)
{
    reference_matrices(scene, m);
    lam_mat4 inverse = lam_mat4_identity(), both = mat4_mul(&m->projection, &m->view);
    put_matrix(s->matrices[READ_MODEL], &m->model, false);
    put_matrix(s->matrices[READ_VIEW], &m->view, false);
    put_matrix(s->matrices[READ_PROJECTION], &m->projection, false);
    put_matrix(s->matrices[READ_MODEL_VIEW], &m->model_view, false);
    put_matrix(s->matrices[READ_VIEW_PROJECTION], &both, false);
    put_matrix(s->matrices[READ_ALL], &m->model_view_projection, false);
    put_matrix(s->matrices[READ_NORMAL_EYE], &m->normal4, false);
    mat4_inverse_affine(&m->model, &inverse);
    put_matrix(s->matrices[READ_OTHER], &inverse, false); // world to object
    put_matrix(s->matrices[READ_NORMAL_WORLD], &inverse, true);
    mat4_inverse_affine(&m->view, &inverse);
    put_matrix(s->matrices[READ_VIEW_INVERSE], &inverse, false);
}

static lam_vec3 normal_to_world(const double *m, lam_vec3 n)
{
    return v3(m[0] * n.x + m[4] * n.y + m[8] * n.z, m[1] * n.x + m[5] * n.y + m[9] * n.z,
              m[2] * n.x + m[6] * n.y + m[10] * n.z);
}

// Makes one sample of a point. The eye has the same distance and depth in every sample of the point.
static void make_turn(struct reading_sample *s, struct reference_scene *scene, const lam_vec3 corners[3], bool lit,
                      int side, uint32_t *state)
{
    struct reference_matrices m;
    lam_vec3 center = v3(0, 0, 0), world, n, eye, away;
    for (int k = 0; k < 3; k++)
        center = v3_add(center, v3_scale(corners[k], s->weights[k]));
    reference_matrices(scene, &m);
    world = mat4_point(&m.model, center);
    const lam_vec3 l = v3_unit(v3_sub(v3(s->lights[0][0], s->lights[0][1], s->lights[0][2]), world));
    lam_vec3 up;
    double grazing;
    do {
        n = around(state);
        up = v3_unit(normal_to_world(s->matrices[READ_NORMAL_WORLD], n));
        eye = around(state);
        grazing = v3_dot(up, l) * side;
        // Near the horizon: with side −1, a highlight without light; with side 1, the highlight of a reversed vector.
        if (side && grazing > 0.02 && grazing < 0.3)
            eye = v3_unit(v3_add(v3_scale(v3_sub(l, v3_scale(up, 2 * v3_dot(up, l))), side), v3_scale(up, 0.45)));
    } while (v3_dot(up, eye) < 0.2 || (lit && v3_dot(up, l) < 0.1) || (side && (grazing <= 0.02 || grazing >= 0.3)));
    away = v3_unit(v3_cross(eye, around(state)));
    scene->eye = v3_add(world, v3_scale(eye, 3));
    scene->target = v3_add(world, v3_scale(away, 0.9));
    fill_matrices(s, scene, &m);
    put(s->eye, scene->eye);
    put(s->eye_axis, v3_sub(scene->eye, scene->target));
    for (int k = 0; k < 3; k++) {
        lam_vec3 normal = v3_unit(v3_add(n, v3_scale(around(state), side ? 0.04 : 0.35)));
        lam_vec3 longer = normal_to_world(s->matrices[READ_NORMAL_WORLD], normal);
        put(s->positions[k], corners[k]);
        put(s->points[k], mat4_point(&m.model, corners[k]));
        put(s->normals[k], normal);
        put(s->longs[k], longer);
        put(s->units[k], v3_unit(longer));
    }
}

static bool make_samples(struct reading *r)
{
    static const double distances[READ_POINTS] = {2, 1.3, 2.7, 1.7, 3.2};
    uint32_t state = 12345;
    r->samples = arena_alloc_zeroed(r->arena, (size_t)READ_POINTS * READ_TURNS * sizeof *r->samples);
    for (int p = 0; r->samples && p < READ_POINTS; p++) {
        struct reference_scene scene = {.scale = r->has_model ? v3(1, 0.6, 1.5) : v3(1, 1, 1),
                                        .turn_axis = around(&state),
                                        .turn_deg = r->has_model ? 40 + 50 * p : 0};
        struct reading_sample *first = r->samples + p * READ_TURNS;
        struct reference_matrices m;
        lam_vec3 corners[3], center = v3_scale(around(&state), 0.7), world;
        scene.move = r->has_model ? v3_scale(around(&state), 0.8) : v3(0, 0, 0);
        scene.eye = v3(0, 1, 4);
        for (int k = 0; k < 3; k++)
            corners[k] = v3_add(center, v3_scale(around(&state), 0.6));
        fill_matrices(first, &scene, &m);
        world = mat4_point(&m.model, center);
        for (int t = 0; t < READ_TURNS; t++) {
            struct reading_sample *s = first + t;
            memcpy(s->matrices, first->matrices, sizeof s->matrices);
            memcpy(s->weights, ((const double[3][3]){{0.5, 0.3, 0.2}, {0.2, 0.45, 0.35}, {0.3, 0.2, 0.5}})[p % 3],
                   sizeof s->weights);
            for (int i = 0; i < READ_LIGHTS && t == 0; i++) {
                lam_vec3 to = around(&state), at = v3_add(world, v3_scale(to, distances[(p + i) % READ_POINTS]));
                put(s->lights[i], at);
                put(s->axes[i], v3_unit(v3_sub(v3_scale(around(&state), 0.08), to)));
            }
            memcpy(s->lights, first->lights, sizeof s->lights);
            memcpy(s->axes, first->axes, sizeof s->axes);
            make_turn(s, &scene, corners, t % 6 < 3, t % 6 == 5 ? -1 : t % 6 == 4, &state);
        }
    }
    return r->samples != NULL;
}

// --- inputs

static bool has(const char *name, const char *const *words)
{
    char plain[96];
    size_t length = 0;
    for (; *name && length + 1 < sizeof plain; name++)
        plain[length++] = (char)tolower((unsigned char)*name);
    plain[length] = 0;
    for (; *words; words++)
        if (strstr(plain, *words))
            return true;
    return false;
}

// The only names that count as clear.
static const char *const eye_words[] = {"eye", "cam", "viewpos", "viewer", "viewp", NULL};
static const char *const light_words[] = {"light", "lamp", "sun", NULL};
static const char *const normal_words[] = {"norm", "inv", NULL};

// Returns whether the roles of an input are stated, and this is none of them. `stated`: whether they are stated.
static bool is_excluded(const struct reading *r, const struct reading_leaf *leaf, int role, int space, bool *stated)
{
    static const char *const spaces[] = {"world", "eye", "object"};
    bool allowed = false;
    char name[60], whole[80];
    snprintf(name, sizeof name, "%s%s", space & 4 ? "-" : "", reading_role_names[role]);
    snprintf(whole, sizeof whole, "%s/%s", name, spaces[space & 3]);
    *stated = false;
    for (const char *const *s = r->stated; s && *s; s++) {
        const char *is = strchr(*s, '=');
        bool mine = is && strlen(leaf->name) == (size_t)(is - *s) && strncmp(*s, leaf->name, (size_t)(is - *s)) == 0;
        *stated = *stated || mine;
        allowed = allowed || (mine && (strcmp(is + 1, name) == 0 || strcmp(is + 1, whole) == 0));
    }
    return *stated && !allowed;
}

static void choose(struct reading *r, struct reading_leaf *leaf, int role, int space)
{
    bool eye = has(leaf->name, eye_words) && !has(leaf->name, light_words), light = has(leaf->name, light_words);
    bool stated;
    if (leaf->choice_count == READ_CHOICES || is_excluded(r, leaf, role, space, &stated))
        return;
    bool against = !stated && ((role == READ_EYE && light) || (eye && (role == READ_LIGHT || role == READ_TO_LIGHT)));
    leaf->choices[leaf->choice_count++] = (struct reading_choice){(uint8_t)role, (uint8_t)space, against};
}

static struct reading_leaf *add_leaf(struct reading *r, const char *name, struct glsl_type type, int side, int at)
{
    for (int i = 0; i < r->leaf_count; i++)
        if (strcmp(r->leaves[i].name, name) == 0 && !r->leaves[i].attribute) {
            r->leaves[i].at[side] = at;
            return &r->leaves[i];
        }
    if (r->leaf_count == READ_LEAVES) {
        snprintf(r->reason, sizeof r->reason, "the shader has more than %d matrices and vectors", READ_LEAVES);
        return NULL;
    }
    struct reading_leaf *leaf = &r->leaves[r->leaf_count++];
    *leaf = (struct reading_leaf){.type = type, .at = {-1, -1}, .owner = -1, .node = -1};
    snprintf(leaf->name, sizeof leaf->name, "%s", name);
    leaf->at[side] = at;
    return leaf;
}

// Returns the value of a number without a role. The variants differ in the order of the values and in their size.
static double number_of(const struct reading *r, const char *name, int component)
{
    double x = 0.3 + 0.03 * (word_hash(name) % 11) + 0.05 * (component % 4);
    return r->variant == 1 ? 1.1 - x : r->variant == 2 ? 20 * x : x;
}

// Gives values to an input and its members, and lists its matrices and vectors.
static bool add_input(struct reading *r, int side, const char *name, struct glsl_type t, int at, int step, int count)
{
    struct glsl_program *p = &r->sides[side];
    struct glsl_type one = t;
    one.count = 0;
    const int size = glsl_size(p, one), elements = t.count ? t.count : 1;
    char path[96];
    snprintf(path, sizeof path, "%s%s", name, t.count ? "[]" : "");
    if (t.count && !count) {
        step = size;
        count = t.count;
    }
    if (t.base == GLSL_STRUCT) {
        const struct glsl_structure *s = &p->structures[t.structure];
        for (int i = s->first; i < s->first + s->count; i++) {
            char member[96];
            snprintf(member, sizeof member, "%.40s.%.50s", path, p->members[i].name);
            if (!add_input(r, side, member, p->members[i].type, at + p->members[i].offset, step, count))
                return false;
        }
        return true;
    }
    const bool whole = t.base == GLSL_INT, truth = t.base == GLSL_BOOL;
    for (int e = 0; e < (count ? count : 1); e++)
        for (int i = 0; i < size * (count && step == size ? 1 : elements); i++) {
            double *to = &p->memory[at + e * (count ? step : 0) + i];
            r->has_ints = r->has_ints || whole;
            if (truth && r->switch_count < READ_NUMBERS)
                r->switches[r->switch_count++] = to;
            const bool moves = r->still && t.rows == 1 && declarations_uses(r->sides[0].text, name);
            *to = whole                       ? 2 - (r->variant == 3)
                  : truth                     ? r->variant != 1
                  : moves                     ? 0
                  : i % 4 == 3 && t.rows == 4 ? 1
                                              : number_of(r, path, i);
            if (t.base == GLSL_FLOAT && t.rows == 1 && !moves && r->number_count < READ_NUMBERS)
                r->numbers[r->number_count++] = to;
        }
    bool matrix = t.columns == t.rows && t.columns > 2, vector = t.columns == 1 && t.rows > 2 && t.base == GLSL_FLOAT;
    struct reading_leaf *leaf = matrix || vector ? add_leaf(r, path, one, side, at) : NULL;
    if (leaf) {
        leaf->step = step;
        leaf->count = count;
    }
    return leaf || !(matrix || vector);
}

static bool add_inputs(struct reading *r)
{
    for (int side = 0; side < 2; side++)
        for (int i = 0; i < r->sides[side].symbol_count; i++) {
            const struct glsl_symbol *s = &r->sides[side].symbols[i];
            bool used = declarations_uses(r->sides[side].text, s->name) || s->type.base == GLSL_STRUCT ||
                        (s->name[0] == 'g' && declarations_uses(r->sides[side].text, "ftransform"));
            struct glsl_type t = s->type;
            t.count = (uint16_t)declarations_read_elements(r->sides[0].text, r->sides[1].text, s->name, t.count);
            if (s->storage == GLSL_UNIFORM && used && !add_input(r, side, s->name, t, s->at, 0, 0))
                return false;
            if (s->storage != GLSL_INPUT || side == 1 || !used)
                continue;
            struct reading_leaf *leaf = s->type.rows > 2 ? add_leaf(r, s->name, s->type, 0, s->at) : NULL;
            for (int k = 0; k < 4; k++)
                r->sides[0].memory[s->at + k] = k == 3 ? 1 : r->still && s->type.rows < 3 ? 0 : 0.4 + 0.05 * k;
            if (leaf)
                leaf->attribute = true;
        }
    return true;
}

// Adds the vectors of constants or of three numbers in the source: they may be a light.
static void add_constants(struct reading *r)
{
    for (int side = 0; side < 2; side++)
        for (int i = 0; i < r->sides[side].node_count; i++) {
            struct glsl_program *p = &r->sides[side];
            struct glsl_node *n = &p->nodes[i];
            int numbers = 0, others = 0, inputs = 0;
            double v[4] = {0}, sum = 0;
            for (int c = n->kind == GLSL_CONSTRUCT && n->type.rows > 2 && n->type.columns == 1 ? n->first : -1; c >= 0;
                 c = p->nodes[c].next) {
                const struct glsl_node *x = &p->nodes[c], *inner = x->kind == GLSL_UNARY ? &p->nodes[x->first] : x;
                bool input = x->kind == GLSL_VARIABLE && x->number == GLSL_UNIFORM && glsl_width(x->type) == 1;
                numbers += inner->kind == GLSL_CONSTANT;
                inputs += input;
                others += !input && inner->kind != GLSL_CONSTANT;
                if (numbers + inputs <= 4 && !others)
                    v[numbers + inputs - 1] = input ? 0.5 : inner == x ? p->memory[x->at] : -p->memory[inner->at];
            }
            for (int k = 0; k < 3 && numbers + inputs >= 3; k++)
                sum += v[k] < 0 ? -v[k] : v[k];
            bool grey = !inputs && v[0] == v[1] && v[1] == v[2] && n->type.rows == 4;
            if (others || (inputs != 3 && numbers < 3) || sum == 0 || grey || r->leaf_count == READ_LEAVES)
                continue;
            char name[96];
            snprintf(name, sizeof name, "line %d", n->word < p->text->word_count ? p->text->words[n->word].line : 0);
            struct reading_leaf *leaf = &r->leaves[r->leaf_count++];
            *leaf = (struct reading_leaf){.type = n->type, .at = {-1, -1}, .owner = -1, .node = i, .side = side};
            snprintf(leaf->name, sizeof leaf->name, "%s", name);
            for (int k = 0; k < 4; k++)
                leaf->given[k] = k < numbers + inputs ? v[k] : 1;
            leaf->light = inputs;
            n->kind = GLSL_GIVEN;
            n->given = leaf->given;
        }
}

// --- the first guesses, by the effect of each input

static double *value_of(struct reading *r, struct reading_leaf *leaf, int side)
{
    return leaf->node >= 0       ? (side ? NULL : leaf->given)
           : leaf->at[side] >= 0 ? r->sides[side].memory + leaf->at[side]
                                 : NULL;
}

static void copy_vectors(struct reading *r, double *kept, bool back)
{
    for (int i = 0; i < r->leaf_count; i++)
        for (int side = 0; side < 2; side++) {
            double *v = r->leaves[i].type.columns == 1 ? value_of(r, &r->leaves[i], side) : NULL;
            for (int c = 0; c < r->leaves[i].type.rows && v; c++)
                *(back ? &v[c] : &kept[8 * i + 4 * side + c]) = back ? kept[8 * i + 4 * side + c] : v[c];
        }
}

// Changes a component (or, with component < 0, doubles the vector) and returns which outputs change: bits 0 to 2 are
// the channels, bit 3 is the position.
static unsigned effect(struct reading *r, struct reading_leaf *leaf, int component, int samples)
{
    unsigned changed = 0;
    const int clip = glsl_symbol(&r->sides[0], "gl_Position")->at;
    uint32_t state = 99;
    double *old = arena_array(r->arena, 8 * READ_LEAVES, sizeof *old), numbers[READ_NUMBERS];
    if (!old)
        return 0;
    copy_vectors(r, old, false);
    for (int i = 0; i < r->number_count; i++)
        numbers[i] = *r->numbers[i];
    for (int k = 0; k < samples && !(changed & 6); k++) {
        struct reading_sample *s = r->samples + (k % READ_POINTS) * READ_TURNS + k % READ_TURNS;
        double before[7] = {0}, kept[2][16];
        for (int i = 0; i < r->number_count; i++) { // many samples are inside of all cones, by cosines or by angles
            const bool wide = k % 6 == 1 && (k / 6 % 3 == 0 || (i + k / 6) % 2); // not with a large exponent in all
            *r->numbers[i] = k % 3 == 2 ? -1 + 0.05 * numbers[i] : wide ? 90 + numbers[i] : numbers[i];
        }
        // Vectors without a role get various values, so that some samples are in the cone of a spot light.
        for (int i = 0; i < r->leaf_count && k; i++)
            for (int c = 0; c < 3 && !r->leaves[i].attribute && r->leaves[i].type.columns == 1; c++) {
                double x = noise(&state) * 1.5;
                for (int side = 0; side < 2; side++)
                    if (value_of(r, &r->leaves[i], side))
                        value_of(r, &r->leaves[i], side)[c] = k / 3 % 2 && x < 0 ? -x : x;
            }
        bool ok = reading_evaluate(r, s);
        memcpy(before, s->color, sizeof s->color);
        memcpy(before + 3, r->sides[0].memory + clip, 4 * sizeof *before);
        for (int side = 0; side < 2; side++)
            for (int i = 0, n = glsl_width(leaf->type); i < n && value_of(r, leaf, side); i++) {
                double *v = value_of(r, leaf, side);
                kept[side][i] = v[i];
                if (component < 0 && i < 3)
                    v[i] *= 2;
                else if (i == component)
                    v[i] = 0.37 - 1.5 * v[i];
            }
        ok = reading_evaluate(r, s) && ok;
        for (int i = 0; i < 3 && ok; i++)
            changed |= s->color[i] - before[i] > 1e-9 || before[i] - s->color[i] > 1e-9 ? 1u << i : 0;
        for (int i = 0; i < 4; i++)
            changed |= r->sides[0].memory[clip + i] != before[3 + i] ? 8 : 0;
        for (int side = 0; side < 2; side++)
            if (value_of(r, leaf, side))
                memcpy(value_of(r, leaf, side), kept[side], (size_t)glsl_width(leaf->type) * sizeof(double));
    }
    copy_vectors(r, old, true);
    for (int i = 0; i < r->number_count; i++)
        *r->numbers[i] = numbers[i];
    return changed;
}

static void find_owner(struct reading *r, struct reading_leaf *leaf)
{
    const char *dot = strrchr(leaf->name, '.');
    for (int i = 0; dot && i < r->leaf_count; i++)
        if (strncmp(r->leaves[i].name, leaf->name, (size_t)(dot + 1 - leaf->name)) == 0) {
            leaf->owner = i;
            return;
        }
}

static void list_vector(struct reading *r, struct reading_leaf *leaf)
{
    static const int spaces[2][3] = {{READ_EYE_SPACE, READ_WORLD_SPACE, READ_OBJECT_SPACE},
                                     {READ_WORLD_SPACE, READ_EYE_SPACE, READ_OBJECT_SPACE}};
    bool world = false, paired = false;
    for (int i = 0; i < r->leaf_count; i++) {
        const struct reading_leaf *other = &r->leaves[i];
        world = world || (other->type.columns > 2 && other->choices[0].role == READ_MODEL);
        paired = paired || (other != leaf && other->geometric && other->owner >= 0 && other->owner == leaf->owner);
    }
    const int *order = spaces[world];
    const bool scaled = effect(r, leaf, -1, 100) & 7, plain = leaf->owner < 0 && leaf->node < 0;
    const bool literal = leaf->node >= 0, eye = has(leaf->name, eye_words);
    if (literal)
        choose(r, leaf, READ_OTHER, 0);
    for (int i = 0; i < (literal ? 4 : 2) && (paired || literal) && !scaled; i++)
        choose(r, leaf, READ_AXIS, order[i / 2] | (i & 1) << 2);
    for (int turn = 0; turn < 2; turn++) { // first the roles that suit the effect of a longer vector
        if (plain && eye && turn == 0)
            choose(r, leaf, READ_EYE, READ_WORLD_SPACE);
        for (int i = 0; i < 3 && scaled == (turn == 0); i++) {
            choose(r, leaf, READ_LIGHT, order[i]);
            if (plain && !eye && i == (world ? 0 : 2))
                choose(r, leaf, READ_EYE, READ_WORLD_SPACE);
        }
        for (int i = 0; i < 6 && scaled == (turn == 1); i++)
            choose(r, leaf, READ_TO_LIGHT, order[i / 2] | (i & 1) << 2);
        for (int sign = 0; sign < 2 && !literal && !scaled && !paired && turn == 0; sign++)
            choose(r, leaf, READ_AXIS, order[0] | sign << 2);
    }
    if (!literal)
        choose(r, leaf, READ_OTHER, 0);
    leaf->light = 0;
}

static void list_matrix(struct reading *r, struct reading_leaf *leaf)
{
    static const struct {
        const char *name;
        int role;
    } fixed[] = {{"gl_ModelViewMatrix", READ_MODEL_VIEW},
                 {"gl_ProjectionMatrix", READ_PROJECTION},
                 {"gl_ModelViewProjectionMatrix", READ_ALL},
                 {"gl_NormalMatrix", READ_NORMAL_EYE},
                 {"gl_ModelViewMatrixInverseTranspose", READ_NORMAL_EYE}};
    for (size_t i = 0; i < sizeof fixed / sizeof *fixed; i++)
        if (strcmp(leaf->name, fixed[i].name) == 0) {
            choose(r, leaf, fixed[i].role, 0);
            return;
        }
    bool small = leaf->type.rows == 3, normal = small || has(leaf->name, normal_words);
    static const int others[] = {READ_MODEL_VIEW, READ_MODEL, READ_VIEW, READ_VIEW_INVERSE, READ_ALL};
    for (int i = 0; i < 2 && normal; i++)
        choose(r, leaf, READ_NORMAL_EYE + i, 0);
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        choose(r, leaf, others[i], 0);
    for (int i = 0; i < 2 && !normal; i++)
        choose(r, leaf, READ_NORMAL_EYE + i, 0);
    choose(r, leaf, READ_OTHER, 0);
}

// --- gl_Position

static bool is_clip(struct reading *r)
{
    const double *clip = r->sides[0].memory + glsl_symbol(&r->sides[0], "gl_Position")->at;
    for (int k = 0; k < 3; k++) {
        struct reading_sample *s = r->samples + k * READ_TURNS + k;
        double right[4];
        reading_evaluate(r, s);
        const double *m = s->matrices[READ_ALL], *p = s->positions[2];
        for (int i = 0; i < 4; i++)
            right[i] = m[i] * p[0] + m[4 + i] * p[1] + m[8 + i] * p[2] + m[12 + i];
        for (int i = 0; i < 3; i++) {
            double d = clip[i] * right[3] - right[i] * clip[3];
            if (!(d < 1e-6 && d > -1e-6))
                return false;
        }
    }
    return true;
}

struct chain {
    int leaves[3], roles[3], count;
    bool rows;
};

// Finds the roles of the matrices that lead to gl_Position: all assignments that give the right position.
static int find_chains(struct reading *r, struct chain out[MAX_CHAINS])
{
    int members[3], count = 0, found = 0;
    struct reading_leaf *position = NULL;
    for (int i = 0; i < r->leaf_count; i++)
        r->leaves[i].choices[0].role = r->leaves[i].attribute ? READ_OTHER : r->leaves[i].choices[0].role;
    for (int i = 0; i < r->leaf_count; i++)
        if (r->leaves[i].attribute && !position && (effect(r, &r->leaves[i], 0, 2) & 8))
            position = &r->leaves[i];
    if (!position)
        return 0;
    position->choices[0] = (struct reading_choice){READ_POSITION, 0, false};
    for (int i = 0; i < r->leaf_count; i++) {
        struct reading_leaf *leaf = &r->leaves[i];
        bool leads = !leaf->attribute && leaf->type.columns == 4 && leaf->choices[0].role == READ_OTHER &&
                     (effect(r, leaf, 0, 2) & 8);
        if (leads) {
            if (count == 3)
                return 0;
            members[count++] = i;
        }
    }
    for (int k = 0; k < 432 && found < MAX_CHAINS; k++) {
        struct chain c = {.count = count, .rows = k % 2};
        bool repeated = false, stated;
        for (int i = 0, rest = k / 2; i < 3; i++, rest /= 6) {
            c.roles[i] = READ_MODEL + rest % 6;
            repeated = repeated || (i >= count && rest % 6) ||
                       (!r->has_model && count > 1 && c.roles[i] == READ_MODEL && i < count) ||
                       (i < count && is_excluded(r, &r->leaves[members[i]], c.roles[i], 0, &stated));
            for (int m = 0; m < i && i < count; m++)
                repeated = repeated || c.roles[m] == c.roles[i];
        }
        if (repeated)
            continue;
        r->rows = c.rows;
        for (int i = 0; i < count; i++) {
            c.leaves[i] = members[i];
            r->leaves[members[i]].choices[0].role = (uint8_t)c.roles[i];
        }
        if (is_clip(r))
            out[found++] = c;
    }
    for (int i = 0; i < count; i++)
        r->leaves[members[i]].choices[0].role = READ_OTHER;
    return found;
}

// --- the search

// Numbers the lights. Returns false if the roles contradict each other.
static bool number_lights(struct reading *r)
{
    int eyes = 0, axes = 0, normals = 0;
    r->light_count = 0;
    for (int i = 0; i < r->leaf_count; i++) {
        struct reading_leaf *leaf = &r->leaves[i];
        const int role = leaf->choices[leaf->chosen].role;
        normals += leaf->attribute && role == READ_NORMAL;
        if (!leaf->geometric)
            continue;
        eyes += role == READ_EYE;
        axes += role == READ_AXIS;
        if (role != READ_LIGHT && role != READ_TO_LIGHT)
            continue;
        for (int k = 0; k < i; k++)
            if (leaf->owner >= 0 && r->leaves[k].geometric && r->leaves[k].owner == leaf->owner &&
                (r->leaves[k].choices[r->leaves[k].chosen].role == READ_LIGHT ||
                 r->leaves[k].choices[r->leaves[k].chosen].role == READ_TO_LIGHT))
                return false;
        leaf->light = r->light_count % READ_LIGHTS;
        r->light_count += leaf->count ? leaf->count : 1;
    }
    for (int i = 0; i < r->leaf_count; i++)
        for (int k = 0; k < r->leaf_count; k++)
            if (r->leaves[i].geometric && r->leaves[i].choices[r->leaves[i].chosen].role == READ_AXIS &&
                r->leaves[k].geometric && r->leaves[k].choices[r->leaves[k].chosen].role == READ_LIGHT &&
                (r->leaves[i].owner == r->leaves[k].owner))
                r->leaves[i].light = r->leaves[k].light;
    r->light_count = r->light_count < READ_LIGHTS ? r->light_count : READ_LIGHTS; // further lights repeat the first
    bool vectors = false;
    for (int i = 0; i < r->leaf_count; i++)
        vectors = vectors || (r->leaves[i].geometric && r->leaves[i].node < 0);
    return eyes <= 1 && normals <= 1 && (r->light_count || (!axes && !vectors));
}

// Returns whether a reading is less likely than another.
static bool is_worse(const struct reading_state *a, const struct reading_state *b)
{
    return a->cheap != b->cheap ? b->cheap : a->wrong != b->wrong ? a->wrong > b->wrong : a->mean > b->mean;
}

static struct reading_state state_of(const struct reading *r)
{
    struct reading_state s = {.rows = r->rows, .mean = 1};
    for (int i = 0; i < r->leaf_count; i++) {
        s.chosen[i] = (uint8_t)r->leaves[i].chosen;
        s.roles[i] = r->leaves[i].choices[0].role;
    }
    return s;
}

// Keeps the reading if it is one of the likeliest.
static void keep(struct reading *r, int wrong)
{
    struct reading_state *list = r->nearest, mine = state_of(r);
    int at = r->nearest_count;
    mine.wrong = wrong;
    mine.cheap = wrong < READ_MANY && r->cheap_count < READ_CHEAP;
    r->cheap_count += mine.cheap;
    while (at > 0 && is_worse(&list[at - 1], &mine))
        at--;
    if (at == READ_NEAREST)
        return;
    r->nearest_count += r->nearest_count < READ_NEAREST;
    for (int i = r->nearest_count - 1; i > at; i--)
        list[i] = list[i - 1];
    list[at] = mine;
}

// Keeps the likeliest combinations of choices whose ranks add up to `sum`. Returns true if one of them is right and
// contradicts no name.
static bool search(struct reading *r, int leaf, int sum)
{
    while (leaf < r->leaf_count && r->leaves[leaf].choice_count < 2)
        leaf++;
    if (leaf >= r->leaf_count) {
        bool against = false;
        for (int i = 0; i < r->leaf_count; i++)
            against = against || r->leaves[i].choices[r->leaves[i].chosen].against;
        if (sum || !number_lights(r))
            return false;
        const int wrong = reading_count_wrong(r, false);
        if (wrong == 0 && !(against && r->doubted) && reading_test_forms(r, FORMS_RIGHT)) {
            if (!against)
                return true;
            r->doubt = state_of(r);
            r->doubted = true;
        }
        if (!against)
            keep(r, wrong);
        return false;
    }
    struct reading_leaf *l = &r->leaves[leaf];
    for (int i = 0; i < l->choice_count && i <= sum && !r->spent; i++) {
        l->chosen = i;
        if (search(r, leaf + 1, sum - i))
            return true;
    }
    l->chosen = 0;
    return false;
}

int reading_restore(struct reading *r, const struct reading_state *state)
{
    r->rows = state->rows;
    for (int i = 0; i < r->leaf_count; i++) {
        r->leaves[i].chosen = state->chosen[i];
        r->leaves[i].choices[0].role = state->roles[i];
    }
    number_lights(r);
    return reading_count_wrong(r, false);
}

// Searches all readings, cheapest first, and tests the likeliest.
static enum reading_outcome search_chains(struct reading *r, const struct chain *chains, int count)
{
    for (int sum = 0; sum < MAX_SUM && !r->spent; sum++)
        for (int k = 0; k < count && !r->spent; k++) {
            r->rows = chains[k].rows;
            for (int i = 0; i < chains[k].count; i++)
                r->leaves[chains[k].leaves[i]].choices[0].role = (uint8_t)chains[k].roles[i];
            if (search(r, 0, sum))
                return READING_RIGHT;
        }
    r->steps = r->steps > test_steps ? r->steps : test_steps;
    r->spent = false;
    for (int i = 0; i < r->nearest_count && !r->spent; i++) {
        reading_restore(r, &r->nearest[i]);
        if (reading_test_forms(r, FORMS_RIGHT))
            return READING_RIGHT;
        r->nearest[i].mean = r->mean;
    }
    if (r->doubted) {
        reading_restore(r, &r->doubt);
        return reading_test_forms(r, FORMS_RIGHT) ? READING_AGAINST : READING_NONE;
    }
    for (int i = 1; i < r->nearest_count; i++) { // sorts them by their means
        const struct reading_state state = r->nearest[i];
        int at = i;
        for (; at > 0 && is_worse(&r->nearest[at - 1], &state); at--)
            r->nearest[at] = r->nearest[at - 1];
        r->nearest[at] = state;
    }
    return READING_NONE;
}

static void list_attributes(struct reading *r)
{
    for (int preferred = 1; preferred >= 0; preferred--)
        for (int i = 0; i < r->leaf_count; i++) {
            struct reading_leaf *leaf = &r->leaves[i];
            if (!leaf->attribute || leaf->choices[0].role == READ_POSITION || leaf->choice_count ||
                has(leaf->name, normal_words) != (preferred == 1) || (effect(r, leaf, 0, 90) & 7) == 0)
                continue;
            bool first = true;
            if (strncmp(leaf->name, "gl_", 3) == 0) {
                if (strcmp(leaf->name, "gl_Normal") == 0)
                    choose(r, leaf, READ_NORMAL, 0);
                continue;
            }
            for (int k = 0; k < r->leaf_count; k++)
                first = first && !(r->leaves[k].attribute && r->leaves[k].choice_count &&
                                   r->leaves[k].choices[0].role == READ_NORMAL);
            choose(r, leaf, first ? READ_NORMAL : READ_OTHER, 0);
            choose(r, leaf, first ? READ_OTHER : READ_NORMAL, 0);
        }
}

static bool prepare(struct reading *r, const struct declarations *vertex, const struct declarations *fragment)
{
    const struct declarations *texts[] = {vertex, fragment};
    r->sides = arena_alloc_zeroed(r->arena, 2 * sizeof *r->sides);
    for (int side = 0; side < 2; side++)
        if (!r->sides || !glsl_parse(&r->sides[side], texts[side], side == 0, r->arena)) {
            snprintf(r->reason, sizeof r->reason, "the check does not understand the %s shader: %.100s",
                     side ? "fragment" : "vertex", r->sides ? r->sides[side].unsupported : "");
            return false;
        }
    const struct glsl_symbol *out =
        glsl_symbol(&r->sides[1], declarations_uses(fragment, "gl_FragData") ? "gl_FragData" : "gl_FragColor");
    for (int i = 0; i < r->sides[1].symbol_count; i++)
        if (r->sides[1].symbols[i].storage == GLSL_OUTPUT && out->name[0] == 'g')
            out = &r->sides[1].symbols[i];
    r->output = out->at;
    for (int i = 0; i < r->sides[1].symbol_count; i++) {
        const struct glsl_symbol *in = &r->sides[1].symbols[i],
                                 *from = in->storage == GLSL_INPUT ? glsl_symbol(&r->sides[0], in->name) : NULL;
        if (in->storage == GLSL_INPUT && in->name[0] != 'g' && (!from || from->storage != GLSL_OUTPUT) &&
            declarations_uses(fragment, in->name)) {
            snprintf(r->reason, sizeof r->reason,
                     "the vertex shader does not write '%.60s': another stage is between them", in->name);
            return false;
        }
    }
    return add_inputs(r);
}

// Returns whether a matrix may move the model. Otherwise its vertices are in world space. Only the clear names of a view and
// a projection are evidence, because a shader that forgets the model matrix in its lighting looks the same.
static bool moves_model(struct reading *r)
{
    static const char *const model[] = {"model", "world", "mv", "obj", "gl_", NULL},
                             *const view[] = {"view", "cam", NULL}, *const projection[] = {"proj", "persp", NULL};
    for (int i = 0; i < r->leaf_count; i++)
        if (!r->leaves[i].attribute && r->leaves[i].type.columns > 2) {
            const char *name = r->leaves[i].name;
            bool moves = has(name, model) || has(name, view) == has(name, projection);
            for (int k = 0; k < 4 && !moves; k++)
                moves = effect(r, &r->leaves[i], 5 * k % glsl_width(r->leaves[i].type), 30) & 7;
            if (moves)
                return true;
        }
    return false;
}

static enum reading_outcome find_variant(struct reading *r, const struct declarations *vertex,
                                         const struct declarations *fragment)
{
    struct chain chains[MAX_CHAINS];
    r->leaf_count = r->number_count = r->nearest_count = r->cheap_count = r->switch_count = 0;
    r->doubted = false;
    if (!prepare(r, vertex, fragment))
        return READING_NONE;
    int matrices = 0;
    for (int i = 0; i < r->leaf_count; i++)
        matrices += !r->leaves[i].attribute && r->leaves[i].type.columns > 2;
    r->has_model = matrices != 1;
    if (!make_samples(r))
        return READING_NONE;
    for (int i = 0; i < r->leaf_count; i++)
        if (strncmp(r->leaves[i].name, "gl_", 3) == 0 && r->leaves[i].type.columns > 2)
            list_matrix(r, &r->leaves[i]);
    int count = find_chains(r, chains);
    if (matrices == 2 && count && !moves_model(r)) {
        r->has_model = false;
        if (!make_samples(r))
            return READING_NONE;
        count = find_chains(r, chains);
    }
    if (!count && !r->still) {
        r->still = true;
        return find_variant(r, vertex, fragment);
    }
    if (!count) {
        snprintf(r->reason, sizeof r->reason, "the check does not understand how gl_Position is computed");
        return READING_NONE;
    }
    for (int i = 0; i < chains[0].count; i++)
        r->leaves[chains[0].leaves[i]].choices[0].role = (uint8_t)chains[0].roles[i];
    r->rows = chains[0].rows;
    add_constants(r);
    for (int i = 0; i < r->leaf_count; i++)
        if (!r->leaves[i].attribute && r->leaves[i].type.columns > 2 && !r->leaves[i].choices[0].role)
            list_matrix(r, &r->leaves[i]);
    list_attributes(r);
    for (int i = 0; i < r->leaf_count; i++) {
        struct reading_leaf *leaf = &r->leaves[i];
        unsigned changed = leaf->attribute || leaf->type.columns > 1 ? 0 : effect(r, leaf, 0, 90);
        find_owner(r, leaf);
        leaf->geometric = changed & 6;
        for (int side = 1; side >= 0 && leaf->geometric; side--)
            if (value_of(r, leaf, side))
                memcpy(leaf->original, value_of(r, leaf, side), (size_t)leaf->type.rows * sizeof *leaf->original);
    }
    for (int i = 0; i < r->leaf_count; i++)
        if (r->leaves[i].geometric)
            list_vector(r, &r->leaves[i]);
    for (int side = 0; side < 2; side++)
        if (!(r->dots[side] = arena_alloc_zeroed(r->arena, (size_t)r->sides[side].node_capacity * sizeof **r->dots)))
            return READING_NONE;
    if (!(r->pair = arena_alloc_zeroed(r->arena, 2 * sizeof *r->pair)))
        return READING_NONE;
    return search_chains(r, chains, count);
}

enum reading_outcome reading_find(struct reading *r, const struct declarations *vertex,
                                  const struct declarations *fragment)
{
    enum reading_outcome outcome = READING_NONE;
    int best = 0, last = 0;
    double mean = 2;
    for (int v = 0; v < 3 + r->has_ints && outcome == READING_NONE && !r->reason[0] &&
                    (mean > dark || (v == 1 && r->switch_count));
         v++) {
        r->steps = v ? max_steps / 3 : max_steps;
        r->spent = false;
        r->variant = last = v;
        outcome = find_variant(r, vertex, fragment);
        for (int i = 0; i < r->nearest_count; i++)
            if (r->nearest[i].mean < mean) {
                best = v;
                mean = r->nearest[i].mean;
            }
    }
    if (outcome == READING_RIGHT && r->switch_count) { // takes the other branches
        const struct reading_form form = r->form;
        for (int i = 0; i < r->switch_count; i++)
            *r->switches[i] = !*r->switches[i];
        r->one_way = !reading_test_forms(r, FORMS_RIGHT);
        r->form = form;
    }
    if (outcome == READING_RIGHT && (r->still || r->variant == 3)) {
        snprintf(r->reason, sizeof r->reason,
                 r->still ? "numbers or attributes move the vertices; the shader is right if they are 0, and the check "
                            "does not test other values"
                          : "the shader is right if its integers are 1, and the check does not test other values");
        return READING_NONE;
    }
    if (outcome == READING_NONE && best != last && !r->reason[0]) { // the mistakes are searched with the best values
        r->steps = max_steps;
        r->spent = false;
        r->variant = best;
        find_variant(r, vertex, fragment);
    }
    return outcome;
}

void reading_explain(const struct reading *r, char *out, size_t capacity)
{
    static const char *const spaces[] = {"world space", "eye space", "object space"};
    size_t at = 0;
    out[0] = 0;
    for (int i = 0; i < r->leaf_count && at + 200 < capacity; i++) {
        const struct reading_leaf *leaf = &r->leaves[i];
        const struct reading_choice *c = &leaf->choices[leaf->chosen];
        if (c->role == READ_OTHER)
            continue;
        at += (size_t)snprintf(out + at, capacity - at, "%s%s: %s%s", at ? "; " : "", leaf->name,
                               c->space & 4 ? "from the " : "", reading_role_names[c->role]);
        if (c->role >= READ_LIGHT && c->role <= READ_EYE)
            at += (size_t)snprintf(out + at, capacity - at, " in %s", spaces[c->space & 3]);
    }
}
