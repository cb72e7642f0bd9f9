// lecture.c: the text of shaders in the lecture style, from lecture.glsl.
#include "lecture.h"

#include "fail.h"
#include "lecture.inc"

#include <stdio.h>
#include <stdlib.h>

bool lecture_check(const struct glsl_choices *c, const struct glsl_facts *f, lam_error *error)
{
    bool masked = c->alpha[0] == LAM_ALPHA_MASK || c->alpha[1] == LAM_ALPHA_MASK;
    bool other = f->lit && c->reflection != LAM_REFLECTION_LAMBERT && c->reflection != LAM_REFLECTION_PHONG &&
                 c->reflection != LAM_REFLECTION_BLINN_PHONG && c->reflection != LAM_REFLECTION_KAJIYA_KAY &&
                 c->reflection != LAM_REFLECTION_KAJIYA_KAY_LECTURE;
    const lam_reflection_info *lobe = lam_reflection_describe(c->reflection);
    const struct {
        bool asked;
        const char *what, *instead;
    } missing[] = {
        {!output_is_picture(c->output), "'--show'", ""},
        {other, NULL, "'--reflection lambert', 'phong', 'blinn-phong' or 'kajiya-kay', or "},
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

// Lights of a kind are together. Writes the condition on a loop's index that selects them: "i >= 1 && i < 3"; "" if all lights
// are. Returns their number.
static int lights_of(const struct glsl_choices *c, int kind, char condition[48])
{
    int first = 0, count = 0, at = 0;
    for (int i = 0; i < c->group_count; at += c->groups[i++].count)
        if (c->groups[i].kind == kind) {
            first = count ? first : at;
            count += c->groups[i].count;
        }
    char from[20] = "", to[20] = "";
    if (first > 0)
        snprintf(from, sizeof from, "i >= %d", first);
    if (first + count < c->light_count)
        snprintf(to, sizeof to, "i < %d", first + count);
    snprintf(condition, 48, "%s%s%s", from, *from && *to ? " && " : "", to);
    return count;
}

bool lecture_has_kind(const struct glsl_choices *c, int kind)
{
    char condition[48];
    return lights_of(c, kind, condition) > 0;
}

bool lecture_has_range(const struct glsl_choices *c)
{
    bool any = false;
    for (int i = 0; i < c->group_count; i++)
        any |= c->groups[i].falloff == FALLOFF_RANGE;
    return any;
}

void lecture_add_way(struct text *text, const struct glsl_choices *c, const char *against, const char *towards)
{
    char condition[48];
    if (!lights_of(c, LIGHT_DIRECTIONAL, condition))
        text_add(text, towards);
    else if (!*condition)
        text_add(text, against);
    else
        text_print(text, "%s ? %s : %s", condition, against, towards);
}

void lecture_add_spots(struct text *text, const struct glsl_choices *c, const char *number)
{
    static const char *const factors[GLSL_KINDS] = {
        [LIGHT_SPOT_CUTOFF] = "c >= cutoff ? pow(max(c, 1.0e-6), exponent) : 0.0; // dark outside of the cone",
        [LIGHT_SPOT_EXPONENT] = "pow(max(c, 1.0e-6), lights[i].cone.y); // brightest on the axis",
        [LIGHT_SPOT_CONES] = "pow(clamp((c - lights[i].cone.z) * lights[i].cone.w, 0.0, 1.0), 2.0); // two cones"};
    bool first = true;
    for (int kind = LIGHT_SPOT_CUTOFF; kind < GLSL_KINDS; kind++) {
        char condition[48];
        if (!lights_of(c, kind, condition))
            continue;
        if (!*condition) {
            text_print(text, "        %s spot = %s", number, factors[kind]);
            continue;
        }
        if (first)
            text_print(text, "        %s spot = 1.0;\n", number);
        text_print(text, "%s        if (%s)\n            spot = %s", first ? "" : "\n", condition, factors[kind]);
        first = false;
    }
}

void lecture_add(struct text *text, const struct glsl_facts *f, bool fragment)
{
    const struct glsl_choices *c = f->choices;
    bool glsl_120 = c->version == GLSL_120, flat = f->shading == LAM_SHADING_FLAT;
    bool lights_here = f->lit && fragment == f->per_fragment, tints = c->colors && f->lit;
    bool tangents = f->tangent && c->tangents;
    struct text attributes = {0}, way = {0}, spots = {0};
    glsl_declare_attributes(&attributes, f);
    lecture_add_way(&way, c, "-lights[i].direction.xyz", "lights[i].position.xyz - P");
    lecture_add_spots(&spots, c, "float");
    const struct preprocess_flag flags[] = {
        LECTURE_FLAGS(c, f),
        {"fragment", fragment},
        {"glsl_120", glsl_120},
        {"per_fragment", f->per_fragment},
        {"application", f->application},
        {"passes_tint", tints && f->per_fragment},
        {"lights_here", lights_here},
        {"products", c->products},
        {"reads_eye", f->highlights || f->environment},
        {"has_environment", f->environment},
        {"tangents", c->tangents},
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
    snprintf(parameters, sizeof parameters, "vec3 P, vec3 N%s%s", tangents ? ", vec3 T" : "",
             tints ? ", vec4 tint" : "");
    snprintf(arguments, sizeof arguments, "eye_position, N%s%s%s",
             !tangents         ? ""
             : f->per_fragment ? ", eye_tangent"
                               : ", T",
             tints ? ", " : "", tints ? tint : "");
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
        {"fibre", c->products ? "fibre" : "material.fibre"},
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
