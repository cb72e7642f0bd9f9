// classroom_inside.c: calls the functions of lambent-classroom in a static program, which contains both programs.
#include "classroom.h"

#include "run.h"

int classroom_run(int operand_count, char **operands, const struct options *options)
{
    (void)operand_count, (void)operands;
    int count = 0;
    while (options->line[count])
        count++;
    return classroom_main(count, options->line);
}

bool classroom_start(struct child *child, const struct options *options, lam_error *error)
{
    (void)child, (void)options, (void)error;
    return true;
}

bool classroom_ask(struct child *child, const struct options *options, const lam_bytes *request, lam_bytes *answer,
                   lam_error *error)
{
    (void)child;
    return classroom_figure(options, request, answer, error);
}

void classroom_end(struct child *child) { (void)child; }
