// fault_shader.c: a program that computes the lighting with faults switched on or off (fault_light.glsl, fault_physical.glsl).
#include "fault_shader.h"
#include "offscreen.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fail.h"
#include "linear.h"
#include "fault_texts.inc"

// What a program is compiled for: constants of its text, so that it computes nothing that a picture does not need. A
// software driver computes both sides of every branch.
struct specialization {
    bool in_vertex, physical, phong, products, ambient_by_light, flat, two_sided;
    int masking, diffuse_share, tone, encoding;
    int lamps;
    bool vectors, terms; // switches of these groups may be on
};

struct program {
    struct specialization made_for;
    GLuint name;
};
enum { MAX_PROGRAMS = 32 };

struct fault_shader {
    struct offscreen offscreen;
    struct program programs[MAX_PROGRAMS]; // the last used first
    int program_count;
    GLuint program; // the one in use
    int size, stride;
    bool rests; // its context is not current
};

static const char *const bit_names[FAULT_BIT_COUNT] = {"NONE",
#define BIT_NAME(name) #name,
                                                       FAULT_BITS(BIT_NAME)
#undef BIT_NAME
};

// The switches up to MEAN_DISTANCE concern normals, spaces and lengths; the others concern attenuation, terms, output.
static bool is_of_vectors(int bit) { return bit <= BIT_MEAN_DISTANCE; }

// Whether a switch can be on in a program: that of a shader with an exponent, or with metalness and roughness.
static bool is_possible(const struct specialization *made_for, int bit)
{
    if (is_of_vectors(bit) ? !made_for->vectors : !made_for->terms)
        return false;
    for (int m = 0; m < fault_count; m++)
        for (int k = 0; k < MAX_FAULT_BITS && faults[m].bits[k] != BIT_NONE; k++)
            if (faults[m].bits[k] == bit && !(faults[m].where & (made_for->physical ? WHERE_CLASSIC : WHERE_PHYSICAL)))
                return true;
    return false;
}

static size_t write_constants(const struct specialization *s, char *out, size_t capacity)
{
    const struct {
        const char *name;
        bool value;
    } flags[] = {{"physical", s->physical}, {"phong_lobe", s->phong},
                 {"products", s->products}, {"ambient_by_light", s->ambient_by_light},
                 {"flat_shading", s->flat}, {"two_sided", s->two_sided}};
    const struct {
        const char *name;
        int value;
    } numbers[] = {{"masking", s->masking},
                   {"diffuse_share", s->diffuse_share},
                   {"tone", s->tone},
                   {"encoding", s->encoding},
                   {"lamp_count", s->lamps}};
    size_t at =
        (size_t)snprintf(out, capacity, "#version 330 core\n%s#define FAULT_BITS %d\n#define LAMPS %d\n",
                         s->in_vertex ? "#define IN_VERTEX\n" : "", FAULT_BIT_COUNT, s->lamps > 0 ? s->lamps : 1);
    for (int i = 0; i < FAULT_BIT_COUNT; i++)
        at += (size_t)snprintf(out + at, capacity - at, "#define %s %d\n", bit_names[i], is_possible(s, i) ? i : -1);
    for (size_t i = 0; i < sizeof flags / sizeof *flags; i++)
        at += (size_t)snprintf(out + at, capacity - at, "const bool %s = %s;\n", flags[i].name,
                               flags[i].value ? "true" : "false");
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        at += (size_t)snprintf(out + at, capacity - at, "const int %s = %d;\n", numbers[i].name, numbers[i].value);
    return at;
}

static GLuint compile(struct fault_shader *m, GLenum kind, const struct specialization *made_for, const char *body,
                      lam_error *error)
{
    size_t capacity =
        strlen(text_fault_physical_glsl) + strlen(text_fault_light_glsl) + strlen(body) + 40 * FAULT_BIT_COUNT + 600;
    char *text = malloc(capacity), log[1024] = "";
    if (!text) {
        fail_memory(error, capacity);
        return 0;
    }
    size_t at = write_constants(made_for, text, capacity);
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

static bool is_same(const struct specialization *a, const struct specialization *b)
{
    return a->in_vertex == b->in_vertex && a->physical == b->physical && a->phong == b->phong &&
           a->products == b->products && a->ambient_by_light == b->ambient_by_light && a->flat == b->flat &&
           a->two_sided == b->two_sided && a->masking == b->masking && a->diffuse_share == b->diffuse_share &&
           a->tone == b->tone && a->encoding == b->encoding && a->lamps == b->lamps && a->vectors == b->vectors &&
           a->terms == b->terms;
}

static GLuint link_program(struct fault_shader *m, const struct specialization *made_for, lam_error *error)
{
    GLuint vertex = compile(m, GL_VERTEX_SHADER, made_for, text_fault_vertex_glsl, error),
           fragment = vertex ? compile(m, GL_FRAGMENT_SHADER, made_for, text_fault_fragment_glsl, error) : 0;
    char log[1024] = "";
    GLuint program = fragment ? offscreen_link(&m->offscreen, vertex, fragment, log, sizeof log) : 0;
    if (fragment && !program)
        fail(error, LAM_UNSUPPORTED, "%s does not link the check's own shaders: %.300s", m->offscreen.context.renderer,
             log);
    const struct gl *gl = &m->offscreen.context.gl;
    gl->DeleteShader(vertex);
    gl->DeleteShader(fragment);
    return program;
}

// Makes the program for these constants the one in use; of more than MAX_PROGRAMS the one that was not used longest goes.
static bool build(struct fault_shader *m, const struct specialization *made_for, lam_error *error)
{
    int at = 0;
    while (at < m->program_count && !is_same(&m->programs[at].made_for, made_for))
        at++;
    struct program found = {.made_for = *made_for};
    if (at < m->program_count) {
        found = m->programs[at];
    } else {
        found.name = link_program(m, made_for, error);
        if (!found.name)
            return false;
        if (m->program_count < MAX_PROGRAMS)
            m->program_count++;
        else
            m->offscreen.context.gl.DeleteProgram(m->programs[--at].name);
    }
    memmove(&m->programs[1], &m->programs[0], (size_t)at * sizeof found);
    m->programs[0] = found;
    m->program = found.name;
    return true;
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
        for (int i = 0; i < m->program_count; i++)
            m->offscreen.context.gl.DeleteProgram(m->programs[i].name);
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
    const struct physical_convention *physical = &interface->contract->physical;
    struct specialization made_for = {.in_vertex = interface->vertex_lit || (reference_scene->flat && !smooth),
                                      .physical = interface->physical,
                                      .phong = reflection == LAM_REFLECTION_PHONG,
                                      .products = shader_interface_declares(interface, SEMANTIC_DIFFUSE_PRODUCT),
                                      .ambient_by_light = shader_interface_declares(interface, SEMANTIC_LIGHT_AMBIENT),
                                      .flat = reference_scene->flat,
                                      .two_sided = (interface->supports & NEED_TWO_SIDES) != 0,
                                      .masking = (int)physical->masking,
                                      .diffuse_share = (int)physical->diffuse,
                                      .tone = (int)physical->tone,
                                      .encoding = (int)physical->encoding,
                                      .lamps = reference_scene->light_count};
    GLint bits[FAULT_BIT_COUNT];
    for (int i = 0; i < FAULT_BIT_COUNT; i++) {
        bits[i] = fault_set_has(set, (enum fault_bit)i);
        *(is_of_vectors(i) ? &made_for.vectors : &made_for.terms) |= bits[i];
    }
    if (!build(m, &made_for, error))
        return false;
    gl->UseProgram(m->program);
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
    gl->Uniform3fv(place(m, "ambient_light"), 1,
                   uniform_semantic_value(SEMANTIC_AMBIENT_LIGHT, 0, frame, reference_scene, &matrices).v);
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
    set_color(m, "base_color", reference_scene->diffuse, 1);
    gl->Uniform1f(place(m, "metallic"), reference_scene->metallic);
    gl->Uniform1f(place(m, "roughness"), reference_scene->roughness);
    // Nothing of a closed mesh's inside is seen; upside down, its front faces turn the other way.
    bool closed = reference_scene->mesh == MESH_SPHERE || reference_scene->mesh == MESH_COARSE;
    (closed ? gl->Enable : gl->Disable)(GL_CULL_FACE);
    gl->CullFace(fault_set_has(set, BIT_UPSIDE_DOWN) ? GL_FRONT : GL_BACK);
    return offscreen_draw(&m->offscreen, reference_scene->mesh, (struct offscreen_places){0, 1, -1}, pixels, error);
}
