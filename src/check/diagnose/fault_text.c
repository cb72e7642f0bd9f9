// fault_text.c: expands explanations and corrections with the names that the shaders use.
#include "fault.h"

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
    {"model_view", SEMANTIC_MODEL_VIEW, "gl_ModelViewMatrix"},
    {"projection", SEMANTIC_PROJECTION, "gl_ProjectionMatrix"},
    {"light", SEMANTIC_LIGHT_POSITION, "light"},
    {"light_color", SEMANTIC_LIGHT_COLOR, "Ld"},
    {"light_specular", SEMANTIC_LIGHT_SPECULAR, "Ls"},
    {"ka", SEMANTIC_AMBIENT, "uKa * uColor"},
    {"kd", SEMANTIC_DIFFUSE, "uKd * uColor"},
    {"ks", SEMANTIC_SPECULAR, "uKs * uSpecularColor"},
    {"shininess", SEMANTIC_SHININESS, "64.0"},
    {"a", SEMANTIC_ATTENUATION_CONSTANT, "a"},
    {"b", SEMANTIC_ATTENUATION_LINEAR, "b"},
    {"c", SEMANTIC_ATTENUATION_QUADRATIC, "c"},
    {"count", SEMANTIC_LIGHT_COUNT, "LIGHTS"},
    {"flat", SEMANTIC_FLAT, "flat"},
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

// The light in eye space as a vec3: its position, or the unit direction to it.
static void put_light(struct line *line, bool direction)
{
    const char *name = own_name(line, SEMANTIC_LIGHT_POSITION), *unit = own_name(line, SEMANTIC_LIGHT_DIRECTION);
    const char *model_view = own_name(line, SEMANTIC_MODEL_VIEW);
    const char *open = direction ? "normalize(" : "", *close = direction ? ")" : "";
    if (direction && unit && !(line->interface->supports & NEED_POINT))
        put(line, "normalize(%s)", unit);
    else if (line->interface->contract->names[0].semantic == SEMANTIC_KA) // Oregon: three floats
        put(line, "vec3(uLightX, uLightY, uLightZ)");
    else if (line->frame == LAM_FRAME_OBJECT)
        put(line, "%s(%s * %s).xyz%s", open, model_view ? model_view : "gl_ModelViewMatrix", name ? name : "light",
            close);
    else
        put(line, "%s%s%s%s", open, name ? name : "light", is_wide(line, SEMANTIC_LIGHT_POSITION) ? ".xyz" : "", close);
}

static void put_normal_matrix(struct line *line)
{
    const char *name = own_name(line, SEMANTIC_NORMAL_MATRIX), *view = own_name(line, SEMANTIC_MODEL_VIEW);
    if (line->interface->contract->built_ins[0])
        put(line, "gl_NormalMatrix");
    else if (name && declarations_uses(&line->interface->vertex, name))
        put(line, is_wide(line, SEMANTIC_NORMAL_MATRIX) ? "mat3(%s)" : "%s", name);
    else
        put(line, "transpose(inverse(mat3(%s)))", view ? view : "model_view");
}

static void put_place(struct line *line, const char *place)
{
    const char *shininess = own_name(line, SEMANTIC_SHININESS);
    if (strcmp(place, "S") == 0)
        put(line, "pow(max(dot(%s), 0.0), %s)", line->reflection == LAM_REFLECTION_PHONG ? "R, V" : "N, H",
            shininess ? shininess : "64.0");
    else if (strcmp(place, "light_eye") == 0 || strcmp(place, "light_direction") == 0)
        put_light(line, strcmp(place, "light_direction") == 0);
    else if (strcmp(place, "normal_matrix") == 0)
        put_normal_matrix(line);
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++)
        if (strcmp(places[i].place, place) == 0) {
            const char *name = own_name(line, places[i].semantic);
            bool wide = name && is_wide(line, places[i].semantic);
            bool extend = name && places[i].semantic == SEMANTIC_POSITION && !wide;
            bool cut = places[i].semantic == SEMANTIC_NORMAL && wide;
            put(line, "%s%s%s", extend ? "vec4(" : "", name ? name : places[i].fallback,
                extend ? ", 1.0)"
                : cut  ? ".xyz"
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
