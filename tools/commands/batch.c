// batch.c: the command `batch`: draws many models and writes a journal.
#include "command.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <lambent/path.h>

#include "batch.h"
#include "batch_shard.h"
#include "console.h"
#include "job.h"
#include "json.h"
#include "output.h"
#include "report.h"
#include "terminal.h"

// With --jobs and --list, each job names its model and its picture, so there is no list to resume.
static bool check_jobs(int operands, const struct options *o, lam_error *error)
{
    static const char *const others[] = {"output", "files-from", "resume",     "retry-failed", "report",
                                         "json",   "dry-run",    "save-scene", "shard",        NULL};
    const char *own = o->batch.is_list ? "list" : "jobs";
    if (o->batch.is_list && option_given(o, "jobs"))
        return complain(error, LAM_BAD_ARGUMENT, "options '--jobs' and '--list' cannot be used together");
    if (operands)
        return complain(error, LAM_BAD_ARGUMENT,
                        "option '--%s': each %s names its model, so the command line must not name one", own,
                        o->batch.is_list ? "row" : "job");
    for (int i = 0; others[i]; i++)
        if (option_given(o, others[i]))
            return complain(error, LAM_BAD_ARGUMENT, "options '--%s' and '--%s' cannot be used together", own,
                            others[i]);
    if (o->batch.skip_same && !o->batch.journal)
        return complain(error, LAM_BAD_ARGUMENT, "option '--skip-same' needs a journal; with --%s, give --journal FILE",
                        own);
    return job_check_options(o, error);
}

static bool check(int operands, const struct options *o, lam_error *error)
{
    if (o->batch.jobs)
        return check_jobs(operands, o, error);
    if (option_given(o, "ahead") || option_given(o, "line-limit"))
        return complain(error, LAM_BAD_ARGUMENT, "option '--%s' requires --jobs",
                        option_given(o, "ahead") ? "ahead" : "line-limit");
    if (!operands && !o->batch.lists.count)
        return complain(error, LAM_BAD_ARGUMENT,
                        "batch: no model given, expected files, folders, @FILE with a list of names, or - for names on "
                        "standard input");
    if (o->picture.output && strcmp(o->picture.output, "-") == 0)
        return complain(
            error, LAM_BAD_ARGUMENT,
            "batch: cannot write several pictures to standard output; expected a folder (-o pictures/) or a pattern");
    if (o->picture.term != TERM_AUTO && o->picture.term != TERM_OFF)
        return complain(error, LAM_BAD_ARGUMENT, "batch: option '--term' shows a single picture, but batch draws many");
    const char *page = o->batch.report_page;
    struct stat about;
    if (page && (page[strlen(page) - 1] == '/' || (lam_path_stat(page, &about) == 0 && S_ISDIR(about.st_mode))))
        return complain(error, LAM_BAD_ARGUMENT,
                        "option '--report': '%.200s' is a folder, expected the name of an HTML file, such as "
                        "%.200s%sindex.html",
                        page, page, page[strlen(page) - 1] == '/' ? "" : "/");
    if (o->picture.save_scene)
        return complain(error, LAM_BAD_ARGUMENT, "option '--save-scene' works only with a single model");
    return job_check_options(o, error);
}

// For each picture, prints the path of the model and the path of the picture (--dry-run).
static bool print_mapping(const struct batch_plan *plan, lam_error *error)
{
    for (size_t i = 0; i < plan->count; i++)
        for (int k = 0; k < plan->view_count; k++) {
            char *output = batch_plan_output(plan, i, k);
            if (!output)
                return complain(error, LAM_MACHINE, "out of memory");
            if (plan->options->report.json) {
                struct json json = {.file = stdout};
                json_put(&json, OBJECT(NULL, TEXT("model", plan->models[i].path), TEXT("output", output)));
                putc('\n', stdout);
            } else {
                printf("%s -> %s\n", plan->models[i].path, output);
            }
            free(output);
        }
    return true;
}

// Returns the path of the journal, allocated with malloc. Sets *none if the batch writes no journal.
static char *path_of_journal(const struct batch_plan *plan, bool *none)
{
    const char *named = plan->options->batch.journal;
    *none = named ? strcmp(named, "none") == 0 : plan->options->batch.jobs != NULL;
    if (named)
        return strdup(named);
    char *folder = batch_plan_folder(plan), *path = NULL;
    if (!folder || asprintf(&path, "%slambent.jsonl", folder) < 0)
        path = NULL;
    free(folder);
    return path;
}

static bool fill(struct batch_plan *plan, int count, char **operands, lam_error *error)
{
    const struct options *o = plan->options;
    for (int i = 0; i < count; i++)
        if (!batch_add_operand(plan, operands[i], error))
            return false;
    for (int i = 0; i < o->batch.lists.count; i++)
        if (!batch_add_list(plan, o->batch.lists.items[i], error))
            return false;
    return batch_plan_check(plan, error);
}

// A name of -o without an extension and without placeholders names a folder, even without a slash at its end. Returns
// whether it does, and fails if a file has this name.
static bool name_folder(const char *output, bool *folder, lam_error *error)
{
    struct stat found;
    const char *slash = output ? strrchr(output, '/') : NULL, *last = slash ? slash + 1 : output;
    bool exists = output && lam_path_stat(output, &found) == 0;
    *folder =
        output && *last && !strpbrk(last, ".{") && strcmp(output, "-") != 0 && (!exists || S_ISDIR(found.st_mode));
    return *folder || !exists || !*last || strpbrk(last, ".{") || !S_ISREG(found.st_mode) ||
           complain(error, LAM_BAD_ARGUMENT, "option '--output': '%.200s' is a file, expected a folder or a pattern",
                    output);
}

int run_batch(int operand_count, char **operands, const struct options *given)
{
    lam_error error = {0};
    struct options own = *given, *options = &own;
    char *folder = NULL; // with a page but no -o, the pictures and the journal go to the page's own folder
    bool is_folder = false;
    if (!given->batch.jobs && !name_folder(given->picture.output, &is_folder, &error))
        return report_failure(&error, given);
    if (is_folder)
        own.picture.output = asprintf(&folder, "%s/", given->picture.output) < 0 ? (folder = NULL) : folder;
    const char *page = given->batch.report_page;
    if (page && !given->picture.output && !given->batch.jobs) {
        const char *slash = strrchr(page, '/'), *dot = strrchr(slash ? slash : page, '.');
        int length = dot ? (int)(dot - page) : (int)strlen(page);
        own.picture.output = asprintf(&folder, "%.*s-pictures/", length, page) < 0 ? (folder = NULL) : folder;
    }
    struct batch_plan plan = {0};
    bool none = false;
    bool ok = check(operand_count, options, &error) && batch_plan_start(&plan, options, &error) &&
              fill(&plan, operand_count, operands, &error);
    if (ok && options->report.dry_run)
        ok = print_mapping(&plan, &error);
    char *journal = ok && !options->report.dry_run ? path_of_journal(&plan, &none) : NULL;
    if (ok && !options->report.dry_run && !journal)
        ok = complain(&error, LAM_MACHINE, "out of memory");
    int code = 0;
    if (!ok)
        code = report_failure(&error, options);
    else if (!options->report.dry_run)
        code = batch_run(&plan, none ? NULL : journal, true);
    free(journal);
    free(folder);
    batch_plan_free(&plan);
    return code;
}
