// check.h: the parts of the command `check`.
#ifndef TOOLS_CHECK_H
#define TOOLS_CHECK_H

#include <stdio.h>

#include <lambent/check.h>

#include "options.h"

// --- the drawing process (check_process.c)

// The first argument that starts the program as a drawing process; not a command of the table. The second is the
// limit of its memory in bytes.
#define CHECK_WORKER "check-worker"

// Runs the drawing process: a request from standard input, its result to standard output.
void check_worker(const char *memory_limit_bytes) __attribute__((noreturn));

// lam_check_params.user for check_process.
struct check_process {
    double time_limit_s; // of the processor, over all threads
    uint64_t memory_limit_bytes;
};
lam_check_draw_status check_process(void *user, const lam_bytes *request, lam_bytes *result, lam_error *error);

// --- submissions (check_pairs.c, check_find.c)

// The files of one check. All but `problem` are from malloc.
struct check_submission {
    char *name; // the path of the fragment shader; in a class, below its folder and without an ending
    char *fragment, *vertex;
    const char *problem; // why there is nothing to check; NULL: there is
};
void check_free_submissions(struct check_submission *submissions, int count);

// Returns the length of a path without its extension: "a/phong" of "a/phong.frag" and "a/phong.frag.glsl".
size_t check_stem_length(const char *path);
bool check_same_stem(const char *a, const char *b);
bool check_is_vertex(const char *path);   // by its ending: .vert, .vs, .vsh or .vertex, each also followed by .glsl
bool check_is_fragment(const char *path); // likewise: .frag, .fs, .fsh or .fragment

// Pairs the files of a command line: a vertex shader belongs to the fragment shader of the same folder and name;
// fragment shaders without one get `vertex`. Returns the count of submissions; −1: see `error`.
int check_pair(int count, char **files, const char *vertex, struct check_submission **submissions, lam_error *error);

// Finds the submissions of a class, in alphabetical order. Returns their count; −1: see `error`.
int check_find(const char *folder, struct check_submission **submissions, lam_error *error);

// Returns the path of a sheet, from malloc: `output`, or if that is a folder, as it is for a class, the submission's
// name in it with '-' for '/'. Returns NULL if memory runs out.
char *check_sheet_path(const char *output, const struct check_submission *submissions, int index, bool in_class);

// Reads a text file, or standard input for "-", into memory from malloc. NULL: see `error`.
char *check_read_text(const char *path, lam_error *error);

// --- results (check_points.c)

struct check_result {
    const struct check_submission *submission;
    lam_check_report report; // where error.code is 0
    lam_error error;         // why there is no verdict
    lam_error sheet_error;   // why there is no sheet
    char *sheet;             // its path; NULL: none was asked for, or nothing was drawn
    int code;                // the exit code for this shader alone
};

// Returns a scene's result in one or two words: same, differs, or black (equal to a black reference, which earns no
// points).
const char *check_scene_word(const lam_check_scene *scene);

// Returns a scene's part of the points: its weight or 0, or −1 if it does not count, since the exercise asks for none
// of its terms.
double check_scene_points(const lam_check_scene *scene);

struct check_points {
    double earned, possible; // the weights of scenes
    // The share of the scenes with this term alone that pass; −1: there are none. Ambient, diffuse, specular.
    double terms[3];
};
// "passes: its pictures match the reference".
const char *check_verdict_text(lam_check_verdict verdict);
struct check_points check_points_of(const lam_check_report *report);

// --- output

// Prints a sentence, without a line end, which says that no mistake was found.
void check_print_no_finding(FILE *file, const lam_check_report *report);
void check_report_text(FILE *file, const lam_check_report *report, const char *shader, double tolerance);
void check_report_line(FILE *file, const struct check_result *result); // a class's line of text
// `name`: of a class's submission; NULL: not in a class.
void check_report_json(FILE *file, const struct check_result *result, const char *name, double tolerance);
// Prints contracts, scenes and mistakes.
bool check_print_lists(FILE *file, lam_error *error);

// One sentence: the first mistake, or else the first message, or else the meaning of the verdict; "" if the shader
// passes.
const char *check_says(const lam_check_report *report);

// Writes a value of a CSV line, in quotes if necessary. Names that begin like a formula are escaped, because a
// spreadsheet would evaluate them.
void check_csv_text(FILE *file, const char *text);

// Lines of comma-separated values, and Moodle's. 0, or the errno of the file that could not be written.
int check_csv_head(FILE *file);
int check_csv_row(FILE *file, const struct check_result *result);
int check_moodle_head(FILE *file);
int check_moodle_row(FILE *file, const struct check_result *result);

// Returns the result of one submission as a file of JSON. Likewise.
int check_gradescope(FILE *file, const struct check_result *result);
int check_submitty(FILE *file, const struct check_result *result);

// A file of results, to which each result is appended.
struct check_table {
    const char *path; // NULL: not asked for
    FILE *file;
    int error; // errno of the file that could not be written; 0: none
    int (*head)(FILE *file);
    int (*row)(FILE *file, const struct check_result *result);
};
enum { CHECK_TABLES = 4 };

// The page of a class: rows are added as results arrive, and the page is written at the end.
struct check_page;
struct check_page *check_page_make(lam_error *error);
void check_page_add(struct check_page *page, const struct check_result *result);
char *check_page_path(const char *folder, lam_error *error); // from malloc; NULL: see `error`
bool check_page_write(struct check_page *page, const char *folder, const char *title, lam_error *error);
void check_page_free(struct check_page *page); // NULL is fine

// Writes a labelled page with three pictures of each scene: the shader's, the reference and the difference.
bool check_sheet(const lam_check_report *report, const char *shader, const struct options *options, const char *path,
                 lam_error *error);

// --- checking many (check_batch.c)

struct check_batch {
    const struct options *options;
    const char *const *scenes; // NULL: all
    int scene_count;
    double tolerance;
    const lam_check_contract *contract; // NULL: recognised
    lam_check_cache *cache;             // NULL: none
    const struct check_submission *submissions;
    int count;
    bool in_class;
    struct check_table tables[CHECK_TABLES];
    bool without_sheets;     // their folder cannot be made
    struct check_page *page; // NULL: none
};

// Checks all submissions, several at once, and prints the results in their order. An error in one is reported, and the
// others are still checked. Returns the highest exit code. `first`: the error of the first submission.
int check_batch_run(struct check_batch *batch, lam_error *first);

#endif
