// screen_occlusion.c: memory and passes of ambient occlusion (occlusion_kernels.c contains the kernels).
#include "occlusion_kernels.h"

#include "call_control.h"
#include "pool.h"

enum { LANES_MAX = 16 };

// Rows contain LANES_MAX additional floats at either end, and planes of cells precede the planes of pixels. The first
// use of the memory of a large picture takes seconds. Therefore, all threads fill the rows in chunks, and the call may
// be stopped after each chunk.
enum { CHUNK = 1 << 17, CELL_PLANES = 5 };
struct emptying {
    float *at;
    size_t count;
    struct call_control *call;
};

static void empty_chunk(void *user, size_t index, int thread)
{
    (void)thread;
    const struct emptying *emptying = user;
    size_t first = index * CHUNK, end = first + CHUNK < emptying->count ? first + CHUNK : emptying->count;
    if (!call_should_continue(emptying->call))
        return;
    for (size_t i = first; i < end; i++)
        emptying->at[i] = SCREEN_EMPTY;
}

// Lays out the planes of cells in the caller's memory blocks. Returns how many planes did not fit; the pointers of
// these planes remain NULL.
static int place_planes(float *planes[CELL_PLANES], int count, size_t bytes, struct scratch_memory *lent,
                        int lent_count)
{
    int missing = CELL_PLANES;
    for (int k = 0; k < count; k++)
        for (int i = 0; i < lent_count && !planes[k]; i++)
            missing -= (planes[k] = scratch_borrow(&lent[i], bytes)) != NULL;
    return missing;
}

bool screen_occlusion_start(struct screen_occlusion *occlusion, const struct frame *frame, struct scratch_memory *lent,
                            int lent_count, struct buffer *storage, struct pool *pool, struct call_control *call,
                            lam_error *error)
{
    // With a ground plane, smaller pictures also use large cells, which make the sampling pattern less visible in the
    // wide contact shadow.
    int64_t fine = frame->ground.kind ? SCREEN_FINE / 2 : SCREEN_FINE;
    int step = (int64_t)frame->width * frame->height > fine ? 2 : 1;
    int across = (frame->width + step - 1) / step, down = (frame->height + step - 1) / step;
    int stride = (across + LANES_MAX - 1) / LANES_MAX * LANES_MAX + 2 * LANES_MAX;
    size_t plane = (size_t)stride * (size_t)down, pixels = (size_t)(step * step) * plane;
    size_t layers = SCREEN_LAYERS * plane;
    float *planes[CELL_PLANES] = {0};
    // With step 1, the last plane stores the result, which is read until the picture is complete.
    int own = place_planes(planes, step > 1 ? CELL_PLANES : CELL_PLANES - 1, plane * sizeof(float), lent, lent_count);
    if (!buffer_reserve(storage, (pixels + layers + (size_t)own * plane) * sizeof(float), call, error))
        return false;
    float *depth = storage->data, *at = depth + pixels + layers;
    struct emptying emptying = {depth, pixels + layers, call};
    pool_run(pool, (pixels + layers + CHUNK - 1) / CHUNK, empty_chunk, &emptying);
    if (!call_should_continue(call))
        return call_error(call, error);
    for (int k = 0; k < CELL_PLANES; k++) {
        float *begin = planes[k] ? planes[k] : at;
        at += planes[k] ? 0 : plane;
        planes[k] = begin + LANES_MAX;
    }
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
                                           .pixel_aspect = frame->pixel_aspect,
                                           .middle = {frame->middle[0] - 0.5f, frame->middle[1] - 0.5f},
                                           .radius = frame->occlusion_radius,
                                           .cavity_radius = frame->cavity_radius,
                                           .deepens = frame->deep_valleys,
                                           .slope_x = planes[0],
                                           .slope_y = planes[1],
                                           .noisy = planes[2],
                                           .smoothed = planes[3],
                                           .cell_depth = step > 1 ? planes[4] : depth,
                                           .depth = depth,
                                           .layers = depth + pixels,
                                           .unoccluded = step > 1 ? depth : planes[4]};
    return true;
}

static void fill_beside(const struct screen_occlusion *o, float *plane, int y, float value)
{
    float *row = plane + (size_t)y * (size_t)o->stride;
    for (int x = y > 0 ? 0 : -LANES_MAX; x < 0; x++)
        row[x] = value;
    for (int x = o->grid_width; x < o->stride - LANES_MAX; x++)
        row[x] = value;
    // the floats between this row and the next
    for (int x = o->stride - LANES_MAX; x < o->stride && y + 1 < o->grid_height; x++)
        row[x] = value;
}

// Filters also read values outside the cells. This function stores 0 there and marks the depths as containing no
// surface, so that these values have the weight 0.
static void fill_rows_beside(const struct screen_occlusion *o, int first, int end)
{
    for (int y = first; y < end; y++) {
        fill_beside(o, o->slope_x, y, 0);
        fill_beside(o, o->slope_y, y, 0);
        fill_beside(o, o->noisy, y, 0);
        fill_beside(o, o->smoothed, y, 0);
        if (o->step > 1)
            fill_beside(o, o->cell_depth, y, SCREEN_EMPTY);
    }
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

void screen_occlusion_find(struct screen_occlusion *occlusion, int lanes, struct pool *pool, struct call_control *call)
{
    const struct occlusion_kernels *kernels = CPU_WIDEST_OF_ALL(lanes, occlusion_kernels);
    size_t chunks = ((size_t)occlusion->grid_height + OCCLUSION_ROWS - 1) / OCCLUSION_ROWS;
    pool_run(pool, chunks, run_rows, &(struct pass){occlusion, fill_rows_beside, call});
    if (occlusion->step > 1)
        pool_run(pool, chunks, run_rows, &(struct pass){occlusion, kernels->cell_rows, call});
    pool_run(pool, chunks, run_rows, &(struct pass){occlusion, kernels->occlude_rows, call});
    pool_run(pool, chunks, run_rows, &(struct pass){occlusion, kernels->smooth_rows, call});
    pool_run(pool, chunks, run_rows, &(struct pass){occlusion, kernels->pixel_rows, call});
}
