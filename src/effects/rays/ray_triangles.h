// ray_triangles.h: computes the corners of a frame's triangles, with two coordinates per vector register.
#ifndef RAY_TRIANGLES_H
#define RAY_TRIANGLES_H

#ifndef LANES
#define LANES 4
#endif
#include "double_lanes.h"

#include "builder.h"

// The second number of z is unused.
struct point {
    dnum xy, z;
};

// The draw of the previous triangle, and its matrix in column-major order; initially zero.
struct placement {
    const struct frame_draw *draw;
    uint32_t first, end; // the range of its triangles in the frame
    struct point column[4];
};

LANE_FN void store_point(struct point p, double to[3])
{
    dnum_store(to, p.xy);
    to[2] = p.z[0];
}

LANE_FN void store_floats(float to[4], dnum xy, dnum z)
{
    dnum_store_float(to, xy);
    dnum_store_float(to + 2, z);
}

static __attribute__((noinline, unused)) void place_draw(struct placement *place, const struct frame *frame,
                                                         uint32_t number)
{
    int low = 0, high = frame->draw_count - 1;
    while (low < high) {
        int middle = (low + high + 1) / 2;
        if (frame->draws[middle].first_id <= number)
            low = middle;
        else
            high = middle - 1;
    }
    const struct frame_draw *draw = &frame->draws[low];
    *place = (struct placement){.draw = draw, .first = draw->first_id};
    place->end = draw->first_id + draw->mesh->triangle_count;
    for (int i = 0; i < 4; i++) {
        place->column[i].xy = (dnum){draw->world[0][i], draw->world[1][i]};
        place->column[i].z = (dnum){draw->world[2][i], 0};
    }
}

// Computes the corners of a triangle in world space, bit-identical to ray_corners. Returns false if rays must ignore
// the triangle: its corners are not finite, or the triangle is part of a line or point. Lines and points face the eye
// and cast no shadows.
LANE_FN bool world_corners(const struct frame *frame, uint32_t number, struct placement *place, struct point p[3])
{
    if (number - place->first >= place->end - place->first)
        place_draw(place, frame, number);
    const struct point *column = place->column;
    const lam_mesh *mesh = place->draw->mesh;
    struct point sum = {dnum_of(0), dnum_of(0)}; // 0 if all terms are finite
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t corner = 3 * (number - place->first) + k;
        const float *from = mesh->positions + 3 * (size_t)(mesh->indices ? mesh->indices[corner] : corner);
        double x = (double)from[0], y = (double)from[1], z = (double)from[2];
        p[k].xy = ((column[0].xy * x + column[1].xy * y) + column[2].xy * z) + column[3].xy;
        p[k].z = ((column[0].z * x + column[1].z * y) + column[2].z * z) + column[3].z;
        sum.xy += p[k].xy * 0.0;
        sum.z += p[k].z * 0.0;
    }
    return (sum.xy[0] + sum.xy[1]) + sum.z[0] == 0 && frame_draw_casts(place->draw);
}

// Computes the corners in the hierarchy's space. Returns false if rays must ignore the triangle.
LANE_FN bool ray_space_corners(const struct builder *b, uint32_t number, struct placement *place, struct point p[3])
{
    const double *centre = b->hierarchy->centre, scale = b->hierarchy->scale;
    bool met = world_corners(b->frame, number, place, p) && !place->draw->clear;
    for (int k = 0; k < 3; k++) {
        p[k].xy = (p[k].xy - (dnum){centre[0], centre[1]}) * scale;
        p[k].z = (p[k].z - centre[2]) * scale;
    }
    return met;
}

// Stores the box of a triangle, rounded to the nearest floats; ray_lanes.h allows for the rounding.
LANE_FN void store_box(struct primitive *to, const struct point p[3])
{
    store_floats(to->low, dmin_of(dmin_of(p[0].xy, p[1].xy), p[2].xy), dmin_of(dmin_of(p[0].z, p[1].z), p[2].z));
    store_floats(to->high, dmax_of(dmax_of(p[0].xy, p[1].xy), p[2].xy), dmax_of(dmax_of(p[0].z, p[1].z), p[2].z));
}

#endif
