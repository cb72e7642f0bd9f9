// glsl_stage.c: the text of a stage after its uniforms, from the *.glsl files and what depends on more than flags.
#include "environment_light.h"
#include "glsl_rows.h"
#include "stages.inc"

#include <stdio.h>

// --- the lights

#define WORD(name) [name] = #name
static const char *const kind_words[GLSL_KINDS] = {WORD(LIGHT_POINT), WORD(LIGHT_DIRECTIONAL), WORD(LIGHT_SPOT_CUTOFF),
                                                   WORD(LIGHT_SPOT_EXPONENT), WORD(LIGHT_SPOT_CONES)};
static const char *const falloff_words[GLSL_FALLOFFS] = {WORD(FALLOFF_NONE), WORD(FALLOFF_DISTANCE),
                                                         WORD(FALLOFF_RANGE)};

static const char *list_argument(const struct glsl_facts *f)
{
    return !f->choices->products ? ", m" : f->back_material ? ", front" : "";
}

static void add_groups(struct text *text, const struct glsl_facts *f)
{
    const struct glsl_choices *c = f->choices;
    int first = 0;
    if (c->shadows && f->has_lights)
        text_print(text, "    start_rays(s.p, lit_triangle, %s);\n",
                   c->two_sided && f->per_fragment ? "gl_FrontFacing ? 1.0 : -1.0" : "1.0");
    for (int i = 0; f->adds_lights && i < c->group_count; i++) {
        const struct glsl_group *group = &c->groups[i];
        text_print(text, "    for (int i = %d; i < %d; i++) {\n", first, first + group->count);
        text_print(text, "        light_source light = light_of(i%s);\n", list_argument(f));
        text_print(text, "        light_sample t = toward_light(s.p, light, %s, %s);\n", kind_words[group->kind],
                   falloff_words[group->falloff]);
        if (c->gl1)
            text_print(text, "        sum = add_arriving_ambient(sum, ambient_of(i%s), t);\n", list_argument(f));
        if (c->passed)
            text_add(text, "        t.attenuation = t.attenuation * passed_light(i, s.p);\n");
        if (c->shadows)
            text_print(text,
                       c->tints_rays ? "        light = tinted_light(light, passed_light(%s, light, t, %s, %s));\n"
                                     : "        t.attenuation = t.attenuation * passed_light(%s, light, t, %s, %s);\n",
                       c->storage == GLSL_TEXTURE ? "list_texel(light_list, i * 4)" : "lights[i].position",
                       f->needs_tangent || f->layers ? "1.0" : "dot3(s.n, t.l)", kind_words[group->kind]);
        if (f->layers) {
            text_add(text, "        sum = add_layered(sum, light, t, layered_light(s, layering, t.l, ");
            glsl_add_lobe(text, f);
            text_add(text, ", 0));\n");
        } else {
            if (f->microfacet)
                text_add(text, "        light = with_fresnel(light, mirror, s.v, t.l);\n");
            text_add(text, "        sum = add_reflected(sum, light, t, ");
            glsl_add_lobe(text, f);
            text_add(text, ");\n");
        }
        first += group->count;
        text_add(text, "    }\n");
    }
}

// --- the output

enum {
    TERM_AMBIENT = 1,
    TERM_DIFFUSE = 2,
    TERM_SPECULAR = 4,
    TERM_EMISSION = 8,
    TERM_REFLECTION = 16,
    TERMS_ALL = 31,
    TERM_MATTE = 32,         // the part of the reflection that a diffuse map multiplies,
    TERM_WITHOUT_MATTE = 64, // and the reflection without it
};

static int shown_terms(const struct glsl_choices *c)
{
    switch (c->output) {
    case LAM_OUTPUT_AMBIENT:
        return TERM_AMBIENT;
    case LAM_OUTPUT_DIFFUSE:
        return TERM_DIFFUSE;
    case LAM_OUTPUT_SPECULAR:
        return TERM_SPECULAR;
    case LAM_OUTPUT_EMISSION:
        return TERM_EMISSION;
    case LAM_OUTPUT_REFLECTION:
        return TERM_REFLECTION;
    case LAM_OUTPUT_LIGHT:
        return c->reflection == LAM_REFLECTION_NONE ? 0 : TERM_AMBIENT | TERM_DIFFUSE | TERM_SPECULAR;
    default:
        return TERMS_ALL;
    }
}

// Appends the sum of terms, in the order of sum_terms.
static void add_sum(struct text *text, int terms)
{
    static const struct {
        int term;
        char name[32];
    } rows[] = {{TERM_EMISSION, "sum.emission"},
                {TERM_AMBIENT, "sum.ambient"},
                {TERM_DIFFUSE, "sum.diffuse"},
                {TERM_SPECULAR, "sum.specular"},
                {TERM_REFLECTION, "sum.reflection"},
                {TERM_MATTE, "matte"},
                {TERM_WITHOUT_MATTE, "sub3(sum.reflection, matte)"}};
    if (terms == TERMS_ALL || !terms) {
        text_add(text, terms ? "sum_terms(sum)" : "black3()");
        return;
    }
    for (int left = terms & (terms - 1); left; left &= left - 1)
        text_add(text, "add3(");
    bool first = true;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (terms & rows[i].term) {
            text_print(text, first ? "%s" : ", %s)", rows[i].name);
            first = false;
        }
}

// The terms that a diffuse map multiplies, and the rest. An emission map multiplies the emission apart from both.
static int mapped_terms(const struct glsl_facts *f)
{
    int shown = shown_terms(f->choices);
    return (shown & (TERM_AMBIENT | TERM_DIFFUSE)) |
           (f->separate_reflection && shown & TERM_REFLECTION ? TERM_MATTE : 0);
}

static int rest_terms(const struct glsl_facts *f)
{
    int rest = shown_terms(f->choices) & (TERM_SPECULAR | TERM_EMISSION | TERM_REFLECTION);
    if (f->maps[0][LAM_MAP_EMISSION] || f->maps[1][LAM_MAP_EMISSION])
        rest &= ~TERM_EMISSION;
    return f->separate_reflection && rest & TERM_REFLECTION ? rest ^ (TERM_REFLECTION | TERM_WITHOUT_MATTE) : rest;
}

// Writes the output of the material at the point, such as its base colour or roughness.
static void add_output_material(struct text *text, const struct glsl_facts *f)
{
    lam_output output = f->choices->output;
    const char *map = output == LAM_OUTPUT_OCCLUSION ? "occlusion" : output == LAM_OUTPUT_LOD ? "level" : NULL;
    if (output == LAM_OUTPUT_BASE_COLOR) {
        text_add(text, "sum.diffuse");
    } else if (map) {
        text_print(text, glsl_maps_have(f, map) ? "vec3(maps.%s)" : "vec3(%s)",
                   glsl_maps_have(f, map)           ? map
                   : output == LAM_OUTPUT_OCCLUSION ? "1.0"
                                                    : "0.0");
    } else {
        text_add(text, "vec3(");
        if (glsl_is_physical(f))
            glsl_add_parameter(text, f, output == LAM_OUTPUT_ROUGHNESS ? "roughness" : "metallic");
        else
            text_add(text, "0.0");
        text_add(text, ")");
    }
}

static void add_output_vector(struct text *text, const struct glsl_facts *f)
{
    const struct glsl_choices *c = f->choices;
    if (!f->output_one_light) {
        text_print(text, "    return vec4(%s, 1.0);\n", c->output == LAM_OUTPUT_TANGENTS ? "s.t" : "s.n");
        return;
    }
    bool texture = c->storage == GLSL_TEXTURE;
    text_add(text, "    light_source light;\n");
    text_print(text, "    light.position = %s.xyz;\n",
               texture ? "texelFetch(light_list, ivec2(0, 0), 0)" : "lights[0].position");
    text_print(text, "    light.direction = %s.xyz;\n",
               texture ? "texelFetch(light_list, ivec2(1, 0), 0)" : "lights[0].direction");
    text_print(text, "    vec3 l = toward_light(s.p, light, %s, FALLOFF_NONE).l;\n",
               kind_words[c->group_count && c->groups[0].kind == LIGHT_DIRECTIONAL ? LIGHT_DIRECTIONAL : LIGHT_POINT]);
    text_print(text, "    float c = cosine(dot3(s.n, %s));\n    return vec4(c, c, c, 1.0);\n",
               c->output == LAM_OUTPUT_N_L ? "l" : "halfway3(l, s.v)");
}

// Writes how the alpha mode turns `light.a` into the fragment's opacity.
static void add_alpha_rule(struct text *text, const struct glsl_facts *f)
{
    const struct glsl_choices *c = f->choices;
    bool colors = !f->output_geometry && !f->output_vector && !f->output_material;
    for (int side = 0; side <= f->back_material && colors; side++) {
        static const char *const conditions[] = {"!gl_FrontFacing && ", "gl_FrontFacing && "};
        bool both = !f->back_material || c->alpha[0] == c->alpha[1];
        const char *p = side ? "back_" : "";
        if (c->alpha[side] == LAM_ALPHA_MASK)
            text_print(text, "    if (%s!(light.a >= %salpha_cutoff)) {\n        discard;\n    }\n",
                       f->back_material ? conditions[!side] : "", p);
        if (c->alpha[side] == LAM_ALPHA_BLEND || (both && side))
            continue;
        if (both)
            text_add(text, "    light.a = 1.0;\n");
        else
            text_print(text, "    if (%sgl_FrontFacing) {\n        light.a = 1.0;\n    }\n", side ? "!" : "");
    }
}

// Leaves out the points of masked surfaces where the fragment writes no light.
static void add_value_mask(struct text *text, const struct glsl_facts *f)
{
    const struct glsl_choices *c = f->choices;
    text_print(text, "    float opacity = %s%s;\n", glsl_maps_have(f, "opacity") ? "maps.opacity" : "1.0",
               c->colors ? " * tint.a" : "");
    for (int side = 0; side <= f->back_material; side++)
        if (c->alpha[side] == LAM_ALPHA_MASK)
            text_print(text, "    if (%s!(saturate(opacity) >= %salpha_cutoff)) {\n        discard;\n    }\n",
                       !f->back_material ? ""
                       : side            ? "!gl_FrontFacing && "
                                         : "gl_FrontFacing && ",
                       side ? "back_" : "");
}

// --- parameters and arguments

enum use {
    DECLARED,
    FRONT,
    BACK,
    FRAGMENT
}; // light_point's parameters; the arguments for a vertex's sides, and a fragment's

static void add_list(struct text *text, bool wanted, const char *item)
{
    if (wanted)
        text_print(text, "%s%s", text->length ? ", " : "", item);
}

#define MESH_TANGENT "field_tangent(unit3(n), model_view[1].xyz, model_view[0].xyz)"

static void add_arguments(struct text *text, const struct glsl_facts *f, enum use use)
{
    bool maps = f->has_maps && !f->output_vector && !f->maps_interpolated_light;
    const struct {
        bool wanted;
        char items[4][72];
    } rows[] = {
        {!f->unlit, {"vec3 p, vec3 normal", "p, n", "p, n", "eye_position, n"}},
        {!f->unlit && f->needs_tangent && !f->tangent_field, {"vec3 tangent", "t", "t", "eye_tangent"}},
        {!f->unlit && f->tangent_field, {"vec3 tangent", MESH_TANGENT, MESH_TANGENT, MESH_TANGENT}},
        {f->has_anisotropy, {"float turn", "turn", "-turn", "turn"}},
        {f->has_coat_normal, {"vec3 coat", "coat", "coat", "coat"}},
        {f->vertex_colors, {"vec4 tint", "color", "color", "tint"}},
        {f->back_material, {"bool front", "true", "false", "gl_FrontFacing"}},
        {maps, {"surface_maps maps", "maps", "maps", "maps"}},
        {f->separate_texture_terms && !maps, {"out vec3 rest", "front_rest", "back_rest", "rest"}},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        add_list(text, rows[i].wanted, rows[i].items[use]);
}

static void add_map_arguments(struct text *text, const struct glsl_facts *f)
{
    add_list(text, f->first_texcoords, "first");
    add_list(text, f->second_texcoords, "second");
    add_list(text, f->has_bump_map, "eye_position");
    add_list(text, f->choices->colors && f->converts, "tint");
}

// --- values of the sources

// Number of texels of a light, of its products, and of a hemisphere.
static int light_texels(const struct glsl_choices *c) { return c->products ? 4 : c->gl1 ? 7 : 6; }
static int product_texels(const struct glsl_choices *c) { return c->gl1 ? 3 : 2; }
static int hemisphere_texels(const struct glsl_choices *c) { return c->products ? 1 : 3; }

static const char *list_parameter(const struct glsl_facts *f)
{
    return !f->choices->products ? ", Material m" : f->back_material ? ", bool front" : "";
}

static void put_lists(struct preprocess_tables *v, const struct glsl_facts *f)
{
    const struct glsl_choices *c = f->choices;
    preprocess_number(v, "hemispheres", c->hemisphere_count);
    preprocess_number(v, "light_texels", light_texels(c));
    preprocess_number(v, "product_texels", product_texels(c));
    preprocess_number(v, "hemisphere_texels", hemisphere_texels(c));
    preprocess_number(v, "hemispheres_at", c->light_count * light_texels(c));
    preprocess_number(v, "hemisphere_products_at", c->light_count * product_texels(c));
    preprocess_number(v, "list_width", GLSL_LIST_WIDTH);
    preprocess_value(v, "list_argument", list_argument(f));
    preprocess_value(v, "list_parameter", list_parameter(f));
    add_groups(preprocess_text(v, "groups"), f);
}

static void put_environment(struct preprocess_tables *v)
{
    struct text *sizes = preprocess_text(v, "level_sizes"), *starts = preprocess_text(v, "level_starts");
    for (int i = 0; i <= ENVIRONMENT_LEVELS; i++) {
        int size = i == 0 ? 0 : i < ENVIRONMENT_LEVELS ? prefiltered_size(i) : IRRADIANCE_SIZE;
        text_print(sizes, "%s%d.0", i ? ", " : "", size);
        text_print(starts, "%s%d.0", i ? ", " : "", i ? environment_light_first(i) : 0);
    }
    preprocess_number(v, "level_count", ENVIRONMENT_LEVELS + 1);
    text_print(preprocess_text(v, "level_rows"), "%d.0", environment_light_rows());
}

void glsl_add_interface(struct preprocess_tables *v, const struct glsl_facts *f)
{
    bool flat = f->shading == LAM_SHADING_FLAT;
    const char *smooth = f->glsl_120 ? "varying " : f->fragment ? "in " : "out ";
    glsl_declare_attributes(preprocess_text(v, "attributes"), f);
    preprocess_value(v, "lit_position", flat && f->glsl_120 ? "provoking_position" : "position");
    preprocess_value(v, "smooth_varying", smooth);
    text_print(preprocess_text(v, "varying"), "%s%s", flat && !f->glsl_120 ? "flat " : "", smooth);
    preprocess_value(v, "flat_varying", f->fragment ? "flat in " : "flat out ");
    preprocess_value(v, "pixel", f->glsl_120 ? "gl_FragColor" : "pixel");
    preprocess_value(v, "texture_cube", f->glsl_120 ? "textureCube" : "texture");
}

static void put_arguments(struct preprocess_tables *v, const struct glsl_facts *f)
{
    add_arguments(preprocess_text(v, "lit_parameters"), f, DECLARED);
    add_arguments(preprocess_text(v, "front_arguments"), f, FRONT);
    add_arguments(preprocess_text(v, "back_arguments"), f, BACK);
    add_arguments(preprocess_text(v, "fragment_arguments"), f, FRAGMENT);
    add_map_arguments(preprocess_text(v, "map_arguments"), f);
    preprocess_value(v, "tangent", f->signed_tangent ? "tangent.xyz" : "tangent");
}

static void put_point(struct preprocess_tables *v, const struct glsl_facts *f)
{
    const struct glsl_choices *c = f->choices;
    preprocess_number(v, "anisotropy", c->anisotropy);
    struct text *layers = preprocess_text(v, "layers");
    if (f->layers)
        glsl_add_layers(layers, f);
    glsl_add_parameters(preprocess_text(v, "parameters"), f);
    glsl_add_parameter(preprocess_text(v, "metallic"), f, "metallic");
    glsl_add_parameter(preprocess_text(v, "roughness"), f, "roughness");
    preprocess_value(v, "lambert",
                     glsl_maps_have(f, "dielectric") ? "m.diffuse.rgb" : "scale3(m.diffuse.rgb, 1.0 - m.metallic)");
    preprocess_value(v, "viewer", c->distant_viewer ? "VIEWER_INFINITE" : "VIEWER_LOCAL");
    preprocess_value(v, "passed", c->tints_rays ? "vec3" : "float");
    add_sum(preprocess_text(v, "output_term"), shown_terms(c));
    add_sum(preprocess_text(v, "output_mapped"), mapped_terms(f));
    add_sum(preprocess_text(v, "output_rest"), rest_terms(f));
    add_output_material(preprocess_text(v, "output_material"), f);
    add_output_vector(preprocess_text(v, "output_vector"), f);
    preprocess_value(v, "glow", f->back_material ? "(gl_FrontFacing ? glow : back_glow)" : "glow");
    add_alpha_rule(preprocess_text(v, "alpha_rule"), f);
    add_value_mask(preprocess_text(v, "value_mask"), f);
    preprocess_value(v, "tone", glsl_tone_function(c->tone));
}

// --- the stage

void glsl_add_flags(struct preprocess_tables *v, const struct glsl_facts *f)
{
#define FACT(name)   preprocess_flag(v, #name, f->name);
#define CHOICE(name) preprocess_flag(v, #name, f->choices->name);
    GLSL_FACTS(FACT)
    GLSL_CHOICE_FLAGS(CHOICE)
#undef FACT
#undef CHOICE
    preprocess_flag(v, "lights_in_texture", f->choices->storage == GLSL_TEXTURE);
}

void glsl_add_stage(struct text *text, const struct glsl_facts *f)
{
    const struct glsl_choices *c = f->choices;
    struct preprocess_tables v = {.flag_count = 0};
    glsl_add_flags(&v, f);
    put_lists(&v, f);
    put_environment(&v);
    glsl_add_interface(&v, f);
    put_arguments(&v, f);
    put_point(&v, f);
    const struct preprocess_words words = preprocess_finish(&v, text);
    bool reads_maps = f->fragment && f->has_maps, lights_here = f->lit && f->fragment == f->per_fragment;
    if (!f->glsl_120 && ((reads_maps && f->exact_filter) || (lights_here && c->passes_rays)))
        preprocess_add(text, text_wrapping_glsl, &words);
    if (reads_maps) {
        preprocess_add(text, text_texture_glsl, &words);
        glsl_add_maps(text, f);
    }
    if (lights_here && c->catches)
        text_add(text, "\nbool unobstructed = false; // the point is lit as if nothing were in the way\n");
    if (lights_here && c->shadows)
        preprocess_add(text, text_shadows_glsl, &words);
    if (lights_here)
        preprocess_add(text, text_lighting_glsl, &words);
    preprocess_add(text, text_interface_glsl, &words);
    preprocess_add(text, f->fragment ? text_fragment_glsl : text_vertex_glsl, &words);
    preprocess_free(&v);
}
