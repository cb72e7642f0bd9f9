// environment_lamp.h: separates the brightest lamp of an environment from the rest of the environment's light, so that
// the lamp can cast shadows (docs/lighting/environment.md).
#ifndef ENVIRONMENT_LAMP_H
#define ENVIRONMENT_LAMP_H

#include "environment_light.h"

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

#endif
