// gl_vertex_key.c: collects all inputs of the colours of a draw's vertices, as bytes.
#include "gl_vertex_key.h"

#include <stddef.h>
#include <string.h>

static bool key_add(struct gl_frame *f, struct gl_vertex_lighting *row, size_t *size, const void *bytes, size_t count,
                    lam_error *error)
{
    if (*size + count > row->frame_key.capacity) {
        struct buffer grown = {0};
        if (!buffer_reserve(&grown, 2 * (*size + count), f->call, error))
            return false;
        if (*size)
            memcpy(grown.data, row->frame_key.data, *size);
        buffer_free(&row->frame_key);
        row->frame_key = grown;
    }
    memcpy((char *)row->frame_key.data + *size, bytes, count);
    *size += count;
    return true;
}

// Members are appended without the padding between them, whose bytes are indeterminate.
static bool key_add_light(struct gl_frame *f, struct gl_vertex_lighting *row, size_t *size,
                          const struct frame_light *light, lam_error *error)
{
    const int kind[] = {light->kind, light->falloff};
    size_t first = offsetof(struct frame_light, position), end = offsetof(struct frame_light, light);
    return key_add(f, row, size, kind, sizeof kind, error) &&
           key_add(f, row, size, (const char *)light + first, end - first, error);
}

static bool key_add_material(struct gl_frame *f, struct gl_vertex_lighting *row, size_t *size, const lam_material *m,
                             lam_error *error)
{
    for (int i = 0; lam_material_field(i); i++) {
        double numbers[4];
        size_t bytes = (size_t)lam_field_get(lam_material_field(i), m, numbers) * sizeof *numbers;
        if (!key_add(f, row, size, numbers, bytes, error))
            return false;
    }
    return true;
}

static bool key_add_range(struct gl_frame *f, struct gl_vertex_lighting *row, size_t *size,
                          const struct frame_draw_range *s, lam_error *error)
{
    const uint32_t run[] = {s->first_id, s->count, s->translucent, s->reflection};
    return key_add(f, row, size, run, sizeof run, error) &&
           key_add_material(f, row, size, f->frame->materials[s->front], error) &&
           key_add_material(f, row, size, f->frame->materials[s->back], error);
}

bool vertex_lighting_key(struct gl_frame *f, struct gl_vertex_lighting *row, const struct gl_mesh *mesh, int number,
                         size_t *size, lam_error *error)
{
    const struct frame *frame = f->frame;
    const struct frame_draw *draw = &frame->draws[number];
    const int choices[] = {frame->settings.output,
                           frame->settings.shading,
                           frame->settings.gl1,
                           frame->distant_viewer,
                           frame->settings.match_highlights,
                           frame->settings.single_scattering,
                           frame->light_count,
                           frame->hemisphere_count,
                           draw->one_sided,
                           frame->settings.flat_normal,
                           (int)mesh->form,
                           frame->translucent};
    // Contents that belong to this frame, and shadows, which depend on all meshes.
    const uint64_t frame_number = mesh->passing || frame->settings.shadows ? f->device->frame_number : 0;
    const void *pointers[] = {frame->environment, mesh->mesh.positions, mesh->token};
    bool ok = key_add(f, row, size, choices, sizeof choices, error) &&
              key_add(f, row, size, pointers, sizeof pointers, error) &&
              key_add(f, row, size, &frame_number, sizeof frame_number, error) &&
              key_add(f, row, size, draw->eye, sizeof draw->eye, error) &&
              key_add(f, row, size, draw->normal, sizeof draw->normal, error) &&
              key_add(f, row, size, draw->tangent, sizeof draw->tangent, error) &&
              key_add(f, row, size, frame->ambient, sizeof frame->ambient, error) &&
              key_add(f, row, size, frame->to_environment, sizeof frame->to_environment, error);
    for (int i = 0; ok && i < frame->light_count; i++)
        ok = key_add_light(f, row, size, &frame->lights[i], error);
    for (int i = 0; ok && i < frame->hemisphere_count; i++)
        ok = key_add(f, row, size, &frame->hemispheres[i], offsetof(struct frame_hemisphere, light), error);
    for (int i = 0; ok && i < frame->range_count; i++)
        if (frame->ranges[i].draw == number)
            ok = key_add_range(f, row, size, &frame->ranges[i], error);
    return ok;
}
