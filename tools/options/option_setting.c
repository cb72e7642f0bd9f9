// option_setting.c: the options of the library's settings. Words, default, range and summary are those of its table; a row of
// option_table.c adds details, and says where the option stands in the help.
#include "options.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { POOL = 192, NAME_SIZE = 40 };
static struct word pool[POOL];
static int pool_used;

// An option has - where a key has _.
static bool is_named(const char *name, const char *key)
{
    while (*name && *key && (*name == *key || (*name == '-' && *key == '_')))
        name++, key++;
    return *name == *key;
}

static void add_word(const char *name, int value, const char *summary)
{
    if (pool_used == POOL)
        abort(); // the tables have grown: POOL must
    pool[pool_used++] = (struct word){name, value, summary};
}

// The words of an option; bits begin with all of them together.
static const struct word *words_of(const lam_setting *setting)
{
    const struct word *first = &pool[pool_used];
    const char *word;
    int value, bits = 0;
    for (int i = 0; setting->word(i, &value); i++)
        bits |= value;
    if (setting->type == LAM_SETTING_WORDS)
        add_word("all", bits, NULL);
    for (int i = 0; (word = setting->word(i, &value)); i++) {
        const char *summary = setting->word_summary ? setting->word_summary(i) : "";
        if (summary)
            add_word(word, value, *summary ? summary : NULL);
    }
    add_word(NULL, 0, NULL);
    return first;
}

// The word of 0, or the number.
static const char *standard_of(const lam_setting *setting, char text[NAME_SIZE])
{
    const char *word;
    int value;
    if (setting->type == LAM_SETTING_FLAG || setting->type == LAM_SETTING_RGB || setting->type == LAM_SETTING_RGBA)
        return NULL;
    if (setting->type == LAM_SETTING_WORDS)
        return "none";
    for (int i = 0; setting->word && (word = setting->word(i, &value)); i++)
        if (value == 0)
            return word;
    snprintf(text, NAME_SIZE, "%.3g", setting->standard);
    return text;
}

static const struct {
    bool (*store)(const struct option *, const char *, struct options *, lam_error *);
    const char *value; // the placeholder
} kinds[] = {
    [LAM_SETTING_WORD] = {store_word, "WORD"},         [LAM_SETTING_FLAG] = {store_switch, NULL},
    [LAM_SETTING_NOT_FLAG] = {store_word_flag, "HOW"}, [LAM_SETTING_WHOLE] = {store_integer, "N"},
    [LAM_SETTING_NUMBER] = {store_float, "NUMBER"},    [LAM_SETTING_ANGLE] = {store_angle, "DEGREES"},
    [LAM_SETTING_WORDS] = {store_words, "WORDS"},      [LAM_SETTING_RGBA] = {NULL, NULL},
};

static struct option *row_of(const lam_setting *setting, int rows)
{
    for (int i = 0; i < rows; i++)
        if (is_named(option_table[i].name, setting->key))
            return &option_table[i];
    return NULL;
}

int option_settings_fill(int rows)
{
    static char names[LAM_SETTINGS_MAX][NAME_SIZE], standards[LAM_SETTINGS_MAX][NAME_SIZE];
    const lam_setting *setting;
    int count = rows;
    pool_used = 0;
    for (int i = 0; (setting = lam_draw_setting(i)); i++) {
        struct option *o = row_of(setting, rows);
        if (!o && !kinds[setting->type].store)
            continue; // a colour is set by another option: it depends on --color-mode
        if (!o) {
            snprintf(names[i], NAME_SIZE, "%s", setting->key);
            for (char *c = names[i]; *c; c++)
                *c = *c == '_' ? '-' : *c;
            o = &option_table[count++];
            *o = (struct option){.name = names[i], .group = GROUP_SHADING, .value = kinds[setting->type].value};
        }
        o->setting = setting;
        o->summary = o->summary ? o->summary : setting->summary;
        o->standard = o->standard ? o->standard : standard_of(setting, standards[i]);
        o->words = !o->words && setting->word ? words_of(setting) : o->words;
        if (!o->store) {
            o->store = setting->zero_is_negative ? store_cutoff : kinds[setting->type].store;
            o->field = offsetof(struct options, draw) + setting->offset;
        }
    }
    return count;
}
