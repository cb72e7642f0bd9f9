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

void frame_edges_build(struct frame *frame, const lam_scene *scene, const lam_mat4 *view, const lam_mat4 *pixel)
{
    const lam_draw_params *settings = &frame->settings;
    bool of_model = settings->wireframe || settings->edges,
         annotates = settings->dimensions || settings->scale_bar || settings->axes || settings->grid;
    frame->draws_edges = (of_model || annotates) && settings->output == LAM_OUTPUT_PICTURE;
    if (!frame->draws_edges)
        return;
    lam_mat4 to_pixel = mat4_mul(pixel, view);
    const lam_rgba *back = &settings->background;
    float luminance = 0.2126f * back->r + 0.7152f * back->g + 0.0722f * back->b;
    float ink = back->a > 0.5f && luminance < DARK ? 1 : 0;
    frame->edges = (struct frame_edges){
        .min_cosine = math_cos(setting_number(settings, "edge_angle")),
        .width = {[EDGE_STYLE_GRID] = 1 + (frame->width < frame->height ? frame->width : frame->height) / 1024.0,
                  [EDGE_STYLE_WIREFRAME] = (double)settings->wireframe_width,
                  [EDGE_STYLE_FEATURE] = (double)settings->edge_width},
        .color = {[EDGE_STYLE_GRID] = {0.2f, 0.2f, 0.2f, 0.5f},
                  [EDGE_STYLE_WIREFRAME] = color_of(&settings->wireframe_color, settings),
                  [EDGE_STYLE_FEATURE] = color_of(&settings->edge_color, settings),
                  [EDGE_STYLE_HALO] = {1 - ink, 1 - ink, 1 - ink, 0.75f},
                  [EDGE_STYLE_INK] = {ink, ink, ink, 1},
                  [EDGE_STYLE_X] = {0.6f, 0.02f, 0.02f, 1},
                  [EDGE_STYLE_Y] = {0.02f, 0.3f, 0.02f, 1},
                  [EDGE_STYLE_Z] = {0.03f, 0.12f, 0.75f, 1}},
        .of_model = of_model,
        .up = scene->up == LAM_UP_Z ? 2 : 1,
        .unit_m = lam_scene_file_info(scene)->unit_m};
    frame->edges.has_box = annotates && lam_scene_bounds(scene, &frame->edges.low, &frame->edges.high);
    memcpy(frame->edges.pixel, to_pixel.m, sizeof frame->edges.pixel);
}
