// job_steps.h: the steps of a job, which single pictures and animations combine differently.
#ifndef JOB_STEPS_H
#define JOB_STEPS_H

#include "job.h"

// Fills the control of the next library call: remaining time, memory limit, interrupt flag, progress bar (may be NULL).
bool job_control(const struct job *job, struct progress *progress, lam_control *control, lam_error *error);

// Returns a camera that fits the scene. If the options rotate the model, the camera fits every rotation about `centre`.
lam_camera job_fit_camera(const lam_scene *scene, lam_vec3 centre, const struct options *o, lam_rig rig);

// Make a scene with these vertices (at most 32), or the corners of a box, to which a camera can be fitted.
lam_scene *job_points_scene(const lam_vec3 *points, int count, lam_up up, lam_error *error);
lam_scene *job_box_scene(lam_vec3 low, lam_vec3 high, lam_up up, lam_error *error);

// Sets the options for the picture of one of several views.
void job_choose_view(struct job *job, const struct job_view *view);

// Places the camera of each view, and rotates the model.
bool job_place_camera(struct job *job, lam_error *error);

// Updates the lights for another camera, if the options added lights.
bool job_light_again(struct job *job, lam_error *error);

// Allocates job->image. Fails with LAM_LIMIT.
bool job_make_image(struct job *job, lam_pixel_format format, lam_error *error);

// Draws the arranged scene `count` times and stores the reports in `reports`. `from` and `span` are the start and the
// length of this section of the progress bar.
bool job_draw_frames(struct job *job, double from, double span, int count, lam_frame_report *reports,
                     struct progress *progress, lam_error *error);

// Sets the job's times and the report of the median frame from the reports of `count` frames. Sorts the reports.
void job_time_frames(struct job *job, lam_frame_report *reports, int count);

// Returns the parameters for encoding; `control` must stay valid.
lam_save_params job_save_params(const struct job *job, const lam_control *control);

// Writes job->image to job->output, and adds the file's size to job->bytes and the time to times.encode.
bool job_write(struct job *job, lam_error *error);

// --- the scene (job_scene.c)

// Applies materials, sides and the rig, before the camera is placed and the model is rotated. Fills `sphere`.
bool job_apply_options(struct job *job, const lam_control *control, struct model_sphere *sphere, lam_error *error);

// Gets the axis that the rotations of this picture and of the other pictures on its sheet share. If there are several
// axes, `axis` is 0, 0, 0. Returns false if there is no rotation.
bool job_turn_axis(const struct options *o, lam_vec3 *axis);

// Rotates the model about the sphere's centre.
bool job_turn(struct job *job, const struct model_sphere *sphere, lam_error *error);

// Adds the lights, after the camera has been placed.
bool job_light(struct job *job, const struct model_sphere *sphere, lam_error *error);

// Returns the drawing parameters for the options, without the background.
lam_draw_params draw_params_of(const struct options *o, lam_rig rig);

// Notes that a transparent picture of tinted glass is only correct over white, or that glass is drawn opaque.
void job_note_glass(struct job *job, const lam_draw_params *draw);

#endif
