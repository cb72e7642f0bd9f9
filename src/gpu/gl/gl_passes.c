// gl_passes.c: draws one part of the picture. Each sample is a separate pass, with the projection shifted by the
// sample's offset. A pass draws the opaque surfaces, then peels the translucent surfaces layer by layer, nearest first.
//
// A depth id is the depth and the triangle number of a fragment. Layers are ordered by depth id. If surfaces have the
// same depth, the lower triangle number is in front, as on the CPU device, and no surface is lost.
//
// The target's rows are top-down, like the picture: the projection flips y, which reverses the winding.
#include "gl_device.h"

#include "fail.h"
#include "samples.h"

#include <string.h>

// --- one draw call

// Computes the matrix from object space to the clip space of the part. The draw's matrix produces pixels. The current
// sample must be at the centre of a pixel, so x = 2 (X − left − sample) / width − 1.
static void to_clip(const struct gl_frame *f, const struct frame_draw *draw, float out[16])
{
    const float(*m)[4] = draw->pixel;
    double left = f->left + (double)f->sample_x, top = f->top + (double)f->sample_y;
    for (int j = 0; j < 4; j++) { // OpenGL matrices are stored in column-major order
        double w = (double)m[3][j];
        out[4 * j] = (float)(((double)m[0][j] - left * w) * (2.0 / f->width) - w);
        out[4 * j + 1] = (float)(((double)m[1][j] - top * w) * (2.0 / f->height) - w);
        out[4 * j + 2] = m[2][j];
        out[4 * j + 3] = m[3][j];
    }
}

static void set_uniforms(struct gl_frame *f, struct gl_program *program, const struct frame_draw_range *range)
{
    const struct glsl_uniform_source from = {.frame = f->frame, .range = range};
    for (int i = UNIFORM_ROWS; i < program->uniform_count; i++) {
        const struct glsl_row *row = &program->uniforms[i].row;
        float values[16];
        int count = 16;
        if (row->semantic == GLSL_MODEL_VIEW_PROJECTION)
            to_clip(f, &f->frame->draws[range->draw], values);
        else
            count = glsl_uniform_value(&program->choices, &from, row, NULL, 0, values);
        if (strcmp(row->type, "int") == 0)
            program_set_int(f, program, i, (GLint)values[0]);
        else
            program_set(f, program, i, values, count);
    }
}

static void use_block(struct gl_frame *f, enum block_point point, GLuint buffer, size_t offset, size_t size)
{
    struct gl_current_state *current = &f->device->current;
    if (current->blocks[point].buffer == buffer && current->blocks[point].offset == offset &&
        current->blocks[point].size == size)
        return;
    f->gl->BindBufferRange(GL_UNIFORM_BUFFER, point, buffer, (GLintptr)offset, (GLsizeiptr)size);
    current->blocks[point].buffer = buffer;
    current->blocks[point].offset = offset;
    current->blocks[point].size = size;
}

static void set_light_buffers(struct gl_frame *f, const struct gl_draw_call *call)
{
    struct gl_device *device = f->device;
    const struct glsl_choices *c = &call->program->choices;
    if (f->storage == GLSL_BLOCK) {
        size_t front = (size_t)call->range->front * f->material_stride;
        size_t back = (size_t)call->range->back * f->material_stride;
        use_block(f, POINT_LIGHTS, device->lights.name, 0, device->lights.size);
        use_block(f, POINT_PRODUCTS, device->products.name, front, glsl_products_bytes(c));
        use_block(f, POINT_BACK_PRODUCTS, device->products.name, back, glsl_products_bytes(c));
        return;
    }
    gl_use_texture(device, UNIT_LIGHTS, GL_TEXTURE_2D, device->lights.name);
    gl_use_texture(device, UNIT_PRODUCTS, GL_TEXTURE_2D, device->products.name);
}

static void set_sides(struct gl_frame *f, const struct frame_draw *draw)
{
    const struct gl *gl = f->gl;
    struct gl_current_state *current = &f->device->current;
    gl_use_cull(f->device, draw->cull);
    if (current->front != draw->mirrored) {
        gl->FrontFace(draw->mirrored ? GL_CCW : GL_CW);
        current->front = draw->mirrored;
    }
}

static void issue_draw_call(struct gl_frame *f, const struct gl_draw_call *call)
{
    const struct gl *gl = f->gl;
    const struct frame_draw *draw = call->draw;
    set_uniforms(f, call->program, call->range);
    if (call->lit)
        set_light_buffers(f, call);
    if (call->program->choices.environment != GLSL_NO_ENVIRONMENT)
        gl_use_texture(f->device, UNIT_ENVIRONMENT, GL_TEXTURE_2D_ARRAY, f->device->environment_texture);
    textures_use(f, call->program, call->range);
    if (call->program->choices.environment_light)
        gl_use_texture(f->device, UNIT_ENVIRONMENT_LIGHT, GL_TEXTURE_2D, f->device->environment_light_texture);
    if (call->program->choices.shadows)
        shadows_use(f, call->program);
    if (call->program->choices.occlusion) {
        enum texture_unit unit = gl_occlusion_unit(call->program);
        gl_use_texture(f->device, unit, GL_TEXTURE_2D, f->device->occlusion_texture);
        if (f->device->hardware_filter) // a map may have set a sampler for this unit
            gl_use_sampler(f->device, unit, 0);
    }
    program_set_int(f, call->program, UNIFORM_FIRST_TRIANGLE, (GLint)draw->first_id);
    program_set_int(f, call->program, UNIFORM_SAMPLE, f->sample + 1);
    set_sides(f, draw);
    gl_use_program(f->device, call->program->name);
    gl_use_array(f->device, call->array);
    if (call->by_elements)
        gl->DrawElements(GL_TRIANGLES, (GLsizei)call->count, GL_UNSIGNED_INT,
                         (const void *)((size_t)call->first * sizeof(uint32_t)));
    else
        gl->DrawArrays(GL_TRIANGLES, (GLint)call->first, (GLsizei)call->count);
}

static bool is_layer(const struct gl_frame *f, const struct gl_draw_call *call)
{
    return f->layered && (f->surface_layers || range_blends(f->frame, call->range));
}

// Issues the draw calls of the translucent layers or, if `layers` is false, of all other surfaces. With BLENDING_ADD,
// every triangle over a pixel is added, regardless of depth.
static void draw_all(struct gl_frame *f, bool layers, enum gl_blending blending)
{
    gl_use_blending(f->device, blending);
    for (int i = 0; i < f->draw_call_count; i++)
        if (is_layer(f, &f->draw_calls[i]) == layers && !(f->only_opaque && f->draw_calls[i].range->translucent))
            issue_draw_call(f, &f->draw_calls[i]);
}

// --- targets

// The depth ids of empty pixels: a value in front of everything, and a value behind everything.
enum { DEPTH_ID_NEAREST = 0, DEPTH_ID_FARTHEST = -1 };

static void clear_target(struct gl_frame *f, const struct gl_target *t, int depth_id)
{
    static const GLfloat black[4] = {0}, white[4] = {1, 1, 1, 1}, far[1] = {1};
    const GLuint empty[4] = {(GLuint)depth_id, (GLuint)depth_id, 0, 0};
    gl_use_framebuffer(f->device, t->framebuffer);
    f->gl->ClearBufferfv(GL_COLOR, 0, black);
    if (t->depth_id)
        f->gl->ClearBufferuiv(GL_COLOR, 1, empty);
    if (t->through)
        f->gl->ClearBufferfv(GL_COLOR, 2, white);
    if (t->depth)
        f->gl->ClearBufferfv(GL_DEPTH, 0, far);
}

// Blends a texture's colours, times the factor, into a target.
static void copy_texture(struct gl_frame *f, GLuint from, const struct gl_target *to, enum gl_blending how,
                         float factor)
{
    const struct gl *gl = f->gl;
    struct gl_device *device = f->device;
    gl_use_framebuffer(device, to->framebuffer);
    gl_use_blending(device, how);
    gl_use_cull(device, LAM_CULL_NONE);
    gl_use_program(device, device->copy_program);
    if (device->copy_factor_value != factor)
        gl->Uniform1f(device->copy_factor, device->copy_factor_value = factor);
    gl_use_texture(device, UNIT_COPY, GL_TEXTURE_2D, from);
    gl_use_array(device, device->empty_array);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
}

static void copy_target(struct gl_frame *f, const struct gl_target *from, const struct gl_target *to,
                        enum gl_blending how, float factor)
{
    copy_texture(f, from->color, to, how, factor);
}

// Adds a target's colours times the tint to the sum. With `last`, also adds the opaque surfaces behind all layers, and
// the alpha.
static void add_tinted(struct gl_frame *f, const struct gl_target *from, bool last)
{
    const struct gl *gl = f->gl;
    struct gl_device *device = f->device;
    gl_use_framebuffer(device, device->targets.sum.framebuffer);
    gl_use_blending(device, BLENDING_ADD);
    gl_use_cull(device, LAM_CULL_NONE);
    gl_use_program(device, device->tint_program);
    gl->Uniform1f(device->tint_last, last);
    gl->Uniform4fv(device->tint_background, 1, f->frame->glass_background);
    gl_use_texture(device, UNIT_COPY, GL_TEXTURE_2D, from->color);
    gl_use_texture(device, UNIT_NEARER_DEPTH_IDS, GL_TEXTURE_2D, device->targets.tint.color);
    gl_use_array(device, device->empty_array);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
}

// --- passes

// Peels the translucent surfaces, nearest first, and composites the layers over each other and over the opaque
// surfaces.
static bool draw_layers(struct gl_frame *f, lam_error *error)
{
    const struct gl *gl = f->gl;
    struct gl_device *device = f->device;
    struct gl_targets *t = &device->targets;
    clear_target(f, &t->sum, DEPTH_ID_NEAREST);
    clear_target(f, &t->layers[1], DEPTH_ID_NEAREST); // the depth id before the first layer
    bool tinted = f->frame->transmits;
    if (tinted) {
        static const GLfloat white[4] = {1, 1, 1, 1};
        gl_use_framebuffer(device, t->tint.framebuffer);
        gl->ClearBufferfv(GL_COLOR, 0, white);
    }
    GLuint samples_passed = 1;
    for (int layer = 0; samples_passed; layer++) {
        if (!call_should_continue(f->call))
            return call_error(f->call, error);
        const struct gl_target *target = &t->layers[layer % 2];
        clear_target(f, target, DEPTH_ID_FARTHEST); // a pixel without this layer has no further layers
        gl_use_texture(device, UNIT_NEARER_DEPTH_IDS, GL_TEXTURE_2D, t->layers[1 - layer % 2].depth_id);
        gl_use_texture(device, UNIT_OPAQUE_DEPTH_IDS, GL_TEXTURE_2D, t->sample.depth_id);
        gl->BeginQuery(GL_ANY_SAMPLES_PASSED, device->query);
        draw_all(f, true, BLENDING_NEAREST);
        gl->EndQuery(GL_ANY_SAMPLES_PASSED);
        gl->GetQueryObjectuiv(device->query, GL_QUERY_RESULT, &samples_passed);
        if (samples_passed && tinted) {
            add_tinted(f, target, false);
            copy_texture(f, target->through, &t->tint, BLENDING_MULTIPLY, 1);
        } else if (samples_passed) {
            copy_target(f, target, &t->sum, BLENDING_UNDER, 1);
        }
    }
    if (tinted)
        add_tinted(f, &t->sample, true);
    else
        copy_target(f, &t->sample, &t->sum, BLENDING_UNDER, 1);
    return true;
}

static void use_sample(struct gl_frame *f, const struct sample_pattern *pattern, int number)
{
    int s = pattern->by_distance[number];
    f->sample = number;
    f->sample_x = (float)pattern->x[s] * 0.0625f;
    f->sample_y = (float)pattern->y[s] * 0.0625f;
}

// Peels the opaque surfaces at the sample that is nearest to the centre. Each layer goes to its own channel.
static bool draw_surface_layers(struct gl_frame *f, lam_error *error)
{
    struct gl_device *device = f->device;
    struct gl_targets *t = &device->targets;
    clear_target(f, &t->sum, DEPTH_ID_NEAREST);
    clear_target(f, &t->sample, DEPTH_ID_NEAREST);    // no surface hides the layers
    clear_target(f, &t->layers[1], DEPTH_ID_NEAREST); // the depth id before the first layer
    for (int layer = 0; layer < f->surface_layers; layer++) {
        if (!call_should_continue(f->call))
            return call_error(f->call, error);
        const struct gl_target *target = &t->layers[layer % 2];
        clear_target(f, target, DEPTH_ID_FARTHEST);
        gl_use_texture(device, UNIT_NEARER_DEPTH_IDS, GL_TEXTURE_2D, t->layers[1 - layer % 2].depth_id);
        gl_use_texture(device, UNIT_OPAQUE_DEPTH_IDS, GL_TEXTURE_2D, t->sample.depth_id);
        draw_all(f, true, BLENDING_NEAREST);
        f->gl->ColorMask(layer == 0, layer == 1, layer == 2, layer == 0);
        copy_target(f, target, &t->sum, BLENDING_ADD, 1);
        f->gl->ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    }
    gl_use_framebuffer(device, t->sum.framebuffer);
    return true;
}

bool passes_draw(struct gl_frame *f, lam_error *error)
{
    struct gl_targets *t = &f->device->targets;
    const struct sample_pattern *pattern = sample_pattern(f->frame->settings.samples);
    gl_use_viewport(f->device, f->width, f->height);
    if (f->surface_layers) {
        use_sample(f, pattern, 0);
        return draw_surface_layers(f, error);
    }
    const struct gl_target *result = f->layered ? &t->sum : &t->sample;
    bool several = pattern->count > 1;
    // Whether a pixel has the value of its covered sample nearest to the centre, instead of a mean.
    lam_output output = f->frame->settings.output;
    bool value = output_is_value(output) && output_kind(output) != OUTPUT_COUNT;
    if (several)
        clear_target(f, &t->picture, DEPTH_ID_NEAREST);
    for (int i = 0; i < pattern->count; i++) {
        use_sample(f, pattern, i);
        if (!call_should_continue(f->call))
            return call_error(f->call, error);
        clear_target(f, &t->sample, DEPTH_ID_NEAREST);
        draw_all(f, false, output == LAM_OUTPUT_OVERDRAW ? BLENDING_ADD : BLENDING_NEAREST);
        if (f->layered && !draw_layers(f, error))
            return false;
        if (several)
            copy_target(f, result, &t->picture, value ? BLENDING_UNDER : BLENDING_ADD,
                        value ? 1 : 1.0f / (float)pattern->count);
    }
    gl_use_framebuffer(f->device, several ? t->picture.framebuffer : result->framebuffer);
    return true;
}
