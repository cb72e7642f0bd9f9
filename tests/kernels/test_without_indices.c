// test_without_indices.c: a mesh without indices draws the same bytes as the same mesh with the indices 0, 1, 2 …, with
// every instruction set and on every path of its triangles; and none of its vertices is stored.

#include "test.h"

enum { WIDTH = 203, HEIGHT = 131 };

struct variant {
    float alpha;
    lam_cull cull;
    bool mirrored, orthographic;
    int samples;
};

static uint64_t seed;

static float random_between(float low, float high)
{
    seed = seed * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return low + (high - low) * (float)(seed >> 40) / 16777216.0f;
}

// Triangles of all sizes around the eye at (0, 0, 5): many are behind it, cross the near plane or leave the guard band.
static float *random_triangles(uint32_t count)
{
    float *positions = malloc((size_t)count * 9 * sizeof *positions);
    assert_non_null(positions);
    for (uint32_t i = 0; i < count; i++) {
        float size = i % 10 ? 0.1f : i % 50 ? 3.0f : 1e5f, middle[3];
        for (int a = 0; a < 3; a++)
            middle[a] = random_between(-3, a == 2 ? 6 : 3);
        for (int k = 0; k < 9; k++)
            positions[9 * i + (uint32_t)k] = middle[k % 3] + random_between(-size, size);
    }
    return positions;
}

static lam_mesh mesh_of(const float *positions, const uint32_t *indices, uint32_t triangles)
{
    return (lam_mesh){
        .positions = positions, .indices = indices, .vertex_count = 3 * triangles, .triangle_count = triangles};
}

static void add(lam_scene *scene, const lam_mesh *mesh, const struct variant *variant)
{
    lam_error error = {0};
    lam_material material = lam_material_default();
    material.diffuse.a = variant->alpha;
    lam_object object = lam_object_default();
    object.mesh = lam_scene_add_mesh(scene, mesh, &error);
    object.material = lam_scene_add_material(scene, &material, &error);
    object.cull = variant->cull;
    if (variant->mirrored)
        object.transform.m[1][1] = -1;
    if (lam_scene_add_object(scene, &object, &error) < 0)
        fail_msg("%s", error.text);
}

static lam_image draw(const lam_scene *scene, const struct variant *variant, lam_isa isa, int threads,
                      lam_frame_report *report)
{
    lam_error error = {0};
    lam_camera camera = {.eye = {0, 0, 5},
                         .up = {0, 1, 0},
                         .fovy_rad = 0.8,
                         .ortho_half_height = variant->orthographic ? 2 : 0,
                         .near_plane = 0.5,
                         .far_plane = 20};
    lam_draw_params params = {.samples = variant->samples, .rig = LAM_RIG_STUDIO};
    lam_device *device = lam_device_cpu(&(lam_cpu_params){.threads = threads, .isa = isa}, &error);
    lam_image image = {0};
    if (!device || !lam_image_make(&image, WIDTH, HEIGHT, LAM_RGBA8, &error) ||
        !lam_draw(device, scene, &camera, &params, &image, NULL, &error))
        fail_msg("%s", error.text);
    lam_device_report(device, report);
    lam_device_free(device);
    return image;
}

TEST(test_same_bytes)
{
    enum { TRIANGLES = 3001 };
    static const struct variant variants[] = {
        {1, LAM_CULL_NONE, false, false, 1},    {1, LAM_CULL_BACK, true, false, 4},
        {0.5f, LAM_CULL_NONE, false, false, 4}, {1, LAM_CULL_FRONT, false, true, 1},
        {0.5f, LAM_CULL_BACK, true, true, 1},
    };
    seed = 1;
    float *positions = random_triangles(TRIANGLES);
    uint32_t *indices = malloc(3 * TRIANGLES * sizeof *indices);
    for (uint32_t i = 0; i < 3 * TRIANGLES; i++)
        indices[i] = i;
    // The second object's triangles follow the first one's; neither kind disturbs the other.
    lam_mesh with = mesh_of(positions, indices, TRIANGLES), without = mesh_of(positions, NULL, TRIANGLES),
             half = mesh_of(positions + 9 * 1500, indices, 1501);
    for (size_t v = 0; v < sizeof variants / sizeof *variants; v++) {
        lam_scene *expected = lam_scene_make(NULL), *scene = lam_scene_make(NULL);
        const struct variant *variant = &variants[v];
        struct variant other = *variant;
        other.mirrored = !other.mirrored;
        add(expected, &with, variant);
        add(expected, &half, &other);
        add(scene, &without, variant);
        add(scene, &half, &other);
        lam_frame_report report;
        AUTO_IMAGE reference = draw(expected, variant, LAM_ISA_SCALAR, 1, &report);
        assert_in_range(report.pixels_covered, WIDTH * HEIGHT / 2, WIDTH * HEIGHT);
        for (int isa = LAM_ISA_SCALAR; isa < LAM_ISA_COUNT; isa++)
            for (int threads = 1; threads < 4 && lam_isa_usable((lam_isa)isa); threads += 2) {
                AUTO_IMAGE image = draw(scene, variant, (lam_isa)isa, threads, &report);
                if (memcmp(image.pixels, reference.pixels, WIDTH * HEIGHT * 4) != 0)
                    fail_msg("variant %zu, %s, %d threads: the pictures differ", v, lam_isa_name((lam_isa)isa),
                             threads);
            }
        lam_scene_free(expected);
        lam_scene_free(scene);
    }
    free(indices);
    free(positions);
}

// The device uses no memory for its corners.
TEST(test_memory)
{
    enum { TRIANGLES = 1000000 };
    static const struct variant plain = {.alpha = 1, .samples = 1};
    float *positions = calloc(9 * TRIANGLES, sizeof *positions); // no area, so nothing is binned
    assert_non_null(positions);
    uint64_t bytes[2];
    for (int i = 0; i < 2; i++) {
        AUTO_SCENE scene = lam_scene_make(NULL);
        lam_mesh mesh = mesh_of(positions, NULL, i ? TRIANGLES : 1);
        add(scene, &mesh, &plain);
        lam_frame_report report;
        AUTO_IMAGE image = draw(scene, &plain, LAM_ISA_AUTO, 1, &report);
        bytes[i] = report.memory_bytes;
    }
    assert_true(bytes[1] - bytes[0] < TRIANGLES / 10); // the list of tasks
    free(positions);
}
