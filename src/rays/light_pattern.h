// light_pattern.h: sample points on a light with a size, at which shadow rays aim.
//
// The points lie on a disc across the way to the light: a ball looks like its disc. They follow the spiral of Vogel (1979),
// each with an equal share of the disc: point i of N at the radius √((i + ½)/N), turned by i golden angles. They are the same for
// every lit point, so that the rays of neighbours are nearly parallel and visit the same part of the hierarchy.
//
// If N is above LIGHT_PROBES, that many points are tried first: point i of them at the radius √(i/(LIGHT_PROBES − 1)), from the rim
// inwards. If they agree, the point lies in full light or in full shadow; if not, in a penumbra, and the N points decide.
// With fewer probes, thin stems between the probes leave patches without their faint shadow.
#ifndef LIGHT_PATTERN_H
#define LIGHT_PATTERN_H

enum { LIGHT_POINTS_MAX = 256, LIGHT_PROBES = 48 };

struct light_points {
    int count;
    double x[LIGHT_POINTS_MAX], y[LIGHT_POINTS_MAX]; // on the disc of radius 1
};

struct light_pattern {
    struct light_points probes, all; // probes.count 0: all points are tried at once
};

// `count`: N, 1 … LIGHT_POINTS_MAX.
void light_pattern_fill(struct light_pattern *pattern, int count);

#endif
