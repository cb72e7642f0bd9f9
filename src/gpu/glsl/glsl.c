// glsl.c: generates a vertex and a fragment shader from a set of choices.
#include "glsl.h"

#include "fail.h"
#include "glsl_rows.h"

#include <stdlib.h>

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
    return !c->style || c->style->check(c, f, error);
}

// --- the shader

static const char *const version_lines[] = {"#version 120\n", "#version 330 core\n",
                                            "#version 300 es\nprecision highp float;\nprecision highp int;\n"};

static char *make_stage(const struct glsl_facts *f, bool fragment, lam_error *error)
{
    struct text body = {0}, text = {0};
    const struct glsl_choices *c = f->choices;
    const struct glsl_facts stage = glsl_stage_facts(f, fragment);
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
    struct glsl_facts facts = glsl_facts_of(choices);
    if (!check(choices, &facts, error))
        return false;
    text->vertex = make_stage(&facts, false, error);
    text->fragment = text->vertex ? make_stage(&facts, true, error) : NULL;
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
