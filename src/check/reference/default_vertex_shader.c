// default_vertex_shader.c: generates the vertex shader for a fragment shader that comes alone.
#include "default_vertex_shader.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fail.h"

// The expression of each varying, a vec3, and its w.
static const struct {
    enum varying_semantic semantic;
    const char *text;
    const char *w;
} sources[] = {
    {VARYING_NORMAL, "n", "0.0"},
    {VARYING_LIGHT, "l", "0.0"},
    {VARYING_EYE, "(-p.xyz)", "0.0"},
    {VARYING_POSITION, "p.xyz", "1.0"},
    {VARYING_DISTANCE, "vec3(length(l))", "0.0"},
    {VARYING_TEXCOORD, "vec3(0.0)", "0.0"},
};

static const char *source_of(enum varying_semantic semantic, const char **w)
{
    for (size_t i = 0; i < sizeof sources / sizeof sources[0]; i++)
        if (sources[i].semantic == semantic) {
            *w = sources[i].w;
            return sources[i].text;
        }
    *w = "0.0";
    return "vec3(0.0)";
}

char *default_vertex_shader(const struct shader_interface *r, char unknown[256], lam_error *error)
{
    const struct declarations *d = &r->fragment;
    for (int i = 0; i < d->count; i++)
        if (d->items[i].kind == DECLARED_INPUT && d->items[i].in_block) {
            fail(error, LAM_BAD_ARGUMENT,
                 "the fragment shader reads '%s' from a block, which only its own vertex shader can write; name that "
                 "with --vertex",
                 d->items[i].name);
            return NULL;
        }
    size_t capacity = 2048 + 400 * (size_t)d->count, at = 0;
    char *text = malloc(capacity);
    unknown[0] = 0;
    if (!text) {
        fail_memory(error, capacity);
        return NULL;
    }
    bool modern = d->version >= 130;
    if (d->version)
        at += (size_t)snprintf(text, capacity, "#version %d%s%s\n", d->version, d->profile[0] ? " " : "", d->profile);
    at += (size_t)snprintf(text + at, capacity - at,
                           "%s vec3 lambent_position;\n%s vec3 lambent_normal;\n"
                           "uniform mat4 lambent_model_view;\nuniform mat4 lambent_projection;\n"
                           "uniform mat3 lambent_normal_matrix;\nuniform vec4 lambent_light;\n",
                           modern ? "in" : "attribute", modern ? "in" : "attribute");
    for (int i = 0; i < d->count; i++)
        if (d->items[i].kind == DECLARED_INPUT)
            at += (size_t)snprintf(text + at, capacity - at, "%s%s %s %s;\n", d->items[i].flat ? "flat " : "",
                                   modern ? "out" : "varying", d->items[i].type, d->items[i].name);
    at += (size_t)snprintf(text + at, capacity - at,
                           "void main()\n{\n    vec4 p = lambent_model_view * vec4(lambent_position, 1.0);\n"
                           "    vec3 n = normalize(lambent_normal_matrix * lambent_normal);\n"
                           "    vec3 l = lambent_light.xyz - lambent_light.w * p.xyz;\n"
                           "    gl_Position = lambent_projection * p;\n");
    for (int i = 0; i < d->count; i++) {
        const struct declaration *item = &d->items[i];
        if (item->kind != DECLARED_INPUT)
            continue;
        const struct contract_varying *v = contract_varying(r->contract, item->name);
        if (!v && strlen(unknown) < 150)
            snprintf(unknown + strlen(unknown), 256 - strlen(unknown), "%s%.60s", unknown[0] ? ", " : "", item->name);
        const char *w = "0.0", *from = v ? source_of(v->semantic, &w) : "vec3(0.0)";
        if (v && v->semantic == VARYING_POSITION && v->space == LAM_FRAME_OBJECT)
            from = "lambent_position";
        bool four = strcmp(item->type, "vec4") == 0;
        const char *cut = strcmp(item->type, "vec2") == 0 ? ".xy" : strcmp(item->type, "float") == 0 ? ".x" : "";
        if (four)
            at += (size_t)snprintf(text + at, capacity - at, "    %s = vec4(%s, %s);\n", item->name, from, w);
        else if (*cut || strcmp(item->type, "vec3") == 0)
            at += (size_t)snprintf(text + at, capacity - at, "    %s = (%s)%s;\n", item->name, from, cut);
    }
    snprintf(text + at, capacity - at, "}\n");
    return text;
}
