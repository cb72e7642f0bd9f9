// gl_textures.c: uploads each texture of a material once, with all levels, and binds the textures of a draw call.
//
// Shaders read single texels and filter them (texture.glsl). Numbers in 0…1 are stored in 16 bits, with an error of at
// most 2⁻¹⁷; other numbers are stored as floats. If an OpenGL ES driver does not support the 16-bit format, all numbers
// are stored as floats. With lam_gl_params.hardware_filter, 8-bit texels are not converted (colours remain
// sRGB-encoded), and sampler objects set wrapping and filtering.
#include "gl_device.h"

#include "fail.h"
#include "pixels.h"
#include "texture_levels.h"

#define LANES 1
#include "encoding.h"

#include <stdlib.h>

// The format of an uploaded texture.
struct format {
    GLenum stored, type; // the formats of the stored texels and of the uploaded numbers
    size_t bytes;        // bytes per uploaded texel, and approximately per stored texel
};

static uint8_t encoded_byte(float linear) { return (uint8_t)byte_of(srgb_encode(linear)); }

// Clamps a number to the range of 16-bit floats.
static float half_limited(float x) { return x > 65504 ? 65504 : x < -65504 ? -65504 : x; }

// Writes the texels of a level in the format that is uploaded.
static void pack_level(const struct lam_texture *texture, int level, const struct format *format, void *out)
{
    const struct texture_level *l = &texture->levels[level];
    uint8_t *bytes = out;
    uint16_t *shorts = out;
    float *floats = out;
    if (format->type == GL_UNSIGNED_BYTE && !l->floats) {
        pixels_to_working(texture->channels == 3 ? LAM_RGB8 : LAM_RGBA8, texture->bytes, l->width * l->height, out);
        return;
    }
    for (int y = 0; y < l->height; y++)
        for (int x = 0; x < l->width; x++) {
            texel t = texel_at(texture, level, x, y);
            for (int c = 0; c < 4; c++) {
                if (format->stored == GL_RGBA16F)
                    *floats++ = half_limited(t[c]);
                else if (format->type == GL_FLOAT)
                    *floats++ = t[c];
                else if (format->type == GL_UNSIGNED_SHORT)
                    *shorts++ = (uint16_t)(t[c] * 65535.0f + 0.5f);
                else
                    *bytes++ = format->stored == GL_SRGB8_ALPHA8 && c < 3 ? encoded_byte(t[c]) : (uint8_t)byte_of(t[c]);
            }
        }
}

// Returns whether a number is outside 0…1. Bytes represent numbers in 0…1, and averages of such numbers are in 0…1 too.
static bool needs_floats(const struct lam_texture *texture)
{
    const struct texture_level *l = &texture->levels[0];
    size_t count = (size_t)l->width * (size_t)l->height * (size_t)texture->channels;
    bool outside = false;
    for (size_t i = 0; l->floats && !outside && i < count; i++)
        outside = !(l->floats[i] >= 0 && l->floats[i] <= 1);
    return outside;
}

static struct format format_of(const struct gl_device *device, const struct lam_texture *texture)
{
    if (device->hardware_filter && !texture->levels[0].floats)
        return (struct format){texture->values == LAM_TEXTURE_COLOR ? GL_SRGB8_ALPHA8 : GL_RGBA8, GL_UNSIGNED_BYTE, 4};
    if (device->has_norm16 && !needs_floats(texture))
        return (struct format){GL_RGBA16, GL_UNSIGNED_SHORT, 8};
    // OpenGL ES does not guarantee filtering of 32-bit floats.
    return (struct format){device->hardware_filter ? GL_RGBA16F : GL_RGBA32F, GL_FLOAT, 16};
}

static bool send_levels(struct gl_frame *f, const struct lam_texture *texture, const struct format *format,
                        lam_error *error)
{
    const struct gl *gl = f->gl;
    size_t bytes = (size_t)texture->levels[0].width * (size_t)texture->levels[0].height * format->bytes;
    if (!buffer_reserve(&f->device->scratch, bytes, f->call, error))
        return false;
    for (int level = 0; level < texture->level_count; level++) {
        const struct texture_level *l = &texture->levels[level];
        if (!call_should_continue(f->call))
            return call_error(f->call, error);
        pack_level(texture, level, format, f->device->scratch.data);
        gl->TexImage2D(GL_TEXTURE_2D, level, (GLint)format->stored, l->width, l->height, 0, GL_RGBA, format->type,
                       f->device->scratch.data);
        f->device->base.report.bytes_uploaded += (size_t)l->width * (size_t)l->height * format->bytes;
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
    struct gl_texture *list =
        gl_grown(device->textures, device->texture_count, &device->texture_capacity, sizeof *list, error);
    if (!list)
        return NULL;
    device->textures = list;
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
    struct format format = format_of(device, texture);
    uint64_t texels = 0;
    for (int level = 0; level < texture->level_count; level++)
        texels += (uint64_t)texture->levels[level].width * (uint64_t)texture->levels[level].height;
    row = free_row(device, error);
    if (!row || !gl_charge(f, &row->bytes, texels * format.bytes, error))
        return false;
    row->texture = texture_share(texture);
    row->token = scene_token_hold(f->frame->token);
    row->last_frame = device->frame_number;
    f->gl->GenTextures(1, &row->name);
    gl_edit_texture(device, UNIT_COPY, GL_TEXTURE_2D, row->name);
    if (send_levels(f, texture, &format, error))
        return true;
    drop(device, row);
    return false;
}

// Returns the sampler of a map, with the anisotropy of the frame.
static GLuint sampler_of(struct gl_frame *f, const lam_texture_map *map, struct texture_sampler by)
{
    static const GLint wraps[] = {GL_REPEAT, GL_CLAMP_TO_EDGE, GL_MIRRORED_REPEAT};
    static const GLint magnifying[] = {GL_LINEAR, GL_NEAREST};
    static const GLint minifying[][2] = {{GL_LINEAR_MIPMAP_LINEAR, GL_NEAREST_MIPMAP_LINEAR},
                                         {GL_LINEAR_MIPMAP_NEAREST, GL_NEAREST_MIPMAP_NEAREST},
                                         {GL_LINEAR, GL_NEAREST}};
    const struct gl *gl = f->gl;
    int number = (int)map->wrap_s * LAM_WRAP_COUNT + (int)map->wrap_t;
    number = (number * LAM_FILTER_COUNT + (int)by.magnify) * LAM_FILTER_COUNT + (int)by.minify;
    number = (number * LAM_MIP_COUNT + (int)by.mip) * 2 + (by.probes > 1);
    struct gl_sampler *sampler = &f->device->samplers[number];
    if (!sampler->name) {
        gl->GenSamplers(1, &sampler->name);
        gl->SamplerParameteri(sampler->name, GL_TEXTURE_WRAP_S, wraps[map->wrap_s]);
        gl->SamplerParameteri(sampler->name, GL_TEXTURE_WRAP_T, wraps[map->wrap_t]);
        gl->SamplerParameteri(sampler->name, GL_TEXTURE_MAG_FILTER, magnifying[by.magnify]);
        gl->SamplerParameteri(sampler->name, GL_TEXTURE_MIN_FILTER, minifying[by.mip][by.minify]);
        sampler->anisotropy = 1;
    }
    // Without linear filters, the positions of anisotropic samples differ between drivers.
    bool linear = !by.magnify && !by.minify && !by.mip;
    int anisotropy = linear && f->device->anisotropy_max > 1 ? by.probes : 1;
    if (sampler->anisotropy != anisotropy) {
        GLfloat most = f->device->anisotropy_max;
        gl->SamplerParameterf(sampler->name, GL_TEXTURE_MAX_ANISOTROPY,
                              (float)anisotropy < most ? (float)anisotropy : most);
        sampler->anisotropy = anisotropy;
    }
    return sampler->name;
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

void textures_use(struct gl_frame *f, const struct gl_program *program, const struct frame_draw_range *range)
{
    for (int side = 0; side < 2; side++)
        for (int i = 0; i < LAM_MAP_COUNT; i++) {
            enum texture_unit unit = (enum texture_unit)program->map_units[side][i];
            if (!unit)
                continue;
            const lam_material *material = f->frame->materials[side ? range->back : range->front];
            const lam_texture_map *map = material->maps[i];
            gl_use_texture(f->device, unit, GL_TEXTURE_2D, find(f, map->texture)->name);
            if (f->device->hardware_filter)
                gl_use_sampler(f->device, unit, sampler_of(f, map, frame_map_sampler(f->frame, material, map)));
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
    for (int i = 0; i < SAMPLER_COUNT; i++)
        if (device->samplers[i].name)
            device->context.gl.DeleteSamplers(1, &device->samplers[i].name);
}
