// glsl_uniforms.c: the value of each uniform, for printed shaders and for the OpenGL device.
#include "glsl.h"
#include "glsl_declarations.h"

#include <string.h>

static int put(float *out, const float *from, int count)
{
    memcpy(out, from, (size_t)count * sizeof *out);
    return count;
}

static int put_color(float out[4], const float *from)
{
    out[3] = 1;
    return put(out, from, 3) + 1;
}

static int put_number(float *out, float value)
{
    *out = value;
    return 1;
}

// Writes a matrix, given by rows, in column-major order, as OpenGL requires.
static int put_matrix(float *out, const float *rows, int stride, int size)
{
    for (int column = 0; column < size; column++)
        for (int row = 0; row < size; row++)
            out[size * column + row] = rows[stride * row + column];
    return size * size;
}

static int put_member(float *out, const float *values, const struct glsl_row *member)
{
    return put(out, values + member->at, strcmp(member->type, "float") == 0 ? 1 : 4);
}

static int put_hemisphere(float *out, const struct frame_hemisphere *h, const struct glsl_row *member)
{
    const float values[12] = {h->up[0],     h->up[1],     h->up[2],     0, h->sky[0], h->sky[1], h->sky[2], 1,
                              h->ground[0], h->ground[1], h->ground[2], 1};
    return put_member(out, values, member);
}

static int put_product(float *out, const float *a, const float *b)
{
    for (int i = 0; i < 3; i++)
        out[i] = a[i] * b[i];
    out[3] = 1;
    return 4;
}

static const struct frame_light *light_at(const struct glsl_uniform_source *from, int index)
{
    return &from->frame->lights[from->order[index]];
}

int glsl_uniform_value(const struct glsl_choices *c, const struct glsl_uniform_source *from, const struct glsl_row *row,
                       const struct glsl_row *member, int index, float out[16])
{
    const struct frame *frame = from->frame;
    const struct frame_draw_range *range = from->range;
    static const struct frame_draw no_draw = {0}; // for uniforms of the frame, which use no draw
    const struct frame_draw *draw = range ? &frame->draws[range->draw] : &no_draw;
    int number = range ? (row->back ? range->back : range->front) : 0;
    const lam_material *material = frame->materials[number];
    float kd[3], ks[3], rows[2][4], values[GLSL_MATERIAL_MAX];
    switch (row->semantic) {
    case GLSL_MODEL_VIEW: {
        float eye[16] = {[15] = 1};
        memcpy(eye, draw->eye, sizeof draw->eye);
        return put_matrix(out, eye, 4, 4);
    }
    case GLSL_NORMAL_MATRIX:
        return put_matrix(out, &draw->normal[0][0], 3, 3);
    case GLSL_ENVIRONMENT_MATRIX:
        return put_matrix(out, &frame->to_environment[0][0], 3, 3);
    case GLSL_AMBIENT_LIGHT:
        return put_color(out, frame->ambient);
    case GLSL_LIGHTS: {
        struct glsl_light packed = glsl_light_of(light_at(from, index));
        return put_member(out, packed.position, member);
    }
    case GLSL_HEMISPHERES:
        return put_hemisphere(out, &frame->hemispheres[index], member);
    case GLSL_MATERIAL:
    case GLSL_HEAD:
        glsl_material_values(frame, material, c->products, c->field_layers, values);
        return put_member(out, values, row->semantic == GLSL_MATERIAL ? member : row);
    case GLSL_DIFFUSE_PRODUCT:
    case GLSL_SPECULAR_PRODUCT:
        frame_material_colors(frame, material, kd, ks);
        return row->semantic == GLSL_DIFFUSE_PRODUCT ? put_product(out, kd, light_at(from, index)->diffuse)
                                                     : put_product(out, ks, light_at(from, index)->specular);
    case GLSL_LIGHT_AMBIENT_PRODUCT:
        return put_product(out, &material->ambient.r, light_at(from, index)->ambient);
    case GLSL_SKY_PRODUCT:
        return put_product(out, frame_sky_color(frame, &frame->hemispheres[index], material),
                           frame->hemispheres[index].sky);
    case GLSL_GROUND_PRODUCT:
        return put_product(out, frame_sky_color(frame, &frame->hemispheres[index], material),
                           frame->hemispheres[index].ground);
    case GLSL_FIRST_PRODUCT:
        // NOLINTNEXTLINE(bugprone-integer-division): whole texels of 16 bytes
        return put_number(out, (float)((size_t)number * glsl_products_bytes(c) / 16));
    case GLSL_OBJECT:
        return put_number(out, (float)draw->object);
    case GLSL_PASSED:
        return put_number(out, 1);
    case GLSL_EXPOSURE:
        return put_number(out, frame->exposure);
    case GLSL_MAP_S:
    case GLSL_MAP_T:
        glsl_map_values(material->maps[row->map], draw->mesh, rows[0], rows[1]);
        return put(out, rows[row->semantic == GLSL_MAP_T], 4);
    case GLSL_ALPHA_CUTOFF:
        return put_number(out, glsl_alpha_cutoff(frame, material));
    case GLSL_MAPPED_EMISSION:
        glsl_mapped_emission(frame, range, row->back, out);
        return 4;
    default: // textures, and the projection, which depends on the window
        return 0;
    }
}

// Computes the choices for a frame, and the values of lights, materials and products in its shaders.

static void find_groups(struct glsl_choices *c, const struct frame *frame)
{
    int counts[GLSL_KINDS][GLSL_FALLOFFS] = {{0}};
    for (int i = 0; i < frame->light_count; i++)
        counts[frame->lights[i].kind][frame->lights[i].falloff]++;
    for (int kind = 0; kind < GLSL_KINDS; kind++)
        for (int falloff = 0; falloff < GLSL_FALLOFFS; falloff++)
            if (counts[kind][falloff])
                c->groups[c->group_count++] = (struct glsl_group){kind, falloff, counts[kind][falloff]};
    c->light_count = frame->light_count;
    c->hemisphere_count = frame->hemisphere_count;
    for (int i = 0; i < frame->hemisphere_count; i++)
        c->ambient_hemispheres += !frame->hemispheres[i].source->by_diffuse;
}

void glsl_choose(struct glsl_choices *c, const struct frame *frame, const struct frame_draw_range *range,
                 lam_stage stage)
{
    memset(c, 0, sizeof *c);
    const struct frame_draw *draw = &frame->draws[range->draw];
    c->shading = frame->settings.shading;
    c->stage = stage ? stage : frame->settings.shading == LAM_SHADING_GOURAUD ? LAM_STAGE_VERTEX : LAM_STAGE_FRAGMENT;
    c->reflection = range->reflection;
    c->output = frame->settings.output;
    c->distant_viewer = frame->distant_viewer;
    c->gl1 = frame->settings.gl1;
    c->single_scattering = frame_is_physical(range->reflection) && frame->settings.single_scattering;
    c->two_sided = !draw->one_sided;
    c->back_material = c->two_sided && range->back != range->front;
    c->colors = draw->mesh->colors != NULL;
    c->tangents = draw->mesh->tangents != NULL;
    if (frame->environment_lights && frame_is_physical(range->reflection)) {
        c->environment = GLSL_FACES;
        c->environment_light = true;
    } else if (frame_reflects_environment(frame, frame->materials[range->front]) ||
               (c->back_material && frame_reflects_environment(frame, frame->materials[range->back]))) {
        c->environment = GLSL_FACES;
    }
    for (int i = 0; i < frame->material_count; i++)
        c->field_layers |= (uint8_t)frame_layers(frame, frame->materials[i]);
    if (frame_is_physical(range->reflection))
        c->layers = (uint8_t)(frame_layers(frame, frame->materials[range->front]) |
                              (c->back_material ? frame_layers(frame, frame->materials[range->back]) : 0));
    find_groups(c, frame);
    glsl_choose_maps(c, frame, range);
}

int glsl_next_light(const struct glsl_choices *c, const struct frame *frame, struct glsl_light_cursor *at)
{
    for (; at->group < c->group_count; at->group++, at->light = 0)
        while (at->light < frame->light_count) {
            const struct frame_light *light = &frame->lights[at->light++];
            if (light->kind == c->groups[at->group].kind && light->falloff == c->groups[at->group].falloff)
                return at->light - 1;
        }
    return -1;
}

static void set3(float out[4], const float *from, float w)
{
    memcpy(out, from, 3 * sizeof *out);
    out[3] = w;
}

struct glsl_light glsl_light_of(const struct frame_light *light)
{
    struct glsl_light out;
    set3(out.position, light->position, 1);
    set3(out.direction, light->axis, 0);
    set3(out.attenuation, light->attenuation, light->inverse_range);
    const float cone[4] = {light->cos_cutoff, light->exponent, light->cos_outer, light->inverse_width};
    memcpy(out.cone, cone, sizeof cone);
    set3(out.diffuse, light->diffuse, 1);
    set3(out.specular, light->specular, 1);
    set3(out.ambient, light->ambient, 1);
    return out;
}

static void product(float out[4], const float *a, const float *b)
{
    for (int i = 0; i < 3; i++)
        out[i] = a[i] * b[i];
    out[3] = 1;
}

// --- materials

static bool is_wide(const struct material_field *row) { return row->field.type >= LAM_FIELD_RGB; }

struct glsl_material_layout glsl_material_layout(bool products, int field_layers)
{
    struct glsl_material_layout out = {0};
    for (int wide = 1; wide >= 0; wide--)
        for (int i = 0; material_field(i); i++) {
            const struct material_field *row = material_field(i);
            if (is_wide(row) != wide || row->reader >= FIELD_CHOICE || (products && row->product && !*row->product))
                continue;
            if (row->layer && !(row->layer & field_layers))
                continue;
            out.fields[out.count] = row;
            out.at[out.count++] = out.size;
            out.size += wide ? 4 : 1;
        }
    out.size = (out.size + 3) & ~3;
    return out;
}

const char *glsl_field_name(const struct material_field *row, bool products)
{
    return products && row->product ? row->product : row->field.name;
}

void glsl_material_values(const struct frame *frame, const lam_material *material, bool products, int field_layers,
                          float out[GLSL_MATERIAL_MAX])
{
    struct glsl_material_layout layout = glsl_material_layout(products, field_layers);
    lam_material in_use = *material;
    in_use.shininess = frame_shininess(frame, material);
    if (frame_converts_at_points(frame, material)) { // the shader converts the base colour of each point
        in_use.diffuse = (lam_rgba){material->ambient.r, material->ambient.g, material->ambient.b, material->diffuse.a};
        in_use.specular = (lam_rgb){1, 1, 1};
    }
    memset(out, 0, (size_t)layout.size * sizeof *out);
    for (int i = 0; i < layout.count; i++) {
        double numbers[4] = {0, 0, 0, 1};
        lam_field_get(&layout.fields[i]->field, &in_use, numbers);
        for (int k = 0; k < (is_wide(layout.fields[i]) ? 4 : 1); k++)
            out[layout.at[i] + k] = (float)numbers[k];
        if (products && layout.fields[i]->product)
            product(out + layout.at[i], out + layout.at[i], frame->ambient);
    }
}

// --- lights and products

static size_t floats_of_light(const struct glsl_choices *c) { return c->products ? 16 : c->gl1 ? 28 : 24; }

size_t glsl_lights_bytes(const struct glsl_choices *c)
{
    size_t lights = (size_t)c->light_count * floats_of_light(c),
           hemispheres = (size_t)c->hemisphere_count * (c->products ? 4 : 12),
           head = !c->products && c->storage == GLSL_BLOCK ? 4 : 0, all = head + lights + hemispheres;
    return (all ? all : 4) * sizeof(float);
}

// Adds a light's shadow data to its position, for shaders with shadows. w becomes the radius, or −1 if the light casts
// no shadows. For a directional light, x, y and z become the unit vector along the axis in which the light's direction
// has its smallest component.
static void pack_shadow(float position[4], const struct frame_light *light)
{
    position[3] = light->casts_shadows ? (float)light->radius : -1;
    if (light->kind != LIGHT_DIRECTIONAL)
        return;
    int least = 0;
    for (int i = 1; i < 3; i++)
        least = __builtin_fabs(light->world_axis[i]) < __builtin_fabs(light->world_axis[least]) ? i : least;
    for (int i = 0; i < 3; i++)
        position[i] = i == least;
}

void glsl_pack_lights(const struct glsl_choices *c, const struct frame *frame, float *out)
{
    if (!c->products && c->storage == GLSL_BLOCK) {
        set3(out, frame->ambient, 1);
        out += 4;
    }
    size_t each = floats_of_light(c);
    struct glsl_light_cursor cursor = {0, 0};
    for (int i; (i = glsl_next_light(c, frame, &cursor)) >= 0; out += each) {
        const struct frame_light *light = &frame->lights[i];
        struct glsl_light packed = glsl_light_of(light);
        if (c->occlusion)
            packed.direction[3] = light->occluded;
        if (c->shadows)
            pack_shadow(packed.position, light);
        memcpy(out, &packed, each * sizeof *out);
    }
    for (int i = 0; i < frame->hemisphere_count; i++) {
        const struct frame_hemisphere *h = &frame->hemispheres[i];
        set3(out, h->up, 0);
        out += 4;
        if (c->products)
            continue;
        set3(out, h->sky, 1);
        set3(out + 4, h->ground, 1);
        out += 8;
    }
}

size_t glsl_products_bytes(const struct glsl_choices *c)
{
    size_t lists = (size_t)c->light_count * (c->gl1 ? 12 : 8) + (size_t)c->hemisphere_count * 8;
    size_t head = c->storage == GLSL_BLOCK ? (size_t)glsl_material_layout(true, c->field_layers).size : 0;
    size_t all = (head + lists) * sizeof(float);
    return all ? all : 16;
}

void glsl_pack_products(const struct glsl_choices *c, const struct frame *frame, const lam_material *material,
                        float *out)
{
    bool block = c->storage == GLSL_BLOCK;
    if (block) {
        float head[GLSL_MATERIAL_MAX];
        size_t size = (size_t)glsl_material_layout(true, c->field_layers).size;
        glsl_material_values(frame, material, true, c->field_layers, head);
        memcpy(out, head, size * sizeof *out);
        out += size;
    }
    float kd[3], ks[3];
    frame_material_colors(frame, material, kd, ks);
    // A block has an array for each product; in a texture the products of a light are consecutive.
    size_t lights = (size_t)c->light_count, hemispheres = (size_t)c->hemisphere_count, at = 0;
    size_t step = block ? 4 : c->gl1 ? 12 : 8, next = block ? 4 * lights : 4;
    struct glsl_light_cursor cursor = {0, 0};
    for (int i; (i = glsl_next_light(c, frame, &cursor)) >= 0; at += step) {
        const struct frame_light *light = &frame->lights[i];
        product(out + at, kd, light->diffuse);
        product(out + at + next, ks, light->specular);
        if (c->gl1)
            product(out + at + 2 * next, &material->ambient.r, light->ambient);
    }
    out += lights * (c->gl1 ? 12 : 8);
    for (size_t i = 0; i < hemispheres; i++) {
        float *sky = block ? out + 4 * i : out + 8 * i, *ground = block ? sky + 4 * hemispheres : sky + 4;
        const float *color = frame_sky_color(frame, &frame->hemispheres[i], material);
        product(sky, color, frame->hemispheres[i].sky);
        product(ground, color, frame->hemispheres[i].ground);
    }
}
