// glsl_stage.c: selects the sources of a stage from the files in src/gpu/glsl/text, and adds the conditions that the
// stage's choices determine.
#include "environment_light.h"
#include "equations.h"
#include "fail.h"
#include "glsl_known.h"
#include "stages.inc"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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

static void put_lights(struct known_table *t, const struct glsl_choices *c)
{
    int light_texels = c->products ? 4 : c->gl1 ? 7 : 6, product_texels = c->gl1 ? 3 : 2; // texels per light
    known_flag(t, "has_light_shares", c->passed);
    known_flag(t, "cube_map", c->environment == GLSL_CUBE);
    known_number(t, "HEMISPHERES", c->hemisphere_count);
    glsl_add_sky_color(known_made(t, "SKY_COLOR"), c, "m.ambient.rgb", "m.diffuse.rgb");
    known_number(t, "LIGHT_TEXELS", light_texels);
    known_number(t, "PRODUCT_TEXELS", product_texels);
    known_number(t, "HEMISPHERE_TEXELS", c->products ? 1 : 3);
    known_number(t, "HEMISPHERES_AT", c->light_count * light_texels);
    known_number(t, "HEMISPHERE_PRODUCTS_AT", c->light_count * product_texels);
    known_number(t, "LIST_WIDTH", GLSL_LIST_WIDTH);
}

static void put_environment(struct known_table *t)
{
    struct text *sizes = known_made(t, "LEVEL_SIZES"), *starts = known_made(t, "LEVEL_STARTS");
    for (int i = 0; i <= ENVIRONMENT_LEVELS; i++) {
        int size = i == 0 ? 0 : i < ENVIRONMENT_LEVELS ? prefiltered_size(i) : IRRADIANCE_SIZE;
        text_print(sizes, "%s%d.0", i ? ", " : "", size);
        text_print(starts, "%s%d.0", i ? ", " : "", i ? environment_light_first(i) : 0);
    }
    known_number(t, "LEVEL_COUNT", ENVIRONMENT_LEVELS + 1);
    text_print(known_made(t, "LEVEL_ROWS"), "%d.0", environment_light_rows());
}

static void put_material(struct known_table *t, const struct glsl_facts *f)
{
    const struct glsl_choices *c = f->choices;
    const bool blends[2] = {c->alpha[0] == LAM_ALPHA_BLEND, c->alpha[f->back_material] == LAM_ALPHA_BLEND};
    known_flag(t, "front_masked", c->alpha[0] == LAM_ALPHA_MASK);
    known_flag(t, "back_masked", f->back_material && c->alpha[1] == LAM_ALPHA_MASK);
    known_flag(t, "front_solid", !blends[0]);
    known_flag(t, "back_solid", !blends[1]);
    known_flag(t, "colors", c->colors);
    known_flag(t, "has_coat_normal",
               f->has_clearcoat && (f->has_normal_map || f->has_bump_map || f->has_coat_normal_map));
    known_flag(t, "tangent_field", f->needs_tangent && !c->tangents);
    if (!f->back_material)
        known_flag(t, "front", true);
    if (f->layers)
        glsl_add_layers(known_made(t, "LAYERS"), f);
    glsl_add_parameters(known_made(t, "OWN_PARAMETERS"), f);
    glsl_add_parameter(known_made(t, "METALLIC"), f, "metallic");
    glsl_add_parameter(known_made(t, "ROUGHNESS"), f, "roughness");
    glsl_add_own_parameter(known_made(t, "OWN_ROUGHNESS"), f, "roughness");
    if (f->adds_lights && f->has_lights)
        glsl_add_lobe(known_made(t, "LOBE"), f);
}

static void put_maps(struct known_table *t, const struct glsl_facts *f)
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
        known_flag(t, rows[i].lit, lit && read);
        if (rows[i].last)
            known_flag(t, rows[i].last, f->separate_texture_terms && read);
    }
    known_flag(t, "opacity_in_maps", glsl_maps_have(f, "opacity"));
    known_flag(t, "level_in_maps", glsl_maps_have(f, "level"));
    known_flag(t, "opacity_map_last", f->maps_interpolated_light && !f->value_masks && glsl_maps_have(f, "opacity"));
    known_flag(t, "exact_filter", !f->choices->hardware_filter);
    known_flag(t, "anisotropic", f->choices->anisotropy > 1);
    known_number(t, "PROBES_MAX", f->choices->anisotropy);
}

static void put_output(struct known_table *t, const struct glsl_facts *f)
{
    const struct glsl_choices *c = f->choices;
    const lam_output shown = c->output;
    bool all = (shown < LAM_OUTPUT_AMBIENT || shown > LAM_OUTPUT_LIGHT) && shown != LAM_OUTPUT_ENVIRONMENT,
         lit = c->reflection != LAM_REFLECTION_NONE, light = shown == LAM_OUTPUT_LIGHT && lit,
         around = shown == LAM_OUTPUT_ENVIRONMENT && lit;
    known_flag(t, "shows_all", all);
    known_flag(t, "shows_around", around);
    known_flag(t, "shows_ambient", all || light || shown == LAM_OUTPUT_AMBIENT);
    known_flag(t, "shows_diffuse", all || light || around || shown == LAM_OUTPUT_DIFFUSE);
    known_flag(t, "shows_specular", all || light || around || shown == LAM_OUTPUT_SPECULAR);
    known_flag(t, "shows_emission", all || shown == LAM_OUTPUT_EMISSION);
    known_flag(t, "shows_reflection", all || around || shown == LAM_OUTPUT_REFLECTION);
    known_flag(t, "shows_base_color", shown == LAM_OUTPUT_BASE_COLOR);
    known_flag(t, "shows_occlusion", shown == LAM_OUTPUT_OCCLUSION);
    known_flag(t, "shows_roughness", shown == LAM_OUTPUT_ROUGHNESS);
    known_flag(t, "is_physical", glsl_is_physical(f));
    bool light_shown = !f->output_vector && !f->output_material;
    known_flag(t, "exposes", c->exposes && light_shown);
    known_flag(t, "has_tone", c->tone > LAM_TONE_NONE && light_shown && !f->output_geometry);
    known_flag(t, "clamped", c->gl1 && f->shading != LAM_SHADING_PHONG && output_is_picture(c->output));
    known_flag(t, "output_facing", c->output == LAM_OUTPUT_FACING);
    known_flag(t, "output_ids", c->output == LAM_OUTPUT_IDS);
    known_flag(t, "writes_transmittance", c->transmits);
    known_flag(t, "blends_transmission", f->has_transmission && c->layer == GLSL_NO_LAYERS);
    known_flag(t, "depth_ids", c->layer != GLSL_NO_LAYERS);
    known_flag(t, "peels", c->layer == GLSL_PEELS);
    known_flag(t, "output_n_l", c->output == LAM_OUTPUT_N_L);
    known_flag(t, "output_tangents", c->output == LAM_OUTPUT_TANGENTS);
    known_text(t, "TONE", glsl_tone_function(c->tone));
    known_flag(t, "from_vertices", f->shading != LAM_SHADING_PHONG);
    known_text(t, "VIEWER", c->distant_viewer ? "VIEWER_INFINITE" : "VIEWER_LOCAL");
    known_text(t, "LIGHT_SHARE", c->tints_rays ? "vec3" : "float");
    known_text(t, "TANGENT", f->signed_tangent ? "tangent.xyz" : "tangent");
    text_print(known_made(t, "TINT_VARYING"), "%s%s",
               f->per_fragment && f->shading == LAM_SHADING_FLAT && !f->glsl_120 ? "flat " : "",
               f->glsl_120   ? "varying"
               : f->fragment ? "in"
                             : "out");
}

// Adds a loop for each group of lights that have the same kind and falloff.
static void put_loops(struct known_table *t, const struct glsl_facts *f)
{
    const struct glsl_choices *c = f->choices;
    struct text *loops = known_made(t, "LIGHTS");
    struct known *end = &t->rows[t->count];
    int first = 0;
    for (int i = 0; f->adds_lights && i < c->group_count; i++) {
        const struct glsl_group *group = &c->groups[i];
        char from[12], to[12];
        snprintf(from, sizeof from, "%d", first);
        snprintf(to, sizeof to, "%d", first += group->count);
        const struct known of_group[] = {{"LIGHTS_FIRST", from},
                                         {"LIGHTS_END", to},
                                         {"LIGHT_KIND", kind_words[group->kind]},
                                         {"LIGHT_FALLOFF", falloff_words[group->falloff]}};
        memcpy(end, of_group, sizeof of_group);
        if (known_finish(t))
            specialize_branches(loops, text_light_loop_glsl, t->rows);
    }
    memset(end, 0, 4 * sizeof *end);
    known_text(t, "LIGHT_KIND",
               kind_words[c->group_count && c->groups[0].kind == LIGHT_DIRECTIONAL ? LIGHT_DIRECTIONAL : LIGHT_POINT]);
}

// --- the stage

void glsl_add_stage(struct text *text, const struct glsl_facts *f)
{
    struct known_table t = {.count = 0};
    struct text uniforms = {0}, maps = {0}, attributes = {0};
    known_facts(&t, f);
    known_conditions(&t, f);
    put_lights(&t, f->choices);
    put_environment(&t);
    put_material(&t, f);
    put_maps(&t, f);
    put_output(&t, f);
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
    const struct known *known = known_finish(&t);
    if (known)
        equations_add(text, sources, sizeof sources / sizeof *sources, known);
    text->failed |= !known || uniforms.failed || maps.failed || attributes.failed;
    free(uniforms.bytes);
    free(maps.bytes);
    free(attributes.bytes);
    known_free(&t);
}
