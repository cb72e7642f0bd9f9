// help.h: --help, and the search for a command by its name.
#ifndef HELP_H
#define HELP_H

#include "command.h"

// On standard output. For the first command of the table: the whole program's.
void print_help(const struct command *command);

const struct command *find_command(const char *name); // NULL: no such command

#endif
