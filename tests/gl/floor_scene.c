// floor_scene.c: a textured floor, and its picture.
#include "floor_scene.h"

#include "quad.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

lam_texture *random_texture(int width, int height, float scale)
{
    lam_error error = {0};
    lam_image image = {.format = scale > 1 ? LAM_RGBA32F : LAM_RGBA8};
    assert_true(lam_image_make(&image, width, height, image.format, &error));
    unsigned state = 5;
    for (int i = 0; i < width * height * 4; i++) {
        state = state * 1664525u + 1013904223u;
        if (scale > 1)
            ((float *)image.pixels)[i] = i % 4 == 3 ? 1 : scale * (float)(state >> 8) / 16777216;
        else
            ((uint8_t *)image.pixels)[i] = i % 4 == 3 ? 255 : (uint8_t)(state >> 24);
    }
    lam_texture *texture = lam_texture_make(&image, LAM_TEXTURE_COLOR, NULL, &error);
    lam_image_free(&image);
    assert_non_null(texture);
    return texture;
}

lam_scene *floor_scene(const lam_texture_map *map)
{
    static const float positions[] = {-3, 0, 2, 3, 0, 2, 3, 0, -30, -3, 0, -30},
                       normals[] = {0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0};
    static const float first[] = {-1.3f, -1.1f, 2.2f, -1.1f, 2.2f, 9, -1.3f, 9};
    static const float second[] = {-1.1f, 1.3f, -1.1f, -2.2f, 9, -2.2f, 9, 1.3f};
    lam_error error = {0};
    lam_scene *scene = lam_scene_make(&error);
    lam_material material = lam_material_default();
    material.unlit = true;
    material.diffuse = (lam_rgba){1, 1, 1, 1};
    material.maps[LAM_MAP_DIFFUSE] = map;
    const lam_part part = {.triangle_count = 2, .material = lam_scene_add_material(scene, &material, &error)};
    const lam_mesh mesh = quad_mesh(positions, normals, first, second, &part);
    lam_object object = lam_object_default();
    object.mesh = lam_scene_add_mesh(scene, &mesh, &error);
    assert_true(part.material >= 0 && object.mesh >= 0 && lam_scene_add_object(scene, &object, &error) >= 0);
    return scene;
}

lam_scene *floor_and_cube(const lam_texture_map *map, const lam_texture_map *other)
{
    lam_error error = {0};
    lam_scene *scene = floor_scene(map);
    lam_material material = lam_material_default();
    material.unlit = true;
    material.maps[LAM_MAP_DIFFUSE] = other;
    lam_object object = lam_object_default();
    object.mesh = lam_scene_add_shape(scene, "cube", NULL, &error);
    object.material = lam_scene_add_material(scene, &material, &error);
    assert_true(object.mesh >= 0 && object.material >= 0 && lam_scene_add_object(scene, &object, &error) >= 0);
    return scene;
}

lam_image floor_draw(lam_device *device, const lam_scene *scene, int size, int anisotropy, const lam_draw_params *more)
{
    lam_error error = {0};
    lam_image image = {0};
    lam_camera camera = {.eye = {0.3, 1, 3},
                         .target = {0, 0, -3},
                         .up = {0, 1, 0},
                         .fovy_rad = 0.9,
                         .near_plane = 0.1,
                         .far_plane = 100};
    lam_draw_params params = *more;
    params.samples = 1;
    params.anisotropy = anisotropy;
    params.occlusion = LAM_OCCLUSION_OFF;
    if (!lam_image_make(&image, size, size, LAM_RGBA32F, &error) ||
        !lam_draw(device, scene, &camera, &params, &image, NULL, &error))
        fail_msg("%s", error.text);
    return image;
}

double encoded(float linear)
{
    double c = linear < 0 ? 0 : linear > 1 ? 1 : (double)linear;
    return c <= 0.0031308 ? 12.92 * c : 1.055 * pow(c, 1 / 2.4) - 0.055;
}
