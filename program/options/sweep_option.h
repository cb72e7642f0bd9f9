// sweep_option.h: parses the values of --sweep. A sweep changes a numeric value from frame to frame.
#ifndef SWEEP_OPTION_H
#define SWEEP_OPTION_H

#include "options.h"

// The kinds of values that a sweep can change.
enum sweep_kind {
    SWEEP_OPTION,   // an option of the table
    SWEEP_MATERIAL, // a key of --material
    SWEEP_ROTATE,   // an angle of --rotate
    SWEEP_LIGHT,    // a numeric property of a light
};

// The numeric properties of a light in addition to its fields.
enum sweep_light { SWEEP_LIGHT_FIELD, SWEEP_LIGHT_AZIMUTH, SWEEP_LIGHT_ELEVATION, SWEEP_LIGHT_INTENSITY };

enum { SWEEP_STOPS_MAX = 16, SWEEP_NAME_MAX = 80 };

struct sweep {
    enum sweep_kind kind;
    const struct option *option; // the changed option; --material for SWEEP_MATERIAL, --rotate for SWEEP_ROTATE
    char key[SWEEP_NAME_MAX];    // "roughness" for SWEEP_MATERIAL, "y" for SWEEP_ROTATE
    char which[SWEEP_NAME_MAX];  // the text after '@', or the light's name or number; may be ""
    enum sweep_light light;
    const char *field; // the key of SWEEP_LIGHT_FIELD
    int component;     // the component of the field; −1 means all
    double stops[SWEEP_STOPS_MAX];
    int stop_count; // 0 means that `time` runs through the whole animation
    bool closed;    // the last stop is equivalent to the first, so the frames end one step earlier
    bool whole;     // rounds the values to integers
};

// Returns whether an option accepts numbers and affects the picture.
bool sweep_takes_option(const struct option *option);

// Parses "KEY=FROM..TO", optionally with stops in between. Fails with LAM_BAD_ARGUMENT; error->text lacks the option's
// name.
bool sweep_parse(const char *text, struct sweep *sweep, lam_error *error);

// Returns whether the sweep changes the option with this name.
bool sweep_is_option(const struct sweep *sweep, const char *name);

// Returns the value in frame `frame` of `count` frames.
double sweep_value(const struct sweep *sweep, int frame, int count);

// The arguments that set an option to its value in a frame.
struct sweep_words {
    char option[SWEEP_NAME_MAX + 3], value[3 * SWEEP_NAME_MAX];
};
bool sweep_words(const struct sweep *sweep, int frame, int count, struct sweep_words *words);

#endif
