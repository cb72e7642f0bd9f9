// check.h: the parts of the command `check`.
#ifndef TOOLS_CHECK_H
#define TOOLS_CHECK_H

#include <stdio.h>

#include <lambent/lambent.h>

#include "options.h"

// The word that starts the program as the process that draws; no command of the table.
#define CHECK_WORKER "check-worker"

// Runs as that process: a job from standard input, its pictures to standard output. Returns the exit code.
int check_worker(void);

// What lam_check_params.user is for check_process.
struct check_process {
    double time_limit_s;
};
lam_check_end check_process(void *user, const lam_bytes *job, lam_bytes *drawn, lam_error *error);

void check_tell_text(FILE *file, const lam_check_report *report, const char *shader, double tolerance);
void check_tell_json(FILE *file, const lam_check_report *report, const char *shader, const char *vertex,
                     double tolerance, const char *picture);
void check_tell_lists(FILE *file); // contracts, scenes, mistakes

// Theirs, the reference and the difference of each scene, on one labelled page.
bool check_sheet(const lam_check_report *report, const char *shader, const struct options *options,
                 lam_error *error);

#endif
