// brute_force.h: a scene of parallelograms, and its light by paths in double precision that sample no light and no lobe. Every
// path continues in a direction of the cosine, and lamps are summed.
#ifndef BRUTE_FORCE_H
#define BRUTE_FORCE_H

#include <lambent/lambent.h>

#include "layered_textbook.h"

enum { SIZE = 24, TEXELS = 8, SURFACES = 24, LAMPS = 128 }; // SIZE: pixels per side of a picture

struct board {
    vector corner, along, up; // the corners are corner, corner + along, corner + up and the fourth one
    int material;
};

// The maps are pictures of 8×8 texels, which are not filtered.
struct paint {
    lam_material m;
    const uint8_t (*color)[4], (*rough)[4], (*glow)[4]; // base colour and opacity; roughness and metalness; emission
};

struct world {
    struct board boards[SURFACES];
    struct paint paints[8];
    lam_light lamps[LAMPS];
    int board_count, lamp_count, bounces;
    double sky, gradient; // ambient light; the part of the environment's light that grows with y
    uint8_t texels[3][TEXELS * TEXELS][4];
    uint64_t random;
};

static const vector eye = {0.3, 1.7, 4.6}, target = {0, 1.1, 0};
#define FOVY_RAD 0.7

// The light of the sky and of the environment from a direction.
void sky_light(const struct world *w, vector toward, double out[3]);

// Adds the light of one path that begins in a pixel.
void add_sample(struct world *w, int x, int y, double light[3]);

#endif
