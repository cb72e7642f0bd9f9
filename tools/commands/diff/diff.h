// diff.h: the kinds of `lambent diff`, and the comparison of models that its files share.
#ifndef DIFF_H
#define DIFF_H

#include "batch_plan.h"
#include "batch_use.h"
#include "shared_count.h"

// diff_pictures.c: compares two pictures. Returns the exit code.
int diff_pictures(char **operands, const struct options *options);

// diff_models.c: compares two models, or the models of two folders. Returns the exit code.
int diff_models(char **operands, bool folders, const struct options *options);

// A model of either side.
struct model_pair {
    const char *name;      // below the folder; of two models, the new one's
    const char *old, *new; // paths; NULL: it is not there
};

// How a model has changed.
enum change { CHANGE_CHANGED, CHANGE_FAILED, CHANGE_ADDED, CHANGE_REMOVED, CHANGE_EQUAL, CHANGE_COUNT };
extern const char *const change_names[CHANGE_COUNT];

enum { PAGE_ROWS = 300 };

struct model_diff {
    const struct options *options;
    const char *old, *new;        // as typed
    const char *page;             // the path of the page; NULL: none; "-": standard output
    struct batch_plan olds, news; // the models of both sides; they own the paths
    struct batch_plan plan;       // a model for each pair
    struct model_pair *pairs;     // of each model of the plan
    bool folders;                 // else two models
    atomic_int *rows;             // models whose pictures are kept for the page
    size_t counts[CHANGE_COUNT];  // when all are drawn
};

// diff_draw.c: draws a pair with one camera, and determines how it has changed (batch_use.draw).
bool diff_draw(void *user, size_t model, struct job *job, struct progress *progress, json_t *found, lam_error *error);

// Returns how a model has changed, from its record.
enum change diff_change_of(const json_t *record);

// diff_page.c: builds the page as one file, from malloc. Returns NULL if memory runs out.
char *diff_page(const struct model_diff *diff, json_t *const *records);

#endif
