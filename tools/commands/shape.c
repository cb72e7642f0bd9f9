// shape.c: the command `shape`: draws or saves a built-in shape or a surface defined by formulas.
#include "command.h"

#include <stdio.h>
#include <string.h>

#include "console.h"
#include "job.h"
#include "output.h"
#include "page.h"
#include "report.h"

static bool is_model_file(const char *output)
{
    const char *dot = output ? strrchr(output, '.') : NULL;
    for (int i = 0; dot && dot != output && lam_mesh_format(i); i++)
        if (strcmp(dot + 1, lam_mesh_format(i)) == 0)
            return true;
    return false;
}

// Adds the model formats to the error about an extension that is not a picture format.
static bool check_ending(const char *output, lam_error *error)
{
    lam_pixel_format format;
    if (!output_is_named(output) || is_model_file(output) || page_is_named(output) ||
        output_format(output, &format, error))
        return true;
    size_t used = strlen(error->text);
    snprintf(error->text + used, sizeof error->text - used, "; a model file is .obj, .stl or .ply");
    return false;
}

// A model file stores no lights, camera or pixels, so options for them are rejected.
static bool check_options(const struct options *o, lam_error *error)
{
    static const char *const others[] = {"output", "segments", "up", "normals", "crease-angle", "durable"};
    for (int i = 0; option_table[i].name; i++) {
        enum option_group group = option_table[i].group;
        bool fits = group == GROUP_SHAPE || group == GROUP_ABOUT || group == GROUP_SETTINGS || group == GROUP_WORK ||
                    group == GROUP_LIMITS || group == GROUP_REPORT;
        for (size_t k = 0; k < sizeof others / sizeof *others; k++)
            fits |= strcmp(option_table[i].name, others[k]) == 0;
        if (o->given[i] && !fits)
            return complain(error, LAM_BAD_ARGUMENT, "shape: option '--%s' changes nothing in a model file, %s",
                            option_table[i].name, o->picture.output);
    }
    return true;
}

static bool save(const char *model, const struct options *o, lam_error *error)
{
    struct job job = {.options = o, .model = model};
    struct progress progress = {0};
    job.times.start = clock_ms();
    bool ok = check_options(o, error) && job_load(&job, &progress, error);
    const lam_mesh *mesh = ok ? lam_scene_mesh(job.scene, 0) : NULL;
    ok = ok && lam_mesh_save(mesh, o->picture.output, lam_scene_up(job.scene), error);
    if (ok && !o->report.quiet)
        fprintf(stderr, "%s: %u triangles, %u vertices\n", o->picture.output, (unsigned)mesh->triangle_count,
                (unsigned)mesh->vertex_count);
    job_free(&job);
    return ok;
}

int run_shape(int operand_count, char **operands, const struct options *options)
{
    lam_error error = {0};
    char parametric[] = "parametric", implicit[] = "implicit";
    char *formula[] = {options->shape.implicit ? implicit : options->shape.parametric ? parametric : NULL};
    bool ok = true;
    if (options->shape.parametric && options->shape.implicit)
        ok = complain(&error, LAM_BAD_ARGUMENT, "shape: found --parametric and --implicit, expected one of them");
    else if (operand_count && *formula)
        ok = complain(&error, LAM_BAD_ARGUMENT, "shape: found '%s' and --%s, expected one of them", operands[0],
                      *formula);
    else if (!operand_count && !*formula)
        ok = complain(&error, LAM_BAD_ARGUMENT,
                      "shape: expected the name of a built-in shape (`lambent shapes` lists them), --parametric "
                      "'x=...; y=...; z=...' or --implicit 'x^2+y^2+z^2-1'");
    else if (!*formula && lam_shape_find(operands[0]) < 0)
        ok = complain(&error, LAM_BAD_ARGUMENT,
                      "shape: no built-in shape has the name '%s'; `lambent shapes` lists them", operands[0]);
    ok = ok && job_check_formula(*formula ? *formula : operands[0], options, &error) &&
         check_ending(options->picture.output, &error);
    char **models = *formula ? formula : operands;
    if (ok && !is_model_file(options->picture.output))
        return run_render(1, models, options);
    if (ok && save(models[0], options, &error))
        return 0;
    return report_failure(&error, options);
}
