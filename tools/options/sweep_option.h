// sweep_option.h: the values of --sweep: the numbers that change from frame to frame.
#ifndef SWEEP_OPTION_H
#define SWEEP_OPTION_H

#include "options.h"

// The kind of number that a sweep changes.
enum sweep_kind {
    SWEEP_OPTION,   // an option of the table
    SWEEP_MATERIAL, // a key of --material
    SWEEP_ROTATE,   // a turn of --rotate
    SWEEP_LIGHT,    // a number of one of the lights
};

// The numbers of a light besides its fields.
enum sweep_light { SWEEP_LIGHT_FIELD, SWEEP_LIGHT_AZIMUTH, SWEEP_LIGHT_ELEVATION, SWEEP_LIGHT_INTENSITY };

enum { SWEEP_STOPS_MAX = 16, SWEEP_NAME_MAX = 80 };

struct sweep {
    enum sweep_kind kind;
    const struct option *option; // SWEEP_OPTION, and what SWEEP_MATERIAL and SWEEP_ROTATE are given to
    char key[SWEEP_NAME_MAX];    // SWEEP_MATERIAL: "roughness"; SWEEP_ROTATE: "y"
    char which[SWEEP_NAME_MAX];  // SWEEP_MATERIAL: the part after '@'; SWEEP_LIGHT: a name or number; "": none
    enum sweep_light light;
    const char *field; // SWEEP_LIGHT_FIELD: its key
    int component;     // of the field; −1: all
    double stops[SWEEP_STOPS_MAX];
    int stop_count; // 0: `time` over the whole length of the animation
    bool closed;    // it ends as it begins: the last frame is one step before the end
    bool whole;     // values are rounded to whole numbers
};

// Returns whether numbers in order make an option's value, and the value makes a picture.
bool sweep_takes_option(const struct option *option);

// Parses "KEY=FROM..TO", also with stops between. On failure error->text lacks the option's name. LAM_BAD_ARGUMENT.
bool sweep_parse(const char *text, struct sweep *sweep, lam_error *error);

// Returns whether it sweeps the option of this name.
bool sweep_is_option(const struct sweep *sweep, const char *name);

// Returns the value in a frame of `count`.
double sweep_value(const struct sweep *sweep, int frame, int count);

// The words that give an option its value in a frame, in `text`; NULL: it is a light's.
struct sweep_words {
    char option[SWEEP_NAME_MAX + 3], value[3 * SWEEP_NAME_MAX];
};
bool sweep_words(const struct sweep *sweep, int frame, int count, struct sweep_words *words);

#endif
