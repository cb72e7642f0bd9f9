// job.c: the steps that turn a model into a picture.
#include "job_steps.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <lambent/explain.h>
#include <lambent/render.h>

#include "animate_frame.h"
#include "console.h"
#include "environment_apply.h"
#include "environment_option.h"
#include "job.h"
#include "light_markers.h"
#include "limit_options.h"
#include "output.h"
#include "scene_settings.h"
#include "show_all.h"
#include "show_option.h"

const char *model_counts_text(const struct model_counts *counts, char out[MODEL_COUNTS_SIZE])
{
    const uint64_t numbers[] = {counts->triangles, counts->lines, counts->points};
    static const char *const names[] = {"triangle", "line", "point"};
    size_t length = 0;
    for (int i = 0; i < 3; i++)
        if (numbers[i] || (i == 0 && !counts->lines && !counts->points))
            length += (size_t)snprintf(out + length, MODEL_COUNTS_SIZE - length, "%s%" PRIu64 " %s%s",
                                       length ? ", " : "", numbers[i], names[i], numbers[i] == 1 ? "" : "s");
    return out;
}

// Returns whether an option determines how a model with its own lights is lit.
static bool lit_by_options(const struct options *o)
{
    const struct lighting_options *l = &o->lighting;
    return (l->has_rig && l->rig != (int)LAM_RIG_AUTO) || l->has_light_scale || l->lights.count ||
           environment_option_is_none(o->shading.environment);
}

// Removes the dim studio of an earlier picture, so that each view is identical to the same view drawn alone.
static bool remove_fill(struct job *job, lam_error *error)
{
    bool ok = !job->unfilled || lam_scene_set_environment(job->scene, NULL, 0, error);
    for (int i = 0; ok && job->unfilled && i < lam_scene_light_count(job->scene); i++)
        ok = lam_scene_set_light(job->scene, i, &job->unfilled[i], error);
    free(job->unfilled);
    job->unfilled = NULL;
    return ok;
}

// Adds a dim studio if a file's own lights leave much of the picture black.
static bool fill_darkness(struct job *job, lam_draw_params *draw, int width, int height, lam_error *error)
{
    lam_control control;
    int count = lam_scene_light_count(job->scene);
    job->unfilled = malloc((size_t)count * sizeof *job->unfilled);
    if (!job->unfilled)
        return complain(error, LAM_MACHINE, "out of memory");
    for (int i = 0; i < count; i++)
        job->unfilled[i] = *lam_scene_light(job->scene, i);
    if (!job_control(job, NULL, &control, error) ||
        !lam_studio_fill(job->device, job->scene, &job->camera, draw, width, height, &control, &job->fill_scale, error))
        return false;
    if (job->fill_scale > 0) {
        job->studio = true;
    } else {
        free(job->unfilled);
        job->unfilled = NULL;
    }
    return true;
}

// Computes an automatic exposure. The effect of a weak light depends on the exposure, so no light is skipped.
static bool fit_exposure(struct job *job, lam_draw_params *draw, int width, int height, lam_error *error)
{
    const struct options *o = job->options;
    lam_control control;
    bool by_file = o->picture.exposure_kind == EXPOSURE_BY_FILE && job->file_lights;
    if ((o->picture.exposure_kind != EXPOSURE_AUTO && !by_file) || !lam_output_is_light(draw->output))
        return true;
    if (draw->light_cutoff == 0)
        draw->light_cutoff = -1;
    job->exposure_fitted = true;
    return remove_fill(job, error) && job_control(job, NULL, &control, error) &&
           lam_exposure_fit(job->device, job->scene, &job->camera, draw, width, height, &control, &draw->exposure,
                            error) &&
           (!by_file || lit_by_options(o) || fill_darkness(job, draw, width, height, error));
}

static int by_total(const void *a, const void *b)
{
    double x = ((const lam_frame_report *)a)->total_ms, y = ((const lam_frame_report *)b)->total_ms;
    return (x > y) - (x < y);
}

// Warns about an option for paths of light if no picture of the command line has any, and about lamps behind glass.
static void warn_paths(struct job *job)
{
    static const char *const names[] = {"paths", "noise", "stop-after", "denoise", "caustics"};
    char text[96];
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (!job->draw.bounces && !option_given(job->options, "bounces") && option_given(job->options, names[i])) {
            snprintf(text, sizeof text, "option '--%s' has no effect without --bounces", names[i]);
            lam_scene_add_warning(job->scene, text);
        }
    bool lamps = false, glass = false;
    lam_light lights[16];
    const int count = lam_draw_lights(job->scene, job->draw.rig, job->draw.ground != LAM_GROUND_NONE, lights, 16);
    for (int i = 0; i < count && i < 16; i++)
        lamps |= lights[i].type != LAM_LIGHT_AMBIENT && lights[i].type != LAM_LIGHT_HEMISPHERE;
    for (int i = 0; i < lam_scene_material_count(job->scene); i++)
        glass |= lam_scene_material(job->scene, i)->transmission > 0;
    if (job->draw.bounces && job->draw.caustics && lamps && glass)
        lam_scene_add_warning(job->scene,
                              "option '--caustics': lamps shed no light through glass, only emitting surfaces "
                              "and the environment do");
}

bool job_draw_frames(struct job *job, double from, double span, int count, lam_frame_report *reports,
                     struct progress *progress, lam_error *error)
{
    const struct options *o = job->options;
    job->draw = draw_params_of(o, job->rig);
    job->draw.background = job->background;
    if (!show_option_apply(o->picture.show, job->scene, &job->draw, error) ||
        !fit_exposure(job, &job->draw, o->picture.width, o->picture.height, error))
        return false;
    job_note_glass(job, &job->draw);
    warn_paths(job);
    bool ok = true;
    for (int i = 0; ok && i < count; i++) {
        lam_control control;
        progress_phase(progress, from + span * i / count, span / count);
        ok = job_control(job, progress, &control, error) &&
             lam_draw(job->device, job->scene, &job->camera, &job->draw, &job->image, &control, error);
        if (ok) {
            lam_device_report(job->device, &reports[i]);
            lam_device_comment(job->device, job->comment);
        }
    }
    return ok;
}

// For an even number of frames, the median is the faster of the two middle frames.
void job_time_frames(struct job *job, lam_frame_report *reports, int count)
{
    qsort(reports, (size_t)count, sizeof *reports, by_total);
    job->times.frame = reports[(count - 1) / 2];
    job->times.frame_min = reports[0].total_ms;
    job->times.frame_max = reports[count - 1].total_ms;
    job->times.frames = count;
}

// Draws as many frames as --repeat requests.
static bool draw(struct job *job, struct progress *progress, lam_error *error)
{
    const int count = job->options->work.repeat;
    lam_frame_report *reports = calloc((size_t)count, sizeof *reports);
    if (!reports)
        return complain(error, LAM_MACHINE, "out of memory");
    bool ok = job_draw_frames(job, 0.5, 0.5, count, reports, progress, error);
    if (ok)
        job_time_frames(job, reports, count);
    free(reports);
    return ok;
}

// Returns true if `output` contains colours. These are encoded as sRGB in files with 8 bits.
static bool is_color(lam_output output) { return lam_output_is_light(output) || output == LAM_OUTPUT_BASE_COLOR; }

const char *job_label(const lam_scene *scene, lam_output output, int label)
{
    if (output != LAM_OUTPUT_OBJECT_ID && output != LAM_OUTPUT_PART_ID)
        return NULL;
    for (int i = 0; i < lam_scene_object_count(scene); i++) {
        const lam_object *object = lam_scene_object(scene, i);
        const lam_mesh *mesh = lam_scene_mesh(scene, object->mesh);
        const int parts = output == LAM_OUTPUT_PART_ID && mesh->part_count ? (int)mesh->part_count : 1;
        const bool named = output == LAM_OUTPUT_PART_ID && label <= parts && mesh->part_count;
        const char *name = named && mesh->parts[label - 1].name ? mesh->parts[label - 1].name : object->name;
        if (label <= parts)
            return name ? name : "";
        label -= parts;
    }
    return NULL;
}

// Returns whether the file stores one number for each pixel. Moving pictures have colours.
static bool stores_numbers(const struct job *job)
{
    const struct picture_options *p = &job->options->picture;
    return show_option_is_single(p->show, job->format, p->depth_scale) && !animation_wanted(job->options);
}

lam_save_params job_save_params(const struct job *job, const lam_control *control)
{
    const struct options *o = job->options;
    return (lam_save_params){.background = {job->background.r, job->background.g, job->background.b},
                             .threads = o->work.threads,
                             .control = control,
                             .compress = (lam_compress)o->picture.compress,
                             .quality = o->picture.quality,
                             .durable = o->picture.durable,
                             .single = stores_numbers(job),
                             .comment = *job->comment ? job->comment : NULL,
                             .raw = o->picture.color_mode == LAM_COLOR_RAW ||
                                    !is_color(show_option_what(o->picture.show))};
}

// Multiplies the depths of a PNG with 16 bits by --depth-scale.
static bool scale_depths(struct job *job, lam_error *error)
{
    const double scale = job->options->picture.depth_scale;
    double most = 0;
    if (strcmp(job->format, "png") != 0 || show_option_what(job->options->picture.show) != LAM_OUTPUT_DEPTH ||
        !(scale > 0))
        return true;
    for (int y = 0; y < job->image.height; y++) {
        float *pixel = (float *)job->image.pixels + 4 * (size_t)y * (size_t)job->image.width;
        for (int x = 0; x < job->image.width; x++, pixel += 4) {
            most = (double)pixel[0] > most ? (double)pixel[0] : most;
            pixel[0] = (float)((double)pixel[0] * scale);
        }
    }
    return most * scale < 65535.5 || complain(error, LAM_LIMIT,
                                              "option '--depth-scale': a distance of %.4g times %g does not fit in 16 "
                                              "bits, expected a scale of at most "
                                              "%.4g",
                                              most, scale, 65535 / most);
}

bool job_write(struct job *job, lam_error *error)
{
    lam_control control;
    bool named = !job->picture_bytes && job->output && !output_is_stream(job->output);
    if (!job_control(job, NULL, &control, error) || (named && !job_check_inputs(job->scene, job->output, false, error)))
        return false;
    if (!scale_depths(job, error))
        return false;
    double start = clock_ms();
    lam_save_params params = job_save_params(job, &control);
    bool ok;
    uint64_t bytes = 0;
    if (show_is_all(job->options)) {
        ok = show_all_write(job, &control, error);
        bytes = ok ? output_size(job->output) : 0;
    } else if (job->picture_bytes) {
        ok = lam_image_encode(&job->image, job->format, &params, job->picture_bytes, error);
    } else {
        ok = output_save(&job->image, job->output, &params, &bytes, error);
    }
    job->bytes += job->picture_bytes ? job->picture_bytes->size : bytes;
    job->times.encode += clock_ms() - start;
    job->written = ok;
    return ok;
}

// Warns if the picture of --show environment is certain to be black.
static void warn_environment(struct job *job)
{
    const char *show = job->options->picture.show;
    if (show && strcmp(show, "environment") == 0 && !lam_scene_environment(job->scene) && !job->studio)
        lam_scene_add_warning(job->scene,
                              "the picture of '--show environment' is black: no environment lights this model; "
                              "'--environment studio' sets one");
}

bool job_arrange(struct job *job, struct progress *progress, lam_error *error)
{
    lam_control control;
    if (!job_control(job, progress, &control, error) ||
        !environment_set(job->options, job->environments, job->scene, &control, error) ||
        !job_apply_options(job, &control, &job->sphere, error) || !environment_apply(job->options, job->scene, error))
        return false;
    warn_environment(job);
    if (job->options->picture.save_scene && option_given(job->options, "show"))
        lam_scene_add_warning(job->scene, "the saved scene file describes the picture without --show");
    if (job->options->picture.save_scene && job->options->limits.files_inside && !scene_settings_are_beside(job))
        lam_scene_add_warning(job->scene, "the saved scene file names files outside of its folder");
    animation_sphere(job, &job->sphere);
    if (job->shared)
        job->sphere = job->shared->sphere;
    return job_place_camera(job, error) && job_section(job, &control, error) &&
           (job->lights ? job_light_again(job, error) : job_light(job, &job->sphere, error)) &&
           animation_arrange(job, error) && (!job->options->shading.show_lights || light_markers_add(job, error));
}

bool job_make_image(struct job *job, lam_pixel_format format, lam_error *error)
{
    const struct options *o = job->options; // includes the scene file's settings
    uint64_t bytes = (uint64_t)o->picture.width * (uint64_t)o->picture.height * (format == LAM_RGBA8 ? 4 : 16);
    uint64_t limit = limits_memory(o);
    if (limit && bytes > limit)
        return complain(error, LAM_LIMIT,
                        "the picture of %dx%d pixels needs %.1f MB, more than the memory limit of %.1f MB "
                        "(--memory-limit)",
                        o->picture.width, o->picture.height, (double)bytes / 1e6, (double)limit / 1e6);
    return lam_image_make(&job->image, o->picture.width, o->picture.height, format, error);
}

bool job_draw(struct job *job, lam_pixel_format format, struct progress *progress, lam_error *error)
{
    return job_load(job, progress, error) && job_make_image(job, format, error) && job_arrange(job, progress, error) &&
           draw(job, progress, error);
}

bool job_check_output(struct job *job, lam_error *error)
{
    if (job->picture_bytes ? !lam_image_format_for(job->output, &job->pixels, error)
                           : !output_format(job->output, &job->pixels, error))
        return false;
    job->format = job->picture_bytes ? strrchr(job->output, '.') + 1 : output_ending(job->output);
    if (stores_numbers(job))
        job->pixels = LAM_RGBA32F;
    enum output_given given = output_given(job->options->picture.output);
    given = given == OUTPUT_NAMED && job->makes_folder ? OUTPUT_PATTERN : given;
    if (strcmp(job->output, "-") != 0 && !job->picture_bytes && !output_check(job->output, job->model, given, error))
        return false;
    return !show_is_all(job->options) || show_all_check(job, error);
}

bool job_run(struct job *job, struct progress *progress, lam_error *error)
{
    if (!job_check_output(job, error))
        return false;
    if (job->options->report.dry_run) {
        job->planned = job_load(job, progress, error) && job_arrange(job, progress, error);
        return job->planned;
    }
    bool ok = job_draw(job, job->pixels, progress, error);
    if (ok && progress)
        progress_end(progress); // because the next step may write the picture to the terminal
    return ok && job_write(job, error) && (!job->options->picture.save_scene || scene_settings_save(job, error));
}

bool job_run_view(struct job *job, int view, struct progress *progress, lam_error *error)
{
    job_choose_view(job, &job->views[view]);
    job->camera = job->cameras[view];
    job->written = false;
    job->bytes = 0;
    job->times.encode = 0;
    if (!job_check_output(job, error) || (view > 0 && !job_light_again(job, error)))
        return false;
    job->planned = job->options->report.dry_run;
    return job->planned ||
           (job_make_image(job, job->pixels, error) && draw(job, progress, error) && job_write(job, error) &&
            (!job->options->picture.save_scene || scene_settings_save(job, error)));
}

int job_say_warnings(const struct job *job, int *first, bool print)
{
    int count = 0;
    for (int i = *first; job->scene && lam_scene_warning(job->scene, i); i++) {
        const char *text = lam_scene_warning(job->scene, i);
        bool printed = false;
        for (int k = 0; k < i && !printed; k++)
            printed = strcmp(lam_scene_warning(job->scene, k), text) == 0;
        count += !printed;
        if (!printed && print)
            say_warning(text);
        *first = i + 1;
    }
    return count;
}

void job_add_warnings(lam_scene *to, const lam_scene *from)
{
    for (int i = 0; lam_scene_warning(from, i); i++)
        lam_scene_add_warning(to, lam_scene_warning(from, i));
}

void job_free(struct job *job)
{
    lam_image_free(&job->image);
    lam_scene_free(job->scene);
    free(job->lights);
    free(job->unfilled);
    free(job->cameras);
    free(job->frames.first);
    free(job->frames.last);
    job->scene = NULL;
    job->lights = NULL;
    job->unfilled = NULL;
    job->cameras = NULL;
    job->frames = (struct job_frames){0};
}

lam_explanation *job_explain(struct job *job, int x, int y, struct progress *progress, lam_error *error)
{
    lam_control control;
    if (!job_load(job, progress, error) || !job_arrange(job, progress, error))
        return NULL;
    progress_phase(progress, 0.5, 0.5);
    if (!job_control(job, progress, &control, error))
        return NULL;
    const struct options *o = job->options; // now includes the scene file's settings
    lam_draw_params params = draw_params_of(o, job->rig);
    params.background = job->background;
    if (!fit_exposure(job, &params, o->picture.width, o->picture.height, error))
        return NULL;
    return lam_explain(job->device, job->scene, &job->camera, &params, o->picture.width, o->picture.height, LAM_RGBA8,
                       x, y, &control, error);
}

lam_shader *job_shader(struct job *job, struct progress *progress, lam_error *error)
{
    if (!job_load(job, progress, error) || !job_arrange(job, progress, error))
        return NULL;
    const struct options *o = job->options; // now includes the scene file's settings
    lam_draw_params draw = draw_params_of(o, job->rig);
    lam_shader_params params = {.glsl = (lam_glsl)o->shader.glsl,
                                .lights = (lam_shader_lights)o->shader.lights_in,
                                .products = o->shader.products,
                                .style =
                                    o->shader.mistake ? LAM_SHADER_STYLE_LECTURE : (lam_shader_style)o->shader.style,
                                .mistake = o->shader.mistake,
                                .hardware_filter = o->work.texture_filter == TEXTURE_FILTER_HARDWARE};
    if (!show_option_apply(o->picture.show, job->scene, &draw, error) ||
        (job->device && !fit_exposure(job, &draw, o->picture.width, o->picture.height, error)))
        return NULL;
    return lam_shader_make(job->scene, &job->camera, &draw, o->picture.width, o->picture.height,
                           o->shader.has_object ? o->shader.object : -1, &params, error);
}
