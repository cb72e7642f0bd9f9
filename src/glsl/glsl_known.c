// glsl_known.c: conditions of the equations that the choices decide.
#include "glsl_known.h"

static void add_known(struct known_condition out[KNOWN_MAX], const char *condition, bool holds)
{
    while (out->condition)
        out++;
    *out = (struct known_condition){condition, holds};
}

// A condition that holds for `some` of the lights is known if it holds for none or for all.
static void add_known_lights(struct known_condition out[KNOWN_MAX], const char *condition, int some, int all)
{
    if (some == 0 || some == all)
        add_known(out, condition, some > 0);
}

void glsl_known_conditions(struct known_condition out[KNOWN_MAX], const struct glsl_facts *f)
{
    const struct glsl_choices *c = f->choices;
    int kinds[GLSL_KINDS] = {0}, falloffs[GLSL_FALLOFFS] = {0}, all = c->light_count;
    for (int i = 0; i < c->group_count; i++) {
        kinds[c->groups[i].kind] += c->groups[i].count;
        falloffs[c->groups[i].falloff] += c->groups[i].count;
    }
    if (c->distant_viewer)
        add_known(out, "viewer == VIEWER_LOCAL", false);
    add_known(out, "scattering != 0", !c->single_scattering);
#define LAYER_KNOWN(name) add_known(out, "(set & LAYER_" #name ") != 0", (f->layers & LAYER_##name) != 0)
    LAYER_KNOWN(DIELECTRIC);
    LAYER_KNOWN(CLEARCOAT);
    LAYER_KNOWN(SHEEN);
    LAYER_KNOWN(ANISOTROPY);
    LAYER_KNOWN(IRIDESCENCE);
    LAYER_KNOWN(TRANSMISSION);
    LAYER_KNOWN(VOLUME);
#undef LAYER_KNOWN
    if (f->output_vector) // the shader evaluates a single light, with a kind of its own
        return;
    add_known_lights(out, "kind == LIGHT_DIRECTIONAL", kinds[LIGHT_DIRECTIONAL], all);
    add_known_lights(out, "kind >= LIGHT_SPOT_CUTOFF", all - kinds[LIGHT_POINT] - kinds[LIGHT_DIRECTIONAL], all);
    add_known_lights(out, "kind == LIGHT_SPOT_CUTOFF", kinds[LIGHT_SPOT_CUTOFF], all);
    add_known_lights(out, "kind == LIGHT_SPOT_EXPONENT", kinds[LIGHT_SPOT_EXPONENT], all);
    add_known_lights(out, "kind == LIGHT_SPOT_CONES", kinds[LIGHT_SPOT_CONES], all);
    add_known_lights(out, "falloff != FALLOFF_NONE", all - falloffs[FALLOFF_NONE], all);
    add_known_lights(out, "falloff == FALLOFF_RANGE", falloffs[FALLOFF_RANGE], all);
}
