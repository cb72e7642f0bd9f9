// help_topic.c: the command `help`: explains a subject, a command or an option, or lists all of them.
#include "command.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "console.h"
#include "exit_codes.h"
#include "field_tables.h"
#include "help.h"
#include "help_print.h"
#include "help_search.h"
#include "suggest.h"
#include "topics.h"

enum { LIST_COLUMN = 15 };

// Returns the extension of a model's name.
static bool is_model_ending(const char *word)
{
    for (int format = 0; lam_model_format_name(format); format++)
        for (const char *at = lam_model_format_extensions(format); *at; at += strspn(at, " ")) {
            size_t length = strcspn(at, " ");
            if (strlen(word) == length && strncasecmp(at, word, length) == 0)
                return true;
            at += length;
        }
    return false;
}

static const struct topic *find_topic(const char *word)
{
    if (is_model_ending(word + (*word == '.')))
        word = "formats";
    for (const struct topic *t = topics; t->word; t++)
        if (strcmp(t->word, word) == 0)
            return t;
    return NULL;
}

// Finds an option from "light", "--light", "-o" or "o".
static const struct option *find_option(const char *word)
{
    char letter = word[0] != '-' && !word[1] ? word[0] : word[0] == '-' && word[1] && !word[2] ? word[1] : 0;
    for (const struct option *o = option_table; o->name && letter; o++)
        if (o->letter == letter)
            return o;
    const struct option *option = option_find(word + (strncmp(word, "--", 2) == 0 ? 2 : 0));
    return option && option->now ? option_find(option->now) : option;
}

static void print_options(uint64_t groups, const struct command *command)
{
    for (const struct option *o = option_table; o->name; o++)
        if (groups & 1ull << o->group && !o->now) {
            printf("\n");
            help_option(o, command, true);
        }
}

// Prints options with the defaults of the command that the subject describes.
static void print_topic(const struct topic *topic)
{
    const struct command *command = find_command(topic->word);
    if (command)
        help_command_head(command);
    printf("%s%s\n", command ? "\n" : "", topic->title);
    if (topic->text) {
        printf("\n");
        help_text(topic->text, 0, HELP_WIDTH);
    }
    print_options(topic->groups, command ? command : command_table);
    if (topic->table == TOPIC_LIGHT_FIELDS || topic->table == TOPIC_MATERIAL_FIELDS) {
        printf("\nKeys:\n");
        field_tables_text(topic->table == TOPIC_LIGHT_FIELDS ? lam_light_field : lam_material_field);
    } else if (topic->table == TOPIC_EXIT_CODES) {
        printf("\n");
        help_exit_codes();
    }
    if (command)
        printf("\nAll options of the command: lambent %s --help\n", command->name);
}

// Prints the title of a subject, and its options.
static void topic_summary(const struct topic *topic, char *text, size_t size)
{
    int used = snprintf(text, size, "%s", topic->title);
    bool first = true;
    for (const struct option *o = option_table; o->name; o++)
        if (topic->groups & 1ull << o->group && !o->now && used < (int)size) {
            used += snprintf(text + used, size - (size_t)used, "%s%s", first ? ": " : ", ", o->name);
            first = false;
        }
}

static void print_list(void)
{
    printf("Usage: lambent help TOPIC\n\nSubjects:\n");
    for (const struct topic *t = topics; t->word; t++) {
        char left[40], text[600];
        snprintf(left, sizeof left, "  %s", t->word);
        topic_summary(t, text, sizeof text);
        help_row(left, LIST_COLUMN, HELP_WIDTH, text);
    }
    printf("\nCommands:\n");
    help_commands();
    printf(
        "\nOptions: lambent help light, lambent help --light or lambent help -o; lambent --help lists all of them.\n");
}

// Returns the nearest name, or NULL if no name is near.
static const char *nearest_name(const char *word)
{
    struct suggestion nearest = suggest_start(word);
    for (const struct topic *t = topics; t->word; t++)
        suggest_try(&nearest, t->word);
    for (const struct command *c = command_table; c->name; c++)
        suggest_try(&nearest, c->name);
    for (const struct option *o = option_table; o->name; o++) {
        suggest_try(&nearest, o->name);
        suggest_also(&nearest, o->name, o->others);
    }
    return nearest.best;
}

// Searches the help for a word that is not a subject, command or option. Returns the exit code.
static int search(int count, char **words)
{
    const char *nearest = nearest_name(words[0]);
    char meant[80] = "", heading[200];
    lam_error error;
    if (nearest && count == 1)
        snprintf(meant, sizeof meant, "; did you mean '%s'?", nearest);
    if (count > 1)
        snprintf(heading, sizeof heading, "Found in these entries:");
    else
        snprintf(heading, sizeof heading, "No subject, command or option is named '%.60s'%s", words[0],
                 *meant ? meant : "; found in:");
    bool letter = count == 1 && strlen(words[0]) < 2; // a letter matches nearly every text
    if (!letter && help_search(count, words, heading))
        return 0;
    complain(&error, LAM_BAD_ARGUMENT,
             "help: unknown name '%.60s', expected a subject, a command or an option (`lambent help` lists them)%s",
             words[0], meant);
    say_error(error.text);
    return exit_code_of(error.code)->code;
}

int run_help(int operand_count, char **operands, const struct options *options)
{
    (void)options;
    const char *word = operand_count == 1 ? operands[0] : NULL; // several words are searched for
    const struct topic *topic = word ? find_topic(word) : NULL;
    const struct command *command = word ? find_command(word) : NULL;
    const struct option *option = word ? find_option(word) : NULL;
    if (!operand_count) {
        print_list();
    } else if (topic) {
        print_topic(topic);
        if (option && !command && !(topic->groups & 1ull << option->group)) {
            printf("\n");
            help_option(option, command_table, true);
        }
    } else if (command == command_table) {
        help_command_head(command);
        help_options(command);
    } else if (command) {
        print_help(command);
    } else if (option) {
        help_option(option, command_table, true);
        for (const struct topic *t = topics; t->word; t++)
            if (t->groups & 1ull << option->group)
                printf("\nMore: lambent help %s\n", t->word);
    } else if (word && strcmp(word, "all") == 0) {
        print_help(command_table);
    } else {
        return search(operand_count, operands);
    }
    return 0;
}
