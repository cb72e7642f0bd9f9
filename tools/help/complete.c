// complete.c: the command `complete`: prints completions for a command line, for shells.
#include "complete.h"

#include <stdio.h>
#include <string.h>

#include "command.h"
#include "help_texts.h"

static struct typed_word whole(const char *argument) { return (struct typed_word){argument, argument, 0}; }

// Returns the option that the word names if the next word is the option's value, otherwise NULL.
static const struct option *expects_value(const char *argument)
{
    const struct option *option = NULL;
    if (argument[0] == '-' && argument[1] == '-')
        option = option_find(argument + 2); // not "--name=value"
    else if (argument[0] == '-' && argument[1] && !argument[2])
        for (const struct option *o = option_table; o->name && !option; o++)
            option = o->letter == argument[1] ? o : NULL;
    return option && option->value ? option : NULL;
}

// Offers the synonyms of an option or a command. The caller offers them only for a typed beginning.
static void complete_synonyms(const struct typed_word *typed, const char *also, const char *of)
{
    for (size_t length; also && *also; also += length + (also[length] == ' ')) {
        char word[40];
        length = strcspn(also, " ");
        snprintf(word, sizeof word, "%.*s", (int)strcspn(also, "= "), also);
        complete_offer(typed, word, "", of);
    }
}

static void complete_option(const struct command *command, const char *argument, int count, char **words)
{
    const char *equals = strchr(argument, '=');
    if (equals) {
        char name[64];
        snprintf(name, sizeof name, "%.*s", (int)(equals - argument - 2), argument + 2);
        const struct option *option = option_find(name);
        struct typed_word value = {argument, equals + 1, (int)(equals + 1 - argument)};
        if (option && option->value && option_is_taken(option, command->groups) &&
            !complete_from_model(option, &value, count, words))
            complete_value(option, &value);
        return;
    }
    struct typed_word name = {"--", strncmp(argument, "--", 2) == 0 ? argument + 2 : "", 2};
    for (const struct option *o = option_table; o->name; o++)
        if (option_is_taken(o, command->groups) && !o->now)
            complete_offer(&name, o->name, "", o->summary);
    for (const struct option *o = option_table; *name.prefix && o->name; o++)
        if (option_is_taken(o, command->groups))
            complete_synonyms(&name, o->also, o->name);
}

static void complete_commands(const struct typed_word *typed)
{
    for (const struct command *c = command_table; c->name; c++)
        complete_offer(typed, c->name, "", c->summary);
    for (const struct command *c = command_table; *typed->prefix && c->name; c++)
        complete_synonyms(typed, c->also, c->name);
}

static void complete_shapes(const struct typed_word *typed)
{
    for (int i = 0; i < lam_shape_count(); i++)
        complete_offer(typed, lam_shape_name(i), "", lam_shape_summary(i));
}

static bool is_topic(const char *argument)
{
    const struct topic *t = topics;
    while (t->name && strcmp(t->name, argument) != 0)
        t++;
    return t->name;
}

static void complete_topics(const struct typed_word *typed)
{
    for (const struct topic *t = topics; t->name; t++)
        complete_offer(typed, t->name, "", t->title);
    for (const struct command *c = command_table; c->name; c++)
        if (!is_topic(c->name))
            complete_offer(typed, c->name, "", c->summary);
    for (const struct option *o = option_table; o->name; o++)
        if (!o->now && !is_topic(o->name) && !find_command(o->name) && option_find(o->name) == o)
            complete_offer(typed, o->name, "", o->summary);
}

// Offers the names in the operands of a command, such as "man|bash" or "spot|highlight [CURVE...]". Placeholders are in
// capitals.
static void complete_names(const struct command *command, const struct typed_word *typed)
{
    for (const char *at = command->operands; *at && *at != ' ';
         at += strcspn(at, "| ") + (at[strcspn(at, "| ")] == '|')) {
        char name[40];
        snprintf(name, sizeof name, "%.*s", (int)strcspn(at, "| "), at);
        if (!strpbrk(name, "ABCDEFGHIJKLMNOPQRSTUVWXYZ"))
            complete_offer(typed, name, "", NULL);
    }
}

// Completes operand number `index`, counted from 0.
static void complete_operand(const struct command *command, int index, const char *argument)
{
    struct typed_word typed = whole(argument);
    if (command->max_operands >= 0 && index >= command->max_operands)
        return;
    switch ((enum command_index)(command - command_table)) {
    case COMMAND_help:
        complete_topics(&typed);
        return;
    case COMMAND_generate:
    case COMMAND_plot:
        if (index == 0)
            complete_names(command, &typed);
        else
            complete_files(); // files of lights
        return;
    case COMMAND_explain:
    case COMMAND_render:
    case COMMAND_compare:
    case COMMAND_shader:
    case COMMAND_lights:
        if (index == 0 || command == command_table) {
            complete_shapes(&typed);
            complete_files();
        }
        return;
    default:
        complete_files();
        return;
    }
}

int run_complete(int count, char **words, const struct options *options)
{
    (void)options;
    if (count && strcmp(words[0], "--") == 0)
        words++, count--;
    const char *last = count ? words[count - 1] : "";
    int first = options_first_operand(count - 1, words), operands = 0;
    const struct command *command = first >= 0 ? find_command(words[first]) : NULL;
    if (!command)
        first = -1;
    command = command ? command : command_table;
    bool only_operands = false;
    const struct option *waiting = NULL; // an option that still needs a value
    for (int at = 0; at < count - 1; at++) {
        if (at == first)
            continue;
        if (waiting)
            waiting = NULL;
        else if (only_operands || words[at][0] != '-' || !words[at][1])
            operands++;
        else if (strcmp(words[at], "--") == 0)
            only_operands = true;
        else
            waiting = expects_value(words[at]);
    }
    struct typed_word typed = whole(last);
    if (waiting) {
        if (option_is_taken(waiting, command->groups) && !complete_from_model(waiting, &typed, count - 1, words))
            complete_value(waiting, &typed);
        return 0;
    }
    if (*last == '-' && !only_operands && !command->verbatim) {
        complete_option(command, last, count - 1, words);
        return 0;
    }
    if (count <= 1)
        complete_commands(&typed);
    complete_operand(command, operands, last);
    return 0;
}
