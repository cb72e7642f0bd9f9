// contract.c: looks up names in a contract, and recognises the contract of a pair of shaders.
#include "contract.h"

#include <stdio.h>
#include <string.h>

#include "contract_texts.inc"
#include "fail.h"

#include <lambent/fields.h>

// --- the shipped contracts

static const struct {
    const char *name, *text;
} shipped[] = {
    {"lambent", text_lambent_json},
    {"pittsburgh", text_pittsburgh_json},
    {"oregon", text_oregon_json},
    {"nyu", text_nyu_json},
    {"learnopengl", text_learnopengl_json},
    {"angel", text_angel_json},
    {"mdn", text_mdn_json},
    {"threejs", text_threejs_json},
    {"learnopengl-pbr", text_learnopengl_pbr_json},
    {"gltf", text_gltf_json},
    {"webglfundamentals", text_webglfundamentals_json},
    {"feup", text_feup_json},
    {"stthomas", text_stthomas_json},
    {"chile", text_chile_json},
    {"glsl120", text_glsl120_json},
};
enum { SHIPPED = sizeof shipped / sizeof *shipped };

const char *lam_check_contract_shipped(int index) { return index >= 0 && index < SHIPPED ? shipped[index].name : NULL; }

const char *lam_check_contract_text(const char *name)
{
    for (int i = 0; name && i < SHIPPED; i++)
        if (strcmp(shipped[i].name, name) == 0)
            return shipped[i].text;
    return NULL;
}

bool contracts_read(lam_check_contract *out[MAX_CONTRACTS], int *count, lam_error *error)
{
    for (*count = 0; *count < SHIPPED; (*count)++) {
        const char *text = shipped[*count].text;
        out[*count] = lam_check_contract_read(text, strlen(text), shipped[*count].name, error);
        if (!out[*count])
            return false;
    }
    return true;
}

// --- the public contents of a contract

const char *lam_check_contract_name(const lam_check_contract *contract) { return contract->contract.name; }
const char *lam_check_contract_title(const lam_check_contract *contract) { return contract->contract.title; }

static const char *space_name(lam_light_frame space)
{
    return space == LAM_FRAME_OBJECT ? "object" : space == LAM_FRAME_WORLD ? "world" : "eye";
}

bool lam_check_contract_row(const lam_check_contract *contract, int row, lam_check_name *name)
{
    if (row < 0)
        return false;
    for (const struct contract_name *n = contract->contract.names; n->name; n++)
        if (row-- == 0) {
            const struct role *role = role_of(n->semantic);
            *name = (lam_check_name){.name = n->name,
                                     .type = n->type,
                                     .role = role->name,
                                     .space = role->uses & ROLE_IN_SPACE ? space_name(n->space) : NULL,
                                     .meaning = n->meaning,
                                     .synonyms = n->synonyms,
                                     .attribute = n->attribute};
            return true;
        }
    return false;
}

bool lam_check_role_row(int row, lam_check_role *out)
{
    if (row < 0 || row >= role_count)
        return false;
    const struct role *role = &roles[row];
    *out = (lam_check_role){.name = role->name,
                            .meaning = role->meaning,
                            .attribute = role->uses & ROLE_ATTRIBUTE,
                            .uniform = role->uses & ROLE_UNIFORM,
                            .constant = role->uses & ROLE_CONSTANT,
                            .in_space = role->uses & ROLE_IN_SPACE};
    return true;
}

// The names in generated vertex shaders (default_vertex_shader.c). Every contract contains these names.
static const struct contract_name default_vertex_names[] = {
    {"lambent_position", SEMANTIC_POSITION, true, "vec3", "", NULL, LAM_FRAME_OBJECT, -1},
    {"lambent_normal", SEMANTIC_NORMAL, true, "vec3", "", NULL, LAM_FRAME_OBJECT, -1},
    {"lambent_texture_coordinate", SEMANTIC_TEXCOORD, true, "vec2", "", NULL, LAM_FRAME_OBJECT, -1},
    {"lambent_model_view", SEMANTIC_MODEL_VIEW, false, "mat4", "", NULL, LAM_FRAME_CAMERA, -1},
    {"lambent_projection", SEMANTIC_PROJECTION, false, "mat4", "", NULL, LAM_FRAME_CAMERA, -1},
    {"lambent_normal_matrix", SEMANTIC_NORMAL_MATRIX, false, "mat3", "", NULL, LAM_FRAME_CAMERA, -1},
    {"lambent_light", SEMANTIC_LIGHT_POSITION, false, "vec4", "", NULL, LAM_FRAME_CAMERA, -1},
    {"lambent_model", SEMANTIC_MODEL, false, "mat4", "", NULL, LAM_FRAME_CAMERA, -1},
    {"lambent_world_normal_matrix", SEMANTIC_NORMAL_MATRIX, false, "mat3", "", NULL, LAM_FRAME_WORLD, -1},
    {"lambent_world_light", SEMANTIC_LIGHT_POSITION, false, "vec4", "", NULL, LAM_FRAME_WORLD, -1},
    {"lambent_world_eye", SEMANTIC_EYE_POSITION, false, "vec3", "", NULL, LAM_FRAME_WORLD, -1},
    {.name = NULL},
};

// --- lookup

// Converts "lights[12].a" to "lights[].a" and returns the index.
static int strip_index(const char *name, char plain[96])
{
    const char *open = strchr(name, '['), *close = open ? strchr(open, ']') : NULL;
    int index = 0;
    if (close && close[1] == '.') {
        sscanf(open + 1, "%d", &index);
        snprintf(plain, 96, "%.*s[]%s", (int)(open - name), name, close + 1);
    } else {
        snprintf(plain, 96, "%.*s", open ? (int)(open - name) : 95, name);
        if (close)
            sscanf(open + 1, "%d", &index);
    }
    return index;
}

// Returns whether a list of words, separated by blanks, contains the name.
static bool in_word_list(const char *list, const char *name)
{
    size_t length = strlen(name);
    for (const char *at = list; at && (at = strstr(at, name)); at += length)
        if ((at == list || at[-1] == ' ') && (at[length] == ' ' || at[length] == 0))
            return true;
    return false;
}

// Lambent's own contract contains names in two more forms: "back_…" for the back of a surface, and fields of the
// material that only some reflection models read. The reference scenes set these fields to 0.
static const struct contract_name *find_own(const struct contract *contract, const char *name)
{
    static const struct contract_name other_field = {"material.*", SEMANTIC_ZERO,    false, "float", "0 here",
                                                     NULL,         LAM_FRAME_CAMERA, -1};
    if (strncmp(name, "back_", 5) == 0)
        return contract_find(contract, name + 5, false, NULL);
    const char *field = strncmp(name, "material.", 9) == 0 ? name + 9 : name;
    for (int i = 0; lam_material_field(i); i++)
        if (strcmp(lam_material_field(i)->name, field) == 0)
            return &other_field;
    return NULL;
}

const struct contract_name *contract_find(const struct contract *contract, const char *name, bool attribute, int *index)
{
    char plain[96];
    int at = strip_index(name, plain);
    if (index)
        *index = at;
    for (const struct contract_name *n = contract->names; n->name; n++)
        if (n->attribute == attribute && (strcmp(n->name, plain) == 0 || in_word_list(n->synonyms, plain)))
            return n;
    for (const struct contract_name *n = default_vertex_names; n->name; n++)
        if (n->attribute == attribute && strcmp(n->name, plain) == 0)
            return n;
    return contract->printed && !attribute ? find_own(contract, plain) : NULL;
}

const struct contract_varying *contract_varying(const struct contract *contract, const char *name)
{
    for (const struct contract_varying *v = contract->varyings; v->names; v++)
        if (in_word_list(v->names, name))
            return v;
    return NULL;
}

const char *name_nearest(const char *name, const char *const *words, int count)
{
    const char *nearest = NULL;
    int limit = (int)strlen(name) / 3 + 1;
    for (int i = 0; i < count; i++) {
        int alike = words[i] && strncmp(words[i], name, 5) == 0 ? 2 : 0; // letters at the beginning
        int distance = words[i] && strcmp(words[i], name) != 0 ? lam_word_distance(name, words[i]) - alike : limit;
        if (distance < limit) {
            limit = distance;
            nearest = words[i];
        }
    }
    return nearest;
}

const char *contract_nearest(const struct contract *contract, const char *name)
{
    char plain[96];
    strip_index(name, plain);
    const char *words[64] = {NULL};
    int count = 0;
    for (const struct contract_name *n = contract->names; n->name && count < 64; n++)
        words[count++] = n->name;
    return name_nearest(plain, words, count);
}

static const char *name_used(const struct contract *contract, enum uniform_semantic semantic,
                             const struct declarations *vertex, const struct declarations *fragment, bool *declared)
{
    const struct declarations *sides[] = {vertex, fragment};
    const char *own = NULL;
    *declared = true;
    for (const struct contract_name *n = contract->names; n->name; n++) {
        if (n->semantic != semantic)
            continue;
        if (!own)
            own = n->name;
        for (int s = 0; s < 2; s++)
            for (int i = 0; i < sides[s]->count; i++) {
                const struct declaration *d = &sides[s]->items[i];
                if ((d->kind == DECLARED_UNIFORM || n->attribute) &&
                    contract_find(contract, d->name, n->attribute, NULL) == n)
                    return d->name;
            }
    }
    *declared = false;
    return own;
}

const char *contract_name_used(const struct contract *contract, enum uniform_semantic semantic,
                               const struct declarations *vertex, const struct declarations *fragment)
{
    bool declared;
    const char *name = name_used(contract, semantic, vertex, fragment, &declared);
    if (declared || semantic < SEMANTIC_AMBIENT || semantic > SEMANTIC_SPECULAR)
        return name;
    int to_product = SEMANTIC_AMBIENT_PRODUCT - SEMANTIC_AMBIENT;
    const char *product =
        name_used(contract, (enum uniform_semantic)(semantic + to_product), vertex, fragment, &declared);
    return declared || !name ? product : name;
}
