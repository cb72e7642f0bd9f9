// diff_draw.c: draws an old and a new model with one camera and measures the difference between the pictures.
#include "diff.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base64.h"
#include "console.h"
#include "job_steps.h"
#include "scene_settings.h"

const char *const change_names[CHANGE_COUNT] = {"changed", "failed", "added", "removed", "equal"};

// --- the camera

struct box {
    lam_vec3 minimum, maximum;
};

static bool box_of(const lam_scene *a, const lam_scene *b, struct box *box)
{
    struct box other;
    bool has = lam_scene_bounds(a, &box->minimum, &box->maximum);
    if (!lam_scene_bounds(b, &other.minimum, &other.maximum))
        return has;
    if (!has) {
        *box = other;
        return true;
    }
    box->minimum = (lam_vec3){fmin(box->minimum.x, other.minimum.x), fmin(box->minimum.y, other.minimum.y),
                              fmin(box->minimum.z, other.minimum.z)};
    box->maximum = (lam_vec3){fmax(box->maximum.x, other.maximum.x), fmax(box->maximum.y, other.maximum.y),
                              fmax(box->maximum.z, other.maximum.z)};
    return true;
}

// Computes the sphere around both models. Also computes a camera that shows both models, unless the options or the new
// model's scene file define a camera.
static bool share(struct job *old, struct job *new, struct job_shared *shared, lam_error *error)
{
    // If the up axes differ, no single camera shows both models upright, so each model uses its own camera.
    if (lam_scene_up(old->scene) != lam_scene_up(new->scene)) {
        old->shared = new->shared = NULL;
        return true;
    }
    struct box box = {0};
    box_of(old->scene, new->scene, &box);
    lam_vec3 size = {box.maximum.x - box.minimum.x, box.maximum.y - box.minimum.y, box.maximum.z - box.minimum.z};
    double radius = sqrt(size.x * size.x + size.y * size.y + size.z * size.z) / 2;
    shared->sphere.centre =
        (lam_vec3){box.minimum.x + size.x / 2, box.minimum.y + size.y / 2, box.minimum.z + size.z / 2};
    shared->sphere.radius = radius > 0 ? radius : 1;
    if (new->options->view.camera || scene_settings_has_camera(new))
        return true;
    lam_scene *scene = job_box_scene(box.minimum, box.maximum, lam_scene_up(new->scene), error);
    if (!scene)
        return false;
    shared->camera = job_fit_camera(scene, shared->sphere.centre, new->options, LAM_RIG_AUTO);
    shared->has_camera = true;
    lam_scene_free(scene);
    return true;
}

// --- the pictures

static bool picture(struct job *job, struct progress *progress, double from, lam_error *error)
{
    lam_frame_report report;
    return job_make_image(job, LAM_RGBA8, error) && job_draw_frames(job, from, 0.25, 1, &report, progress, error);
}

// Draws both models with the picture size, camera and exposure of the new model.
static bool draw_both(struct job *old, struct job *new, struct progress *progress, lam_error *error)
{
    struct job_shared shared = {0};
    if (!job_load(old, progress, error))
        return false;
    old->own.picture.width = new->options->picture.width;
    old->own.picture.height = new->options->picture.height;
    old->shared = new->shared = &shared;
    bool ok =
        share(old, new, &shared, error) && job_arrange(new, progress, error) && picture(new, progress, 0.5, error);
    if (ok) {
        shared.camera = new->camera;
        shared.has_camera = true;
        if (new->exposure_fitted) {
            old->own.picture.exposure_kind = EXPOSURE_LITERAL;
            old->own.picture.exposure = new->draw.exposure;
        }
        ok = job_arrange(old, progress, error) && picture(old, progress, 0.75, error);
    }
    old->shared = new->shared = NULL;
    return ok;
}

// --- the record

static bool keep(json_t *found, const char *key, const lam_image *image, bool raw, lam_error *error)
{
    lam_bytes png = {0};
    lam_save_params params = {.threads = 1, .raw = raw};
    size_t length;
    if (!lam_image_encode(image, "png", &params, &png, error))
        return false;
    char *text = base64_encode(png.data, png.size, &length);
    bool ok = text && json_object_set_new(found, key, json_string(text)) == 0;
    free(text);
    lam_bytes_free(&png);
    return ok || complain(error, LAM_MACHINE, "out of memory");
}

static void put_counts(json_t *found, const char *key, const struct model_counts *counts)
{
    char text[MODEL_COUNTS_SIZE];
    json_object_set_new(found, key, json_string(model_counts_text(counts, text)));
}

static bool put_difference(const struct model_diff *diff, const struct job *old, const struct job *new, json_t *found,
                           lam_error *error)
{
    lam_difference d;
    lam_image where = {0};
    if (!lam_image_compare(&old->image, &new->image, &d, error))
        return false;
    bool changed = d.maximum > diff->options->diff.tolerance / 255.0;
    json_object_set_new(found, "change", json_string(change_names[changed ? CHANGE_CHANGED : CHANGE_EQUAL]));
    json_object_set_new(found, "maximum", json_real(d.maximum));
    json_object_set_new(found, "mean", json_real(d.mean));
    json_object_set_new(found, "share_over_1", json_real(d.share_over_1));
    if (!changed || !diff->page || !shared_count_take(diff->rows, PAGE_ROWS))
        return true;
    bool ok = keep(found, "before", &old->image, false, error) && keep(found, "after", &new->image, false, error) &&
              lam_image_difference(&old->image, &new->image, (float)diff->options->diff.gain, &where, error) &&
              keep(found, "where", &where, true, error);
    lam_image_free(&where);
    return ok;
}

static bool draw_one(const struct model_diff *diff, bool is_new, struct job *job, struct progress *progress,
                     json_t *found, lam_error *error)
{
    if (!job_draw(job, LAM_RGBA8, progress, error))
        return false;
    json_object_set_new(found, "change", json_string(change_names[is_new ? CHANGE_ADDED : CHANGE_REMOVED]));
    put_counts(found, is_new ? "counts_after" : "counts_before", &job->model_counts);
    return !diff->page || !shared_count_take(diff->rows, PAGE_ROWS) ||
           keep(found, is_new ? "after" : "before", &job->image, false, error);
}

bool diff_draw(void *user, size_t model, struct job *job, struct progress *progress, json_t *found, lam_error *error)
{
    const struct model_diff *diff = user;
    const struct model_pair *pair = &diff->pairs[model];
    if (!pair->old || !pair->new)
        return draw_one(diff, pair->new != NULL, job, progress, found, error);
    struct job old = {.options = job->options,
                      .model = pair->old,
                      .cancel = job->cancel,
                      .device = job->device,
                      .environments = job->environments,
                      .times.start = job->times.start};
    if (!job_load(job, progress, error))
        return false;
    bool ok = draw_both(&old, job, progress, error) && put_difference(diff, &old, job, found, error);
    if (ok) {
        put_counts(found, "counts_before", &old.model_counts);
        put_counts(found, "counts_after", &job->model_counts);
    } else if (!old.scene) {
        job->model = pair->old; // the report then names the old model
    }
    if (old.scene)
        job_add_warnings(job->scene, old.scene);
    job_free(&old);
    return ok;
}

enum change diff_change_of(const json_t *record)
{
    const char *name = json_string_value(json_object_get(record, "change"));
    const char *class = json_string_value(json_object_get(record, "class"));
    for (int i = 0; name && class && strcmp(class, "ok") == 0 && i < CHANGE_COUNT; i++)
        if (strcmp(change_names[i], name) == 0)
            return (enum change)i;
    return CHANGE_FAILED;
}
