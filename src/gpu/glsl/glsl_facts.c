// glsl_facts.c: derives the properties of a shader from its choices.
#include "glsl_rows.h"

static void find_output(struct glsl_facts *f, const struct glsl_choices *c)
{
    f->output_geometry = glsl_output_is_geometry(c->output);
    f->output_vector = output_is_vector(c->output);
    f->output_one_light = f->output_vector && output_is_one_light(c->output);
    f->shading = f->output_geometry ? LAM_SHADING_PHONG : c->shading;
    f->application = c->stage == LAM_STAGE_APPLICATION && !f->output_geometry;
    f->per_vertex = c->stage == LAM_STAGE_VERTEX && !f->output_geometry;
    f->per_fragment = !f->application && !f->per_vertex;
    f->lit = !f->application && !f->output_geometry;
    f->output_material = f->lit && output_is_material(c->output);
    f->output_depth = c->output == LAM_OUTPUT_DEPTH;
    f->output_occlusion = c->output == LAM_OUTPUT_AMBIENT_OCCLUSION;
    f->shows_level = f->output_material && c->output == LAM_OUTPUT_LOD;
    f->unlit = f->lit && (c->reflection == LAM_REFLECTION_NONE || f->output_material) && !f->output_vector;
    f->adds_lights = f->lit && !f->unlit && !f->output_vector;
    f->encodes = c->encoding == GLSL_ENCODED;
    f->premultiplied = c->encoding == GLSL_PREMULTIPLIED;
}

static void find_lights(struct glsl_facts *f, const struct glsl_choices *c)
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
    f->occluded = c->occlusion && f->per_fragment && (f->adds_lights || f->output_occlusion);
}

static void find_material(struct glsl_facts *f, const struct glsl_choices *c)
{
    const lam_reflection_info *lobe = lam_reflection_describe(c->reflection);
    f->highlights = f->adds_lights && c->light_count > 0 && lobe->base;
    f->microfacet = lobe && lobe->microfacet && (f->highlights || f->environment_light);
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

static void find_attributes(struct glsl_facts *f, const struct glsl_choices *c)
{
    f->glsl_120 = c->version == GLSL_120;
    f->needs_normal = f->lit && !f->unlit;
    f->needs_position = f->needs_normal || f->output_depth;
    f->signed_tangent = f->has_normal_map || f->has_coat_normal_map || (f->has_anisotropy && c->tangents);
    f->needs_tangent_attribute = (f->needs_tangent && c->tangents) || f->signed_tangent;
    f->vertex_colors = c->colors && f->lit && !f->output_vector;
    f->needs_vertex_color = (f->per_fragment && f->vertex_colors) || (f->value_masks && c->colors);
}

struct glsl_facts glsl_facts_of(const struct glsl_choices *c)
{
    struct glsl_facts f = {.choices = c};
    find_output(&f, c);
    find_lights(&f, c);
    find_material(&f, c);
    glsl_find_maps(&f);
    find_attributes(&f, c);
    return f;
}

struct glsl_facts glsl_stage_facts(const struct glsl_facts *facts, bool fragment)
{
    struct glsl_facts f = *facts;
    f.fragment = fragment;
    f.has_transmission &= fragment;
    return f;
}
