// edge_pixels.c: converts strokes to coverage, and blends their colour over the picture.
//
// A stroke is a strip with a given width. The coverage of a pixel is the fraction of the pixel's square that lies
// inside the strip. Projected across the strip, the square has a trapezoidal profile: the convolution of two boxes
// whose widths are |cos| and |sin| of the strip's angle. Therefore, in any row or column that crosses a line, the
// line's coverage adds up to the width of the line in that direction. The sum does not depend on the line's position.
// If several strokes cover a pixel, the largest coverage is used. Corners, and edges that two triangles share, are
// therefore as dark as other edges.
#define LANES 1
#include "edge_lines.h"

#include "encoding.h"
#include "linear.h"
#include "pixels.h"
#include "srgb.h"

#include <string.h>

enum { BAND = 32, BANDS_MAX = 65536 / BAND }; // rows per task; number of tasks for the tallest picture

struct cover_job {
    struct edge_memory *memory;
    const struct frame *frame;
    struct loop_status loop;
    // The strokes that may touch each band of rows. Band b begins at ends[b − 1] (the first band at 0), and ends at
    // ends[b].
    const struct edge_stroke **strokes;
    size_t ends[BANDS_MAX];
};

static double absolute_of(double x) { return x < 0 ? -x : x; }

// Returns the share of a pixel's area in which the coordinate along the direction (ux, uy) is below x. The coordinate
// is 0 at the pixel's centre.
static double share_below(double x, double ux, double uy)
{
    double a = absolute_of(ux), b = absolute_of(uy), size = absolute_of(x), share = 1;
    double wide = a > b ? a : b, narrow = a > b ? b : a;
    if (size <= (wide - narrow) / 2)
        share = 0.5 + size / wide;
    else if (size < (wide + narrow) / 2)
        share = 1 - ((wide + narrow) / 2 - size) * ((wide + narrow) / 2 - size) / (2 * wide * narrow);
    return x < 0 ? 1 - share : share;
}

// Returns a stroke's coverage of the pixel around (x, y). (ux, uy) is the stroke's direction.
static double coverage_at(const struct edge_stroke *s, double x, double y, double ux, double uy, double length)
{
    double dx = x - s->x[0], dy = y - s->y[0], along = dx * ux + dy * uy, across = dx * uy - dy * ux, whole = 1;
    if (!s->round[0])
        whole *= share_below(along, ux, uy);
    if (!s->round[1])
        whole *= share_below(length - along, ux, uy);
    int end = along > length ? 1 : 0;
    if ((along < 0 || end) && s->round[end]) { // at a round cap, the distance from the end
        double ex = x - s->x[end], ey = y - s->y[end];
        across = math_sqrt(ex * ex + ey * ey);
        ux = across > 0 ? ex / across : 1;
        uy = across > 0 ? ey / across : 0;
    }
    return whole * (share_below(across + s->half, ux, uy) - share_below(across - s->half, ux, uy));
}

static int clamped(double x, int limit) { return x <= 0 ? 0 : x >= limit ? limit : (int)x; }

// Finds the columns of a row that a stroke may touch: the columns within `reach` of the stroke's line and inside the
// stroke's box.
static void columns(const struct edge_stroke *s, double y, double ux, double uy, double reach, int width, int *first,
                    int *last)
{
    double low = (s->x[0] < s->x[1] ? s->x[0] : s->x[1]) - reach,
           high = (s->x[0] > s->x[1] ? s->x[0] : s->x[1]) + reach;
    double steep = uy < 0 ? -uy : uy;
    if (steep > 1e-6) {
        double middle = s->x[0] + (y - s->y[0]) * ux / uy, half = reach / steep;
        low = middle - half > low ? middle - half : low;
        high = middle + half < high ? middle + half : high;
    }
    *first = clamped(low - 1, width);
    *last = clamped(high + 1, width);
}

static void draw_stroke(const struct cover_job *job, const struct edge_stroke *s, int top, int bottom)
{
    double reach = s->half + 0.75, low = (s->y[0] < s->y[1] ? s->y[0] : s->y[1]) - reach,
           high = (s->y[0] > s->y[1] ? s->y[0] : s->y[1]) + reach;
    if (high < top || low > bottom)
        return;
    double dx = s->x[1] - s->x[0], dy = s->y[1] - s->y[0], length = math_sqrt(dx * dx + dy * dy);
    double ux = length > 0 ? dx / length : 1, uy = length > 0 ? dy / length : 0;
    int width = job->frame->width, first_row = clamped(low - 1, bottom), last_row = clamped(high + 1, bottom);
    float *coverage = job->memory->coverage[s->style].data;
    for (int y = first_row > top ? first_row : top; y < last_row; y++) {
        float *row = coverage + (size_t)y * (size_t)width;
        int first, last;
        columns(s, y + 0.5, ux, uy, reach, width, &first, &last);
        for (int x = first; x < last; x++) {
            float own = (float)coverage_at(s, x + 0.5, y + 0.5, ux, uy, length);
            row[x] = own > row[x] ? own : row[x];
        }
    }
}

static void band_task(void *user, size_t index, int thread)
{
    (void)thread;
    struct cover_job *job = user;
    struct edge_memory *memory = job->memory;
    int top = (int)index * BAND, bottom = top + BAND < job->frame->height ? top + BAND : job->frame->height;
    size_t width = (size_t)job->frame->width;
    if (!should_continue(&job->loop))
        return;
    for (int style = 0; style < EDGE_STYLES; style++)
        if (memory->styles[style])
            memset((float *)memory->coverage[style].data + (size_t)top * width, 0,
                   (size_t)(bottom - top) * width * sizeof(float));
    for (size_t i = index ? job->ends[index - 1] : 0; i < job->ends[index]; i++)
        draw_stroke(job, job->strokes[i], top, bottom);
}

static void bands_of(const struct edge_stroke *s, int bands, int *first, int *last)
{
    double reach = s->half + 2, low = s->y[0] < s->y[1] ? s->y[0] : s->y[1],
           high = s->y[0] < s->y[1] ? s->y[1] : s->y[0];
    *first = clamped((low - reach) / BAND, bands - 1);
    *last = clamped((high + reach) / BAND, bands - 1);
}

// Lists the strokes of each band with a counting sort. The order of a band's strokes does not matter.
static bool list_strokes(struct cover_job *job, int bands, struct call_control *call, lam_error *error)
{
    struct edge_memory *memory = job->memory;
    size_t sum = 0;
    int first, last;
    memset(job->ends, 0, sizeof job->ends);
    for (int t = 0; t < memory->thread_count; t++)
        for (size_t i = 0; i < memory->strokes[t].count; i++) {
            bands_of(&memory->strokes[t].list[i], bands, &first, &last);
            for (int b = first; b <= last; b++)
                job->ends[b]++;
        }
    for (int b = 0; b < bands; b++) { // sets ends[b] to the start of band b; the next loop advances it to the end
        size_t count = job->ends[b];
        job->ends[b] = sum;
        sum += count;
    }
    if (!buffer_reserve(&memory->bands, sum * sizeof *job->strokes, call, error))
        return false;
    job->strokes = memory->bands.data;
    for (int t = 0; t < memory->thread_count; t++)
        for (size_t i = 0; i < memory->strokes[t].count; i++) {
            bands_of(&memory->strokes[t].list[i], bands, &first, &last);
            for (int b = first; b <= last; b++)
                job->strokes[job->ends[b]++] = &memory->strokes[t].list[i];
        }
    return true;
}

bool edges_cover(struct edge_memory *memory, const struct frame *frame, struct pool *pool, struct call_control *call,
                 lam_error *error)
{
    struct cover_job job = {.memory = memory, .frame = frame, .loop = {.call = call}};
    size_t bytes = (size_t)frame->width * (size_t)frame->height * sizeof(float);
    memset(memory->styles, 0, sizeof memory->styles);
    for (int t = 0; t < memory->thread_count; t++)
        for (size_t i = 0; i < memory->strokes[t].count; i++)
            memory->styles[memory->strokes[t].list[i].style] = true;
    for (int style = 0; style < EDGE_STYLES; style++)
        if (memory->styles[style] && !buffer_reserve(&memory->coverage[style], bytes, call, error))
            return false;
    int bands = (frame->height + BAND - 1) / BAND;
    if (!list_strokes(&job, bands, call, error))
        return false;
    pool_run(pool, (size_t)bands, band_task, &job);
    return should_continue(&job.loop) || loop_error(&job.loop, 0, error);
}

// --- blending over the picture

struct blend_job {
    const struct edge_memory *memory;
    const struct frame *frame;
    lam_image *image;
    float decoded[256]; // the linear light of each byte value
};

// Blends a colour over a pixel. Both are linear, and the pixel is premultiplied.
static void over(float pixel[4], const lam_rgba *color, float coverage)
{
    float a = color->a * coverage, left = 1 - a;
    pixel[0] = color->r * a + pixel[0] * left;
    pixel[1] = color->g * a + pixel[1] * left;
    pixel[2] = color->b * a + pixel[2] * left;
    pixel[3] = a + pixel[3] * left;
}

static uint8_t to_byte(float x, float a, bool raw)
{
    float straight = a > 0 ? x / a : 0;
    return (uint8_t)byte_of(raw ? straight : srgb_encode(straight));
}

static void blend_pixel(const struct blend_job *job, void *at, size_t index)
{
    const struct edge_memory *memory = job->memory;
    const struct frame *frame = job->frame;
    lam_pixel_format format = job->image->format;
    float pixel[4], working[4];
    bool raw = frame->settings.color == LAM_COLOR_RAW, floats = format_is_float(format), any = false;
    for (int style = 0; style < EDGE_STYLES; style++)
        any |= memory->styles[style] && ((const float *)memory->coverage[style].data)[index] > 0;
    if (!any)
        return;
    pixels_to_working(format, at, 1, working);
    uint8_t *bytes = (uint8_t *)working;
    if (floats) {
        memcpy(pixel, working, sizeof pixel);
    } else {
        pixel[3] = (float)bytes[3] / 255.0f;
        for (int c = 0; c < 3; c++)
            pixel[c] = job->decoded[bytes[c]] * pixel[3];
    }
    for (int style = 0; style < EDGE_STYLES; style++)
        if (memory->styles[style])
            over(pixel, &frame->edges.color[style], ((const float *)memory->coverage[style].data)[index]);
    if (floats) {
        memcpy(working, pixel, sizeof pixel);
    } else {
        for (int c = 0; c < 3; c++)
            bytes[c] = to_byte(pixel[c], pixel[3], raw);
        bytes[3] = (uint8_t)byte_of(pixel[3]);
    }
    pixels_from_working(format, raw, working, 1, at);
}

static void blend_task(void *user, size_t index, int thread)
{
    (void)thread;
    const struct blend_job *job = user;
    size_t bytes = pixel_bytes(job->image->format);
    int top = (int)index * BAND, bottom = top + BAND < job->image->height ? top + BAND : job->image->height;
    for (int y = top; y < bottom; y++)
        for (int x = 0; x < job->image->width; x++)
            blend_pixel(job, (char *)image_row(job->image, y) + (size_t)x * bytes,
                        (size_t)y * (size_t)job->image->width + (size_t)x);
}

void edges_blend(const struct edge_memory *memory, const struct frame *frame, lam_image *image, struct pool *pool)
{
    struct blend_job job = {.memory = memory, .frame = frame, .image = image};
    bool any = false;
    for (int style = 0; style < EDGE_STYLES; style++)
        any |= memory->styles[style];
    if (!any)
        return;
    for (int i = 0; i < 256; i++)
        job.decoded[i] = frame->settings.color == LAM_COLOR_RAW ? (float)i / 255.0f : (float)srgb_linear(i / 255.0);
    pool_run(pool, (size_t)((image->height + BAND - 1) / BAND), blend_task, &job);
}
