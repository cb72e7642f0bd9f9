// animate.c: draws the frames of --turntable and --sweep for one model.
//
// Each frame is a picture drawn with the command line's options, plus the options that the sweeps and the turntable set
// for that frame. The program loads the scene once, marks its state (lam_scene_mark), and resets the scene to this
// state before each frame. The program loads the scene again only if a swept option affects loading (option.loads). The
// camera and exposure of the first frame are used for all frames.
#include "animate_frame.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <lambent/animation.h>

#include "command_table.h"
#include "console.h"
#include "environment_option.h"
#include "job.h"
#include "job_steps.h"
#include "output.h"
#include "scene_settings.h"

enum { FRAMES_DEFAULT = 36, FRAMES_MAX = 100000 };

// --- checks

static bool only_with(const struct options *o, const char *option, const char *needed, lam_error *error)
{
    return !option_given(o, option) || complain(error, LAM_BAD_ARGUMENT, "option '--%s' needs %s", option, needed);
}

static bool not_with(const struct options *o, const char *option, lam_error *error)
{
    return !option_given(o, option) ||
           complain(error, LAM_BAD_ARGUMENT, "options '--%s' and '--%s' cannot be used together", animation_option(o),
                    option);
}

static bool check_sweeps(const struct options *o, lam_error *error)
{
    for (int i = 0; i < o->animation.sweeps.count; i++) {
        struct sweep sweep;
        lam_error reason;
        if (!sweep_parse(o->animation.sweeps.items[i], &sweep, &reason))
            return complain(error, LAM_BAD_ARGUMENT, "option '--sweep': %.400s", reason.text);
        // A sweep of the view angles or the zoom moves the fitted camera.
        if (o->view.camera && sweep.kind == SWEEP_OPTION && sweep.option->group == GROUP_VIEW)
            return complain(error, LAM_BAD_ARGUMENT, "options '--camera' and '--sweep %s' cannot be used together",
                            sweep.option->name);
    }
    return true;
}

bool animation_check(const struct options *o, lam_error *error)
{
    if (!animation_wanted(o))
        return only_with(o, "frames", "--sweep; or write --turntable N", error) &&
               only_with(o, "fps", "--turntable or --sweep", error) &&
               only_with(o, "turntable-light", "--turntable", error) &&
               only_with(o, "stream", "--turntable, --sweep or --animation", error);
    if (o->animation.stream && strcmp(o->picture.output, "-") != 0)
        return complain(error, LAM_BAD_ARGUMENT, "option '--stream' writes to standard output, expected -o -");
    if (o->animation.turntable && o->animation.frames)
        return complain(error, LAM_BAD_ARGUMENT,
                        "option '--frames' applies only to --sweep; --turntable sets the number of frames itself");
    if (o->batch.view_count > 1 || o->batch.size_count > 1 || o->batch.show_count > 1)
        return complain(error, LAM_BAD_ARGUMENT, "option '--%s' needs one %s; found several", animation_option(o),
                        o->batch.view_count > 1   ? "--view"
                        : o->batch.size_count > 1 ? "--size"
                                                  : "--show");
    return not_with(o, "repeat", error) && not_with(o, "save-scene", error) && check_sweeps(o, error) &&
           (o->animation.turntable || only_with(o, "turntable-light", "--turntable", error));
}

static bool check_format(const struct job *job, const struct options *o, lam_error *error)
{
    if (job->frames.first || strcmp(job->format, "png") == 0 || lam_animation_format(job->output))
        return true;
    return complain(error, LAM_UNSUPPORTED,
                    "option '--%s': a file of format %s contains one picture; expected .png, .webp or .gif, or "
                    "{frame} in the name: -o '{stem}-{frame}.%s'",
                    animation_option(o), job->format, job->format);
}

// --- names

static bool has_frame_names(const struct options *o)
{
    return output_name_is_pattern(o->picture.output) && output_name_has(o->picture.output, "frame");
}

static const char placeholder[] = "{frame}";

static int digits_of(int count)
{
    int digits = 1;
    for (int last = count - 1; last >= 10; last /= 10)
        digits++;
    return digits;
}

// Returns the number of frames that the options request.
static int animation_count(const struct options *o)
{
    return o->animation.turntable ? o->animation.turntable : o->animation.frames ? o->animation.frames : FRAMES_DEFAULT;
}

bool animation_is_frame(const struct options *o, const char *pattern, const char *path)
{
    int count = animation_count(o), digits = digits_of(count);
    char number[16];
    for (const char *next; (next = strstr(pattern, placeholder)); pattern = next + sizeof placeholder - 1) {
        size_t before = (size_t)(next - pattern);
        if (strncmp(pattern, path, before) != 0 || (int)strspn(path + before, "0123456789") < digits)
            return false;
        snprintf(number, sizeof number, "%.*s", digits, path + before);
        if (atoi(number) >= count)
            return false;
        path += before + (size_t)digits;
    }
    return strcmp(pattern, path) == 0;
}

// Returns the name of a frame's file, with each {frame} replaced by the frame number.
static char *path_of_frame(const struct animation *a, int frame)
{
    int digits = digits_of(a->count);
    char *path = NULL;
    size_t size;
    FILE *out = open_memstream(&path, &size);
    if (!out)
        return NULL;
    const char *at = a->pattern;
    for (const char *next; (next = strstr(at, placeholder)); at = next + sizeof placeholder - 1)
        fprintf(out, "%.*s%0*d", (int)(next - at), at, digits, frame);
    fputs(at, out);
    if (fclose(out) == 0)
        return path;
    free(path);
    return NULL;
}

static bool name_frames(struct job *job, const struct animation *a, lam_error *error)
{
    free(job->frames.first);
    free(job->frames.last);
    bool stream = a->given->animation.stream;
    job->frames.first = path_of_frame(a, 0);
    job->frames.last = stream ? NULL : path_of_frame(a, a->count - 1);
    job->output = job->frames.first;
    return (job->frames.first && (stream || job->frames.last)) || complain(error, LAM_MACHINE, "out of memory");
}

// --- the options of a frame

// Returns the axis letter for a rotation about the up axis.
static char up_letter(lam_up up)
{
    return up == LAM_UP_X || up == LAM_UP_NEGATIVE_X ? 'x' : up == LAM_UP_Z || up == LAM_UP_NEGATIVE_Z ? 'z' : 'y';
}

// Adds the rotation axes for which the camera is fitted: the up axis, and a second axis if the elevation changes.
static bool add_turns(struct animation *a, struct options *o, lam_error *error)
{
    static const char *const all[] = {"x:0", "y:0", "z:0"};
    bool model = a->given->animation.turntable && a->given->animation.turntable_light == TURNTABLE_LIGHT_MODEL;
    bool about_up = model || animation_sweeps(a, "azimuth"), any = animation_sweeps(a, "elevation");
    const char **items = calloc(2, sizeof *items);
    free(o->shading.sheet_rotations.items);
    o->shading.sheet_rotations = (struct texts){.items = items};
    if (!items)
        return complain(error, LAM_MACHINE, "out of memory");
    if (about_up || any)
        items[o->shading.sheet_rotations.count++] = all[up_letter(a->up) - 'x'];
    if (any) // with two axes, the camera is fitted for any rotation
        items[o->shading.sheet_rotations.count++] = all[(up_letter(a->up) - 'x' + 1) % 3];
    return true;
}

// Sets a->frame to the options of a frame.
static bool set_options(struct animation *a, int frame, lam_error *error)
{
    char *words[2 * (OPTIONS_MAX + 1)];
    int count = 0;
    options_free(&a->frame);
    if (!options_copy(&a->frame, a->given)) {
        a->frame = (struct options){0};
        return complain(error, LAM_MACHINE, "out of memory");
    }
    struct options *o = &a->frame;
    for (int i = 0; i < a->sweep_count; i++) {
        const struct sweep *sweep = &a->sweeps[i];
        // animation_arrange moves the camera to the swept angle. The options of every frame therefore contain the
        // sweep's first angle.
        bool angle = sweep_is_option(sweep, "azimuth") || sweep_is_option(sweep, "elevation");
        if (sweep_words(sweep, angle ? 0 : frame, a->count, &a->words[i])) {
            words[count++] = a->words[i].option;
            words[count++] = a->words[i].value;
        }
        o->animation.place_lights |= sweep->kind == SWEEP_LIGHT;
    }
    if (o->animation.turntable && o->animation.turntable_light == TURNTABLE_LIGHT_CAMERA) {
        struct sweep_words *turn = &a->words[a->sweep_count];
        double angle_deg = animation_turn(a, frame);
        snprintf(turn->option, sizeof turn->option, "--rotate");
        snprintf(turn->value, sizeof turn->value, "%c:%.17g", up_letter(a->up),
                 a->up >= LAM_UP_NEGATIVE_X ? -angle_deg : angle_deg);
        words[count++] = turn->option;
        words[count++] = turn->value;
    }
    o->animation.place_lights |= o->animation.turntable != 0;
    if (a->environment && !a->loads && !environment_option_is_none(o->shading.environment))
        o->shading.environment = NULL; // the scene already contains the environment
    return options_parse(count, words, find_groups("render"), o, error) >= 0 && add_turns(a, o, error);
}

// Copies the first frame's exposure to the options of the later frames. If the first frame has a dim studio, copies the
// studio too.
static void keep_exposure(const struct job *job, struct options *o)
{
    if (!job->exposure_fitted)
        return;
    o->picture.exposure_kind = EXPOSURE_LITERAL;
    o->picture.exposure = job->draw.exposure;
    o->draw.light_cutoff = o->draw.light_cutoff != 0 ? o->draw.light_cutoff : -1;
    if (job->fill_scale > 0) {
        o->lighting.has_light_scale = true;
        o->lighting.light_scale = job->fill_scale;
        o->shading.environment = job->animation->loads ? "studio" : NULL; // otherwise the scene already contains the
                                                                          // studio
    }
}

// --- loading

// Sets the job's options to the options of a frame.
static bool use_options(struct job *job, int frame, lam_error *error)
{
    struct animation *a = job->animation;
    a->index = frame;
    if (!set_options(a, frame, error))
        return false;
    if (a->drawn)
        keep_exposure(job, &a->frame);
    job->options = &a->frame;
    return true;
}

// Loads the model for a frame, without a progress bar. The warnings of the last frame are kept.
static bool load_frame(struct job *job, int frame, lam_error *error)
{
    struct animation *a = job->animation;
    struct progress none;
    progress_start(&none, job->model, false);
    if (!a->warnings && !(a->warnings = lam_scene_make(error)))
        return false;
    job_add_warnings(a->warnings, job->scene);
    lam_scene_free(job->scene);
    job->scene = NULL;
    return use_options(job, frame, error) && job_load(job, &none, error);
}

// Marks the state of the loaded scene before options change the scene.
static bool mark(struct job *job, lam_error *error)
{
    lam_control control;
    bool tangents = lam_reflection_describe(job->options->draw.reflection)->tangents;
    return job_control(job, NULL, &control, error) &&
           (!tangents || lam_scene_make_tangents(job->scene, &control, error)) && lam_scene_mark(job->scene, error);
}

// Restores the scene to its loaded state, and sets the options of a frame.
static bool prepare(struct job *job, int frame, lam_error *error)
{
    if (frame > 0 && job->animation->loads)
        return load_frame(job, frame, error);
    if (frame > 0 && !lam_scene_reset(job->scene, error))
        return false;
    if (!use_options(job, frame, error))
        return false;
    scene_settings_apply(job);
    return true;
}

// --- animations in the file

// Finds the length of the selected animation of the file.
static bool find_length(const struct job *job, double *length_s, lam_error *error)
{
    const lam_file_info *file = lam_scene_file_info(job->scene);
    const char *name = job->options->model.animation ? job->options->model.animation : "0";
    for (int i = 0; i < file->animation_count; i++) {
        char number[16];
        snprintf(number, sizeof number, "%d", i);
        const char *other = file->animations[i].name;
        if (strcmp(name, number) == 0 || (other && strcmp(name, other) == 0))
            *length_s = file->animations[i].length_s;
    }
    return *length_s > 0 || !option_given(job->options, "sweep") ||
           complain(error, LAM_BAD_ARGUMENT,
                    "option '--sweep time': the file does not state how long its animation is; "
                    "expected time=FROM..TO");
}

// Sets the number of frames. For a time sweep without a range, sets the range to the whole animation.
static bool set_length(struct job *job, lam_error *error)
{
    struct animation *a = job->animation;
    for (int i = 0; i < a->sweep_count; i++) {
        struct sweep *sweep = &a->sweeps[i];
        double length_s = 0;
        if (sweep->stop_count)
            continue;
        if (!find_length(job, &length_s, error))
            return false;
        sweep->stops[1] = length_s;
        sweep->stop_count = 2;
        sweep->closed = true;
        double frames = length_s * job->frames.frames_per_second + 0.5;
        if (!a->given->animation.turntable && !a->given->animation.frames)
            a->count = length_s <= 0 ? 1 : frames < 2 ? 2 : frames > FRAMES_MAX ? FRAMES_MAX : (int)frames;
    }
    job->frames.count = a->count;
    return !job->frames.first || name_frames(job, a, error);
}

static void extend(lam_vec3 *low, lam_vec3 *high, lam_vec3 a, lam_vec3 b)
{
    low->x = a.x < low->x ? a.x : low->x;
    low->y = a.y < low->y ? a.y : low->y;
    low->z = a.z < low->z ? a.z : low->z;
    high->x = b.x > high->x ? b.x : high->x;
    high->y = b.y > high->y ? b.y : high->y;
    high->z = b.z > high->z ? b.z : high->z;
}

// The vertices of all frames that reach farthest in directions to the sides of the picture. A camera that shows these
// vertices shows all, because a side of its view is perpendicular to one of the directions, or lies between two.
struct reach {
    lam_vec3 right, up, ahead; // the axes of the camera
    double far[26];            // along each direction
    lam_vec3 points[26];
    bool any;
};

static double dot(lam_vec3 a, lam_vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

// Returns the unit vector along a × b.
static lam_vec3 across(lam_vec3 a, lam_vec3 b)
{
    lam_vec3 v = {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    double length = sqrt(dot(v, v));
    return length > 0 ? (lam_vec3){v.x / length, v.y / length, v.z / length} : v;
}

static void reach_point(struct reach *reach, lam_vec3 p)
{
    static const double slopes[6] = {0, 0.1, 0.2, 0.35, 0.6, 1.2}; // half widths of views at distance 1
    double x = dot(p, reach->right), y = dot(p, reach->up), z = dot(p, reach->ahead);
    for (int i = 0; i < 26; i++) {
        double side = i < 12 ? x : i < 24 ? y : 0, slope = i < 24 ? slopes[i / 2 % 6] : 1;
        double far = (i % 2 ? -side : side) + (i == 25 ? slope : -slope) * z;
        if (reach->any && far <= reach->far[i])
            continue;
        reach->far[i] = far;
        reach->points[i] = p;
    }
    reach->any = true;
}

static void reach_scene(struct reach *reach, const lam_scene *scene)
{
    for (int i = 0; i < lam_scene_object_count(scene); i++) {
        const lam_object *object = lam_scene_object(scene, i);
        const lam_mesh *mesh = lam_scene_mesh(scene, object->mesh);
        const double(*m)[4] = object->transform.m;
        for (uint32_t k = 0; k < mesh->vertex_count; k++) {
            double p[3], w[3];
            for (int c = 0; c < 3; c++)
                p[c] = (double)mesh->positions[3 * (size_t)k + (size_t)c] + mesh->origin[c];
            for (int c = 0; c < 3; c++)
                w[c] = m[c][0] * p[0] + m[c][1] * p[1] + m[c][2] * p[2] + m[c][3];
            reach_point(reach, (lam_vec3){w[0], w[1], w[2]});
        }
    }
}

// Returns whether the surfaces decide the camera. Otherwise the box of all poses does: a model that turns, a ground, and
// parts that are hidden need more or less space.
static bool fits_surfaces(const struct job *job)
{
    const struct options *o = job->options;
    return !o->animation.turntable && !o->shading.rotations.count && !o->draw.ground && !o->material.hidden.count &&
           !o->material.only.count;
}

// For a model whose pose changes, computes one centre of rotation and one camera. The centre is the middle of the bounding box
// around the model's poses in all frames, and the camera fits the surfaces of all frames.
static bool fit_poses(struct job *job, lam_error *error)
{
    struct animation *a = job->animation;
    lam_vec3 low = {0}, high = {0}, one_low, one_high;
    bool any = false;
    const lam_camera start = job_fit_camera(job->scene, (lam_vec3){0}, job->options, job->rig);
    const lam_vec3 view = {start.target.x - start.eye.x, start.target.y - start.eye.y, start.target.z - start.eye.z};
    struct reach reach = {.right = across(view, start.up)};
    reach.up = across(reach.right, view);
    reach.ahead = across(reach.up, reach.right);
    for (int i = 0; i < a->count; i++) {
        if (i > 0 && !load_frame(job, i, error))
            return false;
        if (fits_surfaces(job))
            reach_scene(&reach, job->scene);
        if (!lam_scene_bounds(job->scene, &one_low, &one_high))
            continue;
        if (!any)
            low = one_low, high = one_high;
        any = true;
        extend(&low, &high, one_low, one_high);
    }
    if (!load_frame(job, 0, error))
        return false;
    lam_scene *box = any ? job_box_scene(low, high, a->up, error) : NULL;
    if (!box)
        return !any;
    lam_scene_sphere(box, -1, &a->sphere.centre, &a->sphere.radius);
    a->has_sphere = a->sphere.radius > 0;
    if (!job->options->view.camera && !scene_settings_has_camera(job)) {
        lam_scene *surfaces = reach.any ? job_points_scene(reach.points, 26, a->up, error) : NULL;
        a->camera = job_fit_camera(surfaces ? surfaces : box, a->sphere.centre, job->options, job->rig);
        a->has_camera = true;
        lam_scene_free(surfaces);
    }
    lam_scene_free(box);
    return true;
}

// --- running

static bool begin(struct job *job, const struct options *o, lam_error *error)
{
    struct animation *a = job->animation;
    a->sweeps = calloc((size_t)o->animation.sweeps.count + 1, sizeof *a->sweeps);
    a->words = calloc((size_t)o->animation.sweeps.count + 1, sizeof *a->words);
    if (!a->sweeps || !a->words)
        return complain(error, LAM_MACHINE, "out of memory");
    if (o->animation.sweeps.count > OPTIONS_MAX)
        return complain(error, LAM_BAD_ARGUMENT, "option '--sweep': given %d times, expected at most %d",
                        o->animation.sweeps.count, OPTIONS_MAX);
    for (int i = 0; i < o->animation.sweeps.count; i++) {
        // The text is always valid, because animation_check has parsed it.
        sweep_parse(o->animation.sweeps.items[i], &a->sweeps[i], error);
        a->loads |= a->sweeps[i].option && a->sweeps[i].option->loads;
    }
    a->sweep_count = o->animation.sweeps.count;
    a->count = animation_count(o);
    job->frames.count = a->count;
    job->frames.frames_per_second = o->animation.fps > 0 ? o->animation.fps : 24;
    if (o->animation.stream && !name_frames(job, a, error))
        return false;
    if (has_frame_names(o) &&
        (!name_frames(job, a, error) || !output_check(job->output, job->model, OUTPUT_PATTERN, error)))
        return false;
    return check_format(job, o, error);
}

static lam_animation *start_file(const struct job *job, lam_error *error)
{
    lam_save_params params = job_save_params(job, NULL);
    lam_animation_params animation = {.frames_per_second = job->frames.frames_per_second, .frames = &params};
    return lam_animation_make(job->format, job->options->picture.width, job->options->picture.height, &animation,
                              error);
}

// Adds the frame to the animation's file, or writes it to a separate file.
static bool put_frame(struct job *job, lam_animation *file, lam_error *error)
{
    lam_control control;
    if (!file) {
        char *path = path_of_frame(job->animation, job->animation->index);
        job->output = path;
        bool ok = path ? job_write(job, error) : complain(error, LAM_MACHINE, "out of memory");
        job->output = job->frames.first;
        free(path);
        return ok;
    }
    double start = clock_ms();
    bool ok = job_control(job, NULL, &control, error) && lam_animation_add(file, &job->image, &control, error);
    job->times.encode += clock_ms() - start;
    return ok;
}

static bool write_file(struct job *job, lam_animation *file, lam_error *error)
{
    lam_control control;
    lam_bytes bytes = {0};
    double start = clock_ms();
    bool ok = job_control(job, NULL, &control, error) && lam_animation_finish(file, &control, &bytes, error);
    if (ok && job->picture_bytes) {
        *job->picture_bytes = bytes;
        job->bytes = bytes.size;
    } else {
        ok = ok && (output_is_stream(job->output) || job_check_inputs(job->scene, job->output, false, error)) &&
             output_save_bytes(&bytes, job->output, job->options->picture.durable, &job->bytes, error);
        lam_bytes_free(&bytes);
    }
    job->times.encode += clock_ms() - start;
    job->written = ok;
    return ok;
}

static bool draw_frames(struct job *job, lam_animation *file, struct progress *progress, lam_error *error)
{
    struct animation *a = job->animation;
    lam_frame_report *reports = calloc((size_t)a->count, sizeof *reports);
    uint64_t covered = 0;
    bool ok = reports || complain(error, LAM_MACHINE, "out of memory");
    for (int i = 0; ok && i < a->count; i++) {
        job->times.frame_start = clock_ms();
        ok = prepare(job, i, error) && job_arrange(job, progress, error) &&
             job_draw_frames(job, 0.5 + 0.5 * i / a->count, 0.5 / a->count, 1, &reports[i], progress, error) &&
             put_frame(job, file, error);
        if (ok)
            covered += reports[i].pixels_covered;
        a->environment = a->drawn = true;
    }
    if (ok)
        job_time_frames(job, reports, a->count);
    if (ok && covered)
        job->times.frame.pixels_covered = job->times.frame.pixels_covered ? job->times.frame.pixels_covered : 1;
    free(reports);
    return ok && (!file || write_file(job, file, error));
}

static bool run(struct job *job, lam_pixel_format format, struct progress *progress, lam_error *error)
{
    struct animation *a = job->animation;
    if (!begin(job, a->given, error) || !use_options(job, 0, error) || !job_load(job, progress, error))
        return false;
    a->up = lam_scene_up(job->scene);
    if (!set_length(job, error) || !use_options(job, 0, error))
        return false;
    scene_settings_apply(job);
    if ((a->loads && !fit_poses(job, error)) || !mark(job, error))
        return false;
    if (job->options->report.dry_run) {
        job->planned = prepare(job, 0, error) && job_arrange(job, progress, error);
        return job->planned;
    }
    if (!job_make_image(job, format, error))
        return false;
    lam_animation *file = job->frames.first ? NULL : start_file(job, error);
    bool ok = (file || job->frames.first) && draw_frames(job, file, progress, error);
    lam_animation_free(file);
    return ok;
}

bool animation_run(struct job *job, struct progress *progress, lam_error *error)
{
    if (!job_check_output(job, error))
        return false;
    struct animation animation = {.given = job->options, .pattern = job->output};
    job->animation = &animation;
    bool ok = run(job, job->pixels, progress, error);
    job->animation = NULL;
    // Reports describe the command line, the model as loaded, and the first frame's camera.
    lam_error ignored; // an error means that nothing was marked
    if (job->scene)
        lam_scene_reset(job->scene, &ignored);
    if (animation.has_camera)
        job->camera = animation.camera;
    job->options = animation.given;
    if (job->scene)
        scene_settings_apply(job);
    if (job->scene && animation.warnings)
        job_add_warnings(job->scene, animation.warnings);
    lam_scene_free(animation.warnings);
    options_free(&animation.frame);
    free(animation.sweeps);
    free(animation.words);
    return ok;
}
