// frame_edges.c: which edges of surfaces a frame draws as lines, and how.
#include "frame.h"

#include "linear.h"

#include <string.h>

// Rec. 709 luminance of the background below which lines alone are white.
#define DARK 0.18f

static lam_rgba color_of(const lam_rgba *given, const lam_draw_params *params)
{
    if (given->r > 0 || given->g > 0 || given->b > 0 || given->a > 0)
        return *given;
    const lam_rgba *back = &params->background;
    float luminance = 0.2126f * back->r + 0.7152f * back->g + 0.0722f * back->b;
    float light = params->no_surfaces && back->a > 0.5f && luminance < DARK ? 1 : 0;
    return (lam_rgba){light, light, light, 1};
}

static double width_of(float given, double otherwise) { return given > 0 ? (double)given : otherwise; }

void frame_edges_build(struct frame *frame, const lam_draw_params *params, const lam_mat4 *view, const lam_mat4 *pixel)
{
    frame->draws_edges = (params->wireframe || params->edges) && frame->output == LAM_OUTPUT_PICTURE;
    if (!frame->draws_edges)
        return;
    double angle = params->edge_angle_rad > 0 ? (double)params->edge_angle_rad : math_radians(40);
    lam_mat4 to_pixel = mat4_mul(pixel, view);
    frame->edges = (struct frame_edges){
        .wireframe = params->wireframe,
        .features = params->edges,
        .hidden = params->hidden_lines,
        .min_cosine = math_cos(angle),
        .width = {width_of(params->wireframe_width, 1), width_of(params->edge_width, 1.5)},
        .color = {color_of(&params->wireframe_color, params), color_of(&params->edge_color, params)}};
    memcpy(frame->edges.pixel, to_pixel.m, sizeof frame->edges.pixel);
}
