// option_groups.h: stores the values of the options in one struct for each group.
#ifndef OPTION_GROUPS_H
#define OPTION_GROUPS_H

#include <lambent/camera.h>

enum { ACROSS_MAX = 2, SIZES_MAX = 16, SHOW_SIZE = 48 };

// The values of a repeatable option, in order.
struct texts {
    const char **items;
    int count;
};

// Selects when the exposure is automatic: only for files with lights in candela or lux, always, or never.
enum exposure_kind { EXPOSURE_BY_FILE, EXPOSURE_AUTO, EXPOSURE_LITERAL };

// Rigs in addition to the values of lam_rig. RIG_DARK is --rig none, which leaves only the ambient light.
enum { RIG_DARK = 100, RIG_DEFAULT };

// Selects whether a turntable's lights turn with the camera or with the model.
enum turntable_light { TURNTABLE_LIGHT_CAMERA, TURNTABLE_LIGHT_MODEL };

// --term: selects the protocol for pictures in a terminal.
enum term_kind { TERM_AUTO, TERM_KITTY, TERM_ITERM2, TERM_SIXEL, TERM_BLOCKS, TERM_OFF };

// --figure: selects the small figure of explain -o.
enum figure_name { FIGURE_VECTORS, FIGURE_BEAM, FIGURE_FOOTPRINT };
enum captions_style { CAPTIONS_FULL, CAPTIONS_PLAIN };

enum sandbox_mode { SANDBOX_AUTO, SANDBOX_REQUIRE, SANDBOX_OFF };
enum texture_filter { TEXTURE_FILTER_EXACT, TEXTURE_FILTER_HARDWARE };
enum shard_by { SHARD_BY_NAME, SHARD_BY_LIST };
enum device_name { DEVICE_AUTO, DEVICE_CPU, DEVICE_GL, DEVICE_GLES };

enum sheet_name {
    SHEET_SUMMARY,
    SHEET_TERMS,
    SHEET_STAGES,
    SHEET_LIGHT,
    SHEET_AMBIENT,
    SHEET_FRAMES,
    SHEET_SURFACES,
    SHEET_FILTERS,
    SHEET_TRUTH,
};

// The picture and its output file.
struct picture_options {
    const char *output;     // NULL means <model's name>.png; "-" means standard output
    int width, height;      // pixels
    bool has_size;          // whether the user gave a size
    const char *background; // as typed; NULL means transparent
    int color_mode;         // lam_color_mode
    int compress;           // lam_compress
    int quality;            // 0 means the format's default
    bool durable;
    int term;               // enum term_kind
    double exposure;        // in stops; valid if the kind is EXPOSURE_LITERAL
    int exposure_kind;      // enum exposure_kind
    const char *show;       // as typed (show_option.h); NULL means the picture
    double depth_scale;     // of depth in a PNG of 16 bits; 0: 8 bits
    const char *save_scene; // the scene file to write, or NULL
};

// Selects the data to read from a model file.
struct model_options {
    const char *scene, *variant, *animation; // as typed; NULL means the file's default
    double time_s;                           // valid if `has_time` is set
    double deflection;                       // lam_load_params.deflection; 0: the default
    bool has_time, lenient;
    struct texts sections; // as typed, checked
    int arrange;           // 0: a row, 1: a grid, 2: as the files place the models
};

// The camera.
struct view_options {
    int side;                          // lam_side
    double azimuth_deg, elevation_deg; // valid if the next flag is set
    bool has_azimuth, has_elevation;
    // The view of the picture, if it is one of several; NULL means `side`. Set by the job, not by an option.
    const lam_view *chosen;
    double zoom;        // 0 means 1
    double fov_deg;     // the vertical field of view of the fitted camera; 0 means 30
    int projection;     // 1 means orthographic
    int up;             // lam_up
    const char *camera; // as typed; NULL means a fitted camera
    // How far parts are moved apart, relative to their distance from the middle of the model along each axis; 0: not.
    lam_vec3 explode;
};

// Lights.
struct lighting_options {
    struct texts lights; // as typed, checked
    const char *look;    // as typed; NULL if there is none
    char *look_text;     // the look's text, which contains the strings of the look's options; allocated with malloc
    int look_first, look_lights; // the range of `lights` that the look added
    int rig;                     // lam_rig, RIG_DARK or RIG_DEFAULT
    bool has_rig;
    const char *ambient; // as typed; NULL if there is none
    double light_scale;
    bool has_light_scale;
};

// Materials.
struct material_options {
    struct texts materials; // as typed, checked
    struct texts back_materials;
    struct texts hidden;       // names of objects, parts or materials that are not drawn
    struct texts only;         // if there are any, all others are not drawn
    const char *model_color;   // the colour of all materials, as typed; NULL keeps their own colours
    double shininess, opacity; // valid if the next flag is set
    bool has_shininess, has_opacity;
    lam_rgb reflectivity; // valid if the next flag is set
    bool has_reflectivity;
};

// How surfaces are drawn.
struct shading_options {
    bool has_shading;
    const char *ground_color;                 // the ground's colour as typed; NULL means draw.ground_color
    const char *edge_color, *wireframe_color; // as typed; NULL means the colour in `draw`
    bool two_sided, one_sided, show_lights;
    int cull; // lam_cull
    bool has_cull;
    struct texts rotations; // as typed, checked
    // The rotations of all pictures on a sheet. The pictures share one camera. Set by `compare`, not by an option.
    struct texts sheet_rotations;
    int slices, stacks; // for built-in shapes and formulas; 0 means the shape's default
    bool flip;
    int normals;             // lam_normals
    double crease_angle_deg; // a negative value means the library's default
    const char *environment; // as typed; NULL if there is none
    bool reflection_map;     // --reflection-map has set `environment`
    double environment_rotation_deg;
};

// Surfaces defined by formulas (shape).
struct shape_options {
    // The formulas and the ranges of the command `shape`, as typed; NULL if not given. `parametric` uses the ranges of
    // u and v, `implicit` uses the ranges of x, y and z. The model is called "parametric" or "implicit".
    const char *parametric, *u_range, *v_range, *implicit, *x_range, *y_range, *z_range;
};

// Animations.
struct animation_options {
    int turntable;       // frames in a full turn; 0 if there is no turntable
    int turntable_light; // enum turntable_light
    struct texts sweeps; // as typed
    int frames;          // frames in a sweep; 0 means the default
    double fps;          // frames per second; 0 means the library's default
    bool stream;         // frames go to standard output, one after the other
    // Whether to add the rig's lights to the scene. Set by animations, not by an option.
    bool place_lights;
};

// Selects the device and the threads.
struct work_options {
    int threads;           // 0 means one per processor
    int isa;               // lam_isa
    int device;            // enum device_name
    const char *gl_device; // a number or part of a name; NULL means the first device
    int texture_filter;    // enum texture_filter
    int repeat;
};

// Limits (limit_options.h).
struct limits_options {
    double time_limit_s;         // 0 means the default; infinity means no limit
    uint64_t memory_limit_bytes; // 0 means the default; UINT64_MAX means no limit
    uint64_t triangle_limit;     // here and in the next fields, 0 means the library's default
    uint64_t pixel_limit;
    uint64_t file_limit_bytes;
    uint64_t expansion_limit, object_limit, layer_limit; // 0 means a limit that depends on the file size
    int json_depth_limit;
    bool files_inside; // a scene file may only use files in its own folder
    int sandbox;       // enum sandbox_mode
    struct texts allow_paths;
    // The number of models in progress at the same time, which share the default memory limit. Set by the loop over the
    // models; 0 means 1.
    int in_flight;
};

// Many models (render, batch).
struct batch_options {
    struct texts lists;  // files that list models
    const char *views;   // as typed: a list of views, or of azimuths if by_azimuth
    const char *cameras; // a file of cameras instead, or NULL
    int view_count;      // 0 means --view; 2 for a file of cameras, which has not been read yet
    bool by_azimuth;
    const char *shows; // as typed: a list of quantities
    int show_count;    // 0 means --show
    int sizes[SIZES_MAX][2], size_count;
    const char *journal;     // NULL means the command's default; "none" disables it
    const char *shard;       // as typed (batch_shard.h); NULL means all models
    int shard_by;            // enum shard_by
    const char *report_page; // NULL if no page is written
    int retry_failed;
    bool resume, skip_same, isolate, failures_ok;
    const char *jobs;          // "-" or a file; NULL if jobs are not read
    bool is_list;              // `jobs` is a list with a picture in each row
    int ahead;                 // 0 means the default
    uint64_t line_limit_bytes; // 0 means the default
};

// The viewer (view).
struct viewer_options {
    int port;            // 0 means any free port
    double idle_minutes; // valid if the next flag is set
    bool has_idle, no_open;
};

// Comparing pictures (diff, check).
struct diff_options {
    double tolerance, gain;
};

// Hashes of pictures (hash).
struct hash_options {
    const char *check;    // the file to compare with, or NULL
    const char *pictures; // the folder for the pictures; NULL means that pictures are not kept
    bool update;
};

// Models in another format (convert).
struct convert_options {
    bool thumbnail;
};

// Checks for 3D printing (info).
struct print_options {
    bool wanted;
    double overhang_deg;
};

// Captions (compare, plot, materials, check, explain).
struct captions_options {
    const char *font; // NULL means the system's font
    bool no_captions;
    const char *title;  // the page's title; NULL means the default
    int figure, style;  // the values of --figure and --captions
    struct texts texts; // captions of a sheet's pictures in order; the sheet adds missing captions
};

// Sheets (compare).
struct sheet_options {
    int name;            // enum sheet_name
    struct texts across; // as typed, at most ACROSS_MAX
};

// Contact sheets (sheet).
struct contact_options {
    int columns, per_page; // 0 means fitted
    bool to_scale;
};

// Plots (plot).
struct plot_options {
    double to; // the right end of the axis; 0 means a fitted axis
};

// Exercises (exercises).
struct exercises_options {
    int count, seed;
};

// Checking shaders (check).
struct check_options {
    const char *vertex;   // a file, or NULL
    const char *scenes;   // as typed; NULL means all scenes
    const char *contract; // as typed; NULL means automatic detection
    int light_frame;      // lam_light_frame; WORLD means the contract's default
    int highlight;        // lam_reflection; AUTO means the contract's default
    int terms;            // bits of lam_check_term; 0 means the terms that the shaders declare
    double stop_after_s;
    int search_limit;                                            // lam_check_params.max_pictures
    const char *class_folder, *csv;                              // NULL if not given
    const char *moodle, *gradescope, *submitty, *write_contract; // output files; NULL if not given
    struct texts roles;                                          // as typed
    bool explain_roles, list;
};

// Shaders (shader).
struct shader_options {
    int glsl;      // lam_glsl
    int lights_in; // lam_shader_lights
    int host;      // 1 means that C code is also written
    bool products;
    int style;           // lam_shader_style
    const char *mistake; // the id of a mistake, or "list"; NULL if not given
    bool lecture_device; // for a sheet of mistakes: OpenGL draws with the lecture-style shader that contains `mistake`
    int object;          // valid if the next flag is set
    bool has_object;
};

// The user's own defaults (settings_file.h).
struct settings_options {
    const char *file; // NULL means the user's own file
    bool none;
    char *values;                  // the strings to which `values` of struct options points, allocated with malloc
    const struct options *without; // the same options without the settings file, or NULL
};

// Printed output.
struct report_options {
    bool json, quiet, verbose, dry_run, version, help;
    bool brief_help; // true for -h, false for --help
};

#endif
