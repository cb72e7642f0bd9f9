// without_classroom.c: replaces the functions of classroom/ for programs that are built without it (-Dclassroom=false).
// Each replacement reports that the function is not available.
#include "check.h"
#include "command.h"
#include "console.h"
#include "contract_schema.h"
#include "explain_figure.h"
#include "plot.h"
#include "report.h"

#include <stdlib.h>

static int refuse(const char *command, const struct options *options)
{
    lam_error error = {0};
    complain(&error, LAM_UNSUPPORTED,
             "%s: not in this program, which was built with -Dclassroom=false; build it with -Dclassroom=true",
             command);
    return report_failure(&error, options);
}

int run_check(int count, char **words, const struct options *options)
{
    (void)count, (void)words;
    return refuse("check", options);
}

int run_plot(int count, char **words, const struct options *options)
{
    (void)count, (void)words;
    return refuse("plot", options);
}

void check_worker(const char *memory_limit_bytes)
{
    (void)memory_limit_bytes;
    exit(EXIT_FAILURE);
}

const char *plot_kind(int index)
{
    (void)index;
    return NULL;
}

void generate_contract_schema(void)
{
    say_error("generate: this program contains no contracts, because it was built with -Dclassroom=false");
}

void explain_figure_size(const struct explain_figure *figure, int *width, int *height)
{
    (void)figure;
    *width = *height = 1;
}

bool explain_figure_draw(const struct explain_figure *figure, struct drawing *drawing, lam_error *error)
{
    (void)figure, (void)drawing;
    return complain(error, LAM_UNSUPPORTED,
                    "explain: this program draws no figures, since it was built with -Dclassroom=false; build it with "
                    "-Dclassroom=true");
}
