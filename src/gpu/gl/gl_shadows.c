// gl_shadows.c: stores the hierarchy of a frame in a float texture, which the shaders traverse (shadows.glsl).
//
// The texture contains, in this order:
//    - Two texels for each child of a node: the low corner of its box, with the child's number; the high corner, with
//      twice its count of triangles, plus one if no further child follows.
//    - Six texels for each triangle, in the order of the leaves. Three contain the corners, with the twin, a kind, and
//      the position of the record of a triangle that transmits light, or 0. Three contain the unit normals of the
//      corners, with the corners' elements.
//    - A number for each triangle of the frame: its position in that order.
//    - The data of surfaces that transmit light (gl_surfaces.c).
#include "gl_device.h"

#include "fail.h"

#include <string.h>

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

static void pack_triangle(float *out, const struct gl_frame *f, const struct ray_triangle *t)
{
    const struct frame *frame = f->frame;
    const struct frame_draw *draw = &frame->draws[frame->ranges[frame_range_of(frame, t->number)].draw];
    bool curved = draw->mesh->normals && frame_draw_casts(draw);
    for (uint32_t k = 0; k < 3; k++) {
        for (int i = 0; i < 3; i++)
            out[4 * k + (uint32_t)i] = (float)t->p[k][i];
        uint32_t corner = 3 * (t->number - draw->first_id) + k;
        if (curved)
            pack_normal(out + 4 * (3 + k), draw, corner);
    }
    out[3] = (float)t->twin;
    out[7] = !frame_draw_casts(draw) ? KIND_APART : curved ? KIND_CURVED : KIND_FLAT;
    out[11] = (float)surfaces_record(f, t->number);
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
    for (uint32_t i = 0; i < h->node_count; i++)
        pack_node(out + (size_t)4 * NODE * i, &h->nodes[i]);
    for (uint32_t i = 0; i < h->triangle_count; i++) {
        pack_triangle(out + 4 * (triangles + (size_t)TRIANGLE * i), f, &h->triangles[i]);
        out[4 * positions + h->triangles[i].number] = (float)i;
    }
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
