// lecture.c: generates shaders in the lecture style, from lecture.glsl.
#include "lecture.h"

#include "fail.h"
#include "lecture.inc"

#include <stdio.h>

bool lecture_check(const struct glsl_choices *c, const struct glsl_stage *f, lam_error *error)
{
    const lam_reflection_info *lobe = lam_reflection_describe(c->reflection);
    bool masked = c->alpha[0] == LAM_ALPHA_MASK || c->alpha[1] == LAM_ALPHA_MASK;
    bool other = f->lit && c->reflection != LAM_REFLECTION_LAMBERT && c->reflection != LAM_REFLECTION_PHONG &&
                 c->reflection != LAM_REFLECTION_BLINN_PHONG && c->reflection != LAM_REFLECTION_KAJIYA_KAY &&
                 c->reflection != LAM_REFLECTION_KAJIYA_KAY_LECTURE && c->reflection != LAM_REFLECTION_TOON &&
                 !(lobe && lobe->toned);
    const struct {
        bool asked;
        const char *what, *instead;
    } missing[] = {
        {!output_is_picture(c->output), "'lam_draw_params.output'", ""},
        {other, NULL,
         "'lam_draw_params.reflection lambert', 'phong', 'blinn-phong', 'kajiya-kay', 'toon' or 'gooch', or "},
        {f->has_maps || masked, "textures", ""},
        {c->storage == GLSL_TEXTURE, "'lam_shader_params.lights texture'", "'lam_shader_params.lights array' or "},
        {c->shadows || c->passed || c->catches, "'lam_draw_params.shadows'", ""},
        {c->occlusion, "'lam_draw_params.occlusion'", "'lam_draw_params.occlusion off' or "},
        {c->widens, "'lam_draw_params.specular_aa'", "'lam_draw_params.specular_aa off' or "},
        {c->gl1, "'lam_draw_params.gl1'", ""},
        {f->back_material, "'lam_object.back_material'", ""},
        {c->exposes, "'lam_draw_params.exposure'", ""},
        {c->tone > LAM_TONE_NONE, "'lam_draw_params.tone'", "'lam_draw_params.tone none' or "},
        {f->has_environment && (f->environment_light || c->environment != GLSL_CUBE), "'lam_scene_set_environment'",
         ""},
        {c->layer != GLSL_NO_LAYERS, "translucent surfaces on this device", ""},
    };
    for (size_t i = 0; i < sizeof missing / sizeof *missing; i++)
        if (missing[i].asked && missing[i].what)
            return fail(
                error, LAM_UNSUPPORTED,
                "'lam_shader_params.style lecture' does not support %s; expected %s'lam_shader_params.style full'",
                missing[i].what, missing[i].instead);
        else if (missing[i].asked)
            return fail(error, LAM_UNSUPPORTED,
                        "'lam_shader_params.style lecture' does not support 'lam_draw_params.reflection %s'; expected "
                        "%s'lam_shader_params.style full'",
                        lobe ? lobe->word : "none", missing[i].instead);
    return true;
}

// Lights of one kind are consecutive. Writes the condition on a loop's index that selects the lights of a kind: "i >= 1
// && i < 3", or "" if all lights are of this kind. Returns their number.
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

static bool has_kind(const struct glsl_choices *c, int kind)
{
    char condition[48];
    return lights_of(c, kind, condition) > 0;
}

void lecture_add_flags(struct constant_table *t, const struct glsl_stage *f)
{
    const struct glsl_choices *c = f->choices;
    bool any_range = false;
    for (int i = 0; i < c->group_count; i++)
        any_range |= c->groups[i].falloff == FALLOFF_RANGE;
    constant_stage(t, f);
    constant_flag(t, "has_range", any_range);
    constant_flag(t, "has_cutoff", has_kind(c, LIGHT_SPOT_CUTOFF));
    constant_flag(t, "gated_threads", c->reflection == LAM_REFLECTION_KAJIYA_KAY);
    constant_flag(t, "phong", f->highlights && c->reflection == LAM_REFLECTION_PHONG);
    constant_flag(t, "toon", f->highlights && c->reflection == LAM_REFLECTION_TOON);
    constant_flag(t, "blinn_phong", f->highlights && c->reflection == LAM_REFLECTION_BLINN_PHONG);
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
            text_print(text, "        %s spot = %s\n", number, factors[kind]);
            continue;
        }
        if (first)
            text_print(text, "        %s spot = 1.0;\n", number);
        text_print(text, "        if (%s)\n            spot = %s\n", condition, factors[kind]);
        first = false;
    }
}

// Adds the values of the material and of the vertex colour.
static void add_material(struct constant_table *t, const struct glsl_stage *f)
{
    const struct glsl_choices *c = f->choices;
    const char *tint = !f->vertex_colors ? "" : f->per_fragment ? "tint" : "color", *p = c->products ? "" : "material.";
    bool opaque = c->alpha[0] == LAM_ALPHA_OPAQUE;
    text_print(constant_made(t, "OPACITY"), "%s%s%s%s%s", opaque ? "" : p, opaque ? "1.0" : "diffuse.a",
               opaque || !*tint ? "" : " * ", opaque ? "" : tint, opaque || !*tint ? "" : ".a");
    text_print(constant_made(t, "DIFFUSE_LIGHT"), "%s%s", *tint ? "tint.rgb * " : "",
               c->products ? "diffuse_product[i].rgb" : "kd * lights[i].diffuse.rgb");
    constant_text(t, "SPECULAR_LIGHT", c->products ? "specular_product[i].rgb" : "ks * lights[i].specular.rgb");
    text_print(constant_made(t, "EMISSION"), "%semission.rgb", p);
    text_print(constant_made(t, "SHININESS"), "%sshininess", p);
    text_print(constant_made(t, "FIBRE"), "%sfibre", p);
    text_print(constant_made(t, "STEPS"), "%stoon_steps", p);
    text_print(constant_made(t, "REFLECTIVITY"), "%sreflectivity.rgb", p);
    text_print(constant_made(t, "PARAMETERS"), "vec3 P, vec3 N%s%s", f->needs_tangent_attribute ? ", vec3 T" : "",
               *tint ? ", vec4 tint" : "");
    text_print(constant_made(t, "ARGUMENTS"), "eye_position, N%s%s%s",
               !f->needs_tangent_attribute ? ""
               : f->per_fragment           ? ", eye_tangent"
                                           : ", T",
               *tint ? ", " : "", tint);
}

static void add_stage(struct text *text, const struct glsl_stage *f)
{
    const struct glsl_choices *c = f->choices;
    struct constant_table t = {.count = 0};
    lecture_add_flags(&t, f);
    constant_flag(&t, "lights_here", f->lit && f->fragment == f->per_fragment);
    glsl_declare_attributes(constant_made(&t, "ATTRIBUTES"), f);
    add_material(&t, f);
    constant_number(&t, "HEMISPHERES", c->hemisphere_count);
    glsl_add_sky_color(constant_made(&t, "SKY_COLOR"), c, "ka", "kd");
    constant_number(&t, "LIGHTS", c->light_count);
    lecture_add_way(constant_made(&t, "WAY"), c, "-lights[i].direction.xyz", "lights[i].position.xyz - P");
    lecture_add_spots(constant_made(&t, "SPOTS"), c, "float");
    text_print(constant_made(&t, "ARRIVING"), "%s%s%s", f->has_cone ? "spot" : "",
               f->has_cone && f->has_falloff ? " * " : "", f->has_falloff ? "attenuation" : "");
    constant_specialize(text, text_lecture_glsl, &t);
}

const struct glsl_style lecture_style = {.check = lecture_check, .add_stage = add_stage, .change = mistake_apply};
