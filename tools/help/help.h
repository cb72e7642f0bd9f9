// help.h: prints the help for -h and --help.
#ifndef HELP_H
#define HELP_H

#include "command.h"

// Print the help for a command to standard output. For the first command of the table, print the help for the whole
// program. print_help prints everything (--help). print_brief_help prints the most common options (-h), in at most 25
// lines of 80 columns.
void print_help(const struct command *command);
void print_brief_help(const struct command *command);

#endif
