// denoised.c: draws the pictures that the filter against noise compares (effects/paths/denoise.c): the surfaces, and the
// light in two halves, each with half of the paths.
#include "denoised.h"

#include "pixels.h"

bool is_denoised(const lam_draw_params *params)
{
    bool automatic = params->bounces > 1 && params->paths < 1024;
    bool wanted = params->denoise == LAM_DENOISE_ON || (params->denoise == LAM_DENOISE_AUTO && automatic);
    return wanted && params->bounces && params->paths != 1 && params->output == LAM_OUTPUT_PICTURE;
}

static bool make(lam_image *image, int width, int height, struct call_control *call, lam_error *error)
{
    const size_t bytes = 16 * (size_t)width * (size_t)height;
    if (!call_charge(call, bytes))
        return call_memory_error(call, bytes, error);
    if (lam_image_make(image, width, height, LAM_RGBA32F, error))
        return true;
    call_refund(call, bytes);
    return false;
}

bool denoise_prepare(struct lam_device *device, const lam_scene *scene, const lam_camera *camera,
                     const lam_draw_params *params, const lam_image *target, struct path_pictures *pictures,
                     struct call_control *call, lam_error *error)
{
    const struct {
        lam_output output;
        lam_image *image;
    } surfaces[] = {{LAM_OUTPUT_NORMALS, &pictures->normals},
                    {LAM_OUTPUT_DEPTH, &pictures->depths},
                    {LAM_OUTPUT_BASE_COLOR, &pictures->colors}};
    const int width = target->width, height = target->height;
    *pictures = (struct path_pictures){0};
    for (size_t i = 0; i < sizeof surfaces / sizeof *surfaces; i++) {
        lam_draw_params drawn = *params;
        drawn.output = surfaces[i].output;
        drawn.edges = 0;
        drawn.no_surfaces = drawn.wireframe = drawn.shadows = false;
        drawn.background_environment = 0;
        drawn.background = (lam_rgba){0, 0, 0, 0};
        if (!make(surfaces[i].image, width, height, call, error) ||
            !frame_build(&device->frame, scene, camera, &drawn, width, height, call, error) ||
            !device->type->draw(device, &device->frame, surfaces[i].image, call, error))
            return false;
    }
    return true;
}

bool denoise_draw(struct lam_device *device, struct path_pictures *pictures, lam_image *light,
                  struct call_control *call, lam_error *error)
{
    struct frame *frame = &device->frame;
    const lam_rgba background = frame->settings.background;
    const int paths = frame->settings.paths;
    uint64_t rays = 0;
    bool ok = true;
    frame->settings.background = (lam_rgba){0, 0, 0, 0};
    call->part_rest = 0.5;
    for (int half = 0; half < 2 && ok; half++) {
        frame->path_first = half ? paths / 2 : 0;
        frame->settings.paths = half ? paths - paths / 2 : paths / 2;
        call->part_begin = 0.5 * half;
        ok = make(&pictures->halves[half], light->width, light->height, call, error) &&
             device->type->draw(device, frame, &pictures->halves[half], call, error);
        rays += device->report.rays;
    }
    call->part_begin = call->part_rest = 0;
    device->report.rays = rays;
    frame->settings.background = background;
    frame->settings.paths = paths;
    frame->path_first = 0;
    return ok && path_denoise(pictures, light, device->pool, call, error);
}

void denoise_free(struct path_pictures *pictures, struct call_control *call)
{
    lam_image *const images[] = {&pictures->halves[0], &pictures->halves[1], &pictures->normals, &pictures->depths,
                                 &pictures->colors};
    for (size_t i = 0; i < sizeof images / sizeof *images; i++) {
        if (images[i]->pixels)
            call_refund(call, 16 * (size_t)images[i]->width * (size_t)images[i]->height);
        lam_image_free(images[i]);
    }
}
