// mikktspace.c: the groups of triangles around each corner, and their tangents.
//
// Triangles are taken in order, and each corner that has no group yet starts one: it grows across the edges that leave the
// corner, then across those that lead to it. A triangle without an orientation takes that of the first group that reaches
// it, so this order is part of the definition.
#include "mikktspace.h"

#include "edge_twins.h"
#include "linear.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { CHECK_INTERVAL = 1 << 13 }; // triangles between two checks of the call

struct triangle {
    float along[3];   // unit ∂p/∂s
    bool preserving;  // the texture is not mirrored
    bool joins_any;   // without a direction and, until a group has reached it, without an orientation
    bool has_a_group; // some corner has one
};

struct tangent_maker {
    const lam_mesh *mesh;
    struct corner_weld weld;
    struct edge_twins edges;
    struct triangle *triangles;
    bool *degenerate; // two of the triangle's positions are equal
    uint32_t *groups; // of each corner; NO_CORNER: none
    float *tangents;  // 4 for each group
    uint32_t group_count;
    bool t_down;
};

static const float *position_at(const lam_mesh *mesh, size_t corner)
{
    return mesh->positions + 3 * (size_t)mesh_element(NULL, mesh->indices, corner);
}

static lam_vec3 position_of(const lam_mesh *mesh, size_t corner)
{
    const float *p = position_at(mesh, corner);
    return v3((double)p[0], (double)p[1], (double)p[2]);
}

static lam_vec3 normal_of(const lam_mesh *mesh, size_t corner)
{
    const float *n = mesh->normals + 3 * (size_t)mesh_element(mesh->normal_indices, mesh->indices, corner);
    return v3_unit(v3((double)n[0], (double)n[1], (double)n[2]));
}

static bool equal_positions(const float a[3], const float b[3]) { return a[0] == b[0] && a[1] == b[1] && a[2] == b[2]; }

static bool is_degenerate(const lam_mesh *mesh, size_t triangle)
{
    const float *a = position_at(mesh, 3 * triangle), *b = position_at(mesh, 3 * triangle + 1);
    const float *c = position_at(mesh, 3 * triangle + 2);
    return equal_positions(a, b) || equal_positions(b, c) || equal_positions(c, a);
}

static float length3(const float v[3]) { return sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }
static bool is_not_zero(float x) { return fabsf(x) > FLT_MIN; }

// From p = p0 + ∂p/∂s·Δs + ∂p/∂t·Δt along two edges, times the area that the triangle has in the texture.
static struct triangle triangle_of(const lam_mesh *mesh, size_t triangle)
{
    const float *uv[3], *p[3];
    for (size_t k = 0; k < 3; k++) {
        size_t corner = 3 * triangle + k;
        uv[k] = mesh->texcoords + 2 * (size_t)mesh_element(mesh->texcoord_indices, mesh->indices, corner);
        p[k] = position_at(mesh, corner);
    }
    float s1 = uv[1][0] - uv[0][0], t1 = uv[1][1] - uv[0][1], s2 = uv[2][0] - uv[0][0], t2 = uv[2][1] - uv[0][1];
    float area = s1 * t2 - t1 * s2, along[3], across[3];
    for (int i = 0; i < 3; i++) {
        float d1 = p[1][i] - p[0][i], d2 = p[2][i] - p[0][i];
        along[i] = t2 * d1 - t1 * d2;
        across[i] = s1 * d2 - s2 * d1;
    }
    float along_length = length3(along), across_length = length3(across);
    struct triangle result = {.preserving = area > 0, .joins_any = true};
    if (!is_not_zero(area))
        return result;
    result.joins_any = !is_not_zero(along_length / fabsf(area)) || !is_not_zero(across_length / fabsf(area));
    float scale = is_not_zero(along_length) ? (result.preserving ? 1.0f : -1.0f) / along_length : 0;
    for (int i = 0; i < 3; i++)
        result.along[i] = scale * along[i];
    return result;
}

// The part of v perpendicular to n, made unit; n is unit.
static lam_vec3 in_plane(lam_vec3 v, lam_vec3 n) { return v3_unit(v3_sub(v, v3_scale(n, v3_dot(n, v)))); }

// The tangent without texture coordinates: around the y axis, or along x if the normal is along y. The same as in
// src/cpu/shade/attributes.inc.
static lam_vec3 field_tangent(lam_vec3 n)
{
    lam_vec3 around = v3_cross(v3(0, 1, 0), n);
    return v3_dot(around, around) < 1e-8 ? v3(1, 0, 0) : v3_unit(around);
}

// A triangle's share of the sum of its corner's group.
static lam_vec3 weighted_direction(const struct tangent_maker *m, uint32_t corner, lam_vec3 n)
{
    const struct triangle *triangle = &m->triangles[corner / 3];
    if (triangle->joins_any)
        return v3(0, 0, 0);
    lam_vec3 p = position_of(m->mesh, corner);
    lam_vec3 to = in_plane(v3_sub(position_of(m->mesh, next_corner(corner)), p), n);
    lam_vec3 from = in_plane(v3_sub(position_of(m->mesh, prev_corner(corner)), p), n);
    lam_vec3 along = v3((double)triangle->along[0], (double)triangle->along[1], (double)triangle->along[2]);
    return v3_scale(in_plane(along, n), math_acos(v3_dot(to, from)));
}

// Adds a corner to a group of this orientation. False: the group ends here.
static bool join_group(struct tangent_maker *m, uint32_t corner, uint32_t group, bool preserving)
{
    struct triangle *triangle = &m->triangles[corner / 3];
    if (m->groups[corner] != NO_CORNER)
        return false;
    if (triangle->joins_any && !triangle->has_a_group)
        triangle->preserving = preserving;
    if (triangle->preserving != preserving)
        return false;
    triangle->has_a_group = true;
    m->groups[corner] = group;
    return true;
}

static void write_tangent(float out[4], lam_vec3 t, float sign)
{
    out[0] = (float)t.x;
    out[1] = (float)t.y;
    out[2] = (float)t.z;
    out[3] = sign;
}

// Makes the group that starts at a corner, and its tangent.
static void make_group(struct tangent_maker *m, uint32_t corner)
{
    uint32_t group = m->group_count++, at, edge;
    bool preserving = m->triangles[corner / 3].preserving;
    lam_vec3 n = normal_of(m->mesh, corner);
    join_group(m, corner, group, preserving);
    lam_vec3 sum = weighted_direction(m, corner, n);
    for (at = corner; (edge = m->edges.twin[at]) != NO_CORNER;) {
        at = next_corner(edge);
        if (!join_group(m, at, group, preserving))
            break;
        sum = v3_add(sum, weighted_direction(m, at, n));
    }
    for (at = corner; (at = m->edges.twin[prev_corner(at)]) != NO_CORNER;) {
        if (!join_group(m, at, group, preserving))
            break;
        sum = v3_add(sum, weighted_direction(m, at, n));
    }
    sum = v3_dot(sum, sum) < 1e-24 ? field_tangent(n) : v3_unit(sum);
    write_tangent(m->tangents + 4 * (size_t)group, sum, preserving != m->t_down ? 1.0f : -1.0f);
}

// The corners that no group has reached: those of degenerate triangles copy the first other corner that is equal to them,
// the rest have a group of their own.
static void finish_corner(struct tangent_maker *m, uint32_t corner)
{
    uint32_t v = corner_weld_of(&m->weld, corner);
    if (m->edges.first[v] < m->edges.first[v + (size_t)1]) {
        uint32_t first = m->edges.list[m->edges.first[v]];
        if (m->groups[first] != NO_CORNER) {
            m->groups[corner] = m->groups[first];
            return;
        }
    }
    m->groups[corner] = m->group_count;
    write_tangent(m->tangents + 4 * (size_t)m->group_count++, field_tangent(normal_of(m->mesh, corner)), 1.0f);
}

static bool make_groups(struct tangent_maker *m, struct call_control *call, lam_error *error)
{
    uint32_t corners = 3 * m->mesh->triangle_count;
    memset(m->groups, 0xff, (size_t)corners * sizeof *m->groups);
    for (int finishing = 0; finishing < 2; finishing++)
        for (uint32_t corner = 0; corner < corners; corner++) {
            if (corner % CHECK_INTERVAL == 0 && !call_should_continue(call))
                return call_error(call, error);
            if (m->groups[corner] != NO_CORNER)
                continue;
            if (finishing)
                finish_corner(m, corner);
            else if (!m->degenerate[corner / 3] && !m->triangles[corner / 3].joins_any)
                make_group(m, corner);
        }
    return true;
}

static bool make(struct tangent_maker *m, struct arena *scratch, struct call_control *call, lam_error *error)
{
    size_t count = m->mesh->triangle_count;
    m->triangles = arena_array(scratch, count, sizeof *m->triangles);
    m->degenerate = arena_array(scratch, count, sizeof *m->degenerate);
    m->tangents = arena_array(scratch, 3 * count, 4 * sizeof *m->tangents);
    if (!m->triangles || !m->degenerate || !m->tangents)
        return call_memory_error(call, count * (sizeof *m->triangles + 1 + 12 * sizeof *m->tangents), error);
    for (size_t t = 0; t < count; t++) {
        if (t % CHECK_INTERVAL == 0 && !call_should_continue(call))
            return call_error(call, error);
        m->degenerate[t] = is_degenerate(m->mesh, t);
        m->triangles[t] = triangle_of(m->mesh, t);
    }
    return corner_weld(&m->weld, m->mesh, scratch, call, error) &&
           edge_twins(&m->edges, &m->weld, m->mesh->triangle_count, m->degenerate, scratch, call, error) &&
           make_groups(m, call, error);
}

bool mikktspace(struct mesh_tangents *out, const lam_mesh *mesh, bool t_down, struct arena *arena,
                struct call_control *call, lam_error *error)
{
    size_t corners = (size_t)mesh->triangle_count * 3;
    struct tangent_maker m = {.mesh = mesh, .t_down = t_down};
    struct arena scratch;
    arena_start(&scratch, call);
    m.groups = arena_array(arena, corners, sizeof *m.groups);
    bool ok = m.groups ? make(&m, &scratch, call, error) : call_memory_error(call, corners * sizeof *m.groups, error);
    if (ok) {
        size_t floats = 4 * (size_t)m.group_count;
        *out = (struct mesh_tangents){arena_array(arena, floats, sizeof *out->tangents), m.group_count, m.groups};
        if (out->tangents)
            memcpy(out->tangents, m.tangents, floats * sizeof *out->tangents);
        else
            ok = call_memory_error(call, floats * sizeof *out->tangents, error);
    }
    arena_free(&scratch);
    return ok;
}
