// batch_item.h: draws one model: all of its pictures, with their messages and records.
#ifndef BATCH_ITEM_H
#define BATCH_ITEM_H

#include <jansson.h>
#include <stdio.h>

#include "batch_use.h"

// A model to draw.
struct batch_item {
    const struct options *options;
    const char *options_text; // the options as text for the keys; NULL if records have no keys
    bool has_records;         // whether records are needed
    const char *model;
    const lam_bytes *model_bytes; // the bytes of the model that `model` names; NULL if the model is a file
    const struct job_view *views; // the views of the pictures
    char *const *outputs;         // the paths of the pictures
    lam_bytes *contents;          // receives the pictures; NULL if the pictures are written to the paths
    const int *attempts;          // the attempt number of each picture, starting at 1
    int view_count;
    bool one_of_many;            // several models are drawn with the same options
    bool several;                // the command line has several views or sizes
    bool makes_folders;          // creates the pictures' folders even if the user gave the pictures' paths
    const lam_cancel *cancel;    // stops the drawing; if NULL, only Ctrl-C does
    const struct batch_use *use; // its functions receive the picture; NULL if the picture is written to a file
    size_t index;                // the index of the model in the plan, for `use`
};

// The resources for drawing a model.
struct batch_artist {
    lam_device *device;
    struct environment_cache *environments; // NULL if each model reads its own environment
    FILE *out;                              // receives reports
    bool has_bar;                           // a progress bar on the terminal
    bool is_talkative;                      // prints warnings, and a line for each picture; errors are always printed
};

struct batch_outcome {
    enum { BATCH_INTERRUPTED, BATCH_WRITTEN, BATCH_FAILED } kind;
    const char *class; // the name of the picture's exit code
    bool by_machine;   // batch_is_by_machine
};

struct batch_result {
    struct batch_outcome *outcomes; // the outcome of each picture
    json_t **records;               // the record of each picture; NULL if not needed or interrupted
    int record_count;
    int warnings;
    int code; // the highest exit code
    bool interrupted;
};

// Draws the model. Reports errors as messages and in the records. The caller frees the result.
void batch_draw(const struct batch_item *item, const struct batch_artist *artist, struct batch_result *result);
void batch_result_free(struct batch_result *result);

// Returns whether the machine caused an error, not the model: no space, memory, descriptors or processes. A later run
// draws the picture again.
bool batch_is_by_machine(const lam_error *error);

// Makes the record of a failed picture. Call this if the drawing process ended without a report.
json_t *batch_record_failed(const struct batch_item *item, int view, const char *name, int exit, bool by_machine,
                            const char *text);

#endif
