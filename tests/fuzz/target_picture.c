// target_picture.c: fuzz target for drawing: triangles with any coordinates, pictures of at most 48×48 pixels. Two
// instruction sets must draw the same bytes; a sanitizer detects overflows.
//
// The first bytes of an input are the picture's width and height minus one, and flags. 16-bit numbers follow,
// little-endian, the upper halves of floats: three for the camera's eye, then nine for each triangle. The quotient of a
// byte of the size by the largest side selects an instruction set. If both bytes select the same one, it is compared
// with the scalar one, and the scalar one is compared with the next one.
#include "target.h"

#include <string.h>

enum { SIDE_MAX = 48, TRIANGLES_MAX = 64, HEAD = 3 + 6 };
enum flag { ORTHOGRAPHIC = 1, OWN_EYE = 2, TRANSLUCENT = 4, SHARED_CORNERS = 8, SAMPLES_SHIFT = 4, MIRRORED = 128 };

// Always finite.
static float number(const uint8_t *data)
{
    uint32_t bits = (uint32_t)(data[0] | data[1] << 8) << 16;
    if ((bits & 0x7f800000) == 0x7f800000)
        bits ^= 0x00800000;
    float x;
    memcpy(&x, &bits, 4);
    return x;
}

static lam_scene *scene_of(const uint8_t *data, size_t size, int flags)
{
    static const uint32_t indices[3 * TRIANGLES_MAX] = {0, 1, 2, 1, 2, 3, 2, 3, 4, 3, 4, 5};
    float positions[9 * TRIANGLES_MAX];
    size_t count = size / 18 < TRIANGLES_MAX ? size / 18 : TRIANGLES_MAX;
    for (size_t i = 0; i < 9 * count; i++)
        positions[i] = number(data + 2 * i);
    lam_mesh mesh = {.positions = positions, .vertex_count = (uint32_t)(3 * count), .triangle_count = (uint32_t)count};
    if (flags & SHARED_CORNERS && count >= 2) {
        mesh.indices = indices;
        mesh.triangle_count = 4;
    }
    lam_scene *scene = lam_scene_make(NULL);
    lam_material material = lam_material_default();
    material.diffuse = (lam_rgba){0.8f, 0.5f, 0.2f, flags & TRANSLUCENT ? 0.5f : 1};
    lam_object object = lam_object_default();
    if (flags & MIRRORED)
        object.transform.m[0][0] = -1;
    lam_error error;
    object.material = lam_scene_add_material(scene, &material, &error);
    object.mesh = count ? lam_scene_add_mesh(scene, &mesh, &error) : -1;
    if (object.mesh >= 0 && lam_scene_add_object(scene, &object, &error) >= 0)
        return scene;
    lam_scene_free(scene);
    return NULL;
}

// The instruction sets that run here, in rotation.
static lam_isa isa_of(int number)
{
    lam_isa usable[LAM_ISA_COUNT];
    int count = 0;
    for (int isa = LAM_ISA_SCALAR; isa < LAM_ISA_COUNT; isa++)
        if (lam_isa_usable((lam_isa)isa))
            usable[count++] = (lam_isa)isa;
    return usable[number % count];
}

static bool draw(lam_isa isa, const lam_scene *scene, const lam_camera *camera, int samples, lam_image *image)
{
    static lam_device *devices[LAM_ISA_COUNT];
    const lam_draw_params params = {.samples = samples, .rig = LAM_RIG_STUDIO};
    lam_error error = {0};
    if (!devices[isa] && !(devices[isa] = lam_device_cpu(&(lam_cpu_params){.threads = 1, .isa = isa}, &error)))
        abort();
    bool ok = lam_draw(devices[isa], scene, camera, &params, image, NULL, &error);
    if (!ok && (error.code == LAM_OK || !error.text[0]))
        abort();
    return ok;
}

static void draw_twice(const lam_isa isa[2], const lam_scene *scene, const lam_camera *camera, int width, int height,
                       int samples)
{
    static uint8_t pixels[2][SIDE_MAX * SIDE_MAX * 4];
    bool ok[2];
    for (int i = 0; i < 2; i++) {
        lam_image image = {.width = width, .height = height, .format = LAM_RGBA8, .pixels = pixels[i]};
        ok[i] = draw(isa[i], scene, camera, samples, &image);
    }
    if (ok[0] != ok[1] || (ok[0] && memcmp(pixels[0], pixels[1], (size_t)width * (size_t)height * 4) != 0))
        abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size < HEAD)
        return 0;
    int width = 1 + data[0] % SIDE_MAX, height = 1 + data[1] % SIDE_MAX, flags = data[2];
    lam_scene *scene = scene_of(data + HEAD, size - HEAD, flags);
    if (!scene)
        return 0;
    lam_view view = {.orthographic = flags & ORTHOGRAPHIC};
    lam_camera camera = lam_camera_fit(scene, width, height, &view);
    if (flags & OWN_EYE)
        camera.eye = (lam_vec3){(double)number(data + 3), (double)number(data + 5), (double)number(data + 7)};
    lam_isa isa[2] = {isa_of(data[0] / SIDE_MAX), isa_of(data[1] / SIDE_MAX)};
    if (isa[0] == isa[1])
        isa[0] = isa_of(0);
    if (isa[0] == isa[1])
        isa[1] = isa_of(1);
    draw_twice(isa, scene, &camera, width, height, 1 << (flags >> SAMPLES_SHIFT & 7) % 5);
    lam_scene_free(scene);
    return 0;
}
