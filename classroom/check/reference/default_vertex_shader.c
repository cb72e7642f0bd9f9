// default_vertex_shader.c: generates a vertex shader for a fragment shader that is checked alone.
#include "draw_request.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fail.h"

// For each varying: its expression in each space (a vec3), and its w component. Varyings without a space have the same
// expression in all spaces.
static const struct {
    enum varying_semantic semantic;
    lam_light_frame space;
    const char *text, *w;
} sources[] = {
    {VARYING_NORMAL, LAM_FRAME_CAMERA, "n", "0.0"},
    {VARYING_NORMAL, LAM_FRAME_WORLD, "world_n", "0.0"},
    {VARYING_NORMAL, LAM_FRAME_OBJECT, "normalize(lambent_normal)", "0.0"},
    {VARYING_POSITION, LAM_FRAME_CAMERA, "p.xyz", "1.0"},
    {VARYING_POSITION, LAM_FRAME_WORLD, "world_p.xyz", "1.0"},
    {VARYING_POSITION, LAM_FRAME_OBJECT, "lambent_position", "1.0"},
    {VARYING_LIGHT, LAM_FRAME_CAMERA, "l", "0.0"},
    {VARYING_LIGHT, LAM_FRAME_WORLD, "(lambent_world_light.xyz - lambent_world_light.w * world_p.xyz)", "0.0"},
    {VARYING_EYE, LAM_FRAME_CAMERA, "(-p.xyz)", "0.0"},
    {VARYING_EYE, LAM_FRAME_WORLD, "(lambent_world_eye - world_p.xyz)", "0.0"},
    {VARYING_DISTANCE, LAM_FRAME_CAMERA, "vec3(length(l))", "0.0"},
    {VARYING_DISTANCE, LAM_FRAME_WORLD, "vec3(length(l))", "0.0"},
    {VARYING_TEXCOORD, LAM_FRAME_CAMERA, "vec3(0.0)", "0.0"},
    {VARYING_TEXCOORD, LAM_FRAME_WORLD, "vec3(0.0)", "0.0"},
};

static const char *source_of(const struct contract_varying *v, const char **w)
{
    for (size_t i = 0; i < sizeof sources / sizeof sources[0]; i++)
        if (sources[i].semantic == v->semantic && sources[i].space == v->space) {
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
    if (!text)
        return fail_memory(error, capacity), NULL;
    bool modern = d->version >= 130;
    if (d->version)
        at += (size_t)snprintf(text, capacity, "#version %d%s%s\n", d->version, d->profile[0] ? " " : "", d->profile);
    at += (size_t)snprintf(text + at, capacity - at,
                           "%s vec3 lambent_position;\n%s vec3 lambent_normal;\n"
                           "uniform mat4 lambent_model_view;\nuniform mat4 lambent_projection;\n"
                           "uniform mat3 lambent_normal_matrix;\nuniform vec4 lambent_light;\n"
                           "uniform mat4 lambent_model;\nuniform mat3 lambent_world_normal_matrix;\n"
                           "uniform vec4 lambent_world_light;\nuniform vec3 lambent_world_eye;\n",
                           modern ? "in" : "attribute", modern ? "in" : "attribute");
    if (r->maps)
        at += (size_t)snprintf(text + at, capacity - at, "%s vec2 lambent_texture_coordinate;\n",
                               modern ? "in" : "attribute");
    for (int i = 0; i < d->count; i++)
        if (d->items[i].kind == DECLARED_INPUT)
            at += (size_t)snprintf(text + at, capacity - at, "%s%s %s %s;\n", d->items[i].flat ? "flat " : "",
                                   modern ? "out" : "varying", d->items[i].type, d->items[i].name);
    at += (size_t)snprintf(text + at, capacity - at,
                           "void main()\n{\n    vec4 p = lambent_model_view * vec4(lambent_position, 1.0);\n"
                           "    vec3 n = normalize(lambent_normal_matrix * lambent_normal);\n"
                           "    vec3 l = lambent_light.xyz - lambent_light.w * p.xyz;\n"
                           "    vec4 world_p = lambent_model * vec4(lambent_position, 1.0);\n"
                           "    vec3 world_n = normalize(lambent_world_normal_matrix * lambent_normal);\n"
                           "    gl_Position = lambent_projection * p;\n");
    for (int i = 0; i < d->count; i++) {
        const struct declaration *item = &d->items[i];
        if (item->kind != DECLARED_INPUT)
            continue;
        const struct contract_varying *v = contract_varying(r->contract, item->name);
        if (!v && declarations_uses(d, item->name) && strlen(unknown) < 150)
            snprintf(unknown + strlen(unknown), 256 - strlen(unknown), "%s%.60s", unknown[0] ? ", " : "", item->name);
        const char *w = "0.0", *from = v ? source_of(v, &w) : "vec3(0.0)";
        if (v && v->semantic == VARYING_TEXCOORD && r->maps)
            from = "vec3(lambent_texture_coordinate, 0.0)";
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
