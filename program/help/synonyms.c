// synonyms.c: replaces the words of other programs in a command line by Lambent's own words.
#include "synonyms.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <lambent/material.h>
#include <lambent/mesh.h>
#include <lambent/scene.h>
#include <lambent/words.h>

#include "console.h"
#include "output.h"

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
    char **words, *made; // `made`: memory for new words
    int count;
    const struct command *command; // the command that a word names, or NULL
    uint64_t groups;               // of the command
    bool draws;                    // whether the command line names an output
};

static void add(struct replacing *r, const char *word) { r->words[r->count++] = (char *)(uintptr_t)word; }

// Makes a word: `head`, followed by `meaning`, in which `value` replaces *. A value of numbers and commas gets slashes, as
// in Lambent's positions.
enum { HEAD_SIZE = 200 };
static char *make(struct replacing *r, const char *head, const char *meaning, const char *value)
{
    const char *star = strchr(meaning, '*');
    size_t end = strlen(value);
    bool twice = star && star[1] && end && value[end - 1] == star[1]; // "pictures/" and "*/"
    char *word = r->made, *after = word + strlen(head);
    r->made += 1 + sprintf(word, "%s%.*s%s%s", head, (int)strcspn(meaning, "*"), meaning, star ? value : "",
                           star && !twice ? star + 1 : "");
    for (char *c = after; star && !value[strspn(value, "0123456789.,+-eE")] && *c; c++)
        *c = *c == ',' ? '/' : *c;
    return word;
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
        add(r, own_value(option, value));
}

// Adds a synonym with a meaning such as "top" or "eye=*". A second part of the same value joins the first: `--eye 3,2,1
// --look-at 0,0,0` becomes `--camera eye=3/2/1,target=0/0/0`, and `--width 8 --height 6` becomes `--size 8x6`.
static void add_meaning(struct replacing *r, const struct option *option, const char *meaning, const char *value)
{
    char head[HEAD_SIZE];
    const char *joint = strstr(meaning, "=*") ? "," : *meaning == 'x' && meaning[1] == '*' ? "" : NULL;
    for (int i = 0; joint && i + 1 < r->count; i++)
        if (strncmp(r->words[i], "--", 2) == 0 && strcmp(r->words[i] + 2, option->name) == 0) {
            if (snprintf(head, sizeof head, "%s%s", r->words[i + 1], joint) >= (int)sizeof head)
                break; // too long to join: the option refuses the second value
            r->words[i + 1] = make(r, head, meaning, value);
            return;
        }
    if (strcmp(meaning, "-") == 0) // Lambent always does this
        return;
    add(r, make(r, "--", option->name, ""));
    add(r, make(r, "", meaning, value));
}

static bool is_option(const char *word) { return word && word[0] == '-' && word[1] && !strchr("0123456789.", word[1]); }

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
    bool valued = option && option->value && (value || (next && !is_option(next))); // another command's option
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
    } else if (!r->command && !valued && (find_command(name) || synonym_command(name))) { // --info, --list-materials
        r->command = find_command(name) ? find_command(name) : synonym_command(name);
        if (r->draws)
            return complain(error, LAM_BAD_ARGUMENT, "unknown option '--%s'; the command is: lambent %s %s", name,
                            r->command->name, r->command->operands ? r->command->operands : "");
    } else if (option || !find("in input infile model mesh load", name, meaning)) { // otherwise, the value is the model
        add(r, word);
    } else if (value) {
        add(r, value);
    }
    return true;
}

// Returns the word for the first word of a command line if it means a command or an option without a value, otherwise
// NULL.
static const char *first_word(struct replacing *r, const char *word)
{
    char meaning[MEANING_SIZE];
    if (is_option(word) || find_command(word) || access(word, F_OK) == 0 || lam_shape_find(word) >= 0)
        return NULL;
    if (synonym_command(word))
        return synonym_command(word)->name;
    const struct option *option = option_find(word), *meant = synonym_option(word, r->groups, meaning);
    bool alone = option ? option_is_taken(option, r->groups) && (!option->value || option->alone)
                        : meant && !strchr(meaning, '*') && (*meaning || !meant->value || meant->alone);
    return alone ? make(r, "--", word, "") : NULL;
}

static void insert(struct replacing *r, const char *word)
{
    memmove(r->words + 1, r->words, (size_t)r->count++ * sizeof *r->words);
    r->words[0] = (char *)(uintptr_t)word;
}

// Names the command that the operand and the output imply: a model is converted, a folder of models is drawn to a folder
// or on a sheet.
static void imply_command(struct replacing *r)
{
    struct stat found;
    int first = options_first_operand(r->count, r->words), output = r->count - 2;
    while (output >= 0 && strcmp(r->words[output], "-o") != 0 && strcmp(r->words[output], "--output") != 0)
        output--;
    if (first < 0 || find_command(r->words[first]))
        return;
    bool folder = stat(r->words[first], &found) == 0 && S_ISDIR(found.st_mode);
    char *name = output < 0 ? "sheet.png" : r->words[output + 1];
    if (is_model_name(name)) {
        memmove(r->words + output, r->words + output + 2, (size_t)(r->count - output - 2) * sizeof name);
        r->words[r->count-- - 2] = name;
        insert(r, "convert");
    } else if (folder) {
        insert(r, (*name && name[strlen(name) - 1] == '/') || strchr(name, '{') ? "batch" : "sheet");
    }
}

// Returns the command that a command with models means: `compare` with several models and `batch --sheet` draw a sheet, and
// `check` with a model checks it for printing.
static const char *command_for_models(const char *name, int count, char **words)
{
    int models = 0;
    bool sheet = false, across = false;
    for (int i = 0; i < count; i++) {
        models += words[i][0] != '-' && is_model_name(words[i]) && access(words[i], F_OK) == 0;
        sheet |= strncmp(words[i], "--sheet", 7) == 0;
        across |= strncmp(words[i], "--across", 8) == 0;
    }
    bool draws_sheet =
        (strcmp(name, "compare") == 0 && models > 1 && !sheet && !across) || (strcmp(name, "batch") == 0 && sheet);
    return draws_sheet ? "sheet" : models && strcmp(name, "check") == 0 ? "info" : name;
}

// The name of an output selects the format. Beside such a name, --format must agree with it.
static bool check_format(struct replacing *r, lam_error *error)
{
    char **made = NULL, *output = NULL;
    for (int i = 0; i + 1 < r->count; i++)
        if (strcmp(r->words[i], "-o") == 0 || strcmp(r->words[i], "--output") == 0) {
            bool by_format = strncmp(r->words[i + 1], "{stem}.", 7) == 0;
            made = by_format ? &r->words[i + 1] : made;
            output = by_format ? output : r->words[i + 1];
        }
    if (!made || !output)
        return true;
    const char *format = *made + strlen("{stem}"), *dot = strrchr(output, '.');
    if (!dot || strcmp(dot, format) != 0)
        return complain(error, LAM_BAD_ARGUMENT,
                        "option '--format': found '%.20s' beside -o '%.200s'; the name selects the format, expected -o "
                        "'%.200s%s%s'",
                        format + 1, output, output, output[strlen(output) - 1] == '/' ? "{stem}-{view}" : "", format);
    *made = output;
    return true;
}

char **synonyms_replace(int *count, char **given, lam_error *error)
{
    struct replacing r = {.groups = command_table->groups};
    size_t size = 0;
    for (int i = 0; i < *count; i++) {
        size += 2 * strlen(given[i]) + 2 * (HEAD_SIZE + MEANING_SIZE + 4);
        r.draws |= strncmp(given[i], "-o", 2) == 0 || strncmp(given[i], "--out", 5) == 0;
    }
    r.words = malloc((2 * (size_t)*count + 3) * sizeof *r.words + size);
    if (!r.words)
        return complain(error, LAM_MACHINE, "out of memory"), NULL;
    r.made = (char *)(r.words + 2 * (size_t)*count + 3);
    const char *first = *count ? first_word(&r, given[0]) : NULL;
    if (first)
        given[0] = (char *)(uintptr_t)first;
    int operand = options_first_operand(*count, given), at = 0;
    r.command = operand >= 0 ? find_command(given[operand]) : NULL;
    if (r.command) {
        const char *meant = command_for_models(given[operand], *count, given);
        bool prints = strcmp(meant, "info") == 0 && strcmp(given[operand], "check") == 0;
        given[operand] = prints ? "--print" : (char *)(uintptr_t)meant;
        r.command = find_command(meant);
        if (prints)
            add(&r, "info");
    }
    if (r.command)
        r.groups = r.command->groups;
    bool named = r.command, verbatim = named && r.command->verbatim, ok = true;
    for (; ok && at < *count && !verbatim && strcmp(given[at], "--") != 0; at++) {
        if (strcmp(given[at], "-f") == 0 || strcmp(given[at], "-t") == 0)
            given[at] = given[at][1] == 'f' ? "--format" : "--threads";
        if (strcmp(given[at], "--sheet") == 0 && r.command && strcmp(r.command->name, "sheet") == 0)
            continue;
        if (strncmp(given[at], "--", 2) == 0)
            ok = replace_option(&r, given, &at, error);
        else if (strcmp(given[at], "-i") != 0)
            add(&r, given[at]);
    }
    for (; at < *count; at++)
        add(&r, given[at]);
    ok = ok && check_format(&r, error);
    if (r.command && !named)
        insert(&r, r.command->name);
    else if (!r.command)
        imply_command(&r);
    r.words[ *count = r.count] = NULL;
    if (!ok)
        free(r.words);
    return ok ? r.words : NULL;
}
