// gl_light_buffers.c: uploads the lights, the products of materials and lights, and the environment's faces. Lights and
// products are stored in uniform blocks or, if they are too large for a block, in textures. Data that have not changed
// are not uploaded.
#include "gl_device.h"

#include "environment.h"
#include "fail.h"

#include <string.h>

enum { TEXEL = 4 * sizeof(float) };

enum glsl_storage light_buffers_storage(const struct gl_device *device, const struct glsl_choices *choices)
{
    struct glsl_choices c = *choices;
    c.storage = GLSL_BLOCK;
    size_t max = (size_t)device->block_size_max;
    return glsl_lights_bytes(&c) <= max && glsl_products_bytes(&c) <= max ? GLSL_BLOCK : GLSL_TEXTURE;
}

static bool send_block(struct gl_frame *f, struct gl_light_buffer *list, lam_error *error)
{
    const struct gl *gl = f->gl;
    if (!list->name)
        gl->GenBuffers(1, &list->name);
    gl->BindBuffer(GL_UNIFORM_BUFFER, list->name);
    if (list->size > list->capacity) {
        uint64_t held = list->capacity;
        if (!gl_charge(f, &held, list->size, error))
            return false;
        gl->BufferData(GL_UNIFORM_BUFFER, (GLsizeiptr)list->size, list->next.data, GL_DYNAMIC_DRAW);
        list->capacity = list->size;
    } else {
        gl->BufferSubData(GL_UNIFORM_BUFFER, 0, (GLsizeiptr)list->size, list->next.data);
    }
    return true;
}

// Uploads rows of GLSL_LIST_WIDTH texels; `next` contains whole rows.
static bool send_texels(struct gl_frame *f, struct gl_light_buffer *list, enum texture_unit unit, lam_error *error)
{
    const struct gl *gl = f->gl;
    size_t row = GLSL_LIST_WIDTH * TEXEL, rows = (list->size + row - 1) / row;
    if (rows > (size_t)f->device->texture_size_max)
        return fail(
            error, LAM_LIMIT,
            "OpenGL: lights and materials need a texture of %zu rows of %d texels, this driver supports at most %d; "
            "the CPU device has no such limit",
            rows, GLSL_LIST_WIDTH, f->device->texture_size_max);
    gl_edit_plain_texture(f->device, unit, GL_TEXTURE_2D, &list->name);
    if (rows > list->capacity) {
        uint64_t held = list->capacity * row;
        if (!gl_charge(f, &held, rows * row, error))
            return false;
        gl->TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, GLSL_LIST_WIDTH, (GLsizei)rows, 0, GL_RGBA, GL_FLOAT,
                       list->next.data);
        list->capacity = rows;
    } else {
        gl->TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, GLSL_LIST_WIDTH, (GLsizei)rows, GL_RGBA, GL_FLOAT, list->next.data);
    }
    return true;
}

static void delete_light_buffer(const struct gl *gl, struct gl_light_buffer *list)
{
    if (list->name && list->texture)
        gl->DeleteTextures(1, &list->name);
    else if (list->name)
        gl->DeleteBuffers(1, &list->name);
    list->name = 0;
    list->size = list->capacity = 0;
}

// Uploads `size` bytes of list->next if these bytes have changed since the previous frame.
static bool send(struct gl_frame *f, struct gl_light_buffer *list, size_t size, enum texture_unit unit,
                 lam_error *error)
{
    bool texture = f->storage == GLSL_TEXTURE;
    if (list->name && list->texture != texture) {
        delete_light_buffer(f->gl, list);
        gl_state_invalidate(f->device);
    }
    list->texture = texture;
    uint64_t key = size;
    gl_key_add(&key, list->next.data, size);
    if (list->name && list->key == key)
        return true;
    list->size = size;
    list->key = 0;
    if (texture ? !send_texels(f, list, unit, error) : !send_block(f, list, error))
        return false;
    f->device->base.report.bytes_uploaded += size;
    list->key = key;
    return true;
}

// Reserves list->next, in whole rows of texels, and zeroes it.
static bool reserve_next(struct gl_frame *f, struct gl_light_buffer *list, size_t size, lam_error *error)
{
    size_t row = GLSL_LIST_WIDTH * TEXEL, bytes = (size + row - 1) / row * row;
    if (!buffer_reserve(&list->next, bytes, f->call, error))
        return false;
    memset(list->next.data, 0, bytes);
    return true;
}

bool light_buffers_send(struct gl_frame *f, const struct glsl_choices *choices, lam_error *error)
{
    struct gl_device *device = f->device;
    size_t lights = glsl_lights_bytes(choices), one = glsl_products_bytes(choices);
    size_t unit = f->storage == GLSL_BLOCK ? (size_t)device->block_alignment : TEXEL;
    size_t step = (one + unit - 1) / unit * unit, all;
    if (__builtin_mul_overflow(step, (size_t)f->frame->material_count, &all))
        return fail(error, LAM_LIMIT, "the products of %d materials and %d lights are too many",
                    f->frame->material_count, f->frame->light_count);
    f->material_stride = f->storage == GLSL_BLOCK ? step : step / TEXEL;
    if (!reserve_next(f, &device->lights, lights, error) || !reserve_next(f, &device->products, all, error))
        return false;
    glsl_pack_lights(choices, f->frame, device->lights.next.data);
    for (int i = 0; i < f->frame->material_count; i++)
        glsl_pack_products(choices, f->frame, f->frame->materials[i],
                           (float *)((char *)device->products.next.data + (size_t)i * step));
    return send(f, &device->lights, lights, UNIT_LIGHTS, error) &&
           send(f, &device->products, all, UNIT_PRODUCTS, error);
}

bool environment_send(struct gl_frame *f, lam_error *error)
{
    struct gl_device *device = f->device;
    const struct gl *gl = f->gl;
    const struct lam_environment *cube = f->frame->environment;
    if (device->environment == cube)
        return true;
    int side = cube->size + 2;
    if (side > device->texture_size_max)
        return fail(error, LAM_LIMIT,
                    "OpenGL: the environment's faces are %d texels wide, this driver supports at most %d", cube->size,
                    device->texture_size_max - 2);
    uint64_t bytes = (uint64_t)side * (uint64_t)side * 6 * 3 * sizeof(float);
    if (!gl_charge(f, &device->environment_bytes, bytes, error))
        return false;
    lam_environment_free(device->environment);
    device->environment = NULL;
    device->environment_light = NULL; // another environment light may get the same address
    gl_edit_plain_texture(device, UNIT_ENVIRONMENT, GL_TEXTURE_2D_ARRAY, &device->environment_texture);
    gl->TexImage3D(GL_TEXTURE_2D_ARRAY, 0, GL_RGB32F, side, side, 6, 0, GL_RGB, GL_FLOAT, cube->texels);
    device->environment = cube_share(cube);
    device->base.report.bytes_uploaded += bytes;
    return true;
}

bool environment_light_send(struct gl_frame *f, lam_error *error)
{
    struct gl_device *device = f->device;
    const struct gl *gl = f->gl;
    if (device->environment_light == f->environment_light)
        return true;
    uint64_t held = 0, bytes = (uint64_t)environment_light_rows() * ENVIRONMENT_LIGHT_WIDTH * 3 * sizeof(float);
    if (!gl_charge(f, &held, bytes, error))
        return false;
    gl_edit_plain_texture(device, UNIT_ENVIRONMENT_LIGHT, GL_TEXTURE_2D, &device->environment_light_texture);
    gl->TexImage2D(GL_TEXTURE_2D, 0, GL_RGB32F, ENVIRONMENT_LIGHT_WIDTH, environment_light_rows(), 0, GL_RGB, GL_FLOAT,
                   f->environment_light->texels);
    device->environment_light = f->environment_light;
    device->base.report.bytes_uploaded += bytes;
    return true;
}

void light_buffers_free(struct gl_device *device)
{
    const struct gl *gl = &device->context.gl;
    struct gl_light_buffer *lists[] = {&device->lights, &device->products};
    for (int i = 0; i < 2; i++) {
        delete_light_buffer(gl, lists[i]);
        buffer_free(&lists[i]->next);
    }
    if (device->environment_texture)
        gl->DeleteTextures(1, &device->environment_texture);
    if (device->environment_light_texture)
        gl->DeleteTextures(1, &device->environment_light_texture);
    lam_environment_free(device->environment);
}
