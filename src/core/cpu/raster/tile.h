// tile.h: the grid of tiles of the picture, and the layout of a tile's samples in memory.
#ifndef TILE_H
#define TILE_H

#include <stdint.h>

enum {
    TILE_SHIFT = 6,
    TILE = 1 << TILE_SHIFT, // pixels per side (FRAME_TILE)
    SUBPIXEL = 256,         // steps per pixel to which vertices are snapped
    SUBPIXEL_SHIFT = 8,
    LANES_MAX = 16,
    // the maximum number of translucent fragments that a thread stores, and therefore the maximum number in one pixel
    LAYERS_MAX = 65536,
};

#define NOTHING   0xffffffffu // a sample that no triangle covers
#define BACK_SIDE 0x80000000u // flag in a triangle number: the back of the triangle is visible

// A tile: its column and row in the grid, and the number of its pixels inside the picture.
struct tile {
    int x, y, width, height;
};

static inline struct tile tile_at(int x, int y, int picture_width, int picture_height)
{
    int width = picture_width - x * TILE, height = picture_height - y * TILE;
    return (struct tile){x, y, width < TILE ? width : TILE, height < TILE ? height : TILE};
}

// A rectangle of pixels in a tile, including the last column and row.
struct rectangle {
    int left, top, right, bottom;
};

// A tile's samples are stored cell by cell. A cell contains CELL samples. Its shape is as square as possible, so that a
// small triangle touches few cells. Within a cell, pixels are stored row by row, and the samples of a pixel are
// adjacent.
enum { CELL = 16 };
struct cells {
    int x_shift, y_shift; // a cell's width and height in pixels: 1 << shift
    int across;           // cells in a row of the tile
    int samples;          // per pixel
};
static inline struct cells cells_of(int samples)
{
    int x_shift = samples <= 2 ? 2 : samples <= 8 ? 1 : 0, y_shift = samples == 1 ? 2 : samples <= 4 ? 1 : 0;
    return (struct cells){x_shift, y_shift, TILE >> x_shift, samples};
}

// Returns the index of a pixel's first sample.
static inline int pixel_index(const struct cells *cells, int x, int y)
{
    int cell = (y >> cells->y_shift) * cells->across + (x >> cells->x_shift);
    int column = x & ((1 << cells->x_shift) - 1), row = y & ((1 << cells->y_shift) - 1);
    return cell * CELL + ((row << cells->x_shift) + column) * cells->samples;
}

// Returns the number of samples in a tile, which is also the maximum number of its opaque fragments.
static inline int tile_samples_count(int samples) { return TILE * TILE * samples; }

#endif
