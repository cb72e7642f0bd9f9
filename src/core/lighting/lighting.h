// lighting.h: the equations in C. Define LANES as 1, 4, 8 or 16 before including this file (src/core/base/math/lanes.h).
//
// In GLSL, prelude.glsl and the files of the equations are concatenated in this order.
#ifndef LIGHTING_H
#define LIGHTING_H

#include "prelude_c.h"

#include <lambent/device.h>
#include <lambent/material.h>

#include "surface.h"
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

// LANES points of a material, for sums of light from many directions.
STRUCT(physical_point)
{
    surface s;
    lobe_parameters m;
    fresnel f; // used without layers
    vec3 kd;
    int model;       // the reflection model
    int layers;      // LAYER_…; 0 for a material without layers
    layered layered; // used with layers
};

// LANES points of a material, for paths of light (src/effects/paths).
STRUCT(lit_point)
{
    physical_point base;
    vec3 ks;                // the highlights' colour, before the Fresnel factor
    num matt;               // factors of the diffuse light after lobes and colours: of the metalness,
    vec3 diffuse, specular; // of vertex colours and maps
    vec3 emission;          // light that the surface emits towards the eye
    vec3 mirrored;          // kr of a classic material that mirrors
    vec3 through;           // share of the light that passes through the surface, without the volume behind it
    vec3 absorbed;          // log2 of the volume's colour after a path of length 1
    num ior;
    bool unlit;  // emits only
    bool volume; // light that passes is refracted
    bool inside; // the surface is seen from within the volume
};

#endif
