// light_pattern.h: sample points on a light with a size, as targets for shadow rays.
//
// The points are on a disc perpendicular to the direction to the light. The disc also represents spherical lights. The
// points are on Vogel's spiral (1979), and each represents the same area of the disc: point i of N is at the radius
// √((i + ½)/N), at an angle of i times the golden angle. The points are the same for every lit point, so that the rays
// of neighbouring points are nearly parallel and visit the same part of the hierarchy.
//
// If N exceeds LIGHT_PROBES, LIGHT_PROBES probes are traced first. Probe i is at the radius √(i/(LIGHT_PROBES − 1)),
// and the probe at the rim is traced first. If the probes agree, the lit point is in full light or full shadow.
// Otherwise it is in a penumbra, and the N points are used. With fewer probes, thin objects could lie between the
// probes, and their faint shadows would have gaps.
#ifndef LIGHT_PATTERN_H
#define LIGHT_PATTERN_H

enum {
    LIGHT_POINTS_MAX = 256,
    LIGHT_PROBES = 48,
    CELL_PROBES = 128,
    COVER_GROUP = 32,
    COVER_GROUPS = 32,
    LIGHT_FEW = 32
};
enum { COVER_POINTS = COVER_GROUP * COVER_GROUPS };

struct light_points {
    int count;
    double x[LIGHT_POINTS_MAX], y[LIGHT_POINTS_MAX]; // positions on the disc of radius 1
};

struct light_pattern {
    struct light_points probes, all; // probes.count is 0 if there are no probes
    struct light_points few;         // for surfaces at grazing angles
    // x and y of points, for the coverage by few triangles. Each COVER_GROUP points are near each other: in `group`, x, y
    // and radius of a circle around them.
    _Alignas(64) float cover[2][COVER_POINTS], group[3][COVER_GROUPS];
    struct light_points cell; // CELL_PROBES points, for the first rays of a cell of pixels (penumbra.h)
};

#endif
