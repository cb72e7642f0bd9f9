// journal_command.c: the command `journal`: summarises the journals of a batch and merges the journals of its shards.
#include "command.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "batch.h"
#include "console.h"
#include "file_io.h"
#include "journal.h"
#include "json.h"
#include "output.h"
#include "report.h"
#include "sandbox_start.h"
#include "writer.h"

enum { LINES = 20 }; // the maximum number of lines for failures and for shards

// --- the sum

struct times {
    double total_ms, median_ms, percent_90_ms, percent_99_ms, longest_ms;
    const struct journal_entry *longest; // NULL if no picture is written
};

static int by_ms(const void *a, const void *b)
{
    float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

static bool sum_times(const struct journal_sum *sum, struct times *times, lam_error *error)
{
    float *list = calloc(sum->written + 1, sizeof *list);
    size_t count = 0;
    if (!list)
        return complain(error, LAM_MACHINE, "out of memory");
    for (size_t i = 0; i < sum->count; i++) {
        const struct journal_entry *entry = &sum->entries[i];
        if (entry->ms <= 0)
            continue;
        list[count++] = entry->ms;
        times->total_ms += (double)entry->ms;
        if (!times->longest || entry->ms > times->longest->ms)
            times->longest = entry;
    }
    qsort(list, count, sizeof *list, by_ms);
    if (count) {
        times->median_ms = (double)list[count / 2];
        times->percent_90_ms = (double)list[count * 9 / 10];
        times->percent_99_ms = (double)list[count * 99 / 100];
        times->longest_ms = (double)list[count - 1];
    }
    free(list);
    return true;
}

// Counts the failures by class, as a batch does.
static bool sum_classes(const struct journal_sum *sum, struct batch_tally *tally, lam_error *error)
{
    tally->written = sum->written;
    tally->failed = sum->failed;
    for (int i = 0; i < sum->part_count; i++)
        tally->total += sum->parts[i].pictures;
    for (size_t i = 0; i < sum->count; i++) {
        if (sum->entries[i].ms > 0)
            continue;
        json_t *record = journal_sum_record(sum, i);
        batch_count_class(tally, exit_code_name(journal_value(record, "class").text));
        json_decref(record);
        if (!record)
            return complain(error, LAM_MACHINE, "out of memory");
    }
    return true;
}

// --- printed output

static void print_parts(const struct journal_sum *sum)
{
    int count = 0, missing = 0;
    for (int i = 0; i < sum->part_count; i++) {
        const struct journal_part *part = &sum->parts[i];
        if (!part->ended && count++ < LINES)
            printf("%s: the run has not ended: %zu of %zu pictures\n", part->path, part->written + part->failed,
                   part->pictures);
        if (part->build && sum->parts[0].build && strcmp(part->build, sum->parts[0].build) != 0 && !missing++)
            printf("%s and %s were written by different builds of lambent\n", sum->parts[0].path, part->path);
    }
    if (count > LINES)
        printf("and %d more runs have not ended\n", count - LINES);
    missing = 0;
    for (int k = 1; k <= sum->parts[0].shard.count; k++)
        if (!journal_sum_has_shard(sum, k) && missing++ < LINES)
            printf("shard %d/%d has no journal\n", k, sum->parts[0].shard.count);
    if (missing > LINES)
        printf("and %d more shards have none\n", missing - LINES);
    if (sum->first_double)
        printf("%zu picture%s in two journals: %s\n", sum->doubles, sum->doubles == 1 ? " is" : "s are",
               sum->first_double);
}

static void print_failures(const struct journal_sum *sum)
{
    size_t count = 0;
    for (size_t i = 0; i < sum->count && count < LINES; i++) {
        json_t *record = sum->entries[i].ms > 0 ? NULL : journal_sum_record(sum, i);
        if (record) {
            print_foreign(stdout, FOREIGN_TERMINAL, journal_value(record, "error"));
            putchar('\n');
            count++;
        }
        json_decref(record);
    }
    if (sum->failed > count)
        printf("and %zu more have failed\n", sum->failed - count);
}

static void print_sum(const struct journal_sum *sum, const struct batch_tally *tally, const struct times *times)
{
    printf("%zu of %zu pictures written", tally->written, tally->total);
    if (tally->failed)
        printf(", %zu failed", tally->failed);
    const char *between = " (";
    for (int i = 0; i < TALLY_CLASSES && tally->classes[i].name; i++, between = ", ")
        printf("%s%s %zu", between, tally->classes[i].name, tally->classes[i].count);
    printf("%s; %d journal%s", tally->failed ? ")" : "", sum->part_count, sum->part_count == 1 ? "" : "s");
    if (times->longest) {
        json_t *record = journal_sum_record(sum, (size_t)(times->longest - sum->entries));
        printf("; %.4g s of work; a picture: median %.4g ms, 90 %% below %.4g, 99 %% below %.4g, longest %.4g (",
               times->total_ms / 1e3, times->median_ms, times->percent_90_ms, times->percent_99_ms, times->longest_ms);
        print_foreign(stdout, FOREIGN_TERMINAL, journal_value(record, "model"));
        putchar(')');
        json_decref(record);
    }
    printf("\n");
}

static void print_json(const struct journal_sum *sum, const struct batch_tally *tally, const struct times *times)
{
    struct json json = {.file = stdout};
    json_open(&json, NULL, '{');
    json_put(&json, FLAG("whole", journal_sum_is_whole(sum)), COUNT("pictures", tally->total),
             COUNT("written", tally->written), COUNT("failed", tally->failed));
    json_open(&json, "classes", '{');
    for (int i = 0; i < TALLY_CLASSES && tally->classes[i].name; i++)
        json_put(&json, COUNT(tally->classes[i].name, tally->classes[i].count));
    json_close(&json, '}');
    json_put(&json, COUNT("in_two_journals", sum->doubles),
             OBJECT("times_ms", NUMBER("total", times->total_ms), NUMBER("median", times->median_ms),
                    NUMBER("percent_90", times->percent_90_ms), NUMBER("percent_99", times->percent_99_ms),
                    NUMBER("longest", times->longest_ms)),
             COUNT("shards", sum->parts[0].shard.count));
    json_open(&json, "missing_shards", '[');
    for (int k = 1; k <= sum->parts[0].shard.count; k++)
        if (!journal_sum_has_shard(sum, k))
            json_put(&json, COUNT(NULL, k));
    json_close(&json, ']');
    json_open(&json, "journals", '[');
    for (int i = 0; i < sum->part_count; i++) {
        const struct journal_part *part = &sum->parts[i];
        json_open(&json, NULL, '{');
        json_text(&json, "path", part->path);
        if (part->shard.count)
            json_put(&json, COUNT("shard", part->shard.number));
        json_put(&json, COUNT("pictures", part->pictures), COUNT("written", part->written),
                 COUNT("failed", part->failed), FLAG("ended", part->ended), TEXT("build", part->build));
        json_close(&json, '}');
    }
    json_close(&json, ']');
    json_close(&json, '}');
    putc('\n', stdout);
}

// --- written files

// Writes a line that names the folder of the pictures in the next lines. `line` is the journal line that names the
// folder.
static void write_folder(FILE *out, const char *line)
{
    json_t *run = json_loadb(line, strcspn(line, "\n"), 0, NULL), *folder = json_object_get(run, "folder");
    json_t *own = folder ? json_pack("{s:O}", "folder", folder) : NULL;
    char *text = own ? journal_line(own) : NULL;
    fputs(text ? text : "", out);
    free(text);
    json_decref(own);
    json_decref(run);
}

// Writes one journal with the latest line for each picture, as a run without shards would write it.
static bool write_merged(const struct journal_sum *sum, size_t pictures, const char *path, lam_error *error)
{
    char *text = NULL;
    size_t size = 0;
    bool standard = strcmp(path, "-") == 0;
    FILE *out = standard ? stdout : open_memstream(&text, &size);
    json_t *run = json_pack("{s:s, s:s*, s:s, s:I}", "lambent", lam_version(), "build", sum->parts[0].build, "options",
                            sum->parts[0].options, "pictures", (json_int_t)pictures);
    char *line = run ? journal_line(run) : NULL;
    bool ok = out && line;
    if (ok)
        fputs(line, out);
    for (size_t i = 0; ok && i < sum->count; i++) {
        if (sum->entries[i].folder && (i == 0 || sum->entries[i].folder != sum->entries[i - 1].folder))
            write_folder(out, sum->entries[i].folder);
        fwrite(sum->entries[i].line, 1, sum->entries[i].length, out);
        putc('\n', out);
    }
    if (ok && journal_sum_is_whole(sum))
        fprintf(out, "{\"ended\":true,\"exit\":%d}\n", journal_sum_exit(sum));
    if (out && !standard)
        ok = fclose(out) == 0 && ok;
    ok = ok || complain(error, LAM_MACHINE, "out of memory");
    ok = ok && (standard || writer_save(path, &(lam_bytes){text, size}, false, error));
    json_decref(run);
    free(line);
    free(text);
    return ok;
}

static json_t *record_of(void *user, size_t picture) { return journal_sum_record(user, picture); }

static bool write_page(struct journal_sum *sum, const struct batch_tally *tally, const char *path, lam_error *error)
{
    for (size_t i = 0; i < sum->count; i++) {
        json_t *record = sum->entries[i].ms > 0 ? journal_sum_record(sum, i) : NULL;
        char *output = record ? batch_page_output(path, false, record) : NULL;
        if (output)
            batch_page_thumbnail(path, output, false);
        free(output);
        json_decref(record);
    }
    struct batch_page page = {
        .path = path, .tally = tally, .record = record_of, .user = sum, .record_count = sum->count};
    return batch_page_write(&page, error);
}

// Decides whether the command may write a file in its sandbox. The journals may be untrusted, and they name the
// pictures from which the command makes thumbnails.
static enum writer_right right_of(void *user, const char *path)
{
    const char *page = user;
    return strcmp(path, page) == 0               ? WRITER_ANY
           : batch_page_is_thumbnail(page, path) ? WRITER_NEW_OR_OURS
                                                 : WRITER_NONE;
}

static bool enter_sandbox(const struct options *o, lam_error *error)
{
    struct sandbox_paths paths = {.may_write = right_of, .user = (void *)(uintptr_t)o->batch.report_page};
    sandbox_add(&paths, "/", SANDBOX_READ);
    sandbox_add(&paths, o->batch.report_page, SANDBOX_MAKE);
    return sandbox_start(o, &paths, error);
}

// --- the command

static bool add_all(struct journal_sum *sum, int count, char **operands, lam_error *error)
{
    for (int i = 0; i < count; i++)
        if (!(path_is_folder(operands[i]) ? journal_sum_add_folder : journal_sum_add)(sum, operands[i], error))
            return false;
    return true;
}

int run_journal(int operand_count, char **operands, const struct options *o)
{
    lam_error error = {0};
    struct journal_sum sum = {0};
    struct batch_tally tally = {0};
    struct times times = {0};
    bool merges = o->picture.output, to_standard = merges && strcmp(o->picture.output, "-") == 0;
    bool ok = !(to_standard && o->report.json) ||
              complain(&error, LAM_BAD_ARGUMENT, "options '--json' and '-o -' both write to standard output");
    ok = ok && add_all(&sum, operand_count, operands, &error) && sum_classes(&sum, &tally, &error) &&
         sum_times(&sum, &times, &error);
    ok = ok && (!merges || write_merged(&sum, tally.total, o->picture.output, &error));
    ok = ok && (!o->batch.report_page ||
                (enter_sandbox(o, &error) && write_page(&sum, &tally, o->batch.report_page, &error)));
    if (ok && o->report.json) {
        print_json(&sum, &tally, &times);
    } else if (ok && !o->report.quiet && !to_standard) {
        print_parts(&sum);
        print_failures(&sum);
        print_sum(&sum, &tally, &times);
    }
    int code = !ok ? report_failure(&error, o) : journal_sum_exit(&sum);
    journal_sum_free(&sum);
    return code;
}
