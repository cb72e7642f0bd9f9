// transforms.c: writes the cameras of numbered views (docs/cameras.md).
#include "transforms.h"

#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "console.h"
#include "output.h"
#include "show_option.h"

// Adds the intrinsics of a camera, in pixels from the picture's corner.
static void set_lens(json_t *object, const lam_camera *c, int width, int height)
{
    static const char *const keys[] = {"fl_x", "fl_y", "cx", "cy"};
    double lens[4];
    const bool flat = !lam_camera_intrinsics(c, width, height, LAM_CONVENTION_OPENGL, lens);
    if (flat)
        json_object_set_new(object, "ortho_half_height", json_real(c->ortho_half_height));
    else
        json_object_set_new(object, "camera_angle_x", json_real(2 * atan(width / (2 * lens[0]))));
    for (int i = 0; !flat && i < 4; i++)
        json_object_set_new(object, keys[i], json_real(lens[i]));
    json_object_set_new(object, "w", json_integer(width));
    json_object_set_new(object, "h", json_integer(height));
}

static json_t *frame_of(const struct job *job, int view, const char *picture)
{
    const lam_mat4 pose = job_camera_pose(&job->cameras[view]);
    json_t *frame = json_object(), *matrix = json_array();
    json_object_set_new(frame, "file_path", json_string(picture));
    for (int i = 0; i < 4; i++)
        json_array_append_new(matrix, json_pack("[f,f,f,f]", pose.m[i][0], pose.m[i][1], pose.m[i][2], pose.m[i][3]));
    json_object_set_new(frame, "transform_matrix", matrix);
    set_lens(frame, &job->cameras[view], job->views[view].width, job->views[view].height);
    return frame;
}

bool transforms_write(const struct job *job, const char *path, char *const *pictures, lam_error *error)
{
    const char *slash = strrchr(path, '/');
    const size_t folder = slash ? (size_t)(slash + 1 - path) : 0;
    json_t *root = json_object(), *frames = json_array();
    json_object_set_new(root, "lambent", json_string(lam_version()));
    json_object_set_new(root, "model", json_string(job->model));
    set_lens(root, &job->cameras[0], job->views[0].width, job->views[0].height);
    for (int i = 0; i < job->view_count; i++)
        if (strcmp(job->views[i].show, job->views[0].show) == 0) // one frame for all quantities
            json_array_append_new(
                frames, frame_of(job, i, pictures[i] + (strncmp(pictures[i], path, folder) == 0 ? folder : 0)));
    json_object_set_new(root, "frames", frames);
    for (int i = 0; i < job->view_count; i++) {
        const lam_output output =
            show_option_what(*job->views[i].show ? job->views[i].show : job->options->picture.show);
        json_t *names = json_object_get(root, lam_output_name(output)) ? NULL : json_array();
        for (int k = 1; names && job_label(job->scene, output, k); k++) {
            json_t *name = json_string(job_label(job->scene, output, k));
            json_array_append_new(names, name ? name : json_string(""));
        }
        if (json_array_size(names))
            json_object_set(root, lam_output_name(output), names);
        json_decref(names);
    }
    char *text = json_dumps(root, JSON_INDENT(1) | JSON_REAL_PRECISION(17));
    uint64_t size;
    bool ok =
        text ? output_save_bytes(&(lam_bytes){text, strlen(text)}, path, job->options->picture.durable, &size, error)
             : complain(error, LAM_MACHINE, "out of memory");
    free(text);
    json_decref(root);
    return ok;
}
