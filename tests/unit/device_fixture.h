// device_fixture.h: a CPU device for all tests of a group.
#ifndef DEVICE_FIXTURE_H
#define DEVICE_FIXTURE_H

#include <lambent/lambent.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

static lam_device *device;

static int set_up(void **state)
{
    (void)state;
    device = lam_device_cpu(&(lam_cpu_params){.threads = 2}, NULL);
    return device ? 0 : -1;
}

static int tear_down(void **state)
{
    (void)state;
    lam_device_free(device);
    return 0;
}

// Draws a square picture of `side` pixels in floats.
static inline lam_image draw_square(const lam_scene *scene, const lam_camera *camera, const lam_draw_params *params,
                                    int side)
{
    lam_error error = {0};
    lam_image image = {0};
    if (!lam_image_make(&image, side, side, LAM_RGBA32F, &error) ||
        !lam_draw(device, scene, camera, params, &image, NULL, &error))
        fail_msg("%s", error.text);
    return image;
}

#endif
