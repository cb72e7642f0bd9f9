// opacity.c: computes the opacity of a point on a triangle, and the light that passes through this point, from the
// triangle's material, vertex colours and maps.
#include "rays.h"

#include "layer_kinds.h"
#include "srgb.h"
#include "texture_map.h"

#include <string.h>

static float at_weights(const float v[3], float b1, float b2)
{
    return v[0] + ((v[1] - v[0]) * b1 + (v[2] - v[0]) * b2);
}

static float saturated(float x) { return x > 0 ? x < 1 ? x : 1 : 0; }

static float corner_channel(const lam_mesh *mesh, uint32_t corner, int channel)
{
    uint32_t element =
        mesh->colors_rate == LAM_PER_TRIANGLE ? corner / 3 : mesh_element(mesh->color_indices, mesh, corner);
    size_t at = 4 * (size_t)element + (size_t)channel;
    if (mesh->colors_format == LAM_COLORS_LINEAR_F32)
        return ((const float *)mesh->colors)[at];
    double encoded = (double)((const uint8_t *)mesh->colors)[at] / 255.0;
    return (float)(channel < 3 ? srgb_linear(encoded) : encoded);
}

void ray_corner_color(const lam_mesh *mesh, uint32_t corner, float out[4])
{
    for (int channel = 0; channel < 4; channel++)
        out[channel] = corner_channel(mesh, corner, channel);
}

bool ray_corner_texcoord(const lam_mesh *mesh, int set, uint32_t corner, float out[2])
{
    const float *from = set ? mesh->second_texcoords : mesh->texcoords;
    const uint32_t *own = set ? mesh->second_texcoord_indices : mesh->texcoord_indices;
    if (from)
        memcpy(out, from + 2 * (size_t)mesh_element(own, mesh, corner), 2 * sizeof *out);
    return from != NULL;
}

// Returns a channel of the colours of a triangle's vertices.
static float vertex_color(const lam_mesh *mesh, uint32_t triangle, int channel, float b1, float b2)
{
    float value[3];
    for (uint32_t k = 0; k < 3; k++)
        value[k] = corner_channel(mesh, 3 * triangle + k, channel);
    return at_weights(value, b1, b2);
}

// Returns the texel of a map at level 0, or 1 if the mesh lacks texture coordinates for the map.
static texel map_texel(const lam_mesh *mesh, const lam_texture_map *map, uint32_t triangle, float b1, float b2)
{
    float at[2], s[3], t[3];
    texel value = {1, 1, 1, 1};
    uint32_t k = 0;
    for (; k < 3 && ray_corner_texcoord(mesh, map->texcoords, 3 * triangle + k, at); k++) {
        s[k] = at[0];
        t[k] = at[1];
    }
    if (k == 3)
        value = texture_map_base(map, at_weights(s, b1, b2), at_weights(t, b1, b2));
    return value * (map->scale != 0 ? map->scale : 1) + map->offset;
}

// Returns a channel of the texel of a map at level 0, or 1 if the mesh lacks texture coordinates for the map.
static float map_value(const lam_mesh *mesh, const lam_texture_map *map, int channel, uint32_t triangle, float b1,
                       float b2)
{
    return map_texel(mesh, map, triangle, b1, b2)[channel];
}

float ray_opacity(const struct frame *frame, uint32_t number, bool back, float b1, float b2)
{
    const struct frame_draw_range *range = &frame->ranges[frame_range_of(frame, number)];
    const struct frame_draw *draw = &frame->draws[range->draw];
    const lam_material *material = frame->materials[back && !draw->one_sided ? range->back : range->front];
    if (!range->passes_rays || material->alpha_mode == LAM_ALPHA_OPAQUE)
        return 1;
    uint32_t triangle = number - draw->first_id;
    float alpha =
        saturated(material->diffuse.a * (draw->mesh->colors ? vertex_color(draw->mesh, triangle, 3, b1, b2) : 1));
    const lam_texture_map *diffuse = material->maps[LAM_MAP_DIFFUSE], *opacity = material->maps[LAM_MAP_OPACITY];
    if (diffuse && diffuse->texture)
        alpha = saturated(alpha * map_value(draw->mesh, diffuse, 3, triangle, b1, b2));
    if (opacity && opacity->texture)
        alpha = saturated(alpha * map_value(draw->mesh, opacity, opacity->channel, triangle, b1, b2));
    return material->alpha_mode == LAM_ALPHA_MASK ? alpha >= material->alpha_cutoff : alpha;
}

bool ray_share_is_constant(const struct frame *frame, uint32_t number, bool back)
{
    const struct frame_draw_range *range = &frame->ranges[frame_range_of(frame, number)];
    const struct frame_draw *draw = &frame->draws[range->draw];
    const lam_texture_map *const *maps = frame->materials[back && !draw->one_sided ? range->back : range->front]->maps;
    return !draw->mesh->colors && !maps[LAM_MAP_DIFFUSE] && !maps[LAM_MAP_OPACITY] && !maps[LAM_MAP_METALLIC] &&
           !maps[LAM_MAP_TRANSMISSION];
}

bool ray_leaves_volume(const struct frame *frame, uint32_t number, bool back)
{
    const struct frame_draw_range *range = &frame->ranges[frame_range_of(frame, number)];
    const lam_material *material = frame->materials[frame->draws[range->draw].one_sided ? range->front : range->back];
    return back && material->thickness > 0 && frame_is_physical(range->reflection) &&
           frame_layers(frame, material) & LAYER_TRANSMISSION && material->alpha_mode != LAM_ALPHA_MASK;
}

void ray_transmittance(const struct frame *frame, uint32_t number, bool back, float b1, float b2, float out[3])
{
    const struct frame_draw_range *range = &frame->ranges[frame_range_of(frame, number)];
    const struct frame_draw *draw = &frame->draws[range->draw];
    const lam_material *material = frame->materials[back && !draw->one_sided ? range->back : range->front];
    float opacity = ray_opacity(frame, number, back, b1, b2);
    out[0] = out[1] = out[2] = 1 - opacity;
    if (!frame_is_physical(range->reflection) || !(frame_layers(frame, material) & LAYER_TRANSMISSION) ||
        material->alpha_mode == LAM_ALPHA_MASK)
        return;
    if (ray_leaves_volume(frame, number, back)) {
        out[0] = out[1] = out[2] = 1;
        return;
    }
    uint32_t triangle = number - draw->first_id;
    const lam_texture_map *const *maps = material->maps;
    const lam_texture_map *metallic = maps[LAM_MAP_METALLIC], *transmission = maps[LAM_MAP_TRANSMISSION];
    float through = opacity * material->transmission, metal = material->metallic;
    if (transmission && transmission->texture)
        through *= saturated(map_value(draw->mesh, transmission, transmission->channel, triangle, b1, b2));
    if (metallic && metallic->texture)
        metal *= saturated(map_value(draw->mesh, metallic, metallic->channel, triangle, b1, b2));
    through *= 1 - metal;
    texel colors = {1, 1, 1, 1};
    if (maps[LAM_MAP_DIFFUSE] && maps[LAM_MAP_DIFFUSE]->texture)
        colors = map_texel(draw->mesh, maps[LAM_MAP_DIFFUSE], triangle, b1, b2);
    const float base[3] = {material->diffuse.r, material->diffuse.g, material->diffuse.b};
    for (int c = 0; c < 3; c++) {
        float color = base[c] * (draw->mesh->colors ? vertex_color(draw->mesh, triangle, c, b1, b2) : 1);
        if (maps[LAM_MAP_DIFFUSE] && maps[LAM_MAP_DIFFUSE]->texture)
            color *= colors[c];
        out[c] += through * saturated(color);
    }
}
