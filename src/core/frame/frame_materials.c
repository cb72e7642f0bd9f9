// frame_materials.c: selects the reflection model of each material, and converts classic or physical materials if the
// model needs the other kind.
#define LANES 1
#include "lighting.h"

#include "fields.h"
#include "frame.h"
#include "texture_map.h"

const lam_map frame_lod_maps[LOD_MAPS] = {LAM_MAP_DIFFUSE,   LAM_MAP_ROUGHNESS, LAM_MAP_METALLIC,
                                          LAM_MAP_OCCLUSION, LAM_MAP_EMISSION,  LAM_MAP_AMBIENT,
                                          LAM_MAP_SPECULAR,  LAM_MAP_SHININESS, LAM_MAP_OPACITY};

bool frame_is_physical(lam_reflection model) { return lobe_properties((int)model) & LOBE_MICROFACET; }

float frame_exponent_share(lam_reflection model) { return lobe_properties((int)model) & LOBE_MIRRORED ? 0.25f : 1.0f; }

lam_reflection frame_reflection(const struct frame *frame, const lam_material *material)
{
    if (frame->settings.reflection != LAM_REFLECTION_AUTO)
        return frame->settings.reflection;
    if (material->unlit)
        return LAM_REFLECTION_NONE;
    return material->physical || frame->lights_classic ? LAM_REFLECTION_GGX : LAM_REFLECTION_BLINN_PHONG;
}

// Returns whether a model can be used with this kind of material. LAM_REFLECTION_NONE shows the diffuse colour of both
// kinds.
static bool fits(const lam_material *material, lam_reflection model)
{
    return model == LAM_REFLECTION_NONE || material->physical == frame_is_physical(model);
}

static lam_material converted(const lam_material *material, lam_reflection model)
{
    if (frame_is_physical(model))
        return lam_material_as_physical(material);
    lam_material classic = lam_material_as_classic(material);
    classic.shininess *= frame_exponent_share(model);
    return classic;
}

// Returns whether lam_draw_params.glass applies to a material.
static bool is_pane(const struct frame *frame, const lam_material *m)
{
    static const char *const words[] = {"glass", "window", "windscreen", "windshield"};
    if (frame->settings.glass != LAM_GLASS_AUTO || !m->name || !frame_is_physical(frame_reflection(frame, m)) ||
        m->alpha_mode != LAM_ALPHA_BLEND || !(m->diffuse.a > 0 && m->diffuse.a <= 0.6f) || m->transmission > 0 ||
        m->maps[LAM_MAP_DIFFUSE] || m->maps[LAM_MAP_OPACITY])
        return false;
    for (const char *at = m->name; *at; at++)
        for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
            size_t k = 0;
            while (words[i][k] && (at[k] | 0x20) == words[i][k])
                k++;
            if (!words[i][k])
                return true;
        }
    return false;
}

static lam_material pane_of(lam_material m)
{
    float *base = &m.diffuse.r;
    for (int c = 0; c < 3; c++)
        base[c] = 1 - m.diffuse.a * (1 - base[c]);
    m.diffuse.a = 1;
    m.transmission = 1;
    m.metallic = 0;
    m.roughness = m.roughness < 0.1f ? m.roughness : 0.1f;
    return m;
}

size_t frame_materials_to_convert(const struct frame *frame, const lam_scene *scene)
{
    size_t count = 0;
    bool physical = scene->default_material->physical, mixed = false;
    for (int i = -1; i < scene->materials.count; i++) {
        const lam_material *material = i < 0 ? scene->default_material : lam_scene_material(scene, i);
        count += !fits(material, frame_reflection(frame, material)) || is_pane(frame, material);
        mixed |= material->physical != physical;
    }
    // Each material may also need a converted copy for unlit lines, or for the back of an object whose front has the
    // other kind.
    for (int i = 0; i < scene->meshes.count; i++)
        if (mesh_is_strokes(scene_mesh(scene, i)) && !scene_mesh(scene, i)->normals) {
            count += 2 * ((size_t)scene->materials.count + 1);
            break;
        }
    return count +
           (mixed && frame->settings.reflection == LAM_REFLECTION_AUTO ? (size_t)scene->materials.count + 1 : 0);
}

void frame_materials_build(struct frame *frame, const lam_scene *scene)
{
    frame->default_material = *scene->default_material;
    frame->scene_material_count = frame->material_count = scene->materials.count + 1;
    frame->converted_count = frame->panes = 0;
    for (int i = 0; i < frame->material_count; i++) {
        const lam_material *material = i ? lam_scene_material(scene, i - 1) : &frame->default_material;
        lam_reflection model = frame_reflection(frame, material);
        const bool fit = fits(material, model), pane = is_pane(frame, material);
        frame->materials[i] = material;
        if (fit && !pane)
            continue;
        lam_material *own = &frame->converted[frame->converted_count++];
        *own = fit ? *material : converted(material, model);
        *own = pane ? pane_of(*own) : *own;
        frame->panes += pane;
        frame->materials[i] = own;
    }
}

// Repeats the list of materials, so that it contains each material `times` times.
static void repeat_materials(struct frame *frame, int times)
{
    for (; frame->material_count < times * frame->scene_material_count; frame->material_count++)
        frame->materials[frame->material_count] = frame->materials[frame->material_count % frame->scene_material_count];
}

int frame_back_material(struct frame *frame, int front, int back)
{
    const lam_material *material = frame->materials[back];
    lam_reflection model = frame_reflection(frame, frame->materials[front]);
    if (fits(material, model))
        return back;
    int second = frame->scene_material_count + back;
    repeat_materials(frame, 2);
    if (frame->materials[second] == material) {
        frame->converted[frame->converted_count] = converted(material, model);
        frame->materials[second] = &frame->converted[frame->converted_count++];
    }
    return second;
}

// Returns whether the colour of a material is the default colour of the scene, or of glTF primitives without a
// material.
static bool is_unchosen(const struct frame *frame, int front)
{
    const lam_material *m = frame->materials[front];
    const lam_rgba plain = front == 0 ? lam_material_default().diffuse : (lam_rgba){1, 1, 1, 1};
    return !m->name && m->diffuse.r == plain.r && m->diffuse.g == plain.g && m->diffuse.b == plain.b &&
           (front == 0 || (m->physical && m->metallic == 1 && m->roughness == 1 && !m->maps[LAM_MAP_DIFFUSE]));
}

// A grey that is visible on white and on black pages: sRGB 124.
static const lam_rgba visible_grey = {0.2f, 0.2f, 0.2f, 1};

static bool is_dark(const lam_rgba *background)
{
    return background->a > 0.5f && 0.2126f * background->r + 0.7152f * background->g + 0.0722f * background->b < 0.1f;
}

int frame_stroke_material(struct frame *frame, int front, bool colored)
{
    const lam_material *material = frame->materials[front];
    bool grey = !colored && is_unchosen(frame, front) && !is_dark(&frame->settings.background);
    if (!grey && material->emission.r == 0 && material->emission.g == 0 && material->emission.b == 0)
        return front;
    int copy = (grey ? 3 : 2) * frame->scene_material_count + front;
    repeat_materials(frame, grey ? 4 : 3);
    if (frame->materials[copy] == material) {
        lam_material *unlit = &frame->converted[frame->converted_count++];
        *unlit = *material;
        if (grey)
            unlit->diffuse = visible_grey;
        unlit->diffuse.r += material->emission.r;
        unlit->diffuse.g += material->emission.g;
        unlit->diffuse.b += material->emission.b;
        unlit->emission = (lam_rgb){0, 0, 0};
        frame->materials[copy] = unlit;
    }
    return copy;
}

unsigned frame_maps(const struct frame *frame, const lam_material *material)
{
    unsigned maps = 0, drawn = ~(1u << LAM_MAP_DISPLACEMENT | 1u << LAM_MAP_REFLECTION);
    if (frame->settings.shading != LAM_SHADING_PHONG)
        drawn = 1u << LAM_MAP_DIFFUSE | 1u << LAM_MAP_OPACITY | 1u << LAM_MAP_EMISSION;
    for (int i = 0; i < LAM_MAP_COUNT; i++)
        if (material->maps[i] && (!map_layer((lam_map)i) || map_layer((lam_map)i) & frame_layers(frame, material)))
            maps |= 1u << i;
    return maps & drawn;
}

struct texture_sampler frame_map_sampler(const struct frame *frame, const lam_material *material,
                                         const lam_texture_map *map)
{
    static const lam_map sharp[] = {LAM_MAP_DIFFUSE, LAM_MAP_SPECULAR, LAM_MAP_EMISSION, LAM_MAP_NORMAL, LAM_MAP_BUMP};
    const lam_draw_params *settings = &frame->settings;
    const lam_filter filter = settings->map_filter == LAM_MAP_FILTER_NEAREST ? LAM_FILTER_NEAREST : LAM_FILTER_LINEAR;
    struct texture_sampler sampler = {
        filter, filter, settings->map_filter == LAM_MAP_FILTER_TRILINEAR ? LAM_MIP_LINEAR : LAM_MIP_NONE, 1};
    if (settings->map_filter == LAM_MAP_FILTER_FILE)
        sampler = texture_map_sampler(map);
    if (settings->anisotropy)
        sampler.probes = settings->anisotropy;
    else if (sampler.minify == LAM_FILTER_LINEAR && sampler.mip != LAM_MIP_NONE)
        for (size_t i = 0; i < sizeof sharp / sizeof *sharp; i++)
            if (material->maps[sharp[i]] && texture_map_same(material->maps[sharp[i]], map))
                sampler.probes = 8;
    return sampler;
}

bool frame_converts_at_points(const struct frame *frame, const lam_material *material)
{
    bool converted =
        !material->physical && material >= frame->converted && material < frame->converted + frame->converted_count;
    return converted && frame->settings.shading == LAM_SHADING_PHONG && frame_maps(frame, material);
}

void frame_material_colors(const struct frame *frame, const lam_material *material, float kd[3], float ks[3])
{
    bool converts = frame_converts_at_points(frame, material);
    bool varies = converts || frame_maps(frame, material) >> LAM_MAP_METALLIC & 1;
    const float *diffuse = converts ? &material->ambient.r : &material->diffuse.r, *specular = &material->specular.r;
    for (int i = 0; i < 3; i++) {
        kd[i] = material->physical && !varies ? diffuse[i] * (1 - material->metallic) : diffuse[i];
        ks[i] = material->physical || varies ? 1 : specular[i];
    }
}

const float *frame_sky_color(const struct frame *frame, const struct frame_hemisphere *h, const lam_material *material)
{
    bool by_diffuse = h->source->by_diffuse && !material->physical && !frame_converts_at_points(frame, material);
    return by_diffuse ? &material->diffuse.r : &material->ambient.r;
}

bool frame_reflects_environment(const struct frame *frame, const lam_material *material)
{
    return frame->environment && !material->physical &&
           (material->reflectivity.r != 0 || material->reflectivity.g != 0 || material->reflectivity.b != 0);
}

int frame_layers(const struct frame *frame, const lam_material *material)
{
    int set = material_layers(material);
    return frame->settings.shading == LAM_SHADING_PHONG ? set : set & ~(LAYER_TRANSMISSION | LAYER_VOLUME);
}

float frame_lobe_max(const lam_material *material)
{
    if (!material->physical)
        return 1;
    if (material->maps[LAM_MAP_ROUGHNESS] || material_layers(material))
        return 1.25f / (ROUGHNESS_MIN * ROUGHNESS_MIN * ROUGHNESS_MIN * ROUGHNESS_MIN * ROUGHNESS_MIN * ROUGHNESS_MIN);
    // The strength S of the microfacet lobe is at most 1 / (2 α³), and multiple scattering multiplies it by less than
    // 2.5.
    float roughness = material->roughness > ROUGHNESS_MIN ? material->roughness : ROUGHNESS_MIN;
    float alpha = roughness * roughness;
    return 1.25f / (alpha * alpha * alpha);
}

float frame_shininess(const struct frame *frame, const lam_material *material)
{
    float shininess = material->shininess;
    if (frame->settings.match_highlights && lobe_properties((int)frame_reflection(frame, material)) & LOBE_HALFWAY)
        shininess *= 4;
    return frame->settings.gl1 && shininess > 128 ? 128 : shininess;
}
