// help.h: the text of --help.
#ifndef HELP_H
#define HELP_H

#include "command.h"

// Prints the help of a command, or of the whole program for the first command of the table, on standard output.
void print_help(const struct command *command);

#endif
