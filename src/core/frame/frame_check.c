// frame_check.c: checks the ranges of the numbers in cameras and draw parameters.
#include "frame.h"

#include "fail.h"
#include "linear.h"
#include "rays.h"
#include "settings_check.h"

bool frame_camera_check(const lam_camera *camera, lam_error *error)
{
    if (!check_reserved("camera", camera, error))
        return false;
    if (!v3_finite(camera->eye) || !v3_finite(camera->target) || !v3_finite(camera->up))
        return fail(error, LAM_BAD_ARGUMENT, "camera: eye, target or up is not finite");
    const double distance = v3_length(v3_sub(camera->eye, camera->target)),
                 farthest = 5e33; // times 65535 pixels, this is a float
    if (distance == 0)
        return fail(error, LAM_BAD_ARGUMENT, "camera: eye and target are the same point");
    if (!(distance <= farthest))
        return fail(error, LAM_UNSUPPORTED,
                    "camera: the eye is %g units from its target, expected at most %g; a larger model cannot be drawn",
                    distance, farthest);
    double half = camera->ortho_half_height;
    if (!(half >= 0) || !math_finite(half))
        return fail(error, LAM_BAD_ARGUMENT, "camera: ortho_half_height is %g, expected a positive number or 0", half);
    if (!(camera->fx >= 0) || !math_finite(camera->fx))
        return fail(error, LAM_BAD_ARGUMENT, "camera: fx is %g, expected a positive number or 0", camera->fx);
    if (camera->fx > 0 && half > 0)
        return fail(error, LAM_BAD_ARGUMENT, "camera: both fx and ortho_half_height are set, expected only one");
    if (camera->fx > 0 && !(camera->fy > 0 && math_finite(camera->fy)))
        return fail(error, LAM_BAD_ARGUMENT, "camera: fy is %g, expected a positive number", camera->fy);
    if (camera->fx > 0 && !(math_finite(camera->cx) && math_finite(camera->cy)))
        return fail(error, LAM_BAD_ARGUMENT, "camera: cx or cy is not finite");
    if (camera->width < 0 || camera->height < 0 || !camera->width != !camera->height)
        return fail(error, LAM_BAD_ARGUMENT, "camera: the size of its pictures is %d x %d, expected both above 0 or 0",
                    camera->width, camera->height);
    if (half == 0 && camera->fx == 0 && !(camera->fovy_rad > 0 && camera->fovy_rad < PI))
        return fail(error, LAM_BAD_ARGUMENT, "camera: fovy is %g°, expected more than 0° and less than 180°",
                    math_degrees(camera->fovy_rad));
    double n = camera->near_plane, f = camera->far_plane;
    bool automatic = n == 0 && f == 0;
    if (!automatic && !(n < f && math_finite(n) && math_finite(f) && (half > 0 || n > 0)))
        return fail(error, LAM_BAD_ARGUMENT, "camera: near is %g and far is %g, expected %snear < far", n, f,
                    half > 0 ? "" : "0 < ");
    return true;
}

// Checks the members that are not in the table of settings.
static bool others_check(const lam_draw_params *params, lam_error *error)
{
    int s = params->samples;
    if (s != 0 && s != 1 && s != 2 && s != 4 && s != 8 && s != 16)
        return fail(error, LAM_BAD_ARGUMENT, "samples is %d, expected 1, 2, 4, 8 or 16", s);
    float alpha = params->background.a;
    if (!channels_check("background", &params->background.r, 3, error))
        return false;
    if (!(alpha >= 0 && alpha <= 3e38f))
        return fail(error, LAM_BAD_ARGUMENT, "background: a channel is %g, expected a number of at least 0",
                    (double)alpha);
    if (alpha > 1)
        return fail(error, LAM_BAD_ARGUMENT, "background: alpha is %g, expected 0 to 1", (double)alpha);
    if (!(params->exposure >= -100 && params->exposure <= 100))
        return fail(error, LAM_BAD_ARGUMENT, "exposure is %g, expected stops from -100 to 100", params->exposure);
    if ((unsigned)params->color > LAM_COLOR_RAW || (unsigned)params->rig > LAM_RIG_LECTURE)
        return fail(error, LAM_BAD_ARGUMENT, "draw parameters: color, rig, shading or reflection is out of range");
    if ((unsigned)params->tone >= LAM_TONE_COUNT)
        return fail(error, LAM_BAD_ARGUMENT, "draw parameters: tone %d is not one of lam_tone", (int)params->tone);
    if ((unsigned)params->output >= LAM_OUTPUT_COUNT || params->output_light < 0)
        return fail(error, LAM_BAD_ARGUMENT, "draw parameters: output or output_light is out of range");
    return true;
}

// Checks combinations of settings.
static bool rules_check(const lam_draw_params *params, lam_error *error)
{
    if (params->cavity == LAM_CAVITY_ON && params->occlusion == LAM_OCCLUSION_RAYS)
        return fail(error, LAM_BAD_ARGUMENT,
                    "cavity shading is computed from screen depths: it needs the ambient occlusion 'screen' or 'off', "
                    "not 'rays'");
    const char *shading = params->shading == LAM_SHADING_FLAT ? "flat" : "Gouraud";
    if (params->bounces && params->shading != LAM_SHADING_PHONG)
        return fail(error, LAM_BAD_ARGUMENT, "paths of light begin at each pixel: bounces needs Phong shading, not %s",
                    shading);
    if (params->bounces && params->gl1)
        return fail(error, LAM_BAD_ARGUMENT,
                    "gl1 clamps the light of each surface, so it cannot be combined with bounces");
    bool pixels = params->occlusion > LAM_OCCLUSION_OFF || params->cavity == LAM_CAVITY_ON;
    if (pixels && params->shading != LAM_SHADING_PHONG)
        return fail(error, LAM_BAD_ARGUMENT, "%s is computed for each pixel: it needs Phong shading, not %s",
                    params->occlusion > LAM_OCCLUSION_OFF ? "ambient occlusion" : "the cavity", shading);
    if (params->specular_aa == LAM_SPECULAR_AA_ON && params->shading != LAM_SHADING_PHONG)
        return fail(error, LAM_BAD_ARGUMENT,
                    "specular antialiasing widens highlights at each pixel: it needs Phong shading, not %s", shading);
    if (params->ground && params->shading != LAM_SHADING_PHONG)
        return fail(error, LAM_BAD_ARGUMENT,
                    "the shadow on a ground is computed for each pixel: a ground needs Phong shading, not %s", shading);
    if (params->shading == LAM_SHADING_PHONG &&
        (params->stage == LAM_STAGE_APPLICATION || params->stage == LAM_STAGE_VERTEX))
        return fail(error, LAM_BAD_ARGUMENT,
                    "Phong shading lights every fragment: its stage is fragment; "
                    "application and vertex work with flat and Gouraud shading");
    if (params->shading == LAM_SHADING_GOURAUD && params->stage == LAM_STAGE_FRAGMENT)
        return fail(error, LAM_BAD_ARGUMENT,
                    "Gouraud shading lights every vertex: its stage is application or vertex; "
                    "fragment works with flat and Phong shading");
    return true;
}

// In a build without effects, checks that none is asked for.
static bool effects_check(const lam_draw_params *params, lam_error *error)
{
    const char *wanted = params->bounces                      ? "light between surfaces"
                         : params->shadows                    ? "shadows"
                         : params->ground                     ? "the shadow on a ground"
                         : params->edges || params->wireframe ? "edges"
                         : params->dimensions || params->scale_bar || params->axes || params->grid ? "annotations"
                         : params->cavity == LAM_CAVITY_ON                                         ? "cavity shading"
                         : params->occlusion > LAM_OCCLUSION_OFF || params->output == LAM_OUTPUT_AMBIENT_OCCLUSION
                             ? "ambient occlusion"
                             : NULL;
    return ray_kernels_of(1) || !wanted ||
           fail(error, LAM_UNSUPPORTED,
                "this build of lambent cannot draw %s: its effects were left out (-Deffects=false)", wanted);
}

bool frame_params_check(const lam_draw_params *params, lam_error *error)
{
    return check_reserved("lam_draw_params", params, error) && others_check(params, error) &&
           settings_check(params, error) && rules_check(params, error) && effects_check(params, error);
}
