// options.h: the options of the program. One table serves the parser, the help, the man page, the shells' completions
// and docs/command-line.md.
#ifndef OPTIONS_H
#define OPTIONS_H

#include <lambent/lambent.h>

enum { OPTIONS_MAX = 192, ACROSS_MAX = 2, VIEWS_MAX = 16 };

// The values of an option that may be repeated, in order.
struct texts {
    const char **items;
    int count;
};

// The options of a command line; option_defaults() returns their defaults.
struct options {
    // Stored by the options of lam_draw_setting, and by --samples and --tone. draw_params_of adds the others.
    lam_draw_params draw;

    // Picture
    const char *output;     // NULL: <model's name>.png; "-": standard output
    int width, height;      // pixels
    bool has_size;          // the size was given
    const char *background; // as written; NULL: clear
    int color_mode;         // lam_color_mode
    int compress;           // lam_compress
    int quality;            // 0: the format's own
    bool durable;
    int term;          // enum term_kind
    double exposure;   // stops, where the next is literal
    int exposure_kind; // enum exposure_kind
    const char *show;  // as written (show_option.h); NULL: the picture

    const char *save_scene; // the scene file to write; NULL: none

    // Model files
    const char *model_scene, *variant, *animation; // as written; NULL: the file's own choice
    double time_s;                                 // valid if the flag below is set
    bool has_time, lenient;

    // View
    int view;                          // lam_side
    double azimuth_deg, elevation_deg; // valid if the flag below is set
    bool has_azimuth, has_elevation;
    double zoom;        // 0: 1
    double fov_deg;     // of the fitted camera, vertical; 0: 30
    int projection;     // 1: orthographic
    int up;             // lam_up
    const char *camera; // as written; NULL: fitted

    // Lights
    struct texts lights;         // as written, checked
    const char *look;            // as written; NULL: none
    char *look_text;             // its file, which values point into; from malloc; of the options that read it
    int look_first, look_lights; // the lights above that are the look's
    int rig;                     // lam_rig, or RIG_DARK
    bool has_rig;
    const char *ambient; // as written; NULL: none
    double light_scale;
    bool has_light_scale;

    // Materials
    struct texts materials; // as written, checked
    struct texts back_materials;
    const char *model_color;   // of all materials, as written; NULL: their own
    double shininess, opacity; // valid if the flag below is set
    bool has_shininess, has_opacity;

    // Shading
    bool has_shading;
    const char *ground_color;                 // of LAM_GROUND_COLOR, as written; NULL: draw.ground_color
    const char *edge_color, *wireframe_color; // as written; NULL: those of `draw`
    bool two_sided, one_sided, show_lights;
    int cull; // lam_cull
    bool has_cull;
    struct texts rotations; // as written, checked
    // Set by `compare`, not by an option: the turns of any picture on its sheet, which all have one camera.
    struct texts sheet_rotations;
    int slices, stacks; // of a built-in shape or a formula; 0: its own
    // Of the command `shape`, as written: a surface over u and v or an implicit one (the model then has the name of the
    // option), and the ranges of u and v or of x, y and z. NULL: none.
    const char *parametric, *u_range, *v_range, *implicit, *x_range, *y_range, *z_range;
    bool flip;
    int normals;             // lam_normals
    double crease_angle_deg; // < 0: the library's default
    const char *environment; // as written; NULL: none
    double environment_rotation_deg;
    lam_rgb reflectivity; // valid if the flag below is set
    bool has_reflectivity;

    // Animations
    int turntable;       // frames of a full turn; 0: none
    int turntable_light; // enum turntable_light
    struct texts sweeps; // as written
    int frames;          // of sweeps; 0: the default
    double fps;          // frames a second; 0: the library's default
    // Set by animations, not by an option: the rig's lights become lights of the scene.
    bool place_lights;

    // Work
    int threads;           // 0: one for each processor
    int isa;               // lam_isa
    int device;            // enum device_name
    const char *gl_device; // a number or a part of a name; NULL: the first
    int texture_filter;    // enum texture_filter
    int repeat;

    // Limits (limit_options.h)
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

    // Many models
    struct texts lists;               // files of names
    int views[VIEWS_MAX], view_count; // lam_side; 0: that of --view
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

    // Viewer
    int port;            // 0: any that is free
    double idle_minutes; // valid if the flag below is set
    bool has_idle, no_open;

    // Comparison of pictures
    double tolerance, gain;

    // Plots and sheets
    const char *font; // NULL: the system's
    bool no_captions;
    const char *title;     // of the page; NULL: its own
    struct texts captions; // of a sheet's pictures, in their order; those that are missing are the sheet's
    int sheet;             // enum sheet_name
    struct texts across;   // as written, at most ACROSS_MAX
    double to;             // right end of a plot's axis; 0: fitted

    // Checks of shaders
    const char *vertex;   // file; NULL: none
    const char *scenes;   // as written; NULL: all
    const char *contract; // as written; NULL: recognised
    int light_frame;      // lam_light_frame; WORLD: the contract's
    int highlight;        // lam_reflection; AUTO: the contract's
    int terms;            // bits of lam_check_term; 0: as the shaders declare
    double stop_after_s;
    int search_limit;               // lam_check_params.max_pictures
    const char *class_folder, *csv; // NULL: none
    bool list;

    // Shaders
    int glsl;      // lam_glsl
    int lights_in; // lam_shader_lights
    int host;      // 1: C code as well
    bool products;
    int style;           // lam_shader_style
    const char *mistake; // the id of one, or "list"; NULL: none
    bool lecture_device; // OpenGL draws in the lecture style, with that mistake: the cells of a sheet
    int object;          // valid if the flag below is set
    bool has_object;

    // Reports
    bool json, quiet, verbose, dry_run, version, help;
    bool brief_help; // -h, not --help

    bool given[OPTIONS_MAX];         // for each row of the table: the option is on the command line
    bool by_look[OPTIONS_MAX];       // and it is there by --look
    const char *values[OPTIONS_MAX]; // its last value there; NULL: it takes none
};

// Options that a command accepts without the rest of their group: bits above those of the groups.
enum {
    TAKES_OUTPUT = 1u << 24,
    TAKES_JSON = 1u << 25,
    TAKES_QUIET = 1u << 26,
    TAKES_SIZE = 1u << 27,
    TAKES_FILES = 1u << 28,
    TAKES_THREADS = 1u << 29,
    TAKES_MEMORY = 1u << 30,
    TAKES_PICTURE_LIMITS = 1u << 23,
    TAKES_REPORT = 1u << 22,
    TAKES_TERM = 1u << 21,
    TAKES_TITLE = 1u << 20,
};
// A command that writes no file of its own: of its groups it accepts all but the options that say where and how one is written.
#define WRITES_NO_FILE (1u << 31)

// The background of the sheets of `compare` and `materials`, unless the command line names another.
#define SHEET_BACKGROUND "white"

// Whether the exposure is found for the picture: where the light is that of a file in candela and lux, always, never.
enum exposure_kind { EXPOSURE_BY_FILE, EXPOSURE_AUTO, EXPOSURE_LITERAL };

// --rig none: only the ambient light. A value besides those of lam_rig.
enum { RIG_DARK = 100 };

// What the lights of a turntable are fixed to.
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

enum option_group {
    GROUP_PICTURE,
    GROUP_MODEL,
    GROUP_VIEW,
    GROUP_LIGHTS,
    GROUP_MATERIALS,
    GROUP_SHADING,
    GROUP_ANIMATION,
    GROUP_WORK,
    GROUP_LIMITS,
    GROUP_BATCH,
    GROUP_REPORT,
    GROUP_DIFF,
    GROUP_PLOT,
    GROUP_CAPTIONS,
    GROUP_SHEET,
    GROUP_CHECK,
    GROUP_SHADER,
    GROUP_SHAPE,
    GROUP_VIEWER,
    GROUP_ABOUT, // accepted by every command
    GROUP_COUNT,
};

// A word that an option accepts as its value. A list ends with a NULL name.
struct word {
    const char *name;
    int value;
    const char *summary; // NULL: the name says enough, or is another name of the word before
};

// The form of a value that is not one of a list of words.
enum value_kind {
    VALUE_ANY,
    VALUE_FILE,
    VALUE_COLOR,
    VALUE_MATERIAL,
    VALUE_LIGHT,
    VALUE_CAMERA,
    VALUE_ENVIRONMENT,
    VALUE_VARIED, // an option and its values
    VALUE_SWEPT,  // a key and numbers
};

struct option {
    const char *name; // without the dashes
    char letter;      // the short form; 0: none
    enum option_group group;
    const char *value;        // the placeholder of its value in the help; NULL: takes none
    const char *standard;     // the default in words; NULL: not shown
    const char *summary;      // one sentence for --help
    const char *details;      // more for the man page and the docs, with `code` in back quotes; NULL: none
    const struct word *words; // the accepted values; NULL: any
    enum value_kind kind;     // of its value, for the completions

    // Stores the value (NULL for a switch) at offset `field` of struct options. On failure error->text describes the
    // mistake without naming the option.
    bool (*store)(const struct option *option, const char *value, struct options *options, lam_error *error);
    size_t field, has_field; // has_field: a bool to set as well (words and numbers); 0: none
    double min, max;         // for numbers
    unsigned single;         // TAKES_…, if commands may accept it without its group
    const char *brief;       // for -h: a few words; NULL: not shown there
    size_t letter_field;     // a bool to set as well where the option is given by its letter; 0: none
    const char *alias;       // another long name that is the same; NULL: none
    const char *others;      // other names that people try, separated by spaces, for suggestions; NULL: none
    const char *alone;       // its value where the word after it is none of its own; NULL: it needs one
    bool of_file;            // says where and how a file is written: see WRITES_NO_FILE
    bool loads;              // the model is read anew where it changes
    const char *former; // the option that had this name before: a value that is one of its words means it; NULL: none
};

extern const struct option option_table[]; // ends with a NULL name
// Fills in the words that come from the library's tables. main calls it before anything reads the table.
void option_table_fill(void);
extern const char *const group_titles[GROUP_COUNT];

struct options option_defaults(void);
void options_free(struct options *options);

// Makes an independent copy. False: out of memory; there is nothing to free.
bool options_copy(struct options *to, const struct options *from);

// The option of a long name; NULL: no such option.
const struct option *option_find(const char *name);

// Where the first word stands that is neither an option nor the value of one; −1: there is none, or "--" or an unknown option
// comes before it.
int options_first_operand(int count, char **words);

// The words of an option: "flat, gouraud or phong". Returns `text`.
enum { OPTION_WORDS_SIZE = 256 };
const char *option_words_list(const struct option *option, char text[OPTION_WORDS_SIZE]);

// True if the command line has the option, given by its long name.
bool option_given(const struct options *options, const char *name);

// True if a command accepts an option: `groups` has bit g set for each group accepted as a whole, and TAKES_… bits.
bool option_is_taken(const struct option *option, unsigned groups);

// Parses the words of a command line (without the program's and the command's name). `groups` as above. Moves the
// operands to the front of `words` and returns their number; −1: LAM_BAD_ARGUMENT.
int options_parse(int count, char **words, unsigned groups, struct options *options, lam_error *error);

// Parsers of values, for the table's `store`; the comments name the type of the field.
bool store_switch(const struct option *, const char *, struct options *, lam_error *);       // bool
bool store_text(const struct option *, const char *, struct options *, lam_error *);         // const char *
bool store_word(const struct option *, const char *, struct options *, lam_error *);         // int
bool store_words(const struct option *, const char *, struct options *, lam_error *);        // int, bits
bool store_glsl(const struct option *, const char *, struct options *, lam_error *);         // likewise
bool store_up(const struct option *, const char *, struct options *, lam_error *);           // likewise
bool store_integer(const struct option *, const char *, struct options *, lam_error *);      // int
bool store_number(const struct option *, const char *, struct options *, lam_error *);       // double
bool store_path(const struct option *, const char *, struct options *, lam_error *);         // struct texts
bool store_seconds(const struct option *, const char *, struct options *, lam_error *);      // double, or none
bool store_count(const struct option *, const char *, struct options *, lam_error *);        // uint64_t
bool store_float(const struct option *, const char *, struct options *, lam_error *);        // float
bool store_angle(const struct option *, const char *, struct options *, lam_error *);        // float, from degrees
bool store_cutoff(const struct option *, const char *, struct options *, lam_error *);       // float; 0 is stored as -1
bool store_word_flag(const struct option *, const char *, struct options *, lam_error *);    // bool, words of 0 and 1
bool store_exposure(const struct option *, const char *, struct options *, lam_error *);     // double, or auto
bool store_size(const struct option *, const char *, struct options *, lam_error *);         // width, height
bool store_views(const struct option *, const char *, struct options *, lam_error *);        // views, view_count
bool store_sizes(const struct option *, const char *, struct options *, lam_error *);        // sizes, size_count
bool store_jobs(const struct option *, const char *, struct options *, lam_error *);         // const char *
bool store_list(const struct option *, const char *, struct options *, lam_error *);         // struct texts
bool store_segments(const struct option *, const char *, struct options *, lam_error *);     // slices, stacks
bool store_bytes(const struct option *, const char *, struct options *, lam_error *);        // uint64_t
bool store_color(const struct option *, const char *, struct options *, lam_error *);        // const char *, checked
bool store_ground(const struct option *, const char *, struct options *, lam_error *);       // ground, checked
bool store_show(const struct option *, const char *, struct options *, lam_error *);         // const char *, checked
bool store_reflectivity(const struct option *, const char *, struct options *, lam_error *); // lam_rgb
bool store_camera(const struct option *, const char *, struct options *,
                  lam_error *);                                                       // const char *, checked
bool store_light(const struct option *, const char *, struct options *, lam_error *); // struct texts, checked
bool store_material(const struct option *, const char *, struct options *,
                    lam_error *);                                                     // struct texts, checked
bool store_texts(const struct option *, const char *, struct options *, lam_error *); // struct texts, as they are
bool store_across(const struct option *, const char *, struct options *,
                  lam_error *); // repeatable, to ACROSS_MAX
bool store_rotation(const struct option *, const char *, struct options *,
                    lam_error *); // struct texts, checked
bool store_opaque_color(const struct option *, const char *, struct options *,
                        lam_error *); // const char *, checked

// Reads a plain decimal number at the start of `text` ("-1.5e3"; no hexadecimal, no "inf"). Returns the text after it;
// NULL if there is no number or it is too large.
const char *read_number(const char *text, double *value);

// Parses "x:30", an axis and an angle. False: not of that form, or over a million degrees.
bool rotation_parse(const char *text, lam_vec3 *axis, double *angle_deg);

double radians(double degrees);

#endif
