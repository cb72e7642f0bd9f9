// target_render.c: fuzz target for complete rendering: loads a model or a scene file of any format and draws it, at
// most 48×48 pixels, with options from the input (picture_options.h). If an option requests it, the model is drawn
// twice, with other instruction sets and threads; the pictures must have the same bytes.
#include "picture_options.h"

static bool draw(const lam_scene *scene, const lam_camera *camera, const struct options *options, int which,
                 void *pixels)
{
    static lam_device *devices[LAM_ISA_COUNT][2];
    lam_device **device = &devices[options->isa[which]][options->threads[which] - 1];
    const lam_cpu_params params = {.threads = options->threads[which], .isa = options->isa[which]};
    lam_error error = {0};
    if (!*device && !(*device = lam_device_cpu(&params, &error)))
        abort();
    lam_image image = options->image;
    image.pixels = pixels;
    // A frame of 48×48 pixels that uses more than this many bytes is a fault.
    const lam_control control = {.memory_limit_bytes = 256 << 20};
    bool ok = lam_draw(*device, scene, camera, &options->draw, &image, &control, &error);
    if (!ok && (error.code == LAM_OK || !error.text[0]))
        abort();
    note_sentence(ok ? "" : error.text);
    const float *number = pixels, *end = number + 4 * image.width * image.height;
    for (; ok && image.format == LAM_RGBA32F && number < end; number++)
        if (*number != *number) // NaN
            abort();
    return ok;
}

static void draw_as_told(const lam_scene *scene, const struct options *options)
{
    static float pixels[2][SIDE_MAX * SIDE_MAX * 4];
    const lam_camera camera = camera_of(scene, options);
    size_t count = (size_t)options->image.width * (size_t)options->image.height * 4;
    bool ok = draw(scene, &camera, options, 0, pixels[0]);
    if (!(options->way & TWICE))
        return;
    if (draw(scene, &camera, options, 1, pixels[1]) != ok)
        abort();
    if (ok && memcmp(pixels[0], pixels[1], count * (options->way & FLOATS ? 4 : 1)) != 0)
        abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct options options;
    lam_scene *scene = scene_of_input(data, size, &options);
    if (scene)
        draw_as_told(scene, &options);
    lam_scene_free(scene);
    return 0;
}
