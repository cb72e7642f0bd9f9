// complete_names.c: completes the names of objects, parts, materials and animations of the model on the command line.
#include "complete.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <lambent/material.h>

#include "info.h"
#include "job.h"
#include "limit_options.h"
#include "output.h"
#include "sandbox_start.h"

// A shell waits for the completions, so a large model gives none.
enum { SECONDS_MAX = 3 };

// Offers a name that needs no quotes in a shell. A shell would run a command in other names.
static void offer(const struct typed_word *typed, const char *name)
{
    bool plain = name && *name && *name != '-';
    for (const char *c = name; plain && *c; c++)
        plain = isalnum((unsigned char)*c) || strchr("._-+", *c) || (unsigned char)*c >= 0x80;
    if (plain)
        complete_offer(typed, name, "", "a name in the model");
}

bool complete_from_model(const struct option *option, const struct typed_word *typed, int count, char **words)
{
    bool animation = strcmp(option->name, "animation") == 0, hide = strcmp(option->name, "hide") == 0;
    const char *at = option->kind == VALUE_MATERIAL ? strchr(typed->prefix, '@') : NULL, *model = NULL;
    for (int i = 0; i < count && !model; i++)
        model = is_model_name(words[i]) && access(words[i], R_OK) == 0 ? words[i] : NULL;
    if ((!animation && !hide && !at) || !model)
        return false;
    int kept = at ? (int)(at + 1 - typed->prefix) : 0;
    struct typed_word name = {typed->before, typed->prefix + kept, typed->before_length + kept};
    struct options options = option_defaults();
    struct sandbox_paths paths = {0};
    struct progress progress;
    lam_error error;
    options.limits.time_limit_s = SECONDS_MAX;
    struct job job = {.options = &options, .model = model, .times.start = clock_ms()};
    progress_start(&progress, model, false);
    sandbox_add_input(&paths, model);
    if (sandbox_start(&options, &paths, &error) && job_load(&job, &progress, &error)) {
        const lam_file_info *file = lam_scene_file_info(job.scene);
        for (int i = 0; animation && i < file->animation_count; i++)
            offer(&name, file->animations[i].name);
        struct info_names names = {0};
        bool listed = !animation && info_names_list(job.scene, &names, &error);
        for (int i = 0; i < names.count; i++)
            offer(&name, names.items[i].name);
        for (int i = 0; listed && i < lam_scene_material_count(job.scene); i++)
            offer(&name, lam_scene_material(job.scene, i)->name);
        free(names.items);
    }
    job_free(&job);
    options_free(&options);
    return true;
}
