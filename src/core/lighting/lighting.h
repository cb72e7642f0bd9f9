// lighting.h: the equations in C. Define LANES as 1, 4, 8 or 16 before including this file (src/core/base/math/lanes.h).
//
// In GLSL, prelude.glsl and the files of the equations are concatenated in this order. These files therefore have no
// include guards.
#ifndef LIGHTING_H
#define LIGHTING_H

#include "prelude_c.h"

#include <lambent/device.h>
#include <lambent/material.h>

#include "lobes.h"
#include "light_kinds.h"
#include "lights.h"
#include "sum.h"
#include "point.h"
#include "layer_kinds.h"
#include "layer_inputs.h"
#include "layers.h"
#include "refraction.h"
#include "tone.h"

#endif
