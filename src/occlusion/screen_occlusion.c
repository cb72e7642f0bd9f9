// screen_occlusion.c: memory and passes of ambient occlusion (screen_occlusion.inc has the kernels).
#include "screen_occlusion.h"

#include "call_control.h"
#include "pool.h"

enum { LANES_MAX = 16 };

// Rows have LANES_MAX floats more at either end, planes of cells stand in front of those of pixels.
// In pieces, by all threads: first use of the memory of a large picture takes seconds, in which the call may be stopped.
enum { PIECE = 1 << 17 };
struct filling {
    float *at;
    size_t zeros, count; // the others are SCREEN_EMPTY
    struct call_control *call;
};

static void fill_piece(void *user, size_t index, int thread)
{
    (void)thread;
    const struct filling *filling = user;
    size_t first = index * PIECE, end = first + PIECE < filling->count ? first + PIECE : filling->count;
    size_t zeros = filling->zeros < end ? filling->zeros : end;
    if (!call_should_continue(filling->call))
        return;
    for (size_t i = first; i < zeros; i++)
        filling->at[i] = 0;
    for (size_t i = first > zeros ? first : zeros; i < end; i++)
        filling->at[i] = SCREEN_EMPTY;
}

bool screen_occlusion_start(struct screen_occlusion *occlusion, const struct frame *frame, struct buffer *storage,
                            struct pool *pool, struct call_control *call, lam_error *error)
{
    int step = (int64_t)frame->width * frame->height > SCREEN_FINE ? 2 : 1;
    int across = (frame->width + step - 1) / step, down = (frame->height + step - 1) / step;
    int stride = (across + LANES_MAX - 1) / LANES_MAX * LANES_MAX + 2 * LANES_MAX;
    size_t plane = (size_t)stride * (size_t)down, pixels = (size_t)(step * step) * plane, cells = step > 1 ? plane : 0;
    if (!buffer_reserve(storage, (4 * plane + cells + 2 * pixels) * sizeof(float), call, error))
        return false;
    float *at = storage->data, *depth = at + 4 * plane;
    // Beside the cells a filter reads numbers, which do not count.
    struct filling filling = {at, 4 * plane, 4 * plane + cells + pixels, call};
    pool_run(pool, (filling.count + PIECE - 1) / PIECE, fill_piece, &filling);
    if (!call_should_continue(call))
        return call_error(call, error);
    at += LANES_MAX;
    depth += LANES_MAX;
    *occlusion = (struct screen_occlusion){.width = frame->width,
                                           .height = frame->height,
                                           .step = step,
                                           .grid_width = across,
                                           .grid_height = down,
                                           .stride = stride,
                                           .plane = plane,
                                           .orthographic = frame->orthographic,
                                           .pixel_size = frame->pixel_size,
                                           .radius = frame->occlusion_radius,
                                           .slope_x = at,
                                           .slope_y = at + plane,
                                           .noisy = at + 2 * plane,
                                           .smoothed = at + 3 * plane,
                                           .cell_depth = depth,
                                           .depth = depth + cells,
                                           .unoccluded = depth + cells + pixels};
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
    int first = (int)index * OCCLUSION_ROWS, height = pass->occlusion->grid_height;
    if (call_should_continue(pass->call))
        pass->rows(pass->occlusion, first, first + OCCLUSION_ROWS < height ? first + OCCLUSION_ROWS : height);
}

void screen_occlusion_find(struct screen_occlusion *occlusion, const struct occlusion_kernels *kernels,
                           struct pool *pool, struct call_control *call)
{
    size_t pieces = ((size_t)occlusion->grid_height + OCCLUSION_ROWS - 1) / OCCLUSION_ROWS;
    if (occlusion->step > 1)
        pool_run(pool, pieces, run_rows, &(struct pass){occlusion, kernels->cell_rows, call});
    pool_run(pool, pieces, run_rows, &(struct pass){occlusion, kernels->occlude_rows, call});
    pool_run(pool, pieces, run_rows, &(struct pass){occlusion, kernels->smooth_rows_across, call});
    pool_run(pool, pieces, run_rows, &(struct pass){occlusion, kernels->smooth_rows_down, call});
    pool_run(pool, pieces, run_rows, &(struct pass){occlusion, kernels->pixel_rows, call});
}
