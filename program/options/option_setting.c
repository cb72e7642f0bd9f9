// option_setting.c: creates options from the library's settings. The table of settings provides words, defaults, ranges
// and summaries; a row of option_table.c adds details and the position in the help.
#include "options.h"

#include <stdio.h>
#include <stdlib.h>

enum { POOL = 224, NAME_SIZE = 40 };
static struct choice pool[POOL];
static int pool_used;

// Returns whether a name equals a key. A - in the name also matches a _ in the key.
static bool is_named(const char *name, const char *key)
{
    while (*name && *key && (*name == *key || (*name == '-' && *key == '_')))
        name++, key++;
    return *name == *key;
}

static void add_word(const char *name, int value, const char *summary)
{
    if (pool_used == POOL)
        abort(); // the tables have grown: increase POOL
    pool[pool_used++] = (struct choice){name, value, summary};
}

// Returns the words of an option, with the summary of each word. For a bit mask, the first word sets all bits.
static const struct choice *words_of(const lam_setting *setting)
{
    const struct choice *first = &pool[pool_used];
    const char *choice;
    int value, bits = 0;
    for (int i = 0; setting->word(i, &value); i++)
        bits |= value;
    if (setting->type == LAM_SETTING_WORDS)
        add_word("all", bits, NULL);
    for (int i = 0; (choice = setting->word(i, &value)); i++)
        add_word(choice, value, setting->word_summary ? setting->word_summary(i) : NULL);
    add_word(NULL, 0, NULL);
    return first;
}

// Formats a number of at least 0 with up to five decimals. Rounds a fraction so that the number has at most three
// significant digits. Calling printf would take a tenth of the start-up time.
static void put_number(char *text, double number)
{
    long long scaled = (long long)(number * 100000 + 0.5), unit = 1;
    for (; scaled / unit >= 1000 && unit < 100000; unit *= 10)
        ;
    scaled = (scaled + unit / 2) / unit * unit;
    char digits[24];
    int count = 0, skipped = 0;
    for (long long rest = scaled; rest || count < 6; rest /= 10)
        digits[count++] = (char)('0' + rest % 10);
    while (skipped < 5 && digits[skipped] == '0')
        skipped++;
    while (count > skipped) {
        if (count == 5)
            *text++ = '.';
        *text++ = digits[--count];
    }
    *text = 0;
}

// Lists the values of --show.
static const struct choice *outputs(void)
{
    const struct choice *first = &pool[pool_used];
    for (lam_output o = LAM_OUTPUT_PICTURE + 1; o < LAM_OUTPUT_COUNT; o++)
        add_word(o == LAM_OUTPUT_LIGHT ? "light:NAME" : lam_output_name(o), (int)o, lam_output_summary(o));
    add_word("all", LAM_OUTPUT_PICTURE, "the picture, every term and every light, as layers of one .exr file");
    add_word(NULL, 0, NULL);
    return first;
}

// Formats the default of a setting: a number, or the word that means 0.
static const char *standard_of(const lam_setting *setting, char text[NAME_SIZE])
{
    const char *choice;
    int value;
    if (setting->type == LAM_SETTING_FLAG || setting->type == LAM_SETTING_RGB || setting->type == LAM_SETTING_RGBA)
        return NULL;
    if (setting->type == LAM_SETTING_WORDS)
        return "none";
    for (int i = 0; setting->word && (choice = setting->word(i, &value)); i++)
        if (value == 0)
            return choice;
    put_number(text, setting->standard);
    return text;
}

static const struct {
    option_parser *store;
    const char *value; // the placeholder
} kinds[] = {
    [LAM_SETTING_WORD] = {store_word, "WORD"},
    [LAM_SETTING_FLAG] = {store_switch, NULL},
    [LAM_SETTING_NOT_FLAG] = {store_word_flag, "SWITCH"},
    [LAM_SETTING_WHOLE] = {store_integer, "N"},
    [LAM_SETTING_NUMBER] = {store_float, "NUMBER"},
    [LAM_SETTING_ANGLE] = {store_angle, "DEGREES"},
    [LAM_SETTING_WORDS] = {store_words, "WORDS"},
    [LAM_SETTING_RGBA] = {NULL, NULL},
};

// Collects the rows without a parser or a summary; the table of settings supplies both. Returns the number of these
// rows, and sets *rows to the number of all rows.
static int open_rows(struct option *table, struct option *open[LAM_SETTINGS_MAX], int *rows)
{
    int count = 0;
    for (*rows = 0; table[*rows].name; ++*rows)
        if ((!table[*rows].store || !table[*rows].summary) && count < LAM_SETTINGS_MAX)
            open[count++] = &table[*rows];
    return count;
}

static struct option *row_of(const lam_setting *setting, struct option *const *rows, int count)
{
    for (int i = 0; i < count; i++)
        if (*rows[i]->name == *setting->key && is_named(rows[i]->name, setting->key))
            return rows[i];
    return NULL;
}

void option_settings_fill(struct option table[OPTIONS_MAX])
{
    static char names[LAM_SETTINGS_MAX][NAME_SIZE], standards[LAM_SETTINGS_MAX][NAME_SIZE];
    const lam_setting *setting;
    struct option *open[LAM_SETTINGS_MAX];
    int rows, count = open_rows(table, open, &rows);
    if (rows >= OPTIONS_MAX - LAM_SETTINGS_MAX)
        abort(); // increase OPTIONS_MAX
    if (pool_used)
        return; // already filled
    for (int i = 0; i < rows; i++)
        if (table[i].store == store_show || table[i].store == store_shows)
            table[i].words = outputs();
    for (int i = 0; (setting = lam_draw_setting(i)); i++) {
        struct option *o = row_of(setting, open, count);
        if (!o && !kinds[setting->type].store)
            continue; // a colour setting: its value depends on --color-mode, so another option parses it
        if (!o) {
            snprintf(names[i], NAME_SIZE, "%s", setting->key);
            for (char *c = names[i]; *c; c++)
                *c = *c == '_' ? '-' : *c;
            o = &table[rows++];
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
}
