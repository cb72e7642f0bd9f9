// job.h: the work on one model: its options, its state and its results.
#ifndef JOB_H
#define JOB_H

#include "environment_cache.h"
#include "options.h"
#include "progress.h"

struct job_times {
    double start;                                // clock_ms() at the job's start
    double frame_start;                          // of an animation's frame: the default time limit is each frame's
    double read, prepare, camera, encode, total; // milliseconds
    lam_frame_report frame;                      // of the median frame
    double frame_min, frame_max;                 // over the --repeat frames
    int frames;
};

// The contents of the model before options add to it.
struct model_counts {
    uint64_t triangles, lines, points, vertices;
    int meshes, objects, materials, lights;
};

// Its contents in words: "1 triangle, 4 lines". Returns `out`.
enum { MODEL_COUNTS_SIZE = 100 };
const char *model_counts_text(const struct model_counts *counts, char out[MODEL_COUNTS_SIZE]);

// The bounding sphere of the model before --rotate; its radius is the unit r.
struct model_sphere {
    lam_vec3 centre;
    double radius;
};

// One of several pictures of a model that is read once.
struct job_view {
    int side;          // lam_side; −1: as the options have it
    int width, height; // pixels
};

// The data shared by two jobs whose pictures are compared.
struct job_shared {
    struct model_sphere sphere; // around both models
    lam_camera camera;          // if the flag below is set, in place of any other
    bool has_camera;
};

// The frames of --turntable and --sweep.
struct job_frames {
    int count;                // 0: one picture
    double frames_per_second; // of the animation
    char *first, *last;       // the paths of the frames; NULL: all are in one file
};

struct job {
    const struct options *options;
    const char *model;            // as typed
    const lam_bytes *model_bytes; // the model itself, which `model` is then a name for; NULL: a file
    const char *output;           // path of the picture; "-": standard output
    lam_bytes *picture_bytes;     // receives the picture's file, whose format `output` names; NULL: the file is written
    bool makes_folder;            // of a picture that the options name, too
    const lam_cancel *cancel;     // stops it; NULL: Ctrl-C does
    const char *format;           // of the picture: "png"
    lam_pixel_format pixels;      // that it is drawn with
    struct job_frames frames;
    struct animation *animation; // while one is made (animate.h); NULL: none is
    lam_scene *scene;            // NULL until the model is loaded
    bool keeps_scene;            // it is drawn again, by another job
    struct model_counts model_counts;
    lam_rig rig;                // the rig that drawing adds to the scene's own lights
    bool file_lights;           // the lights of a glTF file, in candela and lux, light it
    bool exposure_fitted;       // draw.exposure was found for this picture
    lam_light *unfilled;        // the scene's lights before lam_studio_fill scaled them; NULL: it did not. From malloc
    double fill_scale;          // by which it scaled them; 0: it did not
    bool studio;                // the built-in environment "studio" lights it, if no other is set
    struct model_sphere sphere; // before it was turned
    lam_camera camera;
    lam_image image;
    lam_rgba background; // behind the model
    lam_device *device;
    struct environment_cache *environments; // that other jobs share; NULL: none are
    const struct job_shared *shared;        // with another job; NULL: nothing is
    const struct job_view *views;           // the pictures to draw; NULL: one, as the options have it
    int view_count;
    lam_camera *cameras; // of the views; from malloc, by job_arrange
    lam_light *lights;   // those before the options' lights, which may depend on the camera; from malloc
    int light_count;
    uint64_t bytes; // size of the written file
    bool written;
    bool planned;                  // --dry-run: everything is ready to be drawn
    struct options own;            // the options, completed by the settings of a scene file
    lam_picture_settings settings; // of the scene file; none set if the model is not a scene file
    lam_draw_params draw;          // of the drawn picture
    struct job_times times;
    lam_error error; // code LAM_OK: none
};

// Loads the model, draws it and writes the picture. The caller fills in options, model, output, device and
// times.start; the steps fill in the rest, so that a report of a failure includes the completed steps. The caller
// frees the scene, the image and the paths of frames.
bool job_run(struct job *job, struct progress *progress, lam_error *error);

// The same for one of several pictures, after job_check_output, job_load and job_arrange; `output` is its file.
bool job_run_view(struct job *job, int view, struct progress *progress, lam_error *error);

// Returns whether the picture's name is one that can be written, and by which format. Fills in `format`.
bool job_check_output(struct job *job, lam_error *error);

// Frees the scene, the image, the lights and the paths of frames.
void job_free(struct job *job);

// Loads and draws; the picture stays in `image`. Ignores output and format.
bool job_draw(struct job *job, lam_pixel_format format, struct progress *progress, lam_error *error);

// Runs the first step of job_run, for commands that draw nothing: loads the model or builds the shape if the job has no
// scene, and applies the settings of a scene file.
bool job_load(struct job *job, struct progress *progress, lam_error *error);

// Runs the second step: applies the options for materials, rotations, camera and lights.
bool job_arrange(struct job *job, struct progress *progress, lam_error *error);

// Runs both steps and explains one pixel. NULL on failure.
lam_explanation *job_explain(struct job *job, int x, int y, struct progress *progress, lam_error *error);

// Runs both steps and makes the shaders of the picture. NULL on failure.
lam_shader *job_shader(struct job *job, struct progress *progress, lam_error *error);

// glass.c: notes that a transparent picture of coloured glass is meant for white, or that glass is drawn opaque.
void job_note_glass(struct job *job, const lam_draw_params *draw);

#endif
