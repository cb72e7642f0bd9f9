// scene_form.c: recognizes curved models and terrains, which the studio lights differently from models with flat faces.
#include "scene_internal.h"

#include "linear.h"
#include "surface_lattice.h"
#include "up_axis.h"

#include <lambent/material.h>

#include <string.h>

// A scene is a terrain if it is open and its area faces up: the vertical component of the sum of all area vectors must
// be more than FACING times the whole area. A closed surface faces all sides equally, so the sum is 0. A level plane is
// not a terrain, because light from the side would reveal no detail on the plane.
#define FACING 0.6
#define LEVEL  0.98

// Other scenes are curved if their normals differ: each normal falls into a cell of a cube around all directions, and
// the six fullest cells contain less than FLAT times the whole area. A box fills six cells completely. For scans and
// figures, these six cells contain 0.04 to 0.29 of the area; for machine parts and most low-poly models, 0.34 to 1.
#define FLAT 0.32

// The detail is the number of different planes through the points of the lattice, divided by the number of points. The
// number of triangles says less, because it grows if flat faces are divided. Scenes with less detail than COARSE are
// treated as flat: figures of a few hundred faces. Scenes with more detail than FINE show no faces.
#define COARSE 0.28
#define FINE   0.73

enum {
    SIDE = 7, // cells along an edge of the cube; odd, so that no axis lies between cells
    CELLS = 6 * SIDE * SIDE,
    FULLEST = 6,
    WORDS = 1 << 11, // words of 64 bits in a set of planes or points
    TURNS = 32,
    OFFSETS = 4,     // steps of the normals of planes, and of their distances from zero in the lattice
    CHUNK = 1 << 16, // triangles per parallel task
};

// Sums over the points of the lattice. Whole numbers, so that the order of the points has no effect.
struct sums {
    int64_t all, area[3], cells[CELLS];    // the area, the area vector, and the area for each direction of the normal
    uint64_t planes[WORDS], points[WORDS]; // sets of the different planes, and of the different points
};

// Returns the index of the cell for a coordinate −1 ≤ x ≤ 1 along one edge of the cube.
static int cell_along(double x)
{
    int cell = (int)((x + 1) * (0.5 * SIDE));
    return cell < SIDE ? cell : SIDE - 1;
}

// Returns the cell of a direction other than 0: the face of its largest component, then the row and the column.
static int cell_of(const double c[3])
{
    const double size[3] = {c[0] < 0 ? -c[0] : c[0], c[1] < 0 ? -c[1] : c[1], c[2] < 0 ? -c[2] : c[2]};
    int axis = size[1] > size[0];
    axis = size[2] > size[axis] ? 2 : axis;
    int column = cell_along(c[(axis + 1) % 3] / size[axis]), row = cell_along(c[(axis + 2) % 3] / size[axis]);
    return ((2 * axis + (c[axis] < 0)) * SIDE + row) * SIDE + column;
}

static uint64_t mixed(uint64_t hash, uint64_t value)
{
    hash = (hash ^ value) * 0x9e3779b97f4a7c15u;
    return hash ^ hash >> 29;
}

static int64_t rounded(double x) { return (int64_t)(x + (x < 0 ? -0.5 : 0.5)); }

static uint64_t mixed_vector(uint64_t hash, lam_vec3 v)
{
    return mixed(mixed(mixed(hash, (uint64_t)rounded(v.x)), (uint64_t)rounded(v.y)), (uint64_t)rounded(v.z));
}

static void put(uint64_t set[WORDS], uint64_t hash)
{
    __atomic_fetch_or(&set[hash >> 48 & (WORDS - 1)], UINT64_C(1) << (hash >> 42 & 63), __ATOMIC_RELAXED);
}

static void add_row(void *user, const struct lattice_row *row)
{
    struct sums *sum = user;
    const double normal[] = {row->normal.x, row->normal.y, row->normal.z};
    const lam_vec3 unit = v3_unit(row->normal);
    __atomic_fetch_add(&sum->all, row->size * row->points, __ATOMIC_RELAXED);
    for (int i = 0; i < 3; i++)
        __atomic_fetch_add(&sum->area[i], row->area[i] * row->points, __ATOMIC_RELAXED);
    __atomic_fetch_add(&sum->cells[cell_of(normal)], row->size * row->points, __ATOMIC_RELAXED);
    const uint64_t plane = mixed_vector((uint64_t)rounded(v3_dot(unit, row->at) * OFFSETS), v3_scale(unit, TURNS));
    put(sum->planes, plane);
    for (int i = 0; i < row->points; i++)
        put(sum->points, mixed(plane, (uint64_t)(row->x + i) << 32 | (uint64_t)row->y));
}

struct summing {
    const struct lam_scene *scene;
    struct surface_lattice lattice;
    struct sums *sum;
    int object;
};

static void sum_chunk(void *user, size_t index, int thread)
{
    (void)thread;
    const struct summing *summing = user;
    const uint32_t count =
                       scene_mesh(summing->scene, scene_object(summing->scene, summing->object)->mesh)->triangle_count,
                   first = (uint32_t)index * CHUNK, end = count - first > CHUNK ? first + CHUNK : count;
    surface_lattice_visit(&summing->lattice, summing->scene, summing->object, first, end, add_row, summing->sum);
}

// Returns the area in the fullest cells, and empties these cells.
static int64_t take_fullest(struct sums *sum)
{
    int64_t taken = 0;
    for (int i = 0; i < FULLEST; i++) {
        int fullest = 0;
        for (int cell = 1; cell < CELLS; cell++)
            if (sum->cells[cell] > sum->cells[fullest])
                fullest = cell;
        taken += sum->cells[fullest];
        sum->cells[fullest] = 0;
    }
    return taken;
}

static int members(const uint64_t set[WORDS])
{
    int count = 0;
    for (int i = 0; i < WORDS; i++)
        count += __builtin_popcountll(set[i]);
    return count;
}

struct surface_facts surface_facts(const struct lam_scene *scene, struct pool *pool)
{
    struct sums sum = {.all = 0};
    struct summing summing = {scene, surface_lattice_of(scene), &sum, 0};
    for (int i = 0; i < scene->objects.count; i++) {
        if (!scene_shows(scene, i))
            continue;
        summing.object = i;
        const size_t chunks =
            ((size_t)scene_mesh(scene, scene_object(scene, i)->mesh)->triangle_count + CHUNK - 1) / CHUNK;
        pool_run(chunks > 1 ? pool : NULL, chunks, sum_chunk, &summing);
    }
    const double all = sum.all ? (double)sum.all : 1, points = members(sum.points);
    return (struct surface_facts){
        .facing = v3((double)sum.area[0] / all, (double)sum.area[1] / all, (double)sum.area[2] / all),
        .fullest = (double)take_fullest(&sum) / all,
        .detail = points > 0 ? members(sum.planes) / points : 0,
    };
}

// Returns the direction of the sky before the placement of the scene.
static lam_vec3 up_of(const struct lam_scene *scene)
{
    const lam_vec3 up = from_y_up(lam_scene_up(scene), v3(0, 1, 0));
    const double(*m)[4] = scene->placement.m;
    return v3_unit(v3(m[0][0] * up.x + m[1][0] * up.y + m[2][0] * up.z,
                      m[0][1] * up.x + m[1][1] * up.y + m[2][1] * up.z,
                      m[0][2] * up.x + m[1][2] * up.y + m[2][2] * up.z));
}

// Returns a number that identifies the visible objects and the direction of the sky. Its lowest four bits are 0, and
// the others are not all 0.
static uint64_t key_of(const struct lam_scene *scene, lam_vec3 up)
{
    uint64_t key = mixed_vector((uint64_t)(uintptr_t)scene->token, v3_scale(up, 1 << 20));
    for (int i = 0; i < scene->objects.count; i++) {
        const lam_mat4 transform = unplaced_transform(scene, i);
        uint64_t words[sizeof transform / sizeof(uint64_t)];
        memcpy(words, &transform, sizeof words);
        key = mixed(key, (uint64_t)scene_object(scene, i)->mesh << 1 | scene_shows(scene, i));
        for (size_t k = 0; k < sizeof words / sizeof *words; k++)
            key = mixed(key, words[k]);
    }
    return (key | 1) << 4;
}

enum { KNOWN_FINE = 4 }; // the lowest bits of scene->known_form: a scene_form, and this bit if the scene is fine

int scene_find_form(const struct lam_scene *scene, struct pool *pool)
{
    if (!scene || scene->file.animation_count) // the form must not change between frames
        return FORM_FLAT;
    const lam_vec3 up = up_of(scene);
    const uint64_t key = key_of(scene, up), known = __atomic_load_n(scene->known_form, __ATOMIC_RELAXED);
    if (known >> 4 == key >> 4)
        return (int)(known & 15);
    const struct surface_facts facts = surface_facts(scene, pool);
    const double facing = v3_dot(facts.facing, up);
    enum scene_form form = facts.detail < COARSE               ? FORM_FLAT
                           : facing > FACING && facing < LEVEL ? FORM_TERRAIN
                           : facts.fullest < FLAT              ? FORM_CURVED
                                                               : FORM_FLAT;
    const int found = (int)form | (facts.detail > FINE ? KNOWN_FINE : 0);
    __atomic_store_n(scene->known_form, key | (uint64_t)found, __ATOMIC_RELAXED);
    return found;
}

enum scene_form scene_form(const struct lam_scene *scene)
{
    return (enum scene_form)(scene_find_form(scene, NULL) & ~KNOWN_FINE);
}

bool scene_is_fine(const struct lam_scene *scene) { return scene_find_form(scene, NULL) & KNOWN_FINE; }
