// products.c: computes the products of materials and lights, once per frame.
#define LANES 1
#include "lighting.h"

#include "shade_frame.h"

#include "environment.h"

#include "fail.h"
#include "fields.h"
#include "linear.h"
#include "texture_map.h"

#include <string.h>

static void product(float out[3], const float *a, const float *b)
{
    for (int i = 0; i < 3; i++)
        out[i] = a[i] * b[i];
}

static void multiply_material(struct material_products *out, const lam_material *material, const struct frame *frame)
{
    product(out->ambient, &material->ambient.r, frame->ambient);
    memcpy(out->emission, &material->emission, sizeof out->emission);
    memcpy(out->diffuse, &material->diffuse, sizeof out->diffuse);
    out->given = material;
    out->maps = frame_maps(frame, material);
    out->converted = frame_converts_at_points(frame, material);
    out->shininess = frame_shininess(frame, material);
    out->layers = frame_layers(frame, material);
    out->stretch[0] = (float)math_cos((double)material->anisotropy_rotation_rad);
    out->stretch[1] = (float)math_sin((double)material->anisotropy_rotation_rad);
    memcpy(out->reflectivity, &material->reflectivity, sizeof out->reflectivity);
    out->mirrors = frame_reflects_environment(frame, material);
}

struct material_products *products_make(struct buffer *storage, const struct frame *frame, struct call_control *call,
                                        lam_error *error)
{
    size_t materials = (size_t)frame->material_count, lights = (size_t)frame->light_count;
    size_t skies = (size_t)frame->hemisphere_count,
           each = lights * sizeof(struct light_products) + skies * 6 * sizeof(float);
    size_t bytes;
    if (__builtin_mul_overflow(materials, each + sizeof(struct material_products), &bytes))
        return fail(error, LAM_LIMIT, "%zu materials under %zu lights are too many", materials, lights), NULL;
    if (!buffer_reserve(storage, bytes, call, error))
        return NULL;
    struct material_products *products = storage->data;
    char *at = (char *)(products + materials);
    for (size_t m = 0; m < materials; m++) {
        const lam_material *material = frame->materials[m];
        struct material_products *out = &products[m];
        multiply_material(out, material, frame);
        struct light_products *list = (struct light_products *)at;
        at += lights * sizeof *list;
        const float *kd = out->kd, *ks = out->ks;
        frame_material_colors(frame, material, out->kd, out->ks);
        for (size_t i = 0; i < lights; i++) {
            product(list[i].diffuse, kd, frame->lights[i].diffuse);
            product(list[i].specular, ks, frame->lights[i].specular);
            product(list[i].ambient, &material->ambient.r, frame->lights[i].ambient);
        }
        out->lights = list;
        out->sky = (float(*)[3])at;
        out->ground = out->sky + skies;
        at += skies * 6 * sizeof(float);
        for (size_t i = 0; i < skies; i++) {
            const float *color = frame_sky_color(frame, &frame->hemispheres[i], material);
            product(out->sky[i], color, frame->hemispheres[i].sky);
            product(out->ground[i], color, frame->hemispheres[i].ground);
        }
    }
    return products;
}

// Returns the levels of the prefiltered environment that a roughness needs. The roughness is the material's value,
// multiplied by a map if there is one. A mesh without texture coordinates uses no map. `widens` is true if the variance
// of normals increases the roughness.
static unsigned parts_of_number(const struct material_products *m, lam_map slot, float factor, bool stretched,
                                bool widens)
{
    const float margin = 1e-4f; // allows for the rounding of filtered texels
    float low = factor, high = factor;
    if (m->maps >> slot & 1) {
        float range[2];
        texture_map_range(m->given->maps[slot], range);
        low = factor * range[0] < low ? factor * range[0] : low;
        high = factor * range[1] > high ? factor * range[1] : high;
    }
    if (widens)
        high = widened_roughness(high > 1 ? 1 : high, 1);
    return environment_light_parts(prefilter_level(low - margin), prefilter_level(stretched ? 1 : high + margin));
}

unsigned environment_parts_of(const struct shade_frame *shade)
{
    unsigned parts = 0;
    const bool widens = shade->frame->widens_highlights;
    for (int i = 0; i < shade->frame->material_count; i++) {
        const struct material_products *m = &shade->materials[i];
        const lam_material *given = m->given;
        if (!given->physical)
            continue;
        parts |= parts_of_number(m, LAM_MAP_ROUGHNESS, given->roughness, m->layers & LAYER_ANISOTROPY, widens);
        if (m->layers & LAYER_CLEARCOAT)
            parts |= parts_of_number(m, LAM_MAP_CLEARCOAT_ROUGHNESS, given->clearcoat_roughness, false, widens);
    }
    return parts;
}
