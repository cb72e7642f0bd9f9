// diff_models.c: `lambent diff` for models and folders: pairs the models and prints the summary.
#include "diff.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "batch.h"
#include "batch_shard.h"
#include "console.h"
#include "foreign.h"
#include "job.h"
#include "json.h"
#include "output.h"
#include "report.h"
#include "sandbox_start.h"

// --- the pairs

// Returns a model's name relative to its folder.
static const char *name_of(const struct batch_model *model)
{
    size_t root = model->root ? strlen(model->root) : 0;
    const char *name = model->path + root;
    while (root && *name == '/')
        name++;
    return name;
}

static int by_name(const void *a, const void *b) { return strcmp(name_of(a), name_of(b)); }

static void sort(struct batch_plan *plan)
{
    if (plan->count)
        qsort(plan->models, plan->count, sizeof *plan->models, by_name);
}

static bool add_pair(struct model_diff *diff, const struct batch_model *old, const struct batch_model *new,
                     lam_error *error)
{
    const struct batch_model *shown = new ? new : old;
    size_t at = diff->plan.count;
    if (!batch_plan_add(&diff->plan, shown->path, shown->root, error))
        return false;
    diff->pairs[at] = (struct model_pair){name_of(shown), old ? old->path : NULL, new ? new->path : NULL};
    return true;
}

// Both lists are sorted. If the next names differ, the name that sorts first exists on only one side.
static bool make_pairs(struct model_diff *diff, lam_error *error)
{
    struct batch_plan *olds = &diff->olds, *news = &diff->news;
    diff->pairs = calloc(olds->count + news->count + 1, sizeof *diff->pairs);
    if (!diff->pairs)
        return complain(error, LAM_MACHINE, "out of memory");
    if (!diff->folders)
        return add_pair(diff, olds->models, news->models, error);
    sort(olds);
    sort(news);
    for (size_t i = 0, k = 0; i < olds->count || k < news->count;) {
        const struct batch_model *old = i < olds->count ? &olds->models[i] : NULL,
                                 *new = k < news->count ? &news->models[k] : NULL;
        int order = !old ? 1 : !new ? -1 : strcmp(name_of(old), name_of(new));
        if (!add_pair(diff, order <= 0 ? old : NULL, order >= 0 ? new : NULL, error))
            return false;
        i += order <= 0;
        k += order >= 0;
    }
    return diff->plan.count ||
           complain(error, LAM_CANNOT_READ, "%.200s, %.200s: found no model in the folders or below them", diff->old,
                    diff->new);
}

static bool add_side(struct batch_plan *plan, const char *operand, bool folder, lam_error *error)
{
    return folder ? batch_add_folder_if_any(plan, operand, error) : batch_plan_add(plan, operand, NULL, error);
}

// --- the result

static void count_changes(struct model_diff *diff, json_t *const *records)
{
    for (size_t i = 0; i < diff->plan.count; i++)
        diff->counts[diff_change_of(records[i])]++;
}

static void put_json(FILE *file, const struct model_diff *diff, json_t *const *records)
{
    struct json json = {.file = file};
    json_open(&json, NULL, '{');
    json_put(&json, TEXT("lambent", lam_version()), TEXT("old", diff->old), TEXT("new", diff->new),
             NUMBER("tolerance", diff->options->diff.tolerance));
    for (int i = 0; i < CHANGE_COUNT; i++)
        json_put(&json, COUNT(change_names[i], diff->counts[i]));
    json_text(&json, "page", diff->page);
    json_open(&json, "models", '[');
    for (size_t i = 0; i < diff->plan.count; i++) {
        const json_t *record = records[i];
        static const char *const numbers[] = {"maximum", "mean", "share_over_1"};
        static const char *const texts[] = {"counts_before", "counts_after"};
        json_open(&json, NULL, '{');
        json_put(&json, TEXT("name", diff->pairs[i].name), TEXT("change", change_names[diff_change_of(record)]),
                 TEXT("error", json_string_value(json_object_get(record, "error"))));
        for (int k = 0; k < 3; k++)
            if (json_object_get(record, numbers[k]))
                json_number(&json, numbers[k], json_number_value(json_object_get(record, numbers[k])));
        for (int k = 0; k < 2; k++)
            if (json_object_get(record, texts[k]))
                json_text(&json, texts[k], json_string_value(json_object_get(record, texts[k])));
        json_close(&json, '}');
    }
    json_close(&json, ']');
    json_close(&json, '}');
    putc('\n', file);
}

static void put_text(const struct model_diff *diff, json_t *const *records)
{
    for (size_t i = 0; i < diff->plan.count; i++) {
        enum change change = diff_change_of(records[i]);
        if (change == CHANGE_EQUAL)
            continue;
        printf("%-8s ", change_names[change]);
        print_foreign(stdout, FOREIGN_TERMINAL, FOREIGN(diff->pairs[i].name));
        if (change == CHANGE_CHANGED)
            printf("  %.4g %% of the pixels", 100 * json_number_value(json_object_get(records[i], "share_over_1")));
        putchar('\n');
    }
    for (int i = 0; i < CHANGE_COUNT; i++)
        printf("%s%zu %s", i ? ", " : "", diff->counts[i], change_names[i]);
    putchar('\n');
    if (diff->page)
        printf("%s\n", diff->page);
}

static int finish(void *user, json_t *const *records, size_t failed)
{
    (void)failed;
    struct model_diff *diff = user;
    const struct options *o = diff->options;
    lam_error error = {0};
    count_changes(diff, records);
    bool ok = true, standard = diff->page && strcmp(diff->page, "-") == 0;
    if (diff->page) {
        char *page = diff_page(diff, records);
        ok = page || complain(&error, LAM_MACHINE, "out of memory");
        if (ok && standard)
            fputs(page, stdout);
        else
            ok = ok && writer_save(diff->page, &(lam_bytes){page, strlen(page)}, false, &error);
        free(page);
    }
    if (!ok)
        return report_failure(&error, o);
    if (o->report.json)
        put_json(standard ? stderr : stdout, diff, records);
    else if (!o->report.quiet && !standard)
        put_text(diff, records);
    const size_t *n = diff->counts;
    if (!diff->folders && n[CHANGE_FAILED])
        return (int)json_integer_value(json_object_get(records[0], "exit"));
    bool differs = n[CHANGE_CHANGED] + n[CHANGE_ADDED] + n[CHANGE_REMOVED];
    return n[CHANGE_FAILED] && !o->batch.failures_ok ? EXIT_SOME_FAILED : differs ? EXIT_DIFFERS : 0;
}

// --- the run

static void reach(void *user, size_t model, struct sandbox_paths *paths)
{
    const struct model_pair *pair = &((struct model_diff *)user)->pairs[model];
    if (pair->old && pair->new)
        sandbox_add_input(paths, pair->old);
}

static enum writer_right right_of(void *user, const char *path)
{
    const char *page = ((struct model_diff *)user)->page;
    return page && strcmp(path, page) == 0 ? WRITER_ANY : WRITER_NONE;
}

static bool check(const struct model_diff *diff, lam_error *error)
{
    const struct options *o = diff->options;
    const char *dot = diff->page ? strrchr(diff->page, '.') : NULL;
    bool html = dot && (strcmp(dot, ".html") == 0 || strcmp(dot, ".htm") == 0);
    if (diff->page && !html && strcmp(diff->page, "-") != 0)
        return complain(error, LAM_UNSUPPORTED, "%s: a comparison of models is written as a page; write .html",
                        diff->page);
    if (o->batch.lists.count)
        return complain(error, LAM_BAD_ARGUMENT,
                        "option '--files-from' does not apply to diff, which compares folders");
    if (o->picture.show && strcmp(o->picture.show, "all") == 0)
        return complain(error, LAM_BAD_ARGUMENT,
                        "option '--show all' draws several pictures of a model, but diff draws one");
    return job_check_options(o, error) &&
           (!diff->page || strcmp(diff->page, "-") == 0 || output_check(diff->page, "", OUTPUT_NAMED, error));
}

int diff_models(char **operands, bool folders, const struct options *options)
{
    lam_error error = {0};
    // This command prints its own report, so the batch run prints no reports and writes no pictures.
    struct options drawn = *options;
    drawn.report.json = false;
    drawn.picture.output = NULL;
    if (!option_given(options, "size"))
        drawn.picture.width = drawn.picture.height = 384;
    struct model_diff diff = {.options = options,
                              .old = operands[0],
                              .new = operands[1],
                              .page = options->picture.output,
                              .folders = folders};
    struct batch_receiver use = {diff_draw, reach, right_of, {diff.page}, finish, &diff};
    bool ok = check(&diff, &error) && batch_plan_start(&diff.plan, &drawn, &error) &&
              ((diff.rows = shared_count_make()) || complain(&error, LAM_MACHINE, "out of memory"));
    diff.olds.options = diff.news.options = &drawn;
    ok = ok && add_side(&diff.olds, diff.old, folders, &error) && add_side(&diff.news, diff.new, folders, &error) &&
         make_pairs(&diff, &error);
    int code = ok ? batch_receive(&diff.plan, &use) : report_failure(&error, options);
    shared_count_free(diff.rows);
    free(diff.pairs);
    batch_plan_free(&diff.plan);
    batch_plan_free(&diff.olds);
    batch_plan_free(&diff.news);
    return code;
}
