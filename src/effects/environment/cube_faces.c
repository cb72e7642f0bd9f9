// cube_faces.c: computes the directions of a cube map's texels, and the borders of its faces.
#include "cube_map.h"

#include <string.h>

void cube_direction(int face, double major, double across, double down, double out[3])
{
    switch (face) {
    case LAM_FACE_PX:
    case LAM_FACE_NX:
        out[0] = face == LAM_FACE_PX ? major : -major;
        out[1] = -down;
        out[2] = face == LAM_FACE_PX ? -across : across;
        break;
    case LAM_FACE_PY:
    case LAM_FACE_NY:
        out[0] = across;
        out[1] = face == LAM_FACE_PY ? major : -major;
        out[2] = face == LAM_FACE_PY ? down : -down;
        break;
    default:
        out[0] = face == LAM_FACE_PZ ? across : -across;
        out[1] = -down;
        out[2] = face == LAM_FACE_PZ ? major : -major;
    }
}

// Returns the texel that is beside texel (s, t) of the border, on the neighbouring face. A face extends from −size to
// size, so texel i is at the odd number 2i + 1 − size. Beyond an edge, the texel is as far inside the neighbouring face
// as (s, t) is outside its own face. All numbers are integers.
static const float *neighbour(const struct lam_environment *cube, int face, int s, int t)
{
    int n = cube->size;
    double across = 2 * s + 1 - n, down = 2 * t + 1 - n, d[3];
    if (s < 0 || s >= n)
        across = s < 0 ? -n : n;
    else
        down = t < 0 ? -n : n;
    cube_direction(face, n - 1, across, down, d);
    for (int other = 0; other < LAM_FACE_COUNT; other++) {
        if (d[other / 2] != (other % 2 ? -n : n))
            continue;
        double unit[2][3];
        cube_direction(other, 0, 1, 0, unit[0]);
        cube_direction(other, 0, 0, 1, unit[1]);
        int at[2];
        for (int i = 0; i < 2; i++)
            at[i] = ((int)(unit[i][0] * d[0] + unit[i][1] * d[1] + unit[i][2] * d[2]) + n - 1) / 2;
        return cube_texel(cube, other, at[0], at[1]);
    }
    return cube_texel(cube, face, 0, 0); // unreachable: one axis is at ±size
}

static void close_corner(struct lam_environment *cube, int face, int s, int t)
{
    int n = cube->size, inner_s = s < 0 ? 0 : n - 1, inner_t = t < 0 ? 0 : n - 1;
    const float *a = cube_texel(cube, face, inner_s, inner_t), *b = cube_texel(cube, face, s, inner_t),
                *c = cube_texel(cube, face, inner_s, t);
    float *out = cube_texel(cube, face, s, t);
    for (int channel = 0; channel < 3; channel++)
        out[channel] = (float)(((double)a[channel] + (double)b[channel] + (double)c[channel]) / 3);
}

void cube_close(struct lam_environment *cube)
{
    int n = cube->size;
    for (int face = 0; face < LAM_FACE_COUNT; face++) {
        for (int i = 0; i < n; i++) {
            const int border[4][2] = {{-1, i}, {n, i}, {i, -1}, {i, n}};
            for (int p = 0; p < 4; p++)
                memcpy(cube_texel(cube, face, border[p][0], border[p][1]),
                       neighbour(cube, face, border[p][0], border[p][1]), 3 * sizeof(float));
        }
        for (int corner = 0; corner < 4; corner++)
            close_corner(cube, face, corner & 1 ? n : -1, corner & 2 ? n : -1);
    }
}
