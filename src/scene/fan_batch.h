// fan_batch.h: the normals at many positions at a time.
//
// Positions where few corners of ordinary triangles meet, as nearly all do, are gathered until there are
// enough of them, and worked out side by side (fan_lanes.h). The others are left to normals_fan.h, one by
// one. The bits are the same either way.
#ifndef FAN_BATCH_H
#define FAN_BATCH_H

#include "fan_lanes.h"

#include <lambent/mesh.h>

#include <stdbool.h>

enum { FAN_FEW = 24 }; // corners at a position, at most

struct fan_place {
    uint16_t first, count; // of its corners
    bool done;             // false: normals_fan.h is needed
};

struct fan_batch {
    uint32_t count, places, fans;
    struct fan_place place[FAN_CORNERS];
    uint32_t corner[FAN_CORNERS];
    uint16_t fan[FAN_CORNERS]; // of each corner, numbered through the batch
    uint32_t group[FAN_CORNERS];
    uint32_t vertex[3][FAN_CORNERS]; // of the corner, the triangle's next one and the one before
    struct fan_corners corners;
    struct fan_sums sums; // of the fans
};

void fan_batch_start(struct fan_batch *batch);

// Adds a position with its corners, ascending. False, and nothing is done: there is no room; make and empty
// the batch first. 0 < count ≤ FAN_FEW.
bool fan_batch_add(struct fan_batch *batch, const uint32_t *corners, uint32_t count);

// Works out what was added. Of a place that is done, corner i has the fan batch->fan[i], whose normal is
// batch->sums.unit[0…2][fan].
void fan_batch_make(struct fan_batch *batch, const lam_mesh *mesh, double least_cosine,
                    const struct fan_lanes *lanes);

void fan_batch_empty(struct fan_batch *batch);

#endif
