// job_check.c: options of a picture that exclude one another.
#include "job_check.h"

#include <string.h>

#include "animate.h"
#include "console.h"

// Phong shading runs in the fragment stage, Gouraud shading in the vertex stage or the application, flat in any.
static bool check_stage(const struct options *o, lam_error *error)
{
    if (!o->has_shading || !o->draw.stage)
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
    const char *view = o->view            ? "view"
                       : o->has_azimuth   ? "azimuth"
                       : o->has_elevation ? "elevation"
                       : o->zoom > 0      ? "zoom"
                       : o->fov_deg > 0   ? "fov"
                       : o->projection    ? "projection"
                                          : NULL;
    if (o->camera && view)
        return complain(error, LAM_BAD_ARGUMENT, "options '--camera' and '--%s' cannot be used together", view);
    if (o->fov_deg > 0 && o->projection)
        return complain(
            error, LAM_BAD_ARGUMENT,
            "options '--fov' and '--projection orthographic' cannot be used together: parallel rays span no angle");
    if (o->two_sided && o->one_sided)
        return complain(error, LAM_BAD_ARGUMENT, "options '--two-sided' and '--one-sided' cannot be used together");
    if (!check_stage(o, error) || !animation_check(o, error))
        return false;
    if (o->quiet && o->verbose)
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
    } rows[] = {{"parametric", "the model 'parametric'", o->parametric && !parametric},
                {"implicit", "the model 'implicit'", o->implicit && !implicit},
                {"u", "--parametric", o->u_range && !parametric},
                {"v", "--parametric", o->v_range && !parametric},
                {"x", "--implicit", o->x_range && !implicit},
                {"y", "--implicit", o->y_range && !implicit},
                {"z", "--implicit", o->z_range && !implicit},
                {"flip", "--parametric and --implicit", o->flip && !parametric && !implicit}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (rows[i].stray)
            return complain(error, LAM_BAD_ARGUMENT, "option '--%s' belongs to %s", rows[i].name, rows[i].kind);
    return true;
}
