// up_axis.h: rotates between the axes of a model with y up and the axes of a scene with another up axis.
#ifndef UP_AXIS_H
#define UP_AXIS_H

#include <lambent/scene.h>

// With y up, the front is +Z and the right side is +X. The other axes are:
//
//  up      y    −y    z    −z    x    −x
//  front   +Z   +Z    −Y   −Y    +Z   +Z
//  right   +X   −X    +X   −X    −Y   +Y
//
// A negative axis turns the picture upside down and keeps the front. The axes for z up are the convention of CAD
// programs. LAM_UP_AUTO and LAM_UP_FILE mean y.
lam_vec3 from_y_up(lam_up up, lam_vec3 d); // rotates a direction of a model with y up into the scene
lam_vec3 to_y_up(lam_up up, lam_vec3 d);   // the inverse rotation

#endif
