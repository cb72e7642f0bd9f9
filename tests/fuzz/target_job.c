// target_job.c: fuzz target for the lines of `lambent batch --jobs` (docs/worker.md). Nothing is drawn: it reads a
// line, with the options, the plan and the model's bytes that the line requests. Its files may be in an empty folder.
#include "target.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <lambent/path.h>

#include "batch_job.h"

static char root[] = "/tmp/lambent-fuzz-job-XXXXXX";

static void leave(void) { rmdir(root); }

static struct options *worker(void)
{
    static struct options options;
    static const char *paths[] = {root};
    if (!options.limits.allow_paths.count) {
        option_table_fill();
        options = option_defaults();
        if (!mkdtemp(root) || atexit(leave) != 0 || !lam_path_hold(root, true, NULL))
            abort();
        options.limits.allow_paths = (struct texts){.items = paths, .count = 1};
    }
    return &options;
}

// Invariant for every line: a valid job, the id of a job to cancel, or an error message.
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct batch_job_rules rules = {.options = worker(), .threads = 1, .in_flight = 1, .has_keys = true};
    lam_error error = {0};
    json_t *id;
    struct batch_job *job;
    enum batch_line kind = batch_job_read((const char *)data, size, &rules, &job, &id, &error);
    note_sentence(kind == LINE_REFUSED ? error.text : "");
    if ((kind == LINE_REFUSED) != (error.text[0] != 0) || (kind == LINE_REFUSED) != (error.code != LAM_OK) ||
        (kind == LINE_JOB) != (job != NULL) || (kind == LINE_CANCEL && !id))
        abort();
    if (job && (job->plan.count != 1 || job->plan.view_count < 1 || !job->output || !job->id || !job->options_text ||
                !(job->options.limits.time_limit_s > 0)))
        abort();
    batch_job_free(job);
    json_decref(id);
    for (int csv = 0; csv < 2; csv++) { // the same bytes as rows of a list: a job, or an error message
        struct list_rows rows = {.is_csv = csv};
        for (uint64_t line = 1; line < 3; line++) {
            char *text;
            lam_error reason = {0};
            const bool ok = list_rows_take(&rows, (const char *)data, size, line, &text, &reason);
            note_sentence(reason.text);
            if (ok != (reason.code == LAM_OK) || (text && !ok) || (ok && !text && !(csv && line == 1)))
                abort();
            free(text);
        }
        json_decref(rows.columns);
        json_decref(rows.outputs);
    }
    return 0;
}
