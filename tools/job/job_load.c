// job_load.c: the first step of a job: reads the model or models, or makes the shape.
#include "job_steps.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "console.h"
#include "interrupt.h"
#include "joined_models.h"
#include "limit_options.h"
#include "material_option.h"
#include "scene_settings.h"
#include "several_models.h"
#include "show_all.h"

bool job_control(const struct job *job, struct progress *progress, lam_control *control, lam_error *error)
{
    const struct options *o = job->options;
    *control = limits_control(o);
    control->cancel = job->cancel ? job->cancel : interrupt_flag();
    control->progress = progress ? progress_update : NULL;
    control->user = progress;
    if (interrupted())
        return complain(error, LAM_CANCELLED, "%s: interrupted", job->model);
    double whole = control->time_limit_s;
    if (whole > 0) {
        double start =
            job->times.frame_start > 0 && !(o->limits.time_limit_s > 0) ? job->times.frame_start : job->times.start;
        control->time_limit_s = whole - (clock_ms() - start) / 1e3;
        if (!(control->time_limit_s > 0))
            return complain(error, LAM_LIMIT, "%s: the time limit of %.10g s was reached (--time-limit)", job->model,
                            whole);
    }
    return true;
}

// Returns the crease angle for the library. In the library, 0 means the default, so an angle of 0 from the user is
// replaced by a tiny angle, which splits the normals at every edge.
static double crease_of(const struct options *o)
{
    return o->shading.crease_angle_deg < 0   ? 0
           : o->shading.crease_angle_deg > 0 ? radians(o->shading.crease_angle_deg)
                                             : 1e-6;
}

// Names the option in an error about a formula or one of its ranges.
static void name_formula_option(const char *model, lam_error *error)
{
    const struct {
        const char *begin, *option;
    } rows[] = {{"formula", model},  {"range of u", "u"}, {"range of v", "v"},
                {"range of x", "x"}, {"range of y", "y"}, {"range of z", "z"}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        size_t length = strlen(rows[i].begin);
        if (strncmp(error->text, rows[i].begin, length) != 0 || !strchr(",:", error->text[length]))
            continue;
        lam_error copy = *error;
        complain(error, copy.code, "option '--%s': %s", rows[i].option, copy.text + length + 2);
        return;
    }
}

lam_formula job_formula(const struct options *o)
{
    if (o->shape.implicit)
        return (lam_formula){.text = o->shape.implicit,
                             .implicit = true,
                             .x = o->shape.x_range,
                             .y = o->shape.y_range,
                             .z = o->shape.z_range,
                             .u_segments = o->shading.slices,
                             .v_segments = o->shading.stacks,
                             .flip = o->shading.flip};
    return (lam_formula){.text = o->shape.parametric,
                         .u = o->shape.u_range,
                         .v = o->shape.v_range,
                         .u_segments = o->shading.slices,
                         .v_segments = o->shading.stacks ? o->shading.stacks : o->shading.slices,
                         .flip = o->shading.flip};
}

static lam_scene *make_shape(const char *name, const struct options *o, const lam_control *control, lam_error *error)
{
    lam_scene *scene = lam_scene_make(error);
    if (!scene)
        return NULL;
    lam_object object = lam_object_default();
    object.name = name;
    lam_shape_params params = {
        .slices = o->shading.slices, .stacks = o->shading.stacks, .control = control, .threads = o->work.threads};
    const lam_formula formula = job_formula(o);
    object.mesh = formula.text ? lam_scene_add_formula(scene, &formula, control, error)
                               : lam_scene_add_shape(scene, name, &params, error);
    bool ok = object.mesh >= 0 && lam_scene_add_object(scene, &object, error) >= 0;
    if (ok && (o->shading.normals != LAM_NORMALS_FILE || o->shading.crease_angle_deg >= 0))
        ok = lam_scene_make_normals(scene, (lam_normals)o->shading.normals, crease_of(o), o->work.threads, control,
                                    error);
    if (ok) {
        // Formulas use the axes of textbooks, with z up.
        lam_scene_set_up(scene, formula.text && (o->view.up == LAM_UP_AUTO || o->view.up == LAM_UP_FILE)
                                    ? LAM_UP_Z
                                    : (lam_up)o->view.up);
        return scene;
    }
    if (formula.text)
        name_formula_option(name, error);
    lam_scene_free(scene);
    return NULL;
}

// Returns true if only one frame is drawn. Only the triangles visible in this frame then need normals.
static bool draws_once(const struct job *job)
{
    const struct options *o = job->options;
    if (job->device && lam_device_isa(job->device) == LAM_ISA_AUTO) // an OpenGL device
        return false;
    bool tangents = lam_reflection_describe(o->draw.reflection)->tangents;
    return o->work.repeat == 1 && !job->keeps_scene && !show_is_all(o) && !tangents && job->view_count <= 1 &&
           !job->animation && !o->model.sections.count && !o->material.only.count &&
           o->view.explode.x + o->view.explode.y + o->view.explode.z == 0;
}

// Warns about maps that flat and Gouraud shading ignore.
static void warn_maps(struct job *job)
{
    static const lam_map fine[] = {LAM_MAP_NORMAL,   LAM_MAP_BUMP,      LAM_MAP_SPECULAR, LAM_MAP_SHININESS,
                                   LAM_MAP_METALLIC, LAM_MAP_ROUGHNESS, LAM_MAP_OCCLUSION};
    char names[120] = "", text[220];
    if (draw_params_of(job->options, LAM_RIG_NONE).shading == LAM_SHADING_PHONG)
        return;
    for (size_t map = 0; map < sizeof fine / sizeof *fine; map++) {
        bool used = false;
        for (int i = 0; i < lam_scene_material_count(job->scene); i++)
            used |= lam_scene_material(job->scene, i)->maps[fine[map]] != NULL;
        if (used)
            snprintf(names + strlen(names), sizeof names - strlen(names), "%s%s", *names ? ", " : "",
                     lam_map_name(fine[map]));
    }
    snprintf(text, sizeof text, "maps that need Phong shading are omitted: %s", names);
    if (*names)
        lam_scene_add_warning(job->scene, text);
}

// Sets job->background to the background from the command line or, if the command line sets none, from the scene file.
static bool find_background(struct job *job, lam_error *error)
{
    const struct options *o = job->options;
    float unused;
    if (o->picture.background && !background_environment(o->picture.background, &unused))
        return lam_color_parse(o->picture.background, (lam_color_mode)o->picture.color_mode, &job->background, error);
    job->background = o->picture.background ? (lam_rgba){0, 0, 0, 0} : job->settings.draw.background;
    return true;
}

// Reads one model, or makes the shape.
static lam_scene *load_one(const struct job *job, const char *name, bool only, const lam_control *control,
                           lam_error *error)
{
    const struct options *o = job->options;
    const lam_bytes *bytes = job->model_bytes;
    if (!bytes && (job_formula(o).text || lam_shape_find(name) >= 0))
        return make_shape(name, o, control, error);
    // Several models share their axes, so none is turned by its own shape.
    const bool turns = o->view.up != LAM_UP_AUTO || (only && !job->keeps_axes);
    lam_load_params params = {.up = turns ? (lam_up)o->view.up : LAM_UP_FILE,
                              .color = (lam_color_mode)o->picture.color_mode,
                              .override_color = option_given(o, "color-mode"),
                              .models_anywhere = !o->limits.files_inside,
                              .allowed_paths = o->limits.allow_paths.items,
                              .allowed_path_count = o->limits.allow_paths.count,
                              .normals = (lam_normals)o->shading.normals,
                              .crease_angle_rad = crease_of(o),
                              .threads = o->work.threads,
                              .scene = o->model.scene,
                              .variant = o->model.variant,
                              .lenient = o->model.lenient,
                              .deflection = o->model.deflection,
                              .measure = job->measure,
                              .animation = o->model.animation  ? o->model.animation
                                           : o->model.has_time ? "0"
                                                               : NULL,
                              .time_s = o->model.time_s,
                              .polygon_edges = o->draw.wireframe || o->draw.edges,
                              .normals_when_drawn = only && draws_once(job)};
    lam_scene *scene = bytes ? lam_scene_load_memory(bytes->data, bytes->size, name, &params, control, error)
                             : lam_scene_load(name, &params, control, error);
    if (!scene && !bytes)
        model_guess(name, o, error);
    return scene;
}

// Reads the models of `a.stl + b.stl`.
static lam_scene *load_several(const struct job *job, const lam_control *control, lam_error *error)
{
    int count = 1, filled = 0;
    for (const char *at = job->model; (at = joined_models_next(at));)
        count++;
    lam_scene **scenes = calloc((size_t)count, sizeof *scenes), *all = NULL;
    char *names = strdup(job->model), *name = names;
    bool ok = (scenes && names) || complain(error, LAM_MACHINE, "out of memory");
    for (; ok && filled < count; filled++) {
        char *next = (char *)(uintptr_t)joined_models_next(name);
        if (next)
            next[-(ptrdiff_t)strlen(JOINED_MODELS)] = 0;
        scenes[filled] = load_one(job, name, false, control, error);
        ok = scenes[filled] != NULL;
        name = next;
    }
    if (ok)
        all = several_models_join(scenes, count, (enum arrange)job->options->model.arrange, error);
    for (int i = 0; !ok && scenes && i < filled; i++)
        lam_scene_free(scenes[i]);
    free(names);
    free(scenes);
    return all;
}

// Reads the model or models.
static bool make_scene(struct job *job, struct progress *progress, lam_error *error)
{
    lam_control control;
    progress_phase(progress, 0, 0.5);
    if (!job_control(job, progress, &control, error))
        return false;
    bool several = !job->model_bytes && !job_formula(job->options).text && joined_models_next(job->model);
    job->scene = several ? load_several(job, &control, error) : load_one(job, job->model, true, &control, error);
    if (job->scene)
        lam_scene_times(job->scene, &job->times.read, &job->times.prepare);
    if (job->scene && job->times.prepare == 0)
        job->times.prepare = clock_ms() - job->times.start; // a shape
    return job->scene != NULL;
}

// Warns about colour values that are above 1 or look like bytes.
static void warn_color(lam_scene *scene, const char *option, const char *value, bool reflects, lam_color_mode mode)
{
    lam_rgba color;
    char advice[COLOR_ADVICE_SIZE], text[200];
    if (!lam_color_parse(value, mode, &color, NULL))
        return;
    const double rgb[3] = {(double)color.r, (double)color.g, (double)color.b};
    color_advice(rgb, advice);
    bool above = rgb[0] > 1 || rgb[1] > 1 || rgb[2] > 1;
    snprintf(text, sizeof text, "option '--%s': found %.40s, expected numbers from 0 to 1%s%s", option, value,
             reflects ? ": it reflects more light than it receives" : "", advice);
    if (reflects ? above : *advice != 0)
        lam_scene_add_warning(scene, text);
}

// Does not check lights with an attenuation, intensity or range, because their colours are often above 1.
static void warn_colors(struct job *job)
{
    const struct options *o = job->options;
    lam_color_mode mode = (lam_color_mode)o->picture.color_mode;
    for (int i = 0; option_table[i].name; i++)
        if (option_table[i].kind == VALUE_COLOR && o->given[i])
            warn_color(job->scene, option_table[i].name, o->values[i], strcmp(option_table[i].name, "color") == 0,
                       mode);
    for (int i = 0; i < o->lighting.lights.count; i++) {
        const char *text = o->lighting.lights.items[i], *color = strstr(text, "color=");
        char value[40];
        if (!color || strstr(text, "attenuation=") || strstr(text, "intensity=") || strstr(text, "range="))
            continue;
        snprintf(value, sizeof value, "%.*s", (int)strcspn(color + 6, ","), color + 6);
        warn_color(job->scene, "light", value, false, mode);
    }
}

bool job_load(struct job *job, struct progress *progress, lam_error *error)
{
    const struct options *o = job->options;
    if (!job->scene && !make_scene(job, progress, error))
        return false;
    materials_warn(job->scene);
    job->model_counts = (struct model_counts){lam_scene_triangle_count(job->scene), lam_scene_line_count(job->scene),
                                              lam_scene_point_count(job->scene),    lam_scene_vertex_count(job->scene),
                                              lam_scene_mesh_count(job->scene),     lam_scene_object_count(job->scene),
                                              lam_scene_material_count(job->scene), lam_scene_light_count(job->scene)};
    if (job->model_counts.triangles + job->model_counts.lines + job->model_counts.points == 0)
        return complain(error, LAM_CANNOT_READ,
                        "%s: found no triangles, lines or points, expected at least one to draw", job->model);
    scene_settings_apply(job);
    if (!lam_scene_set_sections(job->scene, NULL, 0, NULL, error)) // job_section cuts what the options have changed
        return false;
    const lam_vec3 apart = o->view.explode;
    if ((o->material.only.count || apart.x + apart.y + apart.z > 0) && !lam_scene_split_parts(job->scene, error))
        return false;
    if (!find_background(job, error))
        return false;
    warn_maps(job);
    warn_colors(job);
    if (o->shading.slices && !job_formula(o).text && lam_shape_find(job->model) < 0)
        lam_scene_add_warning(job->scene, "option '--segments' changes nothing: the model is a file");
    bool is_gltf = strcmp(lam_scene_format(job->scene), "gltf") == 0;
    if (!is_gltf && (o->model.scene || o->model.variant || o->model.animation || o->model.has_time))
        lam_scene_add_warning(job->scene, "options '--scene', '--variant', '--animation' and '--time' apply only "
                                          "to glTF files");
    if (o->model.lenient && !is_gltf && strcmp(lam_scene_format(job->scene), "3mf") != 0)
        lam_scene_add_warning(job->scene, "option '--lenient' applies only to glTF and 3MF files");
    if (o->model.deflection > 0 && !strstr("step iges brep", lam_scene_format(job->scene)))
        lam_scene_add_warning(job->scene, "option '--deflection' applies only to STEP, IGES and BREP files");
    return true;
}
