// light_option.h: the value of --light.
#ifndef LIGHT_OPTION_H
#define LIGHT_OPTION_H

#include <lambent/lambent.h>

// A light as written, without the parts that depend on the model and the camera.
struct light_option {
    bool none; // "none": no light at all
    bool adds; // "+TYPE": the rig stays
    lam_light light;
    bool has_position, has_direction, has_target;
    bool position_in_radii, target_in_radii, linear_in_radii, quadratic_in_radii, range_in_radii;
    lam_vec3 target;
    char text[1024]; // the light's names point into it: the struct must not be copied
};

// "TYPE:key=value,…"; docs in the table of options.
bool light_option_parse(const char *text, lam_color_mode mode, struct light_option *option, lam_error *error);

// The sphere that 'r' counts by: of the model as it was before --rotate.
struct model_sphere {
    lam_vec3 centre;
    double radius;
};

// Adds the light to the scene.
bool light_option_add(const struct light_option *option, const struct model_sphere *sphere, const lam_camera *camera,
                      lam_scene *scene, lam_error *error);

// Whether angles make a cone; NULL: that kind is not asked for. Errors are in degrees.
bool light_cone_check(const double *cutoff_deg, const double *inner_deg, const double *outer_deg, lam_error *error);

#endif
