// contract_read.c: reads a contract from its JSON file.
#include "contract.h"

#include <stdlib.h>
#include <string.h>

#include "fail.h"
#include "json_parse.h"

static bool read_terms(struct contract_reader *r, const json_t *root)
{
    static const struct json_choice words[] = {
        {"ambient", TERM_AMBIENT}, {"diffuse", TERM_DIFFUSE}, {"specular", TERM_SPECULAR}, {NULL, 0}};
    const json_t *list = json_object_get(root, "terms");
    const struct place *place = KEY_OF(NULL, "terms");
    r->contract->terms = TERM_AMBIENT | TERM_DIFFUSE | TERM_SPECULAR;
    if (!list)
        return true;
    if (!json_is_array(list) || !json_array_size(list))
        return json_unexpected(&r->json, place, list, "a list of ambient, diffuse and specular");
    r->contract->terms = 0;
    for (size_t i = 0; i < json_array_size(list); i++) {
        int term = 0;
        if (!json_choice_of(&r->json, ELEMENT_OF(place, i), json_array_get(list, i), words, &term))
            return false;
        r->contract->terms |= (unsigned)term;
    }
    return true;
}

static bool read_demands(struct contract_reader *r, const json_t *root)
{
    static const struct json_choice words[] = {{"optional", 0}, {"required", 1}, {NULL, 0}};
    static const struct {
        const char *key;
        enum contract_demand demand;
    } rows[] = {{"gate", DEMAND_GATE}, {"unit_normals", DEMAND_UNIT_NORMALS}, {"bare_ambient", DEMAND_BARE_AMBIENT}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        int required = 0;
        if (!json_take_word(&r->json, NULL, root, rows[i].key, words, &required))
            return false;
        r->contract->demands |= required ? (unsigned)rows[i].demand : 0;
    }
    return true;
}

// Reads the weight of each scene in the grade.
static bool read_weights(struct contract_reader *r, const json_t *root)
{
    const json_t *object = json_object_get(root, "weights");
    const struct place *place = KEY_OF(NULL, "weights");
    const char *names[MAX_WEIGHTS + 1] = {NULL};
    double *weights = arena_alloc_zeroed(r->arena, MAX_WEIGHTS * sizeof *weights);
    if (!weights)
        return contract_no_memory(r);
    r->contract->weights = weights;
    for (int i = 0; i < MAX_WEIGHTS; i++) {
        weights[i] = 1;
        names[i] = i < reference_scene_count ? reference_scenes[i].name : NULL;
    }
    if (object && !json_check_keys(&r->json, place, object, names))
        return false;
    for (int i = 0; object && names[i]; i++)
        if (!json_take_number(&r->json, place, object, names[i], 0, 1000, &weights[i]))
            return false;
    return true;
}

static bool has(const struct contract *c, enum uniform_semantic semantic)
{
    for (const struct contract_name *n = c->names; n->name; n++)
        if (n->semantic == semantic)
            return true;
    return false;
}

static bool has_any(const struct contract *c, const enum uniform_semantic *list)
{
    for (; *list != SEMANTIC_NONE; list++)
        if (has(c, *list))
            return true;
    return false;
}

// Sets the values of inputs for which neither the shader nor the contract has a name: no attenuation, strengths of 1,
// white colours. Products of colours include the strengths.
static void complete_defaults(struct contract *c)
{
    static const enum uniform_semantic attenuations[] = {SEMANTIC_ATTENUATION, SEMANTIC_ATTENUATION_CONSTANT,
                                                         SEMANTIC_ATTENUATION_LINEAR, SEMANTIC_ATTENUATION_QUADRATIC,
                                                         SEMANTIC_NONE};
    struct contract_defaults *d = &c->defaults;
    const struct {
        struct default_color *color;
        enum uniform_semantic names[5];
    } colors[] = {
        {&d->ambient_color, {SEMANTIC_AMBIENT, SEMANTIC_AMBIENT_PRODUCT, SEMANTIC_LIGHT_AMBIENT_PRODUCT}},
        {&d->diffuse_color, {SEMANTIC_DIFFUSE, SEMANTIC_DIFFUSE_PRODUCT, SEMANTIC_COLOR}},
        {&d->specular_color, {SEMANTIC_SPECULAR, SEMANTIC_SPECULAR_PRODUCT, SEMANTIC_SPECULAR_COLOR}},
        {&d->light_color, {SEMANTIC_LIGHT_COLOR, SEMANTIC_DIFFUSE_PRODUCT}},
        {&d->light_specular, {SEMANTIC_LIGHT_SPECULAR, SEMANTIC_SPECULAR_PRODUCT}},
        {&d->light_ambient,
         {SEMANTIC_LIGHT_AMBIENT, SEMANTIC_AMBIENT_LIGHT, SEMANTIC_AMBIENT_PRODUCT, SEMANTIC_LIGHT_AMBIENT_PRODUCT}}};
    const struct {
        enum uniform_semantic strength;
        struct default_number *value;
    } strengths[] = {
        {SEMANTIC_KA, &d->ambient_strength}, {SEMANTIC_KD, &d->diffuse_strength}, {SEMANTIC_KS, &d->specular_strength}};
    if (!d->has_attenuation && !has_any(c, attenuations)) {
        d->has_attenuation = true;
        d->attenuation[0] = 1;
    }
    for (size_t i = 0; i < sizeof strengths / sizeof *strengths; i++)
        if (!has(c, strengths[i].strength) && !strengths[i].value->given)
            *strengths[i].value = (struct default_number){true, 1};
    for (size_t i = 0; i < sizeof colors / sizeof *colors; i++)
        if (colors[i].color->source == COLOR_OF_SCENE && !has_any(c, colors[i].names))
            *colors[i].color = (struct default_color){COLOR_GIVEN, {1, 1, 1}};
}

// Returns the space of the first name that belongs to a light. If there is no such name, the result is the space of the
// default light or, without a default light, the space in which lighting is computed.
static lam_light_frame light_frame_of(const struct contract *c)
{
    const struct contract_defaults *d = &c->defaults;
    for (const struct contract_name *n = c->names; n->name; n++)
        if (n->group >= 0 && role_of(n->semantic)->uses & ROLE_IN_SPACE)
            return n->space;
    return d->has_direction || d->has_position ? (lam_light_frame)d->light_space : c->space;
}

// Computes the members that depend on the contract's names.
static bool complete(struct contract_reader *r, bool alpha, bool two_sided)
{
    struct contract *c = r->contract;
    const struct contract_defaults *d = &c->defaults;
    c->light_frame = light_frame_of(c);
    bool position = has(c, SEMANTIC_LIGHT_POSITION) || has(c, SEMANTIC_LIGHT_X),
         direction = has(c, SEMANTIC_LIGHT_DIRECTION) || has(c, SEMANTIC_LIGHT_TRAVEL) || d->has_direction;
    position = position || d->has_position;
    c->has_attenuation = has(c, SEMANTIC_ATTENUATION) || has(c, SEMANTIC_ATTENUATION_CONSTANT) ||
                         has(c, SEMANTIC_ATTENUATION_LINEAR) || has(c, SEMANTIC_ATTENUATION_QUADRATIC) ||
                         (d->has_attenuation && (d->attenuation[1] > 0 || d->attenuation[2] > 0));
    complete_defaults(c);
    c->material_strengths = has(c, SEMANTIC_KA) || has(c, SEMANTIC_KD) || has(c, SEMANTIC_KS);
    c->supports = (c->terms & TERM_AMBIENT ? NEED_AMBIENT : 0) | (c->has_attenuation ? NEED_ATTENUATION : 0) |
                  (position ? NEED_POINT : 0) | (direction ? NEED_DIRECTIONAL : 0) |
                  (has(c, SEMANTIC_CONE) || has(c, SEMANTIC_CUTOFF) ? NEED_SPOT : 0) | (alpha ? NEED_ALPHA : 0) |
                  (two_sided ? NEED_TWO_SIDES : 0) | (has(c, SEMANTIC_SHININESS) ? NEED_SHININESS : 0) |
                  (has(c, SEMANTIC_FLAT) ? NEED_FLAT : 0);
    for (const struct contract_name *n = c->names; n->name; n++) {
        if (n->semantic == SEMANTIC_LIGHT_POSITION && strcmp(n->type, "vec4") == 0)
            c->supports |= NEED_DIRECTIONAL; // w may be 0
        if (n->group >= 0 && strstr(n->name, "[]"))
            c->supports |= NEED_LIGHTS;
    }
    if (c->reflection == LAM_REFLECTION_GGX && !has(c, SEMANTIC_METALLIC) && !has(c, SEMANTIC_ROUGHNESS))
        return json_fail(&r->json, KEY_OF(NULL, "uniforms"),
                         "found no name with the role metallic or roughness; the highlight metallic-roughness needs "
                         "one of these roles");
    bool drawn = has(c, SEMANTIC_POSITION);
    for (const char *const *word = c->built_ins; *word; word++)
        drawn = drawn || strcmp(*word, "gl_Vertex") == 0;
    if (!drawn)
        return json_fail(&r->json, KEY_OF(NULL, "attributes"),
                         "found no name with the role position, and no gl_Vertex in built_ins");
    return position || direction ||
           json_fail(&r->json, KEY_OF(NULL, "uniforms"),
                     "found no light: expected a name with the role light_position, light_x, light_direction or "
                     "light_travel, or light_direction in undeclared");
}

static bool read_root(struct contract_reader *r, const json_t *root)
{
    static const char *const keys[] = {
        "contract",     "name",         "title",      "glsl",       "space",    "terms",     "highlight",
        "alpha",        "two_sided",    "printed",    "attributes", "uniforms", "built_ins", "varyings",
        "outputs",      "constants",    "undeclared", "prefix",     "physical", "maps",      "gate",
        "unit_normals", "bare_ambient", "strengths",  "comment",    "weights",  NULL};
    static const struct json_choice highlights[] = {{"phong", LAM_REFLECTION_PHONG},
                                                    {"blinn-phong", LAM_REFLECTION_BLINN_PHONG},
                                                    {"metallic-roughness", LAM_REFLECTION_GGX},
                                                    {"toon", LAM_REFLECTION_TOON},
                                                    {"gooch", LAM_REFLECTION_GOOCH},
                                                    {NULL, 0}};
    static const struct json_choice spaces[] = {{"eye", LAM_FRAME_CAMERA},
                                                {"world", LAM_FRAME_WORLD},
                                                {"object", LAM_FRAME_OBJECT},
                                                {NULL, 0}},
                                    strengths[] = {{"given", false}, {"any", true}, {NULL, 0}};
    struct contract *c = r->contract;
    double version = 0;
    int highlight = LAM_REFLECTION_BLINN_PHONG, space = LAM_FRAME_CAMERA, any = false;
    const char *name = NULL, *title = NULL;
    bool alpha = false, two_sided = false;
    if (!json_check_keys(&r->json, NULL, root, keys))
        return false;
    if (!json_object_get(root, "contract"))
        return json_fail(&r->json, NULL, "the key 'contract' is missing: \"contract\": 1 marks a contract file");
    if (!json_take_number(&r->json, NULL, root, "contract", 1, 1, &version) ||
        !json_take_text(&r->json, NULL, root, "name", &name) ||
        !json_take_text(&r->json, NULL, root, "title", &title) ||
        !json_take_word(&r->json, NULL, root, "space", spaces, &space) ||
        !json_take_word(&r->json, NULL, root, "highlight", highlights, &highlight) ||
        !json_take_word(&r->json, NULL, root, "strengths", strengths, &any) ||
        !json_take_bool(&r->json, NULL, root, "alpha", &alpha) ||
        !json_take_bool(&r->json, NULL, root, "two_sided", &two_sided) ||
        !json_take_bool(&r->json, NULL, root, "printed", &c->printed))
        return false;
    if (!name)
        return json_fail(&r->json, NULL, "the key 'name' is missing, expected the contract's name for reports");
    c->name = arena_string(r->arena, name);
    c->title = arena_string(r->arena, title ? title : name);
    if (!c->name || !c->title)
        return contract_no_memory(r);
    if (space == LAM_FRAME_OBJECT && !any)
        return json_fail(&r->json, KEY_OF(NULL, "space"), "object needs \"strengths\": \"any\"");
    c->space = (lam_light_frame)space;
    c->reflection = (lam_reflection)highlight;
    c->any_strengths = any != 0;
    const json_t *versions = json_object_get(root, "glsl");
    if (versions && !contract_read_list(r, KEY_OF(NULL, "glsl"), versions, ", ", false, false, &c->versions))
        return false;
    c->versions = c->versions ? c->versions : "";
    const json_t *outputs = json_object_get(root, "outputs");
    if (outputs && !contract_read_list(r, KEY_OF(NULL, "outputs"), outputs, " ", true, true, &c->outputs))
        return false;
    return contract_check_comment(r, NULL, root) && read_weights(r, root) && read_terms(r, root) &&
           read_demands(r, root) && contract_read_names(r, root) && contract_read_varyings(r, root) &&
           contract_read_defaults(r, root) && contract_read_constants(r, root) && contract_read_prefix(r, root) &&
           contract_read_physical(r, root) && contract_read_maps(r, root) && complete(r, alpha, two_sided);
}

lam_check_contract *lam_check_contract_read(const char *text, size_t size, const char *file, lam_error *error)
{
    lam_check_contract *out = calloc(1, sizeof *out);
    lam_error unused;
    if (!out)
        return fail_memory(error, sizeof *out), NULL;
    arena_start(&out->arena, NULL);
    struct contract_reader r = {
        .json = {.file = file ? file : "contract", .error = error ? error : &unused, .text = text, .size = size},
        .arena = &out->arena,
        .contract = &out->contract};
    json_t *root = json_parse(text, size, r.json.file, NULL, r.json.error);
    bool ok = root && ((out->contract.text = arena_string_of(&out->arena, text, size)) || contract_no_memory(&r));
    ok = ok && read_root(&r, root);
    uint64_t hash = 14695981039346656037u; // FNV-1a
    for (size_t i = 0; i < size; i++)
        hash = (hash ^ (unsigned char)text[i]) * 1099511628211u;
    out->contract.hash = hash;
    json_decref(root);
    if (ok)
        return out;
    lam_check_contract_free(out);
    return NULL;
}

void lam_check_contract_free(lam_check_contract *contract)
{
    if (contract)
        arena_free(&contract->arena);
    free(contract);
}
