// page_model.h: collects a model's data for a page: the files with their paths in the page, and the command line.
#ifndef PAGE_MODEL_H
#define PAGE_MODEL_H

#include <stdio.h>

#include "job.h"

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
