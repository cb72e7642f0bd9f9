// environment_light.h: an environment as a light of metallic-roughness materials: the two parts of the split sum (Karis,
// "Real Shading in Unreal Engine 4", 2013) that depend on the surroundings alone.
//
//   prefiltered  the environment as mirrors of GGX's distribution around the mirrored direction r show it, seen along
//                their normal (n = v = r), for ENVIRONMENT_LEVELS roughnesses:
//                    P(r) = sum over l of L(l) D(h) max(r.l, 0) / sum of D(h) max(r.l, 0),   h = unit(r + l)
//   irradiance   the mean of the light from the half space above a surface, weighted by the cosine: irradiance / pi
//
// Both are sums over fixed directions in a fixed order, computed with + − × ÷ √ alone: the same texels on every machine
// and with any number of threads.
#ifndef ENVIRONMENT_LIGHT_H
#define ENVIRONMENT_LIGHT_H

#include "cube_map.h"

// Level 0, of ROUGHNESS_MIN, is the environment itself. Level i is of the roughness at which prefilter_level
// (src/lighting/lobes.h) is i.
enum { ENVIRONMENT_LEVELS = 12, IRRADIANCE_SIZE = 32 };

struct environment_light {
    struct lam_environment level[ENVIRONMENT_LEVELS]; // [0] shares the texels of the environment
    struct lam_environment irradiance;
    float *texels; // of all but level[0], in whole rows of ENVIRONMENT_LIGHT_WIDTH texels
    size_t held;   // of their pages
    unsigned made; // bit i: level i; bit ENVIRONMENT_LEVELS: the irradiance. Accessed atomically
    // environment_lamp.h; NULL until they are asked for. The latter has the levels of this one.
    struct environment_lamp *lamp;
    struct environment_light *without_lamp;
};
enum { ENVIRONMENT_LIGHT_ALL = (2 << ENVIRONMENT_LEVELS) - 1 };

// Returns the parts that roughnesses between two levels read: the irradiance, these levels, and the levels between and
// next to them.
unsigned environment_light_parts(float first, float last);

int prefiltered_size(int level); // texels on a side of levels 1 and up
// Levels 1 and up and the irradiance, each six faces with their borders (cube_map.h), follow each other in `texels`:
// the number of the first texel of a level, of the irradiance for ENVIRONMENT_LEVELS, and the rows of a texture of
// ENVIRONMENT_LIGHT_WIDTH texels with all of them.
enum { ENVIRONMENT_LIGHT_WIDTH = 1024 };
int environment_light_first(int level);
int environment_light_rows(void);
double prefiltered_roughness(int level);

// The light of an environment. Of its parts `needed` are made unless an earlier call has, and kept with the environment; any
// number of threads may ask, and read the parts that they asked for. `pool` NULL: threads of its own; `call` may be NULL. NULL:
// LAM_LIMIT, LAM_CANCELLED.
struct pool;
const struct environment_light *environment_light(const struct lam_environment *cube, unsigned needed,
                                                  struct pool *pool, struct call_control *call, lam_error *error);
void environment_light_free(struct environment_light *light); // NULL is fine

// --- the steps

// Smaller and smaller copies of a cube, each texel the mean of the light through it; [0] is the cube itself.
enum { CUBE_CHAIN_MAX = 15 };
struct cube_chain {
    struct lam_environment cube[CUBE_CHAIN_MAX];
    int count;
    float *texels; // of all but cube[0]
    size_t held;   // of their pages
};
bool cube_chain_make(struct cube_chain *chain, const struct lam_environment *cube, struct pool *pool,
                     struct call_control *call, lam_error *error);
void cube_chain_free(struct cube_chain *chain);
// Returns the copy whose size is nearest to `size`, by ratio.
const struct lam_environment *cube_chain_near(const struct cube_chain *chain, double size);

// Returns the solid angle of a texel up to a factor, and its direction, not of length 1.
float texel_weight(int size, int s, int t);

// Sums over every texel of a small copy of a cube: the irradiance, or the environment prefiltered for a wide lobe.
struct cube_sums;
struct cube_sums *cube_sums_make(const struct cube_chain *chain, lam_error *error);

#endif
