// shader_interface.c: matches the declarations of two shaders with their contract.
#include "shader_interface.h"

#include <stdio.h>
#include <string.h>

#include "fail.h"

bool shader_interface_declares(const struct shader_interface *r, enum uniform_semantic semantic)
{
    const struct declarations *sides[] = {&r->vertex, &r->fragment};
    for (int s = 0; s < 2; s++)
        for (int i = 0; i < sides[s]->count; i++) {
            const struct contract_name *n = sides[s]->items[i].kind == DECLARED_UNIFORM
                                                ? contract_find(r->contract, sides[s]->items[i].name, false, NULL)
                                                : NULL;
            if (n && n->semantic == semantic)
                return true;
        }
    return false;
}

static bool is_light(enum uniform_semantic semantic)
{
    return semantic >= SEMANTIC_LIGHT_POSITION && semantic <= SEMANTIC_LIGHT_AMBIENT;
}

static bool is_material(enum uniform_semantic semantic)
{
    return semantic >= SEMANTIC_AMBIENT && semantic <= SEMANTIC_SHININESS;
}

// Whether a shader declares a uniform of a material or light.
static bool has_lighting(const struct contract *contract, const struct declarations *d)
{
    for (int i = 0; i < d->count; i++) {
        const struct contract_name *n =
            d->items[i].kind == DECLARED_UNIFORM ? contract_find(contract, d->items[i].name, false, NULL) : NULL;
        if (n && (is_material(n->semantic) || is_light(n->semantic)))
            return true;
    }
    return false;
}

static void count_lights(struct shader_interface *r)
{
    const struct declarations *sides[] = {&r->vertex, &r->fragment};
    for (int s = 0; s < 2; s++)
        for (int i = 0; i < sides[s]->count; i++) {
            const struct declaration *d = &sides[s]->items[i];
            const struct contract_name *n =
                d->kind == DECLARED_UNIFORM ? contract_find(r->contract, d->name, false, NULL) : NULL;
            if (n && is_light(n->semantic) && d->count > r->light_count)
                r->light_count = d->count;
        }
}

// Whether the words at `at` match `text`, a list separated by blanks in which "?" matches any word.
static bool words_match(const struct declarations *d, int at, const char *text)
{
    for (; *text; at++) {
        size_t length = strcspn(text, " ");
        if (at >= d->word_count || (!(length == 1 && *text == '?') && (strlen(d->words[at].text) != length ||
                                                                       strncmp(d->words[at].text, text, length) != 0)))
            return false;
        text += length + (text[length] == ' ');
    }
    return true;
}

// A shader printed by `lambent shader` has one loop for each kind of light, with the kind as a constant. Returns the
// restrictions that these loops impose (reference_rule); 0: another shader.
static unsigned lambent_light_rules(const struct declarations *lit)
{
    unsigned rules = 0;
    int from = 0, to = 0;
    for (int i = 0; i < lit->word_count; i++) {
        if (words_match(lit, i, "for ( int i = ? ; i < ? ;")) {
            sscanf(lit->words[i + 5].text, "%d", &from);
            sscanf(lit->words[i + 9].text, "%d", &to);
        } else if (words_match(lit, i, "toward_light ( s . p , light , ? , ? )")) {
            const char *kind = lit->words[i + 8].text;
            unsigned rule = strcmp(kind, "LIGHT_DIRECTIONAL") == 0   ? RULE_DIRECTIONAL
                            : strcmp(kind, "LIGHT_SPOT_CUTOFF") == 0 ? RULE_SPOT
                                                                     : RULE_POINT;
            if (strcmp(lit->words[i + 10].text, "FALLOFF_NONE") == 0)
                rule |= RULE_UNATTENUATED;
            for (int k = from; k < to && k < MAX_SCENE_LIGHTS; k++)
                rules |= rule << (RULE_FIRST + RULE_BITS * k);
        }
    }
    return rules;
}

// False for printed shaders that need inputs which the check cannot provide.
static bool can_be_checked(const struct shader_interface *r, lam_error *error)
{
    static const struct {
        enum declared kind;
        const char *name, *what;
    } unsupported[] = {
        {DECLARED_UNIFORM, "light_list",
         "lights in a texture, which the check does not provide; print it with --lights-in array or block"},
        {DECLARED_INPUT, "provoking_position",
         "the vertices of flat shading in GLSL 120, which the check does not provide; print it with --glsl 330"},
        {DECLARED_INPUT, "front_color", "colours that the application computes: there is no lighting in it to check"}};
    for (int i = 0; r->which == LAM_CONTRACT_LAMBENT && i < 3; i++)
        if (declarations_find(&r->vertex, unsupported[i].kind, unsupported[i].name) ||
            declarations_find(&r->fragment, unsupported[i].kind, unsupported[i].name))
            return fail(error, LAM_UNSUPPORTED, "the shader's '%s' needs %s", unsupported[i].name, unsupported[i].what);
    return true;
}

static bool is_flat(const struct declarations *fragment)
{
    for (int i = 0; i < fragment->count; i++)
        if (fragment->items[i].kind == DECLARED_INPUT && fragment->items[i].flat)
            return true;
    return false;
}

static void apply_lambent_rules(struct shader_interface *r)
{
    const struct declarations *lit = r->vertex_lit ? &r->vertex : &r->fragment;
    unsigned rules = lambent_light_rules(lit), first = rules >> RULE_FIRST & RULE_KIND;
    if (r->which != LAM_CONTRACT_LAMBENT || !rules)
        return;
    r->supports &= ~(unsigned)(NEED_POINT | NEED_DIRECTIONAL | NEED_SPOT);
    r->supports |= first == RULE_DIRECTIONAL ? NEED_DIRECTIONAL
                   : first == RULE_SPOT      ? NEED_POINT | NEED_SPOT
                                             : NEED_POINT;
    if (!declarations_uses(&r->fragment, "gl_FrontFacing"))
        r->supports &= ~(unsigned)NEED_TWO_SIDES;
    r->phong = declarations_uses(lit, "phong_lobe");
    r->supports |= rules;
    r->supports |= declarations_uses(lit, "blinn_phong_lobe") || r->phong ? 0 : RULE_NO_SPECULAR;
    r->supports |= is_flat(&r->fragment) ? RULE_FLAT : 0;
}

// The kinds of light that the shader can have, by the members that it reads.
static unsigned light_kinds(const struct shader_interface *r)
{
    if (r->which == LAM_CONTRACT_NYU)
        return shader_interface_declares(r, SEMANTIC_LIGHT_POSITION) ? NEED_POINT : NEED_DIRECTIONAL;
    if (r->which == LAM_CONTRACT_LAMBENT) {
        const struct declarations *lit = r->vertex_lit ? &r->vertex : &r->fragment;
        int cone = 0, attenuation = 0, position = 0;
        for (int i = 0; i < lit->word_count; i++) // read, not only declared: lights[i].cone
            if (lit->words[i].is_member) {
                cone += strcmp(lit->words[i].text, "cone") == 0;
                attenuation += strcmp(lit->words[i].text, "attenuation") == 0;
                position += strcmp(lit->words[i].text, "position") == 0;
            }
        return cone ? NEED_SPOT | NEED_POINT : attenuation || position ? NEED_POINT : NEED_DIRECTIONAL;
    }
    return NEED_POINT | NEED_DIRECTIONAL;
}

bool shader_interface_make(struct shader_interface *r, const char *vertex, const char *fragment,
                           lam_check_contract which, lam_error *error)
{
    *r = (struct shader_interface){.which = which};
    if (!declarations_read(&r->vertex, vertex ? vertex : "", true, error) ||
        !declarations_read(&r->fragment, fragment, false, error)) {
        shader_interface_free(r);
        return false;
    }
    r->contract =
        which == LAM_CONTRACT_AUTO ? contract_recognise(&r->vertex, &r->fragment, &r->which) : contract_of(which);
    if (!r->contract) {
        const struct declarations *sides[] = {&r->vertex, &r->fragment};
        char found[200] = "";
        for (int s = 0; s < 2; s++)
            for (int i = 0; i < sides[s]->count && strlen(found) < 120; i++)
                if (sides[s]->items[i].kind == DECLARED_UNIFORM)
                    snprintf(found + strlen(found), sizeof found - strlen(found), "%s%.40s", found[0] ? ", " : "",
                             sides[s]->items[i].name);
        shader_interface_free(r);
        return fail(error, LAM_BAD_ARGUMENT,
                    "no uniform or attribute of the shader has a name of a known contract (found %s); write "
                    "--contract lambent, pittsburgh, oregon or nyu, and see `lambent check --list`",
                    found[0] ? found : "none");
    }
    if (!can_be_checked(r, error)) {
        shader_interface_free(r);
        return false;
    }
    r->vertex_lit = vertex && vertex[0] && !has_lighting(r->contract, &r->fragment);
    count_lights(r);
    r->supports = r->contract->supports;
    unsigned kinds = NEED_POINT | NEED_DIRECTIONAL | NEED_SPOT;
    r->supports = (r->supports & ~kinds) | (r->supports & kinds & light_kinds(r));
    if (r->light_count < 2)
        r->supports &= ~(unsigned)NEED_LIGHTS;
    r->supports |= r->vertex_lit ? NEED_VERTEX_LIT : 0;
    if (!shader_interface_declares(r, SEMANTIC_FLAT))
        r->supports &= ~(unsigned)NEED_FLAT;
    apply_lambent_rules(r);
    return true;
}

void shader_interface_free(struct shader_interface *r)
{
    declarations_free(&r->vertex);
    declarations_free(&r->fragment);
    *r = (struct shader_interface){0};
}
