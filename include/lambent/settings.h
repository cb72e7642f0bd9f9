// lambent/settings.h: the table of the settings of lam_draw_params that scene files and options have. Scene files are
// read and written, their schema is made, and options are made and applied from its rows.
#ifndef LAMBENT_SETTINGS_H
#define LAMBENT_SETTINGS_H

#include "device.h"

#ifdef __cplusplus
extern "C" {
#endif

// The type of a setting's value, and how a scene file writes it.
typedef enum lam_setting_type {
    LAM_SETTING_WORD, // an enumeration; lam_setting.word has its words
    LAM_SETTING_FLAG, // a bool
    // A bool that is false where the setting is true, which is the default.
    LAM_SETTING_NOT_FLAG,
    LAM_SETTING_WHOLE,  // an int
    LAM_SETTING_NUMBER, // a float
    LAM_SETTING_RGB,    // a lam_rgb
    LAM_SETTING_RGBA,   // a lam_rgba
    // A float in radians; `min`, `max` and `standard` are degrees, as scene files have them.
    LAM_SETTING_ANGLE,
    LAM_SETTING_WORDS, // an int of bits, each a word of lam_setting.word
} lam_setting_type;

// A setting of lam_draw_params. A member of 0 means the default.
typedef struct lam_setting {
    const char *key;       // in scene files; an option has - in place of _
    lam_setting_type type; // the type of the member
    size_t offset;         // of the member in lam_draw_params
    // The range of WHOLE, NUMBER and ANGLE, and the default; a default below `min`: it depends on the scene.
    double min, max, standard;
    bool zero; // WHOLE, NUMBER: 0 may be written too, whatever `min` is
    // NUMBER: a written 0 is −1 in the member, where 0 is the default.
    bool zero_is_negative;
    // The words of WORD and WORDS: the one with this index and its value; NULL past the end. Of several words for one value the
    // first is written.
    // NOT_FLAG: the words of its option, with the member's values.
    const char *(*word)(int index, int *value);
    const char *summary; // one sentence
    const char *member;  // its name in lam_draw_params
    // WHOLE, NUMBER and ANGLE: the values that an error about another one names. WORD and WORDS: the enumeration (lam_…), or the members that
    // share an error.
    const char *expected;
    // One phrase about the word with this index; NULL: scene files alone have the word, and its option has not. A function of NULL:
    // every word says enough.
    const char *(*word_summary)(int index);
    LAM_RESERVED(5);
} lam_setting;

// The most rows of the table: lam_picture_settings has a bit for each.
enum { LAM_SETTINGS_MAX = 64 };

// Returns a row of the table, or NULL past the end.
LAM_API const lam_setting *lam_draw_setting(int index);

// Returns the index of the row with this key, or −1 if there is no such row.
LAM_API int lam_draw_setting_find(const char *key);

// Returns true if the member is 0.
LAM_API bool lam_setting_is_default(const lam_setting *setting, const lam_draw_params *params);

// Copies the member.
LAM_API void lam_setting_copy(const lam_setting *setting, const lam_draw_params *from, lam_draw_params *to);

#ifdef __cplusplus
}
#endif
#endif
