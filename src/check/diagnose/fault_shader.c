// fault_shader.c: the program that lights rightly or, on purpose, wrongly (fault_light.glsl).
#include "fault_shader.h"
#include "offscreen.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fail.h"
#include "linear.h"
#include "fault_texts.inc"

struct model {
    struct target target;
    GLuint programs[2]; // lighting in the fragment shader, in the vertex shader; made when first used
    GLuint program;     // the one in use
};

static const char *const bit_names[] = {
#define BIT_NAME(name) #name,
    MISTAKE_BITS(BIT_NAME)
#undef BIT_NAME
};

static GLuint compile(struct model *m, GLenum kind, bool in_vertex, const char *body, lam_error *error)
{
    size_t room = strlen(text_fault_light_glsl) + strlen(body) + 40 * MISTAKE_BIT_COUNT + 100;
    char *text = malloc(room), log[1024] = "";
    if (!text) {
        fail_memory(error, room);
        return 0;
    }
    size_t at = (size_t)snprintf(text, room, "#version 330 core\n%s#define MISTAKE_BITS %d\n",
                                 in_vertex ? "#define IN_VERTEX\n" : "", MISTAKE_BIT_COUNT);
    for (int i = 0; i < MISTAKE_BIT_COUNT; i++)
        at += (size_t)snprintf(text + at, room - at, "#define %s %d\n", bit_names[i], i);
    snprintf(text + at, room - at, "%s%s", text_fault_light_glsl, body);
    GLuint shader = target_compile(&m->target, kind, text, log, sizeof log);
    free(text);
    if (!shader)
        fail(error, LAM_UNSUPPORTED, "%s does not compile the check's own shader: %.300s", m->target.context.renderer,
             log);
    return shader;
}

struct model *model_open(const char *gl_device, int size, lam_error *error)
{
    struct model *m = calloc(1, sizeof *m);
    if (!m) {
        fail_memory(error, sizeof *m);
        return NULL;
    }
    if (!target_open(&m->target, GL_PROFILE_CORE, gl_device, size, error)) {
        free(m);
        return NULL;
    }
    return m;
}

static bool build(struct model *m, bool in_vertex, lam_error *error)
{
    m->program = m->programs[in_vertex];
    if (m->program)
        return true;
    GLuint vertex = compile(m, GL_VERTEX_SHADER, in_vertex, text_fault_vertex_glsl, error),
           fragment = vertex ? compile(m, GL_FRAGMENT_SHADER, in_vertex, text_fault_fragment_glsl, error) : 0;
    char log[1024] = "";
    if (fragment) {
        m->program = m->programs[in_vertex] = target_link(&m->target, vertex, fragment, log, sizeof log);
        if (!m->program)
            fail(error, LAM_UNSUPPORTED, "%s does not link the check's own shaders: %.300s", m->target.context.renderer,
                 log);
    }
    const struct gl *gl = &m->target.context.gl;
    gl->DeleteShader(vertex);
    gl->DeleteShader(fragment);
    return m->program != 0;
}

void model_close(struct model *m)
{
    if (!m)
        return;
    for (int i = 0; i < 2; i++)
        if (m->programs[i])
            m->target.context.gl.DeleteProgram(m->programs[i]);
    target_close(&m->target);
    free(m);
}

static GLint place(const struct model *m, const char *name)
{
    return m->target.context.gl.GetUniformLocation(m->program, name);
}

static GLint lamp_place(const struct model *m, int i, const char *member)
{
    char name[64];
    snprintf(name, sizeof name, "lamps[%d].%s", i, member);
    return place(m, name);
}

static void set_lamp(const struct model *m, int i, const struct study_light *light, const struct reading *reading,
                     lam_light_frame frame, const struct study *study, const struct study_matrices *matrices)
{
    const struct gl *gl = &m->target.context.gl;
    const struct contract *contract = reading->contract;
    float v[16];
    role_value(ROLE_LIGHT_POSITION, i, contract, LAM_FRAME_CAMERA, study, matrices, v);
    gl->Uniform4fv(lamp_place(m, i, "position"), 1, v);
    role_value(ROLE_LIGHT_POSITION, i, contract, frame, study, matrices, v);
    gl->Uniform4fv(lamp_place(m, i, "given"), 1, v);
    role_value(ROLE_LIGHT_TRAVEL, i, contract, LAM_FRAME_CAMERA, study, matrices, v);
    gl->Uniform3fv(lamp_place(m, i, "axis"), 1, v);
    role_value(ROLE_CONE, i, contract, frame, study, matrices, v);
    gl->Uniform2fv(lamp_place(m, i, "cone"), 1, v);
    gl->Uniform3fv(lamp_place(m, i, "attenuation"), 1, light->attenuation);
    gl->Uniform3f(lamp_place(m, i, "diffuse"), light->color.r, light->color.g, light->color.b);
    gl->Uniform3f(lamp_place(m, i, "specular"), light->specular.r, light->specular.g, light->specular.b);
}

static void set_color(const struct model *m, const char *name, lam_rgb c, float k)
{
    m->target.context.gl.Uniform3f(place(m, name), c.r * k, c.g * k, c.b * k);
}

bool model_draw(struct model *m, const struct study *study, const struct reading *reading, int room,
                lam_light_frame frame, lam_reflection reflection, mistake_set set, float *pixels, lam_error *error)
{
    const struct gl *gl = &m->target.context.gl;
    struct study_matrices matrices;
    study_matrices(study, &matrices);
    bool smooth = set >> BIT_SMOOTH_FOR_FLAT & 1;
    if (!build(m, reading->vertex_lit || (study->flat && !smooth), error))
        return false;
    gl->UseProgram(m->program);
    GLint bits[MISTAKE_BIT_COUNT];
    for (int i = 0; i < MISTAKE_BIT_COUNT; i++)
        bits[i] = (GLint)(set >> i & 1);
    gl->Uniform1iv(place(m, "mistaken"), MISTAKE_BIT_COUNT, bits);
    float v[16];
    const struct contract *contract = reading->contract;
    role_value(ROLE_MODEL_VIEW, 0, contract, frame, study, &matrices, v);
    gl->UniformMatrix4fv(place(m, "model_view"), 1, GL_FALSE, v);
    role_value(ROLE_PROJECTION, 0, contract, frame, study, &matrices, v);
    gl->UniformMatrix4fv(place(m, "projection"), 1, GL_FALSE, v);
    role_value(ROLE_NORMAL_MATRIX, 0, contract, frame, study, &matrices, v);
    gl->UniformMatrix4fv(place(m, "normal_matrix4"), 1, GL_FALSE, v);
    for (int i = 0; i < study->light_count; i++)
        set_lamp(m, i, &study->lights[i], reading, frame, study, &matrices);
    gl->Uniform1i(place(m, "lamp_count"), study->light_count);
    float light[16];
    role_value(ROLE_AMBIENT_LIGHT, 0, contract, frame, study, &matrices, light);
    gl->Uniform3f(place(m, "ambient_product"), study->ambient.r * study->ka * light[0],
                  study->ambient.g * study->ka * light[1], study->ambient.b * study->ka * light[2]);
    set_color(m, "kd", study->diffuse, study->kd);
    set_color(m, "ks", study->specular, study->ks);
    // Contracts with strengths and colours apart mix up the one or the other; the rest have only their products.
    bool apart = contract->material_strengths;
    set_color(m, "kd_with_ks", apart ? study->diffuse : study->specular, study->ks);
    set_color(m, "ks_with_kd", apart ? study->specular : study->diffuse, study->kd);
    set_color(m, "specular_as_diffuse", study->diffuse, apart ? study->ks : study->kd);
    set_color(m, "tint", study->diffuse, apart ? 1 : study->kd);
    gl->Uniform1f(place(m, "light_room"), (float)room);
    gl->Uniform1f(place(m, "opacity"), study->alpha);
    gl->Uniform1f(place(m, "shininess"), study->shininess);
    gl->Uniform1i(place(m, "phong_lobe"), reflection == LAM_REFLECTION_PHONG);
    gl->Uniform1i(place(m, "flat_shading"), study->flat);
    gl->Uniform1i(place(m, "two_sided"), (reading->offers & NEED_TWO_SIDES) != 0);
    return target_draw(&m->target, study->mesh, 0, 1, pixels, error);
}
