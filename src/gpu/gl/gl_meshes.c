// gl_meshes.c: uploads meshes as vertex buffers, and keeps them as long as their scene exists.
#include "gl_device.h"

#include "fail.h"

#include <stdlib.h>
#include <string.h>

enum { CHUNK = 4096 }; // number of vertices packed at a time

// Returns whether a vertex has the same index for all attributes, so that the mesh's own vertices can be uploaded.
bool mesh_can_share(const lam_mesh *mesh)
{
    return mesh->indices && mesh->normals && !mesh->normal_indices && mesh->normal_count >= mesh->vertex_count &&
           (!mesh->colors ||
            (mesh->colors_rate == LAM_PER_VERTEX && !mesh->color_indices && mesh->color_count >= mesh->vertex_count)) &&
           (!mesh->tangents || (!mesh->tangent_indices && mesh->tangent_count >= mesh->vertex_count)) &&
           (!mesh->texcoords || (!mesh->texcoord_indices && mesh->texcoord_count >= mesh->vertex_count)) &&
           (!mesh->second_texcoords ||
            (!mesh->second_texcoord_indices && mesh->second_texcoord_count >= mesh->vertex_count));
}

uint32_t mesh_vertex_count(const lam_mesh *mesh, enum vertex_form form)
{
    return form == FORM_SHARED ? mesh->vertex_count : 3 * mesh->triangle_count;
}

static uint32_t element(const uint32_t *own, const uint32_t *shared, uint32_t corner)
{
    return own ? own[corner] : shared ? shared[corner] : corner;
}

static void copy_color(const struct gl_device *device, const lam_mesh *mesh, uint32_t at, float out[4])
{
    if (mesh->colors_format == LAM_COLORS_LINEAR_F32) {
        memcpy(out, (const float *)mesh->colors + 4 * (size_t)at, 4 * sizeof *out);
        return;
    }
    const uint8_t *bytes = (const uint8_t *)mesh->colors + 4 * (size_t)at;
    for (int c = 0; c < 4; c++)
        out[c] = c < 3 && mesh->colors_format == LAM_COLORS_SRGB8 ? device->decode_srgb[bytes[c]]
                                                                  : (float)(bytes[c] / 255.0);
}

static void unit(float v[3])
{
    float square = (v[0] * v[0] + v[1] * v[1]) + v[2] * v[2];
    float inverse = square > 0 ? 1 / __builtin_sqrtf(square) : 0;
    for (int i = 0; i < 3; i++)
        v[i] *= inverse;
}

// Computes the normalized vector (p1 − p0) × (p2 − p0). The edges are normalized first, because their product could
// underflow.
static void face_normal(const lam_mesh *mesh, uint32_t triangle, float out[3])
{
    float edge[2][3];
    const float *p[3];
    for (uint32_t k = 0; k < 3; k++)
        p[k] = mesh->positions + 3 * (size_t)element(NULL, mesh->indices, 3 * triangle + k);
    for (int k = 0; k < 2; k++) {
        for (int i = 0; i < 3; i++)
            edge[k][i] = p[k + 1][i] - p[0][i];
        unit(edge[k]);
    }
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        out[i] = edge[0][j] * edge[1][k] - edge[0][k] * edge[1][j];
    }
    unit(out);
}

static void copy(float *to, const float *from, size_t count, uint32_t element)
{
    if (from)
        memcpy(to, from + count * element, count * sizeof *to);
}

// Writes `count` vertices of the vertex buffer, from the index `first`. `form` is the layout of the buffer.
static void mesh_vertices(const struct gl_device *device, const lam_mesh *mesh, enum vertex_form form, uint32_t first,
                          uint32_t count, struct mesh_vertex *out)
{
    for (uint32_t i = 0; i < count; i++, out++) {
        uint32_t corner = first + i, triangle = corner / 3;
        uint32_t attribute = form >= FORM_FLAT_FACE ? 3 * triangle + 2 : corner; // flat shading uses the attributes of
                                                                                 // the last corner
        bool shared = form == FORM_SHARED;
        uint32_t p = shared ? corner : element(NULL, mesh->indices, corner);
        copy(out->position, mesh->positions, 3, p);
        if (form == FORM_FLAT_FACE || !mesh->normals)
            face_normal(mesh, triangle, out->normal);
        else
            copy(out->normal, mesh->normals, 3, shared ? p : element(mesh->normal_indices, mesh->indices, attribute));
        if (mesh->colors)
            copy_color(device, mesh,
                       shared                                  ? p
                       : mesh->colors_rate == LAM_PER_TRIANGLE ? triangle
                                                               : element(mesh->color_indices, mesh->indices, attribute),
                       out->color);
        copy(out->tangent, mesh->tangents, 4, shared ? p : element(mesh->tangent_indices, mesh->indices, attribute));
        copy(out->texcoord, mesh->texcoords, 2, shared ? p : element(mesh->texcoord_indices, mesh->indices, corner));
        copy(out->second_texcoord, mesh->second_texcoords, 2,
             shared ? p : element(mesh->second_texcoord_indices, mesh->indices, corner));
    }
}

// --- on the device

// Returns the number of floats per vertex in the buffer.
static size_t mesh_vertex_floats(const lam_mesh *mesh)
{
    return 6u + (mesh->colors ? 4 : 0) + (mesh->tangents ? 4 : 0) + (mesh->texcoords ? 2 : 0) +
           (mesh->second_texcoords ? 2 : 0);
}

static float *append(float *to, const float *from, size_t count)
{
    memcpy(to, from, count * sizeof *to);
    return to + count;
}

static bool send_vertices(struct gl_frame *f, const struct gl_mesh *row, lam_error *error)
{
    struct gl_device *device = f->device;
    const lam_mesh *mesh = &row->mesh;
    size_t each = mesh_vertex_floats(mesh) * sizeof(float);
    uint32_t count = mesh_vertex_count(mesh, row->form);
    if (!count)
        return true;
    if (!buffer_reserve(&device->scratch, CHUNK * sizeof(struct mesh_vertex), f->call, error))
        return false;
    struct mesh_vertex *from = device->scratch.data;
    float *to = gl_buffer_map_new(f, row->vertices, count * each, GL_STATIC_DRAW, error);
    if (!to)
        return false;
    bool on = true;
    for (uint32_t first = 0; on && first < count; first += CHUNK) {
        uint32_t chunk = count - first < CHUNK ? count - first : CHUNK;
        on = call_should_continue(f->call);
        mesh_vertices(device, mesh, row->form, first, chunk, from);
        for (uint32_t i = 0; i < chunk; i++) {
            to = append(to, from[i].position, 3);
            to = append(to, from[i].normal, 3);
            if (mesh->colors)
                to = append(to, from[i].color, 4);
            if (mesh->tangents)
                to = append(to, from[i].tangent, 4);
            if (mesh->texcoords)
                to = append(to, from[i].texcoord, 2);
            if (mesh->second_texcoords)
                to = append(to, from[i].second_texcoord, 2);
        }
    }
    f->gl->UnmapBuffer(GL_ARRAY_BUFFER);
    return on || call_error(f->call, error);
}

void mesh_describe(struct gl_frame *f, const struct gl_mesh *row, GLuint array, bool lit)
{
    const struct {
        bool there, for_light;
        GLuint location;
        GLint size;
    } attributes[] = {{true, false, 0, 3},
                      {true, true, 1, 3},
                      {row->mesh.colors != NULL, false, 2, 4},
                      {row->mesh.tangents != NULL, true, 3, 4},
                      {row->mesh.texcoords != NULL, false, 7, 2},
                      {row->mesh.second_texcoords != NULL, false, 8, 2}};
    size_t stride = mesh_vertex_floats(&row->mesh), at = 0;
    gl_use_array(f->device, array);
    f->gl->BindBuffer(GL_ARRAY_BUFFER, row->vertices);
    for (size_t i = 0; i < sizeof attributes / sizeof *attributes; i++)
        if (attributes[i].there) {
            if (!lit || !attributes[i].for_light)
                gl_point_to(f, attributes[i].location, attributes[i].size, stride, at);
            at += (size_t)attributes[i].size;
        }
}

// Returns whether two meshes have the same arrays. Equal pointers mean equal contents, since a scene never modifies its
// arrays.
static bool same_arrays(const lam_mesh *a, const lam_mesh *b)
{
    return a->positions == b->positions && a->indices == b->indices && a->normals == b->normals &&
           a->normal_indices == b->normal_indices && a->colors == b->colors && a->color_indices == b->color_indices &&
           a->tangents == b->tangents && a->tangent_indices == b->tangent_indices && a->texcoords == b->texcoords &&
           a->texcoord_indices == b->texcoord_indices && a->second_texcoords == b->second_texcoords &&
           a->second_texcoord_indices == b->second_texcoord_indices && a->triangle_count == b->triangle_count &&
           a->vertex_count == b->vertex_count;
}

static void drop(struct gl_device *device, struct gl_mesh *row)
{
    const struct gl *gl = &device->context.gl;
    gl->DeleteBuffers(1, &row->vertices);
    gl->DeleteBuffers(1, &row->elements);
    gl->DeleteVertexArrays(1, &row->array);
    if (device->current.array == row->array)
        device->current.array = 0;
    // OpenGL may reuse the names for other buffers.
    for (int i = 0; i < device->vertex_lighting_capacity; i++)
        if (device->vertex_lighting[i].of_vertices == row->vertices)
            device->vertex_lighting[i].of_vertices = 0;
    scene_token_release(row->token);
    free(row->runs);
    *row = (struct gl_mesh){0};
}

static struct gl_mesh *free_row(struct gl_device *device, lam_error *error)
{
    for (int i = 0; i < device->mesh_count; i++)
        if (!device->meshes[i].token)
            return &device->meshes[i];
    struct gl_mesh *list = gl_grown(device->meshes, device->mesh_count, &device->mesh_capacity, sizeof *list, error);
    if (!list)
        return NULL;
    device->meshes = list;
    struct gl_mesh *row = &device->meshes[device->mesh_count++];
    *row = (struct gl_mesh){0};
    return row;
}

static bool same_runs(const struct gl_mesh *row, const struct mesh_run *runs, int count)
{
    return row->run_count == count && (!count || memcmp(row->runs, runs, (size_t)count * sizeof *runs) == 0);
}

// Uploads the vertex indices in the order in which the triangles are drawn.
static bool send_elements(struct gl_frame *f, const struct gl_mesh *row, lam_error *error)
{
    const lam_mesh *mesh = &row->mesh;
    size_t bytes = 3 * (size_t)mesh->triangle_count * sizeof(uint32_t);
    gl_use_array(f->device, row->array); // the vertex array stores the binding
    f->gl->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, row->elements);
    f->device->base.report.bytes_uploaded += bytes;
    if (!row->run_count) {
        f->gl->BufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)bytes, mesh->indices, GL_STATIC_DRAW);
        return true;
    }
    if (!buffer_reserve(&f->device->scratch, bytes, f->call, error))
        return false;
    uint32_t *to = f->device->scratch.data;
    int calls = 0;
    for (int r = 0; r < row->run_count; r++)
        calls = row->runs[r].call >= calls ? row->runs[r].call + 1 : calls;
    for (int call = 0; call < calls; call++)
        for (int r = 0; r < row->run_count; r++)
            for (uint32_t i = 0; row->runs[r].call == call && i < 3 * row->runs[r].count; i++) {
                uint32_t corner = 3 * row->runs[r].first + i;
                *to++ = row->form == FORM_SHARED ? mesh->indices[corner] : corner;
            }
    f->gl->BufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)bytes, f->device->scratch.data, GL_STATIC_DRAW);
    return true;
}

static bool keep_runs(struct gl_mesh *row, const struct mesh_run *runs, int count, lam_error *error)
{
    size_t bytes = (size_t)count * sizeof *runs;
    row->runs = count ? malloc(bytes) : NULL;
    if (count && !row->runs)
        return fail_memory(error, bytes);
    if (count)
        memcpy(row->runs, runs, bytes);
    row->run_count = count;
    return true;
}

struct gl_mesh *mesh_upload(struct gl_frame *f, const lam_mesh *mesh, enum vertex_form form, bool passing,
                            const struct mesh_run *runs, int run_count, lam_error *error)
{
    struct gl_device *device = f->device;
    for (int i = 0; i < device->mesh_count; i++) {
        struct gl_mesh *row = &device->meshes[i];
        if (row->token == f->frame->token && row->form == form && !row->passing && same_arrays(&row->mesh, mesh) &&
            same_runs(row, runs, run_count)) {
            row->last_frame = device->frame_number;
            return row;
        }
    }
    uint64_t vertices = form == FORM_SHARED ? mesh->vertex_count : 3 * (uint64_t)mesh->triangle_count;
    if (vertices > INT32_MAX) {
        fail(error, LAM_LIMIT, "OpenGL: a mesh has %llu vertices, expected at most %d", (unsigned long long)vertices,
             INT32_MAX);
        return NULL;
    }
    bool elements = form == FORM_SHARED || run_count;
    uint64_t bytes = vertices * mesh_vertex_floats(mesh) * sizeof(float) +
                     (elements ? 3 * (uint64_t)mesh->triangle_count * sizeof(uint32_t) : 0);
    struct gl_mesh *row = free_row(device, error);
    if (!row || !gl_charge(f, &row->bytes, bytes, error))
        return NULL;
    row->token = scene_token_hold(f->frame->token);
    row->mesh = *mesh;
    row->form = form;
    row->passing = passing;
    row->last_frame = device->frame_number;
    f->gl->GenBuffers(1, &row->vertices);
    f->gl->GenVertexArrays(1, &row->array);
    if (elements)
        f->gl->GenBuffers(1, &row->elements);
    if (!keep_runs(row, runs, run_count, error) || !send_vertices(f, row, error) ||
        (elements && !send_elements(f, row, error))) {
        drop(device, row);
        return NULL;
    }
    mesh_describe(f, row, row->array, false);
    return row;
}

void meshes_evict(struct gl_frame *f)
{
    struct gl_device *device = f->device;
    for (int i = 0; i < device->mesh_count; i++) {
        struct gl_mesh *row = &device->meshes[i];
        bool gone = row->token && __atomic_load_n(&row->token->gone, __ATOMIC_ACQUIRE);
        bool unused = row->passing || (row->token == f->frame->token && row->last_frame + 2 < device->frame_number);
        if (row->token && (gone || unused))
            drop(device, row);
    }
}

void meshes_free(struct gl_device *device)
{
    for (int i = 0; i < device->mesh_count; i++)
        if (device->meshes[i].token)
            drop(device, &device->meshes[i]);
    free(device->meshes);
}
