// help.h: prints the help for -h and --help.
#ifndef HELP_H
#define HELP_H

#include "command_table.h"

// Print the help for a command to standard output. For the first command of the table, print the help for the whole
// program. print_help prints everything (--help). print_brief_help prints the most common options (-h), in at most 25
// lines of 80 columns.
void print_help(const struct command *command);
void print_brief_help(const struct command *command);

// --- the sections of help texts, at most 100 columns wide

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

#endif
