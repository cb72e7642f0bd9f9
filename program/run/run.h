// run.h: parses the command line of a program, and runs its command.
#ifndef RUN_H
#define RUN_H

#include <lambent/image.h>

#include "command_table.h"

// Runs a command whose options and operands are parsed. Returns the program's exit code.
typedef int run_command_fn(const struct command *command, int operand_count, char **operands, struct options *options);

// The body of main(): parses the command line, prints help or the version if the options ask for it, otherwise calls
// `run`, and reports errors.
int run_program(int count, char **words, run_command_fn *run);

// The functions of lambent-classroom that lambent calls in static builds, which contain both programs: the body of
// main(), and the figure of `explain` (classroom/commands/explain_figure.c), whose answer the caller frees.
int classroom_main(int count, char **words);
bool classroom_figure(const struct options *options, const lam_bytes *request, lam_bytes *answer, lam_error *error);

#endif
