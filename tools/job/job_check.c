// job_check.c: checks picture options that exclude each other.
#include "animate_frame.h"
#include "console.h"
#include "job.h"

#include <string.h>
#include <sys/stat.h>

// Phong shading needs the fragment stage. Gouraud shading needs the vertex stage or the application stage. Flat shading
// works in any stage.
static bool check_stage(const struct options *o, lam_error *error)
{
    if (!o->shading.has_shading || !o->draw.stage)
        return true;
    if (o->draw.shading == LAM_SHADING_PHONG && o->draw.stage != LAM_STAGE_FRAGMENT)
        return complain(error, LAM_BAD_ARGUMENT,
                        "phong shading cannot be evaluated in stage %s; phong works with fragment, gouraud with "
                        "application or vertex, flat with all three",
                        o->draw.stage == LAM_STAGE_VERTEX ? "vertex" : "application");
    if (o->draw.shading == LAM_SHADING_GOURAUD && o->draw.stage == LAM_STAGE_FRAGMENT)
        return complain(error, LAM_BAD_ARGUMENT,
                        "gouraud shading cannot be evaluated in stage fragment; gouraud works with application or "
                        "vertex, phong with fragment, flat with all three");
    return true;
}

bool job_check_options(const struct options *o, lam_error *error)
{
    const char *view = o->view.side            ? "view"
                       : o->view.has_azimuth   ? "azimuth"
                       : o->view.has_elevation ? "elevation"
                       : o->view.zoom > 0      ? "zoom"
                       : o->view.fov_deg > 0   ? "fov"
                       : o->view.projection    ? "projection"
                                               : NULL;
    if (o->view.camera && view)
        return complain(error, LAM_BAD_ARGUMENT, "options '--camera' and '--%s' cannot be used together", view);
    if (o->view.fov_deg > 0 && o->view.projection)
        return complain(
            error, LAM_BAD_ARGUMENT,
            "options '--fov' and '--projection orthographic' cannot be used together: parallel rays span no angle");
    if (o->shading.two_sided && o->shading.one_sided)
        return complain(error, LAM_BAD_ARGUMENT, "options '--two-sided' and '--one-sided' cannot be used together");
    if (!check_stage(o, error) || !animation_check(o, error))
        return false;
    if (o->report.quiet && o->report.verbose)
        return complain(error, LAM_BAD_ARGUMENT, "options '--quiet' and '--verbose' cannot be used together");
    return true;
}

bool job_model_is_shape(const char *model)
{
    return lam_shape_find(model) >= 0 || strcmp(model, "parametric") == 0 || strcmp(model, "implicit") == 0;
}

bool job_check_formula(const char *model, const struct options *o, lam_error *error)
{
    const bool parametric = strcmp(model, "parametric") == 0, implicit = strcmp(model, "implicit") == 0;
    const struct {
        const char *name, *kind;
        bool stray;
    } rows[] = {{"parametric", "the model 'parametric'", o->shape.parametric && !parametric},
                {"implicit", "the model 'implicit'", o->shape.implicit && !implicit},
                {"u", "--parametric", o->shape.u_range && !parametric},
                {"v", "--parametric", o->shape.v_range && !parametric},
                {"x", "--implicit", o->shape.x_range && !implicit},
                {"y", "--implicit", o->shape.y_range && !implicit},
                {"z", "--implicit", o->shape.z_range && !implicit},
                {"flip", "--parametric and --implicit", o->shading.flip && !parametric && !implicit}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (rows[i].stray)
            return complain(error, LAM_BAD_ARGUMENT, "option '--%s' belongs to %s", rows[i].name, rows[i].kind);
    return true;
}
