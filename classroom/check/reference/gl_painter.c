// gl_painter.c: draws with OpenGL: an offscreen framebuffer of floats, the meshes as buffers, programs and their
// uniforms.
#include "draw_request.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "context.h"
#include "fail.h"
#include "reference_scene.h"

enum { MAX_BLOCKS = 8, MAX_BLOCK_BYTES = 65536, MAX_TEXTURES = 16, MAX_STREAMS = 8 };

struct gl_mesh {
    GLuint positions, normals, tangents, indices; // buffers
    bool there;
};

struct gl_place {
    struct gl_context context; // the struct must not move while the context is current
    struct gl_previous_context previous;
    int size;
    bool rests;     // the context is not current
    bool built_ins; // a compatibility context, with gl_Vertex and gl_Normal
    GLuint framebuffer, color, depth, array;
    struct gl_mesh meshes[MESH_COUNT];
    GLuint streams[MAX_STREAMS]; // buffers of the current picture
};

// The destination of an input's values.
struct gl_input {
    GLint location;                             // the location of the first element, or −1 in a block
    GLint block, offset, stride, matrix_stride; // the position of the first element in the block, in bytes
    GLenum type;
};

struct gl_program {
    GLuint name;
    struct gl_input *inputs;
    GLuint blocks[MAX_BLOCKS];
    int block_bytes[MAX_BLOCKS];
    GLuint textures[MAX_TEXTURES]; // textures with one texel, indexed by unit
};

// --- the context

static void delete_objects(struct gl_place *t)
{
    const struct gl *gl = &t->context.gl;
    for (int i = 0; i < MESH_COUNT; i++) {
        gl->DeleteBuffers(1, &t->meshes[i].positions); // ignores 0
        gl->DeleteBuffers(1, &t->meshes[i].normals);
        gl->DeleteBuffers(1, &t->meshes[i].tangents);
        gl->DeleteBuffers(1, &t->meshes[i].indices);
    }
    gl->DeleteBuffers(MAX_STREAMS, t->streams);
    gl->DeleteVertexArrays(1, &t->array);
    gl->DeleteFramebuffers(1, &t->framebuffer);
    gl->DeleteRenderbuffers(1, &t->color);
    gl->DeleteRenderbuffers(1, &t->depth);
}

// Frees the context. If `rests` is set, another context may be current. The objects are then freed together with the
// context.
static void close(void *place)
{
    struct gl_place *t = place;
    if (!t->rests) {
        delete_objects(t);
        gl_context_leave(&t->context, &t->previous);
    }
    gl_context_free(&t->context);
    free(t);
}

static void *open(void *user, lam_check_language language, int size, char renderer[128], lam_error *error)
{
    static const enum gl_profile profiles[] = {[LAM_CHECK_LANGUAGE_CORE] = GL_PROFILE_CORE,
                                               [LAM_CHECK_LANGUAGE_ES] = GL_PROFILE_ES,
                                               [LAM_CHECK_LANGUAGE_COMPATIBILITY] = GL_PROFILE_COMPATIBILITY};
    struct gl_place *t = calloc(1, sizeof *t);
    if (!t)
        return fail_memory(error, sizeof *t), NULL;
    t->size = size;
    t->built_ins = language == LAM_CHECK_LANGUAGE_COMPATIBILITY;
    if (!gl_context_make(&t->context, NULL, user, profiles[language], false, error)) {
        free(t);
        return NULL;
    }
    if (!gl_context_enter(&t->context, &t->previous, error)) {
        gl_context_free(&t->context);
        free(t);
        return NULL;
    }
    snprintf(renderer, 128, "%s", t->context.renderer);
    const struct gl *gl = &t->context.gl;
    gl->GenFramebuffers(1, &t->framebuffer);
    gl->BindFramebuffer(GL_FRAMEBUFFER, t->framebuffer);
    gl->GenRenderbuffers(1, &t->color);
    gl->BindRenderbuffer(GL_RENDERBUFFER, t->color);
    gl->RenderbufferStorage(GL_RENDERBUFFER, GL_RGBA32F, size, size);
    gl->FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, t->color);
    gl->GenRenderbuffers(1, &t->depth);
    gl->BindRenderbuffer(GL_RENDERBUFFER, t->depth);
    gl->RenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, size, size);
    gl->FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, t->depth);
    if (gl->CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        fail(error, LAM_UNSUPPORTED, "%s cannot render to float textures (RGBA32F)", renderer);
        close(t);
        return NULL;
    }
    gl->GenVertexArrays(1, &t->array);
    gl->BindVertexArray(t->array);
    gl->Viewport(0, 0, size, size);
    gl->Enable(GL_DEPTH_TEST);
    gl->DepthFunc(GL_LESS);
    gl->Disable(GL_BLEND);
    gl->Disable(GL_DITHER);
    gl->ClearColor(0, 0, 0, 0);
    gl->PixelStorei(GL_PACK_ALIGNMENT, 4);
    return t;
}

static void rest(void *place)
{
    struct gl_place *t = place;
    gl_context_leave(&t->context, &t->previous);
    t->rests = true;
}

static bool wake(void *place, lam_error *error)
{
    struct gl_place *t = place;
    t->rests = !gl_context_enter(&t->context, &t->previous, error);
    return !t->rests;
}

// --- programs

// Compiles a shader. Returns 0 if the source does not compile; `log` then contains the driver's messages.
static GLuint compile_text(const struct gl *gl, GLenum kind, const char *text, char log[4096])
{
    GLuint shader = gl->CreateShader(kind);
    GLint good = 0;
    gl->ShaderSource(shader, 1, &text, NULL);
    gl->CompileShader(shader);
    gl->GetShaderiv(shader, GL_COMPILE_STATUS, &good);
    gl->GetShaderInfoLog(shader, 4096, NULL, log);
    if (good)
        return shader;
    gl->DeleteShader(shader);
    return 0;
}

static GLuint link(const struct gl *gl, GLuint vertex, GLuint fragment, char log[4096])
{
    GLuint program = gl->CreateProgram();
    GLint good = 0;
    gl->AttachShader(program, vertex);
    gl->AttachShader(program, fragment);
    gl->LinkProgram(program);
    gl->GetProgramiv(program, GL_LINK_STATUS, &good);
    gl->GetProgramInfoLog(program, 4096, NULL, log);
    if (good)
        return program;
    gl->DeleteProgram(program);
    return 0;
}

static lam_check_type type_of(GLenum type)
{
    switch (type) {
    case GL_FLOAT:
        return LAM_CHECK_TYPE_FLOAT;
    case GL_INT:
        return LAM_CHECK_TYPE_INT;
    case GL_BOOL:
        return LAM_CHECK_TYPE_BOOL;
    case GL_FLOAT_VEC2:
        return LAM_CHECK_TYPE_VEC2;
    case GL_FLOAT_VEC3:
        return LAM_CHECK_TYPE_VEC3;
    case GL_FLOAT_VEC4:
        return LAM_CHECK_TYPE_VEC4;
    case GL_FLOAT_MAT3:
        return LAM_CHECK_TYPE_MAT3;
    case GL_FLOAT_MAT4:
        return LAM_CHECK_TYPE_MAT4;
    case GL_SAMPLER_2D:
        return LAM_CHECK_TYPE_SAMPLER2D;
    default:
        return LAM_CHECK_TYPE_OTHER;
    }
}

static void find_uniform(const struct gl *gl, const struct gl_program *p, GLuint number, lam_check_input *input,
                         struct gl_input *own)
{
    GLenum type = 0;
    GLint elements = 0;
    gl->GetActiveUniform(p->name, number, sizeof input->name, NULL, &elements, &type, input->name);
    input->type = type_of(type);
    input->elements = elements;
    *own = (struct gl_input){.location = -1, .block = -1, .type = type};
    gl->GetActiveUniformsiv(p->name, 1, &number, GL_UNIFORM_BLOCK_INDEX, &own->block);
    if (own->block < 0) {
        own->location = gl->GetUniformLocation(p->name, input->name);
        return;
    }
    gl->GetActiveUniformsiv(p->name, 1, &number, GL_UNIFORM_OFFSET, &own->offset);
    gl->GetActiveUniformsiv(p->name, 1, &number, GL_UNIFORM_MATRIX_STRIDE, &own->matrix_stride);
    gl->GetActiveUniformsiv(p->name, 1, &number, GL_UNIFORM_ARRAY_STRIDE, &own->stride);
}

static void find_blocks(const struct gl *gl, struct gl_program *p)
{
    GLint blocks = 0;
    gl->GetProgramiv(p->name, GL_ACTIVE_UNIFORM_BLOCKS, &blocks);
    for (GLuint i = 0; i < (GLuint)blocks && i < MAX_BLOCKS; i++) {
        GLint bytes = 0;
        gl->GetActiveUniformBlockiv(p->name, i, GL_UNIFORM_BLOCK_DATA_SIZE, &bytes);
        p->block_bytes[i] = bytes < MAX_BLOCK_BYTES ? bytes : MAX_BLOCK_BYTES;
        gl->GenBuffers(1, &p->blocks[i]);
        gl->UniformBlockBinding(p->name, i, i);
    }
}

static bool find_inputs(const struct gl *gl, struct gl_program *p, lam_check_program *out)
{
    GLint uniforms = 0, attributes = 0;
    gl->GetProgramiv(p->name, GL_ACTIVE_UNIFORMS, &uniforms);
    gl->GetProgramiv(p->name, GL_ACTIVE_ATTRIBUTES, &attributes);
    size_t count = (size_t)uniforms + (size_t)attributes;
    out->inputs = calloc(count + 1, sizeof *out->inputs);
    p->inputs = calloc(count + 1, sizeof *p->inputs);
    if (!out->inputs || !p->inputs)
        return false;
    out->input_count = (int)count;
    for (GLuint i = 0; i < (GLuint)uniforms; i++)
        find_uniform(gl, p, i, &out->inputs[i], &p->inputs[i]);
    for (GLuint i = 0; i < (GLuint)attributes; i++) {
        lam_check_input *input = &out->inputs[(GLuint)uniforms + i];
        GLenum type = 0;
        gl->GetActiveAttrib(p->name, i, sizeof input->name, NULL, &input->elements, &type, input->name);
        input->type = type_of(type);
        input->attribute = true;
        p->inputs[(GLuint)uniforms + i].location = gl->GetAttribLocation(p->name, input->name);
    }
    find_blocks(gl, p);
    return true;
}

static void forget(void *place, lam_check_program *program)
{
    struct gl_place *t = place;
    struct gl_program *p = program->program;
    if (p && !t->rests) { // otherwise the objects are freed with the context
        t->context.gl.DeleteProgram(p->name);
        t->context.gl.DeleteBuffers(MAX_BLOCKS, p->blocks); // this call and the next ignore the name 0
        t->context.gl.DeleteTextures(MAX_TEXTURES, p->textures);
    }
    if (p) {
        free(p->inputs);
        free(p);
    }
    free(program->inputs);
    program->program = NULL;
    program->inputs = NULL;
    program->input_count = 0;
}

static bool compile(void *place, const char *vertex_text, const char *fragment_text, lam_check_program *out,
                    lam_error *error)
{
    const struct gl *gl = &((struct gl_place *)place)->context.gl;
    memset(out, 0, sizeof *out);
    GLuint vertex = compile_text(gl, GL_VERTEX_SHADER, vertex_text, out->vertex_log);
    GLuint fragment = compile_text(gl, GL_FRAGMENT_SHADER, fragment_text, out->fragment_log);
    out->refused_vertex = !vertex;
    out->refused_fragment = !fragment;
    GLuint name = vertex && fragment ? link(gl, vertex, fragment, out->link_log) : 0;
    gl->DeleteShader(vertex); // ignores 0
    gl->DeleteShader(fragment);
    if (!name)
        return true;
    struct gl_program *p = out->program = calloc(1, sizeof *p);
    if (!p) {
        gl->DeleteProgram(name);
        return fail_memory(error, sizeof *p);
    }
    p->name = name;
    if (find_inputs(gl, p, out))
        return true;
    forget(place, out);
    return fail_memory(error, sizeof *p->inputs);
}

// --- values

static void set_sampler(const struct gl *gl, struct gl_program *p, GLint location, int unit, const float *v)
{
    if (!p->textures[unit])
        gl->GenTextures(1, &p->textures[unit]);
    gl->ActiveTexture(GL_TEXTURE0 + (GLenum)unit);
    gl->BindTexture(GL_TEXTURE_2D, p->textures[unit]);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl->TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, 1, 1, 0, GL_RGBA, GL_FLOAT, v);
    gl->Uniform1i(location, unit);
}

static void set_integers(const struct gl *gl, GLint location, int count, const float *v)
{
    enum { AT_ONCE = 256 };
    GLint whole[AT_ONCE];
    for (int from = 0; from < count; from += AT_ONCE) {
        int some = count - from < AT_ONCE ? count - from : AT_ONCE;
        for (int i = 0; i < some; i++)
            whole[i] = (GLint)v[from + i];
        gl->Uniform1iv(location + from, some, whole); // elements of an array have consecutive locations
    }
}

static void set_uniform(const struct gl *gl, GLenum type, GLint location, int count, const float *v)
{
    switch (type) {
    case GL_FLOAT:
        gl->Uniform1fv(location, count, v);
        break;
    case GL_FLOAT_VEC2:
        gl->Uniform2fv(location, count, v);
        break;
    case GL_FLOAT_VEC3:
        gl->Uniform3fv(location, count, v);
        break;
    case GL_FLOAT_VEC4:
        gl->Uniform4fv(location, count, v);
        break;
    case GL_FLOAT_MAT3:
        gl->UniformMatrix3fv(location, count, GL_FALSE, v);
        break;
    case GL_FLOAT_MAT4:
        gl->UniformMatrix4fv(location, count, GL_FALSE, v);
        break;
    default:
        set_integers(gl, location, count, v);
        break;
    }
}

static void store_in_block(const struct gl_input *input, struct type_shape shape, int element, const float *v,
                           unsigned char *bytes, int capacity)
{
    size_t size = (size_t)shape.rows * sizeof *v;
    int32_t whole = (int32_t)v[0];
    bool is_whole = input->type == GL_INT || input->type == GL_BOOL;
    for (int c = 0; c < shape.columns; c++) {
        int at = input->offset + element * input->stride + c * input->matrix_stride;
        if (at < 0 || at + (int)size > capacity)
            return;
        memcpy(bytes + at, is_whole ? (const void *)&whole : v + c * shape.rows, size);
    }
}

static bool set_values(const struct gl *gl, const lam_check_drawing *d, lam_error *error)
{
    struct gl_program *p = d->program->program;
    unsigned char *bytes = p->blocks[0] ? calloc(MAX_BLOCKS, MAX_BLOCK_BYTES) : NULL;
    if (p->blocks[0] && !bytes)
        return fail_memory(error, MAX_BLOCKS * MAX_BLOCK_BYTES);
    int unit = 0;
    for (int i = 0; i < d->value_count; i++) {
        const lam_check_value *value = &d->values[i];
        const struct gl_input *input = &p->inputs[value->input];
        struct type_shape shape = type_shape(d->program->inputs[value->input].type);
        int each = shape.columns * shape.rows;
        if (input->type == GL_SAMPLER_2D)
            for (int k = 0; k < value->count && unit < MAX_TEXTURES; k++)
                set_sampler(gl, p, input->location + value->first + k, unit++, value->numbers + (ptrdiff_t)k * each);
        else if (input->block < 0)
            set_uniform(gl, input->type, input->location + value->first, value->count, value->numbers);
        else if (input->block < MAX_BLOCKS && bytes)
            for (int k = 0; k < value->count; k++)
                store_in_block(input, shape, value->first + k, value->numbers + (ptrdiff_t)k * each,
                               bytes + (size_t)input->block * MAX_BLOCK_BYTES, p->block_bytes[input->block]);
    }
    for (GLuint i = 0; i < MAX_BLOCKS && bytes; i++)
        if (p->blocks[i]) {
            gl->BindBufferBase(GL_UNIFORM_BUFFER, i, p->blocks[i]);
            gl->BufferData(GL_UNIFORM_BUFFER, p->block_bytes[i], bytes + (size_t)i * MAX_BLOCK_BYTES, GL_STATIC_DRAW);
        }
    free(bytes);
    return true;
}

// --- drawing

static GLuint buffer_of(const struct gl *gl, GLenum target, const void *data, size_t size)
{
    GLuint name = 0;
    gl->GenBuffers(1, &name);
    gl->BindBuffer(target, name);
    gl->BufferData(target, (GLsizeiptr)size, data, GL_STATIC_DRAW);
    return name;
}

static void upload_mesh(struct gl_place *t, const lam_check_mesh *mesh)
{
    const struct gl *gl = &t->context.gl;
    struct gl_mesh *own = &t->meshes[mesh->number];
    if (own->there)
        return;
    size_t count = (size_t)mesh->vertex_count;
    own->positions = buffer_of(gl, GL_ARRAY_BUFFER, mesh->positions, count * 3 * sizeof(float));
    own->normals = buffer_of(gl, GL_ARRAY_BUFFER, mesh->normals, count * 4 * sizeof(float));
    own->tangents = buffer_of(gl, GL_ARRAY_BUFFER, mesh->tangents, count * 3 * sizeof(float));
    own->indices =
        buffer_of(gl, GL_ELEMENT_ARRAY_BUFFER, mesh->indices, (size_t)mesh->index_count * sizeof *mesh->indices);
    own->there = true;
}

// Binds a buffer to the attribute `place`, or to the built-in attribute if `place` is negative.
static void point_at(const struct gl *gl, GLuint buffer, int place, int width, bool is_normal)
{
    gl->BindBuffer(GL_ARRAY_BUFFER, buffer);
    if (place >= 0) {
        gl->EnableVertexAttribArray((GLuint)place);
        gl->VertexAttribPointer((GLuint)place, width, GL_FLOAT, GL_FALSE, 0, NULL);
    } else if (is_normal) {
        gl->EnableClientState(GL_NORMAL_ARRAY);
        gl->NormalPointer(GL_FLOAT, width * (int)sizeof(float), NULL);
    } else {
        gl->EnableClientState(GL_VERTEX_ARRAY);
        gl->VertexPointer(width, GL_FLOAT, 0, NULL);
    }
}

static void set_attributes(struct gl_place *t, const lam_check_drawing *d)
{
    const struct gl *gl = &t->context.gl;
    const struct gl_program *p = d->program->program;
    const struct gl_mesh *mesh = &t->meshes[d->mesh->number];
    bool built_in = t->built_ins && gl->VertexPointer && gl->NormalPointer && gl->EnableClientState;
    if (d->position >= 0 || built_in)
        point_at(gl, mesh->positions, d->position < 0 ? -1 : p->inputs[d->position].location, 3, false);
    if (d->normal >= 0 || built_in)
        point_at(gl, mesh->normals, d->normal < 0 ? -1 : p->inputs[d->normal].location, 4, true);
    if (d->tangent >= 0)
        point_at(gl, mesh->tangents, p->inputs[d->tangent].location, 3, false);
    for (uint64_t i = 0; i < d->stream_count && i < MAX_STREAMS; i++) {
        const lam_check_stream *stream = &d->streams[i];
        size_t size = (size_t)d->mesh->vertex_count * (size_t)stream->components * sizeof(float);
        if (!t->streams[i])
            gl->GenBuffers(1, &t->streams[i]);
        gl->BindBuffer(GL_ARRAY_BUFFER, t->streams[i]);
        gl->BufferData(GL_ARRAY_BUFFER, (GLsizeiptr)size, stream->numbers, GL_STATIC_DRAW);
        point_at(gl, t->streams[i], p->inputs[stream->input].location, stream->components, false);
    }
    if (t->built_ins && gl->MatrixMode && gl->LoadMatrixf) {
        gl->MatrixMode(GL_MODELVIEW);
        gl->LoadMatrixf(d->model_view);
        gl->MatrixMode(GL_PROJECTION);
        gl->LoadMatrixf(d->projection);
    }
}

static bool draw(void *place, const lam_check_drawing *d, float *pixels, lam_error *error)
{
    struct gl_place *t = place;
    const struct gl *gl = &t->context.gl;
    upload_mesh(t, d->mesh);
    gl->UseProgram(((struct gl_program *)d->program->program)->name);
    if (!set_values(gl, d, error))
        return false;
    set_attributes(t, d);
    (d->cull ? gl->Enable : gl->Disable)(GL_CULL_FACE);
    gl->CullFace(d->cull == LAM_CHECK_CULL_FRONT ? GL_FRONT : GL_BACK);
    gl->Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    gl->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, t->meshes[d->mesh->number].indices);
    gl->DrawElements(GL_TRIANGLES, d->mesh->index_count, GL_UNSIGNED_SHORT, NULL);
    gl->ReadPixels(0, 0, t->size, t->size, GL_RGBA, GL_FLOAT, pixels);
    GLenum wrong = gl->GetError();
    for (int i = 0; wrong && i < d->program->input_count; i++)
        if (d->program->inputs[i].type == LAM_CHECK_TYPE_OTHER)
            return fail(
                error, LAM_BAD_ARGUMENT,
                "no verdict: the shader reads '%.60s', whose type the check cannot draw, such as the cube map of a "
                "shadow or of an environment",
                d->program->inputs[i].name);
    if (wrong)
        return fail(error, LAM_UNSUPPORTED, "%s reports error 0x%04x while drawing", t->context.renderer, wrong);
    size_t row = 4 * (size_t)t->size; // in OpenGL, the first row is at the bottom
    for (int y = 0; y < t->size / 2; y++) {
        float *a = pixels + (size_t)y * row, *b = pixels + (size_t)(t->size - 1 - y) * row;
        for (size_t i = 0; i < row; i++) {
            float kept = a[i];
            a[i] = b[i];
            b[i] = kept;
        }
    }
    return true;
}

lam_check_painter gl_painter(const char *device)
{
    return (lam_check_painter){.user = (void *)(uintptr_t)device,
                               .open = open,
                               .close = close,
                               .rest = rest,
                               .wake = wake,
                               .compile = compile,
                               .forget = forget,
                               .draw = draw};
}
