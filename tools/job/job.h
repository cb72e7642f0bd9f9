// job.h: a job: the options, state and results of drawing one model.
#ifndef JOB_H
#define JOB_H

#include "environment_cache.h"
#include "options.h"
#include "progress.h"

#include <lambent/camera.h>
#include <lambent/scene.h>
#include <lambent/scene_file.h>
#include <lambent/shader.h>

struct job_times {
    double start; // clock_ms() at the job's start
    // the start of the current frame of an animation; the default time limit applies to each frame
    double frame_start;
    double read, prepare, camera, encode, total; // milliseconds
    lam_frame_report frame;                      // the report of the median frame
    double frame_min, frame_max;                 // the minimum and maximum over the --repeat frames
    int frames;
};

// The model's contents, before the options add objects and lights.
struct model_counts {
    uint64_t triangles, lines, points, vertices;
    int meshes, objects, materials, lights;
};

// Describes the contents: "1 triangle, 4 lines". Returns `out`.
enum { MODEL_COUNTS_SIZE = 100 };
const char *model_counts_text(const struct model_counts *counts, char out[MODEL_COUNTS_SIZE]);

// The bounding sphere of the model before --rotate; its radius is the unit r in positions of lights.
struct model_sphere {
    lam_vec3 centre;
    double radius;
};

// One of several pictures of a model that is loaded once.
struct job_view {
    char name[LAM_VIEW_NAME_SIZE]; // {view}
    bool given;                    // `view` is set; otherwise the options select the view
    bool numbered;                 // one of many directions, whose cameras are written to transforms.json
    lam_view view;
    char show[SHOW_SIZE]; // {show}; "" if the options select the quantity
    char *camera;         // text for lam_camera_parse instead of `view`, allocated with malloc, or NULL
    int width, height;    // pixels
};

// Data shared by two jobs whose pictures are compared.
struct job_shared {
    struct model_sphere sphere; // around both models
    lam_camera camera;          // the camera of both pictures if has_camera is set
    bool has_camera;
};

// The frames of --turntable and --sweep.
struct job_frames {
    int count;                // the number of frames; 0 means one picture
    double frames_per_second; // the frame rate of the animation
    char *first, *last;       // the paths of the frames; NULL if one file contains all frames
};

struct job {
    const struct options *options;
    const char *model;            // as typed
    bool measure;                 // lam_load_params.measure
    const lam_bytes *model_bytes; // the bytes of the model that `model` names; NULL if the model is a file
    const char *output;           // path of the picture; "-" means standard output
    lam_bytes *picture_bytes;     // receives the picture in the format of `output`; NULL if a file is written
    bool one_of_many;  // several models share the options, so a name given to --hide may be missing from this model
    bool makes_folder; // creates the picture's folder even if the user gave the picture's path
    const lam_cancel *cancel; // stops the job; if NULL, only Ctrl-C does
    const char *format;       // the format of the picture: "png"
    lam_pixel_format pixels;  // the pixel format for drawing
    struct job_frames frames;
    struct animation *animation; // during an animation (animate_frame.h); otherwise NULL
    lam_scene *scene;            // NULL until the model is loaded
    bool keeps_scene;            // another job will draw the scene again
    bool keeps_axes;             // the model is not turned upright if it lies (`--up auto` means file)
    struct model_counts model_counts;
    lam_rig rig;          // the rig that drawing adds to the scene's own lights
    bool file_lights;     // whether the model is lit by the lights of a glTF file, which are in candela and lux
    bool exposure_fitted; // whether draw.exposure was computed for this picture
    // the scene's lights before lam_studio_fill scaled them, allocated with malloc; NULL if not scaled
    lam_light *unfilled;
    double fill_scale;          // the factor of lam_studio_fill; 0 if not scaled
    bool studio;                // whether the built-in environment "studio" lights the model if no other is set
    struct model_sphere sphere; // before the rotation
    lam_camera camera;
    lam_image image;
    lam_rgba background; // behind the model
    lam_device *device;
    struct environment_cache *environments; // shared with other jobs; NULL if not shared
    const struct job_shared *shared;        // shared with another job; NULL if not shared
    const struct job_view *views;           // the pictures to draw; NULL means one picture from the options
    int view_count;
    lam_camera *cameras; // one camera per view, allocated by job_arrange with malloc
    // the scene's lights without the lights of the options (these may depend on the camera); allocated with malloc
    lam_light *lights;
    int light_count;
    char comment[LAM_COMMENT_SIZE]; // of a PNG (lam_device_comment)
    uint64_t bytes;                 // size of the written file
    bool written;
    bool planned;                  // --dry-run: loading and arranging have succeeded
    struct options own;            // the options, completed by the settings of a scene file
    lam_picture_settings settings; // the scene file's settings; empty if the model is not a scene file
    lam_draw_params draw;          // parameters of the drawn picture
    struct job_times times;
    lam_error error; // the error, or the code LAM_OK if the job has not failed
};

// Loads the model, draws it and writes the picture. The caller fills in options, model, output, device and times.start;
// the steps fill in the rest, so that the report of a failure includes the completed steps. The caller frees the scene,
// the image and the paths of frames.
bool job_run(struct job *job, struct progress *progress, lam_error *error);

// Returns the pose of a camera, with the axes of OpenGL and a rotation of at most 30 binary digits. A camera with
// this pose has exactly this pose again, so that a camera that is written to a file and read draws the same bytes.
lam_mat4 job_camera_pose(const lam_camera *camera);

// Draws and writes one of several pictures, after job_check_output, job_load and job_arrange. `output` is the file of
// this picture.
bool job_run_view(struct job *job, int view, struct progress *progress, lam_error *error);

// Returns the name of the object or part with a label (LAM_OUTPUT_OBJECT_ID, LAM_OUTPUT_PART_ID), "" if it has none. Labels
// start at 1. Returns NULL past the last label, and for other outputs.
const char *job_label(const lam_scene *scene, lam_output output, int label);

// Returns whether the picture's name has a writable format, and sets `format`.
bool job_check_output(struct job *job, lam_error *error);

// If `print` is true, prints the scene's warnings with index *first and above, but each text only once. Sets *first to
// the number of warnings. Returns the number of warnings with new texts.
int job_say_warnings(const struct job *job, int *first, bool print);

// Adds the warnings of another scene that `to` does not have yet.
void job_add_warnings(lam_scene *to, const lam_scene *from);

// Frees the scene, the image, the lights and the paths of frames.
void job_free(struct job *job);

// Loads the model and draws it into `image`. Ignores `output` and `format`.
bool job_draw(struct job *job, lam_pixel_format format, struct progress *progress, lam_error *error);

// Runs the first step of job_run, for commands that draw nothing: loads the model or builds the shape if the job has no
// scene, and applies the settings of a scene file.
bool job_load(struct job *job, struct progress *progress, lam_error *error);

// Cuts the model by the sections of the options or the scene file. job_arrange does this after it has placed the camera.
bool job_section(struct job *job, const lam_control *control, lam_error *error);

// Runs the second step: applies the options for materials, rotations, camera and lights.
bool job_arrange(struct job *job, struct progress *progress, lam_error *error);

// Runs both steps and explains one pixel. Returns NULL on failure.
struct lam_explanation *job_explain(struct job *job, int x, int y, struct progress *progress, lam_error *error);

// Runs both steps and makes the shaders of the picture. Returns NULL on failure.
lam_shader *job_shader(struct job *job, struct progress *progress, lam_error *error);

// --- checks picture options that exclude each other.

// Checks the options. Fails with LAM_BAD_ARGUMENT.
bool job_check_options(const struct options *options, lam_error *error);

// Returns whether `model` names a built-in shape, or selects a formula of the options ("parametric" or "implicit").
bool job_model_is_shape(const char *model);

// Returns the formula in the options. Without a formula, the returned `text` is NULL.
lam_formula job_formula(const struct options *options);
// Returns whether the formula options match the model. Fails with LAM_BAD_ARGUMENT.
bool job_check_formula(const char *model, const struct options *options, lam_error *error);

// --- prevents outputs from replacing the files of the model.

// Returns whether writing `path` would leave the scene's input files unchanged. Fails with LAM_BAD_ARGUMENT. With
// `own`, `path` may be the scene file itself, but not a file that the scene file names.
bool job_check_inputs(const lam_scene *scene, const char *path, bool own, lam_error *error);

// Returns whether both paths refer to the same existing file.
bool job_is_same_file(const char *a, const char *b);

// --- suggestions for a model that cannot be read.

// If a model cannot be read, and the program can guess the user's intention, adds a suggestion to the error.
void model_guess(const char *model, const struct options *options, lam_error *error);

#endif
