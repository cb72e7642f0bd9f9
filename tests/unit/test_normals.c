// test_normals.c: smooth and facet normals.
// The file has more than 600 lines because it contains a test for each rule, each kind of file that once failed, and
// the reference for all of them.

#include "test.h"

#include <time.h>

#include "arena.h"
#include "corner_fan.h"
#include "normals.h"
#include "pool.h"
#include "positions.h"
#include "visible_normals.h"

#include <lambent/scene.h>

#define RADIANS(degrees) ((degrees) * M_PI / 180)

// Computes the normals of the triangles of a mesh that `take` selects (0: all), numbered from `first` on; the arrays
// are in `arena`.
static bool make_some(const lam_mesh *mesh, uint32_t first, uint32_t take, int lanes, double crease_rad,
                      struct visible_normals *visible, struct arena *arena, struct pool *pool, lam_error *error)
{
    *visible = (struct visible_normals){.triangles.size = (size_t)first + mesh->triangle_count + 40};
    struct rank_bitset *set = &visible->triangles;
    size_t words = rank_bitset_words(set->size);
    set->bits = arena_alloc_zeroed(arena, words * sizeof *set->bits);
    set->ranks = arena_array(arena, words, sizeof *set->ranks);
    // Other meshes' triangles precede and follow.
    for (uint32_t i = 0; set->bits && i < set->size; i++)
        if (i < first ? i % 2 : i - first >= mesh->triangle_count || !take || (i - first) * 2654435761u % take == 0)
            rank_bitset_add(set, i);
    bool ok = set->bits && set->ranks;
    if (ok) {
        rank_bitset_finish(set);
        visible->elements = arena_array(arena, set->count, 3 * sizeof *visible->elements);
        visible->normals = arena_array(arena, set->count, 3 * sizeof *visible->normals);
        ok = visible->elements && visible->normals;
    }
    if (!ok) {
        error->code = LAM_MACHINE;
        return false;
    }
    memset(visible->elements, 0xff, (size_t)set->count * 12);
    // With scratch memory for a part of the required size, and without any.
    struct scratch_memory scratch = {.capacity = take == 17 ? 64 * (size_t)mesh->triangle_count : 0};
    scratch.memory = arena_alloc(arena, scratch.capacity + 64);
    if (scratch.memory && scratch.capacity)
        memset(scratch.memory, 0xa5, scratch.capacity);
    scratch.capacity = scratch.memory ? scratch.capacity : 0;
    return make_visible_normals(mesh, first, crease_rad, visible, &(struct normals_work){scratch, lanes, pool, NULL},
                                error);
}

// The normals of any subset of the triangles equal the normals of the whole mesh, and corners that share one there also
// share it here.
static void visible_as_all(const lam_mesh *mesh, double crease_degrees, struct pool *pool)
{
    static const uint32_t firsts[] = {0, 70, 64, 70, 0}, takes[] = {0, 3, 17, 3, 0};
    static const int lanes[] = {16, 16, 16, 8, 1};
    for (int k = 0; k < (mesh->triangle_count > 20000 ? 3 : 5); k++) { // large ones take time
        struct arena arena;
        arena_start(&arena, NULL);
        struct visible_normals visible;
        lam_error error = {0};
        lam_mesh bare = *mesh;
        bare.normals = NULL;
        bare.normal_indices = NULL;
        SUCCEEDS(
            make_some(&bare, firsts[k], takes[k], lanes[k], RADIANS(crease_degrees), &visible, &arena, pool, &error));
        uint32_t *same = arena_array(&arena, mesh->normal_count, sizeof *same), members = 0;
        uint8_t *wanted = arena_alloc_zeroed(&arena, (size_t)visible.used + 1);
        memset(same, 0xff, mesh->normal_count * sizeof *same);
        for (uint32_t t = 0; t < mesh->triangle_count; t++) {
            if (!rank_bitset_has(&visible.triangles, firsts[k] + t))
                continue;
            members++;
            for (uint32_t c = 0; c < 3; c++) {
                uint32_t element = visible_element(&visible, firsts[k] + t, c), made = mesh->normal_indices[3 * t + c];
                assert_memory_equal(visible.normals[element], mesh->normals + 3 * (size_t)made, 12);
                assert_true(same[made] == UINT32_MAX || same[made] == element);
                same[made] = element;
                assert_true(element < visible.used);
                wanted[element] = 1;
            }
        }
        for (uint32_t i = 0; i < visible.used; i++)
            assert_true(wanted[i]);
        assert_true(members > 0 || !mesh->triangle_count);
        assert_true(visible.used <= 3 * members);
        // Data of other meshes does not change.
        for (uint32_t i = 1; i < firsts[k]; i += 2)
            assert_int_equal(visible_element(&visible, i, 0), UINT32_MAX);
        assert_int_equal(visible_element(&visible, firsts[k] + mesh->triangle_count, 2), UINT32_MAX);
        arena_free(&arena);
    }
}

struct placed_corner {
    uint32_t bits[3], corner;
};

static int compare_placed(const void *left, const void *right)
{
    const struct placed_corner *a = left, *b = right;
    int order = memcmp(a->bits, b->bits, sizeof a->bits);
    return order ? order : a->corner < b->corner ? -1 : 1;
}

// The normals of all triangles equal the normals computed one position at a time from the corners at each position,
// found by sorting; they are numbered by their first corners.
static void all_as_one_by_one(const lam_mesh *mesh, double crease_degrees)
{
    uint32_t corners = 3 * mesh->triangle_count, fans = 0, next = 0;
    struct placed_corner *placed = malloc((corners + 1) * sizeof *placed);
    uint32_t *used = calloc(mesh->normal_count + 1, sizeof *used);
    for (uint32_t c = 0; c < corners; c++) {
        position_bits(mesh->positions + 3 * (size_t)corner_vertex(mesh, c), placed[c].bits);
        placed[c].corner = c;
        assert_true(mesh->normal_indices[c] <= next);
        next += mesh->normal_indices[c] == next;
    }
    assert_int_equal(next, mesh->normal_count);
    qsort(placed, corners, sizeof *placed, compare_placed);
    struct corner_fan_scratch scratch;
    corner_fan_scratch_start(&scratch, NULL);
    for (uint32_t first = 0, end; first < corners; first = end) {
        for (end = first; end < corners && same_position(placed[end].bits, placed[first].bits);)
            end++;
        assert_true(corner_fan_scratch_reserve(&scratch, end - first));
        for (uint32_t i = first; i < end; i++)
            scratch.numbers[i - first] = placed[i].corner;
        uint32_t count = corner_fan_normals(mesh, min_crease_cosine(RADIANS(crease_degrees)), &scratch, end - first);
        for (uint32_t i = 0; i < end - first; i++) {
            uint32_t index = mesh->normal_indices[scratch.corners[i].corner], fan = fans + scratch.corners[i].fan;
            assert_memory_equal(mesh->normals + 3 * (size_t)index, scratch.normals[scratch.corners[i].fan], 12);
            assert_true(used[index] == 0 || used[index] == fan + 1);
            used[index] = fan + 1;
        }
        fans += count;
    }
    assert_int_equal(fans, mesh->normal_count);
    corner_fan_scratch_free(&scratch);
    free(placed);
    free(used);
}

static void smooth(lam_mesh *mesh, double crease_degrees, struct arena *arena, struct pool *pool)
{
    lam_error error = {0};
    SUCCEEDS(normals_smooth(mesh, RADIANS(crease_degrees), arena, pool, NULL, &error));
    for (size_t c = 0; c < 3 * (size_t)mesh->triangle_count; c++)
        assert_true(mesh->normal_indices[c] < mesh->normal_count);
    all_as_one_by_one(mesh, crease_degrees);
    visible_as_all(mesh, crease_degrees, pool);
}

static const float *normal_of(const lam_mesh *mesh, size_t corner)
{
    return mesh->normals + 3 * (size_t)mesh->normal_indices[corner];
}

static void assert_normal(const lam_mesh *mesh, size_t corner, double x, double y, double z)
{
    const float *n = normal_of(mesh, corner);
    double dx = (double)n[0] - x, dy = (double)n[1] - y, dz = (double)n[2] - z;
    if (!(dx * dx + dy * dy + dz * dz < 1e-12))
        fail_msg("corner %zu: normal %g %g %g, expected %g %g %g", corner, (double)n[0], (double)n[1], (double)n[2], x,
                 y, z);
}

// --- A cube of eight vertices

static const float cube_positions[] = {-1, -1, -1, 1, -1, -1, -1, 1, -1, 1, 1, -1,
                                       -1, -1, 1,  1, -1, 1,  -1, 1, 1,  1, 1, 1};
static const uint32_t cube_indices[] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                        2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
static const float cube_faces[6][3] = {{0, 0, -1}, {0, 0, 1}, {0, -1, 0}, {0, 1, 0}, {-1, 0, 0}, {1, 0, 0}};

static lam_mesh cube(void)
{
    return (lam_mesh){.positions = cube_positions, .vertex_count = 8, .indices = cube_indices, .triangle_count = 12};
}

TEST(test_cube)
{
    struct arena arena;
    arena_start(&arena, NULL);
    lam_mesh mesh = cube();
    smooth(&mesh, 40, &arena, NULL); // each face has its own
    assert_int_equal(mesh.normal_count, 24);
    for (size_t c = 0; c < 36; c++) {
        const float *face = cube_faces[c / 6];
        assert_normal(&mesh, c, (double)face[0], (double)face[1], (double)face[2]);
    }
    // At 90° all are joined. Some faces have two triangles at a corner, some one; the angles, 45° and 45° or 90°,
    // compensate for that, so the diagonal is invisible.
    static const double creases[] = {90, 120, 180};
    for (int k = 0; k < 3; k++) {
        mesh = cube();
        smooth(&mesh, creases[k], &arena, NULL);
        assert_int_equal(mesh.normal_count, 8);
        for (size_t c = 0; c < 36; c++) {
            const float *p = cube_positions + 3 * cube_indices[c];
            double s = 1 / sqrt(3);
            const float *n = normal_of(&mesh, c);
            for (int a = 0; a < 3; a++)
                assert_true(fabs((double)n[a] - (double)p[a] * s) < 3e-6); // the error of the angle itself
        }
    }
    mesh = cube();
    smooth(&mesh, 89.9, &arena, NULL);
    assert_int_equal(mesh.normal_count, 24);
    arena_free(&arena);
}

// --- The weight of a corner: its triangle's area × its angle

// Adds v, weighted by `weight`, to a sum, as a unit vector.
static void add_weighted(double sum[3], const double v[3], double weight)
{
    for (int a = 0; a < 3; a++)
        sum[a] += v[a] * weight;
}

// A tip where three triangles of areas about 1 : 10 : 100, and angles from 20° to 150°, meet; in metres, micrometres
// and light years.
TEST(test_area_times_angle)
{
    static const double scales[] = {1, 1e-6, 1e16, 1e-30, 1e34};
    for (size_t k = 0; k < sizeof scales / sizeof *scales; k++) {
        struct arena arena;
        arena_start(&arena, NULL);
        static const double rim[4][3] = {{1, 0, 0.1}, {0.3, 0, -0.4}, {-3, 0.5, 0.2}, {20, 0.1, 30}};
        static const uint32_t indices[] = {0, 2, 1, 2, 0, 3, 3, 0, 4};
        static const int tips[] = {0, 1, 1};
        float p[15] = {0};
        for (int i = 0; i < 12; i++)
            p[3 + i] = (float)(rim[i / 3][i % 3] * scales[k]);
        lam_mesh mesh = {.positions = p, .vertex_count = 5, .indices = indices, .triangle_count = 3};
        smooth(&mesh, 180, &arena, NULL);
        double expected[3] = {0}, by_angle[3] = {0};
        for (int t = 0; t < 3; t++) {
            const double *q = rim[indices[3 * t + (tips[t] + 1) % 3] - 1],
                         *r = rim[indices[3 * t + (tips[t] + 2) % 3] - 1];
            double cross[3] = {q[1] * r[2] - q[2] * r[1], q[2] * r[0] - q[0] * r[2], q[0] * r[1] - q[1] * r[0]};
            double length = sqrt(cross[0] * cross[0] + cross[1] * cross[1] + cross[2] * cross[2]);
            double angle = atan2(length, q[0] * r[0] + q[1] * r[1] + q[2] * r[2]);
            add_weighted(expected, cross, angle);
            add_weighted(by_angle, cross, angle / length);
        }
        double length = sqrt(expected[0] * expected[0] + expected[1] * expected[1] + expected[2] * expected[2]);
        double other = sqrt(by_angle[0] * by_angle[0] + by_angle[1] * by_angle[1] + by_angle[2] * by_angle[2]);
        double apart = 0;
        for (int a = 0; a < 3; a++) {
            const double n = (double)normal_of(&mesh, 0)[a];
            assert_true(fabs(n - expected[a] / length) < 1e-5); // the error of the angle itself
            apart = fmax(apart, fabs(n - by_angle[a] / other));
        }
        assert_true(apart > 0.05); // the test distinguishes the weights
        arena_free(&arena);
    }
}

// The wall of a cylinder as CAD programs write it: between its facets there are slivers, whose normals are tilted by
// the rounding of their corners, here by 20°. Weighted by the angle alone, they would tilt the wall's normals by 10°.
TEST(test_slivers_do_not_streak)
{
    enum { SIDES = 180, POINTS = 2 * SIDES };
    struct arena arena;
    arena_start(&arena, NULL);
    float p[2 * POINTS * 3];
    uint32_t indices[POINTS * 6];
    for (uint32_t i = 0; i < POINTS; i++) {
        double angle = 2 * M_PI * (i / 2) / SIDES, beside = i % 2 * 1e-5, along = angle + RADIANS(90 + 20);
        for (uint32_t top = 0; top < 2; top++) {
            float point[3] = {(float)(cos(angle) + beside * cos(along)), (float)(sin(angle) + beside * sin(along)),
                              top ? 10 : 0};
            memcpy(p + 3 * (2 * i + top), point, 12);
        }
        uint32_t low = 2 * i, next = 2 * ((i + 1) % POINTS);
        memcpy(indices + 6 * i, (uint32_t[]){low, next, next + 1, low, next + 1, low + 1}, 24);
    }
    lam_mesh mesh = {.positions = p, .vertex_count = 2 * POINTS, .indices = indices, .triangle_count = 2 * POINTS};
    smooth(&mesh, 40, &arena, NULL);
    for (size_t c = 0; c < 6 * POINTS; c++) {
        const float *n = normal_of(&mesh, c), *at = p + 3 * (size_t)indices[c];
        double radial = (double)n[0] * (double)at[0] + (double)n[1] * (double)at[1];
        assert_true(radial > cos(RADIANS(1.1))); // a facet's own normal is 1° off at its edges
    }
    arena_free(&arena);
}

TEST(test_facet)
{
    struct arena arena;
    arena_start(&arena, NULL);
    lam_mesh mesh = cube();
    lam_error error;
    assert_true(normals_facet(&mesh, &arena, NULL, NULL, &error));
    for (size_t c = 0; c < 36; c++) {
        const float *face = cube_faces[c / 6];
        assert_normal(&mesh, c, (double)face[0], (double)face[1], (double)face[2]);
        assert_int_equal(mesh.normal_indices[c], c / 3);
    }
    static const float line[] = {0, 0, 0, 1, 1, 1, 2, 2, 2};
    lam_mesh flat = {.positions = line, .vertex_count = 3, .triangle_count = 1};
    assert_true(normals_facet(&flat, &arena, NULL, NULL, &error));
    assert_normal(&flat, 2, 0, 0, 0);
    arena_free(&arena);
}

TEST(test_sphere)
{
    AUTO_SCENE scene = lam_scene_make(NULL);
    struct arena arena;
    arena_start(&arena, NULL);
    double before = 0;
    for (int slices = 48; slices <= 192; slices *= 2) {
        int index =
            lam_scene_add_shape(scene, "sphere", &(lam_shape_params){.slices = slices, .stacks = slices / 2}, NULL);
        lam_mesh mesh = *lam_scene_mesh(scene, index);
        smooth(&mesh, 40, &arena, NULL);
        assert_int_equal(mesh.normal_count, mesh.vertex_count); // one normal at each position
        double worst = 0;
        for (size_t c = 0; c < 3 * (size_t)mesh.triangle_count; c++) {
            const float *n = normal_of(&mesh, c), *p = mesh.positions + 3 * (size_t)mesh.indices[c];
            for (int a = 0; a < 3; a++)
                worst = fmax(worst, fabs((double)n[a] - (double)p[a])); // p is the normal of the unit sphere
        }
        assert_true(worst < 20.0 / (slices * slices));
        assert_true(before == 0 || worst < before / 3.5); // a quarter for each doubling
        before = worst;
    }
    arena_free(&arena);
}

// --- Welding

TEST(test_weld)
{
    struct arena arena;
    arena_start(&arena, NULL);
    // Two triangles of a roof (30°) without shared vertices; the common edge is once written with −0.
    float h = (float)tan(RADIANS(15));
    const float roof[] = {-1, 0, 0, 0, h, -0.0f, 0, h, 1, /**/ 1, 0, 0, -0.0f, h, 1, -0.0f, h, 0};
    lam_mesh mesh = {.positions = roof, .vertex_count = 6, .triangle_count = 2};
    smooth(&mesh, 40, &arena, NULL);
    assert_int_equal(mesh.normal_count, 4);
    assert_int_equal(mesh.normal_indices[1], mesh.normal_indices[5]);
    assert_int_equal(mesh.normal_indices[2], mesh.normal_indices[4]);
    assert_normal(&mesh, 1, 0, -1, 0); // the roof is seen from below
    assert_normal(&mesh, 2, 0, -1, 0);
    mesh.normals = NULL;
    smooth(&mesh, 29, &arena, NULL); // now it is a crease
    assert_int_equal(mesh.normal_count, 6);
    arena_free(&arena);
}

TEST(test_smoothing_groups)
{
    struct arena arena;
    arena_start(&arena, NULL);
    // A strip of three triangles in a plane; only the groups determine which normals may be shared.
    static const float strip[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0};
    static const uint32_t indices[] = {0, 1, 2, 2, 1, 3, 2, 3, 4};
    static const struct {
        uint32_t groups[3];
        uint32_t normals;
    } cases[] = {
        {{1, 1, 1}, 5}, {{1, 2, 2}, 7}, {{1, 1, 2}, 7}, {{1, 2, 1}, 9}, {{0, 0, 0}, 9}, {{0, 7, 7}, 7},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        lam_mesh mesh = {.positions = strip,
                         .vertex_count = 5,
                         .indices = indices,
                         .triangle_count = 3,
                         .smoothing_groups = cases[k].groups};
        smooth(&mesh, 40, &arena, NULL);
        assert_int_equal(mesh.normal_count, cases[k].normals);
        for (size_t c = 0; c < 9; c++)
            assert_normal(&mesh, c, 0, 0, 1);
    }
    arena_free(&arena);
}

// --- Odd triangles

TEST(test_degenerate)
{
    struct arena arena;
    arena_start(&arena, NULL);
    // A floor triangle, a needle along its edge (two equal corners), one with three equal corners, and a separate line.
    static const float p[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 5, 5, 5, 6, 6, 6, 7, 7, 7};
    static const uint32_t indices[] = {0, 1, 2, 1, 0, 0, 2, 2, 2, 3, 4, 5};
    lam_mesh mesh = {.positions = p, .vertex_count = 6, .indices = indices, .triangle_count = 4};
    smooth(&mesh, 40, &arena, NULL);
    for (size_t c = 0; c < 9; c++)
        assert_normal(&mesh, c, 0, 0, 1);
    for (size_t c = 9; c < 12; c++)
        assert_normal(&mesh, c, 0, 0, 0);

    // A sliver on a crease does not smooth it, and joins a side with which it shares an edge.
    static const float corner[] = {0, 0, 0, 2, 0, 0, 1, 0, 0, 1, 1, 0, 1, 0, 1};
    static const uint32_t bent[] = {0, 1, 3, /* floor side */ 1, 0, 2, /* sliver, on the edge's middle */ 0, 4, 2,
                                    2, 4, 1};
    lam_mesh crease = {.positions = corner, .vertex_count = 5, .indices = bent, .triangle_count = 4};
    smooth(&crease, 40, &arena, NULL);
    for (size_t c = 0; c < 3; c++)
        assert_normal(&crease, c, 0, 0, 1);
    for (size_t c = 5; c < 12; c++)
        assert_normal(&crease, c, 0, 1, 0);
    assert_true(crease.normal_indices[3] == crease.normal_indices[1] ||
                crease.normal_indices[3] == crease.normal_indices[11]);
    assert_true(crease.normal_indices[4] == crease.normal_indices[0] ||
                crease.normal_indices[4] == crease.normal_indices[6]);

    lam_mesh empty = {.positions = p, .vertex_count = 6};
    smooth(&empty, 40, &arena, NULL);
    assert_int_equal(empty.normal_count, 0);
    lam_mesh nothing = {0};
    smooth(&nothing, 40, &arena, NULL);

    // Numbers at the ends of the range of floats.
    static const float wide[] = {-3e38f, -3e38f, 0, 3e38f, -3e38f, 0, 0, 3e38f, 0, 0, 0, 0, 1e-45f, 0, 0, 0, 1e-45f, 0};
    lam_mesh extremes = {.positions = wide, .vertex_count = 6, .triangle_count = 2};
    smooth(&extremes, 40, &arena, NULL);
    for (size_t c = 0; c < 6; c++)
        assert_normal(&extremes, c, 0, 0, 1);
    arena_free(&arena);
}

TEST(test_bow_tie)
{
    struct arena arena;
    arena_start(&arena, NULL);
    // The tips of two pyramids touch at vertex 0, without a common edge: two normals there, for any crease.
    static const float p[] = {0, 0, 0, 1, -1, 1, 1,  -1, -1, -1, -1, -1, -1, -1,
                              1, 1, 1, 1, 1,  1, -1, -1, 1,  -1, -1, 1,  1};
    static const uint32_t indices[] = {0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1, 0, 6, 5, 0, 7, 6, 0, 8, 7, 0, 5, 8};
    lam_mesh mesh = {.positions = p, .vertex_count = 9, .indices = indices, .triangle_count = 8};
    smooth(&mesh, 180, &arena, NULL);
    assert_int_equal(mesh.normal_count, 10);
    for (size_t t = 0; t < 8; t++)
        assert_normal(&mesh, 3 * t, 0, t < 4 ? 1 : -1, 0);
    arena_free(&arena);
}

// Closed vertices are not welded to others at their position, open ones are: three octahedra in the same place, the
// last without its face towards +x +y +z.
TEST(test_closed_vertices)
{
    static const float points[6][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
    static const uint32_t faces[] = {1, 0, 5, 2, 4, 0, 2, 1, 3, 0, 4, 5, 1, 5, 3, 2, 3, 4, 3, 5, 4, 0, 1, 2};
    float p[18][3];
    uint32_t indices[72];
    for (uint32_t i = 0; i < 72; i++) {
        indices[i] = faces[i % 24] + i / 24 * 6;
        memcpy(p[indices[i]], points[faces[i % 24]], sizeof *p);
    }
    struct arena arena;
    arena_start(&arena, NULL);
    lam_mesh mesh = {.positions = p[0], .vertex_count = 18, .indices = indices, .triangle_count = 23};
    lam_error error = {0};
    assert_true(normals_smooth(&mesh, M_PI, &arena, NULL, NULL, &error));
    assert_int_equal(mesh.normal_count, 18);
    for (uint32_t c = 0; c < 69; c++) {
        double n[3], rest = 1 / sqrt(123);
        for (int a = 0; a < 3; a++)
            n[a] = indices[c] >= 15 || indices[c] < 12 ? (double)p[indices[c]][a]
                   : p[indices[c]][a] > 0              ? 11 * rest
                                                       : -rest;
        assert_normal(&mesh, c, n[0], n[1], n[2]);
    }
    visible_as_all(&mesh, 180, NULL);
    arena_free(&arena);
}

TEST(test_inconsistent_winding)
{
    struct arena arena;
    arena_start(&arena, NULL);
    static const float p[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
    static const uint32_t same[] = {0, 1, 2, 2, 1, 3}, turned[] = {0, 1, 2, 1, 2, 3};
    lam_mesh mesh = {.positions = p, .vertex_count = 4, .indices = same, .triangle_count = 2};
    smooth(&mesh, 180, &arena, NULL);
    assert_int_equal(mesh.normal_count, 4);
    mesh.indices = turned;
    smooth(&mesh, 180, &arena, NULL); // not joined even at a crease of 180°, because they would cancel
    assert_int_equal(mesh.normal_count, 6);
    for (size_t c = 0; c < 6; c++)
        assert_normal(&mesh, c, 0, 0, c < 3 ? 1 : -1);
    arena_free(&arena);
}

// --- One result for any number of threads

TEST(test_threads)
{
    AUTO_SCENE scene = lam_scene_make(NULL);
    struct arena arena;
    arena_start(&arena, NULL);
    int index = lam_scene_add_shape(scene, "teapot", &(lam_shape_params){.slices = 200, .stacks = 40}, NULL);
    const lam_mesh *teapot = lam_scene_mesh(scene, index);
    size_t corners = 3 * (size_t)teapot->triangle_count;
    // Unchanged, and as a soup of triangles as in STL files, without indices and with them.
    float *soup = malloc(corners * 12);
    uint32_t *counted = malloc(corners * sizeof *counted);
    for (size_t c = 0; c < corners; c++) {
        memcpy(soup + 3 * c, teapot->positions + 3 * (size_t)teapot->indices[c], 12);
        counted[c] = (uint32_t)c;
    }
    for (int k = 0; k < 3; k++) {
        lam_mesh mesh = {.positions = teapot->positions,
                         .vertex_count = teapot->vertex_count,
                         .indices = teapot->indices,
                         .triangle_count = teapot->triangle_count};
        if (k)
            mesh = (lam_mesh){.positions = soup,
                              .vertex_count = (uint32_t)corners,
                              .indices = k == 2 ? counted : NULL,
                              .triangle_count = teapot->triangle_count};
        lam_mesh first = mesh;
        smooth(&first, 20, &arena, NULL);
        static const int threads[] = {1, 2, 5};
        for (int i = 0; i < 3; i++) {
            struct pool *pool = pool_make(threads[i]);
            lam_mesh other = mesh;
            smooth(&other, 20, &arena, pool);
            assert_int_equal(first.normal_count, other.normal_count);
            assert_memory_equal(first.normals, other.normals, 12 * (size_t)first.normal_count);
            assert_memory_equal(first.normal_indices, other.normal_indices, 4 * corners);
            pool_free(pool);
        }
    }
    free(counted);
    free(soup);
    arena_free(&arena);
}

// --- Meshes designed to be slow: each must take about as long as any other mesh of its size

// Triangles between random points of all magnitudes, some of them equal, some zeros with a sign; most positions have
// few corners, some very many.
TEST(test_random)
{
    enum { POINTS = 1400, TRIANGLES = 3000 };
    static float positions[3 * POINTS];
    static uint32_t indices[3 * TRIANGLES], groups[TRIANGLES];
    static const float coordinates[] = {0, -0.0f, 1, -1, 0.5f, 3e38f, -3e38f, 1e-45f, 1e-20f, 7, 1.5f, 2};
    uint32_t random = 12345;
    for (int pass = 0; pass < 3; pass++) {
        for (size_t i = 0; i < 3 * POINTS; i++) {
            random = random * 1664525u + 1013904223u;
            positions[i] = pass == 0   ? coordinates[(random >> 8) % 12]
                           : pass == 1 ? coordinates[(random >> 8) % 6]
                                       : (float)(random >> 8 & 0xffff) / 4096.0f;
        }
        for (size_t i = 0; i < 3 * TRIANGLES; i++) {
            random = random * 1664525u + 1013904223u;
            // Mostly strips of neighbours, so that edges are shared.
            indices[i] = pass == 2 ? (uint32_t)(i / 6 + (i % 6 == 1) + 2 * (i % 6 == 2) + 2 * (i % 6 == 3) +
                                                (i % 6 == 4) + 3 * (i % 6 == 5)) %
                                         POINTS
                                   : (random >> 8) % POINTS;
            groups[i / 3] = random >> 28 & 3;
        }
        for (int grouped = 0; grouped < 2; grouped++) {
            struct arena arena;
            arena_start(&arena, NULL);
            lam_mesh mesh = {.positions = positions,
                             .vertex_count = POINTS,
                             .indices = indices,
                             .triangle_count = TRIANGLES,
                             .smoothing_groups = grouped ? groups : NULL};
            smooth(&mesh, 60, &arena, NULL);
            lam_mesh loose = {.positions = positions, .triangle_count = POINTS / 3};
            smooth(&loose, 60, &arena, NULL);
            arena_free(&arena);
        }
    }
}

// Processor time, not elapsed time: several hundred times the necessary time.
static void within_seconds(clock_t start, double seconds)
{
    assert_true((double)(clock() - start) / CLOCKS_PER_SEC < seconds);
}

TEST(test_crowd_at_one_vertex)
{
    enum { COUNT = 200000 }; // quadratic time would be minutes
    struct arena arena;
    arena_start(&arena, NULL);
    float *p = malloc((COUNT + 1) * 12);
    uint32_t *indices = malloc((size_t)COUNT * 12);
    p[0] = 0, p[1] = 0.1f, p[2] = 0;
    for (uint32_t i = 0; i < COUNT; i++) {
        double a = 2 * M_PI * i / COUNT;
        float ring[3] = {(float)cos(a), 0, (float)-sin(a)};
        memcpy(p + 3 * (size_t)(i + 1), ring, 12);
        uint32_t triangle[3] = {0, i + 1, (i + 1) % COUNT + 1};
        memcpy(indices + 3 * (size_t)i, triangle, 12);
    }
    lam_mesh mesh = {.positions = p, .vertex_count = COUNT + 1, .indices = indices, .triangle_count = COUNT};
    clock_t start = clock();
    smooth(&mesh, 40, &arena, NULL);
    within_seconds(start, 20);
    assert_normal(&mesh, 0, 0, 1, 0);
    for (size_t t = 1; t < COUNT; t++)
        assert_int_equal(mesh.normal_indices[3 * t], mesh.normal_indices[0]);

    // The same with several threads, which list their corners in any order.
    struct pool *pool = pool_make(3);
    lam_mesh other = mesh;
    smooth(&other, 40, &arena, pool);
    assert_int_equal(mesh.normal_count, other.normal_count);
    assert_memory_equal(mesh.normals, other.normals, 12 * (size_t)mesh.normal_count);
    assert_memory_equal(mesh.normal_indices, other.normal_indices, (size_t)COUNT * 12);
    pool_free(pool);

    // All on one edge, every other one reversed.
    for (uint32_t i = 0; i < COUNT; i++) {
        uint32_t triangle[3] = {0, i & 1 ? 1 : i / 2 + 2, i & 1 ? i / 2 + 2 : 1};
        memcpy(indices + 3 * (size_t)i, triangle, 12);
    }
    start = clock();
    smooth(&mesh, 40, &arena, NULL);
    within_seconds(start, 20);

    // One triangle many times, and the same number of degenerate triangles.
    for (uint32_t i = 0; i < COUNT; i++)
        memcpy(indices + 3 * (size_t)i, (uint32_t[]){0, 1, COUNT / 4}, 12);
    start = clock();
    smooth(&mesh, 40, &arena, NULL);
    memset(indices, 0, (size_t)COUNT * 12);
    smooth(&mesh, 40, &arena, NULL);
    within_seconds(start, 20);
    assert_normal(&mesh, 5, 0, 0, 0);
    free(p);
    free(indices);
    arena_free(&arena);
}

static uint32_t inverse(uint32_t odd) // modulo 2³², by Newton's steps
{
    uint32_t x = odd;
    for (int i = 0; i < 5; i++)
        x *= 2 - odd * x;
    return x;
}

// Positions that all have the same hash, found by inverting it: they reach the limit of probes. Each of them once, with
// and without indices, and twice.
TEST(test_colliding_positions)
{
    enum { COUNT = 60000 };
    struct arena arena;
    arena_start(&arena, NULL);
    float *p = malloc(2 * COUNT * 12);
    uint32_t *counted = malloc(2 * COUNT * sizeof *counted), back = inverse(0xc2b2ae3du);
    size_t count = 0;
    for (uint32_t x = 0x3f000000; count < COUNT; x++) {
        uint32_t bits[3] = {x, 0x3f800000, 0}, h = (x ^ x >> 16) * 0x9e3779b1u;
        h = (h ^ h >> 15 ^ bits[1] ^ bits[1] >> 16) * 0x85ebca77u;
        uint32_t z = 0x12345678u * back ^ h ^ h >> 15;
        bits[2] = z ^ z >> 16;
        float f[3];
        memcpy(f, bits, 12);
        if (!isfinite(f[2]))
            continue;
        assert_int_equal(hash_position(bits), 0x12345678u ^ 0x12345678u >> 16);
        memcpy(p + 3 * count++, f, 12);
    }
    memcpy(p + 3 * COUNT, p, COUNT * 12);
    for (uint32_t i = 0; i < 2 * COUNT; i++)
        counted[i] = i;
    for (int k = 0; k < 4; k++) {
        uint32_t vertices = k < 2 ? COUNT : 2 * COUNT;
        lam_mesh mesh = {.positions = p,
                         .vertex_count = vertices,
                         .indices = k % 2 ? counted : NULL,
                         .triangle_count = vertices / 3};
        clock_t start = clock();
        smooth(&mesh, 40, &arena, NULL);
        within_seconds(start, 20);
        // Two equal triangles do not share an edge in opposite directions, so they are welded, but not joined.
        assert_int_equal(mesh.normal_count, vertices);
    }
    free(counted);
    free(p);
    arena_free(&arena);
}

// Positions whose hashes have the same first bits, so that one part of the table gets them all.
TEST(test_one_part_of_the_table)
{
    enum { COUNT = 60000 };
    struct arena arena;
    arena_start(&arena, NULL);
    float *p = malloc(COUNT * 12);
    uint32_t random = 1;
    for (size_t count = 0; count < COUNT;) {
        float f[3];
        for (int a = 0; a < 3; a++) {
            random = random * 1664525u + 1013904223u;
            f[a] = (float)(random >> 8) + 1.0f;
        }
        uint32_t bits[3];
        memcpy(bits, f, 12);
        if (hash_position(bits) >> 29 == 0)
            memcpy(p + 3 * count++, f, 12);
    }
    uint32_t *indices = malloc(2 * COUNT * sizeof *indices);
    for (uint32_t i = 0; i < 2 * COUNT; i++)
        indices[i] = i < COUNT ? i : 2 * COUNT - 1 - i; // each triangle again, reversed
    lam_mesh mesh = {.positions = p, .vertex_count = COUNT, .indices = indices, .triangle_count = 2 * COUNT / 3};
    smooth(&mesh, 180, &arena, NULL);
    assert_int_equal(mesh.normal_count, COUNT);
    for (uint32_t i = 0; i < COUNT; i++)
        assert_int_equal(mesh.normal_indices[i], mesh.normal_indices[2 * COUNT - 1 - i]);
    free(indices);
    free(p);
    arena_free(&arena);
}

// --- Controls

TEST(test_controls)
{
    AUTO_SCENE scene = lam_scene_make(NULL);
    int index = lam_scene_add_shape(scene, "sphere", NULL, NULL);
    const lam_mesh mesh = *lam_scene_mesh(scene, index);
    lam_cancel cancel = {0};
    lam_cancel_raise(&cancel);
    struct call_control call;
    struct arena arena;
    lam_error error;
    call_start(&call, &(lam_control){.cancel = &cancel});
    arena_start(&arena, &call);
    lam_mesh copy = mesh;
    assert_false(normals_smooth(&copy, 0.7, &arena, NULL, &call, &error));
    assert_int_equal(error.code, LAM_CANCELLED);
    assert_false(normals_facet(&copy, &arena, NULL, &call, &error));
    assert_int_equal(error.code, LAM_CANCELLED);
    assert_memory_equal(&copy, &mesh, sizeof mesh);
    arena_free(&arena);

    call_start(&call, &(lam_control){.memory_limit_bytes = 100000});
    arena_start(&arena, &call);
    assert_false(normals_smooth(&copy, 0.7, &arena, NULL, &call, &error));
    assert_int_equal(error.code, LAM_LIMIT);
    assert_non_null(strstr(error.text, "memory limit"));
    arena_free(&arena);
    assert_int_equal(call.memory_used, 0);

    // Each allocation fails once.
    bool done = false;
    for (long k = 0; !done; k++) {
        assert_true(k < 100);
        arena_start(&arena, NULL);
        arena_fail_after(k);
        done = normals_smooth(&copy, 0.7, &arena, NULL, NULL, &error);
        arena_fail_after(-1);
        assert_true(done || error.code == LAM_MACHINE);
        arena_free(&arena);
    }
    done = false;
    copy.normals = NULL;
    for (long k = 0; !done; k++) {
        assert_true(k < 100);
        struct visible_normals visible;
        arena_start(&arena, NULL);
        arena_fail_after(k);
        done = make_some(&copy, 0, 2, 16, 0.7, &visible, &arena, NULL, &error);
        arena_fail_after(-1);
        assert_true(done || error.code == LAM_MACHINE);
        arena_free(&arena);
    }
}
