// journal.c: reads and writes journals: files with one JSON line for each finished or failed picture.
#include "journal.h"

#include <errno.h>
#include <fcntl.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <lambent/path.h>

#include "console.h"
#include "file_io.h"
#include "host_name.h"
#include "interrupt.h"
#include "output.h"
#include "progress.h"
#include "writer.h"
#include "xxh64.h"

enum { SLOT = 8192 };

// The journal's latest line for a picture.
struct entry {
    uint64_t output;  // the hash of the picture's path
    const char *line; // NULL if the entry is free
};

struct journal {
    char *path, *running_path;
    char *folder; // journal_run.folder
    enum journal_way way;
    int file, running;
    char *text; // the contents when the journal was opened; each line ends with a zero byte
    struct entry *entries;
    size_t capacity; // a power of 2
    size_t count;
    char *was_running; // slots of the previous run
    size_t was_slots;
    bool torn;  // the last line is incomplete
    bool begun; // FILE.running contains the slots of this run
};

char *journal_text(const char *text)
{
    char *out = malloc(5 * strlen(text) + 1), *to = out;
    while (out && *text) {
        int length = lam_utf8_length(text, strnlen(text, 4));
        if (length) {
            memcpy(to, text, (size_t)length);
            to += length;
            text += length;
        } else {
            to += sprintf(to, "\xEF\xBF\xBD%02X", (unsigned char)*text);
            text++;
        }
    }
    if (out)
        *to = 0;
    return out;
}

char *journal_path(const char *text)
{
    static const char digits[] = "0123456789ABCDEF";
    char *out = malloc(strlen(text) + 1), *to = out;
    while (out && *text) {
        const char *high = strncmp(text, "\xEF\xBF\xBD", 3) == 0 && text[3] ? strchr(digits, text[3]) : NULL;
        const char *low = high && text[4] ? strchr(digits, text[4]) : NULL;
        *to++ = low ? (char)(16 * (high - digits) + (low - digits)) : *text;
        text += low ? 5 : 1;
    }
    if (out)
        *to = 0;
    return out;
}

// Returns a hash that identifies a picture by its path. If `folder` is not NULL, the path begins with `folder`, and the
// hash ignores this prefix: the folder may be absolute in one run and relative in the next.
static uint64_t hash_of(const char *folder, const char *output)
{
    struct xxh64 hash;
    xxh64_start(&hash);
    if (folder)
        xxh64_add_text(&hash, "");
    xxh64_add_text(&hash, output + (folder ? strlen(folder) : 0));
    return xxh64_end(&hash);
}

static bool is_below(const char *folder, const char *output)
{
    return folder && strncmp(output, folder, strlen(folder)) == 0;
}

// --- reading

static struct entry *find_entry(const struct journal *j, uint64_t output)
{
    size_t at = output & (j->capacity - 1);
    while (j->entries[at].line && j->entries[at].output != output)
        at = (at + 1) & (j->capacity - 1);
    return &j->entries[at];
}

static bool keep_line(struct journal *j, uint64_t output, const char *line)
{
    if (2 * (j->count + 1) > j->capacity) {
        struct journal larger = *j;
        larger.capacity = j->capacity ? 2 * j->capacity : 1024;
        larger.entries = calloc(larger.capacity, sizeof *larger.entries);
        if (!larger.entries)
            return false;
        for (size_t i = 0; i < j->capacity; i++)
            if (j->entries[i].line)
                *find_entry(&larger, j->entries[i].output) = j->entries[i];
        free(j->entries);
        *j = larger;
    }
    struct entry *entry = find_entry(j, output);
    j->count += !entry->line;
    *entry = (struct entry){output, line};
    return true;
}

char *journal_read(const char *path, size_t *size)
{
    struct stat about;
    int file = lam_path_open(path, O_RDONLY | O_CLOEXEC);
    char *text = file >= 0 && fstat(file, &about) == 0 ? malloc((size_t)about.st_size + 1) : NULL;
    *size = 0;
    bool whole = text && read_up_to(file, text, (size_t)about.st_size, size);
    int reason = errno;
    if (file >= 0)
        close(file);
    if (whole) {
        text[*size] = 0;
    } else {
        free(text);
        text = NULL;
    }
    errno = file < 0 && reason == ENOENT ? 0 : reason;
    return text;
}

// Returns the options of a line that begins a run, or NULL for other lines.
static const char *options_of(const json_t *line) { return json_string_value(json_object_get(line, "options")); }

// Parses the lines. Ignores lines that are not JSON. Such a line was truncated, or it was written after a truncated
// line.
static bool read_lines(struct journal *j, size_t size, const char **options, json_t **last_run, lam_error *error)
{
    json_t *folder = NULL; // the folder in the latest line that names a folder
    bool ok = true;
    *options = NULL; // the options of the latest run
    j->torn = size && j->text[size - 1] != '\n';
    for (char *line = j->text, *end; ok && (end = memchr(line, '\n', size - (size_t)(line - j->text)));
         line = end + 1) {
        *end = 0;
        json_t *record = json_loads(line, 0, NULL), *named = json_object_get(record, "folder");
        const char *output = json_string_value(json_object_get(record, "output")), *below = json_string_value(folder);
        ok = !output || (keep_line(j, hash_of(NULL, output), line) &&
                         (!is_below(below, output) || keep_line(j, hash_of(below, output), line)));
        if (record && options_of(record)) {
            json_decref(*last_run);
            *last_run = json_incref(record);
            *options = options_of(record);
        }
        if (json_is_string(named)) {
            json_decref(folder);
            folder = json_incref(named);
        }
        json_decref(record);
    }
    json_decref(folder);
    return ok || complain(error, LAM_MACHINE, "out of memory");
}

// --- opening

// Writes the line that begins a run.
static bool begin_run(struct journal *j, const struct journal_run *about, lam_error *error)
{
    char *clean = journal_text(about->options);
    json_t *run = clean ? json_pack("{s:s, s:s, s:s, s:s, s:s*, s:I}", "lambent", lam_version(), "build",
                                    lam_build_info(), "options", clean, "folder", j->folder, "shard", about->shard,
                                    "pictures", (json_int_t)about->pictures)
                        : NULL;
    bool ok = run || complain(error, LAM_MACHINE, "out of memory");
    ok = ok && journal_add(j, run, error);
    json_decref(run);
    free(clean);
    return ok;
}

static bool check_options(const char *path, const char *then, const char *options, lam_error *error)
{
    char *now = journal_text(options), difference[300];
    if (!now)
        return complain(error, LAM_MACHINE, "out of memory");
    bool same = strcmp(then, now) == 0;
    if (!same)
        batch_options_difference(then, now, difference);
    free(now);
    return same || complain(error, LAM_BAD_ARGUMENT,
                            "option '--resume': the journal %.100s was written with other options: %.300s; without "
                            "--resume, lambent draws everything again",
                            path, difference);
}

// Continues an existing journal.
static bool read_journal(struct journal *j, enum journal_way way, const char *options, lam_error *error)
{
    size_t size;
    const char *then;
    json_t *run = NULL;
    j->text = journal_read(j->path, &size);
    if (!j->text)
        return errno == 0 ||
               complain(error, LAM_CANNOT_READ, "%s: cannot read the journal: %s", j->path, strerror(errno));
    bool ok = read_lines(j, size, &then, &run, error);
    if (ok && size && !then)
        ok = complain(error, LAM_BAD_ARGUMENT, "%s: expected a journal of lambent, found another file", j->path);
    if (ok && then && way == JOURNAL_RESUME)
        ok = check_options(j->path, then, options, error);
    json_decref(run);
    return ok;
}

// Renames an existing journal. Fails if the file is not a journal.
static bool set_aside(const struct journal *j, lam_error *error)
{
    char *before = NULL, head[64] = "";
    struct stat about;
    if (stat(j->path, &about) != 0)
        return true;
    FILE *file = fopen(j->path, "r");
    bool ours = about.st_size == 0 || (file && fgets(head, sizeof head, file) && strstr(head, "\"lambent\""));
    if (file)
        fclose(file);
    if (!ours)
        return complain(error, LAM_BAD_ARGUMENT, "%s: expected a journal of lambent, found another file", j->path);
    bool ok = asprintf(&before, "%s.before", j->path) >= 0 || complain(error, LAM_MACHINE, "out of memory");
    ok = ok && (rename(j->path, before) == 0 ||
                complain(error, LAM_CANNOT_WRITE, "%s: cannot rename to %s: %s", j->path, before, strerror(errno)));
    if (ok)
        free(before);
    return ok;
}

static bool wait_for_lock(int file, double until_ms)
{
    for (; clock_ms() < until_ms; nanosleep(&(struct timespec){.tv_nsec = 10000000}, NULL)) {
        if (flock(file, LOCK_EX | LOCK_NB) == 0)
            return true;
        if (errno == ENOLCK || errno == ENOSYS || errno == EOPNOTSUPP) { // some network file systems
            say_warning("the file system of the journal has no locks; only one run at a time may write this journal");
            return true;
        }
        if ((errno != EWOULDBLOCK && errno != EINTR) || interrupted())
            return false;
    }
    errno = EWOULDBLOCK;
    return false;
}

// Locks FILE.running, so that only one run at a time writes the journal. The processes of a killed run keep the lock
// until they end, so this function waits up to two seconds. If the other run ends and removes the file, a new file is
// created and locked.
static bool lock_running(struct journal *j, lam_error *error)
{
    const double until_ms = clock_ms() + 2000;
    struct stat about = {0};
    while (about.st_nlink == 0) {
        if (j->running >= 0)
            close(j->running);
        j->running = lam_path_open(j->running_path, O_RDWR | O_CREAT | O_CLOEXEC);
        if (j->running < 0)
            return complain(error, LAM_CANNOT_WRITE, "%s: cannot write: %s", j->running_path, strerror(errno));
        if (!wait_for_lock(j->running, until_ms))
            return errno == EWOULDBLOCK
                       ? complain(error, LAM_CANNOT_WRITE, "%s: the journal is in use by another run", j->path)
                       : complain(error, LAM_CANNOT_WRITE, "%s: cannot lock: %s", j->running_path, strerror(errno));
        if (fstat(j->running, &about) != 0)
            return complain(error, LAM_CANNOT_WRITE, "%s: cannot lock: %s", j->running_path, strerror(errno));
    }
    return true;
}

static bool open_running(struct journal *j, lam_error *error)
{
    if (!lock_running(j, error))
        return false;
    size_t size;
    j->was_running = journal_read(j->running_path, &size);
    if (!j->was_running)
        return complain(error, LAM_CANNOT_READ, "%s: cannot read: %s", j->running_path, strerror(errno));
    j->was_slots = j->was_running ? size / SLOT : 0;
    return true;
}

// Replaces the slots of the previous run with empty slots for this run. Called last, so that the previous slots remain
// if this run cannot begin.
static bool take_over_running(struct journal *j, int slots, lam_error *error)
{
    j->begun = ftruncate(j->running, 0) == 0 && ftruncate(j->running, (off_t)slots * SLOT) == 0;
    return j->begun || complain(error, LAM_CANNOT_WRITE, "%s: cannot write: %s", j->running_path, strerror(errno));
}

struct journal *journal_open(const char *path, enum journal_way way, const struct journal_run *run, int slots,
                             lam_error *error)
{
    struct journal *j = calloc(1, sizeof *j);
    if (j)
        *j = (struct journal){
            .path = strdup(path), .folder = journal_text(run->folder), .way = way, .file = -1, .running = -1};
    bool ok = j && j->path && j->folder && asprintf(&j->running_path, "%s.running", path) >= 0;
    if (!ok)
        complain(error, LAM_MACHINE, "out of memory");
    struct stat there;
    if (ok && lstat(path, &there) == 0 && !S_ISREG(there.st_mode) && !S_ISLNK(there.st_mode))
        ok =
            complain(error, LAM_CANNOT_WRITE,
                     "%s: cannot write: found a folder, pipe or device, expected a regular file for the journal", path);
    ok = ok && output_make_folder(path, error) && open_running(j, error) &&
         (way == JOURNAL_START ? set_aside(j, error) : read_journal(j, way, run->options, error));
    if (ok) {
        j->file = lam_path_open(path, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC);
        ok = j->file >= 0 || complain(error, LAM_CANNOT_WRITE, "%s: cannot write: %s", path, strerror(errno));
    }
    // Adds a line end to a truncated line, so that the next record begins on a new line.
    ok = ok && (!j->torn || write_all(j->file, "\n", 1) ||
                complain(error, LAM_CANNOT_WRITE, "%s: cannot write: %s", path, strerror(errno)));
    ok = ok && begin_run(j, run, error) && take_over_running(j, slots, error);
    if (ok)
        return j;
    journal_close(j, false, 0, false);
    return NULL;
}

// --- records

json_t *journal_find(const struct journal *j, const char *output)
{
    char *clean = j->count ? journal_text(output) : NULL;
    const struct entry *entry = clean ? find_entry(j, hash_of(NULL, clean)) : NULL;
    // --skip-same checks the contents of all files, so it accepts a line for the same picture in another folder.
    // --resume trusts the line, so the line must be for the same path.
    if (entry && !entry->line && j->way == JOURNAL_SAME && is_below(j->folder, clean))
        entry = find_entry(j, hash_of(j->folder, clean));
    json_t *record = entry && entry->line ? json_loads(entry->line, 0, NULL) : NULL;
    free(clean);
    return record;
}

struct foreign journal_value(const json_t *record, const char *key)
{
    const char *text = json_string_value(json_object_get(record, key));
    return FOREIGN(text ? text : "");
}

void journal_set_text(json_t *record, const char *key, const char *text)
{
    char *clean = text ? journal_text(text) : NULL;
    json_object_set_new(record, key, clean ? json_string(clean) : json_null());
    free(clean);
}

char *journal_line(const json_t *record)
{
    char *text = json_dumps(record, JSON_COMPACT | JSON_REAL_PRECISION(9)), *line = NULL;
    if (!text || asprintf(&line, "%s\n", text) < 0)
        line = NULL;
    free(text);
    return line;
}

bool journal_add(struct journal *j, const json_t *record, lam_error *error)
{
    char *line = journal_line(record);
    if (!line)
        return complain(error, LAM_MACHINE, "out of memory");
    bool ok = write_all(j->file, line, strlen(line)) ||
              complain(error, LAM_CANNOT_WRITE, "%s: cannot write: %s", j->path, strerror(errno));
    free(line);
    return ok;
}

// --- models in progress

// A slot of FILE.running.
struct slot {
    int process;
    char host[HOST_SIZE];
    char model[SLOT - sizeof(int) - HOST_SIZE]; // "" if the slot is free
};

const char *journal_running_path(const struct journal *j) { return j->running_path; }

void journal_begin(struct journal *j, int slot, int process, const char *model)
{
    struct slot text = {.process = process};
    size_t length = model ? strlen(model) : 0;
    if (length < sizeof text.model) // longer paths cannot be opened
        memcpy(text.model, model ? model : "", length);
    else
        length = 0;
    host_name(text.host);
    // A failed write is harmless. If this run is killed, --resume draws this model with the others instead of first.
    if (pwrite(j->running, &text, offsetof(struct slot, model) + length + 1, (off_t)slot * SLOT) < 0)
        return;
}

void journal_each_running(const struct journal *j,
                          void (*visit)(void *user, const char *model, int process, const char *host), void *user)
{
    for (size_t i = 0; i < j->was_slots; i++) {
        struct slot slot;
        memcpy(&slot, j->was_running + i * SLOT, sizeof slot);
        if (*slot.model && memchr(slot.model, 0, sizeof slot.model) && memchr(slot.host, 0, sizeof slot.host))
            visit(user, slot.model, slot.process, slot.host);
    }
}

// Writes the line that ends a run. If writing fails, the run looks as if it had been killed just before its end.
static void end_run(struct journal *j, bool done, int exit)
{
    lam_error error;
    json_t *ended = json_pack("{s:b, s:i}", "ended", done, "exit", exit);
    if (ended)
        journal_add(j, ended, &error);
    json_decref(ended);
}

void journal_close(struct journal *j, bool done, int exit, bool interrupted)
{
    if (!j)
        return;
    if (j->begun && !interrupted)
        end_run(j, done, exit);
    if (j->file >= 0)
        close(j->file);
    if (j->was_running &&
        (j->begun ? !interrupted : !j->was_slots)) // this run holds the lock, and no later run needs the file
        writer_remove(j->running_path);
    if (j->running >= 0)
        close(j->running);
    free(j->path);
    free(j->running_path);
    free(j->folder);
    free(j->text);
    free(j->entries);
    free(j->was_running);
    free(j);
}
