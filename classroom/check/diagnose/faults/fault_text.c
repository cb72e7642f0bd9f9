// fault_text.c: expands explanations and corrections with the names that the shaders use.
#include "fault.h"

#include <lambent/light.h>

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static const struct {
    const char *place;
    enum uniform_semantic semantic;
    const char *fallback;
} places[] = {
    {"normal_matrix4", SEMANTIC_NORMAL_MATRIX, "normalMatrix"},
    {"normal", SEMANTIC_NORMAL, "gl_Normal"},
    {"position", SEMANTIC_POSITION, "gl_Vertex"},
    {"view", SEMANTIC_VIEW, "view"},
    {"projection", SEMANTIC_PROJECTION, "gl_ProjectionMatrix"},
    {"light", SEMANTIC_LIGHT_POSITION, "light"},
    {"light_color", SEMANTIC_LIGHT_COLOR, "Ld"},
    {"light_specular", SEMANTIC_LIGHT_SPECULAR, "Ls"},
    {"ka", SEMANTIC_AMBIENT, "uKa * uColor"},
    {"kd", SEMANTIC_DIFFUSE, "uKd * uColor"},
    {"ks", SEMANTIC_SPECULAR, "uKs * uSpecularColor"},
    {"a", SEMANTIC_ATTENUATION_CONSTANT, "a"},
    {"b", SEMANTIC_ATTENUATION_LINEAR, "b"},
    {"c", SEMANTIC_ATTENUATION_QUADRATIC, "c"},
    {"count", SEMANTIC_LIGHT_COUNT, "LIGHTS"},
    {"flat", SEMANTIC_FLAT, "flat"},
    {"base", SEMANTIC_COLOR, "albedo"},
    {"occlusion", SEMANTIC_KA, "ao"},
    {"metallic", SEMANTIC_METALLIC, "metallic"},
    {"roughness", SEMANTIC_ROUGHNESS, "roughness"},
    {"emission", SEMANTIC_EMISSION, "emission"},
    {"tangent", SEMANTIC_TANGENT, "tangent"},
    {"base_map", SEMANTIC_BASE_COLOR_MAP, "albedoMap"},
    {"metallic_roughness_map", SEMANTIC_METALLIC_ROUGHNESS_MAP, "metallicRoughnessMap"},
    {"normal_map", SEMANTIC_NORMAL_MAP, "normalMap"},
    {"occlusion_map", SEMANTIC_OCCLUSION_MAP, "aoMap"},
    {"emission_map", SEMANTIC_EMISSION_MAP, "emissionMap"},
};

struct line {
    const struct shader_interface *interface;
    lam_light_frame frame;
    lam_reflection reflection;
    char *out;
    size_t at, capacity;
};

__attribute__((format(printf, 2, 3))) static void put(struct line *line, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    int n = vsnprintf(line->out + line->at, line->capacity - line->at, format, arguments);
    va_end(arguments);
    line->at = n < 0 || line->at + (size_t)n >= line->capacity ? line->capacity - 1 : line->at + (size_t)n;
}

static const char *own_name(const struct line *line, enum uniform_semantic semantic)
{
    return contract_name_used(line->interface->contract, semantic, &line->interface->vertex,
                              &line->interface->fragment);
}

static bool is_wide(const struct line *line, enum uniform_semantic semantic) // vec4 or mat4
{
    const char *name = own_name(line, semantic);
    const struct declarations *sides[] = {&line->interface->vertex, &line->interface->fragment};
    for (int s = 0; name && s < 2; s++)
        for (int i = 0; i < sides[s]->count; i++)
            if (strcmp(sides[s]->items[i].name, name) == 0)
                return strchr(sides[s]->items[i].type, '4') != NULL;
    for (const struct contract_name *n = line->interface->contract->names; name && n->name; n++)
        if (strcmp(n->name, name) == 0)
            return strchr(n->type, '4') != NULL;
    return false;
}

static bool is_world(const struct line *line) { return line->interface->space == LAM_FRAME_WORLD; }

// Returns the matrix from model space to lighting space (eye or world space).
static const char *to_lighting(const struct line *line)
{
    const char *name = own_name(line, is_world(line) ? SEMANTIC_MODEL : SEMANTIC_MODEL_VIEW);
    return name ? name : is_world(line) ? "model" : "gl_ModelViewMatrix";
}

// Writes the matrices from lighting space to clip space.
static void put_to_clip(struct line *line)
{
    const char *projection = own_name(line, SEMANTIC_PROJECTION), *view = own_name(line, SEMANTIC_VIEW);
    put(line, "%s", projection ? projection : "gl_ProjectionMatrix");
    if (is_world(line))
        put(line, " * %s", view ? view : "view");
}

// Writes the light's position, or the unit direction to the light, as a vec3 in lighting space.
static void put_light(struct line *line, bool direction)
{
    const char *name = own_name(line, SEMANTIC_LIGHT_POSITION), *unit = own_name(line, SEMANTIC_LIGHT_DIRECTION),
               *travel = own_name(line, SEMANTIC_LIGHT_TRAVEL), *x = own_name(line, SEMANTIC_LIGHT_X),
               *y = own_name(line, SEMANTIC_LIGHT_Y), *z = own_name(line, SEMANTIC_LIGHT_Z);
    const char *open = direction ? "normalize(" : "", *close = direction ? ")" : "";
    bool directional = direction && !(line->interface->supports & NEED_POINT);
    if (directional && unit)
        put(line, "normalize(%s)", unit);
    else if (directional && travel)
        put(line, "normalize(-%s)", travel);
    else if (!name && x)
        put(line, "vec3(%s, %s, %s)", x, y ? y : "y", z ? z : "z");
    else if (line->frame == LAM_FRAME_OBJECT)
        put(line, "%s(%s * %s).xyz%s", open, to_lighting(line), name ? name : "light", close);
    else
        put(line, "%s%s%s%s", open, name ? name : "light", is_wide(line, SEMANTIC_LIGHT_POSITION) ? ".xyz" : "", close);
}

// Writes the vector from the point P to the eye.
static void put_to_eye(struct line *line)
{
    const char *eye = own_name(line, SEMANTIC_EYE_POSITION);
    if (is_world(line))
        put(line, "%s%s - P", eye ? eye : "eye", is_wide(line, SEMANTIC_EYE_POSITION) ? ".xyz" : "");
    else
        put(line, "-P");
}

// Returns the space to which a normal matrix of the contract transforms.
static lam_light_frame normal_space(const struct line *line, const char *name)
{
    const struct contract_name *row = contract_find(line->interface->contract, name, false, NULL);
    return row ? row->space : LAM_FRAME_CAMERA;
}

static void put_normal_matrix(struct line *line)
{
    const char *name = own_name(line, SEMANTIC_NORMAL_MATRIX);
    if (line->interface->contract->built_ins[0])
        put(line, "gl_NormalMatrix");
    else if (name && declarations_find(&line->interface->vertex, DECLARED_UNIFORM, name) &&
             line->interface->space == normal_space(line, name))
        put(line, is_wide(line, SEMANTIC_NORMAL_MATRIX) ? "mat3(%s)" : "%s", name);
    else
        put(line, "transpose(inverse(mat3(%s)))", to_lighting(line));
}

// Writes the exponent: its name, or the number that the shader contains instead.
static void put_shininess(struct line *line)
{
    const struct shader_interface *r = line->interface;
    const char *name = own_name(line, SEMANTIC_SHININESS);
    if (name && (shader_interface_declares(r, SEMANTIC_SHININESS) || !r->defaults.shininess.given))
        put(line, "%s", name);
    else
        put(line, "%.1f", r->defaults.shininess.given ? (double)r->defaults.shininess.value : 64.0);
}

// Returns the name of the material's colour for a term. If the shader declares only the name of the surface's colour,
// returns that name.
static const char *term_name(const struct line *line, enum uniform_semantic semantic)
{
    const struct shader_interface *r = line->interface;
    const char *name = own_name(line, semantic), *color = own_name(line, SEMANTIC_COLOR);
    bool product =
        shader_interface_declares(r, (enum uniform_semantic)(semantic + SEMANTIC_AMBIENT_PRODUCT - SEMANTIC_AMBIENT));
    bool declared = shader_interface_declares(r, semantic) || product;
    bool colored = !r->contract->material_strengths && shader_interface_declares(r, SEMANTIC_COLOR);
    return name && !declared && colored ? color : name;
}

// Returns a map of metalness or roughness: one map for both, or a separate map.
static const char *data_map(const struct line *line, enum uniform_semantic alone)
{
    const char *name =
        own_name(line, shader_interface_declares(line->interface, alone) ? alone : SEMANTIC_METALLIC_ROUGHNESS_MAP);
    return name ? name : "metallicRoughnessMap";
}

// Returns the texture coordinate in the fragment shader.
static const char *texture_coordinate(const struct line *line)
{
    const struct declarations *d = &line->interface->fragment;
    for (int i = 0; i < d->count; i++) {
        const struct contract_varying *v = contract_varying(line->interface->contract, d->items[i].name);
        bool known = v && v->semantic == VARYING_TEXCOORD;
        if (d->items[i].kind == DECLARED_INPUT && (known || strcmp(d->items[i].type, "vec2") == 0))
            return d->items[i].name;
    }
    return "uv";
}

static void put_place(struct line *line, const char *place)
{
    if (strcmp(place, "uv") == 0) {
        put(line, "%s", texture_coordinate(line));
        return;
    }
    if (strcmp(place, "metallic_map") == 0 || strcmp(place, "roughness_map") == 0) {
        put(line, "%s", data_map(line, place[0] == 'm' ? SEMANTIC_METALLIC_MAP : SEMANTIC_ROUGHNESS_MAP));
        return;
    }
    if (strcmp(place, "S") == 0) {
        put(line, "pow(max(dot(%s), 0.0), ", line->reflection == LAM_REFLECTION_PHONG ? "R, V" : "N, H");
        put_shininess(line);
        put(line, ")");
    } else if (strcmp(place, "shininess") == 0) {
        put_shininess(line);
        return;
    } else if (strcmp(place, "light_eye") == 0 || strcmp(place, "light_direction") == 0)
        put_light(line, strcmp(place, "light_direction") == 0);
    else if (strcmp(place, "normal_matrix") == 0)
        put_normal_matrix(line);
    else if (strcmp(place, "model_view") == 0)
        put(line, "%s", to_lighting(line));
    else if (strcmp(place, "clip") == 0)
        put_to_clip(line);
    else if (strcmp(place, "space") == 0)
        put(line, "%s", is_world(line) ? "world" : "eye");
    else if (strcmp(place, "v") == 0)
        put_to_eye(line);
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++)
        if (strcmp(places[i].place, place) == 0) {
            bool term = places[i].semantic >= SEMANTIC_AMBIENT && places[i].semantic <= SEMANTIC_SPECULAR;
            const char *name = term ? term_name(line, places[i].semantic) : own_name(line, places[i].semantic);
            bool wide = name && is_wide(line, places[i].semantic);
            bool extend = name && places[i].semantic == SEMANTIC_POSITION && !wide;
            bool cut = wide && (places[i].semantic == SEMANTIC_NORMAL || places[i].semantic == SEMANTIC_COLOR);
            const char *plain = term && line->interface->contract->any_strengths ? place : places[i].fallback;
            put(line, "%s%s%s", extend ? "vec4(" : "", name ? name : plain,
                extend ? ", 1.0)"
                : cut  ? (places[i].semantic == SEMANTIC_COLOR ? ".rgb" : ".xyz")
                       : "");
        }
}

void fault_text(const char *template, const struct shader_interface *interface, lam_light_frame frame,
                lam_reflection reflection, char *out, size_t capacity)
{
    struct line line = {
        .interface = interface, .frame = frame, .reflection = reflection, .out = out, .capacity = capacity};
    out[0] = 0;
    for (const char *c = template; *c; c++) {
        const char *end = *c == '{' ? strchr(c, '}') : NULL;
        if (end) {
            char place[32];
            snprintf(place, sizeof place, "%.*s", (int)(end - c - 1), c + 1);
            put_place(&line, place);
            c = end;
        } else {
            put(&line, "%c", *c);
        }
    }
}
