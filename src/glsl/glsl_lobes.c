// glsl_lobes.c: GLSL calls of the reflection models, from the table in src/lighting/lobes.h.
#include "glsl_rows.h"

#define LANES 1
#include "lighting.h"

#include <stdio.h>
#include <string.h>

// The calls of the table: "kajiya_kay_lobe(s, l, m.fibre)".
static const char *const calls[LAM_REFLECTION_COUNT] = {
#define LOBE(NAME, call, ...) [LAM_REFLECTION_##NAME] = #call,
    LOBES(LOBE)
#undef LOBE
};

static const char *const parameters[] = {
#define NAME(name) #name,
    LOBE_PARAMETERS(NAME)
#undef NAME
};
enum { PARAMETERS = sizeof parameters / sizeof *parameters };

static bool is_name(const char *at, size_t length, const char *name)
{
    return strlen(name) == length && memcmp(at, name, length) == 0;
}

static size_t name_length(const char *at) { return strspn(at, "abcdefghijklmnopqrstuvwxyz_0123456789"); }

bool glsl_lobe_reads(const struct glsl_facts *f, const char *parameter)
{
    if (f->output_material && glsl_is_physical(f) &&
        strcmp(parameter, f->choices->output == LAM_OUTPUT_ROUGHNESS  ? "roughness"
                          : f->choices->output == LAM_OUTPUT_METALLIC ? "metallic"
                                                                      : "") == 0)
        return true;
    if (f->environment_light && (strcmp(parameter, "roughness") == 0 || strcmp(parameter, "metallic") == 0))
        return true;
    if (!f->adds_lights || !f->lights)
        return false;
    bool numbers = f->converts && !f->microfacet; // the classic model's numbers come from these
    if (strcmp(parameter, "shininess") == 0)
        return f->highlights && !f->microfacet;
    if (strcmp(parameter, "metallic") == 0) // of Fresnel's factor
        return f->microfacet || numbers;
    if (strcmp(parameter, "roughness") == 0 && numbers)
        return true;
    const char *at = calls[f->choices->reflection];
    while (at && (at = strstr(at, "m.")) && !is_name(at + 2, name_length(at + 2), parameter))
        at += 2;
    return at != NULL;
}

// With products and two materials, parameters are selected once, before the loops over the lights.
static bool selects(const struct glsl_facts *f) { return f->choices->products && f->back_material; }

void glsl_add_parameters(struct text *text, const struct glsl_facts *f)
{
    for (int i = 0; selects(f) && i < PARAMETERS; i++)
        if (glsl_lobe_reads(f, parameters[i]))
            text_print(text, "%s    float own_%s = front ? %s : back_%s;", text->bytes ? "\n" : "", parameters[i],
                       parameters[i], parameters[i]);
}

static void add_parameter(struct text *text, const struct glsl_facts *f, const char *name, size_t length)
{
    char member[32];
    snprintf(member, sizeof member, "%.*s", (int)length, name);
    if (glsl_maps_have(f, member)) {
        text_print(text, "maps.%s", member);
        return;
    }
    text_print(text, "%s%.*s", !f->choices->products ? "m." : selects(f) ? "own_" : "", (int)length, name);
}

void glsl_add_parameter(struct text *text, const struct glsl_facts *f, const char *name)
{
    add_parameter(text, f, name, strlen(name));
}

void glsl_add_lobe(struct text *text, const struct glsl_facts *f)
{
    text_add(text, f->microfacet ? "microfacet_of(" : "reflected_of(");
    for (const char *at = calls[f->choices->reflection]; *at;) {
        size_t length = name_length(at), member = length && at[length] == '.' ? name_length(at + length + 1) : 0;
        if (is_name(at, length, "m") && member) {
            add_parameter(text, f, at + length + 1, member);
            length += 1 + member;
        } else if (is_name(at, length, "l")) {
            text_add(text, "t.l");
        } else {
            length += !length;
            text_add_part(text, at, length);
        }
        at += length;
    }
    if (f->microfacet) {
        text_add(text, ")");
        return;
    }
    text_add(text, ", ");
    if (f->highlights)
        add_parameter(text, f, "shininess", strlen("shininess"));
    else
        text_add(text, "1.0"); // the base is 0: no highlight
    text_add(text, ")");
}

const char *glsl_tone_function(lam_tone tone)
{
    switch (tone) {
#define TONE(NAME, function, ...)                                                                                      \
    case LAM_TONE_##NAME:                                                                                              \
        return #function;
        TONES(TONE)
#undef TONE
    default:
        return "";
    }
}
