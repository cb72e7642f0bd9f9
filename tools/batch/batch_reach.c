// batch_reach.c: the sandbox of a batch.
#include "batch_reach.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "batch_job.h"
#include "console.h"
#include "output.h"
#include "page_file.h"
#include "sandbox_start.h"

// Pictures that are given to the sandbox one by one; more of them by their folder.
enum { SINGLE = 64 };

// Whether the pictures' folder as a whole is within reach: they are read again for the journal and the page.
static bool takes_folder(const struct batch *b)
{
    return !b->options->jobs && (b->options_text || b->plan->count * (size_t)b->plan->view_count > SINGLE);
}

// The folder of a path, from malloc: "." where it names none.
static char *folder_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? strndup(path, (size_t)(slash - path) + 1) : strdup(".");
}

static bool make_folder(char *folder, lam_error *error)
{
    char *file = NULL;
    bool ok = folder && asprintf(&file, "%s%s", folder, *folder ? "." : "./.") >= 0;
    ok = ok ? output_make_folder(file, error) : complain(error, LAM_LIMIT, "out of memory");
    free(file);
    free(folder);
    return ok;
}

bool batch_reach_make(const struct batch *b, const char *journal, lam_error *error)
{
    const char *page = b->options->report_page;
    return (!takes_folder(b) || make_folder(batch_plan_folder(b->plan), error)) &&
           (!journal || make_folder(folder_of(journal), error)) && (!page || make_folder(folder_of(page), error));
}

static void add_folder(struct sandbox_paths *paths, char *folder)
{
    if (folder)
        sandbox_add(paths, *folder ? folder : ".", SANDBOX_READ | SANDBOX_WRITE);
    paths->failed |= !folder;
    free(folder);
}

// A model whose folder is that of the model before adds nothing, unless it is a link, which may lead elsewhere. A shape
// has no folder.
static bool is_within_reach(const char *model, const char *before)
{
    before = before && lam_shape_find(before) < 0 ? before : NULL;
    const char *slash = strrchr(model, '/'), *other = before ? strrchr(before, '/') : NULL, *dot = strrchr(model, '.');
    struct stat about;
    size_t length = slash ? (size_t)(slash - model) : 0;
    bool same = before && !slash == !other &&
                (!slash || ((size_t)(other - before) == length && memcmp(model, before, length) == 0));
    bool scene = dot && strcmp(dot, ".json") == 0;
    return same && !scene && lstat(model, &about) == 0 && !S_ISLNK(about.st_mode);
}

// The page that is filled with a model. Where there is none, writing one says so.
static void add_page(struct sandbox_paths *paths)
{
    lam_error error;
    char *page = page_file_find(&error);
    if (page)
        sandbox_add(paths, page, SANDBOX_READ);
    free(page);
}

bool batch_reach_enter(const struct batch *b, const char *journal, size_t first, size_t count, lam_error *error)
{
    struct sandbox_paths paths = {0};
    const struct batch_model *models = b->plan->models;
    for (size_t i = first; i < first + count; i++) {
        const char *before = i > first && !models[i - 1].leads_out ? models[i - 1].path : NULL;
        if (!models[i].leads_out && !is_within_reach(models[i].path, before))
            sandbox_add_input(&paths, models[i].path);
        for (int k = 0; !takes_folder(b) && k < b->plan->view_count; k++) {
            char *output = batch_plan_output(b->plan, i, k);
            paths.failed |= !output;
            if (output)
                sandbox_add_output(&paths, output);
            free(output);
        }
    }
    if (takes_folder(b))
        add_folder(&paths, batch_plan_folder(b->plan));
    if (journal)
        add_folder(&paths, folder_of(journal));
    if (b->options->report_page)
        add_folder(&paths, folder_of(b->options->report_page));
    if (b->options->jobs || page_is_named(b->options->output)) // a job may ask for one
        add_page(&paths);
    return sandbox_start(b->options, &paths, error);
}

bool batch_reach_enter_job(const struct batch_job *job, lam_error *error)
{
    struct sandbox_paths paths = {0};
    struct options options = job->options;
    options.allow_paths.count = 0;
    if (!job->in_answer && !make_folder(batch_plan_folder(&job->plan), error))
        return false;
    if (!job->in_answer)
        add_folder(&paths, batch_plan_folder(&job->plan));
    if (!job->bytes.data)
        sandbox_add_input(&paths, job->plan.models[0].path);
    if (!job->in_answer)
        add_page(&paths);
    return sandbox_start(&options, &paths, error);
}
