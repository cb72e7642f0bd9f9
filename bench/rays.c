// rays.c: measures the time of shadow rays in the library's hierarchy, and in Embree's if Embree is installed.
//
//   bench-rays [TRIANGLES]      a torus knot of about so many triangles over a floor (100000)
//
// It prints the processor time of one thread, the minimum of several rounds. Rays start at the points that an
// orthographic camera sees, row by row. They go to a point light ("coherent") or in random directions ("scattered"),
// eight at a time. Embree uses packets of eight rays, in robust mode and with floats. Lambent decides with doubles.
// Unlike the other programs in this folder, this program uses internal headers of the library.
#define LANES 8
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

enum { SIDE = 512, RAYS = SIDE * SIDE, ROUNDS = 7 };

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
                const struct ray_triangle *t = &h->triangles[i];
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
    return any_hit(h, ray, 0xff, NULL, NULL);
}

static void measure_own(const struct hierarchy *h)
{
    static const char *const names[] = {"coherent", "scattered"};
    for (int kind = 0; kind < 2; kind++) {
        double best = 1e9;
        long hits = 0;
        for (int round = 0; round < ROUNDS; round++) {
            double start = seconds();
            hits = 0;
            for (int i = 0; i < RAYS / LANES; i++)
                hits += __builtin_popcount(trace(h, &packets[kind][i]));
            best = fmin(best, seconds() - start);
        }
        printf("lambent %-9s %6.1f Mray/s (%.1f %% shadowed)\n", names[kind], RAYS / best * 1e-6,
               100.0 * (double)hits / RAYS);
    }
}

#ifdef HAS_EMBREE
static void measure_embree(const struct hierarchy *h)
{
    static const char *const names[] = {"coherent", "scattered"};
    RTCDevice device = rtcNewDevice("threads=1,set_affinity=0");
    for (int quality = RTC_BUILD_QUALITY_LOW; quality <= RTC_BUILD_QUALITY_MEDIUM; quality++) {
        double built = 1e9;
        RTCScene scene = NULL;
        for (int round = 0; round < ROUNDS; round++) {
            if (scene)
                rtcReleaseScene(scene);
            scene = rtcNewScene(device);
            rtcSetSceneBuildQuality(scene, (enum RTCBuildQuality)quality);
            rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
            RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
            rtcSetGeometryBuildQuality(mesh, (enum RTCBuildQuality)quality);
            float *p = rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12,
                                               3 * (size_t)h->triangle_count);
            unsigned *index =
                rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, h->triangle_count);
            for (uint32_t i = 0; i < 3 * h->triangle_count; i++) {
                index[i] = i;
                for (int k = 0; k < 3; k++)
                    p[3 * i + (uint32_t)k] = (float)h->triangles[i / 3].p[i % 3][k];
            }
            rtcCommitGeometry(mesh);
            rtcAttachGeometry(scene, mesh);
            rtcReleaseGeometry(mesh);
            double start = seconds();
            rtcCommitScene(scene);
            built = fmin(built, seconds() - start);
        }
        printf("Embree, quality %s: built in %.1f ms\n", quality ? "medium" : "low", built * 1e3);
        for (int kind = 0; kind < 2; kind++) {
            double best = 1e9;
            long hits = 0;
            for (int round = 0; round < ROUNDS; round++) {
                struct RTCIntersectContext context;
                rtcInitIntersectContext(&context);
                context.flags = kind ? RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT : RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
                static const _Alignas(32) int valid[8] = {-1, -1, -1, -1, -1, -1, -1, -1};
                double start = seconds();
                hits = 0;
                for (int i = 0; i < RAYS / 8; i++) {
                    const struct ray_lanes *r = &packets[kind][i];
                    _Alignas(32) struct RTCRay8 ray;
                    for (int n = 0; n < 8; n++) {
                        ray.org_x[n] = (float)r->origin[0][n];
                        ray.org_y[n] = (float)r->origin[1][n];
                        ray.org_z[n] = (float)r->origin[2][n];
                        ray.dir_x[n] = (float)r->direction[0][n];
                        ray.dir_y[n] = (float)r->direction[1][n];
                        ray.dir_z[n] = (float)r->direction[2][n];
                        ray.tnear[n] = 1e-4f;
                        ray.tfar[n] = (float)r->end[n];
                        ray.time[n] = 0;
                        ray.mask[n] = ~0u;
                        ray.flags[n] = 0;
                    }
                    rtcOccluded8(valid, scene, &context, &ray);
                    for (int n = 0; n < 8; n++)
                        hits += ray.tfar[n] < 0;
                }
                best = fmin(best, seconds() - start);
            }
            printf("Embree  %-9s %6.1f Mray/s (%.1f %% shadowed)\n", names[kind], RAYS / best * 1e-6,
                   100.0 * (double)hits / RAYS);
        }
        rtcReleaseScene(scene);
    }
    rtcReleaseDevice(device);
}
#endif

int main(int argc, char **argv)
{
    lam_error error = {0};
    double wanted = argc > 1 ? atof(argv[1]) : 100000;
    lam_scene *scene = lam_scene_make(&error);
    int stacks = (int)sqrt(wanted / 16), slices = 8 * stacks;
    lam_shape_params params = {.slices = slices, .stacks = stacks};
    lam_object object = lam_object_default();
    object.mesh = lam_scene_add_shape(scene, "torus-knot", &params, &error);
    lam_scene_add_object(scene, &object, &error);
    object.mesh = lam_scene_add_shape(scene, "plane", NULL, &error);
    object.transform.m[0][0] = object.transform.m[2][2] = 2;
    object.transform.m[1][3] = -1;
    lam_scene_add_object(scene, &object, &error);
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
    double best = 1e9;
    for (int round = 0; round < ROUNDS; round++) {
        bool built;
        hierarchy_free(&memory);
        double start = seconds();
        h = hierarchy_of_frame(&memory, &frame, NULL, NULL, &built, &error);
        best = fmin(best, seconds() - start);
    }
    printf("lambent: %u triangles, built in %.1f ms\n", h->triangle_count, best * 1e3);
    make_rays(h, (const double[3]){0.9, 1.2, 0.7});
    measure_own(h);
#ifdef HAS_EMBREE
    measure_embree(h);
#else
    printf("built without Embree (libembree-dev)\n");
#endif
    hierarchy_free(&memory);
    frame_free(&frame);
    lam_scene_free(scene);
    return 0;
}
