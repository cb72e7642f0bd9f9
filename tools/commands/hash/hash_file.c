// hash_file.c: reads and writes hash files.
#include "hash.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <lambent/lambent.h>
#include <lambent/path.h>

#include "console.h"
#include "file_io.h"
#include "xxh64.h"

static const char first_line[] = "lambent hashes 1";

void hash_file_free(struct hash_file *file)
{
    for (size_t i = 0; i < file->count; i++)
        free(file->entries[i].name);
    free(file->entries);
    free(file->version);
    free(file->options);
    *file = (struct hash_file){0};
}

static int by_name(const void *a, const void *b)
{
    return strcmp(((const struct hash_entry *)a)->name, ((const struct hash_entry *)b)->name);
}

void hash_file_sort(struct hash_file *file)
{
    if (file->count)
        qsort(file->entries, file->count, sizeof *file->entries, by_name);
}

const struct hash_entry *hash_file_find(const struct hash_file *file, const char *name)
{
    struct hash_entry key = {(char *)(uintptr_t)name, 0}; // bsearch does not modify the key
    return file->count ? bsearch(&key, file->entries, file->count, sizeof *file->entries, by_name) : NULL;
}

// --- reading

// Decodes the escape sequences of a name in place. Returns false if an escape sequence is unknown.
static bool unescape(char *name)
{
    char *to = name;
    for (const char *from = name; *from; from++) {
        char c = *from;
        if (c == '\\') {
            from++;
            if (*from != '\\' && *from != 'n' && *from != 'r')
                return false;
            c = *from;
            c = c == 'n' ? '\n' : c == 'r' ? '\r' : '\\';
        }
        *to++ = c;
    }
    *to = 0;
    return true;
}

// Reads "pixels:0123456789abcdef", the XXH64 of pixels. (Hashes of a file's bytes begin with "xxh64:" instead.)
static bool pixels_parse(const char *text, uint64_t *hash)
{
    char of_file[XXH64_TEXT];
    bool form = strncmp(text, "pixels:", 7) == 0;
    snprintf(of_file, sizeof of_file, "xxh64:%.17s", form ? text + 7 : "");
    return form && xxh64_parse(of_file, hash);
}

static bool add_line(struct hash_file *file, const char *path, int number, char *line, size_t *capacity,
                     lam_error *error)
{
    enum { HASH = sizeof "pixels:0123456789abcdef" - 1 };
    struct hash_entry entry = {0};
    bool form = strlen(line) > HASH + 2 && line[HASH] == ' ' && line[HASH + 1] == ' ';
    if (form)
        line[HASH] = 0;
    if (!form || !pixels_parse(line, &entry.hash) || !unescape(line + HASH + 2))
        return complain(error, LAM_CANNOT_READ,
                        "%.300s:%d: found '%.60s', expected a hash, two blanks and a name: "
                        "pixels:0123456789abcdef  models/koala.obj",
                        path, number, line);
    if (file->count == *capacity) {
        *capacity = *capacity ? 2 * *capacity : 64;
        struct hash_entry *more = realloc(file->entries, *capacity * sizeof *more);
        if (!more)
            return complain(error, LAM_MACHINE, "out of memory");
        file->entries = more;
    }
    entry.name = strdup(line + HASH + 2);
    if (!entry.name)
        return complain(error, LAM_MACHINE, "out of memory");
    file->entries[file->count++] = entry;
    return true;
}

// Parses a line of the header such as "version 0.9.0". Returns false for any other line.
static bool take_head(const char *line, const char *key, char **value)
{
    size_t length = strlen(key);
    if (strncmp(line, key, length) != 0 || (line[length] && line[length] != ' '))
        return false;
    *value = strdup(line[length] ? line + length + 1 : "");
    return true;
}

static bool read_lines(struct hash_file *file, FILE *in, const char *path, lam_error *error)
{
    char *line = NULL;
    size_t size = 0, capacity = 0;
    bool ok = true;
    int number = 1;
    for (ssize_t length; ok && (length = getline(&line, &size, in)) > 0; number++) {
        while (length && (line[length - 1] == '\n' || line[length - 1] == '\r'))
            line[--length] = 0;
        if (strlen(line) != (size_t)length)
            ok = complain(error, LAM_CANNOT_READ, "%.300s:%d: found a zero byte, expected text", path, number);
        else if (number == 1)
            ok = strcmp(line, first_line) == 0 ||
                 complain(error, LAM_CANNOT_READ, "%.300s: found '%.40s', expected '%s': a file of lambent hash", path,
                          line, first_line);
        else if (number == 2)
            ok = take_head(line, "version", &file->version) ||
                 complain(error, LAM_CANNOT_READ, "%.300s:2: found '%.60s', expected 'version' and a number", path,
                          line);
        else if (number == 3)
            ok = take_head(line, "options", &file->options) ||
                 complain(error, LAM_CANNOT_READ, "%.300s:3: found '%.60s', expected 'options' and a command line's",
                          path, line);
        else if (length)
            ok = add_line(file, path, number, line, &capacity, error);
    }
    if (ok && !feof(in)) // getline also fails if memory runs out
        ok = complain(error, errno == ENOMEM ? LAM_MACHINE : LAM_CANNOT_READ, "%.400s: cannot read: %s", path,
                      strerror(errno));
    if (ok && (!file->version || !file->options))
        ok = complain(error, number < 4 ? LAM_CANNOT_READ : LAM_LIMIT,
                      "%.300s: the file ends after line %d, expected "
                      "the lines 'version' and 'options'",
                      path, number - 1);
    free(line);
    return ok;
}

bool hash_file_read(struct hash_file *file, const char *path, lam_error *error)
{
    *file = (struct hash_file){0};
    struct stat about;
    int opened = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK |
                                O_NOCTTY); // O_NONBLOCK: opening a named pipe must not wait for its writer
    FILE *in = opened < 0 ? NULL : fdopen(opened, "r");
    if (!in)
        return complain(error, LAM_CANNOT_READ, "%.400s: cannot open: %s", path, strerror(errno));
    bool regular = fstat(opened, &about) == 0 && S_ISREG(about.st_mode), ok = regular && about.st_size <= HASH_FILE_MAX;
    if (!ok)
        complain(error, LAM_CANNOT_READ,
                 regular ? "%.400s: has more than %d MiB, which no file of hashes has"
                         : "%.400s: is not a regular file",
                 path, HASH_FILE_MAX >> 20);
    ok = ok && read_lines(file, in, path, error);
    fclose(in);
    hash_file_sort(file);
    for (size_t i = 1; ok && i < file->count; i++)
        if (strcmp(file->entries[i].name, file->entries[i - 1].name) == 0)
            ok = complain(error, LAM_CANNOT_READ, "%.300s: '%.100s' is listed twice", path, file->entries[i].name);
    return ok;
}

// --- writing

static void put_name(FILE *out, const char *name)
{
    for (; *name; name++)
        if (*name == '\\' || *name == '\n' || *name == '\r')
            fprintf(out, "\\%c", *name == '\n' ? 'n' : *name == '\r' ? 'r' : '\\');
        else
            putc(*name, out);
}

char *hash_file_text(const struct hash_file *file)
{
    char *text = NULL, hash[XXH64_TEXT];
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return NULL;
    fprintf(out, "%s\nversion %s\noptions%s%s\n", first_line, file->version, *file->options ? " " : "", file->options);
    for (size_t i = 0; i < file->count; i++) {
        xxh64_print(file->entries[i].hash, hash);
        fprintf(out, "pixels%s  ", strchr(hash, ':'));
        put_name(out, file->entries[i].name);
        putc('\n', out);
    }
    if (fclose(out) == 0)
        return text;
    free(text);
    return NULL;
}

// --- names

// Resolves the links in a path's folder, and returns the new path, allocated with malloc. The file itself may be a
// link. Returns the path unchanged if its folder does not exist.
static char *plain_path(const char *path)
{
    char *folder = output_folder_of(path), *real = folder ? realpath(folder, NULL) : NULL, *plain = NULL;
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    if (real && asprintf(&plain, "%s%s%s", real, strcmp(real, "/") == 0 ? "" : "/", name) < 0)
        plain = NULL;
    else if (folder && !real)
        plain = strdup(path);
    free(folder);
    free(real);
    return plain;
}

char *hash_file_name(const char *path, const char *model)
{
    if (lam_shape_find(model) >= 0)
        return strdup(model);
    char *file = plain_path(strcmp(path, "-") == 0 ? "./." : path), *full = plain_path(model), *name = NULL;
    size_t size = 0, common = 0;
    FILE *out = file && full ? open_memstream(&name, &size) : NULL;
    for (size_t i = 0; out && file[i] && file[i] == full[i]; i++)
        if (file[i] == '/')
            common = i + 1;
    for (const char *at = out ? file + common : ""; (at = strchr(at, '/')); at++)
        fputs("../", out);
    if (out) {
        fputs(full + common, out);
        if (fclose(out) != 0) {
            free(name);
            name = NULL;
        }
    }
    free(file);
    free(full);
    return name;
}

char *hash_file_model(const char *path, const char *name)
{
    const char *slash = strrchr(path, '/');
    char *model = NULL;
    if (lam_shape_find(name) >= 0 || name[0] == '/')
        return strdup(name);
    return asprintf(&model, "%.*s%s", slash ? (int)(slash - path) + 1 : 0, path, name) < 0 ? NULL : model;
}

bool hash_file_may_name(const char *path, const char *file, const struct options *options, lam_error *error)
{
    if (lam_shape_find(file) >= 0)
        return true;
    char *folder = output_folder_of(path);
    bool may = folder && lam_path_is_below(file, folder);
    for (int i = 0; i < options->limits.allow_paths.count; i++)
        may |= lam_path_is_below(file, options->limits.allow_paths.items[i]);
    struct stat about;
    may &= lam_path_stat(file, &about) == 0 || (errno != EXDEV && errno != EMLINK); // a missing file is allowed
    free(folder);
    return may || complain(error, LAM_CANNOT_READ,
                           "%.200s: names '%.200s', which is not below the folder of this file; --allow-path allows it",
                           path, file);
}
