// commands.h: the commands of lambent-classroom.
#ifndef COMMANDS_H
#define COMMANDS_H

#include "command_table.h"

command_fn run_check;     // check/check.c
command_fn run_plot;      // plot/plot.c
command_fn run_exercises; // exercises.c
// The parts of other commands of lambent that need the library of checks. lambent starts this program for them.
command_fn run_contracts; // contracts.c: `generate contract-schema` and `generate contract-NAME`
command_fn run_mistakes;  // contracts.c: `shader --mistake list`
command_fn run_figure;    // explain_figure.c: `explain -o`, for which this program is a filter

#endif
