// cube_map.h: the inside of lam_environment: six faces, each with a border of one texel taken from its neighbours.
//
// With the border, bilinear filtering needs no case at edges and corners, and is continuous there: both faces mix the
// same four texels. A border's corner, where three faces meet and there is no fourth texel, is the average of the
// three.
#ifndef CUBE_MAP_H
#define CUBE_MAP_H

#include <lambent/environment.h>
#include <lambent/image.h>

enum { CUBE_SIDE_MOST = 8192 };

struct lam_environment {
    int references;                  // accessed atomically
    int size;                        // texels on a face's side, border not counted
    float *texels;                   // 6 faces of (size + 2)² times r, g, b; row t = −1 first
    size_t held;                     // of the pages of its own texels
    struct environment_light *light; // for physical materials, made when first asked for (environment_light.h)
};

static inline size_t cube_row(const struct lam_environment *cube) { return (size_t)(cube->size + 2) * 3; }
// Texel (s, t) of a face, −1 … size.
static inline float *cube_texel(const struct lam_environment *cube, int face, int s, int t)
{
    return cube->texels + ((size_t)face * (size_t)(cube->size + 2) + (size_t)(t + 1)) * cube_row(cube) +
           (size_t)(s + 1) * 3;
}

// Returns a cube of that size, texels undefined. Returns NULL if memory runs out.
struct lam_environment *cube_make(int size, lam_error *error);

// Memory after the texels, so that the last one too can be read as four numbers.
enum { CUBE_TEXELS_AFTER = 16 };

static inline size_t cube_bytes(int size)
{
    return ((size_t)size + 2) * ((size_t)size + 2) * LAM_FACE_COUNT * 3 * sizeof(float);
}

// Opens the file of picture `index`; the caller releases it. Messages use *name for it.
struct call_control;
struct file_bytes;
struct picture_source {
    bool (*open)(void *user, int index, struct call_control *call, struct file_bytes *file, const char **name,
                 lam_error *error);
    void *user;
};

// Returns an environment of one picture or of six faces (`count`), read one after the other within a call. `call` may
// be NULL. The environment's memory stays charged.
struct lam_environment *environment_read(const struct picture_source *source, int count, lam_color_mode color,
                                         struct call_control *call, lam_error *error);

// Fills the borders from the faces.
void cube_close(struct lam_environment *cube);

// The direction of a point of a face: major · axis + across · s + down · t (OpenGL's table, read backwards).
void cube_direction(int face, double major, double across, double down, double out[3]);

// The built-in studio, made when it is first asked for, by any number of threads. NULL: out of memory.
struct lazy_environment;
struct lazy_environment *lazy_environment_make(void);
const struct lam_environment *lazy_environment_studio(struct lazy_environment *lazy, lam_error *error);
void lazy_environment_free(struct lazy_environment *lazy); // NULL is fine

// Adds a reference.
struct lam_environment *cube_share(const struct lam_environment *cube);

#endif
