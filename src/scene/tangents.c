// tangents.c: computes tangents from texture coordinates.
//
// A triangle's tangent is ∂p/∂s, the direction in which the first texture coordinate grows, from
//
//   p = p0 + ∂p/∂s·Δs + ∂p/∂t·Δt
//
// along two edges. Corners with the same position, normal, texture coordinate and orientation of the mapping share the
// mean of their triangles' tangents, weighted by the corner's angle: the result does not depend on the triangulation of
// a planar face. A counting sort lists the corners by vertex, in a fixed order: every run gives the same bits.
#include "scene_internal.h"

#include "fail.h"
#include "float_state.h"
#include "linear.h"

#include <stdlib.h>
#include <string.h>

enum { CHECK_INTERVAL = 1 << 13 }; // vertices or triangles between two checks of the call

// A corner of the mesh. Corners with equal keys (normal, texcoord, mirrored) share a tangent.
struct corner {
    uint32_t normal, texcoord, number;
    bool mirrored; // the mapping is mirrored: its bitangent is −n × t
};

static int by_key(const void *a, const void *b)
{
    const struct corner *x = a, *y = b;
    if (x->normal != y->normal)
        return x->normal < y->normal ? -1 : 1;
    if (x->texcoord != y->texcoord)
        return x->texcoord < y->texcoord ? -1 : 1;
    if (x->mirrored != y->mirrored)
        return x->mirrored ? 1 : -1;
    return (x->number > y->number) - (x->number < y->number);
}

struct tangents {
    const lam_mesh *mesh;
    size_t corners;
    float (*faces)[4];      // of each triangle: unit ∂p/∂s, and ±1 for the orientation; zeros if undefined
    uint32_t *first, *list; // corners by vertex: list[first[v]] … list[first[v + 1] − 1]
    float *tangents;        // the result, 4 per element
    uint32_t *indices;      // the result, one per corner
    uint32_t count;
    struct corner *shared; // scratch: the corners of one vertex
};

static uint32_t element(const uint32_t *own, const uint32_t *common, size_t corner)
{
    return own ? own[corner] : common ? common[corner] : (uint32_t)corner;
}

static lam_vec3 position_of(const lam_mesh *mesh, size_t corner)
{
    const float *p = mesh->positions + 3 * (size_t)element(NULL, mesh->indices, corner);
    return v3((double)p[0], (double)p[1], (double)p[2]);
}

static lam_vec3 normal_of(const lam_mesh *mesh, uint32_t at)
{
    const float *n = mesh->normals + 3 * (size_t)at;
    return v3_unit(v3((double)n[0], (double)n[1], (double)n[2]));
}

static void face_tangent(const lam_mesh *mesh, size_t triangle, float out[4])
{
    double s[3], t[3];
    lam_vec3 p[3];
    for (size_t k = 0; k < 3; k++) {
        size_t corner = 3 * triangle + k;
        const float *uv = mesh->texcoords + 2 * (size_t)element(mesh->texcoord_indices, mesh->indices, corner);
        s[k] = (double)uv[0];
        t[k] = (double)uv[1];
        p[k] = position_of(mesh, corner);
    }
    double area = (s[1] - s[0]) * (t[2] - t[0]) - (s[2] - s[0]) * (t[1] - t[0]);
    double orientation = area > 0 ? 1 : area < 0 ? -1 : 0;
    lam_vec3 along = v3_sub(v3_scale(v3_sub(p[1], p[0]), t[2] - t[0]), v3_scale(v3_sub(p[2], p[0]), t[1] - t[0]));
    along = v3_unit(v3_scale(along, orientation));
    bool defined = orientation != 0 && v3_finite(along) && v3_length(along) > 0.5;
    out[0] = defined ? (float)along.x : 0;
    out[1] = defined ? (float)along.y : 0;
    out[2] = defined ? (float)along.z : 0;
    out[3] = defined ? (float)orientation : 0;
}

// The angle of a triangle at one of its corners.
static double angle_at(const lam_mesh *mesh, uint32_t corner)
{
    size_t base = corner - corner % 3;
    lam_vec3 p = position_of(mesh, corner);
    lam_vec3 a = v3_unit(v3_sub(position_of(mesh, base + (corner + 1) % 3), p));
    lam_vec3 b = v3_unit(v3_sub(position_of(mesh, base + (corner + 2) % 3), p));
    return math_acos(v3_dot(a, b));
}

// The tangent without texture coordinates: around the y axis, or along x if the normal is along y. The same as in
// src/cpu/shade/attributes.inc.
static lam_vec3 field_tangent(lam_vec3 n)
{
    lam_vec3 around = v3_cross(v3(0, 1, 0), n);
    return v3_dot(around, around) < 1e-8 ? v3(1, 0, 0) : v3_unit(around);
}

// Adds one tangent for `count` corners of the same key.
static void add_tangent(struct tangents *m, const struct corner *corners, uint32_t count)
{
    lam_vec3 sum = v3(0, 0, 0), n = normal_of(m->mesh, corners[0].normal);
    for (uint32_t i = 0; i < count; i++) {
        const float *face = m->faces[corners[i].number / 3];
        double weight = face[3] != 0 ? angle_at(m->mesh, corners[i].number) : 0;
        sum = v3_add(sum, v3_scale(v3((double)face[0], (double)face[1], (double)face[2]), weight));
    }
    sum = v3_unit(sum);
    sum = v3_sub(sum, v3_scale(n, v3_dot(n, sum)));
    sum = v3_dot(sum, sum) < 1e-8 ? field_tangent(n) : v3_unit(sum); // along the normal: no direction
    float *out = m->tangents + 4 * (size_t)m->count;
    out[0] = (float)sum.x;
    out[1] = (float)sum.y;
    out[2] = (float)sum.z;
    out[3] = corners[0].mirrored ? -1.0f : 1.0f;
    for (uint32_t i = 0; i < count; i++)
        m->indices[corners[i].number] = m->count;
    m->count++;
}

static void add_vertex_tangents(struct tangents *m, uint32_t vertex)
{
    const lam_mesh *mesh = m->mesh;
    uint32_t count = m->first[vertex + 1] - m->first[vertex];
    for (uint32_t i = 0; i < count; i++) {
        uint32_t number = m->list[m->first[vertex] + i];
        m->shared[i] = (struct corner){element(mesh->normal_indices, mesh->indices, number),
                                       element(mesh->texcoord_indices, mesh->indices, number), number,
                                       m->faces[number / 3][3] < 0};
    }
    qsort(m->shared, count, sizeof *m->shared, by_key); // the order is total: any sorting gives the same
    for (uint32_t from = 0, to; from < count; from = to) {
        for (to = from + 1; to < count; to++)
            if (m->shared[to].normal != m->shared[from].normal || m->shared[to].texcoord != m->shared[from].texcoord ||
                m->shared[to].mirrored != m->shared[from].mirrored)
                break;
        add_tangent(m, &m->shared[from], to - from);
    }
}

// Lists the corners by vertex. Returns the maximum number of corners of a vertex.
static uint32_t list_corners(struct tangents *m, uint32_t vertices)
{
    uint32_t max = 0;
    for (size_t i = 0; i < m->corners; i++)
        m->first[element(NULL, m->mesh->indices, i) + 1]++;
    for (uint32_t v = 0; v < vertices; v++) {
        max = m->first[v + 1] > max ? m->first[v + 1] : max;
        m->first[v + 1] += m->first[v];
    }
    // Filling advances each start to its end; the loop after it restores them.
    for (size_t i = 0; i < m->corners; i++)
        m->list[m->first[element(NULL, m->mesh->indices, i)]++] = (uint32_t)i;
    for (uint32_t v = vertices; v > 0; v--)
        m->first[v] = m->first[v - 1];
    m->first[0] = 0;
    return max;
}

static bool make(struct lam_scene *scene, lam_mesh *mesh, struct arena *scratch, struct call_control *call,
                 lam_error *error)
{
    struct tangents m = {.mesh = mesh, .corners = (size_t)mesh->triangle_count * 3};
    uint32_t vertices = mesh->indices ? mesh->vertex_count : (uint32_t)m.corners;
    size_t starts = (size_t)vertices + 1;
    m.faces = arena_array(scratch, mesh->triangle_count, sizeof *m.faces);
    m.first = arena_alloc_zeroed(scratch, starts * sizeof *m.first);
    m.list = arena_array(scratch, m.corners, sizeof *m.list);
    float *tangents = arena_array(scratch, m.corners, 4 * sizeof *tangents);
    m.indices = arena_array(&scene->arena, m.corners, sizeof *m.indices);
    if (!m.faces || !m.first || !m.list || !tangents || !m.indices)
        return call_memory_error(call, m.corners * 4 * sizeof *tangents, error);
    m.tangents = tangents;
    for (size_t i = 0; i < mesh->triangle_count; i++) {
        if (i % CHECK_INTERVAL == 0 && !call_should_continue(call))
            return call_error(call, error);
        face_tangent(mesh, i, m.faces[i]);
    }
    m.shared = arena_array(scratch, list_corners(&m, vertices), sizeof *m.shared);
    if (!m.shared)
        return call_memory_error(call, 0, error);
    for (uint32_t v = 0; v < vertices; v++) {
        if (v % CHECK_INTERVAL == 0 && !call_should_continue(call))
            return call_error(call, error);
        add_vertex_tangents(&m, v);
    }
    float *kept = arena_array(&scene->arena, m.count, 4 * sizeof *kept);
    if (!kept)
        return call_memory_error(call, (size_t)m.count * 4 * sizeof *kept, error);
    memcpy(kept, tangents, (size_t)m.count * 4 * sizeof *kept);
    mesh->tangents = kept;
    mesh->tangent_count = m.count;
    mesh->tangent_indices = m.indices;
    return true;
}

bool lam_scene_make_tangents(lam_scene *scene, const lam_control *control, lam_error *error)
{
    if (!scene)
        return fail(error, LAM_BAD_ARGUMENT, "lam_scene_make_tangents: the scene is NULL");
    struct call_control call;
    call_start(&call, control);
    uint64_t state = float_state_enter();
    scene->arena.call = &call;
    bool ok = scene->deferred_crease_rad <= 0 || scene_prepare(scene, LAM_NORMALS_FILE, 0, NULL, &call, error);
    for (int i = 0; ok && i < scene->meshes.count; i++) {
        lam_mesh *mesh = (lam_mesh *)scene->meshes.items + i;
        if (mesh->tangents || !mesh->texcoords || !mesh->normals || !mesh->triangle_count)
            continue;
        struct arena scratch;
        arena_start(&scratch, &call);
        ok = make(scene, mesh, &scratch, &call, error);
        arena_free(&scratch);
    }
    scene_built(scene);
    float_state_leave(state);
    return ok;
}
