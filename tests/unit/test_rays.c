// test_rays.c: rays in the hierarchy give the same answer as testing every triangle separately, for any scene.
#include "test.h"

#include <lambent/scene.h>

#define LANES 8
#include "ray_lanes.h"
#include "rays.h"

static uint64_t seed = 1;

static double uniform(void)
{
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(seed >> 11) / 9007199254740992.0;
}

static double between(double low, double high) { return low + (high - low) * uniform(); }

// --- scenes of triangles

enum { TRIANGLES_MAX = 20000 };

struct soup {
    float p[3 * TRIANGLES_MAX][3];
    uint32_t count;
    lam_scene *scene;
    struct frame frame;
    struct hierarchy_memory memory;
    const struct hierarchy *hierarchy;
};

static void add_triangle(struct soup *s, const float a[3], const float b[3], const float c[3])
{
    memcpy(s->p[3 * s->count], a, 12);
    memcpy(s->p[3 * s->count + 1], b, 12);
    memcpy(s->p[3 * s->count++ + 2], c, 12);
}

static void build(struct soup *s, int threads, const lam_mat4 *transform)
{
    lam_error error = {0};
    s->scene = lam_scene_make(&error);
    lam_mesh mesh = {.positions = &s->p[0][0], .vertex_count = 3 * s->count, .triangle_count = s->count};
    lam_object object = lam_object_default();
    object.mesh = lam_scene_add_mesh(s->scene, &mesh, &error);
    if (transform)
        object.transform = *transform;
    if (object.mesh < 0 || lam_scene_add_object(s->scene, &object, &error) < 0)
        fail_msg("%s", error.text);
    lam_light light = lam_light_default(LAM_LIGHT_POINT);
    lam_scene_add_light(s->scene, &light, &error);
    lam_camera camera = lam_camera_fit(s->scene, 100, 100, NULL);
    s->frame = (struct frame){0};
    lam_draw_params params = {.shadows = true};
    SUCCEEDS(frame_build(&s->frame, s->scene, &camera, &params, 100, 100, NULL, &error));
    struct pool *pool = pool_make(threads);
    bool built;
    memset(&s->memory, 0, sizeof s->memory);
    s->hierarchy = hierarchy_of_frame(&s->memory, &s->frame, pool, NULL, &built, &error);
    SUCCEEDS(s->hierarchy);
    assert_true(built);
    // An unchanged scene is not built again.
    assert_true(hierarchy_of_frame(&s->memory, &s->frame, pool, NULL, &built, &error) == s->hierarchy && !built);
    pool_free(pool);
}

static void drop(struct soup *s)
{
    hierarchy_free(&s->memory);
    frame_free(&s->frame);
    lam_scene_free(s->scene);
    s->count = 0;
}

static void random_point(float p[3], double size)
{
    for (int i = 0; i < 3; i++)
        p[i] = (float)between(-size, size);
}

// Triangles of all sizes, including needles, points and lines.
static void random_soup(struct soup *s, uint32_t count, double size)
{
    s->count = 0;
    while (s->count < count) {
        float a[3], b[3], c[3];
        double reach = size * exp(between(-9, 0));
        random_point(a, size);
        random_point(b, reach);
        random_point(c, reach);
        for (int i = 0; i < 3; i++) {
            b[i] += a[i];
            c[i] += a[i];
        }
        int kind = (int)(uniform() * 12);
        if (kind == 0)
            memcpy(b, a, 12); // a line
        if (kind == 1)
            memcpy(c, memcpy(b, a, 12), 12); // a point
        if (kind == 2)
            for (int i = 0; i < 3; i++)
                c[i] = 0.5f * (a[i] + b[i]); // three points on a line
        if (kind == 3)
            a[1] = b[1] = c[1] = 0; // in one plane with others
        if (kind == 4 && s->count)
            memcpy(a, s->p[3 * (s->count - 1)], 12); // shares a corner
        add_triangle(s, a, b, c);
    }
}

static const struct ray_triangle *triangle_of(const struct soup *s, uint32_t number)
{
    static struct ray_triangle triangles[4];
    static int next;
    struct ray_triangle *triangle = &triangles[next = (next + 1) % 4];
    hierarchy_triangle(s->hierarchy, number, triangle);
    return triangle;
}

static struct ray_lanes random_rays(const struct soup *s, bool inside)
{
    struct ray_lanes ray;
    int kind = (int)(uniform() * 5);
    for (int i = 0; i < LANES; i++) {
        double o[3], d[3];
        uint32_t number = (uint32_t)(uniform() * s->count);
        const struct ray_triangle *t = triangle_of(s, number);
        ray.own[i] = NO_TRIANGLE;
        for (int k = 0; k < 3; k++) {
            o[k] = between(-1.5, 1.5);
            d[k] = between(-2, 2);
        }
        if (kind == 1) // along an axis
            for (int k = 0; k < 3; k++)
                d[k] = k == i % 3 ? (i & 4 ? -1 : 1) : 0;
        for (int k = 0; k < 3 && (kind == 2 || inside); k++) // from a point of a triangle
            o[k] = t->p[0][k] * 0.25 + t->p[1][k] * 0.25 + t->p[2][k] * 0.5;
        if (kind == 2)
            ray.own[i] = (int32_t)t->twin;
        for (int k = 0; k < 3 && kind == 3; k++) // to a corner or the middle of an edge
            d[k] = (i & 1 ? t->p[0][k] : 0.5 * (t->p[1][k] + t->p[2][k])) - o[k];
        for (int k = 0; k < 3 && kind == 4; k++) // in a plane
            d[k] = k == 1 ? 0 : d[k], o[k] = k == 1 ? t->p[0][1] : o[k];
        for (int k = 0; k < 3; k++) {
            ray.origin[k][i] = ray.point[k][i] = o[k];
            ray.direction[k][i] = d[k];
        }
    }
    for (int i = 0; i < LANES; i++)
        ray.end[i] = kind == 1 ? HUGE_VAL : kind == 3 ? 1.001 : 1;
    return ray;
}

// Returns whether a ray passes within 10⁻⁶ of a triangle's box. Seen from afar, rounding can turn the sides of a triangle
// with a size of 10⁻¹⁰ round, so that it contains any ray for crosses().
static bool passes_near(const struct ray_triangle *t, const struct ray_lanes *ray, int lane)
{
    double near = 0, far = HUGE_VAL;
    for (int k = 0; k < 3; k++) {
        double low = fmin(fmin(t->p[0][k], t->p[1][k]), t->p[2][k]) - 1e-6 - ray->origin[k][lane],
               high = fmax(fmax(t->p[0][k], t->p[1][k]), t->p[2][k]) + 1e-6 - ray->origin[k][lane];
        double d = ray->direction[k][lane];
        if (d == 0 && (low > 0 || high < 0))
            return false;
        near = d == 0 ? near : fmax(near, fmin(low / d, high / d));
        far = d == 0 ? far : fmin(far, fmax(low / d, high / d));
    }
    return near <= far;
}

static unsigned every_triangle(const struct soup *s, const struct ray_lanes *ray, unsigned active)
{
    struct ray_view view;
    unsigned hit = 0;
    view_along(&view, ray);
    view_common(&view, active);
    for (uint32_t i = 0; i < s->count; i++) {
        const struct ray_triangle *t = triangle_of(s, i);
        unsigned crossed = crosses(t, ray, &view, active, NULL, NULL);
        crossed &= ~through_points(s->hierarchy, t, ray->point, crossed);
        for (unsigned rest = crossed & ~hit; rest; rest &= rest - 1)
            hit |= (unsigned)passes_near(t, ray, __builtin_ctz(rest)) << __builtin_ctz(rest);
    }
    return hit;
}

// The nearest triangle on each ray, and the next one behind it.
static void check_nearest(const struct soup *s, const struct ray_lanes *ray)
{
    struct nearest_search search;
    nearest_start(&search, s->hierarchy, ray);
    for (int lane = 0; lane < LANES; lane++) {
        double after = 0;
        uint32_t after_number = (uint32_t)NO_TRIANGLE;
        for (int round = 0; round < 2; round++) {
            double t[LANES], nearest = HUGE_VAL;
            uint32_t number = (uint32_t)NO_TRIANGLE;
            view_common(&search.view, 1u << lane);
            for (uint32_t i = 0; i < s->count; i++) {
                const struct ray_triangle *triangle = triangle_of(s, i);
                if (crosses(triangle, ray, &search.view, 1u << lane, NULL, t) && passes_near(triangle, ray, lane) &&
                    !through_points(s->hierarchy, triangle, ray->point, 1u << lane) && t[lane] < nearest &&
                    (t[lane] > after || (t[lane] == after && (int64_t)i > (int32_t)after_number))) {
                    nearest = t[lane];
                    number = triangle->number;
                }
            }
            nearest_hit(&search, lane, after, after_number);
            assert_int_equal(search.found.number, number);
            if (number == (uint32_t)NO_TRIANGLE)
                break;
            assert_true(search.t == nearest);
            after = nearest;
            after_number = number;
        }
    }
}

static int found, missed;

static void check_rays(const struct soup *s, int rounds)
{
    for (int i = 0; i < rounds; i++) {
        struct ray_lanes ray = random_rays(s, i & 1);
        unsigned active = i % 3 ? 0xff : (unsigned)(uniform() * 256),
                 hit = any_hit(s->hierarchy, &ray, active, NULL, NULL, i % 5 == 0);
        assert_int_equal(hit, every_triangle(s, &ray, active));
        check_nearest(s, &ray);
        found += __builtin_popcount(hit);
        missed += __builtin_popcount(active & ~hit);
    }
}

static struct soup soup;

TEST(test_random)
{
    static const double sizes[] = {1, 1e-20, 1e20};
    for (uint32_t count = 1; count < 3000; count = count * 3 + 1) {
        random_soup(&soup, count, sizes[count % 3]);
        build(&soup, 1 + (int)count % 3, NULL);
        check_rays(&soup, 300);
        drop(&soup);
    }
    // A rotated object far away.
    lam_mat4 m = {{{0.6, 0.8, 0, 1e7}, {-0.8, 0.6, 0, -3e6}, {0, 0, 1, 5}, {0, 0, 0, 1}}};
    random_soup(&soup, 500, 3);
    build(&soup, 2, &m);
    check_rays(&soup, 300);
    drop(&soup);
    assert_true(found > 2000 && missed > 2000);
}

// Each triangle is in one leaf, within the boxes above it.
static uint32_t check_node(const struct hierarchy *h, uint32_t child, uint32_t count, const float low[3],
                           const float high[3], uint8_t *seen, int depth)
{
    assert_true(depth < HIERARCHY_DEPTH);
    uint32_t sum = 0;
    for (uint32_t i = 0; i < count; i++) {
        const float *leaf = h->leaves + LEAF_FLOATS * child;
        struct ray_triangle t;
        hierarchy_triangle(h, leaf_number(leaf, count, i), &t);
        assert_false(seen[t.number]++);
        for (uint32_t k = 0; k < 9; k++) {
            float x = leaf[k * count + i];
            assert_true(x == (float)t.p[k / 3][k % 3] && x >= low[k % 3] && x <= high[k % 3]);
        }
    }
    assert_true(count <= LEAF_MAX);
    const struct ray_node *n = &h->nodes[child];
    bool ended = false;
    for (int i = 0; i < NODE_CHILDREN && !count; i++) {
        float own_low[3], own_high[3];
        for (int k = 0; k < 3; k++) {
            own_low[k] = n->planes[0][k][i];
            own_high[k] = n->planes[1][k][i];
            ended |= own_low[k] > own_high[k];
        }
        if (ended) { // no child, and none after it
            assert_true(own_low[0] > 1e38f && own_high[0] < -1e38f && i > 0);
            continue;
        }
        for (int k = 0; k < 3; k++)
            assert_true(own_low[k] >= low[k] && own_high[k] <= high[k]);
        assert_true(n->count[i] || n->child[i] < h->node_count);
        sum += check_node(h, n->child[i], n->count[i], own_low, own_high, seen, depth + 1);
    }
    return sum + count;
}

TEST(test_tree)
{
    static uint8_t seen[TRIANGLES_MAX];
    static struct ray_node nodes[TRIANGLES_MAX];
    static float leaves[LEAF_FLOATS * TRIANGLES_MAX];
    static const float low[3] = {-1, -1, -1}, high[3] = {1, 1, 1};
    for (int kind = 0; kind < 3; kind++)
        for (int threads = 1; threads <= 5; threads += 2) {
            seed = 5;
            random_soup(&soup, TRIANGLES_MAX, 1);
            for (uint32_t i = 0; i < soup.count && kind == 1; i++) // the same middle everywhere
                for (int k = 0; k < 3; k++) {
                    soup.p[3 * i + 1][k] = -soup.p[3 * i][k];
                    soup.p[3 * i + 2][k] = 0;
                }
            for (uint32_t i = 0; i < soup.count && kind == 2; i++) // smaller and smaller towards a corner
                for (int k = 0; k < 9; k++)
                    soup.p[3 * i + (uint32_t)k / 3][k % 3] =
                        (float)((double)soup.p[3 * i + (uint32_t)k / 3][k % 3] * 1e-3 + 1) *
                        powf(0.99f, (float)(i % 8000));
            build(&soup, threads, NULL);
            memset(seen, 0, sizeof seen);
            assert_int_equal(check_node(soup.hierarchy, 0, 0, low, high, seen, 0), soup.count);
            if (threads == 1) {
                memcpy(nodes, soup.hierarchy->nodes, soup.hierarchy->node_count * sizeof *nodes);
                memcpy(leaves, soup.hierarchy->leaves, LEAF_FLOATS * soup.count * sizeof *leaves);
            }
            assert_memory_equal(nodes, soup.hierarchy->nodes, soup.hierarchy->node_count * sizeof *nodes);
            assert_memory_equal(leaves, soup.hierarchy->leaves, LEAF_FLOATS * soup.count * sizeof *leaves);
            check_rays(&soup, 10);
            drop(&soup);
        }
}

static bool fits(size_t limit, size_t *used)
{
    struct hierarchy_memory memory = {0};
    struct call_control call;
    lam_control control = {.memory_limit_bytes = limit};
    lam_error error = {0};
    bool built;
    struct pool *pool = pool_make(2);
    call_start(&call, &control);
    bool ok = hierarchy_of_frame(&memory, &soup.frame, pool, &call, &built, &error) != NULL;
    if (!ok) {
        assert_int_equal(error.code, LAM_LIMIT);
        assert_non_null(strstr(error.text, "lam_control.memory_limit_bytes"));
    }
    assert_int_equal(call.memory_used, hierarchy_bytes(&memory)); // memory used only during the call is returned
    *used = call.memory_used;
    hierarchy_free(&memory);
    pool_free(pool);
    return ok;
}

// The memory limit counts the memory used while the hierarchy is built: the cells of large ranges, and a group of
// triangles with the same middle while it is sorted.
TEST(test_memory_limit)
{
    for (int same_middles = 0; same_middles < 2; same_middles++) {
        seed = 5;
        random_soup(&soup, TRIANGLES_MAX, 1);
        for (uint32_t i = 0; i < soup.count && same_middles; i++)
            for (int k = 0; k < 3; k++) {
                soup.p[3 * i + 1][k] = -soup.p[3 * i][k];
                soup.p[3 * i + 2][k] = 0;
            }
        build(&soup, 2, NULL);
        // The number of each triangle, and cells. A group of triangles with the same middle is divided together, with
        // the box, the corners, a node for seven triangles, and a record larger than a triangle's corners.
        size_t numbers = 4 * (size_t)soup.count, kept, used;
        size_t group = same_middles ? (32 + 36 + 36 + 72) * (size_t)soup.count : 0;
        assert_true(fits(SIZE_MAX, &kept));
        assert_true(same_middles || kept < 60 * (size_t)soup.count); // the cost of one triangle
        assert_false(fits(kept + numbers + group, &used));
        assert_true(fits(kept + numbers + 2 * group + 800000, &used));
        assert_int_equal(used, kept);
        drop(&soup);
    }
}

// Triangles with the same three positions, in any order, have the lowest number among them as their twin.
TEST(test_twins)
{
    static const int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    random_soup(&soup, 300, 1);
    for (uint32_t i = 0; i < 300; i++)
        for (int n = 0; n < (i == 7 ? 60 : 2); n++) {
            const int *order = orders[(i + (uint32_t)n) % 6];
            add_triangle(&soup, soup.p[3 * i + (uint32_t)order[0]], soup.p[3 * i + (uint32_t)order[1]],
                         soup.p[3 * i + (uint32_t)order[2]]);
        }
    build(&soup, 2, NULL);
    for (uint32_t i = 0; i < soup.count; i++) {
        const struct ray_triangle *t = triangle_of(&soup, i);
        uint32_t lowest = t->number;
        for (uint32_t j = 0; j < lowest; j++) {
            int same = 0;
            for (int o = 0; o < 6; o++)
                same |= memcmp(soup.p[3 * j + (uint32_t)orders[o][0]], soup.p[3 * t->number], 12) == 0 &&
                        memcmp(soup.p[3 * j + (uint32_t)orders[o][1]], soup.p[3 * t->number + 1], 12) == 0 &&
                        memcmp(soup.p[3 * j + (uint32_t)orders[o][2]], soup.p[3 * t->number + 2], 12) == 0;
            if (same)
                lowest = j;
        }
        assert_int_equal(t->twin, lowest);
        assert_int_equal(hierarchy_twin(soup.hierarchy, i), lowest);
    }
    drop(&soup);
}

// A closed surface of thin triangles around a point: no ray from there leaves it, even through its edges and corners.
TEST(test_watertight)
{
    enum { ROUND = 40, DOWN = 20 };
    static float p[DOWN + 1][ROUND][3];
    for (int j = 0; j <= DOWN; j++)
        for (int i = 0; i < ROUND; i++) {
            double a = 6.28318530717958647 * i / ROUND, b = 3.14159265358979323 * j / DOWN;
            double r = j == 0 || j == DOWN ? 0 : sin(b) * (1 + 0.3 * uniform());
            p[j][i][0] = (float)(r * cos(a) + 0.3);
            p[j][i][1] = (float)cos(b);
            p[j][i][2] = (float)(r * sin(a) * 1e-3 + 0.7); // flat: triangles seen at a grazing angle
        }
    soup.count = 0;
    for (int j = 0; j < DOWN; j++)
        for (int i = 0; i < ROUND; i++) {
            int n = (i + 1) % ROUND;
            add_triangle(&soup, p[j][i], p[j + 1][i], p[j + 1][n]);
            add_triangle(&soup, p[j][i], p[j + 1][n], p[j][n]);
        }
    build(&soup, 1, NULL);
    double centre[3], world[3] = {0.3, 0.01, 0.7};
    ray_point(soup.hierarchy, world, centre);
    for (int round = 0; round < 3000; round++) {
        struct ray_lanes ray;
        for (int i = 0; i < LANES; i++) {
            const struct ray_triangle *t = triangle_of(&soup, (uint32_t)(uniform() * soup.count));
            double share = i & 2 ? uniform() : 0;
            for (int k = 0; k < 3; k++) {
                ray.origin[k][i] = ray.point[k][i] = centre[k];
                ray.direction[k][i] = t->p[0][k] + share * (t->p[1][k] - t->p[0][k]) - centre[k];
                if (i & 1) // no special direction
                    ray.direction[k][i] = between(-1, 1) * (k == 2 ? 1e-3 : 1);
            }
            ray.own[i] = NO_TRIANGLE;
        }
        for (int i = 0; i < LANES; i++)
            ray.end[i] = HUGE_VAL;
        assert_int_equal(any_hit(soup.hierarchy, &ray, 0xff, NULL, NULL, false), 0xff);
    }
    drop(&soup);
}

// Whether a ray crosses a triangle, computed exactly: corners and rays on a grid, in integers.
TEST(test_exact)
{
    int hits = 0;
    for (int round = 0; round < 20000; round++) {
        struct ray_triangle triangle = {.twin = 3};
        struct ray_lanes ray;
        int64_t p[3][3], o[3], d[3];
        for (int k = 0; k < 3; k++) {
            for (int c = 0; c < 3; c++)
                triangle.p[c][k] = (double)(p[c][k] = (int64_t)(uniform() * 8) - 4);
            o[k] = (int64_t)(uniform() * 8) - 4;
            d[k] = (int64_t)(uniform() * 4) * 2 - 4; // powers of two or 0, so divisions are exact
            d[k] = d[k] == 0 || d[k] == 2 || d[k] == -2 || d[k] == -4 ? d[k] : 4;
            for (int i = 0; i < LANES; i++) {
                ray.origin[k][i] = (double)o[k];
                ray.direction[k][i] = (double)d[k];
                ray.own[i] = NO_TRIANGLE;
                ray.end[i] = 1;
            }
        }
        if (!d[0] && !d[1] && !d[2])
            continue;
        int64_t a[3][3], w[3], det = 0, t = 0;
        for (int c = 0; c < 3; c++)
            for (int k = 0; k < 3; k++)
                a[c][k] = p[c][k] - o[k];
        for (int c = 0; c < 3; c++) {
            const int64_t *u = a[(c + 1) % 3], *v = a[(c + 2) % 3];
            w[c] = d[0] * (u[1] * v[2] - u[2] * v[1]) + d[1] * (u[2] * v[0] - u[0] * v[2]) +
                   d[2] * (u[0] * v[1] - u[1] * v[0]);
            det += w[c];
        }
        // o + t d is in the plane: t = det[a b c] / det.
        t = a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1]) + a[0][1] * (a[1][2] * a[2][0] - a[1][0] * a[2][2]) +
            a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0]);
        bool inside =
            (w[0] >= 0 && w[1] >= 0 && w[2] >= 0 && det > 0) || (w[0] <= 0 && w[1] <= 0 && w[2] <= 0 && det < 0);
        bool wanted = inside && (det > 0 ? t > 0 && t < det : t < 0 && t > det);
        struct ray_view view;
        view_along(&view, &ray);
        view_common(&view, 0xff);
        assert_int_equal(crosses(&triangle, &ray, &view, 0xff, NULL, NULL), wanted ? 0xff : 0);
        view.k = -1; // the same with the operations for rays that differ
        assert_int_equal(crosses(&triangle, &ray, &view, 0xff, NULL, NULL), wanted ? 0xff : 0);
        ray.own[2] = 3;
        assert_int_equal(crosses(&triangle, &ray, &view, 0xff, NULL, NULL), wanted ? 0xfb : 0);
        hits += wanted;
    }
    assert_true(hits > 100);
}

// Triangles of one plane in general position, whose corners are rounded to floats: rays from points of one cross no
// other. They do cross a triangle slightly above the plane, by a few times the rounding of a corner.
TEST(test_coplanar)
{
    enum { PLANE = 30 };
    int crossed = 0;
    for (int round = 0; round < 200; round++) {
        double centre[3], axes[3][3], square = 0, n[3];
        for (int i = 0; i < 3; i++) {
            centre[i] = between(-1, 1) * (round % 2 ? 10 : 0);
            axes[0][i] = between(-1, 1);
            axes[1][i] = between(-1, 1);
        }
        for (int i = 0; i < 3; i++)
            axes[2][i] = axes[0][(i + 1) % 3] * axes[1][(i + 2) % 3] - axes[0][(i + 2) % 3] * axes[1][(i + 1) % 3];
        for (int i = 0; i < 3; i++)
            square += axes[2][i] * axes[2][i];
        if (square < 0.1)
            continue;
        for (int t = 0; t <= PLANE; t++) {
            float corners[3][3];
            for (int c = 0; c < 3; c++) {
                double u = between(-1, 1), v = between(-1, 1);
                if (t == PLANE) // the last covers all others
                    u = c == 1 ? 9 : -3, v = c == 2 ? 9 : -3;
                for (int i = 0; i < 3; i++) {
                    n[i] = axes[2][i] / sqrt(square);
                    corners[c][i] = (float)(centre[i] + u * axes[0][i] + v * axes[1][i] + (t == PLANE) * 1e-4 * n[i]);
                }
            }
            add_triangle(&soup, corners[0], corners[1], corners[2]);
        }
        build(&soup, 1, NULL);
        struct ray_view view;
        for (int i = 0; i < PLANE; i++) {
            struct ray_lanes ray;
            const struct ray_triangle *own = triangle_of(&soup, (uint32_t)i);
            for (int lane = 0; lane < LANES; lane++) {
                double b1 = uniform(), b2 = uniform() * (1 - b1), toward = 0, to[3];
                for (int k = 0; k < 3; k++)
                    toward += (to[k] = between(-1, 1)) * n[k];
                for (int k = 0; k < 3; k++) {
                    ray.origin[k][lane] = ray.point[k][lane] =
                        own->p[0][k] + ((own->p[1][k] - own->p[0][k]) * b1 + (own->p[2][k] - own->p[0][k]) * b2);
                    ray.direction[k][lane] = toward < 0 ? -to[k] : to[k];
                }
                ray.own[lane] = (int32_t)own->twin;
                ray.end[lane] = HUGE_VAL;
            }
            view_along(&view, &ray);
            view_common(&view, 0xff);
            unsigned all = 0;
            for (uint32_t t = 0; t <= PLANE; t++) {
                const struct ray_triangle *other = triangle_of(&soup, t);
                unsigned found_here = crosses(other, &ray, &view, 0xff, NULL, NULL), through;
                through = through_points(soup.hierarchy, other, ray.point, found_here);
                if (other->number == PLANE)
                    assert_int_equal(through, 0);
                else
                    assert_int_equal(through, found_here);
                crossed += other->number != PLANE ? __builtin_popcount(found_here) : 0;
                all |= found_here & ~through;
            }
            assert_int_equal(any_hit(soup.hierarchy, &ray, 0xff, NULL, NULL, false), all);
        }
        drop(&soup);
    }
    assert_true(crossed > 1000);
}

TEST(test_nothing)
{
    struct hierarchy none = {.scale = 1};
    struct ray_lanes ray = {.end = {1}, .direction = {{0}, {1}}};
    assert_int_equal(any_hit(&none, &ray, 0xff, NULL, NULL, false), 0);
}
