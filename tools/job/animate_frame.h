// animate_frame.h: the state of an animation, and the parts of job_arrange that differ in one.
#ifndef ANIMATE_FRAME_H
#define ANIMATE_FRAME_H

#include "job.h"
#include "job_scene.h"
#include "sweep_option.h"

struct animation {
    const struct options *given; // of the command line
    const char *pattern;         // the picture's name, which may contain {frame}
    struct options frame;        // of the frame being drawn
    int sweep_count;
    struct sweep *sweeps;
    struct sweep_words *words; // of the sweeps, then of the turntable
    int index, count;          // of frames
    bool loads;                // each frame reads the model
    bool environment;          // the scene has it: only the first frame loads it
    bool drawn;                // the first frame: the exposure is known
    bool has_sphere, has_camera;
    struct model_sphere sphere; // before any turn
    lam_camera camera;          // of the first frame
    lam_up up;
};

bool animation_wanted(const struct options *o);

// Returns the option that asks for frames, for messages: "turntable" or "sweep".
const char *animation_option(const struct options *o);

// Returns whether an option is swept.
bool animation_sweeps(const struct animation *a, const char *option);

// Returns the share of a full turn that a frame has made, in degrees.
double animation_turn(const struct animation *a, int frame);

// Without an animation these do nothing. animation_sphere: all frames turn about one point. animation_camera: the camera
// that was placed for all frames; false: none yet. animation_arrange: after the lights were added, gives them the frame's
// values, and takes the camera to where the frame is seen from.
void animation_sphere(const struct job *job, struct model_sphere *sphere);
bool animation_camera(const struct job *job, lam_camera *camera);
bool animation_arrange(struct job *job, lam_error *error);

#endif
