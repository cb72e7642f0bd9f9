// rays.c: measures shadow rays in the library's hierarchy, and in Embree's if Embree is installed.
//
//   bench-rays [SCENE [TRIANGLES]]     knot, stl (its triangles one by one), soup or beams; 100000
//
// It prints the processor time of one thread, the minimum of several rounds, which take turns. Rays start at the points
// that an orthographic camera sees, row by row. They go to a point light ("coherent") or in random directions
// ("scattered"), LANES at a time. For Embree it prints the fastest of single rays, packets of 8 and packets of 16, in
// robust mode and with floats. Lambent decides with doubles. The surface area cost (one function for both) is that of
// Embree's builder for 8 children, rtcBuildBVH. Unlike the other programs in this folder, this program uses internal
// headers of the library. bench-rays uses AVX2, bench-rays-512 AVX-512.
#ifdef __AVX512F__
#define LANES    16
#define ISA_NAME "avx512"
#else
#define LANES    8
#define ISA_NAME "avx2"
#endif
#include "ray_lanes.h"
#include "rays.h"

#include <lambent/lambent.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#ifdef HAS_EMBREE
#include <embree3/rtcore.h>
#endif

enum { SIDE = 384, RAYS = SIDE * SIDE, ROUNDS = 9 };
static const char *const names[] = {"coherent", "scattered"};

static struct ray_lanes packets[2][RAYS / LANES];

// Returns the processor time of this thread. Other programs hardly affect this time.
static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double uniform(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) / 9007199254740992.0;
}

// Finds the points that the camera sees obliquely from above, and makes their rays.
static void make_rays(const struct hierarchy *h, const double light[3])
{
    uint64_t seed = 1;
    struct ray_lanes *coherent = packets[0], *scattered = packets[1];
    for (int n = 0; n < RAYS; n++) {
        // The eight rays of a packet start in a block of 8 × 1 pixels.
        int x = n % SIDE, y = n / SIDE, lane = n % LANES;
        struct ray_lanes *a = &coherent[n / LANES], *b = &scattered[n / LANES];
        double origin[3] = {(x + 0.5) / SIDE * 1.6 - 0.8, 2, (y + 0.5) / SIDE * 1.6 - 0.8}, d[3] = {0.2, -1, 0.1};
        double nearest = 1e9;
        uint32_t own = 0;
        // Finds the nearest triangle by traversing the hierarchy. This time is not measured.
        uint32_t stack[NODE_CHILDREN * HIERARCHY_DEPTH][2] = {{0, 0}};
        for (int waiting = 1; waiting;) {
            uint32_t child = stack[--waiting][0], count = stack[waiting][1];
            for (int i = 0; i < NODE_CHILDREN && !count; i++) {
                const struct ray_node *node = &h->nodes[child];
                double near = 0, far = nearest;
                for (int k = 0; k < 3; k++) {
                    double u = ((double)node->planes[0][k][i] - 1e-6 - origin[k]) / d[k],
                           v = ((double)node->planes[1][k][i] + 1e-6 - origin[k]) / d[k];
                    near = u < v ? fmax(near, u) : fmax(near, v);
                    far = u < v ? fmin(far, v) : fmin(far, u);
                }
                if (near <= far && node->planes[0][0][i] <= node->planes[1][0][i]) {
                    stack[waiting][0] = node->child[i];
                    stack[waiting++][1] = node->count[i];
                }
            }
            for (uint32_t i = child; i < child + count; i++) {
                struct ray_triangle triangle, *t = &triangle;
                hierarchy_triangle(h, leaf_number(h->leaves + LEAF_FLOATS * (size_t)child, count, i - child), t);
                double e[2][3], p[3], q[3], s[3];
                for (int k = 0; k < 3; k++) {
                    e[0][k] = t->p[1][k] - t->p[0][k];
                    e[1][k] = t->p[2][k] - t->p[0][k];
                    s[k] = origin[k] - t->p[0][k];
                }
                for (int k = 0, l = 1, m = 2; k < 3; l = m, m = k++) {
                    p[k] = d[l] * e[1][m] - d[m] * e[1][l];
                    q[k] = s[l] * e[0][m] - s[m] * e[0][l];
                }
                double det = e[0][0] * p[0] + e[0][1] * p[1] + e[0][2] * p[2];
                double u = (s[0] * p[0] + s[1] * p[1] + s[2] * p[2]) / det,
                       v = (d[0] * q[0] + d[1] * q[1] + d[2] * q[2]) / det;
                double at = (e[1][0] * q[0] + e[1][1] * q[1] + e[1][2] * q[2]) / det;
                if (det != 0 && u >= 0 && v >= 0 && u + v <= 1 && at > 0 && at < nearest) {
                    nearest = at;
                    own = t->twin;
                }
            }
        }
        double to[3];
        for (int k = 0; k < 3; k++)
            to[k] = uniform(&seed) * 2 - 1;
        to[1] = fabs(to[1]);
        for (int k = 0; k < 3; k++) {
            double p = origin[k] + (nearest < 1e8 ? nearest : 0) * d[k];
            a->origin[k][lane] = a->point[k][lane] = b->origin[k][lane] = b->point[k][lane] = p;
            a->direction[k][lane] = light[k] - p;
            b->direction[k][lane] = to[k];
        }
        a->end[lane] = 1;
        b->end[lane] = 1e30;
        a->own[lane] = b->own[lane] = (int32_t)own;
    }
}

static __attribute__((noinline)) unsigned trace(const struct hierarchy *h, const struct ray_lanes *ray)
{
    return any_hit(h, ray, (1u << LANES) - 1, NULL, NULL, false);
}

// --- the surface area cost: the expected number of nodes that a random line tests, and of tests of `block` triangles at
// once in leaves

struct tree_node {
    float low[NODE_CHILDREN][3], high[NODE_CHILDREN][3];
    struct tree_node *child[NODE_CHILDREN]; // NULL for a leaf
    uint32_t count[NODE_CHILDREN], children;
};

static double area_of(const float low[3], const float high[3])
{
    double x = (double)(high[0] - low[0]), y = (double)(high[1] - low[1]), z = (double)(high[2] - low[2]);
    return x * y + y * z + z * x;
}

static double cost_of(const struct tree_node *node, double area, uint32_t block)
{
    double cost = area;
    for (uint32_t i = 0; i < node->children; i++) {
        double own = area_of(node->low[i], node->high[i]);
        cost += node->child[i] ? cost_of(node->child[i], own, block) : own * ((node->count[i] + block - 1) / block);
    }
    return cost;
}

static double relative_cost(const struct tree_node *root, uint32_t block)
{
    float low[3] = {3e38f, 3e38f, 3e38f}, high[3] = {-3e38f, -3e38f, -3e38f};
    for (uint32_t i = 0; i < root->children; i++)
        for (int k = 0; k < 3; k++) {
            low[k] = fminf(low[k], root->low[i][k]);
            high[k] = fmaxf(high[k], root->high[i][k]);
        }
    double area = area_of(low, high);
    return cost_of(root, area, block) / area;
}

static struct tree_node *own_tree(const struct hierarchy *h, uint32_t index)
{
    struct tree_node *to = calloc(1, sizeof *to);
    const struct ray_node *node = &h->nodes[index];
    for (int i = 0; i < NODE_CHILDREN && node->planes[0][0][i] <= node->planes[1][0][i]; i++) {
        for (int k = 0; k < 3; k++) {
            to->low[i][k] = node->planes[0][k][i];
            to->high[i][k] = node->planes[1][k][i];
        }
        to->count[i] = node->count[i];
        to->child[i] = node->count[i] ? NULL : own_tree(h, node->child[i]);
        to->children++;
    }
    return to;
}

// --- Embree

#ifdef HAS_EMBREE
static void *make_node(RTCThreadLocalAllocator a, unsigned children, void *user)
{
    (void)user;
    struct tree_node *node = rtcThreadLocalAlloc(a, sizeof *node, 16);
    memset(node, 0, sizeof *node);
    node->children = children;
    return node;
}
static void set_children(void *node, void **children, unsigned count, void *user)
{
    (void)user;
    for (unsigned i = 0; i < count; i++) {
        struct tree_node *child = children[i];
        ((struct tree_node *)node)->child[i] = child->children ? child : NULL;
        ((struct tree_node *)node)->count[i] = child->count[0];
    }
}
static void set_bounds(void *node, const struct RTCBounds **bounds, unsigned count, void *user)
{
    (void)user;
    for (unsigned i = 0; i < count; i++) {
        memcpy(((struct tree_node *)node)->low[i], &bounds[i]->lower_x, 12);
        memcpy(((struct tree_node *)node)->high[i], &bounds[i]->upper_x, 12);
    }
}
static void *make_leaf(RTCThreadLocalAllocator a, const struct RTCBuildPrimitive *p, size_t count, void *user)
{
    struct tree_node *node = make_node(a, 0, user);
    (void)p;
    node->count[0] = (uint32_t)count;
    return node;
}

static void embree_cost(RTCDevice device, const struct hierarchy *h, double cost[2])
{
    struct RTCBuildPrimitive *p = aligned_alloc(64, ((size_t)h->triangle_count * sizeof *p + 63) / 64 * 64);
    for (uint32_t i = 0; i < h->triangle_count; i++) {
        struct ray_triangle t;
        hierarchy_triangle(h, i, &t);
        float low[3], high[3];
        for (int k = 0; k < 3; k++) {
            low[k] = (float)fmin(fmin(t.p[0][k], t.p[1][k]), t.p[2][k]);
            high[k] = (float)fmax(fmax(t.p[0][k], t.p[1][k]), t.p[2][k]);
        }
        p[i] = (struct RTCBuildPrimitive){low[0], low[1], low[2], 0, high[0], high[1], high[2], i};
    }
    struct RTCBuildArguments build = rtcDefaultBuildArguments();
    build.maxBranchingFactor = NODE_CHILDREN;
    build.maxDepth = 64;
    build.bvh = rtcNewBVH(device);
    build.primitives = p;
    build.primitiveCount = build.primitiveArrayCapacity = h->triangle_count;
    build.createNode = make_node;
    build.setNodeChildren = set_children;
    build.setNodeBounds = set_bounds;
    build.createLeaf = make_leaf;
    const struct tree_node *root = rtcBuildBVH(&build);
    cost[0] = relative_cost(root, 8);
    cost[1] = relative_cost(root, 1);
    rtcReleaseBVH(build.bvh);
    free(p);
}

static RTCScene embree_scene(RTCDevice device, const struct hierarchy *h, enum RTCBuildQuality quality, double *built)
{
    RTCScene scene = rtcNewScene(device);
    rtcSetSceneBuildQuality(scene, quality);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetGeometryBuildQuality(mesh, quality);
    size_t corners = 3 * (size_t)h->triangle_count;
    float *p = rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, corners);
    unsigned *index = rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, corners / 3);
    for (uint32_t i = 0; i < corners; i++) {
        struct ray_triangle triangle;
        hierarchy_triangle(h, i / 3, &triangle);
        index[i] = i;
        for (int k = 0; k < 3; k++)
            p[3 * i + (uint32_t)k] = (float)triangle.p[i % 3][k];
    }
    rtcCommitGeometry(mesh);
    rtcAttachGeometry(scene, mesh);
    rtcReleaseGeometry(mesh);
    double start = seconds();
    rtcCommitScene(scene);
    *built = fmin(*built, seconds() - start);
    return scene;
}

#define RAY_FIELDS(ray, at, packet, n)                                                                                 \
    (ray).org_x at = (float)(packet)->origin[0][n], (ray).org_y at = (float)(packet)->origin[1][n],                    \
                (ray).org_z at = (float)(packet)->origin[2][n], (ray).dir_x at = (float)(packet)->direction[0][n],     \
                (ray).dir_y at = (float)(packet)->direction[1][n], (ray).dir_z at = (float)(packet)->direction[2][n],  \
                (ray).tnear at = 1e-4f, (ray).tfar at = (float)(packet)->end[n], (ray).time at = 0,                    \
                (ray).mask at = ~0u, (ray).flags at = 0

// Traces all rays in packets of `width` rays, and returns the number of rays that are blocked.
static long embree_round(RTCScene scene, int kind, int width)
{
    static const _Alignas(64) int valid[16] = {-1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1};
    struct RTCIntersectContext context;
    long hits = 0;
    rtcInitIntersectContext(&context);
    context.flags = kind ? RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT : RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    for (int i = 0; i < RAYS; i += width) {
        _Alignas(64) union {
            struct RTCRay one;
            struct RTCRay8 eight;
            struct RTCRay16 sixteen;
        } ray;
        for (int n = 0; n < width; n++) {
            const struct ray_lanes *r = &packets[kind][(i + n) / LANES];
            int from = (i + n) % LANES;
            if (width == 1)
                RAY_FIELDS(ray.one, , r, from);
            else if (width == 8)
                RAY_FIELDS(ray.eight, [n], r, from);
            else
                RAY_FIELDS(ray.sixteen, [n], r, from);
        }
        if (width == 1)
            rtcOccluded1(scene, &context, &ray.one);
        else if (width == 8)
            rtcOccluded8(valid, scene, &context, &ray.eight);
        else
            rtcOccluded16(valid, scene, &context, &ray.sixteen);
        for (int n = 0; n < width; n++)
            hits += (width == 1 ? ray.one.tfar : width == 8 ? ray.eight.tfar[n] : ray.sixteen.tfar[n]) < 0;
    }
    return hits;
}
#endif

// --- scenes

static void add_mesh(lam_scene *scene, float *positions, uint32_t triangles)
{
    lam_error error = {0};
    lam_mesh mesh = {.positions = positions, .vertex_count = 3 * triangles, .triangle_count = triangles};
    lam_object object = lam_object_default();
    object.mesh = lam_scene_add_mesh(scene, &mesh, &error);
    if (object.mesh < 0 || lam_scene_add_object(scene, &object, &error) < 0)
        fprintf(stderr, "%s\n", error.text);
}

// Random triangles ("soup"), or long thin ones along the axes and obliquely ("beams").
static float *random_triangles(uint32_t triangles, bool beams)
{
    uint64_t seed = 7;
    float *p = malloc((size_t)triangles * 9 * sizeof *p);
    for (uint32_t t = 0; t < triangles; t++) {
        double size = pow((double)triangles, -1.0 / 3), centre[3], along[3] = {0};
        for (int k = 0; k < 3; k++)
            centre[k] = uniform(&seed) * 2 - 1;
        for (int k = 0; k < 3; k++)
            along[k] = t % 4 < 3 ? k == (int)(t % 4) : uniform(&seed) * 2 - 1;
        for (int c = 0; c < 3; c++)
            for (int k = 0; k < 3; k++)
                p[9 * (size_t)t + 3 * (size_t)c + (size_t)k] =
                    (float)(centre[k] + (beams ? 0.02 : 1) * size * (uniform(&seed) * 2 - 1) +
                            (beams && c ? 0.3 * along[k] : 0));
    }
    return p;
}

static bool add_scene(lam_scene *scene, const char *kind, double wanted)
{
    lam_error error = {0};
    bool knot = !strcmp(kind, "knot"), stl = !strcmp(kind, "stl");
    if (!knot && !stl && strcmp(kind, "soup") != 0 && strcmp(kind, "beams") != 0)
        return false;
    lam_object object = lam_object_default();
    if (knot || stl) {
        int stacks = (int)sqrt(wanted / 16);
        lam_shape_params params = {.slices = 8 * stacks, .stacks = stacks};
        object.mesh = lam_scene_add_shape(scene, "torus-knot", &params, &error);
        const lam_mesh *mesh = scene_mesh(scene, object.mesh);
        if (knot) {
            lam_scene_add_object(scene, &object, &error);
        } else {
            float *p = malloc((size_t)mesh->triangle_count * 9 * sizeof *p);
            for (size_t i = 0; i < 3 * (size_t)mesh->triangle_count; i++)
                memcpy(p + 3 * i, mesh->positions + 3 * (size_t)mesh->indices[i], 12);
            add_mesh(scene, p, mesh->triangle_count);
        }
    } else {
        add_mesh(scene, random_triangles((uint32_t)wanted, kind[0] == 'b'), (uint32_t)wanted);
    }
    object.mesh = lam_scene_add_shape(scene, "plane", NULL, &error);
    object.transform.m[0][0] = object.transform.m[2][2] = 2;
    object.transform.m[1][3] = -1;
    lam_scene_add_object(scene, &object, &error);
    return true;
}

static double own_round(const struct hierarchy *h, int kind, long *hits)
{
    double start = seconds();
    *hits = 0;
    for (int i = 0; i < RAYS / LANES; i++)
        *hits += __builtin_popcount(trace(h, &packets[kind][i]));
    return seconds() - start;
}

int main(int argc, char **argv)
{
    lam_error error = {0};
    lam_scene *scene = lam_scene_make(&error);
    if (!add_scene(scene, argc > 1 ? argv[1] : "knot", argc > 2 ? atof(argv[2]) : 100000)) {
        fprintf(stderr, "bench-rays: unknown scene '%s'; expected knot, stl, soup or beams\n", argv[1]);
        return 2;
    }
    lam_light light = lam_light_default(LAM_LIGHT_POINT);
    lam_scene_add_light(scene, &light, &error);
    lam_camera camera = lam_camera_fit(scene, SIDE, SIDE, NULL);
    static struct frame frame;
    static struct hierarchy_memory memory;
    lam_draw_params draw = {.shadows = true};
    if (!frame_build(&frame, scene, &camera, &draw, SIDE, SIDE, NULL, &error)) {
        fprintf(stderr, "%s\n", error.text);
        return 1;
    }
    const struct hierarchy *h = NULL;
    double own_built = 1e9, embree_built[2] = {1e9, 1e9};
#ifdef HAS_EMBREE
    RTCDevice device = rtcNewDevice("threads=1,set_affinity=0,isa=" ISA_NAME);
    RTCScene embree = NULL;
#endif
    for (int round = 0; round < (frame.triangle_count < 3000000 ? 5 : 2); round++) {
        bool built;
        hierarchy_free(&memory);
        double start = seconds();
        h = hierarchy_of_frame(&memory, &frame, NULL, NULL, &built, &error);
        own_built = fmin(own_built, seconds() - start);
#ifdef HAS_EMBREE
        rtcReleaseScene(embree_scene(device, h, RTC_BUILD_QUALITY_LOW, &embree_built[0]));
        if (embree)
            rtcReleaseScene(embree);
        embree = embree_scene(device, h, RTC_BUILD_QUALITY_MEDIUM, &embree_built[1]);
#endif
    }
    make_rays(h, (const double[3]){0.9, 1.2, 0.7});
    const struct tree_node *tree = own_tree(h, 0);
    double own_cost[2] = {relative_cost(tree, 8), relative_cost(tree, 1)};
    printf("%s, %u triangles: %.1f bytes each, built in %.1f ms, cost %.2f by tests of eight triangles, %.2f by "
           "triangles\n",
           ISA_NAME, h->triangle_count, (double)hierarchy_bytes(&memory) / h->triangle_count, own_built * 1e3,
           own_cost[0], own_cost[1]);
#ifdef HAS_EMBREE
    double cost[2];
    embree_cost(device, h, cost);
    printf("Embree: medium %.1f ms (ratio %.2f), low %.1f ms (%.2f), cost %.2f (%.2f), %.2f (%.2f)\n",
           embree_built[1] * 1e3, own_built / embree_built[1], embree_built[0] * 1e3, own_built / embree_built[0],
           cost[0], own_cost[0] / cost[0], cost[1], own_cost[1] / cost[1]);
#endif
    for (int kind = 0; kind < 2; kind++) {
        double own = 1e9;
        long hits = 0;
#ifdef HAS_EMBREE
        static const int widths[3] = {1, 8, 16};
        double theirs = 1e9;
        long their_hits = 0;
        int best = 0;
        for (int round = 0; round < ROUNDS; round++)
            for (int k = 0; k < 3; k++) {
                own = fmin(own, own_round(h, kind, &hits));
                double start = seconds();
                their_hits = embree_round(embree, kind, widths[k]);
                double taken = seconds() - start;
                best = taken < theirs ? widths[k] : best;
                theirs = fmin(theirs, taken);
            }
        printf("%-9s %6.2f Mray/s (%.1f %% shadowed), Embree (%d) %6.2f (%.1f %%), ratio %.2f\n", names[kind],
               RAYS / own * 1e-6, 100.0 * (double)hits / RAYS, best, RAYS / theirs * 1e-6,
               100.0 * (double)their_hits / RAYS, theirs / own);
#else
        for (int round = 0; round < ROUNDS; round++)
            own = fmin(own, own_round(h, kind, &hits));
        printf("%-9s %6.2f Mray/s (%.1f %% shadowed)\n", names[kind], RAYS / own * 1e-6, 100.0 * (double)hits / RAYS);
#endif
    }
#ifdef HAS_EMBREE
    rtcReleaseScene(embree);
    rtcReleaseDevice(device);
#else
    (void)embree_built;
    printf("built without Embree (libembree-dev)\n");
#endif
    hierarchy_free(&memory);
    frame_free(&frame);
    lam_scene_free(scene);
    return 0;
}
