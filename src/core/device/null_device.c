// null_device.c: a device that draws nothing and fills the picture with zeros.
#include "device_type.h"

#include "fail.h"
#include "pixels.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool null_draw(struct lam_device *device, const struct frame *frame, lam_image *image, struct call_control *call,
                      lam_error *error)
{
    (void)device;
    (void)frame;
    for (int y = 0; y < image->height; y++)
        memset(image_row(image, y), 0, (size_t)image->width * pixel_bytes(image->format));
    return call_should_continue(call) || call_error(call, error);
}

static uint64_t null_memory(const struct lam_device *device)
{
    (void)device;
    return 0;
}

static void null_free(struct lam_device *device) { free(device); }

lam_device *lam_device_null(lam_error *error)
{
    static const struct device_type type = {null_draw, null_memory, null_free, .makes_normals = true};
    struct lam_device *device = calloc(1, sizeof *device);
    if (!device)
        return fail_memory(error, sizeof *device), NULL;
    device->type = &type;
    snprintf(device->name, sizeof device->name, "null");
    return device;
}
