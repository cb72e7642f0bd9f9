// help.h: the texts of -h and --help.
#ifndef HELP_H
#define HELP_H

#include "command.h"

// Prints the help of a command, or of the whole program for the first command of the table, on standard output: all of
// it (--help), or the most common options (-h) in at most 25 lines of 80 columns.
void print_help(const struct command *command);
void print_brief_help(const struct command *command);

#endif
