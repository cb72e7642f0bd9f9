// gif.c: writes GIF pictures and animations: https://www.w3.org/Graphics/GIF/spec-gif89a.txt.
//
// Each frame has a palette of its own: the means of the boxes into which a median cut divides the frame's colours. An
// ordered dither of the colours and of alpha hides the steps, and does not flicker. All numbers are integers, so the
// bytes are identical on every machine.
#include "animation.h"
#include "codec.h"
#include "fail.h"

#include <stdlib.h>
#include <string.h>

// COLORS does not include the transparent one. BITS of each channel select a cell of the histogram. DITHER is the largest
// change of a channel by the dither. HEAD is more than the bytes of a frame without its pixels.
enum { COLORS = 255, CLEAR = 256, END = 257, CODES = 4096, BLOCK = 255, DITHER = 5, HEAD = 1024 };
enum { BITS = 6, SIDES = 1 << BITS, CELLS = 1 << 3 * BITS };

// A cell of the histogram: the sum and the number of its colours, and the colour of the palette.
struct cell {
    uint64_t sums[3], count;
    uint8_t index;
};

struct gif {
    struct animation_settings settings;
    uint8_t *bytes;
    size_t size, capacity;
    int count; // frames so far
    struct cell cells[CELLS];
    uint32_t used[CELLS]; // the cells that a frame uses; the cells of a box are consecutive
    uint16_t next[CODES][256];
    size_t block; // the position of the length of the last block of codes
    uint32_t bits;
    int bit_count;
};

static void put(struct gif *gif, const void *data, size_t size)
{
    memcpy(gif->bytes + gif->size, data, size);
    gif->size += size;
}

static void put_u16(struct gif *gif, int number)
{
    put(gif, (uint8_t[2]){(uint8_t)(number & 255), (uint8_t)(number >> 8)}, 2);
}

static void put_code(struct gif *gif, uint32_t code, int width)
{
    gif->bits |= code << gif->bit_count;
    for (gif->bit_count += width; gif->bit_count >= 8; gif->bit_count -= 8, gif->bits >>= 8) {
        if (gif->bytes[gif->block] == BLOCK) {
            gif->block = gif->size;
            put(gif, "", 1);
        }
        gif->bytes[gif->block]++;
        gif->bytes[gif->size++] = (uint8_t)gif->bits;
    }
}

// Compresses the indices of a frame with LZW.
static void put_indices(struct gif *gif, const uint8_t *indices, size_t count)
{
    int width = 9, codes = CODES; // the table is full, so the first code clears it
    uint32_t prefix = indices[0];
    put(gif, "\x08", 2);
    gif->block = gif->size - 1;
    for (size_t i = 1; i <= count; i++) {
        uint16_t *next = i < count ? &gif->next[prefix][indices[i]] : NULL;
        if (codes == CODES) {
            put_code(gif, CLEAR, width);
            memset(gif->next, 0, sizeof gif->next);
            width = 9;
            codes = END + 1;
        }
        if (next && *next) {
            prefix = *next;
            continue;
        }
        put_code(gif, prefix, width);
        width += codes >> width;
        if (next)
            *next = (uint16_t)codes++, prefix = indices[i];
    }
    put_code(gif, END, width);
    put_code(gif, 0, 7); // the last bits
    gif->bits = 0, gif->bit_count = 0;
    put(gif, "", 1);
}

// --- the palette

static int side_of(uint32_t key, int axis) { return (int)(key >> BITS * axis & (SIDES - 1)); }

// Returns the cell of a colour. `step` is added to each channel.
static uint32_t key_of(const uint8_t *pixel, int step)
{
    uint32_t key = 0;
    for (int i = 0; i < 3; i++) {
        int value = pixel[i] + step < 0 ? 0 : pixel[i] + step > 255 ? 255 : pixel[i] + step;
        key |= (uint32_t)value >> (8 - BITS) << BITS * i;
    }
    return key;
}

// Returns 0 to 63: the order in which the pixels of a square of 8×8 pixels take the next step (Bayer).
static int order_of(int x, int y)
{
    int order = 0;
    for (int bit = 0; bit < 3; bit++)
        order |= ((x ^ y) >> bit & 1) << (5 - 2 * bit) | (y >> bit & 1) << (4 - 2 * bit);
    return order;
}

// Returns whether a pixel is drawn. At the edge of an opaque surface, half of the largest alpha decides. Elsewhere, as
// in a soft shadow, the dither decides.
static bool is_opaque(const lam_image *frame, const uint8_t *pixel, int x, int y)
{
    const ptrdiff_t row = (ptrdiff_t)4 * frame->width;
    bool edge = (x > 0 && pixel[3 - 4] == 255) || (x + 1 < frame->width && pixel[3 + 4] == 255) ||
                (y > 0 && pixel[3 - row] == 255) || (y + 1 < frame->height && pixel[3 + row] == 255);
    return edge ? pixel[3] >= 128 : pixel[3] * 64 > order_of(x, y) * 255;
}

// Moves the cells of the lower half of the longest side to the front, and returns their number.
static uint32_t split(uint32_t *cells, uint32_t count)
{
    int axis = 0, middle = 0, longest = 0;
    uint32_t left = 0;
    for (int a = 0; a < 3; a++) {
        int low = SIDES, high = 0;
        for (uint32_t i = 0; i < count; i++) {
            low = side_of(cells[i], a) < low ? side_of(cells[i], a) : low;
            high = side_of(cells[i], a) > high ? side_of(cells[i], a) : high;
        }
        if (high - low > longest)
            longest = high - low, axis = a, middle = (low + high) / 2;
    }
    for (uint32_t i = 0; i < count; i++)
        if (side_of(cells[i], axis) <= middle) {
            uint32_t cell = cells[i];
            cells[i] = cells[left];
            cells[left++] = cell;
        }
    return left;
}

// Puts the palette: the means of boxes with about the same number of used cells.
static void put_palette(struct gif *gif, uint32_t used)
{
    uint32_t first[COLORS] = {0}, counts[COLORS] = {used};
    for (int boxes = 1, largest = 0; boxes < COLORS && counts[largest] > 1; boxes++) {
        uint32_t left = split(gif->used + first[largest], counts[largest]);
        first[boxes] = first[largest] + left;
        counts[boxes] = counts[largest] - left;
        counts[largest] = left;
        for (int i = 0; i <= boxes; i++)
            largest = counts[i] > counts[largest] ? i : largest;
    }
    for (int i = 0; i <= COLORS; i++)
        for (int c = 0; c < 3; c++) {
            uint64_t sum = 0, pixels = 0;
            for (uint32_t k = 0; i < COLORS && k < counts[i]; k++) {
                struct cell *cell = &gif->cells[gif->used[first[i] + k]];
                cell->index = (uint8_t)i;
                sum += cell->sums[c];
                pixels += cell->count;
            }
            gif->bytes[gif->size++] = (uint8_t)(pixels ? (sum + pixels / 2) / pixels : 0);
        }
}

// Puts the palette of a frame and fills its indices.
static void quantize(struct gif *gif, const lam_image *frame, uint8_t *indices)
{
    const uint8_t *pixels = frame->pixels;
    size_t count = (size_t)frame->width * (size_t)frame->height;
    uint32_t used = 0;
    memset(gif->cells, 0, sizeof gif->cells);
    for (size_t i = 0; i < count; i++) {
        int x = (int)(i % (size_t)frame->width), y = (int)(i / (size_t)frame->width);
        indices[i] = is_opaque(frame, pixels + 4 * i, x, y) ? 0 : COLORS;
        struct cell *cell = &gif->cells[key_of(pixels + 4 * i, 0)];
        if (indices[i] == 0 && !cell->count++)
            gif->used[used++] = key_of(pixels + 4 * i, 0);
        for (int c = 0; c < 3 && indices[i] == 0; c++)
            cell->sums[c] += pixels[4 * i + (size_t)c];
    }
    put_palette(gif, used);
    for (size_t i = 0; i < count; i++) {
        int step = (2 * order_of((int)(i % (size_t)frame->width), (int)(i / (size_t)frame->width)) - 63) * DITHER / 63;
        const struct cell *cell = &gif->cells[key_of(pixels + 4 * i, step)];
        if (indices[i] == 0) // the dither uses only colours of the frame
            indices[i] = cell->count ? cell->index : gif->cells[key_of(pixels + 4 * i, 0)].index;
    }
}

// --- the file

static void gif_free(void *state)
{
    struct gif *gif = state;
    free(gif->bytes);
    free(gif);
}

static void *gif_start(const struct animation_settings *settings, lam_error *error)
{
    const double rate = settings->frames_per_second;
    if (rate > 50)
        return fail(error, LAM_BAD_ARGUMENT, "GIF: %g frames a second, expected at most 50", rate), NULL;
    struct gif *gif = calloc(1, sizeof *gif);
    if (!gif || !(gif->bytes = malloc(HEAD)))
        return free(gif), fail_memory(error, sizeof *gif), NULL;
    gif->settings = *settings;
    put(gif, "GIF89a", 6);
    put_u16(gif, settings->width);
    put_u16(gif, settings->height);
    put(gif, "\x70\0", 3); // 8 bits per channel, no global palette
    if (settings->loops != 1) {
        put(gif, "\x21\xff\x0bNETSCAPE2.0\x03\x01", 16);
        put_u16(gif, settings->loops ? settings->loops - 1 : 0); // the number of repetitions; 0: forever
        put(gif, "", 1);
    }
    return gif;
}

// Returns the start time of a frame in hundredths of a second, the unit of the format.
static int time_of(const struct gif *gif, int frame)
{
    return (int)(frame * 100.0 / gif->settings.frames_per_second + 0.5);
}

static bool gif_add(void *state, const lam_image *frame, const lam_save_params *params, struct pool *pool,
                    lam_error *error)
{
    (void)params, (void)pool;
    struct gif *gif = state;
    const size_t count = (size_t)frame->width * (size_t)frame->height;
    gif->capacity = gif->size + 2 * count + HEAD; // a pixel takes up to 12 bits and 1/255 of a length
    uint8_t *indices = malloc(count), *bytes = realloc(gif->bytes, gif->capacity);
    gif->bytes = bytes ? bytes : gif->bytes;
    if (!bytes || !indices)
        return free(indices), fail_memory(error, gif->capacity);
    put(gif, "\x21\xf9\x04\x09", 4); // clear the frame afterwards; one colour is transparent
    put_u16(gif, time_of(gif, gif->count + 1) - time_of(gif, gif->count));
    gif->count++;
    put(gif, "\xff\0\x2c\0\0\0", 7);
    put_u16(gif, frame->width);
    put_u16(gif, frame->height);
    put(gif, "\x87", 1); // a palette of 256 colours
    quantize(gif, frame, indices);
    put_indices(gif, indices, count);
    free(indices);
    return true;
}

static bool gif_finish(void *state, const lam_save_params *params, lam_bytes *out, lam_error *error)
{
    (void)params, (void)error;
    struct gif *gif = state;
    put(gif, "\x3b", 1);
    *out = (lam_bytes){gif->bytes, gif->size};
    gif->bytes = NULL;
    return true;
}

static uint64_t gif_held(const void *state) { return ((const struct gif *)state)->capacity; }

const struct animation_codec animation_gif = {
    .start = gif_start, .add = gif_add, .finish = gif_finish, .held = gif_held, .free = gif_free};

static bool gif_write(const lam_image *image, const lam_save_params *params, struct pool *pool, lam_bytes *out,
                      lam_error *error)
{
    struct animation_settings still = {image->width, image->height, .frames_per_second = 1, .loops = 1};
    struct gif *gif = gif_start(&still, error);
    bool ok = gif && gif_add(gif, image, params, pool, error) && gif_finish(gif, params, out, error);
    if (gif)
        gif_free(gif);
    return ok;
}

const struct codec codec_gif = {.name = "gif",
                                .title = "GIF",
                                .written = "255 colours per frame, and transparent pixels",
                                .pixels = LAM_RGBA8,
                                .write = gif_write};
