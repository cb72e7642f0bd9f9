// opacity.c: the opacity of a point of a triangle, from its material, its vertices' alphas and its maps.
#include "opacity.h"

#include "texture_map.h"

static uint32_t element_of(const uint32_t *own, const uint32_t *shared, uint32_t corner)
{
    return own ? own[corner] : shared ? shared[corner] : corner;
}

static float at_weights(const float v[3], float b1, float b2)
{
    return v[0] + ((v[1] - v[0]) * b1 + (v[2] - v[0]) * b2);
}

static float saturated(float x) { return x > 0 ? x < 1 ? x : 1 : 0; }

static float vertex_alpha(const lam_mesh *mesh, uint32_t triangle, float b1, float b2)
{
    float alpha[3];
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t element = mesh->colors_rate == LAM_PER_TRIANGLE
                               ? triangle
                               : element_of(mesh->color_indices, mesh->indices, 3 * triangle + k);
        size_t at = 4 * (size_t)element + 3;
        alpha[k] = mesh->colors_format == LAM_COLORS_LINEAR_F32
                       ? ((const float *)mesh->colors)[at]
                       : (float)((double)((const uint8_t *)mesh->colors)[at] / 255.0);
    }
    return at_weights(alpha, b1, b2);
}

// A channel of a map at level 0; 1 where the mesh has no texture coordinates for it.
static float map_value(const lam_mesh *mesh, const lam_texture_map *map, int channel, uint32_t triangle, float b1,
                       float b2)
{
    const float *from = map->texcoords ? mesh->second_texcoords : mesh->texcoords;
    const uint32_t *own = map->texcoords ? mesh->second_texcoord_indices : mesh->texcoord_indices;
    float s[3], t[3], value = 1;
    if (from) {
        for (uint32_t k = 0; k < 3; k++) {
            const float *at = from + 2 * (size_t)element_of(own, mesh->indices, 3 * triangle + k);
            s[k] = at[0];
            t[k] = at[1];
        }
        value = texture_map_base(map, at_weights(s, b1, b2), at_weights(t, b1, b2))[channel];
    }
    return value * (map->scale != 0 ? map->scale : 1) + map->offset;
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
        saturated(material->diffuse.a * (draw->mesh->colors ? vertex_alpha(draw->mesh, triangle, b1, b2) : 1));
    const lam_texture_map *diffuse = material->maps[LAM_MAP_DIFFUSE], *opacity = material->maps[LAM_MAP_OPACITY];
    if (diffuse && diffuse->texture)
        alpha = saturated(alpha * map_value(draw->mesh, diffuse, 3, triangle, b1, b2));
    if (opacity && opacity->texture)
        alpha = saturated(alpha * map_value(draw->mesh, opacity, opacity->channel, triangle, b1, b2));
    return material->alpha_mode == LAM_ALPHA_MASK ? alpha >= material->alpha_cutoff : alpha;
}
