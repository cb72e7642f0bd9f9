// camera_option.h: the value of --camera.
#ifndef CAMERA_OPTION_H
#define CAMERA_OPTION_H

#include <lambent/lambent.h>

struct camera_option {
    lam_camera camera; // angles in radians
    bool has_target, has_up;
};

// "eye=x/y/z,target=x/y/z,up=x/y/z,fovy=degrees" and so on; docs in the table of options.
bool camera_option_parse(const char *text, struct camera_option *option, lam_error *error);

// The same with what was left out taken from the scene: the middle of its box as target, its up axis, 30° high.
lam_camera camera_option_complete(const struct camera_option *option, const lam_scene *scene);

double radians(double degrees);

#endif
