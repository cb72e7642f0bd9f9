// test_triangulate.c: triangles cover their polygon exactly and keep its winding, for polygons of any shape.
#include "test.h"
#include "triangulate.h"

#include "share.h"

#include <time.h>

static uint64_t state = 88172645463325252u;

static double random_unit(void)
{
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return (double)(state >> 11) * 0x1p-53;
}

// Places the polygon of `count` points in space by `plane` (0: z = 0; otherwise a tilted plane).
static float *lay(const double (*points)[2], uint32_t count, int plane)
{
    float *positions = malloc(3 * count * sizeof *positions);
    for (uint32_t i = 0; i < count; i++) {
        double x = points[i][0], y = points[i][1];
        float *p = positions + 3 * i;
        p[0] = (float)(plane == 1 ? y : x);
        p[1] = (float)(plane == 1 ? 0.5 * x : y);
        p[2] = (float)(plane == 0 ? 0 : plane == 1 ? x : -0.25 * x + 0.5 * y);
    }
    return positions;
}

static void normal_of(const float *a, const float *b, const float *c, double n[3])
{
    double u[3], v[3];
    for (int k = 0; k < 3; k++) {
        u[k] = (double)b[k] - (double)a[k];
        v[k] = (double)c[k] - (double)a[k];
    }
    n[0] = u[1] * v[2] - u[2] * v[1];
    n[1] = u[2] * v[0] - u[0] * v[2];
    n[2] = u[0] * v[1] - u[1] * v[0];
}

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// Triangulates a polygon and checks: indices in range, every corner used, no reversed triangle, and the sum of areas,
// so that the triangles cover the polygon once. Returns the number of triangles without area.
static uint32_t check(const double (*points)[2], uint32_t count, int plane)
{
    float *positions = lay(points, count, plane);
    uint32_t *corners = malloc(count * sizeof *corners), *triples = malloc(3 * count * sizeof *triples);
    uint32_t *again = malloc(3 * count * sizeof *again);
    char *used = calloc(count, 1);
    double whole[3] = {0, 0, 0};
    for (uint32_t i = 0; i < count; i++)
        corners[i] = i;
    for (uint32_t i = 1; i + 1 < count; i++) {
        double n[3];
        normal_of(positions, positions + 3 * i, positions + 3 * i + 3, n);
        for (int k = 0; k < 3; k++)
            whole[k] += n[k];
    }
    double area = sqrt(dot(whole, whole));
    struct triangulator scratch;
    triangulator_start(&scratch, NULL);
    assert_true(triangulate(&scratch, positions, corners, count, triples));
    assert_true(triangulate(&scratch, positions, corners, count, again));
    assert_memory_equal(triples, again, 3 * (count - 2) * sizeof *triples);
    triangulator_stop(&scratch);

    double sum = 0, turned = 0;
    uint32_t flat = 0;
    for (uint32_t t = 0; t < count - 2; t++) {
        double n[3];
        for (int c = 0; c < 3; c++) {
            assert_true(triples[3 * t + (uint32_t)c] < count);
            used[triples[3 * t + (uint32_t)c]] = 1;
        }
        normal_of(positions + 3 * triples[3 * t], positions + 3 * triples[3 * t + 1],
                  positions + 3 * triples[3 * t + 2], n);
        double size = dot(n, whole) / area;
        sum += fabs(size);
        turned += size < 0 ? -size : 0;
        flat += size == 0;
    }
    if (fabs(sum - area) > 1e-5 * area || turned > 1e-6 * area)
        fail_msg("%u corners: area %g, triangles %g, of which turned over %g", count, area, sum, turned);
    for (uint32_t i = 0; i < count; i++)
        assert_true(used[i]);
    free(positions);
    free(corners);
    free(triples);
    free(again);
    free(used);
    return flat;
}

TEST(test_small)
{
    static const double square[][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    static const double dart[][2] = {{0, 0}, {2, 0}, {0.3, 0.3}, {0, 2}};  // corner 2 is turned inward
    static const double dart2[][2] = {{0.3, 0.3}, {0, 2}, {0, 0}, {2, 0}}; // the same from corner 2
    static const double dart3[][2] = {{0, 2}, {0, 0}, {2, 0}, {0.3, 0.3}};
    static const double flat_corner[][2] = {{0, 0}, {1, 0}, {2, 0}, {1, 2}};
    static const double pentagon[][2] = {{0, 0}, {2, 0}, {3, 2}, {1, 3}, {-1, 2}};
    static const double midpoints[][2] = {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
    static const double comb[][2] = {{0, 0}, {7, 0}, {7, 3}, {6, 3}, {6, 1}, {5, 1}, {5, 3}, {4, 3},
                                     {4, 1}, {3, 1}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}};
    for (int plane = 0; plane < 3; plane++) {
        assert_int_equal(check(square, 4, plane), 0);
        assert_int_equal(check(dart, 4, plane), 0);
        assert_int_equal(check(dart2, 4, plane), 0);
        assert_int_equal(check(dart3, 4, plane), 0);
        assert_int_equal(check(flat_corner, 4, plane), 0);
        assert_int_equal(check(pentagon, 5, plane), 0);
        assert_int_equal(check(midpoints, 8, plane), 0);
        assert_int_equal(check(comb, 16, plane), 0);
    }
}

// A ring whose hole is connected by a bridge in both directions, holes that touch the outline, and repeated points.
TEST(test_touching)
{
    static const double ring[][2] = {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}};
    static const double two_holes[][2] = {{0, 0}, {8, 0}, {8, 4}, {0, 4}, {0, 0}, {1, 1}, {1, 3}, {3, 3},
                                          {3, 1}, {1, 1}, {5, 1}, {5, 3}, {7, 3}, {7, 1}, {5, 1}, {1, 1}};
    static const double hole_at_corner[][2] = {{0, 0}, {1, 2}, {2, 1}, {0, 0}, {4, 0}, {4, 4}, {0, 4}};
    static const double repeated[][2] = {{0, 0}, {0, 0}, {2, 0}, {2, 0}, {2, 0}, {1, 0.5}, {2, 2}, {0, 2}, {0, 2}};
    static const double hourglass[][2] = {{0, 0}, {2, 0}, {1, 1}, {2, 2}, {0, 2}, {1, 1}};
    for (int plane = 0; plane < 3; plane++) {
        check(ring, 10, plane);
        check(two_holes, 16, plane);
        check(hole_at_corner, 7, plane);
        check(repeated, 9, plane);
        check(hourglass, 6, plane);
    }
}

// A star-shaped polygon: a random radius at each angle.
static void make_star(double (*points)[2], uint32_t count, double spikes)
{
    for (uint32_t i = 0; i < count; i++) {
        double angle = 2 * 3.14159265358979 * i / count, radius = 1 + spikes * random_unit();
        points[i][0] = radius * cos(angle);
        points[i][1] = radius * sin(angle);
    }
}

// Corners 0 … n/2 are on the outside, and the rest on the inside. Corners 0 … n/2 outside, then back inside.
static void make_spiral(double (*points)[2], uint32_t count)
{
    uint32_t half = count / 2;
    for (uint32_t i = 0; i < half; i++) {
        double angle = 40.0 * i / half, radius = 1 + 0.2 * angle;
        points[i][0] = (radius + 0.6) * cos(angle);
        points[i][1] = (radius + 0.6) * sin(angle);
        points[count - 1 - i][0] = radius * cos(angle);
        points[count - 1 - i][1] = radius * sin(angle);
    }
}

// Long thin teeth, rotated so that no tooth is parallel to an axis.
static void make_comb(double (*points)[2], uint32_t count)
{
    for (uint32_t i = 0; i + 2 < count; i++) {
        double x = 1 - (double)i / count, y = i % 2 ? 1 : 0.01;
        points[i + 2][0] = x - y;
        points[i + 2][1] = x + y;
    }
    points[0][0] = points[0][1] = -0.1;
    points[1][0] = points[1][1] = 1.1;
}

TEST(test_random)
{
    enum { MOST = 600 };
    static double points[MOST][2];
    for (int round = 0; round < 400; round++) {
        uint32_t count = 5 + (uint32_t)(random_unit() * (MOST - 6));
        make_star(points, count, round % 2 ? 5 : 0.01);
        check((const double(*)[2])points, count, round % 3);
    }
    for (uint32_t count = 40; count < MOST; count += 2) {
        make_spiral(points, count);
        check((const double(*)[2])points, count, (int)count % 3);
        make_comb(points, count);
        check((const double(*)[2])points, count, (int)count % 3);
    }
}

// Large polygons; the time limit of the test run limits the time.
TEST(test_large)
{
    enum { COUNT = 100000 };
    double(*points)[2] = malloc(COUNT * sizeof *points);
    make_star(points, COUNT, 0.5);
    check((const double(*)[2])points, COUNT, 2);
    make_spiral(points, COUNT);
    check((const double(*)[2])points, COUNT, 0);
    make_comb(points, 50000);
    check((const double(*)[2])points, 50000, 0);
    free(points);
}

// Polygons without area or with self-intersections are also triangulated.
TEST(test_hopeless)
{
    enum { COUNT = 300 };
    float positions[3 * COUNT];
    uint32_t corners[COUNT], triples[3 * COUNT];
    struct triangulator scratch;
    triangulator_start(&scratch, NULL);
    for (int round = 0; round < 60; round++) {
        uint32_t count = 3 + (uint32_t)(random_unit() * (COUNT - 4));
        for (uint32_t i = 0; i < count; i++) {
            corners[i] = i;
            for (int k = 0; k < 3; k++) {
                double r = random_unit();
                positions[3 * i + (uint32_t)k] =
                    (float)(round % 6 == 0   ? 1                           // one point
                            : round % 6 == 1 ? i * (k + 1)                 // a line
                            : round % 6 == 2 ? r                           // a tangle
                            : round % 6 == 3 ? (k == 2 ? 0 : floor(4 * r)) // few places
                            : round % 6 == 4 ? (r - 0.5) * 6.8e38          // up to the limit of floats
                                             : r * 1e-44);                 // denormals
            }
        }
        memset(triples, 0xff, sizeof triples);
        assert_true(triangulate(&scratch, positions, corners, count, triples));
        for (uint32_t i = 0; i < 3 * (count - 2); i++)
            assert_true(triples[i] < count);
        assert_true(triples[3 * (count - 2)] == UINT32_MAX);
    }
    triangulator_stop(&scratch);
}

// A large polygon around four points: every test of a corner meets all corners at its own position.
TEST(test_repeated)
{
    enum { COUNT = IS_SLOW_BUILD ? 20000 : 100000 };
    static const float positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
    uint32_t *corners = malloc(COUNT * sizeof *corners), *triples = malloc(3 * COUNT * sizeof *triples);
    for (uint32_t i = 0; i < COUNT; i++)
        corners[i] = (uint32_t)(random_unit() * 4);
    struct triangulator scratch;
    triangulator_start(&scratch, NULL);
    clock_t start = clock();
    assert_true(triangulate(&scratch, positions, corners, COUNT, triples));
    assert_true(clock() - start < 5 * CLOCKS_PER_SEC); // 12 s instead of 1.2 s, if the steps were not limited
    triangulator_stop(&scratch);
    free(corners);
    free(triples);
}

TEST(test_memory)
{
    static const float positions[] = {0, 0, 0, 2, 0, 0, 0.5f, 0.5f, 0, 2, 2, 0, 0, 2, 0};
    static const uint32_t corners[] = {0, 1, 2, 3, 4};
    uint32_t triples[9];
    struct triangulator scratch;
    triangulator_start(&scratch, NULL);
    arena_fail_after(0);
    assert_false(triangulate(&scratch, positions, corners, 5, triples));
    arena_fail_after(-1);
    assert_true(triangulate(&scratch, positions, corners, 5, triples));
    triangulator_stop(&scratch);
}
