// options.h: the options of the program. One table serves the parser, the help, the man page, the shells' completions
// and docs/command-line.md.
#ifndef OPTIONS_H
#define OPTIONS_H

#include <lambent/settings.h>

#include "option_groups.h"

enum { OPTIONS_MAX = 256 };

// The options of a command line; option_defaults() returns their defaults.
struct options {
    // Stored by the options of lam_draw_setting, and by --samples and --tone. draw_params_of adds the others.
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
    struct convert_options convert;
    struct captions_options captions;
    struct sheet_options sheet;
    struct plot_options plot;
    struct check_options check;
    struct shader_options shader;
    struct report_options report;
    struct settings_options settings;

    bool given[OPTIONS_MAX];   // for each row of the table: the option is on the command line
    bool by_look[OPTIONS_MAX]; // and it comes from --look
    int by_config
        [OPTIONS_MAX]; // the line of the settings file that it comes from; then it is not given. 0: it does not
    const char *values[OPTIONS_MAX]; // its last value there; NULL: it takes none
};

// Options that a command accepts without the rest of their group: bits above the groups' bits.
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
// A command that writes no file of its own: of its groups it accepts all but the options that say where and how one is written.
#define WRITES_NO_FILE (1ull << 63)

// The background of the sheets of `compare` and `materials`, unless the command line names another.
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
    GROUP_CHECK,
    GROUP_SHADER,
    GROUP_SHAPE,
    GROUP_VIEWER,
    GROUP_HASH,
    GROUP_CONVERT,
    GROUP_SETTINGS,
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
    size_t field, has_field;    // has_field: a bool to set as well (words and numbers); 0: none
    double min, max;            // for numbers without a setting, which has its own
    uint64_t single;            // TAKES_…, if commands may accept it without its group
    const char *brief;          // for -h: a few words; NULL: not shown there
    size_t letter_field;        // a bool to set as well where the option is given by its letter; 0: none
    const char *alias;          // another long name that is the same; NULL: none
    const char *others;         // other names that people try, separated by spaces, for suggestions; NULL: none
    const char *alone;          // its value where the word after it is none of its own; NULL: it needs one
    bool of_file;               // says where and how a file is written: see WRITES_NO_FILE
    bool loads;                 // a change needs the model to be read again
    const lam_setting *setting; // the row of the library's table that it stores; NULL: none
    // The option that takes several values separated by commas, and is meant where a value has one; NULL: none.
    const char *several;
    const char *now;    // the option that has taken its place: it works as ever, and no help lists it; NULL: none
    const char *former; // the option that had this name before: a value that is one of its words means it; NULL: none
};

// Ends with a NULL name. Nobody but option_table_fill writes to it.
extern struct option option_table[OPTIONS_MAX];
// Fills the table, with the words and settings that come from the library's tables. main calls it before anything reads the table.
void option_table_fill(void);
// The rows of settings get missing entries from the library's table; an option for each other setting follows the last
// row. A second call changes nothing.
void option_settings_fill(struct option table[OPTIONS_MAX]);
extern const char *const group_titles[GROUP_COUNT];

struct options option_defaults(void);
void options_free(struct options *options);

// Makes an independent copy. False: out of memory; there is nothing to free.
bool options_copy(struct options *to, const struct options *from);

// Takes back what the user's settings file changed, for a scene file: it describes its picture itself.
void options_drop_settings(struct options *options);

// Returns the option of a long name, or NULL if there is no such option.
const struct option *option_find(const char *name);

// Returns the position of the first word that is neither an option nor its value, or −1 if there is none, or "--" or an
// unknown option comes before it.
int options_first_operand(int count, char **words);

// The words of an option: "flat, gouraud or phong". Returns `text`.
enum { OPTION_WORDS_SIZE = 256 };
const char *option_words_list(const struct option *option, char text[OPTION_WORDS_SIZE]);

// Returns true if the command line has the option, given by its long name.
bool option_given(const struct options *options, const char *name);

// Returns true if a command accepts an option: `groups` has bit g set for each group accepted as a whole, and TAKES_…
// bits.
bool option_is_taken(const struct option *option, uint64_t groups);

// Parses the words of a command line (without the program's and the command's name). `groups` as above. Moves the
// operands to the front of `words` and returns their number; −1: LAM_BAD_ARGUMENT.
int options_parse(int count, char **words, uint64_t groups, struct options *options, lam_error *error);

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

// Parses "x:30", an axis and an angle. Returns false if it is not of that form, or over a million degrees.
bool rotation_parse(const char *text, lam_vec3 *axis, double *angle_deg);

double radians(double degrees);

#endif
