// gl_occlusion.c: ambient occlusion. The distances of the surfaces are drawn and read back. The processor computes the
// occlusion with the code of the CPU device, so that the results are bit-identical. The shaders read the occlusion from
// a texture.
#include "gl_device.h"

#include "fail.h"

static const float *float_row(const lam_image *image, int y)
{
    return (const float *)((const char *)image->pixels + (size_t)y * image->stride);
}

bool occlusion_find(struct gl_frame *f, const lam_image *distances, const lam_image *layers,
                    struct screen_occlusion *occlusion, lam_error *error)
{
    if (!screen_occlusion_start(occlusion, f->frame, NULL, 0, &f->device->occlusion, NULL, f->call, error))
        return false;
    for (int y = 0; y < occlusion->height; y++) {
        const float *row = float_row(distances, y);
        for (int x = 0; x < occlusion->width; x++)
            occlusion->depth[screen_pixel(occlusion, x, y)] = row[4 * x + 3] > 0 ? row[4 * x]
                                                              : f->frame->ground.kind
                                                                  ? screen_ground_depth(f->frame, x, y)
                                                                  : SCREEN_EMPTY;
    }
    for (int y = 0; y < occlusion->height; y += occlusion->step) {
        const float *row = float_row(layers, y);
        for (int x = 0; x < occlusion->width; x += occlusion->step)
            for (int k = 0; k < SCREEN_LAYERS && row[4 * x + k] != 0; k++)
                occlusion->layers[(size_t)k * occlusion->plane + screen_pixel(occlusion, x, y)] = row[4 * x + k];
    }
    screen_occlusion_find(occlusion, 16, NULL, f->call);
    return call_should_continue(f->call) || call_error(f->call, error);
}

bool occlusion_send(struct gl_frame *f, lam_error *error)
{
    struct gl_device *device = f->device;
    const struct gl *gl = f->gl;
    const struct screen_occlusion *o = f->occlusion;
    if (!buffer_reserve(&device->occlusion_rows, (size_t)f->width * (size_t)f->height * sizeof(float), f->call, error))
        return false;
    float *rows = device->occlusion_rows.data;
    for (int y = 0; y < f->height; y++)
        for (int x = 0; x < f->width; x++)
            rows[(size_t)y * (size_t)f->width + (size_t)x] = o->unoccluded[screen_pixel(o, f->left + x, f->top + y)];
    gl_edit_plain_texture(device, UNIT_OCCLUSION, GL_TEXTURE_2D, &device->occlusion_texture);
    gl->TexImage2D(GL_TEXTURE_2D, 0, GL_R32F, f->width, f->height, 0, GL_RED, GL_FLOAT, rows);
    device->base.report.bytes_uploaded += (uint64_t)f->width * (uint64_t)f->height * sizeof(float);
    return true;
}
