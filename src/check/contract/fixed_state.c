// fixed_state.c: declares the fixed state that a text reads (GLSL 1.20, section 7.5).
#include "fixed_state.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// MAX_LIGHTS: as many as the reference scenes have.
static const struct {
    const char *name, *declaration;
} states[] = {
    {"gl_LightSource", "struct fixed_Light { vec4 ambient, diffuse, specular, position, halfVector; vec3 "
                       "spotDirection; float spotExponent, "
                       "spotCutoff, spotCosCutoff, constantAttenuation, linearAttenuation, quadraticAttenuation; };\n"
                       "uniform fixed_Light fixed_LightSource[4];\n"},
    {"gl_FrontMaterial", "struct fixed_Material { vec4 emission, ambient, diffuse, specular; float shininess; };\n"
                         "uniform fixed_Material fixed_FrontMaterial;\n"},
    {"gl_LightModel", "struct fixed_Model { vec4 ambient; };\nuniform fixed_Model fixed_LightModel;\n"},
    {"gl_FrontLightModelProduct",
     "struct fixed_Scene { vec4 sceneColor; };\nuniform fixed_Scene fixed_FrontLightModelProduct;\n"},
    {"gl_FrontLightProduct", "struct fixed_Product { vec4 ambient, diffuse, specular; };\n"
                             "uniform fixed_Product fixed_FrontLightProduct[4];\n"},
};
enum { STATES = sizeof states / sizeof *states, MAX_DECLARATIONS = 1024 };

static bool is_name(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

// The state whose name stands at `at`. −1: none.
static int state_at(const char *text, const char *at)
{
    for (int i = 0; i < STATES; i++) {
        size_t length = strlen(states[i].name);
        if (strncmp(at, states[i].name, length) == 0 && !is_name(at[length]) && (at == text || !is_name(at[-1])))
            return i;
    }
    return -1;
}

bool fixed_state_has(const char *name) { return state_at(name, name) >= 0; }

char *fixed_state_rewrite(const char *text, bool *ok)
{
    char declarations[MAX_DECLARATIONS] = "";
    size_t names = 0;
    unsigned used = 0;
    *ok = true;
    for (const char *at = strstr(text, "gl_"); at; at = strstr(at + 1, "gl_")) {
        int state = state_at(text, at);
        names += state >= 0;
        if (state >= 0 && !(used >> state & 1))
            strcat(declarations, states[state].declaration); // all of them have room
        used |= state >= 0 ? 1u << state : 0;
    }
    if (!names)
        return NULL;
    // After the version, which has to be first; the lines keep their numbers.
    const char *version = strstr(text, "#version"), *rest = version ? version + strcspn(version, "\n") : text;
    int line = version ? 1 : 0;
    for (const char *c = text; c < rest; c++)
        line += *c == '\n';
    rest += *rest == '\n' && version;
    size_t size = strlen(text) + strlen(declarations) + 3 * names + 40;
    char *out = malloc(size);
    if (!out) {
        *ok = false;
        return NULL;
    }
    int length = snprintf(out, size, "%.*s\n%s#line %d\n", (int)(rest - text), text, declarations, line);
    for (const char *at = rest; *at; at++) {
        bool found = strncmp(at, "gl_", 3) == 0 && state_at(text, at) >= 0;
        length += snprintf(out + length, size - (size_t)length, "%s", found ? "fixed_" : (char[]){*at, 0});
        at += found ? 2 : 0;
    }
    return out;
}
