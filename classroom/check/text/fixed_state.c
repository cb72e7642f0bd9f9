// fixed_state.c: declares the fixed-function state that a shader reads (GLSL 1.20, section 7.5).
#include "prefix.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Arrays have as many elements as the reference scenes have lights.
static const struct {
    const char *name, *elements;
    const char *members[13]; // the members with their types; ends with NULL
} states[] = {
    {"gl_LightSource",
     "[4]",
     {"vec4 ambient", "vec4 diffuse", "vec4 specular", "vec4 position", "vec4 halfVector", "vec3 spotDirection",
      "float spotExponent", "float spotCutoff", "float spotCosCutoff", "float constantAttenuation",
      "float linearAttenuation", "float quadraticAttenuation"}},
    {"gl_FrontMaterial", "", {"vec4 emission", "vec4 ambient", "vec4 diffuse", "vec4 specular", "float shininess"}},
    {"gl_LightModel", "", {"vec4 ambient"}},
    {"gl_FrontLightModelProduct", "", {"vec4 sceneColor"}},
    {"gl_FrontLightProduct", "[4]", {"vec4 ambient", "vec4 diffuse", "vec4 specular"}},
};
enum { STATES = sizeof states / sizeof *states, MAX_STATE_LINES = 2048 };

static bool is_name(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

// Returns the state whose name begins at `at`, or −1 if there is none.
static int state_at(const char *text, const char *at)
{
    for (int i = 0; i < STATES; i++) {
        size_t length = strlen(states[i].name);
        if (strncmp(at, states[i].name, length) == 0 && !is_name(at[length]) && (at == text || !is_name(at[-1])))
            return i;
    }
    return -1;
}

// Returns whether a source contains a word.
static bool has_word(const char *text, const char *word)
{
    size_t length = strlen(word);
    for (const char *at = text ? strstr(text, word) : NULL; at; at = strstr(at + 1, word))
        if ((at == text || !is_name(at[-1])) && !is_name(at[length]))
            return true;
    return false;
}

// Declares a state with the members that at least one of the two sources uses. The declaration is the same in both
// sources. Other members remain undeclared, so the check does not expect the terms of these members.
static void declare(int state, const char *text, const char *other, char out[MAX_STATE_LINES])
{
    size_t at = strlen(out);
    const char *name = states[state].name + 3;
    at += (size_t)snprintf(out + at, MAX_STATE_LINES - at, "struct fixed_%s_ {", name);
    for (const char *const *member = states[state].members; *member; member++) {
        const char *word = strchr(*member, ' ') + 1;
        if (has_word(text, word) || has_word(other, word))
            at += (size_t)snprintf(out + at, MAX_STATE_LINES - at, " %s;", *member);
    }
    snprintf(out + at, MAX_STATE_LINES - at, " };\nuniform fixed_%s_ fixed_%s%s;\n", name, name,
             states[state].elements);
}

bool fixed_state_has(const char *name) { return state_at(name, name) >= 0; }

char *fixed_state_rewrite(const char *text, const char *other, bool *ok)
{
    char declarations[MAX_STATE_LINES] = "";
    size_t names = 0;
    unsigned used = 0;
    *ok = true;
    for (const char *at = strstr(text, "gl_"); at; at = strstr(at + 1, "gl_")) {
        int state = state_at(text, at);
        names += state >= 0;
        if (state >= 0 && !(used >> state & 1))
            declare(state, text, other, declarations); // large enough for the declarations of all states
        used |= state >= 0 ? 1u << state : 0;
    }
    if (!names)
        return NULL;
    // The declarations follow the version line, which must be the first line. Lines keep their numbers.
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
