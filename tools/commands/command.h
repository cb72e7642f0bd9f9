// command.h: the functions of the commands. Each command has an entry in COMMANDS, a row in command_table.c and a
// source file.
#ifndef COMMAND_H
#define COMMAND_H

#include "command_table.h"

#define COMMAND_FUNCTION(name, program) command_fn run_##name;
COMMANDS(COMMAND_FUNCTION)

#endif
