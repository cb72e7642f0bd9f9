// offscreen.c: a framebuffer of floats, the reference meshes as buffers, and drawing.
#include "offscreen.h"

#include <stdlib.h>
#include <string.h>

#include "fail.h"

bool offscreen_open(struct offscreen *t, enum gl_profile profile, const char *gl_device, int size, lam_error *error)
{
    memset(t, 0, sizeof *t);
    t->size = size;
    t->built_ins = profile == GL_PROFILE_COMPATIBILITY;
    if (!gl_context_make(&t->context, NULL, gl_device, profile, false, error))
        return false;
    if (!gl_context_enter(&t->context, &t->previous, error)) {
        gl_context_free(&t->context);
        return false;
    }
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
        fail(error, LAM_UNSUPPORTED, "%s cannot render to float textures (RGBA32F)", t->context.renderer);
        offscreen_close(t);
        return false;
    }
    gl->GenVertexArrays(1, &t->array);
    gl->BindVertexArray(t->array);
    gl->Viewport(0, 0, size, size);
    gl->Enable(GL_DEPTH_TEST);
    gl->DepthFunc(GL_LESS);
    gl->Disable(GL_CULL_FACE);
    gl->Disable(GL_BLEND);
    gl->Disable(GL_DITHER);
    gl->ClearColor(0, 0, 0, 0);
    gl->PixelStorei(GL_PACK_ALIGNMENT, 4);
    return true;
}

void offscreen_close(struct offscreen *t)
{
    if (t->context.context == EGL_NO_CONTEXT)
        return;
    const struct gl *gl = &t->context.gl;
    gl->DeleteBuffers(MESH_COUNT, t->positions);
    gl->DeleteBuffers(MESH_COUNT, t->normals);
    gl->DeleteBuffers(MESH_COUNT, t->tangents);
    gl->DeleteBuffers(MESH_COUNT, t->indices);
    gl->DeleteVertexArrays(1, &t->array);
    gl->DeleteFramebuffers(1, &t->framebuffer);
    gl->DeleteRenderbuffers(1, &t->color);
    gl->DeleteRenderbuffers(1, &t->depth);
    gl_context_leave(&t->context, &t->previous);
    gl_context_free(&t->context);
    memset(t, 0, sizeof *t);
}

void offscreen_rest(struct offscreen *t) { gl_context_leave(&t->context, &t->previous); }

bool offscreen_wake(struct offscreen *t, lam_error *error)
{
    return gl_context_enter(&t->context, &t->previous, error);
}

static bool upload_mesh(struct offscreen *t, enum reference_mesh mesh, lam_error *error)
{
    if (t->counts[mesh])
        return true;
    struct reference_points points;
    if (!reference_points(mesh, &points, error))
        return false;
    size_t count = (size_t)points.vertex_count;
    float *four = malloc(count * 4 * sizeof *four);
    if (!four) {
        reference_points_free(&points);
        return fail_memory(error, count * 4 * sizeof *four);
    }
    for (size_t i = 0; i < count; i++) {
        memcpy(four + 4 * i, points.normals + 3 * i, 3 * sizeof *four);
        four[4 * i + 3] = 0;
    }
    const struct gl *gl = &t->context.gl;
    gl->GenBuffers(1, &t->positions[mesh]);
    gl->BindBuffer(GL_ARRAY_BUFFER, t->positions[mesh]);
    gl->BufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(count * 3 * sizeof(float)), points.positions, GL_STATIC_DRAW);
    gl->GenBuffers(1, &t->normals[mesh]);
    gl->BindBuffer(GL_ARRAY_BUFFER, t->normals[mesh]);
    gl->BufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(count * 4 * sizeof(float)), four, GL_STATIC_DRAW);
    gl->GenBuffers(1, &t->tangents[mesh]);
    gl->BindBuffer(GL_ARRAY_BUFFER, t->tangents[mesh]);
    gl->BufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(count * 3 * sizeof(float)), points.tangents, GL_STATIC_DRAW);
    gl->GenBuffers(1, &t->indices[mesh]);
    gl->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, t->indices[mesh]);
    gl->BufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)((size_t)points.count * sizeof *points.indices), points.indices,
                   GL_STATIC_DRAW);
    t->counts[mesh] = points.count;
    free(four);
    reference_points_free(&points);
    return true;
}

// Binds a buffer to generic attribute `place`, or to the built-in one where it is negative.
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

bool offscreen_draw(struct offscreen *t, enum reference_mesh mesh, struct offscreen_places places, float *pixels,
                    lam_error *error)
{
    const struct gl *gl = &t->context.gl;
    if (!upload_mesh(t, mesh, error))
        return false;
    bool built_in = t->built_ins && gl->VertexPointer && gl->NormalPointer && gl->EnableClientState;
    if (places.position >= 0 || built_in)
        point_at(gl, t->positions[mesh], places.position, 3, false);
    if (places.normal >= 0 || built_in)
        point_at(gl, t->normals[mesh], places.normal, 4, true);
    if (places.tangent >= 0)
        point_at(gl, t->tangents[mesh], places.tangent, 3, false);
    gl->Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    gl->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, t->indices[mesh]);
    gl->DrawElements(GL_TRIANGLES, t->counts[mesh], GL_UNSIGNED_SHORT, NULL);
    gl->ReadPixels(0, 0, t->size, t->size, GL_RGBA, GL_FLOAT, pixels);
    GLenum wrong = gl->GetError();
    if (wrong)
        return fail(error, LAM_UNSUPPORTED, "%s reports error 0x%04x while drawing", t->context.renderer, wrong);
    size_t row = 4 * (size_t)t->size; // OpenGL's first row is the bottom one
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

GLuint offscreen_compile(struct offscreen *t, GLenum kind, const char *text, char *log, size_t capacity)
{
    const struct gl *gl = &t->context.gl;
    GLuint shader = gl->CreateShader(kind);
    GLint good = 0;
    gl->ShaderSource(shader, 1, &text, NULL);
    gl->CompileShader(shader);
    gl->GetShaderiv(shader, GL_COMPILE_STATUS, &good);
    gl->GetShaderInfoLog(shader, (GLsizei)capacity, NULL, log);
    if (good)
        return shader;
    gl->DeleteShader(shader);
    return 0;
}

GLuint offscreen_link(struct offscreen *t, GLuint vertex, GLuint fragment, char *log, size_t capacity)
{
    const struct gl *gl = &t->context.gl;
    GLuint program = gl->CreateProgram();
    GLint good = 0;
    gl->AttachShader(program, vertex);
    gl->AttachShader(program, fragment);
    gl->LinkProgram(program);
    gl->GetProgramiv(program, GL_LINK_STATUS, &good);
    gl->GetProgramInfoLog(program, (GLsizei)capacity, NULL, log);
    if (good)
        return program;
    gl->DeleteProgram(program);
    return 0;
}
