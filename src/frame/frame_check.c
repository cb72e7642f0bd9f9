// frame_check.c: the ranges of a camera's and of the draw parameters' numbers.
#include "frame.h"

#include "environment_samples.h"
#include "fail.h"
#include "linear.h"

bool frame_camera_check(const lam_camera *camera, lam_error *error)
{
    if (!check_reserved("camera", camera, error))
        return false;
    if (!v3_finite(camera->eye) || !v3_finite(camera->target) || !v3_finite(camera->up))
        return fail(error, LAM_BAD_ARGUMENT, "camera: eye, target or up is not finite");
    if (v3_length(v3_sub(camera->eye, camera->target)) == 0)
        return fail(error, LAM_BAD_ARGUMENT, "camera: eye and target are the same point");
    double half = camera->ortho_half_height;
    if (!(half >= 0) || !math_finite(half))
        return fail(error, LAM_BAD_ARGUMENT, "camera: ortho_half_height is %g, expected a positive number or 0", half);
    if (half == 0 && !(camera->fovy_rad > 0 && camera->fovy_rad < PI))
        return fail(error, LAM_BAD_ARGUMENT, "camera: fovy is %g°, expected more than 0° and less than 180°",
                    math_degrees(camera->fovy_rad));
    double n = camera->near_plane, f = camera->far_plane;
    bool automatic = n == 0 && f == 0;
    if (!automatic && !(n < f && math_finite(n) && math_finite(f) && (half > 0 || n > 0)))
        return fail(error, LAM_BAD_ARGUMENT, "camera: near is %g and far is %g, expected %snear < far", n, f,
                    half > 0 ? "" : "0 < ");
    return true;
}

static bool edges_check(const lam_draw_params *params, lam_error *error)
{
    if (params->edges > LAM_EDGES_ALL || (unsigned)params->hidden_lines >= LAM_HIDDEN_LINES_COUNT)
        return fail(error, LAM_BAD_ARGUMENT, "draw parameters: edges or hidden_lines is out of its range");
    if (!(params->edge_angle_rad >= 0 && (double)params->edge_angle_rad <= PI + 1e-6))
        return fail(error, LAM_BAD_ARGUMENT, "edge_angle is %g°, expected 0° to 180°",
                    math_degrees((double)params->edge_angle_rad));
    for (int i = 0; i < 8; i++) {
        const lam_rgba *color = i < 4 ? &params->wireframe_color : &params->edge_color;
        float channel = (&color->r)[i % 4];
        if (!(channel >= 0 && channel <= (i % 4 == 3 ? 1 : 3e38f)))
            return fail(error, LAM_BAD_ARGUMENT, "%s_color: a channel is %g, expected a number of at least 0%s",
                        i < 4 ? "wireframe" : "edge", (double)channel, i % 4 == 3 ? " and at most 1" : "");
    }
    return true;
}

bool frame_params_check(const lam_draw_params *params, lam_error *error)
{
    if (!check_reserved("lam_draw_params", params, error))
        return false;
    int s = params->samples;
    if (s != 0 && s != 1 && s != 2 && s != 4 && s != 8 && s != 16)
        return fail(error, LAM_BAD_ARGUMENT, "samples is %d, expected 1, 2, 4, 8 or 16", s);
    const float *b = &params->background.r;
    for (int i = 0; i < 4; i++)
        if (!(b[i] >= 0 && b[i] <= 3e38f))
            return fail(error, LAM_BAD_ARGUMENT, "background: a channel is %g, expected a number of at least 0",
                        (double)b[i]);
    if (b[3] > 1)
        return fail(error, LAM_BAD_ARGUMENT, "background: alpha is %g, expected 0 to 1", (double)b[3]);
    if (!(params->exposure >= -100 && params->exposure <= 100))
        return fail(error, LAM_BAD_ARGUMENT, "exposure is %g, expected stops from -100 to 100", params->exposure);
    if ((unsigned)params->color > LAM_COLOR_RAW || (unsigned)params->rig > LAM_RIG_LECTURE ||
        (unsigned)params->shading > LAM_SHADING_FLAT || (unsigned)params->reflection >= LAM_REFLECTION_COUNT)
        return fail(error, LAM_BAD_ARGUMENT, "draw parameters: color, rig, shading or reflection is out of its range");
    if ((unsigned)params->stage > LAM_STAGE_FRAGMENT || (unsigned)params->viewer > LAM_VIEWER_INFINITE ||
        (unsigned)params->flat_normal > LAM_FLAT_NORMAL_VERTEX)
        return fail(error, LAM_BAD_ARGUMENT, "draw parameters: stage, viewer or flat_normal is out of its range");
    static const char *const names[] = {"line_width", "point_size", "wireframe_width", "edge_width"};
    const float sizes[] = {params->line_width, params->point_size, params->wireframe_width, params->edge_width};
    for (int i = 0; i < 4; i++)
        if (!(sizes[i] >= 0 && sizes[i] <= 1000))
            return fail(error, LAM_BAD_ARGUMENT, "%s is %g, expected pixels from 0 to 1000", names[i],
                        (double)sizes[i]);
    if (!edges_check(params, error))
        return false;
    if ((unsigned)params->occlusion >= LAM_OCCLUSION_COUNT)
        return fail(error, LAM_BAD_ARGUMENT, "draw parameters: occlusion %d is not one of lam_occlusion",
                    (int)params->occlusion);
    if ((unsigned)params->cavity >= LAM_CAVITY_COUNT)
        return fail(error, LAM_BAD_ARGUMENT, "draw parameters: cavity %d is not one of lam_cavity",
                    (int)params->cavity);
    if (params->cavity == LAM_CAVITY_ON && params->occlusion == LAM_OCCLUSION_RAYS)
        return fail(
            error, LAM_BAD_ARGUMENT,
            "cavity is found on the screen: it goes with the ambient occlusion 'screen' or 'off', not with 'rays'");
    if (!(params->occlusion_radius >= 0 && params->occlusion_radius <= 10))
        return fail(error, LAM_BAD_ARGUMENT, "occlusion_radius is %g, expected more than 0, up to 10",
                    (double)params->occlusion_radius);
    if (params->occlusion_samples < 0 || params->occlusion_samples > 1024)
        return fail(error, LAM_BAD_ARGUMENT, "occlusion_samples is %d, expected 0 to 1024", params->occlusion_samples);
    bool pixels = params->occlusion > LAM_OCCLUSION_OFF || params->cavity == LAM_CAVITY_ON;
    if (pixels && params->shading != LAM_SHADING_PHONG)
        return fail(error, LAM_BAD_ARGUMENT,
                    "ambient occlusion is found for pixels: it goes with Phong shading, not with %s",
                    params->shading == LAM_SHADING_FLAT ? "flat" : "Gouraud");
    if ((unsigned)params->ground >= LAM_GROUND_COUNT)
        return fail(error, LAM_BAD_ARGUMENT, "draw parameters: ground %d is not one of lam_ground",
                    (int)params->ground);
    const float *ground = &params->ground_color.r;
    for (int i = 0; i < 3; i++)
        if (!(ground[i] >= 0 && ground[i] <= 3e38f))
            return fail(error, LAM_BAD_ARGUMENT, "ground_color: a channel is %g, expected a number of at least 0",
                        (double)ground[i]);
    if (params->ground && params->shading != LAM_SHADING_PHONG)
        return fail(error, LAM_BAD_ARGUMENT,
                    "shadows on a ground are found for pixels: a ground goes with Phong shading, not with %s",
                    params->shading == LAM_SHADING_FLAT ? "flat" : "Gouraud");
    if (params->anisotropy < 0 || params->anisotropy > 16)
        return fail(error, LAM_BAD_ARGUMENT, "anisotropy is %d, expected 0 to 16", params->anisotropy);
    int n = params->reference;
    if (n != 0 && (n < ENVIRONMENT_SAMPLES_MIN || n > ENVIRONMENT_SAMPLES_MAX))
        return fail(error, LAM_BAD_ARGUMENT, "reference is %d, expected 0 or %d to %d directions", n,
                    ENVIRONMENT_SAMPLES_MIN, ENVIRONMENT_SAMPLES_MAX);
    if ((unsigned)params->tone >= LAM_TONE_COUNT)
        return fail(error, LAM_BAD_ARGUMENT, "draw parameters: tone %d is not one of lam_tone", (int)params->tone);
    if (!(params->light_cutoff >= -3e38f && params->light_cutoff <= 1))
        return fail(error, LAM_BAD_ARGUMENT, "light_cutoff is %g, expected at most 1", (double)params->light_cutoff);
    if (params->shadow_samples < 0 || params->shadow_samples > 256)
        return fail(error, LAM_BAD_ARGUMENT, "shadow_samples is %d, expected 0 to 256", params->shadow_samples);
    if ((unsigned)params->output >= LAM_OUTPUT_COUNT || params->output_light < 0)
        return fail(error, LAM_BAD_ARGUMENT, "draw parameters: output or output_light is out of its range");
    if (params->shading == LAM_SHADING_PHONG &&
        (params->stage == LAM_STAGE_APPLICATION || params->stage == LAM_STAGE_VERTEX))
        return fail(error, LAM_BAD_ARGUMENT,
                    "Phong shading lights every fragment: its stage is fragment; "
                    "application and vertex go with flat and Gouraud shading");
    if (params->shading == LAM_SHADING_GOURAUD && params->stage == LAM_STAGE_FRAGMENT)
        return fail(error, LAM_BAD_ARGUMENT,
                    "Gouraud shading lights every vertex: its stage is application or vertex; "
                    "fragment goes with flat and Phong shading");
    return true;
}
