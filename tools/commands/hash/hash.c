// hash.c: the command `hash`: writes, compares and updates hashes of pictures, as text that is kept in a repository.
#include "command.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "journal.h"
#include "batch.h"
#include "batch_shard.h"
#include "console.h"
#include "foreign.h"
#include "hash.h"
#include "job.h"
#include "json.h"
#include "output.h"
#include "file_io.h"
#include "report.h"
#include "sandbox_start.h"
#include "xxh64.h"

// --- the command line

// Makes the folder of --pictures before drawing starts, because without the folder every picture would fail.
static bool make_pictures_folder(const struct options *o, lam_error *error)
{
    const char *folder = o->hash.pictures;
    char *inside = NULL;
    struct stat found;
    if (!folder || (o->hash.check && !o->hash.update))
        return true;
    if (asprintf(&inside, "%s/.", folder) < 0)
        return complain(error, LAM_MACHINE, "out of memory");
    lam_error reason = {0};
    bool ok = output_make_folder(inside, &reason);
    free(inside);
    if (!ok)
        return complain(error, reason.code, "option '--pictures': %.400s", reason.text);
    if (stat(folder, &found) == 0 && !S_ISDIR(found.st_mode))
        return complain(error, LAM_CANNOT_WRITE, "option '--pictures': found the file '%.300s', expected a folder",
                        folder);
    return access(folder, W_OK | X_OK) == 0 ||
           complain(error, LAM_CANNOT_WRITE, "%.300s: cannot write to the folder: %s", folder, strerror(errno));
}

static bool check(int operands, const struct options *o, lam_error *error)
{
    if (!o->hash.check == !o->picture.output)
        return complain(error, LAM_BAD_ARGUMENT,
                        "hash: expected either -o FILE, to write hashes, or --check FILE, to compare them");
    if (o->hash.update && !o->hash.check)
        return complain(error, LAM_BAD_ARGUMENT, "option '--update' requires --check FILE, whose hashes it replaces");
    if (o->hash.check && strcmp(o->hash.check, "-") == 0)
        return complain(error, LAM_BAD_ARGUMENT, "option '--check' reads a file, found '-'");
    if (o->picture.output && !output_is_named(o->picture.output))
        return complain(error, LAM_BAD_ARGUMENT, "option '--output': found the folder '%.200s', expected a file",
                        o->picture.output);
    if (!operands && !o->batch.lists.count && !o->hash.check)
        return complain(error, LAM_BAD_ARGUMENT,
                        "hash: no model given, expected files, folders, @FILE with a list of names, or - for names on "
                        "standard input");
    if (o->work.device != DEVICE_AUTO && o->work.device != DEVICE_CPU)
        return complain(error, LAM_BAD_ARGUMENT,
                        "option '--device': only pictures of the CPU device are hashed, because they are identical on "
                        "every machine");
    if (o->picture.show && strcmp(o->picture.show, "all") == 0)
        return complain(error, LAM_BAD_ARGUMENT,
                        "option '--show all' draws several pictures, but each hash is for one picture");
    return job_check_options(o, error) && make_pictures_folder(o, error);
}

// --- the models

static bool add_models(struct hash_run *run, int count, char **operands, lam_error *error)
{
    bool ok = true;
    for (int i = 0; ok && i < count; i++)
        ok = batch_add_operand(&run->plan, operands[i], error);
    for (int i = 0; ok && i < run->options->batch.lists.count; i++)
        ok = batch_add_list(&run->plan, run->options->batch.lists.items[i], error);
    for (size_t i = 0; ok && run->by_file && i < run->then.count; i++) {
        char *model = hash_file_model(run->path, run->then.entries[i].name);
        ok = model || complain(error, LAM_MACHINE, "out of memory");
        ok = ok && hash_file_may_name(run->path, model, run->options, error) &&
             batch_plan_add(&run->plan, model, NULL, error);
        free(model);
    }
    return ok;
}

// Collects the names of the models. Fails if a model is given twice.
static bool name_models(struct hash_run *run, lam_error *error)
{
    struct batch_plan *plan = &run->plan;
    struct hash_file seen = {.entries = calloc(plan->count + 1, sizeof *seen.entries)};
    run->names = calloc(plan->count + 1, sizeof *run->names);
    bool ok = seen.entries && run->names;
    for (size_t i = 0; ok && i < plan->count; i++) {
        ok = (run->names[i] = hash_file_name(run->path, plan->models[i].path)) != NULL;
        seen.entries[i] = (struct hash_entry){run->names[i], i};
    }
    ok = ok || complain(error, LAM_MACHINE, "out of memory");
    seen.count = ok ? plan->count : 0;
    hash_file_sort(&seen);
    for (size_t i = 1; ok && i < seen.count; i++)
        if (strcmp(seen.entries[i].name, seen.entries[i - 1].name) == 0)
            ok = complain(error, LAM_BAD_ARGUMENT, "hash: '%.300s' is given twice", seen.entries[i].name);
    run->sorted = seen;
    return ok;
}

// Finds the existing models that the hash file lists but the command line does not name. --update keeps their hashes.
static bool find_kept(struct hash_run *run, lam_error *error)
{
    run->kept = calloc(run->then.count + 1, sizeof *run->kept);
    bool ok = run->kept != NULL;
    for (size_t i = 0; ok && run->options->hash.update && i < run->then.count; i++) {
        char *model = hash_file_model(run->path, run->then.entries[i].name);
        ok = model != NULL;
        run->kept[i] = ok && !hash_file_find(&run->sorted, run->then.entries[i].name) &&
                       (lam_shape_find(model) >= 0 || access(model, F_OK) == 0);
        free(model);
    }
    return ok || complain(error, LAM_MACHINE, "out of memory");
}

// --- drawing

static bool save_picture(const struct hash_run *run, const char *name, const struct job *job, lam_error *error)
{
    char *path = hash_picture_path(run->options->hash.pictures, name);
    lam_save_params params = {.threads = job->options->work.threads};
    lam_bytes png = {0};
    bool ok = path || complain(error, LAM_MACHINE, "out of memory");
    ok = ok && lam_image_encode(&job->image, "png", &params, &png, error) && writer_save(path, &png, false, error);
    lam_bytes_free(&png);
    free(path);
    return ok;
}

static bool draw(void *user, size_t model, struct job *job, struct progress *progress, json_t *found, lam_error *error)
{
    struct hash_run *run = user;
    const struct options *o = run->options;
    const char *name = run->names[model];
    if (!job_draw(job, LAM_RGBA8, progress, error))
        return false;
    char text[XXH64_TEXT];
    uint64_t hash = hash_of_pixels(&job->image);
    const struct hash_entry *then = hash_file_find(&run->then, name);
    xxh64_print(hash, text);
    json_object_set_new(found, "pixels", json_string(text));
    bool differs = !then || then->hash != hash;
    if (o->hash.update && then && differs)
        hash_sheet_keep(run, name, then->hash, &job->image, found);
    return !o->hash.pictures || (run->checks && !o->hash.update) || save_picture(run, name, job, error);
}

// --- the result

enum state { STATE_EQUAL, STATE_CHANGED, STATE_MISSING, STATE_NEW, STATE_FAILED, STATE_COUNT };
static const char *const state_names[STATE_COUNT] = {"equal", "changed", "missing", "new", "failed"};

struct result {
    size_t counts[STATE_COUNT];
};

// Prints the names of the models in one state, as a JSON array or one per line.
static void tell_state(const struct hash_run *run, json_t *const *records, enum state state, struct json *json,
                       struct result *result)
{
    if (json)
        json_open(json, state_names[state], '[');
    size_t count = state == STATE_MISSING ? run->then.count : run->plan.count;
    for (size_t i = 0; i < count; i++) {
        const char *name = state == STATE_MISSING ? run->then.entries[i].name : run->names[i];
        enum state is;
        if (state == STATE_MISSING) {
            is = hash_file_find(&run->now, name) ? STATE_EQUAL : STATE_MISSING;
        } else {
            uint64_t hash;
            const char *text = json_string_value(json_object_get(records[i], "pixels"));
            const struct hash_entry *then = hash_file_find(&run->then, name);
            bool drawn = text && xxh64_parse(text, &hash);
            is = !drawn ? STATE_FAILED : !then ? STATE_NEW : then->hash == hash ? STATE_EQUAL : STATE_CHANGED;
        }
        if (is != state)
            continue;
        result->counts[state]++;
        if (json)
            json_text(json, NULL, name);
        else if (state != STATE_EQUAL && run->checks && !run->options->report.quiet) {
            printf("%-8s ", state_names[state]);
            print_foreign(stdout, FOREIGN_TERMINAL, FOREIGN(name));
            putchar('\n');
        }
    }
    if (json)
        json_close(json, ']');
}

// Fills `now` with the hashes of the drawn models. A failed model gets the hash 0, so the comparison does not treat the
// model as missing.
static bool take_hashes(struct hash_run *run, json_t *const *records, lam_error *error)
{
    run->now = (struct hash_file){.entries = calloc(run->plan.count + 1, sizeof *run->now.entries)};
    if (!run->now.entries)
        return complain(error, LAM_MACHINE, "out of memory");
    for (size_t i = 0; i < run->plan.count; i++) {
        const char *text = json_string_value(json_object_get(records[i], "pixels"));
        struct hash_entry entry = {strdup(run->names[i]), 0};
        if (!entry.name)
            return complain(error, LAM_MACHINE, "out of memory");
        run->now.entries[run->now.count++] = entry;
        if (text)
            xxh64_parse(text, &run->now.entries[run->now.count - 1].hash);
    }
    hash_file_sort(&run->now);
    return true;
}

static bool write_file(struct hash_run *run, json_t *const *records, char *options_text, lam_error *error)
{
    struct hash_file out = {.version = (char *)(uintptr_t)lam_version(), // not modified
                            .options = options_text,
                            .entries = calloc(run->plan.count + run->then.count + 1, sizeof *out.entries)};
    bool ok = out.entries || complain(error, LAM_MACHINE, "out of memory");
    for (size_t i = 0; ok && i < run->plan.count; i++) {
        const char *text = json_string_value(json_object_get(records[i], "pixels"));
        struct hash_entry entry = {run->names[i], 0};
        if (text && xxh64_parse(text, &entry.hash))
            out.entries[out.count++] = entry;
    }
    for (size_t i = 0; ok && i < run->then.count; i++) // existing models that were not drawn
        if (run->kept[i])
            out.entries[out.count++] = run->then.entries[i];
    hash_file_sort(&out);
    char *text = ok ? hash_file_text(&out) : NULL;
    ok = ok && (text || complain(error, LAM_MACHINE, "out of memory"));
    if (ok && strcmp(run->path, "-") == 0)
        fputs(text, stdout);
    else
        ok = ok && writer_save(run->path, &(lam_bytes){text, strlen(text)}, false, error);
    free(text);
    free(out.entries);
    return ok;
}

static void say_summary(const struct hash_run *run, const struct result *r)
{
    const char *text = "";
    for (int i = 0; i < STATE_COUNT; i++)
        if (r->counts[i] || (i == STATE_EQUAL && run->checks)) {
            printf("%s%zu %s", text, r->counts[i],
                   run->checks || i == STATE_FAILED ? state_names[i]
                   : r->counts[i] == 1              ? "hash"
                                                    : "hashes");
            text = ", ";
        }
    putchar('\n');
}

static void head_json(struct json *json, const struct hash_run *run, const char *options_text)
{
    json_open(json, NULL, '{');
    json_put(json, TEXT("lambent", lam_version()), TEXT("file", run->path), TEXT("options", options_text),
             TEXT("file_version", run->then.version), TEXT("file_options", run->then.options));
}

// Writes the hashes and the sheet of old and new pictures. Sets *rows to the number of pictures on the sheet.
static bool write_results(struct hash_run *run, json_t *const *records, char *options_text, int *rows, lam_error *error)
{
    return (!run->options->hash.update || hash_sheet_write(run, records, rows, error)) &&
           write_file(run, records, options_text, error);
}

static void say_result(const struct hash_run *run, const struct result *result, struct json *json, bool written,
                       int rows)
{
    if (run->options->report.json) {
        json_put(json, FLAG("written", written), TEXT("sheet", rows ? run->sheet : NULL));
        json_close(json, '}');
        putc('\n', json->file);
    } else if (!run->options->report.quiet && json->file == stdout) {
        say_summary(run, result);
        if (written)
            printf("written to %s%s%s\n", run->path, rows ? "; old and new pictures: " : "", rows ? run->sheet : "");
    }
}

// Returns whether a model in the hash file failed. --failures-ok does not permit such failures.
static bool lost_models(const struct hash_run *run, json_t *const *records)
{
    bool lost = false;
    for (size_t i = 0; run->checks && i < run->plan.count; i++)
        lost |= hash_file_find(&run->then, run->names[i]) && !json_object_get(records[i], "pixels");
    return lost;
}

static int finish(void *user, json_t *const *records, size_t failed)
{
    struct hash_run *run = user;
    const struct options *o = run->options;
    lam_error error = {0};
    struct result result = {0};
    struct json json = {.file = strcmp(run->path, "-") == 0 ? stderr : stdout};
    char *options_text = hash_options_text(o, run->path);
    const bool writes = !run->checks || o->hash.update, blocked = failed && !o->batch.failures_ok;
    int rows = 0;
    bool ok = (options_text || complain(&error, LAM_MACHINE, "out of memory")) && take_hashes(run, records, &error) &&
              (!writes || blocked || write_results(run, records, options_text, &rows, &error));
    if (ok && o->report.json)
        head_json(&json, run, options_text);
    for (int i = 0; ok && i < STATE_COUNT; i++)
        tell_state(run, records, (enum state)i, o->report.json ? &json : NULL, &result);
    free(options_text);
    if (!ok)
        return report_failure(&error, o);
    say_result(run, &result, &json, writes && !blocked, rows);
    if (writes && blocked && json.file != stderr) // unless the hashes go to standard output
        say_plain("lambent: %s is not written, because %zu of the models failed; --failures-ok omits them\n", run->path,
                  failed);
    bool differs = result.counts[STATE_CHANGED] + result.counts[STATE_MISSING] + result.counts[STATE_NEW] ||
                   lost_models(run, records);
    return blocked ? EXIT_SOME_FAILED : run->checks && !o->hash.update && differs ? EXIT_DIFFERS : 0;
}

// --- the run

// If the file was written by another version or with other options, prints a warning, because the pictures may differ
// for this reason.
static bool say_head(const struct hash_run *run, lam_error *error)
{
    char *now = hash_options_text(run->options, run->path);
    if (!now)
        return complain(error, LAM_MACHINE, "out of memory");
    bool says = !run->options->report.quiet;
    if (says && strcmp(run->then.version, lam_version()) != 0)
        say_plain("lambent: %s was written by version %s, and this is %s: pictures may differ for that reason\n",
                  run->path, run->then.version, lam_version());
    if (says && strcmp(run->then.options, now) != 0)
        say_plain("lambent: %s was made with the options '%s', and these are '%s': pictures differ for that reason\n",
                  run->path, run->then.options, now);
    free(now);
    return true;
}

static enum writer_right right_of(void *user, const char *path)
{
    const struct hash_run *run = user;
    const char *pictures = run->options->hash.pictures;
    if (run->checks && !run->options->hash.update)
        return WRITER_NONE;
    if (strcmp(path, run->path) == 0)
        return WRITER_ANY;
    if (run->sheet && strcmp(path, run->sheet) == 0)
        return WRITER_NEW_OR_OURS;
    size_t length = pictures ? strlen(pictures) : 0, all = strlen(path);
    bool kept = length && strncmp(path, pictures, length) == 0 && !strstr(path + length, "../") &&
                (pictures[length - 1] == '/' || path[length] == '/') && all > 4 && strcmp(path + all - 4, ".png") == 0;
    return kept ? WRITER_NEW_OR_OURS : WRITER_NONE;
}

static void reach(void *user, size_t model, struct sandbox_paths *paths)
{
    const struct hash_run *run = user;
    if (run->options->hash.pictures && run->options->hash.update && model < run->plan.count)
        sandbox_add(paths, run->options->hash.pictures, SANDBOX_READ);
}

static bool prepare(struct hash_run *run, int count, char **operands, lam_error *error)
{
    const struct options *o = run->options;
    run->checks = o->hash.check != NULL;
    run->path = run->checks ? o->hash.check : o->picture.output;
    if (run->checks && !say_head(run, error))
        return false;
    lam_error ignored;
    struct hash_file other = {0};
    bool replaces = !run->checks && access(run->path, F_OK) == 0 && !hash_file_read(&other, run->path, &ignored);
    hash_file_free(&other);
    if (replaces)
        return complain(error, LAM_CANNOT_WRITE,
                        "%.300s: the output would replace this file, which lambent hash did not write", run->path);
    if ((!run->checks || o->hash.update) && strcmp(run->path, "-") != 0 &&
        !output_check(run->path, "", OUTPUT_NAMED, error))
        return false;
    if (o->hash.update && (!(run->sheet = hash_sheet_path(run->path)) || !(run->rows = shared_count_make())))
        return complain(error, LAM_MACHINE, "out of memory");
    return add_models(run, count, operands, error) && name_models(run, error) && find_kept(run, error);
}

// Draws the models with run->options, which hash_options_take completed from the hash file, and compares their hashes.
static int run_with(struct hash_run *run, int operand_count, char **operands)
{
    lam_error error = {0};
    // This command prints its own report, so the batch run prints no reports and writes no pictures.
    struct options drawn = *run->options;
    drawn.report.json = false;
    drawn.report.verbose = false;
    drawn.picture.output = NULL;
    run->by_file = !operand_count && !run->options->batch.lists.count;
    drawn.limits.files_inside |=
        run->by_file; // scene files that the hash file lists may refer only to files below their own folders
    struct batch_receiver use = {draw, reach, right_of, {NULL, NULL, run->options->hash.pictures}, finish, run};
    bool ok = check(operand_count, run->options, &error) && batch_plan_start(&run->plan, &drawn, &error) &&
              prepare(run, operand_count, operands, &error);
    use.files[0] = run->path;
    use.files[1] = run->sheet;
    return ok ? batch_receive(&run->plan, &use) : report_failure(&error, run->options);
}

int run_hash(int operand_count, char **operands, const struct options *options)
{
    lam_error error = {0};
    struct hash_run run = {.options = options};
    struct options own = {0};
    char *kept = NULL;
    bool ok = check(operand_count, options, &error);
    if (ok && options->hash.check) {
        ok = hash_file_read(&run.then, options->hash.check, &error) &&
             hash_options_take(&run.then, options->hash.check, options, &own, &kept, &error);
        run.options = &own;
    }
    int code = ok ? run_with(&run, operand_count, operands) : report_failure(&error, options);
    for (size_t i = 0; run.names && i < run.plan.count; i++)
        free(run.names[i]);
    free(run.names);
    free(run.sorted.entries); // the names, shared with run.names, are already freed
    free(run.kept);
    free(run.sheet);
    shared_count_free(run.rows);
    hash_file_free(&run.then);
    hash_file_free(&run.now);
    batch_plan_free(&run.plan);
    if (run.options == &own)
        options_free(&own);
    free(kept);
    return code;
}
