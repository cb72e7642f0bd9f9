// command.h: the functions of the commands. Each command has an entry in COMMANDS, a row in command_table.c and a
// source file.
#ifndef COMMAND_H
#define COMMAND_H

#include "command_table.h"

// Runs a command and reports its errors. Returns the program's exit code.
typedef int command_fn(int operand_count, char **operands, const struct options *options);

#define COMMAND_FUNCTION(name) command_fn run_##name;
COMMANDS(COMMAND_FUNCTION)

#endif
