// gl_state.c: changes the context's state only if necessary, and allocates vertex buffers.
#include "fail.h"
#include "gl_device.h"

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

// Saves the state of the caller's context that a frame changes, and restores it.

static const GLenum switches[] = {
    GL_DEPTH_TEST, GL_BLEND, GL_CULL_FACE, GL_SCISSOR_TEST, GL_STENCIL_TEST, GL_RASTERIZER_DISCARD,
    GL_SAMPLE_ALPHA_TO_COVERAGE, GL_SAMPLE_COVERAGE, GL_POLYGON_OFFSET_FILL, GL_PRIMITIVE_RESTART_FIXED_INDEX,
    // The following exist only in desktop OpenGL.
    GL_FRAMEBUFFER_SRGB, GL_PRIMITIVE_RESTART, GL_COLOR_LOGIC_OP, GL_DEPTH_CLAMP, GL_MULTISAMPLE};
enum { SWITCHES = sizeof switches / sizeof *switches, SWITCHES_ES = 10 };

static const GLenum unpacking[] = {GL_UNPACK_ALIGNMENT,   GL_UNPACK_ROW_LENGTH,   GL_UNPACK_SKIP_ROWS,
                                   GL_UNPACK_SKIP_PIXELS, GL_UNPACK_IMAGE_HEIGHT, GL_UNPACK_SKIP_IMAGES};
static const GLenum packing[] = {GL_PACK_ALIGNMENT, GL_PACK_ROW_LENGTH, GL_PACK_SKIP_ROWS, GL_PACK_SKIP_PIXELS};
static const GLint default_storage[6] = {4, 0, 0, 0, 0, 0};

static bool is_supported(const struct gl_device *device, int i)
{
    if (switches[i] == GL_PRIMITIVE_RESTART_FIXED_INDEX) // part of desktop OpenGL since version 4.3
        return device->context.es || device->context.major * 10 + device->context.minor >= 43;
    return !device->context.es || i < SWITCHES_ES;
}

static void set_switch(const struct gl *gl, GLenum name, bool on)
{
    if (on)
        gl->Enable(name);
    else
        gl->Disable(name);
}

static void set_defaults(const struct gl_device *device)
{
    const struct gl *gl = &device->context.gl;
    for (int i = 0; i < SWITCHES; i++)
        if (is_supported(device, i))
            set_switch(gl, switches[i], switches[i] == GL_DEPTH_TEST);
    for (int i = 0; i < 6; i++)
        gl->PixelStorei(unpacking[i], default_storage[i]);
    for (int i = 0; i < 4; i++)
        gl->PixelStorei(packing[i], default_storage[i]);
    gl->BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    gl->BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    gl->ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl->DepthMask(GL_TRUE);
    gl->DepthFunc(GL_LESS);
    gl->BlendEquation(GL_FUNC_ADD);
}

void gl_state_save(const struct gl_device *device, struct gl_saved_state *s)
{
    const struct gl *gl = &device->context.gl;
    if (device->external_context) {
        gl->GetIntegerv(GL_CURRENT_PROGRAM, &s->program);
        gl->GetIntegerv(GL_VERTEX_ARRAY_BINDING, &s->array);
        gl->GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &s->draw_framebuffer);
        gl->GetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &s->read_framebuffer);
        gl->GetIntegerv(GL_ACTIVE_TEXTURE, &s->active_unit);
        gl->GetIntegerv(GL_ARRAY_BUFFER_BINDING, &s->array_buffer);
        gl->GetIntegerv(GL_UNIFORM_BUFFER_BINDING, &s->uniform_buffer);
        gl->GetIntegerv(GL_PIXEL_UNPACK_BUFFER_BINDING, &s->unpack_buffer);
        gl->GetIntegerv(GL_PIXEL_PACK_BUFFER_BINDING, &s->pack_buffer);
        for (GLuint i = 0; i < (GLuint)device->unit_count; i++) {
            gl->ActiveTexture(GL_TEXTURE0 + i);
            gl->GetIntegerv(GL_TEXTURE_BINDING_2D, &s->texture_2d[i]);
            gl->GetIntegerv(GL_TEXTURE_BINDING_2D_ARRAY, &s->texture_array[i]);
            gl->GetIntegerv(GL_SAMPLER_BINDING, &s->sampler[i]);
            gl->BindSampler(i, 0);
        }
        for (GLuint i = 0; i < POINT_COUNT; i++) {
            gl->GetIntegeri_v(GL_UNIFORM_BUFFER_BINDING, i, &s->block_buffer[i]);
            gl->GetIntegeri_v(GL_UNIFORM_BUFFER_START, i, &s->block_offset[i]);
            gl->GetIntegeri_v(GL_UNIFORM_BUFFER_SIZE, i, &s->block_size[i]);
        }
        gl->GetIntegerv(GL_VIEWPORT, s->viewport);
        gl->GetIntegerv(GL_DEPTH_FUNC, &s->depth_function);
        gl->GetIntegerv(GL_CULL_FACE_MODE, &s->cull_side);
        gl->GetIntegerv(GL_FRONT_FACE, &s->front_face);
        gl->GetIntegerv(GL_BLEND_SRC_RGB, &s->blend[0]);
        gl->GetIntegerv(GL_BLEND_DST_RGB, &s->blend[1]);
        gl->GetIntegerv(GL_BLEND_SRC_ALPHA, &s->blend[2]);
        gl->GetIntegerv(GL_BLEND_DST_ALPHA, &s->blend[3]);
        gl->GetIntegerv(GL_BLEND_EQUATION_RGB, &s->blend_equation[0]);
        gl->GetIntegerv(GL_BLEND_EQUATION_ALPHA, &s->blend_equation[1]);
        gl->GetBooleanv(GL_COLOR_WRITEMASK, s->color_mask);
        gl->GetBooleanv(GL_DEPTH_WRITEMASK, &s->depth_mask);
        for (int i = 0; i < 6; i++)
            gl->GetIntegerv(unpacking[i], &s->unpack[i]);
        for (int i = 0; i < 4; i++)
            gl->GetIntegerv(packing[i], &s->pack[i]);
        for (int i = 0; i < SWITCHES; i++)
            s->enabled[i] = is_supported(device, i) ? gl->IsEnabled(switches[i]) : GL_FALSE;
        if (!device->context.es) {
            gl->GetIntegerv(GL_POLYGON_MODE, s->polygon_mode);
            gl->PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
        }
    }
    if (device->external_context || !device->frame_number)
        set_defaults(device);
}

void gl_state_restore(const struct gl_device *device, const struct gl_saved_state *s)
{
    const struct gl *gl = &device->context.gl;
    if (!device->external_context)
        return;
    gl->UseProgram((GLuint)s->program);
    gl->BindVertexArray((GLuint)s->array);
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, (GLuint)s->draw_framebuffer);
    gl->BindFramebuffer(GL_READ_FRAMEBUFFER, (GLuint)s->read_framebuffer);
    gl->BindBuffer(GL_ARRAY_BUFFER, (GLuint)s->array_buffer);
    gl->BindBuffer(GL_PIXEL_UNPACK_BUFFER, (GLuint)s->unpack_buffer);
    gl->BindBuffer(GL_PIXEL_PACK_BUFFER, (GLuint)s->pack_buffer);
    for (GLuint i = 0; i < (GLuint)device->unit_count; i++) {
        gl->ActiveTexture(GL_TEXTURE0 + i);
        gl->BindTexture(GL_TEXTURE_2D, (GLuint)s->texture_2d[i]);
        gl->BindTexture(GL_TEXTURE_2D_ARRAY, (GLuint)s->texture_array[i]);
        gl->BindSampler(i, (GLuint)s->sampler[i]);
    }
    gl->ActiveTexture((GLenum)s->active_unit);
    for (GLuint i = 0; i < POINT_COUNT; i++)
        if (s->block_size[i])
            gl->BindBufferRange(GL_UNIFORM_BUFFER, i, (GLuint)s->block_buffer[i], s->block_offset[i], s->block_size[i]);
        else
            gl->BindBufferBase(GL_UNIFORM_BUFFER, i, (GLuint)s->block_buffer[i]);
    gl->BindBuffer(GL_UNIFORM_BUFFER, (GLuint)s->uniform_buffer);
    gl->Viewport(s->viewport[0], s->viewport[1], s->viewport[2], s->viewport[3]);
    gl->DepthFunc((GLenum)s->depth_function);
    gl->CullFace((GLenum)s->cull_side);
    gl->FrontFace((GLenum)s->front_face);
    gl->BlendFuncSeparate((GLenum)s->blend[0], (GLenum)s->blend[1], (GLenum)s->blend[2], (GLenum)s->blend[3]);
    gl->BlendEquationSeparate((GLenum)s->blend_equation[0], (GLenum)s->blend_equation[1]);
    gl->ColorMask(s->color_mask[0], s->color_mask[1], s->color_mask[2], s->color_mask[3]);
    gl->DepthMask(s->depth_mask);
    for (int i = 0; i < 6; i++)
        gl->PixelStorei(unpacking[i], s->unpack[i]);
    for (int i = 0; i < 4; i++)
        gl->PixelStorei(packing[i], s->pack[i]);
    for (int i = 0; i < SWITCHES; i++)
        if (is_supported(device, i))
            set_switch(gl, switches[i], s->enabled[i]);
    if (!device->context.es)
        gl->PolygonMode(GL_FRONT_AND_BACK, (GLenum)s->polygon_mode[0]);
}
