// diff.h: the two kinds of comparison in `lambent diff`, and the state of a comparison of models.
#ifndef DIFF_H
#define DIFF_H

#include "batch_shard.h"
#include "batch_work.h"

// diff_pictures.c: compares two pictures. Returns the exit code.
int diff_pictures(char **operands, const struct options *options);

// diff_models.c: compares two models, or the models in two folders. Returns the exit code.
int diff_models(char **operands, bool folders, const struct options *options);

// Two versions of a model.
struct model_pair {
    const char *name;      // relative to the folder; for two models, the new model's name
    const char *old, *new; // paths; NULL if the model does not exist on this side
};

// How a model has changed.
enum change { CHANGE_CHANGED, CHANGE_FAILED, CHANGE_ADDED, CHANGE_REMOVED, CHANGE_EQUAL, CHANGE_COUNT };
extern const char *const change_names[CHANGE_COUNT];

enum { PAGE_ROWS = 300 };

struct model_diff {
    const struct options *options;
    const char *old, *new;        // as typed
    const char *page;             // the path of the page, or NULL; "-" is standard output
    struct batch_plan olds, news; // the models of both sides; these plans own the paths
    struct batch_plan plan;       // one model for each pair
    struct model_pair *pairs;     // for each model of the plan
    bool folders;                 // compares two folders, not two models
    atomic_int *rows;             // the number of models whose pictures are kept for the page
    size_t counts[CHANGE_COUNT];  // valid after all models are drawn
};

// diff_draw.c: draws a pair with one camera and determines how the model has changed (batch_receiver.draw).
bool diff_draw(void *user, size_t model, struct job *job, struct progress *progress, json_t *found, lam_error *error);

// Returns the kind of change in a model's record.
enum change diff_change_of(const json_t *record);

// diff_page.c: builds the page as one file, allocated with malloc. Returns NULL if memory runs out.
char *diff_page(const struct model_diff *diff, json_t *const *records);

#endif
