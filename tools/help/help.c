// help.c: --help and the command `help`: prints the examples, then the options by group.
#include "help.h"

#include <stdio.h>
#include <string.h>

#include "console.h"
#include "exit_codes.h"
#include "suggest.h"

enum { WIDTH = 100, COLUMN = 29, EXAMPLE_COLUMN = 41 };

// Prints words up to WIDTH columns, starting at column `at`; further lines begin at `indent`. Omits back quotes.
static void print_wrapped(const char *text, int at, int indent)
{
    while (*text) {
        size_t length = strcspn(text, " ");
        int shown = 0;
        for (size_t i = 0; i < length; i++)
            shown += text[i] != '`';
        if (at > indent && at + 1 + shown > WIDTH) {
            printf("\n%*s", indent, "");
            at = indent;
        } else if (at > indent) {
            putchar(' ');
            at++;
        }
        for (size_t i = 0; i < length; i++)
            if (text[i] != '`')
                putchar(text[i]);
        at += shown;
        text += length;
        text += strspn(text, " ");
    }
    putchar('\n');
}

static void print_row(const char *left, int column, const char *text)
{
    int width = (int)strlen(left);
    printf("%s", left);
    if (width + 1 > column) {
        putchar('\n');
        width = 0;
    }
    printf("%*s", column - width, "");
    print_wrapped(text, column, column);
}

static void print_option(const struct option *option)
{
    char left[96], text[512];
    char letter[8] = "    ";
    if (option->letter)
        snprintf(letter, sizeof letter, "-%c, ", option->letter);
    snprintf(left, sizeof left, "  %s--%s%s%s", letter, option->name, option->value ? " " : "",
             option->value ? option->value : "");
    snprintf(text, sizeof text, "%s%s%s%s", option->summary, option->standard ? " [" : "",
             option->standard ? option->standard : "", option->standard ? "]" : "");
    print_row(left, COLUMN, text);
}

static void print_options(unsigned groups)
{
    for (int group = 0; group < GROUP_COUNT; group++) {
        bool titled = false;
        for (const struct option *o = option_table; o->name; o++) {
            if ((int)o->group != group || !option_is_taken(o, groups))
                continue;
            if (!titled)
                printf("\n%s:\n", group_titles[group]);
            titled = true;
            print_option(o);
        }
    }
}

// Prints the examples that begin with `words`; NULL: all.
static void print_examples(const char *words)
{
    bool any = false;
    for (const struct example *e = examples; e->line; e++) {
        if (words && strncmp(e->line, words, strlen(words)) != 0)
            continue;
        if (!any)
            printf(words ? "\nExamples:\n" : "Examples:\n");
        any = true;
        char left[128];
        snprintf(left, sizeof left, "  %s", e->line);
        print_row(left, EXAMPLE_COLUMN, e->meaning);
    }
}

static void print_command(const struct command *command)
{
    printf("Usage: lambent %s%s%s\n\n%s\n", command->name, command->operands ? " " : "",
           command->operands ? command->operands : "", command->summary);
    char words[64];
    snprintf(words, sizeof words, "lambent %s ", command->name);
    print_examples(words);
    print_options(command->groups);
}

void print_help(const struct command *command)
{
    if (command != command_table) {
        print_command(command);
        return;
    }
    printf("lambent lights 3D models: a model file becomes a picture.\n\n"
           "Usage: lambent [OPTIONS] MODEL...\n"
           "       lambent COMMAND [ARGUMENTS]\n\n");
    print_examples(NULL);
    print_options(command->groups);
    printf("\nCommands:\n");
    for (const struct command *c = command_table + 1; c->name; c++) {
        char left[96];
        snprintf(left, sizeof left, "  %s%s%s", c->name, c->operands ? " " : "", c->operands ? c->operands : "");
        print_row(left, COLUMN, c->summary);
    }
    printf("\nExit codes:\n");
    for (const struct exit_code *e = exit_codes; e->meaning; e++) {
        char left[16];
        snprintf(left, sizeof left, "  %d", e->code);
        print_row(left, 7, e->meaning);
    }
    printf("\nMore: man lambent\n");
}

int run_help(int operand_count, char **operands, const struct options *options)
{
    (void)options;
    const struct command *command = operand_count ? find_command(operands[0]) : command_table;
    if (!command) {
        lam_error error;
        struct suggestion nearest = suggest_start(operands[0]);
        for (const struct command *c = command_table; c->name; c++)
            suggest_try(&nearest, c->name);
        char known[256] = "";
        for (const struct command *c = command_table; c->name; c++) {
            strncat(known, c == command_table ? "" : c[1].name ? ", " : " or ", sizeof known - strlen(known) - 1);
            strncat(known, c->name, sizeof known - strlen(known) - 1);
        }
        complain(&error, LAM_BAD_ARGUMENT, "help: unknown command '%.60s', expected %s%s%s%s", operands[0], known,
                 nearest.best ? "; did you mean '" : "", nearest.best ? nearest.best : "", nearest.best ? "'?" : "");
        say_error(error.text);
        return exit_code_of(error.code)->code;
    }
    if (operand_count)
        print_command(command);
    else
        print_help(command);
    return 0;
}
