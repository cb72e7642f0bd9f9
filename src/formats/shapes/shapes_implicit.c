// shapes_implicit.c: tessellates implicit surfaces f(p) = 0 by marching cubes, with a table that is computed here.
//
// The box is divided into cells. A lattice point is inside if f < 0; 0 and NaN are outside. The surface crosses an edge
// of a cell if one end of the edge is inside and the other is outside. The edge then contains one vertex, which all
// cells at the edge share. Root finding along the edge places the vertex on the surface, up to rounding. The vertex's
// normal is computed from ∇f.
//
// The table connects the vertices of a cell. Visit the edges of a face counter-clockwise, as seen from outside the
// cell. Each run of inside corners then begins after one crossed edge and ends before another. The surface intersects
// the face in a line from the first of these edges to the second. A face with two opposite inside corners contains two
// such lines, each of which cuts off one of these corners. This rule depends only on the face, so both cells at the
// face agree and the mesh has no holes. A crossed edge starts a line in one of its two faces and ends a line in the
// other, so the lines form closed loops. Seen from outside the surface, the loops are counter-clockwise. Loops are
// triangulated with diagonals that are not in a face, because the neighbouring cell might have the same diagonal. Among
// these triangulations, the code chooses the one whose triangles agree best with the normals at their corners.
#include "shapes.h"

#include "fail.h"
#include "linear.h"
#include "origin.h"

#include <string.h>

// Corner numbers of a cell: x + 2y + 4z. Edge numbers: 4·axis + a + 2b. a and b are the coordinates on the other two
// axes, in the order x, y, z.
enum { CORNERS = 8, EDGES = 12, LOOPS_MAX = EDGES / 3 };

// The loops of one of the 256 cases, with their edges concatenated.
struct cell_case {
    uint8_t loops;
    uint8_t counts[LOOPS_MAX];
    uint8_t edges[EDGES];
};

// --- The table

// Returns the edge between two corners that differ in one coordinate.
static int edge_between(int a, int b)
{
    int axis = (a ^ b) == 1 ? 0 : (a ^ b) == 2 ? 1 : 2;
    int low = a & b; // the end with coordinate 0 on the axis
    int others = axis == 0 ? low >> 1 : axis == 1 ? (low & 1) | (low >> 1 & 2) : low & 3;
    return 4 * axis + others;
}

// Returns corner k of a face, counter-clockwise seen from outside the cell. The face number is 2·axis + side.
static int face_corner(int face, int k)
{
    int axis = face >> 1, side = face & 1;
    int u = (axis + 1) % 3, v = (axis + 2) % 3; // u × v points along +axis
    int turn = side ? k : 3 - k;                // seen from the other side, the order is reversed
    static const int steps[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    return side << axis | steps[turn][0] << u | steps[turn][1] << v;
}

// Sets next[e] to the edge at which the surface's line from edge e ends, or to −1 if the surface does not cross edge e.
static void link_edges(int inside, int next[EDGES])
{
    for (int e = 0; e < EDGES; e++)
        next[e] = -1;
    for (int face = 0; face < 6; face++)
        for (int k = 0; k < 4; k++) {
            int from = face_corner(face, k), to = face_corner(face, (k + 1) % 4);
            bool leaves = (inside >> from & 1) && !(inside >> to & 1);
            if (!leaves)
                continue;
            int entry = k; // the first corner of the run
            while (inside >> face_corner(face, (entry + 3) % 4) & 1)
                entry = (entry + 3) % 4;
            next[edge_between(face_corner(face, (entry + 3) % 4), face_corner(face, entry))] = edge_between(from, to);
        }
}

// Returns whether two edges share a face of the cell. An edge belongs to the two faces that its other coordinates
// select.
static bool share_face(int a, int b)
{
    for (int axis = 0; axis < 3; axis++) {
        int side[2], edges[2] = {a, b};
        for (int k = 0; k < 2; k++) {
            int own = edges[k] >> 2, others = edges[k] & 3;
            int first = own == 0 ? 1 : 0; // the lower of the other two axes
            side[k] = own == axis ? 2 : axis == first ? others & 1 : others >> 1;
        }
        if (side[0] == side[1] && side[0] != 2)
            return true;
    }
    return false;
}

static void make_table(struct cell_case table[256])
{
    for (int inside = 0; inside < 256; inside++) {
        struct cell_case *cell = &table[inside];
        int next[EDGES], used = 0;
        bool done[EDGES] = {false};
        cell->loops = 0;
        link_edges(inside, next);
        for (int e = 0; e < EDGES; e++) {
            int count = 0;
            for (int at = e; next[at] >= 0 && !done[at]; at = next[at]) {
                done[at] = true;
                cell->edges[used++] = (uint8_t)at;
                count++;
            }
            if (count)
                cell->counts[cell->loops++] = (uint8_t)count;
        }
    }
}

// --- Marching

#define NO_VERTEX UINT32_MAX

struct march {
    const lam_implicit *surface;
    int cells[3];
    double origin[3];
    struct arena *scratch; // memory for lists and planes
    struct call_control *call;
    lam_error *error;

    double *values[2];       // f at the lattice points of the plane below and above
    uint32_t *crossed[2][2]; // vertices on the x and y edges of the two planes
    uint32_t *upright;       // vertices on the z edges between the two planes
    uint32_t *corners[2];    // vertices on lattice points of the two planes

    float *positions, *normals;
    uint32_t *indices;
    size_t vertices, vertex_capacity, count, index_capacity; // count: number of indices
};

static double coordinate(const struct march *m, int axis, int i)
{
    const lam_implicit *s = m->surface;
    double low[3] = {s->minimum.x, s->minimum.y, s->minimum.z}, high[3] = {s->maximum.x, s->maximum.y, s->maximum.z};
    int n = m->cells[axis];
    if (i <= 0)
        return low[axis];
    if (i >= n)
        return high[axis];
    return (low[axis] * (n - i) + high[axis] * i) / n;
}

static lam_vec3 lattice(const struct march *m, int x, int y, int z)
{
    return v3(coordinate(m, 0, x), coordinate(m, 1, y), coordinate(m, 2, z));
}

static bool is_inside(double value) { return value < 0; }

// Returns the root of f between a (0) and b (1) by the Illinois method, a variant of regula falsi that halves the value
// at an end that was kept twice.
static double find_root(const struct march *m, lam_vec3 a, lam_vec3 b, double fa, double fb)
{
    const lam_implicit *s = m->surface;
    lam_vec3 edge = v3_sub(b, a);
    double low = 0, high = 1, before = -1;
    bool a_inside = is_inside(fa);
    int replaced = 0; // the most recently replaced end: −1 low, 1 high
    for (int step = 0; step < 64; step++) {
        double t = low + (high - low) * (fa / (fa - fb));
        if (!(t > low && t < high) || !math_finite(t))
            t = 0.5 * low + 0.5 * high;
        double f = s->value(s->user, v3_add(a, v3_scale(edge, t)));
        double change = t - before;
        if (f == 0 || (change > -1e-12 && change < 1e-12))
            return t;
        before = t;
        if (is_inside(f) == a_inside) {
            low = t;
            fa = f;
            if (replaced < 0)
                fb *= 0.5;
            replaced = -1;
        } else {
            high = t;
            fb = f;
            if (replaced > 0)
                fa *= 0.5;
            replaced = 1;
        }
        if (high - low < 1e-12)
            return high;
    }
    return before;
}

// Returns the normalized gradient of f. If the gradient is zero or not finite, uses central differences of f over a
// hundredth of a cell instead.
static lam_vec3 normal_at(const struct march *m, lam_vec3 p)
{
    const lam_implicit *s = m->surface;
    lam_vec3 n = s->gradient(s->user, p);
    if (v3_finite(n) && v3_length(n) > 0)
        return v3_unit(n);
    double h = 0.01 * (s->maximum.x - s->minimum.x) / m->cells[0];
    n = v3(s->value(s->user, v3(p.x + h, p.y, p.z)) - s->value(s->user, v3(p.x - h, p.y, p.z)),
           s->value(s->user, v3(p.x, p.y + h, p.z)) - s->value(s->user, v3(p.x, p.y - h, p.z)),
           s->value(s->user, v3(p.x, p.y, p.z + h)) - s->value(s->user, v3(p.x, p.y, p.z - h)));
    return v3_finite(n) ? v3_unit(n) : v3(0, 0, 0);
}

// Grows a list to a capacity of at least `needed`.
static bool grow(struct march *m, void **list, size_t *capacity, size_t needed, size_t size)
{
    if (needed <= *capacity)
        return true;
    size_t larger = *capacity ? *capacity * 2 : 1 << 14;
    void *copy = arena_array(m->scratch, larger, size);
    if (!copy)
        return call_memory_error(m->call, larger * size, m->error);
    if (*capacity)
        memcpy(copy, *list, *capacity * size);
    *list = copy;
    *capacity = larger;
    return true;
}

static void to_float(const struct march *m, lam_vec3 p, float out[3])
{
    out[0] = (float)(p.x - m->origin[0] + 0.0);
    out[1] = (float)(p.y - m->origin[1] + 0.0);
    out[2] = (float)(p.z - m->origin[2] + 0.0);
}

// Adds a vertex at p. If p rounds to the lattice point `at`, uses the vertex of that point, *corner, instead.
static bool add_vertex(struct march *m, lam_vec3 p, lam_vec3 at, uint32_t *corner, uint32_t *id)
{
    float position[3], lattice_position[3];
    to_float(m, p, position);
    to_float(m, at, lattice_position);
    bool on_lattice = memcmp(position, lattice_position, sizeof position) == 0;
    if (on_lattice && *corner != NO_VERTEX) {
        *id = *corner;
        return true;
    }
    if (m->vertices >= SHAPE_VERTICES_MAX)
        return fail(m->error, LAM_LIMIT, "implicit surface: more than %d vertices", SHAPE_VERTICES_MAX);
    size_t capacity = m->vertex_capacity;
    if (!grow(m, (void **)&m->positions, &capacity, m->vertices + 1, 3 * sizeof(float)) ||
        !grow(m, (void **)&m->normals, &m->vertex_capacity, m->vertices + 1, 3 * sizeof(float)))
        return false;
    lam_vec3 n = normal_at(m, p);
    float *normal = m->normals + 3 * m->vertices;
    normal[0] = (float)(n.x + 0.0);
    normal[1] = (float)(n.y + 0.0);
    normal[2] = (float)(n.z + 0.0);
    memcpy(m->positions + 3 * m->vertices, position, sizeof position);
    *id = (uint32_t)m->vertices++;
    if (on_lattice)
        *corner = *id;
    return true;
}

// Adds the vertex on the edge between two neighbouring lattice points, if the surface crosses it.
static bool cross_edge(struct march *m, const int from[3], const int to[3], int plane_from, int plane_to, uint32_t *id)
{
    size_t row = (size_t)m->cells[0] + 1;
    size_t i = (size_t)from[1] * row + (size_t)from[0], j = (size_t)to[1] * row + (size_t)to[0];
    double a = m->values[plane_from][i], b = m->values[plane_to][j];
    *id = NO_VERTEX;
    if (is_inside(a) == is_inside(b))
        return true;
    lam_vec3 pa = lattice(m, from[0], from[1], from[2]), pb = lattice(m, to[0], to[1], to[2]);
    double t = find_root(m, pa, pb, a, b);
    lam_vec3 p = v3_add(pa, v3_scale(v3_sub(pb, pa), t));
    bool nearer_a = t < 0.5;
    return add_vertex(m, p, nearer_a ? pa : pb, nearer_a ? &m->corners[plane_from][i] : &m->corners[plane_to][j], id);
}

static bool evaluate_plane(struct march *m, int z, int plane)
{
    const lam_implicit *s = m->surface;
    size_t at = 0;
    for (int y = 0; y <= m->cells[1]; y++) {
        if (!call_should_continue(m->call))
            return call_error(m->call, m->error);
        for (int x = 0; x <= m->cells[0]; x++) {
            m->corners[plane][at] = NO_VERTEX;
            m->values[plane][at++] = s->value(s->user, lattice(m, x, y, z));
        }
    }
    return true;
}

static bool cross_plane(struct march *m, int z, int plane)
{
    size_t row = (size_t)m->cells[0] + 1;
    for (int y = 0; y <= m->cells[1]; y++)
        for (int x = 0; x <= m->cells[0]; x++) {
            size_t at = (size_t)y * row + (size_t)x;
            if (x < m->cells[0] &&
                !cross_edge(m, (int[]){x, y, z}, (int[]){x + 1, y, z}, plane, plane, &m->crossed[plane][0][at]))
                return false;
            if (y < m->cells[1] &&
                !cross_edge(m, (int[]){x, y, z}, (int[]){x, y + 1, z}, plane, plane, &m->crossed[plane][1][at]))
                return false;
        }
    return true;
}

static bool cross_between(struct march *m, int z, int below, int above)
{
    size_t row = (size_t)m->cells[0] + 1;
    for (int y = 0; y <= m->cells[1]; y++)
        for (int x = 0; x <= m->cells[0]; x++)
            if (!cross_edge(m, (int[]){x, y, z}, (int[]){x, y, z + 1}, below, above,
                            &m->upright[(size_t)y * row + (size_t)x]))
                return false;
    return true;
}

// Returns the vertex on an edge of a cell. `at` is the index of the cell's first corner in its plane.
static uint32_t edge_vertex(const struct march *m, int edge, size_t at, int below, int above)
{
    size_t row = (size_t)m->cells[0] + 1;
    size_t first = edge & 1, second = edge >> 1 & 1;
    switch (edge >> 2) {
    case 0: // the other coordinates are y, z
        return m->crossed[second ? above : below][0][at + first * row];
    case 1: // x, z
        return m->crossed[second ? above : below][1][at + first];
    default: // x, y
        return m->upright[at + first + second * row];
    }
}

// Returns 1 − the smallest cosine between a triangle's normal and the normals at its corners: 0 if all normals are
// equal, 2 if one is opposite.
static double normal_deviation(const struct march *m, uint32_t a, uint32_t b, uint32_t c)
{
    const float *p[3] = {m->positions + 3 * (size_t)a, m->positions + 3 * (size_t)b, m->positions + 3 * (size_t)c};
    const uint32_t ids[3] = {a, b, c};
    lam_vec3 first = v3((double)p[0][0], (double)p[0][1], (double)p[0][2]);
    lam_vec3 face = v3_unit(v3_cross(v3_sub(v3((double)p[1][0], (double)p[1][1], (double)p[1][2]), first),
                                     v3_sub(v3((double)p[2][0], (double)p[2][1], (double)p[2][2]), first)));
    double min = 1;
    for (int k = 0; k < 3; k++) {
        const float *n = m->normals + 3 * (size_t)ids[k];
        double cosine = v3_dot(face, v3((double)n[0], (double)n[1], (double)n[2]));
        min = cosine < min ? cosine : min;
    }
    return 1 - min;
}

static void add_triangle(struct march *m, uint32_t a, uint32_t b, uint32_t c)
{
    if (a == b || b == c || c == a)
        return;
    m->indices[m->count] = a;
    m->indices[m->count + 1] = b;
    m->indices[m->count + 2] = c;
    m->count += 3;
}

// Triangulates a loop at minimum cost by dynamic programming. The cost of the polygon from i to j is the minimum, over
// k, of the cost of triangle i–k–j plus the costs of the polygons from i to k and from k to j.
static void triangulate_loop(struct march *m, const uint8_t *edges, const uint32_t *ids, int count)
{
    const double in_a_face = 1000;
    double cost[EDGES][EDGES] = {{0}};
    int apex[EDGES][EDGES] = {{0}};
    if (count == 3) {
        add_triangle(m, ids[0], ids[1], ids[2]);
        return;
    }
    for (int span = 2; span < count; span++)
        for (int i = 0; i + span < count; i++) {
            int j = i + span;
            cost[i][j] = 1e9;
            for (int k = i + 1; k < j; k++) {
                double c = cost[i][k] + cost[k][j] + normal_deviation(m, ids[i], ids[k], ids[j]);
                c += k > i + 1 && share_face(edges[i], edges[k]) ? in_a_face : 0;
                c += k < j - 1 && share_face(edges[k], edges[j]) ? in_a_face : 0;
                if (c < cost[i][j]) {
                    cost[i][j] = c;
                    apex[i][j] = k;
                }
            }
        }
    int stack[EDGES][2] = {{0, count - 1}}, depth = 1;
    while (depth > 0) {
        depth--;
        int i = stack[depth][0], j = stack[depth][1], k = apex[i][j];
        if (j - i < 2)
            continue;
        add_triangle(m, ids[i], ids[k], ids[j]);
        stack[depth][0] = i;
        stack[depth++][1] = k;
        stack[depth][0] = k;
        stack[depth++][1] = j;
    }
}

// Adds the triangles of the cells between two planes.
static bool fill_layer(struct march *m, const struct cell_case *table, int below, int above)
{
    size_t row = (size_t)m->cells[0] + 1;
    for (int y = 0; y < m->cells[1]; y++)
        for (int x = 0; x < m->cells[0]; x++) {
            size_t at = (size_t)y * row + (size_t)x;
            int inside = 0;
            for (int corner = 0; corner < CORNERS; corner++) {
                const double *values = m->values[corner & 4 ? above : below];
                inside |= is_inside(values[at + (corner & 1) + (corner & 2 ? row : 0)]) << corner;
            }
            const struct cell_case *cell = &table[inside];
            if (!cell->loops)
                continue;
            if (!grow(m, (void **)&m->indices, &m->index_capacity, m->count + 3 * EDGES, sizeof(uint32_t)))
                return false;
            const uint8_t *edges = cell->edges;
            for (int loop = 0; loop < cell->loops; edges += cell->counts[loop++]) {
                uint32_t ids[EDGES];
                for (int k = 0; k < cell->counts[loop]; k++)
                    ids[k] = edge_vertex(m, edges[k], at, below, above);
                triangulate_loop(m, edges, ids, cell->counts[loop]);
            }
        }
    return true;
}

static bool march_all(struct march *m)
{
    size_t points = ((size_t)m->cells[0] + 1) * ((size_t)m->cells[1] + 1);
    bool ok = true;
    for (int k = 0; k < 2; k++) {
        m->values[k] = arena_array(m->scratch, points, sizeof(double));
        m->corners[k] = arena_array(m->scratch, points, sizeof(uint32_t));
        m->crossed[k][0] = arena_array(m->scratch, points, sizeof(uint32_t));
        m->crossed[k][1] = arena_array(m->scratch, points, sizeof(uint32_t));
        ok = ok && m->values[k] && m->corners[k] && m->crossed[k][0] && m->crossed[k][1];
    }
    m->upright = arena_array(m->scratch, points, sizeof(uint32_t));
    struct cell_case *table = arena_array(m->scratch, 256, sizeof *table);
    if (!ok || !m->upright || !table)
        return call_memory_error(m->call, points * 44, m->error);
    make_table(table);
    if (!evaluate_plane(m, 0, 0) || !cross_plane(m, 0, 0))
        return false;
    for (int z = 0; z < m->cells[2]; z++) {
        int below = z & 1, above = !below;
        if (!evaluate_plane(m, z + 1, above) || !cross_plane(m, z + 1, above) || !cross_between(m, z, below, above) ||
            !fill_layer(m, table, below, above))
            return false;
    }
    return true;
}

static bool check(const lam_implicit *s, lam_error *error)
{
    const char *kind = "implicit surface";
    if (!s->value || !s->gradient)
        return fail(error, LAM_BAD_ARGUMENT, "%s: the function `%s` is NULL", kind, s->value ? "gradient" : "value");
    if (!v3_finite(s->minimum) || !v3_finite(s->maximum))
        return fail(error, LAM_BAD_ARGUMENT, "%s: a side of the box is not finite", kind);
    double low[3] = {s->minimum.x, s->minimum.y, s->minimum.z}, high[3] = {s->maximum.x, s->maximum.y, s->maximum.z};
    for (int a = 0; a < 3; a++)
        if (!(low[a] < high[a]) || !(high[a] - low[a] < 1e38))
            return fail(error, LAM_BAD_ARGUMENT,
                        "%s: the box goes from %g to %g along %c, expected a length in 0 to 1e38", kind, low[a],
                        high[a], "xyz"[a]);
    if (s->cells != 0 && (s->cells < 2 || s->cells > 1024))
        return fail(error, LAM_BAD_ARGUMENT, "%s: cells is %d, expected 2 to 1024, or 0", kind, s->cells);
    return true;
}

bool tessellate_implicit(const lam_implicit *surface, struct arena *arena, struct call_control *call, lam_mesh *mesh,
                         lam_error *error)
{
    if (!check(surface, error))
        return false;
    struct arena scratch;
    arena_start(&scratch, call);
    struct march m = {.surface = surface, .scratch = &scratch, .call = call, .error = error};
    double low[3] = {surface->minimum.x, surface->minimum.y, surface->minimum.z};
    double high[3] = {surface->maximum.x, surface->maximum.y, surface->maximum.z};
    double longest = 0;
    for (int a = 0; a < 3; a++)
        longest = high[a] - low[a] > longest ? high[a] - low[a] : longest;
    int cells = surface->cells ? surface->cells : 96;
    for (int a = 0; a < 3; a++) {
        double exact = cells * ((high[a] - low[a]) / longest); // in (0, 1024]
        m.cells[a] = (int)exact;
        m.cells[a] += m.cells[a] < exact - 1e-9 || m.cells[a] == 0;
    }
    origin_choose(low, high, m.origin);
    bool ok = march_all(&m);
    if (ok) {
        float *positions = arena_array(arena, m.vertices, 3 * sizeof(float));
        float *normals = arena_array(arena, m.vertices, 3 * sizeof(float));
        uint32_t *indices = arena_array(arena, m.count, sizeof(uint32_t));
        ok = positions && normals && indices;
        if (!ok)
            call_memory_error(call, m.vertices * 24 + m.count * 4, error);
        if (ok && m.count) {
            memcpy(positions, m.positions, m.vertices * 3 * sizeof(float));
            memcpy(normals, m.normals, m.vertices * 3 * sizeof(float));
            memcpy(indices, m.indices, m.count * sizeof(uint32_t));
        }
        *mesh = (lam_mesh){
            .origin = {m.origin[0], m.origin[1], m.origin[2]},
            .positions = positions,
            .vertex_count = (uint32_t)m.vertices,
            .indices = indices,
            .triangle_count = (uint32_t)(m.count / 3),
            .normals = normals,
            .normal_count = (uint32_t)m.vertices,
        };
    }
    arena_free(&scratch);
    return ok;
}
