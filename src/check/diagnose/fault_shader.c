// fault_shader.c: a program that computes the lighting with faults switched on or off (fault_light.glsl, fault_physical.glsl).
#include "fault_shader.h"
#include "offscreen.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fail.h"
#include "linear.h"
#include "fault_texts.inc"

struct fault_shader {
    struct offscreen offscreen;
    GLuint programs[2]; // lighting in the fragment shader, in the vertex shader; 0: not built yet
    GLuint program;     // the one in use
    int size, stride;
    bool rests; // its context is not current
};

static const char *const bit_names[FAULT_BIT_COUNT] = {"NONE",
#define BIT_NAME(name) #name,
                                                       FAULT_BITS(BIT_NAME)
#undef BIT_NAME
};

static GLuint compile(struct fault_shader *m, GLenum kind, bool in_vertex, const char *body, lam_error *error)
{
    size_t capacity =
        strlen(text_fault_physical_glsl) + strlen(text_fault_light_glsl) + strlen(body) + 40 * FAULT_BIT_COUNT + 100;
    char *text = malloc(capacity), log[1024] = "";
    if (!text) {
        fail_memory(error, capacity);
        return 0;
    }
    size_t at = (size_t)snprintf(text, capacity, "#version 330 core\n%s#define FAULT_BITS %d\n",
                                 in_vertex ? "#define IN_VERTEX\n" : "", FAULT_BIT_COUNT);
    for (int i = 0; i < FAULT_BIT_COUNT; i++)
        at += (size_t)snprintf(text + at, capacity - at, "#define %s %d\n", bit_names[i], i);
    snprintf(text + at, capacity - at, "%s%s%s", text_fault_physical_glsl, text_fault_light_glsl, body);
    GLuint shader = offscreen_compile(&m->offscreen, kind, text, log, sizeof log);
    free(text);
    if (!shader)
        fail(error, LAM_UNSUPPORTED, "%s does not compile the check's own shader: %.300s",
             m->offscreen.context.renderer, log);
    return shader;
}

struct fault_shader *fault_shader_open(const char *gl_device, int size, int stride, lam_error *error)
{
    struct fault_shader *m = calloc(1, sizeof *m);
    if (!m) {
        fail_memory(error, sizeof *m);
        return NULL;
    }
    m->size = size;
    m->stride = stride;
    if (!offscreen_open(&m->offscreen, GL_PROFILE_CORE, gl_device, fault_shader_size(size, stride), error)) {
        free(m);
        return NULL;
    }
    return m;
}

static bool build(struct fault_shader *m, bool in_vertex, lam_error *error)
{
    m->program = m->programs[in_vertex];
    if (m->program)
        return true;
    GLuint vertex = compile(m, GL_VERTEX_SHADER, in_vertex, text_fault_vertex_glsl, error),
           fragment = vertex ? compile(m, GL_FRAGMENT_SHADER, in_vertex, text_fault_fragment_glsl, error) : 0;
    char log[1024] = "";
    if (fragment) {
        m->program = m->programs[in_vertex] = offscreen_link(&m->offscreen, vertex, fragment, log, sizeof log);
        if (!m->program)
            fail(error, LAM_UNSUPPORTED, "%s does not link the check's own shaders: %.300s",
                 m->offscreen.context.renderer, log);
    }
    const struct gl *gl = &m->offscreen.context.gl;
    gl->DeleteShader(vertex);
    gl->DeleteShader(fragment);
    return m->program != 0;
}

bool fault_shader_draws(const struct fault_shader *m, int size, int stride)
{
    return m->size == size && m->stride == stride;
}

void fault_shader_rest(struct fault_shader *m)
{
    offscreen_rest(&m->offscreen);
    m->rests = true;
}

bool fault_shader_wake(struct fault_shader *m, lam_error *error)
{
    bool ok = offscreen_wake(&m->offscreen, error);
    m->rests = m->rests && !ok;
    return ok;
}

void fault_shader_close(struct fault_shader *m)
{
    if (!m)
        return;
    if (!m->rests || fault_shader_wake(m, NULL)) {
        for (int i = 0; i < 2; i++)
            if (m->programs[i])
                m->offscreen.context.gl.DeleteProgram(m->programs[i]);
        offscreen_close(&m->offscreen);
    }
    free(m);
}

static GLint place(const struct fault_shader *m, const char *name)
{
    return m->offscreen.context.gl.GetUniformLocation(m->program, name);
}

static GLint lamp_place(const struct fault_shader *m, int i, const char *member)
{
    char name[64];
    snprintf(name, sizeof name, "lamps[%d].%s", i, member);
    return place(m, name);
}

static void set_lamp(const struct fault_shader *m, int i, const struct shader_interface *interface,
                     lam_light_frame frame, const struct reference_scene *reference_scene,
                     const struct reference_matrices *matrices)
{
    const struct gl *gl = &m->offscreen.context.gl;
    const struct reference_light *light = &reference_scene->lights[i];
    lam_light_frame space = interface->space;
    // A direction comes with unit length, a position whose w is 0 does not.
    bool unit = light->type == LAM_LIGHT_DIRECTIONAL && !shader_interface_uses(interface, SEMANTIC_LIGHT_POSITION) &&
                !shader_interface_uses(interface, SEMANTIC_LIGHT_X);
    enum uniform_semantic position = unit ? SEMANTIC_LIGHT_DIRECTION : SEMANTIC_LIGHT_POSITION;
    const struct {
        const char *member;
        enum uniform_semantic semantic;
        lam_light_frame frame;
    } members[] = {{"position", position, space},
                   {"given", position, frame},
                   {"axis", SEMANTIC_LIGHT_TRAVEL, space},
                   {"cone", SEMANTIC_CONE, frame}};
    for (int k = 0; k < 4; k++)
        gl->Uniform4fv(lamp_place(m, i, members[k].member), 1,
                       uniform_semantic_value(members[k].semantic, i, members[k].frame, reference_scene, matrices).v);
    gl->Uniform3fv(lamp_place(m, i, "attenuation"), 1, light->attenuation);
    gl->Uniform3f(lamp_place(m, i, "diffuse"), light->color.r, light->color.g, light->color.b);
    gl->Uniform3f(lamp_place(m, i, "specular"), light->specular.r, light->specular.g, light->specular.b);
    lam_rgb a = reference_scene->ambient;
    float ka = reference_scene->ka;
    gl->Uniform3f(lamp_place(m, i, "ambient"), a.r * ka * light->ambient.r, a.g * ka * light->ambient.g,
                  a.b * ka * light->ambient.b);
}

static void set_color(const struct fault_shader *m, const char *name, lam_rgb c, float k)
{
    m->offscreen.context.gl.Uniform3f(place(m, name), c.r * k, c.g * k, c.b * k);
}

bool fault_shader_draw(struct fault_shader *m, const struct reference_scene *reference_scene,
                       const struct shader_interface *interface, int light_capacity, lam_light_frame frame,
                       lam_reflection reflection, const fault_set *set, float *pixels, lam_error *error)
{
    const struct gl *gl = &m->offscreen.context.gl;
    struct reference_matrices matrices;
    reference_matrices(reference_scene, &matrices);
    bool smooth = fault_set_has(set, BIT_SMOOTH_FOR_FLAT);
    if (!build(m, interface->vertex_lit || (reference_scene->flat && !smooth), error))
        return false;
    gl->UseProgram(m->program);
    GLint bits[FAULT_BIT_COUNT];
    for (int i = 0; i < FAULT_BIT_COUNT; i++)
        bits[i] = fault_set_has(set, (enum fault_bit)i);
    gl->Uniform1iv(place(m, "fault_on"), FAULT_BIT_COUNT, bits);
    lam_light_frame space = interface->space;
    const struct {
        const char *name;
        enum uniform_semantic eye, world; // where the lighting is in eye space, and in world space
    } values[] = {{"to_lighting", SEMANTIC_MODEL_VIEW, SEMANTIC_MODEL},
                  {"to_clip", SEMANTIC_PROJECTION, SEMANTIC_VIEW_PROJECTION},
                  {"to_eye_space", SEMANTIC_NONE, SEMANTIC_VIEW},
                  {"normal_matrix4", SEMANTIC_NORMAL_MATRIX, SEMANTIC_NORMAL_MATRIX}};
    for (size_t i = 0; i < sizeof values / sizeof *values; i++) {
        enum uniform_semantic semantic = space == LAM_FRAME_WORLD ? values[i].world : values[i].eye;
        if (semantic != SEMANTIC_NONE)
            gl->UniformMatrix4fv(place(m, values[i].name), 1, GL_FALSE,
                                 uniform_semantic_value(semantic, 0, space, reference_scene, &matrices).v);
    }
    gl->Uniform4fv(place(m, "eye_position"), 1,
                   uniform_semantic_value(SEMANTIC_EYE_POSITION, 0, space, reference_scene, &matrices).v);
    // The third row of the view matrix is the eye's axis in world space.
    const lam_mat4 *view = &matrices.view;
    if (space == LAM_FRAME_WORLD)
        gl->Uniform4f(place(m, "eye_axis"), (float)view->m[2][0], (float)view->m[2][1], (float)view->m[2][2], 0);
    else
        gl->Uniform4f(place(m, "eye_axis"), 0, 0, 1, 0);
    float small = (float)(m->stride * m->offscreen.size), scale = (float)m->size / small;
    float offset = scale + (float)(m->stride - 1) / small - 1;
    gl->Uniform4f(place(m, "window"), scale, scale, offset, offset);
    for (int i = 0; i < reference_scene->light_count; i++)
        set_lamp(m, i, interface, frame, reference_scene, &matrices);
    gl->Uniform1i(place(m, "lamp_count"), reference_scene->light_count);
    gl->Uniform3fv(place(m, "ambient_light"), 1,
                   uniform_semantic_value(SEMANTIC_AMBIENT_LIGHT, 0, frame, reference_scene, &matrices).v);
    gl->Uniform1i(place(m, "products"), shader_interface_declares(interface, SEMANTIC_DIFFUSE_PRODUCT));
    set_color(m, "ka", reference_scene->ambient, reference_scene->ka);
    set_color(m, "kd", reference_scene->diffuse, reference_scene->kd);
    set_color(m, "ks", reference_scene->specular, reference_scene->ks);
    set_color(m, "bare_ka", reference_scene->ambient, 1);
    set_color(m, "bare_kd", reference_scene->diffuse, 1);
    set_color(m, "bare_ks", reference_scene->specular, 1);
    // In contracts with separate strengths and colours, shaders confuse one of them; in the others, the products.
    bool apart = interface->contract->material_strengths;
    set_color(m, "kd_with_ks", apart ? reference_scene->diffuse : reference_scene->specular, reference_scene->ks);
    set_color(m, "ks_with_kd", apart ? reference_scene->specular : reference_scene->diffuse, reference_scene->kd);
    set_color(m, "specular_as_diffuse", reference_scene->diffuse, apart ? reference_scene->ks : reference_scene->kd);
    set_color(m, "tint", reference_scene->diffuse, apart ? 1 : reference_scene->kd);
    gl->Uniform1f(place(m, "light_capacity"), (float)light_capacity);
    gl->Uniform1f(place(m, "opacity"), reference_scene->alpha);
    gl->Uniform1f(place(m, "shininess"), reference_scene->shininess);
    gl->Uniform1f(place(m, "exponent_factor"), set->factor);
    gl->Uniform1f(place(m, "exponent_constant"), set->constant);
    gl->Uniform1i(place(m, "ambient_by_light"), shader_interface_declares(interface, SEMANTIC_LIGHT_AMBIENT));
    gl->Uniform1i(place(m, "phong_lobe"), reflection == LAM_REFLECTION_PHONG);
    const struct physical_convention *physical = &interface->contract->physical;
    gl->Uniform1i(place(m, "physical"), interface->physical);
    set_color(m, "base_color", reference_scene->diffuse, 1);
    gl->Uniform1f(place(m, "metallic"), reference_scene->metallic);
    gl->Uniform1f(place(m, "roughness"), reference_scene->roughness);
    gl->Uniform1i(place(m, "masking"), (GLint)physical->masking);
    gl->Uniform1i(place(m, "diffuse_share"), (GLint)physical->diffuse);
    gl->Uniform1i(place(m, "tone"), (GLint)physical->tone);
    gl->Uniform1i(place(m, "encoding"), (GLint)physical->encoding);
    gl->Uniform1i(place(m, "flat_shading"), reference_scene->flat);
    gl->Uniform1i(place(m, "two_sided"), (interface->supports & NEED_TWO_SIDES) != 0);
    return offscreen_draw(&m->offscreen, reference_scene->mesh, 0, 1, pixels, error);
}
