// gl_textures.c: uploads the textures of materials with all their levels, once, and binds those that a draw call reads.
//
// Numbers of 0…1 are kept in 16 bits, error 2⁻¹⁷; others, and all where an OpenGL ES driver has no such format, as floats.
// Shaders read single texels and filter themselves (texture.glsl).
#include "gl_device.h"

#include "fail.h"
#include "texture_levels.h"

#include <stdlib.h>

// The texels of a level as bytes of the format that it is uploaded in.
static void pack_level(const struct lam_texture *texture, int level, bool wide, void *out)
{
    const struct texture_level *l = &texture->levels[level];
    uint16_t *shorts = out;
    float *floats = out;
    for (int y = 0; y < l->height; y++)
        for (int x = 0; x < l->width; x++) {
            texel t = texel_at(texture, level, x, y);
            for (int c = 0; c < 4; c++) {
                if (wide)
                    *floats++ = t[c];
                else
                    *shorts++ = (uint16_t)(t[c] * 65535.0f + 0.5f);
            }
        }
}

// Whether some number is outside of 0…1. Those of bytes are inside, and averages lie between what they are made of.
static bool needs_floats(const struct lam_texture *texture)
{
    const struct texture_level *l = &texture->levels[0];
    size_t count = (size_t)l->width * (size_t)l->height * 4;
    bool outside = false;
    for (size_t i = 0; l->floats && !outside && i < count; i++)
        outside = !(l->floats[i] >= 0 && l->floats[i] <= 1);
    return outside;
}

static bool send_levels(struct gl_frame *f, const struct lam_texture *texture, bool wide, lam_error *error)
{
    const struct gl *gl = f->gl;
    size_t each = wide ? 4 * sizeof(float) : 4 * sizeof(uint16_t);
    size_t bytes = (size_t)texture->levels[0].width * (size_t)texture->levels[0].height * each;
    if (!buffer_reserve(&f->device->scratch, bytes, f->call, error))
        return false;
    for (int level = 0; level < texture->level_count; level++) {
        const struct texture_level *l = &texture->levels[level];
        if (!call_should_continue(f->call))
            return call_error(f->call, error);
        pack_level(texture, level, wide, f->device->scratch.data);
        gl->TexImage2D(GL_TEXTURE_2D, level, wide ? GL_RGBA32F : GL_RGBA16, l->width, l->height, 0, GL_RGBA,
                       wide ? GL_FLOAT : GL_UNSIGNED_SHORT, f->device->scratch.data);
        f->device->base.report.bytes_uploaded += (size_t)l->width * (size_t)l->height * each;
    }
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST_MIPMAP_NEAREST);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, texture->level_count - 1);
    return true;
}

static void drop(struct gl_device *device, struct gl_texture *row)
{
    device->context.gl.DeleteTextures(1, &row->name);
    for (int unit = 0; unit < UNIT_COUNT; unit++) // OpenGL may reuse the name
        if (device->current.textures[unit] == row->name)
            device->current.textures[unit] = UINT32_MAX;
    scene_token_release(row->token);
    lam_texture_free(row->texture);
    *row = (struct gl_texture){0};
}

static struct gl_texture *free_row(struct gl_device *device, lam_error *error)
{
    for (int i = 0; i < device->texture_count; i++)
        if (!device->textures[i].texture)
            return &device->textures[i];
    if (device->texture_count == device->texture_capacity) {
        int capacity = device->texture_capacity ? 2 * device->texture_capacity : 8;
        struct gl_texture *grown = realloc(device->textures, (size_t)capacity * sizeof *grown);
        if (!grown) {
            fail_memory(error, (size_t)capacity * sizeof *grown);
            return NULL;
        }
        device->textures = grown;
        device->texture_capacity = capacity;
    }
    struct gl_texture *row = &device->textures[device->texture_count++];
    *row = (struct gl_texture){0};
    return row;
}

static struct gl_texture *find(struct gl_frame *f, const struct lam_texture *texture)
{
    for (int i = 0; i < f->device->texture_count; i++)
        if (f->device->textures[i].texture == texture)
            return &f->device->textures[i];
    return NULL;
}

static bool upload(struct gl_frame *f, const struct lam_texture *texture, lam_error *error)
{
    struct gl_device *device = f->device;
    struct gl_texture *row = find(f, texture);
    if (row) {
        row->last_frame = device->frame_number;
        return true;
    }
    int width = texture->levels[0].width, height = texture->levels[0].height;
    if (width > device->texture_size_max || height > device->texture_size_max)
        return fail(error, LAM_LIMIT, "OpenGL: a texture has %d×%d texels, this driver supports at most %d on a side",
                    width, height, device->texture_size_max);
    bool wide = !device->has_norm16 || needs_floats(texture);
    uint64_t texels = 0;
    for (int level = 0; level < texture->level_count; level++)
        texels += (uint64_t)texture->levels[level].width * (uint64_t)texture->levels[level].height;
    row = free_row(device, error);
    if (!row || !gl_charge(f, &row->bytes, texels * (wide ? 16 : 8), error))
        return false;
    row->texture = texture_share(texture);
    row->token = scene_token_hold(f->frame->token);
    row->last_frame = device->frame_number;
    f->gl->GenTextures(1, &row->name);
    gl_edit_texture(device, UNIT_COPY, GL_TEXTURE_2D, row->name);
    if (send_levels(f, texture, wide, error))
        return true;
    drop(device, row);
    return false;
}

bool textures_upload(struct gl_frame *f, const struct gl_program *program, const struct frame_draw_range *range,
                     lam_error *error)
{
    bool ok = true;
    for (int side = 0; side < 2; side++)
        for (int i = 0; ok && i < LAM_MAP_COUNT; i++)
            if (program->map_units[side][i])
                ok = upload(f, f->frame->materials[side ? range->back : range->front]->maps[i]->texture, error);
    return ok;
}

void textures_use(struct gl_frame *f, struct gl_program *program, const struct frame_draw_range *range)
{
    for (int side = 0; side < 2; side++) {
        const lam_material *material = f->frame->materials[side ? range->back : range->front];
        float cutoff = glsl_alpha_cutoff(f->frame, material), glow[4];
        glsl_glow(f->frame, range, side, glow);
        program_set(f, program, side ? UNIFORM_BACK_ALPHA_CUTOFF : UNIFORM_ALPHA_CUTOFF, &cutoff, 1);
        program_set(f, program, side ? UNIFORM_BACK_GLOW : UNIFORM_GLOW, glow, 4);
        for (int i = 0; i < LAM_MAP_COUNT; i++) {
            float s[4], t[4];
            enum uniform rows = (enum uniform)(UNIFORM_MAPS + 2 * (side * LAM_MAP_COUNT + i));
            if (program->locations[rows] < 0 && program->locations[rows + 1] < 0 && !program->map_units[side][i])
                continue;
            glsl_map_values(material->maps[i], f->frame->draws[range->draw].mesh, s, t);
            program_set(f, program, rows, s, 4);
            program_set(f, program, (enum uniform)(rows + 1), t, 4);
            if (program->map_units[side][i])
                gl_use_texture(f->device, (enum texture_unit)program->map_units[side][i], GL_TEXTURE_2D,
                               find(f, material->maps[i]->texture)->name);
        }
    }
}

void textures_evict(struct gl_frame *f)
{
    struct gl_device *device = f->device;
    for (int i = 0; i < device->texture_count; i++) {
        struct gl_texture *row = &device->textures[i];
        bool gone = row->token && __atomic_load_n(&row->token->gone, __ATOMIC_ACQUIRE);
        bool unused = row->token == f->frame->token && row->last_frame + 2 < device->frame_number;
        if (row->texture && (gone || unused))
            drop(device, row);
    }
}

void textures_free(struct gl_device *device)
{
    for (int i = 0; i < device->texture_count; i++)
        if (device->textures[i].texture)
            drop(device, &device->textures[i]);
    free(device->textures);
}
