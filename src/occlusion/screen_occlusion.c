// screen_occlusion.c: memory and passes of ambient occlusion (screen_occlusion.inc has the kernels).
#include "screen_occlusion.h"

#include "call_control.h"
#include "pool.h"

enum { PLANES = 6, LANES_MAX = 16 };

bool screen_occlusion_start(struct screen_occlusion *occlusion, const struct frame *frame, struct buffer *storage,
                            struct call_control *call, lam_error *error)
{
    int stride = (frame->width + 2 * LANES_MAX - 1) / LANES_MAX * LANES_MAX;
    size_t plane = (size_t)stride * (size_t)frame->height + LANES_MAX;
    if (!buffer_reserve(storage, PLANES * plane * sizeof(float), call, error))
        return false;
    float *at = storage->data;
    *occlusion = (struct screen_occlusion){.width = frame->width,
                                           .height = frame->height,
                                           .stride = stride,
                                           .orthographic = frame->orthographic,
                                           .pixel_size = frame->pixel_size,
                                           .radius = frame->occlusion_radius,
                                           .depth = at,
                                           .slope_x = at + plane,
                                           .slope_y = at + 2 * plane,
                                           .noisy = at + 3 * plane,
                                           .smoothed = at + 4 * plane,
                                           .unoccluded = at + 5 * plane};
    for (size_t i = 0; i < plane; i++)
        occlusion->depth[i] = SCREEN_EMPTY;
    return true;
}

struct pass {
    const struct screen_occlusion *occlusion;
    void (*rows)(const struct screen_occlusion *occlusion, int first, int end);
    struct call_control *call;
};

static void run_rows(void *user, size_t index, int thread)
{
    (void)thread;
    const struct pass *pass = user;
    int first = (int)index * OCCLUSION_ROWS, height = pass->occlusion->height;
    if (call_should_continue(pass->call))
        pass->rows(pass->occlusion, first, first + OCCLUSION_ROWS < height ? first + OCCLUSION_ROWS : height);
}

void screen_occlusion_find(struct screen_occlusion *occlusion, const struct occlusion_kernels *kernels,
                           struct pool *pool, struct call_control *call)
{
    size_t pieces = ((size_t)occlusion->height + OCCLUSION_ROWS - 1) / OCCLUSION_ROWS;
    pool_run(pool, pieces, run_rows, &(struct pass){occlusion, kernels->occlude_rows, call});
    pool_run(pool, pieces, run_rows, &(struct pass){occlusion, kernels->smooth_rows_across, call});
    pool_run(pool, pieces, run_rows, &(struct pass){occlusion, kernels->smooth_rows_down, call});
}
