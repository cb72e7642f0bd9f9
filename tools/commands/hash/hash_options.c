// hash_options.c: applies the options in a hash file unless the command line contains an option that changes the
// picture.
#include "hash.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "journal.h"
#include "command_table.h"
#include "console.h"
#include "environment_option.h"
#include "limit_options.h"

enum { WORDS_MAX = 512 };

// Splits a line into words at blanks outside single quotes, like a shell. \' means a quote. Modifies `text`.
static int split(char *text, char **words)
{
    int count = 0;
    char *to = text;
    for (const char *from = text; *from && count < WORDS_MAX;) {
        from += strspn(from, " ");
        if (!*from)
            break;
        words[count++] = to;
        for (bool quoted = false; *from && (quoted || *from != ' '); from++)
            if (*from == '\'')
                quoted = !quoted;
            else if (!quoted && *from == '\\' && from[1])
                *to++ = *++from;
            else
                *to++ = *from;
        from += *from == ' '; // skip the blank now, because `to` may overwrite it
        *to++ = 0;
    }
    return count;
}

// The picture options whose values are paths of files: one path for `look`, and one or six paths for the others. All
// options also accept built-in names.
static const char *const of_files[] = {"environment", "reflection-map", "look"};

// Writes the value of an option that of_files lists. `map` converts each path first.
static bool put_paths(FILE *out, const char *name, const char *value, const char *file,
                      char *(*map)(const char *file, const char *path))
{
    bool environment = strcmp(name, "look") != 0;
    if (environment ? environment_option_built_in(value) != NULL : look_find(value) != NULL)
        return fputs(value, out) >= 0;
    for (const char *from = value; from;) {
        size_t length = environment ? strcspn(from, ",") : strlen(from);
        char *one = strndup(from, length), *path = one ? map(file, one) : NULL;
        bool ok = path && fprintf(out, "%s%s", from == value ? "" : ",", path) >= 0;
        free(one);
        free(path);
        if (!ok)
            return false;
        from = from[length] ? from + length + 1 : NULL;
    }
    return true;
}

static char *map_paths(const char *name, const char *value, const char *file,
                       char *(*map)(const char *file, const char *path))
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    bool ok = out && put_paths(out, name, value, file, map);
    if (out && fclose(out) == 0 && ok)
        return text;
    free(text);
    return NULL;
}

char *hash_options_text(const struct options *options, const char *path)
{
    enum { FILES = sizeof of_files / sizeof *of_files };
    struct options shown = *options; // a copy that shares the lists of `options`
    char *values[FILES] = {0}, *text = NULL;
    bool ok = true;
    for (int i = 0; i < FILES; i++) {
        size_t row = (size_t)(option_find(of_files[i]) - option_table);
        if (!options->values[row])
            continue;
        shown.values[row] = values[i] = map_paths(of_files[i], options->values[row], path, hash_file_name);
        ok = ok && values[i];
    }
    text = ok ? batch_options_given(&shown) : NULL;
    for (int i = 0; i < FILES; i++)
        free(values[i]);
    return text;
}

// Returns whether the hash file `path` may refer to the files in an option's value. The paths in `value` are relative
// to the current folder.
static bool may_name(const char *path, const char *name, const char *value, const struct options *o, lam_error *error)
{
    bool environment = strcmp(name, "look") != 0, ok = true;
    if (environment ? environment_option_built_in(value) != NULL : look_find(value) != NULL)
        return true;
    for (const char *from = value; ok && from;) {
        size_t length = environment ? strcspn(from, ",") : strlen(from);
        char *one = strndup(from, length);
        ok = one ? hash_file_may_name(path, one, o, error) : complain(error, LAM_MACHINE, "out of memory");
        free(one);
        from = from[length] ? from + length + 1 : NULL;
    }
    return ok;
}

// Makes the paths in the options relative to the current folder. Must be called before a look is read. The new paths
// are stored in the buffer that begins at `to` and ends at `end`.
static bool resolve(char **words, int count, const char *path, char *to, const char *end, const struct options *o,
                    lam_error *error)
{
    for (int i = 0; i < count; i++)
        for (size_t k = 0; k < sizeof of_files / sizeof *of_files; k++) {
            size_t length = strlen(of_files[k]);
            if (strncmp(words[i], "--", 2) != 0 || strncmp(words[i] + 2, of_files[k], length) != 0)
                continue;
            const char *rest = words[i] + 2 + length;
            if (*rest == '=') // `lambent hash` never writes --name=value
                return false;
            if (*rest || i + 1 == count)
                continue;
            char *value = map_paths(of_files[k], words[i + 1], path, hash_file_model);
            bool fits = value && strlen(value) < (size_t)(end - to);
            if (fits)
                words[i + 1] = strcpy(to, value);
            to += fits ? strlen(value) + 1 : 0;
            free(value);
            if (!fits || !may_name(path, of_files[k], words[i + 1], o, error))
                return false;
        }
    return true;
}

bool hash_options_take(const struct hash_file *file, const char *path, const struct options *given, struct options *own,
                       char **kept, lam_error *error)
{
    char *words[WORDS_MAX], *now = hash_options_text(given, path);
    bool wanted = now && !*now && *file->options, ok = now && options_copy(own, given);
    free(now);
    // Each path may become longer by the length of the hash file's folder.
    size_t length = strlen(file->options), room = length + 1 + (length + 1) * (strlen(path) + 2);
    *kept = ok && wanted ? malloc(room) : NULL;
    if (*kept)
        strcpy(*kept, file->options);
    if (!ok || (wanted && !*kept))
        return complain(error, LAM_MACHINE, "out of memory");
    if (!wanted)
        return true;
    lam_error reason = {0};
    int count = split(*kept, words);
    ok = resolve(words, count, path, *kept + length + 1, *kept + room, given, &reason) &&
         options_parse(count, words, find_groups("hash"), own, &reason) == 0;
    // A look may name an environment.
    ok = ok && (!own->shading.environment || may_name(path, "environment", own->shading.environment, given, &reason));
    now = ok ? hash_options_text(own, path) : NULL;
    ok = now && strcmp(now, file->options) == 0; // the line may contain only options that change the picture
    free(now);
    return ok || complain(error, LAM_CANNOT_READ,
                          "%.300s:3: found '%.100s', expected options that change the picture%s%.200s", path,
                          file->options, *reason.text ? ": " : "", reason.text);
}
