// frame_ranges.c: divides a draw into ranges of triangles with the same materials, and determines whether light passes
// through the triangles.
#include "frame.h"

#include "frame_strokes.h"
#include "layer_kinds.h"

static int material_index(int scene_index) { return scene_index < 0 ? 0 : scene_index + 1; }

// Returns whether a material has translucent or masked points. `varies` means that the mesh's colours contain alpha
// values.
static bool sees_through(const lam_material *material, bool varies)
{
    varies |= material->maps[LAM_MAP_OPACITY] || texture_map_translucent(material->maps[LAM_MAP_DIFFUSE]);
    varies |= material->diffuse.a < 1 || (material->alpha_mode == LAM_ALPHA_MASK && material->alpha_cutoff > 1);
    return material->alpha_mode != LAM_ALPHA_OPAQUE && varies;
}

// Returns whether a material transmits light.
static bool transmits(const struct frame *frame, int material, lam_reflection model)
{
    return frame_is_physical(model) && frame_layers(frame, frame->materials[material]) & LAYER_TRANSMISSION;
}

// Returns whether a material that transmits light blurs or refracts the picture behind it. A material with an index of
// refraction of 1 (air) or 0 (which admits no light) does neither.
static bool refracts(const lam_material *m) { return m->ior > 1 && (m->roughness > 0 || m->thickness > 0); }

// Returns whether light passes through a material unchanged at every point and on both sides (src/effects/rays/opacity.h).
static bool is_clear(const struct frame *frame, const lam_mesh *mesh, int material, lam_reflection model)
{
    const lam_material *m = frame->materials[material];
    const lam_map used[] = {LAM_MAP_DIFFUSE, LAM_MAP_OPACITY, LAM_MAP_METALLIC, LAM_MAP_TRANSMISSION};
    for (size_t i = 0; i < sizeof used / sizeof *used; i++)
        if (m->maps[used[i]])
            return false;
    bool whole = m->alpha_mode == LAM_ALPHA_OPAQUE || (m->alpha_mode == LAM_ALPHA_BLEND && m->diffuse.a >= 1);
    return whole && !mesh->colors && transmits(frame, material, model) && m->transmission >= 1 && m->metallic <= 0 &&
           m->diffuse.r >= 1 && m->diffuse.g >= 1 && m->diffuse.b >= 1;
}

// Traits: the effects of one side of a range on light that passes through. A range combines the traits of its two
// sides.
enum side_trait { SIDE_DIMS = 1, SIDE_TRANSMITS = 2, SIDE_REFRACTS = 4, SIDE_SEEN_THROUGH = 8, SIDE_MASKED = 16 };

// Returns the traits of a side with this material. `varies` has the same meaning as in sees_through.
static unsigned side_traits(const struct frame *frame, const lam_mesh *mesh, int material, lam_reflection model,
                            bool varies)
{
    const lam_material *m = frame->materials[material];
    unsigned traits = is_clear(frame, mesh, material, model) ? 0 : SIDE_DIMS;
    if (transmits(frame, material, model))
        traits |= SIDE_TRANSMITS | (refracts(m) ? SIDE_REFRACTS : 0);
    if (sees_through(m, varies))
        traits |= SIDE_SEEN_THROUGH;
    return traits | (m->alpha_mode == LAM_ALPHA_MASK ? SIDE_MASKED : 0);
}

// Adds a range to the frame, and sets the properties that follow from the traits of its sides.
static void add_range(struct frame *frame, struct frame_draw_range range, unsigned traits)
{
    lam_output output = frame->settings.output;
    const bool traced = frame->settings.bounces > 1; // paths go through glass, so the picture behind it is not needed
    const bool shows = !output_is_value(output), masked = traits & SIDE_MASKED;
    range.passes_rays = traits & (SIDE_SEEN_THROUGH | SIDE_TRANSMITS);
    range.transmits = shows && !traced && traits & SIDE_TRANSMITS;
    // Pictures of surface properties contain no translucent triangles, only masked triangles. Overdraw also counts
    // masked points.
    range.translucent = (traced ? traits & SIDE_SEEN_THROUGH : range.passes_rays) &&
                        (shows || (masked && output != LAM_OUTPUT_OVERDRAW));
    frame->transmits |= range.transmits;
    frame->refracts |= range.transmits && traits & SIDE_REFRACTS;
    frame->translucent |= range.translucent;
    frame->passes_rays |= range.passes_rays;
    frame->tints_rays |= (traits & SIDE_TRANSMITS) != 0;
    frame->masked |= range.translucent && masked;
    frame->ranges[frame->range_count++] = range;
}

void frame_ranges_build(struct frame *frame, const lam_scene *scene, int draw_index)
{
    struct frame_draw *draw = &frame->draws[draw_index];
    draw->clear = !draw->strokes && frame->settings.bounces < 2;
    const lam_object *object = scene_object(scene, draw->object);
    const lam_mesh *mesh = draw->mesh;
    lam_part all = {.triangle_count = mesh->triangle_count, .material = -1};
    uint32_t parts = mesh->part_count ? mesh->part_count : 1;
    for (uint32_t i = 0; i < parts; i++) {
        const lam_part *part = mesh->part_count ? &mesh->parts[i] : &all;
        if (!part->triangle_count)
            continue;
        int front = material_index(object->material >= 0 ? object->material : part->material);
        int back = object->back_material >= 0 && !draw->strokes
                       ? frame_back_material(frame, front, material_index(object->back_material))
                       : front;
        struct frame_draw_range *last = frame->range_count ? &frame->ranges[frame->range_count - 1] : NULL;
        if (last && last->draw == draw_index && last->front == front && last->back == back) {
            last->count += part->triangle_count;
            continue;
        }
        lam_reflection reflection = frame_reflection(frame, frame->materials[front]);
        if (draw->strokes) {
            if (!mesh->normals) { // unlit
                reflection = LAM_REFLECTION_NONE;
                front = frame_stroke_material(frame, front, mesh->colors != NULL);
            }
            back = front;
        }
        bool varies = scene_extent(scene, object->mesh)->translucent;
        unsigned traits = side_traits(frame, mesh, front, reflection, varies);
        if (!draw->one_sided)
            traits |= side_traits(frame, mesh, back, reflection, varies);
        draw->clear = draw->clear && !(traits & SIDE_DIMS);
        add_range(frame,
                  (struct frame_draw_range){.first_id = draw->first_id + part->first_triangle,
                                            .count = part->triangle_count,
                                            .draw = draw_index,
                                            .front = front,
                                            .back = back,
                                            .reflection = reflection},
                  traits);
    }
}
