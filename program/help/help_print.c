// help_print.c: prints the sections of help texts.
#include "help.h"

#include <stdio.h>
#include <string.h>

#include "console.h"
#include "synonyms.h"

enum { WIDTH = HELP_WIDTH, LETTER_COLUMN = 6 };

// Prints a paragraph, wrapped at `width` columns. The first line begins at column `at`, and further lines begin at
// column `indent`. Omits back quotes. Returns the text after the paragraph.
static const char *print_paragraph(const char *text, int at, int indent, int width)
{
    while (*text && *text != '\n') {
        size_t length = strcspn(text, " \n");
        int shown = 0;
        for (size_t i = 0; i < length; i++)
            shown += text[i] != '`';
        if (at > indent && at + 1 + shown > width) {
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
    return text + (*text == '\n');
}

void help_text(const char *text, int indent, int width)
{
    for (bool first = true; *text; first = false) {
        printf("%s%*s", first ? "" : "\n", indent, "");
        text = print_paragraph(text, indent, indent, width);
    }
}

void help_row(const char *left, int column, int width, const char *text)
{
    int used = (int)strlen(left);
    printf("%s", left);
    if (used + 1 > column) {
        putchar('\n');
        used = 0;
    }
    printf("%*s", column - used, "");
    print_paragraph(text, column, column, width);
}

static void print_words(const struct option *option)
{
    for (const struct choice *w = option->words; w && w->name; w++) {
        char left[96];
        snprintf(left, sizeof left, "%*s%s", LETTER_COLUMN, "", w->name);
        if (w->summary)
            help_row(left, HELP_COLUMN, WIDTH, w->summary);
        else
            printf("%s\n", left);
    }
}

void help_option(const struct option *option, const struct command *command, bool details)
{
    char left[96], letter[8] = "    ";
    if (option->letter)
        snprintf(letter, sizeof letter, "-%c, ", option->letter);
    snprintf(left, sizeof left, "  %s--%s%s%s", letter, option->name, option->value ? " " : "",
             option->value ? option->value : "");
    const char *standard = default_of(command, option);
    char text[512];
    snprintf(text, sizeof text, "%s%s%s%s", option->summary, standard ? " [" : "", standard ? standard : "",
             standard ? "]" : "");
    help_row(left, HELP_COLUMN, WIDTH, text);
    if (!details)
        return;
    if (option->details)
        help_text(option->details, LETTER_COLUMN, WIDTH);
    if (option->also)
        help_row("", LETTER_COLUMN, WIDTH, OTHER_NAMES), help_text(option->also, LETTER_COLUMN, WIDTH);
    print_words(option);
}

// `lambent --help` describes the options of these groups; other commands list only their names.
#define SHARED                                                                                                         \
    (PICTURE_GROUPS | 1ull << GROUP_ANIMATION | 1ull << GROUP_WORK | 1ull << GROUP_LIMITS | 1ull << GROUP_REPORT)

// Returns whether the command's help lists only the name of an option, because `lambent --help` describes the option.
// Returns false if the option's default differs for this command.
static bool is_shared(const struct option *o, const struct command *command)
{
    return command != command_table && SHARED & command->groups & 1ull << o->group &&
           default_of(command, o) == o->standard;
}

static void group_options(int group, const struct command *command)
{
    bool titled = false;
    for (const struct option *o = option_table; o->name; o++) {
        if ((int)o->group != group || o->now || !option_is_taken(o, command->groups) || is_shared(o, command))
            continue;
        if (!titled)
            printf("\n%s:\n", group_titles[group]);
        titled = true;
        help_option(o, command, false);
    }
}

// Prints the names of the shared options, one row for each group.
static void shared_options(const struct command *command)
{
    bool any = false;
    for (int group = 0; group < GROUP_COUNT; group++) {
        char left[64], text[1000] = "";
        size_t used = 0;
        for (const struct option *o = option_table; o->name && used < sizeof text; o++)
            if ((int)o->group == group && !o->now && option_is_taken(o, command->groups) && is_shared(o, command))
                used += (size_t)snprintf(text + used, sizeof text - used, "%s--%s", used ? ", " : "", o->name);
        if (!used)
            continue;
        if (!any)
            printf(
                "\nShared with pictures of models (lambent --help describes them, lambent help NAME describes one):\n");
        any = true;
        snprintf(left, sizeof left, "  %s", group_titles[group]);
        help_row(left, HELP_COLUMN, WIDTH, text);
    }
}

void help_options(const struct command *command)
{
    bool whole = command == command_table;
    const uint64_t later = SHARED | 1ull << GROUP_ABOUT;
    for (int group = 0; group < GROUP_COUNT; group++)
        if (whole || !(later & 1ull << group))
            group_options(group, command);
    for (int group = 0; group < GROUP_COUNT && !whole; group++)
        if (later & 1ull << group)
            group_options(group, command);
    shared_options(command);
}

void help_commands(void)
{
    for (const struct command *c = command_table + 1; c->name; c++) {
        char left[96];
        snprintf(left, sizeof left, "  %s%s%s", c->name, c->operands ? " " : "", c->operands ? c->operands : "");
        help_row(left, HELP_COLUMN, WIDTH, c->summary);
    }
}

void help_exit_codes(void)
{
    for (const struct exit_code *e = exit_codes; e->meaning; e++) {
        char left[16];
        snprintf(left, sizeof left, "  %d", e->code);
        help_row(left, 7, WIDTH, e->meaning);
    }
}

void help_command_head(const struct command *command)
{
    printf("Usage: lambent %s%s%s\n\n", command->name, command->operands ? " " : "",
           command->operands ? command->operands : "");
    help_text(command->summary, 0, WIDTH);
    if (command->also)
        help_row("Other names:", 13, WIDTH, command->also);
    char words[64];
    bool any = false;
    snprintf(words, sizeof words, "lambent %s ", command->name);
    for (const struct example *e = examples; e->line; e++) {
        if (strncmp(e->line, words, strlen(words)) != 0)
            continue;
        printf("%s", any ? "" : "\nExamples:\n");
        any = true;
        char left[128];
        snprintf(left, sizeof left, "  %s", e->line);
        help_row(left, HELP_EXAMPLE_COLUMN, WIDTH, e->meaning);
    }
}
