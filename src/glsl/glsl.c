// glsl.c: makes the texts of a vertex and a fragment shader from a set of choices.
#include "glsl.h"

#include "environment_light.h"
#include "equations.h"
#include "fail.h"
#include "glsl_known.h"
#include "glsl_rows.h"
#include "lecture.h"
#include "pieces.inc"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool check(const struct glsl_choices *c, const struct glsl_facts *f, lam_error *error)
{
    if (c->version == GLSL_120 && c->storage != GLSL_ARRAY)
        return fail(error, LAM_BAD_ARGUMENT, "GLSL 120 has no %s, expected the lights in an array",
                    c->storage == GLSL_BLOCK ? "uniform blocks" : "texelFetch");
    if (c->version == GLSL_120 && (c->environment == GLSL_FACES || c->output == LAM_OUTPUT_IDS))
        return fail(error, LAM_BAD_ARGUMENT, "GLSL 120 has no %s",
                    c->output == LAM_OUTPUT_IDS ? "gl_VertexID"
                                                : "array textures, expected a cube map as the environment");
    if (c->version == GLSL_120 && c->output == LAM_OUTPUT_LOD)
        return fail(error, LAM_BAD_ARGUMENT, "GLSL 120 has no textureSize, which levels of detail need");
    if (c->version == GLSL_120 && c->layer != GLSL_NO_LAYERS)
        return fail(error, LAM_BAD_ARGUMENT, "GLSL 120 has no integer textures, which depth peeling needs");
    if (f->shading == LAM_SHADING_PHONG && !f->per_fragment)
        return fail(error, LAM_BAD_ARGUMENT, "Phong shading lights every fragment: its stage is fragment");
    if (f->shading == LAM_SHADING_GOURAUD && f->per_fragment)
        return fail(error, LAM_BAD_ARGUMENT, "Gouraud shading lights every vertex: its stage is application or vertex");
    return !c->lecture || lecture_check(c, f, error);
}

// --- text that depends on more than flags

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
    if (c->shadows)
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
                       f->tangent || f->layers ? "1.0" : "dot3(s.n, t.l)", kind_words[group->kind]);
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
        text_add(text, first < c->light_count ? "    }\n" : "    }");
    }
}

static const char *output_term(const struct glsl_choices *c)
{
    switch (c->output) {
    case LAM_OUTPUT_AMBIENT:
        return "sum.ambient";
    case LAM_OUTPUT_DIFFUSE:
        return "sum.diffuse";
    case LAM_OUTPUT_SPECULAR:
        return "sum.specular";
    case LAM_OUTPUT_EMISSION:
        return "sum.emission";
    case LAM_OUTPUT_REFLECTION:
        return "sum.reflection";
    case LAM_OUTPUT_LIGHT:
        return c->reflection == LAM_REFLECTION_NONE ? "black3()" : "add3(add3(sum.ambient, sum.diffuse), sum.specular)";
    default:
        return "sum_terms(sum)";
    }
}

// What the material is at the point.
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

// The environment's light on physical materials has a part of its own that the diffuse map multiplies.
static bool maps_reflection(const struct glsl_facts *f) { return f->apart && f->environment_light; }

// The parts of that term that the diffuse map multiplies, and does not. An emission map multiplies the emission apart from both.
static const char *mapped_term(const struct glsl_facts *f)
{
    const struct glsl_choices *c = f->choices;
    bool matte = maps_reflection(f);
    switch (c->output) {
    case LAM_OUTPUT_AMBIENT:
    case LAM_OUTPUT_DIFFUSE:
        return output_term(c);
    case LAM_OUTPUT_SPECULAR:
    case LAM_OUTPUT_EMISSION:
        return "black3()";
    case LAM_OUTPUT_REFLECTION:
        return matte ? "matte" : "black3()";
    case LAM_OUTPUT_LIGHT:
        return c->reflection == LAM_REFLECTION_NONE ? "black3()" : "add3(sum.ambient, sum.diffuse)";
    default:
        return matte ? "add3(add3(sum.ambient, sum.diffuse), matte)" : "add3(sum.ambient, sum.diffuse)";
    }
}

static const char *rest_term(const struct glsl_facts *f)
{
    const struct glsl_choices *c = f->choices;
    bool glows = f->maps[0][LAM_MAP_EMISSION] || f->maps[1][LAM_MAP_EMISSION];
    switch (c->output) {
    case LAM_OUTPUT_SPECULAR:
        return output_term(c);
    case LAM_OUTPUT_REFLECTION:
        return maps_reflection(f) ? "sub3(sum.reflection, matte)" : output_term(c);
    case LAM_OUTPUT_EMISSION:
        return glows ? "black3()" : "sum.emission";
    case LAM_OUTPUT_AMBIENT:
    case LAM_OUTPUT_DIFFUSE:
        return "black3()";
    case LAM_OUTPUT_LIGHT:
        return c->reflection == LAM_REFLECTION_NONE ? "black3()" : "sum.specular";
    default:
        if (maps_reflection(f))
            return glows ? "add3(sum.specular, sub3(sum.reflection, matte))"
                         : "add3(add3(sum.emission, sum.specular), sub3(sum.reflection, matte))";
        return glows ? "add3(sum.specular, sum.reflection)" : "add3(add3(sum.emission, sum.specular), sum.reflection)";
    }
}

static void add_output_vector(struct text *text, const struct glsl_facts *f)
{
    const struct glsl_choices *c = f->choices;
    if (!f->output_one_light) {
        text_print(text, "    return vec4(%s, 1.0);", c->output == LAM_OUTPUT_TANGENTS ? "s.t" : "s.n");
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
    text_print(text, "    float c = cosine(dot3(s.n, %s));\n    return vec4(c, c, c, 1.0);",
               c->output == LAM_OUTPUT_N_L ? "l" : "halfway3(l, s.v)");
}

// Number of texels of a light, of its products, and of a hemisphere.
static int light_texels(const struct glsl_choices *c) { return c->products ? 4 : c->gl1 ? 7 : 6; }
static int product_texels(const struct glsl_choices *c) { return c->gl1 ? 3 : 2; }
static int hemisphere_texels(const struct glsl_choices *c) { return c->products ? 1 : 3; }

static const char *list_parameter(const struct glsl_facts *f)
{
    return !f->choices->products ? ", Material m" : f->back_material ? ", bool front" : "";
}

// What becomes of the opacity `light.a` of the fragment.
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
    if (text->bytes) // the line has an end of its own
        text->bytes[--text->length] = 0;
}

// Leaves out the points of masked surfaces where the fragment writes no light.
static void add_value_mask(struct text *text, const struct glsl_facts *f)
{
    const struct glsl_choices *c = f->choices;
    text_print(text, "    float opacity = %s%s;", glsl_maps_have(f, "opacity") ? "maps.opacity" : "1.0",
               c->colors ? " * tint.a" : "");
    for (int side = 0; side <= f->back_material; side++)
        if (c->alpha[side] == LAM_ALPHA_MASK)
            text_print(text, "\n    if (%s!(saturate(opacity) >= %salpha_cutoff)) {\n        discard;\n    }",
                       !f->back_material ? ""
                       : side            ? "!gl_FrontFacing && "
                                         : "gl_FrontFacing && ",
                       side ? "back_" : "");
}

static void add_stage(struct text *text, const struct glsl_facts *f, bool fragment)
{
    const struct glsl_choices *c = f->choices;
    bool glsl_120 = c->version == GLSL_120, lights_here = f->lit && fragment == f->per_fragment;
    bool flat = f->shading == LAM_SHADING_FLAT, surface = !f->unlit && f->lit;
    bool passes_tangent = (f->tangent && c->tangents) || f->signed_tangent, field = f->tangent && !c->tangents;
    bool clamped = c->gl1 && f->shading != LAM_SHADING_PHONG && output_is_picture(c->output);
    bool tints = c->colors && f->lit && !f->output_vector;
    bool eye = surface || c->output == LAM_OUTPUT_DEPTH;
    bool triangle_ids = c->output == LAM_OUTPUT_IDS || c->layer != GLSL_NO_LAYERS || c->shadows;
    struct text groups = {0}, vector = {0}, attributes = {0}, chosen = {0}, metallic = {0}, roughness = {0},
                alpha = {0}, of_material = {0}, layers = {0}, value_mask = {0};
    bool samples = fragment && f->mapped, reads_maps = f->mapped && !f->output_vector && !f->late;
    bool passes_tint = tints || (f->value_masks && c->colors);
    if (fragment)
        add_alpha_rule(&alpha, f);
    if (fragment && f->value_masks)
        add_value_mask(&value_mask, f);
    glsl_declare_attributes(&attributes, f);
    add_groups(&groups, f);
    if (f->layers)
        glsl_add_layers(&layers, f);
    glsl_add_parameters(&chosen, f);
    glsl_add_parameter(&metallic, f, "metallic");
    glsl_add_parameter(&roughness, f, "roughness");
    const struct preprocess_flag flags[] = {
        {"glsl_120", glsl_120},
        {"array", c->storage == GLSL_ARRAY},
        {"block", c->storage == GLSL_BLOCK},
        {"texture", c->storage == GLSL_TEXTURE},
        {"products", c->products},
        {"gl1", c->gl1},
        {"clamped", clamped},
        {"two_sided", c->two_sided},
        {"back_material", f->back_material},
        {"flat", flat},
        {"application", f->application},
        {"per_fragment", f->per_fragment},
        {"output_geometry", f->output_geometry},
        {"output_vector", f->output_vector},
        {"output_material", f->output_material},
        {"shows_level", f->output_material && c->output == LAM_OUTPUT_LOD},
        {"unlit", f->unlit},
        {"needs_surface", surface && (f->lights || f->hemispheres || f->environment || f->output_vector)},
        {"fragment", fragment},
        {"tangent", f->tangent},
        {"bends", f->bends},
        {"coat_bends", f->coat_bends},
        {"coat_normal", f->coat_normal},
        {"turns", f->turns},
        {"tangents", c->tangents},
        {"signed_tangent", f->signed_tangent},
        {"layered", f->layers != 0},
        {"passes", (f->layers & LAYER_TRANSMISSION) != 0 && f->per_fragment && fragment},
        {"transmits", c->transmits},
        {"passes_one_alpha", (f->layers & LAYER_TRANSMISSION) != 0 && f->per_fragment && c->layer == GLSL_NO_LAYERS},
        {"clearcoat", (f->layers & LAYER_CLEARCOAT) != 0},
        {"anisotropy", (f->layers & LAYER_ANISOTROPY) != 0},
        {"exact_filter", !c->hardware_filter},
        {"tilts", f->tilts},
        {"alpha_ruled", alpha.bytes != NULL},
        {"mapped", f->mapped},
        {"apart", f->apart},
        {"mapped_reflection", maps_reflection(f)},
        {"value_masks", fragment && f->value_masks},
        {"passes_tint", f->per_fragment ? passes_tint : f->value_masks && c->colors},
        {"late_color", f->apart && glsl_maps_have(f, "color")},
        {"late_emission", f->apart && glsl_maps_have(f, "emission")},
        {"late_opacity", f->late && !f->value_masks && glsl_maps_have(f, "opacity")},
        {"first_texcoords", f->texcoords[0]},
        {"second_texcoords", f->texcoords[1]},
        {"anisotropic", c->anisotropy > 1},
        {"map_color", reads_maps && glsl_maps_have(f, "color")},
        {"map_ambient", reads_maps && glsl_maps_have(f, "ambient")},
        {"map_specular", reads_maps && glsl_maps_have(f, "specular")},
        {"map_emission", reads_maps && glsl_maps_have(f, "emission")},
        {"map_occlusion", reads_maps && glsl_maps_have(f, "occlusion")},
        {"map_dielectric", reads_maps && glsl_maps_have(f, "dielectric")},
        {"map_opacity", reads_maps && glsl_maps_have(f, "opacity")},
        {"passes_tangent", passes_tangent},
        {"passes_normal", surface},
        {"passes_position", eye},
        {"has_varyings",
         f->mapped || passes_tint || eye || surface || tints || f->application || f->per_vertex || triangle_ids},
        {"tangent_field", field},
        {"vertex_colors", tints},
        {"reads_lights", (f->lights || f->hemispheres) && !f->output_vector},
        {"has_lights", f->lights},
        {"has_hemispheres", f->hemispheres},
        {"has_falloff", f->attenuated},
        {"has_cone", f->cones},
        {"has_environment", f->environment},
        {"cube_map", c->environment == GLSL_CUBE},
        {"cube_points", c->environment == GLSL_FACES || f->environment_light},
        {"environment_light", f->environment_light},
        {"occluded", f->occlusion},
        {"highlights", f->highlights},
        {"microfacet", f->microfacet},
        {"single_scattering", c->single_scattering},
        {"selects_parameters", chosen.bytes != NULL},
        {"provoking", flat && glsl_120 && eye},
        {"depth", c->output == LAM_OUTPUT_DEPTH},
        {"facing", c->output == LAM_OUTPUT_FACING},
        {"ids", c->output == LAM_OUTPUT_IDS},
        {"occlusion", c->output == LAM_OUTPUT_AMBIENT_OCCLUSION},
        {"triangle_ids", triangle_ids},
        {"depth_ids", c->layer != GLSL_NO_LAYERS},
        {"shadows", c->shadows},
        {"catches", c->catches},
        {"passes_lights", c->passed},
        {"fragment_shadows", c->shadows && f->per_fragment},
        {"vertex_shadows", c->shadows && lights_here && !fragment},
        {"from_vertices", f->shading != LAM_SHADING_PHONG},
        {"passes_rays", c->passes_rays},
        {"tints_rays", c->tints_rays},
        {"numbers_triangles", c->layer != GLSL_NO_LAYERS || c->shadows},
        {"peels", c->layer == GLSL_PEELS},
        {"exposed", c->exposes && !f->output_vector && !f->output_material},
        {"toned", c->tone > LAM_TONE_NONE && !f->output_vector && !f->output_geometry && !f->output_material},
        {"encoded", c->encoding == GLSL_ENCODED},
        {"premultiplied", c->encoding == GLSL_PREMULTIPLIED},
        {NULL, false},
    };
    char numbers[8][16];
    const int counts[8] = {c->light_count,
                           c->hemisphere_count,
                           light_texels(c),
                           product_texels(c),
                           hemisphere_texels(c),
                           c->light_count * light_texels(c),
                           c->light_count * product_texels(c),
                           GLSL_LIST_WIDTH};
    for (int i = 0; i < 8; i++)
        snprintf(numbers[i], sizeof numbers[i], "%d", counts[i]);
    char varying[32], arguments[8][160], anisotropy[8];
    char map_arguments[64];
    snprintf(map_arguments, sizeof map_arguments, "%s%s%s%s%s", f->texcoords[0] ? "first" : "",
             f->texcoords[0] && f->texcoords[1] ? ", " : "", f->texcoords[1] ? "second" : "",
             f->tilts ? ", eye_position" : "", c->colors && f->converts ? ", tint" : "");
    snprintf(anisotropy, sizeof anisotropy, "%d", c->anisotropy);
    snprintf(varying, sizeof varying, "%s%s", flat && !glsl_120 ? "flat " : "",
             glsl_120   ? "varying "
             : fragment ? "in "
                        : "out ");
    const char *const position = f->unlit ? NULL : "p", *const sides[4] = {NULL, "true", "false", "gl_FrontFacing"};
    for (int i = 0; i < 4; i++) {
        const char *p = i == 0 ? "vec3 p, vec3 normal" : i == 3 ? "eye_position, n" : "p, n";
        const char *t = !f->tangent ? ""
                        : i == 0    ? ", vec3 tangent"
                        : !field    ? (i == 3 ? ", eye_tangent" : ", t")
                                    : ", field_tangent(n)";
        const char *turn = !f->turns ? "" : i == 0 ? ", float turn" : i == 2 ? ", -turn" : ", turn";
        const char *coat = !f->coat_normal ? "" : i == 0 ? ", vec3 coat" : ", coat";
        const char *color = !tints ? "" : i == 0 ? ", vec4 tint" : i == 3 ? ", tint" : ", color";
        if (!position) {
            p = t = "";
            color += tints ? 2 : 0;
        }
        int length = snprintf(arguments[i], sizeof arguments[i], "%s%s%s%s%s%s%s", p, t, turn, coat, color,
                              f->back_material && (*p || *color) ? ", " : "",
                              !f->back_material ? ""
                              : i == 0          ? "bool front"
                                                : sides[i]);
        static const char *const rests[] = {"out vec3 rest", "front_rest", "back_rest", "rest"};
        if (reads_maps)
            snprintf(arguments[i] + length, sizeof arguments[i] - (size_t)length, "%s%smaps", length ? ", " : "",
                     i == 0 ? "surface_maps " : "");
        else if (f->apart)
            snprintf(arguments[i] + length, sizeof arguments[i] - (size_t)length, "%s%s", length ? ", " : "", rests[i]);
    }
    if (f->output_vector)
        add_output_vector(&vector, f);
    if (f->output_material)
        add_output_material(&of_material, f);
    struct text sizes = {0}, starts = {0};
    for (int i = 0; i <= ENVIRONMENT_LEVELS; i++) {
        int size = i == 0 ? 0 : i < ENVIRONMENT_LEVELS ? prefiltered_size(i) : IRRADIANCE_SIZE;
        text_print(&sizes, "%s%d.0", i ? ", " : "", size);
        text_print(&starts, "%s%d.0", i ? ", " : "", i ? environment_light_first(i) : 0);
    }
    char level_count[16], row_count[16];
    snprintf(level_count, sizeof level_count, "%d", ENVIRONMENT_LEVELS + 1);
    snprintf(row_count, sizeof row_count, "%d.0", environment_light_rows());
    const char *pixel = glsl_120 ? "gl_FragColor" : "pixel";
    const struct preprocess_value values[] = {
        {"hemispheres", numbers[1]},
        {"light_texels", numbers[2]},
        {"product_texels", numbers[3]},
        {"hemisphere_texels", numbers[4]},
        {"hemispheres_at", numbers[5]},
        {"hemisphere_products_at", numbers[6]},
        {"list_width", numbers[7]},
        {"list_argument", list_argument(f)},
        {"list_parameter", list_parameter(f)},
        {"lit_parameters", arguments[0]},
        {"front_arguments", arguments[1]},
        {"back_arguments", arguments[2]},
        {"fragment_arguments", arguments[3]},
        {"map_arguments", map_arguments},
        {"anisotropy", anisotropy},
        {"alpha_rule", alpha.bytes ? alpha.bytes : ""},
        {"tangent", f->signed_tangent ? "tangent.xyz" : "tangent"},
        {"layers", layers.bytes ? layers.bytes : ""},
        {"lambert", glsl_maps_have(f, "dielectric") ? "m.diffuse.rgb" : "scale3(m.diffuse.rgb, 1.0 - m.metallic)"},
        {"lit_position", flat && glsl_120 ? "provoking_position" : "position"},
        {"viewer", c->distant_viewer ? "VIEWER_INFINITE" : "VIEWER_LOCAL"},
        {"groups", groups.bytes ? groups.bytes : ""},
        {"parameters", chosen.bytes ? chosen.bytes : ""},
        {"metallic", metallic.bytes ? metallic.bytes : ""},
        {"roughness", roughness.bytes ? roughness.bytes : ""},
        {"output_term", output_term(c)},
        {"output_material", of_material.bytes ? of_material.bytes : ""},
        {"output_mapped", mapped_term(f)},
        {"output_rest", rest_term(f)},
        {"value_mask", value_mask.bytes ? value_mask.bytes : ""},
        {"glow", f->back_material ? "(gl_FrontFacing ? glow : back_glow)" : "glow"},
        {"smooth_varying", glsl_120   ? "varying "
                           : fragment ? "in "
                                      : "out "},
        {"output_vector", vector.bytes ? vector.bytes : ""},
        {"texture_cube", glsl_120 ? "textureCube" : "texture"},
        {"varying", varying},
        {"flat_varying", fragment ? "flat in " : "flat out "},
        {"attributes", attributes.bytes ? attributes.bytes : ""},
        {"pixel", pixel},
        {"passed", c->tints_rays ? "vec3" : "float"},
        {"tone", glsl_tone_function(c->tone)},
        {"level_sizes", sizes.bytes},
        {"level_starts", starts.bytes},
        {"level_count", level_count},
        {"level_rows", row_count},
        {NULL, NULL},
    };
    const struct preprocess_words words = {flags, values};
    const struct text *parts[] = {&groups, &vector, &attributes, &chosen,      &metallic, &roughness,
                                  &alpha,  &sizes,  &starts,     &of_material, &layers,   &value_mask};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        if (parts[i]->failed) {
            text->failed = true;
            text->error = parts[i]->error;
        }
    if (!glsl_120 && ((samples && !c->hardware_filter) || (lights_here && c->passes_rays)))
        preprocess_add(text, text_wrapping_glsl, &words);
    if (samples) {
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
    preprocess_add(text, fragment ? text_fragment_glsl : text_vertex_glsl, &words);
    free(groups.bytes);
    free(vector.bytes);
    free(attributes.bytes);
    free(chosen.bytes);
    free(metallic.bytes);
    free(roughness.bytes);
    free(alpha.bytes);
    free(layers.bytes);
    free(value_mask.bytes);
    free(sizes.bytes);
    free(starts.bytes);
    free(of_material.bytes);
}

// --- the shader

static const char *const version_lines[] = {"#version 120\n", "#version 330 core\n",
                                            "#version 300 es\nprecision highp float;\nprecision highp int;\n"};

static char *make_stage(const struct glsl_facts *f, bool fragment, lam_error *error)
{
    struct text body = {0}, text = {0};
    const struct glsl_choices *c = f->choices;
    if (c->lecture)
        lecture_add(&body, f, fragment);
    else
        add_stage(&body, f, fragment);
    text_add(&text, version_lines[c->version]);
    if (c->version == GLSL_300_ES && fragment && c->layer == GLSL_PEELS)
        text_add(&text, "precision highp usampler2D;\n");
    if (c->version == GLSL_300_ES &&
        ((fragment == f->per_fragment &&
          (c->storage == GLSL_TEXTURE || f->environment_light || c->shadows || f->occlusion)) ||
         (fragment && f->mapped)))
        text_add(&text, "precision highp sampler2D;\n");
    if (c->version == GLSL_300_ES && fragment == f->per_fragment && f->environment)
        text_print(&text, "precision highp %s;\n", c->environment == GLSL_CUBE ? "samplerCube" : "sampler2DArray");
    if (body.bytes && !body.failed) {
        struct known_condition known[KNOWN_MAX + 1] = {{NULL, false}};
        glsl_known_conditions(known, f);
        if (!c->lecture)
            equations_add(&text, body.bytes, known);
        glsl_declare(&text, f, fragment);
        text_add(&text, body.bytes);
    }
    bool failed = body.failed || text.failed || !text.bytes;
    if (failed) {
        const lam_error *first = body.failed ? &body.error : &text.error;
        fail(error, first->code ? first->code : LAM_LIMIT, "%s", first->code ? first->text : "out of memory");
        free(text.bytes);
    }
    free(body.bytes);
    return failed ? NULL : text.bytes;
}

bool glsl_make(const struct glsl_choices *choices, struct glsl_text *text, lam_error *error)
{
    *text = (struct glsl_text){0};
    struct glsl_facts facts = glsl_facts_of(choices);
    if (!check(choices, &facts, error))
        return false;
    text->vertex = make_stage(&facts, false, error);
    text->fragment = text->vertex ? make_stage(&facts, true, error) : NULL;
    char *texts[2] = {text->vertex, text->fragment};
    bool ok = text->fragment && (!choices->mistake || mistake_apply(choices, texts, 2, error));
    if (text->fragment)
        *text = (struct glsl_text){texts[0], texts[1]};
    if (!ok)
        glsl_free(text);
    return ok;
}

void glsl_free(struct glsl_text *text)
{
    free(text->vertex);
    free(text->fragment);
    *text = (struct glsl_text){0};
}
