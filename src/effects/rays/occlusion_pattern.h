// occlusion_pattern.h: the directions and lengths of the rays that compute ambient occlusion at a lit point.
//
// The points of a disc are projected up to the hemisphere (Malley's method), so that each direction contributes equally
// to the cosine-weighted integral. The points are on Vogel's spiral (1979), as for lights with a size
// (light_pattern.h). At each lit point, the disc is rotated by a different angle, so that visible steps become fine
// noise. A surface at the distance d occludes its direction by the share
//    w(d) = clamp((radius − d) / (OCCLUSION_FADING radius), 0, 1)
// The lengths of the rays are evenly distributed from (1 − OCCLUSION_FADING) radius to the radius, so w(d) is the
// fraction of rays that are longer than d. It therefore matters only whether a ray is blocked, not at which distance.
#ifndef OCCLUSION_PATTERN_H
#define OCCLUSION_PATTERN_H

#include <stdint.h>

// The fraction of the radius over which occlusion fades out.
#define OCCLUSION_FADING 0.4f

enum { OCCLUSION_RAYS_MAX = 1024, OCCLUSION_TURNS = 256 };

// Rays about +z; neighbours in the list have similar directions.
struct occlusion_pattern {
    int count;
    double x[OCCLUSION_RAYS_MAX], y[OCCLUSION_RAYS_MAX], z[OCCLUSION_RAYS_MAX]; // unit directions
    double length[OCCLUSION_RAYS_MAX]; // from 0 (the longest ray) to 1 (the shortest)
    // The cosines and sines of the angles that occlusion_turn selects.
    double cosine[OCCLUSION_TURNS], sine[OCCLUSION_TURNS];
};

// Returns the turn at a pixel: interleaved gradient noise (Jimenez 2014) computed in integers. The turns of
// neighbouring pixels differ as much as possible.
static inline uint32_t occlusion_turn(uint32_t x, uint32_t y)
{
    uint32_t part = x * 0x112e0be8u + y * 0x017e8cd9u;       // the fractional part of 0.06711056 x + 0.00583715 y
    return (uint32_t)((uint64_t)part * 3472289 >> 16) >> 24; // the fractional part of 52.9829189 · part
}

#endif
