// environment.h: environments: cube maps that surfaces mirror, and that light physical materials. This header is the
// entry to this folder: other wings include only this header of the folder, and call only the functions that it
// declares (tests/structure.py).
#ifndef ENVIRONMENT_ENTRY_H
#define ENVIRONMENT_ENTRY_H

#include "buffer.h"
#include "environment_light.h"

// --- environments

// Opens the file of picture number `index`; the caller releases the file. Error messages use *name as the file's name.
struct file_bytes;
struct picture_source {
    bool (*open)(void *user, int index, struct call_control *call, struct file_bytes *file, const char **name,
                 lam_error *error);
    void *user;
};

// Makes an environment from one picture or from six faces (`count` is 1 or 6), which are read one after the other.
// `call` may be NULL. The environment's memory counts towards the call's memory limit, even after this function
// returns.
struct lam_environment *environment_read(const struct picture_source *source, int count, lam_color_mode color,
                                         struct call_control *call, lam_error *error);

// The built-in studio environment. The first call of lazy_environment_studio makes the environment, or returns NULL if
// memory runs out.
struct lazy_environment;
struct lazy_environment *lazy_environment_make(void);
const struct lam_environment *lazy_environment_studio(struct lazy_environment *lazy, lam_error *error);
void lazy_environment_free(struct lazy_environment *lazy); // NULL is allowed

// Adds a reference.
struct lam_environment *cube_share(const struct lam_environment *cube);

// --- the light that physical materials receive

// Returns a bit mask of the parts that roughnesses between two levels need: the irradiance, these two levels, the
// levels between them, and the levels next to them.
unsigned environment_light_parts(float first, float last);

int prefiltered_size(int level); // texels per side, for levels from 1
// `texels` contains the levels, starting with level 1, and then the irradiance, each as six faces with their borders
// (cube_map.h). environment_light_first returns the index of the first texel of a level, or of the irradiance if
// `level` is ENVIRONMENT_LEVELS. environment_light_rows returns the number of rows of a texture that is
// ENVIRONMENT_LIGHT_WIDTH texels wide and contains all of these texels.
enum { ENVIRONMENT_LIGHT_WIDTH = 1024 };
int environment_light_first(int level);
int environment_light_rows(void);

// Returns the light of an environment. Computes the parts in `needed` that do not exist yet, and stores them with the
// environment. Any number of threads may call this function at the same time, and read the parts that they requested.
// If `pool` is NULL, the function starts its own threads. `call` may be NULL. On failure, returns NULL with LAM_LIMIT
// or LAM_CANCELLED.
const struct environment_light *environment_light(const struct lam_environment *cube, unsigned needed,
                                                  struct pool *pool, struct call_control *call, lam_error *error);

// --- the brightest lamp of an environment, separate from the rest of its light, so that the lamp can cast shadows
// (docs/lighting/environment.md)

struct environment_lamp {
    bool present;             // false if no region of the environment is much brighter than its mean
    double direction[3];      // the unit direction to the lamp, in the environment's axes
    float color[3];           // the light that a white matt surface facing the lamp reflects: irradiance / pi
    float angular_radius_rad; // the radius of a disc with the lamp's angular spread
};

// Finds the lamp on the first call and stores it with the environment. Fails with LAM_LIMIT or LAM_CANCELLED. `call`
// may be NULL.
bool environment_lamp(const struct lam_environment *cube, struct environment_lamp *lamp, struct call_control *call,
                      lam_error *error);

// Works like environment_light, but the irradiance does not contain the lamp. The total irradiance is the returned
// irradiance plus the lamp's light: max(n.l, 0) times the lamp's colour. Reflections still contain the lamp.
const struct environment_light *environment_light_without_lamp(const struct lam_environment *cube, unsigned needed,
                                                               struct pool *pool, struct call_control *call,
                                                               lam_error *error);

// --- fixed directions that follow the brightness of an environment, computed from a Hammersley set

// A direction towards a bright region of the environment.
struct sampled_light {
    float direction[3]; // unit vector, in the caller's axes
    float density;      // directions per steradian
    float color[3];     // the light from this direction
};

struct environment_samples {
    struct sampled_light *light;
    int light_count;
    int size; // texels per side of the density's faces
    // 6 faces, row by row: the probability density of the directions in `light`, per area; a side of a face has length
    // 2.
    const float *density;
};

// Selects `count` directions. `to_environment` rotates the caller's axes to the environment's axes. `storage` owns the
// samples. `call` may be NULL.
bool environment_samples_make(struct environment_samples *samples, const struct lam_environment *cube,
                              const float to_environment[3][3], int count, struct buffer *storage,
                              struct call_control *call, lam_error *error);

// --- lookups for a batch of points

// The environment of a frame, for lookups.
struct environment_view {
    const struct lam_environment *cube;
    const float (*to_environment)[3];          // from the axes of the caller's directions to the environment's axes
    const struct environment_light *light;     // needed by `irradiance` and `prefiltered`
    const struct environment_samples *samples; // needed by `densities`
};

// Rows of vectors, one row for each coordinate or channel. `count` is rounded up to a multiple of the lanes.
typedef float *const environment_rows[3];

// The functions for a number of points at a time, compiled for each instruction set. The results may replace the
// directions.
struct environment_lookups {
    // The environment itself in each direction.
    void (*colors)(const struct environment_view *view, environment_rows direction, int count, environment_rows out);
    // The irradiance divided by pi, for each normal.
    void (*irradiance)(const struct environment_view *view, environment_rows normal, int count, environment_rows out);
    // The light around each direction, prefiltered for a level (prefilter_level).
    void (*prefiltered)(const struct environment_view *view, environment_rows direction, const float *level, int count,
                        environment_rows out);
    // The probability density of the directions in `samples`, per solid angle, in each direction.
    void (*densities)(const struct environment_view *view, environment_rows direction, int count, float *out);
};
// Returns the version with the given number of lanes (1, 4, 8, 16). NULL if the build has no effects.
const struct environment_lookups *environment_lookups_of(int lanes);

#endif
