// check.c: the command `check`: compares pictures of shaders with the reference scenes.
#include "check.h"

#include <errno.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "commands.h"
#include "console.h"
#include "interrupt.h"
#include "output.h"
#include "failure.h"

enum { MAX_SCENES = 32 };
static const size_t max_cache_bytes = (size_t)384 << 20; // the cache of pictures, shared by the shaders of one command

// Loads the contract that the command line specifies by name or as a file. Leaves *contract NULL if the check must
// detect the contract.
static bool read_contract(const char *name, lam_check_contract **contract, lam_error *error)
{
    if (!name || strcmp(name, "auto") == 0)
        return true;
    const char *text = lam_check_contract_text(name);
    if (text)
        return (*contract = lam_check_contract_read(text, strlen(text), name, error)) != NULL;
    if (!strpbrk(name, "./")) {
        struct suggestion nearest = suggest_start(name);
        char known[200] = "auto";
        for (int i = 0; lam_check_contract_shipped(i); i++) {
            size_t used = strlen(known);
            snprintf(known + used, sizeof known - used, ", %s", lam_check_contract_shipped(i));
            suggest_try(&nearest, lam_check_contract_shipped(i));
        }
        return complain(error, LAM_BAD_ARGUMENT, "option '--contract': found '%.60s', expected %s or a file%s%s%s",
                        name, known, nearest.best ? "; did you mean '" : "", nearest.best ? nearest.best : "",
                        nearest.best ? "'?" : "");
    }
    char *file = check_read_text(name, error);
    *contract = file ? lam_check_contract_read(file, strlen(file), name, error) : NULL;
    free(file);
    return *contract != NULL;
}

struct check_command {
    const struct options *options;
    struct check_batch batch;
    struct check_submission *submissions;
    lam_check_contract *contract;
    int code; // the exit code if the command cannot write an output, otherwise 0
    char *scene_list;
    const char *scenes[MAX_SCENES];
};

// Splits "all,gate" into its names.
static bool split_scenes(struct check_command *c, lam_error *error)
{
    if (!c->options->check.scenes)
        return true;
    c->scene_list = strdup(c->options->check.scenes);
    if (!c->scene_list)
        return complain(error, LAM_MACHINE, "out of memory");
    for (char *word = strtok(c->scene_list, ","); word && c->batch.scene_count < MAX_SCENES; word = strtok(NULL, ","))
        c->scenes[c->batch.scene_count++] = word;
    c->batch.scenes = c->batch.scene_count ? c->scenes : NULL;
    return true;
}

// Finds the submissions in a folder, or among the operands.
static bool find_submissions(struct check_command *c, int operand_count, char **operands, lam_error *error)
{
    const struct options *o = c->options;
    if (o->check.class_folder && operand_count)
        return complain(error, LAM_BAD_ARGUMENT,
                        "option '--class' names a folder, but '%.100s' names a shader too; expected one of them",
                        operands[0]);
    c->batch.in_class = o->check.class_folder != NULL;
    c->batch.count = o->check.class_folder
                         ? check_find(o->check.class_folder, &c->submissions, error)
                         : check_pair(operand_count, operands, o->check.vertex, &c->submissions, error);
    c->batch.submissions = c->submissions;
    if (c->batch.count < 0)
        return false;
    if (c->batch.count == 0)
        return complain(error, LAM_BAD_ARGUMENT,
                        "check: no shader given, expected the file of a fragment shader, --class FOLDER, or --list");
    for (int i = 0; o->check.class_folder && o->check.vertex && i < c->batch.count; i++)
        if (!c->submissions[i].vertex && !(c->submissions[i].vertex = strdup(o->check.vertex)))
            return complain(error, LAM_MACHINE, "out of memory");
    for (int i = 0; c->batch.count > 1 && !c->batch.in_class && i < c->batch.count; i++)
        if (strcmp(c->submissions[i].fragment, "-") == 0)
            return complain(error, LAM_BAD_ARGUMENT, "'-' (standard input) is possible only for a single shader");
    return true;
}

// Checks the formats of the output files before the work starts. Writing the files may still fail later.
static bool check_outputs(const struct check_command *c, lam_error *error)
{
    const struct options *o = c->options;
    if (o->picture.has_size && o->picture.width != o->picture.height)
        return complain(error, LAM_BAD_ARGUMENT, "check: pictures are square, found %dx%d", o->picture.width,
                        o->picture.height);
    if (c->batch.in_class) // -o always names a folder here
        return true;
    if (o->picture.output && output_is_named(o->picture.output) && c->batch.count > 1)
        return complain(error, LAM_BAD_ARGUMENT,
                        "option '--output' names one sheet for %d shaders; name a folder: -o sheets/", c->batch.count);
    if (!o->picture.output || !output_is_named(o->picture.output) || output_is_stream(o->picture.output))
        return true;
    return output_check_bytes(o->picture.output, "sheet", "", error);
}

static bool open_tables(struct check_command *c, lam_error *error)
{
    const struct check_options *o = &c->options->check;
    const struct check_table tables[CHECK_TABLES] = {
        {.path = o->csv, .head = check_csv_head, .row = check_csv_row},
        {.path = o->moodle, .head = check_moodle_head, .row = check_moodle_row},
        {.path = o->gradescope, .row = check_gradescope},
        {.path = o->submitty, .row = check_submitty},
    };
    bool of_one = o->gradescope || o->submitty || o->write_contract;
    if (of_one && (c->batch.count > 1 || c->batch.in_class))
        return complain(error, LAM_BAD_ARGUMENT, "option '--%s' is for one submission, found %s",
                        o->gradescope ? "gradescope"
                        : o->submitty ? "submitty"
                                      : "write-contract",
                        c->batch.in_class ? "a class" : "several");
    for (int i = 0; i < CHECK_TABLES; i++) {
        struct check_table *table = &c->batch.tables[i];
        *table = tables[i];
        if (!table->path)
            continue;
        if (!output_make_folder(table->path, error))
            return false;
        table->file = fopen(table->path, "w");
        if (!table->file)
            return complain(error, LAM_CANNOT_WRITE, "%s: cannot write: %s", table->path, strerror(errno));
        table->error = table->head ? table->head(table->file) : 0;
    }
    return true;
}

// Creates the folder of the page and the sheets. The command prints the verdicts even if the folder cannot be created.
static bool prepare_page(struct check_command *c, lam_error *error)
{
    char *page = check_page_path(c->options->picture.output, error);
    lam_error reason = {0};
    if (!page)
        return false;
    if (output_make_folder(page, &reason) && output_check(page, "", OUTPUT_NAMED, &reason)) {
        c->batch.page = check_page_make(error);
    } else {
        say_error(reason.text);
        c->code = exit_code_of(reason.code)->code;
        c->batch.without_sheets = true;
    }
    free(page);
    return c->batch.page || c->batch.without_sheets;
}

// Makes the list of roles, which ends with NULL.
static bool list_roles(struct check_command *c, lam_error *error)
{
    const struct texts *roles = &c->options->check.roles;
    if (!roles->count)
        return true;
    c->batch.roles = calloc((size_t)roles->count + 1, sizeof *c->batch.roles);
    for (int i = 0; c->batch.roles && i < roles->count; i++) {
        c->batch.roles[i] = roles->items[i];
        if (!strchr(roles->items[i], '='))
            return complain(error, LAM_BAD_ARGUMENT,
                            "option '--role': found '%.60s', expected NAME=ROLE, such as observer=eye",
                            roles->items[i]);
    }
    return c->batch.roles || complain(error, LAM_MACHINE, "out of memory");
}

static bool prepare(struct check_command *c, int operand_count, char **operands, lam_error *error)
{
    const struct options *o = c->options;
    if (!split_scenes(c, error) || !find_submissions(c, operand_count, operands, error) || !check_outputs(c, error) ||
        !read_contract(o->check.contract, &c->contract, error) || !list_roles(c, error) || !open_tables(c, error))
        return false;
    c->batch.contract = c->contract;
    if (c->batch.in_class && o->picture.output && !prepare_page(c, error))
        return false;
    return c->batch.count == 1 || (c->batch.cache = lam_check_cache_make(max_cache_bytes, error));
}

// Writes the files that need all results. A failure is only reported, because the verdicts are already printed.
static int finish(struct check_command *c)
{
    const struct options *o = c->options;
    lam_error error = {0};
    int code = c->code;
    if (c->batch.page && !check_page_write(c->batch.page, o->picture.output,
                                           o->captions.title ? o->captions.title : o->check.class_folder, &error)) {
        say_error(error.text);
        code = exit_code_of(error.code)->code;
    }
    for (int i = 0; i < CHECK_TABLES; i++) {
        struct check_table *table = &c->batch.tables[i];
        if (table->file && fclose(table->file) != 0 && !table->error)
            table->error = errno;
        table->file = NULL;
        if (!table->error)
            continue;
        complain(&error, LAM_CANNOT_WRITE, "%s: cannot write: %s", table->path, strerror(table->error));
        say_error(error.text);
        code = exit_code_of(error.code)->code;
    }
    return code;
}

// Ends the program soon after a signal, even if a thread is busy and does not look at interrupted().
static void *end_after_signal(void *unused)
{
    const struct timespec pause = {.tv_nsec = 20000000}, grace = {.tv_nsec = 200000000};
    while (!interrupted())
        nanosleep(&pause, NULL);
    nanosleep(&grace, NULL);
    interrupt_finish();
    return unused;
}

int run_check(int operand_count, char **operands, const struct options *o)
{
    lam_error error = {0};
    if (o->check.list)
        return check_print_lists(stdout, &error) ? 0 : report_failure(&error, o);
    if (o->limits.memory_limit_bytes == UINT64_MAX) {
        complain(&error, LAM_BAD_ARGUMENT,
                 "option '--memory-limit': found 'none', but a shader needs a limit, in bytes");
        return report_failure(&error, o);
    }
    interrupt_start();
    pthread_t watch;
    if (pthread_create(&watch, NULL, end_after_signal, NULL) == 0)
        pthread_detach(watch);
    struct check_command c = {.options = o, .batch = {.options = o}};
    c.batch.tolerance = option_given(o, "tolerance") ? o->diff.tolerance : 2;
    int code = 0;
    if (prepare(&c, operand_count, operands, &error)) {
        code = check_batch_run(&c.batch, &error);
        int finished = finish(&c);
        code = finished > code ? finished : code;
    }
    for (int i = 0; i < CHECK_TABLES; i++)
        if (c.batch.tables[i].file)
            fclose(c.batch.tables[i].file);
    check_page_free(c.batch.page);
    lam_check_cache_free(c.batch.cache);
    lam_check_contract_free(c.contract);
    check_free_submissions(c.submissions, c.batch.count);
    free(c.scene_list);
    free(c.batch.roles);
    if (interrupted())
        interrupt_finish();
    return error.code ? report_failure(&error, o) : code;
}
