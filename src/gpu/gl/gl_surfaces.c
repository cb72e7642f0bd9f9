// gl_surfaces.c: stores the data with which a shader computes the light that passes through a masked, translucent or
// transmitting triangle (passed_surface in shadows.glsl). These data are the record of the triangle, the records of the
// triangle's materials, and the materials' maps at level 0. The data follow the hierarchy in the same texture.
#include "gl_device.h"

#include "fail.h"
#include "layer_kinds.h"
#include "opacity.h"
#include "texture_levels.h"

#include <string.h>

enum {
    RECORD = 4,  // texels of a triangle: its sides, and the texture coordinates of its corners
    COLORED = 7, // texels of a triangle with the colours of its corners
    SIDE = 4,    // texels of one side of a material
    MAP = 4,     // texels of a map
    MAPS = 4,    // number of maps that affect the transmitted light of a side
    WIDE = -1,   // channel number that means all four channels
};

// The packed pixels of a texture, or of one channel, and their position.
struct packed_pixels {
    const struct lam_texture *texture;
    int channel;
    size_t at;
};

// Everything is packed twice. The first pass only computes the size and the key. Pictures and meshes are identified by
// their addresses, because a scene never changes its arrays, and keeps the arrays until the scene is freed.
struct packer {
    float *out; // if NULL, only the size and the key are computed
    size_t first, used;
    uint64_t key;
    struct packed_pixels *pixels;
    int pixel_count;
    size_t *records; // the first record of each range, or 0
};

// Reserves texels and returns their position, counted from the first texel of the texture.
static size_t add_texels(struct packer *p, size_t count)
{
    size_t at = p->used;
    p->used += count;
    return p->first + at;
}

static float *texel_of(const struct packer *p, size_t at) { return p->out + 4 * (at - p->first); }

static void put(struct packer *p, size_t at, const float *numbers, size_t size)
{
    if (p->out)
        memcpy(texel_of(p, at), numbers, size);
    else
        gl_key_add(&p->key, numbers, size);
}

// Packs the pixels at level 0. A texel contains either all channels of one pixel, or one channel of four pixels.
static size_t add_pixels(struct packer *p, const struct lam_texture *texture, int channel)
{
    for (int i = 0; i < p->pixel_count; i++)
        if (p->pixels[i].texture == texture && p->pixels[i].channel == channel)
            return p->pixels[i].at;
    const struct texture_level *level = &texture->levels[0];
    size_t count = (size_t)level->width * (size_t)level->height;
    size_t at = add_texels(p, channel == WIDE ? count : (count + 3) / 4);
    p->pixels[p->pixel_count++] = (struct packed_pixels){texture, channel, at};
    if (!p->out) {
        gl_key_add(&p->key, &texture, sizeof texture);
        gl_key_add(&p->key, &channel, sizeof channel);
    }
    float *out = p->out ? texel_of(p, at) : NULL;
    for (int y = 0; out && y < level->height; y++)
        for (int x = 0; x < level->width; x++) {
            texel t = texel_at(texture, 0, x, y);
            for (int c = 0; c < 4; c++)
                if (channel == WIDE || channel == c)
                    *out++ = t[c];
        }
    return at;
}

// Packs a map, for one channel or all channels. Returns 0 if there is no map.
static size_t add_map(struct packer *p, const lam_mesh *mesh, const lam_texture_map *map, int channel)
{
    if (!map || !map->texture)
        return 0;
    size_t at = add_texels(p, MAP), pixels = add_pixels(p, map->texture, channel);
    const struct texture_level *level = &map->texture->levels[0];
    float s[4], t[4];
    glsl_map_values(map, mesh, s, t);
    const float packed[4 * MAP] = {(float)pixels,
                                   (float)level->width,
                                   (float)level->height,
                                   channel == WIDE,
                                   s[0],
                                   s[1],
                                   s[2],
                                   (float)((int)map->wrap_s + 4 * (int)map->wrap_t),
                                   t[0],
                                   t[1],
                                   t[2],
                                   (float)map->texcoords,
                                   s[3],
                                   t[3],
                                   map->magnify == LAM_FILTER_NEAREST};
    put(p, at, packed, sizeof packed);
    return at;
}

// Packs the numbers and maps of one side's material for a range of triangles. ray_opacity and ray_transmittance
// (opacity.c) use the same values.
static size_t add_side(struct packer *p, const struct frame *frame, const struct frame_draw_range *range, bool back)
{
    const struct frame_draw *draw = &frame->draws[range->draw];
    const lam_material *m = frame->materials[back && !draw->one_sided ? range->back : range->front];
    const lam_texture_map *const *maps = m->maps, *opacity = maps[LAM_MAP_OPACITY];
    const lam_texture_map *transmission = maps[LAM_MAP_TRANSMISSION], *metallic = maps[LAM_MAP_METALLIC];
    bool transmits = frame_is_physical(range->reflection) && frame_layers(frame, m) & LAYER_TRANSMISSION &&
                     m->alpha_mode != LAM_ALPHA_MASK;
    size_t at = add_texels(p, SIDE), of_maps[MAPS] = {0};
    of_maps[0] = add_map(p, draw->mesh, maps[LAM_MAP_DIFFUSE], frame->tints_rays ? WIDE : 3);
    of_maps[1] = add_map(p, draw->mesh, opacity, opacity ? opacity->channel : 0);
    if (transmits) {
        of_maps[2] = add_map(p, draw->mesh, transmission, transmission ? transmission->channel : 0);
        of_maps[3] = add_map(p, draw->mesh, metallic, metallic ? metallic->channel : 0);
    }
    const float packed[4 * SIDE] = {
        m->diffuse.a,      m->alpha_mode == LAM_ALPHA_OPAQUE ? 0 : m->alpha_mode == LAM_ALPHA_MASK ? 1 : 2,
        m->alpha_cutoff,   !transmits ? 0 : back && m->thickness > 0 ? 2 : 1,
        m->diffuse.r,      m->diffuse.g,
        m->diffuse.b,      0,
        (float)of_maps[0], (float)of_maps[1],
        (float)of_maps[2], (float)of_maps[3],
        m->metallic,       m->transmission,
    };
    put(p, at, packed, sizeof packed);
    return at;
}

static size_t record_size(const struct frame *frame, const struct frame_draw_range *range)
{
    return frame->draws[range->draw].mesh->colors ? COLORED : RECORD;
}

static void key_add_range(struct packer *p, const struct frame_draw *draw, const struct frame_draw_range *range)
{
    const lam_mesh *m = draw->mesh;
    const void *const arrays[] = {
        m->indices, m->texcoords,    m->texcoord_indices, m->second_texcoords, m->second_texcoord_indices,
        m->colors,  m->color_indices};
    const uint32_t numbers[] = {range->first_id, range->count, draw->first_id, draw->mirrored};
    gl_key_add(&p->key, arrays, sizeof arrays);
    gl_key_add(&p->key, numbers, sizeof numbers);
}

// Returns the position of the record of a range's first triangle.
static size_t add_range(struct packer *p, const struct frame *frame, const struct frame_draw_range *range)
{
    const struct frame_draw *draw = &frame->draws[range->draw];
    const lam_mesh *mesh = draw->mesh;
    if (!p->out)
        key_add_range(p, draw, range);
    size_t front = add_side(p, frame, range, false), back = add_side(p, frame, range, true);
    size_t each = record_size(frame, range), at = add_texels(p, each * range->count);
    for (uint32_t i = 0; p->out && i < range->count; i++) {
        float *out = texel_of(p, at + each * i);
        uint32_t corner = 3 * (range->first_id - draw->first_id + i);
        out[0] = (float)(draw->mirrored ? back : front);
        out[1] = (float)(draw->mirrored ? front : back);
        out[2] = mesh->colors != NULL;
        for (uint32_t k = 0; k < 3; k++) {
            ray_corner_texcoord(mesh, 0, corner + k, out + 4 * (1 + k));
            ray_corner_texcoord(mesh, 1, corner + k, out + 4 * (1 + k) + 2);
            if (mesh->colors)
                ray_corner_color(mesh, corner + k, out + 4 * (RECORD + k));
        }
    }
    return at;
}

static void add_ranges(struct packer *p, const struct frame *frame)
{
    p->used = 0;
    p->pixel_count = 0;
    p->key = 1;
    for (int i = 0; i < frame->range_count; i++) {
        const struct frame_draw_range *range = &frame->ranges[i];
        bool passes = range->passes_rays && frame_draw_casts(&frame->draws[range->draw]);
        p->records[i] = passes ? add_range(p, frame, range) : 0;
    }
}

size_t surfaces_record(const struct gl_frame *f, uint32_t number)
{
    int range = frame_range_of(f->frame, number);
    size_t first = f->frame->passes_rays ? ((const size_t *)f->device->surfaces.records.data)[range] : 0;
    const struct frame_draw_range *r = &f->frame->ranges[range];
    return first ? first + record_size(f->frame, r) * (number - r->first_id) : 0;
}

bool surfaces_count(struct gl_frame *f, size_t first, size_t most, size_t *count, bool *same, lam_error *error)
{
    struct gl_surfaces *own = &f->device->surfaces;
    size_t ranges = f->frame->passes_rays ? (size_t)f->frame->range_count : 0;
    *count = own->next_key = 0;
    *same = own->key == 0;
    if (!ranges)
        return true;
    if (!buffer_reserve(&own->pixels, ranges * 2 * MAPS * sizeof(struct packed_pixels), f->call, error) ||
        !buffer_reserve(&own->records, ranges * sizeof(size_t), f->call, error))
        return false;
    struct packer p = {.first = first, .pixels = own->pixels.data, .records = own->records.data};
    add_ranges(&p, f->frame);
    if (first + p.used > most)
        return fail(error, LAM_LIMIT,
                    "OpenGL: for shadows the surfaces that let light through, with their textures, need %zu texels "
                    "beside the hierarchy's %zu, this device can have %zu; the CPU device has no such limit",
                    p.used, first, most);
    *count = p.used;
    own->next_key = p.key;
    *same = p.key == own->key;
    return true;
}

void surfaces_pack(struct gl_frame *f, size_t first, float *out)
{
    struct gl_surfaces *own = &f->device->surfaces;
    if (own->next_key) {
        struct packer p = {.out = out, .first = first, .pixels = own->pixels.data, .records = own->records.data};
        add_ranges(&p, f->frame);
    }
    own->key = own->next_key;
}

uint64_t surfaces_bytes(const struct gl_device *device)
{
    return device->surfaces.records.capacity + device->surfaces.pixels.capacity;
}

void surfaces_free(struct gl_device *device)
{
    buffer_free(&device->surfaces.records);
    buffer_free(&device->surfaces.pixels);
}
