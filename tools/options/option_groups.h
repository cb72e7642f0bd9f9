// option_groups.h: the values of the options, a struct for each group.
#ifndef OPTION_GROUPS_H
#define OPTION_GROUPS_H

#include <lambent/lambent.h>

enum { ACROSS_MAX = 2, VIEWS_MAX = 16 };

// The values of an option that may be repeated, in order.
struct texts {
    const char **items;
    int count;
};

// Whether the exposure is computed for the picture: for the lights of a file in candela and lux, always, never.
enum exposure_kind { EXPOSURE_BY_FILE, EXPOSURE_AUTO, EXPOSURE_LITERAL };

// --rig none: only the ambient light. A value in addition to lam_rig's.
enum { RIG_DARK = 100, RIG_DEFAULT };

// The frame in which the lights of a turntable are fixed.
enum turntable_light { TURNTABLE_LIGHT_CAMERA, TURNTABLE_LIGHT_MODEL };

// --term: the protocol of pictures in a terminal.
enum term_kind { TERM_AUTO, TERM_KITTY, TERM_ITERM2, TERM_SIXEL, TERM_BLOCKS, TERM_OFF };

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
};

// The picture and its file.
struct picture_options {
    const char *output;     // NULL: <model's name>.png; "-": standard output
    int width, height;      // pixels
    bool has_size;          // the size was given
    const char *background; // as written; NULL: clear
    int color_mode;         // lam_color_mode
    int compress;           // lam_compress
    int quality;            // 0: the format's own
    bool durable;
    int term;               // enum term_kind
    double exposure;        // stops, where the next is literal
    int exposure_kind;      // enum exposure_kind
    const char *show;       // as written (show_option.h); NULL: the picture
    const char *save_scene; // the scene file to write; NULL: none
};

// Data to read from a model file.
struct model_options {
    const char *scene, *variant, *animation; // as written; NULL: the file's own choice
    double time_s;                           // valid if the flag below is set
    bool has_time, lenient;
};

// The camera.
struct view_options {
    int side;                          // lam_side
    double azimuth_deg, elevation_deg; // valid if the flag below is set
    bool has_azimuth, has_elevation;
    double zoom;        // 0: 1
    double fov_deg;     // of the fitted camera, vertical; 0: 30
    int projection;     // 1: orthographic
    int up;             // lam_up
    const char *camera; // as written; NULL: fitted
};

// Lights.
struct lighting_options {
    struct texts lights;         // as written, checked
    const char *look;            // as written; NULL: none
    char *look_text;             // its file, which values point into; from malloc; of the options that read it
    int look_first, look_lights; // the lights above that are the look's
    int rig;                     // lam_rig, RIG_DARK or RIG_DEFAULT
    bool has_rig;
    const char *ambient; // as written; NULL: none
    double light_scale;
    bool has_light_scale;
};

// Materials.
struct material_options {
    struct texts materials; // as written, checked
    struct texts back_materials;
    struct texts hidden;       // names of objects, parts or materials that are not drawn
    const char *model_color;   // of all materials, as written; NULL: their own
    double shininess, opacity; // valid if the flag below is set
    bool has_shininess, has_opacity;
    lam_rgb reflectivity; // valid if the flag below is set
    bool has_reflectivity;
};

// How surfaces are drawn.
struct shading_options {
    bool has_shading;
    const char *ground_color;                 // of LAM_GROUND_COLOR, as written; NULL: draw.ground_color
    const char *edge_color, *wireframe_color; // as written; NULL: `draw` decides
    bool two_sided, one_sided, show_lights;
    int cull; // lam_cull
    bool has_cull;
    struct texts rotations; // as written, checked
    // Set by `compare`, not by an option: the turns of any picture on its sheet, which all have one camera.
    struct texts sheet_rotations;
    int slices, stacks; // of a built-in shape or a formula; 0: its own
    bool flip;
    int normals;             // lam_normals
    double crease_angle_deg; // < 0: the library's default
    const char *environment; // as written; NULL: none
    double environment_rotation_deg;
};

// Surfaces given by formulas (shape).
struct shape_options {
    // Of the command `shape`, as written: a surface over u and v or an implicit one (the model then has the name of the
    // option), and the ranges of u and v or of x, y and z. NULL: none.
    const char *parametric, *u_range, *v_range, *implicit, *x_range, *y_range, *z_range;
};

// Animations.
struct animation_options {
    int turntable;       // frames of a full turn; 0: none
    int turntable_light; // enum turntable_light
    struct texts sweeps; // as written
    int frames;          // of sweeps; 0: the default
    double fps;          // frames a second; 0: the library's default
    // Set by animations, not by an option: the rig's lights become lights of the scene.
    bool place_lights;
};

// How the work is done.
struct work_options {
    int threads;           // 0: one for each processor
    int isa;               // lam_isa
    int device;            // enum device_name
    const char *gl_device; // a number or a part of a name; NULL: the first
    int texture_filter;    // enum texture_filter
    int repeat;
};

// Limits (limit_options.h).
struct limits_options {
    double time_limit_s;         // 0: the default; infinity: none
    uint64_t memory_limit_bytes; // 0: the default; UINT64_MAX: none
    uint64_t triangle_limit;     // 0: the library's default, as in the next ones
    uint64_t pixel_limit;
    uint64_t file_limit_bytes;
    uint64_t expansion_limit, object_limit, layer_limit; // 0: by the size of the files
    int json_depth_limit;
    bool files_inside; // that a scene file names
    int sandbox;       // enum sandbox_mode
    struct texts allow_paths;
    // Models that are worked on at the same time, which share the default memory; set by the loop over them. 0: one.
    int in_flight;
};

// Many models (render, batch).
struct batch_options {
    struct texts lists;               // files of names
    int views[VIEWS_MAX], view_count; // lam_side; 0: as --view
    int sizes[VIEWS_MAX][2], size_count;
    const char *journal;     // NULL: the command's default; "none"
    const char *shard;       // as written (batch_shard.h); NULL: all models
    int shard_by;            // enum shard_by
    const char *report_page; // NULL: none
    int retry_failed;
    bool resume, skip_same, isolate, failures_ok;
    const char *jobs;          // "-" or a file; NULL: none come
    int ahead;                 // 0: the default
    uint64_t line_limit_bytes; // 0: the default
};

// The viewer (view).
struct viewer_options {
    int port;            // 0: any that is free
    double idle_minutes; // valid if the flag below is set
    bool has_idle, no_open;
};

// Comparing pictures (diff, check).
struct diff_options {
    double tolerance, gain;
};

// Hashes of pictures (hash).
struct hash_options {
    const char *check;    // the file to compare with; NULL: none
    const char *pictures; // the folder where pictures are kept; NULL: nowhere
    bool update;
};

// Models in another format (convert).
struct convert_options {
    bool thumbnail;
};

// Captions (compare, plot, materials, check, explain).
struct captions_options {
    const char *font; // NULL: the system's
    bool no_captions;
    const char *title;  // of the page; NULL: its own
    struct texts texts; // of a sheet's pictures, in their order; the sheet supplies missing ones
};

// Sheets (compare).
struct sheet_options {
    int name;            // enum sheet_name
    struct texts across; // as written, at most ACROSS_MAX
};

// Plots (plot).
struct plot_options {
    double to; // right end of a plot's axis; 0: fitted
};

// Checking shaders (check).
struct check_options {
    const char *vertex;   // file; NULL: none
    const char *scenes;   // as written; NULL: all
    const char *contract; // as written; NULL: recognised
    int light_frame;      // lam_light_frame; WORLD: the contract's
    int highlight;        // lam_reflection; AUTO: the contract's
    int terms;            // bits of lam_check_term; 0: as the shaders declare
    double stop_after_s;
    int search_limit;                                            // lam_check_params.max_pictures
    const char *class_folder, *csv;                              // NULL: none
    const char *moodle, *gradescope, *submitty, *write_contract; // files; NULL: none
    bool list;
};

// Shaders (shader).
struct shader_options {
    int glsl;      // lam_glsl
    int lights_in; // lam_shader_lights
    int host;      // 1: C code as well
    bool products;
    int style;           // lam_shader_style
    const char *mistake; // the id of one, or "list"; NULL: none
    bool lecture_device; // OpenGL draws in the lecture style, with that mistake: the cells of a sheet
    int object;          // valid if the flag below is set
    bool has_object;
};

// The user's own defaults (settings_file.h).
struct settings_options {
    const char *file; // NULL: the user's
    bool none;
    char *values; // texts that `values` of struct options points to; from malloc; of the options that read them
    const struct options *without; // the same options without the settings; NULL: there are none
};

// Printed output.
struct report_options {
    bool json, quiet, verbose, dry_run, version, help;
    bool brief_help; // -h, not --help
};

#endif
