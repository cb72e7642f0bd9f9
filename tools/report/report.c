// report.c: reports the result of a job as a line, a table, or JSON.
#include "report.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "console.h"
#include "json.h"
#include "sandbox_start.h"
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
    if (camera->fx > 0)
        say_plain("fx %.7g, fy %.7g, cx %.7g, cy %.7g\n", camera->fx, camera->fy, camera->cx - 0.5, camera->cy - 0.5);
    else if (camera->ortho_half_height > 0)
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

static double rays_per_second(const lam_frame_report *frame)
{
    return frame->total_ms > 0 ? 1000 * (double)frame->rays / frame->total_ms : 0;
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
        say_plain("rays     %" PRIu64 ", %.3g million a second\n", frame->rays, rays_per_second(frame) * 1e-6);
    if (frame->paths > 0)
        say_plain("paths    %.10g from each surface in a pixel, estimated noise %.3g of 255\n", frame->paths,
                  frame->noise);
    if (job->exposure_fitted)
        say_plain("exposure %.10g stops, selected for this picture\n", job->draw.exposure);
    if (frame->brightened > 0)
        say_plain("exposure raised by %.3g stops for a dark model\n", frame->brightened);
    if (frame->brightened < 0)
        say_plain("exposure lowered by %.3g stops for a white model\n", -frame->brightened);
    if (frame->glass_materials)
        say_plain("glass    blended materials drawn as glass: %" PRIu64 "\n", frame->glass_materials);
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
    const struct model_counts *counts = &job->model_counts;
    json_open(json, "model", '{');
    json_text(json, "path", job->model);
    if (scene) {
        lam_vec3 low, high;
        lam_scene_bounds(scene, &low, &high);
        json_put(json, TEXT("format", format_of(scene)), COUNT("triangles", counts->triangles),
                 COUNT("lines", counts->lines), COUNT("points", counts->points), COUNT("vertices", counts->vertices),
                 COUNT("meshes", counts->meshes), COUNT("objects", counts->objects),
                 COUNT("materials", counts->materials), COUNT("lights", counts->lights),
                 TEXT("up", lam_up_name(lam_scene_up(scene))),
                 OBJECT("bounds", VECTOR("min", low), VECTOR("max", high)));
    }
    json_close(json, '}');
}

// Writes the key "animation", which describes the frames.
static void json_frames(struct json *json, const struct job *job)
{
    if (job->frames.count)
        json_put(json,
                 OBJECT("animation", COUNT("frames", job->frames.count),
                        NUMBER("frames_per_second", job->frames.frames_per_second), TEXT("last", job->frames.last)));
}

static void json_image(struct json *json, const struct job *job)
{
    const lam_frame_report *frame = &job->times.frame;
    int samples = job->draw.samples ? job->draw.samples : lam_default_samples(job->image.width, job->image.height);
    json_open(json, "image", '{');
    json_put(json, TEXT("path", job->output), TEXT("format", job->format), COUNT("width", job->image.width),
             COUNT("height", job->image.height), COUNT("samples", samples), COUNT("bytes", job->bytes),
             NUMBER("exposure_stops", job->draw.exposure), TEXT("exposure", job->exposure_fitted ? "auto" : "literal"));
    if (job->draw.output == LAM_OUTPUT_DEPTH)
        json_put(json, NUMBER("depth_near", frame->depth_near), NUMBER("depth_far", frame->depth_far));
    if (job_label(job->scene, job->draw.output, 1)) {
        json_open(json, "labels", '[');
        for (int i = 1; job_label(job->scene, job->draw.output, i); i++)
            json_text(json, NULL, job_label(job->scene, job->draw.output, i));
        json_close(json, ']');
    }
    if (frame->paths > 0)
        json_put(json, NUMBER("paths", frame->paths), NUMBER("noise", frame->noise),
                 NUMBER("rays_per_second", rays_per_second(frame)));
    if (frame->ground)
        json_put(json, NUMBER("ground_height", frame->ground_height));
    if (frame->ground && frame->ground_square > 0)
        json_put(json, NUMBER("ground_square", frame->ground_square));
    json_frames(json, job);
    json_close(json, '}');
}

static void json_camera(struct json *json, const lam_camera *c)
{
    const bool flat = c->ortho_half_height > 0, fitted = c->near_plane == 0 && c->far_plane == 0;
    json_open(json, "camera", '{');
    json_put(json, VECTOR("eye", c->eye), VECTOR("target", c->target), VECTOR("up", c->up));
    if (c->fx > 0)
        json_put(json, NUMBER("fx", c->fx), NUMBER("fy", c->fy), NUMBER("cx", c->cx - 0.5), NUMBER("cy", c->cy - 0.5));
    else
        json_put(json,
                 NUMBER(flat ? "ortho_half_height" : "fovy_deg", flat ? c->ortho_half_height : degrees(c->fovy_rad)));
    json_put(json, NUMBER("near", fitted ? (double)NAN : c->near_plane),
             NUMBER("far", fitted ? (double)NAN : c->far_plane));
    json_close(json, '}');
}

static void json_device(struct json *json, const lam_device *device)
{
    lam_isa isa = lam_device_isa(device);
    json_put(json, OBJECT("device", TEXT("name", lam_device_name(device)),
                          TEXT("isa", isa == LAM_ISA_AUTO ? NULL : lam_isa_name(isa)),
                          COUNT("threads", lam_device_threads(device))));
}

static void json_times(struct json *json, const struct job_times *times)
{
    const lam_frame_report *frame = &times->frame;
    json_put(
        json,
        OBJECT("times_ms", MILLISECONDS("read", times->read), MILLISECONDS("prepare", times->prepare),
               MILLISECONDS("camera", times->camera), MILLISECONDS("frame", frame->total_ms),
               MILLISECONDS("encode", times->encode), MILLISECONDS("total", times->total),
               OBJECT("steps", MILLISECONDS("flatten", frame->frame_ms), MILLISECONDS("vertices", frame->vertices_ms),
                      MILLISECONDS("triangles", frame->triangles_ms), MILLISECONDS("normals", frame->normals_ms),
                      MILLISECONDS("occlusion", frame->occlusion_ms), MILLISECONDS("hierarchy", frame->hierarchy_ms),
                      MILLISECONDS("edges", frame->edges_ms), MILLISECONDS("tiles", frame->tiles_ms),
                      MILLISECONDS("coverage", frame->coverage_ms), MILLISECONDS("lighting", frame->lighting_ms),
                      MILLISECONDS("resolve", frame->resolve_ms), MILLISECONDS("upload", frame->upload_ms),
                      MILLISECONDS("draw", frame->draw_ms), MILLISECONDS("read", frame->read_ms)),
               COUNT("frames", times->frames), MILLISECONDS("frame_least", times->frame_min),
               MILLISECONDS("frame_most", times->frame_max)),
        OBJECT("counts", COUNT("triangles", frame->triangles), COUNT("triangles_binned", frame->triangles_binned),
               COUNT("pixels_covered", frame->pixels_covered), COUNT("points_lit", frame->points_lit),
               COUNT("lights_evaluated", frame->lights_evaluated), COUNT("rays", frame->rays),
               COUNT("memory_bytes", frame->memory_bytes), COUNT("bytes_uploaded", frame->bytes_uploaded)));
}

static void json_option(void *user, const char *name, const char *value) { option_json(user, name, value); }

static void json_plan(struct json *json, const struct job *job)
{
    json_open(json, "planned", '{');
    json_put(json, TEXT("path", job->output), TEXT("format", job->format), COUNT("width", job->options->picture.width),
             COUNT("height", job->options->picture.height), COUNT("samples", planned_samples(job->options)),
             FLAG("replaces", plan_replaces(job)));
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
    }
    json_warnings(&json, job->scene);
    json_error(&json, error);
    json_close(&json, '}');
    putc('\n', file);
}
