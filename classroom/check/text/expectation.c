// expectation.c: determines the terms that shaders must compute, from the declarations of the shaders.
#include "expectation.h"

#include <stdio.h>
#include <string.h>

#include <lambent/check.h>

static bool declares(const struct shader_interface *r, enum uniform_semantic semantic)
{
    return shader_interface_declares(r, semantic);
}

static bool names(const struct shader_interface *r, enum uniform_semantic semantic)
{
    for (const struct contract_name *n = r->contract->names; n->name; n++)
        if (n->semantic == semantic)
            return true;
    return false;
}

// Returns whether the contract contains a name for the semantic, but the shaders declare none.
static bool lacks(const struct shader_interface *r, enum uniform_semantic semantic)
{
    return names(r, semantic) && !declares(r, semantic);
}

// Returns whether the contract defines the colour of undeclared names.
static bool is_fixed(const struct default_color *color) { return color->source != COLOR_OF_SCENE; }

static bool has_number(const struct shader_interface *r, enum uniform_semantic semantic)
{
    return r->constants >> semantic & 1;
}

// --- the possible expectations for each term, the most complete ones first

enum { MAX_CHOICES = 4 };

static int ambient_choices(const struct shader_interface *r, unsigned terms, unsigned out[MAX_CHOICES])
{
    const struct contract_defaults *d = &r->defaults;
    bool product = declares(r, SEMANTIC_AMBIENT_PRODUCT);
    bool declared = names(r, SEMANTIC_KA) ? declares(r, SEMANTIC_KA) : declares(r, SEMANTIC_AMBIENT) || product;
    bool light = declares(r, SEMANTIC_AMBIENT_LIGHT) || declares(r, SEMANTIC_LIGHT_AMBIENT) || product;
    declared = declared || has_number(r, SEMANTIC_KA) || has_number(r, SEMANTIC_LIGHT_AMBIENT) ||
               (light && is_fixed(&d->ambient_color));
    unsigned complete =
        light || is_fixed(&d->light_ambient) || !names(r, SEMANTIC_AMBIENT_LIGHT) ? 0 : EXPECT_WHITE_AMBIENT_LIGHT;
    bool constant = d->ambient_strength.given && !declared; // the exercise uses a number for the strength
    int count = 0;
    if (terms ? terms & LAM_CHECK_TERM_AMBIENT : declared || constant)
        out[count++] = complete;
    if (terms ? !count : !declared)
        out[count++] = EXPECT_NO_AMBIENT;
    return count;
}

static int diffuse_choices(const struct shader_interface *r, unsigned terms, unsigned out[MAX_CHOICES])
{
    const struct contract_defaults *d = &r->defaults;
    bool product = declares(r, SEMANTIC_DIFFUSE_PRODUCT);
    bool surface = declares(r, SEMANTIC_DIFFUSE) || declares(r, SEMANTIC_COLOR) || product;
    bool light = declares(r, SEMANTIC_LIGHT_COLOR);
    bool declared = names(r, SEMANTIC_KD) ? declares(r, SEMANTIC_KD) : surface || light;
    unsigned complete = 0;
    if (!surface && !is_fixed(&d->diffuse_color))
        complete |= EXPECT_WHITE_DIFFUSE | (declares(r, SEMANTIC_KD) ? 0 : EXPECT_FULL_DIFFUSE);
    if (lacks(r, SEMANTIC_LIGHT_COLOR) && !product && !is_fixed(&d->light_color))
        complete |= EXPECT_WHITE_LIGHT;
    int count = 0;
    if (!terms || terms & LAM_CHECK_TERM_DIFFUSE)
        out[count++] = complete;
    // The light's colour may be used only for the highlight.
    if (terms ? !count : !declared || (!surface && !declares(r, SEMANTIC_LIGHT_SPECULAR)))
        out[count++] = EXPECT_NO_DIFFUSE;
    return count;
}

static int specular_choices(const struct shader_interface *r, unsigned terms, unsigned out[MAX_CHOICES])
{
    const struct contract_defaults *d = &r->defaults;
    bool product = declares(r, SEMANTIC_SPECULAR_PRODUCT);
    bool surface = declares(r, SEMANTIC_SPECULAR) || declares(r, SEMANTIC_SPECULAR_COLOR) || product;
    bool light = declares(r, SEMANTIC_LIGHT_SPECULAR);
    bool declared = names(r, SEMANTIC_KS) ? declares(r, SEMANTIC_KS) : surface || light;
    bool has_surface_color =
        names(r, SEMANTIC_SPECULAR) || names(r, SEMANTIC_SPECULAR_PRODUCT) || names(r, SEMANTIC_SPECULAR_COLOR);
    declared = declared || has_number(r, SEMANTIC_KS) || has_number(r, SEMANTIC_SHININESS) || r->physical;
    unsigned white =
        surface || !has_surface_color || is_fixed(&d->specular_color) || r->physical ? 0 : EXPECT_WHITE_SPECULAR;
    if (white && !declares(r, SEMANTIC_KS))
        white |= EXPECT_FULL_SPECULAR;
    int count = 0;
    if (!(r->supports & RULE_NO_SPECULAR) && (!terms || terms & LAM_CHECK_TERM_SPECULAR)) {
        bool light_open = lacks(r, SEMANTIC_LIGHT_SPECULAR) && !product && !is_fixed(&d->light_specular);
        if (light_open && declares(r, SEMANTIC_LIGHT_COLOR))
            out[count++] = white | EXPECT_SPECULAR_LIGHT_AS_DIFFUSE;
        out[count++] = white | (light_open ? EXPECT_WHITE_SPECULAR_LIGHT : 0);
        // tinted and untinted highlights are both correct
        if (!surface && d->specular_color.source == COLOR_OF_DIFFUSE) {
            out[count] = out[count - 1] | EXPECT_WHITE_SPECULAR;
            count++;
        }
    }
    if (terms || r->supports & RULE_NO_SPECULAR ? !count : !declared)
        out[count++] = EXPECT_NO_SPECULAR;
    return count;
}

int expectations_of(const struct shader_interface *r, unsigned terms, unsigned out[MAX_EXPECTATIONS])
{
    const unsigned nothing = EXPECT_NO_AMBIENT | EXPECT_NO_DIFFUSE | EXPECT_NO_SPECULAR;
    unsigned ambient[MAX_CHOICES], diffuse[MAX_CHOICES], specular[MAX_CHOICES];
    int ambient_count = ambient_choices(r, terms, ambient), diffuse_count = diffuse_choices(r, terms, diffuse),
        specular_count = specular_choices(r, terms, specular);
    int count = 0;
    for (int a = 0; a < ambient_count; a++)
        for (int i = 0; i < diffuse_count; i++)
            for (int k = 0; k < specular_count; k++) {
                unsigned whole = ambient[a] | diffuse[i] | specular[k];
                if (terms || (whole & nothing) != nothing)
                    out[count++] = whole;
            }
    return count;
}

bool expectation_permits(const struct shader_interface *r, unsigned terms, const char *fault)
{
    static const struct {
        const char *fault;
        unsigned bit;
    } rows[] = {{"no-ambient", EXPECT_NO_AMBIENT},
                {"no-diffuse", EXPECT_NO_DIFFUSE},
                {"no-specular", EXPECT_NO_SPECULAR},
                {"specular-tinted", EXPECT_WHITE_SPECULAR},
                {"specular-light-as-diffuse", EXPECT_SPECULAR_LIGHT_AS_DIFFUSE}};
    unsigned choices[MAX_EXPECTATIONS];
    int count = expectations_of(r, terms, choices);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        bool with = false, without = false;
        for (int k = 0; k < count && strcmp(fault, rows[i].fault) == 0; k++)
            *(choices[k] & rows[i].bit ? &with : &without) = true;
        if (with && without)
            return true;
    }
    return false;
}

void expectation_apply(unsigned e, struct reference_scene *s)
{
    const lam_rgb white = {1, 1, 1};
    if (e & EXPECT_NO_AMBIENT)
        s->ka = 0;
    if (e & EXPECT_WHITE_DIFFUSE) {
        bool one = s->ambient.r == s->diffuse.r && s->ambient.g == s->diffuse.g && s->ambient.b == s->diffuse.b;
        s->ambient = one ? white : s->ambient; // the contract contains one colour for both terms
        s->diffuse = white;
    }
    if (e & EXPECT_WHITE_SPECULAR)
        s->specular = white;
    if (e & EXPECT_FULL_DIFFUSE)
        s->kd = 1;
    if (e & EXPECT_FULL_SPECULAR)
        s->ks = 1;
    for (int i = 0; i < s->light_count; i++) {
        struct reference_light *light = &s->lights[i];
        if (e & EXPECT_WHITE_LIGHT)
            light->color = white;
        if (e & EXPECT_WHITE_SPECULAR_LIGHT)
            light->specular = white;
        if (e & EXPECT_SPECULAR_LIGHT_AS_DIFFUSE)
            light->specular = light->color;
        if (e & EXPECT_WHITE_AMBIENT_LIGHT) // the sum over all lights
            light->ambient = i ? (lam_rgb){0, 0, 0} : white;
    }
    if (e & EXPECT_NO_DIFFUSE)
        s->kd = 0;
    if (e & EXPECT_NO_SPECULAR)
        s->ks = 0;
}

void expectation_describe(unsigned e, const struct shader_interface *r, unsigned terms, char *out, size_t capacity)
{
    static const struct {
        unsigned bit;
        const char *name;
    } terms_of[] = {{EXPECT_NO_AMBIENT, "ambient"}, {EXPECT_NO_DIFFUSE, "diffuse"}, {EXPECT_NO_SPECULAR, "specular"}},
      white[] = {{EXPECT_WHITE_DIFFUSE, "colour of the surface"},
                 {EXPECT_WHITE_SPECULAR, "colour of the highlight"},
                 {EXPECT_WHITE_LIGHT, "light's diffuse colour"},
                 {EXPECT_WHITE_SPECULAR_LIGHT, "light's specular colour"},
                 {EXPECT_WHITE_AMBIENT_LIGHT, "ambient light"}};
    size_t at = 0;
    out[0] = 0;
    if (!(r->contract->terms & TERM_AMBIENT))
        e &= ~(unsigned)EXPECT_NO_AMBIENT;
    if (!(r->contract->terms & TERM_DIFFUSE))
        e &= ~(unsigned)EXPECT_NO_DIFFUSE;
    if (r->supports & RULE_NO_SPECULAR || !(r->contract->terms & TERM_SPECULAR))
        e &= ~(unsigned)EXPECT_NO_SPECULAR;
    int count = 0;
    for (size_t i = 0; !terms && i < sizeof terms_of / sizeof *terms_of; i++)
        if (e & terms_of[i].bit)
            at += (size_t)snprintf(out + at, capacity - at, "%s%s",
                                   count++ ? ", "
                                           : "not expected, because the shaders declare no name of these "
                                             "terms: ",
                                   terms_of[i].name);
    if (count)
        at += (size_t)snprintf(out + at, capacity - at, "; --terms all requires these terms");
    count = 0;
    for (size_t i = 0; i < sizeof white / sizeof *white; i++)
        if (e & white[i].bit)
            at += (size_t)snprintf(out + at, capacity - at, "%s%s",
                                   count++ ? ", "
                                   : at    ? "; treated as white, because not declared: "
                                           : "treated as white, because not declared: ",
                                   white[i].name);
    if (e & EXPECT_SPECULAR_LIGHT_AS_DIFFUSE)
        snprintf(out + at, capacity - at, "%sthe light has one colour for both terms", at ? "; " : "");
}
