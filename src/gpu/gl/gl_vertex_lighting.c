// gl_vertex_lighting.c: the stage `application`: the CPU lights the vertices (vertex_colors.h), and the front and back
// colours are uploaded as attributes. A draw is lit again only if an input of its colours has changed.
#include "gl_device.h"

#include "fail.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

// --- the key

// The key does not include the padding between members, because the bytes of the padding are indeterminate.
static void key_add_light(uint64_t *key, const struct frame_light *light)
{
    const int kind[] = {light->kind, light->falloff};
    size_t first = offsetof(struct frame_light, position), end = offsetof(struct frame_light, light);
    gl_key_add(key, kind, sizeof kind);
    gl_key_add(key, (const char *)light + first, end - first);
}

static void key_add_material(uint64_t *key, const lam_material *m)
{
    for (int i = 0; lam_material_field(i); i++) {
        double numbers[4];
        int count = lam_field_get(lam_material_field(i), m, numbers);
        gl_key_add(key, numbers, (size_t)count * sizeof *numbers);
    }
}

// Returns the key of all inputs of a draw's colours.
static uint64_t key_of(const struct gl_frame *f, const struct gl_mesh *mesh, int number)
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
    // The key contains the frame's number if the mesh belongs to this frame only, or if shadows are drawn, because
    // shadows depend on all meshes.
    const uint64_t frame_number = mesh->passing || frame->settings.shadows ? f->device->frame_number : 0;
    const void *pointers[] = {frame->environment, mesh->mesh.positions, mesh->token};
    uint64_t key = 1;
    gl_key_add(&key, choices, sizeof choices);
    gl_key_add(&key, pointers, sizeof pointers);
    gl_key_add(&key, &frame_number, sizeof frame_number);
    gl_key_add(&key, draw->eye, sizeof draw->eye);
    gl_key_add(&key, draw->normal, sizeof draw->normal);
    gl_key_add(&key, draw->tangent, sizeof draw->tangent);
    gl_key_add(&key, frame->ambient, sizeof frame->ambient);
    gl_key_add(&key, frame->to_environment, sizeof frame->to_environment);
    for (int i = 0; i < frame->light_count; i++)
        key_add_light(&key, &frame->lights[i]);
    for (int i = 0; i < frame->hemisphere_count; i++)
        gl_key_add(&key, &frame->hemispheres[i], offsetof(struct frame_hemisphere, light));
    for (int i = 0; i < frame->range_count; i++) {
        const struct frame_draw_range *s = &frame->ranges[i];
        const uint32_t run[] = {s->first_id, s->count, s->translucent, s->reflection};
        if (s->draw != number)
            continue;
        gl_key_add(&key, run, sizeof run);
        key_add_material(&key, frame->materials[s->front]);
        key_add_material(&key, frame->materials[s->back]);
    }
    return key;
}

// --- the colours

// Lights the vertices of a range, and interleaves front and back colours.
static bool light_range(struct gl_frame *f, const struct gl_mesh *mesh, uint32_t range, uint32_t first, uint32_t end,
                        bool separate, float (*lit)[4])
{
    const struct frame_draw_range *of = &f->frame->ranges[range];
    struct vertex_colors *colors = &f->device->vertex_colors;
    const struct vertex_cache *out = &colors->shading.vertices;
    struct vertex_run run = {.range = range,
                             .shared = mesh->form == FORM_SHARED,
                             .separate_texture_terms = glsl_separates_texture_terms(f->frame, of)};
    uint32_t each = separate ? 4 : 2, repeat = mesh->form >= FORM_FLAT_FACE ? 3 : 1; // vertices with one colour
    for (int back = 0; back < 2; back++)
        run.has_emission_map |= f->frame->materials[back ? of->back : of->front]->maps[LAM_MAP_EMISSION] != NULL;
    for (; first < end; first += VERTEX_RUN_MAX) {
        uint32_t count = end - first < VERTEX_RUN_MAX ? end - first : VERTEX_RUN_MAX;
        run.first = first / repeat;
        run.count = count / repeat;
        if (!call_should_continue(f->call))
            return false;
        for (uint32_t back = 0; back < 2; back++) {
            run.back = back;
            if (!back || !f->frame->draws[of->draw].one_sided) // if one-sided, the back repeats the front
                vertex_colors_light(colors, &run);
            for (uint32_t i = 0; i < count; i++)
                memcpy(lit[(first + i) * each + back], out->color[i / repeat], sizeof *out->color);
            for (uint32_t i = 0; i < count && run.separate_texture_terms; i++)
                memcpy(lit[(first + i) * each + 2 + back], out->rest[i / repeat], sizeof *out->rest);
        }
    }
    return call_should_continue(f->call); // if the call is stopped, the last vertices may not be lit
}

static bool send_colors(struct gl_frame *f, struct gl_vertex_lighting *row, const struct gl_mesh *mesh, int number,
                        lam_error *error)
{
    const struct frame *frame = f->frame;
    struct gl_device *device = f->device;
    struct vertex_colors *colors = &device->vertex_colors;
    uint64_t start = now_ns();
    uint32_t count = mesh_vertex_count(&mesh->mesh, mesh->form);
    uint64_t bytes = (uint64_t)count * (row->separate_texture_terms ? 4 : 2) * 4 * sizeof(float);
    if (device->vertex_colors_frame != device->frame_number) {
        const struct hierarchy *hierarchy = frame->settings.shadows ? &device->hierarchy.hierarchy : NULL;
        if (!vertex_colors_start(colors, frame, f->environment_light, hierarchy, f->call, error))
            return false;
        device->vertex_colors_frame = device->frame_number;
    }
    if (!gl_charge(f, &row->bytes, bytes, error))
        return false;
    float(*lit)[4] = gl_buffer_map_new(f, row->colors, (size_t)bytes, GL_DYNAMIC_DRAW, error);
    if (!lit)
        return false;
    struct shading *shading = &colors->shading;
    shading->points_lit = shading->lights_evaluated = shading->rays = 0;
    // with shared vertices, all ranges have one material
    bool on = true, shared = mesh->form == FORM_SHARED, done = false;
    for (int i = 0; on && !done && i < frame->range_count; i++) {
        const struct frame_draw_range *s = &frame->ranges[i];
        uint32_t first = 3 * (s->first_id - frame->draws[number].first_id);
        if (s->draw != number)
            continue;
        on = light_range(f, mesh, (uint32_t)i, shared ? 0 : first, shared ? count : first + 3 * s->count,
                         row->separate_texture_terms, lit);
        done = shared;
    }
    f->gl->UnmapBuffer(GL_ARRAY_BUFFER);
    lam_frame_report *report = &device->base.report;
    report->points_lit += shading->points_lit;
    report->lights_evaluated += shading->lights_evaluated;
    report->rays += shading->rays;
    report->lighting_ms += (double)(now_ns() - start) * 1e-6;
    const struct ray_layers *layers = &shading->ray_layers;
    if (layers->failed)
        return fail_memory(error, (size_t)layers->capacity * 2 * sizeof *layers->list);
    return on || call_error(f->call, error);
}

static bool reserve_row(struct gl_device *device, int draw, lam_error *error)
{
    if (draw < device->vertex_lighting_capacity)
        return true;
    int capacity = draw + 8;
    struct gl_vertex_lighting *grown = realloc(device->vertex_lighting, (size_t)capacity * sizeof *grown);
    if (!grown)
        return fail_memory(error, (size_t)capacity * sizeof *grown);
    memset(grown + device->vertex_lighting_capacity, 0,
           (size_t)(capacity - device->vertex_lighting_capacity) * sizeof *grown);
    device->vertex_lighting = grown;
    device->vertex_lighting_capacity = capacity;
    return true;
}

// Sets the vertex attributes: the mesh's attributes for fragments, and the colours.
static void describe(struct gl_frame *f, struct gl_vertex_lighting *row, const struct gl_mesh *mesh)
{
    const struct gl *gl = f->gl;
    mesh_describe(f, mesh, row->array, true);
    gl->BindBuffer(GL_ARRAY_BUFFER, row->colors);
    for (GLuint side = 0; side < 2; side++) {
        gl_point_to(f, 4 + side, 4, row->separate_texture_terms ? 16 : 8, side * 4);
        if (row->separate_texture_terms)
            gl_point_to(f, 9 + side, 3, 16, 8 + side * 4);
        else
            gl->DisableVertexAttribArray(9 + side);
    }
    gl->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, mesh->elements);
    row->of_vertices = mesh->vertices;
}

GLuint vertex_lighting_upload(struct gl_frame *f, int draw, struct gl_mesh *mesh, lam_error *error)
{
    struct gl_device *device = f->device;
    const struct gl *gl = f->gl;
    if (!reserve_row(device, draw, error))
        return 0;
    uint64_t key = key_of(f, mesh, draw);
    struct gl_vertex_lighting *row = &device->vertex_lighting[draw];
    bool separate = false;
    for (int i = 0; i < f->frame->range_count; i++)
        separate |= f->frame->ranges[i].draw == draw && glsl_separates_texture_terms(f->frame, &f->frame->ranges[i]);
    if (row->separate_texture_terms != separate)
        row->key = row->of_vertices = 0;
    row->separate_texture_terms = separate;
    if (!row->colors) {
        gl->GenBuffers(1, &row->colors);
        gl->GenVertexArrays(1, &row->array);
    }
    if (row->key != key) {
        row->key = 0;
        if (!send_colors(f, row, mesh, draw, error))
            return 0;
        row->key = key;
        lam_environment_free(row->environment);
        row->environment = cube_share(f->frame->environment);
    }
    if (row->of_vertices != mesh->vertices)
        describe(f, row, mesh);
    return row->array;
}

void vertex_lighting_free(struct gl_device *device)
{
    const struct gl *gl = &device->context.gl;
    for (int i = 0; i < device->vertex_lighting_capacity; i++) {
        struct gl_vertex_lighting *row = &device->vertex_lighting[i];
        gl->DeleteBuffers(1, &row->colors);
        gl->DeleteVertexArrays(1, &row->array);
        lam_environment_free(row->environment);
    }
    free(device->vertex_lighting);
    vertex_colors_free(&device->vertex_colors);
}
