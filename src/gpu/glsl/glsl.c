// glsl.c: generates a vertex and a fragment shader from a set of choices.
#include "glsl.h"
#include "environment.h"
#include "fail.h"
#include "glsl_constants.h"
#include "glsl_declarations.h"
#include "glsl_text.h"
#include "samples.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "stages.inc"

// --- known conditions and names

#define WORD(name) [name] = #name
static const char *const kind_words[GLSL_KINDS] = {WORD(LIGHT_POINT), WORD(LIGHT_DIRECTIONAL), WORD(LIGHT_SPOT_CUTOFF),
                                                   WORD(LIGHT_SPOT_EXPONENT), WORD(LIGHT_SPOT_CONES)};
static const char *const falloff_words[GLSL_FALLOFFS] = {WORD(FALLOFF_NONE), WORD(FALLOFF_DISTANCE),
                                                         WORD(FALLOFF_RANGE)};

void glsl_add_sky_color(struct text *text, const struct glsl_choices *c, const char *ka, const char *kd)
{
    if (c->ambient_hemispheres == c->hemisphere_count || frame_is_physical(c->reflection))
        text_add(text, ka);
    else if (!c->ambient_hemispheres)
        text_add(text, kd);
    else
        text_print(text, "(i < %d ? %s : %s)", c->ambient_hemispheres, ka, kd);
}

static void put_lights(struct constant_table *t, const struct glsl_choices *c)
{
    int light_texels = c->products ? 4 : c->gl1 ? 7 : 6, product_texels = c->gl1 ? 3 : 2; // texels per light
    constant_flag(t, "has_light_shares", c->passed);
    constant_flag(t, "cube_map", c->environment == GLSL_CUBE);
    constant_number(t, "HEMISPHERES", c->hemisphere_count);
    glsl_add_sky_color(constant_made(t, "SKY_COLOR"), c, "m.ambient.rgb", "m.diffuse.rgb");
    constant_number(t, "LIGHT_TEXELS", light_texels);
    constant_number(t, "PRODUCT_TEXELS", product_texels);
    constant_number(t, "HEMISPHERE_TEXELS", c->products ? 1 : 3);
    constant_number(t, "HEMISPHERES_AT", c->light_count * light_texels);
    constant_number(t, "HEMISPHERE_PRODUCTS_AT", c->light_count * product_texels);
    constant_number(t, "LIST_WIDTH", GLSL_LIST_WIDTH);
}

static void put_environment(struct constant_table *t)
{
    struct text *sizes = constant_made(t, "LEVEL_SIZES"), *starts = constant_made(t, "LEVEL_STARTS");
    for (int i = 0; i <= ENVIRONMENT_LEVELS; i++) {
        int size = i == 0 ? 0 : i < ENVIRONMENT_LEVELS ? prefiltered_size(i) : IRRADIANCE_SIZE;
        text_print(sizes, "%s%d.0", i ? ", " : "", size);
        text_print(starts, "%s%d.0", i ? ", " : "", i ? environment_light_first(i) : 0);
    }
    constant_number(t, "LEVEL_COUNT", ENVIRONMENT_LEVELS + 1);
    text_print(constant_made(t, "LEVEL_ROWS"), "%d.0", environment_light_rows());
}

static void put_material(struct constant_table *t, const struct glsl_stage *f)
{
    const struct glsl_choices *c = f->choices;
    const bool blends[2] = {c->alpha[0] == LAM_ALPHA_BLEND, c->alpha[f->back_material] == LAM_ALPHA_BLEND};
    constant_flag(t, "front_masked", c->alpha[0] == LAM_ALPHA_MASK);
    constant_flag(t, "back_masked", f->back_material && c->alpha[1] == LAM_ALPHA_MASK);
    constant_flag(t, "front_solid", !blends[0]);
    constant_flag(t, "back_solid", !blends[1]);
    constant_flag(t, "colors", c->colors);
    constant_flag(t, "has_coat_normal",
                  f->has_clearcoat && (f->has_normal_map || f->has_bump_map || f->has_coat_normal_map));
    constant_flag(t, "tangent_field", f->needs_tangent && !c->tangents);
    if (!f->back_material)
        constant_flag(t, "front", true);
    if (f->layers)
        glsl_add_layers(constant_made(t, "LAYERS"), f);
    glsl_add_parameters(constant_made(t, "OWN_PARAMETERS"), f);
    glsl_add_parameter(constant_made(t, "METALLIC"), f, "metallic");
    glsl_add_parameter(constant_made(t, "ROUGHNESS"), f, "roughness");
    glsl_add_own_parameter(constant_made(t, "OWN_ROUGHNESS"), f, "roughness");
    if (f->adds_lights && f->has_lights)
        glsl_add_lobe(constant_made(t, "LOBE"), f);
}

static void put_maps(struct constant_table *t, const struct glsl_stage *f)
{
    static const struct {
        const char *member, *lit,
            *last; // flags: `lit`: light_point applies the map; `last`: the fragment shader applies the map afterwards
    } rows[] = {{"color", "map_color", "color_map_last"}, {"emission", "map_emission", "emission_map_last"},
                {"opacity", "map_opacity", NULL},         {"ambient", "map_ambient", NULL},
                {"specular", "map_specular", NULL},       {"occlusion", "map_occlusion", NULL},
                {"dielectric", "map_dielectric", NULL}};
    bool lit = f->has_maps && !f->output_vector && !f->maps_interpolated_light;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        bool read = glsl_maps_have(f, rows[i].member);
        constant_flag(t, rows[i].lit, lit && read);
        if (rows[i].last)
            constant_flag(t, rows[i].last, f->separate_texture_terms && read);
    }
    constant_flag(t, "opacity_in_maps", glsl_maps_have(f, "opacity"));
    constant_flag(t, "level_in_maps", glsl_maps_have(f, "level"));
    constant_flag(t, "opacity_map_last", f->maps_interpolated_light && !f->value_masks && glsl_maps_have(f, "opacity"));
    constant_flag(t, "exact_filter", !f->choices->hardware_filter);
    bool anisotropic = false;
    for (int i = 0; i < 2 * LAM_MAP_COUNT; i++)
        anisotropic |= f->choices->maps[i / LAM_MAP_COUNT][i % LAM_MAP_COUNT].probes > 1;
    constant_flag(t, "anisotropic", anisotropic);
}

// Names of values at the point that is lit, which is the fragment's own point unless all samples share a point.
static void put_point(struct constant_table *t, const struct glsl_stage *f)
{
    static const char *const rows[][3] = {{"POINT_POSITION", "eye_position", "AT_POINT(eye_position)"},
                                          {"POINT_NORMAL", "eye_normal", "AT_POINT(eye_normal)"},
                                          {"POINT_TANGENT", "eye_tangent", "AT_POINT(eye_tangent)"},
                                          {"POINT_TINT", "tint", "AT_POINT(tint)"},
                                          {"POINT_AT", "at", "AT_POINT(at)"},
                                          {"POINT_P", "p", "AT_POINT(p)"},
                                          {"POINT_W", "w", "point_w"},
                                          {"OVER_POINT", "over", "point_w"}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        constant_text(t, rows[i][0], rows[i][f->one_point ? 2 : 1]);
    if (!f->one_point)
        return;
    const struct sample_pattern *pattern = sample_pattern(f->choices->samples);
    constant_number(t, "SAMPLES", pattern->count);
    struct text *offsets = constant_made(t, "SAMPLE_OFFSETS");
    text_add(offsets, "vec2(0.0)");
    for (int i = 0, s; i < pattern->count; i++) {
        s = pattern->by_distance[i];
        text_print(offsets, ", vec2(%d.0, %d.0) / 16.0", pattern->x[s], pattern->y[s]);
    }
}

static void put_output(struct constant_table *t, const struct glsl_stage *f)
{
    const struct glsl_choices *c = f->choices;
    const struct output_row *row = &output_rows[c->output];
    const int shown = row->lit && c->reflection == LAM_REFLECTION_NONE ? 0 : row->terms;
    constant_flag(t, "shows_all", shown == TERMS_ALL);
    constant_flag(t, "shows_around", shown && c->output == LAM_OUTPUT_ENVIRONMENT);
    constant_flag(t, "shows_ambient", shown & TERM_AMBIENT);
    constant_flag(t, "shows_diffuse", shown & TERM_DIFFUSE);
    constant_flag(t, "shows_specular", shown & TERM_SPECULAR);
    constant_flag(t, "shows_emission", shown & TERM_EMISSION);
    constant_flag(t, "shows_reflection", shown & TERM_REFLECTION);
    for (int i = 0; i < LAM_OUTPUT_COUNT; i++)
        if (output_rows[i].flag)
            constant_flag(t, output_rows[i].flag, (int)c->output == i);
    constant_flag(t, "is_physical", glsl_is_physical(f));
    bool light_shown = !f->output_vector && !f->output_material;
    constant_flag(t, "exposes", c->exposes && light_shown);
    constant_flag(t, "has_tone", c->tone > LAM_TONE_NONE && light_shown && !f->output_geometry);
    constant_flag(t, "clamped", c->gl1 && f->shading != LAM_SHADING_PHONG && output_is_picture(c->output));
    constant_flag(t, "writes_transmittance", c->transmits);
    constant_flag(t, "blends_transmission", f->has_transmission && c->layer == GLSL_NO_LAYERS);
    constant_flag(t, "depth_ids", c->layer != GLSL_NO_LAYERS);
    constant_flag(t, "peels", c->layer == GLSL_PEELS);
    constant_text(t, "TONE", glsl_tone_function(c->tone));
    constant_flag(t, "from_vertices", f->shading != LAM_SHADING_PHONG);
    constant_text(t, "VIEWER", c->distant_viewer ? "VIEWER_INFINITE" : "VIEWER_LOCAL");
    constant_text(t, "LIGHT_SHARE", c->tints_rays ? "vec3" : "float");
    constant_text(t, "TANGENT", f->signed_tangent ? "tangent.xyz" : "tangent");
    text_print(constant_made(t, "TINT_VARYING"), "%s%s",
               f->per_fragment && f->shading == LAM_SHADING_FLAT && !f->glsl_120 ? "flat " : "",
               f->glsl_120   ? "varying"
               : f->fragment ? "in"
                             : "out");
}

// Adds a loop for each group of lights that have the same kind and falloff.
static void put_loops(struct constant_table *t, const struct glsl_stage *f)
{
    const struct glsl_choices *c = f->choices;
    struct text *loops = constant_made(t, "LIGHTS");
    struct constant *end = &t->rows[t->count];
    int first = 0;
    for (int i = 0; f->adds_lights && i < c->group_count; i++) {
        const struct glsl_group *group = &c->groups[i];
        char from[12], to[12];
        snprintf(from, sizeof from, "%d", first);
        snprintf(to, sizeof to, "%d", first += group->count);
        const struct constant of_group[] = {{"LIGHTS_FIRST", from},
                                            {"LIGHTS_END", to},
                                            {"LIGHT_KIND", kind_words[group->kind]},
                                            {"LIGHT_FALLOFF", falloff_words[group->falloff]}};
        memcpy(end, of_group, sizeof of_group);
        if (constant_finish(t))
            specialize_branches(loops, text_light_loop_glsl, t->rows);
    }
    memset(end, 0, 4 * sizeof *end);
    constant_text(
        t, "LIGHT_KIND",
        kind_words[c->group_count && c->groups[0].kind == LIGHT_DIRECTIONAL ? LIGHT_DIRECTIONAL : LIGHT_POINT]);
}

// --- the stage

// Appends the code of a stage, without its version.
static void glsl_add_stage(struct text *text, const struct glsl_stage *f)
{
    struct constant_table t = {.count = 0};
    struct text uniforms = {0}, maps = {0}, attributes = {0};
    constant_stage(&t, f);
    constant_conditions(&t, f);
    put_lights(&t, f->choices);
    put_environment(&t);
    put_material(&t, f);
    put_maps(&t, f);
    put_output(&t, f);
    put_point(&t, f);
    put_loops(&t, f);
    glsl_declare(&uniforms, f, f->fragment);
    if (f->fragment)
        glsl_add_maps(&maps, f);
    else
        glsl_declare_attributes(&attributes, f);
    const struct stage_source sources[] = {
        {.title = NULL, .text = uniforms.bytes, .made = true},
        {.title = NULL, .text = "bool unobstructed = false; // the point is lit as if nothing blocked the light\n"},
        {.title = "wrapping of texture coordinates", .text = text_wrapping_glsl},
        {.title = "textures", .text = text_texture_glsl},
        {.title = NULL, .text = maps.bytes},
        {.title = "shadows: docs/lighting/shadows.md, in float", .text = text_shadows_glsl},
        {.title = "the environment", .text = text_environment_glsl},
        {.title = "lights and materials", .text = text_lights_glsl},
        {.title = NULL, .text = text_passed_glsl, .whole = true},
        {.title = "lighting of a point", .text = text_lighting_glsl},
        {.title = "the vertex shader", .text = attributes.bytes, .made = true},
        {.title = f->fragment ? "the fragment shader" : NULL,
         .text = f->fragment ? text_fragment_glsl : text_vertex_glsl}};
    const struct constant *constants = constant_finish(&t);
    if (constants)
        equations_add(text, sources, sizeof sources / sizeof *sources, constants);
    text->failed |= !constants || uniforms.failed || maps.failed || attributes.failed;
    free(uniforms.bytes);
    free(maps.bytes);
    free(attributes.bytes);
    constant_free(&t);
}

static bool check(const struct glsl_choices *c, const struct glsl_stage *f, lam_error *error)
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
    return !c->style || c->style->check(c, f, error);
}

// --- the shader

static const char *const version_lines[] = {"#version 120\n", "#version 330 core\n",
                                            "#version 300 es\nprecision highp float;\nprecision highp int;\n"};

static char *make_stage(const struct glsl_stage *f, bool fragment, lam_error *error)
{
    struct text body = {0}, text = {0};
    const struct glsl_choices *c = f->choices;
    const struct glsl_stage stage = glsl_stage_of_kind(f, fragment);
    if (c->style)
        c->style->add_stage(&body, &stage);
    else
        glsl_add_stage(&body, &stage);
    text_add(&text, version_lines[c->version]);
    if (c->version == GLSL_300_ES && fragment && c->layer == GLSL_PEELS)
        text_add(&text, "precision highp usampler2D;\n");
    if (c->version == GLSL_300_ES &&
        ((fragment == f->per_fragment &&
          (c->storage == GLSL_TEXTURE || f->environment_light || c->shadows || f->occluded)) ||
         (fragment && f->has_maps)))
        text_add(&text, "precision highp sampler2D;\n");
    if (c->version == GLSL_300_ES && fragment == f->per_fragment && f->has_environment)
        text_print(&text, "precision highp %s;\n", c->environment == GLSL_CUBE ? "samplerCube" : "sampler2DArray");
    if (c->style)
        glsl_declare(&text, f, fragment);
    if (body.bytes && !body.failed)
        text_add(&text, body.bytes);
    bool failed = body.failed || text.failed || !text.bytes;
    if (failed) {
        const lam_error *first = body.failed ? &body.error : &text.error;
        fail(error, first->code ? first->code : LAM_MACHINE, "%s", first->code ? first->text : "out of memory");
        free(text.bytes);
    }
    free(body.bytes);
    return failed ? NULL : text.bytes;
}

bool glsl_make(const struct glsl_choices *choices, struct glsl_text *text, lam_error *error)
{
    *text = (struct glsl_text){0};
    struct glsl_stage stage = glsl_stage_of(choices);
    if (!check(choices, &stage, error))
        return false;
    text->vertex = make_stage(&stage, false, error);
    text->fragment = text->vertex ? make_stage(&stage, true, error) : NULL;
    char *texts[2] = {text->vertex, text->fragment};
    bool ok = text->fragment && (!choices->mistake || choices->style->change(choices, texts, 2, error));
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
