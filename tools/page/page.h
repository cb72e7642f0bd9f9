// page.h: `lambent MODEL -o page.html`: writes the one-file page with the model and the command line.
#ifndef PAGE_H
#define PAGE_H

#include "job.h"

#include <lambent/base.h>

#include <stdio.h>

// The maximum size in bytes of a model and of all files that the model uses.
enum { PAGE_FILES_MAX = 100000000 };

// Returns whether the job's output is a page.
bool page_wanted(const struct job *job);

// Replaces job_run for a page. Draws the picture, to detect errors in the model or the options, and writes the page.
// Fails like job_run. Also fails with LAM_UNSUPPORTED if no page is installed or a file is outside the model's folder,
// and with LAM_LIMIT for more than PAGE_FILES_MAX bytes.
bool page_run(struct job *job, struct progress *progress, lam_error *error);

// Reports that a page shows only one picture (LAM_BAD_ARGUMENT), and returns false.
bool page_refuse_several(lam_error *error);

// --- finds the one-file page made by `make web` (docs/web.md).

// Returns whether the extension of an output is ".html".
bool page_is_named(const char *output);

// Returns the path of the page, allocated with malloc. Tries, in this order: the file that LAMBENT_PAGE names, the
// installed file ../share/lambent/lambent.html relative to the program's folder, and ../build-web/lambent.html relative
// to a build folder. Fails with LAM_UNSUPPORTED if there is no page, or with LAM_LIMIT if memory runs out.
char *page_file_find(lam_error *error);

// Reads `*size` bytes, the whole file, into memory allocated with malloc, and appends a zero. Fails with
// LAM_CANNOT_READ, or with LAM_LIMIT if the file has more than `most` bytes (then *size is the file's size, otherwise
// 0) or if memory runs out.
char *page_file_read(const char *path, size_t most, size_t *size, lam_error *error);

// --- collects a model's data for a page: the files with their paths in the page, and the command line.

struct page_file {
    char *path;   // on this machine
    char *inside; // the path in the page, such as "/bunny.obj" or "/textures/fur.png"
};

struct page_model {
    struct page_file *files; // the existing files, allocated with malloc
    int count;
    char *environment; // the value of --environment with paths in the page; NULL if it names no file
};

// Lists the files of a loaded model and of --environment. Fails with LAM_UNSUPPORTED if a file is outside the model's
// folder, or LAM_LIMIT.
bool page_model_list(const struct job *job, struct page_model *model, lam_error *error);

// Adds only the files of --environment.
bool page_model_add_environment(const struct options *options, struct page_model *model, lam_error *error);
void page_model_free(struct page_model *model);

// Returns a sentence that explains why the page cannot read some of the files. There may be several reasons, with the
// indices 0, 1 and so on. Returns NULL if there is no reason with this index.
const char *page_model_lacks(const struct page_model *model, const lam_file_info *info, int index);

// Prints the picture's command line as a JSON array: the model, and one string for each option with its value. The text
// contains no '<'. `given` contains the options of the command line. The result omits the options for the machine
// (threads, device, limits) and for output files. Fails with LAM_LIMIT.
bool page_model_words(FILE *out, const struct job *job, const struct options *given, const struct page_model *model,
                      lam_error *error);

#endif
