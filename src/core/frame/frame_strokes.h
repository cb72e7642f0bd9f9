// frame_strokes.h: converts lines and points to polygons that face the eye, so that devices draw only triangles.
//
// A line becomes a rectangle in the window. Each end of the line becomes two corners, one on each side of the line, at
// the depth of the end. A point becomes a square or, if the difference is visible, a regular polygon of 8 or 16
// corners. These polygons are planar in space and in the window, so depth and attributes change along a line in the
// same way as along the edge of a triangle. Each polygon is drawn nearer to the eye by the polygon's width. Otherwise,
// a slanted surface would hide half of a line on the surface. Lines have no caps at their ends, even if several lines
// meet.
#ifndef FRAME_STROKES_H
#define FRAME_STROKES_H

#include "frame.h"

struct stroke_view {
    // world to eye space; eye to clip space; eye space to pixels (frame_draw.pixel)
    const lam_mat4 *view, *projection, *pixel;
    double near_plane;
    bool orthographic;
    double line_width, point_size; // pixels
    size_t point_corners;          // corners of a point's polygon
};

// Sets the width of lines and the size of points from the settings. If no size is set, the size of points grows with
// the picture and shrinks with the number of points. The minimum is 3 pixels, or 8 pixels for fewer than 100 points.
void frame_strokes_size(struct stroke_view *view, const struct lam_scene *scene, const struct frame *frame);

// Returns the number of triangles per line or point of a mesh.
size_t stroke_triangles(const lam_mesh *mesh, size_t point_corners);

// Moves a near plane that was fitted to the scene towards the eye, so that the plane does not clip lines and points,
// which can extend nearer to the eye than their vertices. `pixel` is a pixel's height in eye space at w = 1.
void frame_strokes_near(const struct lam_scene *scene, const struct stroke_view *view, double pixel,
                        double *near_plane);

// Reserves memory for the polygons of all lines and points of a scene.
bool frame_strokes_reserve(struct frame *frame, const struct lam_scene *scene, const struct stroke_view *view,
                           struct call_control *call, lam_error *error);

// Replaces the lines or points of a draw's mesh with polygons of stroke_triangles triangles each, in the same order.
// Polygons that are nearer than the near plane have no area.
void frame_strokes_build(struct frame *frame, struct frame_draw *draw, const lam_mat4 *transform,
                         const struct stroke_view *view);

#endif
