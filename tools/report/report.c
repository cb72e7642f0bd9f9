// report.c: reports the result of a job as a line, a table, or JSON.
#include "report.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "console.h"
#include "json.h"
#include "plan.h"
#include "sandbox_start.h"
#include "settings_json.h"
#include "vectors.h"

// Returns the model's format, or "shape" for a built-in shape.
static const char *format_of(const lam_scene *scene)
{
    const char *format = lam_scene_format(scene);
    return format && *format ? format : "shape";
}

// Converts radians to degrees. Rounds to thirteen digits. A conversion to radians and back preserves these digits.
static double degrees(double angle_rad)
{
    char text[32];
    snprintf(text, sizeof text, "%.13g", in_degrees(angle_rad));
    return strtod(text, NULL);
}

// Prints "turn.png", or "turn-00.png to turn-35.png" for frames in separate files.
static void say_output(const struct job *job)
{
    say_plain("%s", strcmp(job->output, "-") == 0 ? "standard output" : job->output);
    if (job->frames.last)
        say_plain(" to %s", job->frames.last);
}

void report_line(const struct job *job)
{
    char items[MODEL_COUNTS_SIZE];
    char exposure[60] = "";
    if (job->exposure_fitted)
        snprintf(exposure, sizeof exposure, "  exposure %.4g stops (auto)", job->draw.exposure);
    say_output(job);
    if (job->frames.count)
        say_plain("  %d frames", job->frames.count);
    say_plain("  %dx%d  %s  %.*f ms%s\n", job->image.width, job->image.height,
              model_counts_text(&job->model_counts, items), job->times.total < 10 ? 1 : 0, job->times.total, exposure);
}

static void time_row(const char *name, double ms) { say_plain("  %-12s %10.2f ms\n", name, ms); }

static void table_of_model(const struct job *job)
{
    const lam_scene *scene = job->scene;
    lam_vec3 low, high;
    lam_scene_bounds(scene, &low, &high);
    char items[MODEL_COUNTS_SIZE];
    say_plain("model    %s (%s), %s, %" PRIu64 " vertices\n", job->model, format_of(scene),
              model_counts_text(&job->model_counts, items), job->model_counts.vertices);
    say_plain("         meshes %d, objects %d, materials %d, lights %d, up %s\n", job->model_counts.meshes,
              job->model_counts.objects, job->model_counts.materials, job->model_counts.lights,
              lam_up_name(lam_scene_up(scene)));
    say_plain("box      %.7g %.7g %.7g to %.7g %.7g %.7g\n", low.x, low.y, low.z, high.x, high.y, high.z);
    const lam_camera *camera = &job->camera;
    say_plain("camera   eye %.7g %.7g %.7g, target %.7g %.7g %.7g, ", camera->eye.x, camera->eye.y, camera->eye.z,
              camera->target.x, camera->target.y, camera->target.z);
    if (camera->ortho_half_height > 0)
        say_plain("orthographic, half height %.7g\n", camera->ortho_half_height);
    else
        say_plain("%.7g degrees high\n", degrees(camera->fovy_rad));
}

static void table_of_program(const struct job *job)
{
    char sandbox[SANDBOX_TEXT_SIZE];
    say_plain("device   %s\n", lam_device_name(job->device));
    say_plain("sandbox  %s\n", sandbox_text(sandbox_active(), sandbox));
    if (settings_are_used(job->options)) {
        say_plain("settings");
        for (int i = 0; option_table[i].name; i++)
            if (job->options->by_config[i])
                say_plain(" --%s%s%s", option_table[i].name, job->options->values[i] ? " " : "",
                          job->options->values[i] ? job->options->values[i] : "");
        say_plain("\n");
    }
}

static void table_of_picture(const struct job *job)
{
    const lam_frame_report *frame = &job->times.frame;
    say_plain("picture  ");
    say_output(job);
    say_plain(", %dx%d, %" PRIu64 " bytes\n", job->image.width, job->image.height, job->bytes);
    if (job->frames.count)
        say_plain("frames   %d, %.4g a second: %.4g s, forever\n", job->frames.count, job->frames.frames_per_second,
                  job->frames.count / job->frames.frames_per_second);
    if (lam_device_isa(job->device) == LAM_ISA_AUTO)
        say_plain("drawn    %" PRIu64 " triangles, %" PRIu64 " pixels covered, %.1f MB sent, %.1f MB\n",
                  frame->triangles, frame->pixels_covered, (double)frame->bytes_uploaded / 1e6,
                  (double)frame->memory_bytes / 1e6);
    else
        say_plain("drawn    %" PRIu64 " of %" PRIu64 " triangles, %" PRIu64 " pixels covered, %" PRIu64
                  " points lit, %.1f MB\n",
                  frame->triangles_binned, frame->triangles, frame->pixels_covered, frame->points_lit,
                  (double)frame->memory_bytes / 1e6);
    if (frame->rays)
        say_plain("rays     %" PRIu64 "\n", frame->rays);
    if (job->exposure_fitted)
        say_plain("exposure %.10g stops, selected for this picture\n", job->draw.exposure);
    if (frame->brightened > 0)
        say_plain("exposure raised by %.3g stops for a dark model\n", frame->brightened);
    if (frame->brightened < 0)
        say_plain("exposure lowered by %.3g stops for a white model\n", -frame->brightened);
    if (job->draw.output == LAM_OUTPUT_DEPTH)
        say_plain("depth    %.7g to %.7g\n", frame->depth_near, frame->depth_far);
    if (frame->ground)
        say_plain("ground   at height %.7g\n", frame->ground_height);
    if (frame->ground_square > 0)
        say_plain("         squares of %.7g\n", frame->ground_square);
}

static void table_of_times(const struct job *job)
{
    const lam_frame_report *frame = &job->times.frame;
    time_row("read", job->times.read);
    time_row("prepare", job->times.prepare);
    time_row("camera", job->times.camera);
    time_row("frame", frame->total_ms);
    time_row("  flatten", frame->frame_ms);
    if (frame->hierarchy_ms > 0)
        time_row("  hierarchy", frame->hierarchy_ms);
    if (lam_device_isa(job->device) == LAM_ISA_AUTO) {
        time_row("  lighting", frame->lighting_ms);
        time_row("  upload", frame->upload_ms);
        time_row("  draw", frame->draw_ms);
        time_row("  read", frame->read_ms);
    } else {
        time_row("  vertices", frame->vertices_ms);
        time_row("  triangles", frame->triangles_ms);
        if (frame->normals_ms > 0)
            time_row("  normals", frame->normals_ms);
        if (frame->occlusion_ms > 0)
            time_row("  occlusion", frame->occlusion_ms);
        time_row("  tiles", frame->tiles_ms);
        time_row("    coverage", frame->coverage_ms);
        time_row("    lighting", frame->lighting_ms);
        time_row("    resolve", frame->resolve_ms);
    }
    if (frame->edges_ms > 0)
        time_row("  edges", frame->edges_ms);
    if (job->times.frames > 1)
        say_plain("  %d frames, the median one above; %.2f to %.2f ms\n", job->times.frames, job->times.frame_min,
                  job->times.frame_max);
    time_row("encode", job->times.encode);
    time_row("total", job->times.total);
}

void report_table(const struct job *job)
{
    table_of_model(job);
    table_of_program(job);
    table_of_picture(job);
    table_of_times(job);
}

static void json_model(struct json *json, const struct job *job)
{
    const lam_scene *scene = job->scene;
    json_open(json, "model", '{');
    json_text(json, "path", job->model);
    if (scene) {
        lam_vec3 low, high;
        lam_scene_bounds(scene, &low, &high);
        json_text(json, "format", format_of(scene));
        json_count(json, "triangles", job->model_counts.triangles);
        json_count(json, "lines", job->model_counts.lines);
        json_count(json, "points", job->model_counts.points);
        json_count(json, "vertices", job->model_counts.vertices);
        json_count(json, "meshes", (uint64_t)job->model_counts.meshes);
        json_count(json, "objects", (uint64_t)job->model_counts.objects);
        json_count(json, "materials", (uint64_t)job->model_counts.materials);
        json_count(json, "lights", (uint64_t)job->model_counts.lights);
        json_text(json, "up", lam_up_name(lam_scene_up(scene)));
        json_open(json, "bounds", '{');
        json_vector(json, "min", low);
        json_vector(json, "max", high);
        json_close(json, '}');
    }
    json_close(json, '}');
}

// Writes the key "animation", which describes the frames.
static void json_frames(struct json *json, const struct job *job)
{
    if (!job->frames.count)
        return;
    json_open(json, "animation", '{');
    json_count(json, "frames", (uint64_t)job->frames.count);
    json_number(json, "frames_per_second", job->frames.frames_per_second);
    json_text(json, "last", job->frames.last);
    json_close(json, '}');
}

static void json_image(struct json *json, const struct job *job)
{
    json_open(json, "image", '{');
    json_text(json, "path", job->output);
    json_text(json, "format", job->format);
    json_count(json, "width", (uint64_t)job->image.width);
    json_count(json, "height", (uint64_t)job->image.height);
    int samples = job->draw.samples ? job->draw.samples : lam_default_samples(job->image.width, job->image.height);
    json_count(json, "samples", (uint64_t)samples);
    json_count(json, "bytes", job->bytes);
    json_number(json, "exposure_stops", job->draw.exposure);
    json_text(json, "exposure", job->exposure_fitted ? "auto" : "literal");
    if (job->draw.output == LAM_OUTPUT_DEPTH) {
        json_number(json, "depth_near", job->times.frame.depth_near);
        json_number(json, "depth_far", job->times.frame.depth_far);
    }
    if (job->times.frame.ground) {
        json_number(json, "ground_height", job->times.frame.ground_height);
        if (job->times.frame.ground_square > 0)
            json_number(json, "ground_square", job->times.frame.ground_square);
    }
    json_frames(json, job);
    json_close(json, '}');
}

static void json_camera(struct json *json, const lam_camera *camera)
{
    json_open(json, "camera", '{');
    json_vector(json, "eye", camera->eye);
    json_vector(json, "target", camera->target);
    json_vector(json, "up", camera->up);
    if (camera->ortho_half_height > 0)
        json_number(json, "ortho_half_height", camera->ortho_half_height);
    else
        json_number(json, "fovy_deg", degrees(camera->fovy_rad));
    bool fitted = camera->near_plane == 0 && camera->far_plane == 0;
    if (fitted) {
        json_none(json, "near");
        json_none(json, "far");
    } else {
        json_number(json, "near", camera->near_plane);
        json_number(json, "far", camera->far_plane);
    }
    json_close(json, '}');
}

static void json_device(struct json *json, const lam_device *device)
{
    lam_isa isa = lam_device_isa(device);
    json_open(json, "device", '{');
    json_text(json, "name", lam_device_name(device));
    json_text(json, "isa", isa == LAM_ISA_AUTO ? NULL : lam_isa_name(isa));
    json_count(json, "threads", (uint64_t)lam_device_threads(device));
    json_close(json, '}');
}

// Rounds the time to microseconds.
static void json_ms(struct json *json, const char *key, double ms)
{
    json_number(json, key, (double)(int64_t)(ms * 1e3 + 0.5) / 1e3);
}

static void json_times(struct json *json, const struct job_times *times)
{
    const lam_frame_report *frame = &times->frame;
    json_open(json, "times_ms", '{');
    json_ms(json, "read", times->read);
    json_ms(json, "prepare", times->prepare);
    json_ms(json, "camera", times->camera);
    json_ms(json, "frame", frame->total_ms);
    json_ms(json, "encode", times->encode);
    json_ms(json, "total", times->total);
    json_open(json, "steps", '{');
    json_ms(json, "flatten", frame->frame_ms);
    json_ms(json, "vertices", frame->vertices_ms);
    json_ms(json, "triangles", frame->triangles_ms);
    json_ms(json, "normals", frame->normals_ms);
    json_ms(json, "occlusion", frame->occlusion_ms);
    json_ms(json, "hierarchy", frame->hierarchy_ms);
    json_ms(json, "edges", frame->edges_ms);
    json_ms(json, "tiles", frame->tiles_ms);
    json_ms(json, "coverage", frame->coverage_ms);
    json_ms(json, "lighting", frame->lighting_ms);
    json_ms(json, "resolve", frame->resolve_ms);
    json_ms(json, "upload", frame->upload_ms);
    json_ms(json, "draw", frame->draw_ms);
    json_ms(json, "read", frame->read_ms);
    json_close(json, '}');
    json_count(json, "frames", (uint64_t)times->frames);
    json_ms(json, "frame_least", times->frame_min);
    json_ms(json, "frame_most", times->frame_max);
    json_close(json, '}');
}

static void json_counts(struct json *json, const lam_frame_report *frame)
{
    json_open(json, "counts", '{');
    json_count(json, "triangles", frame->triangles);
    json_count(json, "triangles_binned", frame->triangles_binned);
    json_count(json, "pixels_covered", frame->pixels_covered);
    json_count(json, "points_lit", frame->points_lit);
    json_count(json, "lights_evaluated", frame->lights_evaluated);
    json_count(json, "rays", frame->rays);
    json_count(json, "memory_bytes", frame->memory_bytes);
    json_count(json, "bytes_uploaded", frame->bytes_uploaded);
    json_close(json, '}');
}

static void json_option(void *user, const char *name, const char *value) { option_json(user, name, value); }

static void json_plan(struct json *json, const struct job *job)
{
    json_open(json, "planned", '{');
    json_text(json, "path", job->output);
    json_text(json, "format", job->format);
    json_count(json, "width", (uint64_t)job->options->picture.width);
    json_count(json, "height", (uint64_t)job->options->picture.height);
    json_count(json, "samples", (uint64_t)planned_samples(job->options));
    json_flag(json, "replaces", plan_replaces(job));
    json_frames(json, job);
    json_open(json, "options", '[');
    each_given_option(job->options, json_option, json);
    if (settings_are_used(job->options))
        option_json(json, "no-config", NULL);
    json_close(json, ']');
    json_close(json, '}');
}

void report_json(FILE *file, const struct job *job, const lam_error *error)
{
    struct json json = {.file = file};
    report_begin(&json);
    json_model(&json, job);
    settings_json(&json, job->options);
    if (job->planned) {
        json_plan(&json, job);
        json_camera(&json, &job->camera);
        json_device(&json, job->device);
    }
    // Camera, device and times are reported only for a written picture.
    if (job->written) {
        json_image(&json, job);
        json_camera(&json, &job->camera);
        json_device(&json, job->device);
        json_times(&json, &job->times);
        json_counts(&json, &job->times.frame);
    }
    json_open(&json, "warnings", '[');
    for (int i = 0; job->scene && lam_scene_warning(job->scene, i); i++)
        json_message(&json, NULL, lam_scene_warning(job->scene, i));
    json_close(&json, ']');
    json_error(&json, error);
    json_close(&json, '}');
    putc('\n', file);
}
