// glsl_constants.c: the conditions and names in a shader's sources that the choices determine.
#include "glsl_constants.h"
#include "glsl_declarations.h"

#include <stdlib.h>

void constant_text(struct constant_table *t, const char *name, const char *text)
{
    if (t->count == CONSTANT_MAX)
        abort(); // the tables of constants have grown: increase CONSTANT_MAX
    t->rows[t->count++] = (struct constant){name, text};
}

void constant_flag(struct constant_table *t, const char *name, bool holds)
{
    constant_text(t, name, holds ? "true" : "false");
}

struct text *constant_made(struct constant_table *t, const char *name)
{
    if (t->made_count == CONSTANT_MADE_MAX)
        abort(); // increase CONSTANT_MADE_MAX
    constant_text(t, name, "");
    t->of_made[t->made_count] = &t->rows[t->count - 1];
    return &t->made[t->made_count++];
}

void constant_number(struct constant_table *t, const char *name, int number)
{
    text_print(constant_made(t, name), "%d", number);
}

const struct constant *constant_finish(struct constant_table *t)
{
    for (int i = 0; i < t->made_count; i++) {
        if (t->made[i].failed)
            return NULL;
        t->of_made[i]->text = t->made[i].bytes ? t->made[i].bytes : "";
    }
    return t->rows;
}

void constant_free(struct constant_table *t)
{
    for (int i = 0; i < t->made_count; i++)
        free(t->made[i].bytes);
}

void constant_specialize(struct text *text, const char *source, struct constant_table *t)
{
    const struct constant *rows = constant_finish(t);
    if (rows)
        specialize_branches(text, source, rows);
    text->failed |= !rows;
    constant_free(t);
}

void constant_stage(struct constant_table *t, const struct glsl_stage *f)
{
#define FACT(name)   constant_flag(t, #name, f->name);
#define CHOICE(name) constant_flag(t, #name, f->choices->name);
    GLSL_FACTS(FACT)
    GLSL_CHOICE_FLAGS(CHOICE)
#undef FACT
#undef CHOICE
    constant_flag(t, "lights_in_texture", f->choices->storage == GLSL_TEXTURE);
    const bool flat = f->shading == LAM_SHADING_FLAT;
    const char *smooth = f->glsl_120 ? "varying" : f->fragment ? "in" : "out";
    text_print(constant_made(t, "VARYING"), "%s%s", flat && !f->glsl_120 ? "flat " : "", smooth);
    constant_text(t, "SMOOTH_VARYING", smooth);
    constant_text(t, "FLAT_VARYING", f->fragment ? "flat in" : "flat out");
    constant_text(t, "LIT_POSITION", flat && f->glsl_120 ? "provoking_position" : "position");
    constant_text(t, "TEXTURE_CUBE", f->glsl_120 ? "textureCube" : "texture");
    if (f->glsl_120)
        constant_text(t, "pixel", "gl_FragColor");
}

// Adds a condition if its value is the same for all lights. `some` of `all` lights meet the condition.
static void add_light_constants(struct constant_table *out, const char *condition, int some, int all)
{
    if (some == 0 || some == all)
        constant_flag(out, condition, some > 0);
}

void constant_conditions(struct constant_table *out, const struct glsl_stage *f)
{
    const struct glsl_choices *c = f->choices;
    int kinds[GLSL_KINDS] = {0}, falloffs[GLSL_FALLOFFS] = {0}, all = c->light_count;
    for (int i = 0; i < c->group_count; i++) {
        kinds[c->groups[i].kind] += c->groups[i].count;
        falloffs[c->groups[i].falloff] += c->groups[i].count;
    }
    if (c->distant_viewer)
        constant_flag(out, "viewer == VIEWER_LOCAL", false);
    constant_flag(out, "scattering != 0", !c->single_scattering);
#define LAYER_KNOWN(name) constant_flag(out, "(set & LAYER_" #name ") != 0", (f->layers & LAYER_##name) != 0)
    LAYER_KNOWN(DIELECTRIC);
    LAYER_KNOWN(CLEARCOAT);
    LAYER_KNOWN(SHEEN);
    LAYER_KNOWN(ANISOTROPY);
    LAYER_KNOWN(IRIDESCENCE);
    LAYER_KNOWN(TRANSMISSION);
    LAYER_KNOWN(VOLUME);
#undef LAYER_KNOWN
    if (f->output_vector) // the shader evaluates a single light, whose kind is a uniform
        return;
    add_light_constants(out, "kind == LIGHT_DIRECTIONAL", kinds[LIGHT_DIRECTIONAL], all);
    add_light_constants(out, "kind >= LIGHT_SPOT_CUTOFF", all - kinds[LIGHT_POINT] - kinds[LIGHT_DIRECTIONAL], all);
    add_light_constants(out, "kind == LIGHT_SPOT_CUTOFF", kinds[LIGHT_SPOT_CUTOFF], all);
    add_light_constants(out, "kind == LIGHT_SPOT_EXPONENT", kinds[LIGHT_SPOT_EXPONENT], all);
    add_light_constants(out, "kind == LIGHT_SPOT_CONES", kinds[LIGHT_SPOT_CONES], all);
    add_light_constants(out, "falloff != FALLOFF_NONE", all - falloffs[FALLOFF_NONE], all);
    add_light_constants(out, "falloff == FALLOFF_RANGE", falloffs[FALLOFF_RANGE], all);
}

// Derives the properties of a shader from its choices.

static void find_output(struct glsl_stage *f, const struct glsl_choices *c)
{
    f->output_geometry = glsl_output_is_geometry(c->output);
    f->output_vector = output_kind(c->output) == OUTPUT_VECTOR;
    f->output_one_light = f->output_vector && lam_output_is_one_light(c->output);
    f->shading = f->output_geometry ? LAM_SHADING_PHONG : c->shading;
    f->application = c->stage == LAM_STAGE_APPLICATION && !f->output_geometry;
    f->per_vertex = c->stage == LAM_STAGE_VERTEX && !f->output_geometry;
    f->per_fragment = !f->application && !f->per_vertex;
    f->lit = !f->application && !f->output_geometry;
    f->output_material = f->lit && output_kind(c->output) == OUTPUT_MATERIAL;
    f->shows_level = f->output_material && c->output == LAM_OUTPUT_LOD;
    f->unlit = f->lit && (c->reflection == LAM_REFLECTION_NONE || f->output_material) && !f->output_vector;
    f->adds_lights = f->lit && !f->unlit && !f->output_vector;
    f->encodes = c->encoding == GLSL_ENCODED;
    f->premultiplied = c->encoding == GLSL_PREMULTIPLIED;
}

static void find_lights(struct glsl_stage *f, const struct glsl_choices *c)
{
    f->has_lights = c->light_count > 0 && (f->adds_lights || f->output_one_light);
    f->has_hemispheres = c->hemisphere_count > 0 && f->adds_lights;
    for (int i = 0; i < c->group_count; i++) {
        f->has_falloff |= f->has_lights && !f->output_vector && c->groups[i].falloff != FALLOFF_NONE;
        f->has_cone |= f->has_lights && !f->output_vector && c->groups[i].kind >= LIGHT_SPOT_CUTOFF;
        f->positions |= c->groups[i].kind != LIGHT_DIRECTIONAL;
        f->directions |= c->groups[i].kind != LIGHT_POINT;
    }
    f->has_environment = c->environment != GLSL_NO_ENVIRONMENT && f->adds_lights;
    f->environment_light = f->has_environment && c->environment_light;
    f->occluded = c->occlusion && f->per_fragment && (f->adds_lights || c->output == LAM_OUTPUT_AMBIENT_OCCLUSION);
}

static void find_material(struct glsl_stage *f, const struct glsl_choices *c)
{
    const lam_reflection_info *lobe = lam_reflection_describe(c->reflection);
    f->highlights = f->adds_lights && c->light_count > 0 && lobe->base;
    f->microfacet = lobe && lobe->microfacet && (f->highlights || f->environment_light);
    f->toned = lobe && lobe->toned && f->highlights;
    f->layers = f->microfacet ? c->layers : 0;
    f->widens_roughness = c->widens && f->microfacet && f->per_fragment && f->shading == LAM_SHADING_PHONG;
    f->layered = f->layers != 0;
    f->has_clearcoat = f->layers & LAYER_CLEARCOAT;
    f->has_anisotropy = f->layers & LAYER_ANISOTROPY;
    f->needs_tangent =
        (f->adds_lights && lobe->tangents) || (f->lit && c->output == LAM_OUTPUT_TANGENTS) || f->has_anisotropy;
    f->back_material = c->two_sided && c->back_material && f->lit && !f->output_vector;
    f->has_transmission = (f->layers & LAYER_TRANSMISSION) != 0 && f->per_fragment;
}

static void find_attributes(struct glsl_stage *f, const struct glsl_choices *c)
{
    f->glsl_120 = c->version == GLSL_120;
    f->needs_normal = f->lit && !f->unlit;
    f->needs_position = f->needs_normal || c->output == LAM_OUTPUT_DEPTH;
    f->signed_tangent = f->has_normal_map || f->has_coat_normal_map || (f->has_anisotropy && c->tangents);
    f->needs_tangent_attribute = (f->needs_tangent && c->tangents) || f->signed_tangent;
    f->vertex_colors = c->colors && f->lit && !f->output_vector;
    f->needs_vertex_color = (f->per_fragment && f->vertex_colors) || (f->value_masks && c->colors);
}

struct glsl_stage glsl_stage_of(const struct glsl_choices *c)
{
    struct glsl_stage f = {.choices = c, .one_point = c->samples > 1};
    find_output(&f, c);
    find_lights(&f, c);
    find_material(&f, c);
    glsl_find_maps(&f);
    find_attributes(&f, c);
    return f;
}

struct glsl_stage glsl_stage_of_kind(const struct glsl_stage *stage, bool fragment)
{
    struct glsl_stage f = *stage;
    f.fragment = fragment;
    f.has_transmission &= fragment;
    return f;
}
