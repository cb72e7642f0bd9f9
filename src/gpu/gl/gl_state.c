// gl_state.c: changes the context's state only if necessary, and allocates vertex buffers.
#include "gl_device.h"

#include "fail.h"

#include <stdlib.h>
#include <string.h>

void gl_use_program(struct gl_device *device, GLuint program)
{
    if (device->current.program != program)
        device->context.gl.UseProgram(device->current.program = program);
}

void gl_use_array(struct gl_device *device, GLuint array)
{
    if (device->current.array != array)
        device->context.gl.BindVertexArray(device->current.array = array);
}

void gl_use_framebuffer(struct gl_device *device, GLuint framebuffer)
{
    if (device->current.framebuffer != framebuffer)
        device->context.gl.BindFramebuffer(GL_FRAMEBUFFER, device->current.framebuffer = framebuffer);
}

void gl_use_texture(struct gl_device *device, enum texture_unit unit, GLenum target, GLuint texture)
{
    if (device->current.textures[unit] == texture)
        return;
    if (device->current.unit != (int)unit)
        device->context.gl.ActiveTexture(GL_TEXTURE0 + (GLenum)(device->current.unit = (int)unit));
    device->context.gl.BindTexture(target, device->current.textures[unit] = texture);
}

void gl_use_sampler(struct gl_device *device, enum texture_unit unit, GLuint sampler)
{
    if (device->current.samplers[unit] != sampler)
        device->context.gl.BindSampler((GLuint)unit, device->current.samplers[unit] = sampler);
}

void gl_edit_texture(struct gl_device *device, enum texture_unit unit, GLenum target, GLuint texture)
{
    gl_use_texture(device, unit, target, texture);
    if (device->current.unit != (int)unit)
        device->context.gl.ActiveTexture(GL_TEXTURE0 + (GLenum)(device->current.unit = (int)unit));
}

void gl_edit_plain_texture(struct gl_device *device, enum texture_unit unit, GLenum target, GLuint *name)
{
    const struct gl *gl = &device->context.gl;
    bool fresh = !*name;
    if (fresh)
        gl->GenTextures(1, name);
    gl_edit_texture(device, unit, target, *name);
    if (!fresh)
        return;
    gl->TexParameteri(target, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl->TexParameteri(target, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl->TexParameteri(target, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl->TexParameteri(target, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    gl->TexParameteri(target, GL_TEXTURE_MAX_LEVEL, 0);
}

void gl_point_to(struct gl_frame *f, GLuint location, GLint size, size_t stride, size_t at)
{
    f->gl->EnableVertexAttribArray(location);
    f->gl->VertexAttribPointer(location, size, GL_FLOAT, GL_FALSE, (GLsizei)(stride * sizeof(float)),
                               (const void *)(at * sizeof(float)));
}

void gl_key_add(uint64_t *key, const void *bytes, size_t count)
{
    for (size_t at = 0; at < count; at += sizeof(uint64_t)) {
        uint64_t word = 0;
        memcpy(&word, (const char *)bytes + at, count - at < sizeof word ? count - at : sizeof word);
        *key = (*key ^ word) * UINT64_C(0x9e3779b97f4a7c15);
        *key ^= *key >> 32;
    }
}

void *gl_grown(void *list, int count, int *capacity, size_t size, lam_error *error)
{
    if (count < *capacity)
        return list;
    int more = *capacity ? 2 * *capacity : 8;
    void *grown = realloc(list, (size_t)more * size);
    if (grown)
        *capacity = more;
    else
        fail_memory(error, (size_t)more * size);
    return grown;
}

void gl_use_blending(struct gl_device *device, enum gl_blending blending)
{
    const struct gl *gl = &device->context.gl;
    enum gl_blending before = device->current.blending;
    bool nearest = blending == BLENDING_NEAREST;
    if (before == blending)
        return;
    if (before == BLENDING_UNKNOWN || nearest != (before == BLENDING_NEAREST)) {
        (nearest ? gl->Enable : gl->Disable)(GL_DEPTH_TEST);
        (nearest ? gl->Disable : gl->Enable)(GL_BLEND);
    }
    if (!nearest && device->current.factors != blending) {
        gl->BlendFunc(blending == BLENDING_UNDER      ? GL_ONE_MINUS_DST_ALPHA
                      : blending == BLENDING_MULTIPLY ? GL_ZERO
                                                      : GL_ONE,
                      blending == BLENDING_MULTIPLY ? GL_SRC_COLOR : GL_ONE);
        device->current.factors = blending;
    }
    device->current.blending = blending;
}

void gl_use_viewport(struct gl_device *device, int width, int height)
{
    if (device->current.width != width || device->current.height != height)
        device->context.gl.Viewport(0, 0, device->current.width = width, device->current.height = height);
}

void gl_use_cull(struct gl_device *device, lam_cull cull)
{
    const struct gl *gl = &device->context.gl;
    int before = device->current.cull;
    if (before == (int)cull)
        return;
    if (cull == LAM_CULL_NONE)
        gl->Disable(GL_CULL_FACE);
    else if (before <= LAM_CULL_NONE)
        gl->Enable(GL_CULL_FACE);
    if (cull != LAM_CULL_NONE && device->current.culled != cull)
        gl->CullFace((device->current.culled = cull) == LAM_CULL_BACK ? GL_BACK : GL_FRONT);
    device->current.cull = (int)cull;
}

void gl_state_invalidate(struct gl_device *device)
{
    memset(&device->current, 0, sizeof device->current);
    device->current.program = device->current.array = device->current.framebuffer = UINT32_MAX;
    for (int i = 0; i < UNIT_COUNT; i++)
        device->current.textures[i] = device->current.samplers[i] = UINT32_MAX;
    for (int i = 0; i < POINT_COUNT; i++)
        device->current.blocks[i].buffer = UINT32_MAX;
    device->current.cull = device->current.front = device->current.unit = -1;
}

bool gl_charge(struct gl_frame *f, uint64_t *held, uint64_t bytes, lam_error *error)
{
    uint64_t more = bytes > *held ? bytes - *held : 0;
    if (more && !call_charge(f->call, more))
        return call_memory_error(f->call, more, error);
    *held = bytes > *held ? bytes : *held;
    return true;
}

void *gl_buffer_map_new(struct gl_frame *f, GLuint buffer, size_t bytes, GLenum usage, lam_error *error)
{
    f->gl->BindBuffer(GL_ARRAY_BUFFER, buffer);
    f->gl->BufferData(GL_ARRAY_BUFFER, (GLsizeiptr)bytes, NULL, usage);
    void *mapped =
        f->gl->MapBufferRange(GL_ARRAY_BUFFER, 0, (GLsizeiptr)bytes, GL_MAP_WRITE_BIT | GL_MAP_INVALIDATE_BUFFER_BIT);
    if (!mapped) {
        fail(error, LAM_MACHINE, "OpenGL: '%s' is out of memory: %zu bytes of vertices", f->device->context.renderer,
             bytes);
        return NULL;
    }
    f->device->base.report.bytes_uploaded += bytes;
    return mapped;
}
