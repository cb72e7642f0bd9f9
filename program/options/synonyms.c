// synonyms.c: replaces the words of other programs in a command line by Lambent's own words.
#include "synonyms.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

#include <lambent/export.h>
#include <lambent/material.h>
#include <lambent/mesh.h>
#include <lambent/scene.h>
#include <lambent/words.h>

#include "console.h"

// Wishes that Lambent does not fulfil as typed, with the answer.
static const struct {
    const char *names, *answer;
} answers[] = {
    {"texture map-kd", "the model's file names its textures (MTL, glTF): lambent help formats"},
    {"no-texture no-textures",
     "--color white draws the model in one colour, --show base-color its colours without light"},
    {"logo watermark overlay", "lambent draws no pictures into a picture; ImageMagick's `composite` does"},
    {"dpi ppi", "a picture has a size in pixels; 10 cm at 300 dpi are -s 1181"},
    {"margin padding border", "--zoom 0.9 leaves a margin; 1 fills 92 % of the picture"},
};

// Finds `name` in a list such as "bg top=top eye=eye=*". Sets `meaning` to the text after the first equals sign.
static bool find(const char *list, const char *name, char meaning[MEANING_SIZE])
{
    size_t wanted = strlen(name);
    for (size_t length; list && *list; list += length + (list[length] == ' ')) {
        length = strcspn(list, " ");
        if (strncmp(list, name, wanted) != 0 || (wanted < length && list[wanted] != '='))
            continue;
        size_t start = wanted + (wanted < length);
        snprintf(meaning, MEANING_SIZE, "%.*s", (int)(length - start), list + start);
        return true;
    }
    return false;
}

const struct option *synonym_option(const char *name, uint64_t groups, char meaning[MEANING_SIZE])
{
    for (const struct option *o = option_table; o->name; o++)
        if (option_is_taken(o, groups) && find(o->also, name, meaning))
            return o;
    return NULL;
}

const struct command *synonym_command(const char *name)
{
    char unused[MEANING_SIZE];
    for (const struct command *c = command_table; c->name; c++)
        if (find(c->also, name, unused))
            return c;
    return NULL;
}

// A command line while its words are replaced.
struct replacing {
    struct own_words *own;
    const struct command *command; // the command that a word names, or NULL
    uint64_t groups;               // of the command
    bool draws;                    // whether the command line names an output
    bool ok;                       // false if memory ran out
};

static void add(struct replacing *r, char *word) { r->own->words[r->own->count++] = word; }

// Adds a new string, formatted as "HEAD" followed by `meaning`, in which `value` replaces *. A value of numbers and
// commas gets slashes, as in Lambent's positions.
static char *make(struct replacing *r, const char *head, const char *meaning, const char *value)
{
    const char *star = strchr(meaning, '*');
    int before = star ? (int)(star - meaning) : (int)strlen(meaning);
    size_t end = strlen(value);
    bool twice = star && star[1] && end && value[end - 1] == star[1]; // "pictures/" and "*/"
    char *text;
    if (asprintf(&text, "%s%.*s%s%s", head, before, meaning, star ? value : "", star && !twice ? star + 1 : "") < 0) {
        r->ok = false;
        return NULL;
    }
    if (star && !value[strspn(value, "0123456789.,+-eE")])
        for (char *c = strchr(text + strlen(head), ','); c; c = strchr(c, ','))
            *c = '/';
    return r->own->made[r->own->made_count++] = text;
}

// Returns Lambent's word for a value, if the value is a synonym of exactly one of the option's words or materials.
// Otherwise, returns `value`.
static const char *own_value(const struct option *option, const char *value)
{
    const char *found = NULL;
    int words = 0, count = option->kind == VALUE_MATERIAL ? LAM_MATERIAL_COUNT : 0;
    while (option->words && option->words[words].name)
        words++;
    for (int i = 0; i < words + count; i++) {
        const char *word = i < words ? option->words[i].name : lam_material_name((lam_material_id)(i - words));
        if (strcmp(word, value) == 0 || (found && lam_word_distance(value, word) == 0))
            return value;
        found = lam_word_distance(value, word) == 0 ? word : found;
    }
    return found ? found : value;
}

// Adds an option with its value, if there is one. `--color steel` names a material.
static void add_option(struct replacing *r, const struct option *option, const char *value)
{
    lam_rgba unused;
    bool color = option->kind == VALUE_COLOR && option->former && value &&
                 !lam_color_parse(value, LAM_COLOR_SRGB, &unused, NULL) && strcmp(value, "raw") != 0;
    const struct option *material = color ? option_find("material") : NULL;
    if (material && lam_material_find(own_value(material, value)) != LAM_MATERIAL_COUNT)
        option = material;
    add(r, make(r, "--", option->name, ""));
    if (value)
        add(r, (char *)(uintptr_t)own_value(option, value));
}

// Adds a synonym with a meaning such as "top" or "eye=*". A second synonym with keys of the same option joins the first
// one's value: `--eye 3,2,1 --look-at 0,0,0` becomes `--camera eye=3/2/1,target=0/0/0`.
static void add_meaning(struct replacing *r, const struct option *option, const char *meaning, const char *value)
{
    char head[200] = "";
    for (int i = 0; i + 1 < r->own->count && strstr(meaning, "=*"); i++)
        if (strncmp(r->own->words[i], "--", 2) == 0 && strcmp(r->own->words[i] + 2, option->name) == 0) {
            snprintf(head, sizeof head, "%s,", r->own->words[i + 1]);
            r->own->words[i + 1] = make(r, head, meaning, value);
            return;
        }
    if (strcmp(meaning, "-") == 0) // Lambent always does this
        return;
    add(r, make(r, "--", option->name, ""));
    add(r, make(r, "", meaning, value));
}

static bool is_option(const char *word) { return word && word[0] == '-' && word[1] && !strchr("0123456789.", word[1]); }

static bool answer(const char *name, lam_error *error)
{
    char unused[MEANING_SIZE];
    for (size_t i = 0; i < sizeof answers / sizeof *answers; i++)
        if (find(answers[i].names, name, unused))
            return complain(error, LAM_BAD_ARGUMENT, "unknown option '--%s'; %s", name, answers[i].answer);
    return true;
}

// Replaces one option with its value, `words[*at]` and maybe the next word.
static bool replace_option(struct replacing *r, char **words, int *at, lam_error *error)
{
    char name[64], meaning[MEANING_SIZE];
    char *word = words[*at], *next = words[*at + 1];
    const char *value = strchr(word, '=') ? strchr(word, '=') + 1 : NULL;
    snprintf(name, sizeof name, "%.*s", (int)strcspn(word + 2, "="), word + 2);
    const struct option *option = option_find(name), *meant = synonym_option(name, r->groups, meaning);
    bool taken = option && option_is_taken(option, r->groups);
    bool lacks_value = taken && option->value && !option->alone && !value && (!next || is_option(next));
    if (taken && !(lacks_value && meant && *meaning)) {
        bool other = value && option->value && (option->former || own_value(option, value) != value);
        if (!option->value || option->alone || lacks_value || (value && !other))
            return add(r, word), true;
        add_option(r, option, other ? value : next);
        *at += !other;
    } else if (meant && !*meaning) {
        bool follows = !value && meant->value && !meant->alone && next && !is_option(next);
        add_option(r, meant, follows ? next : value);
        *at += follows;
    } else if (meant) {
        bool wants = strchr(meaning, '*') != NULL;
        add_meaning(r, meant, meaning, value ? value : wants && next ? next : "");
        *at += wants && !value && next;
    } else if (!r->command && (find_command(name) || synonym_command(name))) { // --info, --list-materials
        r->command = find_command(name) ? find_command(name) : synonym_command(name);
        if (r->draws)
            return complain(error, LAM_BAD_ARGUMENT, "unknown option '--%s'; the command is: lambent %s %s", name,
                            r->command->name, r->command->operands ? r->command->operands : "");
    } else if (!option && !answer(name, error)) {
        return false;
    } else if (!option && option_names_model(name)) {
        if (value)
            add(r, word + (value - word));
    } else {
        add(r, word);
    }
    return true;
}

static bool is_there(const char *word)
{
    struct stat found;
    return stat(word, &found) == 0 || lam_shape_find(word) >= 0;
}

// Returns the word for the first word of a command line if it means a command or an option without a value, otherwise
// NULL.
static const char *first_word(struct replacing *r, const char *word)
{
    char meaning[MEANING_SIZE];
    if (is_option(word) || find_command(word) || is_there(word))
        return NULL;
    if (synonym_command(word))
        return synonym_command(word)->name;
    const struct option *option = option_find(word), *meant = synonym_option(word, r->groups, meaning);
    bool alone = option ? option_is_taken(option, r->groups) && (!option->value || option->alone)
                        : meant && !strchr(meaning, '*') && (*meaning || !meant->value || meant->alone);
    return alone ? make(r, "--", word, "") : NULL;
}

static bool is_exported(const char *path)
{
    const char *dot = strrchr(path, '.'), *format;
    for (int i = 0; dot && (format = lam_export_format(i)); i++)
        if (strcasecmp(dot + 1, format) == 0)
            return true;
    return false;
}

static void insert(struct own_words *own, const char *word)
{
    memmove(own->words + 1, own->words, (size_t)own->count++ * sizeof *own->words);
    own->words[0] = (char *)(uintptr_t)word;
}

// Names the command that the output implies: a model is converted, and a folder of models is drawn to a folder.
static void imply_command(struct own_words *own)
{
    struct stat found;
    int first = options_first_operand(own->count, own->words), output = own->count - 2;
    while (output >= 0 && strcmp(own->words[output], "-o") != 0 && strcmp(own->words[output], "--output") != 0)
        output--;
    if (output < 0 || first < 0 || find_command(own->words[first]))
        return;
    char *name = own->words[output + 1];
    if (is_exported(name)) {
        memmove(own->words + output, own->words + output + 2, (size_t)(own->count - output - 2) * sizeof name);
        own->words[own->count-- - 2] = name;
        insert(own, "convert");
    } else if ((name[strlen(name) - 1] == '/' || strchr(name, '{')) && stat(own->words[first], &found) == 0 &&
               S_ISDIR(found.st_mode)) {
        insert(own, "batch");
    }
}

bool synonyms_replace(int count, char **given, struct own_words *own, lam_error *error)
{
    struct replacing r = {own, NULL, command_table->groups, false, true};
    *own = (struct own_words){calloc(2 * (size_t)count + 3, sizeof *own->words), 0,
                              calloc(2 * (size_t)count + 1, sizeof *own->made), 0};
    if (!own->words || !own->made)
        return complain(error, LAM_MACHINE, "out of memory");
    const char *first = count ? first_word(&r, given[0]) : NULL;
    if (first)
        given[0] = (char *)(uintptr_t)first;
    int operand = options_first_operand(count, given);
    r.command = operand >= 0 ? find_command(given[operand]) : NULL;
    if (r.command)
        r.groups = r.command->groups;
    for (int i = 0; i < count; i++)
        r.draws |= strncmp(given[i], "-o", 2) == 0 || strncmp(given[i], "--out", 5) == 0;
    bool ok = r.ok, verbatim = r.command && r.command->verbatim, named = r.command;
    int at = 0;
    for (; ok && at < count && !verbatim && strcmp(given[at], "--") != 0; at++)
        if (strncmp(given[at], "--", 2) == 0)
            ok = replace_option(&r, given, &at, error) && (r.ok || complain(error, LAM_MACHINE, "out of memory"));
        else if (strcmp(given[at], "-i") != 0)
            add(&r, given[at]);
    for (; ok && at < count; at++)
        add(&r, given[at]);
    if (ok && r.command && !named)
        insert(own, r.command->name);
    else if (ok && !r.command)
        imply_command(own);
    own->words[own->count] = NULL;
    return ok;
}

void synonyms_free(struct own_words *own)
{
    for (int i = 0; i < own->made_count; i++)
        free(own->made[i]);
    free(own->made);
    free(own->words);
}
