// manual.c: generates the man page and docs/command-line.md from the tables of options and commands.
#include "help_texts.h"

#include <stdio.h>
#include <string.h>

#include "console.h"
#include "synonyms.h"

// Prints text, escaped for roff. A dash becomes \- (roff may show a plain '-' as another dash), `code` becomes bold,
// and a control character at the start of a line is escaped.
static void roff(const char *text)
{
    bool code = false;
    for (const char *s = text; *s; s++) {
        if (*s == '`')
            fputs((code = !code) ? "\\fB" : "\\fR", stdout);
        else if (*s == '-')
            fputs("\\-", stdout);
        else if (*s == '\\')
            fputs("\\e", stdout);
        else if ((*s == '.' || *s == '\'') && (s == text || s[-1] == '\n'))
            printf("\\&%c", *s);
        else
            putchar(*s);
    }
}

static void roff_line(const char *text)
{
    roff(text);
    putchar('\n');
}

// Formats the default of an option, followed by the defaults of the commands that use a different default. The result
// is "" if there is no default.
static const char *standard_of(const struct option *o, char text[400])
{
    int used = snprintf(text, 400, "%s", o->standard ? o->standard : "");
    for (const struct command *c = command_table; c->name; c++) {
        const char *own = option_is_taken(o, c->groups) ? default_of(c, o) : o->standard;
        if (own && own != o->standard)
            used += snprintf(text + used, 400 - (size_t)used, "%s`%s`: %s", used ? "; " : "", c->name, own);
    }
    return text;
}

static void roff_option(const struct option *o)
{
    printf(".TP\n");
    if (o->letter)
        printf("\\fB\\-%c\\fR, ", o->letter);
    printf("\\fB\\-\\-");
    roff(o->name);
    printf("\\fR");
    if (o->value) {
        printf(" \\fI");
        roff(o->value);
        printf("\\fR");
    }
    printf("\n");
    roff_line(o->summary);
    char standard[400];
    if (*standard_of(o, standard)) {
        printf("Default: ");
        roff(standard);
        printf(".\n");
    }
    if (o->details)
        roff_line(o->details);
    if (o->also)
        roff(OTHER_NAMES), roff_line(o->also);
    for (const struct choice *w = o->words; w && w->name && w->summary; w++) {
        printf(".br\n\\fB");
        roff(w->name);
        printf("\\fR: ");
        roff_line(w->summary);
    }
}

static void roff_paragraphs(const char *text)
{
    for (; *text; text++) {
        if (*text == '\n') {
            printf("\n.PP\n");
            continue;
        }
        char paragraph[4096];
        size_t length = strcspn(text, "\n");
        snprintf(paragraph, sizeof paragraph, "%.*s", (int)length, text);
        roff(paragraph);
        text += length - 1;
    }
    putchar('\n');
}

void generate_man(void)
{
    printf(".TH LAMBENT 1 \"\" \"Lambent %s\" \"User Commands\"\n", lam_version());
    printf(".SH NAME\nlambent \\- render 3D models\n");
    printf(".SH SYNOPSIS\n.B lambent\n[\\fIOPTIONS\\fR] \\fIMODEL\\fR...\n.br\n.B lambent\n\\fICOMMAND\\fR "
           "[\\fIARGUMENTS\\fR]\n");
    printf(".SH EXAMPLES\n");
    for (const struct example *e = examples; e->line; e++) {
        printf(".TP\n.B ");
        roff_line(e->line);
        roff_line(e->meaning);
    }
    printf(".SH OPTIONS\n");
    for (int group = 0; group < GROUP_COUNT; group++) {
        printf(".SS %s\n", group_titles[group]);
        for (const struct option *o = option_table; o->name; o++)
            if ((int)o->group == group && !o->now)
                roff_option(o);
    }
    printf(".SH COMMANDS\n");
    for (const struct command *c = command_table; c->name; c++) {
        printf(".TP\n\\fB%s\\fR", c->name);
        if (c->operands)
            printf(" \\fI%s\\fR", c->operands);
        printf("\n");
        roff_line(c->summary);
        if (c->also)
            printf("Other names: %s\n", c->also);
    }
    for (const struct topic *t = topics; t->name; t++) {
        if (!t->text)
            continue;
        printf(".SH \"");
        for (const char *s = t->title; *s; s++)
            putchar(*s >= 'a' && *s <= 'z' ? *s - 'a' + 'A' : *s);
        printf("\"\n");
        roff_paragraphs(t->text);
    }
    field_tables_man();
    printf(".SH \"EXIT STATUS\"\n");
    for (const struct exit_code *e = exit_codes; e->meaning; e++) {
        printf(".TP\n.B %d\n", e->code);
        roff_line(e->meaning);
    }
}

// Prints a cell of a Markdown table, in which '|' must be escaped.
static void cell(const char *text)
{
    for (; *text; text++)
        printf(*text == '|' ? "\\|" : "%c", *text);
}

static void markdown_option(const struct option *o)
{
    printf("| `");
    if (o->letter)
        printf("-%c`, `", o->letter);
    printf("--%s", o->name);
    if (o->value) {
        putchar(' ');
        cell(o->value);
    }
    printf("` | ");
    char standard[400];
    cell(standard_of(o, standard));
    printf(" | ");
    cell(o->summary);
    if (o->details) {
        putchar(' ');
        cell(o->details);
    }
    if (o->also)
        printf(" " OTHER_NAMES "`%s`.", o->also);
    for (const struct choice *w = o->words; w && w->name && w->summary; w++) {
        printf("<br>`%s`: ", w->name);
        cell(w->summary);
    }
    printf(" |\n");
}

void generate_markdown(void)
{
    printf("<!-- Generated by `lambent generate markdown` from the tables of options, commands and fields. -->\n"
           "# The command line\n\n"
           "    lambent [OPTIONS] MODEL...\n"
           "    lambent COMMAND [ARGUMENTS]\n\n"
           "## Examples\n\n| command | description |\n|---|---|\n");
    for (const struct example *e = examples; e->line; e++) {
        printf("| `");
        cell(e->line);
        printf("` | ");
        cell(e->meaning);
        printf(" |\n");
    }
    printf("\n## Options\n");
    for (int group = 0; group < GROUP_COUNT; group++) {
        printf("\n### %s\n\n| option | default | description |\n|---|---|---|\n", group_titles[group]);
        for (const struct option *o = option_table; o->name; o++)
            if ((int)o->group == group && !o->now)
                markdown_option(o);
    }
    printf("\n## Commands\n\n| command | description |\n|---|---|\n");
    for (const struct command *c = command_table; c->name; c++) {
        printf("| `%s%s", c->name, c->operands ? " " : "");
        cell(c->operands ? c->operands : "");
        printf("` | ");
        cell(c->summary);
        printf("%s%s |\n", c->also ? " Other names: " : "", c->also ? c->also : "");
    }
    for (const struct topic *t = topics; t->name; t++) {
        if (!t->text)
            continue;
        printf("\n## %s\n\n", t->title);
        for (const char *s = t->text; *s; s++)
            fputs(*s == '\n' ? "\n\n" : (char[]){*s, 0}, stdout);
        putchar('\n');
    }
    field_tables_markdown();
    printf("\n## Exit codes\n\n| code | meaning |\n|---|---|\n");
    for (const struct exit_code *e = exit_codes; e->meaning; e++)
        printf("| %d | %s |\n", e->code, e->meaning);
}
