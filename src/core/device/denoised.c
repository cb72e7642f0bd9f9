// denoised.c: draws the surfaces that the filter against noise compares (effects/paths/denoise.c).
#include "denoised.h"

#include "pixels.h"

bool is_denoised(const lam_draw_params *params)
{
    bool automatic = params->bounces > 1 && params->paths < DENOISED_BELOW && !(params->noise > 0);
    bool wanted = params->denoise == LAM_DENOISE_ON || (params->denoise == LAM_DENOISE_AUTO && automatic);
    return wanted && params->bounces && params->paths != 1 && params->output == LAM_OUTPUT_PICTURE;
}

bool denoise_image_make(lam_image *image, int width, int height, struct call_control *call, lam_error *error)
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
        if (!denoise_image_make(surfaces[i].image, width, height, call, error) ||
            !frame_build(&device->frame, scene, camera, &drawn, width, height, call, error) ||
            !device->type->draw(device, &device->frame, surfaces[i].image, call, error))
            return false;
    }
    return true;
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
