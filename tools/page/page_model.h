// page_model.h: a model's data in a page: its files by their paths in the page, and the words of its command line.
#ifndef PAGE_MODEL_H
#define PAGE_MODEL_H

#include <stdio.h>

#include "job.h"

struct page_file {
    char *path;   // on this machine
    char *inside; // in the page: "/bunny.obj", "/textures/fur.png"
};

struct page_model {
    struct page_file *files; // the existing ones; from malloc
    int count;
    char *environment; // the value of --environment with paths in the page; NULL: it names no file
};

// Lists the files of a loaded model, and of --environment. Fails with LAM_UNSUPPORTED (one that lies outside of the
// model's folder), LAM_LIMIT.
bool page_model_list(const struct job *job, struct page_model *model, lam_error *error);

// Adds the files of --environment alone.
bool page_model_add_environment(const struct options *options, struct page_model *model, lam_error *error);
void page_model_free(struct page_model *model);

// Why the page cannot read some of them, as a sentence for each kind, from 0; NULL: nothing more.
const char *page_model_lacks(const struct page_model *model, const lam_file_info *info, int index);

// Returns whether an option belongs to the picture, and has a control in the page. A look is in the options that it
// sets.
bool page_model_has_option(const struct option *option);

// Prints the words of the picture's command line as a list in JSON, in which no '<' is left: the model, and an option
// with its value in one word. `given`: the options of the command line. Options of the machine (threads, device,
// limits) and of files to write are left out. Fails with LAM_LIMIT.
bool page_model_words(FILE *out, const struct job *job, const struct options *given, const struct page_model *model,
                      lam_error *error);

#endif
