// glsl_known.c: the conditions and names in a shader's sources that the choices determine.
#include "glsl_known.h"

#include <stdlib.h>

void known_text(struct known_table *t, const char *name, const char *text)
{
    if (t->count == KNOWN_MAX)
        abort(); // the tables of facts have grown: increase KNOWN_MAX
    t->rows[t->count++] = (struct known){name, text};
}

void known_flag(struct known_table *t, const char *name, bool holds) { known_text(t, name, holds ? "true" : "false"); }

struct text *known_made(struct known_table *t, const char *name)
{
    if (t->made_count == KNOWN_MADE_MAX)
        abort(); // increase KNOWN_MADE_MAX
    known_text(t, name, "");
    t->of_made[t->made_count] = &t->rows[t->count - 1];
    return &t->made[t->made_count++];
}

void known_number(struct known_table *t, const char *name, int number)
{
    text_print(known_made(t, name), "%d", number);
}

const struct known *known_finish(struct known_table *t)
{
    for (int i = 0; i < t->made_count; i++) {
        if (t->made[i].failed)
            return NULL;
        t->of_made[i]->text = t->made[i].bytes ? t->made[i].bytes : "";
    }
    return t->rows;
}

void known_free(struct known_table *t)
{
    for (int i = 0; i < t->made_count; i++)
        free(t->made[i].bytes);
}

void known_specialize(struct text *text, const char *source, struct known_table *t)
{
    const struct known *rows = known_finish(t);
    if (rows)
        specialize_branches(text, source, rows);
    text->failed |= !rows;
    known_free(t);
}

void known_facts(struct known_table *t, const struct glsl_facts *f)
{
#define FACT(name)   known_flag(t, #name, f->name);
#define CHOICE(name) known_flag(t, #name, f->choices->name);
    GLSL_FACTS(FACT)
    GLSL_CHOICE_FLAGS(CHOICE)
#undef FACT
#undef CHOICE
    known_flag(t, "lights_in_texture", f->choices->storage == GLSL_TEXTURE);
    const bool flat = f->shading == LAM_SHADING_FLAT;
    const char *smooth = f->glsl_120 ? "varying" : f->fragment ? "in" : "out";
    text_print(known_made(t, "VARYING"), "%s%s", flat && !f->glsl_120 ? "flat " : "", smooth);
    known_text(t, "SMOOTH_VARYING", smooth);
    known_text(t, "FLAT_VARYING", f->fragment ? "flat in" : "flat out");
    known_text(t, "LIT_POSITION", flat && f->glsl_120 ? "provoking_position" : "position");
    known_text(t, "TEXTURE_CUBE", f->glsl_120 ? "textureCube" : "texture");
    if (f->glsl_120)
        known_text(t, "pixel", "gl_FragColor");
}

// Adds a condition if its value is the same for all lights. `some` of `all` lights meet the condition.
static void add_known_lights(struct known_table *out, const char *condition, int some, int all)
{
    if (some == 0 || some == all)
        known_flag(out, condition, some > 0);
}

void known_conditions(struct known_table *out, const struct glsl_facts *f)
{
    const struct glsl_choices *c = f->choices;
    int kinds[GLSL_KINDS] = {0}, falloffs[GLSL_FALLOFFS] = {0}, all = c->light_count;
    for (int i = 0; i < c->group_count; i++) {
        kinds[c->groups[i].kind] += c->groups[i].count;
        falloffs[c->groups[i].falloff] += c->groups[i].count;
    }
    if (c->distant_viewer)
        known_flag(out, "viewer == VIEWER_LOCAL", false);
    known_flag(out, "scattering != 0", !c->single_scattering);
#define LAYER_KNOWN(name) known_flag(out, "(set & LAYER_" #name ") != 0", (f->layers & LAYER_##name) != 0)
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
    add_known_lights(out, "kind == LIGHT_DIRECTIONAL", kinds[LIGHT_DIRECTIONAL], all);
    add_known_lights(out, "kind >= LIGHT_SPOT_CUTOFF", all - kinds[LIGHT_POINT] - kinds[LIGHT_DIRECTIONAL], all);
    add_known_lights(out, "kind == LIGHT_SPOT_CUTOFF", kinds[LIGHT_SPOT_CUTOFF], all);
    add_known_lights(out, "kind == LIGHT_SPOT_EXPONENT", kinds[LIGHT_SPOT_EXPONENT], all);
    add_known_lights(out, "kind == LIGHT_SPOT_CONES", kinds[LIGHT_SPOT_CONES], all);
    add_known_lights(out, "falloff != FALLOFF_NONE", all - falloffs[FALLOFF_NONE], all);
    add_known_lights(out, "falloff == FALLOFF_RANGE", falloffs[FALLOFF_RANGE], all);
}
