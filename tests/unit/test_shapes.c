// test_shapes.c: built-in shapes, and tessellation of parametric and implicit surfaces. The file has more than 600
// lines because it lists the properties of each shape, and contains the checks that all shapes share.

#include "test.h"
#include "arena.h"
#include "shapes.h"

#include <lambent/scene.h>

// --- Inspecting meshes

typedef struct {
    double x, y, z;
} point;

static point minus(point a, point b) { return (point){a.x - b.x, a.y - b.y, a.z - b.z}; }
static double dot(point a, point b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static point cross(point a, point b)
{
    return (point){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static double length(point a) { return sqrt(dot(a, a)); }
static point from_floats(const float *f) { return (point){(double)f[0], (double)f[1], (double)f[2]}; }

static uint32_t element(const uint32_t *own, const lam_mesh *mesh, size_t corner)
{
    return own ? own[corner] : mesh->indices ? mesh->indices[corner] : (uint32_t)corner;
}
static point position(const lam_mesh *mesh, size_t corner)
{
    return from_floats(mesh->positions + 3 * (size_t)element(NULL, mesh, corner));
}
static point normal(const lam_mesh *mesh, size_t corner)
{
    return from_floats(mesh->normals + 3 * (size_t)element(mesh->normal_indices, mesh, corner));
}

struct place {
    float position[3];
    uint32_t vertex;
};
static int compare_places(const void *a, const void *b)
{
    int order = memcmp(((const struct place *)a)->position, ((const struct place *)b)->position, 12);
    return order ? order : ((const struct place *)a)->vertex < ((const struct place *)b)->vertex ? -1 : 1;
}

// vertex → the lowest vertex with the same position bits.
static uint32_t *weld(const lam_mesh *mesh)
{
    uint32_t *same = malloc((mesh->vertex_count + 1) * sizeof *same);
    struct place *places = malloc((mesh->vertex_count + 1) * sizeof *places);
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        memcpy(places[i].position, mesh->positions + 3 * (size_t)i, 12);
        places[i].vertex = i;
    }
    qsort(places, mesh->vertex_count, sizeof *places, compare_places);
    for (uint32_t i = 0, first = 0; i < mesh->vertex_count; i++) {
        if (memcmp(places[i].position, places[first].position, 12) != 0)
            first = i;
        same[places[i].vertex] = places[first].vertex;
    }
    free(places);
    return same;
}

static int compare_edges(const void *a, const void *b)
{
    uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return x < y ? -1 : x > y;
}

// Edges that do not occur exactly once in each direction, with welded positions.
static size_t open_edges(const lam_mesh *mesh)
{
    uint32_t *same = weld(mesh);
    size_t corners = 3 * (size_t)mesh->triangle_count, bad = 0;
    uint64_t *edges = malloc(corners * sizeof *edges);
    for (size_t c = 0; c < corners; c++) {
        size_t next = c % 3 == 2 ? c - 2 : c + 1;
        uint64_t a = same[element(NULL, mesh, c)], b = same[element(NULL, mesh, next)];
        assert_true(a != b);
        edges[c] = a << 32 | b;
    }
    qsort(edges, corners, sizeof *edges, compare_edges);
    for (size_t c = 0; c < corners; c++) {
        uint64_t back = edges[c] << 32 | edges[c] >> 32;
        bool once = c == 0 || edges[c] != edges[c - 1];
        bad += !once || !bsearch(&back, edges, corners, sizeof *edges, compare_edges);
    }
    free(edges);
    free(same);
    return bad;
}

static double volume(const lam_mesh *mesh)
{
    double six = 0;
    for (size_t t = 0; t < mesh->triangle_count; t++)
        six += dot(position(mesh, 3 * t), cross(position(mesh, 3 * t + 1), position(mesh, 3 * t + 2)));
    return six / 6;
}

static void bounds(const lam_mesh *mesh, double low[3], double high[3])
{
    for (int a = 0; a < 3; a++) {
        low[a] = 1e30;
        high[a] = -1e30;
    }
    for (size_t i = 0; i < 3 * (size_t)mesh->vertex_count; i++) {
        double x = (double)mesh->positions[i];
        low[i % 3] = fmin(low[i % 3], x);
        high[i % 3] = fmax(high[i % 3], x);
    }
}

// FNV-1a of the parts of a mesh that affect pictures.
static uint64_t hash_bytes(uint64_t h, const void *bytes, size_t size)
{
    for (size_t i = 0; i < size; i++)
        h = (h ^ ((const unsigned char *)bytes)[i]) * UINT64_C(0x100000001b3);
    return h;
}
static uint64_t hash_mesh(const lam_mesh *mesh)
{
    uint64_t h = UINT64_C(0xcbf29ce484222325);
    h = hash_bytes(h, mesh->positions, 12 * (size_t)mesh->vertex_count);
    h = hash_bytes(h, mesh->indices, 12 * (size_t)mesh->triangle_count);
    h = hash_bytes(h, mesh->normals, 12 * (size_t)mesh->normal_count);
    return h;
}

// Unit normals on the outward side of each face, unit tangents perpendicular to them, and only finite numbers in range.
static void check_attributes(const lam_mesh *mesh, const char *name)
{
    for (size_t c = 0; c < 3 * (size_t)mesh->triangle_count; c++) {
        assert_true(element(NULL, mesh, c) < mesh->vertex_count);
        assert_true(element(mesh->normal_indices, mesh, c) < mesh->normal_count);
        point n = normal(mesh, c);
        if (!(fabs(length(n) - 1) < 1e-6))
            fail_msg("%s: a normal of length %g at corner %zu", name, length(n), c);
        if (mesh->texcoords) {
            const float *st = mesh->texcoords + 2 * (size_t)element(mesh->texcoord_indices, mesh, c);
            assert_true(st[0] >= 0 && st[0] <= 1 && st[1] >= 0 && st[1] <= 1);
        }
        if (mesh->tangents) {
            const float *four = mesh->tangents + 4 * (size_t)element(mesh->tangent_indices, mesh, c);
            point t = from_floats(four);
            assert_true(fabs(length(t) - 1) < 1e-6);
            assert_true(fabs(dot(t, n)) < 1e-6);
            assert_true(four[3] == 1.0f);
        }
    }
    for (size_t t = 0; t < mesh->triangle_count; t++) {
        point a = position(mesh, 3 * t);
        point face = cross(minus(position(mesh, 3 * t + 1), a), minus(position(mesh, 3 * t + 2), a));
        if (!(length(face) > 0))
            fail_msg("%s: triangle %zu has no area", name, t);
        if (length(face) < 1e-9) // its own normal consists of rounding errors
            continue;
        for (size_t k = 0; k < 3; k++)
            if (!(dot(face, normal(mesh, 3 * t + k)) > 0))
                fail_msg("%s: the normal at corner %zu of triangle %zu is on the inner side", name, k, t);
    }
}

// Tangents follow the texture: s grows along them, and t along n × tangent.
static void check_texture_frame(const lam_mesh *mesh, const char *name)
{
    for (size_t t = 0; t < mesh->triangle_count; t++) {
        const float *st[3];
        for (size_t k = 0; k < 3; k++)
            st[k] = mesh->texcoords + 2 * (size_t)element(mesh->texcoord_indices, mesh, 3 * t + k);
        point a = position(mesh, 3 * t), e1 = minus(position(mesh, 3 * t + 1), a),
              e2 = minus(position(mesh, 3 * t + 2), a);
        double s1 = (double)(st[1][0] - st[0][0]), t1 = (double)(st[1][1] - st[0][1]);
        double s2 = (double)(st[2][0] - st[0][0]), t2 = (double)(st[2][1] - st[0][1]);
        double area = s1 * t2 - s2 * t1;
        if (!(area > 0))
            fail_msg("%s: the texture of triangle %zu is mirrored or without area", name, t);
        point along = {(t2 * e1.x - t1 * e2.x) / area, (t2 * e1.y - t1 * e2.y) / area, (t2 * e1.z - t1 * e2.z) / area};
        const float *four = mesh->tangents + 4 * (size_t)element(mesh->tangent_indices, mesh, 3 * t);
        if (!(dot(along, from_floats(four)) > 0.7 * length(along)))
            fail_msg("%s: the tangent of triangle %zu does not follow its texture", name, t);
    }
}

// --- The built-in shapes

struct expected {
    const char *name;
    bool closed;
    double volume; // of the exact body; 0 if unknown
    double reach;  // how close to ±1 the box comes
    uint64_t hash; // positions, indices, normals: the same for every compiler and build
};

static const struct expected expected[] = {
    {"sphere", true, 4.18879, 1e-6, UINT64_C(0xa0c8a8db5a0423cf)},
    {"torus", true, 2 * 9.8696044 * 0.7 * 0.09, 1e-6, UINT64_C(0x6cad90f85dec4d50)},
    {"plane", false, 0, 0, UINT64_C(0xe7fc2c2e90498c16)},
    {"cube", true, 8, 0, UINT64_C(0xedd2e29c7be892e5)},
    {"cylinder", true, 6.2831853, 1e-6, UINT64_C(0x10480d1957ba91ad)},
    {"cone", true, 2.0943951, 1e-6, UINT64_C(0xe585a6f76dc55411)},
    {"teapot", false, 0, 1e-3, UINT64_C(0xc2416c296b159c08)},
    {"torus-knot", true, 0, 1e-3, UINT64_C(0x529d8e15677c303b)},
    {"gyroid", true, 0, 1e-3, UINT64_C(0x37abdf9a42fbf76a)},
    {"metaballs", true, 0, 2e-3, UINT64_C(0x2b34211beaccf4be)},
};

static const lam_mesh *make(lam_scene *scene, const char *name, const lam_shape_params *params)
{
    lam_error error = {0};
    int index = lam_scene_add_shape(scene, name, params, &error);
    if (index < 0)
        fail_msg("%s: %s", name, error.text);
    return lam_scene_mesh(scene, index);
}

TEST(test_shapes)
{
    assert_int_equal(lam_shape_count(), sizeof expected / sizeof *expected);
    lam_scene *scene = lam_scene_make(NULL);
    int wrong = 0;
    for (int i = 0; i < lam_shape_count(); i++) {
        const struct expected *e = &expected[i];
        assert_string_equal(lam_shape_name(i), e->name);
        assert_true(strlen(lam_shape_summary(i)) > 0);
        assert_int_equal(lam_shape_find(e->name), i);
        const lam_mesh *mesh = make(scene, e->name, NULL);
        assert_string_equal(mesh->name, e->name);
        check_attributes(mesh, e->name);
        if (mesh->tangents)
            check_texture_frame(mesh, e->name);
        if (e->closed) {
            assert_int_equal(open_edges(mesh), 0);
            assert_true(volume(mesh) > 0.1);
        }
        if (e->volume > 0)
            assert_true(fabs(volume(mesh) / e->volume - 1) < 2e-3);
        double low[3], high[3], farthest = 0;
        bounds(mesh, low, high);
        for (int a = 0; a < 3; a++) {
            assert_true(low[a] >= -1.000001 && high[a] <= 1.000001);
            farthest = fmax(farthest, fmax(-low[a], high[a]));
        }
        assert_true(farthest >= 1 - e->reach - 1e-9);
        if (hash_mesh(mesh) != e->hash) {
            print_message("%s: hash 0x%016llx, recorded 0x%016llx (%u triangles)\n", e->name,
                          (unsigned long long)hash_mesh(mesh), (unsigned long long)e->hash, mesh->triangle_count);
            wrong++;
        }
    }
    lam_scene_free(scene);
    assert_int_equal(wrong, 0);
    assert_null(lam_shape_name(-1));
    assert_null(lam_shape_name(lam_shape_count()));
    assert_null(lam_shape_summary(lam_shape_count()));
    assert_int_equal(lam_shape_find("ball"), -1);
    assert_int_equal(lam_shape_find(NULL), -1);
}

TEST(test_shape_options)
{
    AUTO_SCENE scene = lam_scene_make(NULL);
    for (int i = 0; i < lam_shape_count(); i++) {
        // The coarsest, an odd and a finer tessellation are also closed.
        static const lam_shape_params tries[] = {{.slices = 3, .stacks = 3},
                                                 {.slices = 17, .stacks = 5, .radius = 250},
                                                 {.slices = 40, .stacks = 21, .radius = 1e-3}};
        for (int k = 0; k < 3; k++) {
            const char *name = lam_shape_name(i);
            const lam_mesh *mesh = make(scene, name, &tries[k]);
            double radius = tries[k].radius > 0 ? tries[k].radius : 1, low[3], high[3];
            bounds(mesh, low, high);
            for (int a = 0; a < 3; a++)
                assert_true(low[a] >= -1.000001 * radius && high[a] <= 1.000001 * radius);
            if (expected[i].closed)
                assert_int_equal(open_edges(mesh), 0);
        }
    }
    lam_error error;
    static const lam_shape_params bad[] = {{.slices = 2},
                                           {.slices = 16385},
                                           {.slices = -1},
                                           {.stacks = -1},
                                           {.stacks = 16385},
                                           {.radius = -1},
                                           {.radius = (double)INFINITY},
                                           {.radius = (double)NAN}};
    static const char *const named[] = {"slices", "slices", "slices", "stacks", "stacks", "radius", "radius", "radius"};
    for (int k = 0; k < 8; k++) {
        assert_int_equal(lam_scene_add_shape(scene, "sphere", &bad[k], &error), -1);
        assert_int_equal(error.code, LAM_BAD_ARGUMENT);
        assert_non_null(strstr(error.text, named[k]));
    }
    assert_int_equal(lam_scene_add_shape(scene, "teapod", NULL, &error), -1);
    assert_int_equal(error.code, LAM_BAD_ARGUMENT);
    assert_non_null(strstr(error.text, "'teapot'"));
    assert_int_equal(lam_scene_add_shape(scene, "gyroid", &(lam_shape_params){.slices = 1025}, &error), -1);
    assert_non_null(strstr(error.text, "1024"));
    assert_int_equal(lam_scene_add_shape(scene, "torus", &(lam_shape_params){.stacks = 2}, &error), -1);
    assert_non_null(strstr(error.text, "at least 3"));
    assert_int_equal(lam_scene_add_shape(NULL, "sphere", NULL, &error), -1);
    assert_int_equal(lam_scene_add_shape(scene, NULL, NULL, &error), -1);
}

// Any number of threads gives the same mesh.
TEST(test_threads)
{
    for (int i = 0; i < lam_shape_count(); i++) {
        static const int threads[] = {1, 2, 5};
        uint64_t hashes[3];
        for (int k = 0; k < 3; k++) {
            AUTO_SCENE scene = lam_scene_make(NULL);
            hashes[k] = hash_mesh(make(scene, lam_shape_name(i),
                                       &(lam_shape_params){.slices = 150, .stacks = 131, .threads = threads[k]}));
        }
        assert_true(hashes[0] == hashes[1] && hashes[0] == hashes[2]);
    }
    lam_error error;
    AUTO_SCENE scene = lam_scene_make(NULL);
    assert_int_equal(lam_scene_add_shape(scene, "torus", &(lam_shape_params){.threads = 1025}, &error), -1);
    assert_non_null(strstr(error.text, "threads"));
}

// For any coarseness, no side of a triangle occurs twice in one direction. In a tube that is so coarse that it is flat,
// both sheets are in one place and share all sides.
TEST(test_coarsest_segments)
{
    AUTO_SCENE scene = lam_scene_make(NULL);
    for (int i = 0; i < lam_shape_count() * 6 * 3; i++) {
        lam_shape_params params = {.slices = 3 + i % 6, .stacks = 1 + i / 6 % 3};
        lam_error error = {0};
        int index = lam_scene_add_shape(scene, lam_shape_name(i / 18), &params, &error);
        if (index < 0) { // sphere needs 2 stacks, torus and torus-knot 3
            assert_non_null(strstr(error.text, "at least"));
            continue;
        }
        const lam_mesh *mesh = lam_scene_mesh(scene, index);
        uint32_t *same = weld(mesh);
        size_t corners = 3 * (size_t)mesh->triangle_count;
        uint64_t *edges = malloc(corners * sizeof *edges);
        for (size_t c = 0; c < corners; c++)
            edges[c] =
                (uint64_t)same[element(NULL, mesh, c)] << 32 | same[element(NULL, mesh, c % 3 == 2 ? c - 2 : c + 1)];
        qsort(edges, corners, sizeof *edges, compare_edges);
        for (size_t c = 1; c < corners; c++)
            if (edges[c - 1] == edges[c])
                fail_msg("%s with %d by %d segments: two triangles have the same side", lam_shape_name(i / 18),
                         params.slices, params.stacks);
        free(edges);
        free(same);
    }
}

// A sphere's triangles approach it. When the segments double, the error between face normals and vertex normals halves,
// and the error between the face normal and the mean of the vertex normals falls to a quarter.
static void sphere_errors(int slices, double *at_vertices, double *at_middle)
{
    AUTO_SCENE scene = lam_scene_make(NULL);
    const lam_mesh *mesh = make(scene, "sphere", &(lam_shape_params){.slices = slices, .stacks = slices / 2});
    *at_vertices = *at_middle = 0;
    for (size_t t = 0; t < mesh->triangle_count; t++) {
        point p[3], n[3];
        for (size_t k = 0; k < 3; k++) {
            p[k] = position(mesh, 3 * t + k);
            n[k] = normal(mesh, 3 * t + k);
        }
        point face = cross(minus(p[1], p[0]), minus(p[2], p[0]));
        point middle = {p[0].x + p[1].x + p[2].x, p[0].y + p[1].y + p[2].y, p[0].z + p[1].z + p[2].z};
        point mean = {n[0].x + n[1].x + n[2].x, n[0].y + n[1].y + n[2].y, n[0].z + n[1].z + n[2].z};
        double sum = 0;
        for (int k = 0; k < 3; k++)
            sum += length(cross(face, n[k])) / length(face) / 3;
        *at_vertices += sum / mesh->triangle_count;
        // The true direction of the mean of the corners, and the direction of the interpolated normal before
        // normalization: its length falls short of 1 by the square of the segment.
        *at_middle += fabs(1 - length(mean) / 3) / mesh->triangle_count;
        assert_true(length(cross(middle, mean)) / (length(middle) * length(mean)) < 1e-6);
    }
}

TEST(test_convergence)
{
    double before_vertices = 0, before_middle = 0;
    for (int slices = 16; slices <= 256; slices *= 2) {
        double vertices, middle;
        sphere_errors(slices, &vertices, &middle);
        if (slices > 16) {
            assert_true(before_vertices / vertices > 1.9 && before_vertices / vertices < 2.1);
            assert_true(before_middle / middle > 3.8 && before_middle / middle < 4.2);
        }
        before_vertices = vertices;
        before_middle = middle;
    }
}

// --- The unit sphere in three ways, with the mathematics library's functions, as a user would write it

static lam_parametric parametric(lam_surface_fn *surface, double u_max, double v_max, int u_segments, int v_segments,
                                 bool u_closed)
{
    return (lam_parametric){.surface = surface,
                            .u_max = u_max,
                            .v_max = v_max,
                            .u_segments = u_segments,
                            .v_segments = v_segments,
                            .u_closed = u_closed};
}

static void user_sphere(void *user, double u, double v, lam_surface_point *out)
{
    bool limits = user != NULL;
    double su = sin(u), cu = cos(u), sv = sin(v), cv = cos(v);
    out->p = (lam_vec3){cu * sv, su * sv, -cv};
    double length_u = limits && fabs(sv) < 1e-9 ? 1 : fabs(sv) < 1e-9 ? 0 : sv;
    out->dp_du = (lam_vec3){-su * length_u, cu * length_u, 0};
    out->dp_dv = (lam_vec3){cu * cv, su * cv, sv};
}

static double ball_value(void *user, lam_vec3 p)
{
    (void)user;
    return p.x * p.x + p.y * p.y + p.z * p.z - 1;
}
static lam_vec3 ball_gradient(void *user, lam_vec3 p)
{
    (void)user;
    return (lam_vec3){2 * p.x, 2 * p.y, 2 * p.z};
}

TEST(test_unit_sphere)
{
    AUTO_SCENE scene = lam_scene_make(NULL);
    lam_error error = {0};
    int yes = 1;
    // With the limit direction at the poles, and with derivatives that vanish there.
    for (int k = 0; k < 2; k++) {
        lam_parametric sphere = parametric(user_sphere, 2 * M_PI, M_PI, 48, 24, true);
        sphere.user = k ? NULL : &yes;
        int index = lam_scene_add_parametric(scene, &sphere, NULL, &error);
        assert_int_equal(index, k);
        const lam_mesh *mesh = lam_scene_mesh(scene, index);
        assert_int_equal(mesh->vertex_count, 48 * 23 + 2);
        assert_int_equal(mesh->triangle_count, 48 * 22 * 2 + 48 * 2);
        check_attributes(mesh, "sphere");
        check_texture_frame(mesh, "sphere");
        assert_int_equal(open_edges(mesh), 0);
        for (size_t c = 0; c < 3 * (size_t)mesh->triangle_count; c++) {
            // The parametric normal ∂p/∂u × ∂p/∂v, ∇f/|∇f| and the position are the same vector on the unit sphere.
            point p = position(mesh, c), n = normal(mesh, c);
            lam_vec3 g = ball_gradient(NULL, (lam_vec3){p.x, p.y, p.z});
            point gradient = {g.x / 2, g.y / 2, g.z / 2};
            assert_true(length(minus(n, gradient)) < 3e-7);
        }
        // At the seam, the normals of both sides have the same bits.
        for (int j = 0; j <= 24; j++)
            assert_memory_equal(mesh->normals + 3 * (size_t)(49 * j), mesh->normals + 3 * (size_t)(49 * j + 48), 12);
    }
    // Lattice points on the surface (cells 20, 24), and none on it (cells 25).
    static const int cells[] = {20, 24, 25, 61};
    for (int k = 0; k < 4; k++) {
        lam_implicit ball = {.value = ball_value,
                             .gradient = ball_gradient,
                             .minimum = {-1.25, -1.25, -1.25},
                             .maximum = {1.25, 1.25, 1.25},
                             .cells = cells[k]};
        int index = lam_scene_add_implicit(scene, &ball, NULL, &error);
        assert_int_equal(index, 2 + k);
        const lam_mesh *mesh = lam_scene_mesh(scene, index);
        check_attributes(mesh, "ball");
        assert_int_equal(open_edges(mesh), 0);
        assert_true(fabs(volume(mesh) / (4 * M_PI / 3) - 1) < 0.02);
        for (size_t c = 0; c < 3 * (size_t)mesh->triangle_count; c++) {
            point p = position(mesh, c);
            assert_true(fabs(length(p) - 1) < 2e-7);
            assert_true(length(minus(p, normal(mesh, c))) < 3e-7);
        }
    }
}

// Every case of the table, by random values on the lattice: closed meshes without an edge in more than two triangles.
struct noise {
    int n;
    signed char *sign; // for the inner lattice points
};
static double noise_value(void *user, lam_vec3 p)
{
    const struct noise *noise = user;
    int n = noise->n;
    // Trilinear between lattice points 0…n, and outside around them.
    double f = 0;
    int x = (int)floor(p.x), y = (int)floor(p.y), z = (int)floor(p.z);
    for (int k = 0; k < 8; k++) {
        int i = x + (k & 1), j = y + (k >> 1 & 1), l = z + (k >> 2);
        double w = (k & 1 ? p.x - x : 1 - p.x + x) * (k & 2 ? p.y - y : 1 - p.y + y) * (k & 4 ? p.z - z : 1 - p.z + z);
        bool inner = i > 0 && j > 0 && l > 0 && i < n && j < n && l < n;
        f += w * (inner ? noise->sign[(l * n + j) * n + i] : 1);
    }
    return f;
}
static lam_vec3 noise_gradient(void *user, lam_vec3 p)
{
    const double h = 1e-3;
    return (lam_vec3){
        noise_value(user, (lam_vec3){p.x + h, p.y, p.z}) - noise_value(user, (lam_vec3){p.x - h, p.y, p.z}),
        noise_value(user, (lam_vec3){p.x, p.y + h, p.z}) - noise_value(user, (lam_vec3){p.x, p.y - h, p.z}),
        noise_value(user, (lam_vec3){p.x, p.y, p.z + h}) - noise_value(user, (lam_vec3){p.x, p.y, p.z - h})};
}

TEST(test_every_cell_case)
{
    enum { N = 24 };
    static signed char sign[N * N * N];
    uint32_t random = 1;
    for (int share = 1; share < 4; share++) { // a quarter, a half, or three quarters inside
        for (int i = 0; i < N * N * N; i++) {
            random = random * 1664525u + 1013904223u;
            sign[i] = (int)(random >> 30) < share ? -1 : 1;
        }
        struct noise noise = {N, sign};
        lam_implicit surface = {
            .value = noise_value, .gradient = noise_gradient, .user = &noise, .maximum = {N, N, N}, .cells = N};
        AUTO_SCENE scene = lam_scene_make(NULL);
        lam_error error = {0};
        assert_int_equal(lam_scene_add_implicit(scene, &surface, NULL, &error), 0);
        const lam_mesh *mesh = lam_scene_mesh(scene, 0);
        assert_true(mesh->triangle_count > 10000);
        assert_int_equal(open_edges(mesh), 0);
        assert_true(volume(mesh) > 0);
    }
}

// --- Other formulas

static void cone_point(void *user, double u, double v, lam_surface_point *out)
{
    (void)user;
    out->p = (lam_vec3){v * cos(u), v * sin(u), 1 - v};
    out->dp_du = (lam_vec3){-v * sin(u), v * cos(u), 0}; // vanishes at the tip
    out->dp_dv = (lam_vec3){-cos(u), -sin(u), 1};
    out->dp_dv = (lam_vec3){-out->dp_dv.x, -out->dp_dv.y, -out->dp_dv.z};
}

// A tip is not a smooth pole: each triangle's corner there has the normal of its own side.
TEST(test_tip)
{
    AUTO_SCENE scene = lam_scene_make(NULL);
    // (v, u) in this order makes ∂p/∂u × ∂p/∂v point outward, so the tip is a column that coincides, not a row.
    lam_parametric cone = parametric(cone_point, 2 * M_PI, 1, 16, 4, true);
    assert_int_equal(lam_scene_add_parametric(scene, &cone, NULL, NULL), 0);
    const lam_mesh *mesh = lam_scene_mesh(scene, 0);
    assert_int_equal(mesh->vertex_count, 16 * 4 + 1);
    for (size_t c = 0; c < 3 * (size_t)mesh->triangle_count; c++) {
        point n = normal(mesh, c);
        // ∂p/∂u × ∂p/∂v points inward here (down and in), so the mesh is reversed in the same way.
        assert_true(fabs(n.z + sqrt(0.5)) < 1e-6);
        point a = position(mesh, c / 3 * 3),
              face = cross(minus(position(mesh, c / 3 * 3 + 1), a), minus(position(mesh, c / 3 * 3 + 2), a));
        assert_true(dot(face, n) > 0.98 * length(face));
    }
}

static void triangle_patch(void *user, double u, double v, lam_surface_point *out)
{
    (void)user; // flat; the column u = 0 is one point
    out->p = (lam_vec3){u, u * v, 1e7};
    out->dp_du = (lam_vec3){1, v, 0};
    out->dp_dv = (lam_vec3){0, u, 0};
}

TEST(test_column_pole_and_origin)
{
    AUTO_SCENE scene = lam_scene_make(NULL);
    lam_parametric patch = parametric(triangle_patch, 1, 1, 3, 4, false);
    patch.v_min = -1;
    assert_int_equal(lam_scene_add_parametric(scene, &patch, NULL, NULL), 0);
    const lam_mesh *mesh = lam_scene_mesh(scene, 0);
    assert_int_equal(mesh->vertex_count, 3 * 5 + 1);
    assert_int_equal(mesh->triangle_count, 2 * 4 * 2 + 4);
    check_attributes(mesh, "patch");
    for (size_t c = 0; c < 3 * (size_t)mesh->triangle_count; c++)
        assert_true(normal(mesh, c).z > 0.999999);
    assert_true(fabs(mesh->origin[2] + (double)mesh->positions[2] - 1e7) < 1e-6);
    assert_true(fabs((double)mesh->positions[2]) < 1);
}

static void infinite_point(void *user, double u, double v, lam_surface_point *out)
{
    (void)user;
    (void)v;
    *out = (lam_surface_point){{1 / (u - 0.3), 0, v}, {1, 0, 0}, {0, 1, 0}};
}

static double nan_value(void *user, lam_vec3 p) { return p.x < 0 ? (double)NAN : ball_value(user, p); }

TEST(test_bad_formulas)
{
    AUTO_SCENE scene = lam_scene_make(NULL);
    lam_error error;
    lam_parametric good = parametric(user_sphere, 1, 1, 4, 4, false);
    lam_parametric bad[6];
    static const char *const named[6] = {"NULL", "u goes", "v goes", "u_segments", "v_segments", "coordinate"};
    for (int i = 0; i < 6; i++)
        bad[i] = good;
    bad[0].surface = NULL;
    bad[1].u_max = 0;
    bad[2].v_max = (double)NAN;
    bad[3].u_segments = 0;
    bad[4].v_segments = 16385;
    bad[5].surface = infinite_point;
    bad[5].u_segments = 10; // includes 0.3, which the coarse sample does not
    for (int i = 0; i < 6; i++) {
        assert_int_equal(lam_scene_add_parametric(scene, &bad[i], NULL, &error), -1);
        assert_int_equal(error.code, LAM_BAD_ARGUMENT);
        if (!strstr(error.text, named[i]))
            fail_msg("'%s' does not name %s", error.text, named[i]);
    }
    lam_parametric huge = good;
    huge.u_segments = huge.v_segments = 16384;
    assert_int_equal(lam_scene_add_parametric(scene, &huge, NULL, &error), -1);
    assert_int_equal(error.code, LAM_LIMIT);

    lam_implicit ball = {
        .value = ball_value, .gradient = ball_gradient, .minimum = {-2, -2, -2}, .maximum = {2, 2, 2}, .cells = 8};
    lam_implicit wrong = ball;
    wrong.gradient = NULL;
    assert_int_equal(lam_scene_add_implicit(scene, &wrong, NULL, &error), -1);
    assert_non_null(strstr(error.text, "gradient"));
    wrong = ball;
    wrong.cells = 1025;
    assert_int_equal(lam_scene_add_implicit(scene, &wrong, NULL, &error), -1);
    assert_non_null(strstr(error.text, "cells"));
    wrong = ball;
    wrong.maximum.y = -2;
    assert_int_equal(lam_scene_add_implicit(scene, &wrong, NULL, &error), -1);
    assert_non_null(strstr(error.text, "along y"));
    wrong = ball;
    wrong.value = nan_value; // counts as outside
    assert_int_equal(lam_scene_add_implicit(scene, &wrong, NULL, &error), 0);
    check_attributes(lam_scene_mesh(scene, 0), "half ball");

    // Controls: cancelled, out of time, out of memory.
    lam_cancel cancel = {0};
    lam_cancel_raise(&cancel);
    assert_int_equal(lam_scene_add_implicit(scene, &ball, &(lam_control){.cancel = &cancel}, &error), -1);
    assert_int_equal(error.code, LAM_CANCELLED);
    assert_int_equal(lam_scene_add_parametric(scene, &good, &(lam_control){.cancel = &cancel}, &error), -1);
    assert_int_equal(error.code, LAM_CANCELLED);
    ball.cells = 200;
    assert_int_equal(lam_scene_add_implicit(scene, &ball, &(lam_control){.memory_limit_bytes = 4 << 20}, &error), -1);
    assert_int_equal(error.code, LAM_LIMIT);
    assert_int_equal(lam_scene_mesh_count(scene), 1);
}

// Of several bad points, the first one is reported, whichever thread finds it.
TEST(test_bad_points_of_threads)
{
    lam_parametric bad = parametric(infinite_point, 1, 1, 150, 150, false);
    struct arena arena;
    lam_error errors[2] = {0};
    for (int k = 0; k < 2; k++) {
        struct call_control call;
        lam_mesh mesh;
        call_start(&call, NULL);
        arena_start(&arena, &call);
        const struct shape_request request = {
            .arena = &arena, .call = &call, .error = &errors[k], .threads = k ? 5 : 1};
        assert_false(tessellate_parametric(&bad, 1, &request, &mesh));
        arena_free(&arena);
    }
    assert_int_equal(errors[0].code, LAM_BAD_ARGUMENT);
    assert_string_equal(errors[0].text, errors[1].text);
}

// If an allocation fails, the call gives an error and nothing else.
TEST(test_allocations_fail)
{
    for (int shape = 0; shape < lam_shape_count(); shape++) {
        bool done = false;
        for (long k = 0; !done && k < 200; k++) {
            AUTO_SCENE scene = lam_scene_make(NULL);
            lam_error error = {0};
            arena_fail_after(k);
            int index = lam_scene_add_shape(scene, lam_shape_name(shape),
                                            &(lam_shape_params){.slices = 12, .stacks = 4}, &error);
            arena_fail_after(-1);
            done = index >= 0;
            if (!done) {
                assert_int_equal(error.code, LAM_MACHINE);
                assert_int_equal(lam_scene_mesh_count(scene), 0);
            }
        }
        assert_true(done);
    }
}

// --- The teapot

TEST(test_teapot_data)
{
    // Some of the 306 published points, as printed in the list (numbers from 1).
    assert_true(teapot_body[3][0].radius == 1.5 && teapot_body[3][0].step == 0.84 &&
                teapot_body[3][0].height == 2.4);                                    // 13, 14
    assert_true(teapot_body[3][3].radius == 1.4 && teapot_body[3][3].step == 0.784); // 1, 2
    assert_true(teapot_lid[1][2].radius == 0.8 && teapot_lid[1][2].step == 0.45 &&
                teapot_lid[1][2].height == 3.15);                                    // 207
    assert_true(teapot_spout[1][1].bx == 3.525 && teapot_spout[1][1].bz == 2.49375); // 188
    assert_true(teapot_handle[1][3].ax == -2.0 && teapot_handle[1][3].bz == 0.6);    // 69, 155
    // Consecutive bands share a ring.
    for (int i = 0; i < 3; i++)
        assert_memory_equal(&teapot_body[i][3], &teapot_body[i + 1][0], sizeof(struct teapot_ring));
    assert_memory_equal(&teapot_lid[0][3], &teapot_lid[1][0], sizeof(struct teapot_ring));
    assert_memory_equal(&teapot_handle[0][3], &teapot_handle[1][0], sizeof(struct teapot_section));
    assert_memory_equal(&teapot_spout[0][3], &teapot_spout[1][0], sizeof(struct teapot_section));
}

// The shared teapot.obj consists of the same patches divided into 10 × 10: the vertices with 10 segments per patch are
// its vertices.
TEST(test_teapot_against_file)
{
    const char *models = getenv("LAMBENT_MODELS");
    char path[4096];
    snprintf(path, sizeof path, "%s/obj/teapot/teapot.obj", models ? models : "../shared/models");
    FILE *file = fopen(path, "r");
    if (!file) {
        print_message("skipped: %s is not there\n", path);
        skip();
    }
    enum { ROOM = 8192 };
    static point theirs[ROOM];
    size_t count = 0;
    char line[256];
    while (fgets(line, sizeof line, file) && count < ROOM)
        if (sscanf(line, "v %lf %lf %lf", &theirs[count].x, &theirs[count].y, &theirs[count].z) == 3)
            count++;
    fclose(file);
    assert_int_equal(count, 3644);
    AUTO_SCENE scene = lam_scene_make(NULL);
    const lam_mesh *mesh = make(scene, "teapot", &(lam_shape_params){.slices = 40, .stacks = 10});
    assert_int_equal(mesh->triangle_count,
                     6320); // 32 patches of 200, minus 10 at each of the 8 that end in a pole
    double worst = 0;
    static bool found[ROOM];
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        point p = from_floats(mesh->positions + 3 * (size_t)i);
        // Converts back to Newell's measures, on the ground.
        p = (point){p.x * 3.2170375625 + 0.2170375625, p.y * 3.2170375625 + 1.575, p.z * 3.2170375625};
        double nearest = 1e9;
        for (size_t k = 0; k < count; k++) {
            double d = length(minus(p, theirs[k]));
            nearest = fmin(nearest, d);
            found[k] |= d < 2e-6;
        }
        worst = fmax(worst, nearest);
    }
    assert_true(worst < 2e-6); // the file has six decimals
    for (size_t k = 0; k < count; k++)
        assert_true(found[k]);
}

// Poles and joints of the teapot: the lid's top faces up, the bottom faces down, and normals do not jump across joints.
TEST(test_teapot_normals)
{
    AUTO_SCENE scene = lam_scene_make(NULL);
    const lam_mesh *mesh = make(scene, "teapot", NULL);
    double low[3], high[3];
    bounds(mesh, low, high);
    assert_true(fabs(low[0] + 1) < 1e-3 && fabs(high[0] - 1) < 1e-3 && fabs(low[1] + high[1]) < 1e-6);
    int tops = 0, bottoms = 0;
    for (size_t c = 0; c < 3 * (size_t)mesh->triangle_count; c++) {
        point p = position(mesh, c), n = normal(mesh, c);
        bool on_axis = fabs(p.x + 0.2170375625 / 3.2170375625) < 1e-6 && fabs(p.z) < 1e-6;
        if (on_axis && p.y > 0) {
            assert_true(n.y > 0.9999999);
            tops++;
        } else if (on_axis) {
            assert_true(n.y < -0.9999999);
            bottoms++;
        }
    }
    assert_int_equal(tops, 128);
    assert_int_equal(bottoms, 128);
    // One position has one normal: no vertex of the teapot is a crease. (The handle's lower end touches the body's
    // widest ring in one point; these are two surfaces.)
    uint32_t *same = weld(mesh);
    point *first = calloc(mesh->vertex_count, sizeof *first);
    for (size_t c = 0; c < 3 * (size_t)mesh->triangle_count; c++) {
        point *n = &first[same[element(NULL, mesh, c)]], own = normal(mesh, c);
        point p = position(mesh, c);
        bool handle_end = p.z == 0 && fabs(p.x * 3.2170375625 + 0.2170375625 + 2) < 1e-6;
        if (dot(*n, *n) > 0 && !handle_end)
            assert_true(dot(*n, own) > 0.9999999);
        *n = own;
    }
    free(first);
    free(same);
}

// circle(): exact at quarters, mirrored, and accurate.
TEST(test_circle)
{
    for (int n = 3; n < 400; n++)
        for (int i = -n; i <= 2 * n; i++) {
            struct circle_point p = circle(i, n), back = circle(-i, n);
            assert_true(fabs(p.c - cos(2 * M_PI * i / n)) < 1e-14 && fabs(p.s - sin(2 * M_PI * i / n)) < 1e-14);
            assert_true(p.c == back.c && p.s == -back.s);
            if (i % n == 0)
                assert_true(p.c == 1 && p.s == 0);
        }
    struct circle_point quarter = circle(2, 8), half = circle(4, 8);
    assert_true(quarter.c == 0 && quarter.s == 1 && half.c == -1 && half.s == 0);
}
