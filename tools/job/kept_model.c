// kept_model.c: keeps a model loaded between pictures.
#include "kept_model.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "console.h"

void kept_model_forget(struct kept_model *model)
{
    free(model->key);
    lam_scene_free(model->scene);
    *model = (struct kept_model){0};
}

// Returns whether a loaded scene can be used again with another value of the option.
static bool changes_drawing_only(const struct option *option)
{
    return !option->loads && (option->setting || option_is_in(option, KEEPS_MODEL));
}

// Returns a key for the model and its load options, allocated with malloc.
static char *key_of(const char *name, const struct options *options)
{
    size_t size = 0;
    char *key = NULL;
    FILE *text = open_memstream(&key, &size);
    if (!text)
        return NULL;
    fputs(name, text);
    for (const struct option *o = option_table; o->name; o++)
        if (options->given[o - option_table] && !changes_drawing_only(o))
            fprintf(text, "\n%s=%s", o->name,
                    options->values[o - option_table] ? options->values[o - option_table] : "");
    fclose(text);
    return key;
}

bool kept_model_take(struct kept_model *model, struct job *job, struct progress *progress, lam_error *error)
{
    char *key = key_of(job->model, job->options);
    if (!key)
        return complain(error, LAM_MACHINE, "out of memory");
    bool same = model->key && strcmp(model->key, key) == 0;
    if (!same) {
        kept_model_forget(model);
        struct job first = {.options = job->options,
                            .model = job->model,
                            .device = job->device,
                            .cancel = job->cancel,
                            .environments = job->environments,
                            .keeps_scene = true};
        first.times.start = clock_ms();
        bool ok = job_load(&first, progress, error) && lam_scene_mark(first.scene, error);
        if (!ok) {
            lam_scene_free(first.scene);
            free(key);
            return false;
        }
        model->key = key;
        model->scene = first.scene;
        model->environment = lam_scene_environment(model->scene) != NULL;
        model->read_ms = clock_ms() - first.times.start;
        key = NULL;
    }
    free(key);
    job->scene = model->scene;
    return lam_scene_reset(model->scene, error) &&
           (model->environment || lam_scene_set_environment(model->scene, NULL, 0, error));
}
