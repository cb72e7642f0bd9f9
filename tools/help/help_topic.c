// help_topic.c: the command `help`: explains a subject, a command or an option, or lists the subjects and commands.
#include "command.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "console.h"
#include "help_texts.h"
#include "synonyms.h"

enum { LIST_COLUMN = 15 };

// Returns whether the query is the extension of a model format.
static bool is_model_ending(const char *query)
{
    for (int format = 0; lam_model_format_name(format); format++)
        for (const char *at = lam_model_format_extensions(format); *at; at += strspn(at, " ")) {
            size_t length = strcspn(at, " ");
            if (strlen(query) == length && strncasecmp(at, query, length) == 0)
                return true;
            at += length;
        }
    return false;
}

static const struct topic *find_topic(const char *query)
{
    if (is_model_ending(query + (*query == '.')))
        query = "formats";
    for (const struct topic *t = topics; t->name; t++)
        if (strcmp(t->name, query) == 0)
            return t;
    return NULL;
}

// Finds the option for a query such as "light", "--light", "-o" or "o".
static const struct option *find_option(const char *query)
{
    char letter = query[0] != '-' && !query[1] ? query[0] : query[0] == '-' && query[1] && !query[2] ? query[1] : 0;
    for (const struct option *o = option_table; o->name && letter; o++)
        if (o->letter == letter)
            return o;
    char meaning[MEANING_SIZE];
    query += strncmp(query, "--", 2) == 0 ? 2 : 0;
    const struct option *option = option_find(query);
    option = option ? option : synonym_option(query, ~WRITES_NO_FILE, meaning);
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
    const struct command *command = find_command(topic->name);
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

// Formats the title of a subject and the names of its options.
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
    for (const struct topic *t = topics; t->name; t++) {
        char left[40], text[600];
        snprintf(left, sizeof left, "  %s", t->name);
        topic_summary(t, text, sizeof text);
        help_row(left, LIST_COLUMN, HELP_WIDTH, text);
    }
    printf("\nCommands:\n");
    help_commands();
    printf("\nOptions: lambent help light, lambent help --light or lambent help -o. All options: lambent --help\n");
}

// Returns the name that is most similar to the query, or NULL if no name is similar enough.
static const char *nearest_name(const char *query)
{
    struct suggestion nearest = suggest_start(query);
    for (const struct topic *t = topics; t->name; t++)
        suggest_try(&nearest, t->name);
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
        snprintf(heading, sizeof heading, "These entries contain all of these words:");
    else
        snprintf(heading, sizeof heading, "No subject, command or option is named '%.60s'%s", words[0],
                 *meant ? meant : ". These entries contain the word:");
    bool letter = count == 1 && strlen(words[0]) < 2; // a single letter matches nearly every text
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
    const char *query = operand_count == 1 ? operands[0] : NULL; // with several words, `help` searches for all of them
    const struct topic *topic = query ? find_topic(query) : NULL;
    const struct command *command = query ? find_command(query) : NULL;
    const struct option *option = query ? find_option(query) : NULL;
    if (query && !topic && !option && !command)
        command = synonym_command(query);
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
        for (const struct option *o = option_table; o->name;
             o++) // a name may mean different options of different commands
            if (o == option || strcmp(o->name, option->name) == 0) {
                help_option(o, command_table, true);
                for (const struct topic *t = topics; t->name; t++)
                    if (t->groups & 1ull << o->group)
                        printf("\nMore: lambent help %s\n", t->name);
            }
    } else if (query && strcmp(query, "all") == 0) {
        print_help(command_table);
    } else {
        return search(operand_count, operands);
    }
    return 0;
}
