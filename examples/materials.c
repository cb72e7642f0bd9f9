// materials.c: draws every named material on a sphere, in one picture, with only the library. cc materials.c
// $(pkg-config --cflags --libs lambent) -o materials
#include <lambent/lambent.h>
#include <stdio.h>

enum { COLUMNS = 6, WIDTH = 960, HEIGHT = 640 };

int main(int argc, char **argv)
{
    lam_error error = {LAM_BAD_ARGUMENT, "usage: materials PICTURE"};
    lam_scene *scene = argc == 2 ? lam_scene_make(&error) : NULL;
    int sphere = scene ? lam_scene_add_shape(scene, "sphere", NULL, &error) : -1;
    bool ok = sphere >= 0;
    for (int i = 0; ok && i < LAM_MATERIAL_COUNT; i++) {
        lam_material material = lam_material_named((lam_material_id)i, LAM_COLOR_SRGB);
        lam_object object = lam_object_default();
        object.name = lam_material_name((lam_material_id)i);
        object.mesh = sphere;
        object.material = lam_scene_add_material(scene, &material, &error);
        object.transform.m[0][3] = 2.2 * (i % COLUMNS);  // to the right
        object.transform.m[1][3] = -2.2 * (i / COLUMNS); // downwards
        ok = object.material >= 0 && lam_scene_add_object(scene, &object, &error) >= 0;
    }
    // The classic picture's light: one point light above and to the right of the viewer, and a little ambient light.
    lam_light light = lam_light_default(LAM_LIGHT_POINT);
    light.position = (lam_vec3){20, 20, 30};
    light.ambient = (lam_rgb){0.2f, 0.2f, 0.2f};
    ok = ok && lam_scene_add_light(scene, &light, &error) >= 0;

    lam_view view = {.from_angles = true, .orthographic = true, .fill = 0.96};
    lam_camera camera = lam_camera_fit(scene, WIDTH, HEIGHT, &view); // azimuth and elevation 0: from the front
    lam_device *device = ok ? lam_device_cpu(NULL, &error) : NULL;
    lam_image image = {0};
    ok = device && lam_image_make(&image, WIDTH, HEIGHT, LAM_RGBA8, &error) &&
         lam_draw(device, scene, &camera, NULL, &image, NULL, &error) && lam_image_save(&image, argv[1], NULL, &error);
    if (!ok)
        fprintf(stderr, "materials: %s\n", error.text);
    lam_image_free(&image);
    lam_device_free(device);
    lam_scene_free(scene);
    return ok ? 0 : error.code;
}
