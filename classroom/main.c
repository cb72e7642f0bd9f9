// main.c: runs the commands for teaching. lambent starts this program with its own command line.
#include <stdio.h>
#include <string.h>

#include "check.h"
#include "commands.h"
#include "failure.h"
#include "console.h"
#include "run.h"

static command_fn *const functions[COMMAND_COUNT] = {
    [COMMAND_check] = run_check,        [COMMAND_plot] = run_plot,       [COMMAND_exercises] = run_exercises,
    [COMMAND_generate] = run_contracts, [COMMAND_shader] = run_mistakes,
#ifndef CLASSROOM_INSIDE
    [COMMAND_explain] = run_figure,
#endif
};

static int run(const struct command *command, int operands, char **words, struct options *options)
{
    lam_error error = {0};
    command_fn *function = functions[command - command_table];
    if (function)
        return function(operands, words, options);
    complain(&error, LAM_BAD_ARGUMENT,
             "lambent-classroom contains only the commands check and plot; for other commands, write lambent");
    return report_failure(&error, options);
}

int classroom_main(int count, char **words)
{
    if (count == 3 && strcmp(words[1], CHECK_WORKER) == 0)
        check_worker(words[2]);
    if (count > 1 && strcmp(words[1], "--help") != 0 && strcmp(words[1], "-h") != 0)
        return run_program(count, words, run);
    puts("lambent-classroom contains the commands of lambent for teaching, which lambent starts:\n"
         "       lambent check SHADER.frag...\n"
         "       lambent plot KIND [CURVE...]\n\n"
         "`lambent check --help` and `lambent plot --help` describe them.");
    return 0;
}

#ifndef CLASSROOM_INSIDE
int main(int count, char **words) { return classroom_main(count, words); }
#endif
