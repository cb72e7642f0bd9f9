// animate_frame.h: the state of an animation, and the steps that job_arrange adds for an animation.
#ifndef ANIMATE_FRAME_H
#define ANIMATE_FRAME_H

#include "job.h"
#include "job_steps.h"
#include "sweep_option.h"

struct animation {
    const struct options *given; // the options of the command line
    const char *pattern;         // the picture's name, which may contain {frame}
    struct options frame;        // the options of the current frame
    int sweep_count;
    struct sweep *sweeps;
    struct sweep_words *words; // the options that the sweeps set, then the option that the turntable sets
    int index, count;          // the frame's index, and the number of frames
    bool loads;                // whether the model is loaded again for each frame
    bool environment;          // the scene contains the environment, which only the first frame loads
    bool drawn;                // the first frame was drawn, so the exposure is known
    bool has_sphere, has_camera;
    struct model_sphere sphere; // before any rotation
    lam_camera camera;          // the camera of the first frame
    lam_up up;
    lam_scene *warnings; // an empty scene with the warnings of frames whose models are freed; NULL if there are none
};

bool animation_wanted(const struct options *o);

// Returns the option that requests frames, for messages: "turntable" or "sweep".
const char *animation_option(const struct options *o);

// Returns whether an option is swept.
bool animation_sweeps(const struct animation *a, const char *option);

// Returns the turntable's angle in a frame, in degrees.
double animation_turn(const struct animation *a, int frame);

// Without an animation these functions do nothing. animation_sphere sets the common centre of rotation.
// animation_camera gets the camera for all frames; it returns false if this camera is not known yet. animation_arrange
// sets the swept values of the lights, which must already be in the scene, and moves the camera to its position for the
// frame.
void animation_sphere(const struct job *job, struct model_sphere *sphere);
bool animation_camera(const struct job *job, lam_camera *camera);
bool animation_arrange(struct job *job, lam_error *error);

// --- draws the frames of --turntable and --sweep from one loaded scene.

// Checks combinations of animation options. Fails with LAM_BAD_ARGUMENT.
bool animation_check(const struct options *o, lam_error *error);

// Replaces job_run for an animation: loads the model, and draws and writes the frames.
bool animation_run(struct job *job, struct progress *progress, lam_error *error);

// Returns whether `path` names the file of a frame. `pattern` is the file name, with {frame} instead of the frame
// number.
bool animation_is_frame(const struct options *o, const char *pattern, const char *path);

#endif
