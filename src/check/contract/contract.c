// contract.c: the table of contracts, and recognising the one that a shader uses.
#include "contract.h"

#include <stdio.h>
#include <string.h>

#include "fail.h"
#include "name_similarity.h"

#include <lambent/fields.h>

#define END {.name = NULL}

// Names of generated vertex shaders (default_vertex_shader.c), known in every contract.
static const struct contract_name default_vertex_names[] = {
    {"lambent_position", SEMANTIC_POSITION, true, "vec3", "", NULL},
    {"lambent_normal", SEMANTIC_NORMAL, true, "vec3", "", NULL},
    {"lambent_model_view", SEMANTIC_MODEL_VIEW, false, "mat4", "", NULL},
    {"lambent_projection", SEMANTIC_PROJECTION, false, "mat4", "", NULL},
    {"lambent_normal_matrix", SEMANTIC_NORMAL_MATRIX, false, "mat3", "", NULL},
    {"lambent_light", SEMANTIC_LIGHT_IN_EYE, false, "vec4", "", NULL},
    END,
};

static const struct contract_name lambent_names[] = {
    {"position", SEMANTIC_POSITION, true, "vec3", "position of the vertex in the model's space", NULL},
    {"normal", SEMANTIC_NORMAL, true, "vec3", "normal of the vertex in the model's space", NULL},
    {"model_view", SEMANTIC_MODEL_VIEW, false, "mat4", "model to eye space", NULL},
    {"model_view_projection", SEMANTIC_MODEL_VIEW_PROJECTION, false, "mat4", "model to clip space", NULL},
    {"projection", SEMANTIC_PROJECTION, false, "mat4", "eye to clip space", NULL},
    {"normal_matrix", SEMANTIC_NORMAL_MATRIX, false, "mat3", "inverse transpose of model_view's 3x3", "normalMatrix"},
    {"ambient_light", SEMANTIC_AMBIENT_LIGHT, false, "vec4", "all light from everywhere", NULL},
    {"material.ambient", SEMANTIC_AMBIENT, false, "vec4", "ka", NULL},
    {"material.diffuse", SEMANTIC_DIFFUSE, false, "vec4", "kd; a: the opacity", NULL},
    {"material.specular", SEMANTIC_SPECULAR, false, "vec4", "ks", NULL},
    {"material.emission", SEMANTIC_ZERO, false, "vec4", "light of the surface's own", NULL},
    {"material.reflectivity", SEMANTIC_ZERO, false, "vec4", "kr", NULL},
    {"material.shininess", SEMANTIC_SHININESS, false, "float", "exponent of the highlight", NULL},
    {"material.fibre", SEMANTIC_ZERO, false, "float", "1: hair or thread", NULL},
    {"ambient_product", SEMANTIC_AMBIENT_PRODUCT, false, "vec4", "ka times all light from everywhere", NULL},
    {"emission", SEMANTIC_ZERO, false, "vec4", "light of the surface's own", NULL},
    {"diffuse", SEMANTIC_DIFFUSE, false, "vec4", "kd; a: the opacity", NULL},
    {"reflectivity", SEMANTIC_ZERO, false, "vec4", "kr", NULL},
    {"shininess", SEMANTIC_SHININESS, false, "float", "exponent of the highlight", NULL},
    {"fibre", SEMANTIC_ZERO, false, "float", "1: hair or thread", NULL},
    {"diffuse_product", SEMANTIC_DIFFUSE_PRODUCT, false, "vec4", "kd Ld, for each light", NULL},
    {"specular_product", SEMANTIC_SPECULAR_PRODUCT, false, "vec4", "ks Ls, for each light", NULL},
    {"hemispheres[].up", SEMANTIC_ZERO, false, "vec4", "in eye space, towards the sky", NULL},
    {"hemispheres[].sky", SEMANTIC_ZERO, false, "vec4", "light from above: none here", NULL},
    {"hemispheres[].ground", SEMANTIC_ZERO, false, "vec4", "light from below: none here", NULL},
    {"sky_product", SEMANTIC_ZERO, false, "vec4", "ka times the light from above: none here", NULL},
    {"ground_product", SEMANTIC_ZERO, false, "vec4", "ka times the light from below: none here", NULL},
    {"exposure", SEMANTIC_ONE, false, "float", "all light is multiplied by it", NULL},
    {"lights[].position", SEMANTIC_LIGHT_POSITION, false, "vec4", "in eye space", NULL},
    {"lights[].direction", SEMANTIC_LIGHT_TRAVEL, false, "vec4", "in eye space, unit, the way the light travels", NULL},
    {"lights[].attenuation", SEMANTIC_ATTENUATION, false, "vec4", "constant, linear, quadratic, 1/range", NULL},
    {"lights[].cone", SEMANTIC_CONE, false, "vec4",
     "cosine of the cutoff, exponent, cosine of the outer angle, 1/width", NULL},
    {"lights[].diffuse", SEMANTIC_LIGHT_COLOR, false, "vec4", "Ld", NULL},
    {"lights[].specular", SEMANTIC_LIGHT_SPECULAR, false, "vec4", "Ls", NULL},
    {"lights[].ambient", SEMANTIC_LIGHT_AMBIENT, false, "vec4", "La", NULL},
    END,
};

static const struct contract_name pittsburgh_names[] = {
    {"vPosition", SEMANTIC_POSITION, true, "vec4", "position of the vertex in the model's space, w 1", NULL},
    {"vNormal", SEMANTIC_NORMAL, true, "vec4", "normal of the vertex in the model's space, w 0", NULL},
    {"model_view", SEMANTIC_MODEL_VIEW, false, "mat4", "model to eye space", "modelView model_view_matrix"},
    {"projection", SEMANTIC_PROJECTION, false, "mat4", "eye to clip space", "projection_matrix"},
    {"normal_matrix", SEMANTIC_NORMAL_MATRIX, false, "mat3", "inverse transpose of model_view's 3x3",
     "normalMatrix NormalMatrix normal_mat model_view_inverse_transpose modelViewInverseTranspose "
     "inverse_transpose"},
    {"ambient_product", SEMANTIC_AMBIENT, false, "vec4", "ka times the light's ambient colour", "AmbientProduct"},
    {"diffuse_product", SEMANTIC_DIFFUSE, false, "vec4", "kd times the light's diffuse colour", "DiffuseProduct"},
    {"specular_product", SEMANTIC_SPECULAR, false, "vec4", "ks times the light's specular colour", "SpecularProduct"},
    {"light_position", SEMANTIC_LIGHT_POSITION, false, "vec4",
     "where the light is, w 1, or the direction to it, w 0; in the model's space (--light-frame camera: in "
     "eye space)",
     "LightPosition"},
    {"shininess", SEMANTIC_SHININESS, false, "float", "exponent of the highlight", "Shininess"},
    {"attenuation_constant", SEMANTIC_ATTENUATION_CONSTANT, false, "float", "a of 1/(a + b d + c d^2)", NULL},
    {"attenuation_linear", SEMANTIC_ATTENUATION_LINEAR, false, "float", "b, for each unit of distance", NULL},
    {"attenuation_quadratic", SEMANTIC_ATTENUATION_QUADRATIC, false, "float", "c, for each unit squared", NULL},
    {"eye_position", SEMANTIC_EYE_POSITION, false, "vec4", "the eye in eye space: 0, 0, 0, 1", "eye_point"},
    END,
};

static const struct contract_name oregon_names[] = {
    {"uKa", SEMANTIC_KA, false, "float", "share of ambient light", NULL},
    {"uKd", SEMANTIC_KD, false, "float", "share of diffuse light", NULL},
    {"uKs", SEMANTIC_KS, false, "float", "share of specular light", NULL},
    {"uColor", SEMANTIC_COLOR, false, "vec3", "colour of the surface", NULL},
    {"uSpecularColor", SEMANTIC_SPECULAR_COLOR, false, "vec3", "colour of the highlight", NULL},
    {"uShininess", SEMANTIC_SHININESS, false, "float", "exponent of the highlight", NULL},
    {"uFlat", SEMANTIC_FLAT, false, "bool", "flat shading: the values of each triangle's last vertex", NULL},
    {"uLightX", SEMANTIC_LIGHT_X, false, "float", "the light's place in eye space", NULL},
    {"uLightY", SEMANTIC_LIGHT_Y, false, "float", "the light's place in eye space", NULL},
    {"uLightZ", SEMANTIC_LIGHT_Z, false, "float", "the light's place in eye space", NULL},
    END,
};
static const char *const oregon_built_ins[] = {
    "gl_Vertex", "gl_Normal", "gl_NormalMatrix", "gl_ModelViewMatrix", "gl_ModelViewProjectionMatrix", NULL};

static const struct contract_name nyu_names[] = {
    {"position", SEMANTIC_POSITION, true, "vec4", "position of the vertex in the model's space, w 1", "vertexPosition"},
    {"normal", SEMANTIC_NORMAL, true, "vec4", "normal of the vertex in the model's space, w 0", "vertexNormal"},
    {"texCoord", SEMANTIC_TEXCOORD, true, "vec2", "texture coordinate; zero", NULL},
    {"modelViewMatrix", SEMANTIC_MODEL_VIEW, false, "mat4", "model to eye space", NULL},
    {"projectionMatrix", SEMANTIC_PROJECTION, false, "mat4", "eye to clip space", NULL},
    {"normalMatrix", SEMANTIC_NORMAL_MATRIX, false, "mat4", "inverse transpose of modelViewMatrix",
     "NormalMatrix normal_matrix"},
    {"uColor", SEMANTIC_COLOR, false, "vec3", "colour of the surface", NULL},
    {"lights[].lightPosition", SEMANTIC_LIGHT_POSITION, false, "vec3", "where the light is, in eye space", NULL},
    {"lights[].lightDirection", SEMANTIC_LIGHT_DIRECTION, false, "vec3", "unit direction to the light, in eye space",
     NULL},
    {"lights[].lightColor", SEMANTIC_LIGHT_COLOR, false, "vec3", "diffuse colour of the light", NULL},
    {"lights[].specularLightColor", SEMANTIC_LIGHT_SPECULAR, false, "vec3", "specular colour of the light", NULL},
    {"lightPosition", SEMANTIC_LIGHT_POSITION, false, "vec3", "where the light is, in eye space", NULL},
    {"lightDirection", SEMANTIC_LIGHT_DIRECTION, false, "vec3", "unit direction to the light, in eye space", NULL},
    {"lightColor", SEMANTIC_LIGHT_COLOR, false, "vec3", "diffuse colour of the light", NULL},
    {"specularLightColor", SEMANTIC_LIGHT_SPECULAR, false, "vec3", "specular colour of the light", NULL},
    END,
};

static const struct contract_varying pittsburgh_varyings[] = {
    {"N fN normal fNormal", VARYING_NORMAL}, {"L fL light", VARYING_LIGHT},
    {"V fV E fE view eye", VARYING_EYE},     {"P fP fPosition position", VARYING_POSITION},
    {"distance dist d", VARYING_DISTANCE},   {NULL, 0},
};
static const struct contract_varying oregon_varyings[] = {
    {"vN vNs vNf Ns Nf N vNormal Normal", VARYING_NORMAL},
    {"vL vLs vLf Ls Lf L vLight Light Lvector", VARYING_LIGHT},
    {"vE vEs vEf Es Ef E vEye Eye Evector", VARYING_EYE},
    {"vEC vECposition vPVs ECposition", VARYING_POSITION},
    {"vMC vMCposition MCposition", VARYING_OBJECT_POSITION},
    {"vST ST", VARYING_TEXCOORD},
    {NULL, 0},
};
static const struct contract_varying nyu_varyings[] = {
    {"varyingNormal", VARYING_NORMAL},
    {"varyingPosition", VARYING_POSITION},
    {"varyingTexCoord varyingTexCoordinate", VARYING_TEXCOORD},
    {NULL, 0},
};
static const struct contract_varying lambent_varyings[] = {
    {"eye_normal surface_normal normal v_normal", VARYING_NORMAL},
    {"eye_position surface_position point v_position", VARYING_POSITION},
    {NULL, 0},
};
static const char *const no_words[] = {NULL};

const struct contract contracts[] = {
    {.name = "lambent",
     .title = "Lambent's own names (lambent shader)",
     .names = lambent_names,
     .varyings = lambent_varyings,
     .built_ins = no_words,
     .supports = NEED_AMBIENT | NEED_ATTENUATION | NEED_DIRECTIONAL | NEED_POINT | NEED_LIGHTS | NEED_SPOT |
                 NEED_ALPHA | NEED_TWO_SIDES | NEED_SHININESS,
     .light_frame = LAM_FRAME_CAMERA,
     .has_ambient = true,
     .has_attenuation = true,
     .own_ambient_color = true,
     .light_colors = true,
     .reflection = LAM_REFLECTION_BLINN_PHONG},
    {.name = "pittsburgh",
     .title = "Pittsburgh, \"Lighting and Shading\"",
     .names = pittsburgh_names,
     .varyings = pittsburgh_varyings,
     .built_ins = no_words,
     .supports = NEED_AMBIENT | NEED_ATTENUATION | NEED_DIRECTIONAL | NEED_POINT | NEED_ALPHA | NEED_SHININESS,
     .light_frame = LAM_FRAME_OBJECT,
     .products = true,
     .has_ambient = true,
     .has_attenuation = true,
     .own_ambient_color = true,
     .light_colors = true,
     .reflection = LAM_REFLECTION_BLINN_PHONG},
    {.name = "oregon",
     .title = "Oregon State, \"Using Shaders for Lighting\"",
     .names = oregon_names,
     .varyings = oregon_varyings,
     .built_ins = oregon_built_ins,
     .supports = NEED_AMBIENT | NEED_POINT | NEED_FLAT | NEED_SHININESS,
     .light_frame = LAM_FRAME_CAMERA,
     .has_ambient = true,
     .reflection = LAM_REFLECTION_PHONG,
     .material_strengths = true},
    {.name = "nyu",
     .title = "NYU, \"Fragment shaders and basic lighting\"",
     .names = nyu_names,
     .varyings = nyu_varyings,
     .built_ins = no_words,
     .supports = NEED_DIRECTIONAL | NEED_POINT | NEED_ATTENUATION | NEED_LIGHTS,
     .light_frame = LAM_FRAME_CAMERA,
     .has_attenuation = true,
     .light_colors = true,
     .reflection = LAM_REFLECTION_BLINN_PHONG,
     .shininess = 64,
     .attenuation = {1, 0.54f, 0.2f},
     .attenuated_points = true},
    {.name = NULL},
};

const struct contract *contract_of(lam_check_contract which)
{
    return which >= LAM_CONTRACT_LAMBENT && which < LAM_CONTRACT_COUNT ? &contracts[which - LAM_CONTRACT_LAMBENT]
                                                                       : NULL;
}

const char *lam_check_contract_name(lam_check_contract which)
{
    return which == LAM_CONTRACT_AUTO ? "auto" : contract_of(which) ? contract_of(which)->name : NULL;
}

// --- lookup

// Stores "lights[12].a" as "lights[].a" and returns the index.
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

// Whether a list of words, separated by blanks, contains the name.
static bool in_word_list(const char *list, const char *name)
{
    size_t length = strlen(name);
    for (const char *at = list; at && (at = strstr(at, name)); at += length)
        if ((at == list || at[-1] == ' ') && (at[length] == ' ' || at[length] == 0))
            return true;
    return false;
}

// Lambent's own names come in two more forms: "back_…" for the back of a surface, and fields of the material that only
// some reflection models read, which the reference scenes leave at 0.
static const struct contract_name *find_own(const struct contract *contract, const char *name)
{
    static const struct contract_name other_field = {"material.*", SEMANTIC_ZERO, false, "float", "0 here", NULL};
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
    return contract->names == lambent_names && !attribute ? find_own(contract, plain) : NULL;
}

const struct contract_varying *contract_varying(const struct contract *contract, const char *name)
{
    for (const struct contract_varying *v = contract->varyings; v->names; v++)
        if (in_word_list(v->names, name))
            return v;
    return NULL;
}

bool lam_check_contract_row(lam_check_contract which, int row, lam_check_name *name)
{
    const struct contract *contract = contract_of(which);
    if (!contract || row < 0)
        return false;
    for (const struct contract_name *n = contract->names; n->name; n++)
        if (row-- == 0) {
            *name = (lam_check_name){.name = n->name,
                                     .type = n->type,
                                     .meaning = n->meaning,
                                     .synonyms = n->synonyms,
                                     .attribute = n->attribute};
            return true;
        }
    return false;
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

static int score(const struct contract *contract, const struct declarations *d)
{
    int points = 0;
    for (int i = 0; i < d->count; i++) {
        bool uniform = d->items[i].kind == DECLARED_UNIFORM;
        if (uniform || d->items[i].kind == DECLARED_INPUT)
            points += 4 * (contract_find(contract, d->items[i].name, !uniform, NULL) != NULL);
        if (d->items[i].kind == DECLARED_INPUT)
            for (const struct contract_varying *v = contract->varyings; v->names; v++)
                points += (strlen(d->items[i].name) > 1 ? 4 : 1) * in_word_list(v->names, d->items[i].name);
    }
    for (const char *const *word = contract->built_ins; *word; word++)
        points += 4 * declarations_uses(d, *word);
    return points;
}

const struct contract *contract_recognise(const struct declarations *vertex, const struct declarations *fragment,
                                          lam_check_contract *which)
{
    int best = 0;
    const struct contract *found = NULL;
    for (int i = LAM_CONTRACT_LAMBENT; i < LAM_CONTRACT_COUNT; i++) {
        int points = score(contract_of(i), vertex) + score(contract_of(i), fragment);
        if (points > best) {
            best = points;
            found = contract_of(i);
            *which = i;
        }
    }
    return found;
}

const char *contract_name_used(const struct contract *contract, enum uniform_semantic semantic,
                               const struct declarations *vertex, const struct declarations *fragment)
{
    const struct declarations *sides[] = {vertex, fragment};
    const char *own = NULL;
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
    return own;
}
