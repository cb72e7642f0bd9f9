// journal_sum.c: combines several journals of one batch.
//
// Keeps the text of the journals and 40 bytes per picture, but no parsed JSON, because a journal may list a million
// pictures.
#include "journal.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "console.h"
#include "xxh64.h"

// --- the table of pictures

static size_t *find_slot(const struct journal_sum *s, uint64_t output)
{
    size_t at = output & (s->slot_count - 1);
    while (s->slots[at] && s->entries[s->slots[at] - 1].output != output)
        at = (at + 1) & (s->slot_count - 1);
    return &s->slots[at];
}

static bool make_room(struct journal_sum *s)
{
    if (s->count == s->capacity) {
        size_t capacity = s->capacity ? 2 * s->capacity : 1024;
        struct journal_entry *more = realloc(s->entries, capacity * sizeof *more);
        if (!more)
            return false;
        s->entries = more;
        s->capacity = capacity;
    }
    if (2 * (s->count + 1) <= s->slot_count)
        return true;
    size_t count = s->slot_count ? 2 * s->slot_count : 2048;
    size_t *slots = calloc(count, sizeof *slots);
    if (!slots)
        return false;
    free(s->slots);
    s->slots = slots;
    s->slot_count = count;
    for (size_t i = 0; i < s->count; i++)
        *find_slot(s, s->entries[i].output) = i + 1;
    return true;
}

static void note_double(struct journal_sum *s, const char *output, int a, int b)
{
    if (!s->doubles++ &&
        asprintf(&s->first_double, "%s is in %s and in %s", output, s->parts[a].path, s->parts[b].path) < 0)
        s->first_double = NULL;
}

static void count(struct journal_sum *s, const struct journal_entry *entry, int by)
{
    struct journal_part *part = &s->parts[entry->part];
    *(entry->ms > 0 ? &s->written : &s->failed) += (size_t)by;
    *(entry->ms > 0 ? &part->written : &part->failed) += (size_t)by;
}

static bool add_picture(struct journal_sum *s, const json_t *record, const char *output, struct journal_entry entry,
                        lam_error *error)
{
    if (!make_room(s))
        return complain(error, LAM_MACHINE, "out of memory");
    struct xxh64 hash;
    xxh64_start(&hash);
    xxh64_add_text(&hash, output);
    entry.output = xxh64_end(&hash);
    const char *class = json_string_value(json_object_get(record, "class"));
    double ms = json_number_value(json_object_get(json_object_get(record, "times_ms"), "total"));
    entry.ms = class && strcmp(class, "ok") == 0 ? ms > 1e-3 ? (float)ms : 1e-3f : 0;
    size_t *slot = find_slot(s, entry.output);
    if (*slot) {
        struct journal_entry *before = &s->entries[*slot - 1];
        if (before->part != entry.part)
            note_double(s, output, before->part, entry.part);
        count(s, before, -1);
        *before = entry;
    } else {
        s->entries[s->count++] = entry;
        *slot = s->count;
    }
    count(s, &entry, 1);
    return true;
}

// --- a journal

static char *text_of(const json_t *record, const char *key)
{
    const char *text = json_string_value(json_object_get(record, key));
    return text ? strdup(text) : NULL;
}

static void begin_run(struct journal_part *part, const json_t *record)
{
    const char *shard = json_string_value(json_object_get(record, "shard"));
    lam_error error;
    free(part->options);
    free(part->build);
    part->options = text_of(record, "options");
    part->build = text_of(record, "build");
    part->pictures = (size_t)json_integer_value(json_object_get(record, "pictures"));
    part->shard = (struct batch_shard){0};
    if (shard)
        batch_shard_of(shard, &part->shard, &error); // cannot fail: only Lambent writes journals
    part->ended = false;
    part->exit = -1;
}

// Ignores lines that are not JSON: the last line of a killed run may be truncated. The next run redraws the picture of
// this line.
static bool read_lines(struct journal_sum *s, int number, lam_error *error)
{
    const char *line = s->parts[number].text, *last = line + s->parts[number].size, *end, *folder = NULL;
    bool ok = true;
    for (; ok && line < last && (end = memchr(line, '\n', (size_t)(last - line))); line = end + 1) {
        json_t *record = json_loadb(line, (size_t)(end - line), 0, NULL);
        const char *output = json_string_value(json_object_get(record, "output"));
        struct journal_entry entry = {.line = line, .length = (size_t)(end - line), .folder = folder, .part = number};
        if (json_object_get(record, "folder"))
            folder = line;
        if (output)
            ok = add_picture(s, record, output, entry, error);
        else if (json_is_string(json_object_get(record, "options")))
            begin_run(&s->parts[number], record);
        else if (json_is_boolean(json_object_get(record, "ended"))) {
            const json_t *exit = json_object_get(record, "exit");
            s->parts[number].ended = json_is_true(json_object_get(record, "ended"));
            s->parts[number].exit = json_is_integer(exit) ? (int)json_integer_value(exit) : -1;
        }
        json_decref(record);
    }
    return ok;
}

static bool check_together(const struct journal_part *a, const struct journal_part *b, lam_error *error)
{
    char difference[300];
    if (!b->options)
        return complain(error, LAM_BAD_ARGUMENT, "%s: expected a journal of lambent, found another file", b->path);
    if (a == b)
        return true;
    if (a->shard.count != b->shard.count)
        return complain(error, LAM_BAD_ARGUMENT, "%.200s and %.200s belong to different batches: %d shards, and %d",
                        a->path, b->path, a->shard.count, b->shard.count);
    if (!a->shard.count || a->shard.number == b->shard.number)
        return complain(error, LAM_BAD_ARGUMENT,
                        "%.200s and %.200s belong to %s; expected different shards of one batch", a->path, b->path,
                        a->shard.count ? "the same shard" : "two batches");
    if (strcmp(a->options, b->options) == 0)
        return true;
    batch_options_difference(a->options, b->options, difference);
    return complain(error, LAM_BAD_ARGUMENT, "%.100s and %.100s were written with different options: %.300s", a->path,
                    b->path, difference);
}

int journal_sum_exit(const struct journal_sum *s)
{
    int code = journal_sum_is_whole(s) ? 0 : EXIT_SOME_FAILED;
    for (int i = 0; i < s->part_count; i++) {
        int exit = s->parts[i].exit;
        if (exit > 0 && exit != EXIT_SOME_FAILED)
            return exit;
        code = exit == EXIT_SOME_FAILED || (exit < 0 && s->parts[i].failed) ? EXIT_SOME_FAILED : code;
    }
    return code;
}

bool journal_sum_add(struct journal_sum *s, const char *path, lam_error *error)
{
    struct journal_part *more = realloc(s->parts, ((size_t)s->part_count + 1) * sizeof *more);
    if (!more)
        return complain(error, LAM_MACHINE, "out of memory");
    s->parts = more;
    struct journal_part *part = &s->parts[s->part_count++];
    *part = (struct journal_part){.path = strdup(path)};
    part->text = part->path ? journal_read(path, &part->size) : NULL;
    if (!part->path || (!part->text && errno == ENOMEM))
        return complain(error, LAM_MACHINE, "out of memory");
    if (!part->text)
        return complain(error, LAM_CANNOT_READ, "%s: cannot read the journal: %s", path,
                        strerror(errno ? errno : ENOENT));
    return read_lines(s, s->part_count - 1, error) && check_together(&s->parts[0], &s->parts[s->part_count - 1], error);
}

static int is_whole_journal(const struct dirent *entry) { return strcmp(entry->d_name, "lambent.jsonl") == 0; }

static int is_shard_journal(const struct dirent *entry)
{
    const char *name = entry->d_name;
    size_t length = strlen(name);
    return strncmp(name, "lambent-", 8) == 0 && strcmp(name + length - 6, ".jsonl") == 0 && batch_shard_count_of(name);
}

bool journal_sum_add_folder(struct journal_sum *s, const char *folder, lam_error *error)
{
    struct dirent **names;
    int count = scandir(folder, &names, is_shard_journal, alphasort);
    if (count == 0) {
        free(names);
        count = scandir(folder, &names, is_whole_journal, alphasort);
    }
    if (count < 0)
        return complain(error, LAM_CANNOT_READ, "%s: cannot read the folder: %s", folder, strerror(errno));
    bool ok =
        count > 0 || complain(error, LAM_CANNOT_READ, "%s: found no journal in the folder (lambent.jsonl)", folder);
    for (int i = 0; i < count; i++) {
        char *path = NULL;
        if (ok &&
            asprintf(&path, "%s%s%s", folder, folder[strlen(folder) - 1] == '/' ? "" : "/", names[i]->d_name) < 0) {
            path = NULL;
            ok = complain(error, LAM_MACHINE, "out of memory");
        }
        ok = ok && journal_sum_add(s, path, error);
        free(path);
        free(names[i]);
    }
    free(names);
    return ok;
}

json_t *journal_sum_record(const struct journal_sum *s, size_t entry)
{
    return json_loadb(s->entries[entry].line, s->entries[entry].length, 0, NULL);
}

bool journal_sum_has_shard(const struct journal_sum *s, int number)
{
    int i = 0;
    while (i < s->part_count && s->parts[i].shard.number != number)
        i++;
    return i < s->part_count;
}

bool journal_sum_is_whole(const struct journal_sum *s)
{
    bool whole = s->part_count && !s->doubles && (!s->parts[0].shard.count || s->part_count == s->parts[0].shard.count);
    for (int i = 0; whole && i < s->part_count; i++)
        whole = s->parts[i].ended;
    return whole;
}

void journal_sum_free(struct journal_sum *s)
{
    for (int i = 0; i < s->part_count; i++) {
        free(s->parts[i].path);
        free(s->parts[i].build);
        free(s->parts[i].options);
        free(s->parts[i].text);
    }
    free(s->parts);
    free(s->entries);
    free(s->slots);
    free(s->first_double);
    *s = (struct journal_sum){0};
}
