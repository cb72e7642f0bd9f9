// options.h: defines the program's options. The parser, the help, the man page, the shell completions and
// docs/command-line.md use the same table.
#ifndef OPTIONS_H
#define OPTIONS_H

#include <lambent/settings.h>

#include "option_groups.h"

enum { OPTIONS_MAX = 320 };

// The options of a command line. option_defaults() returns the defaults.
struct options {
    // Set by the options of lam_draw_setting and by --samples and --tone. draw_params_of adds the other fields.
    lam_draw_params draw;

    struct picture_options picture;
    struct model_options model;
    struct view_options view;
    struct lighting_options lighting;
    struct material_options material;
    struct shading_options shading;
    struct shape_options shape;
    struct animation_options animation;
    struct work_options work;
    struct limits_options limits;
    struct batch_options batch;
    struct viewer_options viewer;
    struct diff_options diff;
    struct hash_options hash;
    struct print_options print;
    struct convert_options convert;
    struct captions_options captions;
    struct sheet_options sheet;
    struct plot_options plot;
    struct exercises_options exercises;
    struct contact_options contact;
    struct check_options check;
    struct shader_options shader;
    struct report_options report;
    struct settings_options settings;
    char **line; // the arguments of main() in their order, beginning with the program's name; ends with NULL

    bool given[OPTIONS_MAX];         // for each row of the table: whether the option is on the command line
    bool by_key[OPTIONS_MAX];        // whether a key in the value of another option sets the option (option.key)
    bool by_look[OPTIONS_MAX];       // whether the option comes from --look
    int by_config[OPTIONS_MAX];      // the line in the settings file, or 0 if the file does not set the option
    const char *values[OPTIONS_MAX]; // the value on the command line or in the settings file, or NULL
};

// Bits above the group bits: single options from groups that a command does not accept as a whole.
#define TAKES_OUTPUT         (1ull << 40)
#define TAKES_JSON           (1ull << 41)
#define TAKES_QUIET          (1ull << 42)
#define TAKES_SIZE           (1ull << 43)
#define TAKES_FILES          (1ull << 44)
#define TAKES_THREADS        (1ull << 45)
#define TAKES_MEMORY         (1ull << 46)
#define TAKES_PICTURE_LIMITS (1ull << 47)
#define TAKES_REPORT         (1ull << 48)
#define TAKES_TERM           (1ull << 49)
#define TAKES_TITLE          (1ull << 50)
#define TAKES_MANY           (1ull << 51)
#define TAKES_UP             (1ull << 52)
// Set for a command that writes no file of its own. Such a command rejects the options about the output file in all of
// its groups.
#define WRITES_NO_FILE (1ull << 63)

// The default background of the sheets of `compare` and `materials`.
#define SHEET_BACKGROUND "white"

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
    GROUP_CONTACT,
    GROUP_CHECK,
    GROUP_SHADER,
    GROUP_SHAPE,
    GROUP_FIGURE,
    GROUP_EXERCISES,
    GROUP_VIEWER,
    GROUP_HASH,
    GROUP_CONVERT,
    GROUP_PRINT,
    GROUP_SETTINGS,
    GROUP_ABOUT, // accepted by every command
    GROUP_COUNT,
};

// The groups of the options that determine the picture of a model.
#define PICTURE_GROUPS                                                                                                 \
    (1ull << GROUP_PICTURE | 1ull << GROUP_MODEL | 1ull << GROUP_VIEW | 1ull << GROUP_LIGHTS |                         \
     1ull << GROUP_MATERIALS | 1ull << GROUP_SHADING)

// Uses of options. Each use includes all options of some groups. `also_in` and `not_in` of a row list exceptions.
enum option_use {
    IN_LOOK = 1,      // a look may set the option
    IN_JOB = 2,       // a worker's job may set the option
    IN_KEY = 4,       // part of the key by which a journal recognises unchanged pictures
    IN_PAGE = 8,      // the web page shows a control for the option
    IN_SHEET = 16,    // `compare --across` can vary the option
    KEEPS_MODEL = 32, // changes only the drawing, so a loaded model can be used again
};

// A named value that an option accepts. A list ends with a NULL name.
struct choice {
    const char *name;
    int value;
    const char *summary; // NULL if the name needs no explanation, or is an alias of the previous name
};

// The syntax of a value that is not one of the option's keywords.
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

struct option;
typedef bool option_parser(const struct option *option, const char *value, struct options *options, lam_error *error);

struct option {
    const char *name; // without the dashes
    char letter;      // the letter of the short form; 0 means no short form
    enum option_group group;
    const char *value;    // the value's placeholder in the help; NULL if the option has no value
    const char *standard; // the text of the default; NULL hides it
    const char *summary;  // one sentence for --help
#if defined(__wasm__)
    bool details; // only whether there are any: a page would wait for this text, and does not show it
#else
    const char *details; // more text for the man page and the docs, `code` in back quotes; may be NULL
#endif
    const struct choice *words; // the accepted values; NULL accepts any
    enum value_kind kind;       // the value's syntax, for the completions

    // Stores the value (NULL for a switch) at offset `field` of struct options. On failure, error->text describes the
    // mistake without the option's name.
    option_parser *store;
    size_t field, has_field; // offset of a bool that the option also sets; 0 means no bool
    double min, max;         // the range of a number that is not a setting of the library
    uint64_t single;         // TAKES_…, if a command may accept the option without its group
    const char *brief;       // a few words for -h; NULL omits the option from -h
    size_t letter_field;     // offset of a bool that the short form also sets; 0 means no bool
    const char *alias;       // another long name for the same option, or NULL
    const char *others;      // names in other programs, separated by spaces, for suggestions; may be NULL
    // Other names that the command line accepts, separated by spaces (synonyms.h): "bg" renames the option, "top=top"
    // means a value, and in "eye=eye=*" the value of the other name replaces *. May be NULL.
    const char *also;
    const char *alone;          // the value of an option without a value; NULL means that a value is required
    bool of_file;               // the option concerns the output file (WRITES_NO_FILE)
    bool loads;                 // if the option changes, the model must be read again
    uint8_t also_in, not_in;    // bits of option_use to add to the group's uses, and bits to remove from the group's
                                // uses
    const lam_setting *setting; // the library's setting that the option stores, or NULL
    const char *replaces;       // the option whose value this option's value replaces, or NULL
    // The option that accepts several values separated by commas, suggested if a value contains a comma. May be NULL.
    const char *several;
    const char *now;    // the option that replaces this obsolete option, or NULL
    const char *key;    // the key that replaces this option in the value of `now`: "width" in "--edges all,width=2"
                        // replaces --edge-width
    bool keyed;         // whether keys in the option's value set other options
    const char *former; // NULL, or the option that formerly had this name; suggested if `former` accepts the value
};

// Ends with a NULL name. Only option_table_fill modifies it.
extern struct option option_table[OPTIONS_MAX];
// Adds the words and settings of the library's tables. Must be called before the table is read.
void option_table_fill(void);
// Uses the library's table to complete the rows of settings, and appends a row for each remaining setting. A second
// call has no effect.
void option_settings_fill(struct option table[OPTIONS_MAX]);
extern const char *const group_titles[GROUP_COUNT];

struct options option_defaults(void);
void options_free(struct options *options);

// Makes an independent copy. Returns false if memory runs out; then there is nothing to free.
bool options_copy(struct options *to, const struct options *from);

// Reverts the changes that the user's settings file made, because a scene file describes its picture completely.
void options_drop_settings(struct options *options);

// Returns the option with a long name, or NULL if there is no such option.
const struct option *option_find(const char *name);

// Returns the index of the first operand: an argument that is neither an option nor an option's value. Returns −1 if
// there is no operand, or if "--" or an unknown option precedes it.
int options_first_operand(int count, char **words);

// Lists an option's words in the form "flat, gouraud or phong". Returns `text`.
enum { OPTION_WORDS_SIZE = 256 };
const char *option_words_list(const struct option *option, char text[OPTION_WORDS_SIZE]);

// Returns true if the command line contains the option with this long name, or the option's key in the value of another
// option.
bool option_given(const struct options *options, const char *name);

// Returns true if a command accepts an option. `groups` contains bit g for each group whose options the command
// accepts, and TAKES_… bits.
bool option_is_taken(const struct option *option, uint64_t groups);

// Returns whether a use includes an option.
bool option_is_in(const struct option *option, enum option_use use);

// Parses the arguments that follow the names of the program and the command. `groups` has the same meaning as in
// option_is_taken. Moves the operands to the front of `words` and returns their number, or −1 with LAM_BAD_ARGUMENT.
int options_parse(int count, char **words, uint64_t groups, struct options *options, lam_error *error);

// Parses the value "environment" or "environment:BLUR" of --background into lam_draw_params.background_environment.
// Returns false for other values.
bool background_environment(const char *text, float *blur);

// Parsers for the `store` member of the table. Each comment names the type of the field.
option_parser store_switch, store_word_flag; // bool; store_word_flag accepts words with the values 0 and 1
option_parser store_text, store_jobs, store_pictures, store_environment; // const char *
option_parser store_color, store_opaque_color, store_show, store_camera; // const char *, checked
option_parser store_word, store_words, store_glsl, store_up; // int, the value of a word; store_words: a bit mask
option_parser store_integer;                                 // int
option_parser store_number, store_seconds;                   // double; store_seconds: infinity for "none"
option_parser store_float, store_angle, store_cutoff;        // float; store_angle: degrees; store_cutoff: −1 for 0
option_parser store_count, store_bytes;                      // uint64_t
option_parser store_explode;                                 // lam_vec3
option_parser store_light, store_material, store_rotation, store_section; // struct texts, checked
option_parser store_texts, store_path, store_list, store_across; // struct texts; store_across: at most ACROSS_MAX
option_parser store_reflectivity;                                // lam_rgb
// Store several members of struct options.
option_parser store_exposure, store_size, store_views, store_azimuths, store_shows, store_cameras, store_sizes,
    store_segments, store_ground, store_back_faces;

// Reads a plain decimal number such as "-1.5e3" at the start of `text`; hexadecimal numbers and "inf" are rejected.
// Returns the rest of the text, or NULL if there is no number or it is too large.
const char *read_number(const char *text, double *value);

// Parses an axis and an angle, as in "x:30". Returns false if the syntax is wrong or the angle exceeds a million
// degrees.
bool rotation_parse(const char *text, lam_vec3 *axis, double *angle_deg);

double radians(double degrees);

#endif
