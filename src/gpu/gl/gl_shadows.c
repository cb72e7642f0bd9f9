// gl_shadows.c: stores the hierarchy of a frame in a float texture, which the shaders traverse (shadows.glsl), with the
// surfaces that transmit light.
//
// The texture contains, in this order:
//    - Two texels for each child of a node: the low corner of its box, with the child's number; the high corner, with
//      twice its count of triangles, plus one if no further child follows.
//    - Six texels for each triangle, in the order of the leaves. Three contain the corners, with the twin, a kind, and
//      the position of the record of a triangle that transmits light, or 0. Three contain the unit normals of the
//      corners, with the corners' elements.
//    - A number for each triangle of the frame: its position in that order.
//    - The data of surfaces that transmit light.
#include "fail.h"
#include "gl_device.h"
#include "layer_kinds.h"
#include "texture_levels.h"

#include <string.h>

// --- stores the data with which a shader computes the light that passes through a masked, translucent or
// transmitting triangle (passed_surface in shadows.glsl). These data are the record of the triangle, the records of the
// triangle's materials, and the materials' maps at level 0. The data follow the hierarchy in the same texture.

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

// Returns the position of the record of triangle `number` of the frame, or 0 if the triangle transmits no light.
static size_t surfaces_record(const struct gl_frame *f, uint32_t number)
{
    int range = frame_range_of(f->frame, number);
    size_t first = f->frame->passes_rays ? ((const size_t *)f->device->surfaces.records.data)[range] : 0;
    const struct frame_draw_range *r = &f->frame->ranges[range];
    return first ? first + record_size(f->frame, r) * (number - r->first_id) : 0;
}

// Counts the texels of the surfaces that transmit light, after the texel `first` of a texture that has `most` texels.
// Sets *same to true if the texels and the hierarchy are the same as in the last packing, otherwise to false. Fails
// with LAM_LIMIT.
static bool surfaces_count(struct gl_frame *f, size_t first, size_t most, size_t *count, bool *same, lam_error *error)
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

// Writes these texels to `out`, which must be zeroed. Call surfaces_count first.
static void surfaces_pack(struct gl_frame *f, size_t first, float *out)
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

enum { WIDTH = GLSL_LIST_WIDTH, TEXEL = 4 * sizeof(float), NODE = 2 * NODE_CHILDREN, TRIANGLE = 6, STACK = 64 };
enum { TEXELS_MAX = 1 << 24 };               // floats represent integers up to this limit exactly
enum { KIND_FLAT, KIND_CURVED, KIND_APART }; // APART: casts no shadow and blocks no ray

static int children_of(const struct ray_node *node)
{
    int count = 0;
    while (count < NODE_CHILDREN && node->planes[0][0][count] <= node->planes[1][0][count])
        count++;
    return count;
}

// Returns the number of nodes between the root and the deepest leaf.
static int depth_of(const struct hierarchy *h)
{
    struct {
        uint32_t node;
        int depth;
    } stack[NODE_CHILDREN * HIERARCHY_DEPTH] = {{0, 1}};
    int deepest = 0;
    for (int waiting = 1; waiting;) {
        waiting--;
        uint32_t node = stack[waiting].node;
        int depth = stack[waiting].depth;
        deepest = depth > deepest ? depth : deepest;
        for (int i = 0; i < children_of(&h->nodes[node]); i++)
            if (!h->nodes[node].count[i]) {
                stack[waiting].node = h->nodes[node].child[i];
                stack[waiting++].depth = depth + 1;
            }
    }
    return deepest;
}

static void pack_node(float *out, const struct ray_node *node)
{
    // If nothing casts shadows, the only node contains one box, which no ray meets.
    int count = children_of(node) ? children_of(node) : 1;
    for (int i = 0; i < count; i++) {
        for (int k = 0; k < 3; k++) {
            out[8 * i + k] = node->planes[0][k][i];
            out[8 * i + 4 + k] = node->planes[1][k][i];
        }
        out[8 * i + 3] = (float)node->child[i];
        out[8 * i + 7] = (float)(2 * node->count[i] + (i == count - 1));
    }
}

static void pack_normal(float *out, const struct frame_draw *draw, uint32_t corner)
{
    const lam_mesh *mesh = draw->mesh;
    uint32_t element = mesh->normal_indices ? mesh->normal_indices[corner]
                       : mesh->indices      ? mesh->indices[corner]
                                            : corner;
    const float *n = mesh->normals + 3 * (size_t)element;
    double to[3], square = 0;
    for (int i = 0; i < 3; i++) {
        const double *row = draw->world_normal[i];
        to[i] = (row[0] * (double)n[0] + row[1] * (double)n[1]) + row[2] * (double)n[2];
        square += to[i] * to[i];
    }
    for (int i = 0; i < 3; i++)
        out[i] = square > 0 ? (float)(to[i] / __builtin_sqrt(square)) : 0;
}

static void pack_triangle(float *out, const struct gl_frame *f, const struct hierarchy *h, uint32_t number)
{
    const struct frame *frame = f->frame;
    const struct frame_draw *draw = &frame->draws[frame->ranges[frame_range_of(frame, number)].draw];
    bool casts = frame_draw_casts(draw), curved = draw->mesh->normals && casts;
    struct ray_triangle t = {0};
    if (casts)
        hierarchy_triangle(h, number, &t);
    for (uint32_t k = 0; k < 3; k++) {
        for (int i = 0; i < 3; i++)
            out[4 * k + (uint32_t)i] = t.p[k][i] * 0 == 0 ? (float)t.p[k][i] : 0;
        uint32_t corner = 3 * (number - draw->first_id) + k;
        if (curved)
            pack_normal(out + 4 * (3 + k), draw, corner);
    }
    out[3] = (float)hierarchy_twin(h, number);
    out[7] = !casts ? KIND_APART : curved ? KIND_CURVED : KIND_FLAT;
    out[11] = (float)surfaces_record(f, number);
}

// Packs all nodes and triangles. The triangles that are in no leaf follow the others; positions[number] is 1 plus a
// triangle's position until then.
static void pack_hierarchy(float *out, const struct gl_frame *f, const struct hierarchy *h, size_t triangles,
                           size_t positions)
{
    float *position = out + 4 * positions;
    uint32_t packed = 0;
    for (uint32_t n = 0; n < h->node_count; n++) {
        const struct ray_node *node = &h->nodes[n];
        pack_node(out + (size_t)4 * NODE * n, node);
        for (int child = 0; child < children_of(node); child++)
            for (uint32_t i = 0; i < node->count[child]; i++) {
                uint32_t at = node->child[child] + i;
                const float *leaf = h->leaves + LEAF_FLOATS * (size_t)node->child[child];
                position[leaf_number(leaf, node->count[child], i)] = (float)at + 1;
                packed++;
            }
    }
    for (uint32_t number = 0; number < h->triangle_count; number++) {
        uint32_t at = position[number] > 0 ? (uint32_t)position[number] - 1 : packed++;
        position[number] = (float)at;
        pack_triangle(out + 4 * (triangles + (size_t)TRIANGLE * at), f, h, number);
    }
}

bool shadows_send(struct gl_frame *f, lam_error *error)
{
    struct gl_device *device = f->device;
    const struct frame *frame = f->frame;
    const struct gl *gl = f->gl;
    bool built;
    uint64_t start = now_ns();
    const struct hierarchy *h = hierarchy_of_frame(&device->hierarchy, frame, NULL, f->call, &built, error);
    if (!h)
        return false;
    if (built)
        device->shadows_sent = false; // the texture does not contain this hierarchy
    device->base.report.hierarchy_ms += built ? (double)(now_ns() - start) * 1e-6 : 0;
    if (f->stage == LAM_STAGE_APPLICATION && !glsl_output_is_geometry(frame->settings.output)) // no shader traverses
                                                                                               // the hierarchy
        return true;
    // Triangle indices are stored as floats and must fit the texels of a texture.
    size_t triangles = (size_t)NODE * h->node_count, positions = triangles + (size_t)TRIANGLE * (h->triangle_count + 1);
    size_t surfaces = positions + h->triangle_count / 4 + 1, surface_texels = 0;
    size_t most = (size_t)device->texture_size_max * WIDTH;
    most = most < TEXELS_MAX ? most : TEXELS_MAX;
    if (surfaces > most)
        return fail(error, LAM_LIMIT,
                    "OpenGL: the hierarchy of %u triangles needs a texture of %zu texels, this device can have %zu; "
                    "the CPU device has no such limit",
                    h->triangle_count, surfaces, most);
    device->shadow_offsets[0] = (float)triangles;
    device->shadow_offsets[1] = (float)positions;
    bool same;
    if (!surfaces_count(f, surfaces, most, &surface_texels, &same, error))
        return false;
    if (device->shadows_sent && same)
        return true;
    device->shadows_sent = false;
    if (depth_of(h) > STACK)
        return fail(error, LAM_LIMIT, "OpenGL: the hierarchy is %d nodes deep, but shaders can traverse at most %d",
                    depth_of(h), STACK);
    size_t rows = (surfaces + surface_texels + WIDTH - 1) / WIDTH, bytes = rows * WIDTH * TEXEL;
    if (!gl_charge(f, &device->shadow_bytes, bytes, error) || !buffer_reserve(&device->scratch, bytes, f->call, error))
        return false;
    float *out = device->scratch.data;
    memset(out, 0, bytes);
    pack_hierarchy(out, f, h, triangles, positions);
    surfaces_pack(f, surfaces, out + 4 * surfaces);
    gl_edit_plain_texture(device, UNIT_SHADOW_TREE, GL_TEXTURE_2D, &device->shadow_texture);
    gl->TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, WIDTH, (GLsizei)rows, 0, GL_RGBA, GL_FLOAT, out);
    device->shadows_sent = true;
    device->base.report.bytes_uploaded += bytes;
    return true;
}

void shadows_use(struct gl_frame *f, struct gl_program *program)
{
    const struct hierarchy *h = &f->device->hierarchy.hierarchy;
    float matrix[16] = {0},
          offsets[4] = {f->device->shadow_offsets[0], f->device->shadow_offsets[1],
                        f->frame->settings.flat_terminator ? 0 : 1, (float)f->frame->settings.shadow_samples};
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++)
            matrix[4 * j + i] = (float)(f->frame->eye_to_world[i][j] * h->scale);
        matrix[12 + i] = (float)((f->frame->eye_to_world[i][3] - h->centre[i]) * h->scale);
    }
    matrix[15] = 1;
    gl_use_texture(f->device, UNIT_SHADOW_TREE, GL_TEXTURE_2D, f->device->shadow_texture);
    program_set(f, program, UNIFORM_SHADOW_MATRIX, matrix, 16);
    program_set(f, program, UNIFORM_SHADOW_OFFSETS, offsets, 4);
    float rounding[4] = {(float)h->rounding[0], (float)h->rounding[1], (float)h->rounding[2], (float)h->scale};
    program_set(f, program, UNIFORM_SHADOW_ROUNDING, rounding, 4);
}

void shadows_free(struct gl_device *device)
{
    if (device->shadow_texture)
        device->context.gl.DeleteTextures(1, &device->shadow_texture);
    hierarchy_free(&device->hierarchy);
}
