// check.h: declares the functions and types of the command `check`.
#ifndef TOOLS_CHECK_H
#define TOOLS_CHECK_H

#include <stdio.h>

#include <lambent/check.h>

#include "foreign.h"
#include "options.h"

// --- the drawing process (check_process.c)

// The first argument of a drawing process. The table of commands does not contain this argument. The second argument is
// the memory limit in bytes.
#define CHECK_WORKER "check-worker"

// Runs the drawing process, which reads a request from standard input and writes the result to standard output.
void check_worker(const char *memory_limit_bytes) __attribute__((noreturn));

// The limits for check_process, which receives this struct as lam_check_params.user.
struct check_process {
    double time_limit_s; // limits the processor time of all threads
    uint64_t memory_limit_bytes;
};
lam_check_draw_status check_process(void *user, const lam_bytes *request, lam_bytes *result, lam_error *error);

// --- submissions (check_pairs.c, check_find.c)

// The files of one check. All texts but `problem` are allocated with malloc.
struct check_submission {
    struct foreign
        name; // the path of the fragment shader; in a class, relative to the folder and without the extension
    char *fragment, *vertex;
    const char *problem; // the reason why the submission cannot be checked, or NULL
};
void check_free_submissions(struct check_submission *submissions, int count);

// Returns the length of a path without its extension. For "a/phong.frag" and "a/phong.frag.glsl", this is the length of
// "a/phong".
size_t check_stem_length(const char *path);
bool check_same_stem(const char *a, const char *b);
// These functions look at the extension of a file. Vertex shaders end in .vert, .vs, .vsh or .vertex, and fragment
// shaders in .frag, .fs, .fsh or .fragment. Each of these extensions may be followed by .glsl.
bool check_is_vertex(const char *path);
bool check_is_fragment(const char *path);

// Pairs the shader files given on the command line. A vertex shader belongs to the fragment shader that has the same
// name and is in the same folder. Fragment shaders without a matching vertex shader use `vertex`. Returns the number of
// submissions, or −1 on failure.
int check_pair(int count, char **files, const char *vertex, struct check_submission **submissions, lam_error *error);

// Finds the submissions of a class in alphabetical order. Returns their number, or −1 on failure.
int check_find(const char *folder, struct check_submission **submissions, lam_error *error);

// Returns the path of a sheet, allocated with malloc. The path is `output` or, if `output` is a folder (always for a
// class), a file in it. This file is named after the submission, with '-' instead of '/'. Returns NULL if memory runs
// out.
char *check_sheet_path(const char *output, const struct check_submission *submissions, int index, bool in_class);

// Reads a text file, or standard input for "-", into memory allocated with malloc. Returns NULL on failure.
char *check_read_text(const char *path, lam_error *error);

// --- results (check_points.c)

struct check_result {
    const struct check_submission *submission;
    lam_check_report report; // contains a verdict if error.code is 0
    lam_error error;         // the reason why there is no verdict
    lam_error sheet_error;   // the reason why there is no sheet
    char *sheet;             // the sheet's path; NULL if none was requested or drawn
    int code;                // the exit code that results from this shader
};

// Returns a scene's result in one or two words: "same", "differs", or "black" if the picture equals a black reference
// and earns no points.
const char *check_scene_word(const lam_check_scene *scene);

// Returns a scene's points: the scene's weight if the scene passes, otherwise 0. Returns −1 if the scene does not
// count, because the exercise requires none of the scene's terms.
double check_scene_points(const lam_check_scene *scene);

struct check_points {
    double earned, possible; // sums of the weights of scenes
    // The fraction of passed scenes among the scenes with only one term: ambient, diffuse, specular. −1 if there are
    // none.
    double terms[3];
};
// Returns text such as "passes: its pictures match the reference".
const char *check_verdict_text(lam_check_verdict verdict);
struct check_points check_points_of(const lam_check_report *report);

// --- output

// Prints the sentence for a report without mistakes. Prints no line end.
void check_print_no_finding(FILE *file, const lam_check_report *report);
void check_report_text(FILE *file, const lam_check_report *report, const char *shader, double tolerance);
void check_report_line(FILE *file, const struct check_result *result); // prints a line of text for a class
// In a class, `name` is the name of the submission; otherwise it is NULL.
void check_report_json(FILE *file, const struct check_result *result, const char *name, double tolerance);
// Prints the lists of contracts, scenes and mistakes.
bool check_print_lists(FILE *file, lam_error *error);

// Returns a sentence about the first mistake, otherwise the first message, otherwise the meaning of the verdict.
// Returns "" if the shader passes.
const char *check_says(const lam_check_report *report);

// Write the rows of a CSV file and of Moodle's worksheet. The functions return 0 or, if the file cannot be written, the
// errno.
int check_csv_head(FILE *file);
int check_csv_row(FILE *file, const struct check_result *result);
int check_moodle_head(FILE *file);
int check_moodle_row(FILE *file, const struct check_result *result);

// Writes the result of one submission as a JSON file. Returns 0 or, if the file cannot be written, the errno.
int check_gradescope(FILE *file, const struct check_result *result);
int check_submitty(FILE *file, const struct check_result *result);

// A file to which each result is appended.
struct check_table {
    const char *path; // NULL if not requested
    FILE *file;
    int error; // the errno if the file could not be written, otherwise 0
    int (*head)(FILE *file);
    int (*row)(FILE *file, const struct check_result *result);
};
enum { CHECK_TABLES = 4 };

// The page of a class. Rows are added as results arrive, and the page is written at the end.
struct check_page;
struct check_page *check_page_make(lam_error *error);
void check_page_add(struct check_page *page, const struct check_result *result);
char *check_page_path(const char *folder, lam_error *error); // allocated with malloc; NULL on failure
bool check_page_write(struct check_page *page, const char *folder, const char *title, lam_error *error);
void check_page_free(struct check_page *page); // accepts NULL

// Writes a labelled page with three pictures for each scene: the shader's picture, the reference and the difference.
bool check_sheet(const lam_check_report *report, const char *shader, const struct options *options, const char *path,
                 lam_error *error);

// Many checks at a time (check_batch.c)

struct check_batch {
    const struct options *options;
    const char *const *scenes; // NULL means all scenes
    int scene_count;
    double tolerance;
    const lam_check_contract *contract; // if NULL, the check detects the contract
    lam_check_cache *cache;             // NULL means no cache
    const struct check_submission *submissions;
    int count;
    bool in_class;
    struct check_table tables[CHECK_TABLES];
    bool without_sheets;     // set if the folder for sheets cannot be created
    struct check_page *page; // NULL if there is no page
    const char **roles;      // of --role; ends with NULL. NULL: none
};

// Checks all submissions, several at a time, and prints the results in order. Reports the errors of a submission and
// continues with the next. Returns the highest exit code and stores the first submission's error in `first`.
int check_batch_run(struct check_batch *batch, lam_error *first);

#endif
