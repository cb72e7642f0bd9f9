// help.h: prints the help for -h and --help.
#ifndef HELP_H
#define HELP_H

#include "command.h"

#include <lambent/fields.h>

#include <stdbool.h>
#include <stdint.h>

// Print the help for a command to standard output. For the first command of the table, print the help for the whole
// program. print_help prints everything (--help). print_brief_help prints the most common options (-h), in at most 25
// lines of 80 columns.
void print_help(const struct command *command);
void print_brief_help(const struct command *command);

// --- finds subjects, commands, options and keys whose texts contain given words.

// Prints the heading, and a row for each entry whose name or summary contains all of the words. If there is no such
// entry, also searches details and prose. Returns false and prints nothing if this search finds nothing either.
bool help_search(int count, char **words, const char *heading);

// --- defines the subjects of `lambent help TOPIC`. The man page and docs/command-line.md also contain these texts.

enum topic_table { TOPIC_NO_TABLE, TOPIC_LIGHT_FIELDS, TOPIC_MATERIAL_FIELDS, TOPIC_EXIT_CODES };

struct topic {
    const char *name; // the argument of `lambent help WORD`
    const char *title;
    uint64_t groups;        // bit g is set if the options of group g belong to the subject
    enum topic_table table; // shown below the options
    const char *text;       // paragraphs with `code` in back quotes, also printed in the man page; may be NULL
};

extern const struct topic topics[]; // in the order of the man page; ends with a NULL name

// --- prints the sections of help texts to standard output, at most 100 columns wide.

enum { HELP_WIDTH = 100, HELP_COLUMN = 29, HELP_EXAMPLE_COLUMN = 41 };

// Prints paragraphs, separated by empty lines. Indents them by `indent` columns, wraps them at `width` columns, and
// omits back quotes.
void help_text(const char *text, int indent, int width);

// Prints a row: `left`, then the text from `column` on, wrapped at `width` columns. The text begins on the next line if
// `left` is too long.
void help_row(const char *left, int column, int width, const char *text);

// Prints an option's row: its summary and its default, or the default of `command` if that default differs. Prints all
// information about the option if `details` is set.
void help_option(const struct option *option, const struct command *command, bool details);

// Prints the options that a command accepts, by group: first the command's own options, then only the names of the
// shared options.
void help_options(const struct command *command);

void help_commands(void);   // all commands except the default command
void help_exit_codes(void); // table of exit codes

// Prints the command's usage, its summary and its examples.
void help_command_head(const struct command *command);

// --- prints the tables of material and light fields for the documentation.

void field_tables_markdown(void);
void field_tables_man(void);
void field_tables_text(const lam_field *(*row)(int)); // for `help`: the rows of lam_light_field or lam_material_field

// Returns the default as text.
const char *field_standard(const lam_field *field, char text[80]);

// --- prints texts generated from the tables on standard output.

void generate_man(void);      // manual.c
void generate_markdown(void); // manual.c
void generate_bash(void);     // complete.c
void generate_zsh(void);
void generate_fish(void);
void generate_scene_schema(void); // scene_schema.c

// Returns the name of a text that can be generated, or NULL if the index is out of range. Indices begin at 0.
const char *generate_kind(int index);

#endif
