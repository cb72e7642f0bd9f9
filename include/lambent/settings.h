// lambent/settings.h: the table of the settings of lam_draw_params that scene files and options share. The program uses
// the rows to read and write scene files, to make the schema of scene files, and to make and apply options.
#ifndef LAMBENT_SETTINGS_H
#define LAMBENT_SETTINGS_H

#include "device.h"

#ifdef __cplusplus
extern "C" {
#endif

// The type of a setting's value, and its form in a scene file.
typedef enum lam_setting_type {
    LAM_SETTING_WORD, // an enumeration; lam_setting.word returns its keywords
    LAM_SETTING_FLAG, // a bool
    // A bool that is false if the setting is true, which is the default.
    LAM_SETTING_NOT_FLAG,
    LAM_SETTING_WHOLE,  // an int
    LAM_SETTING_NUMBER, // a float
    LAM_SETTING_RGB,    // a lam_rgb
    LAM_SETTING_RGBA,   // a lam_rgba
    // A float in radians; `min`, `max` and `standard` are in degrees, as in scene files.
    LAM_SETTING_ANGLE,
    LAM_SETTING_WORDS, // an int of bits; lam_setting.word returns their keywords
} lam_setting_type;

// A setting of lam_draw_params. A member of 0 means the default.
typedef struct lam_setting {
    const char *key;       // in scene files; options have - instead of _
    lam_setting_type type; // the type of the member
    size_t offset;         // of the member in lam_draw_params
    // The range of WHOLE, NUMBER and ANGLE, and the default. If `standard` is below `min`, the default depends on the
    // scene.
    double min, max, standard;
    bool zero; // WHOLE, NUMBER: 0 is allowed too, regardless of `min`
    // NUMBER: 0 in a file is stored as −1 in the member, because a member of 0 means the default.
    bool zero_is_negative;
    // WORD and WORDS: returns the keyword with this index and its value, or NULL past the end. If several keywords have
    // the same value, scene files contain the first. NOT_FLAG: returns the keywords of its option, with the member's
    // values.
    const char *(*word)(int index, int *value);
    const char *summary; // one sentence
    const char *member;  // its name in lam_draw_params
    // WHOLE, NUMBER and ANGLE: the allowed values, for error messages. WORD and WORDS: the enumeration (lam_…), or the
    // members that share an error.
    const char *expected;
    // Returns one phrase about the keyword with this index. The function is NULL if every keyword explains itself.
    const char *(*word_summary)(int index);
    LAM_RESERVED(5);
} lam_setting;

// The maximum number of rows of the table: lam_picture_settings has a bit for each.
enum { LAM_SETTINGS_MAX = 64 };

// Returns a row of the table, or NULL past the end.
LAM_API const lam_setting *lam_draw_setting(int index);

// Returns the index of the row with this key, or −1 if there is no such row.
LAM_API int lam_draw_setting_find(const char *key);

// Returns whether the member is 0.
LAM_API bool lam_setting_is_default(const lam_setting *setting, const lam_draw_params *params);

// Copies the member.
LAM_API void lam_setting_copy(const lam_setting *setting, const lam_draw_params *from, lam_draw_params *to);

#ifdef __cplusplus
}
#endif
#endif
