// glsl_uniforms.c: the value of each uniform, for printed shaders and for the OpenGL device.
#include "glsl_rows.h"

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
