// environment_light.h: converts an environment to the light that metallic-roughness materials receive: the two terms of
// the split-sum approximation (Karis, "Real Shading in Unreal Engine 4", 2013) that depend only on the environment.
//
//  prefiltered  the environment as the GGX microfacets reflect it around the mirrored direction r, seen along the
//               normal (n = v = r), for ENVIRONMENT_LEVELS roughnesses:
//                   P(r) = sum over l of L(l) D(h) max(r.l, 0) / sum of D(h) max(r.l, 0),   h = unit(r + l)
//  irradiance   the mean of the light from the half space above a surface, weighted by the cosine: irradiance / pi
//
// Both terms are sums over fixed directions in a fixed order, computed with + − × ÷ √ only. Therefore the texels are
// identical on every machine and with any number of threads.
#ifndef ENVIRONMENT_LIGHT_H
#define ENVIRONMENT_LIGHT_H

#include "cube_map.h"

struct call_control;
struct pool;

// Level 0, for ROUGHNESS_MIN, is the environment itself. Level i is for the roughness at which prefilter_level
// (src/core/lighting/lobes.h) is i.
enum { ENVIRONMENT_LEVELS = 12, IRRADIANCE_SIZE = 32 };

struct environment_light {
    struct lam_environment level[ENVIRONMENT_LEVELS]; // [0] shares the texels of the environment
    struct lam_environment irradiance;
    float *texels; // all levels but level[0], in rows of ENVIRONMENT_LIGHT_WIDTH texels
    size_t held;   // size in bytes of the pages of `texels`
    unsigned made; // bit i is set if level i exists, bit ENVIRONMENT_LEVELS if the irradiance exists; accessed
                   // atomically
    // See struct environment_lamp; both are NULL before the first use. `without_lamp` shares the levels of this struct.
    struct environment_lamp *lamp;
    struct environment_light *without_lamp;
};
enum { ENVIRONMENT_LIGHT_ALL = (2 << ENVIRONMENT_LEVELS) - 1 };

void environment_light_free(struct environment_light *light); // NULL is allowed

// --- the steps

// A chain of smaller and smaller copies of a cube; each texel is the mean of the light in its solid angle. [0] is the
// cube itself.
enum { CUBE_CHAIN_MAX = 15 };
struct cube_chain {
    struct lam_environment cube[CUBE_CHAIN_MAX];
    int count;
    float *texels; // all copies but cube[0]
    size_t held;   // size in bytes of the pages of `texels`
};
bool cube_chain_make(struct cube_chain *chain, const struct lam_environment *cube, struct pool *pool,
                     struct call_control *call, lam_error *error);
void cube_chain_free(struct cube_chain *chain);
// Returns the copy whose size is nearest to `size`, compared as a ratio.
const struct lam_environment *cube_chain_near(const struct cube_chain *chain, double size);

// Returns the solid angle of a texel, except for a constant factor.
float texel_weight(int size, int s, int t);

// Sums over all texels of a small copy of a cube. The sums are the irradiance, or the environment prefiltered for a
// wide lobe.
struct cube_sums;
struct cube_sums *cube_sums_make(const struct cube_chain *chain, lam_error *error);

#endif
