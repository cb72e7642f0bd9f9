// glsl_lobes.c: writes GLSL calls of the reflection models, from the table in src/core/lighting/lobes.h.
#include "glsl_declarations.h"

#define LANES 1
#include "lighting.h"

#include <stdio.h>
#include <string.h>

// The call of each reflection model: "kajiya_kay_lobe(s, l, m.fibre)".
static const char *const calls[LAM_REFLECTION_COUNT] = {
#define LOBE(NAME, call, ...) [LAM_REFLECTION_##NAME] = #call,
    LOBES(LOBE)
#undef LOBE
};

static const char *const parameters[] = {
#define NAME(name, ...) #name,
    LOBE_PARAMETERS(NAME)
#undef NAME
};
enum { PARAMETERS = sizeof parameters / sizeof *parameters };

static bool is_name(const char *at, size_t length, const char *name)
{
    return strlen(name) == length && memcmp(at, name, length) == 0;
}

static size_t name_length(const char *at) { return strspn(at, "abcdefghijklmnopqrstuvwxyz_0123456789"); }

bool glsl_lobe_reads(const struct glsl_stage *f, const char *parameter)
{
    if (f->output_material && glsl_is_physical(f) &&
        strcmp(parameter, f->choices->output == LAM_OUTPUT_ROUGHNESS  ? "roughness"
                          : f->choices->output == LAM_OUTPUT_METALLIC ? "metallic"
                                                                      : "") == 0)
        return true;
    if (f->environment_light && (strcmp(parameter, "roughness") == 0 || strcmp(parameter, "metallic") == 0))
        return true;
    if (!f->adds_lights || !f->has_lights)
        return false;
    bool numbers = f->converts && !f->microfacet; // the classic model's parameters are computed from the physical
                                                  // parameters
    if (strcmp(parameter, "shininess") == 0)
        return f->highlights && !f->microfacet;
    if (strcmp(parameter, "metallic") == 0) // the Fresnel factor uses this parameter
        return f->microfacet || numbers;
    if (strcmp(parameter, "roughness") == 0 && numbers)
        return true;
    const char *at = calls[f->choices->reflection];
    while (at && (at = strstr(at, "m.")) && !is_name(at + 2, name_length(at + 2), parameter))
        at += 2;
    return at != NULL;
}

// With products and two materials, parameters are selected once, before the loops over the lights.
static bool selects(const struct glsl_stage *f) { return f->choices->products && f->back_material; }

void glsl_add_parameters(struct text *text, const struct glsl_stage *f)
{
    for (int i = 0; selects(f) && i < PARAMETERS; i++)
        if (glsl_lobe_reads(f, parameters[i]))
            text_print(text, "    float own_%s = front ? %s : back_%s;\n", parameters[i], parameters[i], parameters[i]);
}

// Adds the value of a parameter from the material and its maps. If `own` is false and the shader widens the roughness,
// adds the widened roughness instead.
static void add_parameter(struct text *text, const struct glsl_stage *f, const char *name, size_t length, bool own)
{
    char member[32];
    snprintf(member, sizeof member, "%.*s", (int)length, name);
    if (f->widens_roughness && !own && strcmp(member, "roughness") == 0) {
        text_add(text, "widened");
        return;
    }
    if (glsl_maps_have(f, member)) {
        text_print(text, "maps.%s", member);
        return;
    }
    text_print(text, "%s%.*s", !f->choices->products ? "m." : selects(f) ? "own_" : "", (int)length, name);
}

void glsl_add_parameter(struct text *text, const struct glsl_stage *f, const char *name)
{
    add_parameter(text, f, name, strlen(name), false);
}

void glsl_add_own_parameter(struct text *text, const struct glsl_stage *f, const char *name)
{
    add_parameter(text, f, name, strlen(name), true);
}

void glsl_add_lobe(struct text *text, const struct glsl_stage *f)
{
    text_add(text, f->microfacet ? "microfacet_of(" : "reflected_of(");
    for (const char *at = calls[f->choices->reflection]; *at;) {
        size_t length = name_length(at), member = length && at[length] == '.' ? name_length(at + length + 1) : 0;
        if (is_name(at, length, "m") && member) {
            add_parameter(text, f, at + length + 1, member, false);
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
        add_parameter(text, f, "shininess", strlen("shininess"), false);
    else
        text_add(text, "1.0"); // the base is 0: no highlight
    text_add(text, ")");
}

// --- layers

// Appends the value of a layer's field at the point: the value from the maps or, if no map changes the field, the value
// of the visible side's material.
static void add_layer_field(struct text *text, const struct glsl_stage *f, const char *member, const char *field,
                            bool color)
{
    if (glsl_maps_have(f, member))
        text_print(text, "maps.%s", member);
    else if (!f->choices->products)
        text_print(text, "m.%s%s", field, color ? ".rgb" : "");
    else if (f->back_material)
        text_print(text, "(front ? %s : back_%s)%s", field, field, color ? ".rgb" : "");
    else
        text_print(text, "%s%s", field, color ? ".rgb" : "");
}

void glsl_add_layers(struct text *text, const struct glsl_stage *f)
{
    for (int i = 0; material_field(i); i++) { // the numbers are in the order of the table of fields
        const struct material_field *row = material_field(i);
        const struct glsl_layer_input *input = glsl_layer_input_of(row);
        if (!input || !(f->layers & row->layer))
            continue;
        text_print(text, "    given.%s = ", input->member);
        add_layer_field(text, f, input->member, input->field, input->color);
        text_add(text, ";\n");
    }
    if (f->layers & LAYER_ANISOTROPY) {
        if (glsl_maps_have(f, "stretch")) {
            text_add(text, "    vec3 turned = maps.stretch;\n");
        } else {
            text_add(text, "    float angle = ");
            add_layer_field(text, f, "anisotropy_rotation_rad", "anisotropy_rotation_rad", false);
            text_add(text, ";\n    vec3 turned = vec3(cos(angle), sin(angle), ");
            add_layer_field(text, f, "anisotropy", "anisotropy", false);
            text_add(text, ");\n");
        }
        text_add(text, "    given.anisotropy = turned.z;\n"
                       "    given.stretch = along_surface(s.n, s.t, turned.x, turn * turned.y);\n");
    }
    if (f->layers & LAYER_VOLUME) {
        text_add(text, "    mat3 axes = mat3(model_view);\n"
                       "    vec3 path = volume_path(s.v, s.n, given.ior, axes[0], axes[1], axes[2]);\n"
                       "    float attenuation = ");
        add_layer_field(text, f, "attenuation_distance", "attenuation_distance", false);
        text_add(text, ";\n    vec3 left = ");
        add_layer_field(text, f, "attenuation_color", "attenuation_color", true);
        text_add(text, ";\n    given.attenuation_log = vec3(log2_of(left.x), log2_of(left.y), log2_of(left.z));\n"
                       "    given.path = attenuation > 0.0 ? given.thickness * square_root(dot3(path, path)) / "
                       "attenuation : 0.0;\n");
    }
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
