// glb_meshes.c: writes meshes in the layout of glTF: one index for all attributes of a corner, and a primitive for each
// part.
#include "glb.h"

enum { FLOAT = 5126, UNSIGNED_INT = 5125, UNSIGNED_BYTE = 5121, ARRAY_BUFFER = 34962, ELEMENT_ARRAY_BUFFER = 34963 };

// Returns whether all attributes already share one index, as in meshes read from glTF and PLY files.
static bool has_one_number(const lam_mesh *m)
{
    bool own = m->normal_indices || m->texcoord_indices || m->second_texcoord_indices || m->tangent_indices ||
               m->color_indices || (m->colors && m->colors_rate == LAM_PER_TRIANGLE);
    return !own && (!m->normals || m->normal_count == m->vertex_count) &&
           (!m->texcoords || m->texcoord_count == m->vertex_count) &&
           (!m->second_texcoords || m->second_texcoord_count == m->vertex_count) &&
           (!m->tangents || m->tangent_count == m->vertex_count) && (!m->colors || m->color_count == m->vertex_count);
}

// The vertices to write: the mesh's own vertices, or merged vertices.
struct vertices {
    const lam_mesh *mesh;
    bool as_they_are;
    struct export_vertices shared;
    uint32_t count;
};

static uint32_t element(const struct vertices *v, const uint32_t *own, uint32_t vertex)
{
    return v->as_they_are ? vertex : mesh_element(own, v->mesh, v->shared.corners[vertex]);
}

static int add_accessor(struct glb *glb, int view, int component, const char *type, size_t count)
{
    return glb_add(glb, glb->accessors,
                   json_pack("{s:i, s:i, s:I, s:s}", "bufferView", view, "componentType", component, "count",
                             (json_int_t)count, "type", type));
}

// Writes an attribute of floats. Returns the index of its accessor.
static int add_floats(struct glb *glb, const struct vertices *v, const float *items, const uint32_t *own, int width)
{
    static const char *const types[] = {NULL, NULL, "VEC2", "VEC3", "VEC4"};
    if (!items)
        return -1;
    size_t size = (size_t)v->count * (size_t)width;
    float *copy = NULL;
    if (!v->as_they_are) {
        copy = export_memory(glb->e, (size + 1) * sizeof *copy);
        glb->failed |= !copy;
        for (uint32_t i = 0; copy && i < v->count && export_continues(glb->e, i); i++)
            for (int k = 0; k < width; k++)
                copy[(size_t)i * (size_t)width + (size_t)k] =
                    items[(size_t)element(v, own, i) * (size_t)width + (size_t)k];
        items = copy;
    }
    int view = items ? glb_add_view(glb, items, size * sizeof *items, ARRAY_BUFFER) : 0;
    export_memory_free(glb->e, copy, (size + 1) * sizeof *copy);
    return add_accessor(glb, view, FLOAT, types[width], v->count);
}

// Sets the accessor's minimum and maximum, which the standard requires for positions.
static void set_bounds(struct glb *glb, const struct vertices *v, int accessor)
{
    float low[3] = {0}, high[3] = {0};
    for (uint32_t i = 0; i < v->count && export_continues(glb->e, i); i++)
        for (int k = 0; k < 3; k++) {
            float x = v->mesh->positions[3 * (size_t)element(v, NULL, i) + (size_t)k];
            low[k] = i == 0 || x < low[k] ? x : low[k];
            high[k] = i == 0 || x > high[k] ? x : high[k];
        }
    json_t *object = json_array_get(glb->accessors, (size_t)accessor);
    glb_set(glb, object, "min", glb_floats(glb, low, 3));
    glb_set(glb, object, "max", glb_floats(glb, high, 3));
}

static uint32_t color_of(const struct vertices *v, uint32_t vertex)
{
    return v->as_they_are ? vertex : export_color_element(v->mesh, v->shared.corners[vertex]);
}

// Colours in glTF are linear; linear bytes remain bytes.
static int add_colors(struct glb *glb, const struct vertices *v)
{
    const lam_mesh *m = v->mesh;
    if (!m->colors)
        return -1;
    bool bytes = m->colors_format == LAM_COLORS_LINEAR8;
    size_t size = bytes ? 4 : 16;
    char *items = export_memory(glb->e, ((size_t)v->count + 1) * size);
    glb->failed |= !items;
    for (uint32_t i = 0; items && i < v->count && export_continues(glb->e, i); i++) {
        size_t at = color_of(v, i);
        if (bytes)
            for (int k = 0; k < 4; k++)
                items[4 * (size_t)i + (size_t)k] = ((const char *)m->colors)[4 * at + (size_t)k];
        else
            export_color(m, at, (float *)(void *)items + 4 * (size_t)i);
    }
    int view = items ? glb_add_view(glb, items, v->count * size, ARRAY_BUFFER) : 0;
    export_memory_free(glb->e, items, ((size_t)v->count + 1) * size);
    int accessor = add_accessor(glb, view, bytes ? UNSIGNED_BYTE : FLOAT, "VEC4", v->count);
    if (bytes)
        glb_set(glb, json_array_get(glb->accessors, (size_t)accessor), "normalized", json_true());
    return accessor;
}

static size_t corners_of_item(const lam_mesh *m) { return m->line_count ? 2 : m->point_count ? 1 : 3; }

// Writes the indices of each part's corners, as one accessor per part.
static void add_indices(struct glb *glb, const struct vertices *v, struct glb_arrays *arrays)
{
    const lam_mesh *m = v->mesh;
    size_t size = corners_of_item(m), corners = mesh_corners(m);
    uint32_t *numbers = export_memory(glb->e, (corners + 1) * sizeof *numbers);
    glb->failed |= !numbers;
    for (size_t c = 0; numbers && c < corners && export_continues(glb->e, c); c++)
        numbers[c] = v->as_they_are ? mesh_element(NULL, m, c) : v->shared.numbers[c];
    arrays->first_indices = (int)json_array_size(glb->accessors);
    for (uint32_t i = 0; numbers && i < (m->parts ? m->part_count : 1) && !glb->bytes.failed; i++) {
        size_t first = m->parts ? m->parts[i].first_triangle * size : 0,
               count = m->parts ? m->parts[i].triangle_count * size : corners;
        int view = glb_add_view(glb, numbers + first, count * sizeof *numbers, ELEMENT_ARRAY_BUFFER);
        add_accessor(glb, view, UNSIGNED_INT, "SCALAR", count);
    }
    export_memory_free(glb->e, numbers, (corners + 1) * sizeof *numbers);
}

// Writes the arrays of a mesh, unless they are already written.
static bool write_arrays(struct glb *glb, int index)
{
    const lam_mesh *m = scene_mesh(glb->e->scene, index);
    struct glb_arrays *a = &glb->arrays[index];
    struct vertices v = {.mesh = m, .as_they_are = has_one_number(m), .count = m->vertex_count};
    if (a->ready)
        return true;
    if (!v.as_they_are) {
        if (!export_share_vertices(glb->e, m, &v.shared))
            return false;
        v.count = v.shared.count;
    }
    a->position = add_floats(glb, &v, m->positions, NULL, 3);
    set_bounds(glb, &v, a->position);
    a->normal = add_floats(glb, &v, m->normals, m->normal_indices, 3);
    a->texcoords[0] = add_floats(glb, &v, m->texcoords, m->texcoord_indices, 2);
    a->texcoords[1] = add_floats(glb, &v, m->second_texcoords, m->second_texcoord_indices, 2);
    a->tangent = m->normals ? add_floats(glb, &v, m->tangents, m->tangent_indices, 4) : -1;
    a->color = add_colors(glb, &v);
    add_indices(glb, &v, a);
    a->ready = true;
    return true;
}

static void set_attribute(struct glb *glb, json_t *attributes, const char *key, int accessor)
{
    if (accessor >= 0)
        glb_set(glb, attributes, key, json_integer(accessor));
}

static json_t *primitive(struct glb *glb, const lam_mesh *m, const struct glb_arrays *a, uint32_t part, int material)
{
    json_t *object = json_object(), *attributes = json_object();
    set_attribute(glb, attributes, "POSITION", a->position);
    set_attribute(glb, attributes, "NORMAL", a->normal);
    set_attribute(glb, attributes, "TEXCOORD_0", a->texcoords[0]);
    set_attribute(glb, attributes, "TEXCOORD_1", a->texcoords[1]);
    set_attribute(glb, attributes, "TANGENT", a->tangent);
    set_attribute(glb, attributes, "COLOR_0", a->color);
    glb_set(glb, object, "attributes", attributes);
    glb_set(glb, object, "indices", json_integer(a->first_indices + (int)part));
    glb_set(glb, object, "material", json_integer(material));
    if (mesh_is_strokes(m))
        glb_set(glb, object, "mode", json_integer(m->line_count ? 1 : 0));
    return object;
}

int glb_mesh_of(struct glb *glb, const lam_object *object, int part)
{
    const lam_mesh *m = scene_mesh(glb->e->scene, object->mesh);
    struct glb_arrays *arrays = &glb->arrays[object->mesh];
    struct glb_mesh own = {part, object->material, object->cull == LAM_CULL_NONE, arrays->first_mesh};
    for (int i = arrays->first_mesh; i >= 0;) {
        const struct glb_mesh *other = (const struct glb_mesh *)glb->own.items + i;
        if (other->part == part && other->material == own.material && other->double_sided == own.double_sided)
            return i;
        i = other->before;
    }
    if (!write_arrays(glb, object->mesh) || !glb_append(glb, &glb->own, &own, sizeof own))
        return -1;
    json_t *mesh = json_object(), *primitives = json_array();
    for (uint32_t i = 0; i < (m->parts ? m->part_count : 1) && export_asks(glb->e); i++) {
        if (m->parts && (!m->parts[i].triangle_count || (part >= 0 && i != (uint32_t)part)))
            continue;
        int material = object->material >= 0 ? object->material : m->parts ? m->parts[i].material : -1;
        glb_add(glb, primitives, primitive(glb, m, arrays, i, glb_material(glb, material, own.double_sided)));
    }
    glb_set_name(glb, mesh, part >= 0 ? m->parts[part].name : m->name);
    glb_set(glb, mesh, "primitives", primitives);
    return arrays->first_mesh = glb_add(glb, glb->meshes, mesh);
}
