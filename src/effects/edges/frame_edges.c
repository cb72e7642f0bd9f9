// frame_edges.c: selects the edges that a frame draws as lines, and their appearance.
#include "edges.h"

#include "linear.h"
#include "settings_check.h"

#include <string.h>

// If the background's luminance (Rec. 709) is below this value, and no surfaces are drawn, lines are white.
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

void frame_edges_build(struct frame *frame, const lam_mat4 *view, const lam_mat4 *pixel)
{
    const lam_draw_params *settings = &frame->settings;
    frame->draws_edges = (settings->wireframe || settings->edges) && settings->output == LAM_OUTPUT_PICTURE;
    if (!frame->draws_edges)
        return;
    lam_mat4 to_pixel = mat4_mul(pixel, view);
    frame->edges = (struct frame_edges){
        .min_cosine = math_cos(setting_number(settings, "edge_angle")),
        .width = {(double)settings->wireframe_width, (double)settings->edge_width},
        .color = {color_of(&settings->wireframe_color, settings), color_of(&settings->edge_color, settings)}};
    memcpy(frame->edges.pixel, to_pixel.m, sizeof frame->edges.pixel);
}
