// render.c: loads a model and writes a picture. cc render.c $(pkg-config --cflags --libs lambent) -o render
#include <lambent/lambent.h>
#include <stdio.h>

enum { WIDTH = 1024, HEIGHT = 1024 };

int main(int argc, char **argv)
{
    lam_error error = {LAM_BAD_ARGUMENT, "usage: render MODEL PICTURE"};
    lam_scene *scene = argc == 3 ? lam_scene_load(argv[1], NULL, NULL, &error) : NULL;
    lam_device *device = scene ? lam_device_cpu(NULL, &error) : NULL;
    lam_image image = {0};
    lam_camera camera = lam_camera_fit(scene, WIDTH, HEIGHT, NULL);
    bool ok = device && lam_image_make(&image, WIDTH, HEIGHT, LAM_RGBA8, &error) &&
              lam_draw(device, scene, &camera, NULL, &image, NULL, &error) &&
              lam_image_save(&image, argv[2], NULL, &error);
    if (!ok)
        fprintf(stderr, "render: %s\n", error.text);
    lam_image_free(&image);
    lam_device_free(device);
    lam_scene_free(scene);
    return ok ? 0 : error.code;
}
