// help.c: prints the help for --help and -h.
#include "help.h"

#include <stdio.h>
#include <string.h>

enum { WIDTH = HELP_WIDTH, BRIEF_WIDTH = 80, BRIEF_COLUMN = 28, BRIEF_EXAMPLE_COLUMN = 41 };

void print_help(const struct command *command)
{
    if (command != command_table) {
        help_command_head(command);
        help_options(command);
        return;
    }
    printf("lambent renders 3D models: it turns a model file into a picture.\n\n"
           "Usage: lambent [OPTIONS] MODEL...\n"
           "       lambent COMMAND [ARGUMENTS]\n\n"
           "Examples:\n");
    for (const struct example *e = examples; e->line; e++) {
        char left[128];
        snprintf(left, sizeof left, "  %s", e->line);
        help_row(left, HELP_EXAMPLE_COLUMN, WIDTH, e->meaning);
    }
    help_options(command);
    printf("\nCommands:\n");
    help_commands();
    printf("\nExit codes:\n");
    help_exit_codes();
    printf("\nMore: lambent help TOPIC (lambent help lists the topics), man lambent\n");
}

// Prints an option on one line. Shortens a long placeholder for the value, and omits the default if the line has no
// space for it.
static void brief_option(const struct option *o, const struct command *command)
{
    char left[64], text[512], letter[8] = "    ";
    const char *standard = default_of(command, o), *brief = brief_of(command, o), *value = o->value;
    if (o->letter)
        snprintf(letter, sizeof letter, "-%c, ", o->letter);
    bool long_value = value && strlen("  -x, --") + strlen(o->name) + 1 + strlen(value) >= BRIEF_COLUMN;
    snprintf(left, sizeof left, "  %s--%s%s%.*s", letter, o->name, value ? " " : "",
             value ? (int)(long_value ? strcspn(value, "|[:") : strlen(value)) : 0, value ? value : "");
    bool fits = standard && BRIEF_COLUMN + strlen(brief) + strlen(standard) + strlen(" []") <= BRIEF_WIDTH;
    snprintf(text, sizeof text, "%s%s%s%s", brief, fits ? " [" : "", fits ? standard : "", fits ? "]" : "");
    help_row(left, BRIEF_COLUMN, BRIEF_WIDTH, text);
}

// Returns true if the option belongs to a command and does not apply to pictures of models.
static bool is_own(const struct option *o, const struct command *command)
{
    return !o->now && option_is_taken(o, command->groups) && !option_is_taken(o, command_table->groups);
}

// Prints the command's own options and the common picture options. Prints all common options if the command has no
// options of its own. Returns false if no options were printed.
static bool brief_options(const struct command *command)
{
    bool own = false, any = false;
    for (const struct option *o = option_table; o->name; o++)
        own |= is_own(o, command);
    for (const struct option *o = option_table; o->name; o++)
        if (is_own(o, command) ||
            (o->brief && option_is_taken(o, command->groups) && (!own || o->group == GROUP_PICTURE))) {
            brief_option(o, command);
            any = true;
        }
    return any;
}

void print_brief_help(const struct command *command)
{
    bool whole = command == command_table;
    char begin[64];
    if (whole) {
        printf("lambent renders 3D models: it turns a model file into a picture.\n\n");
        snprintf(begin, sizeof begin, "lambent ");
    } else {
        printf("Usage: lambent %s%s%s\n", command->name, command->operands ? " " : "",
               command->operands ? command->operands : "");
        help_text(command->summary, 0, BRIEF_WIDTH);
        printf(command->groups == 1ull << GROUP_ABOUT ? "" : "\n");
        snprintf(begin, sizeof begin, "lambent %s ", command->name);
    }
    bool examples_shown = false;
    for (const struct example *e = examples; e->line; e++) {
        if ((whole && !e->brief) || strncmp(e->line, begin, strlen(begin)) != 0)
            continue;
        char left[96];
        snprintf(left, sizeof left, "  %s", e->line);
        help_row(left, BRIEF_EXAMPLE_COLUMN, BRIEF_WIDTH, e->meaning);
        examples_shown = true;
    }
    if (examples_shown)
        printf("\n");
    bool options_shown = brief_options(command);
    if (whole) {
        char names[400] = "Commands:";
        for (const struct command *c = command_table + 1; c->name; c++) {
            size_t used = strlen(names);
            snprintf(names + used, sizeof names - used, "%s %s", c == command_table + 1 ? "" : ",", c->name);
        }
        printf("\n");
        help_text(names, 0, BRIEF_WIDTH);
        printf("Complete help: lambent --help. One subject, command or option: lambent help NAME\n");
    } else if (options_shown) {
        printf("\nComplete help: lambent %s --help\n", command->name);
    }
}
