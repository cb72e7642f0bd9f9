// interpretations.c: lists the possible interpretations of a shader from the words in its source.
#include "interpretations.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "number.h"

static const struct fault *row_of(const char *id)
{
    for (int i = 0; i < fault_count; i++)
        if (strcmp(faults[i].id, id) == 0)
            return &faults[i];
    return NULL;
}

bool interpretations_use(const struct run *r, const char *word)
{
    return declarations_uses(&r->interface.vertex, word) || declarations_uses(&r->interface.fragment, word);
}

static bool read_literal(const char *text, double *out)
{
    const uint8_t *end = (const uint8_t *)text + strcspn(text, "fF");
    return text[0] && strchr("0123456789", text[0]) && number_double((const uint8_t *)text, end, out) == end;
}

static void add_exponent(float out[MAX_EXPONENTS], int *count, double x)
{
    bool known = x < 2 || x > 4096 || *count == MAX_EXPONENTS;
    for (int k = 0; k < *count; k++)
        known = known || (double)out[k] == x;
    if (!known)
        out[(*count)++] = (float)x;
}

// Gets the second argument of the pow() whose opening parenthesis is word `at`: a number, or a variable that is set to
// a number.
static bool read_exponent(const struct declarations *d, int at, double *out)
{
    int depth = 0;
    for (int i = at; i + 2 < d->word_count; i++) {
        const char *text = d->words[i].text;
        depth += (strcmp(text, "(") == 0) - (strcmp(text, ")") == 0);
        if (depth == 0)
            return false;
        if (depth != 1 || strcmp(text, ",") != 0 || strcmp(d->words[i + 2].text, ")") != 0)
            continue;
        if (read_literal(d->words[i + 1].text, out))
            return true;
        for (int k = 0; k + 2 < d->word_count; k++)
            if (strcmp(d->words[k].text, d->words[i + 1].text) == 0 && strcmp(d->words[k + 1].text, "=") == 0 &&
                read_literal(d->words[k + 2].text, out))
                return true;
        return false;
    }
    return false;
}

// Returns the factor of the exponent in pow(x, shininess * factor), or 0 if there is none.
static float find_factor(const struct declarations *d)
{
    for (int i = 0; i + 2 < d->word_count; i++) {
        int depth = 0;
        bool second = false;
        for (int k = i + 1; strcmp(d->words[i].text, "pow") == 0 && k + 1 < d->word_count; k++) {
            const char *text = d->words[k].text;
            double x = 0;
            depth += (strcmp(text, "(") == 0) - (strcmp(text, ")") == 0);
            if (depth == 0)
                break;
            second = second || (depth == 1 && strcmp(text, ",") == 0);
            if (second && read_literal(text, &x) && x > 0 && strcmp(d->words[k - 1].text, "/") == 0)
                return (float)(1 / x);
            if (second && read_literal(text, &x) && x > 0 &&
                (strcmp(d->words[k - 1].text, "*") == 0 || strcmp(d->words[k + 1].text, "*") == 0))
                return (float)x;
        }
    }
    return 0;
}

// Finds the numbers in the source that may be the exponent.
static int find_exponents(const struct run *r, float out[MAX_EXPONENTS])
{
    const struct declarations *d = r->interface.vertex_lit ? &r->interface.vertex : &r->interface.fragment;
    int count = 0;
    if (shader_interface_uses(&r->interface, SEMANTIC_SHININESS)) {
        out[0] = 0;
        return 1;
    }
    for (int i = 0; i + 1 < d->word_count; i++) {
        double x = 0;
        if (strcmp(d->words[i].text, "pow") == 0 && read_exponent(d, i + 1, &x))
            add_exponent(out, &count, x);
    }
    // The exponent may be passed as a parameter of a function.
    for (int i = 0; i < d->word_count && !count && interpretations_use(r, "pow"); i++) {
        double x = 0;
        if (read_literal(d->words[i].text, &x))
            add_exponent(out, &count, x);
    }
    return count;
}

static void add_bit(struct interpretation *g, enum fault_bit bit)
{
    g->set.words[bit / 64] |= (uint64_t)1 << (bit % 64);
}

static void add_form(const struct run *r, struct interpretation *g, const struct fault *form)
{
    if (g->form_count < MAX_FORMS && fault_is_style(form, &r->interface)) {
        g->set = fault_set_add(&g->set, form);
        g->forms[g->form_count++] = form;
    }
}

static bool is_attenuated(const struct run *r)
{
    return shader_interface_uses(&r->interface, SEMANTIC_ATTENUATION_LINEAR) ||
           shader_interface_uses(&r->interface, SEMANTIC_ATTENUATION_QUADRATIC) || interpretations_use(r, "length") ||
           interpretations_use(r, "distance");
}

static bool has_direction(const struct shader_interface *interface)
{
    return shader_interface_uses(interface, SEMANTIC_LIGHT_DIRECTION) ||
           shader_interface_uses(interface, SEMANTIC_LIGHT_TRAVEL) || interface->defaults.has_direction ||
           (interface->supports & NEED_DIRECTIONAL);
}

int interpretations_list(const struct run *r, struct interpretation out[MAX_INTERPRETATIONS])
{
    enum { BARE, LONG_NORMAL, BLINN, DIMS, FALLOFF, REVERSED, VIEWER, DECODED, EXPONENT, CHOICES };
    const struct shader_interface *interface = &r->interface;
    float exponents[MAX_EXPONENTS];
    int exponent_count = find_exponents(r, exponents), count = 0, combinations = 1;
    const bool highlight = exponent_count > 0, attenuated = is_attenuated(r);
    const int sizes[CHOICES] = {
        [BARE] = highlight ? 2 : 1,
        [LONG_NORMAL] = interface->vertex_lit ? 1 : 2,
        [BLINN] = highlight ? 2 : 1,
        [DIMS] = attenuated ? 2 : 1,
        [FALLOFF] = attenuated ? 3 : 1,
        [REVERSED] = has_direction(interface) ? 2 : 1,
        [VIEWER] = highlight && !shader_interface_uses(interface, SEMANTIC_EYE_POSITION) ? 2 : 1,
        [DECODED] = declarations_uses(&interface->fragment, "2.2") ? 2 : 1,
        [EXPONENT] = highlight ? exponent_count : 1,
    };
    for (int i = 0; i < CHOICES; i++)
        combinations *= sizes[i];
    for (int k = 0; k < combinations && count < MAX_INTERPRETATIONS; k++) {
        int chosen[CHOICES];
        for (int i = 0, n = k; i < CHOICES; n /= sizes[i++])
            chosen[i] = n % sizes[i];
        struct interpretation *g = &out[count++];
        *g = (struct interpretation){.reflection = chosen[BLINN] ? LAM_REFLECTION_BLINN_PHONG : LAM_REFLECTION_PHONG,
                                     .has_highlight = highlight,
                                     .decoded = chosen[DECODED]};
        g->set.constant = highlight ? exponents[chosen[EXPONENT]] : 0;
        if (highlight && g->set.constant == 0)
            g->set.factor = find_factor(interface->vertex_lit ? &interface->vertex : &interface->fragment);
        if (chosen[BARE])
            add_form(r, g, row_of("no-gate"));
        if (chosen[LONG_NORMAL])
            add_form(r, g, row_of("normal-unit-late"));
        if (chosen[DIMS])
            add_form(r, g, row_of("ambient-attenuated"));
        if (chosen[FALLOFF])
            add_bit(g, chosen[FALLOFF] == 1 ? BIT_INVERSE_SQUARE : BIT_INVERSE_DISTANCE);
        if (chosen[REVERSED])
            add_bit(g, BIT_DIRECTION_REVERSED);
        if (chosen[VIEWER])
            add_bit(g, BIT_VIEWER_INFINITE);
    }
    return count;
}

// Returns whether a fault concerns only the geometry. The fitted factors compensate for faults of colours and
// strengths, and alpha does not matter.
static bool is_geometric(const struct fault *row)
{
    static const enum fault_bit others[] = {BIT_KD_KS_SWAPPED,
                                            BIT_KA_KD_SWAPPED,
                                            BIT_SPECULAR_TINTED,
                                            BIT_SPECULAR_AS_DIFFUSE,
                                            BIT_BARE_KA,
                                            BIT_BARE_KD,
                                            BIT_BARE_KS,
                                            BIT_WHITE_LIGHT,
                                            BIT_SPECULAR_LIGHT_AS_DIFFUSE,
                                            BIT_ENCODED,
                                            BIT_ALPHA_ONE,
                                            BIT_ALPHA_SUM,
                                            BIT_AMBIENT_EACH_LIGHT,
                                            BIT_NO_AMBIENT,
                                            BIT_NO_DIFFUSE,
                                            BIT_NO_SPECULAR,
                                            BIT_VERTEX_CLAMPED,
                                            BIT_FLIP,
                                            BIT_OTHER_LOBE,
                                            BIT_DIRECTION_REVERSED,
                                            BIT_AMBIENT_TIMES_D,
                                            BIT_AMBIENT_TWICE,
                                            BIT_AMBIENT_HALVED,
                                            BIT_DIFFUSE_TWICE,
                                            BIT_DIFFUSE_HALVED,
                                            BIT_SPECULAR_TWICE,
                                            BIT_SPECULAR_HALVED,
                                            BIT_LIGHTS_AVERAGED,
                                            BIT_LIGHTS_MEAN,
                                            BIT_LIGHTS_MULTIPLIED,
                                            BIT_CHANNELS_REVERSED,
                                            BIT_RED_EVERYWHERE,
                                            BIT_USE_REINHARD,
                                            BIT_USE_EXPONENTIAL,
                                            BIT_USE_ACES};
    for (int i = 0; i < MAX_FAULT_BITS && row->bits[i]; i++)
        for (size_t k = 0; k < sizeof others / sizeof *others; k++)
            if (row->bits[i] == others[k])
                return false;
    return true;
}

bool interpretations_allow_fault(const struct fault *row)
{
    return is_geometric(row) && !row->style && !row->demand && !row->whole_term && !row->fit && row->factor == 0 &&
           !row->maps;
}

// Returns whether word `i` calls a function that the source does not define and that the interpretations do not
// explain.
static bool calls_other(const struct declarations *d, int i)
{
    static const char *const known =
        " if for while return main normalize dot max min clamp pow reflect vec2 vec3 vec4 mat3 mat4 "
        "float int abs sqrt inversesqrt inverse transpose location layout binding defined ";
    const char *name = d->words[i].text;
    char padded[70];
    snprintf(padded, sizeof padded, " %s ", name);
    bool other = word_is_name(name) && word_is(d, i + 1, "(") && !strstr(known, padded);
    for (int k = 1; k < d->word_count && other; k++) // in the definition of a function, the name follows a type
        other = !word_is(d, k, name) || d->words[k].depth > 0 || !isalpha((unsigned char)d->words[k - 1].text[0]);
    return other;
}

// Returns whether word `i` compares with a number other than 0, outside of a loop's head.
static bool compares(const struct declarations *d, int i)
{
    bool compared = word_is(d, i, "<") || word_is(d, i, ">");
    double zero = 1;
    for (int k = i; k > 0 && k > i - 10; k--)
        compared = compared && !word_is(d, k, "for");
    int after = i + 1 + word_is(d, i + 1, "=");
    return compared && !(((after < d->word_count && read_literal(d->words[after].text, &zero)) ||
                          read_literal(d->words[i - 1].text, &zero)) &&
                         zero == 0);
}

// Returns whether word `i` divides. A division by w belongs to a projection; a division by a distance may be an
// attenuation.
static bool divides(const struct declarations *d, int i)
{
    double divisor;
    return word_is(d, i, "/") && !read_literal(d->words[i + 1].text, &divisor) &&
           !(word_is(d, i + 2, ".") && word_is(d, i + 3, "w"));
}

bool interpretations_are_plain(const struct run *r)
{
    const struct declarations *sides[] = {&r->interface.vertex, &r->interface.fragment};
    if (strstr(r->interface.contract->title, "exclusion"))
        return false;
    for (int s = 0; s < 2; s++)
        for (int i = 1; i + 1 < sides[s]->word_count; i++) {
            double x = 0;
            bool rim = read_literal(sides[s]->words[i].text, &x) && x == 1 && word_is(sides[s], i + 1, "-");
            if (rim || calls_other(sides[s], i) || compares(sides[s], i) || divides(sides[s], i) ||
                word_is(sides[s], i, "discard") || word_is(sides[s], i, "flat") ||
                word_is(sides[s], i, "gl_FrontFacing"))
                return false;
        }
    return true;
}
