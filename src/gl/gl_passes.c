// gl_passes.c: one part of the picture: each sample of its pixels in a pass of its own, the projection moved
// by where the sample lies; opaque surfaces first; then the translucent ones, peeled layer by layer from the
// nearest on.
//
// A place is the depth and the number of a triangle. It is what layers are told apart by, so that surfaces of
// equal depth keep the CPU's order, the lower triangle number in front, and none is lost.
//
// Rows lie in the target as they do in the picture, from the top down: y is turned in the projection, and
// with it the winding.
#include "gl_device.h"

#include "fail.h"
#include "samples.h"

#include <string.h>

// --- one draw

// Rows X·w, Y·w of pixels to clip space of the part, the sample moved to the pixel's centre:
// x = 2 (X − left − sample) / width − 1.
static void to_clip(const struct gl_frame *f, const struct frame_draw *draw, float out[16])
{
    const float(*m)[4] = draw->pixel;
    double left = f->left + (double)f->sample_x, top = f->top + (double)f->sample_y;
    for (int j = 0; j < 4; j++) { // OpenGL's matrices are column after column
        double w = (double)m[3][j];
        out[4 * j] = (float)(((double)m[0][j] - left * w) * (2.0 / f->width) - w);
        out[4 * j + 1] = (float)(((double)m[1][j] - top * w) * (2.0 / f->height) - w);
        out[4 * j + 2] = m[2][j];
        out[4 * j + 3] = m[3][j];
    }
}

static void columns(float *out, const float *rows, int count, int stride)
{
    for (int i = 0; i < count; i++)
        for (int j = 0; j < count; j++)
            out[count * j + i] = rows[i * stride + j];
}

static void set_matrices(struct gl_frame *f, struct gl_program *program, const struct frame_draw *draw)
{
    float clip[16], eye[16] = {0}, three[9];
    to_clip(f, draw, clip);
    program_set(f, program, UNIFORM_MODEL_VIEW_PROJECTION, clip, 16);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            eye[4 * j + i] = draw->eye[i][j];
    eye[15] = 1;
    program_set(f, program, UNIFORM_MODEL_VIEW, eye, 16);
    columns(three, draw->normal[0], 3, 3);
    program_set(f, program, UNIFORM_NORMAL_MATRIX, three, 9);
    columns(three, f->frame->to_environment[0], 3, 3);
    program_set(f, program, UNIFORM_ENVIRONMENT_MATRIX, three, 9);
}

// With GLSL_TEXTURE the head of a material's products is plain uniforms.
static void set_head(struct gl_frame *f, struct gl_program *program, const lam_material *material, bool back)
{
    struct glsl_material_layout layout = glsl_material_layout(true);
    float values[GLSL_MATERIAL_MAX];
    glsl_material_values(f->frame, material, true, values);
    for (int i = 0; i < layout.count; i++) {
        enum uniform uniform = (enum uniform)((back ? UNIFORM_BACK_HEAD : UNIFORM_HEAD) + i);
        program_set(f, program, uniform, values + layout.at[i], layout.fields[i]->field.type < LAM_FIELD_RGB ? 1 : 4);
    }
}

static void use_block(struct gl_frame *f, enum block_point point, GLuint buffer, size_t offset, size_t size)
{
    struct gl_now *now = &f->device->now;
    if (now->blocks[point].buffer == buffer && now->blocks[point].offset == offset && now->blocks[point].size == size)
        return;
    f->gl->BindBufferRange(GL_UNIFORM_BUFFER, point, buffer, (GLintptr)offset, (GLsizeiptr)size);
    now->blocks[point].buffer = buffer;
    now->blocks[point].offset = offset;
    now->blocks[point].size = size;
}

static void set_lists(struct gl_frame *f, const struct gl_surface *s)
{
    struct gl_device *device = f->device;
    const struct glsl_choices *c = &s->program->choices;
    size_t front = (size_t)s->surface->front * f->material_step, back = (size_t)s->surface->back * f->material_step;
    if (f->storage == GLSL_BLOCK) {
        use_block(f, POINT_LIGHTS, device->lights.name, 0, device->lights.size);
        use_block(f, POINT_PRODUCTS, device->products.name, front, glsl_products_bytes(c));
        use_block(f, POINT_BACK_PRODUCTS, device->products.name, back, glsl_products_bytes(c));
        return;
    }
    gl_use_texture(device, UNIT_LIGHTS, GL_TEXTURE_2D, device->lights.name);
    gl_use_texture(device, UNIT_PRODUCTS, GL_TEXTURE_2D, device->products.name);
    program_set_number(f, s->program, UNIFORM_FIRST_PRODUCT, (int)front);
    program_set_number(f, s->program, UNIFORM_BACK_FIRST_PRODUCT, (int)back);
    set_head(f, s->program, f->frame->materials[s->surface->front], false);
    set_head(f, s->program, f->frame->materials[s->surface->back], true);
}

static void set_sides(struct gl_frame *f, const struct frame_draw *draw)
{
    const struct gl *gl = f->gl;
    struct gl_now *now = &f->device->now;
    gl_use_cull(f->device, draw->cull);
    if (now->front != draw->mirrored) {
        gl->FrontFace(draw->mirrored ? GL_CCW : GL_CW);
        now->front = draw->mirrored;
    }
}

static void draw_surface(struct gl_frame *f, const struct gl_surface *s)
{
    const struct gl *gl = f->gl;
    const struct frame_draw *draw = s->draw;
    set_matrices(f, s->program, draw);
    if (s->lit)
        set_lists(f, s);
    if (s->program->choices.environment != GLSL_NO_ENVIRONMENT)
        gl_use_texture(f->device, UNIT_ENVIRONMENT, GL_TEXTURE_2D_ARRAY, f->device->environment_texture);
    float object = (float)draw->object;
    program_set(f, s->program, UNIFORM_OBJECT, &object, 1);
    program_set_number(f, s->program, UNIFORM_FIRST_TRIANGLE, (int)draw->first_id);
    set_sides(f, draw);
    gl_use_program(f->device, s->program->name);
    gl_use_array(f->device, s->array);
    if (s->by_elements)
        gl->DrawElements(GL_TRIANGLES, (GLsizei)s->count, GL_UNSIGNED_INT,
                         (const void *)((size_t)s->first * sizeof(uint32_t)));
    else
        gl->DrawArrays(GL_TRIANGLES, (GLint)s->first, (GLsizei)s->count);
}

static bool is_layer(const struct gl_frame *f, const struct gl_surface *s)
{
    return f->layered && s->surface->translucent;
}

// BLENDING_ADD: each triangle over a pixel counts, whatever its depth.
static void draw_surfaces(struct gl_frame *f, bool layers, enum gl_blending blending)
{
    gl_use_blending(f->device, blending);
    for (int i = 0; i < f->surface_count; i++)
        if (is_layer(f, &f->surfaces[i]) == layers)
            draw_surface(f, &f->surfaces[i]);
}

// --- targets

// The places that stand where nothing is drawn: in front of everything, or behind everything.
enum { PLACE_FRONT = 0, PLACE_END = -1 };

static void clear_target(struct gl_frame *f, const struct gl_target *t, int place)
{
    static const GLfloat nothing[4] = {0}, far[1] = {1};
    const GLuint nowhere[4] = {(GLuint)place, (GLuint)place, 0, 0};
    gl_use_framebuffer(f->device, t->framebuffer);
    f->gl->ClearBufferfv(GL_COLOR, 0, nothing);
    if (t->place)
        f->gl->ClearBufferuiv(GL_COLOR, 1, nowhere);
    if (t->depth)
        f->gl->ClearBufferfv(GL_DEPTH, 0, far);
}

// A target's colours, times the factor, into another one.
static void copy_target(struct gl_frame *f, const struct gl_target *from, const struct gl_target *to,
                        enum gl_blending how, float factor)
{
    const struct gl *gl = f->gl;
    struct gl_device *device = f->device;
    gl_use_framebuffer(device, to->framebuffer);
    gl_use_blending(device, how);
    gl_use_cull(device, LAM_CULL_NONE);
    gl_use_program(device, device->copy_program);
    if (device->copy_factor_now != factor)
        gl->Uniform1f(device->copy_factor, device->copy_factor_now = factor);
    gl_use_texture(device, UNIT_COPY, GL_TEXTURE_2D, from->color);
    gl_use_array(device, device->empty_array);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
}

// --- passes

// Peels the translucent surfaces off, nearest first, and lays them over each other and over the opaque ones.
static bool draw_layers(struct gl_frame *f, lam_error *error)
{
    const struct gl *gl = f->gl;
    struct gl_device *device = f->device;
    struct gl_targets *t = &device->targets;
    clear_target(f, &t->sum, PLACE_FRONT);
    clear_target(f, &t->layers[1], PLACE_FRONT); // the layer before the first
    GLuint any = 1;
    for (int layer = 0; any; layer++) {
        if (!call_should_continue(f->call))
            return call_error(f->call, error);
        const struct gl_target *here = &t->layers[layer % 2];
        clear_target(f, here, PLACE_END); // pixels without this layer have no more
        gl_use_texture(device, UNIT_NEARER, GL_TEXTURE_2D, t->layers[1 - layer % 2].place);
        gl_use_texture(device, UNIT_OPAQUE, GL_TEXTURE_2D, t->sample.place);
        gl->BeginQuery(GL_ANY_SAMPLES_PASSED, device->query);
        draw_surfaces(f, true, BLENDING_NEAREST);
        gl->EndQuery(GL_ANY_SAMPLES_PASSED);
        gl->GetQueryObjectuiv(device->query, GL_QUERY_RESULT, &any);
        if (any)
            copy_target(f, here, &t->sum, BLENDING_UNDER, 1);
    }
    copy_target(f, &t->sample, &t->sum, BLENDING_UNDER, 1);
    return true;
}

// A number is that of the covered sample nearest to the centre, not an average.
static bool is_number(lam_output show)
{
    return !lam_output_is_light(show) && show != LAM_OUTPUT_CLIPPED && show != LAM_OUTPUT_COVERAGE &&
           show != LAM_OUTPUT_OVERDRAW;
}

bool passes_draw(struct gl_frame *f, lam_error *error)
{
    struct gl_targets *t = &f->device->targets;
    const struct sample_pattern *pattern = sample_pattern(f->frame->samples);
    gl_use_viewport(f->device, f->width, f->height);
    const struct gl_target *result = f->layered ? &t->sum : &t->sample;
    bool several = pattern->count > 1;
    if (several)
        clear_target(f, &t->picture, PLACE_FRONT);
    for (int i = 0; i < pattern->count; i++) {
        int s = pattern->by_distance[i];
        if (!call_should_continue(f->call))
            return call_error(f->call, error);
        f->sample_x = (float)pattern->x[s] * 0.0625f;
        f->sample_y = (float)pattern->y[s] * 0.0625f;
        clear_target(f, &t->sample, PLACE_FRONT);
        draw_surfaces(f, false, f->frame->show == LAM_OUTPUT_OVERDRAW ? BLENDING_ADD : BLENDING_NEAREST);
        if (f->layered && !draw_layers(f, error))
            return false;
        bool number = is_number(f->frame->show);
        if (several)
            copy_target(f, result, &t->picture, number ? BLENDING_UNDER : BLENDING_ADD,
                        number ? 1 : 1.0f / (float)pattern->count);
    }
    gl_use_framebuffer(f->device, several ? t->picture.framebuffer : result->framebuffer);
    return true;
}
