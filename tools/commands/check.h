// check.h: the parts of the command `check`.
#ifndef TOOLS_CHECK_H
#define TOOLS_CHECK_H

#include <stdio.h>

#include <lambent/check.h>

#include "options.h"

// The first argument that starts the program as a drawing process; not a command of the table.
#define CHECK_WORKER "check-worker"

// Runs the drawing process: a request from standard input, its result to standard output.
void check_worker(void) __attribute__((noreturn));

// The files of a fragment shader and its vertex shader (NULL: none).
struct check_pair {
    const char *fragment, *vertex;
};

// Pairs the files of a command line: a vertex shader (ending .vert, .vs, .vsh or .vertex, each also followed by .glsl)
// belongs to the fragment shader of the same folder and name; fragment shaders without one get `vertex`. Returns the
// count of pairs, at most `count`; -1: see `error`.
int check_pair(int count, char **files, const char *vertex, struct check_pair *pairs, lam_error *error);

// The path of a sheet, from malloc: `output`, or if that is a folder, the shader's path in it with '-' for '/'. NULL:
// out of memory.
char *check_sheet_path(const char *output, const char *fragment);

// lam_check_params.user for check_process.
struct check_process {
    double time_limit_s; // of the processor, over all threads
};
lam_check_draw_status check_process(void *user, const lam_bytes *request, lam_bytes *result, lam_error *error);

void check_report_text(FILE *file, const lam_check_report *report, const char *shader, double tolerance);
void check_report_json(FILE *file, const lam_check_report *report, const char *shader, const char *vertex,
                       double tolerance, const char *picture);
// For one of several shaders that could not be checked.
void check_report_error_json(FILE *file, const char *shader, const char *vertex, const lam_error *error);
bool check_print_lists(FILE *file, lam_error *error); // contracts, scenes, mistakes

// Writes a labelled page with three pictures of each scene: the shader's, the reference and the difference.
bool check_sheet(const lam_check_report *report, const char *shader, const struct options *options, const char *path,
                 lam_error *error);

#endif
