// cube_map.h: the internal structure of lam_environment: six faces, each with a border of one texel taken from its
// neighbours.
//
// Because of the border, bilinear filtering needs no special cases at edges and corners, and is continuous there: both
// faces mix the same four texels. Three faces meet at each corner; there, the texel of the border is the average of the
// faces' corner texels.
#ifndef CUBE_MAP_H
#define CUBE_MAP_H

#include <lambent/environment.h>
#include <lambent/image.h>

enum { CUBE_SIDE_MOST = 8192 };

struct lam_environment {
    int references;                  // accessed atomically
    int size;                        // texels per side of a face, without the border
    float *texels;                   // 6 faces of (size + 2)² texels of r, g and b; row t = −1 is first
    size_t held;                     // size in bytes of the pages that contain the texels
    struct environment_light *light; // the light on physical materials, made on first use (environment_light.h)
};

static inline size_t cube_row(const struct lam_environment *cube) { return (size_t)(cube->size + 2) * 3; }
// Returns texel (s, t) of a face; s and t are −1 … size.
static inline float *cube_texel(const struct lam_environment *cube, int face, int s, int t)
{
    return cube->texels + ((size_t)face * (size_t)(cube->size + 2) + (size_t)(t + 1)) * cube_row(cube) +
           (size_t)(s + 1) * 3;
}

// Makes a cube of the given size with undefined texels. Returns NULL if memory runs out.
struct lam_environment *cube_make(int size, lam_error *error);

// Padding after the texels, so that the last texel can also be read as four floats.
enum { CUBE_TEXELS_AFTER = 16 };

static inline size_t cube_bytes(int size)
{
    return ((size_t)size + 2) * ((size_t)size + 2) * LAM_FACE_COUNT * 3 * sizeof(float);
}

// Computes the texels of the borders from the texels of the faces.
void cube_close(struct lam_environment *cube);

// Computes the direction of a point on a face: major · axis + across · s + down · t (the inverse of OpenGL's table).
void cube_direction(int face, double major, double across, double down, double out[3]);

#endif
