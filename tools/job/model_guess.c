// model_guess.c: suggests a correction if a model cannot be read, such as another command or a file with a similar
// name.
#include "job.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include <lambent/path.h>

#include "command_table.h"
#include "file_io.h"
#include "output.h"
#include "sandbox_start.h"
#include "console.h"

enum { FILE_NAME_SIZE = 256, ADVICE_SIZE = 600 };

// In the folder of a missing file, finds the model whose name is most similar to the missing name. Returns false if no
// name is similar.
static bool nearest_file(const char *model, char nearest[FILE_NAME_SIZE])
{
    const char *slash = strrchr(model, '/'), *name = slash ? slash + 1 : model;
    char folder[1024];
    snprintf(folder, sizeof folder, "%.*s", slash ? (int)(slash + 1 - model) : 1, slash ? model : ".");
    struct suggestion suggestion = suggest_start(name);
    DIR *entries = lam_path_list(folder);
    for (struct dirent *entry; entries && (entry = readdir(entries));) {
        const char *best = suggestion.best;
        if (is_model_name(entry->d_name))
            suggest_try(&suggestion, entry->d_name);
        if (suggestion.best != best)
            suggestion.best = strcpy(nearest, entry->d_name); // the next readdir overwrites the entry
    }
    if (entries)
        closedir(entries);
    return suggestion.best != NULL;
}

// Suggests a command, an option or a shape for a word without a dot or slash.
static void guess_word(const char *model, char *advice)
{
    const struct option *option = option_find(model);
    if (model[strspn(model, "0123456789")] == 0)
        snprintf(advice, ADVICE_SIZE, "; write the size of the picture as one word: -s 640x480");
    else if (find_command(model))
        snprintf(advice, ADVICE_SIZE, "; a command comes first: lambent %s", model);
    else if (option && option_is_taken(option, command_table->groups))
        snprintf(advice, ADVICE_SIZE, "; an option begins with dashes: --%s", model);
    else {
        struct suggestion nearest = suggest_start(model);
        for (int i = 0; i < lam_shape_count(); i++)
            suggest_try(&nearest, lam_shape_name(i));
        for (const struct command *c = command_table; c->name; c++) {
            suggest_try(&nearest, c->name);
            suggest_also(&nearest, c->name, c->also);
        }
        if (nearest.best)
            snprintf(advice, ADVICE_SIZE, "; did you mean '%s'?", nearest.best);
        else
            snprintf(advice, ADVICE_SIZE,
                     "; no built-in shape has this name either: `lambent shapes` lists the "
                     "shapes");
    }
}

void model_guess(const char *model, const struct options *options, lam_error *error)
{
    char advice[ADVICE_SIZE] = "", nearest[FILE_NAME_SIZE];
    lam_pixel_format format;
    size_t used = strlen(error->text);
    if (!options->picture.output && lam_image_format_for(model, &format, NULL))
        snprintf(advice, sizeof advice, "; write the name of the picture after -o");
    else if (error->code == LAM_CANNOT_READ && path_is_folder(model))
        snprintf(advice, sizeof advice, "; lambent batch %.200s draws all models in it, lambent view %.200s shows them",
                 model, model);
    else if (error->code != LAM_CANNOT_READ || strcmp(model, "-") == 0 || access(model, F_OK) == 0)
        ;
    else if (strpbrk(model, "*?"))
        snprintf(advice, sizeof advice, "; no file matches this pattern");
    else if (strchr(model, '\\'))
        snprintf(advice, sizeof advice, "; separate folders by /");
    else if (!strpbrk(model, "./"))
        guess_word(model, advice);
    else if (nearest_file(model, nearest))
        snprintf(advice, sizeof advice, "; did you mean '%s'?", nearest);
    snprintf(error->text + used, sizeof error->text - used, "%s%s", advice, *advice ? "" : sandbox_advice(error));
}
