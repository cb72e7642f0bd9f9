// lecture.c: the text of shaders in the lecture style, from lecture.glsl.
#include "lecture.h"

#include "fail.h"
#include "lecture.inc"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool lecture_check(const struct glsl_choices *c, const struct glsl_facts *f, lam_error *error)
{
    bool masked = c->alpha[0] == LAM_ALPHA_MASK || c->alpha[1] == LAM_ALPHA_MASK;
    bool other = f->lit && c->reflection != LAM_REFLECTION_LAMBERT && c->reflection != LAM_REFLECTION_PHONG &&
                 c->reflection != LAM_REFLECTION_BLINN_PHONG;
    const lam_reflection_info *lobe = lam_reflection_describe(c->reflection);
    const struct {
        bool asked;
        const char *what, *instead;
    } missing[] = {
        {!output_is_picture(c->output), "'--show'", ""},
        {other, NULL, "'--reflection lambert', 'phong' or 'blinn-phong', or "},
        {f->mapped || masked, "textures", ""},
        {c->storage == GLSL_TEXTURE, "'--lights-in texture'", "'--lights-in array' or "},
        {c->shadows || c->passed || c->catches, "'--shadows'", ""},
        {c->occlusion, "'--ao'", "'--ao off' or "},
        {c->gl1, "'--gl1'", ""},
        {f->back_material, "'--back-material'", ""},
        {c->exposes, "'--exposure'", ""},
        {c->tone > LAM_TONE_NONE, "'--tone'", "'--tone none' or "},
        {f->environment && (f->environment_light || c->environment != GLSL_CUBE), "'--environment'", ""},
        {c->layer != GLSL_NO_LAYERS, "translucent surfaces on this device", ""},
    };
    for (size_t i = 0; i < sizeof missing / sizeof *missing; i++)
        if (missing[i].asked && missing[i].what)
            return fail(error, LAM_UNSUPPORTED, "'--style lecture' does not have %s; expected %s'--style full'",
                        missing[i].what, missing[i].instead);
        else if (missing[i].asked)
            return fail(error, LAM_UNSUPPORTED,
                        "'--style lecture' does not have '--reflection %s'; expected %s'--style full'",
                        lobe ? lobe->word : "none", missing[i].instead);
    return true;
}

// The condition on a loop's index that selects the lights first...end-1 of all: "i >= 1 && i < 3"; "" for all lights.
static void index_condition(char out[48], int first, int end, int all)
{
    char from[20] = "", to[20] = "";
    if (first > 0)
        snprintf(from, sizeof from, "i >= %d", first);
    if (end < all)
        snprintf(to, sizeof to, "i < %d", end);
    snprintf(out, 48, "%s%s%s", from, *from && *to ? " && " : "", to);
}

// The vector from the point to the light. Directional lights, which are together, have none to a place.
static void add_way(struct text *text, const struct glsl_choices *c)
{
    int first = 0, directional = 0, before = 0;
    for (int i = 0; i < c->group_count; i++) {
        if (c->groups[i].kind == LIGHT_DIRECTIONAL) {
            first = directional ? first : before;
            directional += c->groups[i].count;
        }
        before += c->groups[i].count;
    }
    char condition[48];
    index_condition(condition, first, first + directional, c->light_count);
    if (!directional)
        text_add(text, "lights[i].position.xyz - P");
    else if (!*condition)
        text_add(text, "-lights[i].direction.xyz");
    else
        text_print(text, "%s ? -lights[i].direction.xyz : lights[i].position.xyz - P", condition);
}

// The lines that set `spot`, the factor of a spotlight's cone, for each kind of cone.
static void add_spots(struct text *text, const struct glsl_choices *c)
{
    static const char *const factors[GLSL_KINDS] = {
        [LIGHT_SPOT_CUTOFF] = "c >= cutoff ? pow(max(c, 1.0e-6), exponent) : 0.0; // dark outside of the cone",
        [LIGHT_SPOT_EXPONENT] = "pow(max(c, 1.0e-6), lights[i].cone.y); // brightest on the axis",
        [LIGHT_SPOT_CONES] = "pow(clamp((c - lights[i].cone.z) * lights[i].cone.w, 0.0, 1.0), 2.0); // two cones"};
    bool first = true;
    int ends[GLSL_KINDS + 1] = {0}, begins[GLSL_KINDS] = {0}, at = 0;
    for (int i = 0; i < c->group_count; i++) {
        int kind = c->groups[i].kind;
        if (ends[kind] == 0)
            begins[kind] = at;
        at += c->groups[i].count;
        ends[kind] = at;
    }
    for (int kind = LIGHT_SPOT_CUTOFF; kind < GLSL_KINDS; kind++) {
        if (!ends[kind])
            continue;
        char condition[48];
        index_condition(condition, begins[kind], ends[kind], c->light_count);
        if (!*condition) {
            text_print(text, "        float spot = %s", factors[kind]);
            continue;
        }
        if (first)
            text_add(text, "        float spot = 1.0;\n");
        text_print(text, "%s        if (%s)\n            spot = %s", first ? "" : "\n", condition, factors[kind]);
        first = false;
    }
}

static bool has_range(const struct glsl_choices *c)
{
    bool any = false;
    for (int i = 0; i < c->group_count; i++)
        any |= c->groups[i].falloff == FALLOFF_RANGE;
    return any;
}

static bool has_cutoff(const struct glsl_choices *c)
{
    bool any = false;
    for (int i = 0; i < c->group_count; i++)
        any |= c->groups[i].kind == LIGHT_SPOT_CUTOFF;
    return any;
}

void lecture_add(struct text *text, const struct glsl_facts *f, bool fragment)
{
    const struct glsl_choices *c = f->choices;
    bool glsl_120 = c->version == GLSL_120, flat = f->shading == LAM_SHADING_FLAT;
    bool lights_here = f->lit && fragment == f->per_fragment, tints = c->colors && f->lit;
    struct text attributes = {0}, way = {0}, spots = {0};
    glsl_declare_attributes(&attributes, f);
    add_way(&way, c);
    add_spots(&spots, c);
    const struct preprocess_flag flags[] = {
        {"fragment", fragment},
        {"glsl_120", glsl_120},
        {"per_fragment", f->per_fragment},
        {"application", f->application},
        {"two_sided", c->two_sided},
        {"passes_tint", tints && f->per_fragment},
        {"lights_here", lights_here},
        {"products", c->products},
        {"highlights", f->highlights},
        {"reads_eye", f->highlights || f->environment},
        {"distant_viewer", c->distant_viewer},
        {"has_hemispheres", f->hemispheres},
        {"has_lights", f->lights},
        {"has_falloff", f->attenuated},
        {"has_range", has_range(c)},
        {"has_cone", f->cones},
        {"has_cutoff", has_cutoff(c)},
        {"has_environment", f->environment},
        {"phong", f->highlights && c->reflection == LAM_REFLECTION_PHONG},
        {"blinn_phong", f->highlights && c->reflection == LAM_REFLECTION_BLINN_PHONG},
        {"encodes", fragment && c->encoding == GLSL_ENCODED},
        {"premultiplied", c->encoding == GLSL_PREMULTIPLIED},
        {NULL, false},
    };
    char varying[32], lights[16], hemispheres[16], opacity[48], diffuse[64], parameters[64], arguments[64];
    snprintf(varying, sizeof varying, "%s%s", flat && !glsl_120 ? "flat " : "",
             glsl_120   ? "varying "
             : fragment ? "in "
                        : "out ");
    snprintf(lights, sizeof lights, "%d", c->light_count);
    snprintf(hemispheres, sizeof hemispheres, "%d", c->hemisphere_count);
    const char *tint = f->per_fragment ? "tint" : "color";
    snprintf(opacity, sizeof opacity, "%s%s%s",
             c->alpha[0] == LAM_ALPHA_OPAQUE ? "1.0"
             : c->products                   ? "diffuse.a"
                                             : "material.diffuse.a",
             tints && c->alpha[0] != LAM_ALPHA_OPAQUE ? " * " : "",
             tints && c->alpha[0] != LAM_ALPHA_OPAQUE ? (f->per_fragment ? "tint.a" : "color.a") : "");
    snprintf(diffuse, sizeof diffuse, "%s%s", tints ? "tint.rgb * " : "",
             c->products ? "diffuse_product[i].rgb" : "kd * lights[i].diffuse.rgb");
    snprintf(parameters, sizeof parameters, "vec3 P, vec3 N%s", tints ? ", vec4 tint" : "");
    snprintf(arguments, sizeof arguments, "eye_position, N%s%s", tints ? ", " : "", tints ? tint : "");
    const struct preprocess_value values[] = {
        {"attributes", attributes.bytes ? attributes.bytes : ""},
        {"varying", varying},
        {"parameters", parameters},
        {"arguments", arguments},
        {"tinted", tints ? "tint.rgb * " : ""},
        {"emission", c->products ? "emission.rgb" : "material.emission.rgb"},
        {"hemispheres", hemispheres},
        {"lights", lights},
        {"way", way.bytes ? way.bytes : ""},
        {"spots", spots.bytes ? spots.bytes : ""},
        {"diffuse_light", diffuse},
        {"specular_light", c->products ? "specular_product[i].rgb" : "ks * lights[i].specular.rgb"},
        {"shininess", c->products ? "shininess" : "material.shininess"},
        {"reflectivity", c->products ? "reflectivity.rgb" : "material.reflectivity.rgb"},
        {"arriving", f->cones && f->attenuated ? "spot * attenuation * "
                     : f->cones                ? "spot * "
                     : f->attenuated           ? "attenuation * "
                                               : ""},
        {"texture_cube", glsl_120 ? "textureCube" : "texture"},
        {"opacity", opacity},
        {"lit_position", flat && glsl_120 ? "provoking_position" : "position"},
        {"pixel", glsl_120 ? "gl_FragColor" : "pixel"},
        {NULL, NULL},
    };
    const struct preprocess_words words = {flags, values};
    const struct text *parts[] = {&attributes, &way, &spots};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        if (parts[i]->failed) {
            text->failed = true;
            text->error = parts[i]->error;
        }
    preprocess_add(text, text_lecture_glsl, &words);
    free(attributes.bytes);
    free(way.bytes);
    free(spots.bytes);
}
