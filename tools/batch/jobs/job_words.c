// job_words.c: converts the options of a job to words and parses them.
#include "batch_job.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "console.h"
#include "json.h"

enum { WORDS_MAX = 1000 };

// --- from JSON to words

// Appends a word, and takes ownership of the word, which was allocated with malloc. A NULL word means that its
// allocation failed.
static bool append(char ***words, int *count, char *argument, lam_error *error)
{
    char **more = argument && *count < WORDS_MAX ? realloc(*words, ((size_t)*count + 2) * sizeof *more) : NULL;
    if (!more) {
        free(argument);
        return *count < WORDS_MAX ? complain(error, LAM_MACHINE, "out of memory")
                                  : complain(error, LAM_BAD_ARGUMENT, "key 'options': more than %d words", WORDS_MAX);
    }
    *words = more;
    more[(*count)++] = argument;
    more[*count] = NULL;
    return true;
}

// Formats a string or a number as a user would type it on a command line. Returns false for other values.
static bool typed(const json_t *value, char number[32], const char **text)
{
    *text = json_is_string(value) ? json_string_value(value) : number;
    if (json_is_integer(value))
        snprintf(number, 32, "%" JSON_INTEGER_FORMAT, json_integer_value(value));
    else if (json_is_real(value))
        shortest_number(json_real_value(value), number);
    return json_is_string(value) || json_is_number(value);
}

static bool has_word(const struct option *option, const char *name)
{
    for (const struct choice *w = option ? option->words : NULL; w && w->name; w++)
        if (strcmp(w->name, name) == 0)
            return true;
    return false;
}

// Appends one value of an option: --name=value, or --name for true.
static bool append_option(char ***words, int *count, const char *name, const json_t *value, lam_error *error)
{
    const struct option *option = option_find(name);
    char number[32], *argument = NULL;
    const char *text;
    if (json_is_boolean(value) && has_word(option, "off")) {
        text = json_is_true(value) ? "on" : "off";
        if (json_is_true(value) && option->alone)
            text = option->alone;
    } else if (json_is_false(value) || json_is_null(value)) {
        return true;
    } else if (json_is_true(value)) {
        text = NULL;
    } else if (!typed(value, number, &text)) {
        return complain(error, LAM_BAD_ARGUMENT,
                        "key 'options': option '%.60s': expected a string, a number, true, or a list of them", name);
    }
    if ((text ? asprintf(&argument, "--%s=%s", name, text) : asprintf(&argument, "--%s", name)) < 0)
        argument = NULL;
    return append(words, count, argument, error);
}

static bool from_object(json_t *object, char ***words, int *count, lam_error *error)
{
    const char *name;
    json_t *value, *item;
    size_t i;
    json_object_foreach(object, name, value)
    {
        if (!*name || strspn(name, "abcdefghijklmnopqrstuvwxyz0123456789-") != strlen(name))
            return complain(error, LAM_BAD_ARGUMENT,
                            "key 'options': found '%.60s', expected the name of an option without its dashes", name);
        if (!json_is_array(value) && !append_option(words, count, name, value, error))
            return false;
        json_array_foreach(value, i, item) if (!append_option(words, count, name, item, error)) return false;
    }
    return true;
}

bool job_words_make(const json_t *value, char ***words, int *count, lam_error *error)
{
    json_t *item;
    size_t i;
    *words = NULL;
    *count = 0;
    if (!value || json_is_null(value))
        return true;
    if (json_is_object(value))
        return from_object((json_t *)(uintptr_t)value, words, count, error);
    if (!json_is_array(value))
        return complain(
            error, LAM_BAD_ARGUMENT,
            "key 'options': expected a list of words or an object of options, such as [\"--size\", \"256\"] or "
            "{\"size\": 256}");
    json_array_foreach(value, i, item)
    {
        char number[32];
        const char *text;
        if (!typed(item, number, &text))
            return complain(error, LAM_BAD_ARGUMENT, "key 'options': word %zu is neither a string nor a number", i + 1);
        if (!append(words, count, strdup(text), error))
            return false;
    }
    return true;
}

void job_words_free(char **words, int count)
{
    for (int i = 0; i < count; i++)
        free(words[i]);
    free(words);
}

// --- from words to options

// Jobs may set only options of the picture, because the worker's command line sets limits, processors and output files.
static bool check(const struct options *given, lam_error *error)
{
    for (const struct option *option = option_table; option->name; option++) {
        if (!given->given[option - option_table] || option_is_in(option, IN_JOB))
            continue;
        bool output = strcmp(option->name, "output") == 0;
        return complain(error, LAM_BAD_ARGUMENT, "option '--%s' is not allowed in a job: %s", option->name,
                        output ? "use the job's key 'output'" : "it is allowed only on the worker's command line");
    }
    return true;
}

// Parses the words into `options`. Copies the list of words first, because parsing changes its order.
static bool parse(char *const *words, int count, struct options *options, lam_error *error)
{
    char **list = calloc((size_t)count + 1, sizeof *list);
    if (!list)
        return complain(error, LAM_MACHINE, "out of memory");
    for (int i = 0; i < count; i++)
        list[i] = words[i];
    int operands = options_parse(count, list, ~WRITES_NO_FILE, options, error);
    if (operands > 0)
        complain(error, LAM_BAD_ARGUMENT, "key 'options': unexpected word '%.100s'", list[0]);
    free(list);
    return operands == 0;
}

bool job_words_apply(char *const *words, int count, struct options *options, lam_error *error)
{
    struct options given = option_defaults();
    bool ok = !count || (parse(words, count, &given, error) && check(&given, error));
    options_free(&given);
    return ok && (!count || parse(words, count, options, error));
}
