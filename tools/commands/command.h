// command.h: the functions of the commands. A command is one word of COMMANDS, one row of command_table.c and one file.
#ifndef COMMAND_H
#define COMMAND_H

#include "command_table.h"

// Runs a command. Reports its own errors; returns the program's exit code.
typedef int command_fn(int operand_count, char **operands, const struct options *options);

#define COMMAND_FUNCTION(name) command_fn run_##name;
COMMANDS(COMMAND_FUNCTION)

#endif
