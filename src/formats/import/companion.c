// companion.c: opens the files that models and scene files refer to: material libraries, models, pictures.
#include "companion.h"

#include "fail.h"
#include "file_list.h"
#include "number.h"
#include "shown_name.h"

#include <lambent/path.h>

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

// --- names

int companion_escaped(const char *at)
{
    int high = at[0] == '%' ? number_hex_digit(at[1]) : -1, low = high < 0 ? -1 : number_hex_digit(at[2]);
    return low < 0 ? -1 : high * 16 + low;
}

void companion_unescape(const char *uri, char *out)
{
    while (*uri) {
        int byte = companion_escaped(uri);
        *out++ = byte > 0 ? (char)byte : *uri; // %00 is not decoded, because a name cannot contain a zero byte
        uri += byte > 0 ? 3 : 1;
    }
    *out = 0;
}

// Copies the components of a path to `out`, which may be `name` itself. Components that are "." or empty are omitted.
// Each ".." removes the component before it. Returns false if the path leaves the folder, if no component is left, or
// if `capacity` is too small.
static bool copy_components(const char *name, char *out, size_t capacity)
{
    size_t used = 0;
    for (const char *at = name; *at; at += strspn(at, "/")) {
        size_t length = strcspn(at, "/");
        bool up = length == 2 && at[0] == '.' && at[1] == '.';
        if (up && used == 0)
            return false;
        if (up) {
            while (used > 0 && out[--used] != '/')
                ;
        } else if (length > 0 && !(length == 1 && *at == '.')) {
            if (used + length + 2 > capacity)
                return false;
            if (used)
                out[used++] = '/';
            memmove(out + used, at, length);
            used += length;
        }
        at += length;
    }
    out[used] = 0;
    return used > 0;
}

static char *join(struct arena *arena, const char *folder, const char *name)
{
    size_t length = strlen(folder), rest = strlen(name);
    char *path = arena_alloc(arena, length + rest + 1);
    if (path) {
        // NOLINTNEXTLINE(bugprone-not-null-terminated-result): the name follows, including its final zero
        memcpy(path, folder, length);
        memcpy(path + length, name, rest + 1);
    }
    return path;
}

// Resolves all links of a path. Returns the resolved path if it is inside one of params->allowed_paths (see
// path_within), otherwise NULL.
static char *path_allowed(const struct import_source *source, const char *path, size_t *length)
{
    char *real = NULL;
    bool outside;
    for (int i = 0; !real && i < source->params->allowed_path_count; i++)
        real = path_within(path, source->params->allowed_paths[i], &outside, length);
    return real;
}

// Returns whether a name that points outside the folder leads to an allowed path.
static bool is_allowed(const struct import_source *source, const char *name)
{
    const struct companions *companions = source->open_state;
    char path[2 * COMPANION_NAME_SIZE];
    size_t length;
    if (!source->params->allowed_path_count || companions->open || !companions->folder)
        return false;
    snprintf(path, sizeof path, "%s%s", name[0] == '/' ? "" : companions->folder, name);
    file_list_add(companions->files, path);
    char *real = path_allowed(source, path, &length);
    free(real);
    return real != NULL;
}

bool companion_name(const struct import_source *source, const char *name, char out[COMPANION_NAME_SIZE], bool *cut)
{
    char slashed[COMPANION_NAME_SIZE];
    size_t length = strlen(name);
    *cut = false;
    if (length >= sizeof slashed)
        return false;
    for (size_t i = 0; i <= length; i++)
        slashed[i] = name[i] == '\\' ? '/' : name[i];
    bool rooted = slashed[0] == '/' || (slashed[0] && slashed[1] == ':');
    if (!rooted && copy_components(slashed, out, COMPANION_NAME_SIZE))
        return true;
    if (is_allowed(source, slashed)) {
        memcpy(out, slashed, length + 1);
        return true;
    }
    const char *kept = path_name(slashed);
    *cut = true;
    return strcmp(kept, "..") != 0 && copy_components(kept, out, COMPANION_NAME_SIZE);
}

static bool fail_name(const struct import_source *source, const char *name, const char *why, lam_error *error)
{
    char shown[SHOWN_NAME_SIZE];
    return fail(error, LAM_CANNOT_READ, "%s: names the file '%s', %s", source->name, shown_file(name, shown), why);
}

// --- opening

// Opens a file through the caller's function.
static bool open_by_caller(const struct import_source *source, const char *name, struct arena *arena,
                           struct companion *out, lam_error *error)
{
    const struct companions *companions = source->open_state;
    char path[2 * COMPANION_NAME_SIZE], shown[SHOWN_NAME_SIZE];
    if (!companions->open)
        return fail_name(source, name, "which cannot be opened: the model has no folder", error);
    int length = snprintf(path, sizeof path, "%s%s", companions->inside, name);
    if (length < 0 || length >= (int)sizeof path)
        return fail_name(source, name, "whose path is too long", error);
    out->path = NULL;
    out->real = arena_string(arena, path);
    out->shown = arena_string(arena, shown_file(path, shown));
    if (!out->real || !out->shown)
        return call_memory_error(source->call, (size_t)length + sizeof shown, error);
    bool fresh = file_list_add(companions->files, path);
    lam_bytes bytes = {0};
    if (!companions->open(companions->user, path, &bytes, error))
        return false;
    if (fresh)
        call_add_input(source->call, bytes.size);
    bool ok = file_copy(bytes.data, bytes.size, source->call, &out->file, error);
    if (ok && !(ok = file_check_pointer(&out->file, out->shown, error)))
        file_release(&out->file);
    if (companions->release)
        companions->release(companions->user, &bytes);
    else
        lam_bytes_free(&bytes);
    return ok;
}

// Opens a file on disk. If `confined` is set, the file must be in the folder or below.
static bool open_beside(const struct import_source *source, const char *name, bool confined, const char *advice,
                        struct arena *arena, struct companion *out, lam_error *error)
{
    const struct companions *companions = source->open_state;
    const char *root = companions->folder, *folder = name[0] == '/' ? "" : root;
    char shown[SHOWN_NAME_SIZE];
    out->path = join(arena, folder, name);
    out->shown = join(arena, folder, shown_file(name, shown));
    if (!out->path || !out->shown)
        return call_memory_error(source->call, strlen(folder) + strlen(name), error);
    bool fresh = file_list_add(companions->files, out->path), outside;
    size_t length = 0;
    char *real = path_within(out->path, confined ? root : "/", &outside, &length);
    if (outside && !(real = confined ? path_allowed(source, out->path, &length) : realpath(out->path, NULL)))
        return fail(error, LAM_CANNOT_READ, "%s: leads out of the folder %s%s", out->shown, *root ? root : ".", advice);
    if (!real && errno == ENOMEM)
        return fail_memory(error, COMPANION_NAME_SIZE);
    // Opens the checked path. If the path could not be resolved, file_read_named reports the reason.
    out->real = real ? arena_string(arena, real) : out->path;
    length = real && confined ? length : 0;
    free(real);
    if (!out->real)
        return call_memory_error(source->call, COMPANION_NAME_SIZE, error);
    return file_read_named(out->real, length, out->shown, fresh, source->pool, source->call, &out->file, error);
}

// Adds the full name of a missing file to the error. Lambent looked only for the name's last component, but the file
// may exist under the full name.
static void explain_cut(const char *name, lam_error *error)
{
    char shown[SHOWN_NAME_SIZE];
    size_t used = strlen(error->text);
    snprintf(error->text + used, sizeof error->text - used, " (the name is '%s', outside of this folder%s)",
             shown_file(name, shown), name[1] == ':' ? "" : "; use lam_load_params.allowed_paths to allow it");
}

bool companion_open(const struct import_source *source, const char *name, struct arena *arena, struct companion *out,
                    lam_error *error)
{
    const struct companions *companions = source->open_state;
    char confined[COMPANION_NAME_SIZE];
    *out = (struct companion){0};
    bool cut;
    if (!companion_name(source, name, confined, &cut))
        return fail_name(source, name, "which is not a valid name", error);
    if (companions->open || !companions->folder)
        return open_by_caller(source, confined, arena, out, error);
    bool ok = open_beside(source, confined, true, "", arena, out, error);
    if (!ok && cut && error && error->code == LAM_CANNOT_READ)
        explain_cut(name, error);
    return ok;
}

// --- searching

enum { SEARCHES_MAX = 256 }; // a small file must not make the program list large folders many times

// Replaces the components of a name by the entries of the model's folder that differ only in case. Returns the number
// of entries for the last component that was looked for: 0, 1, or more if the name is ambiguous.
static int match_case(const struct companions *companions, char *name)
{
    int found = 1;
    for (char *at = name; at && found == 1; at = strchr(at, '/') ? strchr(at, '/') + 1 : NULL) {
        char path[2 * COMPANION_NAME_SIZE], wanted[COMPANION_NAME_SIZE];
        size_t length = strcspn(at, "/");
        bool exact = false;
        snprintf(path, sizeof path, "%s%.*s.", companions->folder, (int)(at - name), name);
        snprintf(wanted, sizeof wanted, "%.*s", (int)length, at);
        DIR *entries = lam_path_list(path);
        found = 0;
        for (struct dirent *entry; entries && !exact && (entry = readdir(entries));) {
            if (strcasecmp(entry->d_name, wanted) != 0)
                continue;
            exact = strcmp(entry->d_name, wanted) == 0;
            found = exact ? 1 : found + 1;
            memcpy(at, entry->d_name, length);
        }
        if (entries)
            closedir(entries);
    }
    return found;
}

// Tries one name. Returns true if the search ends: with the file, or with another error than a missing file.
static bool try_name(const struct import_source *source, const char *name, bool any_case, struct arena *arena,
                     struct companion *out, lam_error *error)
{
    struct companions *companions = source->open_state;
    char own[COMPANION_NAME_SIZE];
    bool cut, confined = companion_name(source, name, own, &cut);
    if (any_case) {
        if (!companions || companions->open || !companions->folder || companions->searches++ >= SEARCHES_MAX ||
            !confined || own[0] == '/')
            return false;
        int matches = match_case(companions, own);
        if (matches > 1)
            return !fail_name(source, name, "and several files differ from this name only in case; none is used",
                              error);
        if (!matches)
            return false;
    }
    *error = (lam_error){0};
    if (source->open(source, any_case ? own : name, arena, out, error) &&
        !(out->name = arena_string(arena, confined ? own : name)))
        call_memory_error(source->call, COMPANION_NAME_SIZE, error);
    return error->code != LAM_CANNOT_READ;
}

bool companion_find(const struct import_source *source, struct lam_scene *scene, const char *name, const char *beside,
                    struct arena *arena, struct companion *out, lam_error *error)
{
    enum { WAYS = 4 }; // the name and its last component, each in the model's folder and in `beside`
    char *names[2][WAYS], shown[2][SHOWN_NAME_SIZE];
    size_t length = strlen(name), quoted = length > 2 && *name == '"' && name[length - 1] == '"';
    lam_error first = {0}, other = {0};
    for (int step = 0; step < 4 * WAYS; step++) {
        const int decoded = step / (2 * WAYS), any_case = step / WAYS % 2, way = step % WAYS;
        char **own = names[decoded];
        if (way == 0 && !any_case) {
            own[0] = own[2] = arena_string_of(arena, name + quoted, length - 2 * quoted);
            if (decoded && own[0])
                companion_unescape(own[0], own[0]);
            for (char *at = own[0]; at && *at; at++)
                own[2] = *at == '/' || *at == '\\' ? at + 1 : own[2];
            own[1] = own[0] ? join(arena, beside, own[0]) : NULL;
            own[3] = own[0] ? join(arena, beside, own[2]) : NULL;
            if (!own[1] || !own[3])
                return call_memory_error(source->call, 2 * length, error);
        }
        bool repeated = decoded && strcmp(own[way], names[0][way]) == 0;
        for (int i = 0; i < way; i++)
            repeated |= strcmp(own[way], own[i]) == 0;
        lam_error *result = step ? &other : &first;
        if (repeated || !try_name(source, own[way], any_case, arena, out, result))
            continue;
        if (out->name && scene && (decoded || any_case || way >= 2))
            scene_warn(scene, "%s: names the file '%s'; '%s' is used", source->name, shown_file(name, shown[0]),
                       shown_file(out->name, shown[1]));
        first = *result;
        break;
    }
    if (!out->name && error)
        *error = first;
    return out->name != NULL;
}

bool companion_open_of_scene(const struct import_source *source, const char *name, struct arena *arena,
                             struct companion *out, lam_error *error)
{
    const struct companions *companions = source->open_state;
    char inside[COMPANION_NAME_SIZE];
    *out = (struct companion){0};
    if (companions->open || !companions->folder) {
        if (name[0] == '/' || !copy_components(name, inside, sizeof inside))
            return fail_name(source, name, "which is outside the scene file's folder", error);
        return open_by_caller(source, inside, arena, out, error);
    }
    return open_beside(source, name, !source->params->models_anywhere,
                       ", which must contain the files of a scene (lam_load_params.models_anywhere)", arena, out,
                       error);
}

bool companions_of_model(const struct import_source *scene, const char *name, const struct companion *model,
                         struct arena *arena, struct companions *out, lam_error *error)
{
    char inside[COMPANION_NAME_SIZE];
    *out = *(const struct companions *)scene->open_state;
    const char *path = model->path;
    if (!path) {
        copy_components(name, inside, sizeof inside); // the same name as in open_of_scene
        path = inside;
    }
    const char *folder = arena_string_of(arena, path, (size_t)(path_name(path) - path));
    if (!folder)
        return call_memory_error(scene->call, strlen(path), error);
    if (model->path)
        out->folder = folder;
    else
        out->inside = folder;
    return true;
}
