// up_axis.h: rotations between the axes of a model with Y up and of a scene with another up axis.
#ifndef UP_AXIS_H
#define UP_AXIS_H

#include <lambent/scene.h>

// With Y up the front is +Z and the right +X. The other axes are:
//
//   up      y    −y    z    −z    x    −x
//   front   +Z   +Z    −Y   −Y    +Z   +Z
//   right   +X   −X    +X   −X    −Y   +Y
//
// so that of two opposite axes the second turns the picture upside down, and the same side stays in front. With Z up
// this is the habit of CAD. LAM_UP_AUTO is y.
lam_vec3 from_y_up(lam_up up, lam_vec3 d); // a direction of a model with Y up, in the scene
lam_vec3 to_y_up(lam_up up, lam_vec3 d);   // the inverse

#endif
