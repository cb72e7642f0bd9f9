// environment_lamp.h: the brightest lamp of an environment, as a separate light that can cast shadows, and the light of
// the environment without it (docs/lighting/environment.md).
#ifndef ENVIRONMENT_LAMP_H
#define ENVIRONMENT_LAMP_H

#include "environment_light.h"

struct environment_lamp {
    bool present;             // false: no part of the environment is much brighter than its mean
    double direction[3];      // towards the lamp, unit, in the environment's axes
    float color[3];           // the light of a white matt surface that faces it: its irradiance / pi
    float angular_radius_rad; // of the disc that has the lamp's spread
};

// Found once, and kept with the environment. Fails with LAM_LIMIT, LAM_CANCELLED. `call` may be NULL.
bool environment_lamp(const struct lam_environment *cube, struct environment_lamp *lamp, struct call_control *call,
                      lam_error *error);

// As environment_light, but the irradiance is that without the lamp: with the light of the lamp, max(n.l, 0) times its
// colour, it is the whole again. Reflections do not change.
const struct environment_light *environment_light_without_lamp(const struct lam_environment *cube, unsigned needed,
                                                               struct pool *pool, struct call_control *call,
                                                               lam_error *error);

#endif
