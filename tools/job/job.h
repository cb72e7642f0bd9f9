// job.h: one model on its way to a picture: what was asked, what came of it.
#ifndef JOB_H
#define JOB_H

#include "options.h"
#include "progress.h"

struct job_times {
    double start;                                // clock_ms() at the job's start
    double read, prepare, camera, encode, total; // milliseconds
    lam_frame_report frame;                      // of the median frame
    double frame_least, frame_most;              // over the --repeat frames
    int frames;
};

// What the model holds, before options add to it.
struct model_counts {
    uint64_t triangles, vertices;
    int meshes, objects, materials, lights;
};

struct job {
    const struct options *options;
    const char *model;  // as the user wrote it
    const char *output; // path of the picture; "-": standard output
    const char *format; // of the picture: "png"
    lam_scene *scene;   // NULL until it is read
    struct model_counts model_counts;
    lam_rig rig; // what drawing adds to the scene's own lights
    lam_camera camera;
    lam_image image;
    lam_rgba background; // behind the model, as --background says
    lam_device *device;
    uint64_t bytes; // of the file written
    bool written;
    struct options own;            // the options with what a scene file says where the command line says nothing
    lam_picture_settings settings; // of the scene file; nothing given: the model is none
    lam_draw_params draw;          // as it was drawn
    struct job_times times;
    lam_error error; // code LAM_OK: none
};

// Reads, draws and writes. The job comes with its options, model, output, device and start filled in; it is
// filled step by step, so that on failure what was done can be told. The caller frees its scene and image.
bool job_run(struct job *job, struct progress *progress, lam_error *error);

// The same up to the drawn picture, which stays in `image`: output and format are not looked at.
bool job_draw(struct job *job, lam_pixel_format format, struct progress *progress, lam_error *error);

// Reads the model or makes the shape, and takes over what a scene file says: the first step of job_run, for commands
// that draw nothing.
bool job_load(struct job *job, struct progress *progress, lam_error *error);

// The second step: materials, turns, the camera and the lights, as the options ask.
bool job_arrange(struct job *job, struct progress *progress, lam_error *error);

// The same up to the drawing, and then one pixel is explained. NULL on failure.
lam_explanation *job_explain(struct job *job, int x, int y, struct progress *progress, lam_error *error);

// The same up to the drawing, and then the shaders are made that would draw it. NULL on failure.
lam_shader *job_shader(struct job *job, struct progress *progress, lam_error *error);

#endif
