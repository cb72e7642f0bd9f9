// frame_strokes.h: converts lines and points to polygons that face the eye, so that devices draw only triangles.
//
// A line becomes the rectangle around its picture: its ends, moved to both sides at right angles to it in the window, each at its own
// depth. A point becomes a square or, if that can be seen, a regular polygon of 8 or 16 corners. Both are planar in space and in the window, so depth and attributes run along a line as
// they do along the edge of a triangle. Each is drawn nearer to the eye than its vertices, by its own width. Otherwise
// a slanted surface would hide half of a line on it. Line ends are cut off without caps, also where lines meet.
#ifndef FRAME_STROKES_H
#define FRAME_STROKES_H

#include "frame.h"

struct stroke_view {
    const lam_mat4 *view, *projection, *pixel; // world to eye; eye to clip space; eye to pixels (frame_draw.pixel)
    double near_plane;
    bool orthographic;
    double line_width, point_size; // pixels
    size_t point_corners;          // of the polygon that a point becomes
};

// Sets the width of lines and the size of points from the settings. Without a size, points get larger the fewer there are
// and the larger the picture is: 3 pixels or more, and at least 8 if there are fewer than 100.
void frame_strokes_size(struct stroke_view *view, const struct lam_scene *scene, const struct frame *frame);

// The triangles of each item of a mesh of lines or points.
size_t stroke_triangles(const lam_mesh *mesh, size_t point_corners);

// Moves a near plane that was fitted to the scene so far forward that it cuts off no line or point, which lie nearer than
// their vertices.
void frame_strokes_near(const struct lam_scene *scene, const lam_camera *camera, const struct stroke_view *view,
                        int height, double *near_plane);

// Reserves memory for all lines and points of a scene, and starts with none.
bool frame_strokes_reserve(struct frame *frame, const struct lam_scene *scene, const struct stroke_view *view,
                           struct call_control *call, lam_error *error);

// Replaces the mesh of a draw, one of lines or points, by their polygons: stroke_triangles for each, in order. One that is
// before the near plane has no area.
void frame_strokes_build(struct frame *frame, struct frame_draw *draw, const lam_mat4 *transform,
                         const struct stroke_view *view);

#endif
