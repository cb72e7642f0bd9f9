// surface_lattice.c: finds the points at which the lines of a lattice pass through triangles.
#include "surface_lattice.h"

#define LANES 4
#include "lanes.h"
#include "linear.h"

// The distance of the first line from the box. It is not a simple fraction, so that lines rarely meet edges.
#define PHASE 0.381966

enum { AREA_UNIT = 1 << 16 };

lam_mat4 unplaced_transform(const struct lam_scene *scene, int object)
{
    const lam_mat4 *transform = &scene_object(scene, object)->transform;
    lam_mat4 inverse;
    if (memcmp(transform, &scene->placement, sizeof *transform) == 0)
        return lam_mat4_identity(); // exactly, so that nothing changes while a model turns
    return mat4_inverse_affine(&scene->placement, &inverse) ? mat4_mul(&inverse, transform) : *transform;
}

struct surface_lattice surface_lattice_of(const struct lam_scene *scene)
{
    struct surface_lattice lattice;
    lam_vec3 low = v3(1e308, 1e308, 1e308), high = v3(-1e308, -1e308, -1e308);
    for (int i = 0; i < scene->objects.count; i++) {
        const lam_object *object = scene_object(scene, i);
        const struct scene_extent *extent = scene_extent(scene, object->mesh);
        if (!extent->used_count || !scene_shows(scene, i) || mesh_is_strokes(scene_mesh(scene, object->mesh)))
            continue;
        const lam_mat4 transform = unplaced_transform(scene, i);
        for (int k = 0; k < 8; k++) {
            lam_vec3 p = mat4_point(&transform, v3(k & 1 ? extent->maximum.x : extent->minimum.x,
                                                   k & 2 ? extent->maximum.y : extent->minimum.y,
                                                   k & 4 ? extent->maximum.z : extent->minimum.z));
            low = v3(p.x < low.x ? p.x : low.x, p.y < low.y ? p.y : low.y, p.z < low.z ? p.z : low.z);
            high = v3(p.x > high.x ? p.x : high.x, p.y > high.y ? p.y : high.y, p.z > high.z ? p.z : high.z);
        }
    }
    lattice.low = low;
    lattice.spacing = low.x <= high.x ? v3_length(v3_sub(high, low)) / LATTICE : 0;
    return lattice;
}

// The lattice in the space of one mesh: the lines are at whole numbers of position * scale + offset.
struct mesh_lattice {
    const lam_mesh *mesh;
    num scale, offset;
    uint32_t last; // the last vertex; `tail` is a copy that four floats can be loaded from
    float tail[4];
    lam_mat4 transform; // from directions of the lattice to the lattice of the whole scene
    lattice_visitor *visitor;
    void *user;
};

static bool mesh_lattice_make(struct mesh_lattice *m, const struct surface_lattice *lattice,
                              const struct lam_scene *scene, int index)
{
    const lam_object *object = scene_object(scene, index);
    const lam_mesh *mesh = scene_mesh(scene, object->mesh);
    const struct scene_extent *extent = scene_extent(scene, object->mesh);
    lam_mat4 transform = unplaced_transform(scene, index);
    const lam_vec3 x = mat4_vector(&transform, v3(1, 0, 0)), y = mat4_vector(&transform, v3(0, 1, 0)),
                   z = mat4_vector(&transform, v3(0, 0, 1));
    const double largest[] = {v3_length(x), v3_length(y), v3_length(z)};
    const double unit = largest[0] > largest[1] ? largest[0] : largest[1];
    const double scale = (unit > largest[2] ? unit : largest[2]) / lattice->spacing;
    if (!mesh->triangle_count || mesh_is_strokes(mesh) || !math_finite(scale) || !(scale > 0))
        return false;
    const lam_vec3 origin = mat4_point(&transform, v3(mesh->origin[0], mesh->origin[1], mesh->origin[2]));
    const double starts[] = {origin.x - lattice->low.x, origin.y - lattice->low.y, origin.z - lattice->low.z},
                 least[] = {extent->minimum.x - mesh->origin[0], extent->minimum.y - mesh->origin[1],
                            extent->minimum.z - mesh->origin[2]};
    float scales[4] = {0}, offsets[4] = {0};
    for (int i = 0; i < 3; i++) {
        // Positions in the lattice are positive. If the object is rotated, this needs a shift by whole squares.
        const double start = starts[i] / lattice->spacing + PHASE, lowest = start + least[i] * scale;
        const double shift = lowest < 0 ? (double)(int64_t)lowest - 1 : 0;
        scales[i] = (float)scale;
        offsets[i] = (float)(start - shift);
        for (int j = 0; j < 3; j++)
            transform.m[i][j] /= scale * lattice->spacing;
    }
    *m = (struct mesh_lattice){.mesh = mesh,
                               .scale = num_load(scales),
                               .offset = num_load(offsets),
                               .transform = transform,
                               .last = mesh->vertex_count - 1};
    memcpy(m->tail, mesh->positions + 3 * (size_t)m->last, 3 * sizeof(float));
    return true;
}

static num position_of(const struct mesh_lattice *m, size_t corner)
{
    const uint32_t vertex = m->mesh->indices ? m->mesh->indices[corner] : (uint32_t)corner;
    return num_load(vertex == m->last ? m->tail : m->mesh->positions + 3 * (size_t)vertex);
}

// Returns where a row crosses the edge between two corners, if it does. The edge has the same position in the
// neighbouring triangle, so each point belongs to one triangle.
static bool crosses(const double *a, const double *b, int across, int along, int row, double *at)
{
    if ((a[along] < row) == (b[along] < row))
        return false;
    const double *low = a[along] < row ? a : b, *high = a[along] < row ? b : a;
    *at = low[across] + (row - low[along]) / (high[along] - low[along]) * (high[across] - low[across]);
    return true;
}

static int64_t fixed(double x) { return (int64_t)(x * AREA_UNIT + (x < 0 ? -0.5 : 0.5)); }

// Completes the parts of a row that all rows of a triangle share.
static void set_area(const struct mesh_lattice *m, struct lattice_row *row, const lam_vec3 edges[2], double size)
{
    const lam_vec3 area =
        v3_scale(v3_cross(mat4_vector(&m->transform, edges[0]), mat4_vector(&m->transform, edges[1])), 1 / size);
    row->area[0] = fixed(area.x);
    row->area[1] = fixed(area.y);
    row->area[2] = fixed(area.z);
    row->size = fixed(v3_length(area));
}

// Visits the points of a triangle, given its corners in the lattice. `directions` has a bit for each direction in which
// lines are between its ends.
static void visit_triangle(const struct mesh_lattice *m, uint32_t triangle, unsigned directions, double p[3][3])
{
    lam_vec3 edges[2];
    for (int k = 0; k < 2; k++)
        edges[k] = v3(p[k + 1][0] - p[0][0], p[k + 1][1] - p[0][1], p[k + 1][2] - p[0][2]);
    struct lattice_row row = {.triangle = triangle, .normal = v3_cross(edges[0], edges[1])};
    const double n[] = {row.normal.x, row.normal.y, row.normal.z};
    const double size[] = {n[0] < 0 ? -n[0] : n[0], n[1] < 0 ? -n[1] : n[1], n[2] < 0 ? -n[2] : n[2]};
    int axis = size[1] > size[0];
    axis = size[2] > size[axis] ? 2 : axis;
    const int across = (axis + 1) % 3, along = (axis + 2) % 3;
    if (!(size[axis] > 0) || (directions | 1u << axis) != 7)
        return;
    double low = p[0][along], high = low;
    for (int k = 1; k < 3; k++) {
        low = p[k][along] < low ? p[k][along] : low;
        high = p[k][along] > high ? p[k][along] : high;
    }
    for (int y = (int)low + 1; y <= (int)high; y++) {
        double ends[3] = {0};
        int count = 0;
        for (int k = 0; k < 3; k++)
            count += crosses(p[k], p[(k + 1) % 3], across, along, y, &ends[count]);
        const bool reversed = ends[0] > ends[1];
        const int x = (int)ends[reversed] + 1;
        row.points = (int)ends[!reversed] + 1 - x;
        if (row.points <= 0)
            continue;
        if (!row.size)
            set_area(m, &row, edges, size[axis]);
        double at[3] = {0};
        at[across] = row.x = x;
        at[along] = row.y = y;
        for (int k = 0; k < 3; k++) {
            const double *b = p[(k + 1) % 3], *c = p[(k + 2) % 3];
            row.weight[k] = ((b[across] - x) * (c[along] - y) - (b[along] - y) * (c[across] - x)) / n[axis];
            row.step[k] = (b[along] - c[along]) / n[axis];
            at[axis] += row.weight[k] * p[k][axis];
        }
        row.at = v3(at[0], at[1], at[2]);
        m->visitor(m->user, &row);
    }
}

void surface_lattice_visit(const struct surface_lattice *lattice, const struct lam_scene *scene, int object,
                           uint32_t first, uint32_t end, lattice_visitor *visitor, void *user)
{
    struct mesh_lattice m;
    if (!(lattice->spacing > 0) || !mesh_lattice_make(&m, lattice, scene, object))
        return;
    m.visitor = visitor;
    m.user = user;
    for (uint32_t t = first; t < end; t++) {
        num p[3];
        for (int k = 0; k < 3; k++)
            p[k] = position_of(&m, 3 * (size_t)t + (size_t)k);
        // A triangle contains a point only if lines of two directions are between its ends.
        const inum low = int_of(min_of(min_of(p[0], p[1]), p[2]) * m.scale + m.offset),
                   high = int_of(max_of(max_of(p[0], p[1]), p[2]) * m.scale + m.offset);
        const unsigned directions = mask_bits(low != high) & 7;
        if (!(0xe8 >> directions & 1))
            continue;
        double corners[3][3];
        for (int k = 0; k < 3; k++) {
            const num corner = p[k] * m.scale + m.offset;
            for (int i = 0; i < 3; i++)
                corners[k][i] = (double)lane(corner, i);
        }
        visit_triangle(&m, t, directions, corners);
    }
}
