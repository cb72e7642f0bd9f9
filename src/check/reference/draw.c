// draw.c: compiles the shaders under test, sets their uniforms for each reference scene, and draws.
#include "draw_request.h"
#include "offscreen.h"
#include "shader_dialect.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "fail.h"

enum { MAX_BLOCKS = 8, MAX_BLOCK_BYTES = 65536, MAX_TEXTURES = 16 };

// The types of uniforms: matrices have several columns, vectors one of several rows.
static const struct glsl_type {
    GLenum type;
    const char *name;
    int columns, rows;
} types[] = {
    {GL_FLOAT, "float", 1, 1},     {GL_INT, "int", 1, 1},         {GL_BOOL, "bool", 1, 1},
    {GL_FLOAT_VEC2, "vec2", 1, 2}, {GL_FLOAT_VEC3, "vec3", 1, 3}, {GL_FLOAT_VEC4, "vec4", 1, 4},
    {GL_FLOAT_MAT3, "mat3", 3, 3}, {GL_FLOAT_MAT4, "mat4", 4, 4}, {GL_SAMPLER_2D, "sampler2D", 1, 4},
    {0, "another type", 0, 0},
};

// An active uniform with a name of the contract, one element of it.
struct uniform_binding {
    const struct contract_name *name;
    int light;
    const struct glsl_type *type;
    GLint location; // −1: in a block
    int block, offset, matrix_stride;
    GLuint texture; // of a sampler; 0: not made yet
};

struct shader_run {
    struct offscreen offscreen;
    struct shader_interface interface;
    struct draw_request request;
    struct draw_result drawn;
    GLuint program;
    struct offscreen_places places;
    struct uniform_binding *bindings; // one for each element of each uniform
    int binding_count;
    GLuint blocks[MAX_BLOCKS];
    int block_bytes[MAX_BLOCKS];
};

static void report_unknown(struct draw_result *drawn, const char *name)
{
    for (int i = 0; i < drawn->unknown_count; i++)
        if (strcmp(drawn->unknown[i], name) == 0)
            return;
    if (drawn->unknown_count < MAX_UNKNOWN_NAMES)
        snprintf(drawn->unknown[drawn->unknown_count++], sizeof drawn->unknown[0], "%.63s", name);
}

static const struct glsl_type *type_of(GLenum type)
{
    const struct glsl_type *t = types;
    while (t->type && t->type != type)
        t++;
    return t;
}

// Whether a uniform's type can hold the contract's: matrices fit matrices, vectors vectors, scalars scalars. A colour may
// come as a texture.
static bool type_fits(const struct glsl_type *t, const struct contract_name *name)
{
    const char *contract_type = name->type;
    if (t->type == GL_SAMPLER_2D)
        return (role_of(name->semantic)->types & TYPE_SAMPLER) != 0;
    if (strncmp(contract_type, "mat", 3) == 0)
        return t->columns > 1;
    if (strncmp(contract_type, "vec", 3) == 0)
        return t->columns == 1 && t->rows > 2;
    return t->rows == 1;
}

static const struct contract_name *look_up(const struct contract *contract, const char *name, bool attribute,
                                           int *index)
{
    const struct contract_name *found = contract_find(contract, name, attribute, index);
    const char *dot = strchr(name, '.');
    return found || !dot ? found : contract_find(contract, dot + 1, attribute, index); // Block.member
}

static void add_binding(struct shader_run *run, GLuint number, const char *name, GLenum type, GLint elements)
{
    const struct gl *gl = &run->offscreen.context.gl;
    if (strncmp(name, "gl_", 3) == 0)
        return;
    int light = 0;
    const struct contract_name *known = look_up(run->interface.contract, name, false, &light);
    if (!known) {
        report_unknown(&run->drawn, name);
        return;
    }
    if (!type_fits(type_of(type), known)) {
        if (run->drawn.types_count < MAX_UNKNOWN_NAMES)
            snprintf(run->drawn.types[run->drawn.types_count++], sizeof run->drawn.types[0],
                     "uniform %s %.40s should be of type %s", type_of(type)->name, name, known->type);
        return;
    }
    GLint block = -1, offset = 0, stride = 0, array_stride = 0;
    gl->GetActiveUniformsiv(run->program, 1, &number, GL_UNIFORM_BLOCK_INDEX, &block);
    if (block >= 0) {
        gl->GetActiveUniformsiv(run->program, 1, &number, GL_UNIFORM_OFFSET, &offset);
        gl->GetActiveUniformsiv(run->program, 1, &number, GL_UNIFORM_MATRIX_STRIDE, &stride);
        gl->GetActiveUniformsiv(run->program, 1, &number, GL_UNIFORM_ARRAY_STRIDE, &array_stride);
    }
    for (int i = 0; i < elements; i++) {
        char element[128];
        snprintf(element, sizeof element, "%s", name);
        char *bracket = elements > 1 ? strrchr(element, '[') : NULL;
        if (bracket && i > 0)
            snprintf(bracket, sizeof element - (size_t)(bracket - element), "[%d]", i);
        run->bindings[run->binding_count++] =
            (struct uniform_binding){.name = known,
                                     .light = light + i,
                                     .type = type_of(type),
                                     .block = block,
                                     .location = block < 0 ? gl->GetUniformLocation(run->program, element) : -1,
                                     .offset = offset + i * array_stride,
                                     .matrix_stride = stride};
        int *count = known->group >= 0 ? &run->drawn.group_counts[known->group] : NULL;
        if (count && strchr(name, '[') && light + i + 1 > *count)
            *count = light + i + 1;
    }
}

static bool find_uniforms(struct shader_run *run, lam_error *error)
{
    const struct gl *gl = &run->offscreen.context.gl;
    GLint count = 0, blocks = 0;
    size_t capacity = 1;
    gl->GetProgramiv(run->program, GL_ACTIVE_UNIFORMS, &count);
    for (GLuint i = 0; i < (GLuint)count; i++) {
        char name[8];
        GLint elements = 0;
        GLenum type = 0;
        gl->GetActiveUniform(run->program, i, sizeof name, NULL, &elements, &type, name);
        capacity += (size_t)elements;
    }
    run->bindings = calloc(capacity, sizeof *run->bindings);
    if (!run->bindings)
        return fail_memory(error, capacity * sizeof *run->bindings);
    for (GLuint i = 0; i < (GLuint)count; i++) {
        char name[128];
        GLint elements = 0;
        GLenum type = 0;
        gl->GetActiveUniform(run->program, i, sizeof name, NULL, &elements, &type, name);
        add_binding(run, i, name, type, elements);
    }
    gl->GetProgramiv(run->program, GL_ACTIVE_UNIFORM_BLOCKS, &blocks);
    for (GLuint i = 0; i < (GLuint)blocks && i < MAX_BLOCKS; i++) {
        GLint bytes = 0;
        gl->GetActiveUniformBlockiv(run->program, i, GL_UNIFORM_BLOCK_DATA_SIZE, &bytes);
        run->block_bytes[i] = bytes < MAX_BLOCK_BYTES ? bytes : MAX_BLOCK_BYTES;
        gl->GenBuffers(1, &run->blocks[i]);
        gl->BindBufferBase(GL_UNIFORM_BUFFER, i, run->blocks[i]);
        gl->UniformBlockBinding(run->program, i, i);
    }
    return true;
}

static void find_attributes(struct shader_run *run)
{
    const struct gl *gl = &run->offscreen.context.gl;
    GLint count = 0;
    run->places = (struct offscreen_places){-1, -1, -1};
    gl->GetProgramiv(run->program, GL_ACTIVE_ATTRIBUTES, &count);
    for (GLuint i = 0; i < (GLuint)count; i++) {
        char name[128];
        GLint elements = 0;
        GLenum type = 0;
        gl->GetActiveAttrib(run->program, i, sizeof name, NULL, &elements, &type, name);
        if (strncmp(name, "gl_", 3) == 0)
            continue;
        const struct contract_name *known = contract_find(run->interface.contract, name, true, NULL);
        if (!known)
            report_unknown(&run->drawn, name);
        else if (known->semantic == SEMANTIC_POSITION)
            run->places.position = gl->GetAttribLocation(run->program, name);
        else if (known->semantic == SEMANTIC_NORMAL)
            run->places.normal = gl->GetAttribLocation(run->program, name);
        else if (known->semantic == SEMANTIC_TANGENT)
            run->places.tangent = gl->GetAttribLocation(run->program, name);
    }
}

// The columns of a value, as a uniform's type has them.
static void convert_value(const struct glsl_type *type, const struct uniform_value *value, float out[16])
{
    for (int c = 0; c < type->columns; c++)
        memcpy(out + c * type->rows, value->v + 4 * c, (size_t)type->rows * sizeof *out);
}

// A texture of one texel.
static void set_sampler(const struct gl *gl, struct uniform_binding *w, int unit, const float *v)
{
    if (!w->texture)
        gl->GenTextures(1, &w->texture);
    gl->ActiveTexture(GL_TEXTURE0 + (GLenum)unit);
    gl->BindTexture(GL_TEXTURE_2D, w->texture);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl->TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, 1, 1, 0, GL_RGBA, GL_FLOAT, v);
    gl->Uniform1i(w->location, unit);
}

static void set_uniform(const struct gl *gl, const struct uniform_binding *w, const float *v)
{
    GLint whole = (GLint)v[0];
    switch (w->type->type) {
    case GL_FLOAT:
        gl->Uniform1fv(w->location, 1, v);
        break;
    case GL_FLOAT_VEC3:
        gl->Uniform3fv(w->location, 1, v);
        break;
    case GL_FLOAT_VEC4:
        gl->Uniform4fv(w->location, 1, v);
        break;
    case GL_FLOAT_MAT3:
        gl->UniformMatrix3fv(w->location, 1, GL_FALSE, v);
        break;
    case GL_FLOAT_MAT4:
        gl->UniformMatrix4fv(w->location, 1, GL_FALSE, v);
        break;
    default:
        gl->Uniform1iv(w->location, 1, &whole);
        break;
    }
}

static void store_in_block(const struct uniform_binding *w, const float *v, unsigned char *bytes, int capacity)
{
    size_t size = (size_t)w->type->rows * sizeof *v;
    int32_t whole = (int32_t)v[0];
    bool is_whole = w->type->type == GL_INT || w->type->type == GL_BOOL;
    for (int c = 0; c < w->type->columns; c++) {
        int at = w->offset + c * w->matrix_stride;
        if (at < 0 || at + (int)size > capacity)
            return;
        memcpy(bytes + at, is_whole ? (const void *)&whole : v + c * w->type->rows, size);
    }
}

static void set_built_ins(const struct gl *gl, const struct reference_matrices *m)
{
    if (!gl->MatrixMode || !gl->LoadMatrixf)
        return;
    gl->MatrixMode(GL_MODELVIEW);
    gl->LoadMatrixf(matrix_value(&m->model_view).v);
    gl->MatrixMode(GL_PROJECTION);
    gl->LoadMatrixf(matrix_value(&m->projection).v);
}

static bool set_values(struct shader_run *run, const struct reference_scene *reference_scene, enum gl_profile profile,
                       lam_error *error)
{
    const struct gl *gl = &run->offscreen.context.gl;
    lam_light_frame frame = (lam_light_frame)run->request.light_frame;
    struct reference_matrices m;
    reference_matrices(reference_scene, &m);
    if (profile == GL_PROFILE_COMPATIBILITY)
        set_built_ins(gl, &m);
    unsigned char *bytes = calloc(MAX_BLOCKS, MAX_BLOCK_BYTES);
    if (!bytes)
        return fail_memory(error, MAX_BLOCKS * MAX_BLOCK_BYTES);
    int unit = 0;
    for (int i = 0; i < run->binding_count; i++) {
        struct uniform_binding *w = &run->bindings[i];
        lam_light_frame space = w->name->group >= 0 && frame != LAM_FRAME_WORLD ? frame : w->name->space;
        int light = w->name->group < 0
                        ? w->light
                        : shader_interface_light(&run->interface, reference_scene, w->name->group, w->light);
        struct uniform_value value = uniform_semantic_value(w->name->semantic, light, space, reference_scene, &m);
        float shaped[16];
        convert_value(w->type, &value, shaped);
        if (w->type->type == GL_SAMPLER_2D && unit < MAX_TEXTURES)
            set_sampler(gl, w, unit++, shaped);
        else if (w->block < 0)
            set_uniform(gl, w, shaped);
        else if (w->block < MAX_BLOCKS)
            store_in_block(w, shaped, bytes + (size_t)w->block * MAX_BLOCK_BYTES, run->block_bytes[w->block]);
    }
    for (int i = 0; i < MAX_BLOCKS; i++)
        if (run->blocks[i]) {
            gl->BindBuffer(GL_UNIFORM_BUFFER, run->blocks[i]);
            gl->BufferData(GL_UNIFORM_BUFFER, run->block_bytes[i], bytes + (size_t)i * MAX_BLOCK_BYTES, GL_STATIC_DRAW);
        }
    free(bytes);
    return true;
}

// --- endless shaders

// Software drivers leave an endless loop after some ten thousand iterations and continue with the values so far. Such a
// shader is recognised by its processor time, over all threads: a correct shader takes a hundredth of the limit. The
// limit follows the machine's speed: it is a multiple of the time of a sum of dependent terms, measured in pieces so
// short that at least one of them runs without an interruption.
enum { PIECES = 16, TERMS = 1 << 16, TERMS_PER_PIXEL = 2000, MIN_PIXELS = 128 * 128 };
static const double min_time_limit_s = 0.05; // the clock's resolution may be as coarse as 10 ms

static double seconds(clockid_t clock)
{
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

static double time_limit_s(int size)
{
    volatile float seed = 0.5f;
    double shortest = 1;
    for (int piece = 0; piece < PIECES; piece++) {
        double start = seconds(CLOCK_MONOTONIC);
        float x = seed, a = seed;
        for (int i = 0; i < TERMS; i++)
            x = x * a + a;
        seed = x * 0.5f;
        double taken = seconds(CLOCK_MONOTONIC) - start;
        shortest = taken < shortest ? taken : shortest;
    }
    double limit = shortest / TERMS * TERMS_PER_PIXEL * ((double)size * size + MIN_PIXELS);
    return limit > min_time_limit_s ? limit : min_time_limit_s;
}

// Compiles both texts, so that the errors of both are known at once, and links them. 0: refused; `drawn` says why.
static GLuint build_texts(struct offscreen *t, const char *vertex_text, const char *fragment_text,
                          struct draw_result *drawn)
{
    const struct gl *gl = &t->context.gl;
    GLuint vertex = offscreen_compile(t, GL_VERTEX_SHADER, vertex_text, drawn->log, sizeof drawn->log);
    GLuint fragment =
        offscreen_compile(t, GL_FRAGMENT_SHADER, fragment_text, drawn->fragment_log, sizeof drawn->fragment_log);
    GLuint program = 0;
    drawn->refused_vertex = !vertex;
    drawn->refused_fragment = !fragment;
    drawn->state = DRAWN_REFUSED;
    if (vertex && fragment) {
        program = offscreen_link(t, vertex, fragment, drawn->log, sizeof drawn->log);
        drawn->state = program ? DRAWN_PICTURES : DRAWN_REFUSED_LINK;
    }
    gl->DeleteShader(vertex); // ignores 0
    gl->DeleteShader(fragment);
    return program;
}

// Compiles and links the shaders. Errors are recorded in run->drawn. They are those of the texts as they stand; then
// both are built with full precision, which a correct shader may lack (shader_dialect.h).
static bool build(struct shader_run *run, lam_error *error)
{
    const char *vertex = shader_dialect_skip_mark(run->request.vertex),
               *fragment = shader_dialect_skip_mark(run->request.fragment);
    run->program = build_texts(&run->offscreen, vertex, fragment, &run->drawn);
    if (!run->program || !(shader_dialect_lowers_precision(vertex) || shader_dialect_lowers_precision(fragment)))
        return true;
    char *high_vertex = shader_dialect_highp(vertex), *high_fragment = shader_dialect_highp(fragment);
    struct draw_result *unused = calloc(1, sizeof *unused);
    GLuint high = 0;
    if (high_vertex && high_fragment && unused)
        high = build_texts(&run->offscreen, high_vertex, high_fragment, unused);
    if (high) {
        run->offscreen.context.gl.DeleteProgram(run->program);
        run->program = high;
    }
    bool ok = high_vertex && high_fragment && unused;
    free(high_vertex);
    free(high_fragment);
    free(unused);
    return ok || fail_memory(error, strlen(vertex) + strlen(fragment));
}

static bool draw_scenes(struct shader_run *run, enum gl_profile profile, float *pixels, lam_error *error)
{
    run->offscreen.context.gl.UseProgram(run->program);
    if (!find_uniforms(run, error))
        return false;
    find_attributes(run);
    shader_interface_set_counts(&run->interface, run->drawn.group_counts);
    size_t at = 0, each = 4 * (size_t)run->request.size * (size_t)run->request.size;
    double limit = time_limit_s(run->request.size);
    for (int i = 0; i < reference_scene_count; i++)
        if (run->request.scenes >> i & 1) {
            struct reference_scene reference_scene = shader_interface_scene(&run->interface, &reference_scenes[i]);
            if (!set_values(run, &reference_scene, profile, error))
                return false;
            double taken = 0;
            for (int turn = 0; turn == 0 || (turn == 1 && taken > limit);
                 turn++) { // the driver may compile during the first
                double start = seconds(CLOCK_PROCESS_CPUTIME_ID);
                if (!offscreen_draw(&run->offscreen, reference_scene.mesh, run->places, pixels + at, error))
                    return false;
                taken = seconds(CLOCK_PROCESS_CPUTIME_ID) - start;
            }
            if (taken > limit) {
                run->drawn.state = DRAWN_SLOW;
                run->drawn.seconds = taken;
                snprintf(run->drawn.log, sizeof run->drawn.log, "%s", reference_scenes[i].name);
                return true;
            }
            at += each;
        }
    return true;
}

bool lam_check_draw(const void *request, size_t size, const char *gl_device, lam_bytes *out, lam_error *error)
{
    *out = (lam_bytes){0};
    struct shader_run *run = calloc(1, sizeof *run);
    if (!run)
        return fail_memory(error, sizeof *run);
    float *pixels = NULL;
    bool ok = draw_request_read(request, size, &run->request, error);
    const char *text = run->request.contract;
    lam_check_contract *contract = ok ? lam_check_contract_read(text, strlen(text), NULL, error) : NULL;
    struct complete_texts texts = {.vertex = run->request.vertex, .fragment = run->request.fragment};
    ok = contract && shader_interface_make(&run->interface, &texts, &contract->contract, error);
    bool open = false;
    if (ok) {
        enum gl_profile profile = shader_dialect_profile(&run->interface);
        ok = open = offscreen_open(&run->offscreen, profile, gl_device, run->request.size, error);
        size_t count = 0;
        if (ok) {
            snprintf(run->drawn.driver, sizeof run->drawn.driver, "%s", run->offscreen.context.renderer);
            run->drawn.scenes = run->request.scenes;
            for (int i = 0; i < reference_scene_count; i++)
                count += run->request.scenes >> i & 1;
            count *= 4 * (size_t)run->request.size * (size_t)run->request.size;
            pixels = malloc(count * sizeof *pixels + 1);
            ok = pixels || fail_memory(error, count * sizeof *pixels);
        }
        ok = ok && build(run, error) && (!run->program || draw_scenes(run, profile, pixels, error)) &&
             draw_result_write(&run->drawn, run->drawn.state == DRAWN_PICTURES ? pixels : NULL,
                               run->drawn.state == DRAWN_PICTURES ? count : 0, out, error);
    }
    if (open) {
        const struct gl *gl = &run->offscreen.context.gl;
        if (run->program)
            gl->DeleteProgram(run->program);
        gl->DeleteBuffers(MAX_BLOCKS, run->blocks);
        for (int i = 0; i < run->binding_count; i++)
            gl->DeleteTextures(1, &run->bindings[i].texture); // ignores 0
        offscreen_close(&run->offscreen);
    }
    shader_interface_free(&run->interface);
    lam_check_contract_free(contract);
    free(pixels);
    free(run->bindings);
    free(run);
    return ok;
}
