// check.h: the parts of the command `check`.
#ifndef TOOLS_CHECK_H
#define TOOLS_CHECK_H

#include <stdio.h>

#include <lambent/check.h>

#include "options.h"

// The word that starts the program as the process that draws; no command of the table.
#define CHECK_WORKER "check-worker"

// Runs as that process: a job from standard input, its pictures to standard output.
void check_worker(void) __attribute__((noreturn));

// A fragment shader's file, and its vertex shader's (NULL: none).
struct check_pair {
    const char *fragment, *vertex;
};

// Files as the command line has them: a vertex shader (told by the ending: .vert, .vs, .vsh, .vertex, each
// also before .glsl) goes with the fragment shader of the same folder and name, `vertex` with those that have
// none. Returns how many pairs were made, at most `count`; -1: `error`.
int check_pair(int count, char **files, const char *vertex, struct check_pair *pairs, lam_error *error);

// Where a sheet goes, from malloc: `output`, or in that folder the shader's path with '-' for '/'. NULL:
// memory is out.
char *check_sheet_path(const char *output, const char *fragment);

// What lam_check_params.user is for check_process.
struct check_process {
    double time_limit_s; // of the processor, all threads together
};
lam_check_end check_process(void *user, const lam_bytes *job, lam_bytes *drawn, lam_error *error);

void check_tell_text(FILE *file, const lam_check_report *report, const char *shader, double tolerance);
void check_tell_json(FILE *file, const lam_check_report *report, const char *shader, const char *vertex,
                     double tolerance, const char *picture);
// A shader that could not be checked, among several.
void check_tell_json_error(FILE *file, const char *shader, const char *vertex, const lam_error *error);
void check_tell_lists(FILE *file); // contracts, scenes, mistakes

// Theirs, the reference and the difference of each scene, on one labelled page, written to `path`.
bool check_sheet(const lam_check_report *report, const char *shader, const struct options *options, const char *path,
                 lam_error *error);

#endif
