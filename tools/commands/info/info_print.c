// info_print.c: finds what prevents a model from being printed: holes, edges with more than two faces, and faces that are
// turned. Corners at the same position are one vertex, because STL files share no vertices.
#include "info.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "console.h"
#include "vectors.h"

// An edge of a triangle, from its lower vertex.
struct half {
    uint32_t low, high;
    bool backwards;
};

struct corner {
    float position[3];
    uint32_t index; // in the mesh's positions
};

static int by_position(const void *a, const void *b)
{
    const struct corner *x = a, *y = b;
    for (int k = 0; k < 3; k++)
        if (x->position[k] != y->position[k])
            return x->position[k] < y->position[k] ? -1 : 1;
    return 0;
}

static int by_ends(const void *a, const void *b)
{
    const struct half *x = a, *y = b;
    return x->low != y->low ? (x->low < y->low ? -1 : 1) : x->high != y->high ? (x->high < y->high ? -1 : 1) : 0;
}

// Gives equal numbers to equal positions.
static bool weld(const lam_mesh *mesh, uint32_t *numbers)
{
    struct corner *corners = malloc(((size_t)mesh->vertex_count + 1) * sizeof *corners);
    if (!corners)
        return false;
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        for (int k = 0; k < 3; k++)
            corners[i].position[k] = mesh->positions[3 * (size_t)i + (size_t)k];
        corners[i].index = i;
    }
    qsort(corners, mesh->vertex_count, sizeof *corners, by_position);
    for (uint32_t i = 0, first = 0; i < mesh->vertex_count; i++) {
        first = by_position(&corners[first], &corners[i]) == 0 ? first : i;
        numbers[corners[i].index] = corners[first].index;
    }
    free(corners);
    return true;
}

static uint32_t root_of(uint32_t *parents, uint32_t vertex)
{
    for (; parents[vertex] != vertex; vertex = parents[vertex])
        parents[vertex] = parents[parents[vertex]];
    return vertex;
}

// Keeps the longest holes, in order.
static void note_hole(struct info_print *print, struct info_hole hole)
{
    int at = print->holes++ < INFO_HOLES ? print->holes - 1 : INFO_HOLES - 1;
    if (print->holes > INFO_HOLES && print->longest[at].length >= hole.length)
        return;
    for (; at > 0 && print->longest[at - 1].length < hole.length; at--)
        print->longest[at] = print->longest[at - 1];
    print->longest[at] = hole;
}

// Joins the open edges to holes. `parents` has an element for each vertex.
static bool find_holes(const lam_mesh *mesh, const lam_mat4 *m, const struct half *open, size_t count,
                       uint32_t *parents, struct info_print *print)
{
    struct info_hole *holes = calloc((size_t)mesh->vertex_count + 1, sizeof *holes);
    if (!holes)
        return false;
    for (uint32_t i = 0; i < mesh->vertex_count; i++)
        parents[i] = i;
    for (size_t i = 0; i < count; i++)
        parents[root_of(parents, open[i].low)] = root_of(parents, open[i].high);
    for (size_t i = 0; i < count; i++) {
        struct info_hole *hole = &holes[root_of(parents, open[i].low)];
        const lam_vec3 a = info_place(mesh, m, open[i].low), b = info_place(mesh, m, open[i].high);
        hole->edges++;
        hole->length += sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y) + (a.z - b.z) * (a.z - b.z));
        hole->middle.x += 0.5 * (a.x + b.x);
        hole->middle.y += 0.5 * (a.y + b.y);
        hole->middle.z += 0.5 * (a.z + b.z);
    }
    for (uint32_t i = 0; i < mesh->vertex_count; i++)
        if (holes[i].edges) {
            const double share = 1.0 / holes[i].edges;
            holes[i].middle =
                (lam_vec3){holes[i].middle.x * share, holes[i].middle.y * share, holes[i].middle.z * share};
            note_hole(print, holes[i]);
        }
    free(holes);
    return true;
}

static bool check_edges(const lam_mesh *mesh, const lam_mat4 *m, struct info_print *print)
{
    struct half *halves = malloc((3 * (size_t)mesh->triangle_count + 1) * sizeof *halves);
    uint32_t *numbers = malloc(((size_t)mesh->vertex_count + 1) * sizeof *numbers);
    size_t count = 0, open = 0;
    bool ok = halves && numbers && weld(mesh, numbers);
    for (uint32_t t = 0; ok && t < mesh->triangle_count; t++) {
        uint32_t v[3];
        info_vertices(mesh, t, v);
        for (int k = 0; k < 3; k++)
            v[k] = numbers[v[k]];
        for (int k = 0; k < 3 && v[0] != v[1] && v[1] != v[2] && v[2] != v[0]; k++) {
            const uint32_t a = v[k], b = v[(k + 1) % 3];
            halves[count++] = a < b ? (struct half){a, b, false} : (struct half){b, a, true};
        }
    }
    if (ok)
        qsort(halves, count, sizeof *halves, by_ends);
    for (size_t i = 0, end; ok && i < count; i = end) {
        size_t backwards = 0;
        for (end = i; end < count && by_ends(&halves[i], &halves[end]) == 0; end++)
            backwards += halves[end].backwards;
        if (end - i == 1)
            halves[open++] = halves[i]; // open edges move to the front
        print->shared_edges += end - i > 2;
        print->turned_edges += end - i == 2 && backwards != 1;
    }
    print->open_edges += open;
    ok = ok && find_holes(mesh, m, halves, open, numbers, print);
    free(halves);
    free(numbers);
    return ok;
}

// Adds the overhangs, and the volume and its moments. `bed` is a height just above the lowest point.
static void add_faces(const lam_mesh *mesh, const lam_mat4 *m, const double up[3], double bed, double steepest,
                      struct info_print *print)
{
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        lam_vec3 p[3];
        double top = -1e308;
        uint32_t v[3];
        info_vertices(mesh, t, v);
        for (int k = 0; k < 3; k++) {
            p[k] = info_place(mesh, m, v[k]);
            const double height = p[k].x * up[0] + p[k].y * up[1] + p[k].z * up[2];
            top = height > top ? height : top;
        }
        const lam_vec3 n = cross((lam_vec3){p[1].x - p[0].x, p[1].y - p[0].y, p[1].z - p[0].z},
                                 (lam_vec3){p[2].x - p[0].x, p[2].y - p[0].y, p[2].z - p[0].z});
        const double area = 0.5 * sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
        const double down = -0.5 * (n.x * up[0] + n.y * up[1] + n.z * up[2]);
        const double six = n.x * p[0].x + n.y * p[0].y + n.z * p[0].z;
        if (down > steepest * area && top > bed)
            print->overhang_area += area;
        print->volume += six / 6;
        print->mass.x += six * (p[0].x + p[1].x + p[2].x) / 24;
        print->mass.y += six * (p[0].y + p[1].y + p[2].y) / 24;
        print->mass.z += six * (p[0].z + p[1].z + p[2].z) / 24;
    }
}

bool info_print_check(const lam_scene *scene, double overhang_deg, struct info_print *print, lam_error *error)
{
    lam_vec3 low, high;
    lam_scene_bounds(scene, &low, &high);
    const char *name = lam_up_name(lam_scene_up(scene));
    const bool negative = *name == '-';
    const int axis = name[negative] - 'x';
    const double lows[3] = {low.x, low.y, low.z}, highs[3] = {high.x, high.y, high.z};
    double up[3] = {0, 0, 0};
    up[axis] = negative ? -1 : 1;
    const double bed = (negative ? -highs[axis] : lows[axis]) + 1e-3 * (highs[axis] - lows[axis]);
    *print = (struct info_print){.overhang_deg = overhang_deg};
    for (int i = 0; i < lam_scene_object_count(scene); i++) {
        const lam_object *object = lam_scene_object(scene, i);
        const lam_mesh *mesh = lam_scene_mesh(scene, object->mesh);
        if (!mesh->triangle_count)
            continue;
        print->triangles = true;
        if (!check_edges(mesh, &object->transform, print))
            return complain(error, LAM_MACHINE, "out of memory");
        add_faces(mesh, &object->transform, up, bed, sin(radians(overhang_deg)), print);
    }
    const double share = print->volume != 0 ? 1 / print->volume : 0;
    print->mass = (lam_vec3){print->mass.x * share, print->mass.y * share, print->mass.z * share};
    print->printable =
        print->triangles && !print->open_edges && !print->shared_edges && !print->turned_edges && print->volume > 0;
    return true;
}
