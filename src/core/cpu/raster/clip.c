// clip.c: clips triangles that cross the near or far plane or leave the guard band, in homogeneous coordinates.
//
// Sutherland and Hodgman, "Reentrant polygon clipping", 1974. The intersection of an edge and a plane is always
// computed from the inner end towards the outer end. Two triangles that share the edge therefore contain the same
// point, bit for bit, and there is no gap between them.
#include "clip.h"

#include <string.h>

struct corner {
    float x, y, z, w; // pixels·w (y down), clip z, w
};

// Clipping a convex polygon with a plane adds at most one corner. If rounding has folded a thin polygon, clipping at
// most doubles the number of corners.
enum { PLANES = 6, CORNERS_MAX = 3 << PLANES };

// Returns the distance to a plane, multiplied by a positive number. The result is ≥ 0 inside. The near and far planes
// are tested first, so that w > 0 when the guard band is tested.
static float distance(const struct raster_frame *raster, const struct corner *c, int plane)
{
    float dx = c->x - 0.5f * (float)raster->frame->width * c->w;
    float dy = c->y - 0.5f * (float)raster->frame->height * c->w;
    switch (plane) {
    case 0:
        return c->z + c->w;
    case 1:
        return c->w - c->z;
    case 2:
        return raster->guard[0] * c->w + dx;
    case 3:
        return raster->guard[0] * c->w - dx;
    case 4:
        return raster->guard[1] * c->w + dy;
    default:
        return raster->guard[1] * c->w - dy;
    }
}

static int clip_polygon(const struct raster_frame *raster, struct corner polygon[CORNERS_MAX], int count)
{
    struct corner result[CORNERS_MAX];
    for (int plane = 0; plane < PLANES && count >= 3; plane++) {
        int kept = 0;
        for (int i = 0; i < count; i++) {
            const struct corner *a = &polygon[i], *b = &polygon[(i + 1) % count];
            float da = distance(raster, a, plane), db = distance(raster, b, plane);
            if (da >= 0)
                result[kept++] = *a;
            if ((da >= 0) != (db >= 0)) {
                const struct corner *in = da >= 0 ? a : b, *out = da >= 0 ? b : a;
                float inner = da >= 0 ? da : db, outer = da >= 0 ? db : da;
                float t = inner / (inner - outer);
                result[kept++] = (struct corner){in->x + t * (out->x - in->x), in->y + t * (out->y - in->y),
                                                 in->z + t * (out->z - in->z), in->w + t * (out->w - in->w)};
            }
        }
        memcpy(polygon, result, (size_t)kept * sizeof *result);
        count = kept;
    }
    return count;
}

static float row(const float m[4], const float *p) { return ((m[0] * p[0] + m[1] * p[1]) + m[2] * p[2]) + m[3]; }

// Bins one triangle of the clipped polygon's fan, if the triangle has an area and is not culled.
static void bin_clipped(const struct raster_frame *raster, struct thread_bins *bins, const struct frame_draw *draw,
                        const struct clipped_triangle *found)
{
    struct snapped corners;
    for (int k = 0; k < 3; k++) {
        corners.x[k] = snap(found->x[k]);
        corners.y[k] = snap(found->y[k]);
    }
    int64_t area = snapped_area(&corners);
    bool back = (area > 0) != draw->mirrored;
    if (area == 0 || (draw->cull == LAM_CULL_BACK && back) || (draw->cull == LAM_CULL_FRONT && !back))
        return;
    uint32_t number;
    struct clipped_triangle *triangle = new_clipped_triangle(raster, bins, &number);
    if (!triangle)
        return;
    *triangle = *found;
    triangle->back = back;
    bin_large(raster, bins, &corners, number | CLIPPED);
    bins->triangles_binned++;
}

void clip_triangle(const struct raster_frame *raster, struct thread_bins *bins, const struct frame_draw *draw,
                   uint32_t t, uint32_t id)
{
    const lam_mesh *mesh = draw->mesh;
    struct corner polygon[CORNERS_MAX];
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t corner = 3 * t + k;
        const float *p = mesh->positions + 3 * (size_t)(mesh->indices ? mesh->indices[corner] : corner);
        polygon[k] = (struct corner){row(draw->pixel[0], p), row(draw->pixel[1], p), row(draw->pixel[2], p),
                                     row(draw->pixel[3], p)};
    }
    int count = clip_polygon(raster, polygon, 3);
    struct clipped_triangle triangle = {.id = id};
    float x[CORNERS_MAX], y[CORNERS_MAX], key[CORNERS_MAX];
    for (int i = 0; i < count; i++) {
        // The operations are the same as in vertex_transform.inc, so that an unclipped corner snaps to the same point
        // in every triangle.
        float inverse = 1.0f / polygon[i].w;
        x[i] = polygon[i].x * inverse;
        y[i] = polygon[i].y * inverse;
        key[i] = raster->frame->orthographic ? 0.5f - 0.5f * (polygon[i].z * inverse) : inverse;
        float sum = inverse + x[i] + y[i] + key[i];
        if (!(inverse > 0) || sum - sum != 0)
            return; // the corner is in the plane of the eye, or beyond the range of floats
    }
    for (int i = 1; i + 1 < count; i++) {
        int fan[3] = {0, i, i + 1};
        for (int k = 0; k < 3; k++) {
            triangle.x[k] = x[fan[k]];
            triangle.y[k] = y[fan[k]];
            triangle.key[k] = key[fan[k]];
        }
        bin_clipped(raster, bins, draw, &triangle);
    }
}
