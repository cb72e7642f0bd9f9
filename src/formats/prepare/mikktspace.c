// mikktspace.c: finds the groups of triangles around each corner, and computes the tangents of the groups.
//
// Triangles are processed in order, and each corner without a group starts a new group. The group grows first across
// the edges that start at the corner, then across the edges that end at the corner. A triangle without an orientation
// gets the orientation of the first group that reaches it, so this order is part of the definition.
#include "mikktspace.h"

#include "cpu_features.h"
#include "tangent_steps.h"
#include "linear.h"

#include <string.h>

enum { CHECK_INTERVAL = 1 << 13 }; // the number of triangles or corners after which the call's limits are checked again
// a sum is treated as zero if its length is below this fraction of the sum of the summands' lengths
#define ZERO_SUM 1e-6

struct tangent_maker {
    const lam_mesh *mesh;
    const struct tangent_kernels *kernels;
    struct corner_weld weld;
    struct edge_twins edges;
    uint8_t *flags;   // flags of triangles (tangent_steps.h)
    uint32_t *groups; // the group of each corner, or NO_CORNER
    int8_t *signs;    // the sign of the bitangent for each group
    uint32_t group_count;
    bool t_down;
};

static lam_vec3 normal_of(const lam_mesh *mesh, size_t corner)
{
    const float *n = mesh->normals + 3 * (size_t)mesh_element(mesh->normal_indices, mesh->indices, corner);
    return v3_unit(v3((double)n[0], (double)n[1], (double)n[2]));
}

// Returns the tangent for a mesh without texture coordinates: around the y axis, or along x if the normal is along y,
// as in src/core/cpu/shade/attributes.inc.
static lam_vec3 field_tangent(lam_vec3 n)
{
    lam_vec3 around = v3_cross(v3(0, 1, 0), n);
    return v3_dot(around, around) < 1e-8 ? v3(1, 0, 0) : v3_unit(around);
}

// Adds a corner to a group with this orientation, TRIANGLE_PRESERVING or 0. Returns false if the corner cannot join the
// group.
static bool join_group(struct tangent_maker *m, uint32_t corner, uint32_t group, unsigned preserving)
{
    uint8_t *flags = &m->flags[corner / 3];
    if (m->groups[corner] != NO_CORNER)
        return false;
    if ((*flags & (TRIANGLE_JOINS_ANY | TRIANGLE_HAS_A_GROUP)) == TRIANGLE_JOINS_ANY)
        *flags = (uint8_t)((*flags & ~TRIANGLE_PRESERVING) | preserving);
    if ((*flags & TRIANGLE_PRESERVING) != preserving)
        return false;
    *flags |= TRIANGLE_HAS_A_GROUP;
    m->groups[corner] = group;
    return true;
}

// Makes the group that starts at a corner.
static void make_group(struct tangent_maker *m, uint32_t corner)
{
    uint32_t group = m->group_count++, at, edge;
    unsigned preserving = m->flags[corner / 3] & TRIANGLE_PRESERVING;
    m->signs[group] = (preserving != 0) != m->t_down ? 1 : -1;
    join_group(m, corner, group, preserving);
    for (at = corner; (edge = m->edges.twin[at]) != NO_CORNER;) {
        at = next_corner(edge);
        if (!join_group(m, at, group, preserving))
            break;
    }
    for (at = corner; (at = m->edges.twin[prev_corner(at)]) != NO_CORNER;)
        if (!join_group(m, at, group, preserving))
            break;
}

// Assigns a group to a corner that no group reached. If the list of corners contains equal corners and the first of
// these has a group, assigns this group. Otherwise, the corner starts its own group.
static void finish_corner(struct tangent_maker *m, uint32_t corner)
{
    uint32_t v = m->weld.of[corner];
    if (m->edges.first[v] < m->edges.first[v + (size_t)1]) {
        uint32_t first = m->edges.list[m->edges.first[v]];
        if (m->groups[first] != NO_CORNER) {
            m->groups[corner] = m->groups[first];
            return;
        }
    }
    m->signs[m->group_count] = 1;
    m->groups[corner] = m->group_count++;
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
            else if (!(m->flags[corner / 3] & (TRIANGLE_DEGENERATE | TRIANGLE_JOINS_ANY)))
                make_group(m, corner);
        }
    return true;
}

// Normalises the sums. A zero sum is replaced with the tangent for meshes without texture coordinates, computed from
// the normal of the group's corners.
static void finish_sums(const struct tangent_maker *m, float (*sums)[4])
{
    bool zeros = false;
    for (uint32_t g = 0; g < m->group_count; g++) {
        double x = (double)sums[g][0], y = (double)sums[g][1], z = (double)sums[g][2], square = x * x + y * y + z * z;
        double shortest = ZERO_SUM * (double)sums[g][3];
        bool some = square > shortest * shortest;
        double scale = some ? 1 / __builtin_sqrt(square) : 0;
        sums[g][0] = (float)(x * scale);
        sums[g][1] = (float)(y * scale);
        sums[g][2] = (float)(z * scale);
        sums[g][3] = (float)m->signs[g];
        zeros |= !some;
    }
    for (uint32_t corner = 0; zeros && corner < 3 * m->mesh->triangle_count; corner++) {
        float *sum = sums[m->groups[corner]];
        if (sum[0] != 0 || sum[1] != 0 || sum[2] != 0)
            continue;
        lam_vec3 t = field_tangent(normal_of(m->mesh, corner));
        sum[0] = (float)t.x;
        sum[1] = (float)t.y;
        sum[2] = (float)t.z;
    }
}

static bool look(struct tangent_maker *m, struct call_control *call, lam_error *error)
{
    uint32_t count = m->mesh->triangle_count;
    for (uint32_t t = 0, end; t < count; t = end) {
        end = count - t > CHECK_INTERVAL ? t + CHECK_INTERVAL : count;
        if (!call_should_continue(call))
            return call_error(call, error);
        m->kernels->look(m->mesh, t, end, m->flags);
    }
    return true;
}

static bool add(const struct tangent_maker *m, float (*sums)[4], struct call_control *call, lam_error *error)
{
    uint32_t count = m->mesh->triangle_count;
    for (uint32_t t = 0, end; t < count; t = end) {
        end = count - t > CHECK_INTERVAL ? t + CHECK_INTERVAL : count;
        if (!call_should_continue(call))
            return call_error(call, error);
        m->kernels->add(m->mesh, t, end, m->flags, m->groups, sums);
    }
    return true;
}

static bool group(struct tangent_maker *m, struct arena *scratch, struct call_control *call, lam_error *error)
{
    size_t count = m->mesh->triangle_count;
    m->flags = arena_array(scratch, count + TRIANGLES_AFTER, sizeof *m->flags);
    m->signs = arena_array(scratch, 3 * count, sizeof *m->signs);
    if (!m->flags || !m->signs)
        return call_memory_error(call, count * (sizeof *m->flags + 3 * sizeof *m->signs), error);
    return look(m, call, error) && corner_weld(&m->weld, m->mesh, scratch, call, error) &&
           edge_twins(&m->edges, &m->weld, m->mesh->triangle_count, m->flags, TRIANGLE_DEGENERATE, scratch, call,
                      error) &&
           make_groups(m, call, error);
}

bool mikktspace(struct mesh_tangents *out, const lam_mesh *mesh, bool t_down, struct arena *arena,
                struct call_control *call, lam_error *error)
{
    size_t corners = (size_t)mesh->triangle_count * 3;
    struct tangent_maker m = {.mesh = mesh, .t_down = t_down};
    struct arena scratch;
    arena_start(&scratch, call);
    m.kernels = CPU_WIDEST(16, tangent_kernels);
    m.groups = arena_array(arena, corners, sizeof *m.groups);
    bool ok = m.groups ? group(&m, &scratch, call, error) : call_memory_error(call, corners * sizeof *m.groups, error);
    float(*sums)[4] = NULL;
    if (ok && !(sums = arena_alloc_zeroed(arena, m.group_count * sizeof *sums)))
        ok = call_memory_error(call, m.group_count * sizeof *sums, error);
    ok = ok && add(&m, sums, call, error);
    if (ok) {
        finish_sums(&m, sums);
        *out = (struct mesh_tangents){*sums, m.group_count, m.groups};
    }
    arena_free(&scratch);
    return ok;
}
