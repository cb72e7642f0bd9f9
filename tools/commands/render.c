// render.c: the command `render`, the default: draws a picture of each model. tools/batch contains the loop over the
// models.
#include "command.h"

#include <errno.h>
#include <string.h>
#include <unistd.h>

#include "animate_frame.h"
#include "batch.h"
#include "batch_shard.h"
#include "console.h"
#include "job.h"
#include "joined_models.h"
#include "output.h"
#include "report.h"
#include "terminal.h"

#define OF_BATCH(name) "option '--" name "' does not apply to this command; it belongs to batch: lambent batch --jobs -"

static bool check_models(int count, char **models, const struct options *o, lam_error *error)
{
    for (int i = 0; i < count; i++) {
        if (!*models[i])
            return complain(error, LAM_BAD_ARGUMENT, "a model's name is empty");
        if (strcmp(models[i], "-") == 0 && count > 1)
            return complain(error, LAM_BAD_ARGUMENT, "'-' (standard input) works only with a single model");
        if (strcmp(models[i], "-") == 0 && isatty(STDIN_FILENO))
            return complain(error, LAM_BAD_ARGUMENT,
                            "standard input is a terminal, expected a model: lambent - < FILE");
        // A word without a dot or a slash is no model file, so nothing is drawn before it is refused.
        if (!strpbrk(models[i], "./\\*?") && !joined_models_next(models[i]) && strcmp(models[i], "-") != 0 &&
            access(models[i], F_OK) != 0 && !job_model_is_shape(models[i]) && !job_formula(o).text) {
            complain(error, LAM_CANNOT_READ, "%s: cannot open: %s", models[i], strerror(ENOENT));
            return model_guess(models[i], o, error), false;
        }
    }
    return true;
}

// If the command draws only one picture, prepares to show the picture in the terminal. Refuses to write a picture file
// to a terminal.
static bool check_terminal(int count, const struct options *o, lam_error *error)
{
    bool alone = count == 1 && !o->batch.lists.count && o->batch.view_count <= 1 && o->batch.size_count <= 1 &&
                 o->batch.show_count <= 1 && !animation_wanted(o);
    if (!terminal_start(o, alone, error))
        return false;
    if (o->picture.output && strcmp(o->picture.output, "-") == 0 && isatty(STDOUT_FILENO) && !terminal_shows())
        return terminal_refuse("MODEL", error);
    return true;
}

// A reason to reject the command line: whether the reason applies, and the message.
struct refusal {
    bool applies;
    const char *text;
};

static bool check_together(int count, char **models, const struct options *o, lam_error *error)
{
    const struct batch_options *b = &o->batch;
    const char *scene = o->picture.save_scene;
    bool one_picture = !output_name_is_pattern(o->picture.output) && output_is_named(o->picture.output);
    if (!check_models(count, models, o, error) || !job_check_options(o, error))
        return false;
    if (one_picture && count > 1)
        return complain(
            error, LAM_BAD_ARGUMENT,
            "option '--output' names one picture, but there are %d models ('%.60s', '%.60s'%s); "
            "name a folder, -o pictures/, or a pattern, -o '{stem}-{view}.png'; one picture of several models: "
            "lambent a.stl + b.stl",
            count, models[0], models[1], count > 2 ? " ..." : "");
    const struct refusal refusals[] = {
        {b->jobs, OF_BATCH("jobs")},
        {b->ahead, OF_BATCH("ahead")},
        {b->line_limit_bytes, OF_BATCH("line-limit")},
        {scene && b->lists.count, "option '--save-scene' works only with a single model, found a list of models"},
        {scene && count > 1, "option '--save-scene' works only with a single model, found several"},
        {scene && count && strcmp(models[0], "-") == 0,
         "option '--save-scene' needs a model with a name; standard input has none"},
        {scene && strcmp(scene, "-") == 0, "option '--save-scene' writes a file, expected its name"},
        {b->resume && !b->journal, "option '--resume' needs a journal, expected --journal FILE"},
        {b->skip_same && !b->journal, "option '--skip-same' needs a journal, expected --journal FILE"},
    };
    for (size_t i = 0; i < sizeof refusals / sizeof *refusals; i++)
        if (refusals[i].applies)
            return complain(error, LAM_BAD_ARGUMENT, "%s", refusals[i].text);
    return check_terminal(count, o, error);
}

// Returns whether --journal requests a journal. With --dry-run, there is nothing to record.
static bool journal_named(const struct options *o)
{
    return o->batch.journal && strcmp(o->batch.journal, "none") != 0 && !o->report.dry_run;
}

int run_render(int operand_count, char **operands, const struct options *options)
{
    lam_error error = {0};
    struct batch_plan plan;
    bool ok = check_together(operand_count, operands, options, &error) && batch_plan_start(&plan, options, &error);
    if (!ok)
        return report_failure(&error, options);
    for (int i = 0; ok && i < operand_count; i++)
        ok = batch_plan_add(&plan, operands[i], NULL, &error);
    for (int i = 0; ok && i < options->batch.lists.count; i++)
        ok = batch_add_list(&plan, options->batch.lists.items[i], &error);
    ok = ok && batch_plan_check(&plan, &error);
    int code = ok ? batch_run(&plan, journal_named(options) ? options->batch.journal : NULL, false)
                  : report_failure(&error, options);
    batch_plan_free(&plan);
    return code;
}
